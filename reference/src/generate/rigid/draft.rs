//! The numbers of a query, drawn and changed.

use std::ops::Range;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{Rng, RngExt};
use tunnelproof::query::Point;
use tunnelproof::rigid::{Pose, RigidMotion, RigidQuery, Side};

use super::super::motion::{real_vector, vector};

/// The numbers of a query, before they are checked.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) centres: [Vector3<f64>; 2],
    /// w, x, y, z.
    pub(super) quaternions: [[f64; 4]; 2],
    /// Of edges A and B, else A, at the start and at the end of the step.
    pub(super) world: [Vec<Vector3<f64>>; 2],
    pub(super) local: Vec<Vector3<f64>>,
    pub(super) radius: f64,
}

impl Draft {
    /// `None` if the body turns too far.
    pub(super) fn query(&self) -> Option<RigidQuery> {
        let motion = motion(&self.centres, &self.quaternions)?;
        let [start, end] = &self.world;
        let (start, end, local) = (points(start), points(end), points(&self.local));
        let first = Side::Straight {
            start: &start,
            end: &end,
        };
        let second = Side::Turning {
            local: &local,
            motion: &motion,
        };
        RigidQuery::new([first, second], self.radius).ok()
    }

    /// Half of them moved in space so that a point of the first side is about on one of the body at
    /// some time.
    pub(super) fn aimed(mut self, rng: &mut dyn Rng) -> Self {
        if let Some(way) = way_to_contact(rng, self.query()) {
            self.world.iter_mut().flatten().for_each(|p| *p += way);
        }
        self
    }

    /// Every number, each to be changed.
    pub(super) fn numbers(&mut self) -> Vec<&mut f64> {
        let lengths = self
            .centres
            .iter_mut()
            .chain(self.world.iter_mut().flatten());
        let lengths = lengths.chain(&mut self.local).flat_map(|v| v.iter_mut());
        lengths
            .chain(self.quaternions.iter_mut().flatten())
            .collect()
    }

    /// Moves two numbers by up to `2^20` ulp, or not.
    pub(super) fn nudged(mut self, rng: &mut dyn Rng) -> Self {
        nudge(rng, self.numbers());
        self
    }
}

/// `None` if the body turns too far.
pub(super) fn motion(
    centres: &[Vector3<f64>; 2],
    quaternions: &[[f64; 4]; 2],
) -> Option<RigidMotion> {
    let pose = |i: usize| {
        let [w, x, y, z] = quaternions[i];
        Pose::new(Point::from(centres[i]), Quaternion::new(w, x, y, z))
    };
    RigidMotion::new(pose(0), pose(1)).ok()
}

pub(super) fn points(vectors: &[Vector3<f64>]) -> Vec<Point> {
    vectors.iter().copied().map(Point::from).collect()
}

/// For half of the queries how to move the first side so that a point of it is about on one of the
/// second side at some time.
pub(super) fn way_to_contact(rng: &mut dyn Rng, query: Option<RigidQuery>) -> Option<Vector3<f64>> {
    let query = query.filter(|_| rng.random())?;
    let points = query.positions(rng.random_range(0.0..1.0));
    let (first, second) = points.split_at(query.sides()[0].number_of_points());
    Some(mean(rng, second) - mean(rng, first))
}

/// A mean of the points with random weights.
pub(super) fn mean(rng: &mut dyn Rng, points: &[Point]) -> Vector3<f64> {
    let weights: Vec<f64> = points.iter().map(|_| rng.random_range(0.0..1.0)).collect();
    let all: f64 = weights.iter().sum();
    let parts = points
        .iter()
        .zip(weights)
        .map(|(p, w)| p.coords * (w / all));
    parts.sum()
}

/// Moves two of the numbers by up to `2^20` ulp, or not.
pub(super) fn nudge(rng: &mut dyn Rng, mut numbers: Vec<&mut f64>) {
    for _ in 0..2 {
        let ulps = 1_i64 << rng.random_range(0..=20);
        let ulps = if rng.random() { ulps } else { -ulps };
        let at = rng.random_range(0..numbers.len());
        let number = &mut *numbers[at];
        if *number != 0.0 {
            *number = f64::from_bits(number.to_bits().wrapping_add_signed(ulps));
        }
    }
}

/// Draws until the body turns by no more than it may.
pub(super) fn first(rng: &mut dyn Rng, draft: impl Fn(&mut dyn Rng) -> Draft) -> RigidQuery {
    first_query(rng, |rng| draft(rng).query())
}

/// Draws until it is a query.
pub(super) fn first_query(
    rng: &mut dyn Rng,
    draw: impl Fn(&mut dyn Rng) -> Option<RigidQuery>,
) -> RigidQuery {
    loop {
        if let Some(query) = draw(rng) {
            return query;
        }
    }
}

/// How many points are in space and how many are of the body.
pub(super) fn sides(rng: &mut dyn Rng) -> (usize, usize) {
    if rng.random() { (2, 2) } else { (1, 3) }
}

pub(super) fn unit_quaternion(rng: &mut dyn Rng) -> UnitQuaternion<f64> {
    let axis = real_vector(rng, 1.0);
    UnitQuaternion::from_scaled_axis(axis * 3.0)
}

/// Two orientations of this angle at most, and both signs.
pub(super) fn turn(rng: &mut dyn Rng, degrees: f64) -> [[f64; 4]; 2] {
    turn_within(rng, 0.0..degrees)
}

/// Two orientations of an angle in degrees from this range, and both signs.
pub(super) fn turn_within(rng: &mut dyn Rng, degrees: Range<f64>) -> [[f64; 4]; 2] {
    let first = unit_quaternion(rng);
    let axis = nalgebra::Unit::new_normalize(real_vector(rng, 1.0) + Vector3::new(0.0, 0.0, 1e-3));
    let angle = rng.random_range(degrees).to_radians();
    let second = UnitQuaternion::from_axis_angle(&axis, angle) * first;
    let sign = if rng.random() { 1.0 } else { -1.0 };
    let plain = |q: UnitQuaternion<f64>| [q.w, q.i, q.j, q.k];
    [plain(first), plain(second).map(|x| sign * x)]
}

pub(super) fn anywhere(rng: &mut dyn Rng, degrees: f64, speed: f64) -> Draft {
    let (world, local) = sides(rng);
    let start: Vec<_> = (0..world).map(|_| real_vector(rng, 1.0)).collect();
    let moved = start.iter().map(|p| p + real_vector(rng, speed)).collect();
    let centre = real_vector(rng, 1.0);
    Draft {
        quaternions: turn(rng, degrees),
        centres: [centre, centre + real_vector(rng, speed)],
        local: (0..local).map(|_| real_vector(rng, 1.0)).collect(),
        world: [start, moved],
        radius: 0.0,
    }
}

pub(super) fn integers(rng: &mut dyn Rng, reach: i32) -> Vector3<f64> {
    vector(rng, reach).map(f64::from)
}
