//! An explanation as text.

use std::fmt;

use tunnelproof::contact::ContactKind;

use crate::answer::ExactHit;

use super::{Explanation, Impact, TripleProduct, number};

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
        self.statements(f)
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

    fn statements(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths = self.subjects.iter().map(|said| said.claim.len());
        let width = widths.max().unwrap_or(0);
        f.write_str("\nWhat the subjects say\n")?;
        for said in &self.subjects {
            let (name, claim, worth) = (&said.name, &said.claim, &said.worth);
            writeln!(f, "  {name:<17} {claim:<width$}  {worth}")?;
        }
        Ok(())
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
        writeln!(f, "  in f64    {}", self.in_f64)?;
        writeln!(f, "  contact   {}", self.place)?;
        let [first, second] = &self.features;
        writeln!(f, "  features  {first} and {second}")?;
        writeln!(f, "  kind      {}", self.kind_words)
    }
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
