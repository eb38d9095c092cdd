//! The way of a body through a motion, and of a segment of wire beside it.
//!
//! A body goes from pose to pose by [`RigidMotion`], which takes stored poses exactly. Nodes of
//! wires go on straight lines, but for those that are fixed to the body: they would leave its arcs
//! for chords, into the body. So for a segment with such a node the way is divided further, into
//! parts in which the body turns by at most [`FINE`]; at the ends of parts the node is where the
//! body has it, rounded. Two bodies that may come near each other have pieces of the same times.

use std::f64::consts::TAU;

use nalgebra::Quaternion;

use super::segment::direction;
use crate::query::Point;
use crate::rigid::{Pose, RigidError, RigidMotion};
use crate::wire::Vector;
use crate::wire::error::CollisionError;
use crate::wire::model::BodyId;
use crate::wire::record;
use crate::wire::site::SegmentId;
use crate::wire::step::motion::ProposedMotion;
use crate::wire::step::stages::MOST_TURNS;
use crate::wire::world::World;

/// The largest turn of a part for a segment that is fixed to the body, in radians: a degree.
const FINE: f64 = std::f64::consts::PI / 180.0;

/// The way of a body, in pieces of the same time.
pub(super) struct BodyWay {
    pub(super) pieces: Vec<RigidMotion>,
    /// Whether it stays where it is, to the bit.
    pub(super) rests: bool,
}

/// The way of a segment.
pub(super) struct SegmentWay {
    pub(super) id: SegmentId,
    pub(super) start: [Point; 2],
    pub(super) end: [Point; 2],
    /// Where nodes are fixed to the body.
    riding: [Option<Point>; 2],
}

/// A part of both ways in which the segment's nodes go straight.
pub(super) struct Stage {
    pub(super) motion: RigidMotion,
    pub(super) start: [Point; 2],
    pub(super) end: [Point; 2],
    /// Which part of the step it is.
    pub(super) times: [f64; 2],
}

impl From<record::Pose> for Pose {
    fn from(pose: record::Pose) -> Self {
        Pose::new(pose.position, pose.orientation.into_inner())
    }
}

impl BodyWay {
    pub(super) fn new(
        world: &World,
        motion: &ProposedMotion,
        body: BodyId,
    ) -> Result<Self, CollisionError> {
        let ended = motion.body(body);
        if !ended.is_followed {
            let angle = ended.angular_velocity.norm() * world.settings.step;
            return Err(CollisionError::TurnsTooFar {
                body,
                turns: angle / TAU,
                most: MOST_TURNS,
            });
        }
        let poses = motion.poses(world, body);
        let rests = poses.windows(2).all(|two| two[0] == two[1]);
        let pieces = poses.windows(2);
        let pieces = pieces.map(|two| RigidMotion::new(two[0].into(), two[1].into()));
        Ok(BodyWay {
            pieces: pieces.collect::<Result<_, RigidError>>()?,
            rests,
        })
    }

    /// One that stays where the body is.
    pub(super) fn resting(world: &World, body: BodyId) -> Result<Self, RigidError> {
        let pose = Pose::from(record::Pose::of(&world.bodies[body.0]));
        Ok(BodyWay {
            pieces: vec![RigidMotion::new(pose, pose)?],
            rests: true,
        })
    }

    /// How many pieces two have in common. None if each has its own: such bodies stay apart, as two
    /// that may come near each other have the same ([`stages`](crate::wire::step::stages)).
    pub(super) fn common_pieces(ways: [&Self; 2]) -> Option<usize> {
        let counts = ways.map(|way| if way.rests { 1 } else { way.pieces.len() });
        let most = counts[0].max(counts[1]);
        let are_common = ways.iter().all(|way| way.rests || way.pieces.len() == most);
        are_common.then_some(most)
    }

    /// Its motion in a piece of the step; one that rests has one piece.
    pub(super) fn piece(&self, piece: usize) -> &RigidMotion {
        if self.rests {
            &self.pieces[0]
        } else {
            &self.pieces[piece]
        }
    }

    /// One of the parts of a piece, in which the segment's nodes go straight.
    pub(super) fn stage(
        &self,
        segment: &SegmentWay,
        piece: usize,
        part: usize,
        parts: usize,
    ) -> Result<Stage, RigidError> {
        let whole = &self.pieces[piece];
        let at = |part: usize| part as f64 / parts as f64;
        let ends = |part: usize| [0, 1].map(|node| segment.node(self, node, piece, part, parts));
        let motion = match parts {
            1 => *whole,
            _ => RigidMotion::new(pose_at(whole, at(part)), pose_at(whole, at(part + 1)))?,
        };
        let count = self.pieces.len() as f64;
        Ok(Stage {
            motion,
            start: ends(part),
            end: ends(part + 1),
            times: [part, part + 1].map(|part| (piece as f64 + at(part)) / count),
        })
    }
}

impl SegmentWay {
    pub(super) fn new(world: &World, id: SegmentId, end: [Point; 2], body: BodyId) -> Self {
        let nodes = id.nodes(world);
        let riding = |node: &&crate::wire::model::Node| {
            let (carrier, local) = node.kind.carrier()?;
            (carrier == body).then(|| Point::from(local))
        };
        SegmentWay {
            id,
            start: nodes.map(|node| node.position),
            end,
            riding: nodes.each_ref().map(riding),
        }
    }

    /// Whether it does not move against a body: both rest, or the body has both of its nodes.
    pub(super) fn is_still_beside(&self, way: &BodyWay) -> bool {
        let rides = self.riding.iter().all(Option::is_some);
        rides || way.rests && self.start == self.end
    }

    /// Into how many parts a piece of the body's way is divided.
    pub(super) fn parts(&self, piece: &RigidMotion) -> usize {
        match self.riding {
            [None, None] => 1,
            // The tangent is a little more than the angle.
            _ => ((4.0 * quarter_tangent(piece) / FINE).ceil() as usize).max(1),
        }
    }

    /// Where a node is after `part` of the `parts` of a piece.
    fn node(&self, way: &BodyWay, node: usize, piece: usize, part: usize, parts: usize) -> Point {
        // The end of a piece is the start of the next one.
        let (piece, part) = if part == parts {
            (piece + 1, 0)
        } else {
            (piece, part)
        };
        if (piece, part) == (0, 0) {
            return self.start[node];
        }
        let Some(motion) = way.pieces.get(piece) else {
            return self.end[node];
        };
        let within = part as f64 / parts as f64;
        match self.riding[node] {
            Some(local) => motion.position(&local, within),
            None => {
                let t = (piece as f64 + within) / way.pieces.len() as f64;
                between(&self.start[node], &self.end[node], t)
            }
        }
    }
}

/// The tangent of a quarter of the angle by which the body turns.
pub(super) fn quarter_tangent(motion: &RigidMotion) -> f64 {
    let [q0, q1] = motion.quaternions().map(|[w, x, y, z]| {
        let q = Quaternion::new(w, x, y, z).coords;
        q / q.amax()
    });
    let (q0, q1) = (q0.normalize(), q1.normalize());
    (q1 - q0).norm() / (q1 + q0).norm()
}

/// The pose at a time of a motion, rounded; its quaternion is of any length.
fn pose_at(motion: &RigidMotion, t: f64) -> Pose {
    if t == 0.0 {
        return *motion.start();
    }
    if t == 1.0 {
        return *motion.end();
    }
    let [q0, q1] = motion.quaternions();
    let q: [f64; 4] = std::array::from_fn(|i| (1.0 - t) * q0[i] + t * q1[i]);
    let centre = between(&motion.start().centre, &motion.end().centre, t);
    Pose::new(centre, Quaternion::new(q[0], q[1], q[2], q[3]))
}

/// Part of the way from one point to another, rounded.
pub(super) fn between(from: &Point, to: &Point, t: f64) -> Point {
    Point::from(from.coords * (1.0 - t) + to.coords * t)
}

/// A vector of space in the frame of a body at a time of its motion, rounded. It does not matter where the
/// body is.
pub(super) fn into_body(motion: &RigidMotion, t: f64, vector: &Vector) -> Vector {
    turned(motion, t, vector, -1.0)
}

/// The same, with the bits that rows of contacts have: off by what places of the body are rounded by, beside
/// a metre.
pub(super) fn direction_into_body(motion: &RigidMotion, t: f64, vector: &Vector) -> Vector {
    let origin = motion.position(&Point::origin(), t);
    Vector::from_fn(|axis, _| {
        let unit = motion.position(&Point::from(Vector::ith(axis, 1.0)), t) - origin;
        direction(&unit).map_or(0.0, |unit| unit.dot(vector))
    })
}

/// A vector of a body's frame in space at a time of its motion, rounded.
pub(super) fn from_body(motion: &RigidMotion, t: f64, vector: &Vector) -> Vector {
    turned(motion, t, vector, 1.0)
}

/// Turned as a body is, or back where `sense` is -1.
fn turned(motion: &RigidMotion, t: f64, vector: &Vector, sense: f64) -> Vector {
    let [q0, q1] = motion.quaternions();
    let q: [f64; 4] = std::array::from_fn(|i| (1.0 - t) * q0[i] + t * q1[i]);
    let size = q.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let [w, x, y, z] = q.map(|component| component / size);
    let v = Vector::new(x, y, z) * sense;
    let turn = v.cross(vector) * 2.0;
    vector + (turn * w + v.cross(&turn)) / (w * w + v.dot(&v))
}
