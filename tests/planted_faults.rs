//! Faults planted in the thesis path are found by certification: a threshold raised, a root
//! dropped, a case skipped. Each is compared with the same run without the fault.

use tunnelproof::contact::{Case, Verdict};
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::EdgeEdge;
use tunnelproof::thesis::{Options, Thesis, Thresholds};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::generate::by_name;
use tunnelproof_reference::registry::SECOND_JUDGE;
use tunnelproof_reference::subject::Engine;

/// The thesis path, its reports changed.
struct Faulty<F>(F);

impl<F: Fn(Report) -> Report + Sync> NarrowPhase for Faulty<F> {
    fn name(&self) -> &str {
        "faulty"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        Thesis::default().edge_edge(query).map(&self.0)
    }
}

/// How often each of these faults is found in an engine on a family.
fn counts<const N: usize>(engine: impl NarrowPhase, family: &str, faults: [Fault; N]) -> [u64; N] {
    let subject = Engine(engine);
    let judged = Judged {
        subject: &subject,
        explain: None,
    };
    let panel = Panel {
        second_judges: vec![&SECOND_JUDGE],
        subjects: vec![judged],
    };
    let family = by_name(family).expect("a family");
    let source = Source::Family {
        family,
        seed: 6,
        count: 4000,
    };
    let block = panel
        .run(&source.into(), |_| ())
        .expect("generated queries are sound");
    faults.map(|fault| block.tallies[0].count(fault))
}

#[test]
fn certify_finds_a_threshold_raised() {
    let raised = Thresholds {
        parallel: 0.5,
        colinear: 0.5,
        ..Thresholds::default()
    };
    let thesis = Thesis {
        options: Options {
            thresholds: raised,
            ..Options::default()
        },
    };
    let faults = [Fault::Tunnel, Fault::FalseHit];
    assert_eq!(counts(Thesis::default(), "uniform", faults), [0, 0]);
    let [tunnels, _] = counts(thesis, "uniform", faults);
    assert!(tunnels > 0);
}

#[test]
fn certify_finds_a_root_dropped() {
    let early = |report: Report| match report.verdict {
        Verdict::Hit(contact) if contact.toi < 0.25 => Report {
            verdict: Verdict::Miss,
            ..report
        },
        _ => report,
    };
    let [tunnels] = counts(Faulty(early), "uniform", [Fault::Tunnel]);
    assert!(tunnels > 0);
}

#[test]
fn certify_finds_a_case_skipped() {
    let skipped = |report: Report| match report.case {
        Some(Case::Coplanar) => Report {
            verdict: Verdict::Miss,
            case: Some(Case::General),
            ..report
        },
        _ => report,
    };
    let faults = [Fault::Tunnel, Fault::WrongCase];
    let [tunnels_before, wrong_before] = counts(Thesis::default(), "lattice", faults);
    let [tunnels, wrong] = counts(Faulty(skipped), "lattice", faults);
    assert!(tunnels > tunnels_before && wrong > wrong_before);
}
