//! The roots of a polynomial of any small degree, each by itself in an interval.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::{Poly, Time};
use crate::certified::exact::bernstein::{Piece, bernstein};
use crate::certified::exact::bracket::Bracket;
use crate::certified::exact::common_factor::square_free;
use crate::certified::exact::dyadic::Dyadic;
use crate::certified::exact::integer::Integer;
use crate::certified::exact::two_roots::{Found, two_or_none};

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
            Part::Found(cell) => cells.push(cell),
            Part::Open(piece) => match piece.changes() {
                0 => {}
                1 => cells.push(Cell::between(&piece)),
                _ if piece.depth() >= halvings => return None,
                2 if piece.depth() >= FEW_HALVINGS && piece.turns() == 1 => {
                    let derivative = derivative.get_or_insert_with(|| poly.derivative());
                    let mut before = piece.first_sign();
                    for found in two_or_none(poly, derivative, &piece) {
                        cells.push(match found {
                            Found::At(at) => Cell::At(at),
                            Found::Between((low, high)) => Cell::Between { low, high, before },
                        });
                        before = before.reverse();
                    }
                }
                _ => {
                    let (left, right) = piece.halves();
                    let middle = right.starts_at_root().then(|| Cell::At(right.low()));
                    parts.extend(Part::of(right));
                    parts.extend(middle.map(Part::Found));
                    parts.extend(Part::of(left));
                }
            },
        }
    }
    if bernstein.last().is_some_and(Integer::is_zero) {
        cells.push(Cell::At(Dyadic::one()));
    }
    Some(cells)
}

/// A part of the step that is still to be looked at.
enum Part {
    Found(Cell),
    /// An interval without its ends.
    Open(Piece),
}

impl Part {
    /// Of a piece. Those that are kept whole have two sign changes or more each, and all of them
    /// together no more than the first: there are few.
    fn of(mut piece: Piece) -> Option<Self> {
        match piece.changes() {
            0 => None,
            1 => Some(Part::Found(Cell::between(&piece))),
            _ => {
                piece.zoom();
                Some(Part::Open(piece))
            }
        }
    }
}

impl Cell {
    /// The root of a piece with one sign change.
    fn between(piece: &Piece) -> Self {
        let (low, high) = piece.ends();
        Cell::Between {
            low,
            high,
            before: piece.first_sign(),
        }
    }
}

#[cfg(test)]
mod tests;
