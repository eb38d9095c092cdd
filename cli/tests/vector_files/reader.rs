//! Reads vector files as anyone would who has nothing but the schema.

use std::fs;
use std::path::PathBuf;

use serde::Deserialize;
use tunnelproof::query::{Point, Query, QueryKind};

#[derive(Deserialize)]
struct File {
    vectors: Vec<Vector>,
}

#[derive(Clone, Deserialize)]
pub(crate) struct Vector {
    pub(crate) id: String,
    pub(crate) flags: Vec<String>,
    pub(crate) wire: Option<Wire>,
    pub(crate) kind: String,
    pub(crate) radius: Radius<f64>,
    pub(crate) radius_hex: Radius<String>,
    pub(crate) points: [[f64; 3]; 8],
    pub(crate) points_hex: [[String; 3]; 8],
    pub(crate) result: Outcome,
    pub(crate) exact_toi: Option<ExactTime>,
}

/// One number, or two whose sum it is.
#[derive(Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Radius<T> {
    One(T),
    Sum([T; 2]),
}

#[derive(Clone, Deserialize)]
pub(crate) struct Wire {
    pub(crate) id: String,
}

#[derive(Clone, Deserialize)]
pub(crate) struct Outcome {
    pub(crate) hit: bool,
    pub(crate) case: String,
    pub(crate) toi: Option<Bounds>,
    pub(crate) kind_of_contact: Option<String>,
    pub(crate) crosses: Option<bool>,
    pub(crate) side: Option<i8>,
    pub(crate) features: Option<[String; 2]>,
    pub(crate) temporarily_parallel: Option<bool>,
    pub(crate) temporarily_point: Option<bool>,
    pub(crate) u: Option<Bounds>,
    pub(crate) v: Option<Bounds>,
    pub(crate) overlap: Option<Place>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct Bounds {
    pub(crate) below: f64,
    pub(crate) above: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct Place {
    pub(crate) u: Bounds,
    pub(crate) v: Bounds,
}

#[derive(Clone, Deserialize)]
pub(crate) struct ExactTime {
    pub(crate) fraction: Option<[String; 2]>,
    pub(crate) root: Option<Root>,
}

#[derive(Clone, Deserialize)]
pub(crate) struct Root {
    pub(crate) polynomial: Vec<String>,
    pub(crate) interval: [[String; 2]; 2],
}

impl Vector {
    pub(crate) fn query(&self) -> Query {
        let [a, b, c, d, a1, b1, c1, d1] = self.points.map(Point::from);
        let kind = match self.kind.as_str() {
            "edge-edge" => QueryKind::EdgeEdge,
            "vertex-face" => QueryKind::VertexFace,
            kind => panic!("{}: {kind}", self.id),
        };
        let radii = match self.radius {
            Radius::One(radius) => [radius, 0.0],
            Radius::Sum(radii) => radii,
        };
        Query::new(kind, [a, b, c, d], [a1, b1, c1, d1], radii).unwrap()
    }

    pub(crate) fn is_of_edges(&self) -> bool {
        self.kind == "edge-edge"
    }
}

impl<T> Radius<T> {
    pub(crate) fn parts(&self) -> &[T] {
        match self {
            Radius::One(radius) => std::slice::from_ref(radius),
            Radius::Sum(radii) => radii,
        }
    }
}

pub(crate) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../vectors")
}

/// The files of vectors, in alphabetical order.
pub(crate) fn names() -> Vec<String> {
    let entries = fs::read_dir(folder()).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let is_vectors = |name: &String| name.ends_with(".json") && name != "schema.json";
    let mut names: Vec<_> = names.filter(is_vectors).collect();
    names.sort();
    names
}

pub(crate) fn vectors() -> Vec<Vector> {
    let read = |name: String| {
        let text = fs::read_to_string(folder().join(&name)).unwrap();
        let file: File =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        file.vectors
    };
    names().into_iter().flat_map(read).collect()
}
