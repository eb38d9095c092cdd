//! Polynomials with exact coefficients.

use std::ops::{Add, Mul, Sub};

use super::number::Number;

/// The coefficients, of the lowest power first.
#[derive(Clone, Debug)]
pub(in super::super) struct Polynomial(Vec<Number>);

impl Polynomial {
    /// The one that goes from `start` at 0 to `end` at 1.
    pub(in super::super) fn line(start: &Number, end: &Number) -> Self {
        Polynomial(vec![start.clone(), end - start])
    }

    /// The cubic with these Bernstein coefficients, by the rows of Pascal's triangle.
    pub(in super::super) fn of_bernstein([b0, b1, b2, b3]: &[Number; 4]) -> Self {
        let (d0, d1, d2) = (b1 - b0, b2 - b1, b3 - b2);
        let (e0, e1) = (&d1 - &d0, &d2 - &d1);
        Polynomial(vec![b0.clone(), d0.times(3), e0.times(3), &e1 - &e0])
    }

    /// Three times each Bernstein coefficient of a cubic.
    pub(in super::super) fn thrice_bernstein(&self) -> [Number; 4] {
        let c = |i: usize| self.coefficient(i);
        let first = c(0).times(3);
        let second = &first + &c(1);
        let third = &(&first + &c(1).times(2)) + &c(2);
        [first, second, third, self.at(&Number::from(1.0)).times(3)]
    }

    fn coefficient(&self, i: usize) -> Number {
        self.0.get(i).cloned().unwrap_or_else(Number::zero)
    }

    pub(in super::super) fn at(&self, t: &Number) -> Number {
        let sum = |sum: Number, c: &Number| &(&sum * t) + c;
        self.0.iter().rev().fold(Number::zero(), sum)
    }

    pub(in super::super) fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Polynomial(terms.map(|(i, c)| c.times(i as i64)).collect())
    }

    /// The least magnitude of a quadratic in an interval, or slightly more: without a root it is at
    /// an end or at the vertex, which is found by halving.
    pub(in super::super) fn least_magnitude(&self, low: &Number, high: &Number) -> Number {
        if self.roots_in_closed(low, high) > 0 {
            return Number::zero();
        }
        let mut least = self.at(low).abs().smaller(self.at(high).abs());
        let slope = self.derivative();
        if slope.at(low).sign() != slope.at(high).sign() {
            let (from, to) = slope.enclose(low, high, 64);
            least = least.smaller(self.at(&from.middle(&to)).abs());
        }
        least
    }

    /// An interval around a root where the sign changes, `2^halvings` times shorter.
    pub(in super::super) fn enclose(
        &self,
        low: &Number,
        high: &Number,
        halvings: u32,
    ) -> (Number, Number) {
        let (mut low, mut high) = (low.clone(), high.clone());
        let before = self.at(&low).sign();
        for _ in 0..halvings {
            let middle = low.middle(&high);
            if self.at(&middle).sign() == before {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low, high)
    }

    /// How many distinct roots there are in `(low, high]` (Sturm).
    pub(in super::super) fn roots(&self, low: &Number, high: &Number) -> usize {
        let mut chain = vec![self.clone().trimmed(), self.derivative().trimmed()];
        while let [.., a, b] = chain.as_slice()
            && !b.0.is_empty()
        {
            let next = a.negative_remainder(b);
            chain.push(next);
        }
        let changes = |t: &Number| {
            let signs = chain.iter().map(|p| p.at(t).sign());
            let signs: Vec<_> = signs.filter(|sign| sign.is_ne()).collect();
            signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
        };
        changes(low) - changes(high)
    }

    /// How many distinct roots there are in `[low, high]`.
    pub(in super::super) fn roots_in_closed(&self, low: &Number, high: &Number) -> usize {
        self.roots(low, high) + usize::from(self.at(low).sign().is_eq())
    }

    /// A multiple by a number above 0 of minus the remainder of the division by `other`.
    fn negative_remainder(&self, other: &Self) -> Self {
        let mut rest = self.clone();
        let Some(lead) = other.0.last() else {
            return rest;
        };
        while rest.0.len() >= other.0.len() {
            let shift = rest.0.len() - other.0.len();
            let first = rest.coefficient(rest.0.len() - 1);
            let first = if lead.sign().is_lt() { -&first } else { first };
            for c in &mut rest.0 {
                *c = &*c * &lead.abs();
            }
            for (c, d) in rest.0[shift..].iter_mut().zip(&other.0) {
                *c = &*c - &(&first * d);
            }
            rest.0.pop();
            rest = rest.trimmed();
        }
        Polynomial(rest.0.iter().map(|c| -c).collect())
    }

    fn trimmed(mut self) -> Self {
        while self.0.last().is_some_and(|c| c.sign().is_eq()) {
            self.0.pop();
        }
        self
    }

    fn by_coefficient(&self, other: &Self, f: impl Fn(&Number, &Number) -> Number) -> Self {
        let length = self.0.len().max(other.0.len());
        let term = |i: usize| f(&self.coefficient(i), &other.coefficient(i));
        Polynomial((0..length).map(term).collect())
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;

    fn add(self, other: Self) -> Polynomial {
        self.by_coefficient(other, |x, y| x + y)
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;

    fn sub(self, other: Self) -> Polynomial {
        self.by_coefficient(other, |x, y| x - y)
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;

    fn mul(self, other: Self) -> Polynomial {
        let mut product = Polynomial(vec![Number::zero(); self.0.len() + other.0.len() - 1]);
        for (i, x) in self.0.iter().enumerate() {
            for (j, y) in other.0.iter().enumerate() {
                product.0[i + j] = &product.0[i + j] + &(x * y);
            }
        }
        product
    }
}
