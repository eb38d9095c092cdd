//! An edge of a kilometre against one of a millimetre that moves by a millimetre.
//!
//! Probes quantities that differ by six orders of magnitude within one query, and thresholds
//! without regard to length: the long edge's parameter changes by a millionth during the step. Of 4
//! queries in 1 the short edge is nearly parallel to the long one, to `2^-30` at the least. Then
//! the edges and their ends are renamed.

use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::crossing::{crossing, moving};
use super::motion::{real_vector, renamed};
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "long_thin",
    description: "1 km edges against 1 mm ones and 1 mm motion",
    draw: Draw::Query(draw),
};

const LONG: f64 = 1e3;
const SHORT: f64 = 1e-3;

fn draw(rng: &mut dyn Rng) -> Query {
    let long = real_vector(rng, LONG);
    let short = match rng.random_range(0..4) {
        0 => {
            let angle = 2f64.powi(rng.random_range(-30..=0));
            long * (SHORT / LONG) + real_vector(rng, SHORT * angle)
        }
        _ => real_vector(rng, SHORT),
    };
    let positions = crossing(rng, [long, short]);
    let motion = moving(rng, positions, SHORT);
    edge_edge(renamed(rng, motion))
}
