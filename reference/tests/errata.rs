//! The witnesses in `docs/errata.md` show what the page says, and every erratum has its section.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use serde_json::Value;
use tunnelproof::query::Query;
use tunnelproof::thesis::text::ErratumKind;
use tunnelproof::thesis::{Erratum, Options, Repairs, Thesis};
use tunnelproof_reference::corpus::{self, Format, ReadOptions};
use tunnelproof_reference::oracle::decide_query;
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS};
use tunnelproof_reference::subject::{Answer, Engine, Subject};

fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/errata.md");
    fs::read_to_string(path).expect("the page is there")
}

/// A line of JSON in the page.
struct Witness {
    id: String,
    erratum: Erratum,
    query: Query,
    right: Option<f64>,
    unrepaired: Option<f64>,
    /// Whether exact arithmetic shows it, else the default `f64` path.
    is_exact: bool,
}

impl Witness {
    fn new(line: &str) -> Self {
        let fields = &serde_json::from_str::<Value>(line).expect(line)["note"];
        let time = |field: &str| match &fields[field] {
            Value::Null if fields.get(field).is_some() => None,
            value => Some(value.as_f64().expect(field)),
        };
        let lines = Cursor::new(line.to_owned());
        let mut entries =
            corpus::read(lines, "page", Some(Format::Jsonl), ReadOptions::default()).expect(line);
        let entry = entries.next().expect(line).expect(line);
        let name = entry.id.split('/').next().unwrap_or_default();
        let by = fields["by"].as_str();
        assert!(matches!(by, Some("shadow" | "f64")), "{line}");
        Witness {
            erratum: Erratum::from_name(name).expect(name),
            right: time("right"),
            unrepaired: time("unrepaired"),
            is_exact: by == Some("shadow"),
            query: entry.query,
            id: entry.id,
        }
    }

    /// The time of impact with or without the erratum repaired; an exact one rounded down.
    fn toi(&self, is_repaired: bool) -> Option<f64> {
        let leave = |all: Repairs| {
            if is_repaired {
                all
            } else {
                all.without(self.erratum)
            }
        };
        let answer = if self.is_exact {
            Shadow::new(leave(Repairs::ALL)).answer(&self.query)
        } else {
            let options = Options {
                repairs: leave(Repairs::SLIPS),
                ..Options::default()
            };
            Engine(Thesis { options }).answer(&self.query)
        };
        match answer.expect(&self.id) {
            Answer::Exact(answer) => answer.hit.map(|hit| hit.toi.below),
            Answer::Engine(report) => report.verdict.contact().map(|contact| contact.toi),
            Answer::Certified(_) | Answer::Said(_) => {
                unreachable!("neither the shadow nor the thesis path")
            }
        }
    }
}

#[test]
fn errata_witnesses_show_what_the_page_says() {
    let page = page();
    let lines = page.lines().filter(|line| line.starts_with('{'));
    let witnesses: Vec<Witness> = lines.map(Witness::new).collect();
    for witness in &witnesses {
        let id = &witness.id;
        let truth = decide_query(&witness.query);
        assert_eq!(truth.hit.map(|hit| hit.toi.below), witness.right, "{id}");
        assert_eq!(witness.toi(true), witness.right, "{id}, repaired");
        assert_eq!(witness.toi(false), witness.unrepaired, "{id}, unrepaired");
        assert_ne!(witness.right, witness.unrepaired, "{id}");
    }
    for erratum in Erratum::ALL {
        let is_shown = witnesses.iter().any(|witness| witness.erratum == erratum);
        assert!(is_shown, "{erratum} has no witness");
    }
}

#[test]
fn errata_witnesses_shrink_to_what_shows_the_same() {
    let page = page();
    let lines = page.lines().filter(|line| line.starts_with('{'));
    for witness in lines.map(Witness::new).filter(|witness| witness.is_exact) {
        let id = &witness.id;
        let subject = Shadow::new(Repairs::ALL.without(witness.erratum));
        let disagreement = Disagreement::with_oracle(&subject);
        let fault = disagreement.fault(&witness.query).unwrap().expect(id);
        let shrunk = disagreement.shrink(&witness.query, fault, MOST_CALLS);
        assert!(shrunk.is_minimal && shrunk.after < shrunk.before, "{id}");
        assert!(shrunk.after.bits() <= 20, "{id}: {}", shrunk.line(id));
        assert_eq!(disagreement.fault(&shrunk.query), Ok(Some(fault)), "{id}");
    }
}

#[test]
fn errata_have_a_section_and_a_row_each() {
    let page = page();
    let (slips, flaws) = page.split_once("\n## Flaws\n").unwrap();
    for erratum in Erratum::ALL {
        let (kind, part) = match erratum.kind() {
            ErratumKind::Slip => ("slip", slips),
            ErratumKind::Flaw => ("flaw", flaws),
        };
        let number = erratum.algorithm();
        let heading = format!("\n### `{erratum}`: Algorithm {number}, ");
        assert!(part.contains(&heading), "{erratum} has no section");
        let is_row = |line: &str| {
            line.starts_with(&format!("| [`{erratum}`]"))
                && line.contains(&format!(" | {number} | {kind} | "))
        };
        assert!(page.lines().any(is_row), "{erratum} has no row");
    }
}
