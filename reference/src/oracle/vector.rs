//! Vectors of polynomials in `t`.

use std::cmp::Ordering;

use crate::algebraic::Algebraic;
use crate::field::Integer;
use crate::poly::Poly;

/// A vector in space that moves polynomially.
#[derive(Clone, Debug)]
pub(super) struct Vector<Z>(pub(super) [Poly<Z>; 3]);

impl<Z: Integer> Vector<Z> {
    /// From `start` at `t = 0` to `end` at `t = 1`, linearly.
    pub(super) fn linear(start: &[Z; 3], end: &[Z; 3]) -> Self {
        Vector([0, 1, 2].map(|h| Poly::line(&start[h], &end[h])))
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(Poly::is_zero)
    }

    pub(super) fn neg(&self) -> Self {
        Vector([0, 1, 2].map(|h| self.0[h].neg()))
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        Vector([0, 1, 2].map(|h| self.0[h].add(&other.0[h])))
    }

    pub(super) fn sub(&self, other: &Self) -> Self {
        Vector([0, 1, 2].map(|h| self.0[h].sub(&other.0[h])))
    }

    pub(super) fn dot(&self, other: &Self) -> Poly<Z> {
        let mut sum = Poly::zero();
        for (a, b) in self.0.iter().zip(&other.0) {
            sum.add_product(a, b);
        }
        sum
    }

    /// Component `h` of the cross product.
    pub(super) fn cross_component(&self, other: &Self, h: usize) -> Poly<Z> {
        let (i, j) = ((h + 1) % 3, (h + 2) % 3);
        let mut product = self.0[i].mul(&other.0[j]);
        product.sub_product(&self.0[j], &other.0[i]);
        product
    }

    pub(super) fn cross(&self, other: &Self) -> Self {
        Vector([0, 1, 2].map(|h| self.cross_component(other, h)))
    }

    pub(super) fn is_zero_at(&self, time: &Algebraic<Z>) -> bool {
        self.0
            .iter()
            .all(|component| time.sign_of(component).is_eq())
    }

    /// A component that is not 0 at the time, and its sign. The ones that the time's bounds show
    /// come first: to see that a component is 0 costs more.
    pub(super) fn axis_at(&self, time: &Algebraic<Z>) -> Option<(usize, Ordering)> {
        let axes = || [0, 1, 2].into_iter();
        let shown = |h: usize| Some((h, time.try_sign_of(&self.0[h])?));
        let exact = |h: usize| (h, time.sign_of(&self.0[h]));
        axes()
            .filter_map(shown)
            .chain(axes().map(exact))
            .find(|(_, sign)| sign.is_ne())
    }

    /// A polynomial that is 0 exactly where the vector is; 0 for the vector that always is.
    pub(super) fn common_zeros(&self) -> Poly<Z> {
        let [x, y, z] = &self.0;
        x.gcd(y).gcd(z)
    }
}

/// `n / d` near a time, rounded. Shown to people, decided upon by nobody.
pub(super) fn quotient<Z: Integer>(time: &Algebraic<Z>, n: &Poly<Z>, d: &Poly<Z>) -> f64 {
    time.refine(256);
    let (low, high, exponent) = time.bounds();
    let at = |poly: &Poly<Z>| {
        let value = poly.evaluate_dyadic(&low.add(&high), exponent + 1);
        let (mantissa, own) = value.approximate();
        let scale = (exponent as i64 + 1) * poly.degree() as i64;
        (mantissa, own - scale)
    };
    let ((n, n_exponent), (d, d_exponent)) = (at(n), at(d));
    if n == 0.0 {
        return 0.0;
    }
    n / d * 2f64.powi((n_exponent - d_exponent).clamp(-2000, 2000) as i32)
}
