//! A query of a body that turns explained in text: its numbers, the turn, the exact answer and what
//! everyone says.

use std::fmt::Write as _;

use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::certify::verdict::{Judgement, Verdict, judge};
use tunnelproof_reference::corpus::turning::{Fields, TurningEntry};
use tunnelproof_reference::report::{answer, number};
use tunnelproof_reference::subject::{Answer, Subject};

/// The text for a query, its exact answer, and what these subjects say.
pub fn explain(entry: &TurningEntry, truth: &ExactAnswer, subjects: &[&dyn Subject]) -> String {
    let query = &entry.query;
    let fields = Fields::of(query);
    let mut text = format!("{}\n\n  {}\n", entry.id, query.kind());
    let first = query.start().len();
    for (index, point) in fields.points.iter().enumerate() {
        row(
            &mut text,
            &format!("{}({})", NAMES[index % first], index / first),
            point,
        );
    }
    for (index, point) in fields.local.iter().enumerate() {
        row(&mut text, &format!("{} local", NAMES[first + index]), point);
    }
    for (index, pose) in fields.poses.iter().enumerate() {
        row(&mut text, &format!("centre({index})"), &pose[..3]);
        row(&mut text, &format!("quaternion({index})"), &pose[3..]);
    }
    if !query.radius().is_zero() {
        let _ = writeln!(text, "  radius  {}", query.radius());
    }
    let _ = writeln!(text, "\nThe body turns by {:.3} degrees.", degrees(&fields));
    let _ = writeln!(text, "Case: {}\n", truth.case);
    for subject in subjects {
        let line = match subject.turning_answer(query) {
            Ok(answer) => said(subject.name(), truth, &answer),
            Err(reason) => format!("{}: {reason}", subject.name()),
        };
        let _ = writeln!(text, "{line}");
    }
    text
}

/// What a subject says, and what is wrong with it.
fn said(name: &str, truth: &ExactAnswer, answer: &Answer) -> String {
    let judgement = judge(truth, Some(answer), || false);
    let verdict = match judgement {
        _ if judgement.differs => "  differs from the oracle".to_owned(),
        Judgement {
            verdict: Verdict::Right,
            late,
            ..
        } if late > 0.0 => format!("  late by {late:e}"),
        Judgement {
            verdict: Verdict::Right,
            ..
        } => String::new(),
        Judgement { verdict, .. } => format!("  {}", verdict.name()),
    };
    answer::turning_line(name, answer) + &verdict
}

const NAMES: [char; 4] = ['A', 'B', 'C', 'D'];

fn row(text: &mut String, name: &str, numbers: &[f64]) {
    let numbers: Vec<_> = numbers.iter().map(|&x| number::short(x)).collect();
    let _ = writeln!(text, "  {name:<14}  {}", numbers.join("  "));
}

/// The angle of the turn.
fn degrees(Fields { poses, .. }: &Fields) -> f64 {
    let [q0, q1] = poses.map(|[_, _, _, w, x, y, z]| {
        let largest = [w, x, y, z].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        [w, x, y, z].map(|component| component / largest)
    });
    let product = |x: [f64; 4], y: [f64; 4]| -> f64 { (0..4).map(|i| x[i] * y[i]).sum() };
    let cosine = product(q0, q1).abs() / (product(q0, q0) * product(q1, q1)).sqrt();
    2.0 * cosine.min(1.0).acos().to_degrees()
}
