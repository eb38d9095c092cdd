//! Rigid bodies that are cast along lines, as physics engines do: capsules, segments, and a sphere
//! against a triangle. Each body is carried by one translation.
//!
//! Two capsules are two edges whose radius is the sum of theirs, a sphere is an edge without
//! length, and a sphere against a triangle is a vertex and a face. Probes what the shape casts of
//! physics engines answer, so every number is one that they can hold: each coordinate at either end
//! of the step, each translation and each radius is a whole multiple of a unit, fewer than `2^23`
//! of them, and the unit a power of two. So each is a number in `f32`, both points of a body are
//! translated by the same vector exactly, and an engine in single precision is asked the same query
//! as one in double precision.
//!
//! The two parts of the radius are those of the two bodies. Of capsules neither is 0; of 8 pairs of
//! capsules, in 1 the first, in 1 the second and in 1 either is a sphere.

use rand::Rng;
use tunnelproof::query::Query;

use super::{Draw, Family};

mod bodies;
mod draws;
mod pair;

#[cfg(test)]
mod tests;

pub(crate) use bodies::rotation;
use draws::{coplanar, far, grazing, lattice, long_thin, parallel, start, tiny, uniform};
use pair::Pair;

/// Every family of bodies that are cast, in the order of tables.
pub const CAST_FAMILIES: &[Family] = &[
    family("cast_uniform", "capsules cast: general motion", |rng| {
        uniform(rng, Pair::Capsules)
    }),
    family("cast_lattice", "capsules cast: small integers", |rng| {
        lattice(rng, Pair::Capsules)
    }),
    family(
        "cast_coplanar",
        "capsules cast: in one plane, exactly or nearly",
        |rng| coplanar(rng, Pair::Capsules),
    ),
    family(
        "cast_parallel",
        "capsules cast: parallel, exactly or nearly",
        |rng| parallel(rng, Pair::Capsules),
    ),
    family(
        "cast_grazing",
        "capsules cast: past each other at the sum of the radii, exactly or nearly",
        |rng| grazing(rng, Pair::Capsules),
    ),
    family(
        "cast_long_thin",
        "capsules cast: hundreds of metres long against millimetres",
        |rng| long_thin(rng, Pair::Capsules),
    ),
    family(
        "cast_far",
        "capsules cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::Capsules),
    ),
    family("cast_tiny", "capsules cast: steps of a few units", |rng| {
        tiny(rng, Pair::Capsules)
    }),
    family(
        "cast_start",
        "capsules cast: in contact at the start, by overlap or just so",
        |rng| start(rng, Pair::Capsules),
    ),
    family(
        "cast_thin_uniform",
        "segments cast: general motion",
        |rng| uniform(rng, Pair::Segments),
    ),
    family(
        "cast_thin_lattice",
        "segments cast: small integers",
        |rng| lattice(rng, Pair::Segments),
    ),
    family(
        "cast_thin_coplanar",
        "segments cast: in one plane, exactly or nearly",
        |rng| coplanar(rng, Pair::Segments),
    ),
    family(
        "cast_thin_parallel",
        "segments cast: parallel, exactly or nearly",
        |rng| parallel(rng, Pair::Segments),
    ),
    family(
        "cast_thin_far",
        "segments cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::Segments),
    ),
    family(
        "cast_face_uniform",
        "sphere and triangle cast: general motion",
        |rng| uniform(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_lattice",
        "sphere and triangle cast: small integers",
        |rng| lattice(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_grazing",
        "sphere and triangle cast: past each other at the radius, exactly or nearly",
        |rng| grazing(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_long_thin",
        "sphere and triangle cast: hundreds of metres long against millimetres",
        |rng| long_thin(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_far",
        "sphere and triangle cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_tiny",
        "sphere and triangle cast: steps of a few units",
        |rng| tiny(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_start",
        "sphere and triangle cast: in contact at the start, by overlap or just so",
        |rng| start(rng, Pair::SphereFace),
    ),
];

const fn family(
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> Query,
) -> Family {
    Family {
        name,
        description,
        draw: Draw::Query(draw),
    }
}
