//! An explanation as text.

use std::fmt;

use tunnelproof::contact::ContactKind;

use crate::answer::ExactHit;

use super::{Explanation, Impact, TripleProduct, number, place, statements};

impl fmt::Display for Explanation {
    /// What `explain` prints, but for the title.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.points(f)?;
        self.case(f)?;
        if let Some(product) = &self.f {
            product.write(f)?;
        }
        writeln!(f, "\n{}", self.heading)?;
        for time in &self.times {
            writeln!(f, "  t = {:<24}  {}", time.exactly, time.words)?;
        }
        match &self.impact {
            Some(impact) => impact.write(f)?,
            None => f.write_str("\nNo contact.\n")?,
        }
        write!(f, "\n{}", statements(&self.subjects))
    }
}

impl Explanation {
    fn points(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let points = self.query.start().iter().chain(self.query.end());
        let rows: Vec<_> = points
            .map(|point| [point.x, point.y, point.z].map(number::short))
            .collect();
        let width = rows.iter().flatten().map(String::len).max().unwrap_or(0);
        for (index, [x, y, z]) in rows.iter().enumerate() {
            let (name, time) = (['A', 'B', 'C', 'D'][index % 4], index / 4);
            writeln!(f, "  {name}({time})  {x:>width$}  {y:>width$}  {z:>width$}")?;
        }
        match self.query.radius() {
            radius if radius.is_zero() => Ok(()),
            radius => writeln!(f, "  radius  {radius}"),
        }
    }

    fn case(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let listed = |names: &[&str]| match names {
            [] => "none".to_owned(),
            names => names.join(", "),
        };
        let case = &self.case;
        writeln!(f, "\nCase: {}: {}", case.name, case.words)?;
        writeln!(f, "  with {}", case.definitions)?;
        let (zero, other) = (listed(&case.vanishing), listed(&case.not_vanishing));
        writeln!(f, "  identically 0: {zero}; not: {other}")
    }
}

impl TripleProduct {
    fn write(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nf(t), exactly 2^{} times:", self.exponent)?;
        let width = self.integers.iter().map(String::len).max().unwrap_or(0);
        let powers = ["1", "t", "t^2", "t^3"];
        let rows = powers.iter().zip(&self.integers).zip(&self.decimals);
        for ((power, integer), decimal) in rows {
            writeln!(f, "  {power:<4} {integer:>width$}   in m^3: {decimal}")?;
        }
        Ok(())
    }
}

impl Impact {
    fn write(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\nTime of impact\n")?;
        if let Some(fraction) = &self.fraction {
            writeln!(f, "  exactly   {fraction}")?;
        }
        if let Some(root_of) = &self.root_of {
            writeln!(f, "  exactly   irrational, a root of {root_of}")?;
        }
        writeln!(f, "  decimals  {}", self.decimals)?;
        let words = [&self.in_f64, &self.place, &self.kind_words];
        f.write_str(&rounded(words.map(String::as_str), &self.features))
    }
}

/// The first contact as far as the answer has it: its time and place in `f64`, what touches, and the
/// kind. Lines of text.
pub fn contact(hit: &ExactHit, is_thick: bool) -> String {
    let place = place(&hit.first, hit.second.as_ref());
    let words = [&hit.toi.to_string(), &place, &kind(hit, is_thick)];
    let features = hit.features.map(|feature| feature.to_string());
    rounded(words.map(String::as_str), &features)
}

fn rounded([time, place, kind]: [&str; 3], [first, second]: &[String; 2]) -> String {
    format!(
        "  in f64    {time}\n  contact   {place}\n  features  {first} and {second}\n  kind      {kind}\n"
    )
}

/// The kind of a contact, the side they come from and the configuration.
pub(super) fn kind(hit: &ExactHit, is_thick: bool) -> String {
    let kind = match is_thick {
        true => thick(hit),
        false => thin(hit).to_owned(),
    };
    kind + &remarks(hit)
}

fn thin(hit: &ExactHit) -> &'static str {
    match (hit.kind, hit.crosses) {
        (ContactKind::Crossing, _) => "crossing: they swap sides",
        (ContactKind::Graze, true) => "graze, but they swap sides later",
        (ContactKind::Graze, false) => "graze: they touch without swapping sides",
    }
}

/// The kind of a contact at a radius.
fn thick(hit: &ExactHit) -> String {
    let begins = match hit.is_initial() {
        true => "initial overlap",
        false => "contact at the radius",
    };
    let crosses = match hit.crosses {
        true => "crossing: the midlines pass in this step",
        false => "graze: the midlines do not pass in this step",
    };
    format!("{begins}; {crosses}")
}

/// The side they come from and the configuration.
fn remarks(hit: &ExactHit) -> String {
    let side = match hit.side {
        0 => "",
        1.. => ", f > 0 just before",
        _ => ", f < 0 just before",
    };
    let parallel = match hit.flags.temporarily_parallel {
        true => ", temporarily parallel",
        false => "",
    };
    let point = match hit.flags.temporarily_point {
        true => ", temporarily a point",
        false => "",
    };
    [side, parallel, point].concat()
}
