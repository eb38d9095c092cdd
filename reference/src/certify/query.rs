//! A query of any sort, as it is judged.

use std::io::Cursor;

use serde_json::Value;
use tunnelproof::query::{Query, QueryKind, Radius};
use tunnelproof::rigid::{RigidQuery, RigidQueryKind};

use crate::answer::ExactAnswer;
use crate::corpus::jsonl::{self, Numbers};
use crate::corpus::turning::{self, Fields, TurningEntry};
use crate::corpus::{self, CorpusError, Entry, Format, Problem, ReadOptions};
use crate::distance::estimate_gap;
use crate::oracle;

/// What is asked: about linear motion, or about a body that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyQuery {
    /// Each point moves on a straight line.
    Linear(Query),
    /// One side is of a body that turns.
    Turning(RigidQuery),
}

/// The kind of such a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AnyKind {
    /// Of linear motion.
    Linear(QueryKind),
    /// Of bodies that turn.
    Turning(RigidQueryKind),
}

impl AnyKind {
    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            AnyKind::Linear(kind) => kind.name(),
            AnyKind::Turning(kind) => kind.name(),
        }
    }

    /// The kind with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        let linear = QueryKind::from_name(name).map(AnyKind::Linear);
        linear.or_else(|| RigidQueryKind::from_name(name).map(AnyKind::Turning))
    }
}

impl From<Query> for AnyQuery {
    fn from(query: Query) -> Self {
        AnyQuery::Linear(query)
    }
}

impl From<RigidQuery> for AnyQuery {
    fn from(query: RigidQuery) -> Self {
        AnyQuery::Turning(query)
    }
}

impl AnyQuery {
    /// Which kind it is.
    pub fn kind(&self) -> AnyKind {
        match self {
            AnyQuery::Linear(query) => AnyKind::Linear(query.kind()),
            AnyQuery::Turning(query) => AnyKind::Turning(query.kind()),
        }
    }

    /// What it is about, of a body that turns that of the same query of linear motion.
    pub fn shape(&self) -> QueryKind {
        match self {
            AnyQuery::Linear(query) => query.kind(),
            AnyQuery::Turning(query) => query.kind().linear(),
        }
    }

    /// The query, if it is of linear motion.
    pub fn linear(&self) -> Option<&Query> {
        match self {
            AnyQuery::Linear(query) => Some(query),
            AnyQuery::Turning(_) => None,
        }
    }

    /// The query, if it is of a body that turns.
    pub fn turning(&self) -> Option<&RigidQuery> {
        match self {
            AnyQuery::Linear(_) => None,
            AnyQuery::Turning(query) => Some(query),
        }
    }

    /// Whether it is of a body that turns.
    pub fn turns(&self) -> bool {
        matches!(self, AnyQuery::Turning(_))
    }

    /// The distance of a contact.
    pub fn radius(&self) -> Radius {
        match self {
            AnyQuery::Linear(query) => query.radius(),
            AnyQuery::Turning(query) => query.radius(),
        }
    }

    /// The oracle's answer.
    pub fn decide(&self) -> ExactAnswer {
        match self {
            AnyQuery::Linear(query) => oracle::decide_query(query),
            AnyQuery::Turning(query) => oracle::decide_rigid_query(query),
        }
    }

    /// Whether the two come so near, beyond their radius, during the step.
    pub fn comes_within(&self, distance: f64) -> bool {
        match self {
            AnyQuery::Linear(query) => oracle::comes_within(query, distance),
            AnyQuery::Turning(query) => oracle::comes_within(query, distance),
        }
    }

    /// About the least distance during the step, beyond the radius.
    pub fn estimate_gap(&self) -> f64 {
        match self {
            AnyQuery::Linear(query) => estimate_gap(query),
            AnyQuery::Turning(query) => estimate_gap(query),
        }
    }

    /// The gap of a query ([`oracle::least_gap`]), rounded down to about three digits.
    pub fn exact_gap(&self) -> f64 {
        match self {
            AnyQuery::Linear(query) => oracle::least_gap(query).below,
            AnyQuery::Turning(query) => oracle::least_gap(query).below,
        }
    }

    /// The query as a line of JSON that every command reads, without the line end.
    pub fn line(&self, id: &str, numbers: Numbers) -> String {
        match self {
            AnyQuery::Linear(query) => jsonl::write(&Entry::unlabelled(id, *query), numbers),
            AnyQuery::Turning(query) => {
                let entry = TurningEntry {
                    id: id.to_owned(),
                    query: *query,
                    label: None,
                };
                turning::write(&entry, numbers)
            }
        }
    }

    /// The query of a line of JSON, which says itself what it is about.
    ///
    /// # Errors
    ///
    /// What is wrong with it.
    pub fn parse(line: &str) -> Result<Self, String> {
        let kind = serde_json::from_str::<Value>(line).map_err(|error| error.to_string())?;
        let kind = kind["kind"].as_str().unwrap_or_default();
        match AnyKind::from_name(kind) {
            Some(AnyKind::Turning(_)) => turning::parse(line)
                .map(|entry| entry.query.into())
                .map_err(|problem| problem.to_string()),
            _ => linear(line).map_err(|error| error.to_string()),
        }
    }

    /// The word of its kind and all its coordinates, in the order in which they are hashed.
    pub(super) fn fields(&self) -> (&'static str, Vec<f64>) {
        match self {
            AnyQuery::Linear(query) => {
                let points = query.start().iter().chain(query.end());
                let numbers = points.flat_map(|point| <[f64; 3]>::from(*point));
                (self.kind().name(), numbers.collect())
            }
            AnyQuery::Turning(query) => {
                let fields = Fields::of(query);
                let points = fields.points.iter().chain(&fields.local).flatten();
                let numbers = points.chain(fields.poses.iter().flatten());
                (self.kind().name(), numbers.copied().collect())
            }
        }
    }
}

fn linear(line: &str) -> Result<AnyQuery, CorpusError> {
    let reader = Cursor::new(line.to_owned());
    let mut entries = corpus::read(reader, "-", Some(Format::Jsonl), ReadOptions::default())?;
    let none = || CorpusError::new("-", Problem::NotObject);
    let entry = entries.next().ok_or_else(none)??;
    Ok(entry.query.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{by_name, rigid_by_name};

    #[test]
    fn any_query_is_what_it_was_made_of() {
        let linear = by_name("thick_lattice").unwrap().query(1, 3);
        let any = AnyQuery::from(linear);
        assert_eq!(any.decide(), oracle::decide_query(&linear));
        assert_eq!(
            (any.shape(), any.turns(), any.radius()),
            (linear.kind(), false, linear.radius())
        );
        assert_eq!(
            AnyQuery::parse(&any.line("a", Numbers::Hexadecimal)),
            Ok(any)
        );

        let families = ["turning_lattice", "turning_bodies_thick_lattice"];
        for (family, index) in families
            .iter()
            .flat_map(|f| (0..20).map(move |index| (f, index)))
        {
            let rigid = rigid_by_name(family).unwrap().query(1, index);
            let any = AnyQuery::from(rigid);
            assert_eq!(any.decide(), oracle::decide_rigid_query(&rigid));
            assert!(any.turns() && any.comes_within(1e9));
            assert_eq!(any.comes_within(0.0), any.decide().hit.is_some());
            assert_eq!(
                AnyQuery::parse(&any.line("a", Numbers::Hexadecimal)),
                Ok(any)
            );
            let (name, numbers) = any.fields();
            assert_eq!(AnyKind::from_name(name), Some(any.kind()));
            let count = match name {
                "edge-turning-edge" => 32,
                "vertex-turning-face" => 29,
                _ => 40,
            };
            assert_eq!(numbers.len(), count);
        }
    }
}
