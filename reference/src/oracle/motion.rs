//! What the motions of two edges and of a vertex and a face have in common.

use tunnelproof::contact::{Case, Flags};

use crate::algebraic::Algebraic;
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::locus::Locus;
use super::pair::Pair;
use super::vector::Vector;

/// The motion of four points as polynomials.
pub(super) trait Motion<Z: Integer> {
    /// The triple product that is 0 where the four points share a plane: without radius, nothing
    /// touches at other times.
    fn f(&self) -> &Poly<Z>;

    /// The case of the motion, in the sense of [`crate::answer`].
    fn case(&self) -> Case;

    /// Each vertex with each edge of the other side: where motion in a plane begins to touch, such
    /// a vertex is on such an edge.
    fn ends(&self) -> Vec<End<Z>>;

    /// For each two vertices that can meet, the way from one to the other.
    fn meetings(&self) -> Vec<Vector<Z>>;

    /// Where they touch at a time at which `f` is 0; `None` if they do not.
    fn locus(&self, time: &Algebraic<Z>) -> Option<Locus<Z>>;

    /// The places that are nearest to each other, if they are more than one: the two ends of the
    /// part in which parallel edges are beside each other (or one end, if that is a point).
    fn overlap(&self, time: &Algebraic<Z>) -> Option<Locus<Z>>;

    /// What is so at a time but not for the whole step.
    fn flags(&self, time: &Algebraic<Z>) -> Flags;

    /// Every two features whose distance can be that of the whole; those with fewer points first.
    fn pairs(&self) -> Vec<Pair<Z>>;

    /// The vectors and products that the case is decided by.
    fn vanishing(&self) -> Vec<(&'static str, bool)>;

    /// Where the line of `CD` meets that of `AB`, or the vertex the plane of the face, at a time at
    /// which `f` is 0: `u` and `v`, rounded. `None` if that is no single place.
    fn meeting(&self, time: &Algebraic<Z>) -> Option<[f64; 2]>;
}

/// The vector from point `from` to point `to`, moving.
pub(super) fn way<Z: Integer>(points: &Scaled<Z>, from: usize, to: usize) -> Vector<Z> {
    let at = |points: &[[Z; 3]; 4]| [0, 1, 2].map(|h| points[to][h].sub(&points[from][h]));
    Vector::linear(&at(&points.start), &at(&points.end))
}

/// A vertex `X` against an edge `YZ` of the other side.
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
    pub(super) fn new(to_y: Vector<Z>, to_z: Vector<Z>) -> Self {
        let (turn, between) = (to_y.cross(&to_z), to_y.dot(&to_z));
        End {
            to_y,
            to_z,
            turn,
            between,
        }
    }

    /// `E = Z - Y`.
    pub(super) fn edge(&self) -> Vector<Z> {
        self.to_z.sub(&self.to_y)
    }

    /// `(X - Y) . E`, `(Z - X) . E` and their sum `E . E`: how far along the edge the nearest point
    /// of its line is.
    pub(super) fn along(&self) -> [Poly<Z>; 3] {
        let edge = self.edge();
        let (from_y, to_z) = (self.to_y.dot(&edge).neg(), self.to_z.dot(&edge));
        let sum = from_y.add(&to_z);
        [from_y, to_z, sum]
    }
}
