//! A world, and how it is put together.

use super::model::{Body, BodyId, BodyPlan, ModelError, Wire, WireId, WirePlan};
use super::settings::Settings;
use super::solver_cache::SolverCache;

/// Bodies and wires that move together.
#[derive(Clone, Debug)]
pub struct World {
    pub(in crate::wire) settings: Settings,
    pub(in crate::wire) bodies: Vec<Body>,
    pub(in crate::wire) wires: Vec<Wire>,
    /// Steps done.
    pub(in crate::wire) steps: u64,
    pub(in crate::wire) cache: SolverCache,
}

impl World {
    /// An empty world.
    ///
    /// # Errors
    ///
    /// A setting out of its range.
    pub fn new(settings: Settings) -> Result<Self, ModelError> {
        settings.check()?;
        Ok(World {
            settings,
            bodies: Vec::new(),
            wires: Vec::new(),
            steps: 0,
            cache: SolverCache::default(),
        })
    }

    /// Adds a body.
    ///
    /// # Errors
    ///
    /// Names the value that is refused; the world is as before.
    pub fn add_body(&mut self, plan: BodyPlan) -> Result<BodyId, ModelError> {
        self.bodies.push(plan.build()?);
        Ok(BodyId(self.bodies.len() - 1))
    }

    /// Adds a wire.
    ///
    /// # Errors
    ///
    /// Names the value, the body or the stop of the route that is refused; the world is as before.
    pub fn add_wire(&mut self, plan: &WirePlan) -> Result<WireId, ModelError> {
        self.wires.push(plan.build(&self.bodies)?);
        Ok(WireId(self.wires.len() - 1))
    }

    /// What the world is stepped with.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// All bodies, in the order in which they were added.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// All wires, in the order in which they were added.
    pub fn wires(&self) -> &[Wire] {
        &self.wires
    }

    /// A body.
    ///
    /// # Errors
    ///
    /// [`ModelError::Body`] if it is not there.
    pub fn body(&self, id: BodyId) -> Result<&Body, ModelError> {
        let (index, count) = (id.0, self.bodies.len());
        let missing = ModelError::Body { index, count };
        self.bodies.get(index).ok_or(missing)
    }

    /// A wire.
    ///
    /// # Errors
    ///
    /// [`ModelError::Wire`] if it is not there.
    pub fn wire(&self, id: WireId) -> Result<&Wire, ModelError> {
        let (index, count) = (id.0, self.wires.len());
        let missing = ModelError::Wire { index, count };
        self.wires.get(index).ok_or(missing)
    }

    /// Steps done so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Time in s.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.settings.step
    }

    /// Takes all velocity from nodes and dynamic bodies, that of sliding too, as one does again and
    /// again to find a place of rest.
    pub fn halt(&mut self) {
        for node in self.wires.iter_mut().flat_map(|wire| &mut wire.nodes) {
            node.velocity.fill(0.0);
            node.slide = 0.0;
        }
        for body in self.bodies.iter_mut().filter(|body| body.dynamic) {
            body.velocity.fill(0.0);
            body.angular_velocity.fill(0.0);
        }
    }
}

#[cfg(test)]
mod tests;
