//! What is answered: the first contact of a step.
//!
//! [`Hit`] is the answer of the [certified path](crate::certified), with what is proved of it.
//! [`Contact`] is a contact in space: what any narrow phase can say, in a [`Verdict`].
//!
//! ```
//! use tunnelproof::contact::{Case, ContactKind};
//! use tunnelproof::{Point, VertexFace, decide};
//!
//! let p = Point::new;
//! let face = [p(0.0, 0.0, 0.0), p(4.0, 0.0, 0.0), p(0.0, 4.0, 0.0)];
//! let at = |z: f64| [p(1.0, 1.0, z), face[0], face[1], face[2]];
//! let query = VertexFace::new(at(1.0), at(-1.0), 0.0)?;
//! let hit = decide(&query).expect("the vertex goes through the face");
//! assert_eq!((hit.toi, hit.kind, hit.case), (0.5, ContactKind::Crossing, Case::General));
//! assert_eq!(hit.place.weights, [0.5, 0.25, 0.25]);
//! let contact = hit.contact(&query);
//! assert_eq!(contact.first.point, p(1.0, 1.0, 0.0));
//! # Ok::<(), tunnelproof::QueryError>(())
//! ```

use std::fmt;

use nalgebra::Vector3;

use crate::query::Point;

/// The first contact of a step, proved.
///
/// `P` is the place of the contact: [`EdgePlace`] of two edges, [`FacePlace`] of a vertex and a
/// face, [`Place`] of either.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<P> {
    /// The largest `f64` that is not above the exact time of impact, in `[0, 1]`.
    ///
    /// Positions that are rounded to `f64` at this time may already be past the contact: the bound
    /// holds for the time, not for stored positions.
    pub toi: f64,
    /// The smallest `f64` that is not below the exact time of impact: the next one up, or `toi`
    /// itself if that is the time of impact.
    pub toi_above: f64,
    /// Whether a simulator that misses the contact lets the two sides through each other. Exact.
    ///
    /// It is about the first contact of this pair in this step: after a graze the two may still
    /// cross later in the step. Do not filter by it: what passes through a mesh at a
    /// vertex or an edge that two of its parts share, or at the border of two steps, grazes each of
    /// them.
    ///
    /// A contact at time 0 or 1 is a graze. Otherwise the definition uses `f` (see
    /// [`side`](Self::side)):
    ///
    /// - Where `f` is not identically 0: a crossing if `f` changes its sign at the contact and the
    ///   two touch strictly inside: two lines that meet at an angle strictly inside both edges, or
    ///   a vertex strictly inside a face that has an area then.
    /// - Where all points stay in a plane: a crossing if an end of one edge passes through the line
    ///   of the other edge, inside that edge or onto an overlap; or if the vertex passes through
    ///   the line of an edge of the face, strictly inside that edge.
    /// - Where all points stay on a line: always a crossing.
    ///
    /// With a radius: whether there is a crossing, at radius 0, at any time of the step.
    pub kind: ContactKind,
    /// The sign of `f` just before the contact, which is the side that the two come from: 1, -1, or
    /// 0 where `f` is identically 0 or the contact is at time 0. Exact.
    ///
    /// Of two edges `f = ((B - A) x (D - C)) . (C - A)`. Of a vertex and a face
    /// `f = ((C - B) x (D - B)) . (A - B)`: 1 where the vertex comes from the side to which
    /// `(C - B) x (D - B)` points.
    pub side: i8,
    /// The case of the motion. Exact.
    pub case: Case,
    /// The configuration at the time of impact. Exact.
    pub flags: Flags,
    /// Where the two touch; with a radius, where they are nearest.
    pub place: P,
}

/// Where two edges touch, or are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePlace {
    /// The place; of an overlap, the end with the smaller `u`.
    pub first: EdgePoint,
    /// The other end of the overlap, if the edges overlap, or are nearest, in more than a point.
    pub second: Option<EdgePoint>,
    /// No parameter is farther from the exact one than this, which is at most [`PLACE_ERROR`].
    pub error: f64,
}

/// A point on each of two edges.
///
/// On an edge that is a point at that time, the parameter is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePoint {
    /// On edge `AB`, 0 at A and 1 at B.
    pub u: f64,
    /// On edge `CD`, 0 at C and 1 at D.
    pub v: f64,
}

/// Where a vertex and a face touch, or are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePlace {
    /// The weights of the corners B, C and D, in `[0, 1]`; they add up to 1 within three times
    /// [`error`](Self::error).
    ///
    /// In a face without area at that time they are those at the first of B, C and D, or else on
    /// the first of BC, CD and DB, that the vertex is on.
    pub weights: [f64; 3],
    /// No weight is farther from the exact one than this, which is at most [`PLACE_ERROR`].
    pub error: f64,
}

/// The place of a contact, of either kind of query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Of two edges.
    Edges(EdgePlace),
    /// Of a vertex and a face.
    Face(FacePlace),
}

/// The largest error that the place of a [`Hit`] has, `2^-32`. Where `f64` cannot promise so much,
/// integers do.
pub const PLACE_ERROR: f64 = f64::from_bits((1023 - 32) << 52);

/// Hit or miss of one query, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a box would allocate for each hit"
)]
pub enum Verdict {
    /// No contact during the step.
    Miss,
    /// Contact, first at `Contact::toi`.
    Hit(Contact),
}

/// The first contact of a step, in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Time of impact in `[0, 1]`.
    pub toi: f64,
    /// Where they touch at `toi`.
    pub first: ContactPoint,
    /// The other end of the overlap where the edges are collinear at `toi` and share more than a
    /// point.
    pub second: Option<ContactPoint>,
    /// The unit vector along which the two sides touch: from the first side (the edge AB, or the
    /// vertex) to the second (the edge CD, or the face), as they are just before the contact.
    /// `None` from a method that does not say, and where there is no such direction; see
    /// [`Hit::normal`].
    pub normal: Option<Vector3<f64>>,
}

/// One point of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Position in space, in metres, on the first side.
    pub point: Point,
    /// How the point is made of A, B, C and D: `A w[0] + B w[1]` and `C w[2] + D w[3]` of two
    /// edges, `A` and `B w[1] + C w[2] + D w[3]` of a vertex and a face. The weights of each side
    /// add up to 1, within three times the error of the place.
    pub weights: [f64; 4],
    /// The direction in which the second side moves relative to the first at this point, a unit
    /// vector; `None` where they do not move against each other, or so little that rounding hides
    /// it.
    ///
    /// Brandl calls it the normal ("Continuous Collision Detection for Wires with Adaptive
    /// Resolution", Umeå University 2017, section 2.2.2).
    pub relative_velocity: Option<Vector3<f64>>,
}

/// How a pair of edges moves against each other during the whole step (thesis 3.1.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Case {
    /// None of the cases below.
    General,
    /// Directions are parallel for the whole step, on two lines (thesis case 3, 3.1.2.3).
    Parallel,
    /// All four points share a plane for the whole step (thesis case 4).
    Coplanar,
    /// All four points share a line for the whole step (thesis case 3, 3.1.2.1).
    Collinear,
    /// A and C are the same point for the whole step (thesis case 2).
    SharedStart,
    /// An edge is a point for the whole step (thesis case 1).
    Degenerate,
}

/// What the configuration at the time of impact is, over and above the [`Case`] (thesis table 4.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flags {
    /// The edges are parallel at `toi` though not for the whole step.
    pub temporarily_parallel: bool,
    /// An edge is a point at `toi` though not for the whole step.
    pub temporarily_point: bool,
}

/// Whether missing a contact lets the edges through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactKind {
    /// The edges swap sides: a tunnel if missed.
    Crossing,
    /// They touch without swapping sides.
    Graze,
}

impl EdgePoint {
    /// The weights of A, B, C and D.
    pub fn weights(self) -> [f64; 4] {
        let EdgePoint { u, v } = self;
        [1.0 - u, u, 1.0 - v, v]
    }
}

impl ContactPoint {
    /// The point on each edge, of a contact of two edges.
    pub fn on_edges(&self) -> EdgePoint {
        let [_, u, _, v] = self.weights;
        EdgePoint { u, v }
    }
}

impl Place {
    /// No parameter or weight is farther from the exact one than this.
    pub fn error(&self) -> f64 {
        match self {
            Place::Edges(place) => place.error,
            Place::Face(place) => place.error,
        }
    }

    /// The weights of A, B, C and D, as those of a [`ContactPoint`]; and those at the other end where
    /// two edges overlap.
    pub fn weights(&self) -> ([f64; 4], Option<[f64; 4]>) {
        match self {
            Place::Edges(place) => (place.first.weights(), place.second.map(EdgePoint::weights)),
            Place::Face(place) => {
                let [b, c, d] = place.weights;
                ([1.0, b, c, d], None)
            }
        }
    }
}

impl From<EdgePlace> for Place {
    fn from(place: EdgePlace) -> Self {
        Place::Edges(place)
    }
}

impl From<FacePlace> for Place {
    fn from(place: FacePlace) -> Self {
        Place::Face(place)
    }
}

impl<P> Hit<P> {
    /// The largest `f32` that is not above the exact time of impact: `toi as f32` may be above it.
    pub fn toi_f32(&self) -> f32 {
        single_below(self.toi)
    }

    /// The same contact with its place in another form.
    pub fn map_place<T>(self, form: impl FnOnce(P) -> T) -> Hit<T> {
        Hit {
            toi: self.toi,
            toi_above: self.toi_above,
            kind: self.kind,
            side: self.side,
            case: self.case,
            flags: self.flags,
            place: form(self.place),
        }
    }
}

/// The largest `f32` that is not above a finite number.
pub(crate) fn single_below(number: f64) -> f32 {
    let nearest = number as f32;
    match f64::from(nearest) > number {
        true => nearest.next_down(),
        false => nearest,
    }
}

impl Verdict {
    /// Whether it is a hit.
    pub fn is_hit(&self) -> bool {
        matches!(self, Verdict::Hit(_))
    }

    /// The contact of a hit.
    pub fn contact(&self) -> Option<&Contact> {
        match self {
            Verdict::Miss => None,
            Verdict::Hit(contact) => Some(contact),
        }
    }
}

impl Case {
    /// Every case, in the order of the thesis' flow chart (figure 3.2).
    pub const ALL: [Case; 6] = [
        Case::Degenerate,
        Case::SharedStart,
        Case::Collinear,
        Case::Parallel,
        Case::Coplanar,
        Case::General,
    ];

    /// The name used in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Case::General => "general",
            Case::Parallel => "parallel",
            Case::Coplanar => "coplanar",
            Case::Collinear => "collinear",
            Case::SharedStart => "shared-start",
            Case::Degenerate => "degenerate",
        }
    }

    /// The case with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        Case::ALL.into_iter().find(|case| case.name() == name)
    }
}

impl ContactKind {
    /// The name used in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            ContactKind::Crossing => "crossing",
            ContactKind::Graze => "graze",
        }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for ContactKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
