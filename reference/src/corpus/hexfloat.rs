//! Hexadecimal floats as C99 writes them: `0x1.8p-3` is `(1 + 8/16) 2^-3`.
//!
//! Every finite `f64` has such a text, and a text is read only if it is exactly an `f64`: nothing
//! is ever rounded.

use super::dyadic::{NotF64, exact_f64};

/// Why a text is not read as a hexadecimal float.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HexFloatError {
    /// It is not of the form `[+-]0xH.Hp[+-]D`.
    #[error("is not a hexadecimal float such as 0x1.8p-3")]
    Syntax,
    /// It is NaN or an infinity.
    #[error("is not a finite number")]
    NotFinite,
    /// It is a number, but none that an `f64` can hold.
    #[error("is not an f64: {0}")]
    NotF64(NotF64),
}

/// Reads `[+-]0xH.HpE`: hexadecimal digits with an optional point, at least one of them, and the
/// decimal exponent of 2, which may be left out if it is 0. Letters may be of either case.
///
/// # Errors
///
/// [`HexFloatError`] if the text is not of this form, or not exactly an `f64`.
pub fn parse(text: &str) -> Result<f64, HexFloatError> {
    let (negative, unsigned) = match text.strip_prefix(['+', '-']) {
        Some(rest) => (text.starts_with('-'), rest),
        None => (false, text),
    };
    let Some(body) = unsigned
        .strip_prefix("0x")
        .or_else(|| unsigned.strip_prefix("0X"))
    else {
        let is_special = text.parse::<f64>().is_ok_and(|value| !value.is_finite())
            && unsigned.starts_with(|first: char| first.is_ascii_alphabetic());
        return Err(if is_special {
            HexFloatError::NotFinite
        } else {
            HexFloatError::Syntax
        });
    };
    let (digits, exponent) = match body.split_once(['p', 'P']) {
        Some((digits, exponent)) => (digits, decimal_exponent(exponent)?),
        None => (body, 0),
    };
    let (mantissa, shift) = significant_digits(digits)?;
    exact_f64(negative, mantissa, exponent.saturating_add(shift)).map_err(HexFloatError::NotF64)
}

/// The digits `H.H` as `(m, e)` with the value `m 2^e`.
fn significant_digits(digits: &str) -> Result<(u64, i64), HexFloatError> {
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = [whole, fraction].concat();
    if all.is_empty() || !all.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return Err(HexFloatError::Syntax);
    }
    let kept = all.trim_end_matches('0');
    let shift = 4 * (whole.len() as i64 - kept.len() as i64);
    match kept.trim_start_matches('0') {
        "" => Ok((0, 0)),
        kept if kept.len() <= 16 => u64::from_str_radix(kept, 16)
            .map(|mantissa| (mantissa, shift))
            .map_err(|_| HexFloatError::Syntax),
        kept => {
            let digit = |at: usize| u8::from_str_radix(&kept[at..=at], 16).unwrap_or(0);
            let above = digit(0).leading_zeros() - 4;
            let below = digit(kept.len() - 1).trailing_zeros();
            let bits = 4 * kept.len() as u64 - u64::from(above) - u64::from(below);
            Err(HexFloatError::NotF64(NotF64::TooManyBits(bits)))
        }
    }
}

/// The decimal exponent; one too long for an `i64` is as good as the largest.
fn decimal_exponent(text: &str) -> Result<i64, HexFloatError> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(HexFloatError::Syntax);
    }
    let limit = if text.starts_with('-') {
        i64::MIN
    } else {
        i64::MAX
    };
    Ok(text.parse().unwrap_or(limit))
}

/// Writes a number as `[-]0x1.HHHp±E` with no trailing zeros, a zero as `[-]0x0p+0`.
///
/// Subnormals are normalised too (`0x1p-1074`). [`parse`] reads back the same bits. NaN and the
/// infinities, which no query holds, come out as `nan`, `inf` and `-inf`.
pub fn format(value: f64) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    if value.is_nan() {
        return "nan".to_owned();
    }
    if value.is_infinite() {
        return format!("{sign}inf");
    }
    let bits = value.to_bits();
    let stored = bits & ((1 << 52) - 1);
    let (fraction, exponent) = match (bits >> 52 & 0x7ff) as i64 {
        0 if stored == 0 => return format!("{sign}0x0p+0"),
        0 => {
            let shift = stored.leading_zeros() - 11;
            (
                (stored << shift) & ((1 << 52) - 1),
                -1022 - i64::from(shift),
            )
        }
        biased => (stored, biased - 1023),
    };
    let digits = format!("{fraction:013x}");
    match digits.trim_end_matches('0') {
        "" => format!("{sign}0x1p{exponent:+}"),
        digits => format!("{sign}0x1.{digits}p{exponent:+}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn hexfloat_parse_known_texts() {
        for (text, value) in [
            ("0x1.8p-3", 0.1875),
            ("0X.8P1", 1.0),
            ("0x1p-1074", f64::from_bits(1)),
            ("0x0.0000000000001p-1022", f64::from_bits(1)),
            ("0x1.fffffffffffffp+1023", f64::MAX),
            ("-0x1.921fb54442d18p+1", -std::f64::consts::PI),
            ("+0x10", 16.0),
            ("0x1.p0", 1.0),
            ("0x0000000000000000000001.8000000000000000000000p0", 1.5),
            ("0x0p99999999999999999999", 0.0),
            ("0x100000000000000000000p-80", 1.0),
        ] {
            assert_eq!(parse(text), Ok(value), "{text}");
        }
        let zero = parse("-0x0p+0").unwrap();
        assert!(zero == 0.0 && zero.is_sign_negative());
    }

    #[test]
    fn hexfloat_parse_refuses_other_texts() {
        for text in [
            "", "-", "1.5", "1e400", "0x", "0x.", "0xp3", "0x1p", "0x1p+", "0x1p1.0", "0x1.2.3",
            "0x1g", " 0x1", "0x1 ", "--0x1", "0x-1", "0x1p--1", "0x1_0", "1x0", "0xé", "x1",
        ] {
            assert_eq!(parse(text), Err(HexFloatError::Syntax), "{text:?}");
        }
        for text in ["nan", "NaN", "-nan", "inf", "-Infinity", "+INF"] {
            assert_eq!(parse(text), Err(HexFloatError::NotFinite), "{text:?}");
        }
    }

    #[test]
    fn hexfloat_parse_refuses_what_is_not_exactly_an_f64() {
        for (text, reason) in [
            ("0x1.00000000000008p0", NotF64::TooManyBits(54)),
            ("0x1.000000000000000000001p0", NotF64::TooManyBits(85)),
            ("0x3.00000000000000000000cp0", NotF64::TooManyBits(84)),
            ("0x1p1024", NotF64::TooLarge),
            ("0x1p99999999999999999999", NotF64::TooLarge),
            ("0x1p-1075", NotF64::TooFine),
            ("0x1.8p-1074", NotF64::TooFine),
            ("0x1p-99999999999999999999", NotF64::TooFine),
        ] {
            assert_eq!(parse(text), Err(HexFloatError::NotF64(reason)), "{text}");
        }
    }

    #[test]
    fn hexfloat_format_known_values() {
        for (value, text) in [
            (0.1875, "0x1.8p-3"),
            (-0.0, "-0x0p+0"),
            (0.0, "0x0p+0"),
            (1.0, "0x1p+0"),
            (0.1, "0x1.999999999999ap-4"),
            (f64::MAX, "0x1.fffffffffffffp+1023"),
            (f64::MIN_POSITIVE, "0x1p-1022"),
            (f64::from_bits(1), "0x1p-1074"),
            (
                f64::from_bits(0xf_ffff_ffff_ffff),
                "0x1.ffffffffffffep-1023",
            ),
            (f64::NAN, "nan"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(format(value), text);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn hexfloat_format_then_parse_gives_the_same_bits(bits: u64) {
            let value = f64::from_bits(bits);
            match parse(&format(value)) {
                Ok(read) => prop_assert_eq!(read.to_bits(), bits),
                Err(error) => {
                    prop_assert!(!value.is_finite());
                    prop_assert_eq!(error, HexFloatError::NotFinite);
                }
            }
        }

        #[test]
        fn hexfloat_format_then_parse_subnormals(bits in 0u64..1 << 53, negative: bool) {
            let bits = bits | u64::from(negative) << 63;
            let read = parse(&format(f64::from_bits(bits))).map(f64::to_bits);
            prop_assert_eq!(read, Ok(bits));
        }

        #[test]
        fn hexfloat_parse_never_panics(text in "[-+]?0[xX][0-9a-fA-F.]{0,24}[pP]?[-+]?[0-9]{0,22}|\\PC*") {
            if let Ok(value) = parse(&text) {
                prop_assert!(value.is_finite());
            }
        }
    }
}
