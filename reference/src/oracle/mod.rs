//! The truth about two moving edges, or a moving vertex and a moving face, by a method that knows
//! nothing of the thesis' cases: a one-dimensional cylindrical decomposition.
//!
//! The set of contact times is closed and described by signs of polynomials in `t`, so its first
//! element is 0 or a root of one of them; between neighbouring roots nothing changes. Evaluating
//! the description at every candidate decides the query (`literal` does just that and is the test
//! of what follows). Few candidates are enough. Without radius:
//!
//! - What touches is coplanar: a contact time is a root of `f`, the triple product of the four points.
//!   If it is not identically 0, its at most three roots are all the candidates there are (`general`).
//! - If it is, the motion is confined to a plane that may itself turn. Let the first contact be at
//!   `s > 0`. If no vertex were on an edge of the other side at `s`, the lines of two edges would meet
//!   at an angle, inside both, or the vertex would be strictly inside the face, and by continuity also
//!   shortly before `s`. So the candidates are 0 and the times at which a vertex meets an edge
//!   (`confined`).
//!
//! With a radius, the candidates are the times at which two features have that distance
//! (`proximity`).

use std::cmp::Ordering;

use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof::rigid::RigidQuery;

use crate::algebraic::Algebraic;
use crate::answer::{ExactAnswer, ExactHit};
use crate::field::{self, Integer};
use crate::scaled::Scaled;
use crate::subject::{Answer, NoAnswer, Subject};

mod beside;
mod confined;
mod edges;
mod face;
mod gap;
mod general;
#[cfg(test)]
mod literal;
mod locus;
mod motion;
mod pair;
mod proximity;
mod rigid;
mod steps;
#[cfg(test)]
mod tests;
mod vector;

pub use beside::passages_beside;
pub use gap::{Measured, comes_within, least_gap, least_gap_to};
pub use rigid::{decide_rigid, decide_rigid_query};
pub use steps::{Event, Step};

use confined::decide_confined;
use edges::Edges;
use face::Face;
use general::{decide_general, passages, signs_around};
use locus::Locus;
use motion::Motion;
use proximity::Proximity;

/// The oracle as a subject.
pub struct Oracle;

impl Subject for Oracle {
    fn name(&self) -> &str {
        "oracle"
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(decide_query(query)))
    }

    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(decide_rigid_query(query)))
    }
}

/// The exact answer to a query, by the default backend.
pub fn decide_query(query: &Query) -> ExactAnswer {
    decide::<field::Default>(query).written()
}

/// How often two edges pass through each other: +1 for each contact at which `f = (K x L) . M` rises, -1 for each at
/// which it falls. `None` if a contact is not inside both edges and the step, or `f` is identically 0: then
/// [`passages_beside`] has to say where they are moved aside.
pub fn passages_inside(query: &EdgeEdge) -> Option<i64> {
    let query = Query::EdgeEdge(*query);
    let motion = motion_of(&query, &Scaled::<field::Default>::new(&query));
    match motion.f().is_zero() {
        true => None,
        false => passages(&*motion),
    }
}

/// The exact answer to a query, its numbers still algebraic.
pub fn decide<Z: Integer>(query: &Query) -> Decision<Z> {
    let points = Scaled::new(query);
    let motion = motion_of(query, &points);
    let radius = query.radius();
    let near = (!radius.is_zero()).then(|| {
        let proximity = Proximity::new(&*motion, points.exponent);
        Near {
            proximity,
            radius: radius.parts(),
        }
    });
    Decision::of(motion, near)
}

fn motion_of<Z: Integer>(query: &Query, points: &Scaled<Z>) -> Box<dyn Motion<Z>> {
    match query {
        Query::EdgeEdge(_) => Box::new(Edges::new(points)),
        Query::VertexFace(_) => Box::new(Face::new(points)),
    }
}

/// The first contact without radius.
fn decide_contact<Z: Integer>(motion: &dyn Motion<Z>) -> Option<Hit<Z>> {
    match motion.f().is_zero() {
        true => decide_confined(motion),
        false => decide_general(motion),
    }
}

/// What is asked with a radius above 0.
struct Near<Z> {
    proximity: Proximity<Z>,
    /// The two numbers in metres whose sum it is.
    radius: [f64; 2],
}

impl<Z: Integer> Near<Z> {
    /// The first contact, in the sense of [`crate::answer`].
    fn decide(&self, motion: &dyn Motion<Z>) -> Option<Hit<Z>> {
        let toi = self.proximity.first_within(&self.radius)?;
        let crosses = decide_contact(motion).is_some_and(|hit| hit.crosses);
        let f = motion.f();
        let side = match toi.sign_of(f) {
            _ if toi.is_zero() || f.is_zero() => Ordering::Equal,
            Ordering::Equal => signs_around(f, &toi).0,
            side => side,
        };
        Some(Hit {
            kind: kind(crosses),
            crosses,
            side,
            locus: self.proximity.nearest(motion, &toi),
            toi,
        })
    }
}

/// An exact answer, its numbers still algebraic.
pub struct Decision<Z> {
    motion: Box<dyn Motion<Z>>,
    /// For a radius above 0.
    near: Option<Near<Z>>,
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
    /// The answer to what is asked of a motion.
    fn of(motion: Box<dyn Motion<Z>>, near: Option<Near<Z>>) -> Self {
        let hit = match &near {
            None => decide_contact(&*motion),
            Some(near) => near.decide(&*motion),
        };
        Decision { motion, near, hit }
    }

    /// The case of the motion.
    pub fn case(&self) -> Case {
        self.motion.case()
    }

    /// The time of impact; `None` for a miss.
    pub fn toi(&self) -> Option<&Algebraic<Z>> {
        self.hit.as_ref().map(|hit| &hit.toi)
    }

    /// The answer with every number between its neighbours in `f64`.
    pub fn written(&self) -> ExactAnswer {
        ExactAnswer {
            case: self.case(),
            hit: self.hit.as_ref().map(|hit| self.written_hit(hit)),
        }
    }

    fn written_hit(&self, hit: &Hit<Z>) -> ExactHit {
        let Locus { first, second, .. } = &hit.locus;
        let parameters = first.parameters(&hit.toi);
        ExactHit {
            toi: hit.toi.enclosure(),
            kind: hit.kind,
            crosses: hit.crosses,
            side: hit.side as i8,
            features: first.features(&parameters),
            first: parameters,
            second: second.as_ref().map(|place| place.parameters(&hit.toi)),
            flags: self.motion.flags(&hit.toi),
        }
    }
}

fn kind(crosses: bool) -> ContactKind {
    match crosses {
        true => ContactKind::Crossing,
        false => ContactKind::Graze,
    }
}

/// Whether a time is strictly inside the step.
fn is_inside<Z: Integer>(time: &Algebraic<Z>) -> bool {
    let from_start = crate::poly::Poly::new(vec![Z::zero(), Z::one()]);
    let from_end = crate::poly::Poly::new(vec![Z::from_i64(-1), Z::one()]);
    time.sign_of(&from_start).is_gt() && time.sign_of(&from_end).is_lt()
}
