//! Checks of single values.

use nalgebra::Matrix3;

use super::ModelError;
use crate::query::Point;
use crate::wire::Vector;

pub(crate) fn positive(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "finite and above 0";
    accept(value > 0.0 && value.is_finite(), field, value, accepted)
}

pub(crate) fn not_negative(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "finite and at least 0";
    accept(value >= 0.0 && value.is_finite(), field, value, accepted)
}

pub(crate) fn share(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "at least 0 and below 1";
    accept((0.0..1.0).contains(&value), field, value, accepted)
}

pub(crate) fn zero(field: &'static str, value: f64) -> Result<(), ModelError> {
    accept(value == 0.0, field, value, "0")
}

pub(crate) fn finite(field: &'static str, value: f64) -> Result<(), ModelError> {
    accept(value.is_finite(), field, value, "finite")
}

pub(crate) fn finite_vector(field: &'static str, vector: &Vector) -> Result<(), ModelError> {
    vector.iter().try_for_each(|&value| finite(field, value))
}

/// The speed of light in m/s: beyond any speed that is meant, and far below what squares overflow at.
const LARGEST_SPEED: f64 = 299_792_458.0;

/// A velocity in m/s, or an angular one in rad/s.
pub(crate) fn speed(field: &'static str, vector: &Vector) -> Result<(), ModelError> {
    finite_vector(field, vector)?;
    let accepted = "from -299792458 to 299792458";
    vector
        .iter()
        .try_for_each(|&value| accept(value.abs() <= LARGEST_SPEED, field, value, accepted))
}

pub(crate) fn finite_point(field: &'static str, point: &Point) -> Result<(), ModelError> {
    finite_vector(field, &point.coords)
}

/// A length that is 1, to what sloppy normalisation leaves.
pub(crate) fn unit(field: &'static str, length: f64) -> Result<(), ModelError> {
    accept((length - 1.0).abs() <= 1e-9, field, length, "1 within 1e-9")
}

/// A vector of any length above 0, made a unit vector.
pub(crate) fn direction(field: &'static str, vector: &Vector) -> Result<Vector, ModelError> {
    finite_vector(field, vector)?;
    let largest = vector.amax();
    accept(largest > 0.0, field, largest, "a vector longer than 0")?;
    let length = vector.norm();
    // Squares of huge and tiny coordinates leave the range of `f64`.
    match (length * length).is_normal() {
        true => Ok(vector / length),
        false => Ok((vector / largest).normalize()),
    }
}

/// A matrix is symmetric and positive definite (Sylvester: its leading minors are above 0).
pub(super) fn positive_definite(
    field: &'static str,
    matrix: &Matrix3<f64>,
) -> Result<(), ModelError> {
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let [value, across] = [matrix[(row, column)], matrix[(column, row)]];
        accept(value == across, field, value, "symmetric")?;
    }
    let second = matrix[(0, 0)] * matrix[(1, 1)] - matrix[(0, 1)] * matrix[(1, 0)];
    [matrix[(0, 0)], second, matrix.determinant()]
        .into_iter()
        .try_for_each(|minor| positive(field, minor))
}

fn accept(
    good: bool,
    field: &'static str,
    value: f64,
    accepted: &'static str,
) -> Result<(), ModelError> {
    if good {
        Ok(())
    } else {
        Err(ModelError::value(field, value, accepted))
    }
}
