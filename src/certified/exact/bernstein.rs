//! A polynomial on a part of the step, in Bernstein form: Descartes' rule of signs, and halving.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::dyadic::Dyadic;
use super::integer::Integer;
use super::poly::Poly;

/// Positive multiples of the Bernstein coefficients on `[0, 1]`, one more than the degree.
///
/// With `n` the degree, `b_j` is the sum of `C(j, i) / C(n, i) c_i`; times `n!`, the factor of
/// `c_i` is `C(j, i) i! (n - i)! = j! / (j - i)! (n - i)!`.
pub(super) fn bernstein<const N: usize>(poly: &Poly<N>) -> SmallVec<[Integer; 4]> {
    let n = poly.degree();
    let product = |from: usize, to: usize| (from as i64 + 1..=to as i64).product::<i64>();
    let coefficient = |j: usize| {
        let mut sum = Integer::default();
        for (i, c) in poly.coefficients().iter().enumerate().take(j + 1) {
            sum.add_shifted(&c.times(product(j - i, j) * product(0, n - i)), 0);
        }
        sum
    };
    (0..=n).map(coefficient).collect()
}

/// The first sign that is not 0.
pub(super) fn first_sign<'a>(mut coefficients: impl Iterator<Item = &'a Integer>) -> Ordering {
    coefficients
        .find(|c| !c.is_zero())
        .map_or(Ordering::Equal, Integer::sign)
}

/// The number of sign changes, zeros left out.
pub(super) fn changes(coefficients: &[Integer]) -> usize {
    let mut last = Ordering::Equal;
    let mut count = 0;
    for sign in coefficients
        .iter()
        .map(Integer::sign)
        .filter(|sign| sign.is_ne())
    {
        count += usize::from(sign == last.reverse() && last.is_ne());
        last = sign;
    }
    count
}

/// The last digits of an index where as many halvings went to the end: so many have to go the same
/// way before more of them are taken at once.
const ZOOM_DIGITS: u64 = u64::MAX;

/// A polynomial on the interval from `index / 2^depth` to `(index + 1) / 2^depth`.
pub(super) struct Piece {
    /// Positive multiples of the Bernstein coefficients there.
    coefficients: SmallVec<[Integer; 4]>,
    index: Integer,
    depth: u64,
}

impl Piece {
    /// The whole from 0 to 1.
    pub(super) fn unit(bernstein: &[Integer]) -> Self {
        Piece {
            coefficients: bernstein.iter().cloned().collect(),
            index: Integer::default(),
            depth: 0,
        }
    }

    /// The number of sign changes, which bounds that of the roots inside.
    pub(super) fn changes(&self) -> usize {
        changes(&self.coefficients)
    }

    /// The number of sign changes of its derivative.
    pub(super) fn turns(&self) -> usize {
        let pairs = self.coefficients.windows(2);
        let slopes: SmallVec<[Integer; 4]> = pairs
            .map(|pair| Integer::difference(&pair[1], &pair[0]))
            .collect();
        changes(&slopes)
    }

    /// Whether the polynomial is 0 where it starts.
    pub(super) fn starts_at_root(&self) -> bool {
        self.coefficients[0].is_zero()
    }

    /// The sign of the polynomial just after it starts.
    pub(super) fn first_sign(&self) -> Ordering {
        first_sign(self.coefficients.iter())
    }

    /// How often the whole was halved.
    pub(super) fn depth(&self) -> u64 {
        self.depth
    }

    /// Where it starts.
    pub(super) fn low(&self) -> Dyadic {
        Dyadic::new(self.index.clone(), self.depth)
    }

    /// Where it starts and ends.
    pub(super) fn ends(&self) -> (Dyadic, Dyadic) {
        let next = Integer::sum(&self.index, &Integer::from(1));
        (self.low(), Dyadic::new(next, self.depth))
    }

    /// Becomes the smallest part at its start or its end that comes of halving and has as many sign
    /// changes: the rest has none, and no root where the two meet. Looked for where the last
    /// halvings all went the same way.
    pub(super) fn zoom(&mut self) {
        let (digits, _) = self.index.window(0);
        let is_at_end = digits == ZOOM_DIGITS;
        if self.depth < 64 || digits != 0 && !is_at_end {
            return;
        }
        let changes = self.changes();
        let part = |halvings: u64| {
            let part = self.part(halvings, is_at_end);
            (part.changes() == changes).then_some(part)
        };
        // The bits of the number of halvings, from the highest one on.
        let (mut step, mut zoomed, mut count) = (1, None, 0);
        // Ends: the changes are those of a root inside, which is in no part that is small enough.
        while let Some(found) = part(2 * step) {
            (step, count, zoomed) = (2 * step, 2 * step, Some(found));
        }
        // Ends: the step is halved.
        while step > 1 {
            step /= 2;
            if let Some(found) = part(count + step) {
                (count, zoomed) = (count + step, Some(found));
            }
        }
        if let Some(part) = zoomed {
            *self = *part;
        }
    }

    /// The first or the last `2^-halvings` of it, by de Casteljau's algorithm, times a power of two.
    /// On the heap, as this is for numbers that are long.
    #[inline(never)]
    fn part(&self, halvings: u64, is_at_end: bool) -> Box<Piece> {
        let degree = self.coefficients.len() - 1;
        let mut row = self.coefficients.to_vec();
        let mut part = SmallVec::new();
        for i in 0..=degree {
            let kept = if is_at_end { degree - i } else { 0 };
            part.push(row[kept].shifted(halvings * (degree - i) as u64));
            for j in 0..degree - i {
                // (2^halvings - 1) times the nearer one, and the other one.
                let (own, next) = row.split_at_mut(j + 1);
                let [near, other] = if is_at_end {
                    [&next[0], &own[j]]
                } else {
                    [&own[j], &next[0]]
                };
                let mut sum = near.shifted(halvings);
                sum.sub_shifted(near, 0);
                sum.add_shifted(other, 0);
                own[j] = sum;
            }
        }
        let mut index = self.index.clone();
        if is_at_end {
            part.reverse();
            index.add_shifted(&Integer::from(1), 0);
        }
        index = index.shifted(halvings);
        if is_at_end {
            index.sub_shifted(&Integer::from(1), 0);
        }
        Box::new(Piece {
            coefficients: part,
            index,
            depth: self.depth + halvings,
        })
    }

    /// Both halves, by de Casteljau's algorithm without its divisions: row `i` is `2^i` times too
    /// large, and what is kept of it is multiplied to the scale of the last row.
    pub(super) fn halves(&self) -> (Piece, Piece) {
        let degree = self.coefficients.len() - 1;
        let mut row = self.coefficients.clone();
        let mut left = SmallVec::new();
        let mut right = SmallVec::new();
        for i in 0..=degree {
            let missing = (degree - i) as u64;
            left.push(row[0].shifted(missing));
            right.push(row[degree - i].shifted(missing));
            for j in 0..degree - i {
                let (own, next) = row.split_at_mut(j + 1);
                own[j].add_shifted(&next[0], 0);
            }
        }
        right.reverse();
        let half = |coefficients, offset: i128| {
            let mut index = self.index.shifted(1);
            index.add_shifted(&Integer::from(offset), 0);
            Piece {
                coefficients,
                index,
                depth: self.depth + 1,
            }
        };
        (half(left, 0), half(right, 1))
    }
}
