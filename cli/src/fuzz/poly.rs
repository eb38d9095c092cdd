//! Polynomials and real algebraic numbers against Sturm chains and Euclid's algorithm.

use arbitrary::{Arbitrary, Unstructured};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::euclid::{Polynomial, Sturm};
use tunnelproof_reference::algebraic::{Algebraic, isolate_roots};
use tunnelproof_reference::field;
use tunnelproof_reference::field::Integer;
use tunnelproof_reference::poly::Poly;

/// The backend of all that is compared: the one that is used.
type Z = field::Default;

/// How narrow the slow way makes an interval: a root of degree 9 is told from its neighbours
/// anyway.
const BITS: u64 = 24;

/// Compares everything about the two polynomials that these bytes make.
pub(super) fn check(bytes: &[u8]) -> Option<String> {
    let mut bytes = Unstructured::new(bytes);
    // A common factor gives common roots, and taken twice multiple ones.
    let [common, p, q] = [(); 3].map(|()| coefficients(&mut bytes));
    let is_double = bool::arbitrary(&mut bytes).unwrap_or(false);
    let p = product(&p, &common);
    let q = product(
        &q,
        &if is_double {
            product(&common, &common)
        } else {
            common
        },
    );
    let [fast_p, fast_q] =
        [&p, &q].map(|c| Poly::<Z>::new(c.iter().map(|&c| integer(c)).collect()));
    let [slow_p, slow_q] =
        [&p, &q].map(|c| Polynomial::new(c.iter().map(|&c| BigInt::from(c)).collect()));
    let what = if slow(&fast_p.gcd(&fast_q)).positive() != slow_p.gcd(&slow_q) {
        "the greatest common divisor"
    } else if slow_p.is_zero() {
        return None;
    } else {
        roots(&fast_p, &fast_q, &slow_p, &slow_q)?
    };
    Some(format!("{what} of {p:?} and {q:?}"))
}

fn roots(
    p: &Poly<Z>,
    q: &Poly<Z>,
    slow_p: &Polynomial,
    slow_q: &Polynomial,
) -> Option<&'static str> {
    let chain = Sturm::new(slow_p);
    let (found, intervals) = (isolate_roots(p), chain.roots(BITS));
    if found.len() != intervals.len() {
        return Some("the number of roots");
    }
    let signs = slow_q.signs_at(&chain, &intervals);
    for ((root, interval), sign) in found.iter().zip(&intervals).zip(signs) {
        let ends = interval.ends();
        let [low, high] = ends.each_ref().map(|end| root.compare(&number(end)));
        // The interval around the root 0 begins below it.
        let begins_below = ends[0] < BigRational::zero();
        if !(begins_below && root.is_zero() || low.is_gt() && high.is_le()) {
            return Some("the place of a root");
        }
        if root.sign_of(q) != sign {
            return Some("the sign at a root");
        }
        let enclosure = root.enclosure();
        let [below, above] = [enclosure.below, enclosure.above].map(exact);
        let is_enclosed = root.compare(&number(&below)).is_ge()
            && root.compare(&number(&above)).is_le()
            && (below == above || enclosure.below.next_up() == enclosure.above);
        if !is_enclosed {
            return Some("the enclosure of a root");
        }
    }
    None
}

fn integer(value: i64) -> Z {
    <Z as Integer>::from_i64(value)
}

fn slow(poly: &Poly<Z>) -> Polynomial {
    let digits = poly.coefficients().iter().map(|c| c.to_string().parse());
    // What is written in decimal is read.
    Polynomial::new(digits.map(Result::unwrap_or_default).collect())
}

/// A dyadic rational, those below 0 as 0.
fn number(value: &BigRational) -> Algebraic<Z> {
    let exponent = value.denom().bits() - 1;
    let numerator = <Z as Integer>::from_decimal(&value.numer().to_string());
    match numerator {
        Some(numerator) if Integer::sign(&numerator).is_ge() => {
            Algebraic::dyadic(numerator, exponent)
        }
        _ => Algebraic::zero(),
    }
}

fn exact(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap_or_else(BigRational::one)
}

/// Up to five coefficients, small or of 16 bits.
fn coefficients(bytes: &mut Unstructured) -> Vec<i64> {
    let mut next = || u8::arbitrary(bytes).unwrap_or(0);
    let (count, is_large) = (next() % 5, next() % 4 == 0);
    (0..=count)
        .map(|_| match (i64::from(next() as i8), is_large) {
            (small, false) => small % 12,
            (high, true) => high << 8 | i64::from(next()),
        })
        .collect()
}

fn product(a: &[i64], b: &[i64]) -> Vec<i64> {
    let mut product = vec![0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}
