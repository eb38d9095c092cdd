//! The largest step of a mesh that is proved to touch nothing, and the positions to store.

use super::candidates::{Candidate, Candidates, Question};
use super::error::MeshError;
use super::topology::{Mesh, Pair, Thickness};
use crate::certified::{Blocked, Clearance, Limit, Moved, PairMotion, Precision, Together};
use crate::query::{Coordinate, Radius};

/// A step of a mesh that is proved, with positions in `f64`, or in `f32` for `C`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshStep<C = f64> {
    /// How much of the step is made, from 0 to 1.
    pub step: f64,
    /// The positions to store: those of [`interpolate_in`](crate::interpolate_in) at this step, in
    /// the precision of their type, so the end itself at 1 and the start at 0.
    pub positions: Vec<[C; 3]>,
    /// The pairs for which the step is no larger, in order; none if it is a whole one.
    pub limits: Vec<MeshLimit>,
    /// The pairs that keep less than the thickness and the clearance, as they start nearer than
    /// that, in order, with what they keep.
    pub near: Vec<(Pair, Radius)>,
    /// How many pairs of edges or points, and of a vertex and a face, have swept boxes that come
    /// within what is kept of each other.
    pub candidates: [usize; 2],
}

/// A pair that ends a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshLimit {
    /// The pair.
    pub pair: Pair,
    /// Why it does.
    pub blocked: Blocked,
}

/// What one part of the pairs says.
#[derive(Default)]
struct Found {
    counts: [usize; 2],
    /// Pairs whose motion to the end, with rounding, comes too near.
    close: Vec<(Candidate, Option<Limit>)>,
}

impl Mesh {
    /// The largest step, nearly, from `start` towards `end` that keeps all pairs apart by more than
    /// the thickness, and the positions to store.
    ///
    /// As [`step_with_clearance`](Self::step_with_clearance) with [`Clearance::None`].
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact).
    pub fn step<'a, C: Coordinate>(
        &self,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<MeshStep<C>, MeshError> {
        self.step_with_clearance(start, end, thickness, Clearance::None)
    }

    /// The largest step, nearly, that keeps all pairs apart by more than the thickness and a
    /// clearance, and the positions to store. How nearly is said at [`advance`](crate::advance).
    ///
    /// Positions that are given in `f32` are returned in `f32`, with the same guarantee. There is less
    /// room then: two sides that are nearer than some 2^-21 of their coordinates, beyond what they keep,
    /// may be [`Blocked::Rounding`].
    ///
    /// # Guarantee
    ///
    /// Straight motion of all vertices from `start` to [`MeshStep::positions`] keeps each pair
    /// farther apart than the thickness and the clearance, exactly, in real arithmetic. A pair that
    /// starts nearer than that keeps nine tenths of what it has beyond the thickness, or of its
    /// distance if it starts within the thickness; where rounding leaves no room even for that, it
    /// keeps the thickness, or does not touch. [`MeshStep::near`] names such pairs. They are free to
    /// part. With [`Clearance::Share`] a pair that would come within the thickness keeps that share
    /// of what it has beyond it.
    ///
    /// The next step starts at the stored positions. So nothing ever passes through anything,
    /// however many steps follow. The preconditions are those of [`decide`](crate::decide).
    ///
    /// The step is 0 if a pair touches at the start, thickness or not, or if rounding leaves no room
    /// to any step tried: [`MeshStep::limits`] names the pairs. Where [`Blocked::Rounding`] ends a step,
    /// it may be as small as some rounding errors, so do not wait for 0. Do not ask again with the
    /// same motion. Part these pairs, let them move otherwise, or leave them out.
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact), and [`MeshError::Clearance`].
    pub fn step_with_clearance<'a, C: Coordinate>(
        &self,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
        clearance: Clearance,
    ) -> Result<MeshStep<C>, MeshError> {
        let clearance = clearance.checked()?;
        let question = Question::new(self, start, end, thickness.into())?;
        let beyond = match clearance {
            Clearance::Distance(distance) => distance,
            _ => 0.0,
        };
        let candidates = Candidates::new(question, beyond, Some(Precision::of::<C>()));
        let parts = candidates.visit(|found: &mut Found, screen, chunk| {
            found.counts[chunk.kind as usize] += chunk.len();
            let close = &mut found.close;
            let limit = |candidate: &Candidate, vertices: &[u32; 4]| {
                let radius = question.radius(chunk.kind, vertices);
                let motion = question.motion(candidate);
                let limit = motion.limit(radius, clearance, Precision::of::<C>());
                close.push((*candidate, limit));
            };
            screen.may_touch_rounded(&question, chunk, beyond, limit);
        });
        let mut counts = [0; 2];
        let mut close = Vec::new();
        for found in parts {
            counts = [0, 1].map(|i| counts[i] + found.counts[i]);
            close.extend(found.close);
        }
        let together = Together {
            start,
            end,
            motion: &|candidate| question.motion(candidate),
        };
        let Moved {
            step,
            positions,
            limits,
            near,
        } = together.moved(close);
        let limit = |(candidate, blocked): &(Candidate, Blocked)| MeshLimit {
            pair: question.pair(candidate),
            blocked: *blocked,
        };
        let kept = |(candidate, kept): &(Candidate, Radius)| (question.pair(candidate), *kept);
        Ok(MeshStep {
            step,
            positions,
            limits: limits.iter().map(limit).collect(),
            near: near.iter().map(kept).collect(),
            candidates: counts,
        })
    }
}

impl<C: Coordinate> Question<'_, C> {
    fn motion(&self, candidate: &Candidate) -> PairMotion {
        PairMotion {
            kind: candidate.kind,
            positions: self.positions(&self.vertices_of(candidate)),
        }
    }
}
