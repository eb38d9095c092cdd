//! How a decision was reached, for whoever wants to see it: what vanishes, and each time at which
//! contact could begin.

use crate::algebraic::{Algebraic, isolate_roots};
use crate::answer::Parameters;
use crate::field::Integer;
use crate::poly::Poly;

use super::Decision;
use super::motion::Motion;

/// A time at which contact could begin.
pub struct Step<Z> {
    /// The time, in `[0, 1]`.
    pub time: Algebraic<Z>,
    /// Why contact could begin then.
    pub event: Event,
    /// Where the edges touch at that time, if they do: the point or the two ends of an overlap.
    pub contact: Option<(Parameters, Option<Parameters>)>,
    /// Where the lines of the edges meet, if in one point: `u` and `v`, rounded.
    pub meeting: Option<[f64; 2]>,
}

/// Why contact could begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The step starts.
    Start,
    /// `f` is 0 and not identically 0: the edges are coplanar.
    Coplanar,
    /// An end, 0 to 3 for A to D, comes onto the line of the other edge, or onto an end of it.
    EndOnLine(usize),
}

impl<Z: Integer> Decision<Z> {
    /// The triple product `f = (K x L) . M` in units of the scaled coordinates.
    pub fn f(&self) -> &Poly<Z> {
        &self.motion.f
    }

    /// What the case is decided by, and whether it is identically 0.
    pub fn vanishing(&self) -> [(&'static str, bool); 6] {
        let Motion { k, l, m, n, f } = &self.motion;
        [
            ("K", k.is_zero()),
            ("L", l.is_zero()),
            ("M", m.is_zero()),
            ("K x L", n.is_zero()),
            ("K x M", k.cross(m).is_zero()),
            ("f", f.is_zero()),
        ]
    }

    /// Every time at which contact could begin, in order.
    pub fn steps(&self) -> Vec<Step<Z>> {
        let mut times: Vec<_> = match self.motion.f.is_zero() {
            false => {
                let roots = isolate_roots(&self.motion.f).into_iter();
                roots.map(|time| (time, Event::Coplanar)).collect()
            }
            true => self.end_times(),
        };
        times.sort_by(|a, b| a.0.compare(&b.0));
        let step = |(time, event)| self.step(time, event);
        times.into_iter().map(step).collect()
    }

    /// The start, and the times at which an end comes onto the line of the other edge; if it is
    /// always on it, those at which it passes an end of that edge.
    fn end_times(&self) -> Vec<(Algebraic<Z>, Event)> {
        let mut times = vec![(Algebraic::zero(), Event::Start)];
        for (index, end) in self.motion.ends().iter().enumerate() {
            let description = match end.turn.is_zero() {
                true => end.between.clone(),
                false => end.turn.common_zeros(),
            };
            if !description.is_zero() {
                let roots = isolate_roots(&description).into_iter();
                times.extend(roots.map(|time| (time, Event::EndOnLine(index))));
            }
        }
        times
    }

    fn step(&self, time: Algebraic<Z>, event: Event) -> Step<Z> {
        let contact = self.motion.locus(&time).map(|locus| {
            let first = locus.first.parameters(&time);
            let second = locus.second.map(|place| place.parameters(&time));
            (first, second)
        });
        let meeting = self.motion.transversal_axis(&time).map(|(axis, _)| {
            let Motion { k, l, m, n, .. } = &self.motion;
            let quotient = |numerator| quotient(&time, &numerator, &n.0[axis]);
            [m.cross_component(l, axis), m.cross_component(k, axis)].map(quotient)
        });
        Step {
            time,
            event,
            contact,
            meeting,
        }
    }
}

/// `n / d` near a time, rounded. Shown to people, decided upon by nobody.
fn quotient<Z: Integer>(time: &Algebraic<Z>, n: &Poly<Z>, d: &Poly<Z>) -> f64 {
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
