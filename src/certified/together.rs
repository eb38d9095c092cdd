//! How far many pairs may move together, and the positions to store.
//!
//! Each pair has a [`Limit`]: what it keeps of its distance, and up to which step rounded positions
//! do. The step of all is the least of these, unless all pairs keep what they should during the
//! whole motion: then the positions are those asked for, without any rounding. A smaller step needs
//! no second look at the pairs that have room for rounding. The others start so near to what they
//! keep that the motion to the stored positions is decided itself.

use super::motion::Positions;
use super::step::{Blocked, Clearance, Limit, Precision, halved, is_apart_until, limit, stored};
use crate::query::{Coordinate, EdgeEdge, QueryKind, Radius, VertexFace, widened};

/// The motion of a pair, of either kind.
pub(crate) struct PairMotion {
    pub(crate) kind: QueryKind,
    pub(crate) positions: Positions,
}

impl PairMotion {
    /// As [`limit`].
    #[inline(never)]
    pub(crate) fn limit(
        &self,
        radius: Radius,
        clearance: Clearance,
        precision: Precision,
    ) -> Option<Limit> {
        let positions = &self.positions;
        match self.kind {
            QueryKind::EdgeEdge => limit::<EdgeEdge>(positions, radius, clearance, precision),
            QueryKind::VertexFace => limit::<VertexFace>(positions, radius, clearance, precision),
        }
    }

    fn decided(&self, limit: Limit, precision: Precision) -> Limit {
        match self.kind {
            QueryKind::EdgeEdge => limit.decided::<EdgeEdge>(&self.positions, precision),
            QueryKind::VertexFace => limit.decided::<VertexFace>(&self.positions, precision),
        }
    }

    fn is_apart_until(&self, kept: Radius, step: f64, precision: Precision) -> bool {
        let positions = &self.positions;
        match self.kind {
            QueryKind::EdgeEdge => is_apart_until::<EdgeEdge>(positions, kept, step, precision),
            QueryKind::VertexFace => is_apart_until::<VertexFace>(positions, kept, step, precision),
        }
    }
}

/// The motion of all points, and how that of a pair `P` of them is looked up.
pub(crate) struct Together<'a, P, C> {
    pub(crate) start: &'a [[C; 3]],
    pub(crate) end: &'a [[C; 3]],
    pub(crate) motion: &'a dyn Fn(&P) -> PairMotion,
}

/// A step of all points that is proved.
pub(crate) struct Moved<P, C> {
    /// How much of the step is made.
    pub(crate) step: f64,
    /// The positions to store.
    pub(crate) positions: Vec<[C; 3]>,
    /// The pairs for which the step is no larger, in order.
    pub(crate) limits: Vec<(P, Blocked)>,
    /// The pairs that keep less than they should, in order, with what they keep.
    pub(crate) near: Vec<(P, Radius)>,
}

impl<P: Copy + Ord, C: Coordinate> Together<'_, P, C> {
    /// The step by the limits of the pairs that come too near during the motion to the end; those of
    /// `None` touch at the start.
    pub(crate) fn moved(&self, mut close: Vec<(P, Option<Limit>)>) -> Moved<P, C> {
        close.sort_unstable_by_key(|(pair, _)| *pair);
        let (step, limits) = self.furthest(&mut close);
        let near = close.iter().filter_map(|(pair, limit)| {
            let limit = limit.as_ref().filter(|limit| !limit.is_whole)?;
            Some((*pair, limit.kept))
        });
        Moved {
            step,
            positions: self.stored(step).collect(),
            limits,
            near: near.collect(),
        }
    }

    fn furthest(&self, close: &mut [(P, Option<Limit>)]) -> (f64, Vec<(P, Blocked)>) {
        let touching: Vec<_> = close
            .iter()
            .filter(|(_, limit)| limit.is_none())
            .map(|(pair, _)| (*pair, Blocked::Touching))
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
        self.decide_least(close);
        let limits = close.iter();
        let limits = limits.filter_map(|(pair, limit)| limit.as_ref().map(|limit| (*pair, limit)));
        // Those that have hardly room for rounding, or none for a part of the step, are decided at each
        // step that is tried.
        let is_tight = |limit: &Limit| limit.until == 0.0 || limit.toi.is_none() || limit.is_short;
        let (tight, roomy): (Vec<_>, Vec<_>) = limits.partition(|(_, limit)| is_tight(limit));
        let roomy_step = roomy.iter().map(|(_, limit)| limit.until);
        let tight_step = tight.iter().filter_map(|(_, limit)| limit.toi);
        let largest = roomy_step.chain(tight_step).fold(1.0, f64::min);
        let ends = |step: f64| {
            let ahead = roomy.iter().filter(move |(_, limit)| limit.until <= step);
            let ahead = ahead.map(|(pair, _)| (*pair, Blocked::Ahead));
            let near = tight
                .iter()
                .filter(move |(_, limit)| limit.toi.is_some_and(|toi| toi <= step));
            ahead.chain(near.map(|(pair, _)| (*pair, Blocked::Rounding)))
        };
        // What those with hardly room prove at least.
        let short = tight.iter().filter(|(_, limit)| limit.is_short);
        let least = short.map(|(_, limit)| limit.until).reduce(f64::min);
        let least = least.map(|least| least.min(largest));
        let mut failing = Vec::new();
        for step in halved(largest).chain(least) {
            let fails = |(pair, limit): &&(P, &Limit)| {
                !(self.motion)(pair).is_apart_until(limit.kept, step, Precision::of::<C>())
            };
            let now: Vec<_> = tight.iter().filter(fails).collect();
            if now.is_empty() && self.moves(step) {
                let near = failing.iter().copied();
                let mut all: Vec<_> = ends(step).chain(near).collect();
                all.sort_unstable_by_key(|(pair, _)| *pair);
                return (step, all);
            }
            if !now.is_empty() {
                let now = now.into_iter();
                failing = now.map(|(pair, _)| (*pair, Blocked::Rounding)).collect();
            }
        }
        // No position that is stored would be another one.
        if failing.is_empty() {
            let ends = ends(largest);
            failing = ends.map(|(pair, _)| (pair, Blocked::Rounding)).collect();
        }
        (0.0, failing)
    }

    /// Decides the limits that planes leave rough, as long as they are the least: the others do not
    /// matter. Those of 0 are the least of all.
    fn decide_least(&self, close: &mut [(P, Option<Limit>)]) {
        let mut order: Vec<usize> = (0..close.len()).collect();
        let until = |(_, limit): &(P, Option<Limit>)| limit.map_or(1.0, |limit| limit.until);
        order.sort_by(|&i, &j| until(&close[i]).total_cmp(&until(&close[j])));
        let mut least = 1.0;
        for index in order {
            let (pair, limit) = &mut close[index];
            let Some(limit) = limit.as_mut().filter(|limit| limit.toi.is_some()) else {
                continue;
            };
            if limit.until > least {
                break;
            }
            if limit.is_rough() {
                *limit = (self.motion)(pair).decided(*limit, Precision::of::<C>());
            }
            if limit.until > 0.0 && !limit.is_short {
                least = limit.until.min(least);
            }
        }
    }

    /// Whether any position at a step is another one than at the start.
    fn moves(&self, step: f64) -> bool {
        let mut both = self.start.iter().zip(self.stored(step));
        both.any(|(start, stored)| stored != *start)
    }

    /// The positions to store at a step.
    fn stored(&self, step: f64) -> impl Iterator<Item = [C; 3]> {
        let both = self.start.iter().zip(self.end);
        both.map(move |(start, end)| {
            // Of the type of both ends, as the precision says.
            stored(&widened(start), &widened(end), step, Precision::of::<C>()).map(C::of)
        })
    }
}
