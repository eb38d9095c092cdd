//! A world, and how it is put together.

use super::model::{
    Body, BodyId, BodyPlan, ModelError, ReelPhase, Resolution, Wire, WireId, WirePlan, reel,
};
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
    pub(in crate::wire) epoch: Epoch,
    pub(in crate::wire) cache: SolverCache,
}

/// Since when steps are as long as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::wire) struct Epoch {
    /// Steps done then.
    pub(in crate::wire) steps: u64,
    /// The time in s.
    pub(in crate::wire) time: f64,
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
            epoch: Epoch::default(),
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
        id.of(&self.bodies)
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
        self.epoch.time + (self.steps - self.epoch.steps) as f64 * self.settings.step
    }

    /// Goes on with other settings. The time stays, also if the time step is another one.
    ///
    /// # Errors
    ///
    /// A setting out of its range; the world is as before.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), ModelError> {
        settings.check()?;
        if settings.step != self.settings.step {
            self.epoch = Epoch {
                steps: self.steps,
                time: self.time(),
            };
        }
        self.settings = settings;
        Ok(())
    }

    /// Goes on with another resolution of a wire. An adaptive one follows it from the next step on,
    /// as far as tension lets it; one that is not keeps its nodes.
    ///
    /// # Errors
    ///
    /// A wire that is not there, or a length that [`add_wire`](Self::add_wire) would refuse; the
    /// world is as before.
    pub fn set_resolution(&mut self, id: WireId, resolution: Resolution) -> Result<(), ModelError> {
        resolution.check(self.wire(id)?.length())?;
        self.wires[id.0].resolution = resolution;
        Ok(())
    }

    /// Lets a wire out, and hauls it in, at its last end from now on: in these phases, in order of
    /// time. None stops it.
    ///
    /// # Errors
    ///
    /// A wire that is not there, or a reel that [`add_wire`](Self::add_wire) would refuse; the world is
    /// as before.
    pub fn set_reel(&mut self, id: WireId, phases: Vec<ReelPhase>) -> Result<(), ModelError> {
        reel::check(self.wire(id)?.nodes(), &phases)?;
        self.wires[id.0].reel = phases;
        Ok(())
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
