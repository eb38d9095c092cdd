//! Test vectors: queries with their exact answers as JSON, against which any implementation of
//! continuous collision detection can be checked, in any language.
//!
//! `vectors/README.md` describes the format, `vectors/schema.json` states it. One file for each
//! source: the figures of the thesis, the witnesses of its errata, public bug reports, and a
//! selection of each [family](tunnelproof_reference::generate). All of it is computed from the
//! sources here, the same on every machine; nothing is edited by hand.

use std::collections::{BTreeMap, HashSet};

use rayon::prelude::*;
use serde::Serialize;

use tunnelproof_reference::generate::{FAMILIES, OTHER_KINDS};
use tunnelproof_reference::shape::Shape;

mod assessment;
mod exact_time;
mod families;
mod flag;
mod given;
mod layout;
mod method;
pub mod package;
mod reports;
mod turning;
mod vector;

use flag::Note;
pub use turning::FOLDER as TURNING;
use vector::{Described, Vector};

/// A file of vectors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VectorFile {
    /// The name of the file, such as `lattice.json`.
    pub name: String,
    /// What is in it.
    pub text: String,
    /// How many vectors there are in it.
    pub vectors: usize,
}

/// The queries of one source, still without their answers.
struct Source {
    name: String,
    description: String,
    queries: Vec<Described>,
}

/// A whole file as JSON has it.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    generator: &'static str,
    source: String,
    number_of_vectors: usize,
    notes: BTreeMap<String, Note>,
    vectors: Vec<Vector>,
}

/// Every file of vectors, those of bodies that turn in a folder of their own. No query is in two of
/// the others, but those that belong to a wire.
pub fn files() -> Vec<VectorFile> {
    let mut sources = vec![given::figures(), given::errata(), reports::reports()];
    // Casts are queries of the same kinds; they are for the bench of physics engines.
    let families: Vec<_> = FAMILIES.iter().chain(OTHER_KINDS).collect();
    let families: Vec<_> = families.into_par_iter().map(families::selection).collect();
    sources.extend(families);
    without_repetition(&mut sources);
    let files = sources.into_iter().map(Source::file);
    files.chain(turning::files()).collect()
}

/// Leaves of equal queries the first one.
fn without_repetition(sources: &mut [Source]) {
    let mut seen = HashSet::new();
    for source in sources {
        source.queries.retain(|described| {
            let is_new = seen.insert(Shape::new(&described.query));
            is_new || described.wire.is_some()
        });
    }
}

impl Source {
    fn file(self) -> VectorFile {
        let vectors: Vec<_> = self.queries.into_par_iter().map(Vector::new).collect();
        let flags = vectors.iter().flat_map(Vector::flags);
        let document = Document {
            schema: "schema.json",
            generator: concat!("tunnelproof ", env!("CARGO_PKG_VERSION"), " vectors"),
            source: self.description,
            number_of_vectors: vectors.len(),
            notes: flags.map(|flag| (flag.name(), flag.note())).collect(),
            vectors,
        };
        VectorFile {
            name: format!("{}.json", self.name),
            text: layout::text(&document),
            vectors: document.number_of_vectors,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    /// Those of the families take longer: `vectors_are_what_would_be_written_and_every_difference_is_found`.
    #[test]
    fn files_before_the_families_are_as_they_are_on_disk() {
        let mut sources = vec![given::figures(), given::errata(), reports::reports()];
        without_repetition(&mut sources);
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors");
        for file in sources.into_iter().map(Source::file) {
            let on_disk = fs::read_to_string(folder.join(&file.name)).unwrap();
            assert!(file.text == on_disk, "{}", file.name);
        }
    }
}
