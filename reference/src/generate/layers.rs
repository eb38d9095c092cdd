//! Two layers of cloth that lie on each other and slide, of which an edge of each, or a vertex of
//! one and a face of the other, are asked about.
//!
//! Probes what contact and gravity make common: pairs that are near each other, nearly or exactly
//! coplanar and often parallel during the whole step, of which few touch. The layers are planes of
//! square cells with a diagonal, parallel to each other, and the upper one slides by at most half a
//! cell. Of 4 queries they keep their distance in 2. The radius is less than the distance at the
//! start, by at least a part in 16, or, of layers that touch, equal to it there or at the end.
//!
//! Of 2 queries a ripple moves each point by a unit in 1, a thirty-second of a cell at most. Of 2
//! queries 1 is turned by a rational rotation, so that distances are exact, and 1 by any, rounded.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{Rng, RngExt};
use tunnelproof::query::{Point, Query, QueryKind, Radius};

use super::cast::rotation;
use super::motion::{Motion, in_units, real_vector, vector};
use super::{Draw, Family};

pub(super) const EDGES: Family = Family {
    name: "thick_layers",
    description: "thick edges: layers of cloth that slide on each other",
    draw: Draw::Query(|rng| query(rng, QueryKind::EdgeEdge, false)),
};

pub(super) const TOUCHING_EDGES: Family = Family {
    name: "thick_touching_layers",
    description: "thick edges: layers of cloth that slide on each other and just touch",
    draw: Draw::Query(|rng| query(rng, QueryKind::EdgeEdge, true)),
};

pub(super) const FACES: Family = Family {
    name: "thick_face_layers",
    description: "thick vertex and face: layers of cloth that slide on each other",
    draw: Draw::Query(|rng| query(rng, QueryKind::VertexFace, false)),
};

pub(super) const TOUCHING_FACES: Family = Family {
    name: "thick_face_touching_layers",
    description: "thick vertex and face: layers of cloth that slide on each other and just touch",
    draw: Draw::Query(|rng| query(rng, QueryKind::VertexFace, true)),
};

/// The side of a cell in units.
const CELL: i32 = 64;
/// A unit in metres: a cell is 1/16 m.
const UNIT: f64 = 1.0 / 1024.0;

fn query(rng: &mut dyn Rng, kind: QueryKind, is_touching: bool) -> Query {
    let (motion, radius) = layers(rng, kind, is_touching);
    let (motion, scale) = if rng.random() {
        let (turn, scale) = rotation(rng);
        let turned = motion.map(|points| points.map(|point| turn * point));
        (in_units(carried(rng, turned), UNIT), f64::from(scale))
    } else {
        let motion = carried(rng, motion);
        (turned(rng, motion), 1.0)
    };
    let [start, end] = motion.map(|points| points.map(Point::from));
    let half = 0.5 * f64::from(radius) * scale * UNIT;
    let radius: Radius = if rng.random() {
        (2.0 * half).into()
    } else {
        [half, half].into()
    };
    Query::new(kind, start, end, radius).expect("small numbers")
}

/// Points in units, the layers parallel to the plane of x and y, and the radius.
fn layers(rng: &mut dyn Rng, kind: QueryKind, is_touching: bool) -> (Motion<i32>, i32) {
    let distance = rng.random_range(16..=64);
    let rise = match rng.random_range(0..4) {
        0 => rng.random_range(-8..0),
        1 => rng.random_range(1..=8),
        _ => 0,
    };
    let radius = match is_touching {
        true => distance + if rng.random() { rise } else { 0 },
        false => rng.random_range(distance / 2..=distance - distance / 16 - 1),
    };
    let mut within = |reach: i32| rng.random_range(-reach..=reach);
    let offset = Vector3::new(within(CELL), within(CELL), distance);
    let slide = Vector3::new(within(CELL / 2), within(CELL / 2), rise);
    let below = Vector3::zeros();
    let mut start = match kind {
        QueryKind::EdgeEdge => [below, side(rng), offset, offset + side(rng)],
        QueryKind::VertexFace => {
            let [x, y] = [Vector3::x(), Vector3::y()].map(|axis| axis * CELL);
            let corner = if rng.random() { x } else { y };
            [offset, below, corner, x + y]
        }
    };
    if rng.random() {
        for point in &mut start {
            point.z += rng.random_range(-1..=1);
        }
    }
    let is_above = |index: usize| match kind {
        QueryKind::EdgeEdge => index >= 2,
        QueryKind::VertexFace => index == 0,
    };
    let mut end = start;
    for (_, point) in end.iter_mut().enumerate().filter(|(i, _)| is_above(*i)) {
        *point += slide;
    }
    ([start, end], radius)
}

/// A side or the diagonal of a cell.
fn side(rng: &mut dyn Rng) -> Vector3<i32> {
    let [x, y] = [Vector3::x(), Vector3::y()].map(|axis| axis * CELL);
    match rng.random_range(0..3) {
        0 => x,
        1 => y,
        _ => x + y,
    }
}

/// Both layers carried along together, by up to a few cells.
fn carried(rng: &mut dyn Rng, motion: Motion<i32>) -> Motion<i32> {
    motion.map(|points| {
        let origin = vector(rng, 4 * CELL);
        points.map(|point| point + origin)
    })
}

/// In metres, turned by any rotation.
fn turned(rng: &mut dyn Rng, motion: Motion<i32>) -> Motion<f64> {
    let [axis, other] = [(); 2].map(|()| real_vector(rng, 1.0));
    let quaternion = Quaternion::from_parts(other.x, axis);
    let turn = UnitQuaternion::from_quaternion(quaternion);
    in_units(motion, UNIT).map(|points| points.map(|point| turn * point))
}
