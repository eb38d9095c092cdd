//! Prints how many wires over a drum hold and slip as they should, out of a grid.
//!
//! `cargo run --release --example capstan_grid`. With `all`, every one that does not, too; with
//! `route`, `laid` or `contacts` only those that get around their drum in this way; with a number,
//! one in so many.

use std::collections::BTreeMap;
use std::env::args;
use std::error::Error;

mod drum;

use drum::{LAID, MESHES, PARTS, Way, grid};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = args().skip(1).collect();
    let names = |name: &str| arguments.iter().any(|argument| argument == name);
    let ways = [
        ("route", Way::Route),
        ("laid", Way::ContactNodes),
        ("contacts", Way::Contacts),
    ];
    let every = arguments
        .iter()
        .find_map(|argument| argument.parse().ok())
        .map_or(1, |every: usize| every.max(1));
    let some = ways.iter().any(|(name, _)| names(name));
    let parts = PARTS.map(|part| format!(" {part} |"));
    println!(
        "| way | wire | nodes to 180 degrees | resolution, m | adapts | step, s |{} bounds |",
        parts.concat()
    );
    println!(
        "| --- | --- | --- | --- | --- | --- |{} --- |",
        " --- |".repeat(PARTS.len())
    );
    for (name, way) in ways.into_iter().filter(|(name, _)| !some || names(name)) {
        let mut rows = BTreeMap::new();
        for (column, part) in PARTS.into_iter().enumerate() {
            for drum in grid(way, part)
                .into_iter()
                .skip(column % every)
                .step_by(every)
            {
                let mut meshes = MESHES.iter().chain(&LAID);
                let mesh = meshes.position(|mesh| *mesh == drum.mesh);
                let key = (drum.stiffness, mesh);
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
        for ((wire, mesh), (counts, residual)) in rows {
            let mesh = mesh
                .and_then(|at| MESHES.iter().chain(&LAID).nth(at))
                .ok_or("no such mesh")?;
            let counts = counts.map(|[right, all]| format!(" {right}/{all} |"));
            println!(
                "| {name} | {wire} | {} | {} | {} | 1/{} |{} {residual:.0e} |",
                mesh.corners,
                mesh.resolution,
                if mesh.adaptive { "yes" } else { "no" },
                mesh.rate,
                counts.concat()
            );
        }
    }
    Ok(())
}
