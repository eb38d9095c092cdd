//! Two independent ways to every answer, over both backends: oracle and shadow, or oracle and
//! difference, on generated queries, and on the public sets with their labels where
//! `../shared/data` is present.
//!
//! With the feature `gmp` the default backend is GMP, and the comparisons with `num-bigint` are
//! between two implementations of arithmetic; without it they hold trivially.

use num_bigint::BigInt;
use tunnelproof::query::{EdgeEdge, Query, QueryKind};
use tunnelproof::thesis::Repairs;
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::corpus::Entry;
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::generate::{self, FAMILIES};
use tunnelproof_reference::{difference, oracle, shadow};

mod public;

/// A third where Rust checks its arithmetic (`cargo test` without `--release`).
const COUNT: u64 = if cfg!(debug_assertions) { 1_000 } else { 3_000 };

fn by_oracle<Z: Integer>(query: &EdgeEdge) -> ExactAnswer {
    oracle::decide::<Z>(&Query::EdgeEdge(*query)).written()
}

fn by_shadow<Z: Integer>(query: &EdgeEdge) -> ExactAnswer {
    shadow::edge_edge::<Z>(query, Repairs::ALL)
}

/// Calls `check` on every query of this kind of the public sets, which are skipped where they are
/// not.
fn for_every_public_query(kind: QueryKind, check: impl Fn(&Entry)) {
    for set in public::LABELLED {
        public::set(set, kind).iter().for_each(&check);
    }
}

#[test]
fn oracle_shadow_and_label_agree_on_the_public_sets() {
    for_every_public_query(QueryKind::EdgeEdge, |entry| {
        let Query::EdgeEdge(query) = &entry.query else {
            panic!("{} is not edge-edge", entry.id)
        };
        let answer = by_oracle::<field::Default>(query);
        assert_eq!(Some(answer.hit.is_some()), entry.label, "{}", entry.id);
        assert_eq!(answer, by_shadow::<field::Default>(query), "{}", entry.id);
        assert_eq!(answer, by_oracle::<BigInt>(query), "{}", entry.id);
    });
}

#[test]
fn oracle_difference_and_label_agree_on_the_public_sets_of_faces() {
    for_every_public_query(QueryKind::VertexFace, |entry| {
        let answer = oracle::decide::<field::Default>(&entry.query).written();
        assert_eq!(Some(answer.hit.is_some()), entry.label, "{}", entry.id);
        let second = difference::decide::<field::Default>(&entry.query);
        assert_eq!(answer, second, "{}", entry.id);
    });
}

#[test]
fn oracle_difference_and_backends_agree_on_every_family_of_every_kind() {
    for family in generate::all() {
        for index in 0..COUNT / 10 {
            let query = family.query(1, index);
            let answer = oracle::decide::<field::Default>(&query).written();
            let second = difference::decide::<field::Default>(&query);
            let id = || format!("{}:1:{index}", family.name());
            assert_eq!(answer, second, "{}", id());
            if index % 8 == 0 {
                assert_eq!(
                    answer,
                    oracle::decide::<BigInt>(&query).written(),
                    "{}",
                    id()
                );
                assert_eq!(answer, difference::decide::<BigInt>(&query), "{}", id());
            }
        }
    }
}

#[test]
fn oracle_shadow_and_backends_agree_on_every_family() {
    for family in FAMILIES {
        for index in 0..COUNT {
            let Query::EdgeEdge(query) = family.query(1, index) else {
                continue;
            };
            let id = || format!("{}:1:{index}", family.name());
            let answer = by_oracle::<field::Default>(&query);
            assert_eq!(answer, by_shadow::<field::Default>(&query), "{}", id());
            if index % 8 == 0 {
                assert_eq!(answer, by_oracle::<BigInt>(&query), "{}", id());
                assert_eq!(answer, by_shadow::<BigInt>(&query), "{}", id());
                // As published it may be wrong, but in the same way.
                assert_eq!(
                    shadow::edge_edge::<field::Default>(&query, Repairs::NONE),
                    shadow::edge_edge::<BigInt>(&query, Repairs::NONE),
                    "{}",
                    id()
                );
            }
        }
    }
}
