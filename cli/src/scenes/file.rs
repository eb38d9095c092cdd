//! What stands in a scene file. The comments here are the descriptions in the schema.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use tunnelproof::wire::Settings;

/// Three numbers: x, y, z.
pub(super) type Triple = [f64; 3];

/// A scene: what there is, what moves, and for how long. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What it is called.
    pub title: String,
    /// How long it lasts in s; rounded to whole steps.
    pub duration: f64,
    /// Coefficient of friction of wires; usual value 0.5.
    #[serde(default = "half")]
    pub friction: f64,
    /// The share of the thickness of wires that guard mode keeps, in [0, 1); 0 keeps midlines apart
    /// and no more.
    #[serde(default)]
    pub guarded_thickness: f64,
    /// Whether adaptive wires get contact nodes where bodies bend them; usually so.
    #[serde(default = "yes")]
    pub contact_nodes: bool,
    /// What the stepper works with; what is left out has its usual value.
    #[serde(default)]
    #[schemars(with = "super::settings::Settings")]
    pub settings: Settings,
    /// Rigid bodies.
    #[serde(default)]
    pub bodies: Vec<Body>,
    /// Wires, ropes and chains.
    #[serde(default)]
    pub wires: Vec<Wire>,
}

fn half() -> f64 {
    0.5
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Its name, by which wires refer to it; no other body has it.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// Where its centre of mass starts, in m.
    pub position: Triple,
    /// How it starts turned.
    #[serde(default)]
    pub turn: Option<Turn>,
    /// What moves it; nothing if left out.
    #[serde(default)]
    pub drive: Drive,
}

/// A turn about an axis through the centre of mass, counterclockwise seen against the axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The axis, of any length above 0.
    pub axis: Triple,
    /// The angle in degrees.
    pub degrees: f64,
}

/// The shape of a body, around its centre of mass. Lengths in m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A box.
    Box {
        /// Half of its edges along x, y, z.
        half: Triple,
    },
    /// A cylinder around the z axis.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of the height.
        half_height: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A capsule around the z axis.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of the distance between the centres of its two caps.
        half_height: f64,
    },
    /// The half-space below the body's x-y plane.
    Plane,
    /// A closed mesh of triangles, counterclockwise seen from outside. It is moved so that its
    /// centre of mass is the body's position.
    Mesh {
        /// The corners.
        vertices: Vec<Triple>,
        /// Three corners each, by number from 0.
        triangles: Vec<[usize; 3]>,
    },
}

/// What moves a body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Drive {
    /// Nothing does.
    #[default]
    Static,
    /// Its velocity is prescribed, by phases in order of time. Before the first it rests.
    Kinematic(Vec<Phase>),
    /// Forces do.
    Dynamic(Dynamic),
}

/// From a time on, a kinematic body moves at these velocities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Phase {
    /// The time in s.
    pub from: f64,
    /// Velocity in m/s.
    #[serde(default)]
    pub velocity: Triple,
    /// Angular velocity in rad/s.
    #[serde(default)]
    pub angular_velocity: Triple,
}

/// How a dynamic body starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dynamic {
    /// Density in kg/m^3.
    pub density: f64,
    /// Velocity in m/s.
    #[serde(default)]
    pub velocity: Triple,
    /// Angular velocity in rad/s.
    #[serde(default)]
    pub angular_velocity: Triple,
}

/// A wire, rope or chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wire {
    /// Its name; no other wire has it.
    pub name: String,
    /// What it is made of.
    pub material: Material,
    /// The shortest segment wanted, in m.
    pub resolution: f64,
    /// Whether the resolution follows the tension; usual value true.
    #[serde(default = "yes")]
    pub adaptive: bool,
    /// Its way, straight from stop to stop.
    pub route: Vec<Stop>,
    /// Its unstretched length in m, that of the route if left out. It is spread along the route in
    /// proportion: shorter than the route is pretensioned.
    #[serde(default)]
    pub length: Option<f64>,
    /// The velocity that its free nodes start with, in m/s.
    #[serde(default)]
    pub velocity: Triple,
    /// How far its last end is twisted against its first one at the start, in rad; only for a wire
    /// that resists twist and is clamped at both ends.
    #[serde(default)]
    pub twist: f64,
    /// What is let out at its last stop, a fixed point or an eye, by phases in order of time. Before
    /// the first it is nothing.
    #[serde(default)]
    pub reel: Vec<ReelPhase>,
}

/// From a time on, wire is let out, as by a winch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReelPhase {
    /// The time in s.
    pub from: f64,
    /// How much unstretched wire is let out, in m/s; below 0 it is hauled in.
    pub speed: f64,
}

fn yes() -> bool {
    true
}

/// What a round wire is made of: steel, where nothing else is said.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Radius in m.
    pub radius: f64,
    /// Density in kg/m^3; 7850 for steel.
    #[serde(default)]
    pub density: Option<f64>,
    /// Mass per length in kg/m, in place of the density.
    #[serde(default)]
    pub mass_per_length: Option<f64>,
    /// Young's modulus in stretch, in Pa; 2e11 for steel.
    #[serde(default)]
    pub stretch_modulus: Option<f64>,
    /// E A in N, force per strain, in place of the modulus.
    #[serde(default)]
    pub stretch_stiffness: Option<f64>,
    /// Young's modulus in bending, in Pa; 2e11 for steel. With 0 it is a chain, which pulls only.
    #[serde(default)]
    pub bend_modulus: Option<f64>,
    /// E I in N m^2, moment per curvature, in place of the modulus. A rope of strands has far less
    /// than a round bar of its radius.
    #[serde(default)]
    pub bend_stiffness: Option<f64>,
    /// Shear modulus in twist, in Pa; usual value 0: it turns freely about itself. 7.9e10 is that of
    /// steel. It matters where both ends are clamped.
    #[serde(default)]
    pub twist_modulus: Option<f64>,
    /// G J in N m^2, torque per twist and length, in place of the modulus.
    #[serde(default)]
    pub twist_stiffness: Option<f64>,
    /// Damping time of stretch in s; usual value 1/30.
    #[serde(default)]
    pub stretch_damping: Option<f64>,
    /// Damping time of bending in s; usual value 0.075.
    #[serde(default)]
    pub bend_damping: Option<f64>,
    /// Damping time of twist in s; usual value 1/30.
    #[serde(default)]
    pub twist_damping: Option<f64>,
}

/// A point that a wire's route passes, or how it gets to the next one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Stop {
    /// A free node that starts here.
    Free(Triple),
    /// A point of the world to which the wire is fixed. Two in a row clamp it.
    Pinned(Triple),
    /// A point of a body to which the wire is fixed.
    Eye {
        /// The name of the body.
        body: String,
        /// The point in the body's frame, in m.
        local: Triple,
    },
    /// A point of a body over which the wire turns, and sticks or slides.
    Contact {
        /// The name of the body.
        body: String,
        /// The point in the body's frame, in m.
        local: Triple,
        /// Out of the body, in its frame; of any length above 0.
        normal: Triple,
        /// Coefficient of friction.
        friction: f64,
    },
    /// Between two points: from one to the other it hangs as a catenary of this length in m. It knows
    /// no bodies: where a floor is in the way, free stops lay the wire on it.
    Hang(f64),
}
