//! Two bodies about the time at which they come near, and the query that they make.

use nalgebra::{Matrix3, Vector3};
use rand::{Rng, RngExt};
use tunnelproof::query::{Point, Query, QueryKind};

use super::super::motion::{Motion, in_units, placed, vector};
use super::pair::Pair;

/// Two bodies at one time of the step, and how the second moves relative to the first, in units.
///
/// A point of the first and one of the second are `apart` then; which ones is said in eighths of the
/// `sides`: of AB and CD, or of BC and BD, where the first body is the vertex A.
pub(super) struct Cast {
    pub(super) pair: Pair,
    /// An eighth of each side.
    pub(super) sides: [Vector3<i32>; 2],
    pub(super) places: [i32; 2],
    pub(super) apart: Vector3<i32>,
    /// How much of the step is before that time and how much after it.
    pub(super) times: [i32; 2],
    /// The translation in one of these parts of the step.
    pub(super) passing: Vector3<i32>,
    pub(super) radii: [i32; 2],
}

impl Cast {
    /// The points, A at rest.
    pub(super) fn motion(&self) -> Motion<i32> {
        let ([p, q], [i, j]) = (self.sides, self.places);
        let zero = Vector3::zeros();
        let [first, second] = match self.pair.kind() {
            QueryKind::EdgeEdge => [[zero, p * 8], [zero, q * 8]],
            QueryKind::VertexFace => [[zero, zero], [p * 8, q * 8]],
        };
        let met = match self.pair.kind() {
            QueryKind::EdgeEdge => p * i - q * j,
            QueryKind::VertexFace => -(p * i + q * j),
        };
        let [before, after] = self.times;
        [-before, after].map(|since| {
            let origin = met + self.apart + self.passing * since;
            match self.pair.kind() {
                QueryKind::EdgeEdge => [first[0], first[1], origin, origin + second[1]],
                QueryKind::VertexFace => [zero, origin, origin + second[0], origin + second[1]],
            }
        })
    }

    /// Some of the bodies as spheres.
    pub(super) fn rounded(mut self, rng: &mut dyn Rng) -> Self {
        if self.pair == Pair::Capsules {
            let which = rng.random_range(0..8);
            for (body, side) in self.sides.iter_mut().enumerate() {
                if which == body || which == 2 && rng.random() {
                    *side = Vector3::zeros();
                }
            }
        }
        self
    }

    /// The query in a space mapped at random, so that distances change, with this unit.
    pub(super) fn mapped(&self, rng: &mut dyn Rng, exponent: i32) -> Query {
        let motion = placed(rng, self.motion());
        query(self.pair, motion, self.radii, exponent)
    }

    /// The query in a space rotated at random and made larger, so that every distance to be exact
    /// stays so, with this unit.
    pub(super) fn rotated(&self, rng: &mut dyn Rng, exponent: i32) -> Query {
        let (rotation, scale) = rotation(rng);
        let motion = self.motion();
        let motion = motion.map(|points| points.map(|point| rotation * point));
        let motion = carried(rng, motion, 1 << 21);
        let radii = self.radii.map(|radius| radius * scale);
        query(self.pair, motion, radii, exponent)
    }
}

/// An integer matrix that rotates and makes all distances larger by an integer.
pub(crate) fn rotation(rng: &mut dyn Rng) -> (Matrix3<i32>, i32) {
    let [w, x, y, z] = [(); 4].map(|()| rng.random_range(-2..=2));
    let scale = w * w + x * x + y * y + z * z;
    if scale == 0 {
        return (Matrix3::identity(), 1);
    }
    let matrix = Matrix3::new(
        w * w + x * x - y * y - z * z,
        2 * (x * y - w * z),
        2 * (x * z + w * y),
        2 * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        2 * (y * z - w * x),
        2 * (x * z - w * y),
        2 * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    );
    (matrix, scale)
}

/// The motion carried along by a translation, of coordinates up to `reach`.
pub(super) fn carried(rng: &mut dyn Rng, motion: Motion<i32>, reach: i32) -> Motion<i32> {
    motion.map(|points| {
        let origin = vector(rng, reach);
        points.map(|point| point + origin)
    })
}

pub(super) fn query(pair: Pair, motion: Motion<i32>, radii: [i32; 2], exponent: i32) -> Query {
    let unit = 2f64.powi(exponent);
    let [start, end] = in_units(motion, unit).map(|points| points.map(Point::from));
    let radii = radii.map(|radius| f64::from(radius) * unit);
    Query::new(pair.kind(), start, end, radii).expect("integers are finite")
}
