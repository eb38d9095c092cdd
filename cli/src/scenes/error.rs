//! What is wrong with a scene, and where.

use std::fmt;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::EMBEDDED;
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
    /// It is no TOML, or a field is missing, unknown or of another kind. The text shows the place.
    Text(String),
    /// No scene has this name.
    Unknown(String),
    /// A value that the model refuses.
    Model(ModelError),
    /// No body has this name.
    NoBody(String),
    /// Two bodies or two wires have this name.
    Twice(String),
    /// Something else says the same, by this field.
    Both(&'static str),
    /// The state to go on from is of another scene: what it has there.
    State(String),
    /// A wire cannot hang there in a catenary of this length.
    Hang(f64),
}

impl SceneError {
    pub(super) fn new(path: &[&dyn fmt::Display], reason: Reason) -> Self {
        SceneError {
            line: None,
            path: path.iter().map(ToString::to_string).collect(),
            reason,
        }
    }

    /// The same with the line in a file.
    pub(super) fn in_file(mut self, text: &str) -> Self {
        // The file has been read before, so it parses.
        if let Ok(root) = DeTable::parse(text) {
            let at = place(&root, &self.path);
            self.line = Some(1 + text[..at].matches('\n').count());
        }
        self
    }
}

/// Where the value at a path starts, or the innermost one that is there. A last name that is not
/// there is looked for further in.
fn place(root: &Spanned<DeTable<'_>>, path: &[String]) -> usize {
    let mut at = root.span().start;
    let mut inside: Option<&DeValue<'_>> = None;
    for name in path {
        let next = match inside {
            None => root.get_ref().get(name.as_str()),
            Some(DeValue::Table(table)) => table.get(name.as_str()),
            Some(DeValue::Array(array)) => name.parse().ok().and_then(|k: usize| array.get(k)),
            Some(_) => None,
        };
        match next {
            Some(value) => (at, inside) = (value.span().start, Some(value.get_ref())),
            None => return inside.and_then(|inside| find(inside, name)).unwrap_or(at),
        }
    }
    at
}

/// Where the first field of a name starts.
fn find(value: &DeValue<'_>, name: &str) -> Option<usize> {
    match value {
        DeValue::Table(table) => match table.get(name) {
            Some(found) => Some(found.span().start),
            None => table
                .iter()
                .find_map(|(_, value)| find(value.get_ref(), name)),
        },
        DeValue::Array(array) => array.iter().find_map(|value| find(value.get_ref(), name)),
        _ => None,
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
            Reason::NoBody(name) => write!(f, "there is no body {name:?}"),
            Reason::Twice(name) => write!(f, "the name {name:?} is there twice"),
            Reason::Both(other) => {
                write!(f, "{other} says the same; only one of the two may be there")
            }
            Reason::State(what) => write!(f, "not as in the state to go on from, which has {what}"),
            Reason::Hang(length) => write!(
                f,
                "hang is {length}; it must be longer than the way between the stops before and \
                after it, which must \
                 not be one above the other, and there must be gravity"
            ),
        }
    }
}

impl std::error::Error for SceneError {}
