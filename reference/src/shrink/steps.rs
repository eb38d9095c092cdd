//! What may make a query simpler. Each step proposes queries, the boldest first; whether one is
//! simpler and still interesting is for the caller to find out.

use tunnelproof::query::QueryKind;

use super::form::Step;
use crate::algebraic::decompose;
use crate::shape::Shape;

/// Every step, in the order in which they are taken.
pub(super) const STEPS: &[Step<Shape>] = &[
    simpler_radius,
    zeros,
    at_rest,
    equal_positions,
    coarser,
    without_offset,
    scaled,
    equal_numbers,
    single_numbers,
    symmetric,
];

/// Runs of numbers that are aligned to their length: all, the halves of the step, edges, points and
/// single numbers.
fn runs() -> impl Iterator<Item = std::ops::Range<usize>> {
    [24, 12, 6, 3, 1]
        .into_iter()
        .flat_map(|length| (0..24 / length).map(move |run| run * length..(run + 1) * length))
}

/// Positions that are moved together: all, both ends of the step, edges, points.
const GROUPS: [&[usize]; 13] = [
    &[0, 1, 2, 3, 4, 5, 6, 7],
    &[0, 1, 2, 3],
    &[4, 5, 6, 7],
    &[0, 1, 4, 5],
    &[2, 3, 6, 7],
    &[0, 1],
    &[2, 3],
    &[4, 5],
    &[6, 7],
    &[0, 4],
    &[1, 5],
    &[2, 6],
    &[3, 7],
];

/// No radius, one, or one in place of two.
fn simpler_radius(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    let [first, second] = shape.radii;
    Box::new(
        [0.0, 1.0, first, second, first + second]
            .into_iter()
            .map(move |radius| Shape {
                radii: [radius, 0.0],
                ..shape
            }),
    )
}

fn zeros(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    Box::new(runs().map(move |run| shape.changed(run, |_| 0.0)))
}

/// Points that do not move, many at first: they stay where they start, or are from the start where
/// they end.
fn at_rest(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    let mut sets: Vec<usize> = (1..16).collect();
    sets.sort_by_key(|set| std::cmp::Reverse(set.count_ones()));
    Box::new(sets.into_iter().flat_map(move |set| {
        [0, 4].map(|kept| {
            let mut result = shape;
            for point in (0..4).filter(|point| set >> point & 1 == 1) {
                result.set_position(point + 4 - kept, shape.position(point + kept));
            }
            result
        })
    }))
}

/// Two points the same for the whole step, or two positions.
fn equal_positions(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    let copied = move |pairs: &[(usize, usize)]| {
        let mut result = shape;
        for &(from, to) in pairs {
            result.set_position(to, shape.position(from));
        }
        result
    };
    let points = pairs(4).map(move |(a, b)| copied(&[(a, b), (a + 4, b + 4)]));
    let positions = pairs(8).map(move |(a, b)| copied(&[(a, b)]));
    Box::new(points.chain(positions))
}

/// Ordered pairs of different numbers below `count`.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count)
        .flat_map(move |a| (0..count).map(move |b| (a, b)))
        .filter(|(a, b)| a != b)
}

/// Numbers rounded to a multiple of a power of two that leaves few bits of the largest.
fn coarser(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    Box::new(runs().flat_map(move |run| {
        BITS.map(|bits| {
            let round = rounding(&shape.numbers[run.clone()], bits);
            shape.changed(run.clone(), round)
        })
    }))
}

/// How many bits of the largest number are left.
pub(super) const BITS: [i64; 13] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40, 48, 52];

/// Rounds a number to a multiple of a power of two that leaves so many bits of the largest of these.
pub(super) fn rounding(numbers: &[f64], bits: i64) -> impl Fn(f64) -> f64 + use<> {
    let largest = numbers
        .iter()
        .fold(0.0, |largest: f64, number| largest.max(number.abs()));
    let (mantissa, exponent) = decompose(largest);
    let length = i64::from(i64::BITS - mantissa.leading_zeros());
    let unit = exponent + length - bits;
    move |number| scale(scale(number, -unit).round(), unit)
}

/// `number 2^exponent`, rounded once where it has to be.
fn scale(number: f64, exponent: i64) -> f64 {
    let exponent = exponent.clamp(-2200, 2200) as i32;
    // Three factors, each an f64.
    let third = exponent / 3;
    let power = |exponent| 2f64.powi(exponent);
    number * power(third) * power(third) * power(exponent - 2 * third)
}

/// Groups of positions shifted along an axis such that one of them is there at 0.
fn without_offset(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    Box::new(GROUPS.into_iter().flat_map(move |group| {
        (0..3).flat_map(move |axis| {
            let indices = move || group.iter().map(move |position| 3 * position + axis);
            indices().flat_map(move |index| {
                let offset = shape.numbers[index];
                let unit = lowest_bit(offset);
                [offset, unit].map(|by| shape.changed(indices(), |number| number - by))
            })
        })
    }))
}

/// The lowest bit that is set in a number, with its sign; 0 for 0.
pub(super) fn lowest_bit(number: f64) -> f64 {
    match decompose(number) {
        (0, _) => 0.0,
        (_, exponent) => scale(1.0, exponent).copysign(number),
    }
}

/// Everything, or one axis, times a power of two: to integers without a common factor of two, or
/// nearer to 1.
fn scaled(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    let axes = [0..3, 0..1, 1..2, 2..3];
    Box::new(axes.into_iter().flat_map(move |axes| {
        let indices = move || {
            let axes = axes.clone();
            (0..24).filter(move |index| axes.contains(&(index % 3)))
        };
        let lowest = indices()
            .filter(|&index| shape.numbers[index] != 0.0)
            .map(|index| decompose(shape.numbers[index]).1)
            .min()
            .unwrap_or(0);
        let exponents = [-lowest, -lowest / 2, -64, -8, -1, 1, 8, 64];
        exponents.map(move |exponent| {
            let result = shape.changed(indices(), |number| scale(number, exponent));
            Shape {
                radii: shape.radii.map(|radius| scale(radius, exponent)),
                ..result
            }
        })
    }))
}

/// Two coordinates on the same axis the same.
fn equal_numbers(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    Box::new((0..3).flat_map(move |axis| {
        pairs(8).map(move |(from, to)| {
            shape.changed([3 * to + axis], |_| shape.numbers[3 * from + axis])
        })
    }))
}

/// One number smaller or with fewer bits.
fn single_numbers(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    let shape = *shape;
    Box::new((0..24).flat_map(move |index| {
        let number = shape.numbers[index];
        simpler(number).map(|value| shape.changed([index], |_| value))
    }))
}

/// Numbers that may be simpler than this one.
pub(super) fn simpler(number: f64) -> [f64; 11] {
    let step = lowest_bit(number);
    let [half, whole] = [number / 2.0, number.trunc()];
    [
        1.0,
        -1.0,
        2.0,
        -2.0,
        3.0,
        -3.0,
        whole,
        half,
        -number,
        number - step,
        number + step,
    ]
}

/// The same motion seen otherwise: axes exchanged and reversed, time reversed, points renamed as
/// the kind of query allows.
fn symmetric(shape: &Shape) -> Box<dyn Iterator<Item = Shape>> {
    const AXES: [[usize; 3]; 6] = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let shape = *shape;
    let turned = move |axes: [usize; 3], signs: usize| {
        let mut result = shape;
        for index in 0..8 {
            let from = shape.position(index);
            let sign = |axis: usize| if signs >> axis & 1 == 1 { -1.0 } else { 1.0 };
            // Adding 0 turns -0 into 0.
            let to = [0, 1, 2].map(|axis| from[axes[axis]] * sign(axis) + 0.0);
            result.set_position(index, to);
        }
        result
    };
    let turns = AXES
        .into_iter()
        .flat_map(move |axes| (0..8).map(move |signs| turned(axes, signs)));
    let names: &[[usize; 4]] = match shape.kind {
        QueryKind::EdgeEdge => &[[1, 0, 2, 3], [0, 1, 3, 2], [2, 3, 0, 1], [1, 0, 3, 2]],
        QueryKind::VertexFace => &[[0, 2, 1, 3], [0, 1, 3, 2], [0, 3, 2, 1], [0, 2, 3, 1]],
    };
    let renamed = names
        .iter()
        .map(move |&[a, b, c, d]| shape.permuted([a, b, c, d, a + 4, b + 4, c + 4, d + 4]));
    let reversed = std::iter::once(shape.permuted([4, 5, 6, 7, 0, 1, 2, 3]));
    Box::new(turns.chain(renamed).chain(reversed))
}
