//! Motion built from what it is at one time, exactly.

use nalgebra::Vector3;
use rand::{Rng, RngExt};

use super::motion::{Motion, metres, placed, renamed, vector};

/// Two edges at a time of the step and how they move there, in integers.
///
/// They meet at that time, if `places` are on the edges and `aside` is 0: with `s` the time since
/// then, `K = 8 (p + s a)`, `L = 8 (q + s b)`, and the point `i` eighths along AB is off the one
/// `j` eighths along CD by `aside + s w`. Then
///
/// ```text
/// f / 64 = s det(p + s a, q + s b, w)    if aside is 0,
/// ```
///
/// which families give the roots that they probe.
#[derive(Clone, Debug)]
pub(super) struct Meeting {
    /// How much of the step is before that time and how much after it: the time is
    /// `before / (before + after)`.
    pub(super) times: [i32; 2],
    /// `p` and `q`, an eighth of each edge.
    pub(super) edges: [Vector3<i32>; 2],
    /// `a` and `b`, the velocities of `p` and `q`.
    pub(super) turns: [Vector3<i32>; 2],
    /// `i` and `j`.
    pub(super) places: [i32; 2],
    /// `w`, the velocity of the point on CD relative to that on AB.
    pub(super) passing: Vector3<i32>,
    /// How far the point on CD is from that on AB.
    pub(super) aside: Vector3<i32>,
}

impl Meeting {
    /// Edges that cross inside the step, in general motion, if their `places` are on the edges.
    /// Coordinates of edges are at most `reach`, those of velocities `speed`.
    pub(super) fn new(rng: &mut dyn Rng, reach: i32, speed: i32) -> Self {
        Meeting {
            times: inside_step(rng),
            edges: [(); 2].map(|()| vector(rng, reach)),
            turns: [(); 2].map(|()| vector(rng, speed)),
            places: [(); 2].map(|()| rng.random_range(-1..=9)),
            passing: vector(rng, speed),
            aside: Vector3::zeros(),
        }
    }

    /// The largest coordinate of a [`steady`](Self::steady) meeting.
    pub(super) const REACH: i32 = 256;

    /// The same with a motion of about the length of the edges, so that they seldom meet twice.
    pub(super) fn steady(rng: &mut dyn Rng) -> Self {
        Self::new(rng, Self::REACH, Self::REACH / 16)
    }

    /// The points, A at rest.
    pub(super) fn motion(&self) -> Motion<i32> {
        let ([p, q], [a, b], [i, j]) = (self.edges, self.turns, self.places);
        let [before, after] = self.times;
        [-before, after].map(|s| {
            let [k, l] = [p + a * s, q + b * s];
            let c = k * i - l * j + self.aside + self.passing * s;
            [Vector3::zeros(), k * 8, c, c + l * 8]
        })
    }

    /// The motion in metres, seen from anywhere.
    pub(super) fn anywhere(&self, rng: &mut dyn Rng) -> Motion<f64> {
        let motion = placed(rng, self.motion());
        let motion = metres(rng, motion);
        renamed(rng, motion)
    }
}

/// [`times`](Meeting::times) inside the step.
pub(super) fn inside_step(rng: &mut dyn Rng) -> [i32; 2] {
    [(); 2].map(|()| rng.random_range(1..=8))
}

/// [`times`](Meeting::times) at the start or at the end of the step.
pub(super) fn end_of_step(rng: &mut dyn Rng) -> [i32; 2] {
    let all = rng.random_range(1..=8);
    if rng.random() { [0, all] } else { [all, 0] }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use tunnelproof::contact::{Case, ContactKind};

    use super::super::{edge_edge, grazing, temporarily_parallel, temporarily_point, triple_root};
    use super::*;
    use crate::answer::{Enclosure, ExactAnswer, ExactHit};
    use crate::oracle::decide_query;

    const COUNT: u64 = 4000;

    /// Meetings and the exact answers to them, in metres and seen from anywhere.
    fn answers(exact: fn(&mut dyn Rng) -> Meeting) -> impl Iterator<Item = (Meeting, ExactAnswer)> {
        (0..COUNT).map(move |stream| {
            let mut rng = ChaCha8Rng::seed_from_u64(1);
            rng.set_stream(stream);
            let meeting = exact(&mut rng);
            let query = edge_edge(meeting.anywhere(&mut rng));
            (meeting, decide_query(&query))
        })
    }

    fn encloses(enclosure: Enclosure, [numerator, denominator]: [i32; 2]) -> bool {
        let exact = BigRational::new(numerator.into(), denominator.into());
        let [below, above] =
            [enclosure.below, enclosure.above].map(|x| BigRational::from_float(x).unwrap());
        below <= exact && exact <= above && enclosure.above <= enclosure.below.next_up()
    }

    impl Meeting {
        fn is_time_of(&self, hit: &ExactHit) -> bool {
            let [before, after] = self.times;
            encloses(hit.toi, [before, before + after])
        }

        fn is_later_than(&self, hit: &ExactHit) -> bool {
            let [before, after] = self.times.map(f64::from);
            hit.toi.below < before / (before + after)
        }

        /// `f` at this time since the meeting.
        fn f(&self, since: i32) -> i128 {
            let times = [0, since];
            let [_, [a, b, c, d]] = Meeting {
                times,
                ..self.clone()
            }
            .motion();
            let [k, l, m] = [b - a, d - c, c - a].map(|v| v.map(i128::from));
            k.cross(&l).dot(&m)
        }

        /// The coefficients of `f`, which is 0 at the meeting, times 12: of `s`, `s^2` and `s^3`.
        fn coefficients(&self) -> [i128; 3] {
            let [odd, even] = [-1, 1].map(|sign| [1, 2].map(|s| self.f(s) + sign * self.f(-s)));
            assert_eq!(self.f(0), 0);
            let [linear, cubic] = [8 * odd[0] - odd[1], odd[1] - 2 * odd[0]];
            [linear, 6 * even[0], cubic]
        }

        fn det(&self) -> i64 {
            let [p, _] = self.edges.map(|v| v.map(i64::from));
            let [a, b] = self.turns.map(|v| v.map(i64::from));
            p.cross(&a).dot(&b)
        }
    }

    #[test]
    fn meeting_edges_meet_when_and_where_they_are_made_to() {
        let mut met = 0;
        for (meeting, answer) in answers(Meeting::steady) {
            if meeting.places.iter().any(|place| !(0..=8).contains(place)) {
                continue;
            }
            let hit = answer.hit.unwrap();
            assert!(meeting.is_time_of(&hit) || meeting.is_later_than(&hit));
            if meeting.is_time_of(&hit) {
                let [i, j] = meeting.places;
                let is_place = |e: Enclosure, i| encloses(e, [i, 8]) || encloses(e, [8 - i, 8]);
                let [u, v] = [hit.first.u, hit.first.v];
                assert!(is_place(u, i) && is_place(v, j) || is_place(u, j) && is_place(v, i));
                met += 1;
            }
        }
        assert!(met > COUNT / 3, "{met}");
    }

    #[test]
    fn temporarily_parallel_edges_are_parallel_at_their_time_alone() {
        let mut found = [0; 3];
        for (meeting, answer) in answers(temporarily_parallel::exact) {
            // The direction and both velocities are independent.
            assert_ne!(meeting.det(), 0);
            let [p, q] = meeting.edges;
            assert_eq!(p.cross(&q), Vector3::zeros());
            assert!(p != Vector3::zeros() && q != Vector3::zeros());
            assert_ne!(answer.case, Case::Parallel);
            let Some(hit) = answer.hit.filter(|hit| meeting.is_time_of(hit)) else {
                continue;
            };
            assert!(hit.flags.temporarily_parallel);
            // In a plane, edges may pass through each other there.
            assert!(hit.kind == ContactKind::Graze || answer.case == Case::Coplanar);
            found[index_of(meeting.times)] += 1;
        }
        assert!(found.iter().all(|count| *count > COUNT / 50), "{found:?}");
    }

    /// 0 at the start of the step, 1 at its end, 2 inside.
    fn index_of(times: [i32; 2]) -> usize {
        times.iter().position(|part| *part == 0).unwrap_or(2)
    }

    #[test]
    fn temporarily_point_edges_are_points_at_their_time() {
        let mut found = [0; 3];
        for (meeting, answer) in answers(temporarily_point::exact) {
            assert_eq!(meeting.edges[0], Vector3::zeros());
            assert_ne!(meeting.turns[0], Vector3::zeros());
            let Some(hit) = answer.hit.filter(|hit| meeting.is_time_of(hit)) else {
                continue;
            };
            assert!(hit.flags.temporarily_point);
            // In a plane, edges may pass through each other there.
            assert!(hit.kind == ContactKind::Graze || answer.case == Case::Coplanar);
            found[index_of(meeting.times)] += 1;
        }
        assert!(found.iter().all(|count| *count > COUNT / 50), "{found:?}");
    }

    #[test]
    fn grazing_edges_graze_at_their_time() {
        let (mut found, mut double) = ([0; 3], 0);
        for (meeting, answer) in answers(grazing::exact) {
            let hit = answer.hit.unwrap();
            if meeting.is_time_of(&hit) {
                assert_eq!(hit.kind, ContactKind::Graze, "{meeting:?} {answer:?}");
                found[index_of(meeting.times)] += 1;
            } else {
                assert!(meeting.is_later_than(&hit));
            }
            let [i, j] = meeting.places;
            let is_inside = |place: i32| (1..8).contains(&place);
            let is_inner = index_of(meeting.times) == 2 && is_inside(i) && is_inside(j);
            if is_inner {
                let [linear, square, _] = meeting.coefficients();
                assert!(linear == 0 && square != 0, "{meeting:?}");
                double += 1;
            }
        }
        assert!(found.iter().all(|count| *count > COUNT / 10), "{found:?}");
        assert!(found.iter().sum::<u64>() > COUNT * 3 / 4, "{found:?}");
        assert!(double > COUNT / 4, "{double}");
    }

    #[test]
    fn triple_root_queries_have_one_and_are_hit_there_or_never() {
        let [mut crossings, mut grazes, mut misses] = [0; 3];
        for (meeting, answer) in answers(triple_root::exact) {
            let [linear, square, cube] = meeting.coefficients();
            assert_eq!([linear, square], [0; 2], "{meeting:?}");
            assert_ne!(cube, 0, "{meeting:?}");
            assert_eq!(answer.case, Case::General);
            match answer.hit {
                None => misses += 1,
                Some(hit) => {
                    assert!(meeting.is_time_of(&hit));
                    match hit.kind {
                        ContactKind::Crossing => crossings += 1,
                        ContactKind::Graze => grazes += 1,
                    }
                }
            }
        }
        assert!([crossings, grazes, misses].iter().all(|n| *n > COUNT / 20));
    }
}
