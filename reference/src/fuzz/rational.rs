//! Polynomials over the rationals, slowly and plainly: the second way for [`poly`](super::poly).

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

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

    /// Times a number above 0: integers without a common factor.
    fn scaled(&self) -> Self {
        let denominators = self.0.iter().map(|c| c.denom().clone());
        let multiple = denominators.fold(BigInt::one(), |a, b| a.lcm(&b));
        let integers: Vec<BigInt> = self
            .0
            .iter()
            .map(|c| c.numer() * (&multiple / c.denom()))
            .collect();
        let divisor = integers.iter().fold(BigInt::zero(), |a, b| a.gcd(b));
        Rational::new(
            integers
                .into_iter()
                .map(|c| BigRational::from_integer(c / &divisor))
                .collect(),
        )
    }

    /// The sign of the value at `t = n / d` of a polynomial with integer coefficients: that of the sum of
    /// `c_i n^i d^(k - i)`, without a fraction.
    fn sign(&self, t: &BigRational) -> Ordering {
        let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
        for c in self.0.iter().rev() {
            sum = sum * t.numer() + c.numer() * &power;
            power *= t.denom();
        }
        sum.cmp(&BigInt::zero())
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
        self.scaled().sign(&interval[1])
    }
}

/// `(low, high]`.
pub(super) type Interval = [BigRational; 2];

/// The Sturm chain of the polynomial with the same roots, each once; coefficients are integers.
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
        let signs = self.0.iter().map(|p| p.sign(t));
        let signs: Vec<_> = signs.filter(|sign| sign.is_ne()).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// Intervals with a root in `[0, 1]` each, ascending, no wider than `2^-bits`.
    pub(super) fn roots(&self, bits: u32) -> Vec<Interval> {
        let width = BigRational::new(BigInt::one(), BigInt::one() << bits);
        let mut found = Vec::new();
        // `(0, 1]` does not hold 0.
        if self.0[0].sign(&BigRational::zero()).is_eq() {
            found.push(self.around_zero(&width));
        }
        let unit = [BigRational::zero(), BigRational::one()];
        let count = self.count(&unit);
        let mut open = vec![(unit, count)];
        while let Some((interval, count)) = open.pop() {
            match count {
                0 => {}
                1 if &interval[1] - &interval[0] <= width => found.push(interval),
                _ => {
                    let [lower, upper] = halves(&interval);
                    let in_lower = self.count(&lower);
                    open.extend([(upper, count - in_lower), (lower, in_lower)]);
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
