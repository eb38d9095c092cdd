//! Vectors in space of exact numbers.

use std::ops::{Add, Mul, Sub};

/// `x - y`.
pub(crate) fn sub<T>(x: &[T; 3], y: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Sub<Output = T>,
{
    [0, 1, 2].map(|i: usize| &x[i] - &y[i])
}

/// `x . y`.
pub(crate) fn dot<T: Add<Output = T>>(x: &[T; 3], y: &[T; 3]) -> T
where
    for<'a> &'a T: Mul<Output = T>,
{
    &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2]
}

/// `x` cross `y`.
pub(crate) fn cross<T: Sub<Output = T>>(x: &[T; 3], y: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Mul<Output = T>,
{
    [(1, 2), (2, 0), (0, 1)].map(|(i, j): (usize, usize)| &x[i] * &y[j] - &x[j] * &y[i])
}
