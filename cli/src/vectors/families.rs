//! A selection of each family: of every class of queries that occurs the simplest ones, and of
//! every failure of a published method a query that is shrunk.
//!
//! Two queries are of one class if they have the same flags, both hit or both miss, and the same
//! kind of contact. So each case of motion, each place of a contact and each failure that the first
//! queries of a family show is among the vectors.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;
use tunnelproof::query::Query;

use super::Source;
use super::assessment::Assessment;
use super::flag::Flag;
use super::method::Method;
use super::vector::{Described, Wire};
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::generate::{Family, GeneratedId};
use tunnelproof_reference::shrink::Complexity;

const SEED: u64 = 1;
/// How many queries of a family are looked at.
const QUERIES: u64 = 2000;
/// How many queries of a class are taken.
const MEMBERS: usize = 4;

/// What queries of one class have in common.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Class {
    flags: BTreeSet<Flag>,
    /// The kind of the first contact; `None` for a miss.
    kind: Option<&'static str>,
}

/// A query of the family.
struct Candidate {
    id: GeneratedId,
    query: Query,
    complexity: Complexity,
    class: Class,
    summary: String,
    /// Flags that only the whole group shows.
    group_flags: Vec<Flag>,
}

pub(super) fn selection(family: &'static Family) -> Source {
    let mut candidates: Vec<_> = (0..QUERIES)
        .into_par_iter()
        .map(|index| Candidate::new(family, index))
        .collect();
    if family.group_size() > 1 {
        candidates
            .chunks_mut(family.group_size())
            .for_each(flag_wire);
    }
    let chosen = chosen(&candidates);
    let members = chosen.iter().map(|&index| candidates[index].described());
    let shrunk = simplest_failures(&candidates).into_par_iter().map(shrunk);
    Source {
        name: family.name().to_owned(),
        description: format!(
            "a selection of the first {QUERIES} queries of the family {}, seed {SEED}: {}",
            family.name(),
            family.description()
        ),
        queries: members.chain(shrunk.collect::<Vec<_>>()).collect(),
    }
}

/// Says of the segments of a wire that they are, and by which method all of them are missed.
fn flag_wire(segments: &mut [Candidate]) {
    let misses = |candidate: &Candidate, method| {
        let missed = [Fault::Tunnel, Fault::MissedGraze].map(|fault| Flag::Failure(fault, method));
        missed
            .iter()
            .any(|flag| candidate.class.flags.contains(flag))
    };
    // A crossing is due in one of them, but not a contact in each.
    let is_passed_by = |method: &Method| {
        let is_missed =
            |candidate: &Candidate| candidate.class.kind.is_none() || misses(candidate, *method);
        segments.iter().all(is_missed)
    };
    let methods = Method::ALL.into_iter().filter(is_passed_by);
    let joint_tunnels = methods.map(|method| Flag::Failure(Fault::JointTunnel, method));
    let flags: Vec<_> = std::iter::once(Flag::WireJoint)
        .chain(joint_tunnels)
        .collect();
    for candidate in segments {
        candidate.class.flags.extend(&flags);
        candidate.group_flags.clone_from(&flags);
    }
}

/// The simplest queries of each class, in their order, wires as a whole.
fn chosen(candidates: &[Candidate]) -> BTreeSet<usize> {
    let mut classes: BTreeMap<&Class, Vec<usize>> = BTreeMap::new();
    for (index, candidate) in candidates.iter().enumerate() {
        classes.entry(&candidate.class).or_default().push(index);
    }
    let simplest = classes.into_values().flat_map(|mut members| {
        members.sort_by_key(|&index| candidates[index].complexity);
        members.into_iter().take(MEMBERS)
    });
    simplest
        .flat_map(|index| {
            let size = candidates[index].id.family.group_size();
            let first = index - index % size;
            first..first + size
        })
        .collect()
}

/// Of each way in which a method fails on a single query the simplest one that shows it.
fn simplest_failures(candidates: &[Candidate]) -> Vec<(Method, Fault, &Candidate)> {
    let mut simplest: BTreeMap<(Method, Fault), &Candidate> = BTreeMap::new();
    for candidate in candidates {
        for flag in &candidate.class.flags {
            if let Flag::Failure(fault, method) = *flag
                && fault != Fault::JointTunnel
            {
                let best = simplest.entry((method, fault)).or_insert(candidate);
                if candidate.complexity < best.complexity {
                    *best = candidate;
                }
            }
        }
    }
    let failures = simplest.into_iter();
    failures
        .map(|((method, fault), candidate)| (method, fault, candidate))
        .collect()
}

/// The query shrunk to a small one that the method gets wrong in the same way.
fn shrunk((method, fault, candidate): (Method, Fault, &Candidate)) -> Described {
    let (name, what) = (method.subject_name(), fault.name());
    Described {
        id: format!("{}/{name}/{}", candidate.id, what.replace(' ', "-")),
        comment: format!(
            "shrunk from {}, as long as the answer of {name} shows this: {what}",
            candidate.id
        ),
        flags: Vec::new(),
        wire: None,
        query: method.shrink(&candidate.query, fault).query,
    }
}

impl Candidate {
    fn new(family: &'static Family, index: u64) -> Self {
        let id = GeneratedId {
            family,
            seed: SEED,
            index,
        };
        let query = id.query();
        let assessment = Assessment::new(&query);
        let kind = assessment.answer.hit.map(|hit| hit.kind.name());
        Candidate {
            id,
            query,
            complexity: Complexity::of(&query),
            summary: assessment.summary(),
            class: Class {
                flags: assessment.flags,
                kind,
            },
            group_flags: Vec::new(),
        }
    }

    fn described(&self) -> Described {
        let size = self.id.family.group_size() as u64;
        let index = self.id.index;
        let wire = (size > 1).then(|| Wire {
            id: format!("{}:{SEED}:wire-{}", self.id.family.name(), index / size),
            segment: (index % size) as usize,
        });
        Described {
            id: self.id.to_string(),
            comment: self.summary.clone(),
            flags: self.group_flags.clone(),
            wire,
            query: self.query,
        }
    }
}
