//! Many queries: the first stages for several at once, the rest one by one.

use std::ops::Range;

use super::block::{CHUNK, Open, Source};
use super::cascade::{decide_motion, decide_rest};
use super::cubic::Cubic;
use super::kind::{Kind, Stages};
use super::stage::Stage;
use super::step::Precision;
use super::thick;
use crate::contact::Hit;
use crate::environment;
use crate::query::Radius;

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
    const SHARE: usize = 1024;
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
/// stage decided it. Allocates nothing, but in the exact stage.
pub(super) fn decide_range<K: Stages>(
    source: &impl Source,
    queries: Range<usize>,
    mut hit: impl FnMut(usize, Hit<K::Place>),
    mut observe: impl FnMut(Stage),
) {
    // By each thread that takes a part.
    debug_assert_eq!(environment::check(), Ok(()));
    if queries.len() < FEW {
        return decide_few::<K>(source, queries, &mut hit, &mut observe);
    }
    let (mut open, mut are_thin, mut worth) = (Open::new(), true, Worths::default());
    for first in queries.clone().step_by(CHUNK) {
        let chunk = first..queries.end.min(first + CHUNK);
        let are_now_thin = source.are_thin(chunk.clone());
        let is_alone = are_now_thin && !worth.stages.is_tried();
        if open.is_full() || are_now_thin != are_thin || is_alone {
            finish::<K>(
                &mut open,
                are_thin,
                source,
                &mut worth,
                &mut hit,
                &mut observe,
            );
        }
        are_thin = are_now_thin;
        if !are_thin {
            open.add_thick::<K>(source, chunk, &mut observe);
        } else if worth.stages.is_tried() {
            worth.stages.asked += chunk.len();
            open.add::<K, _>(source, chunk, &mut observe);
        } else {
            worth.stages.skip();
            open.put(source, chunk.clone());
            for (place, query) in chunk.enumerate() {
                let positions = || open.positions(place);
                let found = decide_motion::<K>(positions, Radius::ZERO, &mut observe);
                if let Some(found) = found {
                    hit(query, found);
                }
            }
        }
    }
    finish::<K>(
        &mut open,
        are_thin,
        source,
        &mut worth,
        &mut hit,
        &mut observe,
    );
}

/// Fewer queries take longer several at once than one by one.
const FEW: usize = 16;

/// Decides queries one by one; not inlined, so that what takes many stays small.
#[inline(never)]
fn decide_few<K: Stages>(
    source: &impl Source,
    queries: Range<usize>,
    hit: &mut impl FnMut(usize, Hit<K::Place>),
    observe: &mut impl FnMut(Stage),
) {
    for query in queries {
        let positions = source.positions(query);
        if let Some(found) = decide_motion::<K>(|| positions, source.radius(query), observe) {
            hit(query, found);
        }
    }
}

/// What asking several queries at once is worth.
#[derive(Default)]
struct Worths {
    /// All stages, of queries without a radius.
    stages: Worth,
    /// Contacts after the last plane, of those with one.
    touches: Worth,
}

/// Whether it decides so much that it pays.
#[derive(Default)]
struct Worth {
    /// How many queries were asked of late.
    asked: usize,
    /// How many of them it left open.
    left: usize,
    /// How often it is not tried any more.
    skipped: u32,
}

/// How many queries show that.
const SAMPLE: usize = 256;

/// How often it is not tried after a sample for which it did not.
const SKIPPED: u32 = 15 * (SAMPLE / CHUNK) as u32;

impl Worth {
    fn is_tried(&self) -> bool {
        self.skipped == 0
    }

    fn skip(&mut self) {
        self.skipped = self.skipped.saturating_sub(1);
    }

    fn left(&mut self, left: usize) {
        self.left += left;
        if self.asked >= SAMPLE {
            let is_much = 2 * self.left > self.asked;
            *self = Worth {
                skipped: if is_much { SKIPPED } else { 0 },
                ..Worth::default()
            };
        }
    }
}

/// Decides what the first two stages leave.
fn finish<K: Stages>(
    open: &mut Open,
    are_thin: bool,
    source: &impl Source,
    worth: &mut Worths,
    hit: &mut impl FnMut(usize, Hit<K::Place>),
    observe: &mut impl FnMut(Stage),
) {
    if open.queries().is_empty() {
        return;
    }
    if are_thin {
        open.screen::<K>(observe);
        open.time_crossings::<K>();
        let left = decide_thin::<K>(open, hit, observe);
        worth.stages.left(left);
    } else {
        open.screen_thick::<K>(observe);
        let is_tried = worth.touches.is_tried();
        let has_touches = is_tried && open.find_touches::<K>(source);
        if has_touches {
            worth.touches.asked += open.queries().len();
        } else if !is_tried {
            worth.touches.skip();
        }
        let left = decide_thick::<K>(open, source, has_touches, hit, observe);
        worth.touches.left(left);
    }
    open.clear();
}

/// Decides what is open, without a radius; and says of how many no time is known.
fn decide_thin<K: Stages>(
    open: &Open,
    hit: &mut impl FnMut(usize, Hit<K::Place>),
    observe: &mut impl FnMut(Stage),
) -> usize {
    let mut left = 0;
    for (place, &query) in open.queries().iter().enumerate() {
        let positions = open.positions(place);
        let cubic = |motion: &_| open.cubic(place, motion);
        let time = open.crossing_time(place);
        left += usize::from(time == Some(0.0));
        if let Some(found) = decide_rest::<K>(&positions, cubic, time, observe) {
            hit(query, found);
        }
    }
    left
}

/// The same with a radius; and says how many contacts are asked for and not certain.
fn decide_thick<K: Stages>(
    open: &Open,
    source: &impl Source,
    has_touches: bool,
    hit: &mut impl FnMut(usize, Hit<K::Place>),
    observe: &mut impl FnMut(Stage),
) -> usize {
    let mut left = 0;
    for (place, &query) in open.queries().iter().enumerate() {
        let touch = if has_touches {
            open.touch::<K>(place)
        } else {
            Err(open.reached(place))
        };
        let found = match touch {
            Ok(hit) => {
                observe(Stage::Planes);
                Some(hit)
            }
            Err(reached) => {
                left += usize::from(has_touches);
                let (positions, radius) = (open.positions(place), source.radius(query));
                if radius.is_zero() {
                    decide_rest::<K>(&positions, Cubic::new, None, observe)
                } else {
                    thick::decide_from::<K>(&positions, radius, reached, observe)
                }
            }
        };
        if let Some(found) = found {
            hit(query, found);
        }
    }
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
        if source.are_thin(all.clone()) {
            self.open.add::<K::Stages, _>(source, all, &mut |_| {});
            self.open.screen::<K::Stages>(&mut |_| {});
        } else {
            self.open.add_thick::<K::Stages>(source, all, &mut |_| {});
            self.open.screen_thick::<K::Stages>(&mut |_| {});
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
