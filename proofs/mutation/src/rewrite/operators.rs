//! Operators of two values, and of one.

use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use super::{Alternative, Rewriter, has_let, marks};
use crate::mutant::Kind;

/// What may stand in place of an operator.
fn others(operator: &str) -> &'static [&'static str] {
    match operator {
        "+" => &["-", "*"],
        "-" => &["+", "/"],
        "*" => &["+", "/"],
        "/" => &["*", "%"],
        "%" => &["/", "+"],
        "==" => &["!="],
        "!=" => &["=="],
        "<" => &["<=", ">", "=="],
        "<=" => &["<", ">"],
        ">" => &[">=", "<", "=="],
        ">=" => &[">", "<"],
        "&&" => &["||"],
        "||" => &["&&"],
        "<<" => &[">>"],
        ">>" => &["<<"],
        "&" => &["|", "^"],
        "|" => &["&", "^"],
        "^" => &["|", "&"],
        "+=" => &["-=", "*="],
        "-=" => &["+=", "/="],
        "*=" => &["+=", "/="],
        "/=" => &["*=", "%="],
        "|=" => &["&=", "^="],
        "&=" => &["|=", "^="],
        "^=" => &["|=", "&="],
        "<<=" => &[">>="],
        ">>=" => &["<<="],
        _ => &[],
    }
}

impl Rewriter<'_> {
    pub(super) fn binary(&mut self, e: &syn::ExprBinary) {
        let operator = self.text[e.op.span().byte_range()].to_owned();
        let others = others(&operator);
        let is_logic = matches!(e.op, syn::BinOp::And(_) | syn::BinOp::Or(_));
        if others.is_empty() || has_let(&e.left) || has_let(&e.right) {
            return visit::visit_expr_binary(self, e);
        }
        let is_comparison = matches!(operator.as_str(), "==" | "!=" | "<" | "<=" | ">" | ">=");
        let is_assignment = operator.ends_with('=') && !is_comparison;
        let (l, r) = match () {
            () if is_comparison => ("*left_", "*right_"),
            () if is_assignment => (&self.text[e.left.span().byte_range()], "right_"),
            () => ("left_", "right_"),
        };
        let (l, r) = (l.to_owned(), r.to_owned());
        let shown = format!(
            "{} {operator} {}",
            self.shown(e.left.span()),
            self.shown(e.right.span())
        );
        let site = self.site();
        let wanted = self.add(
            site,
            Kind::Operator,
            e.op.span(),
            others
                .iter()
                .map(|other| {
                    (
                        format!("{shown}: {operator} -> {other}"),
                        format!("{l} {other} {r}"),
                    )
                })
                .collect(),
        );
        if wanted.is_empty() {
            return visit::visit_expr_binary(self, e);
        }
        let all = e.span().byte_range();
        let marks = marks(&wanted);
        let arms = arms(&wanted, &format!("{l} {operator} {r}"), &marks);
        match () {
            () if is_logic => {
                let is_on = format!("crate::mutation::at({site}) == {}", wanted[0].0);
                let negated = if operator == "&&" { "" } else { "!" };
                self.open(all.start, "({ let left_: bool = ".to_owned());
                self.visit_expr(&e.left);
                self.replace(
                    e.op.span().byte_range(),
                    format!("; if left_ == {negated}({is_on}) {{ left_ }} else {{ {marks}\n"),
                );
                self.visit_expr(&e.right);
                self.close(all.end, " } })".to_owned());
            }
            () if is_comparison => {
                self.open(all.start, "(match (&(".to_owned());
                self.visit_expr(&e.left);
                self.replace(e.op.span().byte_range(), "), &(".to_owned());
                self.visit_expr(&e.right);
                self.close(all.end, format!(")) {{ {marks}\n(left_, right_) => match crate::mutation::at({site}) {{{arms}}} }})"));
            }
            () if is_assignment => {
                // The place is written as it was, and is not mutated.
                let right = e.right.span().byte_range();
                self.replace(all.start..right.start, "(match (".to_owned());
                self.visit_expr(&e.right);
                self.close(
                    all.end,
                    format!(
                        ") {{ {marks}\nright_ => match crate::mutation::at({site}) {{{arms}}} }})"
                    ),
                );
            }
            () => {
                self.open(all.start, "(match (".to_owned());
                self.visit_expr(&e.left);
                self.replace(e.op.span().byte_range(), ", ".to_owned());
                self.visit_expr(&e.right);
                self.close(all.end, format!(") {{ {marks}\n(left_, right_) => match crate::mutation::at({site}) {{{arms}}} }})"));
            }
        }
    }

    pub(super) fn unary(&mut self, e: &syn::ExprUnary) {
        let operator = match e.op {
            syn::UnOp::Neg(_) => "-",
            syn::UnOp::Not(_) => "!",
            _ => return visit::visit_expr_unary(self, e),
        };
        let site = self.site();
        let shown = self.shown(e.span());
        let wanted = self.add(
            site,
            Kind::Unary,
            e.span(),
            vec![(format!("{shown}: without {operator}"), "it_".to_owned())],
        );
        if wanted.is_empty() {
            return visit::visit_expr_unary(self, e);
        }
        let all = e.span().byte_range();
        let marks = marks(&wanted);
        let arms = arms(&wanted, &format!("{operator}it_"), &marks);
        self.open(all.start, "(match (".to_owned());
        self.replace(e.op.span().byte_range(), String::new());
        self.visit_expr(&e.expr);
        self.close(
            all.end,
            format!(") {{ {marks}\nit_ => match crate::mutation::at({site}) {{{arms}}} }})"),
        );
    }
}

fn arms(alternatives: &[Alternative], original: &str, marks: &str) -> String {
    let mut text = String::new();
    for (id, code) in alternatives {
        text.push_str(&format!("\n{id} => {code}, /*m{id}*/"));
    }
    text.push_str(&format!("\n_ => {original} {marks}\n"));
    text
}
