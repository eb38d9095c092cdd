//! What is wrong with a scene, and where.

use std::fmt;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::EMBEDDED;
use super::hang::NoCatenary;
use tunnelproof::wire::ModelError;

/// Why a scene is refused.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The line in the file, from 1, if there is a file.
    pub line: Option<usize>,
    /// Where in the scene, from the outside in: `wires`, `0`, `route`, `2`.
    pub path: Vec<String>,
    /// What is wrong there.
    pub reason: Reason,
}

/// What is wrong with a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// It is no TOML, or a field is missing, unknown or of another kind.
    Text(String),
    /// No scene has this name.
    Unknown(String),
    /// A value that the model refuses.
    Model(ModelError),
    /// No body has this name.
    NoBody {
        /// The name.
        name: String,
        /// The names that bodies have.
        bodies: Vec<String>,
    },
    /// Two bodies or two wires have this name.
    Twice(String),
    /// Something else says the same, by this field.
    Both(&'static str),
    /// The state to go on from is of another scene: what it has there.
    State(String),
    /// A wire cannot hang there in a catenary.
    Hang {
        /// Of this length in m.
        length: f64,
        /// Why not.
        why: NoCatenary,
    },
}

impl SceneError {
    pub(super) fn new(path: &[&dyn fmt::Display], reason: Reason) -> Self {
        SceneError {
            line: None,
            path: path.iter().map(ToString::to_string).collect(),
            reason,
        }
    }

    /// The same with the line in a file, and with the whole path of what is named.
    pub(super) fn in_file(mut self, text: &str) -> Self {
        // The file has been read before, so it parses.
        if let Ok(root) = DeTable::parse(text) {
            let at = place(&root, &mut self.path);
            self.line = Some(line_at(text, at));
        }
        self
    }
}

/// The line of a place in a text, from 1.
pub(super) fn line_at(text: &str, at: usize) -> usize {
    let before = text.bytes().take(at);
    1 + before.filter(|&byte| byte == b'\n').count()
}

/// Where the value at a path starts, or the innermost one that is there. A last name that is not
/// there is looked for further in, and if it is there once the path leads to it.
fn place(root: &Spanned<DeTable<'_>>, path: &mut Vec<String>) -> usize {
    let mut at = root.span().start;
    let mut inside: Option<&DeValue<'_>> = None;
    for (k, name) in path.iter().enumerate() {
        let next = match inside {
            None => root.get_ref().get(name.as_str()),
            Some(DeValue::Table(table)) => table.get(name.as_str()),
            Some(DeValue::Array(array)) => name.parse().ok().and_then(|k: usize| array.get(k)),
            Some(_) => None,
        };
        if let Some(value) = next {
            (at, inside) = (value.span().start, Some(value.get_ref()));
            continue;
        }
        let mut found = Vec::new();
        if let Some(inside) = inside {
            find(inside, name, &path[..k], &mut found);
        }
        match found.as_mut_slice() {
            [] => {}
            [(start, whole)] => (at, *path) = (*start, std::mem::take(whole)),
            [(start, _), ..] => at = *start,
        }
        return at;
    }
    at
}

/// Where fields of a name start, and their paths.
fn find(value: &DeValue<'_>, name: &str, path: &[String], found: &mut Vec<(usize, Vec<String>)>) {
    let within = |name: &str| [path, &[name.to_owned()]].concat();
    match value {
        DeValue::Table(table) => match table.get(name) {
            Some(value) => found.push((value.span().start, within(name))),
            None => {
                for (key, value) in table {
                    find(value.get_ref(), name, &within(key.get_ref()), found);
                }
            }
        },
        DeValue::Array(array) => {
            for (k, value) in array.iter().enumerate() {
                find(value.get_ref(), name, &within(&k.to_string()), found);
            }
        }
        _ => {}
    }
}

impl From<toml::de::Error> for SceneError {
    fn from(error: toml::de::Error) -> Self {
        SceneError::new(&[], Reason::Text(error.to_string().trim_end().to_owned()))
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        for (k, name) in self.path.iter().enumerate() {
            match name.parse::<usize>() {
                Ok(number) => write!(f, "[{number}]")?,
                Err(_) if k == 0 => f.write_str(name)?,
                Err(_) => write!(f, ".{name}")?,
            }
        }
        if !self.path.is_empty() {
            f.write_str(": ")?;
        }
        self.reason.fmt(f)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Text(text) => f.write_str(text),
            Reason::Unknown(name) => {
                write!(f, "there is no scene {name:?}; there are ")?;
                let names = EMBEDDED.map(|(name, _)| name);
                f.write_str(&names.join(", "))
            }
            Reason::Model(error) => error.fmt(f),
            Reason::NoBody { name, bodies } => match bodies.as_slice() {
                [] => write!(f, "there is no body {name:?}; there is none at all"),
                bodies => write!(
                    f,
                    "there is no body {name:?}; bodies are {}",
                    bodies.join(", ")
                ),
            },
            Reason::Twice(name) => write!(f, "the name {name:?} is there twice"),
            Reason::Both(other) => {
                write!(f, "{other} is given as well; give one of the two")
            }
            Reason::State(what) => write!(f, "not as in the state to go on from, which has {what}"),
            Reason::Hang { length, why } => {
                write!(f, "hang is {length}, ")?;
                match why {
                    NoCatenary::AtEnd => f.write_str(
                        "it must be between two stops that have places: free, pinned, eye or contact",
                    ),
                    NoCatenary::Weightless => f.write_str("but there is no gravity to hang in"),
                    NoCatenary::Short(way) => write!(
                        f,
                        "it must be above {way}, the way between the stops before and after it"
                    ),
                    NoCatenary::Above([x, y, z]) => write!(
                        f,
                        "but its ends are one above the other and it would lie on itself; in its \
                        place a stop {{ free = [{x}, {y}, {z}] }} keeps its strands apart"
                    ),
                }
            }
        }
    }
}

impl std::error::Error for SceneError {}
