//! Folders of queries, and what the public benchmarks keep beside a file.
//!
//! A folder stands for every file of queries in it and in its folders, in the order of their
//! paths. Both public benchmarks are read as they are published. The older one has seven columns
//! and names the kind in its folders ([`super::csv`]). The newer one, with "Time of Impact Dataset
//! for Continuous Collision Detection and a Scalable Conservative Algorithm" (the repository
//! Sample-Scalable-CCD-Data), has a folder for each scene:
//!
//! | file | what is in it |
//! | --- | --- |
//! | `queries/227ee.csv` | six columns, no label; `ee` is edge-edge, `vf` vertex-face |
//! | `mma_bool/227ee_mma_bool.json` | the labels, an array of `true`, `false`, 1 and 0 |
//! | `boxes`, `frames`, `roots` | pairs, meshes and times of impact: not read |
//!
//! Of the test vectors of this project, those of bodies that turn stand in a folder `turning` beside
//! the schema of the others, and are not read.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::error::{CorpusError, Problem};
use super::lines::Lines;
use super::packed::Packing;
use super::{Format, vector_file};

/// The folders of a scene beside that of its queries, whose `.json` files hold no query.
const BESIDE: [&str; 4] = ["mma_bool", "boxes", "frames", "roots"];

/// The files that `path` stands for: of a folder, those of queries in it, sorted; else `path`.
///
/// # Errors
///
/// [`CorpusError`] if a folder cannot be read, or has no such file.
pub fn files(path: &str) -> Result<Vec<String>, CorpusError> {
    if !Path::new(path).is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut found = Vec::new();
    collect(Path::new(path), &mut found)?;
    match found.is_empty() {
        true => Err(CorpusError::new(path, Problem::NoFile)),
        false => Ok(found),
    }
}

/// Whether the file is a JSON schema, which stands beside the test vectors and holds no query.
pub fn is_schema(path: &str) -> bool {
    let Ok(file) = fs::File::open(path) else {
        return false;
    };
    let mut lines = Lines::new(std::io::BufReader::new(file), path);
    let mut is_next = |is: &dyn Fn(&str) -> bool| {
        let line = lines.next().and_then(Result::ok);
        line.is_some_and(|line| is(line.text.trim_start()))
    };
    is_next(&|line| line == vector_file::FIRST_LINE)
        && is_next(&|line| line.starts_with("\"$schema\""))
}

fn collect(folder: &Path, found: &mut Vec<String>) -> Result<(), CorpusError> {
    let shown = folder.display().to_string();
    let unreadable = |error| CorpusError::new(&shown, Problem::Io(error));
    let entries = fs::read_dir(folder).map_err(unreadable)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path()));
    let mut paths: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(unreadable)?;
    paths.sort();
    for path in paths {
        if path.is_dir() {
            if !is_beside(&path) && !is_of_turns(&path) {
                collect(&path, found)?;
            }
        } else if let Some(path) = path.to_str().filter(|path| has_queries(path)) {
            found.push(path.to_owned());
        }
    }
    Ok(())
}

/// Whether it is a folder of a scene that holds no query.
fn is_beside(folder: &Path) -> bool {
    let name = folder.file_name().and_then(|name| name.to_str());
    let is_named = name.is_some_and(|name| BESIDE.contains(&name));
    is_named && folder.with_file_name("queries").is_dir()
}

/// Whether it is the folder of the test vectors of bodies that turn, beside the schema of the others.
fn is_of_turns(folder: &Path) -> bool {
    let schema = folder.with_file_name("schema.json");
    folder.ends_with("turning") && schema.to_str().is_some_and(is_schema)
}

fn has_queries(path: &str) -> bool {
    Format::of_path(path).is_some() && !is_schema(path)
}

/// The labels of the queries of a file, where a benchmark keeps them beside it.
#[derive(Debug)]
pub(super) struct Labels {
    path: String,
    labels: Vec<bool>,
}

impl Labels {
    /// Those of the file at `path`; `None` if there are none.
    ///
    /// # Errors
    ///
    /// [`CorpusError`] for a file that is no array of labels.
    pub(super) fn beside(path: &str) -> Result<Option<Self>, CorpusError> {
        let Some(path) = labels_path(path).filter(|path| path.is_file()) else {
            return Ok(None);
        };
        let shown = path.display().to_string();
        let text = fs::read_to_string(&path)
            .map_err(|error| CorpusError::new(&shown, Problem::Io(error)))?;
        let labels = labels(&text).map_err(|problem| CorpusError::new(&shown, problem))?;
        Ok(Some(Labels {
            path: shown,
            labels,
        }))
    }

    /// The label of the query at this place, from 0.
    ///
    /// # Errors
    ///
    /// There are not so many.
    pub(super) fn get(&self, index: u64) -> Result<bool, CorpusError> {
        let label = usize::try_from(index)
            .ok()
            .and_then(|index| self.labels.get(index));
        label.copied().ok_or_else(|| self.wrong(index + 1))
    }

    /// Sees that there are as many labels as queries.
    ///
    /// # Errors
    ///
    /// There are more.
    pub(super) fn finish(&self, queries: u64) -> Result<(), CorpusError> {
        match self.labels.len() as u64 == queries {
            true => Ok(()),
            false => Err(self.wrong(queries)),
        }
    }

    fn wrong(&self, queries: u64) -> CorpusError {
        let labels = self.labels.len() as u64;
        CorpusError::new(&self.path, Problem::LabelCount { labels, queries })
    }
}

/// Where the labels of `SCENE/queries/NAME.csv` are.
fn labels_path(path: &str) -> Option<PathBuf> {
    let (_, path) = Packing::of_path(path);
    let path = Path::new(path);
    let folder = path.parent().filter(|folder| folder.ends_with("queries"))?;
    let name = path.file_stem()?.to_str()?;
    Some(
        folder
            .with_file_name("mma_bool")
            .join(format!("{name}_mma_bool.json")),
    )
}

fn labels(text: &str) -> Result<Vec<bool>, Problem> {
    let values: Vec<Value> =
        serde_json::from_str(text).map_err(|error| super::jsonl::problem(String::new(), &error))?;
    let label = |value: Value| match (value.as_bool(), value.as_u64()) {
        (Some(label), _) => Ok(label),
        (_, Some(0)) => Ok(false),
        (_, Some(1)) => Ok(true),
        _ => Err(Problem::Label(value.to_string())),
    };
    values.into_iter().map(label).collect()
}
