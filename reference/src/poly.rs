//! Polynomials in one variable with integer coefficients.

use std::cmp::Ordering;

use crate::field::Integer;

/// A polynomial; coefficients ascending, the last one not 0. The zero polynomial has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Poly<Z> {
    coefficients: Vec<Z>,
}

impl<Z: Integer> Poly<Z> {
    /// The polynomial of these coefficients, ascending.
    pub fn new(coefficients: Vec<Z>) -> Self {
        let mut poly = Poly { coefficients };
        poly.trim();
        poly
    }

    /// The polynomial 0.
    pub fn zero() -> Self {
        Poly {
            coefficients: Vec::new(),
        }
    }

    /// A constant.
    pub fn constant(value: Z) -> Self {
        Poly::new(vec![value])
    }

    /// The straight line that is `start` at 0 and `end` at 1.
    pub fn line(start: &Z, end: &Z) -> Self {
        Poly::new(vec![start.clone(), end.sub(start)])
    }

    /// The coefficients, ascending, without leading zeros.
    pub fn coefficients(&self) -> &[Z] {
        &self.coefficients
    }

    /// Whether it is the polynomial 0.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// Whether it is the polynomial 1.
    pub fn is_one(&self) -> bool {
        matches!(self.coefficients(), [constant] if *constant == Z::one())
    }

    /// The degree; 0 for constants, the zero polynomial included.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    /// The leading coefficient; `None` for the zero polynomial.
    pub fn leading(&self) -> Option<&Z> {
        self.coefficients.last()
    }

    /// `self + other`.
    pub fn add(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        sum.add_assign(other);
        sum
    }

    /// `self - other`.
    pub fn sub(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        difference.sub_assign(other);
        difference
    }

    /// `self += other`.
    pub fn add_assign(&mut self, other: &Self) {
        self.lengthen(other.coefficients.len());
        for (a, b) in self.coefficients.iter_mut().zip(&other.coefficients) {
            a.add_assign(b);
        }
        self.trim();
    }

    /// `self -= other`.
    pub fn sub_assign(&mut self, other: &Self) {
        self.lengthen(other.coefficients.len());
        for (a, b) in self.coefficients.iter_mut().zip(&other.coefficients) {
            a.sub_assign(b);
        }
        self.trim();
    }

    fn lengthen(&mut self, length: usize) {
        if self.coefficients.len() < length {
            self.coefficients.resize(length, Z::zero());
        }
    }

    fn trim(&mut self) {
        while self.coefficients.last().is_some_and(Z::is_zero) {
            self.coefficients.pop();
        }
    }

    /// `-self`.
    pub fn neg(&self) -> Self {
        Poly {
            coefficients: self.coefficients.iter().map(Z::neg).collect(),
        }
    }

    /// `self * other`.
    pub fn mul(&self, other: &Self) -> Self {
        let mut product = Poly::zero();
        product.add_product(self, other);
        product
    }

    /// `self += a b`.
    pub fn add_product(&mut self, a: &Self, b: &Self) {
        self.accumulate(a, b, Z::add_product);
    }

    /// `self -= a b`.
    pub fn sub_product(&mut self, a: &Self, b: &Self) {
        self.accumulate(a, b, Z::sub_product);
    }

    fn accumulate(&mut self, a: &Self, b: &Self, step: fn(&mut Z, &Z, &Z)) {
        if a.is_zero() || b.is_zero() {
            return;
        }
        self.lengthen(a.coefficients.len() + b.coefficients.len() - 1);
        for (i, x) in a.coefficients.iter().enumerate() {
            for (j, y) in b.coefficients.iter().enumerate() {
                step(&mut self.coefficients[i + j], x, y);
            }
        }
        self.trim();
    }

    /// `factor * self`.
    pub fn scale(&self, factor: &Z) -> Self {
        Poly::new(self.coefficients.iter().map(|c| c.mul(factor)).collect())
    }

    /// The derivative.
    pub fn derivative(&self) -> Self {
        let terms = self.coefficients.iter().enumerate().skip(1);
        Poly::new(terms.map(|(k, c)| c.mul(&small(k))).collect())
    }

    /// `2^(exponent degree) p(numerator / 2^exponent)`: has the sign of `p` there.
    pub fn evaluate_dyadic(&self, numerator: &Z, exponent: u64) -> Z {
        let Some(leading) = self.leading() else {
            return Z::zero();
        };
        let mut value = leading.clone();
        let mut weight = 0;
        for coefficient in self.coefficients.iter().rev().skip(1) {
            weight += exponent;
            value = value.mul(numerator);
            value.add_assign(&coefficient.shl(weight));
        }
        value
    }

    /// `denominator^degree p(numerator / denominator)`, the denominator above 0: has the sign of
    /// `p` there.
    pub fn evaluate(&self, numerator: &Z, denominator: &Z) -> Z {
        let Some(leading) = self.leading() else {
            return Z::zero();
        };
        let mut value = leading.clone();
        let mut weight = Z::one();
        for coefficient in self.coefficients.iter().rev().skip(1) {
            weight = weight.mul(denominator);
            value = value.mul(numerator);
            value.add_product(coefficient, &weight);
        }
        value
    }

    /// The value at 1.
    pub fn at_one(&self) -> Z {
        let mut sum = Z::zero();
        for coefficient in &self.coefficients {
            sum.add_assign(coefficient);
        }
        sum
    }

    /// `binomial(n, i) b_i` for `i = 0 ..= n`, with `b_i` the Bernstein coefficients on `[0, 1]`.
    ///
    /// With `t = x / (1 + x)`, `(1 + x)^n p(t)` has the `i`-th for the coefficient of `x^i`: read
    /// backwards, `p` with `x` for `t` becomes it by a shift by one.
    pub fn scaled_bernstein(&self) -> Vec<Z> {
        let mut scaled: Vec<Z> = self.coefficients.iter().rev().cloned().collect();
        shift_by_one(&mut scaled);
        scaled.reverse();
        scaled
    }

    /// How often the sign changes along the Bernstein coefficients on `[0, 1]`, zeros skipped.
    ///
    /// By Descartes' rule of signs an upper bound for the number of roots in the open interval
    /// `(0, 1)`, counted with multiplicity, and of the same parity: 0 means none, 1 means one.
    pub fn sign_variations(&self) -> usize {
        sign_variations(&self.scaled_bernstein())
    }

    /// `2^degree p(t / 2)`: stretches `[0, 1/2]` to `[0, 1]`.
    pub fn stretch_lower_half(&self) -> Self {
        let n = self.degree() as u64;
        let terms = self.coefficients.iter().zip(0_u64..);
        Poly {
            coefficients: terms.map(|(c, k)| c.shl(n - k)).collect(),
        }
    }

    /// `p(t + 1)`.
    pub fn shift_by_one(&self) -> Self {
        let mut shifted = self.clone();
        shift_by_one(&mut shifted.coefficients);
        shifted
    }

    /// `self / other`, which the caller knows to be a polynomial with integer coefficients.
    pub fn div_exact(&self, other: &Self) -> Self {
        let Some(leading) = other.leading() else {
            return Poly::zero();
        };
        let mut remainder = self.coefficients.clone();
        let n = other.coefficients.len();
        if remainder.len() < n {
            return Poly::zero();
        }
        let mut quotient = vec![Z::zero(); remainder.len() - n + 1];
        for k in (0..quotient.len()).rev() {
            let factor = remainder[k + n - 1].div_exact(leading);
            for (c, i) in other.coefficients.iter().zip(k..) {
                remainder[i].sub_product(&factor, c);
            }
            quotient[k] = factor;
        }
        debug_assert!(
            remainder.iter().all(Z::is_zero),
            "the division leaves a remainder"
        );
        Poly::new(quotient)
    }

    /// The greatest common divisor of the coefficients, above 0; 0 for the zero polynomial.
    pub fn content(&self) -> Z {
        let mut content = Z::zero();
        for coefficient in &self.coefficients {
            content = content.gcd(coefficient);
            if content == Z::one() {
                break;
            }
        }
        content
    }

    /// The polynomial divided by its content, with a positive leading coefficient.
    pub fn primitive_part(&self) -> Self {
        let Some(leading) = self.leading() else {
            return Poly::zero();
        };
        let content = self.content();
        let divisor = if leading.sign() == Ordering::Less {
            content.neg()
        } else {
            content
        };
        if divisor == Z::one() {
            return self.clone();
        }
        Poly {
            coefficients: self
                .coefficients
                .iter()
                .map(|c| c.div_exact(&divisor))
                .collect(),
        }
    }

    /// The primitive greatest common divisor over the rationals; 0 only of two zeros.
    ///
    /// Subresultant polynomial remainder sequence (Brown and Traub 1971; Knuth, The Art of Computer
    /// Programming 2, 4.6.1, algorithm C).
    pub fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = if self.degree() < other.degree() {
            (other, self)
        } else {
            (self, other)
        };
        if a.is_zero() {
            std::mem::swap(&mut a, &mut b);
        }
        if b.is_zero() {
            return a.primitive_part();
        }
        let (mut a, mut b) = (a.primitive_part(), b.primitive_part());
        let (mut g, mut h) = (Z::one(), Z::one());
        loop {
            if b.degree() == 0 {
                return Poly::constant(Z::one());
            }
            let delta = (a.degree() - b.degree()) as u64;
            let remainder = a.pseudo_remainder(&b);
            if remainder.is_zero() {
                return b.primitive_part();
            }
            let divisor = g.mul(&power(&h, delta));
            let next = Poly {
                coefficients: remainder
                    .coefficients
                    .iter()
                    .map(|c| c.div_exact(&divisor))
                    .collect(),
            };
            a = std::mem::replace(&mut b, next);
            g = a.leading().cloned().unwrap_or_else(Z::one);
            // h becomes g^delta / h^(delta - 1).
            h = match delta {
                0 => h,
                1 => g.clone(),
                _ => power(&g, delta).div_exact(&power(&h, delta - 1)),
            };
        }
    }

    /// Whether `other` is a multiple of it over the rationals; it is not 0.
    pub fn divides(&self, other: &Self) -> bool {
        other.pseudo_remainder(self).is_zero()
    }

    /// The remainder of `leading(other)^(1 + deg self - deg other) self` by `other`, which is not
    /// 0.
    fn pseudo_remainder(&self, other: &Self) -> Self {
        let Some(leading) = other.leading() else {
            return Poly::zero();
        };
        let n = other.coefficients.len();
        let mut remainder = self.coefficients.clone();
        while remainder.len() >= n {
            let Some(factor) = remainder.pop() else { break };
            let shift = remainder.len() + 1 - n;
            for (k, r) in remainder.iter_mut().enumerate() {
                *r = r.mul(leading);
                if k >= shift {
                    r.sub_product(&factor, &other.coefficients[k - shift]);
                }
            }
        }
        Poly::new(remainder)
    }

    /// The polynomial with the same roots, each simple.
    pub fn square_free_part(&self) -> Self {
        if self.degree() < 2 {
            return self.primitive_part();
        }
        let repeated = self.gcd(&self.derivative());
        let primitive = self.primitive_part();
        if repeated.degree() == 0 {
            primitive
        } else {
            primitive.div_exact(&repeated)
        }
    }
}

/// Turns the coefficients of `p(t)`, ascending, into those of `p(t + 1)`.
fn shift_by_one<Z: Integer>(coefficients: &mut [Z]) {
    for start in 1..coefficients.len() {
        for k in (start..coefficients.len()).rev() {
            let (low, high) = coefficients.split_at_mut(k);
            low[k - 1].add_assign(&high[0]);
        }
    }
}

/// How often the sign changes along a sequence, zeros skipped.
pub fn sign_variations<Z: Integer>(sequence: &[Z]) -> usize {
    let mut last = Ordering::Equal;
    let mut variations = 0;
    for sign in sequence.iter().map(Z::sign).filter(|sign| sign.is_ne()) {
        variations += usize::from(last.is_ne() && sign != last);
        last = sign;
    }
    variations
}

fn small<Z: Integer>(value: usize) -> Z {
    Z::from_i64(i64::try_from(value).unwrap_or(i64::MAX))
}

fn power<Z: Integer>(base: &Z, exponent: u64) -> Z {
    (0..exponent).fold(Z::one(), |product, _| product.mul(base))
}

#[cfg(test)]
mod tests;
