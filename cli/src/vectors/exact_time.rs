//! A time of impact written down exactly.

use serde::Serialize;

use tunnelproof_reference::algebraic::{Algebraic, isolate_roots};
use tunnelproof_reference::field::{Integer, Ratio};

/// A rational number: numerator and denominator in decimal digits, in lowest terms.
pub(super) type Fraction = [String; 2];

/// A real algebraic number in `[0, 1]`: a fraction, or a root of a polynomial if it is irrational.
#[derive(Serialize)]
pub(super) struct ExactTime {
    fraction: Option<Fraction>,
    root: Option<Root>,
}

/// The only root of a polynomial in an interval.
#[derive(Serialize)]
struct Root {
    /// Integer coefficients in decimal digits, ascending; without common divisor, every root
    /// simple.
    polynomial: Vec<String>,
    /// Strictly inside is the number and no other root; neither end is one.
    interval: [Fraction; 2],
}

impl ExactTime {
    pub(super) fn new<Z: Integer>(time: &Algebraic<Z>) -> Self {
        match time.rational() {
            Some(ratio) => ExactTime {
                fraction: Some(fraction(&ratio)),
                root: None,
            },
            None => ExactTime {
                fraction: None,
                root: Some(Root::new(time)),
            },
        }
    }

    /// The fraction, if it is one.
    pub(super) fn into_fraction(self) -> Option<Fraction> {
        self.fraction
    }

    /// Whether it is a root of a polynomial and no fraction.
    pub(super) fn is_irrational(&self) -> bool {
        self.root.is_some()
    }
}

impl Root {
    /// The interval is the one that isolation gives, not the one that questions have narrowed: it
    /// has the fewest digits.
    fn new<Z: Integer>(time: &Algebraic<Z>) -> Self {
        let polynomial = time.poly().square_free_part();
        let bounds = isolate_roots(&polynomial).into_iter().find_map(|root| {
            let bounds = root.bounds();
            root.compare(time).is_eq().then_some(bounds)
        });
        let (low, high, exponent) = bounds.unwrap_or_else(|| time.bounds());
        Root {
            polynomial: polynomial.coefficients().iter().map(Z::to_string).collect(),
            interval: [low, high].map(|end| fraction(&Z::Ratio::new(end, Z::one().shl(exponent)))),
        }
    }
}

fn fraction<R: Ratio>(ratio: &R) -> Fraction {
    [
        ratio.numerator().to_string(),
        ratio.denominator().to_string(),
    ]
}
