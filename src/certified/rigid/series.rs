//! Polynomials in the time that passes from the middle of a part of the step.

use std::cmp::Ordering;

use super::ball::{Ball, UP};
use super::rough::Rough;
use super::term::Term;

/// A polynomial of a degree below `N`, its coefficients known up to an error.
#[derive(Clone)]
pub(super) struct Series<const N: usize> {
    coefficients: [Rough; N],
    degree: usize,
}

/// For a degree up to 6: `f` of two edges, and all that is asked of a vertex and a face.
pub(super) const SHORT: usize = 7;

/// For a degree up to 12: the squared distance of two edges.
pub(super) const LONG: usize = 13;

/// The same where both sides turn: `f` of two edges has the degree 9, the squared distance of a
/// vertex and a face 10.
pub(super) const SHORT_OF_TWO: usize = 11;

/// The squared distance of two edges that both turn: 18.
pub(super) const LONG_OF_TWO: usize = 19;

impl<const N: usize> Series<N> {
    /// The polynomial with these coefficients, in ascending order of powers.
    fn of(numbers: &[Rough]) -> Self {
        let mut series = Series::zero(numbers.len() - 1);
        series.coefficients[..numbers.len()].copy_from_slice(numbers);
        series
    }

    fn zero(degree: usize) -> Self {
        Series {
            coefficients: [Rough::ZERO; N],
            degree,
        }
    }

    fn own(&self) -> &[Rough] {
        &self.coefficients[..=self.degree]
    }

    fn each(&self, f: impl Fn(Rough) -> Rough) -> Self {
        let mut result = Series::zero(self.degree);
        for (to, from) in result.coefficients.iter_mut().zip(self.own()) {
            *to = f(*from);
        }
        result
    }

    /// Each coefficient by `f`, those that one of the two lacks being 0.
    fn both(&self, other: &Self, f: impl Fn(Rough, Rough) -> Rough) -> Self {
        let mut result = Series::zero(self.degree.max(other.degree));
        for i in 0..=result.degree {
            result.coefficients[i] = match (i <= self.degree, i <= other.degree) {
                (true, true) => f(self.coefficients[i], other.coefficients[i]),
                (true, false) => self.coefficients[i],
                _ => f(Rough::ZERO, other.coefficients[i]),
            };
        }
        result
    }

    /// About the value at a time, and the slope.
    pub(super) fn about(&self, time: f64) -> [f64; 2] {
        let (mut value, mut slope) = (0.0, 0.0);
        for coefficient in self.own().iter().rev() {
            slope = slope * time + value;
            value = value * time + coefficient.value();
        }
        [value, slope]
    }

    /// The slope at a time, which may be known up to an error: then a bound for all of them.
    pub(super) fn slope_at(&self, time: Rough) -> Rough {
        let mut slope = Rough::ZERO;
        for (power, coefficient) in self.own().iter().enumerate().skip(1).rev() {
            let term = coefficient.mul(Rough::new(power as f64, 0.0));
            slope = slope.mul(time).add(term);
        }
        slope
    }

    /// The sign that it has at all times not farther than `reach` from the middle, if it has one.
    pub(super) fn sign_within(&self, reach: f64) -> Option<Ordering> {
        let first = self.coefficients[0];
        let is_largest = first.least() > self.rest(0, reach, |_| 1.0);
        first.sign().filter(|_| is_largest)
    }

    /// The sign that its slope has there.
    pub(super) fn slope_sign_within(&self, reach: f64) -> Option<Ordering> {
        let slope = self.coefficients[1];
        let is_largest = slope.least() > self.rest(1, reach, |power| power as f64);
        slope.sign().filter(|_| is_largest)
    }

    /// A bound on the terms after one, over the power of that.
    fn rest(&self, after: usize, reach: f64, factor: impl Fn(usize) -> f64) -> f64 {
        let (mut sum, mut power) = (0.0, 1.0);
        for (i, coefficient) in self.own().iter().enumerate().skip(after + 1) {
            power *= reach;
            sum += factor(i) * coefficient.most() * power;
        }
        sum * UP + f64::MIN_POSITIVE
    }
}

impl<const N: usize> Term for Series<N> {
    type Time = f64;

    fn constant(number: Ball) -> Self {
        Series::of(&[Rough::of(number)])
    }

    fn line(start: Ball, change: Ball, middle: f64) -> Self {
        let (start, change) = (Rough::of(start), Rough::of(change));
        let middle = Rough::new(middle, 0.0);
        Series::of(&[start.add(change.mul(middle)), change])
    }

    fn plus(&self, other: &Self) -> Self {
        self.both(other, Rough::add)
    }

    fn minus(&self, other: &Self) -> Self {
        self.both(other, Rough::sub)
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = Series::zero(self.degree + other.degree);
        for (i, x) in self.own().iter().enumerate() {
            for (j, y) in other.own().iter().enumerate() {
                let sum = &mut product.coefficients[i + j];
                let term = x.mul(*y);
                // The first term of a coefficient is not added to 0.
                *sum = match i == 0 || j == other.degree {
                    true => term,
                    false => sum.add(term),
                };
            }
        }
        product
    }

    fn negative(&self) -> Self {
        self.each(Rough::neg)
    }

    fn twice(&self) -> Self {
        self.each(Rough::twice)
    }
}
