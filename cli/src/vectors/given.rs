//! Queries that are written down elsewhere: the figures of the thesis, the witnesses of its errata.

use std::io::Cursor;

use tunnelproof::query::Query;
use tunnelproof::thesis::{Erratum, Repairs};
use tunnelproof_reference::figures::FIGURES;

use super::Source;
use super::flag::Flag;
use super::vector::Described;
use tunnelproof_reference::corpus::{self, Entry, Format, ReadOptions, figures};
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS};

/// The page with the witnesses, each a line of JSON.
const ERRATA: &str = include_str!("errata.md");

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
        description:
            "witnesses of the errata of the thesis' text, from docs/errata.md, and the smallest \
                      queries that show the same"
                .to_owned(),
        queries: entries
            .flat_map(|entry| with_smallest(entry.expect("the page has a query on each such line")))
            .collect(),
    }
}

/// The witness of the page, and the smallest query that shows the same.
fn with_smallest(entry: Entry) -> impl Iterator<Item = Described> {
    let name = entry.id.split('/').next().unwrap_or_default();
    let erratum = Erratum::from_name(name).expect("a witness is called after its erratum");
    let algorithm = erratum.algorithm();
    let id = format!("erratum:{}", entry.id);
    let described = move |id, comment, query| Described {
        id,
        comment,
        flags: vec![Flag::Erratum(erratum)],
        wire: None,
        query,
    };
    let smallest = smallest(erratum, &entry.query).map(|query| {
        let comment = format!("shrunk from {id}, as long as the erratum {erratum} shows the same");
        described(format!("{id}/shrunk"), comment, query)
    });
    let comment = format!("witness of the erratum {erratum} of Algorithm {algorithm}");
    [described(id, comment, entry.query)]
        .into_iter()
        .chain(smallest)
}

/// The query shrunk as long as the text, all errata but this one repaired, is wrong in the same
/// way; `None` if it is right, since it takes rounding to show this one.
fn smallest(erratum: Erratum, query: &Query) -> Option<Query> {
    let subject = Shadow::new(Repairs::ALL.without(erratum));
    let disagreement = Disagreement::with_oracle(&subject);
    let fault = disagreement.fault(query).ok().flatten()?;
    Some(disagreement.shrink(query, fault, MOST_CALLS).query)
}
