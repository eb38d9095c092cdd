//! Numbers as text, exact ones above all.

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::{Integer, Ratio};
use crate::poly::Poly;

/// Digits after the decimal point.
const DIGITS: usize = 20;

/// A rational as an integer or a fraction in lowest terms.
pub fn fraction<R: Ratio>(value: &R) -> String {
    let (numerator, denominator) = (value.numerator(), value.denominator());
    match denominator == R::Integer::one() {
        true => numerator.to_string(),
        false => format!("{numerator}/{denominator}"),
    }
}

/// The number to 20 digits, cut, with `...` where more follow.
pub fn decimal<Z: Integer>(number: &Algebraic<Z>) -> String {
    let unit = ten_to_the_digits::<Z>();
    if let Some(value) = number.rational() {
        let (numerator, denominator) = (value.numerator().mul(&unit), value.denominator());
        let floor = numerator.div_floor(&denominator);
        let is_whole = floor.mul(&denominator) == numerator;
        return point(&floor, is_whole);
    }
    // No multiple of the last digit is irrational, so the digits settle.
    let mut bits = 96;
    loop {
        number.refine(bits);
        let (low, high, exponent) = number.bounds();
        let floor = |bound: Z| bound.mul(&unit).shr_floor(exponent);
        let (low, high) = (floor(low), floor(high));
        if low == high {
            return point(&low, false);
        }
        bits *= 2;
    }
}

fn ten_to_the_digits<Z: Integer>() -> Z {
    (0..DIGITS).fold(Z::one(), |power, _| power.mul(&Z::from_i64(10)))
}

/// A number of at least 0 in units of the last digit.
fn point<Z: Integer>(units: &Z, is_whole: bool) -> String {
    let digits = format!("{:0>width$}", units.to_string(), width = DIGITS + 1);
    let (whole, decimals) = digits.split_at(digits.len() - DIGITS);
    match (is_whole, decimals.trim_end_matches('0')) {
        (true, "") => whole.to_owned(),
        (true, decimals) => format!("{whole}.{decimals}"),
        (false, _) => format!("{whole}.{decimals}..."),
    }
}

/// The ends of a short interval that holds this root of the polynomial of an irrational number and
/// no other root, as fractions.
pub fn isolating<Z: Integer>(number: &Algebraic<Z>) -> [String; 2] {
    let roots = isolate_roots(number.poly());
    let others: Vec<_> = roots
        .iter()
        .filter(|root| root.compare(number).is_ne())
        .collect();
    let mut bits = 4;
    loop {
        let low = floor(number, bits);
        let high = low.add(&Z::one());
        let [below, above] = [&low, &high].map(|end| Algebraic::dyadic(end.clone(), bits));
        let is_outside =
            |root: &&Algebraic<Z>| root.compare(&below).is_lt() || root.compare(&above).is_gt();
        if others.iter().all(is_outside) {
            return [low, high].map(|end| fraction(&Z::Ratio::new(end, Z::one().shl(bits))));
        }
        bits += 1;
    }
}

/// An irrational number in units of `2^-bits`, rounded down.
fn floor<Z: Integer>(number: &Algebraic<Z>, bits: u64) -> Z {
    let mut width = bits + 2;
    loop {
        number.refine(width);
        let (low, high, exponent) = number.bounds();
        let floor = |bound: &Z| bound.shl(bits).shr_floor(exponent);
        // No multiple of the unit is irrational, so they come to be the same.
        if floor(&low) == floor(&high) {
            return floor(&low);
        }
        width *= 2;
    }
}

/// A polynomial in `t`, ascending.
pub fn polynomial<Z: Integer>(poly: &Poly<Z>) -> String {
    let mut text = String::new();
    for (power, coefficient) in poly.coefficients().iter().enumerate() {
        if coefficient.is_zero() {
            continue;
        }
        let sign = match (coefficient.sign().is_lt(), text.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let power = match power {
            0 => String::new(),
            1 => " t".to_owned(),
            _ => format!(" t^{power}"),
        };
        text += &format!("{sign}{}{power}", coefficient.abs());
    }
    text
}

/// `value 2^exponent` to about 16 digits.
pub fn scaled<Z: Integer>(value: &Z, exponent: i64) -> String {
    let (mantissa, own) = value.approximate();
    match own + exponent {
        _ if value.is_zero() => "0".to_owned(),
        exponent @ -1000..=900 => short(mantissa * 2f64.powi(exponent as i32)),
        exponent => format!("{mantissa:e} * 2^{exponent}"),
    }
}

/// The shortest decimal of an `f64`, with an exponent where that is shorter.
pub fn short(value: f64) -> String {
    let (plain, exponential) = (value.to_string(), format!("{value:e}"));
    match plain.len() > exponential.len() + 4 {
        true => exponential,
        false => plain,
    }
}

/// How many there are of something.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_rational::BigRational;

    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[test]
    fn decimal_of_rationals_ends_or_is_cut() {
        let decimal = |n, d| decimal(&Algebraic::<BigInt>::ratio(&ratio(n, d)));
        assert_eq!(decimal(0, 1), "0");
        assert_eq!(decimal(1, 1), "1");
        assert_eq!(decimal(3, 5), "0.6");
        assert_eq!(decimal(1, 16), "0.0625");
        assert_eq!(decimal(2, 3), "0.66666666666666666666...");
    }

    #[test]
    fn decimal_of_irrational_is_cut() {
        let poly = Poly::new([-1, 0, 2].map(BigInt::from).to_vec());
        let roots = isolate_roots(&poly);
        assert_eq!(decimal(&roots[0]), "0.70710678118654752440...");
    }

    #[test]
    fn isolating_interval_holds_one_root() {
        // (2 t^2 - 1) (25 t^2 - 13): 0.7071 and 0.7211.
        let poly = Poly::new([13, 0, -51, 0, 50].map(BigInt::from).to_vec());
        let roots = isolate_roots(&poly);
        assert_eq!(isolating(&roots[0]), ["11/16", "23/32"]);
    }

    #[test]
    fn fraction_is_in_lowest_terms() {
        assert_eq!(fraction(&ratio(6, 8)), "3/4");
        assert_eq!(fraction(&ratio(8, 4)), "2");
    }

    #[test]
    fn polynomial_has_signs_between_its_terms() {
        let text = |coefficients: &[i64]| {
            let coefficients = coefficients.iter().map(|&c| BigInt::from(c));
            polynomial(&Poly::new(coefficients.collect()))
        };
        assert_eq!(text(&[-3, 0, 12, -1]), "-3 + 12 t^2 - 1 t^3");
        assert_eq!(text(&[0, 5]), "5 t");
    }

    #[test]
    fn scaled_is_readable_beyond_f64() {
        assert_eq!(scaled(&BigInt::from(3), -1), "1.5");
        assert_eq!(scaled(&BigInt::from(0), 9999), "0");
        assert!(scaled(&BigInt::from(1), 4000).ends_with("2^3937"));
    }
}
