//! Queries whose corners mix large powers of two with subnormal numbers: where products underflow,
//! an error bound that is relative to what is computed is not enough.
//!
//! The cascade and the exact stage give the same answer, and a share of them is judged by the
//! oracle. `TUNNELPROOF_CASES` sets the number of queries of each shape.

use std::fmt::Debug;

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::certified::{Clearance, Kind, advance, decide, decide_exactly};
use tunnelproof::contact::{EdgePlace, FacePlace, Hit};
use tunnelproof::query::{EdgeEdge, Point, Query, Radius, VertexFace};
use tunnelproof_reference::oracle;

use corners::{Corners, cases};

#[allow(dead_code, reason = "shared with tests that draw by strategies")]
mod corners;

/// How many of the queries without a radius the oracle judges, and with one: one in so many.
const JUDGED: [u32; 2] = [16, 128];

/// What draws the corners of a query, and its radius.
struct Shape {
    name: &'static str,
    usual: u32,
    draw: fn(&mut ChaCha8Rng) -> (Corners, f64),
}

const SHAPES: &[Shape] = &[
    Shape {
        name: "mixed",
        usual: 500,
        draw: |rng| (degenerate(rng, mixed), 0.0),
    },
    Shape {
        name: "mixed, with a radius",
        usual: 30,
        draw: |rng| (degenerate(rng, mixed), radius(rng)),
    },
    Shape {
        name: "along",
        usual: 2_000,
        draw: |rng| (degenerate(rng, along), 0.0),
    },
    Shape {
        name: "along, with a radius",
        usual: 60,
        draw: |rng| (degenerate(rng, along), radius(rng)),
    },
    Shape {
        name: "near an end",
        usual: 3_000,
        draw: |rng| (near_end(rng), 0.0),
    },
    Shape {
        name: "near an f64",
        usual: 3_000,
        draw: |rng| (near_f64(rng), 0.0),
    },
    Shape {
        name: "short",
        usual: 1_000,
        draw: short,
    },
];

/// `m 2^exponent` with `m` from 1 to 2 or from -2 to -1, rounded where that is subnormal.
fn number(rng: &mut impl Rng, exponent: i32) -> f64 {
    let sign = if rng.random() { 1.0 } else { -1.0 };
    sign * rng.random_range(1.0..2.0) * power(exponent)
}

fn power(exponent: i32) -> f64 {
    let half = exponent / 2;
    2f64.powi(half) * 2f64.powi(exponent - half)
}

/// A few units of the smallest number.
fn units(rng: &mut impl Rng, most: i64) -> f64 {
    rng.random_range(-most..=most) as f64 * f64::from_bits(1)
}

/// A magnitude that matters to some bound.
fn exponent(rng: &mut impl Rng) -> i32 {
    match rng.random_range(0..8) {
        0..3 => rng.random_range(-1074..-1000),
        3 => rng.random_range(-700..-400),
        4..6 => rng.random_range(-300..=300),
        6 => rng.random_range(160..180),
        _ => rng.random_range(-1000..=1000),
    }
}

/// Every coordinate of one of two to four magnitudes, or 0.
fn mixed(rng: &mut ChaCha8Rng) -> Corners {
    let magnitudes: Vec<_> = (0..rng.random_range(2..5)).map(|_| exponent(rng)).collect();
    [(); 8].map(|()| {
        [(); 3].map(|()| match rng.random_range(0..12) {
            0 | 1 => 0.0,
            i => number(rng, magnitudes[i % magnitudes.len()]),
        })
    })
}

/// `A`, `B - A`, `D - C` and `C - A` of a magnitude for each axis, where `C - A` changes its sign
/// on one.
fn along(rng: &mut ChaCha8Rng) -> Corners {
    let magnitudes = [(); 4].map(|()| [(); 3].map(|()| exponent(rng)));
    let turned = rng.random_range(0..3);
    let mut draw = |i: usize| magnitudes[i].map(|exponent| number(rng, exponent));
    let mut ends = [[draw(0), draw(1), draw(2), draw(3)]; 2];
    let last = [draw(0), draw(1), draw(2), draw(3)];
    if rng.random() {
        ends[1] = last;
    }
    ends[1][3][turned] = -ends[1][3][turned].abs().copysign(ends[0][3][turned]);
    corners(ends)
}

/// The corners with given `A`, `B - A`, `D - C` and `C - A` at both ends of the step, rounded.
fn corners(ends: [[[f64; 3]; 4]; 2]) -> Corners {
    let add = |x: [f64; 3], y: [f64; 3]| [x[0] + y[0], x[1] + y[1], x[2] + y[2]];
    let [start, end] = ends.map(|[a, k, l, m]| {
        let c = add(a, m);
        [a, add(a, k), c, add(c, l)]
    });
    [
        start[0], start[1], start[2], start[3], end[0], end[1], end[2], end[3],
    ]
}

/// The same, often made coplanar, parallel, collinear, or with corners in common.
fn degenerate(rng: &mut ChaCha8Rng, draw: fn(&mut ChaCha8Rng) -> Corners) -> Corners {
    let mut x = draw(rng);
    match rng.random_range(0..8) {
        0 => x.iter_mut().for_each(|point| point[2] = point[1]),
        1 => x.iter_mut().for_each(|point| point[1] = 0.0),
        2 => (0..3).for_each(|i| {
            x[3][i] = x[2][i] + (x[1][i] - x[0][i]);
            x[7][i] = x[6][i] + (x[5][i] - x[4][i]);
        }),
        3 => x.iter_mut().for_each(|point| *point = [point[0]; 3]),
        4 => x[2] = x[0],
        5 => (x[2], x[6]) = (x[0], x[4]),
        _ => {}
    }
    // A sum may overflow.
    x.map(|point| point.map(|x| x.clamp(-f64::MAX, f64::MAX)))
}

fn radius(rng: &mut ChaCha8Rng) -> f64 {
    let exponent = exponent(rng);
    number(rng, exponent).abs()
}

/// Large edges across each other: `AB` goes by `CD` so near to an end that products with subnormal
/// numbers tell on which side.
fn near_end(rng: &mut ChaCha8Rng) -> Corners {
    let large = rng.random_range(100..179);
    let mut long = || [number(rng, large), number(rng, large), 0.0];
    let (k, l) = (long(), long());
    let height = rng.random_range(-250..100);
    let mut m = |sign: f64| {
        let z = sign * number(rng, height).abs();
        [units(rng, 6), units(rng, 6), z]
    };
    let (first, last) = (m(1.0), m(-1.0));
    // From C or from D, towards A or B.
    let l_start = if rng.random() { l } else { l.map(|x| -x) };
    corners([[[0.0; 3], k, l_start, first], [[0.0; 3], k, l_start, last]])
}

/// Large edges that cross at a time that is within about `2^-66` of an `f64`.
fn near_f64(rng: &mut ChaCha8Rng) -> Corners {
    let large = rng.random_range(170..179);
    let mut long = |x: f64, y: f64| {
        let size = rng.random_range(1.0..2.0) * power(large);
        [x * size, y * size, 0.0]
    };
    let (k, l) = (long(1.0, 0.25), long(-0.25, 1.0));
    let middle = [0, 1, 2].map(|i| 0.5 * (k[i] - l[i]));
    // Heights of C in units of 2^-1074, and the time in units of 2^-53.
    let digits = rng.random_range(53..80);
    let mut height = || i128::from(rng.random_range(1i64 << 52..1 << 53)) << (digits - 53);
    let (first, last) = (height(), height());
    let time = (first as f64 / (first + last) as f64 * 2f64.powi(53)) as i128;
    // `first (1 - time) - last time`, rounded: the height of A.
    let (whole, rest) = (1i128 << 40, 1i128 << 13);
    let rough = |time: i128| ((time / rest) * ((first + last) / 8)) / (whole / 8);
    let fine = |time: i128| ((time % rest) * ((first + last) / 8)) / (rest * whole / 8);
    let level = first - rough(time) - fine(time);
    let number = |x: i128| x as f64 * f64::from_bits(1);
    let [x, y, _] = middle;
    let at = |z: i128| [x, y, number(z)];
    let a = [0.0, 0.0, number(level)];
    let end = |c: [f64; 3]| {
        let add = |p: [f64; 3], q: [f64; 3]| [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
        [a, add(a, k), c, add(c, l)]
    };
    let ([a, b, c, d], [e, f, g, h]) = (end(at(first)), end(at(-last)));
    [a, b, c, d, e, f, g, h]
}

/// An edge so short that products with subnormal numbers tell which end is nearer to a large one
/// that comes near.
fn short(rng: &mut ChaCha8Rng) -> (Corners, f64) {
    let (slim, large) = (rng.random_range(-604..-596), 176);
    let mut k = || [0.0, units(rng, 6), 0.0];
    let (mut first, mut last) = (k(), k());
    (first[0], last[0]) = (power(slim), power(slim));
    let l = [0.0, 0.0, power(large)];
    let aside = number(rng, -1073 + large - slim);
    let m = |size: f64| [aside, size * power(large), power(large - 2)];
    let (far, near) = (m(rng.random_range(2.0..3.0)), m(rng.random_range(0.5..1.0)));
    let radius = rng.random_range(1.0..2.0) * power(large);
    (
        corners([[[0.0; 3], first, l, far], [[0.0; 3], last, l, near]]),
        radius,
    )
}

/// Parameters or weights, and a bound on their error.
trait Weights: Debug {
    fn weights(&self) -> (Vec<f64>, f64);
}

impl Weights for EdgePlace {
    fn weights(&self) -> (Vec<f64>, f64) {
        let places = [Some(self.first), self.second].into_iter().flatten();
        (
            places.flat_map(|place| [place.u, place.v]).collect(),
            self.error,
        )
    }
}

impl Weights for FacePlace {
    fn weights(&self) -> (Vec<f64>, f64) {
        (self.weights.to_vec(), self.error)
    }
}

/// Whether two hits say the same, up to the errors of their places.
fn is_same<P: Weights>(x: &Hit<P>, y: &Hit<P>) -> bool {
    let rest = |x: &Hit<P>| {
        let Hit {
            toi,
            toi_above,
            kind,
            side,
            case,
            flags,
            ..
        } = x;
        format!(
            "{:?}",
            (toi.to_bits(), toi_above.to_bits(), kind, side, case, flags)
        )
    };
    let ((x_weights, x_error), (y_weights, y_error)) = (x.place.weights(), y.place.weights());
    let is_near = |(x, y): (&f64, &f64)| (x - y).abs() <= x_error + y_error;
    rest(x) == rest(y)
        && x_weights.len() == y_weights.len()
        && x_weights.iter().zip(&y_weights).all(is_near)
}

/// What is wrong with the answers to a query.
fn judge<K: Kind<Place: Weights> + Debug>(
    query: &K,
    oracle: Option<&Query>,
    again: impl Fn([Point; 4], Radius) -> K,
) -> Result<bool, String> {
    let (quick, exact) = (decide(query), decide_exactly(query));
    let is_right = match (&quick, &exact) {
        (Some(quick), Some(exact)) => is_same(quick, exact),
        (quick, exact) => quick.is_none() && exact.is_none(),
    };
    if !is_right {
        return Err(format!("{quick:#?} instead of {exact:#?} for {query:?}"));
    }
    if let Some(oracle) = oracle {
        let truth = oracle::decide_query(oracle);
        let truth = truth.hit.map(|hit| (hit.toi.below, hit.toi.above));
        let exact = exact.as_ref().map(|hit| (hit.toi, hit.toi_above));
        if truth != exact {
            return Err(format!("{exact:?} instead of {truth:?} for {query:?}"));
        }
        let moved = advance(query, Clearance::None).map_err(|error| error.to_string())?;
        if let Some(kept) = moved.kept {
            let hit = decide_exactly(&again(moved.points, kept));
            if hit.is_some() {
                return Err(format!("{moved:?} touches: {hit:?} for {query:?}"));
            }
        }
    }
    Ok(exact.is_some())
}

/// Judges queries of a shape, of either kind; how many are hits.
fn judge_shape(shape: &Shape) -> u32 {
    let mut hits = 0;
    let count = cases(shape.usual);
    for index in 0..count {
        let mut rng = ChaCha8Rng::seed_from_u64(2026);
        rng.set_stream(u64::from(index));
        let (corners, radius) = (shape.draw)(&mut rng);
        let p = corners.map(Point::from);
        let (start, end) = ([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]]);
        let one_in = JUDGED[usize::from(radius > 0.0)];
        let is_judged = index % one_in == 0;
        let edges = |end, radius| EdgeEdge::new(start, end, radius).expect("finite");
        let face = |end, radius| VertexFace::new(start, end, radius).expect("finite");
        let radius = Radius::from(radius);
        let (first, second) = (edges(end, radius), face(end, radius));
        let (of_first, of_second) = (Query::EdgeEdge(first), Query::VertexFace(second));
        let found = [
            judge(&first, is_judged.then_some(&of_first), edges),
            judge(&second, is_judged.then_some(&of_second), face),
        ];
        for found in found {
            match found {
                Ok(is_hit) => hits += u32::from(is_hit),
                Err(error) => unreachable!("{}, query {index}: {error}", shape.name),
            }
        }
    }
    eprintln!("{}: {hits} hits of {}", shape.name, 2 * count);
    hits
}

macro_rules! shapes {
    ($($test:ident: $index:literal)*) => {$(
        #[test]
        fn $test() {
            assert!(judge_shape(&SHAPES[$index]) > 0, "hits as well");
        }
    )*};
}

shapes! {
    underflow_of_mixed_magnitudes_changes_no_answer: 0
    underflow_of_mixed_magnitudes_changes_no_answer_with_a_radius: 1
    underflow_of_magnitudes_by_axis_changes_no_answer: 2
    underflow_of_magnitudes_by_axis_changes_no_answer_with_a_radius: 3
    underflow_near_an_end_makes_no_false_hit: 4
    underflow_near_an_f64_changes_no_time: 5
    underflow_in_a_short_edge_changes_no_place: 6
}
