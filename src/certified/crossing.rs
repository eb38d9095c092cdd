//! Stage 4 as far as it goes without a branch: a miss at the only root in each half of the step, or
//! the first root at which there may be contact, and its time.
//!
//! Queries are asked one by one or several at once, with the same answers in every bit.

use super::cubic::Cubic;
use super::ends::Ends;
use super::kind::Stages;
use super::motion::Motion;
use super::root::{Bracket, Half};
use super::stage::Finding;
use crate::contact::Hit;

/// Whether the two certainly do not touch at the only root in each half.
#[inline(always)]
pub(super) fn are_apart<K: Stages, E: Ends>(motion: &Motion<E>, cubic: &Cubic) -> bool {
    let [lower, upper] = cubic.halves();
    K::is_apart_in(motion, cubic, &lower) & K::is_apart_in(motion, cubic, &upper)
}

/// Whether the two certainly touch at no root, and whether they certainly do, strictly inside, at the
/// first one that is not ruled out: a simple one, at which they pass each other.
#[inline(always)]
pub(super) fn cross<K: Stages, E: Ends>(motion: &Motion<E>, cubic: &Cubic) -> [bool; 2] {
    let (first, are_apart) = first_root::<K, E>(motion, cubic);
    let is_valid = cubic.is_valid() & cubic.has_certain_ends();
    let touch = first.has_one & K::touch_at(motion, cubic, &first.bracket);
    [cubic.is_valid() & are_apart, is_valid & touch]
}

/// The first root at which the two are not certain to be apart, and whether they are at all.
#[inline(always)]
fn first_root<K: Stages, E: Ends>(motion: &Motion<E>, cubic: &Cubic) -> (Half, bool) {
    let [lower, upper] = cubic.halves();
    let is_upper = K::is_apart_in(motion, cubic, &lower);
    let of = |lower, upper| if is_upper { upper } else { lower };
    let is = |lower: bool, upper: bool| (is_upper & upper) | (!is_upper & lower);
    let bracket = Bracket {
        low: of(lower.bracket.low, upper.bracket.low),
        high: of(lower.bracket.high, upper.bracket.high),
        is_rising: is(lower.bracket.is_rising, upper.bracket.is_rising),
    };
    let first = Half {
        bracket,
        has_none: is(lower.has_none, upper.has_none),
        has_one: is(lower.has_one, upper.has_one),
    };
    let are_apart = is_upper & K::is_apart_in(motion, cubic, &upper);
    (first, are_apart)
}

/// The time, rounded down, of the first root at which the two are not certain to be apart, if they
/// certainly touch at it, strictly inside: with its sign where `f` rises there, with the other one
/// where it falls; 0 if that is not certain.
#[inline(always)]
pub(super) fn time<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    motion: &Motion<E>,
    cubic: &Cubic,
) -> f64 {
    let (first, _) = first_root::<K, E>(motion, cubic);
    let bracket = first.bracket;
    let (toi, is_certain) = K::time_at(points, cubic, &bracket);
    let signed = if bracket.is_rising { toi } else { -toi };
    let is_first = first.has_one & cubic.has_certain_ends();
    if is_first & K::touch_at(motion, cubic, &bracket) & is_certain {
        signed
    } else {
        0.0
    }
}

/// The same as [`are_apart`] and [`time`] say, with branches: what is not looked at costs nothing.
#[inline(always)]
pub(super) fn decide<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Finding<Hit<K::Place>> {
    if !cubic.has_certain_ends() {
        return Finding::Undecided;
    }
    let Some(half) = cubic.first_half(|half| K::is_apart_in(motion, cubic, half)) else {
        return Finding::Miss;
    };
    if !(half.has_one && K::touch_at(motion, cubic, &half.bracket)) {
        return Finding::Undecided;
    }
    let (toi, is_certain) = K::time_at(points, cubic, &half.bracket);
    let hit = || K::crossing_at(motion, cubic, &half.bracket.from(toi));
    Finding::of_certain(is_certain.then(hit).flatten())
}

/// The contact at such a time, if its place is precise enough.
#[inline(always)]
pub(super) fn at<K: Stages, E: Ends>(
    time: f64,
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Option<Hit<K::Place>> {
    let root = Bracket {
        low: time.abs(),
        high: time.abs().next_up(),
        is_rising: time > 0.0,
    };
    let hit = || K::crossing_at(motion, cubic, &root);
    (time != 0.0).then(hit).flatten()
}
