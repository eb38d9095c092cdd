//! Where two edges are nearest while they are parallel, or one of them is a point, in words.
//!
//! That is what `f64` cannot tell of a contact: whether `K x L` is 0, and which ends are beside the
//! other edge. The general stage has polynomials of any degree for it; the answer is the same. Here
//! everything is a scalar product of `K`, `L` and `M`, of degree 2 in time, with integers of 128
//! bits as coefficients: exact at the start, and with an error bound later, where edges that are
//! parallel for the whole step touch.
//!
//! Components are below `2^60` in magnitude, and so are their changes: a product of two vectors is
//! below `2^122`, a coefficient below `2^123`, a sum of two of these below `2^124`, and one of three
//! below `2^125`.

use std::cmp::Ordering;

use super::super::PLACE_ERROR;
use super::super::passage::{Passage, passage_of_edges};
use super::super::scaled::Scaled;
use super::Approach;
use crate::certified::motion::Positions;
use crate::certified::separate::U;
use crate::contact::{self, EdgePlace, EdgePoint, Flags, Hit};

/// The largest number of bits of a component.
const MOST_BITS: u32 = 60;

type Vector = [i128; 3];

/// `K`, `L` and `M` at the start, and their changes.
struct Words {
    k: [Vector; 2],
    l: [Vector; 2],
    m: [Vector; 2],
}

impl Words {
    /// `None` for coordinates that are too far apart in magnitude.
    fn new(positions: &Positions) -> Option<Self> {
        let Scaled::Short { values, bits } = Scaled::new(positions) else {
            return None;
        };
        let vector = |from: usize| [0, 1, 2].map(|axis: usize| i128::from(values[from + axis]));
        let [k, l, m] = [0, 6, 12].map(|from| [vector(from), vector(from + 3)]);
        (bits <= MOST_BITS).then_some(Words { k, l, m })
    }

    /// Whether `K x L` is 0 for the whole step.
    fn is_normal_always_zero(&self) -> bool {
        let ([k, k_change], [l, l_change]) = (&self.k, &self.l);
        let (first, second) = (cross(k, l_change), cross(k_change, l));
        let middle = [0, 1, 2].map(|axis: usize| first[axis] + second[axis]);
        [cross(k, l), middle, cross(k_change, l_change)]
            .iter()
            .all(is_zero)
    }
}

/// Whether `K x L` is certainly 0 for the whole step.
pub(in crate::certified) fn are_always_parallel(positions: &Positions) -> bool {
    Words::new(positions).is_some_and(|words| words.is_normal_always_zero())
}

/// The contact of two edges that are within the radius of each other at the start, where they are
/// parallel or one is a point; `None` if that is not so, or they do not fit into words.
pub(in crate::certified) fn near_start_of_parallel_edges(
    positions: &Positions,
) -> Option<Hit<EdgePlace>> {
    let words = Words::new(positions)?;
    let ([k, k_change], [l, l_change]) = (&words.k, &words.l);
    let time = Time::Start;
    let along = Along::new(&words);
    let (place, _) = match (is_zero(k), is_zero(l)) {
        (true, true) => (([0.0, 0.0], None), 0.0),
        (true, false) => {
            let (v, error) = along.ml.negative().share_of(along.ll, time)?;
            (([0.0, v], None), error)
        }
        (false, true) => {
            let (u, error) = along.mk.share_of(along.kk, time)?;
            (([u, 0.0], None), error)
        }
        (false, false) if is_zero(&cross(k, l)) => along.nearest(time)?,
        _ => return None,
    };
    let is_some_point = is_zero(k) || is_zero(l);
    let flags = Flags {
        temporarily_parallel: !is_some_point && !words.is_normal_always_zero(),
        temporarily_point: is_zero(k) && !is_zero(k_change) || is_zero(l) && !is_zero(l_change),
    };
    Some(hit(positions, [0.0; 2], place, PLACE_ERROR, flags))
}

/// The contact of two edges that are always parallel at a time of impact above 0, of which the
/// neighbours in `f64` are given; `None` if the place is not certain.
pub(in crate::certified) fn contact_of_parallel_edges(
    positions: &Positions,
    toi: [f64; 2],
) -> Option<Hit<EdgePlace>> {
    let words = Words::new(positions).filter(Words::is_normal_always_zero)?;
    let (place, error) = Along::new(&words).nearest(Time::After(toi[0]))?;
    (error < contact::PLACE_ERROR).then(|| {
        hit(
            positions,
            toi,
            place,
            error.max(PLACE_ERROR),
            Flags::default(),
        )
    })
}

type Place = ([f64; 2], Option<[f64; 2]>);

/// Without a side: `f` is 0 for the whole step, or the contact is at the start.
fn hit(
    positions: &Positions,
    toi: [f64; 2],
    (first, second): Place,
    error: f64,
    flags: Flags,
) -> Hit<EdgePlace> {
    let passage: Passage = passage_of_edges(positions);
    let point = |[u, v]: [f64; 2]| EdgePoint { u, v };
    let place = EdgePlace {
        first: point(first),
        second: second.map(point),
        error,
    };
    let approach = Approach {
        toi,
        side: 0,
        first,
        second,
        flags,
    };
    approach.hit(passage, place)
}

/// A time.
#[derive(Clone, Copy)]
enum Time {
    /// 0.
    Start,
    /// In `[0, 1]`, this `f64` or between it and the next one.
    After(f64),
}

/// A polynomial of degree 2 in time.
#[derive(Clone, Copy, Debug)]
struct Quadratic([i128; 3]);

impl Quadratic {
    /// The scalar product of two vectors that move.
    fn dot([x, x_change]: &[Vector; 2], [y, y_change]: &[Vector; 2]) -> Self {
        Quadratic([
            dot(x, y),
            dot(x, y_change) + dot(x_change, y),
            dot(x_change, y_change),
        ])
    }

    fn negative(self) -> Self {
        Quadratic(self.0.map(|x| -x))
    }

    fn plus(self, other: Self) -> Self {
        Quadratic([0, 1, 2].map(|i: usize| self.0[i] + other.0[i]))
    }

    /// The value at a time after the start, and a bound on its error.
    ///
    /// Error bound: with `s` the sum of the magnitudes of the coefficients, each is rounded once, two
    /// products and two sums are rounded: `5 u s`. The time is within `2 u`, and the slope is at most
    /// `2 s`: `4 u s`. Nothing under- or overflows.
    fn at(self, time: f64) -> (f64, f64) {
        let [a, b, c] = self.0.map(|x| x as f64);
        let size = a.abs() + b.abs() + c.abs();
        (a + time * (b + time * c), 10.0 * U * size)
    }

    /// The sign at a time, if it is certain.
    fn sign_at(self, time: Time) -> Option<Ordering> {
        match time {
            Time::After(time) if self.0 != [0; 3] => {
                let (value, error) = self.at(time);
                (value.abs() > error).then(|| value.total_cmp(&0.0))
            }
            _ => Some(self.0[0].cmp(&0)),
        }
    }

    /// What part of a whole it is at a time, as far as that is in `[0, 1]`, and a bound on the
    /// error.
    ///
    /// Error bound: let `p` and `q` be off by less than `e` and `d`. Where the exact share `x` is in
    /// `[0, 1]`, the quotient is off by `(p - p' + x (q' - q)) / q`, less than `(e + d) / q`; where it
    /// is above 1, `p > q - d - e`, and where it is below 0, `p < e`: after the clamp no more is
    /// missing. `q` is above the least one that is taken. A quarter more is for the roundings of the bound, and
    /// `8 u` for that of the quotient. Three roundings at the start.
    fn share_of(self, whole: Self, time: Time) -> Option<(f64, f64)> {
        match time {
            Time::Start => {
                let part = self.0[0].clamp(0, whole.0[0]);
                Some((part as f64 / whole.0[0] as f64, PLACE_ERROR))
            }
            Time::After(time) => {
                let ((part, part_error), (whole, whole_error)) = (self.at(time), whole.at(time));
                let least = whole - 2.0 * whole_error;
                let error = (part_error + whole_error) / least + 8.0 * U;
                (least > 0.0).then(|| ((part / whole).clamp(0.0, 1.0), 1.25 * error))
            }
        }
    }
}

/// Two parallel edges along `K`, on which A is at 0, B at `K . K`, C at `M . K` and D at
/// `(M + L) . K`; and along `L`.
struct Along {
    kk: Quadratic,
    ll: Quadratic,
    kl: Quadratic,
    mk: Quadratic,
    ml: Quadratic,
}

impl Along {
    fn new(Words { k, l, m }: &Words) -> Self {
        Along {
            kk: Quadratic::dot(k, k),
            ll: Quadratic::dot(l, l),
            kl: Quadratic::dot(k, l),
            mk: Quadratic::dot(m, k),
            ml: Quadratic::dot(m, l),
        }
    }

    /// Both ends of the part along which they are nearest, or the only place, of two that are
    /// parallel at a time; and a bound on the error. `None` if an edge may be a point.
    fn nearest(&self, time: Time) -> Option<(Place, f64)> {
        let (to_c, to_d) = (self.mk, self.mk.plus(self.kl));
        let (low, high, v_low, v_high) = match self.kl.sign_at(time)? {
            Ordering::Greater => (to_c, to_d, 0.0, 1.0),
            Ordering::Less => (to_d, to_c, 1.0, 0.0),
            Ordering::Equal => return None,
        };
        let to_b = |at: Quadratic| at.negative().plus(self.kk).sign_at(time);
        let (low_to_b, high_to_a) = (to_b(low)?, high.sign_at(time)?);
        if low_to_b.is_lt() {
            return Some((([1.0, v_low], None), 0.0));
        }
        if high_to_a.is_lt() {
            return Some((([0.0, v_high], None), 0.0));
        }
        let on_cd = |at: Quadratic| at.share_of(self.ll, time);
        let on_ab = |at: Quadratic| at.share_of(self.kk, time);
        let to_a = self.ml.negative();
        let (first, first_error) = match low.sign_at(time)?.is_le() {
            true => on_cd(to_a).map(|(v, error)| ([0.0, v], error))?,
            false => on_ab(low).map(|(u, error)| ([u, v_low], error))?,
        };
        let (second, second_error) = match to_b(high)?.is_le() {
            true => on_cd(to_a.plus(self.kl)).map(|(v, error)| ([1.0, v], error))?,
            false => on_ab(high).map(|(u, error)| ([u, v_high], error))?,
        };
        let is_more = low_to_b.is_gt() && high_to_a.is_gt();
        let place = (first, is_more.then_some(second));
        Some((place, first_error.max(second_error)))
    }
}

fn cross(x: &Vector, y: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j): (usize, usize)| x[i] * y[j] - x[j] * y[i])
}

fn dot(x: &Vector, y: &Vector) -> i128 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

fn is_zero(x: &Vector) -> bool {
    *x == [0; 3]
}

#[cfg(test)]
mod tests;
