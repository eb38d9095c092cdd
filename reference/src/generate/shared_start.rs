//! Edges that start in the same point, as consecutive segments of a wire do.
//!
//! Probes case 2, which is decided by the distance of A and C, and contact at the very ends of
//! edges. Half of the motions are free in space with all bits, the others coplanar in integers. Of
//! 8 queries
//!
//! - 2 have A = C for the whole step, exactly;
//! - 1 has another pair of ends in one place for the whole step;
//! - 1 has A = C at one end of the step, and them apart at the other;
//! - 4 have A = C but for a nudge of C by 0 to `2^20` ulp along each axis.

use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::confine::{Reach, confined};
use super::motion::{metres, real_vector, renamed};
use super::nudge::{off_by, ulps};
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "shared_start",
    description: "A = C for the whole step or nearly so",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let apart = if rng.random() {
        [(); 2].map(|()| [(); 4].map(|()| real_vector(rng, 1.0)))
    } else {
        let reach = Reach::wide(rng);
        let motion = confined::<2>(rng, [0; 4], &reach);
        metres(rng, motion)
    };
    let joined = apart.map(|[a, b, _, d]| [a, b, a, d]);
    edge_edge(match rng.random_range(0..8) {
        0..2 => joined,
        2 => renamed(rng, joined),
        3 if rng.random() => [joined[0], apart[1]],
        3 => [apart[0], joined[1]],
        _ => off_by(
            joined,
            |[_, point, _]| if point == 2 { ulps(rng) } else { 0 },
        ),
    })
}
