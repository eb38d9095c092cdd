//! The schema of the stepper's settings in a scene file.

use schemars::JsonSchema;
use serde::Serialize;
use tunnelproof::wire;

use super::file::Triple;

/// What a [`World`](wire::World) is stepped with. docs/wires.md says how to choose it.
#[derive(Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Settings {
    /// Time step `h` in s; usual value 1/60.
    step: f64,
    /// Acceleration of free fall in m/s^2; usual value (0, 0, -9.80665).
    gravity: Triple,
    /// How far a penetrating contact gives way, in m/N; usual value 1e-8.
    contact_compliance: f64,
    /// Damping time of penetrating contacts in steps; usual value 2.
    contact_damping: f64,
    /// Approach speed in m/s above which a penetrating contact keeps nothing of its velocity
    /// (restitution 0); usual value 0.01.
    impact_speed: f64,
    /// Most sweeps over contacts that are swept in one solve; usual value 200.
    sweeps: usize,
    /// What a step may spend on finding what pulls, pushes, sticks and slides: multiplications for
    /// each segment and contact, and for 6000 more; usual value 10,000.
    work: usize,
    /// Velocity in m/s by which contacts may be off: by which none may change in the last sweep;
    /// usual value 1e-8.
    contact_tolerance: f64,
    /// Stability margin of a segment's length: `l_min >= h sqrt(T / mu) / margin`, below 1; usual
    /// value 0.8.
    stability_margin: f64,
    /// A segment is split where it is longer than this many `l_min`; above 2 so that halves are not
    /// merged again; usual value 2.5.
    split_ratio: f64,
}

impl Default for Settings {
    fn default() -> Self {
        let usual = wire::Settings::default();
        Settings {
            step: usual.step,
            gravity: usual.gravity.into(),
            contact_compliance: usual.contact_compliance,
            contact_damping: usual.contact_damping,
            impact_speed: usual.impact_speed,
            sweeps: usual.sweeps,
            work: usual.work,
            contact_tolerance: usual.contact_tolerance,
            stability_margin: usual.stability_margin,
            split_ratio: usual.split_ratio,
        }
    }
}
