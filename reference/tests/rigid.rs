//! Bodies that turn: the oracle and the second judge agree, and faults are seen.

use tunnelproof::rigid::RigidQuery;
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::generate::{RigidFamily, all_rigid};
use tunnelproof_reference::oracle::decide_rigid_query;
use tunnelproof_reference::{difference, field};

/// How many queries of each family are judged; `TUNNELPROOF_RIGID_COUNT` asks for more.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 60 } else { 500 };
    asked.map_or(usual, |text| text.parse().expect("a number"))
}

/// The seed; `TUNNELPROOF_RIGID_SEED` sets another one.
fn seed() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_SEED").ok();
    asked.map_or(2031, |text| text.parse().expect("a number"))
}

/// The families to judge; `TUNNELPROOF_RIGID_FAMILIES` names those whose names contain it.
fn families() -> impl Iterator<Item = &'static RigidFamily> {
    let asked = std::env::var("TUNNELPROOF_RIGID_FAMILIES").unwrap_or_default();
    all_rigid().filter(move |family| family.name().contains(&asked))
}

fn second(query: &RigidQuery) -> ExactAnswer {
    difference::decide_rigid::<field::Default>(query)
}

/// The queries on which the two judges differ, and the number of hits.
fn compare(family: &RigidFamily, count: u64) -> (Vec<u64>, u64) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let part = |own: u64| {
        let (mut differing, mut hits) = (Vec::new(), 0);
        for index in (own..count).step_by(threads as usize) {
            let query = family.query(seed(), index);
            let truth = decide_rigid_query(&query);
            hits += u64::from(truth.hit.is_some());
            if truth != second(&query) {
                differing.push(index);
            }
        }
        (differing, hits)
    };
    std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads)
            .map(|own| scope.spawn(move || part(own)))
            .collect();
        let mut all = (Vec::new(), 0);
        for handle in handles {
            let (differing, hits) = handle.join().expect("no judge panics");
            all.0.extend(differing);
            all.1 += hits;
        }
        all.0.sort_unstable();
        all
    })
}

#[test]
fn rigid_judges_agree_on_every_family() {
    for family in families() {
        let (differing, hits) = compare(family, count());
        println!("{}: {} queries, {hits} hits", family.name(), count());
        if let Some(&index) = differing.first() {
            let query = family.query(seed(), index);
            panic!(
                "{} of {}: {index}: {query:?}\n{:?}\n{:?}",
                differing.len(),
                family.name(),
                decide_rigid_query(&query),
                second(&query)
            );
        }
    }
}
