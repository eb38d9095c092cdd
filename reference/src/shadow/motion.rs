//! Points that move on straight lines, as exact position and velocity.

use crate::algebraic::Algebraic;
use crate::field::{Integer, Ratio};
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::element::Element;
use super::vector::{Vector, difference};

/// A point or vector that changes linearly with time, `p + v t` (thesis equations 2.8 and 3.2).
#[derive(Clone, Debug)]
pub(super) struct Motion<Z> {
    /// The value at `t = 0`.
    pub(super) p: [Z; 3],
    /// The change during the step.
    pub(super) v: [Z; 3],
}

impl<Z: Integer> Motion<Z> {
    /// The motions of A, B, C and D, which the thesis stores as `P0` to `P3` and `V0` to `V3`.
    pub(super) fn of_scaled(scaled: &Scaled<Z>) -> [Motion<Z>; 4] {
        std::array::from_fn(|point| Motion {
            p: scaled.start[point].clone(),
            v: difference(&scaled.end[point], &scaled.start[point]),
        })
    }

    /// The motion as seen from another.
    pub(super) fn minus(&self, other: &Self) -> Self {
        Motion {
            p: difference(&self.p, &other.p),
            v: difference(&self.v, &other.v),
        }
    }

    /// The value at `t = 0`.
    pub(super) fn at_start(&self) -> Vector<Element<'_, Z>> {
        Vector(self.p.each_ref().map(Element::constant))
    }

    /// The value at `t_k`.
    pub(super) fn at<'a>(&self, t_k: &'a Algebraic<Z>) -> Vector<Element<'a, Z>> {
        Vector([0, 1, 2].map(|i| Element::moved(&self.p[i], &self.v[i], t_k)))
    }

    /// The value at a rational time.
    pub(super) fn at_ratio(&self, t: &Z::Ratio) -> Vector<Z::Ratio> {
        let ratio = |z: &Z| Z::Ratio::new(z.clone(), Z::one());
        Vector([0, 1, 2].map(|i| ratio(&self.p[i]) + ratio(&self.v[i]) * t.clone()))
    }

    /// The coordinates as polynomials in `t`.
    pub(super) fn polys(&self) -> [Poly<Z>; 3] {
        [0, 1, 2].map(|i| Poly::new(vec![self.p[i].clone(), self.v[i].clone()]))
    }
}
