//! Motion confined to a plane, which may itself turn, or to a line: `f` is identically 0.
//!
//! Let the first contact be at `s > 0`. If no end of an edge were on the other edge at `s`, the lines
//! would meet at an angle, inside both edges, and so they would shortly before. The candidates are
//! therefore 0 and the times at which an end comes onto the other edge. Edges that are a point for
//! the whole step and edges with a common start are among these motions.

use std::cmp::Ordering;

use crate::contact::ContactKind;

use super::isolate::Roots;
use super::lane::{Lane, Number};
use super::locus::Locus;
use super::motion::{End, Motion, Quadratic};
use super::poly::Poly;
use super::time::Time;
use crate::certified::verdict::Hit;

/// An end of an edge against the other edge; see [`Motion::turn`] and [`Motion::between`].
struct Approach<L: Lane> {
    turn: [Quadratic<L>; 3],
    between: Quadratic<L>,
    /// The roots of a component of the turn that is not identically 0, else those of `between`.
    roots: Option<Roots>,
}

impl<L: Lane> Motion<L> {
    /// The first contact of a motion with `f` identically 0.
    pub(super) fn decide_confined(&self) -> Option<Hit> {
        let start = Time::start();
        if let Some(locus) = self.locus(&start) {
            let case = self.confined_case();
            return Some(Hit::exact(
                &start,
                &locus,
                ContactKind::Graze,
                Ordering::Equal,
                case,
            ));
        }
        let approaches = [End::A, End::B, End::C, End::D].map(|end| Approach::new(self, end));
        let times = approaches.iter().filter_map(Approach::first_contact);
        let toi = times.min_by(Time::compare)?;
        let locus = self.locus(&toi)?;
        let kind = if toi.is_inside() && crosses(&approaches, &toi, &locus) {
            ContactKind::Crossing
        } else {
            ContactKind::Graze
        };
        Some(Hit::exact(
            &toi,
            &locus,
            kind,
            Ordering::Equal,
            self.confined_case(),
        ))
    }
}

/// Whether the first contact, strictly inside the step, is a crossing.
fn crosses<L: Lane>(approaches: &[Approach<L>; 4], toi: &Time, locus: &Locus<L>) -> bool {
    // On a line every contact that was not there before is one.
    approaches.iter().all(Approach::is_on_line)
        || approaches
            .iter()
            .any(|approach| approach.passes(toi, locus.second.is_some()))
}

impl<L: Lane> Approach<L> {
    fn new(motion: &Motion<L>, end: End) -> Self {
        let (turn, between) = (motion.turn(end), motion.between(end));
        let moves = |q: &&Quadratic<L>| !q.iter().all(Number::is_zero);
        let leading = turn.iter().find(moves).or(Some(&between)).filter(moves);
        let roots = leading.map(|q| Roots::new(Poly::new(q)));
        Approach {
            turn,
            between,
            roots,
        }
    }

    /// Whether the end is on the line of the other edge for the whole step, or that is a point.
    fn is_on_line(&self) -> bool {
        self.turn.iter().flatten().all(Number::is_zero)
    }

    /// The first time at which the end is on the other edge, if it is not at the start.
    fn first_contact(&self) -> Option<Time<'_>> {
        let roots = self.roots.as_ref()?;
        let times = roots.cells().iter().map(|cell| Time::of_root(roots, cell));
        let mut times = times.filter(|time| self.meets_line(time));
        times.find(|time| time.sign_of(&self.between).is_le())
    }

    /// Whether the turn is 0 at a time.
    fn meets_line(&self, time: &Time) -> bool {
        self.turn
            .iter()
            .all(|component| time.sign_of(component).is_eq())
    }

    /// Whether the end passes at a time through the line of the other edge, which may otherwise be
    /// anywhere: inside that edge, or onto an overlap.
    ///
    /// The turn has degree 2: where it is 0 and its derivative is not, it reverses its direction.
    fn passes(&self, time: &Time, overlap: bool) -> bool {
        if self.is_on_line() || !self.meets_line(time) {
            return false;
        }
        let slope_is_zero = |[_, c1, c2]: &Quadratic<L>| {
            let zero = c1.sub(c1);
            time.sign_of(&[c1.clone(), c2.add(c2), zero]).is_eq()
        };
        !self.turn.iter().all(slope_is_zero) && (overlap || time.sign_of(&self.between).is_lt())
    }
}
