//! The vector type of the stepper.

/// A vector in space: m, m/s, N or N s.
pub type Vector = nalgebra::Vector3<f64>;
