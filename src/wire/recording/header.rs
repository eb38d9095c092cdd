//! What a recording is of.

use serde::{Deserialize, Serialize};

use crate::wire::model::{Body, Wire};
use crate::wire::{Material, Resolution, Settings, Shape, World};

/// What stays the same from step to step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// What the world is stepped with.
    pub settings: Settings,
    /// Its wires, in the order in which they were added.
    pub wires: Vec<WireSummary>,
    /// Its bodies, in the order in which they were added.
    pub bodies: Vec<BodySummary>,
}

/// A wire of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WireSummary {
    /// What it is made of.
    pub material: Material,
    /// How finely it is resolved.
    pub resolution: Resolution,
}

/// A body of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodySummary {
    /// Its shape.
    pub shape: Shape,
    /// Whether forces move it.
    pub dynamic: bool,
    /// Mass in kg; 0 unless it is dynamic.
    pub mass: f64,
}

impl From<&World> for Header {
    fn from(world: &World) -> Self {
        Header {
            settings: world.settings().clone(),
            wires: world.wires().iter().map(WireSummary::from).collect(),
            bodies: world.bodies().iter().map(BodySummary::from).collect(),
        }
    }
}

impl From<&Wire> for WireSummary {
    fn from(wire: &Wire) -> Self {
        WireSummary {
            material: *wire.material(),
            resolution: wire.resolution(),
        }
    }
}

impl From<&Body> for BodySummary {
    fn from(body: &Body) -> Self {
        BodySummary {
            shape: body.shape().clone(),
            dynamic: body.is_dynamic(),
            mass: body.mass(),
        }
    }
}
