//! The exact time of a vector against the definitions, in rational arithmetic that shares nothing with
//! the judges: Sturm's theorem for roots, the definition of contact at a time.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::reader::{Bounds, Root, Vector};
use super::says;

/// Coefficients ascending, the last one not 0.
type Poly = Vec<BigRational>;

type Vector3 = [BigRational; 3];

/// What is wrong with the points or the exact time of a vector.
pub(crate) fn check(vector: &Vector) -> Result<(), String> {
    for (decimal, hex) in vector
        .points
        .iter()
        .flatten()
        .zip(vector.points_hex.iter().flatten())
    {
        let value = hex_float(hex).ok_or_else(|| format!("{hex} is no hexadecimal float"))?;
        says(
            "points",
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
            says(
                "no contact at the fraction",
                touch(&positions(vector, &time)),
            )
        }
        (None, Some(root)) => {
            says("flag of a root", flagged)?;
            check_root(vector, root, toi)
        }
        _ => Err("neither a fraction nor a root".to_owned()),
    }
}

/// The polynomial has exactly one root in the interval, which is within the bounds and a root of the
/// cubic.
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
    let cubic = cubic(vector);
    let common = gcd(&poly, &cubic);
    says(
        "no root of the cubic",
        cubic.is_empty() || common.len() > 1 && roots_between(&common, &low, &high) == 1,
    )
}

fn number(value: f64) -> BigRational {
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

fn fraction([numerator, denominator]: &[String; 2]) -> Option<BigRational> {
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

/// Whether two edges touch, by definition: `A + u K = C + v L` for some `u` and `v` in `[0, 1]`.
fn touch([a, b, c, d]: &[Vector3; 4]) -> bool {
    let (k, l, m) = (minus(b, a), minus(d, c), minus(c, a));
    let n = cross(&k, &l);
    if is_zero(&n) {
        // Parallel, or an edge is a point: then an end of one edge is on the other.
        return on(a, c, d) || on(b, c, d) || on(c, a, b) || on(d, a, b);
    }
    let square = dot(&n, &n);
    let u = dot(&cross(&m, &l), &n) / &square;
    let v = dot(&cross(&m, &k), &n) / &square;
    dot(&n, &m).is_zero() && is_unit(&u) && is_unit(&v)
}

/// Whether X is on the edge YZ.
fn on(x: &Vector3, y: &Vector3, z: &Vector3) -> bool {
    let (to_y, to_z) = (minus(y, x), minus(z, x));
    is_zero(&cross(&to_y, &to_z)) && !dot(&to_y, &to_z).is_positive()
}

fn is_unit(value: &BigRational) -> bool {
    !value.is_negative() && *value <= BigRational::one()
}

fn is_zero(vector: &Vector3) -> bool {
    vector.iter().all(Zero::is_zero)
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

/// `(K x L) . M`, through its values at four times.
fn cubic(vector: &Vector) -> Poly {
    let times = [0, 1, 2, 3].map(|time| BigRational::from(BigInt::from(time)));
    let values = times.each_ref().map(|time| {
        let [a, b, c, d] = positions(vector, time);
        dot(&cross(&minus(&b, &a), &minus(&d, &c)), &minus(&c, &a))
    });
    // Newton's divided differences, equal steps of 1.
    let [f0, f1, f2, f3] = values;
    let (d1, e1, g1) = (&f1 - &f0, &f2 - &f1, &f3 - &f2);
    let (d2, e2) = ((&e1 - &d1) / integer(2), (&g1 - &e1) / integer(2));
    let d3 = (&e2 - &d2) / integer(3);
    // f0 + d1 t + d2 t (t - 1) + d3 t (t - 1) (t - 2)
    trimmed(vec![
        f0,
        &d1 - &d2 + &d3 * integer(2),
        &d2 - &d3 * integer(3),
        d3,
    ])
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
        chain.push(next);
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
    gcd(b, &remainder(a, b))
}
