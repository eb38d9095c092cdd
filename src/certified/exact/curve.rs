//! The polynomials whose roots are times of contact.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::fraction::Fraction;
use super::grid_time::GridTime;
use super::motion::{Cubic, Quadratic};
use super::poly::Poly;
use super::width::{Number, Width};

/// A polynomial of a motion.
pub(super) enum Curve<L: Width> {
    Quadratic(Quadratic<L>),
    Cubic(Cubic<L>),
}

impl<L: Width> Curve<L> {
    /// The signs of the Bernstein coefficients on `[0, 1]`.
    pub(super) fn bernstein_signs(&self) -> SmallVec<[Ordering; 4]> {
        match self {
            Curve::Quadratic(c) => SmallVec::from_slice(&bernstein_signs::<L>(c)),
            Curve::Cubic([c0, c1, c2, c3]) => {
                // 3 c0, 3 c0 + c1, 3 c0 + 2 c1 + c2, 3 (c0 + c1 + c2 + c3)
                let both = c0.add(c1);
                let second = both.add(c0).add(c0);
                let third = second.add(c1).add(c2);
                let last = both.add(c2).add(c3);
                SmallVec::from_buf([c0.sign(), second.sign(), third.sign(), last.sign()])
            }
        }
    }

    /// The sign of the discriminant of a polynomial of degree 2.
    pub(super) fn discriminant_sign(&self) -> Option<Ordering> {
        let Curve::Quadratic([c0, c1, c2]) = self else {
            return None;
        };
        let product = L::times_quadratics(c0, c2);
        let twice = product.add(&product);
        Some(L::times_quadratics(c1, c1).sub(&twice).sub(&twice).sign())
    }

    /// The derivative of a polynomial of degree 2.
    pub(super) fn derivative(&self) -> Option<Self> {
        match self {
            Curve::Quadratic([_, c1, c2]) => {
                let zero = c1.sub(c1);
                Some(Curve::Quadratic([c1.clone(), c2.add(c2), zero]))
            }
            Curve::Cubic(_) => None,
        }
    }

    /// The coefficients in floating point.
    pub(super) fn approximate(&self) -> [f64; 4] {
        match self {
            Curve::Quadratic([c0, c1, c2]) => [c0.to_f64(), c1.to_f64(), c2.to_f64(), 0.0],
            Curve::Cubic([c0, c1, c2, c3]) => [c0.to_f64(), c1.to_f64(), c2.to_f64(), c3.to_f64()],
        }
    }

    /// The sign of the value at a time, and the value in floating point.
    pub(super) fn sample(&self, at: GridTime) -> (Ordering, f64) {
        match self {
            Curve::Quadratic(c) => {
                let value = L::quadratic_at(c, at.0);
                (value.sign(), value.to_f64() * 2f64.powi(-256))
            }
            Curve::Cubic(c) => {
                let value = L::cubic_at(c, at.0);
                (value.sign(), value.to_f64() * 2f64.powi(-384))
            }
        }
    }

    /// Whether a fraction is a root.
    pub(super) fn is_root(&self, at: Fraction) -> bool {
        match self {
            Curve::Quadratic(c) => L::quadratic_at_fraction(c, at).is_zero(),
            Curve::Cubic(c) => L::cubic_at_fraction(c, at).is_zero(),
        }
    }

    /// The same polynomial.
    pub(super) fn to_poly(&self) -> Poly {
        match self {
            Curve::Quadratic(c) => Poly::new(c),
            Curve::Cubic(c) => Poly::new(c),
        }
    }
}

/// The signs of the Bernstein coefficients on `[0, 1]`.
pub(super) fn bernstein_signs<L: Width>([c0, c1, c2]: &Quadratic<L>) -> [Ordering; 3] {
    // 2 c0, 2 c0 + c1, 2 (c0 + c1 + c2)
    let both = c0.add(c1);
    [c0.sign(), both.add(c0).sign(), both.add(c2).sign()]
}
