//! The exact answer, by the oracle on pairs of features.
//!
//! Two convex bodies that are apart at the start first touch with their surfaces: a vertex of one
//! with a face of the other, or two edges. So the first contact is the earliest over all pairs of an
//! edge and an edge, and of a vertex and a triangle of a face; each is a query that the oracle
//! decides. With a radius the same holds of the distance, which two surfaces that are apart have
//! between such a pair.
//!
//! Bodies in contact at the start are another matter: an edge can pierce a face away from all edges and
//! vertices. Then a vertex that runs along that edge meets the face, which is a query again. Bodies
//! whose surfaces are apart, and that are in contact nevertheless, are one inside the other: then so is
//! its first corner.

use nalgebra::Vector3;
use tunnelproof::query::{Point, Query, QueryKind};

use crate::answer::Enclosure;
use crate::oracle::decide_query;
use crate::vector::{dot, sub};

use super::body::{Body, BoxCast, Shape, vector};

/// The time of the first contact; `None` if there is none.
pub fn decide_pairs(cast: &BoxCast) -> Option<Enclosure> {
    let [first, second] = cast.bodies();
    if is_inside(first, second) || is_inside(second, first) || is_pierced(cast) {
        return Some(Enclosure::exactly(0.0));
    }
    let mut earliest: Option<Enclosure> = None;
    for query in pairs(cast) {
        let until = earliest.map_or(1.0, |toi| toi.below);
        if until == 0.0 {
            break;
        }
        if is_apart(&query) {
            continue;
        }
        if let Some(hit) = decide_query(&query).hit {
            // Rounding is monotone: the enclosure of the least time has the least ends.
            earliest = Some(earliest.map_or(hit.toi, |toi| Enclosure {
                below: toi.below.min(hit.toi.below),
                above: toi.above.min(hit.toi.above),
            }));
        }
    }
    earliest
}

/// Every pair of features between which the first contact can be.
pub fn pairs(cast: &BoxCast) -> Vec<Query> {
    let [first, second] = cast.bodies();
    let [p, q] = [first, second].map(Features::new);
    let mut pairs = Vec::new();
    for &[a, b] in &p.edges {
        let edge = |&[c, d]: &[Point; 2]| ([a, b, c, d], QueryKind::EdgeEdge);
        pairs.extend(q.edges.iter().map(edge));
    }
    let count = pairs.len();
    for (vertices, faces) in [(&p.vertices, &q.faces), (&q.vertices, &p.faces)] {
        for &a in vertices {
            let face = |&[b, c, d]: &[Point; 3]| ([a, b, c, d], QueryKind::VertexFace);
            pairs.extend(faces.iter().map(face));
        }
    }
    let of_second = q.vertices.len() * p.faces.len();
    let from = pairs.len() - of_second;
    let queries = pairs.into_iter().enumerate().map(|(i, (points, kind))| {
        // The bodies of the four points.
        let [own, other] = match i >= from {
            true => [second, first],
            false => [first, second],
        };
        let split = if i < count { 2 } else { 1 };
        let steps = [0, 1, 2, 3].map(|i| if i < split { own.step() } else { other.step() });
        query(kind, points, steps, [own.radius(), other.radius()])
    });
    queries.collect()
}

fn query(kind: QueryKind, start: [Point; 4], steps: [Vector3<f64>; 4], radii: [f64; 2]) -> Query {
    let end = [0, 1, 2, 3].map(|i| start[i] + steps[i]);
    Query::new(kind, start, end, radii).expect("corners are finite at both ends of the step")
}

/// What the surface of a body is made of, at the start.
struct Features {
    vertices: Vec<Point>,
    edges: Vec<[Point; 2]>,
    /// Triangles.
    faces: Vec<[Point; 3]>,
}

impl Features {
    fn new(body: &Body) -> Self {
        let vertices = body.corners();
        let at = |corners: [usize; 2]| corners.map(|corner| vertices[corner]);
        let edges = body.edges().into_iter().map(at).collect();
        let faces = match body.shape() {
            Shape::Sphere | Shape::Edge => Vec::new(),
            Shape::Triangle => vec![[vertices[0], vertices[1], vertices[2]]],
            Shape::Box => box_faces()
                .map(|face| face.map(|corner| vertices[corner]))
                .collect(),
        };
        Features {
            vertices,
            edges,
            faces,
        }
    }
}

/// The corners of two triangles for each face, which share a bit.
fn box_faces() -> impl Iterator<Item = [usize; 3]> {
    let normals = [(1, 2, 4), (2, 4, 1), (4, 1, 2)].into_iter();
    let faces = normals.flat_map(|(normal, p, q)| [(0, p, q), (normal, p, q)]);
    faces.flat_map(|(at, p, q)| [[at, at | p, at | q], [at | p | q, at | p, at | q]])
}

/// Whether the first corner of a body is in a box at the start.
fn is_inside(body: &Body, other: &Body) -> bool {
    if other.shape() != Shape::Box {
        return false;
    }
    let [origin, beside @ ..] = other.points().map(|point| vector(&point.coords));
    let way = sub(&vector(&body.points()[0].coords), &origin);
    beside.iter().all(|corner| {
        let side = sub(corner, &origin);
        let along = dot(&way, &side);
        along >= num_traits::Zero::zero() && along <= dot(&side, &side)
    })
}

/// Whether an edge of a body and a face of the other share a point at the start.
fn is_pierced(cast: &BoxCast) -> bool {
    let [p, q] = cast.bodies().each_ref().map(Features::new);
    let sides = [(&p.edges, &q.faces), (&q.edges, &p.faces)].into_iter();
    let mut runs = sides.flat_map(|(edges, faces)| {
        let along = |&[a, b]: &[Point; 2]| {
            let run = move |&[c, d, e]: &[Point; 3]| {
                let [start, end] = [[a, c, d, e], [b, c, d, e]];
                Query::new(QueryKind::VertexFace, start, end, 0.0).expect("corners are finite")
            };
            faces.iter().map(run)
        };
        edges.iter().flat_map(along)
    });
    runs.any(|run| !is_apart(&run) && decide_query(&run).hit.is_some())
}

/// Whether the boxes that the two sides sweep are farther apart along an axis than the radius. A
/// difference that is above an `f64` when it is rounded is above it.
fn is_apart(query: &Query) -> bool {
    let split = match query.kind() {
        QueryKind::EdgeEdge => 2,
        QueryKind::VertexFace => 1,
    };
    let [first, second] = query.radius().parts();
    let reach = (first + second).next_up();
    (0..3).any(|axis| {
        let at = |range: std::ops::Range<usize>| {
            let both = [query.start(), query.end()].into_iter();
            both.flat_map(move |points| points[range.clone()].iter().map(move |p| p[axis]))
        };
        let low = |range| at(range).fold(f64::INFINITY, f64::min);
        let high = |range| at(range).fold(f64::NEG_INFINITY, f64::max);
        low(split..4) - high(0..split) > reach || low(0..split) - high(split..4) > reach
    })
}
