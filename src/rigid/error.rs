//! Why poses, points or a radius are not a query.

use std::fmt;

use super::kind::{Lengths, RigidQueryKind};
use super::motion::MOST_DEGREES;
use crate::query::{Point, QueryError, Radius};

/// Why poses or points are not a query.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RigidError {
    /// A coordinate of a centre is NaN or infinite.
    Centre {
        /// Whether it is that at the end of the step.
        at_end: bool,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A component of a quaternion is NaN or infinite.
    Quaternion {
        /// Whether it is that at the end of the step.
        at_end: bool,
        /// Which component, 0 to 3 for w, x, y, z.
        component: usize,
        /// The value refused.
        value: f64,
    },
    /// A quaternion is 0, which is no orientation.
    NoOrientation {
        /// Whether it is that at the end of the step.
        at_end: bool,
    },
    /// The body turns by more than [`MOST_DEGREES`]: the step has to be divided.
    TurnsTooFar {
        /// By how much, rounded.
        degrees: f64,
    },
    /// A coordinate of a point in space is NaN or infinite.
    World {
        /// Which of the four points, 0 to 3 for A to D.
        point: usize,
        /// Whether it is the position at the end of the step.
        at_end: bool,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A coordinate of a point in the body's frame is NaN or infinite.
    Local {
        /// Which of the four points, 0 to 3 for A to D.
        point: usize,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A radius is NaN, infinite or negative.
    Radius(Radius),
    /// There is no kind of query of so many points.
    NumberOfPoints {
        /// Those of the first side, at one time.
        first: usize,
        /// Those of the second side.
        second: usize,
    },
    /// Lists of points and poses do not have the lengths of this kind.
    Lengths {
        /// The kind.
        kind: RigidQueryKind,
        /// How long they are.
        lengths: Lengths,
    },
    /// The second side is not one of a body: it has to be the one that turns.
    SecondSide,
}

pub(super) fn first_not_finite(point: &Point) -> Option<(usize, f64)> {
    let axis = point.iter().position(|value| !value.is_finite())?;
    Some((axis, point[axis]))
}

impl fmt::Display for RigidError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axis = |axis: usize| ['x', 'y', 'z'][axis];
        let point = |point: usize| ['A', 'B', 'C', 'D'][point];
        match *self {
            RigidError::Centre {
                at_end,
                axis: a,
                value,
            } => {
                let (a, time) = (axis(a), u8::from(at_end));
                write!(
                    f,
                    "{a} of the centre at t = {time} is {value}, not a finite number"
                )
            }
            RigidError::Quaternion {
                at_end,
                component,
                value,
            } => {
                let (name, time) = (['w', 'x', 'y', 'z'][component], u8::from(at_end));
                write!(
                    f,
                    "{name} of the quaternion at t = {time} is {value}, not a finite number"
                )
            }
            RigidError::NoOrientation { at_end } => {
                let time = u8::from(at_end);
                write!(f, "the quaternion at t = {time} is 0; it needs a length")
            }
            RigidError::TurnsTooFar { degrees } => {
                // All digits where fewer would read as if it were permitted.
                let angle = match degrees - MOST_DEGREES > 1e-3 {
                    true => format!("{degrees:.3}"),
                    false => degrees.to_string(),
                };
                write!(
                    f,
                    "the body turns by {angle} degrees in the step; divide the step so that it \
                     turns by at most {MOST_DEGREES}"
                )
            }
            RigidError::World {
                point: p,
                at_end,
                axis: a,
                value,
            } => {
                let (a, p, time) = (axis(a), point(p), u8::from(at_end));
                write!(
                    f,
                    "{a} of point {p} at t = {time} is {value}, not a finite number"
                )
            }
            RigidError::Local {
                point: p,
                axis: a,
                value,
            } => {
                let (a, p) = (axis(a), point(p));
                write!(
                    f,
                    "{a} of point {p} in the body's frame is {value}, not a finite number"
                )
            }
            RigidError::Radius(radius) => QueryError::Radius(radius).fmt(f),
            RigidError::NumberOfPoints { first, second } => write!(
                f,
                "there is no query of {first} and {second} points; two edges have 2 and 2, a \
                 vertex and a face 1 and 3"
            ),
            RigidError::Lengths { kind, lengths } => {
                let said = |lengths: Lengths| {
                    let Lengths {
                        points,
                        local,
                        poses,
                    } = lengths;
                    format!("{points} points in space, {local} of bodies and {poses} poses")
                };
                let (given, due) = (said(lengths), said(kind.lengths()));
                write!(f, "there are {given}; {kind} has {due}")
            }
            RigidError::SecondSide => write!(f, "the second side has to be of a body that turns"),
        }
    }
}

impl std::error::Error for RigidError {}
