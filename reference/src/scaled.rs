//! The points of a query as integers.
//!
//! Finite `f64` coordinates are dyadic rationals; all of them times one power of two are integers.
//! Every predicate of contact is homogeneous, so its sign is the same for the scaled points.

use tunnelproof::query::{Point, Query};

use crate::algebraic::decompose;
use crate::field::Integer;

/// The four points at both ends of the step, all scaled by the same power of two.
#[derive(Clone, Debug)]
pub struct Scaled<Z> {
    /// A, B, C, D at `t = 0`.
    pub start: [[Z; 3]; 4],
    /// A, B, C, D at `t = 1`.
    pub end: [[Z; 3]; 4],
    /// A coordinate is its integer times `2^exponent` metres.
    pub exponent: i64,
}

impl<Z: Integer> Scaled<Z> {
    /// The points of a query, exactly.
    pub fn new(query: &Query) -> Self {
        let all = query
            .start()
            .iter()
            .chain(query.end())
            .flat_map(|point| point.iter());
        let exponents = all
            .filter(|&&value| value != 0.0)
            .map(|&value| decompose(value).1);
        let exponent = exponents.min().unwrap_or(0);
        let integer = |value: f64| {
            let (mantissa, own) = decompose(value);
            let shift = if mantissa == 0 {
                0
            } else {
                own.abs_diff(exponent)
            };
            Z::from_i64(mantissa).shl(shift)
        };
        let point = |point: &Point| [point.x, point.y, point.z].map(integer);
        Scaled {
            start: query.start().each_ref().map(point),
            end: query.end().each_ref().map(point),
            exponent,
        }
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use proptest::prelude::*;
    use tunnelproof::query::QueryKind;

    use super::*;

    proptest! {
        #[test]
        fn scaled_points_are_the_coordinates(bits in prop::array::uniform24(any::<u64>())) {
            let values = bits.map(|b| match f64::from_bits(b) {
                value if value.is_finite() => value,
                _ => 0.0,
            });
            let point = |i: usize| Point::new(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
            let (start, end) = ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point));
            let query = Query::new(QueryKind::EdgeEdge, start, end, 0.0).unwrap();
            let scaled = Scaled::<BigInt>::new(&query);
            let unit = BigRational::from_integer(BigInt::from(2)).pow(scaled.exponent as i32);
            let integers = scaled.start.iter().chain(&scaled.end).flatten();
            for (integer, value) in integers.zip(values) {
                let exact = BigRational::from_integer(integer.clone()) * &unit;
                prop_assert_eq!(exact, BigRational::from_float(value).unwrap());
            }
        }
    }
}
