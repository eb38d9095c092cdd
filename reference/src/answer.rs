//! The exact answer to a query, written down in `f64`.
//!
//! Exact numbers live in their backend; what is printed, stored and compared is an [`ExactAnswer`],
//! in which every exact number stands as the `f64` next below and next above it. Two answers are the
//! same exactly when they are equal, so judges are compared with `==`.
//!
//! # Crossing or graze
//!
//! A contact at time `s` is a **crossing** if the edges swap sides there, within the space that
//! their motion is confined to, and stay in contact under every small enough disturbance of the
//! motion that keeps them confined; missing it is a tunnel. It is a **graze** otherwise. In terms of
//! the polynomials `K = B - A`, `L = D - C`, `M = C - A`, `f = (K x L) . M`:
//!
//! - A contact at `s = 0` or `s = 1` is a graze: the step does not show one of the two sides.
//! - General motion (`f` not identically 0): a crossing if `f` changes sign at `s`, and the lines meet
//!   there at an angle (`K x L` is not 0 at `s`) in a point that is interior to both edges
//!   (`0 < u < 1` and `0 < v < 1`).
//! - Coplanar motion (`f = 0` for all `t`, the four points not always on a line): for an end `X` of
//!   one edge and the other edge `YZ` let `G = (Y - X) x (Z - X)`. A crossing if, for one of the
//!   four such ends, `G` is not identically 0 and reverses its direction at `s` (its root there has
//!   odd multiplicity), and `X` is strictly between `Y` and `Z` at `s`, or the edges overlap at `s`
//!   in more than a point.
//! - Collinear motion (the four points on a line for all `t`): a crossing if the edges touch at `s`
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
    /// Whether the contact at `toi` is a crossing or a graze.
    pub kind: ContactKind,
    /// Whether any contact of the step, the first or a later one, is a crossing: then a method that
    /// reports none lets the edges tunnel.
    pub crosses: bool,
    /// The sign of `f` just before `toi`, which is the side the edges come from; 0 where `f` is
    /// identically 0 or `toi` is 0.
    pub side: i8,
    /// Where they touch at `toi`.
    pub first: Parameters,
    /// The other end of the overlap, if the edges overlap at `toi` in more than a point. Then `first`
    /// is the end with the smaller `u`.
    pub second: Option<Parameters>,
    /// The configuration at `toi`.
    pub flags: Flags,
}

/// A point of contact in edge parameters.
///
/// The parameter on an edge that is a point at that time is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// On edge `AB`, 0 at A and 1 at B.
    pub u: Enclosure,
    /// On edge `CD`, 0 at C and 1 at D.
    pub v: Enclosure,
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
