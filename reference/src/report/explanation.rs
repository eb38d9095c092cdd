//! A query explained in text: the points, the case, the polynomial and its roots, the time of
//! impact, and what every subject says.

use std::fmt::Write as _;

use tunnelproof::certified;
use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{EdgeEdge, Query};

use crate::algebraic::Algebraic;
use crate::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use crate::certify::run::{Found, Judged, exact_gap};
use crate::certify::table;
use crate::certify::tally::Fault;
use crate::field::{self, Integer};
use crate::oracle::{Decision, Event, Step, decide};
use crate::scaled::Scaled;
use crate::subject::Answer;

use super::number;

/// The explanation of an edge-edge query with this name, and what these subjects say of it.
///
/// # Errors
///
/// [`Unsupported`] for a query that the oracle does not take.
pub fn explain(title: &str, edges: &EdgeEdge, subjects: &[Judged]) -> Result<String, Unsupported> {
    let query = Query::EdgeEdge(*edges);
    let decision = decide::<field::Default>(edges)?;
    let answer = decision.written();
    let mut text = format!("{title}\n\n");
    points(&mut text, &query);
    case(&mut text, &decision);
    triple_product(&mut text, &decision, &query);
    steps(&mut text, &decision);
    impact(&mut text, &decision, &answer);
    verdicts(&mut text, subjects, &query, &answer);
    Ok(text)
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
}

fn case<Z: Integer>(text: &mut String, decision: &Decision<Z>) {
    let words = match decision.case() {
        Case::General => "none of the special cases",
        Case::Parallel => "directions are parallel for the whole step, on two lines",
        Case::Coplanar => "the four points share a plane for the whole step",
        Case::Collinear => "the four points share a line for the whole step",
        Case::SharedStart => "A and C are the same point for the whole step",
        Case::Degenerate => "an edge is a point for the whole step",
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
    let _ = writeln!(
        text,
        "  with K = B - A, L = D - C, M = C - A, f = (K x L) . M"
    );
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

fn steps<Z: Integer>(text: &mut String, decision: &Decision<Z>) {
    let steps = decision.steps();
    let heading = match (decision.f().is_zero(), steps.is_empty()) {
        (false, true) => "f has no root in [0, 1], so the edges never share a plane.",
        (false, false) => "Roots of f in [0, 1], where the edges share a plane:",
        (true, _) => "f is identically 0. When an end comes onto the other edge's line or ends:",
    };
    let _ = writeln!(text, "\n{heading}");
    for same_time in steps.chunk_by(|a, b| a.time.compare(&b.time).is_eq()) {
        let events = same_time.iter().map(|step| match step.event {
            Event::Start => "start",
            Event::Coplanar => "",
            Event::EndOnLine(end) => ["A", "B", "C", "D"][end % 4],
        });
        let events = events.collect::<Vec<_>>().join(" ");
        let events = if events.is_empty() {
            events
        } else {
            format!("{events}: ")
        };
        let time = exactly(&same_time[0].time);
        let _ = writeln!(text, "  t = {time:<24}  {events}{}", meeting(&same_time[0]));
    }
}

fn meeting<Z>(step: &Step<Z>) -> String {
    match (&step.contact, step.meeting) {
        (Some((first, second)), _) => format!("contact, {}", place(first, second.as_ref())),
        (None, Some([u, v])) => format!("lines meet beyond the edges, u = {u:.6}, v = {v:.6}"),
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

fn impact<Z: Integer>(text: &mut String, decision: &Decision<Z>, answer: &ExactAnswer) {
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
    let _ = writeln!(text, "  kind      {}", kind(&hit));
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
    let mut words = match (hit.kind, hit.crosses) {
        (ContactKind::Crossing, _) => "crossing: the edges swap sides".to_owned(),
        (ContactKind::Graze, true) => "graze, but the edges swap sides later".to_owned(),
        (ContactKind::Graze, false) => "graze: they touch without swapping sides".to_owned(),
    };
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
        None => "no answer".to_owned(),
        Some(Answer::Exact(exact)) => match exact.hit {
            None => format!("miss ({})", exact.case),
            Some(hit) => format!("hit at {} ({})", hit.toi, exact.case),
        },
        Some(Answer::Certified(verdict)) => match verdict {
            certified::Verdict::Miss => "miss".to_owned(),
            certified::Verdict::Hit(hit) => {
                let toi = Enclosure {
                    below: hit.toi,
                    above: hit.toi_above,
                };
                format!("hit at {toi} ({})", hit.case)
            }
        },
        Some(Answer::Engine(report)) => {
            let case = report
                .case
                .map_or(String::new(), |case| format!(" ({case})"));
            match report.verdict.contact() {
                None => format!("miss{case}"),
                Some(contact) => format!("hit at {}{case}", number::short(contact.toi)),
            }
        }
    }
}

/// The verdict, and what else is wrong.
fn worth(query: &Query, found: &Found) -> String {
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
