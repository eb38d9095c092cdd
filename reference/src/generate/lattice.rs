//! Motion on a lattice: every coordinate is a small integer, so that every degeneracy is met
//! exactly and often, together with others.
//!
//! Probes the classification, and contact at ends of edges, at ends of the step and at times of
//! parallel or vanishing edges. A query is made in two steps:
//!
//! 1. The motion is confined. Of 16 queries, 6 are free in space (coordinates up to 1, 2 or 3), 4
//!    keep the four points in a plane, 3 on a line, and 3 keep the edges parallel on a line each.
//!    Plane and lines move; of two such queries one moves the points freely within a confinement of
//!    fixed direction, the other carries them along with one that turns, stretches or collapses.
//! 2. Points are merged for the whole step: of 16 queries, in 1 A and B, in 1 C and D, in 2 A and
//!    C.
//!
//! Each of the six cases is met by more than a tenth of the queries; coordinates are at most 5.

use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::confine::{Reach, confined};
use super::motion::{Motion, in_units, vector};
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "lattice",
    description: "every degeneracy exactly: coordinates are small integers, motion often confined",
    draw: Draw::Query(draw),
};

const REACH: Reach = Reach {
    directions: 1,
    coefficients: 2,
    origins: 1,
};

fn draw(rng: &mut dyn Rng) -> Query {
    let mut ends = match rng.random_range(0..16) {
        0..6 => free(rng),
        6..10 => confined::<2>(rng, [0, 0, 0, 0], &REACH),
        10..13 => confined::<1>(rng, [0, 0, 0, 0], &REACH),
        _ => confined::<1>(rng, [0, 0, 1, 1], &REACH),
    };
    let merged = match rng.random_range(0..16) {
        0 => Some((0, 1)),
        1 => Some((2, 3)),
        2..4 => Some((0, 2)),
        _ => None,
    };
    if let Some((kept, moved)) = merged {
        for positions in &mut ends {
            positions[moved] = positions[kept];
        }
    }
    edge_edge(in_units(ends, 1.0))
}

/// Points anywhere.
fn free(rng: &mut dyn Rng) -> Motion<i32> {
    let reach = rng.random_range(1..=3);
    [(); 2].map(|()| [(); 4].map(|()| vector(rng, reach)))
}
