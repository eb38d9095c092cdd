//! What one subject says of a query, and what it is worth.

use serde::Serialize;
use tunnelproof::contact::Case;

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
        let (toi, case) = said(found.answer.as_ref());
        Statement {
            name: judged.subject.name().to_owned(),
            is_asked: found.is_asked,
            toi,
            case: case.map(Case::name),
            claim: claim(&found),
            faults: found.faults.iter().map(|(fault, _)| fault.name()).collect(),
            worth: worth(query, &found),
        }
    }
}

/// What they all say, a line each, below a heading.
pub fn statements(all: &[Statement]) -> String {
    let width = all.iter().map(|said| said.claim.len()).max().unwrap_or(0);
    let line = |said: &Statement| {
        let Statement {
            name, claim, worth, ..
        } = said;
        format!("  {name:<17} {claim:<width$}  {worth}\n")
    };
    let lines: String = all.iter().map(line).collect();
    format!("What the subjects say\n{lines}")
}

/// The time of impact and the case of an answer.
fn said(answer: Option<&Answer>) -> (Option<f64>, Option<Case>) {
    match answer {
        None => (None, None),
        Some(Answer::Exact(exact)) => (exact.hit.map(|hit| hit.toi.below), Some(exact.case)),
        Some(Answer::Certified(hit)) => {
            let hit = hit.as_ref();
            (hit.map(|hit| hit.toi), hit.map(|hit| hit.case))
        }
        Some(Answer::Engine(report)) => {
            let contact = report.verdict.contact();
            (contact.map(|contact| contact.toi), report.case)
        }
        Some(Answer::Said(said)) => (said.toi.map(|toi| toi.below), said.case),
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
fn worth(query: &AnyQuery, found: &Found) -> String {
    if !found.is_asked {
        return "does not take such queries".to_owned();
    }
    let is_verdict = |fault| !matches!(fault, Fault::WrongCase | Fault::Differs | Fault::Early);
    let is_right = !found.faults.iter().any(|&(fault, _)| is_verdict(fault));
    let faults = found.faults.iter().map(|&(fault, severity)| match fault {
        Fault::FalseHit => {
            format!("false hit (gap {} m)", table::short(query.exact_gap()))
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
