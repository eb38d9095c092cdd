//! A search for the queries that cost most: on which a subject stalls a frame.
//!
//! Several climbs go on side by side. Each begins at the costliest of some queries of families, changes
//! a few numbers of its query at a time (`change`), and keeps what costs more. A climb that gets no further
//! makes room for a new one. [`Search`] knows nothing of what is counted: a function says what a query
//! costs. [`time`] measures what a subject takes.

use std::cmp::Ordering;
use std::time::{Duration, Instant};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tunnelproof::query::Query;

use crate::generate::{Family, stream};
use crate::shape::Shape;
use crate::subject::{LapseKind, NoAnswer, Subject};

mod change;

#[cfg(test)]
mod tests;

/// So many queries are drawn for the start of a climb.
const DRAWN: u32 = 64;

/// After so many changes in a row that cost no more, a climb ends.
const PATIENCE: u32 = 2000;

/// How often what seems to cost more is asked again.
const REPEATS: u32 = 3;

/// A query and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Costly<C> {
    /// The query.
    pub query: Query,
    /// What it costs.
    pub cost: C,
}

/// A search for the queries that cost most.
pub struct Search<'a, C, F> {
    families: &'a [&'static Family],
    cost: F,
    rng: ChaCha8Rng,
    climbs: Vec<Climb<C>>,
    /// Which climb takes the next turn.
    next: usize,
    /// Where the climbs that have ended came to, the costliest first, no more than there are climbs.
    found: Vec<Costly<C>>,
    asked: u64,
}

struct Climb<C> {
    /// `None` as long as no query was asked.
    best: Option<Costly<C>>,
    /// Queries of families that were tried.
    drawn: u32,
    /// Changes since it got further.
    in_vain: u32,
}

impl<C> Climb<C> {
    const NEW: Self = Climb {
        best: None,
        drawn: 0,
        in_vain: 0,
    };
}

impl<'a, C: Copy + PartialOrd, F: FnMut(&Query) -> Option<C>> Search<'a, C, F> {
    /// A search of so many climbs, each of which ends at one query. `cost` is what a query costs, or
    /// `None` for one that is not asked; where it is a measurement, it may say less when it is asked
    /// again, and the least counts.
    pub fn new(families: &'a [&'static Family], seed: u64, climbs: usize, cost: F) -> Self {
        Search {
            families,
            cost,
            rng: stream("slowest", seed, 0),
            climbs: (0..climbs).map(|_| Climb::NEW).collect(),
            next: 0,
            found: Vec::new(),
            asked: 0,
        }
    }

    /// Tries one query; the climbs take turns.
    pub fn turn(&mut self) {
        let count = self.climbs.len();
        let Some(climb) = self.climbs.get_mut(self.next) else {
            return;
        };
        self.next = (self.next + 1) % count;
        let candidate = match climb.best {
            Some(best) if climb.drawn == DRAWN => {
                climb.in_vain += 1;
                let mut shape = Shape::new(&best.query);
                for _ in 0..self.rng.random_range(1..=3) {
                    change::change(&mut shape, &mut self.rng);
                }
                shape.query()
            }
            _ => {
                climb.drawn += 1;
                let which = self.rng.random_range(0..self.families.len());
                Some(self.families[which].draw(&mut self.rng))
            }
        };
        if let Some(query) = candidate {
            self.asked += 1;
            let than = climb.best.map(|best| best.cost);
            if let Some(cost) = cost_above(&mut self.cost, &query, than) {
                climb.best = Some(Costly { query, cost });
                climb.in_vain = 0;
            }
        }
        if climb.drawn == DRAWN && (climb.best.is_none() || climb.in_vain == PATIENCE) {
            let ended = std::mem::replace(climb, Climb::NEW);
            self.found.extend(ended.best);
            self.rank();
        }
    }

    fn rank(&mut self) {
        let order = |a: &Costly<C>, b: &Costly<C>| b.cost.partial_cmp(&a.cost);
        self.found
            .sort_by(|a, b| order(a, b).unwrap_or(Ordering::Equal));
        self.found.truncate(self.climbs.len());
    }

    /// How many queries were tried.
    pub fn asked(&self) -> u64 {
        self.asked
    }

    /// The costliest queries found, at most one of each climb, the costliest first; no more than there
    /// are climbs.
    pub fn costliest(mut self) -> Vec<Costly<C>> {
        let ends = self.climbs.iter().filter_map(|climb| climb.best);
        self.found.extend(ends);
        self.rank();
        self.found
    }
}

/// What a query costs, if that is above another cost, each time it is asked.
fn cost_above<C: Copy + PartialOrd>(
    mut cost: impl FnMut(&Query) -> Option<C>,
    query: &Query,
    than: Option<C>,
) -> Option<C> {
    let mut least = cost(query)?;
    for _ in 0..REPEATS {
        if than.is_some_and(|than| least <= than) {
            return None;
        }
        let again = cost(query)?;
        if again < least {
            least = again;
        }
    }
    than.is_none_or(|than| least > than).then_some(least)
}

/// How long a subject takes for its answer, or is waited for.
///
/// # Errors
///
/// [`NoAnswer`] for a query that it does not take or fails on in another way: a program that crashes
/// is started again, which is no time of its own.
pub fn time(subject: &dyn Subject, query: &Query) -> Result<Duration, NoAnswer> {
    let start = Instant::now();
    let answer = subject.answers(std::slice::from_ref(query)).pop();
    let time = start.elapsed();
    match answer {
        Some(Err(NoAnswer::Lapse(lapse))) if lapse.kind != LapseKind::Hung => Err(lapse.into()),
        Some(Err(NoAnswer::Unsupported(reason))) => Err(reason.into()),
        _ => Ok(time),
    }
}
