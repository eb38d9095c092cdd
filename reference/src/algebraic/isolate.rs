//! Isolation of the real roots in `[0, 1]`: Descartes' rule of signs on Bernstein coefficients,
//! with exact halving (Collins and Akritas 1976; Rouillier and Zimmermann 2004).

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
        _ => isolate_inside(rest, &mut found),
    }
    if ends_in_root {
        found.push(Algebraic::dyadic(Z::one(), 0));
    }
    found.sort_by(Algebraic::compare);
    found
}

/// The roots of `poly` in the open interval `(0, 1)`, whose ends are not roots.
///
/// Halving ends only if every root is simple. Mostly they are, and few halvings tell the roots
/// apart; if not, the square-free part takes the place of the polynomial.
fn isolate_inside<Z: Integer>(mut poly: Poly<Z>, found: &mut Vec<Algebraic<Z>>) {
    let mut depth = DEPTH_BEFORE_SQUARE_FREE;
    loop {
        let mut intervals = Vec::new();
        match halve(&poly, Z::zero(), 0, depth, &mut intervals) {
            Halving::Done => {
                let root = |interval| Algebraic::isolated(poly.clone(), interval);
                found.extend(intervals.into_iter().map(root));
                return;
            }
            Halving::Root(numerator, exponent) => {
                // A root at a point of division: take it out and isolate the others.
                poly = remove_root(poly, &numerator, exponent);
                found.push(Algebraic::dyadic(numerator, exponent));
            }
            Halving::TooDeep => {
                poly = poly.square_free_part();
                depth = u64::MAX;
            }
        }
    }
}

const DEPTH_BEFORE_SQUARE_FREE: u64 = 6;

/// How the halving of an interval ended.
enum Halving<Z> {
    /// Every root is isolated.
    Done,
    /// This number, numerator over a power of two, is a root and a point of division.
    Root(Z, u64),
    /// Some roots are not told apart at the depth allowed.
    TooDeep,
}

/// Isolating intervals of the roots of `local` in `(0, 1)`, which stands for the `position`-th of
/// `2^exponent` parts of the unit interval.
fn halve<Z: Integer>(
    local: &Poly<Z>,
    position: Z,
    exponent: u64,
    depth: u64,
    intervals: &mut Vec<Interval<Z>>,
) -> Halving<Z> {
    match local.sign_variations() {
        0 => return Halving::Done,
        1 => {
            let high = position.add(&Z::one());
            intervals.push(Interval::new(position, high, exponent));
            return Halving::Done;
        }
        _ if exponent >= depth => return Halving::TooDeep,
        _ => {}
    }
    let lower = local.stretch_lower_half();
    let upper = lower.shift_by_one();
    let (left, exponent) = (position.shl(1), exponent + 1);
    let right = left.add(&Z::one());
    if upper.coefficients()[0].is_zero() {
        return Halving::Root(right, exponent);
    }
    match halve(&lower, left, exponent, depth, intervals) {
        Halving::Done => halve(&upper, right, exponent, depth, intervals),
        stopped => stopped,
    }
}

/// `poly` divided by `2^exponent t - numerator` as often as it goes.
fn remove_root<Z: Integer>(mut poly: Poly<Z>, numerator: &Z, exponent: u64) -> Poly<Z> {
    let factor = Poly::new(vec![numerator.neg(), Z::one().shl(exponent)]);
    while poly.evaluate_dyadic(numerator, exponent).is_zero() {
        poly = poly.div_exact(&factor);
    }
    poly
}
