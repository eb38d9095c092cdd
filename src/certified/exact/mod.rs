//! The exact stage: every edge-edge query of radius 0, decided in integers.
//!
//! All coordinates are dyadic rationals, so that every predicate of contact is the sign of a
//! polynomial with integer coefficients at a time that is itself a root of one. With
//! `K = B - A`, `L = D - C`, `M = C - A`, `N = K x L` and `f = M . N`:
//!
//! 1. [`scaled`] makes the coordinate differences integers; their width chooses a [`lane`], integers
//!    of fixed widths that cannot overflow, or integers of any size where it is too large.
//! 2. [`motion`] computes the coefficients.
//! 3. Edges that touch are coplanar, so that a contact time is a root of `f` ([`general`]). Where `f`
//!    is identically 0, it is the start or a time at which an end comes onto the other edge
//!    ([`confined`]).
//! 4. [`isolate`] parts the roots, [`bracket`] narrows one to the last bit, and [`time`] tells the
//!    signs of other polynomials there: by floating point where its error bound shows them, else
//!    exactly ([`sturm`]).
//! 5. [`locus`] is where the edges touch at such a time, if they do.
//!
//! Nothing is allocated as long as the numbers fit into [`integer`]'s inline buffer, which they do
//! for coordinates between 1e-6 and 1e6 with times of impact above 1e-12; beyond that the heap is
//! used. There is no tolerance and no limit on iterations: every loop ends by a reason that is stated
//! beside it.

use std::cmp::Ordering;

use crate::contact::{Case, ContactKind, Flags};
use crate::narrow::Unsupported;
use crate::query::EdgeEdge;

mod bracket;
mod confined;
mod dyadic;
mod general;
mod integer;
mod isolate;
mod lane;
mod locus;
mod motion;
mod poly;
mod scaled;
mod sturm;
mod time;

use lane::{Fixed, Lane, Number, Unlimited, Wide};
use locus::{Locus, Place};
use motion::Motion;
use scaled::Scaled;
use time::Time;

/// The largest error of the parameters `u` and `v` of an [`ExactHit`], 2^-50.
pub const PARAMETER_ERROR: f64 = 4.0 * f64::EPSILON;

/// Hit or miss of an edge-edge query, and the case of the motion, all decided exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The case of the thesis' classification (3.1.1, figure 3.2), every threshold 0.
    pub case: Case,
    /// The first contact; `None` for a miss.
    pub hit: Option<ExactHit>,
}

/// The first contact of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactHit {
    /// The largest `f64` that is not above the time of impact.
    pub toi_below: f64,
    /// The smallest `f64` that is not below the time of impact; equal to `toi_below` if that is the
    /// time of impact.
    pub toi_above: f64,
    /// Whether the contact lets the edges through if it is missed.
    ///
    /// Contact at `toi` 0 or 1 is a graze. Otherwise, with `f = ((B - A) x (D - C)) . (C - A)`: where
    /// `f` is not identically 0, a crossing if `f` changes its sign at the contact and the edges
    /// share a point strictly inside both; where all points stay in a plane, if an end of one edge
    /// passes through the line of the other edge, inside that edge or onto an overlap; where they
    /// stay on a line, always.
    pub kind: ContactKind,
    /// The sign of `f` just before the contact, which is the side the edges come from: 1, -1, or 0
    /// where `f` is identically 0 or the contact is at `t = 0`.
    pub side: i8,
    /// Where they touch; of an overlap, the end with the smaller `u`.
    pub first: Parameters,
    /// The other end of the overlap, if they overlap in more than a point.
    pub second: Option<Parameters>,
    /// The configuration at the time of impact.
    pub flags: Flags,
}

/// A point of contact in edge parameters.
///
/// In `[0, 1]` and right up to [`PARAMETER_ERROR`]. 0 and 1 are exact where the contact is at an end;
/// on an edge that is a point at that time, the parameter is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// On edge `AB`, 0 at A and 1 at B.
    pub u: f64,
    /// On edge `CD`, 0 at C and 1 at D.
    pub v: f64,
}

/// The exact answer to an edge-edge query, by integer arithmetic alone.
///
/// Every finite query is decided. It takes about a microsecond where the coordinates are of similar
/// magnitude, and up to milliseconds where their exponents span the range of `f64`.
///
/// # Errors
///
/// [`Unsupported`] for a radius above 0.
pub fn decide_exactly(query: &EdgeEdge) -> Result<Decision, Unsupported> {
    if query.radius() != 0.0 {
        return Err(Unsupported::Radius(query.radius()));
    }
    Ok(match Scaled::new(query) {
        Scaled::Narrow { values, bits } => {
            if bits <= Small::BITS {
                decide::<Small>(|i| Wide::from(values[i]))
            } else if bits <= Medium::BITS {
                decide::<Medium>(|i| Wide::from(values[i]))
            } else if bits <= Large::BITS {
                decide::<Large>(|i| Wide::from(values[i]))
            } else if bits <= Huge::BITS {
                decide::<Huge>(|i| Wide::from(values[i]))
            } else {
                decide::<Unlimited>(|i| values[i].into())
            }
        }
        Scaled::Broad(values) => decide::<Unlimited>(|i| values[i].clone()),
    })
}

type Small = Fixed<1, 2, 2>;
type Medium = Fixed<1, 2, 3>;
type Large = Fixed<2, 3, 5>;
type Huge = Fixed<2, 4, 6>;

fn decide<L: Lane>(component: impl Fn(usize) -> L::Linear) -> Decision {
    let motion = Motion::<L>::new(component);
    if motion.f.iter().all(Number::is_zero) {
        Decision {
            case: motion.confined_case(),
            hit: motion.decide_confined(),
        }
    } else {
        Decision {
            case: Case::General,
            hit: motion.decide_general(),
        }
    }
}

impl<L: Lane> Motion<L> {
    /// The case of a motion with `f` identically 0; in every other case than the general one it is.
    fn confined_case(&self) -> Case {
        if self.k.is_zero() || self.l.is_zero() {
            Case::Degenerate
        } else if self.m.is_zero() {
            Case::SharedStart
        } else if !self.is_parallel() {
            Case::Coplanar
        } else if self.m.cross(&self.k).iter().flatten().all(Number::is_zero) {
            Case::Collinear
        } else {
            Case::Parallel
        }
    }
}

impl ExactHit {
    fn new<L: Lane>(time: &Time, locus: &Locus<L>, kind: ContactKind, side: Ordering) -> Self {
        let parameters = |place: &Place<L>| Parameters {
            u: place.u.value(time),
            v: place.v.value(time),
        };
        ExactHit {
            toi_below: time.below,
            toi_above: time.above,
            kind,
            side: side as i8,
            first: parameters(&locus.first),
            second: locus.second.as_ref().map(parameters),
            flags: locus.flags,
        }
    }
}
