//! Bodies that turn: the certified path with its normals against the oracle, and the oracle against
//! the second judge.
//!
//! The first bytes choose a family, whose random numbers are the bytes that follow, or small integers
//! or numbers of any bits within a factor of `2^30` of 1; then a few numbers are changed.
//! Queries with a radius are compared where their numbers are small integers: of others the oracle now
//! and then takes ten seconds, which a fuzzer calls a hang.

use arbitrary::Unstructured;
use tunnelproof::certified::decide_rigid;
use tunnelproof::rigid::{Lengths, RigidQuery, RigidQueryKind};
use tunnelproof_reference::certify::verdict::judge;
use tunnelproof_reference::corpus::jsonl::Numbers as Format;
use tunnelproof_reference::corpus::turning::{self, Fields, TurningEntry};
use tunnelproof_reference::generate::{RIGID_FAMILIES, RigidFamily};
use tunnelproof_reference::normal::ExactNormal;
use tunnelproof_reference::oracle::decide_rigid_query;
use tunnelproof_reference::registry::turning_subjects;
use tunnelproof_reference::subject::Answer;

use super::input::{Numbers, byte, finite, word};
use super::judges::wrong_normal;

/// What is wrong: who differs from the oracle, and the query.
pub(super) fn check(bytes: &[u8]) -> Option<String> {
    let query = query(bytes);
    if !query.radius().is_zero() && !is_of_small_integers(&query) {
        return None;
    }
    let truth = decide_rigid_query(&query);
    let is_wrong = |answer: &Answer| judge(&truth, Some(answer), || false).differs;
    let wrong_subject = turning_subjects()
        .into_iter()
        .skip_while(|subject| subject.name() == "oracle")
        .find(|subject| {
            subject
                .turning_answer(&query)
                .map_or(true, |answer| is_wrong(&answer))
        });
    let wrong = match wrong_subject {
        Some(subject) => format!("{} differs from the oracle", subject.name()),
        None => {
            let found = decide_rigid(&query)?.normal(&query);
            wrong_normal(ExactNormal::of_rigid(&query), found)?
        }
    };
    let entry = TurningEntry {
        id: "turning".to_owned(),
        query,
        label: Some(truth.hit.is_some()),
    };
    let line = turning::write(&entry, Format::Hexadecimal);
    Some(format!("{wrong}: {line}"))
}

fn is_of_small_integers(query: &RigidQuery) -> bool {
    let fields = Fields::of(query);
    let points = fields.points.iter().chain(&fields.local).flatten();
    let mut numbers = points.chain(fields.poses.iter().flatten());
    numbers.all(|number| number.fract() == 0.0 && number.abs() <= 64.0)
}

/// The query that these bytes make.
fn query(bytes: &[u8]) -> RigidQuery {
    let mut bytes = Unstructured::new(bytes);
    let base = byte(&mut bytes);
    let family = &RIGID_FAMILIES[usize::from(byte(&mut bytes)) % RIGID_FAMILIES.len()];
    let made = match base % 4 {
        0 => of_numbers(&mut bytes, |bytes| {
            f64::from(i16::from(byte(bytes) % 7) - 3)
        }),
        1 => of_numbers(&mut bytes, |bytes| finite(word(bytes), 30)),
        _ => changed(&mut bytes, base >> 2 & 3, family),
    };
    made.unwrap_or_else(|| family.query(0, u64::from(base)))
}

/// A query of the family with so many numbers changed, if it is one then.
fn changed(bytes: &mut Unstructured, count: u8, family: &RigidFamily) -> Option<RigidQuery> {
    let changes: Vec<[u8; 3]> = (0..count).map(|_| [(); 3].map(|()| byte(bytes))).collect();
    let query = family.draw(&mut Numbers::new(bytes));
    let mut fields = Fields::of(&query);
    let mut numbers: Vec<&mut f64> = fields.points.iter_mut().flatten().collect();
    numbers.extend(fields.local.iter_mut().flatten());
    numbers.extend(fields.poses.iter_mut().flatten());
    for [place, from, how] in changes {
        let (place, from) = (
            usize::from(place) % numbers.len(),
            usize::from(from) % numbers.len(),
        );
        *numbers[place] = match how % 4 {
            0 => numbers[place].next_up(),
            1 => numbers[place].next_down(),
            2 => f64::from(i16::from(how) / 4 - 32),
            _ => *numbers[from],
        };
    }
    fields.query(query.kind(), query.radius()).ok()
}

fn of_numbers(
    bytes: &mut Unstructured,
    mut number: impl FnMut(&mut Unstructured) -> f64,
) -> Option<RigidQuery> {
    let more = byte(bytes);
    let kind = match more & 0b1001 {
        0 => RigidQueryKind::EdgeTurningEdge,
        1 => RigidQueryKind::VertexTurningFace,
        8 => RigidQueryKind::TurningEdgeTurningEdge,
        _ => RigidQueryKind::TurningVertexTurningFace,
    };
    let Lengths {
        points,
        local,
        poses,
    } = kind.lengths();
    let mut row = || [0; 3].map(|_| number(bytes));
    let points = (0..points).map(|_| row()).collect();
    let local = (0..local).map(|_| row()).collect();
    let poses = (0..poses).map(|_| [0; 7].map(|_| number(bytes))).collect();
    let fields = Fields {
        points,
        local,
        poses,
    };
    let mut radius = |bit: u8| match more & bit {
        0 => 0.0,
        _ => number(bytes).abs(),
    };
    fields.query(kind, [radius(2), radius(4)].into()).ok()
}
