//! Integers of any size for the coefficients of a motion, on the heap: a motion has a hundred of
//! them, which would be much on the stack.

use std::cmp::Ordering;

use super::fraction::Fraction;
use super::integer::Integer;
use super::isolate::Isolated;
use super::poly::Poly;
use super::width::{Number, Width};

/// Any width.
pub(super) struct Unlimited;

/// An integer of any size, on the heap. What makes one is never compiled into its caller, where
/// each integer would take room on the stack for as long as that runs.
#[derive(Debug)]
pub(super) struct Boxed(Box<Integer>);

impl Clone for Boxed {
    #[inline(never)]
    fn clone(&self) -> Self {
        Boxed(self.0.clone())
    }
}

impl From<&Integer> for Boxed {
    #[inline(never)]
    fn from(value: &Integer) -> Self {
        Boxed(Box::new(value.clone()))
    }
}

impl From<i128> for Boxed {
    #[inline(never)]
    fn from(value: i128) -> Self {
        Boxed(Box::new(value.into()))
    }
}

impl From<Integer> for Boxed {
    fn from(value: Integer) -> Self {
        Boxed(Box::new(value))
    }
}

impl Number for Boxed {
    #[inline(never)]
    fn add(&self, other: &Self) -> Self {
        Integer::sum(&self.0, &other.0).into()
    }

    #[inline(never)]
    fn sub(&self, other: &Self) -> Self {
        Integer::difference(&self.0, &other.0).into()
    }

    fn sign(&self) -> Ordering {
        self.0.sign()
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }

    fn to_integer(&self) -> Integer {
        (*self.0).clone()
    }
}

impl Width for Unlimited {
    type Linear = Boxed;
    type Quadratic = Boxed;
    type Cubic = Boxed;
    type QuadraticValue = Boxed;
    type CubicValue = Boxed;
    type Isolated = Box<Isolated>;
    type Poly = Box<Poly>;

    #[inline(never)]
    fn times(a: &Boxed, b: &Boxed) -> Boxed {
        Integer::product(&a.0, &b.0).into()
    }

    fn times_quadratic(a: &Boxed, b: &Boxed) -> Boxed {
        Self::times(a, b)
    }

    fn times_quadratics(a: &Boxed, b: &Boxed) -> Boxed {
        Self::times(a, b)
    }

    fn quadratic_at(c: &[Boxed; 3], grid_time: u128) -> Boxed {
        horner(c, grid_time)
    }

    fn cubic_at(c: &[Boxed; 4], grid_time: u128) -> Boxed {
        horner(c, grid_time)
    }

    fn widened(c: &Boxed) -> Boxed {
        c.clone()
    }

    fn quadratic_at_fraction(c: &[Boxed; 3], at: Fraction) -> Boxed {
        horner_fraction(c, at)
    }

    fn cubic_at_fraction(c: &[Boxed; 4], at: Fraction) -> Boxed {
        horner_fraction(c, at)
    }
}

/// Horner's rule at `grid_time / 2^128`: the value times `2^(128 degree)`.
fn horner(coefficients: &[Boxed], grid_time: u128) -> Boxed {
    let grid_time = Integer::from_magnitude(false, &[grid_time as u64, (grid_time >> 64) as u64]);
    let mut value = Integer::default();
    for (coefficient, step) in coefficients.iter().rev().zip(0..) {
        value.mul_assign(&grid_time);
        value.add_shifted(&coefficient.0, 128 * step);
    }
    value.into()
}

/// Horner's rule at `n / d`: the value times `d^degree`.
fn horner_fraction(coefficients: &[Boxed], at: Fraction) -> Boxed {
    let [numerator, denominator] = [at.numerator, at.denominator].map(|n| i128::from(n).into());
    let (mut value, mut power) = (Integer::default(), Integer::from(1));
    for coefficient in coefficients.iter().rev() {
        value.mul_assign(&numerator);
        value.add_shifted(&Integer::product(&coefficient.0, &power), 0);
        power.mul_assign(&denominator);
    }
    value.into()
}
