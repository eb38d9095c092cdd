//! Polynomials over the rationals, slowly and plainly: the second way for [`poly`](super::poly).

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// Coefficients, that of the highest power last and not 0; none for 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rational(Vec<BigRational>);

impl Rational {
    pub(super) fn new(mut coefficients: Vec<BigRational>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Rational(coefficients)
    }

    pub(super) fn of_integers(coefficients: &[BigInt]) -> Self {
        let ratio = |c: &BigInt| BigRational::from_integer(c.clone());
        Rational::new(coefficients.iter().map(ratio).collect())
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Divided by the leading coefficient.
    pub(super) fn monic(&self) -> Self {
        match self.0.last() {
            Some(leading) => Rational(self.0.iter().map(|c| c / leading).collect()),
            None => self.clone(),
        }
    }

    /// Divided by the magnitude of the leading coefficient: small numbers, the same signs.
    fn scaled(&self) -> Self {
        match self.0.last() {
            Some(leading) => Rational(self.0.iter().map(|c| c / leading.abs()).collect()),
            None => self.clone(),
        }
    }

    fn at(&self, t: &BigRational) -> BigRational {
        let horner = |sum: BigRational, c: &BigRational| sum * t + c;
        self.0.iter().rev().fold(BigRational::zero(), horner)
    }

    fn derivative(&self) -> Self {
        let powers = (1..).map(|n: u32| BigRational::from_integer(n.into()));
        Rational::new(
            self.0
                .iter()
                .skip(1)
                .zip(powers)
                .map(|(c, n)| c * n)
                .collect(),
        )
    }

    /// Quotient and remainder by a polynomial that is not 0, by long division.
    fn divide(&self, other: &Self) -> (Self, Self) {
        let mut rest = self.0.clone();
        let mut quotient = Vec::new();
        while rest.len() >= other.0.len() {
            let shift = rest.len() - other.0.len();
            let factor = &rest[rest.len() - 1] / &other.0[other.0.len() - 1];
            for (place, c) in rest[shift..].iter_mut().zip(&other.0) {
                *place -= c * &factor;
            }
            rest.pop();
            quotient.push(factor);
        }
        quotient.reverse();
        (Rational::new(quotient), Rational::new(rest))
    }

    /// The monic greatest common divisor, by Euclid's algorithm.
    pub(super) fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            (a, b) = (b.clone(), a.divide(&b).1);
        }
        a.monic()
    }

    /// The sign at the root of `other` in the interval.
    pub(super) fn sign_at(&self, other: &Sturm, interval: &Interval) -> Ordering {
        if self.is_zero() || Sturm::new(&self.gcd(&other.0[0])).count(interval) > 0 {
            return Ordering::Equal;
        }
        let own = Sturm::new(self);
        let mut interval = interval.clone();
        while own.count(&interval) > 0 {
            let [lower, upper] = halves(&interval);
            interval = if other.count(&lower) > 0 {
                lower
            } else {
                upper
            };
        }
        self.at(&interval[1]).cmp(&BigRational::zero())
    }
}

/// `(low, high]`.
pub(super) type Interval = [BigRational; 2];

/// The Sturm chain of the polynomial with the same roots, each once.
pub(super) struct Sturm(Vec<Rational>);

impl Sturm {
    /// The chain of a polynomial that is not 0.
    pub(super) fn new(poly: &Rational) -> Self {
        let first = poly.divide(&poly.gcd(&poly.derivative())).0.scaled();
        let mut chain = vec![first.clone(), first.derivative().scaled()];
        while let [.., a, b] = chain.as_slice()
            && !b.is_zero()
        {
            let Rational(rest) = a.divide(b).1;
            chain.push(Rational(rest.iter().map(|c| -c).collect()).scaled());
        }
        Sturm(chain)
    }

    /// How many different roots there are in the interval, by Sturm's theorem.
    pub(super) fn count(&self, [low, high]: &Interval) -> usize {
        self.variations(low) - self.variations(high)
    }

    fn variations(&self, t: &BigRational) -> usize {
        let values = self.0.iter().map(|p| p.at(t));
        let signs: Vec<bool> = values
            .filter(|value| !value.is_zero())
            .map(|value| value.is_positive())
            .collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// Intervals with a root in `[0, 1]` each, ascending, no wider than `2^-bits`.
    pub(super) fn roots(&self, bits: u32) -> Vec<Interval> {
        let width = BigRational::new(BigInt::one(), BigInt::one() << bits);
        let mut found = Vec::new();
        // `(0, 1]` does not hold 0.
        if self.0[0].at(&BigRational::zero()).is_zero() {
            found.push(self.around_zero(&width));
        }
        let mut open = vec![[BigRational::zero(), BigRational::one()]];
        while let Some(interval) = open.pop() {
            match self.count(&interval) {
                0 => {}
                1 if &interval[1] - &interval[0] <= width => found.push(interval),
                _ => {
                    let [lower, upper] = halves(&interval);
                    open.extend([upper, lower]);
                }
            }
        }
        found
    }

    /// An interval that ends at the root 0 and holds no other.
    fn around_zero(&self, width: &BigRational) -> Interval {
        let mut interval = [-width, BigRational::zero()];
        while self.count(&interval) > 1 {
            interval = halves(&interval)[1].clone();
        }
        interval
    }
}

fn halves([low, high]: &Interval) -> [Interval; 2] {
    let middle = (low + high) / BigRational::from_integer(2.into());
    [[low.clone(), middle.clone()], [middle, high.clone()]]
}
