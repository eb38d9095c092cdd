//! Checks of single values.

use tunnelproof::wire::{ModelError, Vector};

pub(super) fn positive(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "finite and above 0";
    accept(value > 0.0 && value.is_finite(), field, value, accepted)
}

pub(super) fn not_negative(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "finite and at least 0";
    accept(value >= 0.0 && value.is_finite(), field, value, accepted)
}

pub(super) fn share(field: &'static str, value: f64) -> Result<(), ModelError> {
    let accepted = "at least 0 and below 1";
    accept((0.0..1.0).contains(&value), field, value, accepted)
}

pub(super) fn finite(field: &'static str, value: f64) -> Result<(), ModelError> {
    accept(value.is_finite(), field, value, "finite")
}

/// A vector of any length above 0, made a unit vector.
pub(super) fn direction(field: &'static str, vector: &Vector) -> Result<Vector, ModelError> {
    vector.iter().try_for_each(|&value| finite(field, value))?;
    let length = vector.norm();
    let is_some = length > 0.0 && length.is_finite();
    accept(is_some, field, length, "a vector longer than 0")?;
    Ok(vector / length)
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
        Err(ModelError::Value {
            field,
            value,
            accepted,
        })
    }
}
