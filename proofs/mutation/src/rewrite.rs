//! Finds the mutants of a source file, and writes a source that has all of them.
//!
//! A place that is mutated asks `crate::mutation::at` which mutant is on, and behaves as it says. So one build serves all
//! mutants ("mutant schemata": Untch, Offutt and Harrold, 1993).

use std::collections::BTreeSet;
use std::ops::Range;

use proc_macro2::Span;
use serde::{Deserialize, Serialize};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// A change of the sources.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Mutant {
    pub id: u32,
    /// The place that has it, which may have others.
    pub site: u32,
    pub file: String,
    pub line: usize,
    pub column: usize,
    pub function: String,
    pub kind: Kind,
    /// What it does, as `a + b -> a - b`.
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A number in floating point is 0, half of what it is, or twice that.
    Constant,
    /// Another operation of two values.
    Operator,
    /// `-` or `!` is left out.
    Unary,
    /// A function returns a constant at once.
    Body,
    /// An arm of a match is left out, or its condition is always met or never.
    Arm,
}

impl Kind {
    pub const ALL: [Self; 5] = [
        Self::Constant,
        Self::Operator,
        Self::Unary,
        Self::Body,
        Self::Arm,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Operator => "operator",
            Self::Unary => "unary",
            Self::Body => "body",
            Self::Arm => "arm",
        }
    }
}

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

    fn binary(&mut self, e: &syn::ExprBinary) {
        let operator = self.text[e.op.span().byte_range()].to_owned();
        let others: &[&str] = match operator.as_str() {
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
        };
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

    fn unary(&mut self, e: &syn::ExprUnary) {
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

    fn body(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let values = returned(&signature.output);
        let site = self.site();
        let wanted = self.add(
            site,
            Kind::Body,
            signature.ident.span(),
            values
                .into_iter()
                .map(|value| {
                    (
                        format!(
                            "returns {}",
                            if value.is_empty() { "at once" } else { &value }
                        ),
                        value,
                    )
                })
                .collect(),
        );
        if !wanted.is_empty() {
            let mut text = format!("match crate::mutation::at({site}) {{");
            for (id, value) in &wanted {
                text.push_str(&format!("\n{id} => return {value}, /*m{id}*/"));
            }
            text.push_str("\n_ => {} }\n");
            self.open(block.brace_token.span.open().byte_range().end, text);
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

fn arms(alternatives: &[Alternative], original: &str, marks: &str) -> String {
    let mut text = String::new();
    for (id, code) in alternatives {
        text.push_str(&format!("\n{id} => {code}, /*m{id}*/"));
    }
    text.push_str(&format!("\n_ => {original} {marks}\n"));
    text
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

/// What a function may return in place of what it computes, as far as its type says so.
fn returned(output: &syn::ReturnType) -> Vec<String> {
    let texts = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect();
    let syn::ReturnType::Type(_, ty) = output else {
        return texts(&[""]);
    };
    let syn::Type::Path(path) = &**ty else {
        return match &**ty {
            syn::Type::Never(_) | syn::Type::ImplTrait(_) | syn::Type::Reference(_) => Vec::new(),
            _ => texts(&["Default::default()"]),
        };
    };
    match path
        .path
        .segments
        .last()
        .map(|segment| segment.ident.to_string())
        .as_deref()
    {
        Some("bool") => texts(&["true", "false"]),
        Some("f64" | "f32") => texts(&["0.0", "1.0", "-1.0"]),
        Some("u8" | "u16" | "u32" | "u64" | "u128" | "usize") => texts(&["0", "1"]),
        Some("i8" | "i16" | "i32" | "i64" | "i128" | "isize") => texts(&["0", "1", "-1"]),
        Some("Option") => texts(&["None", "Some(Default::default())"]),
        Some("Result") => texts(&["Ok(Default::default())"]),
        _ => texts(&["Default::default()"]),
    }
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
}
