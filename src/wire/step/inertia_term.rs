//! What resists a velocity in a step, beside the masses.

use nalgebra::Matrix3;
use smallvec::SmallVec;

use crate::wire::model::{Body, Wire};
use crate::wire::vector::Vector;

/// `12 + 8 sqrt(2)`, the least `c` for which `K (c M + K)^-1 K` beside the masses `M` keeps a step stable against the stiffness `K`
/// ([why](super::transverse)).
pub(super) const FOLLOWED: f64 = 12.0 + 8.0 * std::f64::consts::SQRT_2;

/// What resists a velocity `u` that is linear in those of nodes and of a body, like a mass.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct InertiaTerm {
    /// The mass `m` in kg, or the inertia in kg m^2 of an angular velocity.
    pub(super) mass: f64,
    /// Wires and their nodes, and what their velocities give to `u`.
    pub(super) nodes: SmallVec<[(usize, usize, Matrix3<f64>); 3]>,
    /// A body, and what its velocity and angular velocity give to `u`.
    pub(super) body: Option<(usize, [Matrix3<f64>; 2])>,
}

impl InertiaTerm {
    /// The velocity `u` in m/s or rad/s in a world with these wires and bodies.
    pub(super) fn velocity<'a>(
        &self,
        wire: impl Fn(usize) -> &'a Wire,
        body: impl Fn(usize) -> &'a Body,
    ) -> Vector {
        let nodes = self.nodes.iter();
        let of_nodes = nodes.map(|(at, node, part)| part * wire(*at).nodes[*node].velocity);
        let of_body = self.body.map(|(at, [moved, turned])| {
            let body = body(at);
            moved * body.velocity + turned * body.angular_velocity
        });
        of_nodes.chain(of_body).sum()
    }

    /// `m |u|^2` in J.
    pub(super) fn energy<'a>(
        &self,
        wire: impl Fn(usize) -> &'a Wire,
        body: impl Fn(usize) -> &'a Body,
    ) -> f64 {
        self.mass * self.velocity(wire, body).norm_squared()
    }
}
