//! The `f64` that is exactly `m 2^e` or `n / d`, or why there is none.

use std::fmt;

use crate::field::Integer;

/// Why an exact number is not an `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotF64 {
    /// It has this many significant bits; an `f64` has 53.
    TooManyBits(u64),
    /// Its magnitude is 2^1024 or more.
    TooLarge,
    /// It is not a multiple of 2^-1074, the smallest `f64` above 0.
    TooFine,
    /// Its denominator in lowest terms is not a power of two.
    NotDyadic,
}

impl fmt::Display for NotF64 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotF64::TooManyBits(bits) => write!(f, "it has {bits} significant bits, an f64 has 53"),
            NotF64::TooLarge => f.write_str("its magnitude is 2^1024 or more"),
            NotF64::TooFine => f.write_str("it is not a multiple of 2^-1074"),
            NotF64::NotDyadic => f.write_str("its denominator is not a power of two"),
        }
    }
}

/// `(-1)^negative mantissa 2^exponent` as an `f64`, exact.
///
/// A mantissa of 0 gives the zero of that sign.
///
/// # Errors
///
/// [`NotF64`] if that number is not an `f64`.
pub(super) fn exact_f64(negative: bool, mantissa: u64, exponent: i64) -> Result<f64, NotF64> {
    if mantissa == 0 {
        return Ok(if negative { -0.0 } else { 0.0 });
    }
    // The number is `odd 2^low` and lies in [2^high, 2^(high + 1)).
    let odd = mantissa >> mantissa.trailing_zeros();
    let bits = u64::from(u64::BITS - odd.leading_zeros());
    let low = exponent.saturating_add(i64::from(mantissa.trailing_zeros()));
    let high = low.saturating_add(bits as i64 - 1);
    if high > 1023 {
        return Err(NotF64::TooLarge);
    }
    if bits > 53 {
        return Err(NotF64::TooManyBits(bits));
    }
    if low < -1074 {
        return Err(NotF64::TooFine);
    }
    let magnitude = if high >= -1022 {
        let fraction = (odd << (53 - bits)) & ((1 << 52) - 1);
        ((high + 1023) as u64) << 52 | fraction
    } else {
        odd << (low + 1074)
    };
    Ok(f64::from_bits(u64::from(negative) << 63 | magnitude))
}

/// `numerator / denominator`, the denominator not 0, as an `f64`, exact.
///
/// Powers of two are taken out of both; what is left of the denominator has to divide what is left
/// of the numerator, or the quotient is not dyadic. A quotient of 0 has the sign `+`.
///
/// # Errors
///
/// [`NotF64`] if the quotient is not an `f64`.
pub(super) fn exact_quotient<Z: Integer>(numerator: &Z, denominator: &Z) -> Result<f64, NotF64> {
    if numerator.is_zero() {
        return Ok(0.0);
    }
    let is_negative = numerator.sign() != denominator.sign();
    let (n, n_exponent) = odd_part(&numerator.abs());
    let (d, d_exponent) = odd_part(&denominator.abs());
    let quotient = n.div_floor(&d);
    if quotient.mul(&d) != n {
        return Err(NotF64::NotDyadic);
    }
    let exponent = n_exponent - d_exponent;
    match quotient.to_i64() {
        Some(mantissa) => exact_f64(is_negative, mantissa.unsigned_abs(), exponent),
        None if quotient.bits() as i64 + exponent > 1024 => Err(NotF64::TooLarge),
        None => Err(NotF64::TooManyBits(quotient.bits())),
    }
}

/// `value`, above 0, as an odd integer times a power of two.
fn odd_part<Z: Integer>(value: &Z) -> (Z, i64) {
    let exponent = value.trailing_zeros();
    (value.shr_floor(exponent), exponent as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_f64_range_ends_at_the_largest_and_the_smallest() {
        assert_eq!(exact_f64(false, (1 << 53) - 1, 971), Ok(f64::MAX));
        assert_eq!(exact_f64(true, 1, 1023), Ok(-2f64.powi(1023)));
        assert_eq!(exact_f64(false, 1, 1024), Err(NotF64::TooLarge));
        assert_eq!(exact_f64(false, 1, -1074), Ok(f64::from_bits(1)));
        assert_eq!(exact_f64(false, 3, -1075), Err(NotF64::TooFine));
        assert_eq!(exact_f64(false, 1 << 63, -1137), Ok(f64::from_bits(1)));
        assert_eq!(exact_f64(false, 1, -1022), Ok(f64::MIN_POSITIVE));
        assert_eq!(exact_f64(false, 1, i64::MAX), Err(NotF64::TooLarge));
        assert_eq!(exact_f64(false, 1, i64::MIN), Err(NotF64::TooFine));
    }

    #[test]
    fn exact_f64_mantissa_of_more_than_53_bits_is_refused() {
        assert_eq!(exact_f64(false, (1 << 53) + 2, 0), Ok(9007199254740994.0));
        let error = exact_f64(false, (1 << 53) + 1, 0);
        assert_eq!(error, Err(NotF64::TooManyBits(54)));
        let error = exact_f64(false, u64::MAX, 0);
        assert_eq!(error, Err(NotF64::TooManyBits(64)));
    }

    #[test]
    fn exact_f64_zero_keeps_its_sign() {
        assert!(exact_f64(true, 0, i64::MAX).unwrap().is_sign_negative());
        assert!(exact_f64(false, 0, 0).unwrap().is_sign_positive());
    }

    fn exact_quotient_known_values<Z: Integer>() {
        let z = Z::from_i64;
        let power = |bits: u64| z(1).shl(bits);
        let exact = |n: &Z, d: &Z| exact_quotient(n, d);
        assert_eq!(exact(&z(-6), &z(-4)), Ok(1.5));
        assert_eq!(exact(&z(21), &z(-28)), Ok(-0.75));
        assert_eq!(exact(&power(2000).mul(&z(3)), &power(3074)), Ok(1.5e-323));
        assert!(exact(&z(0), &z(-7)).is_ok_and(|zero| zero == 0.0 && zero.is_sign_positive()));
        assert_eq!(exact(&z(1), &z(3)), Err(NotF64::NotDyadic));
        assert_eq!(exact(&power(200), &z(-10)), Err(NotF64::NotDyadic));
        assert_eq!(exact(&power(1024), &z(1)), Err(NotF64::TooLarge));
        assert_eq!(exact(&z(-1), &power(1075)), Err(NotF64::TooFine));
        let many_bits = power(1024).add(&z(1));
        assert_eq!(exact(&many_bits, &z(1)), Err(NotF64::TooLarge));
        assert_eq!(exact(&many_bits, &z(2)), Err(NotF64::TooManyBits(1025)));
    }

    #[test]
    fn exact_quotient_num_bigint() {
        exact_quotient_known_values::<num_bigint::BigInt>();
    }

    #[cfg(feature = "gmp")]
    #[test]
    fn exact_quotient_gmp() {
        exact_quotient_known_values::<rug::Integer>();
    }
}
