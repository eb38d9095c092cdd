//! The cases of thesis section 4.1 as queries, named `figure:4.1` to `figure:4.12`.

use crate::figures::{FIGURES, Figure};
use tunnelproof::query::Query;

use super::Entry;

const PREFIX: &str = "figure:";

/// Every figure, labelled with whether its caption states a contact.
pub fn entries() -> impl Iterator<Item = Entry> {
    FIGURES.iter().map(entry)
}

/// The name of the figure that an identifier has the form of; there need not be one.
pub(super) fn name_in(identifier: &str) -> Option<&str> {
    identifier.strip_prefix(PREFIX)
}

/// The figure of this name, if any.
pub(super) fn by_name(name: &str) -> Option<Entry> {
    Figure::from_name(name).map(entry)
}

fn entry(figure: &Figure) -> Entry {
    Entry {
        id: format!("{PREFIX}{}", figure.name),
        query: Query::EdgeEdge(figure.query()),
        label: Some(figure.contact.is_some()),
        line: None,
    }
}
