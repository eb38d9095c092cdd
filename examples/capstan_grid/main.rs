//! Prints how many wires over a drum hold and slip as they should, out of a grid.
//!
//! `cargo run --release --example capstan_grid`. With `all`, every one that does not, too; with
//! `route`, `laid` or `contacts` only those that get around their drum in this way.

use std::collections::BTreeMap;
use std::env::args;
use std::error::Error;

mod drum;

use drum::{PARTS, Way, grid};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = args().skip(1).collect();
    let names = |name: &str| arguments.iter().any(|argument| argument == name);
    let ways = [
        ("route", Way::Route),
        ("laid", Way::ContactNodes),
        ("contacts", Way::Contacts),
    ];
    let some = ways.iter().any(|(name, _)| names(name));
    let parts = PARTS.map(|part| format!(" {part} |"));
    println!(
        "| way | wire | resolution, m | adapts | step, s |{} bounds |",
        parts.concat()
    );
    println!(
        "| --- | --- | --- | --- | --- |{} --- |",
        " --- |".repeat(PARTS.len())
    );
    for (name, way) in ways.into_iter().filter(|(name, _)| !some || names(name)) {
        let mut rows = BTreeMap::new();
        for (column, part) in PARTS.into_iter().enumerate() {
            for drum in grid(way, part) {
                let key = (
                    drum.stiffness,
                    format!("{}", drum.resolution),
                    drum.adaptive,
                    (1.0 / drum.step).round() as usize,
                );
                let (counts, residual): &mut ([[usize; 2]; PARTS.len()], f64) =
                    rows.entry(key).or_default();
                counts[column][1] += 1;
                let is_right = match drum.run() {
                    Ok(outcome) => {
                        *residual = residual.max(outcome.residual);
                        let is_right = outcome.is_right(&drum);
                        if !is_right && names("all") {
                            println!("{drum:?}: {outcome:?}");
                        }
                        is_right
                    }
                    Err(error) => {
                        if names("all") {
                            println!("{drum:?}: {error}");
                        }
                        false
                    }
                };
                counts[column][0] += usize::from(is_right);
            }
        }
        for ((wire, resolution, adaptive, rate), (counts, residual)) in rows {
            let counts = counts.map(|[right, all]| format!(" {right}/{all} |"));
            let adapts = if adaptive { "yes" } else { "no" };
            println!(
                "| {name} | {wire} | {resolution} | {adapts} | 1/{rate} |{} {residual:.0e} |",
                counts.concat()
            );
        }
    }
    Ok(())
}
