//! What the certified path answers of a vertex and a face.

use crate::certified::Hit;
use crate::certified::verdict::{between, normalised};
use crate::contact::{Case, Contact, ContactKind, ContactPoint, Flags};
use crate::query::{Point, VertexFace};

/// The first contact of a vertex and a face during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceHit {
    /// The largest `f64` that is not above the time of impact: who advances to it does not pass the
    /// contact.
    pub toi: f64,
    /// The smallest `f64` that is not below the time of impact: the next one up, or `toi` itself if
    /// that is the time of impact.
    pub toi_above: f64,
    /// Whether the contact lets the vertex through if it is missed. Exact.
    ///
    /// Contact at time 0 or 1 is a graze. Otherwise, with `f = ((C - B) x (D - B)) . (A - B)`: where
    /// `f` is not identically 0, a crossing if `f` changes its sign at the contact and the vertex is
    /// strictly inside the face, which has a plane then; where all points stay in a plane, if the vertex
    /// passes through the line of an edge, strictly inside that edge; where they stay on a line, always. With a
    /// radius: whether there is a crossing, at radius 0, at any time of the step.
    pub kind: ContactKind,
    /// The sign of `f` just before the contact, 1 where the vertex comes from the side to which
    /// `(C - B) x (D - B)` points; 0 where `f` is identically 0 or the contact is at `t = 0`. Exact.
    pub side: i8,
    /// Where the vertex is in the face: the weights of B, C and D in it, in `[0, 1]`. With a radius, where the face
    /// is nearest to it.
    ///
    /// In a face without area at that time they are those at the first of B, C and D, or else on the first
    /// of BC, CD and DB, that the vertex is on.
    pub weights: [f64; 3],
    /// No weight is farther from the exact one than this, which is at most [`Hit::PARAMETER_ERROR`].
    pub weight_error: f64,
    /// The case of the motion. Exact: [`Case::Degenerate`] if the face has no area for the whole step, else
    /// [`Case::Coplanar`] if `f` is identically 0, else [`Case::General`].
    pub case: Case,
    /// The configuration at the time of impact. Exact: `temporarily_point` if the face is a point then,
    /// though not for the whole step, `temporarily_parallel` if it is a segment then, though it has an
    /// area at some other time.
    pub flags: Flags,
}

impl FaceHit {
    /// The contact in space: the vertex at `toi`, with the weights of C and D as `u` and `v`.
    ///
    /// With `S` the largest magnitude of a coordinate of A, the point is within
    /// `(4 * 2^-53 + 2 (toi_above - toi)) S` of the exact one in each coordinate. The normal is the
    /// velocity of the face relative to the vertex there, normalised: where the velocities cancel it
    /// loses accuracy in the same measure.
    pub fn contact(&self, query: &VertexFace) -> Contact {
        let (start, end) = (query.start(), query.end());
        let change = |i: usize| end[i].coords - start[i].coords;
        let [b, c, d] = self.weights;
        let face = change(1) * b + change(2) * c + change(3) * d;
        Contact {
            toi: self.toi,
            first: ContactPoint {
                point: Point::from(between(&start[0].coords, &end[0].coords, self.toi)),
                u: c,
                v: d,
                normal: normalised(&(face - change(0))),
            },
            second: None,
        }
    }

    /// Whether the weights are as near as is promised of them.
    pub(super) fn is_precise(&self) -> bool {
        self.weight_error <= Hit::PARAMETER_ERROR
    }
}
