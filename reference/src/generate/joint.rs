//! Two consecutive segments of one wire, and another segment that passes through the wire at their
//! common node or beside it.
//!
//! Probes what no single query shows: if both segments miss at the node, neither miss looks bad,
//! for each may be that of a graze, and the wire has tunnelled all the same. Queries `2 i` and
//! `2 i + 1` are the segments `P0 P1` and `P1 P2` of one wire against the same segment CD. Of 4
//! wires CD passes exactly through the node in 1, 0 to `2^20` ulp beside it in 2, and farther
//! beside it in 1.
//!
//! **The wire is passed.** Let `P1` be the origin. Before it is placed, the wire is for the whole
//! step the graph of a function of `x` on an interval that holds the `x` of C and of D; C is above
//! it in `y`, D below. So, seen along `z`, CD crosses the wire, an odd number of times, and no end
//! of one comes upon the other. Unless they touch, the parity of the crossings at which CD is in
//! front stays the same. At the start CD is in front of the whole wire, at the end behind it: they
//! touch. All these are strict inequalities with room for the nudge, and hold at both ends of the
//! step, hence throughout.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::motion::{Motion, metres, placed, power_of_two, vector};
use super::nudge::nudged;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "joint",
    description: "both segments at a node of a wire, which another segment passes through there",
    draw: Draw::Wire(draw),
};

fn draw(rng: &mut dyn Rng) -> [Query; 2] {
    let reach = power_of_two(rng, 2..=8);
    let kind = rng.random_range(0..4);
    let beside = match kind {
        0 => rng.random_range(-reach..=reach),
        _ => 0,
    };
    let motion = wire(rng, reach, beside);
    let motion = placed(rng, motion);
    let motion = metres(rng, motion);
    let motion = match kind {
        0..2 => motion,
        _ => nudged(rng, motion),
    };
    [0, 1].map(|i| edge_edge(motion.map(|points| [points[i], points[i + 1], points[3], points[4]])))
}

/// `P0`, `P1`, `P2`, `C` and `D`; CD passes `beside` the node at one time.
fn wire(rng: &mut dyn Rng, reach: i32, beside: i32) -> Motion<i32, 5> {
    let times = [(); 2].map(|()| rng.random_range(1..=4));
    // Where C and D are as CD passes, on a line through the node, and how they move.
    let mut along = vector(rng, reach);
    along.y = rng.random_range(4 * reach..=8 * reach);
    let place = rng.random_range(1..=7);
    let [c, d] = [along * place, along * (place - 8)];
    let steps = [(); 2].map(|()| {
        let mut step = vector(rng, reach / 4);
        step.z = -rng.random_range(9 * reach..=12 * reach);
        step
    });
    [-times[0], times[1]].map(|s| {
        let shift = Vector3::x() * beside;
        let mut node = |side: i32| {
            let mut node = vector(rng, reach);
            node.x = side * rng.random_range(10 * reach..=16 * reach);
            node
        };
        [
            node(-1),
            Vector3::zeros(),
            node(1),
            c + shift + steps[0] * s,
            d + shift + steps[1] * s,
        ]
    })
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::oracle::decide_query;

    #[test]
    fn joint_wire_is_a_graph_that_the_segment_starts_before_and_ends_behind() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            let reach = power_of_two(&mut rng, 2..=8);
            let beside = rng.random_range(-reach..=reach);
            let motion = wire(&mut rng, reach, beside);
            for (points, before) in motion.iter().zip([1, -1]) {
                let [p0, p1, p2, c, d] = points;
                let wire = [p0, p1, p2];
                assert_eq!(*p1, Vector3::zeros());
                for end in [c, d] {
                    assert!(p0.x < end.x && end.x < p2.x && p0.x < 0 && p2.x > 0);
                    assert!(wire.iter().all(|node| before * (end.z - node.z) > 0));
                }
                assert!(wire.iter().all(|node| d.y < node.y && node.y < c.y));
            }
        }
    }

    #[test]
    fn joint_segment_meets_both_at_once_or_one_of_them_at_least() {
        let [mut both, mut one] = [0; 2];
        for index in 0..1000 {
            let members = [0, 1].map(|i| FAMILY.query(1, 2 * index + i));
            let [first, second] = members;
            assert_eq!(
                (first.start()[1], first.end()[1]),
                (second.start()[0], second.end()[0])
            );
            assert_eq!(first.start()[2..], second.start()[2..]);
            assert_eq!(first.end()[2..], second.end()[2..]);
            let hits = members.map(|query| decide_query(&query).hit);
            match hits {
                [Some(a), Some(b)] if a.toi == b.toi => both += 1,
                hits => {
                    assert!(hits.iter().any(|hit| hit.is_some()));
                    one += 1;
                }
            }
        }
        assert!(both > 200 && one > 200, "{both} and {one}");
    }
}
