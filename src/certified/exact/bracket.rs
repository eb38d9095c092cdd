//! A simple root between two numbers, narrowed as far as a question about it needs.
//!
//! Quadratic interval refinement (Abbott, "Quadratic interval refinement for real roots", 2006): a
//! chord says in which of `2^bits` cells the root should be, exact signs at the cell's ends say
//! whether it is. A cell that is right squares the number of cells, one that is wrong takes its
//! root; two cells are halving, which always goes on.
//!
//! # Why it ends
//!
//! The chord only chooses a cell, by an index that is clamped; everything else is integers. So
//! [`Bracket::refine`] narrows the bracket whatever floating point says, in any rounding mode. With
//! `b` the logarithm of the number of cells and `e` that of the common denominator of the ends:
//! a cell that is right narrows by `b` bits, adds `b` to `e` and at most doubles `b`; one that is
//! wrong adds `b` to `e` and halves `b`; two cells narrow by a bit either way. So `e + 2 b` grows by
//! at most three times the bits that are gained.
//!
//! How many bits are needed is bounded by the polynomials ([`Bracket::most_exponent`]), if there is
//! a root. That there is one is proved in floating point as well (`isolate_f64`), which a host that
//! rounds otherwise may mislead. Then the signs at both ends are not those around a root, or it
//! narrows towards an end that is another root, until the exponent is larger than any that is
//! needed: it is taken for what it has become, and the answer is as wrong as its premise.

use std::cell::{Cell, RefCell};
use std::cmp::Ordering;

use super::common_factor::common_factor;
use super::dyadic::Dyadic;
use super::enclosure::FIRST;
use super::estimate::between;
use super::integer::{Integer, ratio, scale};
use super::modular::are_coprime;
use super::poly::Poly;
use super::sturm;

mod end;
mod quotient;

use end::End;
pub(super) use quotient::exact_ratio;

/// The only root of a polynomial strictly between two numbers, a simple one.
#[derive(Clone, Debug)]
pub(super) struct Bracket<'a, const N: usize = 4> {
    poly: &'a Poly<N>,
    /// The sign of the polynomial between `low` and the root.
    before: Ordering,
    low: End,
    high: End,
    /// The logarithm of the number of cells that the next step tries.
    bits: u32,
    /// How many bits of the polynomial's values were enough.
    enough: Cell<u64>,
    /// How many leading bits cancelled in the last of its values that was asked for as a number.
    lost: u64,
    /// The ends as far as any question has narrowed it.
    narrowest: RefCell<Option<Narrowed>>,
    /// Whether more cells than floating point tells apart may be tried, so that few steps lead to
    /// many bits.
    is_far: bool,
}

/// Ends of a bracket, nearer than its own, and its `bits` there.
#[derive(Clone, Debug)]
struct Narrowed {
    low: End,
    high: End,
    bits: u32,
}

/// A root compared with the `f64`s.
pub(super) enum Settled {
    /// It is this number.
    At(Dyadic),
    /// It is strictly between these two neighbours.
    Between(f64, f64),
}

/// How many bits the ends may have, and as many more as the other polynomial's coefficients, before
/// that is likely to be 0 at a root.
const LEAST_EXPONENT: u64 = 64;

/// The most of these bits: beyond them narrowing costs as much as remainders do.
const MOST_VAIN_BITS: u64 = 512;

/// From ends with so many bits on, a place may depend on what else was asked of the root.
const FAR: u64 = 2048;

/// The most bits that a chord is worth, computed in floating point.
pub(super) const MOST_BITS: u32 = 48;

/// About `2^bits n / d` for `0 <= n <= d`, by long division: each step takes a digit from floating
/// point, which may be too large or too small; what that leaves is negative or a longer digit.
fn divide_about(n: Integer, d: Integer, bits: u32) -> Integer {
    // So many bits of both are enough.
    let spare = d.bits().saturating_sub(u64::from(bits) + 64);
    let (mut rest, d) = (n.shifted_down(spare), d.shifted_down(spare));
    let (mut quotient, mut missing) = (Integer::ZERO, bits);
    // Ends: each turn adds bits.
    while missing > 0 {
        let step = missing.min(MOST_BITS);
        rest = rest.shifted(step.into());
        // Saturates, and is 0 for what is not a number.
        let digit = Integer::from(i128::from(ratio(&rest, &d).floor() as i64));
        quotient = Integer::sum(&quotient.shifted(step.into()), &digit);
        rest.sub_shifted(&Integer::product(&digit, &d), 0);
        missing -= step;
    }
    quotient
}

impl<'a, const N: usize> Bracket<'a, N> {
    /// The only root of `poly` strictly between `low` and `high`; `before` is the sign between
    /// `low` and the root.
    pub(super) fn new(poly: &'a Poly<N>, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket::between(poly, End::new(low), End::new(high), before)
    }

    fn between(poly: &'a Poly<N>, low: End, high: End, before: Ordering) -> Self {
        Bracket {
            poly,
            before,
            low,
            high,
            // A line is its own chord.
            bits: if poly.degree() == 1 { MOST_BITS } else { 1 },
            enough: Cell::new(FIRST),
            lost: 0,
            narrowest: RefCell::new(None),
            is_far: false,
        }
    }

    /// The same for ends that are known not to be roots.
    pub(super) fn proved(poly: &'a Poly<N>, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket::between(poly, End::proved(low), End::proved(high), before)
    }

    /// The same, to be narrowed far: with more cells at a step than floating point tells apart.
    pub(super) fn far(self) -> Self {
        Bracket {
            is_far: true,
            ..self
        }
    }

    /// Narrows it to between two neighbours in `f64`, and such that neither end is a root.
    pub(super) fn settle(&mut self) -> Settled {
        let most = self.most_exponent(1, self.exponent());
        // Ends: each turn narrows it, and the exponent has a bound. The neighbours of the ends are
        // taken in integers, so that a number between them is between the ends.
        loop {
            let (below, above) = (self.low.at.below(), self.high.at.above());
            let is_spent = self.exponent() > most;
            let met = match between(below, above) {
                None if is_spent || self.low.is_proved && self.high.is_proved => {
                    return Settled::Between(below, above);
                }
                Some(_) if is_spent => return Settled::At(self.low.at.clone()),
                // The root may be the only one that there is between them.
                Some(cut) if below.to_bits() + 1 == cut.to_bits() => {
                    self.meet(Dyadic::from_f64(cut))
                }
                _ => self.refine(),
            };
            if let Some(at) = met {
                return Settled::At(at);
            }
        }
    }

    /// The larger one of the exponents of the ends.
    fn exponent(&self) -> u64 {
        self.low.at.exponent.max(self.high.at.exponent)
    }

    /// An exponent of the ends that narrowing does not reach before it shows the sign of a
    /// polynomial `q` of this degree `n` and so many bits at the root `r`, if that is not 0.
    ///
    /// With `m` the degree of the bracket's polynomial `p` and `h` the bits of its coefficients: the
    /// polynomial of least degree with the root `r` divides `p`, so that its coefficients have at
    /// most `h + 2 m` bits (Mignotte), their norm no more than two more. Its resultant with `q` is an
    /// integer and not 0: `|q(r)|` is at least 2 to the minus `(m - 1) (bits + 5) + n (h + 2 m + 2)`,
    /// as a polynomial of degree up to 18 is at most nineteen times its largest coefficient. Up to the
    /// root `q` changes by no more than `2^(bits + 8)` times the width. So many bits, and those that
    /// the quotients of numbers of 64 bits need beyond the sign, are below `w`.
    ///
    /// For `q = 2^e t - k`, the distance of the root from a number with the exponent `e`, the bits
    /// are `e + 1`: it bounds what it takes to move an end away from another root. To part the root
    /// from a neighbour in `f64` at which it is not, the bracket is cut there, which takes the
    /// exponent of an `f64`, at most 1074. The exponent grows by three times the
    /// width's bits, and by 144 more for one cell too narrow and the first cells.
    pub(super) fn most_exponent(&self, degree: usize, bits: u64) -> u64 {
        let (m, n) = (self.poly.degree() as u64, degree as u64);
        let h = most_bits(self.poly);
        let w = m * (bits + 5) + n * (h + 2 * m + 4) + 128;
        self.exponent().max(1074) + 4 * w + 1074 * 4 + 256
    }

    /// Numbers between which the root is.
    pub(super) fn ends(&self) -> [&Dyadic; 2] {
        [&self.low.at, &self.high.at]
    }

    /// Compares the root with a number strictly between the ends, if it is that; returns the root
    /// if that is it.
    fn meet(&mut self, at: Dyadic) -> Option<Dyadic> {
        let is_inside = at.compare(&self.low.at).is_gt() && at.compare(&self.high.at).is_lt();
        (is_inside && self.cut(&at).is_eq()).then_some(at)
    }

    /// Narrows it to one of its cells, or to what lies on one side of that. Returns the root if it
    /// is met, and the lower end if the signs at the ends are not those around a root.
    pub(super) fn refine(&mut self) -> Option<Dyadic> {
        let own = self.exponent();
        let exponent = own + u64::from(self.bits);
        let low = &self.low.at;
        let start = low.numerator.shifted(exponent - low.exponent);
        let width = self.width();
        let one = Integer::from(1);
        let cells = one.shifted(self.bits.into());
        let Some(index) = self.chord() else {
            return Some(self.low.at.clone());
        };
        let index = index.clamp(Integer::ZERO, Integer::difference(&cells, &one));
        let next = Integer::sum(&index, &one);
        let mut is_right = true;
        for (index, side) in [(&index, Ordering::Greater), (&next, Ordering::Less)] {
            if is_right && !index.is_zero() && *index < cells {
                let numerator = Integer::sum(&start, &Integer::product(&width, index));
                let at = Dyadic::new(numerator, exponent);
                let order = self.cut(&at);
                if order.is_eq() {
                    return Some(at);
                }
                is_right = order == side;
            }
        }
        self.bits = if is_right {
            (2 * self.bits).min(self.most_cells(exponent))
        } else {
            (self.bits / 2).max(1)
        };
        None
    }

    /// The logarithm of the most cells to try for ends with this exponent: where many bits are
    /// needed, a share of those that there are, so that few steps lead there.
    fn most_cells(&self, exponent: u64) -> u32 {
        let share = (exponent / 4).saturating_sub(u64::from(MOST_BITS));
        match self.is_far {
            true => MOST_BITS.max(share as u32),
            false => MOST_BITS,
        }
    }

    /// In which of `2^bits` cells between the ends the chord of the polynomial is 0, about. `None`
    /// if the sign at an end is that of the other side of the root.
    fn chord(&mut self) -> Option<Integer> {
        let (poly, before, bits) = (self.poly, self.before, self.bits);
        let is_around = |low: Ordering, high: Ordering| low != before.reverse() && high != before;
        if bits > MOST_BITS {
            let [(low, own), (high, other)] = [&mut self.low, &mut self.high]
                .map(|end| end.leading(poly, &mut self.lost, u64::from(bits) + 64));
            if !is_around(low.sign(), high.sign()) {
                return None;
            }
            let common = own.min(other);
            let scaled = |x: &Integer, own: i64| x.magnitude().shifted(own.abs_diff(common));
            let low = scaled(&low, own);
            let whole = Integer::sum(&low, &scaled(&high, other));
            return Some(divide_about(low, whole, bits));
        }
        let [(low_sign, (low, own)), (high_sign, (high, other))] =
            [&mut self.low, &mut self.high].map(|end| end.approximate(poly, &self.enough));
        if !is_around(low_sign, high_sign) {
            return None;
        }
        let degree = self.poly.degree() as i64;
        let [low_exponent, high_exponent] =
            [&self.low.at, &self.high.at].map(|at| at.exponent as i64 * degree);
        let (own, other) = (own - low_exponent, other - high_exponent);
        let chord = 1.0 / (1.0 + scale((high / low).abs(), other - own));
        // 0 for what is not a number.
        let index = (chord * (1u64 << bits) as f64) as u64;
        Some(i128::from(index).into())
    }

    /// Compares the root with a number strictly between the ends, which becomes one of them unless
    /// it is the root.
    fn cut(&mut self, at: &Dyadic) -> Ordering {
        let mut end = End::proved(at.clone());
        // It is nearer to the root by as much as cells are shorter than the bracket.
        self.lost += u64::from(self.bits);
        // More than the sign: what the next chord wants to know if the cell is right.
        let next = (2 * self.bits).min(self.most_cells(at.exponent));
        let sign = if next > MOST_BITS {
            let (value, _) = end.leading(self.poly, &mut self.lost, u64::from(next) + 64);
            value.sign()
        } else {
            end.approximate(self.poly, &self.enough).0
        };
        if sign.is_eq() {
            Ordering::Equal
        } else if sign == self.before {
            self.low = end;
            Ordering::Greater
        } else {
            self.high = end;
            Ordering::Less
        }
    }

    /// The root compared with a number.
    pub(super) fn compare_dyadic(&self, at: &Dyadic) -> Ordering {
        if at.compare(&self.low.at).is_le() {
            return Ordering::Greater;
        }
        if at.compare(&self.high.at).is_ge() {
            return Ordering::Less;
        }
        match self.poly.sign_at(at) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == self.before => Ordering::Greater,
            _ => Ordering::Less,
        }
    }

    /// The root compared with another one.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        if self.compare_dyadic(&other.low.at).is_le() {
            return Ordering::Less;
        }
        if self.compare_dyadic(&other.high.at).is_ge() {
            return Ordering::Greater;
        }
        // Between these, the other polynomial changes its sign at the other root alone.
        match self.sign_of(other.poly.clone()) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == other.before => Ordering::Less,
            _ => Ordering::Greater,
        }
    }

    /// The sign of a polynomial at the root.
    ///
    /// It is narrowed for a while before remainders, whose numbers are many times as long, tell: for
    /// longer if there is no factor in common, so that it is not 0 there. If there may be one, and
    /// the polynomials are long, that factor tells first whether it is 0.
    pub(super) fn sign_of(&self, q: Poly<N>) -> Ordering {
        if let Some(sign) = self.plain_sign_of(&q) {
            return sign;
        }
        let bits = most_bits(&q);
        let far = LEAST_EXPONENT + bits + most_bits(self.poly);
        if !are_coprime(self.poly, &q) {
            let near = LEAST_EXPONENT + bits.min(MOST_VAIN_BITS);
            if let Some(sign) = self.sign_by_narrowing(&q, near) {
                return sign;
            }
            match self.shares_root(&q) {
                Some(true) => return Ordering::Equal,
                Some(false) => {}
                None => return self.sturm_sign_of(q),
            }
        }
        self.sign_by_narrowing(&q, far)
            .unwrap_or_else(|| self.sturm_sign_of(q))
    }

    /// Whether the root is one of what the two polynomials have in common; `None` where that is not
    /// known.
    ///
    /// A divisor of the polynomial has no other root in the bracket, and this one is simple.
    fn shares_root(&self, q: &Poly<N>) -> Option<bool> {
        let common = common_factor(self.poly, q)?.divisor;
        let [low, high] = self.ends().map(|end| common.sign_at(end));
        if low.is_eq() || high.is_eq() {
            return None;
        }
        Some(low != high)
    }

    /// The sign of a polynomial at the root, if it has that in the whole bracket.
    pub(super) fn plain_sign_of(&self, q: &Poly<N>) -> Option<Ordering> {
        let variation = slope_bound(q).bits() + self.width().bits();
        q.sign_beyond(&self.low.at, variation as i64 - self.exponent() as i64)
    }

    /// The sign of a polynomial at the root, if it is shown before the ends have so many bits. If
    /// it is not 0, it is shown in the end.
    fn sign_by_narrowing(&self, q: &Poly<N>, most_bits: u64) -> Option<Ordering> {
        let mut bracket = self.clone().far();
        bracket.narrow_as_kept();
        let sign = bracket.narrow_for_sign(q, most_bits);
        self.keep(bracket);
        sign
    }

    /// Goes on where another question has narrowed it to, if that is farther.
    fn narrow_as_kept(&mut self) {
        let own = self.exponent();
        if let Some(narrowed) = self.narrowest.take()
            && narrowed.low.at.exponent.max(narrowed.high.at.exponent) > own
        {
            (self.low, self.high, self.bits) = (narrowed.low, narrowed.high, narrowed.bits);
        }
    }

    /// Keeps how far it was narrowed.
    fn keep(&self, narrowed: Self) {
        let Bracket {
            low, high, bits, ..
        } = narrowed;
        self.narrowest.replace(Some(Narrowed { low, high, bits }));
        self.enough.set(narrowed.enough.get());
    }

    fn narrow_for_sign(&mut self, q: &Poly<N>, most_bits: u64) -> Option<Ordering> {
        // Ends: each turn narrows it, so that its exponent comes to be as large.
        loop {
            if let Some(sign) = self.plain_sign_of(q) {
                return Some(sign);
            }
            if self.exponent() >= most_bits {
                return None;
            }
            if let Some(at) = self.refine() {
                return Some(q.sign_at(&at));
            }
        }
    }

    /// The same for a polynomial that is likely to be 0 there.
    pub(super) fn sturm_sign_of(&self, q: Poly<N>) -> Ordering {
        let [low, high] = self.ends();
        sturm::sign_at_root(self.poly, q, self.before, low, high)
    }

    /// The value of a polynomial at `low` and how much it changes at most up to `high`, both times
    /// the same power of two: `2^(degree exponent)` for the exponent of both ends. The degree is at
    /// least 1 and that of the polynomial.
    ///
    /// On `[0, 1]` the derivative of the sum of the `c_i t^i` is at most that of the `i |c_i|`.
    pub(super) fn range(&self, q: &Poly<N>, degree: usize) -> (Integer, Integer) {
        (self.value_at_low(q, degree), self.variation(q, degree))
    }

    fn value_at_low(&self, q: &Poly<N>, degree: usize) -> Integer {
        let missing = self.exponent() - self.low.at.exponent;
        let value = q.evaluate_as(degree, &self.low.at);
        value.shifted(degree as u64 * missing)
    }

    fn variation(&self, q: &Poly<N>, degree: usize) -> Integer {
        let slope = Integer::product(&slope_bound(q), &self.width());
        slope.shifted((degree as u64 - 1) * self.exponent())
    }

    /// The distance of the ends, times 2 to the power of the exponent of both.
    fn width(&self) -> Integer {
        let exponent = self.exponent();
        let [low, high] = self.ends();
        let mut width = high.numerator.shifted(exponent - high.exponent);
        width.sub_shifted(&low.numerator, exponent - low.exponent);
        width
    }
}

/// The most that the derivative of a polynomial is on `[0, 1]`: the sum of the `i |c_i|`.
fn slope_bound<const N: usize>(q: &Poly<N>) -> Integer {
    let mut slope = Integer::default();
    for (coefficient, i) in q.coefficients().iter().zip(0..) {
        slope.add_shifted(&coefficient.magnitude().times(i), 0);
    }
    slope
}

/// The bits of the longest coefficient.
pub(super) fn most_bits<const N: usize>(poly: &Poly<N>) -> u64 {
    let bits = poly.coefficients().iter().map(Integer::bits);
    bits.max().unwrap_or(0)
}

#[cfg(test)]
mod tests;
