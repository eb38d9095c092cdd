//! The search against all settings, and advice against its own figures.

use std::sync::atomic::AtomicBool;

use super::*;
use crate::sweep::{Domain, Precision, Sample, Watch};
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::generate::by_name;

static NEVER: AtomicBool = AtomicBool::new(false);

fn sample(names: &[&str], count: u64) -> Sample {
    let source = |name: &&str| Source::Family {
        family: by_name(name).unwrap(),
        seed: 3,
        count,
    };
    let sources: Vec<_> = names.iter().map(source).collect();
    Sample::read(Domain::new(1.0, Precision::F64).unwrap(), &sources, |_| {}).unwrap()
}

fn watch() -> Watch<'static> {
    Watch {
        stop: &NEVER,
        progress: &|_| {},
    }
}

const LATTICE: Lattice = Lattice { length: 1.0 };

const START: Place = [9, 9, 9, 5, 5];

#[test]
fn search_ends_where_no_change_of_one_threshold_adds_to_the_front() {
    let sample = sample(&["near_coplanar", "lattice", "near_parallel"], 60);
    for aim in [Aim::Count, Aim::Gap] {
        let mut judge = Judge::new(LATTICE, &sample, sample.parts(), watch());
        let free = [true, true, false, true, true];
        let found = search(&mut judge, aim, &[START], free).unwrap();
        assert!(found.members().len() > 3, "{aim:?}: {found:?}");
        let mut more = found.clone();
        for member in found.members() {
            for place in Lattice::neighbours(member.place, free) {
                let cost = judge.cost(place).unwrap();
                more.offer(aim.objectives(&cost), Member { place, cost });
            }
        }
        assert_eq!(more, found, "{aim:?}");
    }
}

#[test]
fn search_of_two_thresholds_finds_the_front_of_all_their_settings() {
    let sample = sample(&["near_coplanar", "lattice", "near_parallel"], 120);
    let free = [true, false, false, true, false];
    let mut judge = Judge::new(LATTICE, &sample, sample.parts(), watch());
    let found = search(&mut judge, Aim::Count, &[START], free).unwrap();
    let mut all = Front::default();
    for dist in 0..Lattice::VALUES {
        for quadratic in 0..Lattice::VALUES {
            let mut place = START;
            (place[0], place[3]) = (dist, quadratic);
            let cost = judge.cost(place).unwrap();
            all.offer(Aim::Count.objectives(&cost), Member { place, cost });
        }
    }
    let numbers = |front: &Front<Member>| front.numbers().collect::<Vec<_>>();
    assert!(all.members().len() > 3, "{all:?}");
    assert_eq!(numbers(&found), numbers(&all));
}

#[test]
fn advice_is_no_worse_than_what_it_is_compared_with() {
    let sample = sample(&["near_coplanar", "near_parallel", "joint"], 60);
    let mut judge = Judge::new(LATTICE, &sample, sample.parts(), watch());
    let penalty = Penalty { false_hits: 10.0 };
    let advice = advise(&mut judge, penalty).unwrap();
    let least = penalty.of(&advice.best.cost);
    let published = judge
        .cost(LATTICE.nearest(&crate::sweep::Setting::published()))
        .unwrap();
    assert!(least < penalty.of(&published));
    assert!(least <= penalty.of(&advice.relative.cost));
    assert!(penalty.of(&advice.reduced.cost) <= least * 1.01);
    for influence in &advice.influences {
        let axis = influence.threshold as usize;
        assert_eq!(influence.at_zero.place[axis], 0);
        assert!(penalty.of(&influence.at_zero.cost) >= least);
        let [from, to] = influence.indifferent;
        for value in from..=to {
            let mut place = advice.best.place;
            place[axis] = value;
            assert!(penalty.of(&judge.cost(place).unwrap()) <= least * 1.01);
        }
    }
    for threshold in &advice.superfluous {
        assert_eq!(advice.reduced.place[*threshold as usize], 0);
    }
}

#[test]
fn validation_of_the_certified_path_finds_nothing_and_of_the_others_something() {
    let sample = sample(&["near_coplanar", "near_parallel", "joint"], 100);
    let mut judge = Judge::new(LATTICE, &sample, sample.parts(), watch());
    let advice = advise(&mut judge, Penalty { false_hits: 10.0 }).unwrap();
    let validated = validate(&LATTICE, &advice, &sample, &watch()).unwrap();
    let names: Vec<_> = validated.iter().map(|validated| validated.name).collect();
    assert_eq!(names, CANDIDATES);
    for Validated { setting, cost, .. } in &validated {
        let wrong = cost.missed_crossings + cost.missed_grazes + cost.false_hits;
        assert_eq!(wrong == 0, setting.is_none(), "{cost:?}");
    }
    assert_eq!(validated[1].cost, advice.best.cost, "the same sample");
}

#[test]
fn search_interrupted_says_so() {
    let sample = sample(&["lattice"], 20);
    let stop = AtomicBool::new(true);
    let watch = Watch {
        stop: &stop,
        progress: &|_| {},
    };
    let mut judge = Judge::new(LATTICE, &sample, sample.parts(), watch);
    assert!(advise(&mut judge, Penalty { false_hits: 1.0 }).is_err());
}
