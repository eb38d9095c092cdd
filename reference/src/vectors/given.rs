//! Queries that are written down elsewhere: the figures of the thesis, the witnesses of its errata.

use std::io::Cursor;

use tunnelproof::scenario::figures::FIGURES;
use tunnelproof::thesis::Erratum;

use super::Source;
use super::flag::Flag;
use super::vector::Described;
use crate::corpus::{self, Entry, Format, ReadOptions, figures};

/// The page with the witnesses, each a line of JSON.
const ERRATA: &str = include_str!("../../../docs/errata.md");

pub(super) fn figures() -> Source {
    let described = |(entry, caption): (Entry, &str)| Described {
        comment: format!(
            "thesis figure {}: {caption}",
            entry.id.replace("figure:", "")
        ),
        id: entry.id,
        flags: vec![Flag::ThesisFigure],
        wire: None,
        query: entry.query,
    };
    let captions = FIGURES.iter().map(|figure| figure.caption);
    Source {
        name: "figures".to_owned(),
        description: "the cases of section 4.1 of the thesis".to_owned(),
        queries: figures::entries().zip(captions).map(described).collect(),
    }
}

pub(super) fn errata() -> Source {
    let witnesses = ERRATA.lines().filter(|line| line.starts_with('{'));
    let witnesses = Cursor::new(witnesses.collect::<Vec<_>>().join("\n"));
    let entries = corpus::read(
        witnesses,
        "docs/errata.md",
        Some(Format::Jsonl),
        ReadOptions::default(),
    );
    let entries = entries.expect("the format is stated");
    Source {
        name: "errata".to_owned(),
        description: "witnesses of the errata of the thesis' text, from docs/errata.md".to_owned(),
        queries: entries
            .map(|entry| witness(entry.expect("the page has a query on each such line")))
            .collect(),
    }
}

fn witness(entry: Entry) -> Described {
    let name = entry.id.split('/').next().unwrap_or_default();
    let erratum = Erratum::from_name(name).expect("a witness is called after its erratum");
    Described {
        comment: format!(
            "witness of the erratum {erratum} of Algorithm {}",
            erratum.algorithm()
        ),
        id: format!("erratum:{}", entry.id),
        flags: vec![Flag::Erratum(erratum)],
        wire: None,
        query: entry.query,
    }
}
