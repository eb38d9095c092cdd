//! Wires: nodes along a material, and the segments between them.

use super::body::Body;
use super::check::{finite, finite_point, finite_vector, not_negative, positive, zero};
use super::reel::{self, ReelPhase};
use super::{BodyId, Material, ModelError};
use crate::query::Point;
use crate::wire::vector::{Vector, unit};

/// A wire of a world, by the order in which wires were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WireId(pub usize);

/// How many steps the largest tension is remembered for, and how many lie between two changes of
/// resolution at one node.
pub(in crate::wire) const TENSION_HISTORY: usize = 10;

/// What is left of a segment that wire slides out of, as a fraction of the resolution, and of what
/// it was before the step.
pub(in crate::wire) const LEAST: f64 = 1.0 / 16.0;

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
        /// Unit vector along the surface and across the wire, in the body's frame: the wire may slip
        /// off this way and back. `None` where it is guided, as in the groove of a sheave.
        aside: Option<Vector>,
    },
}

impl NodeKind {
    /// Whether a point of this body carries the node.
    pub(in crate::wire) fn is_on(&self, body: BodyId) -> bool {
        self.carrier().is_some_and(|(carrier, _)| carrier == body)
    }

    /// Whether it is fixed to this body.
    pub(in crate::wire) fn is_eye(&self, body: BodyId) -> bool {
        matches!(self, NodeKind::Eye { .. }) && self.is_on(body)
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
    /// Velocity in m/s, also that of the part of the wire whose mass it has.
    pub velocity: Vector,
    /// Arc length along the unstretched wire, in m.
    pub arc: f64,
    /// What carries it.
    pub kind: NodeKind,
    /// How fast its arc length grows because wire slides over it, in m/s; 0 unless it is a contact
    /// node, or the last one of a wire that is [let out](Wire::reel) there.
    pub slide: f64,
    /// The step before which the resolution is not changed here.
    pub(in crate::wire) remesh_from: u64,
}

/// What is remembered of a segment from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Tension in N in the last step; below 0 is compression.
    pub tension: f64,
    /// Tensions of the last steps, at the number of the step modulo `TENSION_HISTORY`.
    pub(in crate::wire) tension_history: [f64; TENSION_HISTORY],
}

impl Segment {
    pub(in crate::wire) const NEW: Segment = Segment {
        tension: 0.0,
        tension_history: [0.0; TENSION_HISTORY],
    };

    /// The largest tension of the last 10 steps in N, at least 0.
    pub fn largest_tension(&self) -> f64 {
        self.tension_history.iter().fold(0.0, |a: f64, &b| a.max(b))
    }

    /// A segment that remembers the larger tension of two.
    pub(in crate::wire) fn larger(a: &Segment, b: &Segment) -> Segment {
        let mut joint = *a;
        joint.tension = a.tension.max(b.tension);
        for (mine, other) in joint.tension_history.iter_mut().zip(b.tension_history) {
            *mine = mine.max(other);
        }
        joint
    }
}

/// What holds an end of a wire so that it neither turns nor twists there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::wire) enum Clamp {
    /// Two points of the world.
    World,
    /// Two points of this body.
    Body(BodyId),
}

impl Clamp {
    /// Of two nodes in a row: if both are fixed to the same thing.
    pub(in crate::wire) fn of(nodes: [&Node; 2]) -> Option<Self> {
        match nodes.map(|node| node.kind) {
            [NodeKind::Pinned, NodeKind::Pinned] => Some(Clamp::World),
            [NodeKind::Eye { body: a, .. }, NodeKind::Eye { body: b, .. }] if a == b => {
                Some(Clamp::Body(a))
            }
            _ => None,
        }
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
    /// How far its last end is twisted against its first one, in rad; 0 unless it holds twist.
    pub(in crate::wire) twist: f64,
    /// What is let out at its last node, in order of time.
    pub(in crate::wire) reel: Vec<ReelPhase>,
}

/// The most segments that a resolution may ask for, so that a slip does not take all memory.
pub(super) const MOST_SEGMENTS: f64 = 1e6;

/// How often a bend of a wire that is pushed may grow `e`-fold in a step.
const GROWTH: f64 = 2.0;

impl Resolution {
    /// Of a wire so long in m.
    pub(in crate::wire) fn check(&self, length: f64) -> Result<(), ModelError> {
        positive("resolution", self.length)?;
        if length > self.length * MOST_SEGMENTS {
            let accepted = "at least a millionth of the wire's length";
            return Err(ModelError::value("resolution", self.length, accepted));
        }
        Ok(())
    }
}

impl Node {
    fn check(&self, bodies: &[Body], is_last: bool) -> Result<(), ModelError> {
        finite_point("position", &self.position)?;
        finite_vector("velocity", &self.velocity)?;
        finite("arc", self.arc)?;
        finite("slide", self.slide)?;
        if !is_last && !matches!(self.kind, NodeKind::Contact { .. }) {
            zero("slide", self.slide)?;
        }
        match self.kind {
            NodeKind::Free => zero("slide", self.slide),
            NodeKind::Pinned => Ok(()),
            NodeKind::Eye { body, local } => {
                finite_vector("local", &local)?;
                self.is_at(&body.of(bodies)?.point(&local), 0.0)
            }
            NodeKind::Contact {
                body,
                local,
                normal,
                friction,
                aside,
            } => {
                finite_vector("local", &local)?;
                finite_vector("normal", &normal)?;
                positive("length of the normal", normal.norm())?;
                not_negative("friction", friction)?;
                if let Some(aside) = aside {
                    finite_vector("aside", &aside)?;
                    positive("length of aside", aside.norm())?;
                }
                // One that was attached just now is there to rounding, of an orientation whose
                // length is 1 within 1e-9.
                let size = local.amax() + self.position.coords.amax();
                let at = body.of(bodies)?.point(&local);
                self.is_at(&at, 1e-8 * size)
            }
        }
    }

    /// Whether it is where its body has it.
    fn is_at(&self, point: &Point, within: f64) -> Result<(), ModelError> {
        let apart = (self.position - point).amax();
        if apart <= within {
            return Ok(());
        }
        let accepted = "0, or rounding of a contact node's";
        Err(ModelError::value(
            "distance from its body's point",
            apart,
            accepted,
        ))
    }
}

impl Wire {
    /// Whether it is a wire beside these bodies; what is wrong, and with which node.
    pub(in crate::wire) fn check(
        &self,
        bodies: &[Body],
    ) -> Result<(), (Option<usize>, ModelError)> {
        let whole = |error| (None, error);
        self.material.check().map_err(whole)?;
        let count = self.nodes.len();
        if count < 2 || self.segments.len() + 1 != count {
            let accepted = "at least 2, and one more than segments";
            let error = ModelError::value("number of nodes", count as f64, accepted);
            return Err(whole(error));
        }
        for (at, node) in self.nodes.iter().enumerate() {
            let wrong = |error| (Some(at), error);
            node.check(bodies, at == count - 1).map_err(wrong)?;
            let is_end = at == 0 || at == count - 1;
            if is_end && matches!(node.kind, NodeKind::Contact { .. }) {
                return Err(wrong(ModelError::ContactAtEnd { stop: at }));
            }
            let ascends = match at {
                0 => node.arc == 0.0,
                _ => node.arc > self.nodes[at - 1].arc,
            };
            if !ascends {
                let accepted = "0 at the first node, and above that of the node before elsewhere";
                return Err(wrong(ModelError::value("arc", node.arc, accepted)));
            }
        }
        for segment in &self.segments {
            finite("tension", segment.tension).map_err(whole)?;
            for &tension in &segment.tension_history {
                finite("tension", tension).map_err(whole)?;
            }
        }
        finite("twist", self.twist).map_err(whole)?;
        if self.twist != 0.0 && !self.holds_twist() {
            let accepted = "0 unless the material has a twist_modulus and both ends are clamped";
            return Err(whole(ModelError::value("twist", self.twist, accepted)));
        }
        if self.holds_twist() {
            for clamp in [0, count - 2] {
                positive("length of a clamp", self.span(clamp).norm()).map_err(whole)?;
            }
        }
        reel::check(&self.nodes, &self.reel).map_err(whole)?;
        self.resolution.check(self.length()).map_err(whole)
    }

    /// Its unstretched length in m.
    pub fn length(&self) -> f64 {
        self.nodes.last().map_or(0.0, |last| last.arc)
    }

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

    /// Whether it holds twist: its material has a twist modulus, and both ends are clamped. An end is
    /// clamped if its first two nodes are fixed to the world, or both to the same body. Then its
    /// torque is `G J twist / l` in N m, with the unstretched length `l` between the clamps.
    pub fn holds_twist(&self) -> bool {
        self.clamps().is_some()
    }

    /// How far its last end is twisted against its first one, in rad, counterclockwise seen from
    /// beyond the last end; any number of turns. 0 for a wire that does not hold twist.
    pub fn twist(&self) -> f64 {
        self.twist
    }

    /// What clamps the first end and the last one, of a wire that holds twist.
    pub(in crate::wire) fn clamps(&self) -> Option<[Clamp; 2]> {
        match self.nodes.as_slice() {
            // What belongs to both clamps cannot be twisted.
            [a, b, .., c, d] if self.material.twist_modulus > 0.0 => {
                Some([Clamp::of([a, b])?, Clamp::of([c, d])?])
            }
            _ => None,
        }
    }

    /// Whether a segment clamps an end of a wire that holds twist. No node is put into it.
    pub(in crate::wire) fn is_clamp(&self, segment: usize) -> bool {
        (segment == 0 || segment + 1 == self.segments.len()) && self.holds_twist()
    }

    /// What twists: the unstretched length between the clamps, in m.
    pub(in crate::wire) fn twisted_length(&self) -> f64 {
        self.nodes[self.nodes.len() - 2].arc - self.nodes[1].arc
    }

    /// The elastic energy of its twist in J.
    pub(in crate::wire) fn twist_energy(&self) -> f64 {
        if self.twist == 0.0 {
            return 0.0;
        }
        self.material.twist_stiffness() * self.twist * self.twist / (2.0 * self.twisted_length())
    }

    /// Unstretched length of a segment in m.
    pub fn rest_length(&self, segment: usize) -> f64 {
        self.nodes[segment + 1].arc - self.nodes[segment].arc
    }

    /// The most that a segment pushes in steps of a length in s, in N. That is what buckles a piece of the resolution's
    /// length, `pi^2 E I / l^2`, as nodes are too far apart for the bends of more; or less, what makes a bend grow `e^2`-fold
    /// in a step, `4 sqrt(E I mu) / h`: it would be bent before the step is over. What the whole wire bears between clamped
    /// ends, `4 pi^2 E I / L^2`, makes no bend grow. A chain pushes with 0.
    ///
    /// A wire that is straight to the last bit would carry any load, and no real one is.
    pub fn largest_push(&self, step: f64) -> f64 {
        let length = self.nodes[self.nodes.len() - 1].arc - self.nodes[0].arc;
        let grows = GROWTH * self.material.growing_load(step);
        let borne = 4.0 * self.material.buckling_load(length);
        let resolved = self.material.buckling_load(self.resolution.length);
        resolved.min(grows.max(borne))
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

    /// The velocity in m/s of the wire itself where a segment begins or ends at a node: that of the
    /// node, less what slides over it.
    pub(in crate::wire) fn velocity_at(&self, node: usize, segment: usize) -> Vector {
        let node = &self.nodes[node];
        if node.slide == 0.0 {
            return node.velocity;
        }
        let (along, _) = unit(&self.span(segment));
        node.velocity - along * node.slide
    }

    /// The segment at an arc length and where in it, from 0 to 1; the nearest end outside of the
    /// wire.
    pub fn at(&self, arc: f64) -> (usize, f64) {
        let after = self.nodes.partition_point(|node| node.arc <= arc);
        let segment = after.clamp(1, self.nodes.len() - 1) - 1;
        let parameter = (arc - self.nodes[segment].arc) / self.rest_length(segment);
        (segment, parameter.clamp(0.0, 1.0))
    }

    /// The node that is nearest to an arc length, along the wire.
    pub(in crate::wire) fn nearest_node(&self, arc: f64) -> usize {
        let (segment, parameter) = self.at(arc);
        segment + usize::from(parameter > 0.5)
    }
}
