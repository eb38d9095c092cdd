//! Whether the vertex is in the face at a root of `f`.

use crate::certified::cubic::Cubic;
use crate::certified::ends::Ends;
use crate::certified::locate::Meeting;
use crate::certified::motion::Motion;
use crate::certified::root::{Bracket, Half};
use crate::certified::separate::U;

/// What is certain about the vertex at a root of `f`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// It is outside of the face.
    Apart,
    /// It is strictly inside.
    Inside {
        /// The weights of B, C and D.
        weights: [f64; 3],
        /// A bound on their error.
        error: f64,
    },
    /// The bounds do not tell.
    Unclear,
}

/// Numbers in proportion to the weights of B, C and D, each up to an error.
///
/// At a root of `f` let `N = (C - B) x (D - B)`. If `N` is not 0, `A` is the sum of the corners by
/// weights that sum up to 1, and the cross products that [`raw_weights`] and [`of_edges`] take are
/// the weights times `N`; the values here are their products with some vector `w`. If `N` is 0, the
/// face is a segment or a point, and if A is on that the cross products are 0.
///
/// So if any of the values is not 0 and A is in the face, `N . w` is not 0 and they have its sign
/// or are 0: two of opposite signs prove that A is outside. Three of the same sign prove that it is
/// strictly inside: their sum is `N . w`, so that `N` is not 0 and the weights are their ratios to
/// it.
#[derive(Clone, Copy, Debug)]
pub(super) struct RawWeights {
    pub(super) values: [f64; 3],
    pub(super) errors: [f64; 3],
}

/// The raw weights at a root, from the motion of [`super::separate::star`].
///
/// With `K = C - B`, `L = D - B` and `M = A - B`: `M x L` is that of C, `K x M` that of D, and
/// `K x L` less both that of B. Their products with `w`, the computed `K x L`, are those of
/// [`Motion::meeting`]; the two sums add less than `2 u` of what they sum up, which is less than an
/// eighth of the bounds.
#[inline(always)]
pub(super) fn raw_weights<E: Ends>(
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> RawWeights {
    let meeting = motion.meeting(cubic, bracket);
    let Meeting {
        error_n,
        error_u,
        error_v,
        ..
    } = meeting;
    RawWeights {
        values: [meeting.before_b + meeting.v, meeting.u, -meeting.v],
        errors: [1.25 * (error_n + error_u + error_v), error_u, error_v],
    }
}

/// The raw weights from the lines of the edges BC and AD: with `K = C - B`, `L = D - A` and
/// `M = A - B`, `M x L` is that of C, `K x M` that of D, and `K x L - M x L` that of B (see the
/// exact stage).
///
/// The difference is rounded once: less than an eighth of the bound, as [`Meeting`] says.
pub(super) fn of_edges(meeting: &Meeting) -> RawWeights {
    let Meeting {
        error_n,
        error_u,
        error_v,
        ..
    } = *meeting;
    RawWeights {
        values: [meeting.before_b, meeting.u, -meeting.v],
        errors: [1.25 * (error_n + error_u), error_u, error_v],
    }
}

/// Whether the vertex is certainly outside of the face at a root in a half of the step.
#[inline(always)]
pub(in crate::certified) fn is_apart_in<E: Ends>(
    motion: &Motion<E>,
    cubic: &Cubic,
    half: &Half,
) -> bool {
    half.has_none | (half.has_one & raw_weights(motion, cubic, &half.bracket).are_apart())
}

impl RawWeights {
    /// Which raw weights are certainly above 0, and which are below.
    #[inline(always)]
    fn signs(&self) -> ([bool; 3], [bool; 3]) {
        let ([b, c, d], [error_b, error_c, error_d]) = (self.values, self.errors);
        (
            [b > error_b, c > error_c, d > error_d],
            [b < -error_b, c < -error_c, d < -error_d],
        )
    }

    /// Whether the vertex is certainly outside of the face.
    #[inline(always)]
    pub(super) fn are_apart(&self) -> bool {
        let ([b, c, d], [minus_b, minus_c, minus_d]) = self.signs();
        (b | c | d) & (minus_b | minus_c | minus_d)
    }

    /// Whether the vertex is certainly strictly inside.
    #[inline(always)]
    pub(super) fn are_inside(&self) -> bool {
        let ([b, c, d], [minus_b, minus_c, minus_d]) = self.signs();
        (b & c & d) | (minus_b & minus_c & minus_d)
    }

    /// Where the vertex is.
    pub(super) fn place(&self) -> Place {
        if self.are_apart() {
            return Place::Apart;
        }
        if !self.are_inside() {
            return Place::Unclear;
        }
        // |x~/s~ - x/s| <= (error of x + error of s) / (|s~| - error of s) for x/s in [0, 1], and
        // for the sums and the quotient fewer than eight roundings.
        let [b, c, d] = self.values;
        let sum = b + c + d;
        let error = self.errors.iter().sum::<f64>() * (1.0 + 8.0 * U);
        // Each is above its error, and yet all together may be no more than the bound of all.
        if sum.abs() <= error {
            return Place::Unclear;
        }
        Place::Inside {
            weights: self.values.map(|value| value / sum),
            error: 2.0 * error / (sum.abs() - error) + 8.0 * U,
        }
    }
}

#[cfg(test)]
mod tests;
