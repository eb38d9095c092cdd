//! Checks what the engine says of a mesh, by the exact oracle.
//!
//! Edges and pairs are found anew, without the engine's trees: by the swept boxes of the broad
//! phase. The oracle answers every pair whose boxes meet.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rayon::prelude::*;
use tunnelproof::broad::{Aabb, BroadPhase, Method};
use tunnelproof::certified::Blocked;
use tunnelproof::mesh::{Feature, Mesh, MeshContact, MeshStep, Pair};
use tunnelproof::query::{Coordinate, Point, Query, QueryKind, Radius};
use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::oracle::decide_query;

use super::{Motion, Parts, Position};

/// What the engine says of a motion.
#[derive(Clone, Copy)]
pub struct Claims<'a, C> {
    /// The distance at which parts touch.
    pub radius: f64,
    /// What the step keeps beyond it.
    pub clearance: f64,
    /// The first contact.
    pub first: Option<&'a MeshContact>,
    /// All contacts.
    pub contacts: &'a [MeshContact],
    /// The step.
    pub step: &'a MeshStep<C>,
}

/// What the oracle says of it.
#[derive(Clone, Debug, Default)]
pub struct Audit {
    /// How many pairs of edges or points, and of a vertex and a face, were asked about.
    pub pairs: [usize; 2],
    /// How many of them touch.
    pub contacts: usize,
    /// The pairs of which the engine says something else.
    pub disagreements: Vec<Disagreement>,
    /// How many pairs were asked about for the motion to the stored positions.
    pub stored_pairs: usize,
    /// The pairs that come nearer in that motion than the step keeps them.
    pub stored_contacts: Vec<Place>,
}

/// A pair of which the oracle and the engine say different things.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// The pair; `None` for the first contact of all.
    pub place: Option<Place>,
    /// The time of impact by the oracle.
    pub expected: Option<[f64; 2]>,
    /// The time of impact by the engine.
    pub found: Option<[f64; 2]>,
}

/// A pair by its vertices, those of each side in ascending order, and the smaller edge first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Two edges, or a vertex and a face.
    pub kind: QueryKind,
    /// A, B, C and D.
    pub vertices: [u32; 4],
}

impl Audit {
    /// Asks the oracle about every pair whose swept boxes meet.
    pub fn new<C: Coordinate>(motion: &Motion, claims: &Claims<'_, C>) -> Self {
        let radius = claims.radius;
        let places = places(motion, &motion.end, radius);
        let truth: Vec<Option<Enclosure>> = places
            .par_iter()
            .map(|place| place.toi(motion, &motion.end, radius.into()))
            .collect();
        let of_kind = |kind| places.iter().filter(|place| place.kind == kind).count();
        let (stored_pairs, stored_contacts) = check_stored(motion, claims);
        Audit {
            pairs: [QueryKind::EdgeEdge, QueryKind::VertexFace].map(of_kind),
            contacts: truth.iter().flatten().count(),
            disagreements: disagreements(&motion.mesh, &places, &truth, claims),
            stored_pairs,
            stored_contacts,
        }
    }

    /// Whether the oracle says the same.
    pub fn passes(&self) -> bool {
        self.disagreements.is_empty() && self.stored_contacts.is_empty()
    }
}

impl Place {
    fn new(kind: QueryKind, vertices: [u32; 4]) -> Self {
        let [a, b, c, d] = vertices;
        let vertices = match kind {
            QueryKind::EdgeEdge => {
                let mut edges = [[a.min(b), a.max(b)], [c.min(d), c.max(d)]];
                edges.sort_unstable();
                let [[a, b], [c, d]] = edges;
                [a, b, c, d]
            }
            QueryKind::VertexFace => {
                let mut face = [b, c, d];
                face.sort_unstable();
                let [b, c, d] = face;
                [a, b, c, d]
            }
        };
        Place { kind, vertices }
    }

    /// The place of a pair of the engine.
    fn of(mesh: &Mesh, pair: Pair) -> Option<Self> {
        let kind = match pair.second {
            Feature::Face(_) => QueryKind::VertexFace,
            _ => QueryKind::EdgeEdge,
        };
        Some(Place::new(kind, mesh.vertices_of(pair)?))
    }

    /// When the pair touches first on the way to some positions, by the oracle.
    fn toi(&self, motion: &Motion, end: &[Position], radius: Radius) -> Option<Enclosure> {
        let of = |all: &[Position]| {
            self.vertices
                .map(|vertex| Point::from(all[vertex as usize]))
        };
        let (start, end) = (of(&motion.start.vertices), of(end));
        let query = Query::new(self.kind, start, end, radius);
        let query = query.expect("coordinates and radii of a step are finite");
        decide_query(&query).hit.map(|hit| hit.toi)
    }
}

/// The pairs whose swept boxes come within a distance on the way to some positions.
fn places(motion: &Motion, end: &[Position], distance: f64) -> Vec<Place> {
    let radius = half(distance);
    let swept = |vertices: &[u32]| {
        let of = |all: &[Position]| -> Vec<Point> {
            let points = vertices.iter().map(|&vertex| all[vertex as usize].into());
            points.collect()
        };
        let aabb = Aabb::swept(&of(&motion.start.vertices), &of(end), radius);
        aabb.expect("coordinates and radii of a step are finite")
    };
    let mut broad = BroadPhase::new(Method::HierarchicalGrid);
    let segments = segments(motion);
    for segment in &segments {
        broad.insert(swept(segment));
    }
    let edges = found(&mut broad, |first, second| {
        let ([a, b], [c, d]) = (*segments.get(first)?, *segments.get(second)?);
        Some(Place::new(QueryKind::EdgeEdge, [a, b, c, d]))
    });
    let faces = &motion.start.faces;
    let vertices = motion.start.vertices.len();
    let mut broad = BroadPhase::new(Method::HierarchicalGrid);
    for vertex in 0..vertices as u32 {
        broad.insert(swept(&[vertex]));
    }
    for face in faces {
        broad.insert(swept(face));
    }
    let faces = found(&mut broad, |first, second| {
        let [b, c, d] = *faces.get(second.checked_sub(vertices)?)?;
        let is_vertex = first < vertices;
        is_vertex.then(|| Place::new(QueryKind::VertexFace, [first as u32, b, c, d]))
    });
    let mut all = [edges, faces].concat();
    all.sort_unstable();
    // Two faces of the same vertices are one place.
    all.dedup();
    all
}

/// The pairs whose boxes meet and that share no vertex.
fn found(broad: &mut BroadPhase, place: impl Fn(usize, usize) -> Option<Place>) -> Vec<Place> {
    let mut places = Vec::new();
    broad.pairs(|pair| {
        let place = place(pair.first().index(), pair.second().index());
        places.extend(place.filter(|Place { kind, vertices }| {
            let (first, second) = vertices.split_at(match kind {
                QueryKind::EdgeEdge => 2,
                QueryKind::VertexFace => 1,
            });
            first.iter().all(|vertex| !second.contains(vertex))
        }));
        false
    });
    places
}

/// The edges that the file names and those of its triangles, and each other vertex with itself.
fn segments(motion: &Motion) -> Vec<[u32; 2]> {
    let Parts {
        vertices,
        edges,
        faces,
    } = &motion.start;
    let of_faces = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges = edges.iter().copied().chain(of_faces);
    let mut segments: BTreeSet<_> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let used: BTreeSet<u32> = segments.iter().flatten().copied().collect();
    let points = (0..vertices.len() as u32).filter(|vertex| !used.contains(vertex));
    segments.extend(points.map(|vertex| [vertex; 2]));
    segments.into_iter().collect()
}

/// At least half of a distance.
fn half(distance: f64) -> f64 {
    match distance {
        0.0 => 0.0,
        _ => (distance.min(f64::MAX) / 2.0).next_up(),
    }
}

/// What the engine says of each pair, against the oracle.
fn disagreements<C>(
    mesh: &Mesh,
    places: &[Place],
    truth: &[Option<Enclosure>],
    claims: &Claims<'_, C>,
) -> Vec<Disagreement> {
    let toi = |contact: &MeshContact| [contact.toi, contact.toi_above];
    let mut said: BTreeMap<Place, Vec<[f64; 2]>> = BTreeMap::new();
    for contact in claims.contacts {
        if let Some(place) = Place::of(mesh, contact.pair) {
            said.entry(place).or_default().push(toi(contact));
        }
    }
    let mut wrong = Vec::new();
    let mut compare = |place, expected: Option<[f64; 2]>, found: Option<[f64; 2]>| {
        if expected != found {
            wrong.push(Disagreement {
                place,
                expected,
                found,
            });
        }
    };
    let bounds = |toi: &Enclosure| [toi.below, toi.above];
    for (place, toi) in places.iter().zip(truth) {
        let expected = toi.as_ref().map(bounds);
        // An edge that the file names twice is two edges.
        match said.remove(place) {
            Some(all) => all
                .into_iter()
                .for_each(|found| compare(Some(*place), expected, Some(found))),
            None => compare(Some(*place), expected, None),
        }
    }
    for (place, all) in said {
        all.into_iter()
            .for_each(|found| compare(Some(place), None, Some(found)));
    }
    let least = truth.iter().flatten().map(|toi| toi.below).reduce(f64::min);
    let first = claims.first.map(|contact| contact.toi);
    if least != first {
        compare(None, least.map(|toi| [toi; 2]), first.map(|toi| [toi; 2]));
    }
    wrong
}

/// How many pairs may meet on the way to the stored positions, and those that come nearer than they
/// are kept. Pairs that touch at the start cannot be kept apart.
fn check_stored<C: Coordinate>(motion: &Motion, claims: &Claims<'_, C>) -> (usize, Vec<Place>) {
    let &Claims {
        radius,
        clearance,
        step,
        ..
    } = claims;
    let positions = step.positions.iter();
    let positions: Vec<Position> = positions.map(|x| x.map(Into::into)).collect();
    let place = |pair| Place::of(&motion.mesh, pair);
    let touching = step.limits.iter();
    let touching = touching.filter(|limit| limit.blocked == Blocked::Touching);
    let touching: BTreeSet<Place> = touching.filter_map(|limit| place(limit.pair)).collect();
    let near = step.near.iter();
    let near: HashMap<Place, Radius> = near
        .filter_map(|(pair, kept)| Some((place(*pair)?, *kept)))
        .collect();
    let distance = match radius + clearance {
        0.0 => 0.0,
        sum => sum.next_up(),
    };
    let mut places = places(motion, &positions, distance);
    places.retain(|place| !touching.contains(place));
    let count = places.len();
    let contacts = places.into_par_iter().filter(|place| {
        let all = [radius, clearance].into();
        let kept = near.get(place).copied().unwrap_or(all);
        place.toi(motion, &positions, kept).is_some()
    });
    (count, contacts.collect())
}
