//! What a step has beside the masses, so that forces which it takes as they are where it starts leave it stable: at [segments that
//! are too short for their tension](super::transverse), and at [bodies that wires pull on](super::body_inertia).

use super::body_inertia::body_inertias;
use super::inertia_term::InertiaTerm;
use super::linearisation::Linearisation;
use super::transverse::{SteepNode, SteepSegment, transverse_inertias};
use crate::wire::world::World;

/// What there is beside the masses in a step.
pub(super) struct AddedInertias {
    /// At bodies, and at nodes beside segments that are too short, and not steep.
    pub(super) terms: Vec<InertiaTerm>,
    /// Segments that are steep.
    pub(super) steep: Vec<SteepSegment>,
    /// Ends of these that can move.
    pub(super) nodes: Vec<SteepNode>,
}

/// The inertias of a world in its next step.
pub(super) fn added_inertias(world: &World, linearisation: &Linearisation) -> AddedInertias {
    let bodies = body_inertias(world, linearisation);
    let transverse = transverse_inertias(world, linearisation, &bodies.is_held);
    let mut terms = bodies.terms;
    terms.extend(transverse.short);
    AddedInertias {
        terms,
        steep: transverse.steep,
        nodes: transverse.nodes,
    }
}
