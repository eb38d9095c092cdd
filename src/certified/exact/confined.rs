//! Motion confined to a plane, which may itself turn, or to a line: `f` is identically 0.
//!
//! Let the first contact be at `s > 0`. If no end of an edge were on the other edge at `s`, the
//! lines would meet at an angle, inside both edges, and so they would shortly before. The
//! candidates are therefore 0 and the times at which an end comes onto the other edge. Edges that
//! are a point for the whole step and edges with a common start are among these motions.

use std::cmp::Ordering;

use crate::contact::{ContactKind, EdgePlace, Hit};

use super::curve::{Curve, bernstein_signs};
use super::edge_hit;
use super::motion::{End, Motion, Quadratic};
use super::roots::Roots;
use super::time::Time;
use super::width::{Number, Width};

impl<L: Width> Motion<L> {
    /// The first contact of a motion with `f` identically 0.
    pub(super) fn decide_confined(&self) -> Option<Hit<EdgePlace>> {
        let start = Time::start();
        if let Some(locus) = self.locus(&start) {
            let case = self.confined_case();
            return Some(edge_hit(
                &start,
                &locus,
                ContactKind::Graze,
                Ordering::Equal,
                case,
            ));
        }
        let ends = self.ends();
        let mut roots = [Roots::none(), Roots::none(), Roots::none(), Roots::none()];
        let toi = first_contact(ends, &mut roots)?;
        let locus = self.locus(&toi)?;
        let kind = kind(ends, &toi, locus.second.is_some());
        Some(edge_hit(
            &toi,
            &locus,
            kind,
            Ordering::Equal,
            self.confined_case(),
        ))
    }
}

/// The first time at which an end is on its edge, with a place for the roots of each.
#[inline(never)]
pub(super) fn first_contact<'a, L: Width, const N: usize>(
    ends: &[End<L>; N],
    roots: &'a mut [Roots<L>; N],
) -> Option<Time<'a, L>> {
    for (end, roots) in ends.iter().zip(&mut *roots) {
        if let Some(curve) = end.candidates() {
            roots.find(curve);
        }
    }
    let times = ends
        .iter()
        .zip(&*roots)
        .filter_map(|(end, roots)| end.first_contact(roots));
    times.min_by(Time::compare)
}

/// What the first contact is, if it is not that of the start.
pub(super) fn kind<L: Width>(ends: &[End<L>], toi: &Time<L>, overlap: bool) -> ContactKind {
    // On a line every contact that was not there before is a crossing.
    let crosses = || ends.iter().all(End::is_on_line) || passes_any(ends, toi, overlap);
    if toi.is_inside() && crosses() {
        ContactKind::Crossing
    } else {
        ContactKind::Graze
    }
}

/// Whether an end passes at a time through the line of its edge, inside that or onto an overlap.
pub(super) fn passes_any<L: Width>(ends: &[End<L>], time: &Time<L>, overlap: bool) -> bool {
    ends.iter().any(|end| end.passes(time, overlap))
}

impl<L: Width> End<L> {
    /// A polynomial that is 0 where the end comes onto the other edge: a component of the turn that
    /// is not identically 0, else `between`; `None` if that is identically 0 as well, or if plainly
    /// the end never does.
    fn candidates(&self) -> Option<Curve<L>> {
        if self.stays_away() {
            None
        } else {
            self.curve()
        }
    }

    /// As [`candidates`](Self::candidates), though plainly the end never does.
    pub(super) fn curve(&self) -> Option<Curve<L>> {
        let moves = |q: &&Quadratic<L>| !q.iter().all(Number::is_zero);
        let mut all = self.turn.iter().chain([&self.between]);
        all.find(moves).map(|q| Curve::Quadratic(q.clone()))
    }

    /// Whether Bernstein coefficients of one sign show that the end is never on the other edge:
    /// those of a component of the turn, or those of `between` if that is above 0.
    fn stays_away(&self) -> bool {
        let keeps = |q: &Quadratic<L>, sign| bernstein_signs::<L>(q) == [sign; 3];
        let is_never_0 = |q| keeps(q, Ordering::Less) || keeps(q, Ordering::Greater);
        keeps(&self.between, Ordering::Greater) || self.turn.iter().any(is_never_0)
    }

    /// Whether the end is on the line of the other edge for the whole step, or that is a point.
    pub(super) fn is_on_line(&self) -> bool {
        self.turn.iter().flatten().all(Number::is_zero)
    }

    /// The first of these times at which it does.
    fn first_contact<'a>(&self, candidates: &'a Roots<L>) -> Option<Time<'a, L>> {
        let mut times = candidates.iter().map(|(time, _, _)| time);
        times.find(|time| self.is_on_edge(time))
    }

    /// Whether the end is on the edge at a time.
    pub(super) fn is_on_edge(&self, time: &Time<L>) -> bool {
        self.meets_line(time) && time.sign_of(&self.between).is_le()
    }

    /// Whether the turn is 0 at a time.
    fn meets_line(&self, time: &Time<L>) -> bool {
        self.turn
            .iter()
            .all(|component| time.sign_of(component).is_eq())
    }

    /// Whether the end passes at a time through the line of the other edge, which may otherwise be
    /// anywhere: inside that edge, or onto an overlap.
    ///
    /// The turn has degree 2: where it is 0 and its derivative is not, it reverses its direction.
    fn passes(&self, time: &Time<L>, overlap: bool) -> bool {
        let is_inside = overlap || time.sign_of(&self.between).is_lt();
        if !is_inside || self.is_on_line() || !self.meets_line(time) {
            return false;
        }
        let slope_is_zero = |[_, c1, c2]: &Quadratic<L>| {
            let zero = c1.sub(c1);
            time.sign_of(&[c1.clone(), c2.add(c2), zero]).is_eq()
        };
        !self.turn.iter().all(slope_is_zero)
    }
}
