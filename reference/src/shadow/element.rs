//! Numbers at a root: the field of rational functions of one real algebraic number.
//!
//! Where the thesis computes with `t_k`, a root that `Solve` found, every value is a quotient of
//! two polynomials in `t_k` with integer coefficients. It is kept as that quotient, without a
//! common divisor taken out: a static test is a few dozen operations long, its degrees stay small,
//! and divisors cost more than they save.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use crate::algebraic::Algebraic;
use crate::field::{Integer, OrderedField};
use crate::poly::Poly;

/// An element of `Q(t_k)`: two polynomials and the number at which they are taken.
#[derive(Clone, Debug)]
pub(super) struct Element<'a, Z> {
    numerator: Rc<Poly<Z>>,
    /// Above 0 at the number; `None` is 1.
    denominator: Option<Rc<Poly<Z>>>,
    /// `None` for constants.
    at: Option<&'a Algebraic<Z>>,
}

impl<'a, Z: Integer> Element<'a, Z> {
    /// The integer `value`.
    pub(super) fn constant(value: &Z) -> Self {
        Element {
            numerator: Rc::new(Poly::constant(value.clone())),
            denominator: None,
            at: None,
        }
    }

    /// `position + velocity t_k`, with `at` for `t_k`.
    pub(super) fn moved(position: &Z, velocity: &Z, at: &'a Algebraic<Z>) -> Self {
        Element {
            numerator: Rc::new(Poly::new(vec![position.clone(), velocity.clone()])),
            denominator: None,
            at: Some(at),
        }
    }

    fn sign_of(&self, poly: &Poly<Z>) -> Ordering {
        match self.at {
            Some(at) => at.sign_of(poly),
            None => poly.leading().map_or(Ordering::Equal, Z::sign),
        }
    }

    fn has_denominator_of(&self, other: &Self) -> bool {
        match (&self.denominator, &other.denominator) {
            (None, None) => true,
            (Some(a), Some(b)) => Rc::ptr_eq(a, b) || a == b,
            _ => false,
        }
    }

    /// `step(self, other)` over a common denominator.
    fn combine(self, other: Self, step: fn(&mut Poly<Z>, &Poly<Z>)) -> Self {
        let at = self.common_root(&other);
        let (mut numerator, term, denominator) = if self.has_denominator_of(&other) {
            (self.numerator, other.numerator, self.denominator)
        } else {
            (
                times(&self.numerator, other.denominator.as_ref()),
                times(&other.numerator, self.denominator.as_ref()),
                product(self.denominator, other.denominator.as_ref()),
            )
        };
        step(Rc::make_mut(&mut numerator), &term);
        Element {
            numerator,
            denominator,
            at,
        }
    }

    fn common_root(&self, other: &Self) -> Option<&'a Algebraic<Z>> {
        if let (Some(a), Some(b)) = (self.at, other.at) {
            debug_assert!(std::ptr::eq(a, b), "elements at two different roots");
        }
        self.at.or(other.at)
    }
}

fn times<Z: Integer>(poly: &Rc<Poly<Z>>, factor: Option<&Rc<Poly<Z>>>) -> Rc<Poly<Z>> {
    match factor {
        None => poly.clone(),
        Some(factor) if poly.is_one() => factor.clone(),
        Some(factor) => Rc::new(poly.mul(factor)),
    }
}

fn product<Z: Integer>(a: Option<Rc<Poly<Z>>>, b: Option<&Rc<Poly<Z>>>) -> Option<Rc<Poly<Z>>> {
    match a {
        Some(a) => Some(times(&a, b)),
        None => b.cloned(),
    }
}

impl<Z: Integer> OrderedField for Element<'_, Z> {
    fn from_i64(value: i64) -> Self {
        Self::constant(&Z::from_i64(value))
    }

    fn sign(&self) -> Ordering {
        self.sign_of(&self.numerator)
    }
}

impl<Z: Integer> Add for Element<'_, Z> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.combine(other, Poly::add_assign)
    }
}

impl<Z: Integer> Sub for Element<'_, Z> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.combine(other, Poly::sub_assign)
    }
}

impl<Z: Integer> Mul for Element<'_, Z> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Element {
            at: self.common_root(&other),
            numerator: Rc::new(self.numerator.mul(&other.numerator)),
            denominator: product(self.denominator, other.denominator.as_ref()),
        }
    }
}

impl<Z: Integer> Div for Element<'_, Z> {
    type Output = Self;

    /// The divisor must not be 0.
    fn div(self, other: Self) -> Self {
        let at = self.common_root(&other);
        let same = self.has_denominator_of(&other);
        let (mut numerator, mut denominator) = if same {
            (self.numerator, other.numerator.clone())
        } else {
            (
                times(&self.numerator, other.denominator.as_ref()),
                times(&other.numerator, self.denominator.as_ref()),
            )
        };
        let sign = other.sign();
        debug_assert!(sign.is_ne(), "division by 0");
        if sign.is_lt() {
            numerator = Rc::new(numerator.neg());
            denominator = Rc::new(denominator.neg());
        }
        Element {
            numerator,
            denominator: Some(denominator),
            at,
        }
    }
}

impl<Z: Integer> Neg for Element<'_, Z> {
    type Output = Self;

    fn neg(self) -> Self {
        Element {
            numerator: Rc::new(self.numerator.neg()),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;

    use super::*;
    use crate::algebraic::isolate_roots;

    fn poly(coefficients: &[i64]) -> Poly<BigInt> {
        Poly::new(coefficients.iter().map(|&c| BigInt::from(c)).collect())
    }

    fn root_of_half() -> Algebraic<BigInt> {
        // The square root of 1/2.
        isolate_roots(&poly(&[-1, 0, 2])).remove(0)
    }

    fn moved(position: i64, velocity: i64, at: &Algebraic<BigInt>) -> Element<'_, BigInt> {
        Element::moved(&BigInt::from(position), &BigInt::from(velocity), at)
    }

    #[test]
    fn element_field_operations_agree_with_arithmetic_of_the_square_root() {
        let t = root_of_half();
        let one = Element::from_i64(1);
        let root = moved(0, 1, &t);
        // 2 t^2 = 1.
        let square = root.clone() * root.clone();
        assert!((square.clone() + square.clone() - one.clone()).is_zero());
        // 1 / t = 2 t.
        let inverse = one.clone() / root.clone();
        assert!((inverse.clone() - (root.clone() + root.clone())).is_zero());
        assert_eq!(inverse.compare(&Element::from_i64(1)), Ordering::Greater);
        // 1 / (t - 1) = -2 - 2 t, a divisor below 0.
        let quotient = one.clone() / moved(-1, 1, &t);
        assert_eq!(quotient.sign(), Ordering::Less);
        assert!((quotient.clone() - moved(-2, -2, &t)).is_zero());
        // (1 / (t - 1)) / (1 / t) = t / (t - 1), and a sum of both over different denominators.
        let nested = quotient.clone() / inverse.clone();
        assert!((nested - root.clone() / moved(-1, 1, &t)).is_zero());
        assert!((quotient + inverse - moved(-2, 0, &t)).is_zero());
    }

    #[test]
    fn element_in_unit_interval_is_closed() {
        let t = root_of_half();
        assert!(moved(0, 1, &t).in_unit_interval());
        assert!(!moved(0, 2, &t).in_unit_interval());
        assert!(!(-moved(0, 1, &t)).in_unit_interval());
        assert!(Element::<BigInt>::from_i64(0).in_unit_interval());
        assert!(Element::<BigInt>::from_i64(1).in_unit_interval());
        assert!((moved(0, 3, &t) / moved(0, 3, &t)).in_unit_interval());
    }
}
