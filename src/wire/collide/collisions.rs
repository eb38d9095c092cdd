//! How collisions in a world are found, and what is known of them from step to step.

use super::body_contacts::BodyContacts;
use super::body_detect::CoreDetection;
use super::detect::Pipeline;
use super::segment::PairFilter;
use super::thickness::Thickness;
use super::wire_contacts::WireContacts;
use crate::broad::Method;
use crate::certified::Certified;
use crate::narrow::NarrowPhase;
use crate::wire::model::ModelError;
use crate::wire::model::check::{not_negative, share};

/// What becomes of a crossing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// It is prevented: the step is solved again with a contact there, and if that does not help,
    /// what takes part moves only as far as it may. Changes of resolution that would cross are
    /// refused, by the certified path whatever narrow phase tests motions.
    #[default]
    Guard,
    /// It happens, as in the thesis: the contact comes with the next step and pushes the wires back
    /// through each other. Changes of resolution are not tested.
    Thesis,
}

/// What [`Collisions`] do, beside the phases that find them. Each builder of `Collisions` that is
/// named sets one of these.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CollisionSettings {
    /// What becomes of a crossing: [`with_mode`](Collisions::with_mode).
    pub mode: Mode,
    /// Coefficient of friction of all contacts that are found:
    /// [`with_friction`](Collisions::with_friction).
    pub friction: f64,
    /// The share of the thickness that guard mode keeps:
    /// [`with_guarded_thickness`](Collisions::with_guarded_thickness).
    pub guarded_thickness: f64,
    /// Whether contacts with bodies are found: not [`without_bodies`](Collisions::without_bodies).
    pub bodies: bool,
    /// Whether wires get contact nodes where bodies bend them: not
    /// [`without_contact_nodes`](Collisions::without_contact_nodes).
    pub contact_nodes: bool,
}

impl Default for CollisionSettings {
    fn default() -> Self {
        CollisionSettings {
            mode: Mode::default(),
            friction: 0.5,
            guarded_thickness: 0.0,
            bodies: true,
            contact_nodes: true,
        }
    }
}

impl CollisionSettings {
    pub(in crate::wire) fn check(&self) -> Result<(), ModelError> {
        not_negative("friction", self.friction)?;
        share("guarded_thickness", self.guarded_thickness)
    }
}

/// The collisions in one world: how they are found, and the contacts there are.
pub struct Collisions<'n> {
    pub(super) narrow: &'n dyn NarrowPhase,
    pub(super) filter: Option<PairFilter<'n>>,
    pub(super) settings: CollisionSettings,
    pub(super) pipeline: Pipeline,
    pub(super) touches: WireContacts,
    pub(super) obstacles: BodyContacts,
    pub(super) cores: CoreDetection,
}

impl Default for Collisions<'_> {
    /// The certified path after sweep-and-prune in guard mode, friction 0.5.
    fn default() -> Self {
        Collisions::new(Mode::default(), Method::default(), &Certified)
    }
}

impl<'n> Collisions<'n> {
    /// Collisions found by a broad and a narrow phase; friction 0.5, no filter. What guard mode
    /// promises of motions it promises as far as the narrow phase misses nothing.
    pub fn new(mode: Mode, method: Method, narrow: &'n dyn NarrowPhase) -> Self {
        Collisions {
            narrow,
            filter: None,
            settings: CollisionSettings {
                mode,
                ..CollisionSettings::default()
            },
            pipeline: Pipeline::new(method),
            touches: WireContacts::default(),
            obstacles: BodyContacts::new(method),
            cores: CoreDetection::new(method),
        }
    }

    /// The same in another mode.
    #[must_use]
    pub fn with_mode(mut self, mode: Mode) -> Self {
        self.settings.mode = mode;
        self
    }

    /// The same with other settings.
    #[cfg(feature = "recording")]
    pub(in crate::wire) fn with_settings(mut self, settings: CollisionSettings) -> Self {
        self.settings = settings;
        self
    }

    /// The name of the narrow phase.
    #[cfg(feature = "recording")]
    pub(in crate::wire) fn narrow_name(&self) -> &str {
        self.narrow.name()
    }

    /// The same with another coefficient of friction, of all contacts that are found.
    ///
    /// # Errors
    ///
    /// A coefficient that is not a finite number of at least 0.
    pub fn with_friction(mut self, friction: f64) -> Result<Self, ModelError> {
        self.settings.friction = friction;
        self.settings.check()?;
        Ok(self)
    }

    /// The same with another share of the thickness that guard mode keeps, in `[0, 1)`; usually 0:
    /// midlines are kept apart and no more. Thesis mode knows no share.
    ///
    /// Two segments that are farther apart than this share of the sum of their radii where a motion
    /// starts stay farther apart throughout the motion, whatever is between its start and its end.
    /// Two that are nearer come no nearer: of the 64 distances that divide it evenly they stay
    /// beyond the last one that they are beyond. Places of one wire that are nearer along it than
    /// `pi / 2` diameters count as thinner, so that it can bend: they touch at `2 / pi` of the length
    /// of wire between them. The narrow phase is asked with a radius.
    ///
    /// # Errors
    ///
    /// A share that is not a number of at least 0 and below 1.
    pub fn with_guarded_thickness(mut self, kappa: f64) -> Result<Self, ModelError> {
        self.settings.guarded_thickness = kappa;
        self.settings.check()?;
        Ok(self)
    }

    /// The same for those pairs only that `filter` keeps. The others pass through each other.
    #[must_use]
    pub fn with_filter(mut self, filter: PairFilter<'n>) -> Self {
        self.filter = Some(filter);
        self
    }

    /// The same without contacts with bodies: all of them are given to the step, and wires may go
    /// through bodies.
    #[must_use]
    pub fn without_bodies(mut self) -> Self {
        self.settings.bodies = false;
        self
    }

    /// The same without contact nodes for adaptive wires. With them, where a body that was found to
    /// touch a wire bends it between two nodes, the wire gets another one there, which is attached to
    /// the body, and over which wire sticks or slides ([`NodeKind::Contact`](crate::wire::NodeKind)).
    /// It leaves where the wire turns away from the body or slips off sideways, and with the end of the
    /// wire. Without them wires hook at edges, whatever the friction.
    #[must_use]
    pub fn without_contact_nodes(mut self) -> Self {
        self.settings.contact_nodes = false;
        self
    }

    /// What is guarded of the thickness.
    pub(super) fn thickness(&self) -> Thickness {
        match self.settings.mode {
            Mode::Guard => Thickness(self.settings.guarded_thickness),
            Mode::Thesis => Thickness::default(),
        }
    }

    /// What becomes of a crossing.
    pub fn mode(&self) -> Mode {
        self.settings.mode
    }

    /// What they do.
    pub fn settings(&self) -> CollisionSettings {
        self.settings
    }

    /// Wall-clock time in s of all broad phases so far.
    pub(super) fn broad_seconds(&self) -> f64 {
        let [wires, cores] = [self.pipeline.broad_seconds(), self.cores.broad_seconds()];
        wires + cores + self.obstacles.broad_seconds()
    }
}
