//! A sample of the grid of wires over drums: what should hold holds, and what should slip slips as
//! fast as the formula says. `cargo run --release --example capstan_grid` prints the whole grid.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[allow(
    dead_code,
    reason = "the example prints what happens without contact nodes, too"
)]
#[path = "../examples/capstan_grid/drum.rs"]
mod drum;

use drum::{Drum, Outcome, PARTS, Way, grid};

/// One in so many. It shares no factor with the numbers of meshes, so that all of them are there.
const EVERY: usize = 29;

/// Drums of each part of the limit.
fn sample(way: Way, parts: &[f64]) -> impl Iterator<Item = Drum> {
    let of = move |(offset, &part)| grid(way, part).into_iter().skip(offset).step_by(EVERY);
    parts.iter().enumerate().flat_map(of)
}

fn check(drum: &Drum, outcome: &Outcome) {
    let wire = drum.stiffness;
    assert!(outcome.is_right(drum), "{wire}, {drum:?}: {outcome:?}");
}

#[test]
fn wires_over_drums_hold_and_slip_by_the_capstans_ratio() {
    let mut count = 0;
    for drum in sample(Way::Route, &PARTS) {
        check(&drum, &drum.run().unwrap());
        count += 1;
    }
    assert!(count > 100, "{count}");
}

#[test]
fn wires_that_are_laid_on_drums_hold_and_slip_by_the_capstans_ratio() {
    // Not what the page on known answers says is wrong: far too short segments sink into the drum.
    let is_too_fine = |drum: &Drum| drum.mesh.resolution < 0.05 && drum.mesh.rate < 100;
    let drums = sample(Way::ContactNodes, &[0.9, 1.1]);
    for drum in drums.filter(|drum| !is_too_fine(drum)) {
        check(&drum, &drum.run().unwrap());
    }
}

#[test]
fn friction_that_is_off_by_a_tenth_is_seen() {
    for (part, factor) in [(0.99, 0.9), (1.01, 1.1)] {
        for drum in sample(Way::Route, &[part]) {
            let outcome = drum.run_with(drum.friction * factor).unwrap();
            assert!(!outcome.is_right(&drum), "{drum:?}: {outcome:?}");
        }
    }
}
