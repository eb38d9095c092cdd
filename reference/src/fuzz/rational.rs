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

    pub(super) fn at(&self, t: &BigRational) -> BigRational {
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

    /// With every root once.
    fn square_free(&self) -> Self {
        self.divide(&self.gcd(&self.derivative())).0
    }

    /// How many different roots there are in `(low, high]`, by Sturm's theorem; the polynomial is not
    /// 0.
    pub(super) fn count(&self, low: &BigRational, high: &BigRational) -> usize {
        let first = self.square_free();
        let mut chain = vec![first.clone(), first.derivative()];
        while let [.., a, b] = chain.as_slice()
            && !b.is_zero()
        {
            let rest = a.divide(b).1;
            chain.push(Rational(rest.0.iter().map(|c| -c).collect()));
        }
        let variations = |t: &BigRational| {
            let signs: Vec<bool> = chain
                .iter()
                .map(|p| p.at(t))
                .filter(|value| !value.is_zero())
                .map(|value| value.is_positive())
                .collect();
            signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
        };
        variations(low) - variations(high)
    }

    /// Intervals `(low, high]` with a root in `[0, 1]` each, ascending, no wider than `2^-bits`.
    pub(super) fn roots(&self, bits: u32) -> Vec<[BigRational; 2]> {
        let width = BigRational::new(BigInt::one(), BigInt::one() << bits);
        // `(-1/2^bits, 0]` holds 0, and may hold roots below it.
        let mut found = Vec::new();
        if self.at(&BigRational::zero()).is_zero() {
            found.push([-&width, BigRational::zero()]);
        }
        let mut open = vec![[BigRational::zero(), BigRational::one()]];
        while let Some([low, high]) = open.pop() {
            match self.count(&low, &high) {
                0 => {}
                1 if &high - &low <= width => found.push([low, high]),
                _ => {
                    let middle = half(&low, &high);
                    open.push([middle.clone(), high]);
                    open.push([low, middle]);
                }
            }
        }
        found
    }

    /// The sign at the root of `other` in `(low, high]`.
    pub(super) fn sign_at(&self, other: &Self, [low, high]: &[BigRational; 2]) -> Ordering {
        if self.is_zero() || self.gcd(other).count(low, high) > 0 {
            return Ordering::Equal;
        }
        let (mut low, mut high) = (low.clone(), high.clone());
        while self.count(&low, &high) > 0 {
            let middle = half(&low, &high);
            if other.count(&low, &middle) > 0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        self.at(&high).cmp(&BigRational::zero())
    }
}

fn half(low: &BigRational, high: &BigRational) -> BigRational {
    (low + high) / BigRational::from_integer(2.into())
}
