//! A query of bodies that turn explained in text: its numbers, the turns, the exact answer and what
//! everyone says.

use std::fmt::Write as _;

use tunnelproof::rigid::{RigidMotion, Side};
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::corpus::turning::TurningEntry;
use tunnelproof_reference::report::explanation::{self, Statement};
use tunnelproof_reference::report::number;

/// The text for a query, its exact answer, and what these subjects say.
pub fn explain(entry: &TurningEntry, truth: &ExactAnswer, subjects: &[Judged]) -> String {
    let query = &entry.query;
    let mut text = format!("{}\n\n  {}\n", entry.id, query.kind());
    let mut names = NAMES.iter();
    for (side, of) in query.sides().iter().zip(["first", "second"]) {
        let names: Vec<_> = names.by_ref().take(side.number_of_points()).collect();
        match side {
            Side::Straight { start, end } => {
                for (time, points) in [start, end].iter().enumerate() {
                    for (name, point) in names.iter().zip(**points) {
                        row(
                            &mut text,
                            &format!("{name}({time})"),
                            point.coords.as_slice(),
                        );
                    }
                }
            }
            Side::Turning { local, motion } => {
                for (name, point) in names.iter().zip(*local) {
                    row(&mut text, &format!("{name} local"), point.coords.as_slice());
                }
                poses(&mut text, motion);
                let _ = writeln!(
                    text,
                    "  The {of} side turns by {:.3} degrees.",
                    motion.degrees()
                );
            }
        }
    }
    if !query.radius().is_zero() {
        let _ = writeln!(text, "  radius  {}", query.radius());
    }
    let _ = writeln!(
        text,
        "\nCase: {}: {}",
        truth.case,
        explanation::case_words(truth.case, query.kind().linear())
    );
    match &truth.hit {
        Some(hit) => {
            let lines = explanation::contact(hit, !query.radius().is_zero());
            let _ = write!(text, "\nTime of impact\n{lines}");
        }
        None => text.push_str("\nNo contact.\n"),
    }
    let query = AnyQuery::from(*query);
    let said: Vec<_> = subjects
        .iter()
        .map(|subject| Statement::new(subject, &query, truth))
        .collect();
    text + "\n" + &explanation::statements(&said)
}

const NAMES: [char; 4] = ['A', 'B', 'C', 'D'];

fn row(text: &mut String, name: &str, numbers: &[f64]) {
    let numbers: Vec<_> = numbers.iter().map(|&x| number::short(x)).collect();
    let _ = writeln!(text, "  {name:<14}  {}", numbers.join("  "));
}

fn poses(text: &mut String, motion: &RigidMotion) {
    for (time, pose) in [motion.start(), motion.end()].iter().enumerate() {
        let q = pose.quaternion;
        row(
            text,
            &format!("centre({time})"),
            pose.centre.coords.as_slice(),
        );
        row(text, &format!("quaternion({time})"), &[q.w, q.i, q.j, q.k]);
    }
}
