//! Motion a few ulp off a permanently coplanar one.
//!
//! Probes the decision between the coplanar and the general case, and a general case with a cubic
//! of rounding errors. A query is made in two steps:
//!
//! 1. A coplanar motion in integers of up to 18 bits: of two queries one moves the points freely
//!    within a plane of fixed direction, the other carries them along with a plane that turns,
//!    stretches or collapses.
//! 2. In metres, one coordinate, one point or all of it is nudged by 0 to `2^20` ulp.

use rand::Rng;
use tunnelproof::query::Query;

use super::confine::{Reach, confined};
use super::motion::metres;
use super::nudge::nudged;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "near_coplanar",
    description: "0 to 2^20 ulp off a permanently coplanar motion",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let reach = Reach::wide(rng);
    let motion = confined::<2>(rng, [0; 4], &reach);
    let motion = metres(rng, motion);
    edge_edge(nudged(rng, motion))
}
