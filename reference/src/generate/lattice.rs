//! Motion on a lattice: every coordinate is a small integer, so that every degeneracy is met exactly
//! and often, together with others.
//!
//! Probes the classification, and contact at ends of edges, at ends of the step and at times of
//! parallel or vanishing edges. A query is made in two steps:
//!
//! 1. The motion is confined. Of 16 queries, 6 are free in space (coordinates up to 1, 2 or 3), 4 keep
//!    the four points in a plane, 3 on a line, and 3 keep the edges parallel on a line each. Plane and
//!    lines move; of two such queries one moves the points freely within a confinement of fixed
//!    direction, the other carries them along with one that turns, stretches or collapses.
//! 2. Points are merged for the whole step: of 16 queries, in 1 A and B, in 1 C and D, in 2 A and C.
//!
//! Each of the six cases is met by more than a tenth of the queries; coordinates are at most 5.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::{Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "lattice",
    description: "every degeneracy exactly: coordinates are small integers, motion often confined",
    draw,
};

/// The positions of A, B, C and D at one end of the step.
type Positions = [Vector3<i32>; 4];

fn draw(rng: &mut dyn Rng) -> Query {
    let mut ends = match rng.random_range(0..16) {
        0..6 => free(rng),
        6..10 => confined::<2>(rng, [0, 0, 0, 0]),
        10..13 => confined::<1>(rng, [0, 0, 0, 0]),
        _ => confined::<1>(rng, [0, 0, 1, 1]),
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
    let [start, end] = ends.map(|positions| positions.map(|position| position.map(f64::from)));
    edge_edge(start, end)
}

/// Points anywhere.
fn free(rng: &mut dyn Rng) -> [Positions; 2] {
    let reach = rng.random_range(1..=3);
    [(); 2].map(|()| [(); 4].map(|()| vector(rng, reach)))
}

/// Each point `X = O + sum of k P` over the `DIMENSION` directions `P`, which all points share, and
/// with the origin `O` of the number that `origins` gives for the point.
///
/// Either the directions keep still and the coefficients `k` differ between the ends of the step, or
/// the other way round.
fn confined<const DIMENSION: usize>(rng: &mut dyn Rng, origins: [usize; 4]) -> [Positions; 2] {
    let is_carried = rng.random();
    let directions = ends(rng, is_carried, |rng| {
        [(); DIMENSION].map(|()| vector(rng, 1))
    });
    let coefficients = ends(rng, !is_carried, |rng| {
        [(); 4].map(|()| [(); DIMENSION].map(|()| rng.random_range(-2..=2)))
    });
    [0, 1].map(|end| {
        let origin = [vector(rng, 1), vector(rng, 1)];
        [0, 1, 2, 3].map(|point| {
            let terms = directions[end].iter().zip(coefficients[end][point]);
            terms.fold(origin[origins[point]], |sum, (p, k)| sum + p * k)
        })
    })
}

/// What is drawn for the start and the end of the step: twice if it changes, else once for both.
fn ends<T: Copy>(rng: &mut dyn Rng, changes: bool, draw: impl Fn(&mut dyn Rng) -> T) -> [T; 2] {
    let start = draw(rng);
    [start, if changes { draw(rng) } else { start }]
}

fn vector(rng: &mut dyn Rng, reach: i32) -> Vector3<i32> {
    Vector3::from_fn(|_, _| rng.random_range(-reach..=reach))
}
