//! Bodies that turn: the certified path against the oracle, and the oracle against the second judge.
//!
//! The first bytes choose a family, whose random numbers are the bytes that follow, or small integers
//! or numbers of any bits within a factor of `2^30` of 1; then a few numbers are changed.
//! Queries with a radius are compared where their numbers are small integers: of others the oracle now
//! and then takes ten seconds, which a fuzzer calls a hang.

use arbitrary::Unstructured;
use nalgebra::Quaternion;
use tunnelproof::query::Point;
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion, RigidQuery, VertexTurningFace};
use tunnelproof_reference::certify::verdict::judge;
use tunnelproof_reference::corpus::jsonl::Numbers as Format;
use tunnelproof_reference::corpus::turning::{self, Fields, TurningEntry};
use tunnelproof_reference::generate::{RIGID_FAMILIES, RigidFamily};
use tunnelproof_reference::oracle::decide_rigid_query;
use tunnelproof_reference::registry::turning_subjects;
use tunnelproof_reference::subject::Answer;

use super::input::{Numbers, byte, finite, word};

/// What is wrong: who differs from the oracle, and the query.
pub(super) fn check(bytes: &[u8]) -> Option<String> {
    let query = query(bytes);
    if !query.radius().is_zero() && !is_of_small_integers(&query) {
        return None;
    }
    let truth = decide_rigid_query(&query);
    let is_wrong = |answer: &Answer| judge(&truth, Some(answer), || false).differs;
    let wrong = turning_subjects()
        .into_iter()
        .skip_while(|subject| subject.name() == "oracle")
        .find(|subject| {
            subject
                .turning_answer(&query)
                .map_or(true, |answer| is_wrong(&answer))
        })?;
    let entry = TurningEntry {
        id: "turning".to_owned(),
        query,
        label: Some(truth.hit.is_some()),
    };
    let line = turning::write(&entry, Format::Hexadecimal);
    Some(format!("{} differs from the oracle: {line}", wrong.name()))
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
    with_numbers(fields, query.radius().parts())
}

fn of_numbers(
    bytes: &mut Unstructured,
    mut number: impl FnMut(&mut Unstructured) -> f64,
) -> Option<RigidQuery> {
    let more = byte(bytes);
    let (points, local) = if more & 1 == 0 { (4, 2) } else { (2, 3) };
    let mut row = || [0; 3].map(|_| number(bytes));
    let points = (0..points).map(|_| row()).collect();
    let local = (0..local).map(|_| row()).collect();
    let poses = [0; 2].map(|_| [0; 7].map(|_| number(bytes)));
    let fields = Fields {
        points,
        local,
        poses,
    };
    let mut radius = |bit: u8| match more & bit {
        0 => 0.0,
        _ => number(bytes).abs(),
    };
    with_numbers(fields, [radius(2), radius(4)])
}

fn with_numbers(fields: Fields, radius: [f64; 2]) -> Option<RigidQuery> {
    let [start, end] = fields
        .poses
        .map(|[x, y, z, w, i, j, k]| Pose::new(Point::new(x, y, z), Quaternion::new(w, i, j, k)));
    let motion = RigidMotion::new(start, end).ok()?;
    let point = |p: &[f64; 3]| Point::from(*p);
    let points: Vec<Point> = fields.points.iter().map(point).collect();
    let local: Vec<Point> = fields.local.iter().map(point).collect();
    match (&points[..], &local[..]) {
        (&[a, b, a1, b1], &[c, d]) => {
            EdgeTurningEdge::with_radius([a, b], [a1, b1], [c, d], motion, radius)
                .ok()
                .map(RigidQuery::EdgeTurningEdge)
        }
        (&[a, a1], &[b, c, d]) => {
            VertexTurningFace::with_radius([a], [a1], [b, c, d], motion, radius)
                .ok()
                .map(RigidQuery::VertexTurningFace)
        }
        _ => None,
    }
}
