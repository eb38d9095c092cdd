//! Distances in floating point: where to look, never what is so.

use nalgebra::Vector3;
use tunnelproof::query::{Point, Query, QueryKind, Radius};
use tunnelproof::rigid::RigidQuery;

/// Two sides that move: edges, or a vertex and a face.
pub trait Moving {
    /// All four points at a time in `[0, 1]`, rounded.
    fn at(&self, t: f64) -> [Point; 4];

    /// What the sides are.
    fn shape(&self) -> QueryKind;

    /// The distance at which they count as touching.
    fn radius(&self) -> Radius;
}

impl Moving for Query {
    fn at(&self, t: f64) -> [Point; 4] {
        let (start, end) = (self.start(), self.end());
        [0, 1, 2, 3].map(|i| Point::from(start[i].coords * (1.0 - t) + end[i].coords * t))
    }

    fn shape(&self) -> QueryKind {
        self.kind()
    }

    fn radius(&self) -> Radius {
        self.radius()
    }
}

impl Moving for RigidQuery {
    fn at(&self, t: f64) -> [Point; 4] {
        self.positions(t)
    }

    fn shape(&self) -> QueryKind {
        self.kind().linear()
    }

    fn radius(&self) -> Radius {
        self.radius()
    }
}

/// The gap in metres in floating point, by sampling and ternary search. Heuristic: to choose what
/// to measure exactly.
pub fn estimate_gap(query: &impl Moving) -> f64 {
    let distance = |t: f64| {
        let points = query.at(t).map(|point| point.coords);
        match query.shape() {
            QueryKind::EdgeEdge => distance_of_segments(&points),
            QueryKind::VertexFace => distance_of_face(&points),
        }
    };
    const SAMPLES: u32 = 64;
    let time = |i: u32| f64::from(i) / f64::from(SAMPLES);
    let nearest = (0..=SAMPLES).min_by(|&i, &j| distance(time(i)).total_cmp(&distance(time(j))));
    let nearest = nearest.unwrap_or(0);
    let (mut low, mut high) = (
        time(nearest.saturating_sub(1)),
        time((nearest + 1).min(SAMPLES)),
    );
    for _ in 0..60 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if distance(left) < distance(right) {
            high = right
        } else {
            low = left
        }
    }
    let least = distance(low).min(distance(time(nearest)));
    (least - query.radius().rounded()).max(0.0)
}

/// The distance of a point from a segment in floating point.
fn distance_of_end([x, y, z]: [&Vector3<f64>; 3]) -> f64 {
    let edge = z - y;
    let s = (x - y).dot(&edge) / edge.dot(&edge);
    (x - y - edge * if s > 0.0 { s.min(1.0) } else { 0.0 }).norm()
}

/// The distance of two segments in floating point: of an end from the other segment, or of the
/// lines.
fn distance_of_segments([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    let ends = [[a, c, d], [b, c, d], [c, a, b], [d, a, b]];
    let of_ends = ends
        .map(distance_of_end)
        .into_iter()
        .fold(f64::MAX, f64::min);
    let (k, l, m) = (b - a, d - c, c - a);
    let n = k.cross(&l);
    let (u, v) = (m.cross(&l).dot(&n), m.cross(&k).dot(&n));
    let inside = 0.0..=n.norm_squared();
    if n.norm() > 0.0 && inside.contains(&u) && inside.contains(&v) {
        of_ends.min(m.dot(&n).abs() / n.norm())
    } else {
        of_ends
    }
}

/// The distance of a point and a face in floating point: from an edge, or from the plane.
fn distance_of_face([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    let edges = [[a, b, c], [a, c, d], [a, b, d]];
    let of_edges = edges
        .map(distance_of_end)
        .into_iter()
        .fold(f64::MAX, f64::min);
    let (w, e1, e2) = (a - b, c - b, d - b);
    let n = e1.cross(&e2);
    let (u, v) = (w.cross(&e2).dot(&n), e1.cross(&w).dot(&n));
    if n.norm() > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= n.norm_squared() {
        of_edges.min(w.dot(&n).abs() / n.norm())
    } else {
        of_edges
    }
}
