//! Stages 1 and 2: proofs that two moving edges stay apart.

use super::ends::Ends;
use super::motion::{Motion, Vector, add, both, dot, sub};

/// The boxes around two swept edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct SweptBoxes {
    /// Whether they have no point in common, or none within the distance.
    pub(super) are_disjoint: bool,
    /// The size of the box around both: no difference of two of the points is larger, but for the
    /// rounding of one subtraction.
    extent: Vector,
}

impl SweptBoxes {
    /// The boxes around two sets of points, which count as disjoint if they are certainly farther
    /// apart than a distance on an axis.
    ///
    /// A difference is rounded once, and of the sign of the exact one: a distance above 0 has to be
    /// larger than the one that is meant by some `u`.
    #[inline(always)]
    pub(super) fn around<E: Ends, const M: usize, const N: usize>(
        first: [&[E; 3]; M],
        second: [&[E; 3]; N],
        distance: f64,
    ) -> Self {
        let axis = |i: usize| {
            let ((low, high), (other_low, other_high)) = (span(&first, i), span(&second, i));
            // Of both: at both ends of the step, then over the step.
            let [low, end_low] = low.transposed(other_low);
            let [high, end_high] = high.transposed(other_high);
            let (low, high) = (low.smaller(end_low), high.larger(end_high));
            let [x, y] = (low.swapped() - high).is_above(E::both(distance));
            (x | y, high.largest() - low.least())
        };
        let ((x, x_extent), (y, y_extent), (z, z_extent)) = (axis(0), axis(1), axis(2));
        SweptBoxes {
            are_disjoint: x | y | z,
            extent: [x_extent, y_extent, z_extent],
        }
    }

    /// Whether a difference of two products of differences of the points with `d` is certainly
    /// above 0 at both ends of the step.
    ///
    /// Error bound: every component `i` of a difference is at most the extent `e_i` of the box
    /// around everything, and rounded once (`u = 2^-53`). With `S` the sum of `e_i |d_i|`, a
    /// product with `d` in three products and two sums is within `4.1 u S` of the exact one
    /// (Higham, Accuracy and Stability of Numerical Algorithms, 3.1), with the rounded difference
    /// `5.2 u S`. There are up to three of them, and two more sums of values up to `3 S`: below
    /// `22 u S`. `S` is computed with a relative error below `6 u`. A product that underflows is
    /// off by at most `2^-1075`, absorbed by `TINY`. Nothing overflows while the bound is below
    /// `2^960`, so `S` below `2^1009`; else, NaN included, there is no claim.
    #[inline(always)]
    pub(super) fn is_certain<E: Ends>(&self, margin: E, d: &Vector) -> bool {
        let bound = self.bound(d);
        let [at_start, at_end] = margin.is_above(E::both(bound));
        at_start & at_end & (bound < LARGEST)
    }

    /// The error bound of [`is_certain`](Self::is_certain), if nothing overflows.
    #[inline(always)]
    pub(super) fn bound(&self, d: &Vector) -> f64 {
        let size = |i: usize| self.extent[i] * d[i].abs();
        (size(0) + size(1) + size(2)) * (24.0 * U) + TINY
    }
}

impl SweptBoxes {
    /// The length of the diagonal of the box around both, about.
    #[inline(always)]
    pub(super) fn size(&self) -> f64 {
        dot(&self.extent, &self.extent).sqrt()
    }
}

/// The least and the largest coordinate of some points on an axis.
#[inline(always)]
fn span<E: Ends, const N: usize>(points: &[&[E; 3]; N], axis: usize) -> (E, E) {
    let first = points[0][axis];
    points
        .iter()
        .skip(1)
        .fold((first, first), |(low, high), point| {
            (low.smaller(point[axis]), high.larger(point[axis]))
        })
}

impl<E: Ends> Motion<E> {
    /// Whether the direction from the middle of one edge's motion to the other's separates them.
    #[inline(always)]
    pub(super) fn is_separated_by_centres(&self, boxes: &SweptBoxes) -> bool {
        // C + D - A - B at both ends of the step, up to rounding that does no harm: any direction
        // will do.
        let rest = sub(&self.l, &self.k);
        let [x, y, z] = add(&add(&self.m, &self.m), &rest);
        self.is_separated_by([x.sum(), y.sum(), z.sum()], boxes)
    }

    /// Whether `d` separates the edges for the whole step: `X . d` is larger for C and D than for A
    /// and B, at `t = 0` and at `t = 1`. It is linear in `t`, so larger in between too.
    ///
    /// Relative to A, the smaller one of C and D is at `M . d + min(L . d, 0)`, the larger one of A
    /// and B at `max(K . d, 0)`.
    ///
    /// Three products, the error bound of [`SweptBoxes::is_certain`].
    #[inline(always)]
    fn is_separated_by(&self, d: Vector, boxes: &SweptBoxes) -> bool {
        let along = both(&d);
        let (k, l, m) = (
            dot(&self.k, &along),
            dot(&self.l, &along),
            dot(&self.m, &along),
        );
        let margin = m + l.smaller(E::both(0.0)) - k.larger(E::both(0.0));
        boxes.is_certain(margin, &d)
    }

    /// Looks for a separating direction: a few steps towards the point of the convex hull of the
    /// eight differences C - A, C - B, D - A, D - B that is nearest to 0 (Gilbert 1966, "An
    /// iterative procedure for computing the minimum of a quadratic form on a convex set"). Costs
    /// more than the cubic, so it comes last, before the exact stage.
    #[inline(never)]
    pub(super) fn is_separated_by_search(&self, boxes: &SweptBoxes) -> bool {
        let (k, l, m) = (&self.k, &self.l, &self.m);
        let to_d = add(m, l);
        let corners = [*m, to_d, sub(m, k), sub(&to_d, k)];
        let [p, q, r, s] = &corners;
        let mut nearest = add(&add(p, q), &add(r, s)).map(|sum| sum.sum() / 8.0);
        // Ends: after so many steps.
        for _ in 0..SEARCH_STEPS {
            let direction = both(&nearest);
            let along = corners.each_ref().map(|corner| dot(corner, &direction));
            let [p, q, r, s] = along;
            let least = p.smaller(q).smaller(r.smaller(s)).least();
            if least > 0.0 && self.is_separated_by(nearest, boxes) {
                return true;
            }
            let support = corners.iter().zip(along).find_map(|(corner, along)| {
                if along.start() == least {
                    Some(corner.map(E::start))
                } else {
                    (along.end() == least).then(|| corner.map(E::end))
                }
            });
            let Some(support) = support else { return false };
            let step = sub(&support, &nearest);
            let fraction = -dot(&nearest, &step) / dot(&step, &step);
            if !(fraction > 0.0) {
                return false;
            }
            nearest = add(&nearest, &step.map(|x| fraction.min(1.0) * x));
        }
        false
    }
}

/// Half the distance from 1 to the next `f64`: the largest relative error of one rounding.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// Far above what underflow adds.
const TINY: f64 = 1e-300;

const LARGEST: f64 = f64::from_bits((1023 + 960) << 52);

const SEARCH_STEPS: usize = 6;

#[cfg(test)]
mod tests;
