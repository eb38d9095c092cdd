//! Early exclusion: pairs of segments that move too little to meet need no test.

use crate::query::Point;

use super::aabb::{check, check_radius};
use super::error::BroadError;
use super::item_id::ItemId;
use super::items::Pair;
use super::separation::{distance_above, distance_below};

/// Leaves out pairs of moving segments that are farther apart than they can have moved.
///
/// Each step: [`place`](Self::place) every segment where the step takes it, then ask which pairs
/// are [`remaining`](Self::remaining). A pair is left out only if it is proved that its segments
/// stay farther apart than their radii, at all times of the step: a bound on their distance when it
/// was last measured, rounded down, less bounds on all that they have moved since, rounded up.
///
/// A point of a segment whose ends go on straight lines moves no farther than one of the ends does,
/// so the distance of two segments shrinks by no more than the longer way of either's ends, in sum.
/// What is no motion of one segment (an id given again to another, a radius that grows) counts as
/// if it were one.
#[derive(Clone, Debug, Default)]
pub struct SlowPairs {
    /// By the index of the item.
    tracks: Vec<Option<Track>>,
    /// The pairs that were left out of the last step, and how much farther than their radii they
    /// are apart at least.
    excluded: Vec<(Pair, f64)>,
    remaining: Vec<Pair>,
    counts: Exclusions,
}

/// How many pairs were asked about, and what became of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exclusions {
    /// Pairs asked about.
    pub asked: u64,
    /// Left out by what remained of a distance measured in an earlier step.
    pub remembered: u64,
    /// Left out by the distance measured at the start of the step.
    pub measured: u64,
}

/// A segment in this step.
#[derive(Clone, Copy, Debug)]
struct Track {
    radius: f64,
    start: [Point; 2],
    now: [Point; 2],
    /// At least how far any point of it has come on its way from `start` to `now`, in metres.
    motion: f64,
}

impl SlowPairs {
    /// Where a segment is now, given by its ends, to which it came on straight lines; it stays
    /// until it is placed again. `radius` is how far from the segment it counts as touched, 0 to
    /// ask for the midlines alone.
    ///
    /// A new segment that moves in its first step is placed twice, where it starts and where it
    /// ends. A move that is taken back is two moves.
    ///
    /// # Errors
    ///
    /// [`BroadError`] if a coordinate is not finite or the radius not a finite number of at least
    /// 0.
    pub fn place(&mut self, item: ItemId, ends: [Point; 2], radius: f64) -> Result<(), BroadError> {
        check(&ends, true)?;
        check_radius(radius)?;
        if self.tracks.len() <= item.index() {
            self.tracks.resize(item.index() + 1, None);
        }
        match &mut self.tracks[item.index()] {
            Some(track) => track.go(ends, radius),
            new => {
                *new = Some(Track {
                    radius,
                    start: ends,
                    now: ends,
                    motion: 0.0,
                });
            }
        }
        Ok(())
    }

    /// Ends a step: of the pairs whose boxes overlap, those that need a test. The segments start
    /// the next step where they are.
    ///
    /// Pairs with an item that was never placed remain.
    pub fn remaining(&mut self, pairs: &[Pair]) -> &[Pair] {
        self.counts.asked += pairs.len() as u64;
        self.remaining.clear();
        let last = std::mem::take(&mut self.excluded);
        let mut last = last.into_iter().peekable();
        for &pair in pairs {
            while last.next_if(|(other, _)| *other < pair).is_some() {}
            let remembered = last.next_if(|(other, _)| *other == pair);
            match self.slack(pair, remembered.map(|(_, slack)| slack)) {
                Some(slack) => self.excluded.push((pair, slack)),
                None => self.remaining.push(pair),
            }
        }
        self.tracks.iter_mut().flatten().for_each(Track::rest);
        &self.remaining
    }

    /// How much farther than their radii the segments of a pair stay apart during this step, at
    /// least, if that is proved to be above 0; `last` is the same at the end of the last step.
    fn slack(&mut self, pair: Pair, last: Option<f64>) -> Option<f64> {
        let track = |item: ItemId| self.tracks.get(item.index()).copied().flatten();
        let (first, second) = (track(pair.first())?, track(pair.second())?);
        let motion = (first.motion + second.motion).next_up();
        let rest = |slack: f64| (slack - motion).next_down();
        if let Some(slack) = last.map(rest).filter(|slack| *slack > 0.0) {
            self.counts.remembered += 1;
            return Some(slack);
        }
        let radius = (first.radius + second.radius).next_up();
        let slack = (distance_below(&first.start, &second.start) - radius).next_down();
        let slack = Some(rest(slack)).filter(|slack| *slack > 0.0)?;
        self.counts.measured += 1;
        Some(slack)
    }

    /// The counts since the beginning.
    pub fn counts(&self) -> Exclusions {
        self.counts
    }
}

/// A segment where it is between two steps: radius and ends.
#[cfg(feature = "recording")]
pub(crate) type Placed = (f64, [Point; 2]);

/// What is known between two steps, of which later answers are made.
#[cfg(feature = "recording")]
impl SlowPairs {
    /// Where segments are, by the index of the item.
    pub(crate) fn placed(&self) -> Vec<Option<Placed>> {
        let placed = |track: &Track| (track.radius, track.now);
        let tracks = self.tracks.iter();
        tracks.map(|track| track.as_ref().map(placed)).collect()
    }

    /// The pairs that were left out of the last step, by the indices of their items in ascending
    /// order, and how much farther than their radii they are apart at least.
    pub(crate) fn excluded(&self) -> Vec<([usize; 2], f64)> {
        let excluded = self.excluded.iter();
        excluded
            .map(|(pair, slack)| ([pair.first().index(), pair.second().index()], *slack))
            .collect()
    }

    /// The same as [`placed`](Self::placed) and [`excluded`](Self::excluded) tell it; counts start
    /// anew. Precondition: the pairs are in ascending order, as far apart, and of two items each.
    pub(crate) fn between_steps(
        placed: Vec<Option<Placed>>,
        excluded: Vec<([usize; 2], f64)>,
    ) -> Self {
        let track = |(radius, ends)| Track {
            radius,
            start: ends,
            now: ends,
            motion: 0.0,
        };
        let excluded = excluded.into_iter();
        SlowPairs {
            tracks: placed.into_iter().map(|placed| placed.map(track)).collect(),
            excluded: excluded
                .map(|([a, b], slack)| (Pair::new(ItemId(a), ItemId(b)), slack))
                .collect(),
            ..SlowPairs::default()
        }
    }
}

impl Track {
    fn go(&mut self, ends: [Point; 2], radius: f64) {
        let way = |end: usize| distance_above(&self.now[end], &ends[end]);
        let farthest = way(0).max(way(1));
        let growth = (radius - self.radius).next_up().max(0.0);
        let way = (farthest + growth).next_up();
        self.motion = (self.motion + way).next_up();
        (self.now, self.radius) = (ends, radius);
    }

    /// Starts the next step.
    fn rest(&mut self) {
        (self.start, self.motion) = (self.now, 0.0);
    }
}
