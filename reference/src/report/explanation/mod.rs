//! A query explained: the case, the polynomial and its roots, the time of impact, and what every
//! subject says. As text it is what `explain` prints; it is serialised for pages.

use serde::Serialize;
use tunnelproof::contact::Case;
use tunnelproof::query::{Query, QueryKind};

use crate::algebraic::Algebraic;
use crate::answer::{ExactHit, Parameters};
use crate::certify::judged::Judged;
use crate::certify::query::AnyQuery;
use crate::field::{self, Integer};
use crate::oracle::{Decision, Event, Step, decide};
use crate::scaled::Scaled;

use super::number;

mod subjects;
mod text;

pub use subjects::{Statement, statements};
pub use text::contact;

/// Everything that is said of a query.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    #[serde(skip)]
    query: Query,
    /// The case of the motion.
    pub case: CaseWords,
    /// The triple product of the four points; `None` if it is identically 0.
    pub f: Option<TripleProduct>,
    /// What the times are.
    pub heading: &'static str,
    /// The times at which contact could begin, in order.
    pub times: Vec<Time>,
    /// The first contact; `None` for a miss.
    pub impact: Option<Impact>,
    /// What the subjects say, in their order.
    pub subjects: Vec<Statement>,
}

/// The case of the motion and what it follows from.
#[derive(Clone, Debug, Serialize)]
pub struct CaseWords {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub words: &'static str,
    /// The vectors that it is decided by.
    pub definitions: &'static str,
    /// What is identically 0.
    pub vanishing: Vec<&'static str>,
    /// What is not.
    pub not_vanishing: Vec<&'static str>,
}

/// `f`, a polynomial of degree at most 3.
#[derive(Clone, Debug, Serialize)]
pub struct TripleProduct {
    /// The coefficients are `2^exponent` times `integers`.
    pub exponent: i64,
    /// Ascending, exact.
    pub integers: Vec<String>,
    /// The coefficients in m^3, rounded.
    pub decimals: Vec<String>,
    /// The coefficients as shares of the largest, rounded: for a chart.
    pub shares: Vec<f64>,
}

/// A time at which contact could begin.
#[derive(Clone, Debug, Serialize)]
pub struct Time {
    /// A fraction if it is short, else digits.
    pub exactly: String,
    /// The `f64` next below.
    pub value: f64,
    /// What happens then.
    pub words: String,
    /// Whether the two touch then.
    pub touches: bool,
}

/// The first contact.
#[derive(Clone, Debug, Serialize)]
pub struct Impact {
    /// The time of impact as a fraction, if it is rational.
    pub fraction: Option<String>,
    /// The polynomial that it is a root of, if it is not.
    pub root_of: Option<String>,
    /// An interval that holds this root alone, if it is irrational.
    pub between: Option<[String; 2]>,
    /// Its digits.
    pub decimals: String,
    /// The `f64` that it is, or those next to it.
    pub in_f64: String,
    /// The `f64` next below it, or it.
    pub below: f64,
    /// Where they touch.
    pub place: String,
    /// The parameters or weights there, rounded, and those of the other end of an overlap.
    pub parameters: Vec<[f64; 2]>,
    /// What touches.
    pub features: [String; 2],
    /// `crossing` or `graze`.
    pub kind: &'static str,
    /// Whether any contact of the step is a crossing.
    pub crosses: bool,
    /// The kind in words.
    pub kind_words: String,
}

impl Explanation {
    /// The explanation of a query, and what these subjects say of it.
    pub fn new(query: &Query, subjects: &[Judged]) -> Self {
        let decision = decide::<field::Default>(query);
        let answer = decision.written();
        let asked = AnyQuery::from(*query);
        let statement = |judged| Statement::new(judged, &asked, &answer);
        Explanation {
            query: *query,
            case: CaseWords::new(&decision, query.kind()),
            f: triple_product(&decision, query),
            heading: heading(&decision, query),
            times: times(&decision, query.kind()),
            impact: impact(&decision, answer.hit, query),
            subjects: subjects.iter().map(statement).collect(),
        }
    }
}

impl CaseWords {
    fn new<Z: Integer>(decision: &Decision<Z>, kind: QueryKind) -> Self {
        let definitions = match kind {
            QueryKind::EdgeEdge => "K = B - A, L = D - C, M = C - A, f = (K x L) . M",
            QueryKind::VertexFace => "w = A - B, E1 = C - B, E2 = D - B, f = (E1 x E2) . w",
        };
        let named = |is_zero: bool| {
            let all = decision.vanishing().into_iter();
            let chosen = all.filter(|(_, zero)| *zero == is_zero);
            chosen.map(|(name, _)| name).collect()
        };
        CaseWords {
            name: decision.case().name(),
            words: case_words(decision.case(), kind),
            definitions,
            vanishing: named(true),
            not_vanishing: named(false),
        }
    }
}

/// What a case means, also where sides turn: then the kind is that of the same query of linear motion.
pub fn case_words(case: Case, kind: QueryKind) -> &'static str {
    match (case, kind) {
        (Case::General, _) => "none of the special cases",
        (Case::Parallel, _) => "directions are parallel for the whole step, on two lines",
        (Case::Coplanar, _) => "the four points share a plane for the whole step",
        (Case::Collinear, _) => "the four points share a line for the whole step",
        (Case::SharedStart, _) => "A and C are the same point for the whole step",
        (Case::Degenerate, QueryKind::EdgeEdge) => "an edge is a point for the whole step",
        (Case::Degenerate, QueryKind::VertexFace) => "the face has no area for the whole step",
    }
}

fn triple_product<Z: Integer>(decision: &Decision<Z>, query: &Query) -> Option<TripleProduct> {
    let f = decision.f();
    if f.is_zero() {
        return None;
    }
    let shift = f.content().trailing_zeros();
    let exponent = 3 * Scaled::<Z>::new(query).exponent;
    let coefficients = f.coefficients();
    let sizes: Vec<_> = coefficients.iter().map(Z::approximate).collect();
    let largest = sizes.iter().filter(|(mantissa, _)| *mantissa != 0.0);
    let largest = largest.map(|(_, own)| *own).max().unwrap_or(0);
    let share = |&(mantissa, own): &(f64, i64)| {
        let below = i32::try_from(own - largest).unwrap_or(i32::MIN).max(-1000);
        mantissa * 2f64.powi(below - 64)
    };
    Some(TripleProduct {
        exponent: exponent + shift as i64,
        integers: (coefficients.iter())
            .map(|c| c.shr_floor(shift).to_string())
            .collect(),
        decimals: (coefficients.iter())
            .map(|c| number::scaled(c, exponent))
            .collect(),
        shares: sizes.iter().map(share).collect(),
    })
}

fn heading<Z: Integer>(decision: &Decision<Z>, query: &Query) -> &'static str {
    let is_thick = !query.radius().is_zero();
    match (
        is_thick,
        decision.f().is_zero(),
        decision.steps().is_empty(),
    ) {
        (true, _, true) => "The distance is never the radius.",
        (true, _, false) => "When nearest points of two features are as far apart as the radius:",
        (false, false, true) => "f has no root in [0, 1], so the points never share a plane.",
        (false, false, false) => "Roots of f in [0, 1], where the points share a plane:",
        (false, true, _) => match query.kind() {
            QueryKind::EdgeEdge => {
                "f is identically 0. When an end comes onto the other edge's line or ends:"
            }
            QueryKind::VertexFace => {
                "f is identically 0. When A comes onto the line or the ends of an edge of the face:"
            }
        },
    }
}

fn times<Z: Integer>(decision: &Decision<Z>, kind: QueryKind) -> Vec<Time> {
    let steps = decision.steps();
    let same_times = steps.chunk_by(|a, b| a.time.compare(&b.time).is_eq());
    let time = |same_time: &[Step<Z>]| {
        let events = same_time.iter().filter_map(|step| match step.event {
            Event::Start => Some("start"),
            Event::Coplanar | Event::AtRadius => None,
            Event::EndOnLine(end) => Some(event_name(kind, end)),
        });
        let events = events.collect::<Vec<_>>().join(" ");
        let events = match events.is_empty() {
            true => events,
            false => format!("{events}: "),
        };
        let first = &same_time[0];
        Time {
            exactly: exactly(&first.time),
            value: first.time.enclosure().below,
            words: format!("{events}{}", meeting(first, kind)),
            touches: first.contact.is_some(),
        }
    };
    same_times.map(time).collect()
}

/// What comes onto a line: an end of an edge; of a vertex and a face, the vertex onto this edge.
fn event_name(kind: QueryKind, index: usize) -> &'static str {
    match kind {
        QueryKind::EdgeEdge => ["A", "B", "C", "D"][index % 4],
        QueryKind::VertexFace => ["BC", "CD", "BD"][index % 3],
    }
}

fn meeting<Z>(step: &Step<Z>, kind: QueryKind) -> String {
    let beyond = match kind {
        QueryKind::EdgeEdge => "lines meet beyond the edges",
        QueryKind::VertexFace => "A is beyond the edges",
    };
    match (&step.contact, step.meeting) {
        (Some((first, second)), _) => format!("contact, {}", place(first, second.as_ref())),
        (None, Some([u, v])) => format!("{beyond}, u = {u:.6}, v = {v:.6}"),
        (None, None) => "no contact".to_owned(),
    }
}

fn place(first: &Parameters, second: Option<&Parameters>) -> String {
    let one = |at: &Parameters| format!("u = {}, v = {}", at.u, at.v);
    match second {
        None => one(first),
        Some(second) => format!("overlap from {} to {}", one(first), one(second)),
    }
}

/// A fraction if it is rational and not too long, else digits.
fn exactly<Z: Integer>(number: &Algebraic<Z>) -> String {
    let fraction = number.rational().map(|value| number::fraction(&value));
    match fraction {
        Some(text) if text.len() <= 24 => text,
        _ => number::decimal(number),
    }
}

fn impact<Z: Integer>(
    decision: &Decision<Z>,
    hit: Option<ExactHit>,
    query: &Query,
) -> Option<Impact> {
    let (toi, hit) = (decision.toi()?, hit?);
    let rational = toi.rational();
    let is_irrational = rational.is_none();
    let parameters = std::iter::once(hit.first).chain(hit.second);
    Some(Impact {
        fraction: rational.map(|value| number::fraction(&value)),
        root_of: is_irrational.then(|| defining(toi, decision)),
        between: is_irrational.then(|| number::isolating(toi)),
        decimals: number::decimal(toi),
        in_f64: hit.toi.to_string(),
        below: hit.toi.below,
        place: place(&hit.first, hit.second.as_ref()),
        parameters: parameters.map(|at| [at.u.below, at.v.below]).collect(),
        features: hit.features.map(|feature| feature.to_string()),
        kind: hit.kind.name(),
        crosses: hit.crosses,
        kind_words: text::kind(&hit, !query.radius().is_zero()),
    })
}

/// The polynomial that the time of impact is a root of.
fn defining<Z: Integer>(toi: &Algebraic<Z>, decision: &Decision<Z>) -> String {
    let poly = toi.poly().primitive_part();
    match poly == decision.f().primitive_part() {
        true => "f".to_owned(),
        false => number::polynomial(&poly),
    }
}
