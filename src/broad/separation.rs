//! Proved bounds on how near segments are and on how far they move.

use crate::closest::closest;
use crate::query::Point;

/// 8 units of rounding of `f64`, 2^-50: more than the errors of the sums below, 4.2 of them at
/// most, and the last rounding come to.
const EIGHT_U: f64 = 4.0 * f64::EPSILON;

/// 2^-900. Beside it an underflow is nothing.
const SMALL: f64 = f64::from_bits((1023 - 900) << 52);

/// A lower bound on the distance of two segments in metres, given by their ends: within rounding of
/// it, or 0 where nothing is proved. All coordinates are finite.
///
/// Along any direction `d`, all of one segment is at least `min (q - p) . d` beyond all of the
/// other, over ends `p` and `q`; their distance is at least that over `|d|`. The direction is the
/// one of the closest points, as well as `f64` finds them: a poor one makes the bound poor, not
/// wrong.
pub(super) fn distance_below(first: &[Point; 2], second: &[Point; 2]) -> f64 {
    let Some(direction) = direction(first, second) else {
        return 0.0;
    };
    let mut least = f64::INFINITY;
    for p in first {
        for q in second {
            least = least.min(advance_below(p, q, &direction));
        }
    }
    (least / norm_above(&direction)).next_down().max(0.0)
}

/// From the closest point of one segment to the other's, its largest component 1 or -1; nothing if
/// it is not finite or has no length.
fn direction(first: &[Point; 2], second: &[Point; 2]) -> Option<[f64; 3]> {
    let ([a, b], [c, d]) = (first, second);
    let (u, v) = closest(&[a.coords, b.coords, c.coords, d.coords]);
    let (p, q) = (a.coords.lerp(&b.coords, u), c.coords.lerp(&d.coords, v));
    let direction = (q - p) / (q - p).amax();
    let is_finite = direction.iter().all(|x| x.is_finite());
    is_finite.then_some(direction.into())
}

/// A lower bound on `(q - p) . d`, the components of `d` at most 1 in magnitude.
///
/// With `u` = 2^-53, a difference has a relative error of `u`, a product of another, or 2^-1075
/// where it underflows, and each of the two sums of one more. So the sum is off by less than 4.2
/// `u` times the sum of magnitudes, and what underflows, which beside a sum of 2^-900 is nothing.
/// The bound takes off 8 `u` of it, and loses another `u` or so by rounding.
fn advance_below(p: &Point, q: &Point, d: &[f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| (q[axis] - p[axis]) * d[axis]);
    let magnitude = x.abs() + y.abs() + z.abs();
    if (SMALL..f64::INFINITY).contains(&magnitude) {
        (x + y + z) - EIGHT_U * magnitude
    } else {
        advance_below_anywhere(p, q, d)
    }
}

/// The same by rounding each operation downward. Not NaN: infinity, which only an overflow makes,
/// is not multiplied by 0, and no sum is +inf.
fn advance_below_anywhere(p: &Point, q: &Point, d: &[f64; 3]) -> f64 {
    let mut sum = 0.0;
    for axis in 0..3 {
        let difference = q[axis] - p[axis];
        let factor = match d[axis] {
            0.0 => continue,
            x if x > 0.0 => difference.next_down(),
            _ => difference.next_up(),
        };
        sum = f64::next_down(sum + (factor * d[axis]).next_down());
    }
    sum
}

/// An upper bound on the distance between two points in metres; 0 if they are one. All coordinates
/// are finite.
pub(super) fn distance_above(p: &Point, q: &Point) -> f64 {
    if p == q {
        return 0.0;
    }
    norm_above(&(q - p).into())
}

/// An upper bound on the length of a vector of which each component is given rounded, none NaN.
///
/// With `u` = 2^-53, each component has a relative error of `u`, each square of another, or 2^-1075
/// where it underflows, which beside a sum of 2^-900 is nothing; two sums and the root have one of
/// `u` each. So the root is at most 3.6 `u` too small; the factor makes it 8 `u` larger, less a
/// rounding.
fn norm_above(v: &[f64; 3]) -> f64 {
    let [x, y, z] = v.map(|x| x * x);
    let squares = x + y + z;
    if (SMALL..f64::INFINITY).contains(&squares) {
        squares.sqrt() * (1.0 + EIGHT_U)
    } else {
        norm_above_anywhere(v)
    }
}

/// The same by rounding each operation upward.
fn norm_above_anywhere(v: &[f64; 3]) -> f64 {
    let squares = v.map(|x| {
        let most = x.abs().next_up();
        (most * most).next_up()
    });
    let sum = (squares[0] + squares[1]).next_up() + squares[2];
    sum.next_up().sqrt().next_up()
}

#[cfg(test)]
mod tests {
    use std::iter;

    use num_rational::BigRational;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn distance_below_is_within_rounding_of_a_distance_from_either_end() {
        let p = Point::new;
        let upright = [p(0.0, 0.0, -5.0), p(0.0, 0.0, 0.0)];
        let across = [p(0.0, -1.0, 1.0), p(0.0, 7.0, 1.0)];
        for first in [upright, [upright[1], upright[0]]] {
            for second in [across, [across[1], across[0]]] {
                for bound in [
                    distance_below(&first, &second),
                    distance_below(&second, &first),
                ] {
                    assert!((1.0 - 1e-14..=1.0).contains(&bound), "{bound}");
                }
            }
        }
    }

    #[test]
    fn distance_above_is_within_rounding_of_a_distance() {
        let far = distance_above(&Point::new(1.0, 2.0, 3.0), &Point::new(3.0, 5.0, 9.0));
        assert!((7.0..7.0 + 1e-14).contains(&far), "{far}");
        let [most, least] = [f64::MAX, -f64::MAX].map(|x| Point::new(x, x, x));
        assert_eq!(distance_above(&most, &least), f64::INFINITY);
        assert!(distance_above(&Point::origin(), &Point::new(0.0, 5e-324, 0.0)) >= 5e-324);
    }

    /// Lengths of vectors of whole numbers times powers of two, which are known exactly, where
    /// squares underflow and overflow too.
    #[test]
    fn bounds_are_on_their_sides_of_lengths_that_are_known() {
        for [x, y, z, length] in [
            [2, 3, 6, 7],
            [1, 4, 8, 9],
            [6, 10, 15, 19],
            [0, 3, 4, 5],
            [0, 0, 1, 1],
        ] {
            // From 2^-1074 to 2^1019.
            for two in iter::successors(Some(5e-324), |two| Some(two * 2.0)).take(2094) {
                let to = Point::from([x, y, z].map(|k: i32| f64::from(k) * two));
                let length = f64::from(length) * two;
                let above = distance_above(&Point::origin(), &to);
                assert!(above >= length, "{to}: {above}");
                let below = distance_below(&[Point::origin(); 2], &[to; 2]);
                assert!(below <= length, "{to}: {below}");
                if (1e-121..1e121).contains(&two) {
                    let [above, below] = [above, below].map(|bound| bound / length);
                    assert!(above <= 1.0 + 1e-14 && below >= 1.0 - 1e-14, "{to}");
                }
            }
        }
    }

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    proptest! {
        /// Both ways to each bound are on its side of the exact number, and near.
        #[test]
        fn bounds_are_on_their_sides_of_exact_numbers(
            p in prop::array::uniform3(-1e3..1e3f64),
            q in prop::array::uniform3(-1e3..1e3f64),
            direction in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let v = [0, 1, 2].map(|axis| q[axis] - p[axis]);
            let exact_v = [0, 1, 2].map(|axis| exact(q[axis]) - exact(p[axis]));
            let squares: BigRational = exact_v.iter().map(|x| x * x).sum();
            let length = norm_above(&v);
            for bound in [length, norm_above_anywhere(&v)] {
                let ratio = exact(bound) * exact(bound) / &squares;
                prop_assert!(ratio >= exact(1.0) && ratio <= exact(1.0 + 1e-14), "{bound}");
            }
            let terms = exact_v.iter().zip(direction);
            let advance: BigRational = terms.map(|(x, d)| x * exact(d)).sum();
            let [p, q] = [p, q].map(Point::from);
            let bounds = [
                advance_below(&p, &q, &direction),
                advance_below_anywhere(&p, &q, &direction),
            ];
            for bound in bounds {
                let lack = &advance - exact(bound);
                prop_assert!(lack >= exact(0.0) && lack <= exact(1e-14 * length), "{bound}");
            }
        }
    }
}
