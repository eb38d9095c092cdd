//! What one subject says of a query, and what it is worth.

use serde::Serialize;
use tunnelproof::contact::Case;
use tunnelproof::narrow::Tolerance;

use crate::answer::{Enclosure, ExactAnswer};
use crate::certify::judged::{Found, Judged};
use crate::certify::query::AnyQuery;
use crate::certify::table;
use crate::certify::tally::Fault;
use crate::report::number;
use crate::subject::Answer;

/// What a subject says of a query.
#[derive(Clone, Debug, Serialize)]
pub struct Statement {
    /// The name of the subject.
    pub name: String,
    /// Whether it takes such queries.
    pub is_asked: bool,
    /// Its time of impact, rounded down; `None` for a miss or no answer.
    pub toi: Option<f64>,
    /// The case that it states, if any.
    pub case: Option<&'static str>,
    /// What it says, in words.
    pub claim: String,
    /// The names of what is wrong, as [`Fault::name`] has them.
    pub faults: Vec<&'static str>,
    /// The verdict, and what else is wrong, in words.
    pub worth: String,
}

impl Statement {
    /// What a subject says of a query with this exact answer.
    pub fn new(judged: &Judged, query: &AnyQuery, truth: &ExactAnswer) -> Self {
        let found = judged.judge(*query, truth);
        let answer = found.answer.as_ref();
        Statement {
            name: judged.subject.name().to_owned(),
            is_asked: found.is_asked,
            toi: answer.and_then(Answer::toi).map(|toi| toi.below),
            case: answer.and_then(Answer::case).map(Case::name),
            claim: claim(&found),
            faults: found.faults.iter().map(|(fault, _)| fault.name()).collect(),
            worth: worth(query, &found, judged.subject.tolerance()),
        }
    }
}

/// What they all say, a line each, below a heading.
pub fn statements(all: &[Statement]) -> String {
    let names: Vec<_> = all.iter().map(|said| table::cut(&said.name)).collect();
    let names_are = widest(names.iter());
    let claims_are = widest(all.iter().map(|said| &said.claim));
    let line = |(said, name): (&Statement, &String)| {
        let Statement { claim, worth, .. } = said;
        format!("  {name:<names_are$} {claim:<claims_are$}  {worth}\n")
    };
    let lines: String = all.iter().zip(&names).map(line).collect();
    format!("What the subjects say\n{lines}")
}

/// How wide a column of these texts is. One that is longer than most are stands out of it.
fn widest<'a>(texts: impl Iterator<Item = &'a String>) -> usize {
    let widths = texts.map(|text| text.chars().count());
    widths.filter(|width| *width <= 60).max().unwrap_or(0)
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
fn worth(query: &AnyQuery, found: &Found, tolerance: Tolerance) -> String {
    if !found.is_asked {
        return "does not take such queries".to_owned();
    }
    let is_verdict = |&(fault, severity)| match fault {
        Fault::WrongCase | Fault::Differs | Fault::Early => false,
        Fault::Late => !tolerance.permits_late(severity),
        _ => true,
    };
    let is_right = !found.faults.iter().any(is_verdict);
    let faults = found.faults.iter().map(|&(fault, severity)| match fault {
        Fault::FalseHit => {
            format!("false hit (gap {} m)", table::short(query.exact_gap()))
        }
        Fault::Late if tolerance.permits_late(severity) => {
            format!("late by {}, as it may be", table::short(severity))
        }
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
