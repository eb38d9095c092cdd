//! Motion a few ulp off a permanently parallel one.
//!
//! Probes the decision between the parallel and the general case, and the place of contact between
//! edges that are nearly parallel. A query is made in three steps:
//!
//! 1. A collinear motion in integers, as of `near_collinear`.
//! 2. CD swings aside, from one side of AB's line to the other, so that the lines are one line at
//!    one time; there the edges overlap or not.
//! 3. In metres, one coordinate, one point or all of it is nudged by 0 to `2^20` ulp.

use rand::Rng;
use tunnelproof::query::Query;

use super::confine::{Reach, confined, swing};
use super::motion::metres;
use super::nudge::nudged;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "near_parallel",
    description: "0 to 2^20 ulp off a permanently parallel motion",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let reach = Reach::wide(rng);
    let mut motion = confined::<1>(rng, [0; 4], &reach);
    swing(rng, &mut motion, &[2, 3], reach.directions);
    let motion = metres(rng, motion);
    edge_edge(nudged(rng, motion))
}
