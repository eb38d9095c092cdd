//! Stage 4, continued: edges that have an end in common at the start touch there.
//!
//! Neighbours in a wire and edges of a mesh that share a vertex are such pairs, at every step.

use super::cubic::Cubic;
use super::ends::Ends;
use super::exact::PLACE_ERROR;
use super::motion::{Motion, Positions, Vector};
use super::root::Bracket;
use crate::contact::{Case, ContactKind, EdgePlace, EdgePoint, Flags, Hit};

/// The contact at `t = 0` in a common end, if nothing else is shared there and the case of the
/// motion is certain.
///
/// Points that are equal are so exactly. Where `N` is not 0 the lines have one point in common,
/// which is then that end: neither edge is a point, they are not parallel, and `u` and `v` are 0 or
/// 1.
///
/// There is no claim for a motion without a cubic but where the end is common for the whole step.
#[inline(always)]
pub(super) fn contact<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: Option<&Cubic>,
) -> Option<Hit<EdgePlace>> {
    let is_apart = cubic.is_some_and(|cubic| cubic.bernstein[0].abs() > cubic.error);
    if is_apart {
        return None;
    }
    common_end(&positions(), motion, cubic)
}

#[inline(never)]
fn common_end<E: Ends>(
    Positions { start, end }: &Positions,
    motion: &Motion<E>,
    cubic: Option<&Cubic>,
) -> Option<Hit<EdgePlace>> {
    let is_common = |at: &[Vector; 4], (i, j): (usize, usize)| at[i] == at[j];
    let ends = ENDS.into_iter().find(|ends| is_common(start, *ends))?;
    let unchecked = || Cubic::unchecked(motion);
    let meeting = motion.meeting(
        &cubic.copied().unwrap_or_else(unchecked),
        &Bracket::around(0.0, 0.0),
    );
    if !(meeting.n > meeting.error_n) {
        return None;
    }
    let case = if cubic.is_some_and(Cubic::is_not_identically_0) {
        Case::General
    } else if is_common(end, ends) {
        case_of_common_end(ends)
    } else {
        return None;
    };
    let parameter = |is_end: bool| if is_end { 1.0 } else { 0.0 };
    Some(Hit {
        toi: 0.0,
        toi_above: 0.0,
        kind: ContactKind::Graze,
        side: 0,
        case,
        flags: Flags::default(),
        place: EdgePlace {
            first: EdgePoint {
                u: parameter(ends.0 == B),
                v: parameter(ends.1 == D),
            },
            second: None,
            error: PLACE_ERROR,
        },
    })
}

/// The case of motion with a common end throughout and `N` not 0 at the start: with `A = C`, `M` is
/// identically 0. With another one it is not (both `A = C` and `B = D`, say, would mean `K = L`,
/// and `A = C` and `B = C` that `K = 0`), while `f` is 0: the four points are three.
fn case_of_common_end(ends: (usize, usize)) -> Case {
    if ends == (A, C) {
        Case::SharedStart
    } else {
        Case::Coplanar
    }
}

/// The ends of the edges, as in [`Positions`].
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const D: usize = 3;

/// An end of each edge; `A` and `C` come first.
const ENDS: [(usize, usize); 4] = [(A, C), (A, D), (B, C), (B, D)];

#[cfg(test)]
mod tests;
