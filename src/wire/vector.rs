//! The vector type of the stepper, and unit vectors.

use nalgebra::Matrix3;

/// A vector in space: m, m/s, N or N s.
pub type Vector = nalgebra::Vector3<f64>;

/// A direction, and its length; a direction of 0 where there is no length.
pub(in crate::wire) fn unit(vector: &Vector) -> (Vector, f64) {
    let length = vector.norm();
    if length > 0.0 {
        (vector / length, length)
    } else {
        (Vector::zeros(), 0.0)
    }
}

/// A right-handed frame with `normal` as its first row.
pub(in crate::wire) fn frame(normal: &Vector) -> Matrix3<f64> {
    let axis = normal.iamin();
    let first = normal.cross(&Vector::ith(axis, 1.0)).normalize();
    let second = normal.cross(&first);
    Matrix3::from_rows(&[normal.transpose(), first.transpose(), second.transpose()])
}
