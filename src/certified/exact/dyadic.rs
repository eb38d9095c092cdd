//! Numbers `m / 2^s`: the `f64`s of `[0, 1]` and what lies between them.

use std::cmp::Ordering;

use super::integer::Integer;

/// `numerator / 2^exponent`, in `[0, 1]`.
#[derive(Clone, Debug)]
pub(super) struct Dyadic {
    pub(super) numerator: Integer,
    pub(super) exponent: u64,
}

impl Dyadic {
    /// `numerator / 2^exponent`.
    pub(super) fn new(numerator: Integer, exponent: u64) -> Self {
        Dyadic {
            numerator,
            exponent,
        }
    }

    /// 0.
    pub(super) fn zero() -> Self {
        Dyadic::new(Integer::default(), 0)
    }

    /// 1.
    pub(super) fn one() -> Self {
        Dyadic::new(Integer::from(1), 0)
    }

    /// The value of an `f64` in `[0, 1]`.
    pub(super) fn from_f64(value: f64) -> Self {
        let (mantissa, exponent) = decompose(value);
        debug_assert!((0.0..=1.0).contains(&value) && exponent <= 0);
        Dyadic::new(
            Integer::from(i128::from(mantissa)),
            exponent.unsigned_abs().into(),
        )
    }

    /// The largest `f64` that is not above the number.
    pub(super) fn below(&self) -> f64 {
        self.floor().0
    }

    /// The smallest `f64` that is not below the number.
    pub(super) fn above(&self) -> f64 {
        let (below, is_exact) = self.floor();
        if is_exact { below } else { below.next_up() }
    }

    /// The largest `f64` that is not above the number, and whether it is the number.
    fn floor(&self) -> (f64, bool) {
        let own = self.exponent as i64;
        // The unit in the last place of the result, not below that of the subnormals.
        let unit = (self.numerator.bits() as i64 - 53 - own).max(-1074);
        let dropped = unit + own;
        if dropped <= 0 {
            // At most 53 bits, and none of them below the unit.
            let (mantissa, _) = self.numerator.window(0);
            return (compose(mantissa << dropped.unsigned_abs(), unit), true);
        }
        let (mantissa, is_exact) = self.numerator.window(dropped.unsigned_abs());
        (compose(mantissa, unit), is_exact)
    }

    /// `self` compared with `other`.
    pub(super) fn compare(&self, other: &Dyadic) -> Ordering {
        let common = self.exponent.max(other.exponent);
        let own = self.numerator.shifted(common - self.exponent);
        own.cmp(&other.numerator.shifted(common - other.exponent))
    }
}

/// `mantissa 2^exponent` for a mantissa of 53 bits, or less if the exponent is -1074 or it is 0: in
/// integers, and so the same in any floating-point environment.
fn compose(mantissa: u64, exponent: i64) -> f64 {
    if mantissa == 0 {
        return 0.0;
    }
    // The lowest bit of the biased exponent is the implicit one of the mantissa.
    let biased = (exponent + 1074) as u64;
    f64::from_bits((biased << 52) + mantissa)
}

/// A finite `f64` as `mantissa 2^exponent`, the mantissa below `2^53`.
#[inline]
pub(super) fn parts(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let biased = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let implicit = i64::from(biased != 0) << 52;
    let magnitude = fraction | implicit;
    let mantissa = if value < 0.0 { -magnitude } else { magnitude };
    (mantissa, biased.max(1) - 1075)
}

/// A finite `f64` as `mantissa 2^exponent`, the mantissa odd; or 0 and 0.
pub(super) fn decompose(value: f64) -> (i64, i32) {
    let (mantissa, exponent) = parts(value);
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    (mantissa >> zeros, exponent + zeros as i32)
}

#[cfg(test)]
pub(super) mod tests;
