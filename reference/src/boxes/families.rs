//! Families of boxes that are cast.
//!
//! Every number is one that an engine in single precision holds, as in the other
//! [families of casts](crate::generate::CAST_FAMILIES): coordinates at either end of the step, of
//! corners and of the middle of a box, half of its sides, translations and radii are whole multiples of
//! a power of two, fewer than `2^23` of them.
//!
//! A box along the axes is known to every engine exactly, as a middle and half of its sides. One that
//! is turned is not: the rotation of an engine is a quaternion of length 1 or a matrix, and a rotation
//! whose numbers are all dyadic maps axes to axes. So a turned box has its corners on the lattice,
//! and is for engines that take corners.

use std::fmt;

use rand::Rng;

use super::body::BoxCast;
use super::draws::{Other, far, grazing, lattice, long_thin, start, tiny, uniform};
use crate::generate::{IdError, seed_and_index, stream};

/// Every family of boxes that are cast, in the order of tables.
pub const BOX_FAMILIES: &[BoxFamily] = &[
    family("cast_box_uniform", "boxes cast: general motion", |rng| {
        uniform(rng, Other::Box)
    }),
    family("cast_box_lattice", "boxes cast: small integers", |rng| {
        lattice(rng, Other::Box)
    }),
    family(
        "cast_box_grazing",
        "boxes cast: along a face, exactly or nearly",
        |rng| grazing(rng, Other::Box),
    ),
    family(
        "cast_box_long_thin",
        "boxes cast: beams of tens of metres against millimetres",
        |rng| long_thin(rng, Other::Box),
    ),
    family(
        "cast_box_far",
        "boxes cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Other::Box),
    ),
    family("cast_box_tiny", "boxes cast: steps of a few units", |rng| {
        tiny(rng, Other::Box)
    }),
    family(
        "cast_box_start",
        "boxes cast: in contact at the start, by overlap or just so",
        |rng| start(rng, Other::Box),
    ),
    family(
        "cast_box_round_uniform",
        "box and capsule or sphere cast: general motion",
        |rng| uniform(rng, Other::Round),
    ),
    family(
        "cast_box_round_lattice",
        "box and capsule or sphere cast: small integers",
        |rng| lattice(rng, Other::Round),
    ),
    family(
        "cast_box_round_grazing",
        "box and capsule or sphere cast: along a face at the radius, exactly or nearly",
        |rng| grazing(rng, Other::Round),
    ),
    family(
        "cast_box_round_far",
        "box and capsule or sphere cast: hundreds of metres off the origin",
        |rng| far(rng, Other::Round),
    ),
    family(
        "cast_box_round_tiny",
        "box and capsule or sphere cast: steps of a few units",
        |rng| tiny(rng, Other::Round),
    ),
    family(
        "cast_box_round_start",
        "box and capsule or sphere cast: in contact at the start",
        |rng| start(rng, Other::Round),
    ),
    family(
        "cast_box_face_uniform",
        "box and triangle cast: general motion",
        |rng| uniform(rng, Other::Face),
    ),
    family(
        "cast_box_face_lattice",
        "box and triangle cast: small integers",
        |rng| lattice(rng, Other::Face),
    ),
    family(
        "cast_box_face_grazing",
        "box and triangle cast: along a face, exactly or nearly",
        |rng| grazing(rng, Other::Face),
    ),
    family(
        "cast_box_face_start",
        "box and triangle cast: in contact at the start",
        |rng| start(rng, Other::Face),
    ),
    family(
        "cast_box_thin_uniform",
        "box and segment cast: general motion",
        |rng| uniform(rng, Other::Thin),
    ),
    family(
        "cast_box_thin_lattice",
        "box and segment cast: small integers",
        |rng| lattice(rng, Other::Thin),
    ),
    family(
        "cast_box_turned_uniform",
        "boxes cast that are turned: general motion",
        |rng| uniform(rng, Other::Turned),
    ),
    family(
        "cast_box_turned_grazing",
        "boxes cast that are turned: along a face, exactly or nearly",
        |rng| grazing(rng, Other::Turned),
    ),
    family(
        "cast_box_turned_start",
        "boxes cast that are turned: in contact at the start",
        |rng| start(rng, Other::Turned),
    ),
];

/// An endless, seeded sequence of casts of boxes that probe one property.
#[derive(Debug)]
pub struct BoxFamily {
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> BoxCast,
}

const fn family(
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> BoxCast,
) -> BoxFamily {
    BoxFamily {
        name,
        description,
        draw,
    }
}

impl BoxFamily {
    /// The name used in identifiers, in tables and on the command line.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What its casts are like, in one line.
    pub fn description(&self) -> &'static str {
        self.description
    }

    /// The cast of this seed and index.
    pub fn cast(&self, seed: u64, index: u64) -> BoxCast {
        (self.draw)(&mut stream(self.name, seed, index))
    }
}

/// The family with this name, if any.
pub fn box_family(name: &str) -> Option<&'static BoxFamily> {
    BOX_FAMILIES.iter().find(|family| family.name == name)
}

/// The name of a generated cast of a box, written `FAMILY:SEED:INDEX`.
#[derive(Clone, Copy, Debug)]
pub struct BoxId {
    /// The family.
    pub family: &'static BoxFamily,
    /// The seed of the family.
    pub seed: u64,
    /// Which cast of that seed, from 0.
    pub index: u64,
}

impl BoxId {
    /// The cast of this name.
    pub fn cast(&self) -> BoxCast {
        self.family.cast(self.seed, self.index)
    }

    /// The identifier that a text is, if it starts with the name of a family of boxes.
    pub fn parse(text: &str) -> Option<Result<Self, IdError>> {
        let (name, rest) = text.split_once(':')?;
        let family = box_family(name)?;
        let id = |[seed, index]: [u64; 2]| BoxId {
            family,
            seed,
            index,
        };
        Some(seed_and_index(rest).map(id))
    }
}

impl fmt::Display for BoxId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.family.name, self.seed, self.index)
    }
}
