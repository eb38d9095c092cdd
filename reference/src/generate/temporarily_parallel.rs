//! Edges that are parallel at exactly one time of the step.
//!
//! Probes contact at roots of the cubic at which the lines of the edges have no single common point
//! (thesis figure 4.2). Of 8 queries the time is inside the step in 4, at its start in 2, at its
//! end in 2; of 4 queries the lines of the edges are one line at that time in 3, where the edges
//! overlap or not. One query in three is nudged by 0 to `2^20` ulp.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::meeting::{Meeting, end_of_step};
use super::motion::{not_zero, power_of_two};
use super::nudge::nudged_if;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "temporarily_parallel",
    description: "edges parallel at exactly one time, also 0 and 1, or nearly so",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = exact(rng).anywhere(rng);
    edge_edge(nudged_if(rng.random_range(0..3) == 0, rng, motion))
}

/// Edges that are parallel at the time of the meeting alone: the direction and both velocities are
/// linearly independent.
pub(super) fn exact(rng: &mut dyn Rng) -> Meeting {
    let reach = power_of_two(rng, 2..=8);
    let mut meeting = Meeting::new(rng, reach, reach / 4);
    if rng.random() {
        meeting.times = end_of_step(rng);
    }
    meeting.edges = [(); 2].map(|()| Vector3::x() * not_zero(rng, reach));
    let [a, b] = &mut meeting.turns;
    (a.y, a.z, b.z) = (not_zero(rng, reach / 4), 0, not_zero(rng, reach / 4));
    if rng.random_range(0..4) == 0 {
        meeting.aside.y = not_zero(rng, reach);
    }
    meeting
}
