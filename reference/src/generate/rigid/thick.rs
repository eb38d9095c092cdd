//! A radius for bodies that turn: that of other families, such that contact at it is decided
//! narrowly.
//!
//! Of 16 queries the radius is in 11 the distance of two vertices or of the lines, or of the vertex
//! and the plane, at the start, at the end or at some time between: exactly where there is no turn,
//! rounded elsewhere. In 4 it is of the size of the query, in 1 anything from far below to far
//! above it. Half of them are nudged, half are a sum of two. `turning_thick_tangent` is
//! exact: the body comes as near as the radius at a fraction, and goes again.

use rand::{Rng, RngExt};
use tunnelproof::query::{Query, Radius};
use tunnelproof::rigid::{RigidQuery, Side};

use super::super::thick::{nudged, of_lines, of_vertices, parts};
use super::draft::first;
use super::one::at_a_fraction;
use super::{RigidFamily, bodies, one};

pub(super) const UNIFORM: RigidFamily = RigidFamily {
    name: "turning_thick_uniform",
    description: "with a radius: random poses, random points",
    draw: |rng| thick(rng, one::uniform),
};

pub(super) const LATTICE: RigidFamily = RigidFamily {
    name: "turning_thick_lattice",
    description: "with a radius: small integers",
    draw: |rng| thick(rng, one::lattice),
};

pub(super) const CONFINED: RigidFamily = RigidFamily {
    name: "turning_thick_confined",
    description: "with a radius: in a plane, on a line or parallel for the whole step",
    draw: |rng| thick(rng, one::confined),
};

pub(super) const TANGENT: RigidFamily = RigidFamily {
    name: "turning_thick_tangent",
    description: "with a radius: double roots at it, exactly or nearly",
    draw: tangent,
};

pub(super) const STILL: RigidFamily = RigidFamily {
    name: "turning_thick_still",
    description: "with a radius: no turn, in coordinates in which the linear query is exact",
    draw: |rng| thick(rng, one::translation),
};

pub(super) const PLATES: RigidFamily = RigidFamily {
    name: "turning_thick_plates",
    description: "with a radius: thin plates and rods that turn fast",
    draw: |rng| thick(rng, one::plates),
};

pub(super) const SCALES: RigidFamily = RigidFamily {
    name: "turning_thick_scales",
    description: "with a radius: lengths from 1e-6 to 1e6, quaternions of any length",
    draw: |rng| thick(rng, one::scales),
};

pub(super) const BODIES_UNIFORM: RigidFamily = RigidFamily {
    name: "turning_bodies_thick_uniform",
    description: "two bodies with a radius: random poses, random points",
    draw: |rng| thick(rng, bodies::uniform),
};

pub(super) const BODIES_LATTICE: RigidFamily = RigidFamily {
    name: "turning_bodies_thick_lattice",
    description: "two bodies with a radius: small integers",
    draw: |rng| thick(rng, bodies::lattice),
};

pub(super) const BODIES_STILL: RigidFamily = RigidFamily {
    name: "turning_bodies_thick_still",
    description: "two bodies with a radius: the first one does not turn, in exact coordinates",
    draw: |rng| thick(rng, bodies::still),
};

/// In one of four an ulp less than the distance, so that they just do not touch.
fn tangent(rng: &mut dyn Rng) -> RigidQuery {
    let query = first(rng, |rng| at_a_fraction(rng, true, true));
    let less = query.radius().rounded().next_down();
    match rng.random_range(0..4) {
        0 => with_radius(&query, less.into()).unwrap_or(query),
        _ => query,
    }
}

fn thick(rng: &mut dyn Rng, draw: fn(&mut dyn Rng) -> RigidQuery) -> RigidQuery {
    let query = draw(rng);
    let size = |query: &RigidQuery| {
        let [first, _] = query.sides();
        let points = match first {
            Side::Straight { start, end } => [start, end].concat(),
            Side::Turning { .. } => [query.positions(0.0), query.positions(1.0)].concat(),
        };
        points
            .iter()
            .fold(0.0, |size: f64, point| size.max(point.coords.amax()))
    };
    let radius = match rng.random_range(0..16) {
        0..5 => {
            let points = at_some_time(rng, &query);
            of_vertices(rng, &points)
        }
        5..11 => {
            let points = at_some_time(rng, &query);
            of_lines(rng, &points)
        }
        11..15 => size(&query) * 2f64.powi(rng.random_range(-8..=0)),
        _ => size(&query) * 2f64.powi(rng.random_range(-300..=300)),
    };
    let radius = match rng.random() {
        true => nudged(rng, radius),
        false => radius,
    };
    let radius = if radius < f64::MAX { radius } else { 1.0 };
    let radius = parts(rng, radius);
    with_radius(&query, radius).expect("a radius is finite and not negative")
}

/// The four points at one time, at rest.
fn at_some_time(rng: &mut dyn Rng, query: &RigidQuery) -> Query {
    let t = match rng.random_range(0..4) {
        0 => 0.0,
        1 => 1.0,
        _ => rng.random_range(0.0..1.0),
    };
    let points = query.positions(t);
    Query::new(query.kind().linear(), points, points, 0.0).expect("positions are finite")
}

fn with_radius(query: &RigidQuery, radius: Radius) -> Option<RigidQuery> {
    RigidQuery::new(query.sides(), radius).ok()
}
