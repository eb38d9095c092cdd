//! Wires: nodes along a material, and the segments between them.

use super::{BodyId, Material};
use crate::query::Point;
use crate::wire::Vector;

/// A wire of a world, by the order in which wires were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WireId(pub usize);

/// How many steps the largest tension is remembered for, and how many lie between two changes of
/// resolution at one node.
pub(in crate::wire) const MEMORY: usize = 10;

/// What carries a node.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NodeKind {
    /// Nothing: a free mass.
    Free,
    /// A point of the world.
    Pinned,
    /// A point of a body, in its frame relative to the centre of mass.
    Eye {
        /// The body.
        body: BodyId,
        /// The point in m.
        local: Vector,
    },
    /// A point of a body over which the wire sticks or slides.
    Contact {
        /// The body.
        body: BodyId,
        /// The point in its frame, in m.
        local: Vector,
        /// Unit vector out of the body, in its frame.
        normal: Vector,
        /// Coefficient of friction.
        friction: f64,
    },
}

impl NodeKind {
    /// Whether a point of this body carries the node.
    pub(in crate::wire) fn rides(&self, body: BodyId) -> bool {
        self.carrier().is_some_and(|(carrier, _)| carrier == body)
    }

    /// Whether it is fixed to this body.
    pub(in crate::wire) fn is_eye(&self, body: BodyId) -> bool {
        matches!(self, NodeKind::Eye { .. }) && self.rides(body)
    }

    /// The body and the point of it that carry the node, if one does.
    pub fn carrier(&self) -> Option<(BodyId, Vector)> {
        match *self {
            NodeKind::Free | NodeKind::Pinned => None,
            NodeKind::Eye { body, local } | NodeKind::Contact { body, local, .. } => {
                Some((body, local))
            }
        }
    }
}

/// A node of a wire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Position in m.
    pub position: Point,
    /// Velocity in m/s, with which it carries its share of the wire's momentum.
    pub velocity: Vector,
    /// Arc length along the unstretched wire, in m.
    pub arc: f64,
    /// What carries it.
    pub kind: NodeKind,
    /// How fast its arc length grows because wire slides over it, in m/s; 0 unless it is a contact node.
    pub slide: f64,
    /// The step before which the resolution is not changed here.
    pub(in crate::wire) settled: u64,
}

/// What is remembered of a segment from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Tension in N in the last step; below 0 is compression.
    pub tension: f64,
    /// Tensions of the last steps, at the number of the step modulo `MEMORY`.
    pub(in crate::wire) memory: [f64; MEMORY],
}

impl Segment {
    pub(in crate::wire) const NEW: Segment = Segment {
        tension: 0.0,
        memory: [0.0; MEMORY],
    };

    /// The largest tension of the last 10 steps in N, at least 0.
    pub fn largest_tension(&self) -> f64 {
        self.memory.iter().fold(0.0, |a: f64, &b| a.max(b))
    }

    /// A segment that remembers the larger tension of two.
    pub(in crate::wire) fn larger(a: &Segment, b: &Segment) -> Segment {
        let mut joint = *a;
        joint.tension = a.tension.max(b.tension);
        for (mine, other) in joint.memory.iter_mut().zip(b.memory) {
            *mine = mine.max(other);
        }
        joint
    }
}

/// How finely a wire is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Resolution {
    /// The shortest segment wanted, `l_user`, in m.
    pub length: f64,
    /// Whether tension may change the resolution.
    pub adaptive: bool,
}

/// A wire: at least two nodes, and a segment between each two that follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    pub(in crate::wire) material: Material,
    pub(in crate::wire) resolution: Resolution,
    pub(in crate::wire) nodes: Vec<Node>,
    pub(in crate::wire) segments: Vec<Segment>,
}

impl Wire {
    /// What it is made of.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// How finely it is resolved.
    pub fn resolution(&self) -> Resolution {
        self.resolution
    }

    /// Its nodes in order of arc length.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Its segments: segment `i` is between nodes `i` and `i + 1`.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Unstretched length of a segment in m.
    pub fn rest_length(&self, segment: usize) -> f64 {
        self.nodes[segment + 1].arc - self.nodes[segment].arc
    }

    /// Mass of a node in kg: half of each segment it ends.
    pub fn node_mass(&self, node: usize) -> f64 {
        let first = self.nodes[node.saturating_sub(1)].arc;
        let last = self.nodes[(node + 1).min(self.nodes.len() - 1)].arc;
        self.material.mass_per_length() * (last - first) / 2.0
    }

    /// From the start of a segment to its end, in m.
    pub fn span(&self, segment: usize) -> Vector {
        self.nodes[segment + 1].position - self.nodes[segment].position
    }

    /// The segment at an arc length and where in it, from 0 to 1; the nearest end outside of the wire.
    pub fn at(&self, arc: f64) -> (usize, f64) {
        let after = self.nodes.partition_point(|node| node.arc <= arc);
        let segment = after.clamp(1, self.nodes.len() - 1) - 1;
        let place = (arc - self.nodes[segment].arc) / self.rest_length(segment);
        (segment, place.clamp(0.0, 1.0))
    }

    /// The node that is nearest to an arc length, along the wire.
    pub(in crate::wire) fn nearest_node(&self, arc: f64) -> usize {
        let (segment, share) = self.at(arc);
        segment + usize::from(share > 0.5)
    }
}
