//! What a wire is made of.

use std::f64::consts::PI;

use super::ModelError;
use super::check::{not_negative, positive};

/// A round, homogeneous wire.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Material {
    /// Density in kg/m^3.
    pub density: f64,
    /// Radius in m.
    pub radius: f64,
    /// Young's modulus in stretch, in Pa.
    pub stretch_modulus: f64,
    /// Young's modulus in bending, in Pa. With 0 the wire is a chain: it does not resist bending
    /// and pulls only.
    pub bend_modulus: f64,
    /// Damping time of stretch in s; usual value two steps.
    pub stretch_damping: f64,
    /// Damping time of bending in s; usual value 0.075.
    pub bend_damping: f64,
}

impl Material {
    /// A steel wire: 7850 kg/m^3, 2e11 Pa.
    pub fn steel(radius: f64) -> Self {
        Material {
            density: 7850.0,
            radius,
            stretch_modulus: 2e11,
            bend_modulus: 2e11,
            stretch_damping: 2.0 / 60.0,
            bend_damping: 0.075,
        }
    }

    /// The same material as a chain.
    #[must_use]
    pub fn chain(self) -> Self {
        Material {
            bend_modulus: 0.0,
            ..self
        }
    }

    /// Whether the wire pulls only and does not resist bending.
    pub fn is_chain(&self) -> bool {
        self.bend_modulus == 0.0
    }

    /// Area of the cross section in m^2.
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Mass per length `mu` in kg/m.
    pub fn mass_per_length(&self) -> f64 {
        self.density * self.area()
    }

    /// Stiffness `E A` in N: force per strain.
    pub fn stretch_stiffness(&self) -> f64 {
        self.stretch_modulus * self.area()
    }

    /// Stiffness `E I` in N m^2: moment per curvature.
    pub fn bend_stiffness(&self) -> f64 {
        self.bend_modulus * self.area() * self.radius * self.radius / 4.0
    }

    pub(super) fn check(&self) -> Result<(), ModelError> {
        positive("density", self.density)?;
        positive("radius", self.radius)?;
        positive("stretch_modulus", self.stretch_modulus)?;
        not_negative("bend_modulus", self.bend_modulus)?;
        not_negative("stretch_damping", self.stretch_damping)?;
        not_negative("bend_damping", self.bend_damping)
    }
}
