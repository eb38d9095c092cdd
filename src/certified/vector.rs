//! Vectors in space, for what is answered.

use nalgebra::Vector3;

/// The point at `t` in `[0, 1]` from `a` to `b`, without overflow of the difference.
pub(super) fn between(a: &Vector3<f64>, b: &Vector3<f64>, t: f64) -> Vector3<f64> {
    a * (1.0 - t) + b * t
}

/// The direction of a vector, without overflow of the squares; `None` if it has none.
pub(super) fn normalised(vector: &Vector3<f64>) -> Option<Vector3<f64>> {
    let scaled = vector / vector.amax();
    scaled
        .iter()
        .all(|x| x.is_finite())
        .then(|| scaled.normalize())
}
