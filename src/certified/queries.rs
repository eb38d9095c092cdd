//! Many queries: the first stages for several at once, the rest one by one.

use std::ops::Range;

use super::block::{CHUNK, Open, Source};
use super::cascade::{decide_motion, decide_rest};
use super::kind::{Kind, Stages};
use super::stage::Stage;
use super::step::Precision;
use super::thick;
use crate::contact::Hit;
use crate::environment;
use crate::query::Radius;

/// Whether none of these is above 0; `None` if some are and some are not.
pub(super) fn are_thin(radii: &[Radius]) -> Option<bool> {
    let zeros = radii.iter().filter(|radius| radius.is_zero()).count();
    let are_thin = zeros == radii.len();
    (are_thin || zeros == 0).then_some(are_thin)
}

/// All hits of so many queries with their places, in order.
pub(super) fn decide<K: Stages>(source: &impl Source, count: usize) -> Vec<(usize, Hit<K::Place>)> {
    let mut hits = Vec::new();
    decide_range::<K>(
        source,
        0..count,
        |query, hit| hits.push((query, hit)),
        |_| {},
    );
    hits
}

/// The same by all threads of the current pool.
#[cfg(feature = "rayon")]
pub(super) fn par_decide<K: Stages>(
    source: &(impl Source + Sync),
    count: usize,
) -> Vec<(usize, Hit<K::Place>)>
where
    K::Place: Send,
{
    use rayon::prelude::*;

    /// How many queries a thread takes at a time.
    const SHARE: usize = 4096;
    let starts = (0..count).into_par_iter().step_by(SHARE);
    let hits = starts.flat_map_iter(|start| {
        let mut hits = Vec::new();
        let share = start..count.min(start + SHARE);
        decide_range::<K>(source, share, |query, hit| hits.push((query, hit)), |_| {});
        hits
    });
    hits.collect()
}

/// Calls `hit` for each hit of some queries, in order, and says for each query, in any order, which
/// stage decided it. Allocates nothing.
pub(super) fn decide_range<K: Stages>(
    source: &impl Source,
    queries: Range<usize>,
    mut hit: impl FnMut(usize, Hit<K::Place>),
    mut observe: impl FnMut(Stage),
) {
    // By each thread that takes a part.
    debug_assert_eq!(environment::check(), Ok(()));
    let (mut open, mut are_thin) = (Open::new(), true);
    // Of those without a radius: how many were asked several at once and left open, of late.
    let (mut asked, mut left, mut unscreened) = (0, 0, 0);
    for first in queries.clone().step_by(CHUNK) {
        let chunk = first..queries.end.min(first + CHUNK);
        let are_now_thin = source.are_thin(chunk.clone());
        if open.is_full() || are_now_thin != Some(are_thin) {
            left += finish::<K>(&mut open, are_thin, source, &mut hit, &mut observe);
            if asked >= SAMPLE {
                unscreened = if 2 * left > asked { UNSCREENED } else { 0 };
                (asked, left) = (0, 0);
            }
        }
        are_thin = are_now_thin.unwrap_or_default();
        match are_now_thin {
            Some(false) => open.add_thick::<K>(source, chunk, &mut observe),
            Some(true) if unscreened == 0 => {
                asked += chunk.len();
                open.add::<K>(source, chunk, &mut observe);
            }
            _ => {
                unscreened = u32::saturating_sub(unscreened, 1);
                finish::<K>(&mut open, are_thin, source, &mut hit, &mut observe);
                open.put(source, chunk.clone());
                for (place, query) in chunk.enumerate() {
                    let positions = || open.positions(place);
                    let radius = source.radius(query);
                    if let Some(found) = decide_motion::<K>(positions, radius, &mut observe) {
                        hit(query, found);
                    }
                }
            }
        }
    }
    finish::<K>(&mut open, are_thin, source, &mut hit, &mut observe);
}

/// How many queries without a radius show whether the stages that are asked of several at once decide
/// so much that it pays.
const SAMPLE: usize = 256;

/// How many chunks are decided one by one after a sample for which it did not.
const UNSCREENED: u32 = 15 * (SAMPLE / CHUNK) as u32;

/// Decides what the first two stages leave, and says how much of it the stages for several at once
/// leave of queries without a radius.
fn finish<K: Stages>(
    open: &mut Open,
    are_thin: bool,
    source: &impl Source,
    hit: &mut impl FnMut(usize, Hit<K::Place>),
    observe: &mut impl FnMut(Stage),
) -> usize {
    let mut left = 0;
    if open.queries().is_empty() {
        return left;
    }
    match are_thin {
        true => {
            open.screen::<K>(observe);
            open.time_crossings::<K>();
        }
        false => open.screen_thick::<K>(observe),
    }
    for (place, &query) in open.queries().iter().enumerate() {
        let positions = open.positions(place);
        let found = if are_thin {
            let cubic = |motion: &_| open.cubic(place, motion);
            let time = open.crossing_time(place);
            left += usize::from(time == Some(0.0));
            decide_rest::<K>(&positions, cubic, time, observe)
        } else {
            let (radius, reached) = (source.radius(query), open.reached(place));
            thick::decide_from::<K>(&positions, radius, reached, observe)
        };
        if let Some(found) = found {
            hit(query, found);
        }
    }
    open.clear();
    left
}

/// Which queries may touch, as far as the stages say that are taken for several at once.
pub(crate) struct MayTouch {
    open: Open,
}

impl MayTouch {
    pub(crate) fn new() -> Self {
        MayTouch { open: Open::new() }
    }

    /// Calls `each` for queries, of a source of [`CHUNK`] or fewer, in order: for all that
    /// touch, and for some that do not.
    pub(crate) fn of<K: Kind>(
        &mut self,
        source: &impl Source,
        count: usize,
        each: impl FnMut(usize),
    ) {
        debug_assert!(count <= CHUNK);
        let all = 0..count;
        match source.are_thin(all.clone()) {
            Some(true) => {
                self.open.add::<K::Stages>(source, all, &mut |_| {});
                self.open.screen::<K::Stages>(&mut |_| {});
            }
            Some(false) => {
                self.open.add_thick::<K::Stages>(source, all, &mut |_| {});
                self.open.screen_thick::<K::Stages>(&mut |_| {});
            }
            None => return all.for_each(each),
        }
        self.visit(each);
    }

    /// As [`of`](Self::of), for what rounded positions at any step touch.
    pub(crate) fn with_room<K: Kind>(
        &mut self,
        source: &impl Source,
        count: usize,
        precision: Precision,
        each: impl FnMut(usize),
    ) {
        debug_assert!(count <= CHUNK);
        let all = 0..count;
        self.open.add_with_room::<K::Stages>(source, all, precision);
        self.open.screen_thick::<K::Stages>(&mut |_| {});
        self.visit(each);
    }

    fn visit(&mut self, each: impl FnMut(usize)) {
        self.open.queries().iter().copied().for_each(each);
        self.open.clear();
    }
}
