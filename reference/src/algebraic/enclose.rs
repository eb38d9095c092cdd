//! Exact numbers rounded down and up to `f64`, and the narrowing of intervals by an `f64` guess.

use std::cmp::Ordering;

use crate::answer::Enclosure;
use crate::field::Integer;
use crate::poly::Poly;

use super::{Algebraic, Interval};

/// How narrow an interval is before numbers are rounded: by so much narrower than an ulp of `f64`
/// that hardly ever one lies inside.
const BITS_OF_ENCLOSURES: u64 = 80;

impl<Z: Integer> Algebraic<Z> {
    /// The number between its neighbours in `f64`.
    pub fn enclosure(&self) -> Enclosure {
        self.narrow_to_f64();
        self.refine(BITS_OF_ENCLOSURES);
        loop {
            let (low, high, exponent) = self.bounds();
            let below = round_down(&low, exponent);
            if low == high {
                let above = if is_f64(&low, exponent, below) {
                    below
                } else {
                    below.next_up()
                };
                return Enclosure { below, above };
            }
            let above = round_up(&high, exponent);
            match between(below, above) {
                Some(cut) => self.split_at_f64(cut),
                None => return Enclosure { below, above },
            }
        }
    }

    /// `numerator / denominator` at the number, between its neighbours in `f64`. The value must lie
    /// in `[0, 1]` and the denominator must not be 0 there.
    pub fn enclose_quotient(&self, numerator: &Poly<Z>, denominator: &Poly<Z>) -> Enclosure {
        let flip = self.sign_of(denominator).is_lt();
        let (mut below, mut above) = self.guess_quotient(numerator, denominator);
        // The sign of the value minus c: that of numerator - c denominator, if the denominator is
        // above 0.
        let versus = |c: f64| {
            let (cut, exponent) = dyadic::<Z>(c);
            let mut difference = numerator.scale(&Z::one().shl(exponent));
            difference.sub_product(&Poly::constant(cut), denominator);
            match self.sign_of(&difference) {
                sign if flip => sign.reverse(),
                sign => sign,
            }
        };
        while let Some(cut) = between(below, above) {
            match versus(cut) {
                Ordering::Less => above = cut,
                Ordering::Equal => return Enclosure::exactly(cut),
                Ordering::Greater => below = cut,
            }
        }
        if below == 0.0 && versus(0.0).is_eq() {
            return Enclosure::exactly(0.0);
        }
        if above == 1.0 && versus(1.0).is_eq() {
            return Enclosure::exactly(1.0);
        }
        Enclosure { below, above }
    }

    /// Bounds in `[0, 1]` of a quotient that lies there. It is strictly between them, but where
    /// they are 0 and 1.
    fn guess_quotient(&self, numerator: &Poly<Z>, denominator: &Poly<Z>) -> (f64, f64) {
        self.refine(BITS_OF_ENCLOSURES);
        let interval = self.interval.borrow();
        let mut n = interval.range_of(numerator);
        let mut d = interval.range_of(denominator);
        if d.1.sign().is_lt() {
            (n, d) = ((n.1.neg(), n.0.neg()), (d.1.neg(), d.0.neg()));
        }
        if n.0.sign().is_lt() || !d.0.sign().is_gt() {
            return (0.0, 1.0);
        }
        // Both ranges are scaled by 2^(exponent degree).
        let (n_degree, d_degree) = (numerator.degree() as u64, denominator.degree() as u64);
        let n_scale = interval.exponent * d_degree.saturating_sub(n_degree);
        let d_scale = interval.exponent * n_degree.saturating_sub(d_degree);
        // The quotient has about 64 bits over 2^shift, so that one unit more or less hardly
        // matters.
        let fraction = |n: &Z, d: &Z| {
            let d = d.shl(d_scale);
            let shift = (d.bits() + 64).saturating_sub(n.bits() + n_scale);
            (n.shl(n_scale + shift).div_floor(&d), shift)
        };
        let (low, shift) = fraction(&n.0, &d.1);
        let below = if low.is_zero() {
            0.0
        } else {
            round_down(&low.sub(&Z::one()), shift)
        };
        let (high, shift) = fraction(&n.1, &d.0);
        let above = round_up(&high.add(&Z::one()), shift);
        (below, above.min(1.0))
    }

    /// Narrows the interval to about an `f64` ulp: a root in floating point is a guess, and exact
    /// signs around it make it a proof. A bad guess costs time only.
    pub(super) fn narrow_to_f64(&self) {
        let mut interval = self.interval.borrow_mut();
        if interval.is_point() {
            return;
        }
        let below = round_down(&interval.low, interval.exponent);
        let above = round_up(&interval.high, interval.exponent);
        let Some(_) = between(below, above) else {
            return;
        };
        let before = self
            .poly
            .evaluate_dyadic(&interval.low, interval.exponent)
            .sign();
        let (guess, error) = guess_root(&self.poly, below, above, before);
        cut_at_f64(&mut interval, &self.poly, guess, before);
        let root_is_above = round_down(&interval.low, interval.exponent) >= guess;
        let mut step = error.max(guess.next_up() - guess);
        while !interval.is_point() {
            let cut = if root_is_above {
                guess + step
            } else {
                guess - step
            };
            if cut <= below || cut >= above {
                break;
            }
            cut_at_f64(&mut interval, &self.poly, cut, before);
            let passed = if root_is_above {
                round_up(&interval.high, interval.exponent) <= cut
            } else {
                round_down(&interval.low, interval.exponent) >= cut
            };
            if passed {
                break;
            }
            step *= 8.0;
        }
        interval.expect_quadratic();
    }

    fn split_at_f64(&self, cut: f64) {
        let mut interval = self.interval.borrow_mut();
        let before = self
            .poly
            .evaluate_dyadic(&interval.low, interval.exponent)
            .sign();
        cut_at_f64(&mut interval, &self.poly, cut, before);
    }
}

fn cut_at_f64<Z: Integer>(interval: &mut Interval<Z>, poly: &Poly<Z>, cut: f64, before: Ordering) {
    let (numerator, exponent) = dyadic::<Z>(cut);
    interval.widen_exponent(exponent);
    let numerator = numerator.shl(interval.exponent - exponent);
    interval.split_at(poly, numerator, before);
    interval.reduce();
}

/// A root of `poly` between `below` and `above` in floating point and how far off it may be:
/// bisection and Newton steps. `before` is the sign of `poly` at the low end. Only a guess.
fn guess_root<Z: Integer>(poly: &Poly<Z>, below: f64, above: f64, before: Ordering) -> (f64, f64) {
    let coefficients = scaled_coefficients(poly);
    let evaluate = |t: f64| {
        let (mut value, mut slope, mut size) = (0.0, 0.0, 0.0);
        for &c in coefficients.iter().rev() {
            slope = slope * t + value;
            value = value * t + c;
            size = size * t + c.abs();
        }
        (value, slope, size)
    };
    let (mut low, mut high) = (below, above);
    let mut t = 0.5 * (low + high);
    let mut error = 0.0;
    for _ in 0..60 {
        let (value, slope, size) = evaluate(t);
        if (value < 0.0) == before.is_lt() {
            low = t
        } else {
            high = t
        }
        let newton = t - value / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        error = 4.0 * f64::EPSILON * size / slope.abs();
        if (next - t).abs() <= 2.0 * f64::EPSILON * t {
            break;
        }
        t = next;
    }
    let error = if error.is_finite() { error } else { 0.0 };
    (t.clamp(below, above), error)
}

/// The coefficients divided by one power of two such that none overflows.
fn scaled_coefficients<Z: Integer>(poly: &Poly<Z>) -> Vec<f64> {
    let parts: Vec<(f64, i64)> = poly.coefficients().iter().map(Z::approximate).collect();
    let top = parts
        .iter()
        .filter(|part| part.0 != 0.0)
        .map(|part| part.1)
        .max()
        .unwrap_or(0);
    parts
        .iter()
        .map(|&(m, e)| m * 2f64.powi((e - top).max(-1100) as i32))
        .collect()
}

/// An `f64` strictly between two others, about in the middle of the `f64`s between them; `None` if
/// there is none. Both are at least 0.
fn between(below: f64, above: f64) -> Option<f64> {
    let (low, high) = (below.to_bits(), above.to_bits());
    (high > low + 1).then(|| f64::from_bits(low + (high - low) / 2))
}

/// A finite `f64` as `numerator / 2^exponent`.
pub(crate) fn dyadic<Z: Integer>(value: f64) -> (Z, u64) {
    let (mantissa, exponent) = decompose(value);
    let numerator = Z::from_i64(mantissa);
    match exponent {
        0.. => (numerator.shl(exponent.unsigned_abs()), 0),
        _ => (numerator, exponent.unsigned_abs()),
    }
}

/// A finite `f64` as `mantissa 2^exponent`, the mantissa odd or 0.
pub(crate) fn decompose(value: f64) -> (i64, i64) {
    let bits = value.to_bits();
    let biased = (bits >> 52 & 0x7ff) as i64;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (magnitude, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    };
    if magnitude == 0 {
        return (0, 0);
    }
    let zeros = i64::from(magnitude.trailing_zeros());
    let magnitude = magnitude >> zeros;
    (
        if value < 0.0 { -magnitude } else { magnitude },
        exponent + zeros,
    )
}

/// The largest `f64` not above `numerator / 2^exponent`, which is at least 0.
fn round_down<Z: Integer>(numerator: &Z, exponent: u64) -> f64 {
    let bits = i64::try_from(numerator.bits()).unwrap_or(i64::MAX);
    let exponent = i64::try_from(exponent).unwrap_or(i64::MAX);
    // The unit in the last place of the result, not below that of the subnormals.
    let unit = (bits - 53 - exponent).max(-1074);
    let drop = unit + exponent;
    let mantissa = if drop >= 0 {
        numerator.shr_floor(drop.unsigned_abs())
    } else {
        numerator.shl(drop.unsigned_abs())
    };
    let mantissa = mantissa.to_i64().unwrap_or(0) as f64;
    // Two factors, because a subnormal power of two and its cofactor each must be an f64.
    let half = unit / 2;
    mantissa * 2f64.powi(half as i32) * 2f64.powi((unit - half) as i32)
}

/// The smallest `f64` not below `numerator / 2^exponent`, which is at least 0.
fn round_up<Z: Integer>(numerator: &Z, exponent: u64) -> f64 {
    let below = round_down(numerator, exponent);
    if is_f64(numerator, exponent, below) {
        below
    } else {
        below.next_up()
    }
}

fn is_f64<Z: Integer>(numerator: &Z, exponent: u64, value: f64) -> bool {
    let (n, e) = dyadic::<Z>(value);
    numerator.shl(e) == n.shl(exponent)
}
