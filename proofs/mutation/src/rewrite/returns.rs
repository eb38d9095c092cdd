//! Functions that return at once.

use super::Rewriter;
use crate::mutant::Kind;

impl Rewriter<'_> {
    pub(super) fn body(&mut self, signature: &syn::Signature, block: &syn::Block) {
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
