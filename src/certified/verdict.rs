//! What the certified path answers.

use nalgebra::Vector3;

use crate::contact::{Case, Contact, ContactKind, ContactPoint, Flags};
use crate::query::{EdgeEdge, Point};

/// Hit or miss of one query, proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The edges do not touch during the step.
    Miss,
    /// They touch, first at [`Hit::toi`].
    Hit(Hit),
}

/// The first contact of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The largest `f64` that is not above the time of impact: who advances to it does not pass the
    /// contact.
    pub toi: f64,
    /// The smallest `f64` that is not below the time of impact: the next one up, or `toi` itself if
    /// that is the time of impact.
    pub toi_above: f64,
    /// Whether the contact lets the edges through if it is missed. Exact.
    ///
    /// Contact at time 0 or 1 is a graze. Otherwise, with `f = ((B - A) x (D - C)) . (C - A)`: where
    /// `f` is not identically 0, a crossing if `f` changes its sign at the contact and the lines meet
    /// at an angle, strictly inside both edges; where all points stay in a plane, if an end of one edge
    /// passes through the line of the other edge, inside that edge or onto an overlap; where they
    /// stay on a line, always. With a radius: whether there is a crossing of the midlines, at radius 0, at
    /// any time of the step.
    pub kind: ContactKind,
    /// The sign of `f` just before the contact, which is the side the edges come from: 1, -1, or 0
    /// where `f` is identically 0 or the contact is at `t = 0`. Exact.
    pub side: i8,
    /// Where they touch; of an overlap, the end with the smaller `u`. With a radius, where they are nearest.
    pub first: Parameters,
    /// The other end of the overlap, if they overlap, or are nearest, in more than a point.
    pub second: Option<Parameters>,
    /// No parameter is farther from the exact one than this, which is at most
    /// [`Hit::PARAMETER_ERROR`].
    pub parameter_error: f64,
    /// The case of the motion (thesis 3.1.1). Exact.
    pub case: Case,
    /// The configuration at the time of impact. Exact.
    pub flags: Flags,
}

/// A point of contact in edge parameters, in `[0, 1]`.
///
/// On an edge that is a point at that time, the parameter is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// On edge `AB`, 0 at A and 1 at B.
    pub u: f64,
    /// On edge `CD`, 0 at C and 1 at D.
    pub v: f64,
}

impl Hit {
    /// The largest [`parameter_error`](Hit::parameter_error) that there is, `2^-32`. Where `f64` cannot
    /// promise so much, integers do.
    pub const PARAMETER_ERROR: f64 = f64::from_bits((1023 - 32) << 52);

    /// The contact in space, from the positions at `toi`.
    ///
    /// With `S` the largest magnitude of a coordinate of A and B, the point is within
    /// `(8 * 2^-53 + 2 parameter_error + 2 (toi_above - toi)) S` of the exact one in each coordinate.
    /// The normal is the velocity of CD relative to AB there, normalised (thesis 2.2.2): where the
    /// velocities cancel it loses accuracy in the same measure.
    pub fn contact(&self, query: &EdgeEdge) -> Contact {
        Contact {
            toi: self.toi,
            first: self.contact_point(query, self.first),
            second: self.second.map(|second| self.contact_point(query, second)),
        }
    }

    fn contact_point(&self, query: &EdgeEdge, Parameters { u, v }: Parameters) -> ContactPoint {
        let (start, end) = (query.start(), query.end());
        let [a, b] = [0, 1].map(|i| between(&start[i].coords, &end[i].coords, self.toi));
        let change = |i: usize| end[i].coords - start[i].coords;
        let relative = between(&change(2), &change(3), v) - between(&change(0), &change(1), u);
        ContactPoint {
            point: Point::from(between(&a, &b, u)),
            u,
            v,
            normal: normalised(&relative),
        }
    }
}

/// The point at `t` in `[0, 1]` from `a` to `b`, without overflow of the difference.
pub(super) fn between(a: &Vector3<f64>, b: &Vector3<f64>, t: f64) -> Vector3<f64> {
    a * (1.0 - t) + b * t
}

/// The direction of a vector, without overflow of the squares; `None` if it has none.
pub(super) fn normalised(vector: &Vector3<f64>) -> Option<Vector3<f64>> {
    let scaled = vector / vector.amax();
    scaled
        .iter()
        .all(|x| x.is_finite())
        .then(|| scaled.normalize())
}
