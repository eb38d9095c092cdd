//! How often each erratum of the thesis changes an answer: the tables of `docs/errata.md`.
//!
//! ```text
//! cargo run --release -p tunnelproof-reference --example errata [FAMILY [COUNT [SEED]]]
//! ```
//!
//! The truth is the oracle's. The first table is the shadow's, so that every error in it is one of
//! the text and none of rounding; the second one is that of the thesis path in `f64`.

use std::env;
use std::error::Error;
use std::process::ExitCode;

use tunnelproof::contact::Case;
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof::thesis::{Erratum, Options, Repairs, Residual, Thesis};
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::generate::{self, Family};
use tunnelproof_reference::oracle::{comes_within, decide_query};
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::subject::{Answer, Engine, Subject};

/// Answers that differ from the truth.
#[derive(Default)]
struct Tally {
    /// Contacts that are not reported.
    missed: u64,
    /// Those of the missed that include a crossing.
    tunnels: u64,
    /// Hits where the edges do not come within the distance that the subject declares.
    false_hits: u64,
    /// Hits without contact within that distance.
    near_hits: u64,
    /// Contacts with another time of impact; of exact subjects only.
    other_time: u64,
    /// Those of all of these in which both edges have length.
    with_length: u64,
}

impl Tally {
    fn add(&mut self, query: &EdgeEdge, truth: &ExactAnswer, answer: &Answer, distance: f64) {
        let reported = match answer {
            Answer::Exact(exact) => exact.hit.is_some(),
            Answer::Engine(report) => report.verdict.is_hit(),
            Answer::Certified(_) | Answer::Said(_) => {
                unreachable!("neither the shadow nor the thesis path")
            }
        };
        match (&truth.hit, reported) {
            (None, false) => return,
            (Some(hit), false) => {
                self.missed += 1;
                self.tunnels += u64::from(hit.crosses);
            }
            (None, true) if distance > 0.0 && comes_within(&Query::EdgeEdge(*query), distance) => {
                self.near_hits += 1
            }
            (None, true) => self.false_hits += 1,
            (Some(hit), true) => match answer {
                Answer::Exact(ExactAnswer {
                    hit: Some(other), ..
                }) if other.toi != hit.toi => self.other_time += 1,
                _ => return,
            },
        }
        self.with_length += u64::from(truth.case != Case::Degenerate);
    }
}

/// A subject and the name of its row.
type Row = (String, Box<dyn Subject>);

/// The text to the letter, as it was meant, and repaired; then with one erratum left in it each.
fn exact_rows() -> Vec<Row> {
    let row = |name: &str, repairs| -> Row { (name.to_owned(), Box::new(Shadow::new(repairs))) };
    let mut rows = vec![
        row("published", Repairs::NONE),
        row("slips repaired", Repairs::SLIPS),
        row("all repaired", Repairs::ALL),
    ];
    let only = |erratum: Erratum| row(erratum.name(), Repairs::ALL.without(erratum));
    rows.extend(Erratum::ALL.map(only));
    rows
}

/// The default, and what differs from it in one place each.
fn f64_rows() -> Vec<Row> {
    let row = |name: String, options| -> Row { (name, Box::new(Engine(Thesis { options }))) };
    let default = Options::default();
    let with = |repairs| Options { repairs, ..default };
    let mut rows = vec![row("default".to_owned(), default)];
    for erratum in Erratum::ALL {
        rows.push(if Repairs::SLIPS.contains(erratum) {
            let repairs = Repairs::SLIPS.without(erratum);
            row(format!("without {erratum}"), with(repairs))
        } else {
            let repairs = Repairs::SLIPS.with(erratum);
            row(format!("with {erratum}"), with(repairs))
        });
    }
    let residual = Residual::All;
    let three = Options {
        residual,
        ..default
    };
    rows.push(row("all three equations".to_owned(), three));
    rows
}

fn print(title: &str, rows: &[Row], tallies: &[Tally]) {
    println!(
        "\n| {title} | missed | tunnels | false hits | near hits | other time | with length |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: |");
    for ((name, _), tally) in rows.iter().zip(tallies) {
        let Tally {
            missed,
            tunnels,
            false_hits,
            near_hits,
            other_time,
            with_length,
        } = tally;
        println!(
            "| {name} | {missed} | {tunnels} | {false_hits} | {near_hits} | {other_time} | \
             {with_length} |"
        );
    }
}

fn run(family: &Family, count: u64, seed: u64) -> Result<(), Box<dyn Error>> {
    let tables = [("exact", exact_rows()), ("f64", f64_rows())];
    let mut tallies = tables
        .each_ref()
        .map(|(_, rows)| rows.iter().map(|_| Tally::default()).collect::<Vec<_>>());
    let (mut hits, mut with_length) = (0_u64, 0_u64);
    for index in 0..count {
        let query = family.query(seed, index);
        let Query::EdgeEdge(edges) = &query else {
            continue;
        };
        let truth = decide_query(&query);
        hits += u64::from(truth.hit.is_some());
        with_length += u64::from(truth.case != Case::Degenerate);
        for ((_, rows), tallies) in tables.iter().zip(&mut tallies) {
            for ((_, subject), tally) in rows.iter().zip(tallies) {
                let answer = subject.answer(&query)?;
                tally.add(edges, &truth, &answer, subject.tolerance().near);
            }
        }
    }
    let name = family.name();
    println!(
        "{count} queries of `{name}`, seed {seed}: {hits} hits; in {with_length} both edges have \
         length."
    );
    for ((title, rows), tallies) in tables.iter().zip(&tallies) {
        print(title, rows, tallies);
    }
    Ok(())
}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let argument = |index: usize, default: &str| {
        arguments
            .get(index)
            .map_or(default, String::as_str)
            .to_owned()
    };
    let family = generate::by_name(&argument(0, "lattice"));
    let (count, seed) = (
        argument(1, "200000").parse().ok(),
        argument(2, "1").parse().ok(),
    );
    let (Some(family), Some(count), Some(seed)) = (family, count, seed) else {
        eprintln!("arguments: FAMILY COUNT SEED, by default lattice 200000 1");
        return ExitCode::from(2);
    };
    match run(family, count, seed) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
