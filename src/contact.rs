//! What is answered: a verdict and, for a hit, its witness.

use std::fmt;

use nalgebra::Vector3;

use crate::query::Point;

/// Hit or miss of one query, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// No contact during the step.
    Miss,
    /// Contact, first at `Contact::toi`.
    Hit(Contact),
}

/// The first contact of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Time of impact in `[0, 1]`.
    pub toi: f64,
    /// Where they touch at `toi`.
    pub first: ContactPoint,
    /// The other end of the overlap where the edges are collinear at `toi` and share more than a
    /// point (thesis figure 4.11).
    pub second: Option<ContactPoint>,
}

/// One point of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Position in space, in metres.
    pub point: Point,
    /// Parameter on edge `AB`: 0 at A, 1 at B.
    pub u: f64,
    /// Parameter on edge `CD`: 0 at C, 1 at D.
    pub v: f64,
    /// The velocity of `CD` relative to `AB` at this point, normalised (thesis 2.2.2); `None`
    /// where they do not move against each other.
    pub normal: Option<Vector3<f64>>,
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
