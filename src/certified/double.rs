//! Double-double arithmetic: an unevaluated sum of two `f64`, twice the precision of one.

use super::ends::{Ends, Scalar};

/// An unevaluated sum `high + low`, `|low|` at most half an ulp of `high`; in each lane.
#[derive(Clone, Copy)]
pub(super) struct Double<T> {
    pub(super) high: T,
    pub(super) low: T,
}

/// `a + b` without error (Knuth; Dekker 1971).
#[inline(always)]
pub(super) fn two_sum<T: Scalar>(a: T, b: T) -> Double<T> {
    let high = a + b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) + (b - part),
    }
}

/// `a - b` without error.
#[inline(always)]
pub(super) fn two_difference<T: Scalar>(a: T, b: T) -> Double<T> {
    let high = a - b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) - (b + part),
    }
}

/// `a b` without error, unless something over- or underflows (Veltkamp, Dekker 1971).
#[inline(always)]
pub(super) fn two_product<E: Ends>(a: E, b: E) -> Double<E> {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let halves = |x: E| {
        let c = E::both(SPLIT) * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let high = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    Double {
        high,
        low: ((ah * bh - high) + ah * bl + al * bh) + al * bl,
    }
}

impl<T: Scalar> Double<T> {
    /// `a + b`, without error if `a` is the larger one (Dekker 1971), or a multiple of an ulp of `b`: as
    /// after a sum of two high parts that cancels, where the low parts are at most one and a half ulps
    /// of the smaller one.
    #[inline(always)]
    pub(super) fn sum(a: T, b: T) -> Self {
        let high = a + b;
        Double {
            high,
            low: b - (high - a),
        }
    }

    /// `self + other`; an error below `8 * 2^-106 (|self| + |other|)`: the low parts are added in
    /// `f64`, which is not precise relative to a sum that cancels, nor need it be.
    #[inline(always)]
    pub(super) fn add(self, other: Self) -> Self {
        let s = two_sum(self.high, other.high);
        Self::sum(s.high, s.low + (self.low + other.low))
    }

    /// `self - other`; an error as that of [`add`](Self::add).
    #[inline(always)]
    pub(super) fn sub(self, other: Self) -> Self {
        let s = two_difference(self.high, other.high);
        Self::sum(s.high, s.low + (self.low - other.low))
    }
}

impl<E: Ends> Double<E> {
    /// `self other`; relative error below `8 * 2^-106`.
    #[inline(always)]
    pub(super) fn mul(self, other: Self) -> Self {
        let p = two_product(self.high, other.high);
        Self::sum(
            p.high,
            p.low + (self.high * other.low + self.low * other.high),
        )
    }

    /// The same number in both lanes.
    #[inline(always)]
    pub(super) fn both(number: Double<f64>) -> Self {
        Double {
            high: E::both(number.high),
            low: E::both(number.low),
        }
    }

    /// The lanes exchanged.
    #[inline(always)]
    pub(super) fn swapped(self) -> Self {
        Double {
            high: self.high.swapped(),
            low: self.low.swapped(),
        }
    }

    /// The first lanes of two numbers, and their second ones.
    #[inline(always)]
    pub(super) fn transposed(self, other: Self) -> [Self; 2] {
        let ([high, end_high], [low, end_low]) = (
            self.high.transposed(other.high),
            self.low.transposed(other.low),
        );
        [
            Double { high, low },
            Double {
                high: end_high,
                low: end_low,
            },
        ]
    }

    /// The two numbers.
    #[inline(always)]
    pub(super) fn lanes(self) -> [Double<f64>; 2] {
        [
            Double {
                high: self.high.start(),
                low: self.low.start(),
            },
            Double {
                high: self.high.end(),
                low: self.low.end(),
            },
        ]
    }
}

impl Double<f64> {
    /// The nearest `f64`.
    #[inline(always)]
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests;
