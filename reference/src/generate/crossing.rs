//! Motion with contact somewhere in it, up to rounding, in numbers with all their bits.

use nalgebra::Vector3;
use rand::{Rng, RngExt};

use super::motion::{Motion, real_vector};

/// Two edges that cross, or nearly do: they cross in a point within a tenth of the ends of both.
pub(super) fn crossing(rng: &mut dyn Rng, edges: [Vector3<f64>; 2]) -> [Vector3<f64>; 4] {
    let [[a, b], [c, d]] = edges.map(|edge| {
        let place = rng.random_range(-0.1..1.1);
        [edge * -place, edge * (1.0 - place)]
    });
    [a, b, c, d]
}

/// A step of points that are at `positions` some time within it, or nearly, and move `distance` at
/// most along each axis.
pub(super) fn moving(
    rng: &mut dyn Rng,
    positions: [Vector3<f64>; 4],
    distance: f64,
) -> Motion<f64> {
    let steps = positions.map(|_| real_vector(rng, distance));
    let time = rng.random_range(-0.1..1.1);
    [-time, 1.0 - time].map(|since| [0, 1, 2, 3].map(|i| positions[i] + steps[i] * since))
}
