//! Two roots that may be as near as one likes, parted by the root of the derivative between them.

use std::cell::Cell;

use smallvec::SmallVec;

use super::bernstein::Piece;
use super::bracket::Bracket;
use super::dyadic::Dyadic;
use super::enclosure::FIRST;
use super::poly::Poly;

/// A simple root by itself.
pub(super) enum Found {
    /// It is this number.
    At(Dyadic),
    /// It is the only root strictly between these.
    Between((Dyadic, Dyadic)),
}

/// The roots in a piece that has two or none, and in which the derivative has one root, in
/// ascending order.
///
/// If there are two, that root is between them, and the polynomial has the other sign there; if
/// not, it has one sign in the whole piece. Its root and that of the derivative are not the same,
/// so that narrowing to the latter, which takes few steps however near the two roots are, tells in
/// the end.
#[inline(never)]
pub(super) fn two_or_none<const N: usize>(
    poly: &Poly<N>,
    derivative: &Poly<N>,
    piece: &Piece,
) -> SmallVec<[Found; 2]> {
    let (low, high) = piece.ends();
    let sign = piece.first_sign();
    let between = |low: &Dyadic, high: &Dyadic| Found::Between((low.clone(), high.clone()));
    let turn = Bracket::new(derivative, low.clone(), high.clone(), sign.reverse());
    let mut turn = turn.far();
    // Where the polynomial is known to have the sign of the piece, or need not be asked: an end of
    // that, and where it was asked last, on each side.
    let mut known = [low.clone(), high.clone()];
    let enough = Cell::new(FIRST);
    // Ends: as said above; integers alone decide that the derivative has one root here, and each
    // turn narrows its bracket.
    loop {
        let met = turn.refine();
        let ends = match &met {
            Some(at) => [at, at],
            None => turn.ends(),
        };
        for ((at, is_before), known) in ends.into_iter().zip([true, false]).zip(&mut known) {
            let is_new = at.compare(known).is_ne();
            if !is_new || at.compare(&low).is_le() || at.compare(&high).is_ge() {
                continue;
            }
            *known = at.clone();
            let here = poly.sign_near(at, &enough);
            if here == sign.reverse() {
                return [between(&low, at), between(at, &high)].into();
            }
            if here.is_eq() {
                let root = Found::At(at.clone());
                return match is_before {
                    true => [root, between(at, &high)].into(),
                    false => [between(&low, at), root].into(),
                };
            }
            // The other end comes as near: one of them is enough.
            break;
        }
        if met.is_some() || turn.plain_sign_of(poly).is_some() {
            return SmallVec::new();
        }
    }
}
