//! Motion built from what it is at one time, exactly.

use nalgebra::Vector3;
use rand::{Rng, RngExt};

use super::motion::{Motion, vector};

/// Two edges at a time of the step and how they move there, in integers.
///
/// They meet at that time, if `places` are on the edges and `aside` is 0: with `s` the time since
/// then, `K = 8 (p + s a)`, `L = 8 (q + s b)`, and the point `i` eighths along AB is off the one `j`
/// eighths along CD by `aside + s w`. Then
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
