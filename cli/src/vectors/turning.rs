//! Vectors of bodies that turn: of every family the simplest queries of every class.
//!
//! Two queries are of one class if they are of one kind, have the same case, flags and features,
//! both hit or both miss at the same part of the step, and have the same kind of contact.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use tunnelproof_reference::answer::{ExactAnswer, ExactHit};
use tunnelproof_reference::corpus::hexfloat;
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::corpus::turning::Fields;
use tunnelproof_reference::field;
use tunnelproof_reference::generate::{RIGID_FAMILIES, RigidFamily};
use tunnelproof_reference::oracle::decide_rigid;
use tunnelproof_reference::report::answer;

use super::exact_time::{ExactTime, Fraction};
use super::{VectorFile, layout};

/// The folder of these files, in that of all.
pub const FOLDER: &str = "turning";

const SEED: u64 = 1;
/// How many queries of a family are looked at.
const QUERIES: u64 = 500;
/// How many queries of a class are taken.
const MEMBERS: usize = 1;

#[derive(Serialize)]
struct Document {
    schema: &'static str,
    generator: &'static str,
    source: String,
    number_of_vectors: usize,
    vectors: Vec<Vector>,
}

#[derive(Serialize)]
struct Vector {
    id: String,
    kind: &'static str,
    /// In metres: a number, or two whose exact sum it is.
    radius: Value,
    radius_hex: Value,
    /// In space; two bodies have none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<[f64; 3]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points_hex: Vec<[String; 3]>,
    local: Vec<[f64; 3]>,
    local_hex: Vec<[String; 3]>,
    poses: Vec<[f64; 7]>,
    poses_hex: Vec<[String; 7]>,
    result: answer::Fields,
    /// Of the exact time of impact, if it is one.
    fraction: Option<Fraction>,
    #[serde(skip)]
    class: String,
    /// How many digits the numbers have.
    #[serde(skip)]
    length: usize,
}

/// A file for each family.
pub(super) fn files() -> Vec<VectorFile> {
    RIGID_FAMILIES.iter().map(file).collect()
}

fn file(family: &'static RigidFamily) -> VectorFile {
    let indices = (0..QUERIES).into_par_iter();
    let all: Vec<_> = indices.map(|index| Vector::new(family, index)).collect();
    let vectors = simplest(all);
    let name = family.name();
    let document = Document {
        schema: "schema.json",
        generator: concat!("tunnelproof ", env!("CARGO_PKG_VERSION"), " vectors"),
        source: format!(
            "a selection of the first {QUERIES} queries of the family {name}, seed {SEED}: {}",
            family.description()
        ),
        number_of_vectors: vectors.len(),
        vectors,
    };
    VectorFile {
        name: format!("{FOLDER}/{name}.json"),
        text: layout::text(&document),
        vectors: document.number_of_vectors,
    }
}

/// Those of each class with the fewest digits, in their order.
fn simplest(vectors: Vec<Vector>) -> Vec<Vector> {
    let mut classes: BTreeMap<String, Vec<(usize, usize)>> = BTreeMap::new();
    for (index, vector) in vectors.iter().enumerate() {
        let class = classes.entry(vector.class.clone()).or_default();
        class.push((vector.length, index));
    }
    let chosen = classes.into_values().flat_map(|mut members| {
        members.sort_unstable();
        members.into_iter().take(MEMBERS).map(|(_, index)| index)
    });
    let mut chosen: Vec<usize> = chosen.collect();
    chosen.sort_unstable();
    let mut chosen = chosen.into_iter().peekable();
    let of_chosen = |(index, vector): (usize, Vector)| chosen.next_if_eq(&index).map(|_| vector);
    vectors
        .into_iter()
        .enumerate()
        .filter_map(of_chosen)
        .collect()
}

impl Vector {
    fn new(family: &RigidFamily, index: u64) -> Self {
        let query = family.query(SEED, index);
        let decision = decide_rigid::<field::Default>(&query);
        let answer = decision.written();
        let Fields {
            points,
            local,
            poses,
        } = Fields::of(&query);
        let hex = |points: &[[f64; 3]]| points.iter().map(|p| p.map(hexfloat::format)).collect();
        let numbers = points.iter().chain(&local).flatten();
        let length = numbers.chain(poses.iter().flatten());
        Vector {
            id: format!("{}:{SEED}:{index}", family.name()),
            kind: query.kind().name(),
            radius: jsonl::radius(query.radius(), Numbers::Decimal),
            radius_hex: jsonl::radius(query.radius(), Numbers::Hexadecimal),
            points_hex: hex(&points),
            local_hex: hex(&local),
            poses_hex: poses
                .iter()
                .map(|pose| pose.map(hexfloat::format))
                .collect(),
            length: length.map(|x| x.to_string().len()).sum(),
            points,
            local,
            poses,
            result: answer::Fields::exact(&answer),
            fraction: decision
                .toi()
                .and_then(|toi| ExactTime::new(toi).into_fraction()),
            class: class(query.kind().name(), &answer),
        }
    }
}

fn class(kind: &str, answer: &ExactAnswer) -> String {
    let Some(ExactHit {
        toi,
        kind: contact,
        crosses,
        side,
        features: [first, second],
        second: overlap,
        flags,
        ..
    }) = &answer.hit
    else {
        return format!("{kind} {} miss", answer.case);
    };
    let when = (toi.above == 0.0, toi.below == 1.0, toi.below == toi.above);
    let overlaps = overlap.is_some();
    format!(
        "{kind} {} {when:?} {contact:?} {crosses} {side} {first} {second} {overlaps} {flags:?}",
        answer.case
    )
}
