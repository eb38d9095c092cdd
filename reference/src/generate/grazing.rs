//! Contact without crossing, where rounding decides between hit and miss.
//!
//! Probes double roots of the cubic and the ends of the intervals of time and of edge parameters.
//! Of 3 queries
//!
//! - in 1 the edges touch inside both and move apart again to the same side: a double root;
//! - in 1 an end of one edge touches the other edge, or an end of it;
//! - in 1 they touch at `t = 0` or at `t = 1`.
//!
//! Of 3 queries one is exact and two are nudged by 0 to `2^20` ulp.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::meeting::{Meeting, end_of_step};
use super::motion::not_zero;
use super::nudge::nudged_if;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "grazing",
    description: "double roots, contact at ends of edges and of the step, exactly or nearly",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = exact(rng).anywhere(rng);
    edge_edge(nudged_if(rng.random_range(0..3) != 0, rng, motion))
}

/// Edges that graze each other at the time of the meeting.
pub(super) fn exact(rng: &mut dyn Rng) -> Meeting {
    match rng.random_range(0..3) {
        0 => double_root(rng),
        1 => end_of_edge(rng),
        _ => Meeting {
            times: end_of_step(rng),
            places: [(); 2].map(|()| rng.random_range(0..=8)),
            ..Meeting::steady(rng)
        },
    }
}

/// `det(p, q, w) = 0`: where they touch, they slide within the plane that both span.
fn double_root(rng: &mut dyn Rng) -> Meeting {
    let mut meeting = Meeting::steady(rng);
    let [p, q] = &mut meeting.edges;
    *p = Vector3::new(not_zero(rng, Meeting::REACH), p.y, 0);
    *q = Vector3::new(0, not_zero(rng, Meeting::REACH), 0);
    let w = &mut meeting.passing;
    *w = Vector3::new(not_zero(rng, Meeting::REACH / 16), w.y, 0);
    let [a, b] = &mut meeting.turns;
    a.z = not_zero(rng, Meeting::REACH / 16);
    // This is 0 for a triple root.
    if w.x * q.y * a.z + (w.y * p.x - w.x * p.y) * b.z == 0 {
        b.z = 0;
    }
    meeting.places = [(); 2].map(|()| rng.random_range(1..=7));
    meeting
}

/// An end of AB on CD, end or not.
fn end_of_edge(rng: &mut dyn Rng) -> Meeting {
    Meeting {
        places: [8 * rng.random_range(0..=1), rng.random_range(0..=8)],
        ..Meeting::steady(rng)
    }
}
