//! A vertex and a face in the place of two edges: every property that a family of edges probes,
//! probed for faces.
//!
//! Of edges AB and CD the vertex is A and the face has the corners C, D and `2 A - B`, which is as
//! far from A as B is, on the other side. The triple product of the four points is the same up to
//! its sign, and where the edges touch the vertex is on the face: with the parameters `u` and `v`
//! of the edges the weights are as `1 - v`, `v` and `u`. So an end A that is on CD becomes a vertex
//! on an edge of the face, an edge that is a point a face that is a segment, and motion in a plane
//! stays there. `2 A - B` is rounded where the numbers have all their bits.

use rand::Rng;
use tunnelproof::query::{Point, Query, QueryKind};

use super::{Draw, Family, cancellation, grazing, lattice, near_coplanar, scales};
use super::{temporarily_point, uniform};

pub(super) const UNIFORM: Family = Family {
    name: "face_uniform",
    description: "vertex and face: general motion",
    draw: Draw::Query(|rng| faced(rng, &uniform::FAMILY)),
};

pub(super) const LATTICE: Family = Family {
    name: "face_lattice",
    description: "vertex and face: every degeneracy exactly, in small integers",
    draw: Draw::Query(|rng| faced(rng, &lattice::FAMILY)),
};

pub(super) const NEAR_COPLANAR: Family = Family {
    name: "face_near_coplanar",
    description: "vertex and face: in one plane for the whole step, exactly or nearly",
    draw: Draw::Query(|rng| faced(rng, &near_coplanar::FAMILY)),
};

pub(super) const GRAZING: Family = Family {
    name: "face_grazing",
    description: "vertex and face: double roots, the vertex on an edge or a corner, exactly or nearly",
    draw: Draw::Query(|rng| faced(rng, &grazing::FAMILY)),
};

pub(super) const COLLAPSING: Family = Family {
    name: "face_collapsing",
    description: "vertex and face: a face that has no area at one time, exactly or nearly",
    draw: Draw::Query(|rng| faced(rng, &temporarily_point::FAMILY)),
};

pub(super) const SCALES: Family = Family {
    name: "face_scales",
    description: "vertex and face: tiny and huge numbers together",
    draw: Draw::Query(|rng| faced(rng, &scales::FAMILY)),
};

pub(super) const CANCELLATION: Family = Family {
    name: "face_cancellation",
    description: "vertex and face: far from the origin",
    draw: Draw::Query(|rng| faced(rng, &cancellation::FAMILY)),
};

/// A query of edges, as a vertex and a face.
fn faced(rng: &mut dyn Rng, family: &Family) -> Query {
    let edges = family.draw(rng);
    let points = |[a, b, c, d]: [Point; 4]| {
        // Where the mirrored point overflows, it stays where B is.
        let mirrored = a + (a - b);
        let is_finite = mirrored.iter().all(|x| x.is_finite());
        [a, c, d, if is_finite { mirrored } else { b }]
    };
    let (start, end) = (points(*edges.start()), points(*edges.end()));
    Query::new(QueryKind::VertexFace, start, end, edges.radius())
        .expect("a family makes finite coordinates")
}
