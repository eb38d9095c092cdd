//! Motion of a few ulp.
//!
//! Probes the smallest motions that numbers can hold: velocities of one or two bits, and a contact
//! between positions that are neighbours in `f64`. Edges of about a metre start where they touch up
//! to rounding, from 0 to some metres off the origin, and each coordinate changes by up to 4 ulp,
//! or each of one point alone.

use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::crossing::crossing;
use super::motion::real_vector;
use super::nudge::off_by;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "slow",
    description: "edges that nearly touch and move by a few ulp",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let edges = [(); 2].map(|()| real_vector(rng, 1.0));
    let reach = [1e-3, 1.0, 8.0][rng.random_range(0..3)];
    let origin = real_vector(rng, reach);
    let start = crossing(rng, edges).map(|point| point + origin);
    let moved = rng.random_range(0..8);
    let is_moved = |point: usize| moved >= 4 || point == moved;
    let [start, end] = off_by([start; 2], |[end, point, _]| {
        let ulps = if end == 1 && is_moved(point) { 4 } else { 0 };
        rng.random_range(-ulps..=ulps)
    });
    edge_edge([start, end])
}
