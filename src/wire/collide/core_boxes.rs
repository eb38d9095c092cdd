//! Boxes around the parts of a core on its way, seen from the body's centre.
//!
//! A corner goes on an arc around the chord between its places at both ends. It strays from the
//! chord by at most the chord times half the tangent of a quarter of the angle, so the box of the
//! chord, grown by that, holds it. Points of wires go straight, also seen from the centre. Every
//! box is grown by more than what is rounded.

use super::body_motion::{Stage, from_body, quarter_tangent};
use crate::query::Point;
use crate::rigid::{Pose, RigidMotion};
use crate::wire::Vector;

/// More than all roundings of a place, as a part of the numbers that it is made of.
const ROUNDING: f64 = 1e-13;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: Vector,
    pub(super) high: Vector,
}

impl Bounds {
    /// Holds nothing.
    pub(super) const NOTHING: Bounds = Bounds {
        low: Vector::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vector::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// A box around two places and everything that is as near.
    fn around(from: &Vector, to: &Vector, margin: f64) -> Self {
        Bounds {
            low: from.inf(to).add_scalar(-margin),
            high: from.sup(to).add_scalar(margin),
        }
    }

    /// Around the sum of two points, one of each box.
    pub(super) fn plus(&self, other: &Bounds) -> Bounds {
        Bounds {
            low: self.low + other.low,
            high: self.high + other.high,
        }
    }

    pub(super) fn joined(&self, other: &Bounds) -> Bounds {
        Bounds {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// Not where a bound is no number.
    pub(super) fn is_apart(&self, other: &Bounds) -> bool {
        let apart =
            |axis: usize| self.low[axis] > other.high[axis] || other.low[axis] > self.high[axis];
        apart(0) || apart(1) || apart(2)
    }
}

/// The box of a point of a body, seen from its centre.
pub(super) fn corner(motion: &RigidMotion, local: &Point) -> Bounds {
    let [from, to] = [0.0, 1.0].map(|t| from_body(motion, t, &local.coords));
    let stray = 0.5 * quarter_tangent(motion) * (to - from).norm();
    Bounds::around(
        &from,
        &to,
        stray * 1.001 + ROUNDING * local.coords.amax() + TINY,
    )
}

/// More than what underflow takes.
const TINY: f64 = 1e-300;

/// The boxes of all corners of a core in a motion.
pub(super) struct CornerBoxes {
    pub(super) corners: Vec<Bounds>,
    /// Around all of them.
    pub(super) whole: Bounds,
}

impl CornerBoxes {
    pub(super) fn new(motion: &RigidMotion, vertices: &[Point]) -> Self {
        let corners: Vec<Bounds> = vertices.iter().map(|v| corner(motion, v)).collect();
        let whole = corners.iter().fold(Bounds::NOTHING, |a, b| a.joined(b));
        CornerBoxes { corners, whole }
    }

    /// The same, seen from the centre of another body.
    pub(super) fn seen_from(mut self, offset: &Bounds) -> Self {
        let all = self.corners.iter_mut().chain([&mut self.whole]);
        all.for_each(|bounds| *bounds = bounds.plus(offset));
        self
    }

    pub(super) fn of<const N: usize>(&self, corners: &[usize; N]) -> Bounds {
        let boxes = corners.map(|k| self.corners[k]);
        boxes[1..].iter().fold(boxes[0], |a, b| a.joined(b))
    }
}

/// The box in space of a box in the body's frame, given by two corners, in a motion.
pub(super) fn in_space(motion: &RigidMotion, [low, high]: &[Point; 2]) -> Bounds {
    let of = |i: usize| {
        let pick = |axis: usize| [low, high][i >> axis & 1][axis];
        corner(motion, &Point::new(pick(0), pick(1), pick(2)))
    };
    let around = (0..8).map(of).fold(Bounds::NOTHING, |a, b| a.joined(&b));
    let [from, to] = [motion.start(), motion.end()].map(|pose| pose.centre.coords);
    let size = from.amax().max(to.amax()) + around.low.amax().max(around.high.amax());
    Bounds {
        low: (from.inf(&to) + around.low).add_scalar(-ROUNDING * size),
        high: (from.sup(&to) + around.high).add_scalar(ROUNDING * size),
    }
}

/// The box of the way from the centre of a body to that of another one.
pub(super) fn offset(motion: &RigidMotion, to: &RigidMotion) -> Bounds {
    let ends = |end: fn(&RigidMotion) -> &Pose| end(to).centre - end(motion).centre;
    rounded_around(&ends(RigidMotion::start), &ends(RigidMotion::end))
}

/// Whether a point of a body stays well above the plane of a body that does not move.
pub(super) fn is_above(motion: &RigidMotion, local: &Point, plane: &RigidMotion) -> bool {
    if plane.start() != plane.end() {
        return false;
    }
    let up = from_body(plane, 0.0, &Vector::z());
    let way = corner(motion, local).plus(&offset(plane, motion));
    let size = way.low.amax().max(way.high.amax());
    let lowest = (0..3).map(|axis| (up[axis] * way.low[axis]).min(up[axis] * way.high[axis]));
    lowest.sum::<f64>() > 1e-9 * size
}

/// The boxes of both nodes of a segment, seen from the centre of the body.
pub(super) fn nodes(stage: &Stage) -> [Bounds; 2] {
    let [from, to] = [stage.motion.start(), stage.motion.end()].map(|pose| pose.centre);
    [0, 1].map(|node| rounded_around(&(stage.start[node] - from), &(stage.end[node] - to)))
}

/// A box around two differences of stored places, of which each is rounded once.
fn rounded_around(from: &Vector, to: &Vector) -> Bounds {
    let size = from.amax().max(to.amax());
    Bounds::around(from, to, ROUNDING * size + TINY)
}
