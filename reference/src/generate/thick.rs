//! A radius for the queries of other families, such that contact at it is decided narrowly.
//!
//! Probes contact at exactly or nearly the radius, initial overlap among it; tiny and huge radii,
//! and sums of two that no `f64` is. Of 8 queries the radius is
//!
//! - in 3 the distance of two vertices at one end of the step: exactly, where that is the square
//!   root of a square (edges on a lattice: Pythagorean numbers);
//! - in 3 the distance of the lines of the edges, or of the vertex from the plane, at the start, in
//!   the middle or at the end;
//! - in 2 a power of two: of the size of the query, or from far below to far above it.
//!
//! Of 2 it is nudged in 1 by 0 to `2^20` ulp. Of 4 it is a sum of two in 2: of halves, or of the
//! whole and half an ulp of it.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::{Query, QueryKind, Radius};

use super::nudge::ulps;
use super::{Draw, Family, face, grazing, lattice, near_parallel, scales, uniform};

pub(super) const UNIFORM: Family = Family {
    name: "thick_uniform",
    description: "thick edges: general motion",
    draw: Draw::Query(|rng| thick(rng, &uniform::FAMILY)),
};

pub(super) const LATTICE: Family = Family {
    name: "thick_lattice",
    description: "thick edges: every degeneracy exactly, at Pythagorean distances",
    draw: Draw::Query(|rng| thick(rng, &lattice::FAMILY)),
};

pub(super) const PARALLEL: Family = Family {
    name: "thick_parallel",
    description: "thick edges: parallel cylinders, exactly or nearly",
    draw: Draw::Query(|rng| thick(rng, &near_parallel::FAMILY)),
};

pub(super) const GRAZING: Family = Family {
    name: "thick_grazing",
    description: "thick edges: midlines that graze each other, and end caps",
    draw: Draw::Query(|rng| thick(rng, &grazing::FAMILY)),
};

pub(super) const SCALES: Family = Family {
    name: "thick_scales",
    description: "thick edges: tiny and huge numbers together",
    draw: Draw::Query(|rng| thick(rng, &scales::FAMILY)),
};

pub(super) const FACE_UNIFORM: Family = Family {
    name: "thick_face_uniform",
    description: "thick vertex and face: general motion",
    draw: Draw::Query(|rng| thick(rng, &face::UNIFORM)),
};

pub(super) const FACE_LATTICE: Family = Family {
    name: "thick_face_lattice",
    description: "thick vertex and face: every degeneracy exactly, at Pythagorean distances",
    draw: Draw::Query(|rng| thick(rng, &face::LATTICE)),
};

fn thick(rng: &mut dyn Rng, family: &Family) -> Query {
    let query = family.draw(rng);
    let length = match rng.random_range(0..8) {
        0..3 => of_vertices(rng, &query),
        3..6 => of_lines(rng, &query),
        6 => size(&query) * 2f64.powi(rng.random_range(-8..=2)),
        _ => size(&query) * 2f64.powi(rng.random_range(-300..=300)),
    };
    let mut radius = length;
    if rng.random() {
        radius = nudged(rng, radius);
    }
    // Two parts of it are numbers, too.
    let radius = if radius < f64::MAX { radius } else { 1.0 };
    Query::new(
        query.kind(),
        *query.start(),
        *query.end(),
        parts(rng, radius),
    )
    .expect("a radius is finite and not negative")
}

pub(super) fn nudged(rng: &mut dyn Rng, length: f64) -> f64 {
    let steps = ulps(rng);
    let bits = (length.to_bits() as i64).saturating_add(steps.into());
    f64::from_bits(bits.max(0) as u64)
}

/// A radius as one number or two.
pub(super) fn parts(rng: &mut dyn Rng, radius: f64) -> Radius {
    let ulp = radius.next_up() - radius;
    match rng.random_range(0..4) {
        0 => [radius * 0.5, radius * 0.5].into(),
        1 => [radius, ulp * 0.5].into(),
        _ => radius.into(),
    }
}

/// The largest coordinate.
fn size(query: &Query) -> f64 {
    let points = query.start().iter().chain(query.end());
    points.fold(0.0, |size: f64, point| size.max(point.coords.amax()))
}

/// The distance of a vertex of one side from one of the other, at an end of the step.
pub(super) fn of_vertices(rng: &mut dyn Rng, query: &Query) -> f64 {
    let points = if rng.random() {
        query.start()
    } else {
        query.end()
    };
    let (first, second) = match query.kind() {
        QueryKind::EdgeEdge => (rng.random_range(0..2), rng.random_range(2..4)),
        QueryKind::VertexFace => (0, rng.random_range(1..4)),
    };
    (points[second] - points[first]).norm()
}

/// The distance of the two lines, or of the vertex from the plane; 0 where they have none.
pub(super) fn of_lines(rng: &mut dyn Rng, query: &Query) -> f64 {
    let time = 0.5 * f64::from(rng.random_range(0..=2));
    let at = |i: usize| query.start()[i].coords * (1.0 - time) + query.end()[i].coords * time;
    let [a, b, c, d] = [0, 1, 2, 3].map(at);
    let (p, q): (Vector3<f64>, Vector3<f64>) = match query.kind() {
        QueryKind::EdgeEdge => (b - a, d - c),
        QueryKind::VertexFace => (c - b, d - b),
    };
    let normal = p.cross(&q);
    let distance = (c - a).dot(&normal).abs() / normal.norm();
    if distance.is_finite() { distance } else { 0.0 }
}
