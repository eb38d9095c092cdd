//! Stages 1 and 2 in `f32`, of coordinates that are `f32`: twice as many queries in a register.
//!
//! They answer only what they can prove. Of what they leave, the stages in `f64` decide.

use super::kind::Stages;

/// A coordinate at `t = 0` and at `t = 1`.
type Ends = [f32; 2];

type Point = [Ends; 3];

/// Whether the swept boxes are disjoint, and whether the direction from one middle to the other
/// certainly separates the two sides for the whole step.
///
/// The boxes are compared without rounding.
///
/// Relative to A, the direction `d` separates if at both ends of the step the least product with it
/// of a point of the second side is above the largest of one of the first, which for A itself is 0.
/// Any `d` will do, however it is rounded. `X . d` is linear in `t`, so it separates in between too.
///
/// Error bound: every component `i` of a difference is at most the extent `e_i` of the box around
/// everything, and rounded once (`u = 2^-24`). With `S` the sum of `e_i |d_i|`, a product with `d`
/// is within `5.2 u S` of that of the exact difference, as [`SweptBoxes::is_certain`] says it of
/// `f64`. So are the least and the largest product, and the difference of the two, each of which is
/// below `1.1 S`, is rounded once more: below `13 u S`. `S` is computed with a relative error below
/// `6 u`, and its product with `16 u`, a power of two, is exact. What underflows adds at most `2^-150`
/// for each of 13 products, absorbed by `TINY`. A difference does not underflow. Nothing overflows while
/// the bound is below `2^80`, so `S` below `2^100`; else, NaN included, there is no claim: the
/// extent is not below a rounded difference, so `S` is infinite or NaN where one of these or of `d`
/// is infinite.
///
/// [`SweptBoxes::is_certain`]: super::separate::SweptBoxes::is_certain
#[allow(
    clippy::needless_range_loop,
    reason = "loops over iterators take 6% more instructions of a candidate"
)]
#[inline(always)]
pub(super) fn are_apart<K: Stages>(points: &[Point; 4]) -> [bool; 2] {
    let (first, second) = points.split_at(K::FIRST);
    let (mut are_disjoint, mut extent) = (false, [0.0; 3]);
    for axis in 0..3 {
        let ((low, high), (other_low, other_high)) = (span(first, axis), span(second, axis));
        are_disjoint |= (other_low > high) | (low > other_high);
        extent[axis] = larger(high, other_high) - smaller(low, other_low);
    }
    let [a, b, c, d] = points;
    let [b, c, d] = [sub(b, a), sub(c, a), sub(d, a)];
    let is_of_first = K::FIRST == 2;
    let mut direction = [0.0; 3];
    for axis in 0..3 {
        let at = |end: usize| {
            let rest = c[axis][end] + d[axis][end];
            if is_of_first {
                rest - b[axis][end]
            } else {
                rest + b[axis][end]
            }
        };
        direction[axis] = at(0) + at(1);
    }
    let margin = |end: usize| {
        let b = dot(&b, &direction, end);
        let least = smaller(dot(&c, &direction, end), dot(&d, &direction, end));
        if is_of_first {
            least - larger(b, 0.0)
        } else {
            smaller(least, b)
        }
    };
    let size = |i: usize| extent[i] * direction[i].abs();
    let bound = (size(0) + size(1) + size(2)) * (16.0 * U) + TINY;
    let is_separated = (margin(0) > bound) & (margin(1) > bound) & (bound < LARGEST);
    [are_disjoint, is_separated]
}

/// The least and the largest coordinate of some points on an axis, over the step.
#[inline(always)]
fn span(points: &[Point], axis: usize) -> (f32, f32) {
    let [start, end] = points[0][axis];
    let (mut low, mut high) = (smaller(start, end), larger(start, end));
    for point in &points[1..] {
        let [start, end] = point[axis];
        low = smaller(low, smaller(start, end));
        high = larger(high, larger(start, end));
    }
    (low, high)
}

#[inline(always)]
fn sub(x: &Point, y: &Point) -> Point {
    let of = |i: usize| [x[i][0] - y[i][0], x[i][1] - y[i][1]];
    [of(0), of(1), of(2)]
}

#[inline(always)]
fn dot(x: &Point, direction: &[f32; 3], end: usize) -> f32 {
    x[0][end] * direction[0] + x[1][end] * direction[1] + x[2][end] * direction[2]
}

/// The larger of two numbers; of a NaN, either.
#[inline(always)]
fn larger(x: f32, y: f32) -> f32 {
    if x > y { x } else { y }
}

/// The smaller of two numbers; of a NaN, either.
#[inline(always)]
fn smaller(x: f32, y: f32) -> f32 {
    if x < y { x } else { y }
}

/// Half the distance from 1 to the next `f32`: the largest relative error of one rounding.
const U: f32 = f32::EPSILON / 2.0;

/// Far above what underflow adds.
const TINY: f32 = f32::MIN_POSITIVE;

const LARGEST: f32 = f32::from_bits((127 + 80) << 23);
