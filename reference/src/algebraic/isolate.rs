//! Isolation of the real roots in `[0, 1]`: Descartes' rule of signs on Bernstein coefficients, with
//! exact halving (Collins and Akritas 1976; Rouillier and Zimmermann 2004).

use crate::field::Integer;
use crate::poly::Poly;

use super::{Algebraic, Interval};

/// The distinct roots of `poly` in `[0, 1]`, ascending; none for the zero polynomial.
pub fn isolate_roots<Z: Integer>(poly: &Poly<Z>) -> Vec<Algebraic<Z>> {
    let mut found = Vec::new();
    if poly.is_zero() {
        return found;
    }
    let mut rest = poly.clone();
    if rest.coefficients()[0].is_zero() {
        found.push(Algebraic::zero());
        rest = remove_root(rest, &Z::zero(), 0);
    }
    let ends_in_root = rest.at_one().is_zero();
    if ends_in_root {
        rest = remove_root(rest, &Z::one(), 0);
    }
    match rest.sign_variations() {
        0 => {}
        1 => found.push(Algebraic::isolated(rest, Interval::unit())),
        _ => isolate_inside(rest.square_free_part(), &mut found),
    }
    if ends_in_root {
        found.push(Algebraic::dyadic(Z::one(), 0));
    }
    found.sort_by(Algebraic::compare);
    found
}

/// The roots of the square-free `poly` in the open interval `(0, 1)`, whose ends are not roots.
fn isolate_inside<Z: Integer>(mut poly: Poly<Z>, found: &mut Vec<Algebraic<Z>>) {
    loop {
        let mut intervals = Vec::new();
        match halve(&poly, Z::zero(), 0, &mut intervals) {
            Some((numerator, exponent)) => {
                // A root at a point of division: take it out and isolate the others.
                poly = remove_root(poly, &numerator, exponent);
                found.push(Algebraic::dyadic(numerator, exponent));
            }
            None => {
                let root = |interval| Algebraic::isolated(poly.clone(), interval);
                found.extend(intervals.into_iter().map(root));
                return;
            }
        }
    }
}

/// Isolating intervals of the roots of `local` in `(0, 1)`, which stands for the `position`-th of
/// `2^exponent` parts of the unit interval. Stops at a root at a point of division and returns it.
fn halve<Z: Integer>(
    local: &Poly<Z>,
    position: Z,
    exponent: u64,
    intervals: &mut Vec<Interval<Z>>,
) -> Option<(Z, u64)> {
    match local.sign_variations() {
        0 => return None,
        1 => {
            let high = position.add(&Z::one());
            intervals.push(Interval::new(position, high, exponent));
            return None;
        }
        _ => {}
    }
    let lower = local.stretch_lower_half();
    let upper = lower.shift_by_one();
    let (left, exponent) = (position.shl(1), exponent + 1);
    let right = left.add(&Z::one());
    if upper.coefficients()[0].is_zero() {
        return Some((right, exponent));
    }
    halve(&lower, left, exponent, intervals).or_else(|| halve(&upper, right, exponent, intervals))
}

/// `poly` divided by `2^exponent t - numerator` as often as it goes.
fn remove_root<Z: Integer>(mut poly: Poly<Z>, numerator: &Z, exponent: u64) -> Poly<Z> {
    let factor = Poly::new(vec![numerator.neg(), Z::one().shl(exponent)]);
    while poly.evaluate_dyadic(numerator, exponent).is_zero() {
        poly = poly.div_exact(&factor);
    }
    poly
}
