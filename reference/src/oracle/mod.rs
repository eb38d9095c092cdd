//! The truth about two moving edges, by a method that knows nothing of the thesis' cases: a
//! one-dimensional cylindrical decomposition.
//!
//! The set of contact times is closed and described by signs of polynomials in `t`, so its first
//! element is 0 or a root of one of them; between neighbouring roots nothing changes. Evaluating
//! the description at every candidate decides the query (`literal` does just that and is the test
//! of what follows). Few candidates are enough:
//!
//! - Edges that touch are coplanar: a contact time is a root of `f = (K x L) . M`. If `f` is not
//!   identically 0, its at most three roots are all the candidates there are (`general`).
//! - If it is, the motion is confined to a plane that may itself turn. Let the first contact be at
//!   `s > 0`. If an end of one edge were not on the other edge at `s`, the lines would meet at an
//!   angle, inside both edges, and by continuity also shortly before `s`. So the candidates are 0
//!   and the times at which an end meets the other edge (`confined`).

use std::cmp::Ordering;

use tunnelproof::contact::{Case, ContactKind, Flags};
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{EdgeEdge, Query};

use crate::algebraic::Algebraic;
use crate::answer::{ExactAnswer, ExactHit};
use crate::field::{self, Integer};
use crate::scaled::Scaled;
use crate::subject::{Answer, Subject};

mod confined;
mod gap;
mod general;
#[cfg(test)]
mod literal;
mod locus;
mod motion;
mod steps;
#[cfg(test)]
mod tests;
mod vector;

pub use gap::{comes_within, estimate_distance, least_distance};
pub use steps::{Event, Step};

use locus::Locus;
use motion::Motion;

/// The oracle as a subject.
pub struct Oracle;

impl Subject for Oracle {
    fn name(&self) -> &str {
        "oracle"
    }

    fn answer(&self, query: &Query) -> Result<Answer, Unsupported> {
        decide_query(query).map(Answer::Exact)
    }
}

/// The exact answer to a query, by the default backend.
///
/// # Errors
///
/// [`Unsupported`] for vertex-face queries and a radius above 0.
pub fn decide_query(query: &Query) -> Result<ExactAnswer, Unsupported> {
    match query {
        Query::EdgeEdge(query) => Ok(decide::<field::Default>(query)?.written()),
        Query::VertexFace(_) => Err(Unsupported::Kind(query.kind())),
    }
}

/// The exact answer to an edge-edge query, its numbers still algebraic.
///
/// # Errors
///
/// [`Unsupported`] for a radius above 0.
pub fn decide<Z: Integer>(query: &EdgeEdge) -> Result<Decision<Z>, Unsupported> {
    if !query.radius().is_zero() {
        return Err(Unsupported::Radius(query.radius()));
    }
    let motion = Motion::new(&Scaled::new(&Query::EdgeEdge(*query)));
    let case = motion.case();
    let hit = if motion.f.is_zero() {
        motion.decide_confined()
    } else {
        motion.decide_general()
    };
    Ok(Decision { motion, case, hit })
}

/// An exact answer, its numbers still algebraic.
pub struct Decision<Z> {
    motion: Motion<Z>,
    case: Case,
    hit: Option<Hit<Z>>,
}

/// The first contact.
struct Hit<Z> {
    toi: Algebraic<Z>,
    locus: Locus<Z>,
    kind: ContactKind,
    crosses: bool,
    side: Ordering,
}

impl<Z: Integer> Decision<Z> {
    /// The case of the motion.
    pub fn case(&self) -> Case {
        self.case
    }

    /// The time of impact; `None` for a miss.
    pub fn toi(&self) -> Option<&Algebraic<Z>> {
        self.hit.as_ref().map(|hit| &hit.toi)
    }

    /// The answer with every number between its neighbours in `f64`.
    pub fn written(&self) -> ExactAnswer {
        ExactAnswer {
            case: self.case,
            hit: self.hit.as_ref().map(|hit| self.written_hit(hit)),
        }
    }

    fn written_hit(&self, hit: &Hit<Z>) -> ExactHit {
        ExactHit {
            toi: hit.toi.enclosure(),
            kind: hit.kind,
            crosses: hit.crosses,
            side: hit.side as i8,
            first: hit.locus.first.parameters(&hit.toi),
            second: hit
                .locus
                .second
                .as_ref()
                .map(|place| place.parameters(&hit.toi)),
            flags: self.flags(&hit.toi),
        }
    }

    fn flags(&self, toi: &Algebraic<Z>) -> Flags {
        let Motion { k, l, n, .. } = &self.motion;
        if self.motion.transversal_axis(toi).is_some() {
            return Flags::default();
        }
        let (first, second) = (k.is_zero_at(toi), l.is_zero_at(toi));
        Flags {
            temporarily_parallel: !first && !second && !n.is_zero(),
            temporarily_point: first && !k.is_zero() || second && !l.is_zero(),
        }
    }
}

/// Whether a time is strictly inside the step.
fn is_inside<Z: Integer>(time: &Algebraic<Z>) -> bool {
    let from_start = crate::poly::Poly::new(vec![Z::zero(), Z::one()]);
    let from_end = crate::poly::Poly::new(vec![Z::from_i64(-1), Z::one()]);
    time.sign_of(&from_start).is_gt() && time.sign_of(&from_end).is_lt()
}
