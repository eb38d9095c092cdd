//! Polynomials over the rationals, slowly and plainly: the second way for [`poly`](super::poly).
//!
//! Roots, divisors and signs do not change by a factor above 0, so every polynomial is held by the
//! integers without common factor that it has by one.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// Coefficients, that of the highest power last and not 0; none for 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial(Vec<BigInt>);

impl Polynomial {
    pub(super) fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        let divisor = coefficients.iter().fold(BigInt::zero(), |a, b| a.gcd(b));
        if !divisor.is_one() {
            coefficients.iter_mut().for_each(|c| *c /= &divisor);
        }
        Polynomial(coefficients)
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Times -1 if the leading coefficient is below 0.
    pub(super) fn positive(self) -> Self {
        match self.0.last() {
            Some(leading) if leading.is_negative() => self.negative(),
            _ => self,
        }
    }

    fn negative(self) -> Self {
        Polynomial(self.0.into_iter().map(|c| -c).collect())
    }

    /// The sign of the value at `n / 2^bits`: that of the sum of `c_i n^i 2^(bits (k - i))`.
    fn sign(&self, n: &BigInt, bits: u64) -> Ordering {
        let terms = (0u64..).zip(self.0.iter().rev());
        let sum = terms.fold(BigInt::zero(), |sum, (power, c)| {
            sum * n + (c << (bits * power))
        });
        sum.cmp(&BigInt::zero())
    }

    fn derivative(&self) -> Self {
        let powers = 1u32..;
        let terms = self.0.iter().skip(1).zip(powers);
        Polynomial::new(terms.map(|(c, n)| c * n).collect())
    }

    /// Quotient and remainder by a polynomial that is not 0, by long division. Before each step
    /// what is left is multiplied by the leading coefficient of the divisor, both times by the same
    /// number above 0.
    fn divide(&self, other: &Self) -> (Self, Self) {
        let (mut rest, mut quotient) = (self.0.clone(), Vec::new());
        let Some(leading) = other.0.last() else {
            return (Polynomial(quotient), self.clone());
        };
        while rest.len() >= other.0.len() {
            let shift = rest.len() - other.0.len();
            let factor = match rest.pop() {
                Some(last) => last * leading.signum(),
                None => BigInt::zero(),
            };
            for c in rest.iter_mut().chain(&mut quotient) {
                *c *= leading.abs();
            }
            for (place, c) in rest[shift..].iter_mut().zip(&other.0) {
                *place -= c * &factor;
            }
            quotient.push(factor);
        }
        quotient.reverse();
        (Polynomial::new(quotient), Polynomial::new(rest))
    }

    /// The greatest common divisor, by Euclid's algorithm, its leading coefficient above 0.
    pub(super) fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            (a, b) = (b.clone(), a.divide(&b).1);
        }
        a.positive()
    }

    /// The sign at the root of `other` in each of these intervals.
    pub(super) fn signs_at(&self, other: &Sturm, intervals: &[Interval]) -> Vec<Ordering> {
        if self.is_zero() {
            return vec![Ordering::Equal; intervals.len()];
        }
        let (own, common) = (Sturm::new(self), Sturm::new(&self.gcd(&other.0[0])));
        let sign = |interval: &Interval| {
            if common.count(interval) > 0 {
                return Ordering::Equal;
            }
            let mut interval = interval.clone();
            while own.count(&interval) > 0 {
                let [lower, upper] = interval.halves();
                interval = if other.count(&lower) > 0 {
                    lower
                } else {
                    upper
                };
            }
            self.sign(&interval.high(), interval.bits)
        };
        intervals.iter().map(sign).collect()
    }
}

/// `(low / 2^bits, (low + 1) / 2^bits]`.
#[derive(Clone, Debug)]
pub(super) struct Interval {
    low: BigInt,
    bits: u64,
}

impl Interval {
    /// `(0, 1]`
    fn unit() -> Self {
        let low = BigInt::zero();
        Interval { low, bits: 0 }
    }

    fn high(&self) -> BigInt {
        &self.low + 1
    }

    fn halves(&self) -> [Interval; 2] {
        let (low, bits) = (&self.low * 2, self.bits + 1);
        let high = &low + 1;
        [low, high].map(|low| Interval { low, bits })
    }

    /// Its ends, of which only the second one is in it.
    pub(super) fn ends(&self) -> [BigRational; 2] {
        let ratio = |n| BigRational::new(n, BigInt::one() << self.bits);
        [ratio(self.low.clone()), ratio(self.high())]
    }
}

/// The Sturm chain of the polynomial with the same roots, each once.
pub(super) struct Sturm(Vec<Polynomial>);

impl Sturm {
    /// The chain of a polynomial that is not 0.
    pub(super) fn new(poly: &Polynomial) -> Self {
        let first = poly.divide(&poly.gcd(&poly.derivative())).0;
        let mut chain = vec![first.clone(), first.derivative()];
        while let [.., a, b] = chain.as_slice()
            && !b.is_zero()
        {
            chain.push(a.divide(b).1.negative());
        }
        Sturm(chain)
    }

    /// How many different roots there are in the interval, by Sturm's theorem.
    pub(super) fn count(&self, interval: &Interval) -> usize {
        let variations = |n| self.variations(n, interval.bits);
        variations(&interval.low) - variations(&interval.high())
    }

    fn variations(&self, n: &BigInt, bits: u64) -> usize {
        let signs = self.0.iter().map(|p| p.sign(n, bits));
        let signs: Vec<_> = signs.filter(|sign| sign.is_ne()).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// Intervals with a root in `[0, 1]` each, ascending, no wider than `2^-bits`.
    pub(super) fn roots(&self, bits: u64) -> Vec<Interval> {
        let mut found = Vec::new();
        // `(0, 1]` does not hold 0.
        if self.0[0].sign(&BigInt::zero(), 0).is_eq() {
            found.push(self.around_zero(bits));
        }
        let unit = Interval::unit();
        let count = self.count(&unit);
        let mut open = vec![(unit, count)];
        while let Some((interval, count)) = open.pop() {
            match count {
                0 => {}
                1 if interval.bits >= bits => found.push(interval),
                _ => {
                    let [lower, upper] = interval.halves();
                    let in_lower = self.count(&lower);
                    open.extend([(upper, count - in_lower), (lower, in_lower)]);
                }
            }
        }
        found
    }

    /// An interval that ends at the root 0 and holds no other.
    fn around_zero(&self, bits: u64) -> Interval {
        let low = BigInt::from(-1);
        let mut interval = Interval { low, bits };
        while self.count(&interval) > 1 {
            interval.bits += 1;
        }
        interval
    }
}
