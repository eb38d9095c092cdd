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
