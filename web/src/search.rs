//! Queries on which a method fails, and smaller ones. Both in parts, so that a page can show how far
//! it is and stop.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tunnelproof::query::Query;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::generate::{FAMILIES, Family};
use tunnelproof_reference::oracle::decide_query;
use tunnelproof_reference::shrink::{Complexity, Disagreement, shrink};
use tunnelproof_reference::subject::Subject;

use crate::ask::{AskError, entry, object};

/// A part of a search: so many queries, taken from the families by turns.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Search {
    families: Vec<String>,
    seed: u64,
    /// The number of the first query.
    start: u64,
    count: u64,
    fault: String,
}

/// A part of a search for a smaller query.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Shrink {
    query: Value,
    fault: String,
    /// How often the method is asked at most.
    calls: u64,
}

/// A query on which the method fails.
#[derive(Serialize)]
pub(crate) struct Found {
    /// The query, with an `id` that names it.
    query: Value,
    /// How it fails.
    fault: &'static str,
    /// How many queries were asked about.
    asked: u64,
    /// The size of the query.
    bits: u64,
    /// Whether there is no smaller query that steps lead to.
    is_minimal: bool,
}

impl Search {
    /// The first of these queries that the method fails on in this way.
    pub(crate) fn run(&self, method: &dyn Subject) -> Result<Option<Found>, AskError> {
        let fault = fault_named(&self.fault)?;
        let families = self.families.iter().map(|name| family_named(name));
        let families = families.collect::<Result<Vec<_>, _>>()?;
        let turns = families.len().max(1) as u64;
        let disagreement = Disagreement::with_oracle(method);
        for number in self.start..self.start.saturating_add(self.count) {
            let Some(family) = families.get((number % turns) as usize) else {
                break;
            };
            let index = number / turns;
            let query = family.query(self.seed, index);
            if disagreement.fault(&query) == Ok(Some(fault)) {
                let id = format!("{}:{}:{index}", family.name(), self.seed);
                let found = Found::new(&id, &query, fault)?;
                let asked = number - self.start + 1;
                return Ok(Some(Found { asked, ..found }));
            }
        }
        Ok(None)
    }
}

impl Shrink {
    /// A smaller query of the same case that the method fails on in the same way; the same one if
    /// there is none. The case is kept because the smallest of all queries is two edges that are
    /// one point, which shows nothing.
    pub(crate) fn run(&self, method: &dyn Subject) -> Result<Option<Found>, AskError> {
        let fault = fault_named(&self.fault)?;
        let entry = entry(&self.query)?;
        let case = decide_query(&entry.query).case;
        let disagreement = Disagreement::with_oracle(method);
        let shrunk = shrink(&entry.query, self.calls, |query| {
            disagreement.fault(query) == Ok(Some(fault)) && decide_query(query).case == case
        });
        Ok(Some(Found {
            asked: shrunk.calls,
            is_minimal: shrunk.is_minimal,
            ..Found::new(&entry.id, &shrunk.query, fault)?
        }))
    }
}

impl Found {
    fn new(id: &str, query: &Query, fault: Fault) -> Result<Self, AskError> {
        Ok(Found {
            query: object(id, query)?,
            fault: fault.name(),
            asked: 0,
            bits: Complexity::of(query).bits(),
            is_minimal: false,
        })
    }
}

fn fault_named(name: &str) -> Result<Fault, AskError> {
    let mut faults = Fault::ALL.iter().copied();
    let found = faults.find(|fault| fault.name() == name);
    found.ok_or_else(|| AskError::Fault(name.to_owned()))
}

fn family_named(name: &str) -> Result<&'static Family, AskError> {
    let found = FAMILIES.iter().find(|family| family.name() == name);
    found.ok_or_else(|| AskError::Family(name.to_owned()))
}
