//! What the formulas are computed with: numbers at one time, or polynomials in time.

use super::ball::Ball;
use super::rough::Rough;

/// A number at a time, or a polynomial in time.
pub(super) trait Term: Clone {
    /// The time, or that around which the polynomials are.
    type Time: Copy;

    /// What does not move.
    fn constant(number: Ball) -> Self;

    /// What moves on a line, from `start` at `t = 0` with a change in the whole step.
    fn line(start: Ball, change: Ball, time: Self::Time) -> Self;

    fn plus(&self, other: &Self) -> Self;

    fn minus(&self, other: &Self) -> Self;

    fn times(&self, other: &Self) -> Self;

    fn negative(&self) -> Self;

    fn twice(&self) -> Self;
}

/// A vector of them.
pub(super) type Vector<T> = [T; 3];

/// The operations of a number that has methods for them.
macro_rules! operations {
    ($number:ident) => {
        fn plus(&self, other: &Self) -> Self {
            self.add(*other)
        }

        fn minus(&self, other: &Self) -> Self {
            self.sub(*other)
        }

        fn times(&self, other: &Self) -> Self {
            self.mul(*other)
        }

        fn negative(&self) -> Self {
            self.neg()
        }

        fn twice(&self) -> Self {
            $number::twice(*self)
        }
    };
}

impl Term for Rough {
    type Time = Rough;

    fn constant(number: Ball) -> Self {
        Rough::of(number)
    }

    fn line(start: Ball, change: Ball, time: Rough) -> Self {
        Rough::of(start).add(Rough::of(change).mul(time))
    }

    operations!(Rough);
}

impl Term for Ball {
    type Time = Ball;

    fn constant(number: Ball) -> Self {
        number
    }

    fn line(start: Ball, change: Ball, time: Ball) -> Self {
        start.add(change.mul(time))
    }

    operations!(Ball);
}

pub(super) fn add<T: Term>(x: &Vector<T>, y: &Vector<T>) -> Vector<T> {
    std::array::from_fn(|i| x[i].plus(&y[i]))
}

pub(super) fn sub<T: Term>(x: &Vector<T>, y: &Vector<T>) -> Vector<T> {
    std::array::from_fn(|i| x[i].minus(&y[i]))
}

pub(super) fn neg<T: Term>(x: &Vector<T>) -> Vector<T> {
    x.each_ref().map(T::negative)
}

pub(super) fn scaled<T: Term>(factor: &T, x: &Vector<T>) -> Vector<T> {
    x.each_ref().map(|component| factor.times(component))
}

pub(super) fn dot<T: Term>(x: &Vector<T>, y: &Vector<T>) -> T {
    let [a, b, c]: [T; 3] = std::array::from_fn(|i| x[i].times(&y[i]));
    a.plus(&b).plus(&c)
}

pub(super) fn cross<T: Term>(x: &Vector<T>, y: &Vector<T>) -> Vector<T> {
    std::array::from_fn(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        x[i].times(&y[j]).minus(&x[j].times(&y[i]))
    })
}
