//! Motion with `f` identically 0: the first contact is where a vertex comes onto an edge.

use std::cmp::Ordering;

use super::{Locus, Places, Sides, hit, kind, signs_around};
use crate::certified::exact::thick::vector::{Vector, cross, dot, is_zero};
use crate::certified::exact::thick::{Poly, Roots, Time};
use crate::contact::Hit;

/// A vertex `X` against an edge `YZ` of the other side.
pub(super) struct End {
    /// A positive multiple of `G = (Y - X) x (Z - X)`, which is 0 where `X` is on the line `YZ`.
    pub(super) turn: Vector,
    /// A positive multiple of `(Y - X) . (Z - X)`: on the line, above 0 outside of the edge.
    pub(super) between: Poly,
    /// `(X - Y) . (Z - Y)`, `(Z - X) . (Z - Y)` and their sum, times something positive.
    pub(super) along: [Poly; 3],
}

impl End {
    /// From `Y - X`, `Z - X` and `Z - Y`, the last one also times something that is above 0.
    pub(super) fn new(to_y: &Vector, to_z: &Vector, edge: &Vector) -> Self {
        let from_y = Poly::difference(&Poly::default(), &dot(to_y, edge));
        let to_end = dot(to_z, edge);
        End {
            turn: cross(to_y, edge),
            between: dot(to_y, to_z),
            along: [from_y.clone(), to_end.clone(), Poly::sum(&from_y, &to_end)],
        }
    }

    /// A polynomial at whose roots alone the vertex can come onto the edge.
    fn candidates(&self) -> Poly {
        let component = self.turn.iter().find(|component| !component.is_zero());
        component.unwrap_or(&self.between).clone()
    }

    /// Whether the vertex is on the edge.
    pub(super) fn is_on_edge(&self, time: &Time) -> bool {
        self.turn.iter().all(|c| time.sign_of(c).is_eq()) && time.sign_of(&self.between).is_le()
    }

    /// Whether the vertex is on the line and passes through it.
    fn passes(&self, time: &Time) -> bool {
        let mut turn = self.turn.clone();
        let mut is_odd = false;
        // Ends: each derivative has a lower degree, and the last one is 0.
        while !is_zero(&turn) {
            if turn.iter().any(|component| time.sign_of(component).is_ne()) {
                return is_odd;
            }
            turn = turn.map(|component| component.derivative());
            is_odd = !is_odd;
        }
        false
    }
}

/// The first contact of a motion with `f` identically 0 and no contact at the start.
pub(super) fn decide<const W: usize>(sides: &impl Sides<W>) -> Option<Hit<Places<W>>> {
    let ends = sides.ends();
    let roots: Vec<Roots> = ends
        .iter()
        .map(|end| Roots::new(end.candidates()))
        .collect();
    let mut first: Option<(Time, [f64; 2])> = None;
    for (end, roots) in ends.iter().zip(&roots) {
        for (time, toi) in roots.times() {
            let is_earlier = |(first, _): &(Time, _)| time.compare(first).is_lt();
            if !first.as_ref().is_none_or(is_earlier) {
                break;
            }
            if end.is_on_edge(&time) {
                first = Some((time, toi));
                break;
            }
        }
    }
    let (time, toi) = first?;
    let locus = sides.locus(&time)?;
    let crosses = toi[0] < 1.0 && crosses(&ends, &time, &locus);
    Some(hit(
        sides,
        &time,
        toi,
        &locus,
        kind(crosses),
        Ordering::Equal,
    ))
}

/// Whether the first contact is a crossing in the sense of [`kind`](Hit::kind).
fn crosses<const W: usize>(ends: &[End], time: &Time, locus: &Locus<W>) -> bool {
    // On a line there was a gap before.
    if ends.iter().all(|end| is_zero(&end.turn)) {
        return true;
    }
    ends.iter().any(|end| {
        end.turn.iter().all(|c| time.sign_of(c).is_eq())
            && (time.sign_of(&end.between).is_lt() || locus.second.is_some())
            && end.passes(time)
    })
}

/// Whether there is a crossing at any time of the step.
pub(super) fn crosses_ever<const W: usize>(sides: &impl Sides<W>) -> bool {
    let ends = sides.ends();
    let is_line = ends.iter().all(|end| is_zero(&end.turn));
    let had_gap = |time: &Time| {
        let is_outside = |end: &End| signs_around(&end.between, time).0.is_gt();
        !is_line || ends.iter().all(is_outside)
    };
    ends.iter().any(|end| {
        let roots = Roots::new(end.candidates());
        let mut times = roots.times();
        times.any(|(time, toi)| {
            toi[0] < 1.0
                && had_gap(&time)
                && sides
                    .locus(&time)
                    .is_some_and(|locus| crosses(&ends, &time, &locus))
        })
    })
}
