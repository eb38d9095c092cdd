//! The roots of a polynomial of any small degree, each by itself in an interval.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::{Poly, Time};
use crate::certified::exact::bernstein::{Piece, bernstein};
use crate::certified::exact::bracket::Bracket;
use crate::certified::exact::dyadic::Dyadic;
use crate::certified::exact::integer::Integer;
use crate::certified::exact::modular::are_coprime;
use crate::certified::exact::remainders::Remainders;

/// How often the step is halved before multiple roots are made simple: these never part.
const FEW_HALVINGS: u64 = 20;

/// The distinct roots in `(0, 1]`, in ascending order; none of the polynomial that is 0.
pub(in crate::certified::exact) struct Roots {
    /// A polynomial with these roots.
    poly: Poly,
    cells: SmallVec<[Cell; 2]>,
}

/// Where a root is.
enum Cell {
    /// It is this number.
    At(Dyadic),
    /// It is the only root strictly between these numbers, and a simple one.
    Between {
        low: Dyadic,
        high: Dyadic,
        /// The sign of the polynomial before the root.
        before: Ordering,
    },
}

impl Roots {
    pub(in crate::certified::exact) fn new(poly: Poly) -> Self {
        if poly.is_zero() {
            let cells = SmallVec::new();
            return Roots { poly, cells };
        }
        if let Some(cells) = isolate(&poly, FEW_HALVINGS) {
            return Roots { poly, cells };
        }
        // Now they part in the end (two circles theorem), if not by then.
        let poly = square_free(poly);
        let cells = isolate(&poly, u64::MAX).unwrap_or_default();
        Roots { poly, cells }
    }

    /// The roots, each with its neighbours in `f64`.
    pub(in crate::certified::exact) fn times(&self) -> impl Iterator<Item = (Time<'_>, [f64; 2])> {
        self.cells.iter().map(|cell| match cell {
            Cell::At(at) => (Time::At(at.clone()), [at.below(), at.above()]),
            Cell::Between { low, high, before } => {
                let bracket = Bracket::new(&self.poly, low.clone(), high.clone(), *before);
                Time::settled(bracket)
            }
        })
    }
}

/// Halves the step until every part has one root or none; `None` if that takes more than so many
/// halvings of a part. Not by recursion: with a radius of 1e-161 two roots are as near as that.
fn isolate(poly: &Poly, halvings: u64) -> Option<SmallVec<[Cell; 2]>> {
    let bernstein = bernstein(poly);
    let mut derivative = None;
    let mut cells = SmallVec::new();
    // What is still to be looked at, the last one first.
    let mut parts = vec![Part::Open(Piece::unit(&bernstein))];
    // Ends: a piece is halved at most so many times; without a limit the polynomial is square-free,
    // so that its roots part (two circles theorem). All of it in integers.
    while let Some(part) = parts.pop() {
        match part {
            Part::Root(at) => cells.push(Cell::At(at)),
            Part::Open(piece) => match piece.changes() {
                0 => {}
                1 => {
                    let (low, high) = piece.ends();
                    let before = piece.first_sign();
                    cells.push(Cell::Between { low, high, before });
                }
                _ if piece.depth() == halvings => return None,
                2 if piece.depth() >= FEW_HALVINGS && piece.turns() == 1 => {
                    cells.extend(two_or_none(
                        poly,
                        derivative.get_or_insert_with(|| poly.derivative()),
                        &piece,
                    ));
                }
                _ => {
                    let (left, right) = piece.halves();
                    let middle = right.starts_at_root().then(|| Part::Root(right.low()));
                    parts.push(Part::Open(right));
                    parts.extend(middle);
                    parts.push(Part::Open(left));
                }
            },
        }
    }
    if bernstein.last().is_some_and(Integer::is_zero) {
        cells.push(Cell::At(Dyadic::one()));
    }
    Some(cells)
}

/// The roots in a piece that has two or none, and in which the derivative has one root.
///
/// If there are two, that root is between them, and the polynomial has the other sign there; if
/// not, it has one sign in the whole piece. Its root and that of the derivative are not the same,
/// so that narrowing to the latter, which takes few steps however near the two roots are, tells in
/// the end.
fn two_or_none(poly: &Poly, derivative: &Poly, piece: &Piece) -> SmallVec<[Cell; 2]> {
    let (low, high) = piece.ends();
    let sign = piece.first_sign();
    let between = |low: &Dyadic, high: &Dyadic, before| Cell::Between {
        low: low.clone(),
        high: high.clone(),
        before,
    };
    let mut turn = Bracket::new(derivative, low.clone(), high.clone(), sign.reverse());
    // Ends: as said above; integers alone decide that the derivative has one root here, and each
    // turn narrows its bracket.
    loop {
        let met = turn.refine();
        let ends = match &met {
            Some(at) => [at, at],
            None => turn.ends(),
        };
        for (at, is_before) in ends.into_iter().zip([true, false]) {
            if at.compare(&low).is_le() || at.compare(&high).is_ge() {
                continue;
            }
            let here = poly.sign_at(at);
            if here == sign.reverse() {
                return [between(&low, at, sign), between(at, &high, here)].into();
            }
            if here.is_eq() {
                let root = Cell::At(at.clone());
                return match is_before {
                    true => [root, between(at, &high, sign.reverse())].into(),
                    false => [between(&low, at, sign), root].into(),
                };
            }
        }
        if met.is_some() || turn.plain_sign_of(poly).is_some() {
            return SmallVec::new();
        }
    }
}

/// A part of the step.
enum Part {
    /// This time, which is a root.
    Root(Dyadic),
    /// An interval without its ends.
    Open(Piece),
}

/// The polynomial divided by its greatest common divisor with its derivative.
fn square_free(poly: Poly) -> Poly {
    let derivative = poly.derivative();
    if are_coprime(&poly, &derivative) {
        return poly;
    }
    match Remainders::new(poly.clone(), derivative).last() {
        Some(divisor) if divisor.degree() > 0 => poly.quotient(&divisor),
        _ => poly,
    }
}

#[cfg(test)]
mod tests;
