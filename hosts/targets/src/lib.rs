//! Digests of what the engine, the judge and the wire stepper answer: the same numbers on every
//! target, or some bits differ.
//!
//! `hosts/targets/check` builds this for other targets, runs it there, and compares.

use std::fmt::{self, Write as _};

use tunnelproof::certified::{Batch, Kind, classify, decide, decide_exactly};
use tunnelproof::query::{EdgeEdge, Query, VertexFace};
use tunnelproof::{Clearance, advance, decide_discrete};
use tunnelproof_reference::generate::{self, Family};
use tunnelproof_reference::oracle;
use tunnelproof_reference::shadow::Shadow;

mod scene;
mod zeros;

/// Families are asked with this seed.
const SEED: u64 = 20;

/// One query of so many is also asked of the judges.
const JUDGED: u64 = 20;

/// What is asked: a family, or the scene.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// Queries of a family.
    Family(&'static Family),
    /// Queries with zeros of both signs, whose larger and smaller ones no standard tells apart.
    Zeros,
    /// The wire stepper.
    Scene,
}

impl Part {
    /// All parts, in order.
    pub fn all() -> impl Iterator<Item = Part> {
        generate::all()
            .map(Part::Family)
            .chain([Part::Zeros, Part::Scene])
    }

    /// Its name, as a word.
    pub fn name(&self) -> &'static str {
        match self {
            Part::Family(family) => family.name(),
            Part::Zeros => "zeros",
            Part::Scene => "scene",
        }
    }

    /// The digest of all answers: to so many queries of a family, or of as many steps of the scene.
    pub fn digest(&self, count: u64) -> u64 {
        match self {
            Part::Family(family) => of_queries(count, |index| family.query(SEED, index)),
            Part::Zeros => of_queries(count, zeros::query),
            Part::Scene => scene::digest(count),
        }
    }
}

/// The digest of a part by its number, for hosts of WebAssembly; 0 if there is no such part.
// SAFETY: no other function of the program has this name.
#[allow(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn tunnelproof_targets_digest(part: u32, count: u32) -> u64 {
    let part = Part::all().nth(part as usize);
    part.map_or(0, |part| part.digest(count.into()))
}

fn of_queries(count: u64, query: impl Fn(u64) -> Query) -> u64 {
    let mut digest = Digest::new();
    let (mut edges, mut faces) = (Batch::new(), Batch::new());
    for index in 0..count {
        let query = query(index);
        match &query {
            Query::EdgeEdge(query) => {
                edges.push(query);
                answers(&mut digest, query);
                digest.add(&decide_discrete(query));
            }
            Query::VertexFace(query) => {
                faces.push(query);
                answers(&mut digest, query);
            }
        }
        if index % JUDGED == 0 {
            exact_answers(&mut digest, &query);
        }
    }
    digest.add(&Batch::<EdgeEdge>::decide(&edges));
    digest.add(&Batch::<VertexFace>::decide(&faces));
    digest.value()
}

/// What the engine says of a query: the hit with its place, normal and points, and a step.
fn answers<K: Kind>(digest: &mut Digest, query: &K)
where
    K::Place: fmt::Debug,
{
    let hit = decide(query);
    digest.add(&hit);
    digest.add(&classify(query));
    digest.add(&advance(query, Clearance::Share(0.1)));
}

/// What integers say of it, and the judges.
fn exact_answers(digest: &mut Digest, query: &Query) {
    match query {
        Query::EdgeEdge(edges) => {
            digest.add(&decide_exactly(edges));
            digest.add(&decide(edges).map(|hit| hit.contact(edges)));
            digest.add(&Shadow::REPAIRED.decide(query));
        }
        Query::VertexFace(face) => {
            digest.add(&decide_exactly(face));
            digest.add(&decide(face).map(|hit| hit.contact(face)));
        }
    }
    digest.add(&oracle::decide_query(query));
}

/// FNV-1a of 64 bits over what values show of themselves: numbers as the shortest decimals that are
/// read as the same ones.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Digest(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, value: &impl fmt::Debug) {
        // Writing to a digest does not fail.
        let _ = write!(self, "{value:?};");
    }

    fn value(&self) -> u64 {
        self.0
    }
}

impl fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}
