//! Proved bounds on how near segments are and on how far they move.

use crate::closest::closest;
use crate::query::Point;

/// A lower bound on the distance of two segments in metres, given by their ends: within rounding of it,
/// or 0 where nothing is proved. All coordinates are finite.
///
/// Along any direction `d`, all of one segment is at least `min (q - p) . d` beyond all of the other, over
/// ends `p` and `q`; their distance is at least that over `|d|`. The direction is the one of the closest
/// points, as well as `f64` finds them: a poor one makes the bound poor, not wrong.
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

/// From the closest point of one segment to the other's, its largest component 1 or -1; nothing if it is
/// not finite or has no length.
fn direction(first: &[Point; 2], second: &[Point; 2]) -> Option<[f64; 3]> {
    let ([a, b], [c, d]) = (first, second);
    let (u, v) = closest(&[a.coords, b.coords, c.coords, d.coords]);
    let (p, q) = (a.coords.lerp(&b.coords, u), c.coords.lerp(&d.coords, v));
    let direction = (q - p) / (q - p).amax();
    let is_finite = direction.iter().all(|x| x.is_finite());
    is_finite.then_some(direction.into())
}

/// A lower bound on `(q - p) . d`, the components of `d` at most 1 in magnitude. Not NaN: infinity, which
/// only an overflow makes, is not multiplied by 0, and no sum is +inf.
fn advance_below(p: &Point, q: &Point, d: &[f64; 3]) -> f64 {
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

/// An upper bound on the distance between two points in metres. All coordinates are finite.
pub(super) fn distance_above(p: &Point, q: &Point) -> f64 {
    norm_above(&[0, 1, 2].map(|axis| (q[axis] - p[axis]).abs().next_up()))
}

/// An upper bound on the length of a vector without NaN.
fn norm_above(v: &[f64; 3]) -> f64 {
    let squares = v.map(|x| (x * x).next_up());
    let sum = (squares[0] + squares[1]).next_up() + squares[2];
    sum.next_up().sqrt().next_up()
}

#[cfg(test)]
mod tests {
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
}
