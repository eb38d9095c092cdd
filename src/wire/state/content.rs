//! What a state file holds, field by field in the order of the file.
//!
//! Every conversion names all fields of what it takes, so that a new one cannot be left out unseen.

use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};

use super::State;
use crate::broad::Placed;
use crate::query::Point;
use crate::wire::collide::{KnownContacts, Side, WireContact, WireContacts};
use crate::wire::model::{Body, MeshParts, Node, NodeKind, Phase, ReelPhase, Segment, Wire};
use crate::wire::site::WireSite;
use crate::wire::solver_cache::SolverCache;
use crate::wire::world::{Epoch, World};
use crate::wire::{
    CollisionMemory, CollisionSettings, ContactConstraint, Material, Mode, Resolution, Settings,
    Shape, Vector,
};

#[derive(Serialize, Deserialize)]
pub(super) struct Content {
    pub(super) world: WorldContent,
    pub(super) narrow: String,
    pub(super) settings: CollisionSettingsContent,
    pub(super) memory: MemoryContent,
}

#[derive(Serialize, Deserialize)]
pub(super) struct WorldContent {
    pub(super) settings: Settings,
    pub(super) steps: u64,
    /// Steps done when the time step became what it is, and the time in s.
    pub(super) epoch: (u64, f64),
    pub(super) bodies: Vec<BodyContent>,
    pub(super) wires: Vec<WireContent>,
    /// Keys of the contacts of the last step, and their impulses in N s.
    pub(super) warm_start: Vec<(u64, Vector)>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct BodyContent {
    pub(super) shape: ShapeContent,
    pub(super) dynamic: bool,
    /// From when in s, velocity, angular velocity.
    pub(super) phases: Vec<(f64, Vector, Vector)>,
    pub(super) mass: f64,
    pub(super) inertia: Matrix3<f64>,
    pub(super) position: Point,
    pub(super) orientation: UnitQuaternion<f64>,
    pub(super) velocity: Vector,
    pub(super) angular_velocity: Vector,
}

/// A shape whose mesh may be none yet.
#[derive(Serialize, Deserialize)]
pub(super) enum ShapeContent {
    Box { half: Vector },
    Cylinder { radius: f64, half_height: f64 },
    Sphere { radius: f64 },
    Capsule { radius: f64, half_height: f64 },
    Plane,
    Mesh(MeshParts),
}

#[derive(Serialize, Deserialize)]
pub(super) struct WireContent {
    pub(super) material: Material,
    pub(super) resolution: Resolution,
    pub(super) nodes: Vec<NodeContent>,
    pub(super) segments: Vec<SegmentContent>,
    pub(super) twist: f64,
    pub(super) reel: Vec<ReelPhase>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct NodeContent {
    pub(super) position: Point,
    pub(super) velocity: Vector,
    pub(super) arc: f64,
    pub(super) kind: NodeKind,
    pub(super) slide: f64,
    pub(super) remesh_from: u64,
}

#[derive(Serialize, Deserialize)]
pub(super) struct SegmentContent {
    pub(super) tension: f64,
    pub(super) tension_history: [f64; 10],
}

#[derive(Serialize, Deserialize)]
pub(super) struct CollisionSettingsContent {
    pub(super) mode: ModeContent,
    pub(super) friction: f64,
    pub(super) guarded_thickness: f64,
    pub(super) bodies: bool,
    pub(super) contact_nodes: bool,
}

#[derive(Serialize, Deserialize)]
pub(super) enum ModeContent {
    Guard,
    Thesis,
}

#[derive(Serialize, Deserialize)]
pub(super) struct MemoryContent {
    /// Of each segment, counted through all wires: radius and ends where the last motion took it.
    pub(super) placed: Vec<Option<Placed>>,
    /// Two of these that the last step left out, and how much farther than their radii they are
    /// apart at least.
    pub(super) excluded: Vec<([usize; 2], f64)>,
    /// Keys given to contacts between wires.
    pub(super) made: u64,
    pub(super) between_wires: Vec<WireContactContent>,
    /// Keys given to contacts with bodies.
    pub(super) given: u64,
    pub(super) with_bodies: Vec<ContactConstraint>,
    /// Where bodies pushed on wires in the last step.
    pub(super) pushed: Vec<WireSite>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct WireContactContent {
    pub(super) key: u64,
    pub(super) sites: [WireSite; 2],
    pub(super) wrong: bool,
    pub(super) normal: Vector,
    pub(super) gap: f64,
    pub(super) pushing: bool,
    pub(super) at_node: Option<Side>,
}

impl From<&State> for Content {
    fn from(state: &State) -> Self {
        let State {
            world,
            narrow,
            settings,
            memory,
        } = state;
        Content {
            world: world.into(),
            narrow: narrow.clone(),
            settings: settings.into(),
            memory: memory.into(),
        }
    }
}

impl From<&World> for WorldContent {
    fn from(world: &World) -> Self {
        let World {
            settings,
            bodies,
            wires,
            steps,
            epoch,
            cache,
        } = world;
        // The structure of the last system follows from the entries of the next one.
        let SolverCache {
            warm_start,
            structures: _,
        } = cache;
        let &Epoch { steps: since, time } = epoch;
        WorldContent {
            settings: settings.clone(),
            steps: *steps,
            epoch: (since, time),
            bodies: bodies.iter().map(BodyContent::from).collect(),
            wires: wires.iter().map(WireContent::from).collect(),
            warm_start: warm_start.impulses().to_vec(),
        }
    }
}

impl From<&Body> for BodyContent {
    fn from(body: &Body) -> Self {
        let Body {
            shape,
            dynamic,
            phases,
            mass,
            inertia,
            position,
            orientation,
            velocity,
            angular_velocity,
        } = body;
        let phase = |phase: &Phase| (phase.from, phase.velocity, phase.angular_velocity);
        BodyContent {
            shape: shape.into(),
            dynamic: *dynamic,
            phases: phases.iter().map(phase).collect(),
            mass: *mass,
            inertia: *inertia,
            position: *position,
            orientation: *orientation,
            velocity: *velocity,
            angular_velocity: *angular_velocity,
        }
    }
}

impl From<&Shape> for ShapeContent {
    fn from(shape: &Shape) -> Self {
        match *shape {
            Shape::Box { half } => ShapeContent::Box { half },
            Shape::Cylinder {
                radius,
                half_height,
            } => ShapeContent::Cylinder {
                radius,
                half_height,
            },
            Shape::Sphere { radius } => ShapeContent::Sphere { radius },
            Shape::Capsule {
                radius,
                half_height,
            } => ShapeContent::Capsule {
                radius,
                half_height,
            },
            Shape::Plane => ShapeContent::Plane,
            Shape::Mesh(ref mesh) => ShapeContent::Mesh(mesh.into()),
        }
    }
}

impl From<&Wire> for WireContent {
    fn from(wire: &Wire) -> Self {
        let Wire {
            material,
            resolution,
            nodes,
            segments,
            twist,
            reel,
        } = wire;
        WireContent {
            material: *material,
            resolution: *resolution,
            nodes: nodes.iter().map(NodeContent::from).collect(),
            segments: segments.iter().map(SegmentContent::from).collect(),
            twist: *twist,
            reel: reel.clone(),
        }
    }
}

impl From<&Node> for NodeContent {
    fn from(node: &Node) -> Self {
        let Node {
            position,
            velocity,
            arc,
            kind,
            slide,
            remesh_from,
        } = *node;
        NodeContent {
            position,
            velocity,
            arc,
            kind,
            slide,
            remesh_from,
        }
    }
}

impl From<&Segment> for SegmentContent {
    fn from(segment: &Segment) -> Self {
        let Segment {
            tension,
            tension_history,
        } = *segment;
        SegmentContent {
            tension,
            tension_history,
        }
    }
}

impl From<&CollisionSettings> for CollisionSettingsContent {
    fn from(settings: &CollisionSettings) -> Self {
        let CollisionSettings {
            mode,
            friction,
            guarded_thickness,
            bodies,
            contact_nodes,
        } = *settings;
        CollisionSettingsContent {
            mode: match mode {
                Mode::Guard => ModeContent::Guard,
                Mode::Thesis => ModeContent::Thesis,
            },
            friction,
            guarded_thickness,
            bodies,
            contact_nodes,
        }
    }
}

impl From<&CollisionMemory> for MemoryContent {
    fn from(memory: &CollisionMemory) -> Self {
        let CollisionMemory {
            slow,
            between_wires: WireContacts { list, made },
            with_bodies:
                KnownContacts {
                    last,
                    given,
                    pushed,
                },
        } = memory;
        MemoryContent {
            placed: slow.placed(),
            excluded: slow.excluded(),
            made: *made,
            between_wires: list.iter().map(WireContactContent::from).collect(),
            given: *given,
            with_bodies: last.clone(),
            pushed: pushed.clone(),
        }
    }
}

impl From<&WireContact> for WireContactContent {
    fn from(contact: &WireContact) -> Self {
        let WireContact {
            key,
            sites,
            wrong,
            normal,
            gap,
            pushing,
            at_node,
        } = *contact;
        WireContactContent {
            key,
            sites,
            wrong,
            normal,
            gap,
            pushing,
            at_node,
        }
    }
}
