//! Families of generated queries: one module each, one property probed by each.
//!
//! A query of a family is named by a seed and an index, `FAMILY:SEED:INDEX`, and made from these
//! alone: any one can be made by itself, on any thread, in any order. The random numbers are
//! ChaCha8, keyed by the seed and the family's name, with the index as the stream.

use std::fmt;
use std::str::FromStr;

use nalgebra::Vector3;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::query::{EdgeEdge, Point, Query};

mod lattice;
mod uniform;

/// Every family, in the order of tables.
pub const FAMILIES: &[Family] = &[uniform::FAMILY, lattice::FAMILY];

/// An endless, seeded sequence of queries that probe one property.
#[derive(Debug)]
pub struct Family {
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> Query,
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
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        for (byte, letter) in key[8..].iter_mut().zip(self.name.bytes()) {
            *byte = letter;
        }
        let mut rng = ChaCha8Rng::from_seed(key);
        rng.set_stream(index);
        self.draw(&mut rng)
    }

    /// A query made of any random numbers, such as the bytes that a fuzzer chooses.
    pub fn draw(&self, rng: &mut dyn Rng) -> Query {
        (self.draw)(rng)
    }
}

/// The family with this [`name`](Family::name), if any.
pub fn by_name(name: &str) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.name == name)
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

fn names() -> String {
    let names: Vec<_> = FAMILIES.iter().map(Family::name).collect();
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
fn edge_edge(start: [Vector3<f64>; 4], end: [Vector3<f64>; 4]) -> Query {
    EdgeEdge::new(start.map(Point::from), end.map(Point::from), 0.0)
        .map(Query::EdgeEdge)
        .expect("a family makes finite coordinates")
}

#[cfg(test)]
mod tests;
