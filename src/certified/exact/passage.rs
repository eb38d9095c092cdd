//! Whether midlines cross at any time of the step, and the case of the motion: what a radius does
//! not change.
//!
//! The definition of [`Hit::kind`](crate::contact::Hit::kind), asked at every time at which there
//! can be a crossing, and not at the first contact alone.

use std::cmp::Ordering;

use super::confined::passes_any;
use super::curve::Curve;
use super::face::Face;
use super::motion::{End, Motion, Quadratic};
use super::roots::Roots;
use super::time::Time;
use super::width::{Number, Width};
use super::{Question, answer};
use crate::certified::motion::Positions;
use crate::contact::{Case, ContactKind};

/// What two midlines, or a vertex and a face, do to each other during the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::certified) struct Passage {
    /// The case of the motion.
    pub(in crate::certified) case: Case,
    /// Whether there is a crossing at any time of the step.
    pub(in crate::certified) kind: ContactKind,
}

/// The passage of two edges.
pub(in crate::certified) fn passage_of_edges(positions: &Positions) -> Passage {
    answer(EdgesPass, positions)
}

/// The passage of a vertex A and a face BCD, given as B, C, A, D.
pub(in crate::certified) fn passage_of_face(as_edges: &Positions) -> Passage {
    answer(VertexPasses, as_edges)
}

/// The sign of `f` of two edges just before a time of impact above 0 with these neighbours in
/// `f64`, unless it has a root there.
pub(in crate::certified) fn side_of_edges(positions: &Positions, toi: [f64; 2]) -> Option<i8> {
    answer(Side { toi }, positions)
}

/// The same of a vertex A and a face BCD, given as B, C, A, D.
pub(in crate::certified) fn side_of_face(as_edges: &Positions, toi: [f64; 2]) -> Option<i8> {
    answer(Side { toi }, as_edges)
}

struct EdgesPass;

impl Question for EdgesPass {
    type Answer = Passage;

    fn answer<L: Width>(self, motion: Motion<L>) -> Passage {
        let (case, crosses) = if motion.is_confined() {
            let overlap = |time: &Time<L>| motion.locus(time).map(|locus| locus.second.is_some());
            let crosses = crosses_confined(motion.ends(), overlap);
            (motion.confined_case(), crosses)
        } else {
            let cuts = |time: &Time<L>| motion.locus(time).is_some_and(|locus| locus.cuts_inside);
            (Case::General, crosses_in_space(&motion, cuts))
        };
        let kind = kind(crosses);
        Passage { case, kind }
    }
}

struct VertexPasses;

impl Question for VertexPasses {
    type Answer = Passage;

    fn answer<L: Width>(self, motion: Motion<L>) -> Passage {
        let face = Face::new(motion);
        let crosses = if face.motion.is_confined() {
            crosses_confined(&face.edges(), |time| face.place(time).map(|_| false))
        } else {
            let is_interior = |time: &Time<L>| face.place(time).is_some_and(|p| p.is_interior());
            crosses_in_space(&face.motion, is_interior)
        };
        Passage {
            case: face.case(),
            kind: kind(crosses),
        }
    }
}

struct Side {
    toi: [f64; 2],
}

impl Question for Side {
    type Answer = Option<i8>;

    fn answer<L: Width>(self, motion: Motion<L>) -> Option<i8> {
        let [below, above] = self.toi;
        let mut roots: Roots<L> = Roots::none();
        let curve = Curve::Cubic(motion.f);
        let signs = curve.bernstein_signs();
        // Just after the start.
        let mut sign = *signs.iter().find(|sign| sign.is_ne())?;
        roots.find(curve);
        for (root, _, after) in roots.iter() {
            if root.below >= above {
                break;
            }
            if !(root.below < below && root.above <= below) {
                return None;
            }
            sign = after;
        }
        Some(sign as i8)
    }
}

fn kind(crosses: bool) -> ContactKind {
    if crosses {
        ContactKind::Crossing
    } else {
        ContactKind::Graze
    }
}

/// Whether `f`, which is not identically 0, changes its sign inside the step where they meet
/// inside.
fn crosses_in_space<L: Width>(motion: &Motion<L>, meet: impl Fn(&Time<L>) -> bool) -> bool {
    let mut roots = Roots::none();
    roots.find(Curve::Cubic(motion.f.clone()));
    roots
        .iter()
        .any(|(time, before, after)| before != after && time.is_inside() && meet(&time))
}

/// The same where `f` is identically 0. `overlap` says where they touch, and whether in more than a
/// point.
fn crosses_confined<L: Width>(ends: &[End<L>], overlap: impl Fn(&Time<L>) -> Option<bool>) -> bool {
    let is_line = ends.iter().all(End::is_on_line);
    let crosses_at = |time: &Time<L>| match overlap(time) {
        Some(_) if is_line => ends
            .iter()
            .all(|end| is_positive_before(&end.between, time)),
        Some(overlap) => passes_any(ends, time, overlap),
        None => false,
    };
    ends.iter().filter_map(End::curve).any(|curve| {
        let mut roots = Roots::none();
        roots.find(curve);
        roots
            .iter()
            .any(|(time, _, _)| time.is_inside() && crosses_at(&time))
    })
}

/// Whether a polynomial is above 0 just before a time.
fn is_positive_before<L: Width>(q: &Quadratic<L>, time: &Time<L>) -> bool {
    let [_, c1, c2] = q;
    let zero = c1.sub(c1);
    let slope = [c1.clone(), c2.add(c2), zero];
    let before = time.sign_of(q);
    let before = before.then(time.sign_of(&slope).reverse());
    before.then(c2.sign()) == Ordering::Greater
}

#[cfg(test)]
mod tests;
