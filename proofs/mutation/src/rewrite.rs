//! Finds the mutants of a source file, and writes a source that has all of them.
//!
//! A place that is mutated asks `crate::mutation::at` which mutant is on, and behaves as it says. So one build serves all
//! mutants ("mutant schemata": Untch, Offutt and Harrold, 1993).

use std::collections::BTreeSet;
use std::ops::Range;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::mutant::{Kind, Mutant};

mod arms;
mod operators;
mod returns;

/// A source with all its mutants.
pub struct Rewritten {
    pub text: String,
    pub mutants: Vec<Mutant>,
}

/// Where numbers go on, so that no two mutants of several files have the same.
#[derive(Default)]
pub struct Numbers {
    pub ids: u32,
    pub sites: u32,
}

/// The names of all constants of type `f64` in a file, outside tests.
pub fn constants(file: &syn::File) -> BTreeSet<String> {
    struct Names(BTreeSet<String>);
    impl Names {
        fn take(&mut self, ty: &syn::Type, name: &syn::Ident) {
            if is_type(ty, "f64") {
                self.0.insert(name.to_string());
            }
        }
    }
    impl<'a> Visit<'a> for Names {
        fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
            self.take(&item.ty, &item.ident);
        }
        fn visit_impl_item_const(&mut self, item: &'a syn::ImplItemConst) {
            self.take(&item.ty, &item.ident);
        }
    }
    let mut names = Names(BTreeSet::new());
    names.visit_file(file);
    names.0
}

/// The file with all its mutants, but those in `dropped`, which do not compile.
pub fn rewrite(
    name: &str,
    text: &str,
    file: &syn::File,
    constants: &BTreeSet<String>,
    dropped: &BTreeSet<u32>,
    numbers: &mut Numbers,
) -> Rewritten {
    let mut rewriter = Rewriter {
        name,
        text,
        constants,
        dropped,
        numbers,
        function: String::new(),
        edits: Vec::new(),
        mutants: Vec::new(),
    };
    rewriter.visit_file(file);
    let mut edits = rewriter.edits;
    // What ends somewhere comes before what begins there, and an operator after that; nesting is in the order of the edits.
    edits.sort_by_key(|edit| (edit.at.start, edit.order));
    let (mut out, mut done) = (String::with_capacity(2 * text.len()), 0);
    for edit in &edits {
        out.push_str(&text[done..edit.at.start]);
        out.push_str(&edit.text);
        done = edit.at.end;
    }
    out.push_str(&text[done..]);
    Rewritten {
        text: out,
        mutants: rewriter.mutants,
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Order {
    Close,
    Open,
    Replace,
}

struct Edit {
    at: Range<usize>,
    order: Order,
    text: String,
}

struct Rewriter<'a> {
    name: &'a str,
    text: &'a str,
    constants: &'a BTreeSet<String>,
    dropped: &'a BTreeSet<u32>,
    numbers: &'a mut Numbers,
    function: String,
    edits: Vec<Edit>,
    mutants: Vec<Mutant>,
}

/// A mutant that compiles, as far as is known: its number, and what the source has in its place.
type Alternative = (u32, String);

impl Rewriter<'_> {
    fn site(&mut self) -> u32 {
        self.numbers.sites += 1;
        self.numbers.sites - 1
    }

    /// Counts the mutants of a place, and returns those that are wanted.
    fn add(
        &mut self,
        site: u32,
        kind: Kind,
        span: Span,
        alternatives: Vec<(String, String)>,
    ) -> Vec<Alternative> {
        let start = span.start();
        let mut wanted = Vec::new();
        for (what, code) in alternatives {
            let id = self.numbers.ids;
            self.numbers.ids += 1;
            if self.dropped.contains(&id) {
                continue;
            }
            self.mutants.push(Mutant {
                id,
                site,
                file: self.name.to_owned(),
                line: start.line,
                column: start.column + 1,
                function: self.function.clone(),
                kind,
                what,
            });
            wanted.push((id, code));
        }
        wanted
    }

    fn open(&mut self, at: usize, text: String) {
        self.edits.push(Edit {
            at: at..at,
            order: Order::Open,
            text,
        });
    }

    fn close(&mut self, at: usize, text: String) {
        self.edits.push(Edit {
            at: at..at,
            order: Order::Close,
            text,
        });
    }

    fn replace(&mut self, at: Range<usize>, text: String) {
        self.edits.push(Edit {
            at,
            order: Order::Replace,
            text,
        });
    }

    /// The source of what has this span, on one line and not too long, for people.
    fn shown(&self, span: Span) -> String {
        let text = self.text[span.byte_range()]
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        if text.chars().count() <= 60 {
            text
        } else {
            text.chars().take(57).chain("...".chars()).collect()
        }
    }

    fn scaled(&mut self, span: Span) {
        let site = self.site();
        let shown = self.shown(span);
        let first = self.numbers.ids;
        let wanted = self.add(
            site,
            Kind::Constant,
            span,
            [" * 0", " / 2", " * 2"]
                .map(|by| (format!("{shown} -> {shown}{by}"), String::new()))
                .to_vec(),
        );
        if wanted.len() == 3 {
            self.open(
                span.byte_range().start,
                format!("crate::mutation::scaled({site}, {first}, "),
            );
            self.close(span.byte_range().end, format!("){}\n", marks(&wanted)));
        }
    }

    fn function(
        &mut self,
        signature: &syn::Signature,
        attributes: &[syn::Attribute],
        block: &syn::Block,
    ) {
        if is_test(attributes) || signature.constness.is_some() {
            return;
        }
        let outer = std::mem::replace(&mut self.function, signature.ident.to_string());
        self.body(signature, block);
        self.visit_block(block);
        self.function = outer;
    }
}

/// The numbers of mutants in a comment, for whoever reads that the line does not compile.
fn marks(alternatives: &[Alternative]) -> String {
    alternatives
        .iter()
        .map(|(id, _)| format!("/*m{id}*/"))
        .collect()
}

fn is_type(ty: &syn::Type, name: &str) -> bool {
    matches!(ty, syn::Type::Path(path) if path.path.is_ident(name))
}

/// Whether the expression, or one that it joins by `&&` or `||`, is a `let`.
fn has_let(e: &syn::Expr) -> bool {
    match e {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(e) => has_let(&e.left) || has_let(&e.right),
        _ => false,
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("test")
            || (attribute.path().is_ident("cfg")
                && matches!(&attribute.meta, syn::Meta::List(list) if list.tokens.to_string() == "test"))
    })
}

impl<'a> Visit<'a> for Rewriter<'_> {
    fn visit_item(&mut self, item: &'a syn::Item) {
        let attributes = match item {
            syn::Item::Mod(item) => &item.attrs,
            syn::Item::Impl(item) => &item.attrs,
            syn::Item::Fn(item) => &item.attrs,
            // What is computed when compiling is not mutated where it stands: its uses are.
            syn::Item::Const(_)
            | syn::Item::Static(_)
            | syn::Item::Enum(_)
            | syn::Item::Struct(_)
            | syn::Item::Macro(_) => return,
            _ => return visit::visit_item(self, item),
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &'a syn::ItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'a syn::ImplItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'a syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.sig, &item.attrs, block);
        }
    }

    fn visit_impl_item_const(&mut self, _: &'a syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'a syn::TraitItemConst) {}
    fn visit_type(&mut self, _: &'a syn::Type) {}
    fn visit_pat(&mut self, _: &'a syn::Pat) {}
    fn visit_attribute(&mut self, _: &'a syn::Attribute) {}
    fn visit_generic_argument(&mut self, _: &'a syn::GenericArgument) {}
    fn visit_macro(&mut self, _: &'a syn::Macro) {}
    fn visit_expr_const(&mut self, _: &'a syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, e: &'a syn::ExprRepeat) {
        self.visit_expr(&e.expr);
    }

    fn visit_expr_binary(&mut self, e: &'a syn::ExprBinary) {
        self.binary(e);
    }

    fn visit_expr_unary(&mut self, e: &'a syn::ExprUnary) {
        self.unary(e);
    }

    fn visit_expr_lit(&mut self, e: &'a syn::ExprLit) {
        if let syn::Lit::Float(number) = &e.lit
            && number.base10_parse::<f64>().is_ok_and(|value| value != 0.0)
        {
            self.scaled(e.span());
        }
    }

    fn visit_expr_path(&mut self, e: &'a syn::ExprPath) {
        let name = e
            .path
            .segments
            .last()
            .map(|segment| segment.ident.to_string());
        if e.qself.is_none() && name.is_some_and(|name| self.constants.contains(&name)) {
            self.scaled(e.span());
        }
    }

    fn visit_expr_match(&mut self, e: &'a syn::ExprMatch) {
        self.visit_expr(&e.expr);
        let has_rest = e
            .arms
            .iter()
            .any(|arm| matches!(arm.pat, syn::Pat::Wild(_)) && arm.guard.is_none());
        for arm in &e.arms {
            self.arm(arm, has_rest);
        }
    }
}

#[cfg(test)]
mod tests;
