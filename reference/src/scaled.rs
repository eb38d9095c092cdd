//! The points of a query as integers.
//!
//! Finite `f64` coordinates are dyadic rationals; all of them times one power of two are integers.
//! Every predicate of contact is homogeneous, so its sign is the same for the scaled points.

use tunnelproof::query::{Point, Query};
use tunnelproof::rigid::{RigidQuery, Side};

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
        let exponent = common_exponent(all);
        let integer = |value: f64| integer(value, exponent);
        let point = |point: &Point| [point.x, point.y, point.z].map(integer);
        Scaled {
            start: query.start().each_ref().map(point),
            end: query.end().each_ref().map(point),
            exponent,
        }
    }
}

/// The numbers of a query of bodies that turn.
#[derive(Clone, Debug)]
pub struct ScaledRigid<Z> {
    /// Both sides; the second one turns.
    pub first: ScaledSide<Z>,
    /// The body of the second side.
    pub second: ScaledBody<Z>,
    /// A coordinate of a point is its integer times `2^exponent` metres.
    pub exponent: i64,
}

/// The first side of a query.
#[derive(Clone, Debug)]
pub enum ScaledSide<Z> {
    /// Points in space at `t = 0` and at `t = 1`.
    Straight(Vec<[[Z; 3]; 2]>),
    /// Points of a body.
    Turning(ScaledBody<Z>),
}

/// A body that turns. All lengths are scaled by one power of two.
#[derive(Clone, Debug)]
pub struct ScaledBody<Z> {
    /// The points in the body's frame.
    pub local: Vec<[Z; 3]>,
    /// The centre at `t = 0` and at `t = 1`.
    pub centres: [[Z; 3]; 2],
    /// w, x, y and z of the quaternions, the nearer one at the end, scaled by a power of their own.
    pub quaternions: [[Z; 4]; 2],
}

impl<Z: Integer> ScaledRigid<Z> {
    /// The numbers of a query, exactly.
    pub fn new(query: &RigidQuery) -> Self {
        let sides = query.sides();
        let lengths: Vec<Point> = sides.iter().flat_map(lengths).collect();
        let exponent = common_exponent(lengths.iter().flat_map(|point| point.iter()));
        let [first, second] = sides.map(|side| ScaledSide::new(&side, exponent));
        let ScaledSide::Turning(second) = second else {
            unreachable!("the second side of a query turns");
        };
        ScaledRigid {
            first,
            second,
            exponent,
        }
    }
}

/// Every point of a side, and the centres of its body.
fn lengths(side: &Side<'_>) -> Vec<Point> {
    match *side {
        Side::Straight { start, end } => [start, end].concat(),
        Side::Turning { local, motion } => {
            let centres = [motion.start().centre, motion.end().centre];
            [local, &centres].concat()
        }
    }
}

impl<Z: Integer> ScaledSide<Z> {
    fn new(side: &Side<'_>, exponent: i64) -> Self {
        let point = |point: &Point| [point.x, point.y, point.z].map(|x| integer(x, exponent));
        match *side {
            Side::Straight { start, end } => {
                let both = start.iter().zip(end);
                ScaledSide::Straight(both.map(|(a, b)| [point(a), point(b)]).collect())
            }
            Side::Turning { local, motion } => {
                let quaternions = motion.quaternions();
                let own = common_exponent(quaternions.iter().flatten());
                let centres = [motion.start(), motion.end()].map(|pose| point(&pose.centre));
                ScaledSide::Turning(ScaledBody {
                    local: local.iter().map(point).collect(),
                    centres,
                    quaternions: quaternions.map(|q| q.map(|x| integer(x, own))),
                })
            }
        }
    }
}

/// The exponent of the largest power of two of which all these numbers are multiples; 0 if all are
/// 0.
fn common_exponent<'a>(numbers: impl Iterator<Item = &'a f64>) -> i64 {
    let used = numbers.filter(|&&value| value != 0.0);
    used.map(|&value| decompose(value).1).min().unwrap_or(0)
}

/// A number in multiples of `2^exponent`.
fn integer<Z: Integer>(value: f64, exponent: i64) -> Z {
    let (mantissa, own) = decompose(value);
    let shift = match mantissa {
        0 => 0,
        _ => own.abs_diff(exponent),
    };
    Z::from_i64(mantissa).shl(shift)
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
