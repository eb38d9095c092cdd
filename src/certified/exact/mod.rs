//! The exact stage: every query, decided in integers. With a radius above 0 see [`thick`]; what
//! follows is of edges without, and [`face`] says what is different there.
//!
//! All coordinates are dyadic rationals, so that every predicate of contact is the sign of a
//! polynomial with integer coefficients at a time that is itself a root of one. With
//! `K = B - A`, `L = D - C`, `M = C - A`, `N = K x L` and `f = M . N`:
//!
//! 1. [`scaled`] makes the coordinate differences integers; their width chooses a [`width`],
//!    integers of fixed widths that cannot overflow, or integers of any size where it is too large.
//! 2. [`motion`] computes the coefficients.
//! 3. Edges that touch are coplanar, so that a contact time is a root of `f` ([`general`]). Where
//!    `f` is identically 0, it is the start or a time at which an end comes onto the other edge
//!    ([`confined`]).
//! 4. [`roots`] finds the roots: isolated in floating point where its error bound allows
//!    ([`isolate_f64`]), else exactly ([`isolate_bisect`], [`isolate`]), recognised as fractions of
//!    small numbers ([`fraction`]) or narrowed to the last bit ([`refine_root`], [`bracket`]).
//!    [`time`] tells the signs of other polynomials there: by floating point where its error bound
//!    shows them, else exactly ([`sturm`]).
//! 5. [`locus`] is where the edges touch at such a time, if they do.
//!
//! Nothing is allocated as long as the numbers fit into [`integer`]'s inline buffer, which they do
//! for coordinates between 1e-6 and 1e6 with times of impact above 1e-12; beyond that the heap is
//! used. There is no tolerance and no limit on iterations: every loop ends by a reason that is
//! stated beside it.

#![allow(
    clippy::large_enum_variant,
    reason = "a box would allocate, which this stage does not"
)]
#![allow(
    clippy::needless_range_loop,
    reason = "limbs and coefficients are indexed as in the formulas"
)]

use std::cmp::Ordering;

use super::motion::Positions;
use crate::contact::{Case, ContactKind, EdgePlace, EdgePoint, Hit};

mod algebraic_time;
mod bernstein;
mod bracket;
mod common_factor;
mod confined;
mod coordinates;
mod curve;
mod dyadic;
mod enclosure;
mod estimate;
mod face;
mod fraction;
mod general;
mod grid_time;
mod integer;
mod isolate;
mod isolate_bisect;
mod isolate_f64;
mod locus;
mod modular;
mod modulus;
mod motion;
mod passage;
mod poly;
mod refine_root;
mod remainders;
mod rigid;
mod roots;
mod scaled;
mod sturm;
mod thick;
mod time;
mod two_roots;
mod unlimited;
mod width;

use self::motion::Motion;
pub(super) use face::{case_of_face, decide_face};
use locus::{Locus, Place};
pub(super) use passage::{Passage, passage_of_edges, passage_of_face, side_of_edges, side_of_face};
pub(super) use rigid::{
    decide_turning_edges, decide_turning_face, normal_of_turning_edges, normal_of_turning_face,
    passage_of_turning_edges, passage_of_turning_face,
};
use scaled::Scaled;
pub(super) use thick::{
    are_always_parallel, are_near, compare_distance_of_edges, compare_distance_of_face,
    contact_of_parallel_edges, decide_thick_edges, decide_thick_face, near_start_of_parallel_edges,
    normal_of_edges_exactly, normal_of_face_exactly, perpendicular_of_edges,
};
use time::Time;
use unlimited::{Boxed, Unlimited};
use width::{Fixed, Number, Width};

/// The largest error of the place of a [`Hit`] of this stage, 2^-50.
pub(super) const PLACE_ERROR: f64 = 4.0 * f64::EPSILON;

/// The first contact of two edges.
pub(super) fn decide_edges(positions: &Positions) -> Option<Hit<EdgePlace>> {
    answer(EdgesTouch, positions)
}

/// The case of the motion of two edges.
pub(super) fn case_of_edges(positions: &Positions) -> Case {
    answer(EdgesCase, positions)
}

/// What is asked of the motion of four points.
trait Question {
    type Answer;

    fn answer<L: Width>(self, motion: Motion<L>) -> Self::Answer;
}

/// The answer in the narrowest integers that the coordinates allow.
fn answer<Q: Question>(question: Q, positions: &Positions) -> Q::Answer {
    match Scaled::new(positions) {
        Scaled::Short { values, bits } => {
            let component = |i: usize| values[i];
            if bits <= Tiny::BITS {
                answer_in::<Q, Tiny, _>(question, component)
            } else if bits <= Small::BITS {
                answer_in::<Q, Small, _>(question, component)
            } else if bits <= Medium::BITS {
                answer_in::<Q, Medium, _>(question, component)
            } else {
                answer_in::<Q, Large, _>(question, component)
            }
        }
        Scaled::Narrow { values, bits } => {
            let component = |i: usize| values[i];
            if bits <= Large::BITS {
                answer_in::<Q, Large, _>(question, component)
            } else if bits <= Huge::BITS {
                answer_in::<Q, Huge, _>(question, component)
            } else {
                answer_in::<Q, Unlimited, _>(question, component)
            }
        }
        Scaled::Broad(values) => {
            answer_in::<Q, Unlimited, _>(question, |i| Boxed::from(&values[i]))
        }
    }
}

/// The answer in one width, from the components of the motion. A function by itself, so that the
/// stack holds a motion of this width alone.
#[inline(never)]
fn answer_in<Q: Question, L: Width<Linear: From<T>>, T>(
    question: Q,
    component: impl Fn(usize) -> T,
) -> Q::Answer {
    question.answer(Motion::<L>::new(|i| component(i).into()))
}

type Tiny = Fixed<1, 1, 2, 5, 8>;
type Small = Fixed<1, 2, 2, 6, 8>;
type Medium = Fixed<1, 2, 3, 6, 9>;
type Large = Fixed<2, 3, 5, 7, 11>;
type Huge = Fixed<2, 4, 6, 8, 12>;

/// The differences in one word each fit into all widths from the large ones on.
const _: () = assert!(Large::BITS >= 63);

/// Whether and when two edges touch.
struct EdgesTouch;

impl Question for EdgesTouch {
    type Answer = Option<Hit<EdgePlace>>;

    fn answer<L: Width>(self, motion: Motion<L>) -> Self::Answer {
        if motion.is_confined() {
            motion.decide_confined()
        } else {
            motion.decide_general()
        }
    }
}

/// How two edges move.
struct EdgesCase;

impl Question for EdgesCase {
    type Answer = Case;

    fn answer<L: Width>(self, motion: Motion<L>) -> Case {
        motion.case()
    }
}

impl<L: Width> Motion<L> {
    /// Whether `f` is identically 0.
    fn is_confined(&self) -> bool {
        self.f.iter().all(Number::is_zero)
    }

    /// The case of the motion.
    fn case(&self) -> Case {
        if self.is_confined() {
            self.confined_case()
        } else {
            Case::General
        }
    }

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

/// The contact of two edges at a time.
fn edge_hit<L: Width>(
    time: &Time<L>,
    locus: &Locus<L>,
    kind: ContactKind,
    side: Ordering,
    case: Case,
) -> Hit<EdgePlace> {
    let point = |place: &Place<L>| EdgePoint {
        u: place.u.value(time),
        v: place.v.value(time),
    };
    Hit {
        toi: time.below,
        toi_above: time.above,
        kind,
        side: side as i8,
        case,
        flags: locus.flags,
        place: EdgePlace {
            first: point(&locus.first),
            second: locus.second.as_ref().map(point),
            error: PLACE_ERROR,
        },
    }
}
