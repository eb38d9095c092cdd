//! Contacts as data.

use super::Vector;
use super::error::Reason;
use super::model::check::{finite, finite_vector, not_negative, unit};
use super::model::{BodyId, ModelError, WireId};
use super::site::WireSite;
use super::world::World;

/// A place on something that can touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactSite {
    /// A place that never moves.
    World,
    /// A point of a body, in its frame relative to the centre of mass, in m.
    Body {
        /// The body.
        body: BodyId,
        /// The point.
        local: Vector,
    },
    /// A point of a wire's midline by arc length in m, so that it outlives changes of resolution.
    Wire {
        /// The wire.
        wire: WireId,
        /// The arc length.
        arc: f64,
    },
}

impl From<WireSite> for ContactSite {
    fn from(WireSite { wire, arc }: WireSite) -> Self {
        ContactSite::Wire { wire, arc }
    }
}

/// Two places that must not come closer, with friction between them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactConstraint {
    /// What the contact is known by from step to step. Two at a time must not share it.
    pub key: u64,
    /// Place A.
    pub a: ContactSite,
    /// Place B.
    pub b: ContactSite,
    /// Unit normal from B to A.
    pub normal: Vector,
    /// Distance of the surfaces along the normal in m, below 0 where they penetrate.
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl ContactConstraint {
    pub(in crate::wire) fn check(&self, world: &World) -> Result<(), ModelError> {
        finite_vector("normal", &self.normal)?;
        unit("length of the normal", self.normal.norm())?;
        finite("gap", self.gap)?;
        not_negative("friction", self.friction)?;
        for place in [&self.a, &self.b] {
            match *place {
                ContactSite::World => {}
                ContactSite::Body { body, local } => {
                    finite_vector("local", &local)?;
                    world.body(body)?;
                }
                ContactSite::Wire { wire, arc } => WireSite { wire, arc }.check(world)?,
            }
        }
        Ok(())
    }
}

pub(in crate::wire) fn check(world: &World, contacts: &[ContactConstraint]) -> Result<(), Reason> {
    for (index, contact) in contacts.iter().enumerate() {
        contact
            .check(world)
            .map_err(|error| Reason::Contact { index, error })?;
    }
    Ok(())
}
