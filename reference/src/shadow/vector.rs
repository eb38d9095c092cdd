//! Vectors of three numbers, over the integers, polynomials and fields.

use std::ops::{Add, Mul, Sub};

use crate::field::{Integer, OrderedField};
use crate::poly::Poly;

/// A vector over an ordered field.
#[derive(Clone, Debug)]
pub(super) struct Vector<F>(pub(super) [F; 3]);

impl<F: OrderedField> Vector<F> {
    /// The scalar product.
    pub(super) fn dot(&self, other: &Self) -> F {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        a.clone() * x.clone() + b.clone() * y.clone() + c.clone() * z.clone()
    }

    /// Whether `self x other = 0`, component after component.
    pub(super) fn is_parallel_to(&self, other: &Self) -> bool {
        [(1, 2), (2, 0), (0, 1)].into_iter().all(|(i, j)| {
            let [a, b, c, d] = [&self.0[i], &other.0[j], &self.0[j], &other.0[i]].map(F::clone);
            (a * b - c * d).is_zero()
        })
    }

    /// Whether all components are 0.
    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(F::is_zero)
    }

    fn zip(&self, other: &Self, step: fn(F, F) -> F) -> Self {
        Vector([0, 1, 2].map(|i| step(self.0[i].clone(), other.0[i].clone())))
    }
}

impl<F: OrderedField> Add for &Vector<F> {
    type Output = Vector<F>;

    fn add(self, other: Self) -> Vector<F> {
        self.zip(other, F::add)
    }
}

impl<F: OrderedField> Sub for &Vector<F> {
    type Output = Vector<F>;

    fn sub(self, other: Self) -> Vector<F> {
        self.zip(other, F::sub)
    }
}

impl<F: OrderedField> Mul<&F> for &Vector<F> {
    type Output = Vector<F>;

    fn mul(self, factor: &F) -> Vector<F> {
        Vector(self.0.each_ref().map(|x| x.clone() * factor.clone()))
    }
}

/// What is added and multiplied by reference: integers and polynomials.
pub(super) trait Ring: Clone {
    /// `self - other`.
    fn minus(&self, other: &Self) -> Self;
    /// `a b - c d`.
    fn minor(a: &Self, b: &Self, c: &Self, d: &Self) -> Self;
    /// `a x + b y + c z`.
    fn sum_of_products(a: &[Self; 3], b: &[Self; 3]) -> Self;
}

impl<Z: Integer> Ring for Z {
    fn minus(&self, other: &Self) -> Self {
        self.sub(other)
    }

    fn minor(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let mut minor = a.mul(b);
        minor.sub_product(c, d);
        minor
    }

    fn sum_of_products([a, b, c]: &[Self; 3], [x, y, z]: &[Self; 3]) -> Self {
        let mut sum = a.mul(x);
        sum.add_product(b, y);
        sum.add_product(c, z);
        sum
    }
}

impl<Z: Integer> Ring for Poly<Z> {
    fn minus(&self, other: &Self) -> Self {
        self.sub(other)
    }

    fn minor(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        let mut minor = a.mul(b);
        minor.sub_product(c, d);
        minor
    }

    fn sum_of_products([a, b, c]: &[Self; 3], [x, y, z]: &[Self; 3]) -> Self {
        let mut sum = a.mul(x);
        sum.add_product(b, y);
        sum.add_product(c, z);
        sum
    }
}

/// `a - b`.
pub(super) fn difference<T: Ring>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [0, 1, 2].map(|i| a[i].minus(&b[i]))
}

/// `a . b`.
pub(super) fn dot<T: Ring>(a: &[T; 3], b: &[T; 3]) -> T {
    T::sum_of_products(a, b)
}

/// `a x b`.
pub(super) fn cross<T: Ring>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| T::minor(&a[i], &b[j], &a[j], &b[i]))
}
