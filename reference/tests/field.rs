//! Operations of both backends on known values.

use std::cmp::Ordering;

use num_bigint::BigInt;
use tunnelproof_reference::field::{Integer, OrderedField, Ratio};

fn integer_operations<Z: Integer>() {
    let z = Z::from_i64;
    let big = z(3).shl(200).add(&z(5));
    assert_eq!(big.bits(), 202);
    assert_eq!(big.sub(&z(5)).trailing_zeros(), 200);
    assert_eq!(z(0).trailing_zeros(), 0);
    assert_eq!(z(-7).shr_floor(1), z(-4));
    assert_eq!(z(-7).div_floor(&z(2)), z(-4));
    assert_eq!(z(-84).gcd(&z(30)), z(6));
    assert_eq!(z(0).gcd(&z(-5)), z(5));
    assert_eq!(big.mul(&z(-9)).div_exact(&z(9)), big.neg());
    let mut sum = z(1);
    sum.add_product(&z(6), &z(7));
    sum.sub_product(&z(2), &z(4));
    assert_eq!(sum, z(35));
    assert_eq!(z(-3).sign(), Ordering::Less);
    assert_eq!(z(-3).abs(), z(3));
    assert_eq!(big.to_i64(), None);
    assert_eq!(z(i64::MIN).to_i64(), Some(i64::MIN));
    let (mantissa, exponent) = z(-3).shl(300).approximate();
    assert_eq!(mantissa * 2f64.powi(-62), -3.0);
    assert_eq!(exponent, 300 - 62);
    assert_eq!(z(0).approximate(), (0.0, 0));
    assert_eq!(Z::from_decimal("-12345678901234567890123"), {
        let head = z(12345678901)
            .mul(&z(1_000_000_000_000))
            .add(&z(234567890123));
        Some(head.neg())
    });
    assert_eq!(Z::from_decimal("+17"), Some(z(17)));
    for text in ["", "-", "+-3", "1_000", " 1", "1.5", "0x10", "--1"] {
        assert_eq!(Z::from_decimal(text), None, "{text:?}");
    }
}

fn ratio_operations<Z: Integer>() {
    let ratio = |n, d| Z::Ratio::new(Z::from_i64(n), Z::from_i64(d));
    assert_eq!(ratio(6, -4).numerator(), Z::from_i64(-3));
    assert_eq!(ratio(6, -4).denominator(), Z::from_i64(2));
    assert_eq!(ratio(1, 2) + ratio(1, 3), ratio(5, 6));
    assert_eq!(ratio(1, 2) / ratio(-1, 3), ratio(-3, 2));
    assert!(ratio(1, 1).in_unit_interval() && ratio(0, 1).in_unit_interval());
    assert!(!ratio(-1, 1000).in_unit_interval() && !ratio(1001, 1000).in_unit_interval());
}

#[test]
fn integer_operations_num_bigint() {
    integer_operations::<BigInt>();
    ratio_operations::<BigInt>();
}

#[cfg(feature = "gmp")]
#[test]
fn integer_operations_gmp() {
    integer_operations::<rug::Integer>();
    ratio_operations::<rug::Integer>();
}
