//! Every tunable of the stepper, with its unit and usual value.

use super::Vector;
use super::model::ModelError;
use super::model::check::{finite_vector, not_negative, positive};

/// What a [`World`](super::World) is stepped with. docs/wires.md says how to choose it.
///
/// ```
/// use tunnelproof::wire::{Settings, Vector};
///
/// let mut settings = Settings::default().with_step(0.01).with_gravity(Vector::zeros());
/// settings.sweeps = 50;
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
#[non_exhaustive]
pub struct Settings {
    /// Time step `h` in s; usual value 1/60.
    pub step: f64,
    /// Acceleration of free fall in m/s^2; usual value (0, 0, -9.80665).
    pub gravity: Vector,
    /// How far a penetrating contact gives way, in m/N; usual value 1e-8.
    pub contact_compliance: f64,
    /// Damping time of penetrating contacts in steps; usual value 2. It is taken as 0.5 at least.
    pub contact_damping: f64,
    /// Approach speed in m/s above which a penetrating contact keeps nothing of its velocity
    /// (restitution 0); usual value 0.01.
    pub impact_speed: f64,
    /// Most sweeps over contacts that are swept in one solve; usual value 200.
    pub sweeps: usize,
    /// What a step may spend on finding what pulls, pushes, sticks and slides: multiplications for
    /// each segment and contact, and for 6000 more; usual value 10,000. What contacts and bodies do
    /// not tie together shares them by its segments and contacts. A step that has spent them ends
    /// with what it has found ([`SolverRecord::cut_short`](super::SolverRecord::cut_short)).
    pub work: usize,
    /// Largest accepted error of contact velocities in m/s, the change in the last sweep; usual
    /// value 1e-8.
    pub contact_tolerance: f64,
    /// Stability margin of a segment's length: `l_min >= h sqrt(T / mu) / margin`, below 1; usual
    /// value 0.8.
    pub stability_margin: f64,
    /// A segment is split where it is longer than this many `l_min`; above 2 so that halves are not
    /// merged again; usual value 2.5.
    pub split_ratio: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            step: 1.0 / 60.0,
            gravity: Vector::new(0.0, 0.0, -9.80665),
            contact_compliance: 1e-8,
            contact_damping: 2.0,
            impact_speed: 0.01,
            sweeps: 200,
            work: 10_000,
            contact_tolerance: 1e-8,
            stability_margin: 0.8,
            split_ratio: 2.5,
        }
    }
}

impl Settings {
    /// The same with another time step in s.
    pub fn with_step(self, step: f64) -> Self {
        Settings { step, ..self }
    }

    /// The same with another acceleration of free fall in m/s^2.
    pub fn with_gravity(self, gravity: Vector) -> Self {
        Settings { gravity, ..self }
    }

    /// The shortest segment that is stable under a tension, in m: `h sqrt(T / mu)` over the margin.
    pub(super) fn shortest_stable(&self, tension: f64, mass_per_length: f64) -> f64 {
        let speed = (tension.max(0.0) / mass_per_length).sqrt();
        self.step * speed / self.stability_margin
    }

    pub(super) fn check(&self) -> Result<(), ModelError> {
        positive("step", self.step)?;
        finite_vector("gravity", &self.gravity)?;
        positive("contact_compliance", self.contact_compliance)?;
        not_negative("contact_damping", self.contact_damping)?;
        not_negative("impact_speed", self.impact_speed)?;
        positive("contact_tolerance", self.contact_tolerance)?;
        positive("stability_margin", self.stability_margin)?;
        if self.stability_margin >= 1.0 {
            let value = self.stability_margin;
            return Err(ModelError::value("stability_margin", value, "below 1"));
        }
        if !(self.split_ratio > 2.0 && self.split_ratio.is_finite()) {
            let value = self.split_ratio;
            return Err(ModelError::value(
                "split_ratio",
                value,
                "finite and above 2",
            ));
        }
        Ok(())
    }
}
