//! The motion of two edges as polynomials, and what it is confined to.

use tunnelproof::contact::Case;

use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::vector::Vector;

/// The polynomials of exactness: `K = B - A`, `L = D - C`, `M = C - A`, `N = K x L`, `f = M . N`.
#[derive(Clone, Debug)]
pub(super) struct Motion<Z> {
    pub(super) k: Vector<Z>,
    pub(super) l: Vector<Z>,
    pub(super) m: Vector<Z>,
    pub(super) n: Vector<Z>,
    /// The edges can touch only where it is 0.
    pub(super) f: Poly<Z>,
}

impl<Z: Integer> Motion<Z> {
    pub(super) fn new(points: &Scaled<Z>) -> Self {
        let difference = |to: usize, from: usize| {
            let at = |points: &[[Z; 3]; 4]| [0, 1, 2].map(|h| points[to][h].sub(&points[from][h]));
            Vector::linear(&at(&points.start), &at(&points.end))
        };
        let (k, l, m) = (difference(1, 0), difference(3, 2), difference(2, 0));
        let n = k.cross(&l);
        let f = m.dot(&n);
        Motion { k, l, m, n, f }
    }

    /// The case of the motion, exactly (thesis 3.1.1, figure 3.2).
    pub(super) fn case(&self) -> Case {
        if self.k.is_zero() || self.l.is_zero() {
            Case::Degenerate
        } else if self.m.is_zero() {
            Case::SharedStart
        } else if self.n.is_zero() {
            if self.k.cross(&self.m).is_zero() {
                Case::Collinear
            } else {
                Case::Parallel
            }
        } else if self.f.is_zero() {
            Case::Coplanar
        } else {
            Case::General
        }
    }

    /// For each of the ends A, B, C, D: the vectors from it to the two ends of the other edge.
    pub(super) fn ends(&self) -> [End<Z>; 4] {
        let to_d = self.m.add(&self.l);
        let b_to_c = self.m.sub(&self.k);
        let b_to_d = to_d.sub(&self.k);
        let back = |v: &Vector<Z>| Vector([0, 1, 2].map(|h| v.0[h].neg()));
        [
            End::new(self.m.clone(), to_d.clone()),
            End::new(b_to_c.clone(), b_to_d.clone()),
            End::new(back(&self.m), back(&b_to_c)),
            End::new(back(&to_d), back(&b_to_d)),
        ]
    }
}

/// An end `X` of one edge against the other edge `YZ`.
#[derive(Clone, Debug)]
pub(super) struct End<Z> {
    /// `Y - X`.
    pub(super) to_y: Vector<Z>,
    /// `Z - X`.
    pub(super) to_z: Vector<Z>,
    /// `G = (Y - X) x (Z - X)`: 0 where `X` is on the line `YZ`, or `Y = Z`.
    pub(super) turn: Vector<Z>,
    /// `(Y - X) . (Z - X)`: where the turn is 0, not positive exactly if `X` is on the edge `YZ`.
    pub(super) between: Poly<Z>,
}

impl<Z: Integer> End<Z> {
    fn new(to_y: Vector<Z>, to_z: Vector<Z>) -> Self {
        let (turn, between) = (to_y.cross(&to_z), to_y.dot(&to_z));
        End {
            to_y,
            to_z,
            turn,
            between,
        }
    }
}
