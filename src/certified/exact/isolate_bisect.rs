//! The roots of a cubic parted by halving, exactly and with numbers of fixed width.
//!
//! As in [`super::isolate_f64`], a piece whose Bernstein coefficients change their sign once has
//! one root, a simple one. The sign changes of both halves together are not more than those of the
//! whole, so that only one half at a time can still have more than one.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::isolate_f64::{Interval, grid_time};
use super::motion::Cubic;
use super::width::{DOUBLINGS, Number, Width};

/// How often the step is halved at most: enough for roots that are as near as neighbours in `f64`.
/// Without divisions, each halving multiplies by 8.
const DEPTH: u32 = 64;
const _: () = assert!(3 * DEPTH <= DOUBLINGS);

/// Bernstein coefficients of a cubic on an interval, times a power of two.
type Bernstein<L> = [<L as Width>::CubicValue; 4];

/// Intervals around each of the roots in `(0, 1)`, which are simple, in ascending order; `None`
/// where they are too near each other, or one of them is where the interval was halved.
pub(super) fn isolate_bisect<L: Width>(c: &Cubic<L>) -> Option<SmallVec<[Interval; 3]>> {
    let [c0, c1, c2, c3] = c.each_ref().map(L::widened);
    // 3 c0, 3 c0 + c1, 3 c0 + 2 c1 + c2, 3 (c0 + c1 + c2 + c3)
    let thrice = |x: &L::CubicValue| x.add(x).add(x);
    let second = thrice(&c0).add(&c1);
    let third = second.add(&c1).add(&c2);
    let last = thrice(&c0.add(&c1).add(&c2).add(&c3));
    let mut piece: Bernstein<L> = [thrice(&c0), second, third, last];
    let mut found: SmallVec<[Interval; 3]> = SmallVec::new();
    let mut index = 0;
    // Ends: after so many halvings.
    for depth in 1..=DEPTH {
        let (left, right) = halves::<L>(&piece);
        if right[0].is_zero() {
            return None;
        }
        let mut open = None;
        for (half, index) in [(left, 2 * index), (right, 2 * index + 1)] {
            match changes::<L>(&half) {
                0 => {}
                1 => found.push((grid_time(index, depth), grid_time(index + 1, depth))),
                _ => open = Some((half, index)),
            }
        }
        let Some(next) = open else {
            found.sort_by_key(|(low, _)| *low);
            return Some(found);
        };
        (piece, index) = next;
    }
    None
}

/// The number of sign changes, zeros left out.
fn changes<L: Width>(piece: &Bernstein<L>) -> usize {
    let signs = piece.each_ref().map(Number::sign);
    let mut last = Ordering::Equal;
    let mut count = 0;
    for sign in signs.into_iter().filter(|sign| sign.is_ne()) {
        count += usize::from(last == sign.reverse());
        last = sign;
    }
    count
}

/// Both halves, times 8, by de Casteljau's algorithm.
fn halves<L: Width>([b0, b1, b2, b3]: &Bernstein<L>) -> (Bernstein<L>, Bernstein<L>) {
    let twice = |x: &L::CubicValue| x.add(x);
    let [first, second, third] = [b0.add(b1), b1.add(b2), b2.add(b3)];
    let (left, right) = (first.add(&second), second.add(&third));
    let centre = left.add(&right);
    (
        [
            twice(&twice(&twice(b0))),
            twice(&twice(&first)),
            twice(&left),
            centre.clone(),
        ],
        [
            centre,
            twice(&right),
            twice(&twice(&third)),
            twice(&twice(&twice(b3))),
        ],
    )
}

#[cfg(test)]
mod tests;
