//! Families of generated queries: one module each, one property probed by each.
//!
//! A query of a family is named by a seed and an index, `FAMILY:SEED:INDEX`, and made from these
//! alone: any one can be made by itself, on any thread, in any order. The random numbers are
//! ChaCha8, keyed by the seed and the family's name, with the index as the stream.
//!
//! The queries of a family come in groups that belong together: each by itself, or the segments of
//! one wire one after the other, which share a stream.

use std::fmt;
use std::str::FromStr;

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::query::{EdgeEdge, Point, Query};

pub use cast::CAST_FAMILIES;
pub(crate) use cast::rotation as integer_rotation;
use motion::Motion;
pub(crate) use motion::vector as random_vector;
pub use rigid::{
    RIGID_FAMILIES, RigidFamily, RigidId, TURNING_CAST_FAMILIES, all_rigid, rigid_by_name,
};

mod cancellation;
mod cast;
mod confine;
mod crossing;
mod face;
mod grazing;
mod joint;
mod lattice;
mod layers;
mod long_thin;
mod meeting;
mod motion;
mod near_collinear;
mod near_coplanar;
mod near_parallel;
mod nudge;
mod point_on_line;
mod rigid;
mod scales;
mod shared_start;
mod slow;
mod temporarily_parallel;
mod temporarily_point;
mod thick;
mod triple_root;
mod uniform;

/// Every family of edges without radius, in the order of tables.
pub const FAMILIES: &[Family] = &[
    uniform::FAMILY,
    lattice::FAMILY,
    near_coplanar::FAMILY,
    near_parallel::FAMILY,
    near_collinear::FAMILY,
    shared_start::FAMILY,
    point_on_line::FAMILY,
    temporarily_parallel::FAMILY,
    temporarily_point::FAMILY,
    grazing::FAMILY,
    triple_root::FAMILY,
    scales::FAMILY,
    cancellation::FAMILY,
    slow::FAMILY,
    long_thin::FAMILY,
    joint::FAMILY,
];

/// Every family of other kinds of queries, in the order of tables: vertices and faces, and with a
/// radius.
pub const OTHER_KINDS: &[Family] = &[
    face::UNIFORM,
    face::LATTICE,
    face::NEAR_COPLANAR,
    face::GRAZING,
    face::COLLAPSING,
    face::SCALES,
    face::CANCELLATION,
    thick::UNIFORM,
    thick::LATTICE,
    thick::PARALLEL,
    thick::GRAZING,
    thick::SCALES,
    layers::EDGES,
    layers::TOUCHING_EDGES,
    thick::FACE_UNIFORM,
    thick::FACE_LATTICE,
    layers::FACES,
    layers::TOUCHING_FACES,
];

/// Every family of any kind, in the order of tables.
pub fn all() -> impl Iterator<Item = &'static Family> + Clone {
    FAMILIES.iter().chain(OTHER_KINDS).chain(CAST_FAMILIES)
}

/// An endless, seeded sequence of queries that probe one property.
#[derive(Debug)]
pub struct Family {
    name: &'static str,
    description: &'static str,
    draw: Draw,
}

/// How a group of queries is made of random numbers.
#[derive(Debug)]
enum Draw {
    /// Each query by itself.
    Query(fn(&mut dyn Rng) -> Query),
    /// Two consecutive segments of one wire against one other segment, which provably passes from
    /// one side of the wire to the other.
    Wire(fn(&mut dyn Rng) -> [Query; 2]),
}

impl Family {
    /// The name used in identifiers, in tables and on the command line.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What its queries are like, in one line.
    pub fn description(&self) -> &'static str {
        self.description
    }

    /// The query of this seed and index.
    pub fn query(&self, seed: u64, index: u64) -> Query {
        let size = self.group_size() as u64;
        let mut rng = stream(self.name, seed, index / size);
        self.draw.member(&mut rng, (index % size) as usize)
    }

    /// How many consecutive queries, from an index that it divides, are one group: 1, or 2 for the
    /// segments of a wire that another segment passes through, so that a hit is due in one of them.
    pub fn group_size(&self) -> usize {
        match self.draw {
            Draw::Query(_) => 1,
            Draw::Wire(_) => 2,
        }
    }

    /// A query made of any random numbers, such as the bytes that a fuzzer chooses.
    pub fn draw(&self, rng: &mut dyn Rng) -> Query {
        let member = rng.random_range(0..self.group_size());
        self.draw.member(rng, member)
    }
}

impl Draw {
    /// One query of a group.
    fn member(&self, rng: &mut dyn Rng, member: usize) -> Query {
        match self {
            Draw::Query(draw) => draw(rng),
            Draw::Wire(draw) => draw(rng)[member],
        }
    }
}

/// The family with this [`name`](Family::name), if any.
pub fn by_name(name: &str) -> Option<&'static Family> {
    all().find(|family| family.name == name)
}

/// The name of a generated query, written `FAMILY:SEED:INDEX`.
#[derive(Clone, Copy, Debug)]
pub struct GeneratedId {
    /// The family.
    pub family: &'static Family,
    /// The seed of the family.
    pub seed: u64,
    /// Which query of that seed, from 0.
    pub index: u64,
}

impl GeneratedId {
    /// The query of this name.
    pub fn query(&self) -> Query {
        self.family.query(self.seed, self.index)
    }
}

/// Why a text is not the name of a generated query.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum IdError {
    /// It is not three texts with a `:` between them.
    #[error("not of the form FAMILY:SEED:INDEX")]
    Form,
    /// There is no such family.
    #[error("no such family; there are {}", names())]
    Family,
    /// The seed is not a number.
    #[error("the seed is not an integer from 0 to {}", u64::MAX)]
    Seed,
    /// The index is not a number.
    #[error("the index is not an integer from 0 to {}", u64::MAX)]
    Index,
}

/// The random numbers of a seed and an index of the family with this name.
pub(crate) fn stream(name: &str, seed: u64, index: u64) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    for (byte, letter) in key[8..].iter_mut().zip(name.bytes()) {
        *byte = letter;
    }
    let mut rng = ChaCha8Rng::from_seed(key);
    rng.set_stream(index);
    rng
}

/// The seed and the index of `SEED:INDEX`, what is left of an identifier without its family.
pub(crate) fn seed_and_index(text: &str) -> Result<[u64; 2], IdError> {
    let (seed, index) = text.split_once(':').ok_or(IdError::Form)?;
    Ok([
        seed.parse().map_err(|_| IdError::Seed)?,
        index.parse().map_err(|_| IdError::Index)?,
    ])
}

fn names() -> String {
    let names: Vec<_> = all().map(Family::name).collect();
    names.join(", ")
}

impl FromStr for GeneratedId {
    type Err = IdError;

    fn from_str(text: &str) -> Result<Self, IdError> {
        let parts: Vec<_> = text.split(':').collect();
        let &[family, seed, index] = parts.as_slice() else {
            return Err(IdError::Form);
        };
        Ok(GeneratedId {
            family: by_name(family).ok_or(IdError::Family)?,
            seed: seed.parse().map_err(|_| IdError::Seed)?,
            index: index.parse().map_err(|_| IdError::Index)?,
        })
    }
}

impl fmt::Display for GeneratedId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.family.name, self.seed, self.index)
    }
}

/// The query of two edges with radius 0, from positions that are finite by construction.
fn edge_edge([start, end]: Motion<f64>) -> Query {
    EdgeEdge::new(start.map(Point::from), end.map(Point::from), 0.0)
        .map(Query::EdgeEdge)
        .expect("a family makes finite coordinates")
}

#[cfg(test)]
mod tests;
