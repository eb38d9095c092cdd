//! A root of `f`, and the exact normals next to it.

use wide::f64x2;

use super::{Exact, Number};
use crate::certified::cubic::Cubic;
use crate::certified::ends::Ends;
use crate::certified::motion::{Motion, Vector, cross};
use crate::certified::root::Bracket;

/// A root of `f` in a bracket.
pub(in super::super) struct Rooted {
    pub(in super::super) motion: Motion<f64x2>,
    pub(in super::super) bracket: Bracket,
    /// `K x L`, `M x L` and `M x K` at both ends of an interval around the root, `2^120` times
    /// shorter than the shortest bracket.
    pub(in super::super) normals: [[[Number; 3]; 3]; 2],
}

impl Rooted {
    /// The first root that `cubic` isolates, in a bracket that `widened` makes of its own.
    pub(in super::super) fn first(
        motion: Motion<f64x2>,
        cubic: &Cubic,
        exact: &Exact,
        widened: impl Fn(&Bracket) -> Option<Bracket>,
    ) -> Option<Self> {
        let bracket = *cubic.isolate(|_, _| false)?.as_slice().first()?;
        let [low, high] = [bracket.low, bracket.high].map(Number::from);
        let bracket = widened(&bracket)?;
        let (low, high) = exact.f.enclose(&low, &high, 120);
        Some(Rooted {
            motion,
            bracket,
            normals: [exact.normals(&low), exact.normals(&high)],
        })
    }

    /// The computed `K x L` in the middle of the bracket.
    pub(in super::super) fn normal(&self) -> Vector {
        let t = 0.5 * (self.bracket.low + self.bracket.high);
        let at = |x: &[f64x2; 3]| x.map(|x| (f64x2::new([1.0 - t, t]) * x).sum());
        cross(&at(&self.motion.k), &at(&self.motion.l))
    }
}
