//! A sweep against `certify`, against itself, and after interruptions.

use std::fs;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use tunnelproof::thesis::Threshold;

use super::*;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::tally::{Fault, Tally};
use tunnelproof_reference::generate::{FAMILIES, by_name};
use tunnelproof_reference::registry;

fn sources(names: &[&str], count: u64) -> Vec<Source> {
    let source = |name: &&str| Source::Family {
        family: by_name(name).unwrap(),
        seed: 5,
        count,
    };
    names.iter().map(source).collect()
}

fn sample(names: &[&str], count: u64, scale: f64) -> Sample {
    let domain = Domain::new(scale, Precision::F64).unwrap();
    Sample::read(domain, &sources(names, count), |_| {}).unwrap()
}

fn counts(sample: &Sample, setting: &Setting) -> Counts {
    let stop = AtomicBool::new(false);
    let watch = Watch {
        stop: &stop,
        progress: &|_| {},
    };
    let judged = sample.judge(&|query| setting.answer(query), sample.parts(), &watch);
    judged.unwrap()
}

#[test]
fn sweep_at_table_3_1_counts_what_certify_counts() {
    let names: Vec<_> = FAMILIES.iter().map(|family| family.name()).collect();
    let panel = Panel {
        second_judges: Vec::new(),
        subjects: vec![Judged {
            subject: registry::by_name("thesis").unwrap(),
            explain: None,
        }],
    };
    let mut expected = Tally::default();
    for source in sources(&names, 150) {
        let block = panel.run(&source.clone().into(), |_| {}).unwrap();
        expected.merge(block.tallies[0].clone());
    }
    let sample = sample(&names, 150, 1.0);
    let found = counts(&sample, &Setting::published());
    assert_eq!(found.hits, expected.hits);
    let wrong = expected.count(Fault::FalseHit) + expected.count(Fault::NearHit);
    assert_eq!(found.count(Fault::FalseHit), wrong);
    for fault in [
        Fault::Tunnel,
        Fault::JointTunnel,
        Fault::MissedGraze,
        Fault::WrongCase,
    ] {
        assert!(expected.count(fault) > 0, "{fault:?} is not probed");
        assert_eq!(found.count(fault), expected.count(fault), "{fault:?}");
        let worst = &found.price(&sample).worst[fault.name()];
        let witness = expected.faults[&fault].worst.as_ref().unwrap();
        if fault != Fault::WrongCase {
            assert_eq!(worst.severity, witness.severity, "{fault:?}");
        }
    }
}

#[test]
fn sweep_at_another_scale_counts_the_same_with_relative_thresholds() {
    let names = [
        "lattice",
        "near_coplanar",
        "near_parallel",
        "near_collinear",
    ];
    let [metre, kilometre] = [1.0, 1024.0].map(|scale| sample(&names, 200, scale));
    // Algorithm 15 also compares parameters, which have no unit, with this threshold.
    let at = |scale: f64| Setting::relative(1e-9, scale).with(Threshold::Dist1d, 0.0);
    let [here, there] =
        [(&metre, 1.0), (&kilometre, 1024.0)].map(|(sample, scale)| counts(sample, &at(scale)));
    assert_eq!(here, there);
    assert_ne!(
        here,
        counts(&kilometre, &at(1.0)),
        "the scale does not matter"
    );
}

#[test]
fn sweep_gaps_are_those_of_the_false_hits() {
    let sample = sample(&["near_coplanar", "lattice"], 300, 1.0);
    let counts = counts(&sample, &Setting::published());
    let gaps = counts.price(&sample).gaps.unwrap();
    let mut exact: Vec<_> = counts
        .false_hits
        .iter()
        .map(|&index| sample.gap(index))
        .collect();
    exact.sort_by(f64::total_cmp);
    // Ranked by estimates, so that neighbours in rank may change places.
    let near = |a: f64, b: f64| (a - b).abs() <= 2e-3 * b + 1e-15;
    assert!(
        near(gaps.max, exact[exact.len() - 1]),
        "{} {exact:?}",
        gaps.max
    );
    assert!(
        near(gaps.median, exact[(exact.len() - 1) / 2]),
        "{} {exact:?}",
        gaps.median
    );
    assert_eq!(gaps.decades.values().sum::<u64>(), exact.len() as u64);
}

fn settings() -> Vec<Setting> {
    let axis = Axis::new(Threshold::Dist, 1e-9, 1e-1, 5).unwrap();
    Grid::alone(vec![axis]).settings()
}

#[test]
fn sweep_interrupted_and_resumed_gives_the_same_bits() {
    let names = ["near_coplanar", "joint"];
    let never = AtomicBool::new(false);
    let watch = Watch {
        stop: &never,
        progress: &|_| {},
    };
    let whole = run(&sample(&names, 300, 1.0), &settings(), &[], &watch, |_| {}).unwrap();
    for judged in [0, 1, 1300, 2400] {
        let folder = tempfile::tempdir().unwrap();
        let first = sample(&names, 300, 1.0);
        let (stop, seen) = (AtomicBool::new(judged == 0), AtomicU64::new(0));
        let progress = |queries| {
            if seen.fetch_add(queries, Ordering::Relaxed) + queries >= judged {
                stop.store(true, Ordering::Relaxed);
            }
        };
        let watch = Watch {
            stop: &stop,
            progress: &progress,
        };
        let (Interrupted, partial) = run(&first, &settings(), &[], &watch, |_| {}).unwrap_err();
        assert_eq!(partial.as_slice(), &whole[..partial.len()]);
        let cache = Cache::new(folder.path(), &first);
        cache.save_settings(&partial).unwrap();
        cache.save_truths(&first).unwrap();
        let mut second = sample(&names, 300, 1.0);
        cache.load_truths(&mut second).unwrap();
        let known = cache.load_settings().unwrap();
        let watch = Watch {
            stop: &never,
            progress: &|_| {},
        };
        let resumed = run(&second, &settings(), &known, &watch, |_| {}).unwrap();
        let json = |evaluated: &[Evaluated]| serde_json::to_string(evaluated).unwrap();
        assert_eq!(json(&resumed), json(&whole));
    }
}

#[test]
fn cache_truths_are_those_that_were_found() {
    let folder = tempfile::tempdir().unwrap();
    let found = sample(&["lattice", "grazing"], 100, 1.0);
    for index in 0..found.queries().len() {
        found.truth(index);
    }
    found.gap(3);
    let cache = Cache::new(folder.path(), &found);
    cache.save_truths(&found).unwrap();
    let mut loaded = sample(&["lattice", "grazing"], 100, 1.0);
    assert_eq!(loaded.known_truths(), 0);
    cache.load_truths(&mut loaded).unwrap();
    assert_eq!(loaded.known_truths(), 200);
    assert_eq!(loaded.records(), found.records());
}

#[test]
fn cache_of_another_corpus_is_not_taken() {
    let folder = tempfile::tempdir().unwrap();
    let one = sample(&["lattice"], 50, 1.0);
    let cache = Cache::new(folder.path(), &one);
    cache.save_truths(&one).unwrap();
    let bytes = fs::read(cache.truths()).unwrap();
    for mut other in [
        sample(&["lattice"], 49, 1.0),
        sample(&["lattice"], 50, 2.0),
        sample(&["grazing"], 50, 1.0),
    ] {
        let own = Cache::new(folder.path(), &other);
        assert_ne!(own.truths(), cache.truths());
        fs::write(own.truths(), &bytes).unwrap();
        let refused = own.load_truths(&mut other);
        assert!(matches!(refused, Err(Damage::Key)), "{refused:?}");
    }
}
