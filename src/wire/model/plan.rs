//! Wires to be added to a world.

use super::check::{direction, finite_point, finite_vector, not_negative, positive, speed};
use super::wire::{Clamp, Segment};
use super::{BodyId, Material, ModelError, Node, NodeKind, ReelPhase, Resolution, Wire};
use crate::query::Point;
use crate::wire::Vector;

use super::body::Body;

/// A point a wire's route passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// A free node that starts here.
    Free(Point),
    /// A point of the world to which the wire is fixed. Two in a row clamp it.
    Pinned(Point),
    /// An eye: a point of a body to which the wire is fixed, in the body's frame.
    Eye {
        /// The body.
        body: BodyId,
        /// The point relative to the centre of mass, in m.
        local: Vector,
    },
    /// A point of a body over which the wire turns, and sticks or slides. The wire is guided there, as
    /// in the groove of a sheave: it does not slip off sideways.
    Contact {
        /// The body.
        body: BodyId,
        /// The point relative to the centre of mass, in m.
        local: Vector,
        /// Out of the body, in its frame; of any length above 0.
        normal: Vector,
        /// Coefficient of friction, at least 0.
        friction: f64,
    },
}

/// A wire to be added to a world.
#[derive(Clone, Debug, PartialEq)]
pub struct WirePlan {
    /// What it is made of.
    pub material: Material,
    /// How finely it is resolved, at first and later.
    pub resolution: Resolution,
    /// Its route, straight from stop to stop.
    pub route: Vec<Stop>,
    /// Its unstretched length in m; `None` for that of the route. It is spread along the route in
    /// proportion: shorter than the route is pretensioned.
    pub length: Option<f64>,
    /// The velocity its free nodes start with, in m/s.
    pub velocity: Vector,
    /// How far its last end is twisted against its first one at the start, in rad, as
    /// [`Wire::twist`]. Other than 0 only for a wire that [holds twist](Wire::holds_twist).
    pub twist: f64,
    /// What is let out at the last stop, in order of time; nothing if there is no phase. The last stop
    /// must be a fixed point or an eye then.
    pub reel: Vec<ReelPhase>,
}

impl WirePlan {
    /// A wire without pretension that starts at rest and keeps its resolution in m.
    pub fn new(material: Material, length: f64, route: Vec<Stop>) -> Self {
        WirePlan {
            material,
            resolution: Resolution {
                length,
                adaptive: false,
            },
            route,
            length: None,
            velocity: Vector::zeros(),
            twist: 0.0,
            reel: Vec::new(),
        }
    }

    /// The same wire, let out and hauled in at its last stop in these phases.
    #[must_use]
    pub fn reeled(mut self, phases: Vec<ReelPhase>) -> Self {
        self.reel = phases;
        self
    }

    /// The same wire, twisted at the start, in rad.
    #[must_use]
    pub fn twisted(mut self, twist: f64) -> Self {
        self.twist = twist;
        self
    }

    /// The same wire with a resolution that follows its tension.
    #[must_use]
    pub fn adaptive(mut self) -> Self {
        self.resolution.adaptive = true;
        self
    }

    pub(in crate::wire) fn build(&self, bodies: &[Body]) -> Result<Wire, ModelError> {
        speed("velocity", &self.velocity)?;
        let stops = self
            .route
            .iter()
            .map(|stop| stop.node(bodies, &self.velocity));
        let stops = stops.collect::<Result<Vec<Node>, ModelError>>()?;
        let stretch = self.stretch(&stops)?;
        let nodes = self.resolve(&stops, stretch);
        let segments = vec![Segment::NEW; nodes.len() - 1];
        let wire = Wire {
            material: self.material,
            resolution: self.resolution,
            nodes,
            segments,
            twist: self.twist,
            reel: self.reel.clone(),
        };
        wire.check(bodies).map_err(|(_, error)| error)?;
        Ok(wire)
    }

    /// Unstretched length per length of the route.
    fn stretch(&self, stops: &[Node]) -> Result<f64, ModelError> {
        if stops.len() < 2 {
            return Err(ModelError::ShortRoute { stops: stops.len() });
        }
        for stop in [0, stops.len() - 1] {
            if matches!(stops[stop].kind, NodeKind::Contact { .. }) {
                return Err(ModelError::ContactAtEnd { stop });
            }
        }
        let mut path = 0.0;
        for (stop, two) in stops.windows(2).enumerate() {
            let leg = (two[1].position - two[0].position).norm();
            if leg == 0.0 {
                return Err(ModelError::ZeroLength { stop });
            }
            path += leg;
        }
        positive("length of the route", path)?;
        let length = self.length.unwrap_or(path);
        positive("length", length)?;
        self.resolution.check(length)?;
        Ok(length / path)
    }

    /// The nodes: the stops, and free ones between them not closer than the resolution. Where a
    /// wire that resists twist is clamped there are none between.
    fn resolve(&self, stops: &[Node], stretch: f64) -> Vec<Node> {
        let mut nodes = vec![stops[0]];
        let mut arc = 0.0;
        let last = stops.len() - 2;
        for (at, two) in stops.windows(2).enumerate() {
            let leg = two[1].position - two[0].position;
            let rest = leg.norm() * stretch;
            let is_clamp = (at == 0 || at == last)
                && self.material.twist_modulus > 0.0
                && Clamp::of([&two[0], &two[1]]).is_some();
            let count = match is_clamp {
                true => 1,
                false => (rest / self.resolution.length).max(1.0) as usize,
            };
            for i in 1..=count {
                let fraction = i as f64 / count as f64;
                let mut node = free(two[0].position + leg * fraction, self.velocity);
                if i == count {
                    node = two[1];
                }
                node.arc = arc + rest * fraction;
                nodes.push(node);
            }
            arc += rest;
        }
        nodes
    }
}

fn free(position: Point, velocity: Vector) -> Node {
    Node {
        position,
        velocity,
        arc: 0.0,
        kind: NodeKind::Free,
        slide: 0.0,
        remesh_from: 0,
    }
}

impl Stop {
    fn node(&self, bodies: &[Body], velocity: &Vector) -> Result<Node, ModelError> {
        let on_body = |id: BodyId, local: &Vector, kind: NodeKind| {
            finite_vector("local", local)?;
            let body = id.of(bodies)?;
            let velocity = body.velocity_at(local);
            let node = free(body.point(local), velocity);
            Ok(Node { kind, ..node })
        };
        match *self {
            Stop::Free(position) => {
                finite_point("position", &position)?;
                Ok(free(position, *velocity))
            }
            Stop::Pinned(position) => {
                finite_point("position", &position)?;
                let kind = NodeKind::Pinned;
                let node = free(position, Vector::zeros());
                Ok(Node { kind, ..node })
            }
            Stop::Eye { body, local } => on_body(body, &local, NodeKind::Eye { body, local }),
            Stop::Contact {
                body,
                local,
                normal,
                friction,
            } => {
                not_negative("friction", friction)?;
                let kind = NodeKind::Contact {
                    body,
                    local,
                    normal: direction("normal", &normal)?,
                    friction,
                    aside: None,
                };
                on_body(body, &local, kind)
            }
        }
    }
}
