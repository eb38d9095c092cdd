//! Proofs that a moving vertex and a moving face stay apart.

use crate::certified::ends::Ends;
use crate::certified::motion::{Motion, Vector, add, both, dot, sub};
use crate::certified::separate::SweptBoxes;

/// `K = C - B`, `L = D - B`, `M = A - B`.
#[inline(always)]
pub(in crate::certified) fn star<E: Ends>([a, b, c, d]: &[[E; 3]; 4]) -> Motion<E> {
    Motion {
        k: sub(c, b),
        l: sub(d, b),
        m: sub(a, b),
    }
}

/// Whether the direction from the middle of the vertex' motion to that of the face separates them.
#[inline(always)]
pub(in crate::certified) fn is_separated_by_centres<E: Ends>(
    star: &Motion<E>,
    boxes: &SweptBoxes,
) -> bool {
    let Motion { k, l, m } = star;
    // B + C + D - 3 A at both ends of the step, up to rounding that does no harm: any direction
    // will do.
    let [x, y, z] = sub(&sub(&add(k, l), m), &add(m, m));
    is_separated_by(star, [x.sum(), y.sum(), z.sum()], boxes)
}

/// Whether `d` separates them for the whole step: `X . d` is larger for each corner than for the
/// vertex, at `t = 0` and at `t = 1`. It is linear in `t`, so larger in between too.
///
/// Relative to B, the least corner is at `min(0, K . d, L . d)`, the vertex at `M . d`: two
/// products, the error bound of [`SweptBoxes::is_certain`].
#[inline(always)]
fn is_separated_by<E: Ends>(star: &Motion<E>, d: Vector, boxes: &SweptBoxes) -> bool {
    let along = both(&d);
    let (k, l, m) = (
        dot(&star.k, &along),
        dot(&star.l, &along),
        dot(&star.m, &along),
    );
    let margin = k.smaller(l).smaller(E::both(0.0)) - m;
    boxes.is_certain(margin, &d)
}

#[cfg(test)]
mod tests;
