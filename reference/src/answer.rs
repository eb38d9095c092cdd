//! The exact answer to a query, written down in `f64`.
//!
//! Exact numbers live in their backend; what is printed, stored and compared is an [`ExactAnswer`],
//! in which every exact number stands as the `f64` next below and next above it. Two answers are
//! the same exactly when they are equal, so judges are compared with `==`.
//!
//! # Vertex and face
//!
//! `w = A - B`, `E1 = C - B`, `E2 = D - B`, `f = (E1 x E2) . w`. A point of the face is
//! `B + u E1 + v E2`. The case is degenerate if the face has no area for the whole step
//! (`E1 x E2 = 0` for all `t`), else coplanar if `f = 0` for all `t`, else general. Of the flags,
//! `temporarily_point` says that the face is a point at `toi`, `temporarily_parallel` that it is a
//! segment, either not for the whole step.
//!
//! # Radius
//!
//! With a radius `R` above 0 there is contact where the distance is at most `R`. `toi = 0` is an
//! *initial overlap*. Otherwise the distance is `R` at `toi` and above it before. The places are
//! the nearest points at `toi`; if edges are parallel there and beside each other, the two ends of
//! that part. A crossing is what the midlines (or the vertex and the face) do: without them
//! passing, nothing comes to the other side. So both `crosses` and `kind` say whether there is a
//! crossing at radius 0 at any time of the step: to miss the contact is then to miss a tunnel.
//!
//! # Crossing or graze
//!
//! At radius 0, a contact at time `s` is a **crossing** if the two swap sides there, within the
//! space that their motion is confined to, and stay in contact under every small enough disturbance
//! of the motion that keeps them confined; missing it is a tunnel. It is a **graze** otherwise. In
//! terms of the polynomials `K = B - A`, `L = D - C`, `M = C - A`, `f = (K x L) . M`:
//!
//! - A contact at `s = 0` or `s = 1` is a graze: the step does not show one of the two sides.
//! - General motion (`f` not identically 0): a crossing if `f` changes sign at `s`, and the lines
//!   meet there at an angle (`K x L` is not 0 at `s`) in a point that is interior to both edges
//!   (`0 < u < 1` and `0 < v < 1`). Of a vertex and a face: `f` changes sign at `s`, where the face
//!   has an area and the vertex is strictly inside it.
//! - Coplanar motion (`f = 0` for all `t`, the four points not always on a line): for an end `X` of
//!   one edge and the other edge `YZ`, or the vertex `X` and an edge `YZ` of the face, let
//!   `G = (Y - X) x (Z - X)`. A crossing if, for one of them, `G` is not identically 0 and reverses
//!   its direction at `s` (its root there has odd multiplicity), and `X` is strictly between `Y`
//!   and `Z` at `s`, or the edges overlap at `s` in more than a point.
//! - Collinear motion (the four points on a line for all `t`): a crossing if the two touch at `s`
//!   and do not in some open interval that ends at `s`.

use std::fmt;

use tunnelproof::contact::{Case, ContactKind, Flags};

/// An exact real number between its neighbours in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// The largest `f64` that is not above the number.
    pub below: f64,
    /// The smallest `f64` that is not below the number; equal to `below` if the number is an `f64`.
    pub above: f64,
}

/// Hit or miss, and the case of the motion, all exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactAnswer {
    /// The case of the thesis' classification, every threshold 0.
    pub case: Case,
    /// The first contact; `None` for a miss.
    pub hit: Option<ExactHit>,
}

/// The first contact of a step and what kind it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactHit {
    /// Time of impact.
    pub toi: Enclosure,
    /// Whether the contact at `toi` is a crossing or a graze; with a radius, whether the midlines
    /// cross.
    pub kind: ContactKind,
    /// Whether any contact of the step, the first or a later one, is a crossing: then a method that
    /// reports none lets the edges tunnel.
    pub crosses: bool,
    /// The sign of `f` just before `toi`, which is the side they come from; 0 where `f` is
    /// identically 0 or `toi` is 0.
    pub side: i8,
    /// The features that touch at `first`, of `AB` and of `CD`, or the vertex and of the face:
    /// those with the fewest points.
    pub features: [Feature; 2],
    /// Where they touch at `toi`.
    pub first: Parameters,
    /// The other end of the overlap, if the edges overlap at `toi` in more than a point. Then
    /// `first` is the end with the smaller `u`.
    pub second: Option<Parameters>,
    /// The configuration at `toi`.
    pub flags: Flags,
}

/// A point of contact.
///
/// The parameter on an edge that is a point at that time is 0. On a face without area, the place is
/// at the first of B, C and D, or else on the first of BC, CD and BD, that it can be on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// On edge `AB`, 0 at A and 1 at B. On a face, the weight of C.
    pub u: Enclosure,
    /// On edge `CD`, 0 at C and 1 at D. On a face, the weight of D.
    pub v: Enclosure,
}

/// A vertex, an edge or the face: the points among A, B, C and D that span it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Feature {
    points: [bool; 4],
}

impl Feature {
    /// The feature with these of A, B, C and D for its corners.
    pub const fn spanned_by(points: [bool; 4]) -> Self {
        Feature { points }
    }

    /// The vertex of this number, 0 to 3 for A to D.
    pub const fn vertex(index: usize) -> Self {
        let mut points = [false; 4];
        points[index] = true;
        Feature { points }
    }

    /// How many points span it: 1 for a vertex, 2 for an edge, 3 for the face.
    pub fn corners(&self) -> usize {
        self.points.iter().filter(|spans| **spans).count()
    }

    /// The part of the edge from point `start` to the next one at this parameter.
    fn of_edge(start: usize, parameter: Enclosure) -> Self {
        let is = |value| parameter == Enclosure::exactly(value);
        let mut points = [false; 4];
        points[start] = !is(1.0);
        points[start + 1] = !is(0.0);
        Feature { points }
    }
}

impl fmt::Display for Feature {
    /// The letters of its points, such as `AB`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = ["A", "B", "C", "D"].into_iter().zip(self.points);
        letters
            .filter(|(_, spans)| *spans)
            .try_for_each(|(letter, _)| f.write_str(letter))
    }
}

impl Parameters {
    /// The features of the edges `AB` and `CD` that these are on.
    pub fn features_of_edges(&self) -> [Feature; 2] {
        [Feature::of_edge(0, self.u), Feature::of_edge(2, self.v)]
    }
}

impl Enclosure {
    /// The enclosure of a number that is an `f64`.
    pub fn exactly(value: f64) -> Self {
        Enclosure {
            below: value,
            above: value,
        }
    }

    /// Whether the number is the `f64` `below`.
    pub fn is_exact(&self) -> bool {
        self.below == self.above
    }
}

impl ExactHit {
    /// Whether the step starts in contact.
    pub fn is_initial(&self) -> bool {
        self.toi.above == 0.0
    }
}

impl fmt::Display for Enclosure {
    /// The number, as the `f64` that it is or as an interval.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_exact() {
            write!(f, "{}", self.below)
        } else {
            write!(f, "[{}, {}]", self.below, self.above)
        }
    }
}
