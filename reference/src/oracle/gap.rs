//! The gap: how much farther than their radius the two sides are from each other during a step, at
//! least.
//!
//! Whether they come within `R + x` is decided exactly ([`super::proximity`]); the least `x`
//! follows by bisection, from a guess in floating point, which can cost time only.

use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::answer::Enclosure;
use crate::distance::{Moving, estimate_gap};
use crate::field::{self, Integer};
use crate::scaled::Scaled;

use super::proximity::Proximity;
use super::{motion_of, rigid};

/// A query of two sides whose distance is measured: a [`Query`] or a [`RigidQuery`].
pub trait Measured: Moving + private::Exact {}

impl Measured for Query {}

impl Measured for RigidQuery {}

mod private {
    use super::*;

    pub trait Exact {
        /// The distance of the two sides, exactly.
        #[allow(private_interfaces, reason = "nobody outside can call it")]
        fn proximity<Z: Integer>(&self) -> Proximity<Z>;
    }

    impl Exact for Query {
        #[allow(private_interfaces, reason = "nobody outside can call it")]
        fn proximity<Z: Integer>(&self) -> Proximity<Z> {
            let points = Scaled::new(self);
            let motion = motion_of(self, &points);
            Proximity::new(&*motion, points.exponent)
        }
    }

    impl Exact for RigidQuery {
        #[allow(private_interfaces, reason = "nobody outside can call it")]
        fn proximity<Z: Integer>(&self) -> Proximity<Z> {
            rigid::proximity(self)
        }
    }
}

/// Whether the two sides come within `distance` metres more than the radius of the query of each
/// other during the step, exactly; `distance` is finite and not negative.
pub fn comes_within(query: &impl Measured, distance: f64) -> bool {
    Gap::<field::Default>::new(query).is_within(distance)
}

/// The gap in metres, between two `f64` that differ by less than one part in a thousand (or are
/// neighbours).
pub fn least_gap(query: &impl Measured) -> Enclosure {
    enclose_gap(query, |below, above| above <= below * 1.001)
}

/// The gap in metres, between two `f64` that are at most `width` apart (or are neighbours).
pub fn least_gap_to(query: &impl Measured, width: f64) -> Enclosure {
    enclose_gap(query, |below, above| above - below <= width)
}

/// The gap between two `f64` that are neighbours or near enough to each other. Infinite above if it
/// is beyond the largest `f64`.
fn enclose_gap(query: &impl Measured, is_near_enough: impl Fn(f64, f64) -> bool) -> Enclosure {
    let gap = Gap::<field::Default>::new(query);
    if gap.is_within(0.0) {
        return Enclosure::exactly(0.0);
    }
    // The bits of an f64 above 0 are in the order of the values.
    let (mut below, mut above) = (0, f64::INFINITY.to_bits());
    let guess = estimate_gap(query);
    let mut cuts = [1e-15, 1e-12, 4e-4]
        .into_iter()
        .flat_map(|off| [guess * (1.0 - off), guess * (1.0 + off)]);
    let is_done = |below, above| is_near_enough(f64::from_bits(below), f64::from_bits(above));
    while above - below > 1 && !is_done(below, above) {
        let mut guessed = cuts.by_ref().map(f64::to_bits);
        let guessed = guessed.find(|cut| (below + 1..above).contains(cut));
        let cut = guessed.unwrap_or(below + (above - below) / 2);
        if gap.is_within(f64::from_bits(cut)) {
            above = cut
        } else {
            below = cut
        }
    }
    Enclosure {
        below: f64::from_bits(below),
        above: f64::from_bits(above),
    }
}

/// The distance of a query, and its radius.
struct Gap<Z> {
    proximity: Proximity<Z>,
    radius: [f64; 2],
}

impl<Z: Integer> Gap<Z> {
    fn new(query: &impl Measured) -> Self {
        Gap {
            proximity: query.proximity(),
            radius: Moving::radius(query).parts(),
        }
    }

    fn is_within(&self, more: f64) -> bool {
        let [first, second] = self.radius;
        self.proximity.is_within(&[first, second, more])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tunnelproof::query::{Point, QueryKind, Radius};

    use super::*;
    use crate::difference;
    use crate::generate::rigid_by_name;
    use crate::oracle::{decide, decide_rigid_query};

    fn query(kind: QueryKind, points: [[f64; 3]; 8], radius: impl Into<Radius>) -> Query {
        let p = points.map(|[x, y, z]| Point::new(x, y, z));
        let (start, end) = ([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]]);
        Query::new(kind, start, end, radius).unwrap()
    }

    fn assert_near(gap: Enclosure, value: f64) {
        assert!(
            gap.below < value && value <= gap.above,
            "{gap} instead of {value}"
        );
        assert!(gap.above <= gap.below * 1.001);
    }

    #[test]
    fn least_gap_of_edges_known_values() {
        let still = [[-1., 0., 0.], [1., 0., 0.]];
        let pass = |c: [f64; 3], d: [f64; 3], e: [f64; 3], f: [f64; 3]| {
            let points = [still[0], still[1], c, d, still[0], still[1], e, f];
            least_gap(&query(QueryKind::EdgeEdge, points, 0.0))
        };
        // Line above line, sideways past the end, parallel, and a point.
        assert_near(
            pass([0., -1., 3.], [0., 1., 3.], [0., -1., 0.25], [0., 1., 0.25]),
            0.25,
        );
        assert_near(
            pass(
                [1.5, -1., 3.],
                [1.5, 1., 3.],
                [1.5, -1., -3.],
                [1.5, 1., -3.],
            ),
            0.5,
        );
        assert_near(
            pass([0., 0., 3.], [9., 0., 3.], [0., 0., 1e-9], [9., 0., 1e-9]),
            1e-9,
        );
        assert_near(
            pass([4., 4., 0.], [4., 4., 0.], [4., 4., 0.], [4., 4., 0.]),
            5.0,
        );
        // Nearest in the middle of the step only.
        assert_near(
            pass([2., 5., 0.], [2., 6., 0.], [2., -6., 0.], [2., -5., 0.]),
            1.0,
        );
        let crossing = pass([0., -1., 1.], [0., 1., 1.], [0., -1., -1.], [0., 1., -1.]);
        assert_eq!(crossing, Enclosure::exactly(0.0));
    }

    #[test]
    fn least_gap_of_a_face_known_values_beyond_the_radius() {
        let face = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.]];
        let pass = |from: [f64; 3], to: [f64; 3], radius: [f64; 2]| {
            let points = [
                from, face[0], face[1], face[2], to, face[0], face[1], face[2],
            ];
            query(QueryKind::VertexFace, points, radius)
        };
        // Above the face, past an edge, past a corner.
        let above = pass([1., 1., 3.], [1., 2., 2.], [0.0, 0.0]);
        assert_near(least_gap(&above), 2.0);
        let thick = pass([1., 1., 3.], [1., 2., 2.], [0.5, 1.0]);
        assert_near(least_gap(&thick), 0.5);
        let beside = pass([5., 5., 1.], [5., 5., -1.], [0.0, 1.0]);
        assert_near(least_gap(&beside), 18f64.sqrt() - 1.0);
        let corner = pass([-3., -4., 1.], [-3., -4., -1.], [5.0, 0.0]);
        assert_eq!(least_gap(&corner), Enclosure::exactly(0.0));
        // The radius is a little below 5, by less than an f64 near 5 can be.
        let missed = pass(
            [-3., -4., 1.],
            [-3., -4., -1.],
            [5f64.next_down(), 2f64.powi(-60)],
        );
        let gap = least_gap_to(&missed, 0.0);
        let exact = 5.0 - 5f64.next_down() - 2f64.powi(-60);
        assert!(gap.below <= exact && exact <= gap.above && gap.above <= gap.below.next_up());
    }

    #[test]
    fn least_gap_to_a_width_is_that_narrow() {
        let points = [
            [0., 0., 1.],
            [1., 0., 1.],
            [0., 3., 0.],
            [1., 4., 0.],
            [0., 0., 1.],
            [1., 1., 1.],
            [0., 3., 0.],
            [1., 4., 0.],
        ];
        let query = query(QueryKind::EdgeEdge, points, 0.0);
        for width in [1.0, 1e-3, 1e-9, 1e-15, 0.0] {
            let gap = least_gap_to(&query, width);
            assert!(gap.above - gap.below <= width || gap.above == gap.below.next_up());
            assert!(!comes_within(&query, gap.below) && comes_within(&query, gap.above));
        }
    }

    /// By the second judge, which shares nothing with the first: the gap is the radius at which a
    /// miss becomes a hit.
    #[test]
    fn least_gap_of_bodies_that_turn_is_where_the_second_judge_hits() {
        for name in [
            "turning_uniform",
            "turning_lattice",
            "turning_bodies_uniform",
        ] {
            let family = rigid_by_name(name).unwrap();
            let (mut misses, mut wide) = (0, 0);
            for query in (0..60).map(|index| family.query(5, index)) {
                let gap = least_gap(&query);
                let hits = |radius: f64| {
                    let query = RigidQuery::new(query.sides(), radius).unwrap();
                    difference::decide_rigid::<field::Default>(&query)
                        .hit
                        .is_some()
                };
                if hits(0.0) {
                    assert_eq!(gap, Enclosure::exactly(0.0), "{query:?}");
                    continue;
                }
                misses += 1;
                wide += u32::from(gap.below > 0.1);
                assert!(!hits(gap.below) && hits(gap.above), "{gap} {query:?}");
                assert!(gap.above <= gap.below * 1.001);
            }
            assert!(misses > 15 && wide > 3, "{name}: {misses} {wide}");
        }
    }

    #[test]
    fn least_gap_of_bodies_that_do_not_turn_is_that_of_lines() {
        for name in ["turning_translation", "turning_thick_still"] {
            let family = rigid_by_name(name).unwrap();
            for query in (0..100).map(|index| family.query(6, index)) {
                let [start, end] = [0.0, 1.0].map(|t| query.positions(t));
                let linear = Query::new(query.shape(), start, end, query.radius()).unwrap();
                let gaps = [least_gap_to(&query, 1e-12), least_gap_to(&linear, 1e-12)];
                let [low, high] = [
                    gaps[0].below.max(gaps[1].below),
                    gaps[0].above.min(gaps[1].above),
                ];
                assert!(low <= high, "{gaps:?} {query:?}");
                for width in [0.0, 1e-3, 0.5] {
                    assert_eq!(comes_within(&query, width), comes_within(&linear, width));
                }
            }
        }
    }

    #[test]
    fn bodies_that_turn_come_within_nothing_where_they_touch() {
        for name in ["turning_thick_lattice", "turning_bodies_thick_lattice"] {
            let family = rigid_by_name(name).unwrap();
            for query in (0..200).map(|index| family.query(7, index)) {
                let hit = decide_rigid_query(&query).hit.is_some();
                assert_eq!(comes_within(&query, 0.0), hit, "{query:?}");
            }
        }
    }

    fn kind() -> impl Strategy<Value = QueryKind> {
        prop::sample::select(vec![QueryKind::EdgeEdge, QueryKind::VertexFace])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]

        #[test]
        fn comes_within_zero_is_a_hit(
            points in prop::array::uniform8(prop::array::uniform3(-2i8..=2)),
            kind in kind(),
            radius in 0u8..3,
        ) {
            let query = query(kind, points.map(|p| p.map(f64::from)), f64::from(radius));
            let hit = decide::<field::Default>(&query).toi().is_some();
            prop_assert_eq!(comes_within(&query, 0.0), hit);
        }

        #[test]
        fn least_gap_is_not_above_any_sampled_distance(
            points in prop::array::uniform8(prop::array::uniform3(-4i8..=4)),
            kind in kind(),
        ) {
            let query = query(kind, points.map(|p| p.map(f64::from)), 0.0);
            let gap = least_gap(&query);
            let at = |t: f64, i: usize| {
                query.start()[i].coords * (1.0 - t) + query.end()[i].coords * t
            };
            let mut sampled = f64::MAX;
            for i in 0..=64 {
                let t = f64::from(i) / 64.0;
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| at(t, i));
                for j in 0..=16 {
                    for k in 0..=16 {
                        let (u, v) = (f64::from(j) / 16.0, f64::from(k) / 16.0);
                        let way = match kind {
                            QueryKind::EdgeEdge => a + (b - a) * u - c - (d - c) * v,
                            QueryKind::VertexFace if j + k > 16 => continue,
                            QueryKind::VertexFace => a - b - (c - b) * u - (d - b) * v,
                        };
                        sampled = sampled.min(way.norm());
                    }
                }
            }
            prop_assert!(gap.below <= sampled * (1.0 + 1e-9), "{} {}", gap, sampled);
            // Half a step of the grid moves the points by at most 14 (1/64 + 1/16).
            prop_assert!(gap.above >= sampled - 1.1, "{} {}", gap, sampled);
        }
    }
}
