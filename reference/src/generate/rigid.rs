//! Families of queries of bodies that turn: half of each family edges, half vertices and faces.

use std::fmt;

use rand::Rng;
use tunnelproof::rigid::RigidQuery;

use super::{IdError, seed_and_index, stream};

mod beside;
mod bodies;
mod brief;
mod cast;
mod draft;
mod one;
mod thick;

pub use cast::TURNING_CAST_FAMILIES;

/// Every family of bodies that turn but those that are [cast](TURNING_CAST_FAMILIES).
pub const RIGID_FAMILIES: &[RigidFamily] = &[
    RigidFamily {
        name: "turning_uniform",
        description: "random poses at most 88 degrees apart, random points",
        draw: one::uniform,
    },
    RigidFamily {
        name: "turning_lattice",
        description: "small integers in quaternions and points, some of them the same",
        draw: one::lattice,
    },
    RigidFamily {
        name: "turning_confined",
        description: "all in a plane, on a line or parallel for the whole step, or nearly",
        draw: one::confined,
    },
    RigidFamily {
        name: "turning_grazing",
        description: "double roots, contact at corners and at ends of the step, or nearly",
        draw: one::grazing,
    },
    RigidFamily {
        name: "turning_spin",
        description: "a centre at rest, and an edge or vertex at rest or slow",
        draw: one::spin,
    },
    RigidFamily {
        name: "turning_translation",
        description: "no turn, in coordinates in which the linear query is exact",
        draw: one::translation,
    },
    RigidFamily {
        name: "turning_plates",
        description: "thin plates and rods that turn fast, past what is slow",
        draw: one::plates,
    },
    RigidFamily {
        name: "turning_scales",
        description: "lengths from 1e-6 to 1e6, and quaternions of any length",
        draw: one::scales,
    },
    thick::UNIFORM,
    thick::LATTICE,
    thick::CONFINED,
    thick::TANGENT,
    thick::STILL,
    thick::PLATES,
    thick::SCALES,
    brief::FAMILY,
    beside::FAMILY,
    bodies::UNIFORM,
    bodies::LATTICE,
    bodies::CONFINED,
    bodies::GRAZING,
    bodies::STILL,
    bodies::SCALES,
    thick::BODIES_UNIFORM,
    thick::BODIES_LATTICE,
    thick::BODIES_STILL,
];

/// An endless, seeded sequence of queries of bodies that turn.
#[derive(Debug)]
pub struct RigidFamily {
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> RigidQuery,
}

impl RigidFamily {
    /// The name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What its queries are like, in one line.
    pub fn description(&self) -> &'static str {
        self.description
    }

    /// The query of this seed and index.
    pub fn query(&self, seed: u64, index: u64) -> RigidQuery {
        (self.draw)(&mut stream(self.name, seed, index))
    }

    /// A query made of any random numbers, such as the bytes that a fuzzer chooses.
    pub fn draw(&self, rng: &mut dyn Rng) -> RigidQuery {
        (self.draw)(rng)
    }
}

/// Every family of bodies that turn, in the order of tables.
pub fn all_rigid() -> impl Iterator<Item = &'static RigidFamily> + Clone {
    RIGID_FAMILIES.iter().chain(TURNING_CAST_FAMILIES)
}

/// The family with this name, if any.
pub fn rigid_by_name(name: &str) -> Option<&'static RigidFamily> {
    all_rigid().find(|family| family.name == name)
}

/// The name of a generated query of a body that turns, written `FAMILY:SEED:INDEX`.
#[derive(Clone, Copy, Debug)]
pub struct RigidId {
    /// The family.
    pub family: &'static RigidFamily,
    /// The seed of the family.
    pub seed: u64,
    /// Which query of that seed, from 0.
    pub index: u64,
}

impl fmt::Display for RigidId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.family.name, self.seed, self.index)
    }
}

impl RigidId {
    /// The query of this name.
    pub fn query(&self) -> RigidQuery {
        self.family.query(self.seed, self.index)
    }

    /// The identifier that a text is, if it starts with the name of a family of bodies that turn.
    pub fn parse(text: &str) -> Option<Result<Self, IdError>> {
        let (name, rest) = text.split_once(':')?;
        let family = rigid_by_name(name)?;
        let id = |[seed, index]: [u64; 2]| RigidId {
            family,
            seed,
            index,
        };
        Some(seed_and_index(rest).map(id))
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof::query::QueryKind;

    use super::*;
    use crate::oracle::decide_rigid_query;

    /// Hits, misses, and hits with `toi` at an end of the step, per family.
    #[test]
    fn rigid_families_have_hits_and_misses_of_both_kinds() {
        for family in RIGID_FAMILIES {
            let mut counts = [[0; 2]; 2];
            for index in 0..400 {
                let query = family.query(1, index);
                let kind = usize::from(query.kind().linear() == QueryKind::EdgeEdge);
                let is_hit = decide_rigid_query(&query).hit.is_some();
                counts[kind][usize::from(is_hit)] += 1;
            }
            println!("{} {counts:?}", family.name());
            assert!(
                counts.iter().all(|[misses, hits]| *hits >= 4
                    && (*misses >= 4 || family.name() == "turning_thick_beside")),
                "{} {counts:?}",
                family.name()
            );
        }
    }
}
