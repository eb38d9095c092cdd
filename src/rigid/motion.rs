//! Where a body is, and how it moves.

use nalgebra::{Quaternion, Vector3};

use super::error::{RigidError, first_not_finite};
use crate::query::Point;

/// Where a body is: its centre, and a quaternion that turns its frame into space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The origin of the body's frame, in metres.
    pub centre: Point,
    /// A quaternion of any length but 0; it is taken as it is stored, exactly.
    pub quaternion: Quaternion<f64>,
}

/// The motion of a body from one pose to another, by at most 90 degrees.
///
/// Both `q` and `-q` are the same orientation: of the two, that is taken for the end which is
/// nearer to the start.
///
/// # The clock
///
/// If the quaternions have the same length, the turn is half done at `t = 1/2`, and at other times
/// it is off a uniform turn by at most 0.034 degrees where the whole turn is 30 degrees, 0.27 at 60
/// and 0.92 at 90. If one is longer, the body turns faster at the other end of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    start: Pose,
    end: Pose,
    /// The sign that the quaternion at the end is taken with.
    sign: f64,
}

/// The largest turn of a step, in degrees. Turns within 1e-12 of it may be taken or refused.
pub const MOST_DEGREES: f64 = 90.0;

/// Below the cosine of half the largest turn by more than any rounding of it.
const LEAST_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2 - 4e-15;

impl Pose {
    /// The pose with this centre, in metres, and this quaternion.
    pub fn new(centre: Point, quaternion: Quaternion<f64>) -> Self {
        Pose { centre, quaternion }
    }

    /// Checks all numbers; returns the quaternion times a power of two, its largest component
    /// between 1 and 2.
    fn check(&self, at_end: bool) -> Result<[f64; 4], RigidError> {
        if let Some((axis, value)) = first_not_finite(&self.centre) {
            return Err(RigidError::Centre {
                at_end,
                axis,
                value,
            });
        }
        let components = components(&self.quaternion);
        if let Some(component) = components.iter().position(|value| !value.is_finite()) {
            return Err(RigidError::Quaternion {
                at_end,
                component,
                value: components[component],
            });
        }
        scaled(components).ok_or(RigidError::NoOrientation { at_end })
    }
}

impl RigidMotion {
    /// The motion from one pose to another.
    ///
    /// # Errors
    ///
    /// [`RigidError`] names the first number that is NaN or infinite, a quaternion that is 0, or a
    /// turn by more than [`MOST_DEGREES`].
    pub fn new(start: Pose, end: Pose) -> Result<Self, RigidError> {
        let (q0, q1) = (start.check(false)?, end.check(true)?);
        let along = product(&q0, &q1);
        let cosine = along.abs() / (product(&q0, &q0) * product(&q1, &q1)).sqrt();
        if cosine < LEAST_COSINE {
            let degrees = degrees(cosine);
            return Err(RigidError::TurnsTooFar { degrees });
        }
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        Ok(RigidMotion { start, end, sign })
    }

    /// The pose at `t = 0`.
    pub fn start(&self) -> &Pose {
        &self.start
    }

    /// The pose at `t = 1`.
    pub fn end(&self) -> &Pose {
        &self.end
    }

    /// The quaternions between which the motion is, each as w, x, y, z: that of the start, and that
    /// of the end with the sign that makes it the nearer one.
    pub fn quaternions(&self) -> [[f64; 4]; 2] {
        let end = components(&self.end.quaternion);
        [
            components(&self.start.quaternion),
            end.map(|component| self.sign * component),
        ]
    }

    /// The angle of the whole turn in degrees, rounded.
    pub fn degrees(&self) -> f64 {
        let [q0, q1] = self.quaternions().map(|q| scaled(q).unwrap_or(q));
        let lengths = product(&q0, &q0) * product(&q1, &q1);
        degrees(product(&q0, &q1) / lengths.sqrt())
    }

    /// Where a point of the body's frame is in space at a time in `[0, 1]`, rounded.
    pub fn position(&self, local: &Point, t: f64) -> Point {
        let [q0, q1] = self.quaternions();
        let q: [f64; 4] = std::array::from_fn(|i| (1.0 - t) * q0[i] + t * q1[i]);
        // It is 0 only where it is below every number that is not.
        let q = scaled(q).or_else(|| scaled(q0)).unwrap_or(q0);
        let (w, v) = (q[0], Vector3::new(q[1], q[2], q[3]));
        let turn = v.cross(&local.coords) * 2.0;
        let turned = local.coords + (turn * w + v.cross(&turn)) / (w * w + v.dot(&v));
        let centre = self.start.centre.coords * (1.0 - t) + self.end.centre.coords * t;
        Point::from(centre + turned)
    }
}

/// w, x, y, z.
fn components(q: &Quaternion<f64>) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

fn product(x: &[f64; 4], y: &[f64; 4]) -> f64 {
    (0..4).map(|i| x[i] * y[i]).sum()
}

/// The turn between two quaternions, from the cosine of the angle between them.
fn degrees(cosine: f64) -> f64 {
    2.0 * cosine.min(1.0).acos().to_degrees()
}

fn largest(q: &[f64; 4]) -> f64 {
    q.iter().fold(0.0, |a, b| a.max(b.abs()))
}

/// Times a power of two, the largest component between 1 and 2; what is tiny beside it may
/// underflow. `None` of 0.
fn scaled(q: [f64; 4]) -> Option<[f64; 4]> {
    let mut q = q;
    let mut size = largest(&q);
    if size == 0.0 {
        return None;
    }
    if size < f64::MIN_POSITIVE {
        q = q.map(|x| x * SUBNORMAL);
        size *= SUBNORMAL;
    }
    // Powers of two from 2^-1022 to 2^1023; halves of both factors are representable.
    let exponent = (size.to_bits() >> 52) as i32 - 1023;
    let power = |exponent: i32| f64::from_bits(((1023 + exponent) as u64) << 52);
    let (first, second) = (exponent / 2, exponent - exponent / 2);
    Some(q.map(|x| x * power(-first) * power(-second)))
}

/// 2^60: times it, a subnormal number is a normal one.
const SUBNORMAL: f64 = (1u64 << 60) as f64;
