//! Casts of boxes by the certified path: the earliest contact of all pairs of features.
//!
//! Bodies in contact at the start are those of which an edge of one pierces a face of the other, which
//! is a vertex that runs along the edge, and those of which one is inside the other. The latter is
//! decided by products and sums in `f64`, which are exact for corners of at most 24 bits in one unit,
//! as in the families.

use tunnelproof::decide;
use tunnelproof::query::{Point, Query, QueryKind};

use crate::frames::{Clock, Convex, Form, Said};

/// What the surface of a body is made of, at the start of the step or at its end.
struct Features {
    vertices: Vec<Point>,
    edges: Vec<[usize; 2]>,
    /// Triangles.
    faces: Vec<[usize; 3]>,
}

pub fn certified(bodies: &[Convex; 2], clock: &mut Clock) -> Said {
    let features = bodies.each_ref().map(features);
    let toi = clock.timed(|| first_contact(bodies, &features));
    toi.map_or(Said::Miss, Said::Hit)
}

fn first_contact(bodies: &[Convex; 2], features: &[Features; 2]) -> Option<f64> {
    let [a, b] = bodies;
    if is_inside(a, b) || is_inside(b, a) || is_pierced(features) {
        return Some(0.0);
    }
    let steps = [a, b].map(|body| body.step);
    let radii = [a.radius, b.radius];
    let mut earliest: Option<f64> = None;
    let mut ask = |kind, bodies: [usize; 4], points: [Point; 4]| {
        let end = [0, 1, 2, 3]
            .map(|i| points[i] + tunnelproof::nalgebra::Vector3::from(steps[bodies[i]]));
        let query = Query::new(kind, points, end, radii).expect("corners are finite");
        if let Some(toi) = toi(&query) {
            earliest = Some(earliest.map_or(toi, |earliest| earliest.min(toi)));
        }
    };
    let [p, q] = features;
    for [a, b] in p.edges.iter().map(|edge| edge.map(|i| p.vertices[i])) {
        for [c, d] in q.edges.iter().map(|edge| edge.map(|i| q.vertices[i])) {
            ask(QueryKind::EdgeEdge, [0, 0, 1, 1], [a, b, c, d]);
        }
    }
    for (i, [own, other]) in [[p, q], [q, p]].into_iter().enumerate() {
        for &a in &own.vertices {
            for [b, c, d] in other
                .faces
                .iter()
                .map(|face| face.map(|i| other.vertices[i]))
            {
                ask(
                    QueryKind::VertexFace,
                    [i, 1 - i, 1 - i, 1 - i],
                    [a, b, c, d],
                );
            }
        }
    }
    earliest
}

fn toi(query: &Query) -> Option<f64> {
    match query {
        Query::EdgeEdge(query) => decide(query).map(|hit| hit.toi),
        Query::VertexFace(query) => decide(query).map(|hit| hit.toi),
    }
}

/// Whether an edge of a body and a face of the other share a point at the start.
fn is_pierced([p, q]: &[Features; 2]) -> bool {
    [[p, q], [q, p]].into_iter().any(|[own, other]| {
        own.edges.iter().any(|edge| {
            let [a, b] = edge.map(|i| own.vertices[i]);
            other.faces.iter().any(|face| {
                let [c, d, e] = face.map(|i| other.vertices[i]);
                let run = Query::new(QueryKind::VertexFace, [a, c, d, e], [b, c, d, e], 0.0);
                toi(&run.expect("corners are finite")).is_some()
            })
        })
    })
}

/// Whether the first corner of a body is in a box at the start.
fn is_inside(body: &Convex, other: &Convex) -> bool {
    if other.form != Form::Box {
        return false;
    }
    let [origin, beside @ ..] = other.points.map(Point::from);
    let way = Point::from(body.points[0]) - origin;
    beside.iter().all(|corner| {
        let side = corner - origin;
        (0.0..=side.dot(&side)).contains(&way.dot(&side))
    })
}

fn features(body: &Convex) -> Features {
    let points = body.points.map(Point::from);
    let (vertices, edges, faces) = match body.form {
        Form::Sphere => (points[..1].to_vec(), Vec::new(), Vec::new()),
        Form::Edge => (points[..2].to_vec(), vec![[0, 1]], Vec::new()),
        Form::Triangle => (
            points[..3].to_vec(),
            vec![[0, 1], [1, 2], [0, 2]],
            vec![[0, 1, 2]],
        ),
        Form::Box => {
            let near = |side: usize| (0..8).filter(move |corner| corner & side == 0);
            let edges = [1, 2, 4].into_iter();
            let edges =
                edges.flat_map(|side| near(side).map(move |corner| [corner, corner | side]));
            let faces = [(1, 2, 4), (2, 4, 1), (4, 1, 2)].into_iter();
            let faces = faces.flat_map(|(n, p, q)| [(0, p, q), (n, p, q)]);
            let faces =
                faces.flat_map(|(at, p, q)| [[at, at | p, at | q], [at | p | q, at | p, at | q]]);
            let corners = body.corners().map(Point::from);
            (corners.to_vec(), edges.collect(), faces.collect())
        }
    };
    Features {
        vertices,
        edges,
        faces,
    }
}
