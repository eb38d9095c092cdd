//! The step of a mesh as JSON and as text.

use serde::Serialize;
use tunnelproof::mesh::{Feature, Mesh, MeshContact, MeshStep, Pair};
use tunnelproof::query::QueryKind;
use tunnelproof_reference::report::number::{counted, short};

use super::step::{blocked_name, rounded_down};
use crate::meshes::audit::{Audit, Disagreement, Place};

/// What the engine says of a mesh in motion, and what the oracle says of that.
#[derive(Serialize)]
pub struct StepReport {
    toi: Option<Bounds>,
    pair: Option<PairRow>,
    step: f64,
    limits: Vec<LimitRow>,
    near: Vec<NearRow>,
    candidates: Kinds,
    vertices: usize,
    edges: usize,
    faces: usize,
    seconds: Seconds,
    threads: usize,
    audit: Option<AuditRow>,
}

/// How long the engine took, without the reading of files.
#[derive(Clone, Copy, Serialize)]
pub struct Seconds {
    /// For the first contact.
    pub first_contact: f64,
    /// For the step.
    pub step: f64,
}

#[derive(Clone, Copy, Serialize)]
struct Bounds {
    below: f64,
    above: f64,
}

/// How many pairs of each kind.
#[derive(Serialize)]
struct Kinds {
    #[serde(rename = "edge-edge")]
    edge_edge: usize,
    #[serde(rename = "vertex-face")]
    vertex_face: usize,
}

#[derive(Serialize)]
struct PairRow {
    kind: &'static str,
    features: [FeatureRow; 2],
    vertices: Option<[u32; 4]>,
}

#[derive(Serialize)]
struct FeatureRow {
    kind: &'static str,
    index: u32,
}

#[derive(Serialize)]
struct LimitRow {
    pair: PairRow,
    blocked: &'static str,
}

#[derive(Serialize)]
struct NearRow {
    pair: PairRow,
    kept: f64,
}

#[derive(Serialize)]
struct AuditRow {
    pairs: Kinds,
    contacts: usize,
    disagreements: usize,
    stored_pairs: usize,
    stored_contacts: usize,
    /// The first of what is wrong.
    faults: Vec<FaultRow>,
}

#[derive(Serialize)]
struct FaultRow {
    /// `pair`, `first_contact` or `stored`.
    what: &'static str,
    kind: Option<&'static str>,
    vertices: Option<[u32; 4]>,
    expected: Option<Bounds>,
    found: Option<Bounds>,
}

/// How many faults a report lists.
const FAULTS: usize = 10;

impl StepReport {
    /// A report of what was asked about a mesh.
    pub fn new<C>(
        mesh: &Mesh,
        first: Option<&MeshContact>,
        step: &MeshStep<C>,
        seconds: Seconds,
        audit: Option<Audit>,
    ) -> Self {
        let row = |pair| PairRow::new(mesh, pair);
        let limits = step.limits.iter().map(|limit| LimitRow {
            pair: row(limit.pair),
            blocked: blocked_name(limit.blocked),
        });
        let near = step.near.iter().map(|(pair, kept)| NearRow {
            pair: row(*pair),
            kept: rounded_down(*kept),
        });
        StepReport {
            toi: first.map(|contact| Bounds {
                below: contact.toi,
                above: contact.toi_above,
            }),
            pair: first.map(|contact| row(contact.pair)),
            step: step.step,
            limits: limits.collect(),
            near: near.collect(),
            candidates: step.candidates.into(),
            vertices: mesh.vertex_count(),
            edges: mesh.edges().len(),
            faces: mesh.faces().len(),
            seconds,
            threads: rayon::current_num_threads(),
            audit: audit.as_ref().map(AuditRow::new),
        }
    }

    /// Whether something touches in the whole step.
    pub fn touches(&self) -> bool {
        self.toi.is_some()
    }

    /// Whether the oracle does not agree.
    pub fn has_fault(&self) -> bool {
        let has_fault = |audit: &AuditRow| audit.disagreements + audit.stored_contacts > 0;
        self.audit.as_ref().is_some_and(has_fault)
    }

    /// As JSON.
    pub fn json(&self) -> String {
        let json = serde_json::to_string_pretty(self).expect("a result is written as JSON");
        json + "\n"
    }

    /// As a few lines of text.
    pub fn text(&self) -> String {
        let mut lines = vec![
            format!(
                "{}, {}, {}",
                counted(self.vertices, "vertex", "vertices"),
                counted(self.edges, "edge", "edges"),
                counted(self.faces, "triangle", "triangles")
            ),
            format!("candidate pairs: {}", self.candidates.text()),
            match (&self.toi, &self.pair) {
                (Some(toi), Some(pair)) => {
                    format!("first contact: {} at {}", pair.text(), short(toi.below))
                }
                _ => "first contact: none".to_owned(),
            },
            format!("step: {}{}", short(self.step), self.end_of_step()),
        ];
        if let [first, ..] = &self.near[..] {
            lines.push(format!(
                "pairs that start too near: {}, the first is {}, which keeps {} m",
                self.near.len(),
                first.pair.text(),
                short(first.kept)
            ));
        }
        lines.push(format!(
            "first contact in {:.6} s, step in {:.6} s, on {}",
            self.seconds.first_contact,
            self.seconds.step,
            counted(self.threads, "thread", "threads")
        ));
        lines.extend(self.audit.iter().flat_map(AuditRow::lines));
        lines.join("\n") + "\n"
    }

    fn end_of_step(&self) -> String {
        match &self.limits[..] {
            [] => String::new(),
            [LimitRow { pair, blocked }] => format!(", ended by {} ({blocked})", pair.text()),
            [LimitRow { pair, blocked }, rest @ ..] => format!(
                ", ended by {} ({blocked}) and {} more",
                pair.text(),
                rest.len()
            ),
        }
    }
}

impl From<[usize; 2]> for Kinds {
    fn from([edge_edge, vertex_face]: [usize; 2]) -> Self {
        Kinds {
            edge_edge,
            vertex_face,
        }
    }
}

impl Kinds {
    fn text(&self) -> String {
        format!(
            "{} edge-edge, {} vertex-face",
            self.edge_edge, self.vertex_face
        )
    }
}

impl PairRow {
    fn new(mesh: &Mesh, pair: Pair) -> Self {
        let features = [pair.first, pair.second].map(|feature| match feature {
            Feature::Vertex(index) => FeatureRow {
                kind: "vertex",
                index,
            },
            Feature::Edge(index) => FeatureRow {
                kind: "edge",
                index,
            },
            Feature::Face(index) => FeatureRow {
                kind: "face",
                index,
            },
        });
        let kind = match pair.second {
            Feature::Face(_) => QueryKind::VertexFace,
            _ => QueryKind::EdgeEdge,
        };
        PairRow {
            kind: kind.name(),
            features,
            vertices: mesh.vertices_of(pair),
        }
    }

    fn text(&self) -> String {
        let [first, second] = [0, 1].map(|side| self.feature_text(side));
        format!("{first} and {second}")
    }

    /// One of both sides; an edge with its vertices, as no file may name it.
    fn feature_text(&self, side: usize) -> String {
        let FeatureRow { kind, index } = &self.features[side];
        match (*kind, self.vertices) {
            ("edge", Some(vertices)) => {
                let (a, b) = (vertices[2 * side], vertices[2 * side + 1]);
                format!("edge {index} ({a}-{b})")
            }
            ("face", _) => format!("triangle {index}"),
            (kind, _) => format!("{kind} {index}"),
        }
    }
}

impl AuditRow {
    fn new(audit: &Audit) -> Self {
        let pairs = audit.disagreements.iter().map(FaultRow::of_pair);
        let stored = audit.stored_contacts.iter().map(FaultRow::of_stored);
        AuditRow {
            pairs: audit.pairs.into(),
            contacts: audit.contacts,
            disagreements: audit.disagreements.len(),
            stored_pairs: audit.stored_pairs,
            stored_contacts: audit.stored_contacts.len(),
            faults: pairs.chain(stored).take(FAULTS).collect(),
        }
    }

    fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!(
                "audit of the whole step: {}; contacts: {}; disagreements: {}",
                self.pairs.text(),
                self.contacts,
                self.disagreements
            ),
            format!(
                "audit of the motion to the positions to store: {}; contacts: {}",
                counted(self.stored_pairs, "pair", "pairs"),
                self.stored_contacts
            ),
        ];
        lines.extend(self.faults.iter().map(FaultRow::text));
        lines
    }
}

impl FaultRow {
    fn of_pair(fault: &Disagreement) -> Self {
        let bounds = |toi: Option<[f64; 2]>| toi.map(|[below, above]| Bounds { below, above });
        FaultRow {
            what: match fault.place {
                Some(_) => "pair",
                None => "first_contact",
            },
            expected: bounds(fault.expected),
            found: bounds(fault.found),
            ..FaultRow::at(fault.place.as_ref())
        }
    }

    fn of_stored(place: &Place) -> Self {
        FaultRow::at(Some(place))
    }

    fn at(place: Option<&Place>) -> Self {
        FaultRow {
            what: "stored",
            kind: place.map(|place| place.kind.name()),
            vertices: place.map(|place| place.vertices),
            expected: None,
            found: None,
        }
    }

    fn text(&self) -> String {
        let toi = |toi: Option<Bounds>| match toi {
            Some(Bounds { below, .. }) => format!("a contact at {}", short(below)),
            None => "no contact".to_owned(),
        };
        let place = match (self.kind, self.vertices) {
            (Some(kind), Some(vertices)) => format!("{kind} of the vertices {vertices:?}"),
            _ => "the first contact of all".to_owned(),
        };
        match self.what {
            "stored" => {
                format!("fault: {place} comes too near on the way to the positions to store")
            }
            _ => format!(
                "fault: {place}: the oracle finds {}, the engine {}",
                toi(self.expected),
                toi(self.found)
            ),
        }
    }
}
