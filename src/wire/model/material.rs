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
    /// Shear modulus in twist, in Pa; 7.9e10 for steel. With 0, the usual value, the wire turns
    /// freely about itself. A wire that resists has a torque if both its ends are clamped: see
    /// [`Wire::holds_twist`](super::Wire::holds_twist). A chain has 0.
    pub twist_modulus: f64,
    /// Damping time of stretch in s; usual value two steps. A step takes half of itself at least:
    /// with less, what it does not resolve would grow.
    pub stretch_damping: f64,
    /// Damping time of bending in s; usual value 0.075.
    pub bend_damping: f64,
    /// Damping time of twist in s; usual value two steps.
    pub twist_damping: f64,
}

/// What is known of a rope: a rope of strands bends and turns far more easily than a round bar of
/// its material that is as stiff in stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopePlan {
    /// Radius in m.
    pub radius: f64,
    /// Mass per length `mu` in kg/m.
    pub mass_per_length: f64,
    /// `E A` in N: force per strain.
    pub stretch_stiffness: f64,
    /// `E I` in N m^2: moment per curvature. With 0 the rope is a chain.
    pub bend_stiffness: f64,
    /// `G J` in N m^2: torque per twist and length. With 0 the rope turns freely about itself.
    pub twist_stiffness: f64,
}

impl Material {
    /// A steel wire: 7850 kg/m^3, 2e11 Pa. It turns freely about itself.
    pub fn steel(radius: f64) -> Self {
        Material {
            density: 7850.0,
            radius,
            stretch_modulus: 2e11,
            bend_modulus: 2e11,
            twist_modulus: 0.0,
            stretch_damping: 2.0 / 60.0,
            bend_damping: 0.075,
            twist_damping: 2.0 / 60.0,
        }
    }

    /// A rope by its stiffness: the density and the moduli of a round wire that is as heavy and as
    /// stiff, to rounding, with the usual damping.
    ///
    /// # Errors
    ///
    /// Names the value that is refused.
    pub fn rope(plan: RopePlan) -> Result<Self, ModelError> {
        positive("radius", plan.radius)?;
        positive("mass_per_length", plan.mass_per_length)?;
        positive("stretch_stiffness", plan.stretch_stiffness)?;
        not_negative("bend_stiffness", plan.bend_stiffness)?;
        not_negative("twist_stiffness", plan.twist_stiffness)?;
        let usual = Material::steel(plan.radius);
        let material = Material {
            density: plan.mass_per_length / usual.area(),
            stretch_modulus: plan.stretch_stiffness / usual.area(),
            bend_modulus: plan.bend_stiffness / usual.second_moment(),
            twist_modulus: plan.twist_stiffness / (2.0 * usual.second_moment()),
            ..usual
        };
        material.check()?;
        Ok(material)
    }

    /// The same material as a chain, which does not resist twist either.
    #[must_use]
    pub fn chain(self) -> Self {
        Material {
            bend_modulus: 0.0,
            twist_modulus: 0.0,
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

    /// Second moment of the cross section about an axis across the wire, `pi r^4 / 4`, in m^4.
    pub fn second_moment(&self) -> f64 {
        self.area() * self.radius * self.radius / 4.0
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

    /// The push in N under which a straight piece of a length in m buckles that is hinged at both ends, `pi^2 E I / l^2`
    /// (Euler 1744).
    pub(super) fn buckling_load(&self, length: f64) -> f64 {
        (PI / length) * (PI / length) * self.bend_stiffness()
    }

    /// The push in N under which a small bend of a long, straight wire grows `e`-fold in a time in s: the fastest one grows
    /// by `T / (2 sqrt(E I mu))` a second.
    pub(super) fn growing_load(&self, time: f64) -> f64 {
        2.0 * (self.bend_stiffness() * self.mass_per_length()).sqrt() / time
    }

    /// Stiffness `G J` in N m^2, `J = pi r^4 / 2`: torque per twist and length.
    pub fn twist_stiffness(&self) -> f64 {
        2.0 * self.twist_modulus * self.second_moment()
    }

    pub(super) fn check(&self) -> Result<(), ModelError> {
        positive("density", self.density)?;
        positive("radius", self.radius)?;
        positive("stretch_modulus", self.stretch_modulus)?;
        not_negative("bend_modulus", self.bend_modulus)?;
        not_negative("twist_modulus", self.twist_modulus)?;
        if self.is_chain() && self.twist_modulus > 0.0 {
            let accepted = "0 for a chain, whose bend_modulus is 0";
            return Err(ModelError::value(
                "twist_modulus",
                self.twist_modulus,
                accepted,
            ));
        }
        not_negative("stretch_damping", self.stretch_damping)?;
        not_negative("bend_damping", self.bend_damping)?;
        not_negative("twist_damping", self.twist_damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROPE: RopePlan = RopePlan {
        radius: 0.012,
        mass_per_length: 0.45,
        stretch_stiffness: 3e6,
        bend_stiffness: 0.7,
        twist_stiffness: 0.3,
    };

    #[test]
    fn rope_is_as_heavy_and_stiff_as_its_plan() {
        let rope = Material::rope(ROPE).unwrap();
        let pairs = [
            (rope.mass_per_length(), 0.45),
            (rope.stretch_stiffness(), 3e6),
            (rope.bend_stiffness(), 0.7),
            (rope.twist_stiffness(), 0.3),
        ];
        for (is, due) in pairs {
            assert!((is - due).abs() <= 4.0 * f64::EPSILON * due, "{is} {due}");
        }
        assert_eq!(rope.radius, 0.012);
        // A round bar of one material that does not change its volume has E = 3 G, and E I = 1.5 G J.
        let bar = Material {
            bend_modulus: 3e9,
            twist_modulus: 1e9,
            ..rope
        };
        let ratio = bar.bend_stiffness() / bar.twist_stiffness();
        assert!((ratio - 1.5).abs() < 1e-15, "{ratio}");
        let chain = Material::rope(RopePlan {
            bend_stiffness: 0.0,
            twist_stiffness: 0.0,
            ..ROPE
        });
        assert!(chain.unwrap().is_chain());
        assert_eq!(rope.chain().twist_stiffness(), 0.0);
    }

    #[test]
    fn rope_is_refused_by_the_value_that_is_wrong() {
        let refusal = |change: fn(&mut RopePlan)| {
            let mut plan = ROPE;
            change(&mut plan);
            Material::rope(plan).unwrap_err().to_string()
        };
        let expected = [
            (
                refusal(|p| p.radius = 0.0),
                "radius is 0, it must be finite and above 0",
            ),
            (
                refusal(|p| p.mass_per_length = -1.0),
                "mass_per_length is -1, it must be finite and above 0",
            ),
            (
                refusal(|p| p.mass_per_length = -1e300),
                "mass_per_length is -1e300, it must be finite and above 0",
            ),
            (
                refusal(|p| p.stretch_stiffness = 0.0),
                "stretch_stiffness is 0, it must be finite and above 0",
            ),
            (
                refusal(|p| p.bend_stiffness = f64::NAN),
                "bend_stiffness is NaN, it must be finite and at least 0",
            ),
            (
                refusal(|p| p.twist_stiffness = -1.0),
                "twist_stiffness is -1, it must be finite and at least 0",
            ),
            (
                refusal(|p| p.radius = 1e-200),
                "density is inf, it must be finite and above 0",
            ),
        ];
        for (is, due) in expected {
            assert_eq!(is, due);
        }
        let chain = refusal(|p| p.bend_stiffness = 0.0);
        assert!(
            chain.ends_with("it must be 0 for a chain, whose bend_modulus is 0"),
            "{chain}"
        );
    }
}
