//! Vectors at the time of impact, in `f64` with a bound of their error.
//!
//! Let `e = 2^-53`. Bounds are for the Euclidean length of the error and are made of sizes, which
//! are sums of magnitudes of components and so at least the Euclidean length. A few operations on
//! bounds themselves, each off by `e` of its result, are covered by constants that are larger than
//! need be by some `e`.
//!
//! Coordinates are first multiplied by a power of two, so that the largest is in `[1/4, 1/2)`. That
//! rounds only what becomes subnormal, by less than 2^-1074; as products do that underflow. A
//! vector is accepted only if it is longer than 2^-900, so that a few of these, times factors of at
//! most 2^10, are below 2^-100 of it.

use nalgebra::Vector3;

use super::{At, Normal, Vector, WORST, cross, sub};

/// `2^-53`.
const E: f64 = 0.5 * f64::EPSILON;

/// `2^-900`.
const SHORTEST: f64 = f64::from_bits((1023 - 900) << 52);

/// The positions at both ends of a step, scaled, and the time of impact.
pub(super) struct Step {
    start: [Vector; 4],
    end: [Vector; 4],
    toi: f64,
    /// No less than the exact time is above `toi`.
    late: f64,
}

/// A vector, computed.
#[derive(Clone, Copy, Debug)]
pub(in crate::certified) struct Bounded {
    value: Vector,
    /// At least the sum of its components' magnitudes, up to a relative error of a few `e`.
    size: f64,
    /// The exact vector is at most this far from `value`.
    error: f64,
}

impl Step {
    /// `None` if all coordinates are 0.
    pub(super) fn new(start: &[Vector; 4], end: &[Vector; 4], at: &At) -> Option<Self> {
        let all = start.iter().chain(end).flatten();
        let largest = all.fold(0.0f64, |largest, x| largest.max(x.abs()));
        let factors = scale(largest)?;
        let scaled = |points: &[Vector; 4]| {
            points.map(|point| point.map(|x| factors.iter().fold(x, |x, factor| x * factor)))
        };
        Some(Step {
            start: scaled(start),
            end: scaled(end),
            toi: at.toi,
            late: at.toi_above - at.toi,
        })
    }

    /// From one point to another at the time of impact: `(1 - t) x + t y` for the differences `x`
    /// and `y` at the start and at the end.
    ///
    /// `x`, `1 - t`, their product and the sum have a relative error of `e` each, `4 e` of the size
    /// and a little. Over `late` the vector changes by at most `|y - x| late`.
    pub(super) fn difference(&self, from: usize, to: usize) -> Bounded {
        let x = sub(&self.start[to], &self.start[from]);
        let y = sub(&self.end[to], &self.end[from]);
        let (t, rest) = (self.toi, 1.0 - self.toi);
        let (first, last) = (sum(&x), sum(&y));
        let size = rest * first + t * last;
        Bounded {
            value: [0, 1, 2].map(|i: usize| rest * x[i] + t * y[i]),
            size,
            error: 5.0 * E * size + self.late * ((first + last) * (1.0 + 8.0 * E)),
        }
    }
}

impl Bounded {
    /// A vector from its components and bounds on their errors, of which the sum is at least the
    /// Euclidean length.
    pub(in crate::certified) fn of(components: [(f64, f64); 3]) -> Self {
        let [a, b, c] = components.map(|(_, error)| error);
        let value = components.map(|(value, _)| value);
        Bounded {
            value,
            size: sum(&value),
            error: (a + b + c) * (1.0 + 16.0 * E),
        }
    }

    /// `factor self` for a factor in `[0, 1]` that is off by at most `inexact`.
    pub(super) fn times(&self, factor: f64, inexact: f64) -> Bounded {
        let off = inexact * (self.size + self.error);
        Bounded {
            value: self.value.map(|x| factor * x),
            size: factor * self.size,
            error: (factor * self.error + off) * (1.0 + 16.0 * E) + 2.0 * E * factor * self.size,
        }
    }

    pub(super) fn plus(&self, other: &Bounded) -> Bounded {
        self.combined(other, |x, y| x + y)
    }

    pub(super) fn minus(&self, other: &Bounded) -> Bounded {
        self.combined(other, |x, y| x - y)
    }

    fn combined(&self, other: &Bounded, combine: impl Fn(f64, f64) -> f64) -> Bounded {
        let size = self.size + other.size;
        Bounded {
            value: [0, 1, 2].map(|i: usize| combine(self.value[i], other.value[i])),
            size,
            error: (self.error + other.error) * (1.0 + 16.0 * E) + 2.0 * E * size,
        }
    }

    /// The cross product. Of exact `x`, `y` with errors `a`, `b` it is off by `a |y| + |x| b + a
    /// b`. Its own two products and difference are off by `2 e` of the sum of the products'
    /// magnitudes; over the components these are some of the products of which both sizes' product
    /// is the sum.
    pub(super) fn cross(&self, other: &Bounded) -> Bounded {
        let size = self.size * other.size;
        let inexact = self.error * other.size + other.error * self.size;
        Bounded {
            value: cross(&self.value, &other.value),
            size,
            error: (inexact + self.error * other.error) * (1.0 + 16.0 * E) + 3.0 * E * size,
        }
    }

    /// Times 1 or -1.
    pub(in crate::certified) fn directed(&self, sign: f64) -> Bounded {
        Bounded {
            value: self.value.map(|x| sign * x),
            ..*self
        }
    }

    /// Its direction, if it is known well.
    ///
    /// The directions of `x` and `y` are at most `2 |x - y| / (|x| + |y|)` apart, which is `d / (1
    /// - d / 2)` for `d = |x - y| / |x|` at most. Computing `x / |x|`, after a division by the
    /// largest component, adds below `5 e`.
    pub(super) fn normal(&self) -> Option<Normal> {
        let largest = self.value.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if !(largest > SHORTEST && largest.is_finite()) {
            return None;
        }
        let scaled = Vector3::from(self.value) / largest;
        let length = scaled.norm();
        let relative = self.error / largest / length;
        // False for NaN as well.
        let is_known = relative <= 0.5 * WORST;
        is_known.then(|| Normal {
            direction: scaled / length,
            error: relative * (1.0 + WORST) + 8.0 * E,
        })
    }
}

fn sum(x: &Vector) -> f64 {
    x[0].abs() + x[1].abs() + x[2].abs()
}

/// Powers of two, one after the other, that bring the largest coordinate into `[1/4, 1/2)`; `None`
/// if it is 0.
fn scale(largest: f64) -> Option<[f64; 2]> {
    if largest == 0.0 {
        return None;
    }
    // A subnormal number is made normal first.
    let (first, normal) = match largest < f64::MIN_POSITIVE {
        true => (TWO_64, largest * TWO_64),
        false => (1.0, largest),
    };
    let biased = normal.to_bits() >> 52;
    // 2^(1021 - biased), in two steps where it is beyond the normal numbers.
    let exponent = 1021 - biased as i64;
    let half = exponent / 2;
    Some([first * power(half), power(exponent - half)])
}

/// `2^64`.
const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// `2^exponent`, in the range of normal numbers.
fn power(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}
