//! Signs of polynomials in floating point, where a proved error bound leaves no doubt.

use std::cmp::Ordering;

use crate::field::Integer;
use crate::poly::Poly;

/// A polynomial in floating point.
pub(super) struct FloatPoly {
    /// Ascending, all multiplied by one power of two, the largest in `[2^63, 2^64]`. The relative
    /// error is at most `2^-52`, or the absolute one at most `2^-958`.
    coefficients: Vec<f64>,
}

/// More than everything that underflow can add up to, for every degree below `2^20`.
const UNDERFLOW: f64 = power_of_two(-900);

impl FloatPoly {
    /// A multiple of `poly`, above 0.
    pub(super) fn multiple_of<Z: Integer>(poly: &Poly<Z>) -> Self {
        let parts = || poly.coefficients().iter().map(Z::approximate);
        let exponents = parts().filter(|part| part.0 != 0.0).map(|part| part.1);
        let top = exponents.max().unwrap_or(0);
        let scaled = |(mantissa, exponent): (f64, i64)| mantissa * power_of_two(exponent - top);
        FloatPoly {
            coefficients: parts().map(scaled).collect(),
        }
    }

    /// The coefficients, the one of the highest power first.
    pub(super) fn descending(&self) -> impl Iterator<Item = f64> {
        self.coefficients.iter().rev().copied()
    }

    /// The sign of the exact polynomial on the whole interval from `low` to `high`, within `[0, 1]`,
    /// if it is certain: never `Equal`.
    ///
    /// By Horner's rule at `h = high`. With `n` the degree, `S` the sum of `|c_k| h^k` and `u = 2^-53`
    /// the value is off by at most `2 n u S / (1 - 2 n u)` for rounding (Higham 2002, Accuracy and
    /// Stability of Numerical Algorithms, 5.1) and by `2 u S` for the coefficients; elsewhere in the
    /// interval the polynomial differs from it by at most `high - low` times the sum of
    /// `k |c_k| h^(k - 1)`. Twice the sum of all makes up for the rounding of the bound itself.
    pub(super) fn sign_between(&self, low: f64, high: f64) -> Option<Ordering> {
        let (mut value, mut slope, mut size) = (0.0, 0.0, 0.0);
        for c in self.descending() {
            slope = slope * high + size;
            value = value * high + c;
            size = size * high + c.abs();
        }
        let rounding = (self.coefficients.len() + 3) as f64 * f64::EPSILON * size;
        let error_bound = 2.0 * (slope * (high - low) + rounding) + UNDERFLOW;
        if value > error_bound {
            Some(Ordering::Greater)
        } else if value < -error_bound {
            Some(Ordering::Less)
        } else {
            None
        }
    }
}

/// `2^exponent` for an exponent of at most 1023; 0 below the normal numbers.
const fn power_of_two(exponent: i64) -> f64 {
    if exponent < -1022 {
        0.0
    } else {
        f64::from_bits(((exponent + 1023) as u64) << 52)
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use proptest::prelude::*;

    use super::*;
    use crate::algebraic::enclose::dyadic;

    /// The product of lines, each 0 within some ulps of `at` or at a few times that, over
    /// `2^shift`, plus a constant: what is hard to tell from 0.
    fn nearly_zero(at: f64, factors: &[(i64, u64)], constant: i64, shift: u64) -> Poly<BigInt> {
        let (numerator, exponent) = dyadic::<BigInt>(at);
        let line = |&(ulps, times): &(i64, u64)| {
            let root = (&numerator << 3) * BigInt::from(times) + BigInt::from(ulps);
            Poly::new(vec![-root, BigInt::from(1) << (exponent + 3)])
        };
        factors
            .iter()
            .map(line)
            .fold(Poly::constant(BigInt::from(1)), |p, line| p.mul(&line))
            .scale(&(BigInt::from(1) << shift))
            .add(&Poly::constant(BigInt::from(constant)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]
        #[test]
        fn float_poly_sign_is_the_exact_one_at_both_ends(
            high in (0.0..=1.0f64, 0..40i32).prop_map(|(t, e)| t * 0.5f64.powi(e)),
            width in 0..5u64,
            factors in prop::collection::vec((-40..40i64, 1..4u64), 1..6),
            constant in any::<i64>(),
            shift in 0..1200u64,
        ) {
            let low = f64::from_bits(high.to_bits().saturating_sub(width));
            let q = nearly_zero(high, &factors, constant, shift);
            if let Some(sign) = FloatPoly::multiple_of(&q).sign_between(low, high) {
                for end in [low, high] {
                    let (numerator, exponent) = dyadic::<BigInt>(end);
                    prop_assert_eq!(Integer::sign(&q.evaluate_dyadic(&numerator, exponent)), sign);
                }
            }
        }
    }

    #[test]
    fn float_poly_sign_is_certain_away_from_roots_only() {
        let root = 0.5f64.sqrt();
        let q = FloatPoly::multiple_of(&Poly::new([-1, 0, 2].map(BigInt::from).to_vec()));
        assert_eq!(q.sign_between(root, root.next_up()), None);
        assert_eq!(q.sign_between(0.7, 0.7), Some(Ordering::Less));
        assert_eq!(
            q.sign_between(root + 1e-14, root + 1e-14),
            Some(Ordering::Greater)
        );
        assert_eq!(q.sign_between(0.7, 0.9), None);
        // Exponents far beyond those of f64.
        let steep = Poly::new(vec![BigInt::from(-1), BigInt::from(1) << 3000]);
        let steep = FloatPoly::multiple_of(&steep);
        assert_eq!(steep.sign_between(0.0, 0.0), None);
        assert_eq!(steep.sign_between(0.5, 0.5), Some(Ordering::Greater));
    }
}
