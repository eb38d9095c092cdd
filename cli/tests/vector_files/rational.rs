//! The exact time of a vector against the definitions, in rational arithmetic that shares nothing
//! with the judges: Sturm's theorem for roots, the distance at a time by trying all that can be
//! nearest.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::reader::{Bounds, Root, Vector};
use super::says;

/// Coefficients ascending, the last one not 0.
type Poly = Vec<BigRational>;

pub(crate) type Vector3 = [BigRational; 3];

/// What is wrong with the points or the exact time of a vector.
pub(crate) fn check(vector: &Vector) -> Result<(), String> {
    let decimals = vector.points.iter().flatten().chain(vector.radius.parts());
    let in_hex = vector.points_hex.iter().flatten();
    let in_hex: Vec<_> = in_hex.chain(vector.radius_hex.parts()).collect();
    says("radius", in_hex.len() == 24 + vector.radius.parts().len())?;
    for (decimal, hex) in decimals.zip(in_hex) {
        let value = hex_float(hex).ok_or_else(|| format!("{hex} is no hexadecimal float"))?;
        says(
            "points or radius",
            value == number(*decimal) && hex.starts_with('-') == decimal.is_sign_negative(),
        )?;
    }
    let Some(toi) = vector.result.toi else {
        return says("time of a miss", vector.exact_toi.is_none());
    };
    let exact = vector.exact_toi.as_ref().ok_or("no exact time of a hit")?;
    let is_tight = toi.below == toi.above || toi.below.next_up() == toi.above;
    says("bounds of the time are not neighbours", is_tight)?;
    let flagged = vector.flags.iter().any(|flag| flag == "IrrationalTime");
    match (&exact.fraction, &exact.root) {
        (Some(text), None) => {
            let time = fraction(text).ok_or("no fraction in lowest terms")?;
            says("flag of a fraction", !flagged)?;
            says("fraction out of bounds", is_within(&time, toi))?;
            says("no contact at the fraction", touch(vector, &time))
        }
        (None, Some(root)) => {
            says("flag of a root", flagged)?;
            check_root(vector, root, toi)
        }
        _ => Err("neither a fraction nor a root".to_owned()),
    }
}

/// The polynomial has exactly one root in the interval, which is within the bounds and a time at
/// which the distance can be the radius.
fn check_root(vector: &Vector, root: &Root, toi: Bounds) -> Result<(), String> {
    let integers: Option<Vec<BigInt>> = root
        .polynomial
        .iter()
        .map(|text| text.parse().ok())
        .collect();
    let integers = integers.ok_or("coefficients are no integers")?;
    let content = integers.iter().fold(BigInt::zero(), |gcd, c| gcd.gcd(c));
    says("a common divisor of the coefficients", content.is_one())?;
    let poly: Poly = integers.into_iter().map(BigRational::from).collect();
    let [low, high] = root.interval.each_ref().map(fraction);
    let (low, high) = low
        .zip(high)
        .ok_or("ends that are no fractions in lowest terms")?;
    says("interval", low < high && high <= BigRational::one())?;
    says(
        "an end is a root",
        !value(&poly, &low).is_zero() && !value(&poly, &high).is_zero(),
    )?;
    says(
        "not one root in the interval",
        roots_between(&poly, &low, &high) == 1,
    )?;
    let (below, above) = (number(toi.below), number(toi.above));
    let inner = [low.clone().max(below), high.clone().min(above)].map(|end| value(&poly, &end));
    says(
        "the root is out of bounds",
        (&inner[0] * &inner[1]).is_negative(),
    )?;
    let is_root = |border: &Poly| {
        let common = gcd(&poly, border);
        border.is_empty() || common.len() > 1 && roots_between(&common, &low, &high) == 1
    };
    says("no time of contact", is_of_a_border(vector, is_root))
}

pub(crate) fn number(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// `[-]0xH.HpE` by the definition of the text.
fn hex_float(text: &str) -> Option<BigRational> {
    let digits = text.trim_start_matches('-').strip_prefix("0x")?;
    let (digits, exponent) = digits.split_once('p')?;
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let mantissa = BigInt::parse_bytes([whole, part].concat().as_bytes(), 16)?;
    let exponent = exponent.parse::<i32>().ok()? - 4 * i32::try_from(part.len()).ok()?;
    let value = BigRational::from(mantissa) * BigRational::from(BigInt::from(2)).pow(exponent);
    Some(if text.starts_with('-') { -value } else { value })
}

pub(crate) fn fraction([numerator, denominator]: &[String; 2]) -> Option<BigRational> {
    let (n, d): (BigInt, BigInt) = (numerator.parse().ok()?, denominator.parse().ok()?);
    (d.is_positive() && n.gcd(&d).is_one()).then(|| BigRational::new(n, d))
}

fn is_within(value: &BigRational, Bounds { below, above }: Bounds) -> bool {
    *value >= number(below) && *value <= number(above) && (below < above || *value == number(below))
}

/// A, B, C and D at a time.
fn positions(vector: &Vector, time: &BigRational) -> [Vector3; 4] {
    [0, 1, 2, 3].map(|point| {
        [0, 1, 2].map(|axis| {
            let [start, end] = [point, point + 4].map(|index| number(vector.points[index][axis]));
            &start + (&end - &start) * time
        })
    })
}

/// The radius, squared.
fn radius_squared(vector: &Vector) -> BigRational {
    let radius: BigRational = vector.radius.parts().iter().map(|&part| number(part)).sum();
    &radius * &radius
}

/// Whether the two touch: the distance is the radius, or less at the start.
fn touch(vector: &Vector, time: &BigRational) -> bool {
    let distance = distance_squared(vector.is_of_edges(), &positions(vector, time));
    match time.is_zero() {
        true => distance <= radius_squared(vector),
        false => distance == radius_squared(vector),
    }
}

/// The least of the squared distances that can be it: of a vertex from an edge, of the insides of
/// both edges, or of the vertex from the inside of the face.
pub(crate) fn distance_squared(is_of_edges: bool, points: &[Vector3; 4]) -> BigRational {
    let [a, b, c, d] = points;
    let (of_ends, inside) = match is_of_edges {
        true => (
            vec![(a, c, d), (b, c, d), (c, a, b), (d, a, b)],
            between_lines(points),
        ),
        false => (vec![(a, b, c), (a, c, d), (a, b, d)], above_face(points)),
    };
    let of_ends = of_ends.into_iter().map(|(x, y, z)| from_edge(x, y, z));
    let least = of_ends.chain(inside).min();
    least.expect("there are vertices")
}

/// The squared distance of two lines, if their common normal meets both between the ends.
fn between_lines([a, b, c, d]: &[Vector3; 4]) -> Option<BigRational> {
    let (k, l, m) = (minus(b, a), minus(d, c), minus(c, a));
    let n = cross(&k, &l);
    let square = dot(&n, &n);
    if square.is_zero() {
        return None;
    }
    let u = dot(&cross(&m, &l), &n) / &square;
    let v = dot(&cross(&m, &k), &n) / &square;
    let height = dot(&n, &m);
    (is_unit(&u) && is_unit(&v)).then(|| &height * &height / &square)
}

/// The squared distance of A from the plane of the face, if it is above or below the face.
fn above_face([a, b, c, d]: &[Vector3; 4]) -> Option<BigRational> {
    let (e, g, w) = (minus(c, b), minus(d, b), minus(a, b));
    let n = cross(&e, &g);
    let square = dot(&n, &n);
    if square.is_zero() {
        return None;
    }
    let of_c = dot(&cross(&w, &g), &n) / &square;
    let of_d = dot(&cross(&e, &w), &n) / &square;
    let of_b = BigRational::one() - &of_c - &of_d;
    let height = dot(&n, &w);
    let is_inside = [of_b, of_c, of_d].iter().all(is_unit);
    is_inside.then(|| &height * &height / &square)
}

/// The squared distance of X from the edge YZ.
fn from_edge(x: &Vector3, y: &Vector3, z: &Vector3) -> BigRational {
    let (edge, to_x) = (minus(z, y), minus(x, y));
    let (along, length) = (dot(&to_x, &edge), dot(&edge, &edge));
    let nearest = match length.is_zero() {
        true => BigRational::zero(),
        false => (along / length).clamp(BigRational::zero(), BigRational::one()),
    };
    let rest = [0, 1, 2].map(|i| &to_x[i] - &edge[i] * &nearest);
    dot(&rest, &rest)
}

fn is_unit(value: &BigRational) -> bool {
    !value.is_negative() && *value <= BigRational::one()
}

fn minus(a: &Vector3, b: &Vector3) -> Vector3 {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

fn cross(a: &Vector3, b: &Vector3) -> Vector3 {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

fn dot(a: &Vector3, b: &Vector3) -> BigRational {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Whether this is so of one of the polynomials in time that are 0 where the distance becomes the
/// radius `R`: `f` without radius, and with one `f^2 - R^2 n^2` for the lines of both edges or the
/// plane of the face, `|w x e|^2 - R^2 e^2` for a vertex and an edge, `w^2 - R^2` for two vertices.
/// One that is 0 throughout has no coefficients.
fn is_of_a_border(vector: &Vector, is_so: impl Fn(&Poly) -> bool) -> bool {
    let is_so_of = |value: &dyn Fn([Vector3; 4]) -> BigRational| {
        is_so(&interpolated(|time| value(positions(vector, time))))
    };
    let normal_and_between = |[a, b, c, d]: &[Vector3; 4]| match vector.is_of_edges() {
        true => (cross(&minus(b, a), &minus(d, c)), minus(c, a)),
        false => (cross(&minus(c, b), &minus(d, b)), minus(a, b)),
    };
    let square = radius_squared(vector);
    if square.is_zero() {
        return is_so_of(&|points| {
            let (normal, between) = normal_and_between(&points);
            dot(&normal, &between)
        });
    }
    let inside = |points: [Vector3; 4]| {
        let (normal, between) = normal_and_between(&points);
        let height = dot(&normal, &between);
        &height * &height - &square * dot(&normal, &normal)
    };
    let at_edge = |[x, y, z]: [usize; 3], points: [Vector3; 4]| {
        let (w, edge) = (minus(&points[x], &points[y]), minus(&points[z], &points[y]));
        let moment = cross(&w, &edge);
        dot(&moment, &moment) - &square * dot(&edge, &edge)
    };
    let at_corner = |[x, y]: [usize; 2], points: [Vector3; 4]| {
        let w = minus(&points[x], &points[y]);
        dot(&w, &w) - &square
    };
    let (edges, corners): (&[_], &[_]) = match vector.is_of_edges() {
        true => (
            &[[0, 2, 3], [1, 2, 3], [2, 0, 1], [3, 0, 1]],
            &[[0, 2], [0, 3], [1, 2], [1, 3]],
        ),
        false => (
            &[[0, 1, 2], [0, 2, 3], [0, 1, 3]],
            &[[0, 1], [0, 2], [0, 3]],
        ),
    };
    let at_edges = || {
        edges
            .iter()
            .any(|&edge| is_so_of(&|points| at_edge(edge, points)))
    };
    let at_corners = || {
        corners
            .iter()
            .any(|&pair| is_so_of(&|points| at_corner(pair, points)))
    };
    is_so_of(&inside) || at_edges() || at_corners()
}

/// The polynomial of degree 6 at most with these values, by Newton's divided differences.
fn interpolated(value: impl Fn(&BigRational) -> BigRational) -> Poly {
    let times: Vec<_> = (0..=6).map(integer).collect();
    let mut differences: Vec<_> = times.iter().map(value).collect();
    for order in 1..times.len() {
        for i in (order..times.len()).rev() {
            let span = &times[i] - &times[i - order];
            differences[i] = (&differences[i] - &differences[i - 1]) / span;
        }
    }
    // Horner: p (t - t_i) + d_i.
    let mut poly = Poly::new();
    for (difference, time) in differences.iter().zip(&times).rev() {
        let mut next = vec![BigRational::zero(); poly.len() + 1];
        for (power, c) in poly.iter().enumerate() {
            next[power + 1] += c;
            next[power] -= c * time;
        }
        next[0] += difference;
        poly = next;
    }
    trimmed(poly)
}

fn integer(value: i64) -> BigRational {
    BigRational::from(BigInt::from(value))
}

fn trimmed(mut poly: Poly) -> Poly {
    while poly.last().is_some_and(Zero::is_zero) {
        poly.pop();
    }
    poly
}

fn value(poly: &Poly, at: &BigRational) -> BigRational {
    let horner = |sum: BigRational, c: &BigRational| sum * at + c;
    poly.iter().rev().fold(BigRational::zero(), horner)
}

/// How many different roots a polynomial has between two numbers that are none, by Sturm's theorem.
fn roots_between(poly: &Poly, low: &BigRational, high: &BigRational) -> usize {
    let derivative = poly
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, c)| c * integer(k as i64));
    let mut chain = vec![poly.clone(), derivative.collect()];
    while let [.., a, b] = &chain[..]
        && !b.is_empty()
    {
        let next = remainder(a, b).into_iter().map(|c| -c).collect();
        chain.push(scaled(next));
    }
    let variations = |at: &BigRational| {
        let signs = chain
            .iter()
            .map(|poly| value(poly, at).cmp(&BigRational::zero()));
        let signs: Vec<Ordering> = signs.filter(|sign| sign.is_ne()).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    };
    variations(low) - variations(high)
}

fn remainder(a: &Poly, b: &Poly) -> Poly {
    let mut rest = a.clone();
    let leading = b.last().expect("a divisor is not 0");
    while rest.len() >= b.len() {
        let factor = rest.last().expect("it is longer") / leading;
        let shift = rest.len() - b.len();
        for (c, divisor) in rest[shift..].iter_mut().zip(b) {
            *c -= &factor * divisor;
        }
        rest.pop();
        rest = trimmed(rest);
    }
    rest
}

fn gcd(a: &Poly, b: &Poly) -> Poly {
    if b.is_empty() {
        return a.clone();
    }
    gcd(b, &scaled(remainder(a, b)))
}

/// Times a number above 0, so that the leading coefficient is 1 or -1: it keeps the digits few.
fn scaled(poly: Poly) -> Poly {
    match poly.last().map(Signed::abs) {
        Some(leading) => poly.iter().map(|c| c / &leading).collect(),
        None => poly,
    }
}
