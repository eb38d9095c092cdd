//! The largest step of a mesh that is proved to touch nothing, and the positions to store.
//!
//! Each pair has a [`Limit`]: what it keeps of its distance, and up to which step rounded positions
//! do. The step of the mesh is the least of these, unless all pairs keep what they should during the
//! whole motion: then the positions are those asked for, without any rounding. A smaller step needs
//! no second look at the pairs that have room for rounding. The others start so near to what they
//! keep that the motion to the stored positions is decided itself.

use super::candidates::{Candidate, Candidates, PairKind, Position, Question};
use super::error::MeshError;
use super::topology::{Mesh, Pair, Thickness};
use crate::certified::{
    Blocked, Clearance, Limit, Positions, Precision, halved, is_apart_until, limit, stored,
};
use crate::query::{EdgeEdge, Radius, VertexFace};

/// A step of a mesh that is proved.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshStep {
    /// How much of the step is made, from 0 to 1.
    pub step: f64,
    /// The positions to store: those of [`interpolate_in`](crate::interpolate_in) at this step, so
    /// the end itself at 1 and the start at 0.
    pub positions: Vec<[f64; 3]>,
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
    pub fn step<'a>(
        &self,
        start: &[Position],
        end: &[Position],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<MeshStep, MeshError> {
        self.step_with_clearance(start, end, thickness, Clearance::None)
    }

    /// The largest step, nearly, that keeps all pairs apart by more than the thickness and a
    /// clearance, and the positions to store. How nearly is said at [`advance`](crate::advance).
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
    /// to any step tried: [`MeshStep::limits`] names the pairs. Do not ask again with the same
    /// motion. Part these pairs, let them move otherwise, or leave them out.
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact), and [`MeshError::Clearance`].
    pub fn step_with_clearance<'a>(
        &self,
        start: &[Position],
        end: &[Position],
        thickness: impl Into<Thickness<'a>>,
        clearance: Clearance,
    ) -> Result<MeshStep, MeshError> {
        self.step_in(start, end, thickness, clearance, Precision::F64)
    }

    /// [`step_with_clearance`](Self::step_with_clearance), with positions that are stored in `f32`
    /// where that is asked.
    ///
    /// The guarantee is the same, and about the numbers that are stored: if all positions at the
    /// start are `f32`, so are those of [`MeshStep::positions`], and `as f32` changes none of them. A
    /// whole step ends at the `f32` nearest to `end`. There is less room, as
    /// [`advance_in`](crate::advance_in) says.
    ///
    /// # Errors
    ///
    /// As [`step_with_clearance`](Self::step_with_clearance).
    pub fn step_in<'a>(
        &self,
        start: &[Position],
        end: &[Position],
        thickness: impl Into<Thickness<'a>>,
        clearance: Clearance,
        precision: Precision,
    ) -> Result<MeshStep, MeshError> {
        let clearance = clearance.checked()?;
        let targets = (precision != Precision::F64).then(|| targets(end, precision));
        let end = targets.as_deref().unwrap_or(end);
        let question = Question::new(self, start, end, thickness.into())?;
        let beyond = match clearance {
            Clearance::Distance(distance) => distance,
            _ => 0.0,
        };
        let candidates = Candidates::new(question, beyond, Some(precision));
        let parts = candidates.visit(|found: &mut Found, screen, chunk| {
            found.counts[chunk.kind as usize] += chunk.len();
            let close = &mut found.close;
            let limit = |candidate: &Candidate, vertices: &[u32; 4]| {
                let radius = question.radius(chunk.kind, vertices);
                let limit = question
                    .motion(candidate)
                    .limit(radius, clearance, precision);
                close.push((*candidate, limit));
            };
            screen.may_touch_rounded(&question, chunk, beyond, precision, limit);
        });
        let mut counts = [0; 2];
        let mut close = Vec::new();
        for found in parts {
            counts = [0, 1].map(|i| counts[i] + found.counts[i]);
            close.extend(found.close);
        }
        close.sort_unstable_by_key(|(candidate, _)| *candidate);
        let (step, limits) = question.furthest(&mut close, precision);
        let shown = |(candidate, blocked): (Candidate, Blocked)| MeshLimit {
            pair: question.pair(&candidate),
            blocked,
        };
        let near = close.iter().filter_map(|(candidate, limit)| {
            let limit = limit.as_ref().filter(|limit| !limit.is_whole)?;
            Some((question.pair(candidate), limit.kept))
        });
        let near = near.collect();
        let positions = start.iter().zip(end);
        Ok(MeshStep {
            step,
            positions: positions
                .map(|(start, end)| stored(start, end, step, precision))
                .collect(),
            limits: limits.into_iter().map(shown).collect(),
            near,
            candidates: counts,
        })
    }
}

/// What positions at the end of a motion become.
fn targets(end: &[Position], precision: Precision) -> Vec<Position> {
    let of = |position: &Position| position.map(|x| precision.target(x));
    end.iter().map(of).collect()
}

impl Question<'_> {
    /// The step of a mesh by the limits of its pairs, and those that end it.
    fn furthest(
        &self,
        close: &mut [(Candidate, Option<Limit>)],
        precision: Precision,
    ) -> (f64, Vec<(Candidate, Blocked)>) {
        let touching: Vec<_> = close
            .iter()
            .filter(|(_, limit)| limit.is_none())
            .map(|(candidate, _)| (*candidate, Blocked::Touching))
            .collect();
        if !touching.is_empty() {
            return (0.0, touching);
        }
        if close
            .iter()
            .flat_map(|(_, limit)| limit)
            .all(|limit| limit.toi.is_none())
        {
            return (1.0, Vec::new());
        }
        self.decide_least(close, precision);
        let limits = close.iter();
        let limits =
            limits.filter_map(|(candidate, limit)| limit.as_ref().map(|limit| (candidate, limit)));
        // Those that have hardly room for rounding, or none for a part of the step, are decided at each
        // step that is tried.
        let is_tight = |limit: &Limit| limit.until == 0.0 || limit.toi.is_none() || limit.is_short;
        let (tight, roomy): (Vec<_>, Vec<_>) = limits.partition(|(_, limit)| is_tight(limit));
        let roomy_step = roomy.iter().map(|(_, limit)| limit.until);
        let tight_step = tight.iter().filter_map(|(_, limit)| limit.toi);
        let largest = roomy_step.chain(tight_step).fold(1.0, f64::min);
        let ends = |step: f64| {
            let ahead = roomy.iter().filter(move |(_, limit)| limit.until <= step);
            let ahead = ahead.map(|(candidate, _)| (**candidate, Blocked::Ahead));
            let near = tight
                .iter()
                .filter(move |(_, limit)| limit.toi.is_some_and(|toi| toi <= step));
            ahead.chain(near.map(|(candidate, _)| (**candidate, Blocked::Near)))
        };
        // What those with hardly room prove at least.
        let short = tight.iter().filter(|(_, limit)| limit.is_short);
        let least = short.map(|(_, limit)| limit.until).reduce(f64::min);
        let least = least.map(|least| least.min(largest));
        let mut failing = Vec::new();
        for step in halved(largest).chain(least) {
            let fails = |(candidate, limit): &&(&Candidate, &Limit)| {
                !self
                    .motion(candidate)
                    .is_apart_until(limit.kept, step, precision)
            };
            let now: Vec<_> = tight.iter().filter(fails).collect();
            if now.is_empty() && self.moves(step, precision) {
                let near = failing.iter().copied();
                let mut all: Vec<_> = ends(step).chain(near).collect();
                all.sort_unstable_by_key(|(candidate, _)| *candidate);
                return (step, all);
            }
            if !now.is_empty() {
                failing = now
                    .into_iter()
                    .map(|(candidate, _)| (**candidate, Blocked::Near))
                    .collect();
            }
        }
        // No position that is stored would be another one.
        if failing.is_empty() {
            failing = ends(largest)
                .map(|(candidate, _)| (candidate, Blocked::Near))
                .collect();
        }
        (0.0, failing)
    }

    /// Decides the limits that planes leave rough, as long as they are the least: the others do not
    /// matter. Those of 0 are the least of all.
    fn decide_least(&self, close: &mut [(Candidate, Option<Limit>)], precision: Precision) {
        let mut order: Vec<usize> = (0..close.len()).collect();
        let until =
            |(_, limit): &(Candidate, Option<Limit>)| limit.map_or(1.0, |limit| limit.until);
        order.sort_by(|&i, &j| until(&close[i]).total_cmp(&until(&close[j])));
        let mut least = 1.0;
        for index in order {
            let (candidate, limit) = &mut close[index];
            let Some(limit) = limit.as_mut().filter(|limit| limit.toi.is_some()) else {
                continue;
            };
            if limit.until > least {
                break;
            }
            if limit.is_rough() {
                *limit = self.motion(candidate).decided(*limit, precision);
            }
            if limit.until > 0.0 && !limit.is_short {
                least = limit.until.min(least);
            }
        }
    }

    fn motion(&self, candidate: &Candidate) -> PairOf {
        PairOf {
            kind: candidate.kind,
            positions: self.positions(&self.vertices_of(candidate)),
        }
    }

    /// Whether any position at a step is another one than at the start.
    fn moves(&self, step: f64, precision: Precision) -> bool {
        let mut both = self.start.iter().zip(self.end);
        both.any(|(start, end)| stored(start, end, step, precision) != *start)
    }
}

/// The motion of a pair, of either kind.
struct PairOf {
    kind: PairKind,
    positions: Positions,
}

impl PairOf {
    #[inline(never)]
    fn limit(&self, radius: Radius, clearance: Clearance, precision: Precision) -> Option<Limit> {
        match self.kind {
            PairKind::Edges => limit::<EdgeEdge>(&self.positions, radius, clearance, precision),
            PairKind::Face => limit::<VertexFace>(&self.positions, radius, clearance, precision),
        }
    }

    fn decided(&self, limit: Limit, precision: Precision) -> Limit {
        match self.kind {
            PairKind::Edges => limit.decided::<EdgeEdge>(&self.positions, precision),
            PairKind::Face => limit.decided::<VertexFace>(&self.positions, precision),
        }
    }

    fn is_apart_until(&self, kept: Radius, step: f64, precision: Precision) -> bool {
        match self.kind {
            PairKind::Edges => is_apart_until::<EdgeEdge>(&self.positions, kept, step, precision),
            PairKind::Face => is_apart_until::<VertexFace>(&self.positions, kept, step, precision),
        }
    }
}
