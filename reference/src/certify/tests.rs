//! The judge judged: subjects that lie, each in its own way, are found out.

use std::io::Write as _;

use tunnelproof::contact::{Case, Contact, ContactPoint, Flags, Verdict as Claim};
use tunnelproof::narrow::{Report, Tolerance, Unsupported};
use tunnelproof::query::{Point, Query};

use super::block::Block;
use super::details;
use super::judged::Judged;
use super::query::AnyQuery;
use super::run::Panel;
use super::source::Source;
use super::strict::{exact_failures, failures};
use super::table;
use super::tally::{Fault, Tally};
use crate::answer::{Enclosure, ExactAnswer};
use crate::corpus::ReadOptions;
use crate::corpus::jsonl::{self, Numbers};
use crate::generate;
use crate::oracle::{Oracle, decide_query, least_gap};
use crate::shadow::Shadow;
use crate::subject::{Answer, LapseKind, NoAnswer, Subject};

mod turning {
    mod tests;
}

const COUNT: u64 = 1500;

fn lattice() -> Source {
    Source::Family {
        family: generate::by_name("lattice").unwrap(),
        seed: 3,
        count: COUNT,
    }
}

fn queries() -> impl Iterator<Item = (Query, ExactAnswer)> {
    let entries = lattice().entries().unwrap();
    entries.map(|entry| {
        let query = entry.unwrap().query;
        (query, decide_query(&query))
    })
}

/// An engine that knows the exact answer and tells something else.
struct Liar<L> {
    lie: L,
    near: f64,
}

impl<L: Fn(&Query, ExactAnswer) -> Result<Report, Unsupported> + Sync> Subject for Liar<L> {
    fn name(&self) -> &str {
        "liar"
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Engine((self.lie)(query, decide_query(query))?))
    }

    fn tolerance(&self) -> Tolerance {
        Tolerance {
            near: self.near,
            late: 0.0,
        }
    }
}

fn honest(truth: ExactAnswer) -> Report {
    Report {
        verdict: truth.hit.map_or(Claim::Miss, |hit| claim(hit.toi.below)),
        case: Some(truth.case),
        flags: Flags::default(),
    }
}

fn claim(toi: f64) -> Claim {
    let first = ContactPoint {
        point: Point::origin(),
        weights: [0.5; 4],
        relative_velocity: None,
    };
    Claim::Hit(Contact {
        toi,
        first,
        second: None,
        normal: None,
    })
}

/// About one query in ten, chosen by its points.
fn is_chosen(query: &Query) -> bool {
    let sum: f64 = (query.start().iter().chain(query.end()))
        .zip(1..)
        .map(|(point, i)| f64::from(i) * (point.x + 3.0 * point.y + 5.0 * point.z))
        .sum();
    sum.rem_euclid(10.0) == 0.0
}

fn run(subject: &dyn Subject) -> Block {
    panel(subject).run(&lattice().into(), |_| {}).unwrap()
}

fn panel(subject: &dyn Subject) -> Panel<'_> {
    Panel {
        second_judges: vec![&Shadow::REPAIRED],
        subjects: vec![Judged {
            subject,
            explain: None,
        }],
    }
}

fn judged(
    lie: impl Fn(&Query, ExactAnswer) -> Result<Report, Unsupported> + Sync,
) -> (Tally, Vec<String>) {
    let liar = Liar { lie, near: 0.0 };
    let mut block = run(&liar);
    let failures = failures(&panel(&liar), &block);
    (block.tallies.remove(0), failures)
}

fn counts(tally: &Tally) -> Vec<(Fault, u64)> {
    let counts = Fault::ALL.map(|fault| (fault, tally.count(fault)));
    counts.into_iter().filter(|(_, count)| *count > 0).collect()
}

#[test]
fn certify_honest_engine_has_no_fault_but_rounding() {
    let (tally, failures) = judged(|_, truth| Ok(honest(truth)));
    let faults = counts(&tally);
    assert!(
        faults.iter().all(|(fault, _)| *fault == Fault::Early),
        "{faults:?}"
    );
    assert!(tally.worst(Fault::Early) <= f64::EPSILON);
    assert_eq!(failures, [""; 0]);
}

#[test]
fn certify_dropped_hits_are_tunnels_and_missed_grazes() {
    let (tally, failures) = judged(|query, truth| {
        let dropped = Report {
            verdict: Claim::Miss,
            ..honest(truth)
        };
        Ok(if is_chosen(query) {
            dropped
        } else {
            honest(truth)
        })
    });
    let hits: Vec<_> = queries()
        .filter(|(query, _)| is_chosen(query))
        .filter_map(|(_, truth)| truth.hit)
        .collect();
    let tunnels = hits.iter().filter(|hit| hit.crosses).count() as u64;
    assert!(tunnels > 0);
    assert_eq!(tally.count(Fault::Tunnel), tunnels);
    assert_eq!(tally.count(Fault::MissedGraze), hits.len() as u64 - tunnels);
    assert_eq!(failures.len(), 1);
    assert!(failures[0].starts_with(&format!("liar: {tunnels} tunnels, ")));
}

#[test]
fn certify_invented_hits_are_false_hits_with_their_gap() {
    let invent = |query: &Query, truth: ExactAnswer| {
        let invented = Report {
            verdict: claim(0.5),
            ..honest(truth)
        };
        let lies = is_chosen(query) && truth.hit.is_none();
        Ok(if lies { invented } else { honest(truth) })
    };
    let gaps: Vec<_> = queries()
        .filter(|(query, truth)| is_chosen(query) && truth.hit.is_none())
        .map(|(query, _)| least_gap(&query).below)
        .collect();
    let (tally, failures) = judged(invent);
    assert!(!gaps.is_empty());
    assert_eq!(tally.count(Fault::FalseHit), gaps.len() as u64);
    assert_eq!(
        tally.worst(Fault::FalseHit),
        gaps.iter().copied().fold(0.0, f64::max)
    );
    assert_eq!(failures, [format!("liar: {} false hits", gaps.len())]);

    let declared = 1.0;
    let declaring = Liar {
        lie: invent,
        near: declared,
    };
    let block = run(&declaring);
    let near = gaps.iter().filter(|gap| **gap < declared).count() as u64;
    assert!(near > 0 && near < gaps.len() as u64);
    assert_eq!(block.tallies[0].count(Fault::NearHit), near);
    assert_eq!(
        block.tallies[0].count(Fault::FalseHit),
        gaps.len() as u64 - near
    );
}

#[test]
fn certify_near_hits_pass_within_the_tolerance_alone() {
    let invent = |_: &Query, truth: ExactAnswer| {
        Ok(Report {
            verdict: claim(truth.hit.map_or(0.5, |hit| hit.toi.below)),
            ..honest(truth)
        })
    };
    let liar = Liar {
        lie: invent,
        near: 1e9,
    };
    let block = run(&liar);
    assert_eq!(block.tallies[0].count(Fault::FalseHit), 0);
    assert_eq!(failures(&panel(&liar), &block), [""; 0]);
    let exact = exact_failures(&panel(&liar), &block);
    assert!(exact[0].ends_with(" near hits"), "{exact:?}");
    let verdicts = details::verdicts(&panel(&liar), &block);
    let lines: Vec<_> = verdicts.lines().collect();
    assert!(
        lines[1].ends_with("passes with its tolerance, near=1e9"),
        "{verdicts}"
    );
    assert!(lines[2].contains("  without it fails: "), "{verdicts}");
}

#[test]
fn certify_late_and_early_are_measured() {
    for (by, fault) in [(1e-3, Fault::Late), (-1e-3, Fault::Early)] {
        let (tally, failures) = judged(|_, truth| {
            let mut report = honest(truth);
            if let Claim::Hit(contact) = &mut report.verdict {
                contact.toi = (contact.toi + by).clamp(0.0, 1.0);
            }
            Ok(report)
        });
        assert!((tally.worst(fault) - 1e-3).abs() < 1e-12);
        assert_eq!(!failures.is_empty(), fault == Fault::Late);
    }
}

#[test]
fn certify_wrong_cases_are_counted_and_do_not_fail_an_engine() {
    let (tally, failures) = judged(|query, truth| {
        let case = if is_chosen(query) {
            Case::General
        } else {
            truth.case
        };
        Ok(Report {
            case: Some(case),
            ..honest(truth)
        })
    });
    let wrong = queries().filter(|(query, truth)| is_chosen(query) && truth.case != Case::General);
    assert_eq!(tally.count(Fault::WrongCase), wrong.count() as u64);
    assert!(tally.count(Fault::WrongCase) > 0);
    assert_eq!(failures, [""; 0]);
}

#[test]
fn certify_queries_that_a_subject_does_not_take_are_counted_and_not_judged() {
    let (tally, failures) = judged(|query, _| Err(Unsupported::Kind(query.kind())));
    let all = queries().count() as u64;
    assert_eq!((tally.not_asked(), counts(&tally)), (all, Vec::new()));
    let all = table::grouped(all);
    let expected = format!("liar: takes none of the {all} queries, so it gave no answer");
    assert_eq!(failures, [expected]);
}

#[test]
fn certify_refusals_of_some_queries_alone_are_found() {
    let refused = queries().filter(|(query, _)| is_chosen(query)).count() as u64;
    assert!(refused > 0);
    let refuse = |reason: fn(&Query) -> Unsupported| {
        judged(move |query, truth| match is_chosen(query) {
            true => Err(reason(query)),
            false => Ok(honest(truth)),
        })
    };
    let (tally, failures) = refuse(|query| Unsupported::Kind(query.kind()));
    assert_eq!(tally.refused_of_taken(), refused);
    let expected = format!("liar: {refused} queries refused of a sort that it takes");
    assert_eq!(failures, [expected]);
    // These have no radius.
    let (tally, failures) = refuse(|_| Unsupported::Radius(1.0.into()));
    let faults = (tally.not_asked(), tally.count(Fault::NoAnswer));
    assert_eq!(faults, (0, refused));
    assert_eq!(tally.lapses, [(LapseKind::Refused, refused)].into());
    assert_eq!(
        failures,
        [format!("liar: {refused} queries without answer")]
    );
}

#[test]
fn certify_panics_and_meaningless_numbers_are_no_answers() {
    let chosen = queries().filter(|(query, _)| is_chosen(query));
    let hits = chosen.filter(|(_, truth)| truth.hit.is_some()).count() as u64;
    let lies = |query: &Query, truth: &ExactAnswer| is_chosen(query) && truth.hit.is_some();
    let (panics, failures) = judged(|query, truth| match lies(query, &truth) {
        true => std::panic::resume_unwind(Box::new("broken")),
        false => Ok(honest(truth)),
    });
    assert_eq!(panics.count(Fault::NoAnswer), hits);
    assert_eq!(panics.lapses, [(LapseKind::Panicked, hits)].into());
    assert_eq!(failures, [format!("liar: {hits} queries without answer")]);
    for toi in [f64::NAN, f64::INFINITY, -0.5, 1.5] {
        let (tally, _) = judged(|query, truth| {
            let mut report = honest(truth);
            if lies(query, &truth) {
                report.verdict = claim(toi);
            }
            Ok(report)
        });
        assert_eq!(tally.count(Fault::NoAnswer), hits, "{toi}");
        assert_eq!(tally.lapses, [(LapseKind::NoTime, hits)].into());
    }
}

/// An exact subject that is off by one neighbour in the time of impact of chosen queries.
struct AlmostExact;

impl Subject for AlmostExact {
    fn name(&self) -> &str {
        "almost exact"
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        let mut answer = decide_query(query);
        if let Some(hit) = answer.hit.as_mut().filter(|_| is_chosen(query)) {
            hit.toi = Enclosure {
                below: hit.toi.below,
                above: hit.toi.below.next_up(),
            };
        }
        Ok(Answer::Exact(answer))
    }
}

#[test]
fn certify_exact_subject_off_by_a_neighbour_differs() {
    let is_f64 = |truth: &ExactAnswer| truth.hit.is_some_and(|hit| hit.toi.is_exact());
    let chosen = queries().filter(|(query, truth)| is_chosen(query) && is_f64(truth));
    let count = chosen.count() as u64;
    let block = run(&AlmostExact);
    assert!(count > 0);
    assert_eq!(block.tallies[0].count(Fault::Differs), count);
    assert_eq!(block.agreements[0].disagreements.count, 0);

    let panel = Panel {
        second_judges: vec![&AlmostExact],
        subjects: Vec::new(),
    };
    let block = panel.run(&lattice().into(), |_| {}).unwrap();
    assert_eq!(block.agreements[0].disagreements.count, count);
    let expected = format!("oracle and almost exact disagree on {count} queries");
    assert_eq!(failures(&panel, &block), [expected]);
}

#[test]
fn certify_wrong_labels_are_found() {
    let mut file = tempfile::Builder::new()
        .suffix(".jsonl")
        .tempfile()
        .unwrap();
    let mut wrong = 0;
    for (index, entry) in lattice().entries().unwrap().take(100).enumerate() {
        let mut entry = entry.unwrap();
        let truth = decide_query(&entry.query).hit.is_some();
        wrong += u64::from(index % 7 == 0);
        entry.label = Some(truth != (index % 7 == 0));
        writeln!(file, "{}", jsonl::write(&entry, Numbers::Decimal)).unwrap();
    }
    let path = file.path().to_str().unwrap().to_owned();
    let source = Source::File {
        path: path.clone(),
        options: ReadOptions::default(),
    };
    let panel = panel(&Oracle);
    let block = panel.run(&source.clone().into(), |_| {}).unwrap();
    assert_eq!((block.labels, block.wrong_labels.count), (100, wrong));
    let witness = block.wrong_labels.worst.as_ref().unwrap();
    assert_eq!(witness.id, format!("{path}#lattice:3:0"));
    let entry = crate::corpus::locate::locate(&witness.id, ReadOptions::default()).unwrap();
    assert_eq!(AnyQuery::from(entry.query), witness.query);
    assert_eq!(failures(&panel, &block).len(), 1);
}

#[test]
fn certify_result_does_not_depend_on_the_threads() {
    let blocks = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        let thesis = crate::registry::by_name("thesis").unwrap();
        pool.install(|| format!("{:?}", run(thesis)))
    });
    assert_eq!(blocks[0], blocks[1]);
    assert_eq!(blocks[0], blocks[2]);
}

#[test]
fn certify_figures_are_hits_where_the_captions_say_so() {
    let panel = panel(&Oracle);
    let block = panel.run(&Source::Figures.into(), |_| {}).unwrap();
    assert_eq!((block.queries, block.labels), (12, 12));
    assert_eq!(block.wrong_labels.count, 0);
    assert_eq!(failures(&panel, &block), [""; 0]);
}

fn joint() -> Source {
    Source::Family {
        family: generate::by_name("joint").unwrap(),
        seed: 3,
        count: COUNT + 1,
    }
}

/// An engine that is right but for the members of chosen wires of which `drops` is asked.
fn run_joint(drops: impl Fn(&Query) -> bool + Sync) -> (Block, Vec<String>) {
    let liar = Liar {
        lie: |query: &Query, truth| {
            let mut report = honest(truth);
            if drops(query) {
                report.verdict = Claim::Miss;
            }
            Ok(report)
        },
        near: 0.0,
    };
    let panel = panel(&liar);
    let block = panel.run(&joint().into(), |_| {}).unwrap();
    let failures = failures(&panel, &block);
    (block, failures)
}

/// About one wire in ten, chosen by the segment that both of its members share.
fn is_chosen_wire(query: &Query) -> bool {
    let bits = query.start()[2].x.to_bits() ^ query.end()[3].y.to_bits();
    (bits ^ bits >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32 < (1 << 32) / 10
}

/// The two queries of each whole wire.
fn members() -> Vec<[Query; 2]> {
    let entries = joint().entries().unwrap();
    let queries: Vec<_> = entries.map(|entry| entry.unwrap().query).collect();
    queries
        .chunks_exact(2)
        .map(|pair| [pair[0], pair[1]])
        .collect()
}

#[test]
fn certify_wires_missed_by_both_segments_are_joint_tunnels() {
    let chosen = members()
        .into_iter()
        .filter(|[first, _]| is_chosen_wire(first));
    let chosen = chosen.count() as u64;
    let (block, failures) = run_joint(is_chosen_wire);
    let tally = &block.tallies[0];
    assert!(chosen > 50, "{chosen}");
    assert_eq!((block.queries, block.joints), (COUNT + 1, COUNT / 2));
    assert_eq!(tally.count(Fault::JointTunnel), chosen);
    assert!(
        failures[0].contains(&format!("{chosen} joint tunnels")),
        "{failures:?}"
    );
    let witness = tally.faults[&Fault::JointTunnel].worst.as_ref().unwrap();
    assert!(witness.query.linear().is_some_and(is_chosen_wire) && witness.truth.hit.is_some());
    assert_eq!(witness.severity, tally.worst(Fault::JointTunnel));
}

#[test]
fn certify_wires_hit_by_one_segment_are_no_joint_tunnels() {
    let is_hit = |query: &Query| decide_query(query).hit.is_some();
    // Of the wires that hit both segments, one hit is dropped: a fault, but the wire is held.
    let dropped: Vec<Query> = (members().into_iter())
        .filter(|pair| pair.iter().all(is_hit))
        .map(|[first, _]| first)
        .collect();
    let (block, failures) = run_joint(|query| dropped.contains(query));
    let tally = &block.tallies[0];
    let missed = tally.count(Fault::Tunnel) + tally.count(Fault::MissedGraze);
    assert_eq!(missed, dropped.len() as u64);
    assert!(missed > 100, "{missed}");
    assert_eq!(tally.count(Fault::JointTunnel), 0);
    assert!(!failures[0].contains("joint"), "{failures:?}");
}

#[test]
fn certify_says_who_misses_joints_where_there_are_any() {
    let (block, _) = run_joint(is_chosen_wire);
    let liar = Liar {
        lie: |_: &Query, truth| Ok(honest(truth)),
        near: 0.0,
    };
    let panel = panel(&liar);
    let count = block.tallies[0].count(Fault::JointTunnel);
    let said = format!("of 750 wires that are passed at a joint, {count} are missed by liar");
    let text = table::agreement(&panel, &block);
    assert!(text.contains(&said), "{text}");
    assert!(!table::agreement(&panel, &run(&liar)).contains("wires"));
}
