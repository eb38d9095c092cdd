//! Arms of a `match`.

use syn::spanned::Spanned;
use syn::visit::Visit;

use super::{Rewriter, has_let};
use crate::mutant::Kind;

impl Rewriter<'_> {
    /// `has_rest` tells whether the match has an arm for whatever no other one takes.
    pub(super) fn arm(&mut self, arm: &syn::Arm, has_rest: bool) {
        let pattern = arm.pat.span();
        match &arm.guard {
            Some((_, guard)) if !has_let(guard) => {
                let site = self.site();
                let shown = self.shown(guard.span());
                let wanted = self.add(
                    site,
                    Kind::Arm,
                    pattern,
                    ["true", "false"]
                        .map(|to| (format!("the condition {shown} is {to}"), to.to_owned()))
                        .to_vec(),
                );
                if let [(met, _), (unmet, _)] = wanted[..] {
                    let at = format!("crate::mutation::at({site})");
                    let range = guard.span().byte_range();
                    self.open(
                        range.start,
                        format!("{at} == {met} || ({at} != {unmet} && ("),
                    );
                    self.visit_expr(guard);
                    self.close(range.end, format!("))/*m{met}*//*m{unmet}*/\n"));
                } else {
                    self.visit_expr(guard);
                }
            }
            Some((_, guard)) => self.visit_expr(guard),
            None if has_rest && !matches!(arm.pat, syn::Pat::Wild(_)) => {
                let site = self.site();
                let shown = self.shown(pattern);
                let wanted = self.add(
                    site,
                    Kind::Arm,
                    pattern,
                    vec![(format!("without the arm {shown}"), String::new())],
                );
                if let [(id, _)] = wanted[..] {
                    self.close(
                        pattern.byte_range().end,
                        format!(" if crate::mutation::at({site}) != {id} /*m{id}*/\n"),
                    );
                }
            }
            None => {}
        }
        self.visit_expr(&arm.body);
    }
}
