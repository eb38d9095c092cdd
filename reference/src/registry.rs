//! The subjects that the command line knows, and which errata explain the published text.

use std::sync::LazyLock;

use tunnelproof::additive::Additive;
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;
use tunnelproof::thesis::{Erratum, Repairs, Thesis};

use crate::answer::ExactAnswer;
use crate::certify::query::AnyQuery;
use crate::difference::{self, Difference};
use crate::field;
use crate::oracle::Oracle;
use crate::shadow::Shadow;
use crate::shrink::Truth;
use crate::subject::{Answer, Certified, Engine, Subject};

/// Agrees with the oracle on every query that it takes, or one of the two is wrong: edges without
/// radius.
pub static SECOND_JUDGE: Shadow = Shadow::REPAIRED;

/// The second judges: of those that take a query, the first is asked.
pub fn second_judges() -> [&'static dyn Subject; 2] {
    [&SECOND_JUDGE, &Difference]
}

static THESIS: LazyLock<Engine<Thesis>> = LazyLock::new(|| Engine(Thesis::default()));

static ADDITIVE: LazyLock<Engine<Additive>> = LazyLock::new(|| Engine(Additive::default()));

/// Every subject, in the order of tables.
pub fn subjects() -> [&'static dyn Subject; 7] {
    [
        &Oracle,
        &Difference,
        &SECOND_JUDGE,
        &Shadow::PUBLISHED,
        &*THESIS,
        &*ADDITIVE,
        &Certified,
    ]
}

/// Every subject but the second judge that takes all queries: it is slow, and asked anyway where no
/// other one takes them.
pub fn judged_by_default() -> impl Iterator<Item = &'static dyn Subject> {
    let subjects = subjects().into_iter();
    subjects.filter(|subject| subject.name() != Difference.name())
}

/// The subject with this [`name`](Subject::name), if any.
pub fn by_name(name: &str) -> Option<&'static dyn Subject> {
    let mut subjects = subjects().into_iter();
    subjects.find(|subject| subject.name() == name)
}

/// Everyone who answers queries of bodies that turn as well, the oracle first.
pub fn turning_subjects() -> [&'static dyn Subject; 3] {
    [&Oracle, &Difference, &Certified]
}

/// Who can be taken for the truth, by the name of the subject.
pub fn truths() -> [(&'static str, Truth); 3] {
    let oracle = |query: &AnyQuery| Ok(query.decide());
    let shadow = |query: &AnyQuery| match query {
        AnyQuery::Linear(query) => SECOND_JUDGE.decide(query),
        AnyQuery::Turning(query) => Err(Unsupported::Turning(query.kind())),
    };
    let difference = |query: &AnyQuery| {
        Ok(match query {
            AnyQuery::Linear(query) => difference::decide::<field::Default>(query),
            AnyQuery::Turning(query) => difference::decide_rigid::<field::Default>(query),
        })
    };
    [
        (Oracle.name(), oracle),
        (Difference.name(), difference),
        (SECOND_JUDGE.name(), shadow),
    ]
}

/// The names of a smallest set of errata whose repair makes the published text give the exact
/// answer; of equals the first in the order of the algorithms.
pub fn errata(query: &Query, truth: &ExactAnswer) -> Vec<&'static str> {
    let exact = Ok(Answer::Exact(*truth));
    let enough = |repairs: &Repairs| Shadow::new(*repairs).answer(query) == exact;
    match repairs_by_size().find(enough) {
        Some(repairs) => repairs.iter().map(Erratum::name).collect(),
        None => vec!["unexplained"],
    }
}

/// Every set of errata, the small ones first.
fn repairs_by_size() -> impl Iterator<Item = Repairs> {
    let sets = 0..1u32 << Erratum::ALL.len();
    (0..=Erratum::ALL.len() as u32)
        .flat_map(move |size| sets.clone().filter(move |set| set.count_ones() == size))
        .map(|set| {
            let chosen = (0..).zip(Erratum::ALL).filter(|(i, _)| set >> i & 1 == 1);
            chosen.fold(Repairs::NONE, |repairs, (_, erratum)| repairs.with(erratum))
        })
}

#[cfg(test)]
mod tests {
    use tunnelproof::narrow::Tolerance;

    use super::*;

    #[test]
    fn subjects_have_names_that_find_them() {
        for subject in subjects() {
            assert_eq!(by_name(subject.name()).unwrap().name(), subject.name());
        }
        assert!(by_name("nobody").is_none());
    }

    #[test]
    fn only_the_thesis_path_has_a_tolerance() {
        for subject in subjects() {
            let tolerance = match subject.name() {
                "thesis" => Tolerance {
                    near: 1e-6,
                    late: 1e-9,
                },
                _ => Tolerance::NONE,
            };
            assert_eq!(subject.tolerance(), tolerance, "{}", subject.name());
        }
    }

    #[test]
    fn repairs_by_size_holds_every_set_once() {
        let sets: Vec<_> = repairs_by_size().collect();
        assert_eq!(sets.len(), 1 << Erratum::ALL.len());
        assert_eq!(sets[0], Repairs::NONE);
        assert_eq!(sets.last(), Some(&Repairs::ALL));
        assert!(sets.is_sorted_by_key(|set| set.iter().count()));
        let distinct: std::collections::HashSet<_> = sets.iter().collect();
        assert_eq!(distinct.len(), sets.len());
    }
}
