//! One root of `f` to the last bit, for a caller that knows where it is.

use std::cell::OnceCell;
use std::cmp::Ordering;

use super::bracket::Bracket;
use super::curve::Curve;
use super::dyadic::Dyadic;
use super::lane::{Lane, Number};
use super::motion::Motion;
use super::roots::Source;
use super::tick::Tick;
use super::time::Time;

impl<L: Lane> Motion<L> {
    /// The only root of `f` in `[low, high]`, a simple one, between its neighbours in `f64`; `None` if
    /// the signs at the ends show that it is not.
    pub(super) fn enclose_root(&self, low: f64, high: f64) -> Option<(f64, f64)> {
        let curve = Curve::Cubic(self.f.clone());
        let poly = OnceCell::new();
        let source = Source::new(&curve, &poly);
        let (before, after) = (self.sign_of_f(source, low), self.sign_of_f(source, high));
        match (before, after) {
            (Ordering::Equal, _) => return Some((low, low)),
            (_, Ordering::Equal) => return Some((high, high)),
            _ if before == after => return None,
            _ => {}
        }
        let time = match (on_grid(low), on_grid(high)) {
            (Some(low), Some(high)) => Time::of_root(source, before, low, high),
            _ => {
                let ends = (Dyadic::from_f64(low), Dyadic::from_f64(high));
                Time::between(Bracket::new(source.poly(), ends.0, ends.1, before))
            }
        };
        Some((time.below, time.above))
    }

    fn sign_of_f(&self, source: Source<L>, at: f64) -> Ordering {
        if at == 0.0 {
            self.f[0].sign()
        } else if let Some(at) = Tick::from_f64(at) {
            source.curve.sample(at).0
        } else {
            source.poly().sign_at(&Dyadic::from_f64(at))
        }
    }
}

/// The time on the grid, `None` within for 0 and 1.
#[expect(
    clippy::option_option,
    reason = "not on the grid, and at an end of the step"
)]
fn on_grid(at: f64) -> Option<Option<Tick>> {
    if at == 0.0 || at == 1.0 {
        Some(None)
    } else {
        Tick::from_f64(at).map(Some)
    }
}
