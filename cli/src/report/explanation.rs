//! A query explained in text: the points, the case, the polynomial and its roots, the time of
//! impact, and what every subject says.

use std::fmt::Write as _;

use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::query::{Query, QueryKind};

use tunnelproof_reference::algebraic::Algebraic;
use tunnelproof_reference::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use tunnelproof_reference::certify::judged::{Found, Judged, exact_gap};
use tunnelproof_reference::certify::table;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::oracle::{Decision, Event, Step, decide};
use tunnelproof_reference::scaled::Scaled;
use tunnelproof_reference::subject::Answer;

use super::number;

/// The explanation of a query with this name, and what these subjects say of it.
pub fn explain(title: &str, query: &Query, subjects: &[Judged]) -> String {
    let decision = decide::<field::Default>(query);
    let answer = decision.written();
    let mut text = format!("{title}\n\n");
    points(&mut text, query);
    case(&mut text, &decision, query.kind());
    triple_product(&mut text, &decision, query);
    steps(&mut text, &decision, query);
    impact(&mut text, &decision, &answer, query);
    verdicts(&mut text, subjects, query, &answer);
    text
}

fn points(text: &mut String, query: &Query) {
    let points = query.start().iter().chain(query.end());
    let rows: Vec<_> = points
        .map(|point| [point.x, point.y, point.z].map(number::short))
        .collect();
    let width = rows.iter().flatten().map(String::len).max().unwrap_or(0);
    for (index, [x, y, z]) in rows.iter().enumerate() {
        let (name, time) = (['A', 'B', 'C', 'D'][index % 4], index / 4);
        let _ = writeln!(
            text,
            "  {name}({time})  {x:>width$}  {y:>width$}  {z:>width$}"
        );
    }
    if !query.radius().is_zero() {
        let _ = writeln!(text, "  radius  {}", query.radius());
    }
}

fn case<Z: Integer>(text: &mut String, decision: &Decision<Z>, kind: QueryKind) {
    let words = match (decision.case(), kind) {
        (Case::General, _) => "none of the special cases",
        (Case::Parallel, _) => "directions are parallel for the whole step, on two lines",
        (Case::Coplanar, _) => "the four points share a plane for the whole step",
        (Case::Collinear, _) => "the four points share a line for the whole step",
        (Case::SharedStart, _) => "A and C are the same point for the whole step",
        (Case::Degenerate, QueryKind::EdgeEdge) => "an edge is a point for the whole step",
        (Case::Degenerate, QueryKind::VertexFace) => "the face has no area for the whole step",
    };
    let named = |is_zero: bool| {
        let chosen = decision
            .vanishing()
            .into_iter()
            .filter(move |(_, zero)| *zero == is_zero);
        let names: Vec<_> = chosen.map(|(name, _)| name).collect();
        if names.is_empty() {
            "none".to_owned()
        } else {
            names.join(", ")
        }
    };
    let _ = writeln!(text, "\nCase: {}: {words}", decision.case());
    let definitions = match kind {
        QueryKind::EdgeEdge => "K = B - A, L = D - C, M = C - A, f = (K x L) . M",
        QueryKind::VertexFace => "w = A - B, E1 = C - B, E2 = D - B, f = (E1 x E2) . w",
    };
    let _ = writeln!(text, "  with {definitions}");
    let _ = writeln!(
        text,
        "  identically 0: {}; not: {}",
        named(true),
        named(false)
    );
}

fn triple_product<Z: Integer>(text: &mut String, decision: &Decision<Z>, query: &Query) {
    let f = decision.f();
    if f.is_zero() {
        return;
    }
    let shift = f.content().trailing_zeros();
    let exponent = 3 * Scaled::<Z>::new(query).exponent;
    let _ = writeln!(text, "\nf(t), exactly 2^{} times:", exponent + shift as i64);
    let integers = f.coefficients().iter();
    let integers: Vec<_> = integers.map(|c| c.shr_floor(shift).to_string()).collect();
    let width = integers.iter().map(String::len).max().unwrap_or(0);
    let powers = ["1", "t", "t^2", "t^3"];
    for ((power, integer), coefficient) in powers.iter().zip(&integers).zip(f.coefficients()) {
        let decimal = number::scaled(coefficient, exponent);
        let _ = writeln!(text, "  {power:<4} {integer:>width$}   in m^3: {decimal}");
    }
}

fn steps<Z: Integer>(text: &mut String, decision: &Decision<Z>, query: &Query) {
    let steps = decision.steps();
    let is_thick = !query.radius().is_zero();
    let heading = match (is_thick, decision.f().is_zero(), steps.is_empty()) {
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
    };
    let _ = writeln!(text, "\n{heading}");
    for same_time in steps.chunk_by(|a, b| a.time.compare(&b.time).is_eq()) {
        let events = same_time.iter().map(|step| match step.event {
            Event::Start => "start",
            Event::Coplanar => "",
            Event::EndOnLine(end) => event_name(query.kind(), end),
            Event::AtRadius => "",
        });
        let events = events.collect::<Vec<_>>().join(" ");
        let events = if events.is_empty() {
            events
        } else {
            format!("{events}: ")
        };
        let time = exactly(&same_time[0].time);
        let meeting = meeting(&same_time[0], query.kind());
        let _ = writeln!(text, "  t = {time:<24}  {events}{meeting}");
    }
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
    text: &mut String,
    decision: &Decision<Z>,
    answer: &ExactAnswer,
    query: &Query,
) {
    let (Some(toi), Some(hit)) = (decision.toi(), answer.hit) else {
        text.push_str("\nNo contact.\n");
        return;
    };
    text.push_str("\nTime of impact\n");
    match toi.rational() {
        Some(value) => {
            let _ = writeln!(text, "  exactly   {}", number::fraction(&value));
        }
        None => {
            let _ = writeln!(
                text,
                "  exactly   irrational, a root of {}",
                defining(toi, decision)
            );
        }
    }
    let _ = writeln!(text, "  decimals  {}", number::decimal(toi));
    let _ = writeln!(text, "  in f64    {}", hit.toi);
    let _ = writeln!(
        text,
        "  contact   {}",
        place(&hit.first, hit.second.as_ref())
    );
    let [first, second] = hit.features;
    let _ = writeln!(text, "  features  {first} and {second}");
    let is_thick = !query.radius().is_zero();
    let kind = if is_thick { thick(&hit) } else { kind(&hit) };
    let _ = writeln!(text, "  kind      {kind}{}", remarks(&hit));
}

/// The polynomial that the time of impact is a root of.
fn defining<Z: Integer>(toi: &Algebraic<Z>, decision: &Decision<Z>) -> String {
    let poly = toi.poly().primitive_part();
    match poly == decision.f().primitive_part() {
        true => "f".to_owned(),
        false => number::polynomial(&poly),
    }
}

fn kind(hit: &ExactHit) -> String {
    let words = match (hit.kind, hit.crosses) {
        (ContactKind::Crossing, _) => "crossing: they swap sides",
        (ContactKind::Graze, true) => "graze, but they swap sides later",
        (ContactKind::Graze, false) => "graze: they touch without swapping sides",
    };
    words.to_owned()
}

/// The kind of a contact at a radius.
fn thick(hit: &ExactHit) -> String {
    let begins = match hit.is_initial() {
        true => "initial overlap",
        false => "contact at the radius",
    };
    let crosses = match hit.crosses {
        true => "crossing: the midlines pass in this step",
        false => "graze: the midlines do not pass in this step",
    };
    format!("{begins}; {crosses}")
}

/// The side they come from and the configuration.
fn remarks(hit: &ExactHit) -> String {
    let mut words = String::new();
    if hit.side != 0 {
        let _ = write!(
            words,
            ", f {} 0 just before",
            if hit.side > 0 { ">" } else { "<" }
        );
    }
    if hit.flags.temporarily_parallel {
        words.push_str(", temporarily parallel");
    }
    if hit.flags.temporarily_point {
        words.push_str(", temporarily a point");
    }
    words
}

fn verdicts(text: &mut String, subjects: &[Judged], query: &Query, truth: &ExactAnswer) {
    let rows = subjects.iter().map(|judged| {
        let found = judged.judge(query, truth);
        (judged.subject.name(), claim(&found), worth(query, &found))
    });
    let rows: Vec<_> = rows.collect();
    let width = rows.iter().map(|row| row.1.len()).max().unwrap_or(0);
    text.push_str("\nWhat the subjects say\n");
    for (name, claim, worth) in rows {
        let _ = writeln!(text, "  {name:<17} {claim:<width$}  {worth}");
    }
}

fn claim(found: &Found) -> String {
    match &found.answer {
        None if !found.is_asked => "not asked".to_owned(),
        None => match &found.lapse {
            Some(lapse) => format!("no answer ({lapse})"),
            None => "no answer".to_owned(),
        },
        Some(Answer::Exact(exact)) => match exact.hit {
            None => format!("miss ({})", exact.case),
            Some(hit) => format!("hit at {} ({})", hit.toi, exact.case),
        },
        Some(Answer::Certified(hit)) => match hit {
            None => "miss".to_owned(),
            Some(hit) => {
                let toi = Enclosure {
                    below: hit.toi,
                    above: hit.toi_above,
                };
                format!("hit at {toi} ({})", hit.case)
            }
        },
        Some(Answer::Engine(report)) => {
            let toi = report.verdict.contact().map(|contact| contact.toi);
            in_words(toi.map(number::short), report.case)
        }
        Some(Answer::Said(said)) => in_words(said.toi.map(|toi| toi.to_string()), said.case),
    }
}

/// A hit at this time, or a miss.
fn in_words(toi: Option<String>, case: Option<Case>) -> String {
    let case = case.map_or(String::new(), |case| format!(" ({case})"));
    match toi {
        None => format!("miss{case}"),
        Some(toi) => format!("hit at {toi}{case}"),
    }
}

/// The verdict, and what else is wrong.
fn worth(query: &Query, found: &Found) -> String {
    if !found.is_asked {
        return "does not take such queries".to_owned();
    }
    let is_verdict = |fault| {
        !matches!(
            fault,
            Fault::WrongCase | Fault::Differs | Fault::Late | Fault::Early
        )
    };
    let is_right = !found.faults.iter().any(|&(fault, _)| is_verdict(fault));
    let faults = found.faults.iter().map(|&(fault, severity)| match fault {
        Fault::FalseHit => format!("false hit (gap {} m)", table::short(exact_gap(query))),
        Fault::Late | Fault::Early => format!("{} by {}", fault.name(), table::short(severity)),
        _ => fault.name().to_owned(),
    });
    let errata = match found.errata.as_slice() {
        [] => None,
        errata => Some(format!("erratum {}", errata.join(" + "))),
    };
    let right = is_right.then(|| "right".to_owned());
    let words: Vec<_> = right.into_iter().chain(faults).chain(errata).collect();
    words.join(", ")
}
