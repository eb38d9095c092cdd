//! Places of two bodies in exact integers.
//!
//! A point `x` of a body at `c`, turned by `q`, is at `(|q|^2 c + M(q) x) / |q|^2`. Of two bodies all
//! places are taken times both squared lengths and a power of two: integers, and signs of volumes are
//! the same.

use num_bigint::{BigInt, Sign};
use tunnelproof::query::Point;
use tunnelproof::rigid::Pose;

/// A point or a vector, times a number above 0.
pub(super) type Exact = [BigInt; 3];

/// The sign of the volume between four points.
pub(super) fn volume(x: &Exact, y: &Exact, z: &Exact, w: &Exact) -> Sign {
    let [a, b, c] = [y, z, w].map(|to| -> Exact { std::array::from_fn(|k| &to[k] - &x[k]) });
    dot(&cross(&a, &b), &c).sign()
}

/// Two bodies in integers.
pub(super) struct Space {
    /// w, x, y, z of each, and the square of its length.
    quaternions: [([BigInt; 4], BigInt); 2],
    centres: [Exact; 2],
    /// The power of two by which coordinates are multiplied.
    exponent: i32,
}

impl Space {
    /// For these points of both. None of numbers that are not finite.
    pub(super) fn new(poses: [&Pose; 2], points: &[&[Point]; 2]) -> Option<Self> {
        let centres = poses.map(|pose| pose.centre);
        let all = points
            .iter()
            .flat_map(|points| points.iter())
            .chain(&centres);
        let coordinates: Vec<f64> = all.flat_map(|point| [point.x, point.y, point.z]).collect();
        let exponent = common_exponent(&coordinates)?;
        let of = |pose: &Pose| {
            let q = [
                pose.quaternion.w,
                pose.quaternion.i,
                pose.quaternion.j,
                pose.quaternion.k,
            ];
            let exponent = common_exponent(&q)?;
            let q = q.map(|x| integer(x, exponent));
            let square = q.iter().map(|x| x * x).sum();
            Some((q, square))
        };
        Some(Space {
            quaternions: [of(poses[0])?, of(poses[1])?],
            centres: centres.map(|centre| exact(&centre, exponent)),
            exponent,
        })
    }

    /// Where a point of a body is, times what all places are taken times.
    pub(super) fn place(&self, body: usize, point: &Point) -> Exact {
        let (q, square) = &self.quaternions[body];
        let other = &self.quaternions[1 - body].1;
        let x = exact(point, self.exponent);
        let [w, i, j, k] = q;
        let v = [i.clone(), j.clone(), k.clone()];
        // |q|^2 R x = |q|^2 x + 2 (w (v x x) + v x (v x x)).
        let across = cross(&v, &x);
        let twice = cross(&v, &across);
        let centre = &self.centres[body];
        std::array::from_fn(|k| {
            let straight = square * (&x[k] + &centre[k]);
            other * (straight + (w * &across[k] + &twice[k]) * 2)
        })
    }
}

/// A power of two times which all of some numbers are integers. None if one is not finite.
fn common_exponent(numbers: &[f64]) -> Option<i32> {
    let exponent = |x: &f64| {
        let biased = (x.to_bits() >> 52 & 0x7ff) as i32;
        // Of 0 as well.
        1075 - biased.max(1)
    };
    let is_finite = numbers.iter().all(|x| x.is_finite());
    let not_zero = numbers.iter().filter(|x| **x != 0.0);
    is_finite.then(|| not_zero.map(exponent).max().unwrap_or(0))
}

/// `x` times a power of two with which it is an integer.
fn integer(x: f64, exponent: i32) -> BigInt {
    let biased = (x.to_bits() >> 52 & 0x7ff) as i32;
    let fraction = x.to_bits() & ((1 << 52) - 1);
    let mantissa = if biased > 0 {
        fraction | 1 << 52
    } else {
        fraction
    };
    let magnitude = BigInt::from(mantissa) << (exponent - 1075 + biased.max(1)).max(0);
    if x < 0.0 { -magnitude } else { magnitude }
}

fn exact(point: &Point, exponent: i32) -> Exact {
    [point.x, point.y, point.z].map(|x| integer(x, exponent))
}

fn cross(a: &Exact, b: &Exact) -> Exact {
    std::array::from_fn(|k| {
        let (l, m) = ((k + 1) % 3, (k + 2) % 3);
        &a[l] * &b[m] - &a[m] * &b[l]
    })
}

fn dot(a: &Exact, b: &Exact) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}
