//! What there is to say of a query: the exact answer, and every flag that follows from the query
//! itself.

use std::collections::BTreeSet;

use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::query::{Query, QueryKind};

use super::exact_time::ExactTime;
use super::flag::Flag;
use super::method::Method;
use tunnelproof_reference::algebraic::Algebraic;
use tunnelproof_reference::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use tunnelproof_reference::field;
use tunnelproof_reference::oracle::{Decision, decide};

/// Products of three numbers within this factor of 1 stay in the range of `f64` with all their
/// digits.
const RANGE: f64 = 1e60;

/// The exact answer and what is special about it.
pub(super) struct Assessment {
    pub(super) answer: ExactAnswer,
    /// Whether the query has a radius above 0.
    is_thick: bool,
    /// The time of impact, exactly; `None` for a miss.
    pub(super) time: Option<ExactTime>,
    pub(super) flags: BTreeSet<Flag>,
}

impl Assessment {
    pub(super) fn new(query: &Query) -> Self {
        let decision = decide::<field::Default>(query);
        let answer = decision.written();
        let is_thick = !query.radius().is_zero();
        let time = decision.toi().map(ExactTime::new);
        let is_irrational = time.as_ref().is_some_and(ExactTime::is_irrational);
        let of_motion = [
            (Flag::Motion(answer.case), answer.case != Case::General),
            (Flag::MultipleRoot, !is_thick && is_multiple_root(&decision)),
            (Flag::IrrationalTime, is_irrational),
            (Flag::ExtremeRange, is_extreme(query)),
            (Flag::SumOfRadii, is_sum_of_radii(query)),
        ];
        let failure = |method: Method| Some(Flag::Failure(method.fault(query)?, method));
        let flags = that_are(of_motion)
            .chain(answer.hit.iter().flat_map(|hit| of_contact(hit, query)))
            .chain(Method::ALL.into_iter().filter_map(failure))
            .collect();
        Assessment {
            answer,
            is_thick,
            time,
            flags,
        }
    }

    /// The answer in a few words.
    pub(super) fn summary(&self) -> String {
        let Some(hit) = self.answer.hit else {
            return format!("{} motion, no contact", self.answer.case);
        };
        let when = match hit.toi {
            Enclosure { above: 0.0, .. } => "at the start",
            Enclosure { below: 1.0, .. } => "at the end",
            _ => "inside the step",
        };
        let contact = match (self.is_thick, hit.crosses) {
            (false, _) => hit.kind.name(),
            (true, false) => "contact by the radius",
            (true, true) => "contact of what passes through",
        };
        format!("{} motion, {contact} {when}", self.answer.case)
    }
}

/// Of flags those that are so.
fn that_are<const N: usize>(flags: [(Flag, bool); N]) -> impl Iterator<Item = Flag> {
    let so = flags.into_iter().filter(|(_, is_so)| *is_so);
    so.map(|(flag, _)| flag)
}

fn of_contact(hit: &ExactHit, query: &Query) -> impl Iterator<Item = Flag> + use<> {
    let is = |number: Enclosure, value| number == Enclosure::exactly(value);
    let is_end = |number| is(number, 0.0) || is(number, 1.0);
    let touches_end = |place: &Parameters| is_end(place.u) || is_end(place.v);
    let is_thick = !query.radius().is_zero();
    let is_graze = !is_thick && hit.kind == ContactKind::Graze;
    let (is_edges, [_, of_face]) = (query.kind() == QueryKind::EdgeEdge, hit.features);
    that_are([
        (Flag::ContactAtStart, is(hit.toi, 0.0)),
        (Flag::ContactAtEnd, is(hit.toi, 1.0)),
        (Flag::Graze, is_graze && !is_end(hit.toi)),
        (Flag::LaterCrossing, is_graze && hit.crosses),
        (
            Flag::EndOfEdge,
            is_edges && (touches_end(&hit.first) || hit.second.as_ref().is_some_and(touches_end)),
        ),
        (Flag::BorderOfFace, !is_edges && of_face.corners() < 3),
        (Flag::PassesThrough, is_thick && hit.crosses),
        (Flag::Overlap, hit.second.is_some()),
        (Flag::TemporarilyParallel, hit.flags.temporarily_parallel),
        (Flag::TemporarilyPoint, hit.flags.temporarily_point),
    ])
}

/// Whether the time of impact is a root of the cubic and of its derivative.
fn is_multiple_root(decision: &Decision<field::Default>) -> bool {
    let f = decision.f();
    let at_root = |toi: &Algebraic<_>| toi.sign_of(&f.derivative()).is_eq();
    !f.is_zero() && decision.toi().is_some_and(at_root)
}

fn is_extreme(query: &Query) -> bool {
    let points = query.start().iter().chain(query.end());
    let mut numbers = points.flat_map(|point| point.iter().map(|number| number.abs()));
    numbers.any(|number| number > RANGE || number > 0.0 && number < 1.0 / RANGE)
}

/// Whether the radius is a sum of two numbers that no `f64` is.
fn is_sum_of_radii(query: &Query) -> bool {
    let [a, b] = query.radius().parts();
    let sum = a + b;
    // What is lost by rounding a sum is an f64 (Knuth's two-sum).
    let of_b = sum - a;
    (a - (sum - of_b)) + (b - of_b) != 0.0
}
