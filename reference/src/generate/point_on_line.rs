//! An end of one edge that is on the line of the other for the whole step.
//!
//! Probes coplanar motion with a permanent point on a line (thesis figures 4.10 and 4.11): its
//! distance to the line is identically 0 and says nothing of when it reaches the edge. A, C and D
//! keep to a line, as of `near_collinear`; of three queries B
//!
//! - keeps to a line of the same direction beside it, or wanders off it, in one;
//! - swings through the line, in one, so that the edges are parallel at one time (figure 4.11);
//! - does either, and all is nudged by 0 to `2^20` ulp, in one.
//!
//! Then the edges and their ends are renamed.

use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::confine::{Reach, confined, swing};
use super::motion::{Motion, metres, renamed, vector};
use super::nudge::nudged_if;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "point_on_line",
    description: "an end of one edge on the other's line for the whole step or nearly so",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = exact(rng);
    let motion = metres(rng, motion);
    let motion = renamed(rng, motion);
    edge_edge(nudged_if(rng.random_range(0..3) == 0, rng, motion))
}

/// A motion with A on the line of CD.
fn exact(rng: &mut dyn Rng) -> Motion<i32> {
    let reach = Reach::wide(rng);
    let mut motion = confined::<1>(rng, [0; 4], &reach);
    if rng.random() {
        swing(rng, &mut motion, &[1], reach.directions);
    } else {
        for points in &mut motion {
            points[1] += vector(rng, reach.directions);
        }
    }
    motion
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    #[test]
    fn point_on_line_has_a_on_the_line_of_cd_throughout() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut off = 0;
        for _ in 0..2000 {
            let [start, end] = exact(&mut rng).map(|points| points.map(|p| p.map(i64::from)));
            // Squares of t: three times decide.
            for s in [0, 1, 2] {
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| start[i] * (2 - s) + end[i] * s);
                assert_eq!((c - a).cross(&(d - a)), Vector3::zeros());
                off += u32::from((c - b).cross(&(d - b)) != Vector3::zeros());
            }
        }
        assert!(off > 3000, "B is off the line at {off} of 6000 times");
    }
}
