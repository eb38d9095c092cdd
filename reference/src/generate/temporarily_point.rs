//! An edge that is a point at one time of the step.
//!
//! Probes contact at roots of the cubic at which an edge has no direction (thesis figure 4.3), and
//! edges of length 0 at an end of the step, which adaptive resolution makes when it puts a node
//! into a wire or takes one out. Of 8 queries the time is inside the step in 4, at its start in 2,
//! at its end in 2; of 8 queries the other edge is a point at the same time in 1. In one of 4 the
//! point is not on the line of the other edge. One query in three is nudged by 0 to `2^20` ulp.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::meeting::{Meeting, end_of_step};
use super::motion::{not_zero, power_of_two};
use super::nudge::nudged_if;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "temporarily_point",
    description: "an edge that is a point at exactly one time, also 0 and 1, or nearly so",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = exact(rng).anywhere(rng);
    edge_edge(nudged_if(rng.random_range(0..3) == 0, rng, motion))
}

/// Edges of which AB is a point at the time of the meeting alone.
pub(super) fn exact(rng: &mut dyn Rng) -> Meeting {
    let reach = power_of_two(rng, 2..=8);
    let mut meeting = Meeting::new(rng, reach, reach / 4);
    if rng.random() {
        meeting.times = end_of_step(rng);
    }
    meeting.edges[0] = Vector3::zeros();
    meeting.turns[0].x = not_zero(rng, reach / 4);
    if rng.random_range(0..8) == 0 {
        meeting.edges[1] = Vector3::zeros();
    }
    if rng.random_range(0..4) == 0 {
        meeting.aside.y = not_zero(rng, reach);
    }
    meeting
}
