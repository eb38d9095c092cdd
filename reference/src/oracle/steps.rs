//! How a decision was reached, for whoever wants to see it: what vanishes, and each time at which
//! contact could begin.

use crate::algebraic::{Algebraic, isolate_roots};
use crate::answer::Parameters;
use crate::field::Integer;
use crate::poly::Poly;

use super::{Decision, Near};

/// A time at which contact could begin.
pub struct Step<Z> {
    /// The time, in `[0, 1]`.
    pub time: Algebraic<Z>,
    /// Why contact could begin then.
    pub event: Event,
    /// Where they touch at that time, if they do: the point or the two ends of an overlap.
    pub contact: Option<(Parameters, Option<Parameters>)>,
    /// Without radius: where the lines of the edges meet, or the vertex the plane of the face, if
    /// in one point: `u` and `v`, rounded.
    pub meeting: Option<[f64; 2]>,
}

/// Why contact could begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The step starts.
    Start,
    /// `f` is 0 and not identically 0: the points are coplanar.
    Coplanar,
    /// Of edges, an end, 0 to 3 for A to D, comes onto the line of the other edge, or onto an end
    /// of it; of a face, the vertex onto one of its edges, 0 to 2 for BC, CD and BD.
    EndOnLine(usize),
    /// Two features are as far apart as the radius.
    AtRadius,
}

impl<Z: Integer> Decision<Z> {
    /// The triple product of the four points in units of the scaled coordinates:
    /// `f = (K x L) . M` of edges, `f = (E1 x E2) . w` of a vertex and a face.
    pub fn f(&self) -> &Poly<Z> {
        self.motion.f()
    }

    /// What the case is decided by, and whether it is identically 0.
    pub fn vanishing(&self) -> Vec<(&'static str, bool)> {
        self.motion.vanishing()
    }

    /// Every time at which contact could begin, in order.
    pub fn steps(&self) -> Vec<Step<Z>> {
        let mut times: Vec<_> = match (&self.near, self.f().is_zero()) {
            (Some(near), _) => self.times_at_radius(near),
            (None, true) => self.end_times(),
            (None, false) => {
                let roots = isolate_roots(self.f()).into_iter();
                roots.map(|time| (time, Event::Coplanar)).collect()
            }
        };
        times.sort_by(|a, b| a.0.compare(&b.0));
        let step = |(time, event)| self.step(time, event);
        times.into_iter().map(step).collect()
    }

    /// The start, and the times at which a vertex comes onto the line of an edge; if it is always
    /// on it, those at which it passes an end of that edge.
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

    /// The start, if there is contact, and the times at which two features are at the radius.
    fn times_at_radius(&self, near: &Near<Z>) -> Vec<(Algebraic<Z>, Event)> {
        let times = near.proximity.times_at(&near.radius).into_iter();
        let mut times: Vec<_> = times.map(|time| (time, Event::AtRadius)).collect();
        if self.toi().is_some_and(Algebraic::is_zero) {
            times.push((Algebraic::zero(), Event::Start));
        }
        times
    }

    fn step(&self, time: Algebraic<Z>, event: Event) -> Step<Z> {
        let (locus, meeting) = match &self.near {
            None => (self.motion.locus(&time), self.motion.meeting(&time)),
            Some(near) => (Some(near.proximity.nearest(&*self.motion, &time)), None),
        };
        let contact = locus.map(|locus| {
            let first = locus.first.parameters(&time);
            let second = locus.second.map(|place| place.parameters(&time));
            (first, second)
        });
        Step {
            time,
            event,
            contact,
            meeting,
        }
    }
}
