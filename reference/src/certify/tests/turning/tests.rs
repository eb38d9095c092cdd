//! Bodies that turn, judged as everything else is.

use tunnelproof::narrow::{Tolerance, Unsupported};
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::answer::{Enclosure, ExactAnswer};
use crate::certify::block::Block;
use crate::certify::caller::Caller;
use crate::certify::findings::{Findings, Settings};
use crate::certify::judged::Judged;
use crate::certify::run::Panel;
use crate::certify::shard::Shard;
use crate::certify::source::{AnySource, Source, TurningSource};
use crate::certify::strict::failures;
use crate::certify::table::{self, Shown};
use crate::generate::{by_name, rigid_by_name};
use crate::oracle::{decide_query, decide_rigid_query};
use crate::registry;
use crate::report::merge::Kept;
use crate::report::results::Results;
use crate::subject::{Answer, Certified, Lapse, LapseKind, NoAnswer, Said, Subject};

type Change = fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer>;

/// The oracle, its answers about bodies that turn changed.
struct Changed {
    name: &'static str,
    change: Change,
    tolerance: Tolerance,
}

impl Subject for Changed {
    fn name(&self) -> &str {
        self.name
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(decide_query(query)))
    }

    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        (self.change)(query, decide_rigid_query(query))
    }

    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
}

fn changed(name: &'static str, change: Change) -> Changed {
    Changed {
        name,
        change,
        tolerance: Tolerance::NONE,
    }
}

fn said(answer: ExactAnswer) -> Said {
    Said {
        toi: answer.hit.map(|hit| hit.toi),
        case: None,
    }
}

const RIGHT: Change = |_, truth| Ok(Answer::Exact(truth));
const LATE: Change = |_, truth| {
    let mut said = said(truth);
    if let Some(toi) = &mut said.toi {
        *toi = Enclosure::exactly((toi.below + 1e-10).min(1.0));
    }
    Ok(Answer::Said(said))
};

fn turning_lattice() -> AnySource {
    first_queries("turning_lattice")
}

fn first_queries(family: &str) -> AnySource {
    let family = rigid_by_name(family).unwrap();
    let [seed, count] = [1, 150];
    TurningSource::Family {
        family,
        seed,
        count,
    }
    .into()
}

fn panel<'a>(second: &'a dyn Subject, subject: &'a dyn Subject) -> Panel<'a> {
    Panel {
        second_judges: vec![second],
        subjects: vec![Judged {
            subject,
            explain: None,
        }],
    }
}

fn findings(panel: Panel, blocks: Vec<Block>) -> Findings {
    let settings = Settings {
        command: "tunnelproof certify".to_owned(),
        caller: Caller::Test,
        seed: 1,
        count: 150,
        shard: Shard::WHOLE,
    };
    Findings::new(panel, settings, blocks, Vec::new())
}

fn judged(second: &dyn Subject, subject: &dyn Subject) -> (Block, Vec<String>, String) {
    let panel = panel(second, subject);
    let block = panel.run(&turning_lattice(), |_| {}).unwrap();
    let failures = failures(&panel, &block);
    let text = table::text(&findings(panel, vec![block.clone()]), Shown::EVERYTHING);
    (block, failures, text)
}

#[test]
fn turning_subject_that_is_right_passes() {
    let (block, failures, text) = judged(&changed("second", RIGHT), &changed("engine", RIGHT));
    assert_eq!(failures, [""; 0]);
    assert_eq!(block.queries, 150);
    assert!(block.hits > 5 && block.hits < 140, "{}", block.hits);
    assert!(
        text.contains("oracle and second agree on all 150 queries"),
        "{text}"
    );
    assert!(text.contains("small integers in quaternions"), "{text}");
}

/// Each sort is asked of whoever takes it, in one run.
#[test]
fn turning_and_linear_queries_are_judged_together() {
    let seconds = registry::second_judges();
    let panel = Panel {
        second_judges: seconds.to_vec(),
        ..panel(seconds[0], &Certified)
    };
    let lattice = Source::Family {
        family: by_name("lattice").unwrap(),
        seed: 1,
        count: 100,
    };
    let sources = [lattice.into(), turning_lattice()];
    let blocks = sources.map(|source| panel.run(&source, |_| {}).unwrap());
    let shadow = [&blocks[0], &blocks[1]].map(|block| block.agreements[0].queries);
    let difference = [&blocks[0], &blocks[1]].map(|block| block.agreements[1].queries);
    assert_eq!((shadow, difference), ([100, 0], [0, 150]));
    assert_ne!(blocks[0].fingerprint, blocks[1].fingerprint);
    let findings = findings(panel, blocks.to_vec());
    assert_eq!(failures(&findings.panel, &findings.total), [""; 0]);
    let names: Vec<_> = findings.total.tallies[0]
        .taken
        .iter()
        .map(|sort| sort.kind.name())
        .collect();
    assert!(
        names.contains(&"edge-edge") && names.contains(&"vertex-turning-face"),
        "{names:?}"
    );
}

#[test]
fn turning_results_are_read_back_and_parts_make_the_whole() {
    let misses: Change = |_, _| Ok(Answer::Said(Said::default()));
    let (right, wrong) = (changed("second", RIGHT), changed("engine", misses));
    let panel = panel(&right, &wrong);
    for (family, kind) in [
        ("turning_lattice", "edge-turning-edge"),
        ("turning_bodies_thick_lattice", "turning-edge-turning-edge"),
    ] {
        let source = first_queries(family);
        let whole = panel.run(&source, |_| {}).unwrap();
        let mut joined = Block::default();
        for shard in ["2/2", "1/2"] {
            let shard = shard.parse().unwrap();
            joined.join(panel.run_shard(&source, shard, |_| {}).unwrap());
        }
        joined.name = whole.name.clone();
        let [whole, joined] = [whole, joined].map(|block| findings(panel.clone(), vec![block]));
        let text = Results::new(&whole).text();
        assert_eq!(Results::new(&joined).text(), text);
        assert!(text.contains(&format!("\"kind\": \"{kind}\"")), "{text}");
        let kept = Kept::new(&Results::read(&text).unwrap()).unwrap();
        assert_eq!(Results::new(&kept.findings()).text(), text);
    }
}

/// Who takes bodies against wires alone is not asked to take two bodies.
#[test]
fn turning_queries_of_one_body_and_of_two_are_sorts_of_their_own() {
    let one_body: Change = |query, truth| match query.kind().lengths().poses {
        2 => Ok(Answer::Exact(truth)),
        _ => Err(Unsupported::Turning(query.kind()).into()),
    };
    let (right, engine) = (changed("second", RIGHT), changed("engine", one_body));
    let panel = panel(&right, &engine);
    let sources = [turning_lattice(), first_queries("turning_bodies_lattice")];
    let blocks = sources.map(|source| panel.run(&source, |_| {}).unwrap());
    let findings = findings(panel, blocks.to_vec());
    assert_eq!(failures(&findings.panel, &findings.total), [""; 0]);
    let tally = &findings.total.tallies[0];
    assert_eq!((tally.taken.len(), tally.refused.len()), (2, 2));
}

#[test]
fn turning_subject_fails_by_each_fault() {
    let of_misses: Change = |_, _| Ok(Answer::Said(Said::default()));
    let of_hits: Change = |_, truth| {
        let toi = said(truth).toi.or(Some(Enclosure::exactly(0.5)));
        Ok(Answer::Said(Said { toi, case: None }))
    };
    let wrong_side: Change = |_, mut truth| {
        if let Some(hit) = &mut truth.hit {
            hit.side = 2;
        }
        Ok(Answer::Exact(truth))
    };
    let silent: Change = |_, _| Err(Lapse::new(LapseKind::Crashed, "gone").into());
    let refusing: Change = |query, _| Err(Unsupported::Turning(query.kind()).into());
    for (change, words) in [
        (of_misses, "tunnels"),
        (of_misses, "missed grazes"),
        (of_hits, "false hits"),
        (LATE, "late times of impact"),
        (wrong_side, "answers that differ from the exact one"),
        (silent, "150 queries without answer"),
        (
            refusing,
            "takes none of the 150 queries, so it gave no answer",
        ),
    ] {
        let (_, failures, text) = judged(&changed("second", RIGHT), &changed("engine", change));
        let [failure] = &failures[..] else {
            panic!("{failures:?}")
        };
        assert!(
            failure.starts_with("engine: ") && failure.contains(words),
            "{failure}"
        );
        assert!(text.contains("FAILS"), "{text}");
    }
}

#[test]
fn turning_subject_may_be_as_late_as_it_declares() {
    let late = |late| Changed {
        tolerance: Tolerance { near: 0.0, late },
        ..changed("engine", LATE)
    };
    assert_eq!(judged(&changed("second", RIGHT), &late(2e-10)).1, [""; 0]);
    assert_eq!(judged(&changed("second", RIGHT), &late(0.5e-10)).1.len(), 1);
}

#[test]
fn turning_second_judge_that_differs_is_named() {
    let of_misses = changed("second", |_, mut truth| {
        truth.hit = None;
        Ok(Answer::Exact(truth))
    });
    let (block, failures, text) = judged(&of_misses, &changed("engine", RIGHT));
    assert_eq!(block.agreements[0].disagreements.count, block.hits);
    let line = format!("oracle and second disagree on {} queries", block.hits);
    assert_eq!(failures, [line]);
    assert!(text.contains("oracle and second DISAGREE on"), "{text}");
    assert!(text.contains("first on turning_lattice:1:"), "{text}");
}
