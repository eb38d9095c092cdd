//! What can be wrong with a corpus, and where.

use std::fmt;
use std::io;

use crate::figures::FIGURES;
use tunnelproof::query::{QueryError, QueryKind};
use tunnelproof::rigid::{RigidError, RigidQueryKind};

use super::csv::LONGEST_INTEGER;
use super::dyadic::NotF64;
use super::hexfloat::HexFloatError;
use super::lines::LONGEST_LINE;
use crate::generate::IdError;

/// What is wrong with a corpus and where; written as one line, `path:line: what is wrong`.
#[derive(Debug)]
pub struct CorpusError {
    /// The file as it was named, `-` for the standard input, or the identifier that was looked up.
    pub path: String,
    /// The line, from 1; `None` if what is wrong belongs to no line.
    pub line: Option<u64>,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a corpus.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be opened or read.
    #[error("{}", describe(.0))]
    Io(io::Error),
    /// The file name has an extension that is not read, or none.
    #[error("neither a .jsonl (.json, .ndjson) nor a .csv file; - reads the standard input")]
    Extension,
    /// There is no query in it.
    #[error("holds no query")]
    Empty,
    /// A line is longer than any query.
    #[error("line is longer than {LONGEST_LINE} bytes")]
    LineTooLong,
    /// A line is not text.
    #[error("line is not UTF-8")]
    NotUtf8,
    /// Nothing says of which kind the query is.
    #[error("states no kind; pass --kind edge-edge or --kind vertex-face")]
    KindMissing,
    /// The kind has another name than the two there are.
    #[error("kind is {}, neither edge-edge nor vertex-face", quoted(.0))]
    KindUnknown(String),
    /// The line has fields that queries of bodies that turn have, and others do not.
    #[error("is a query of bodies that turn, which are read with --turning")]
    Turning,
    /// The query is none of bodies that turn.
    #[error("is a query of linear motion, which is read without --turning")]
    NotTurning,
    /// The text names no query of bodies that turn.
    #[error("is neither PATH#ID nor FAMILY:SEED:INDEX of a query of bodies that turn")]
    NotNamed,
    /// The kind is none of bodies that turn.
    #[error("kind is {}, not {}", quoted(.0), RigidQueryKind::ALL.map(RigidQueryKind::name).join(", "))]
    TurningKindUnknown(String),
    /// The poses, the points and the radius are no query of a body that turns.
    #[error(transparent)]
    Rigid(#[from] RigidError),
    /// A list has another number of items than it has to have.
    #[error("{place} has {count} items, not {expected}")]
    Length {
        /// Which list.
        place: String,
        /// How many items it has.
        count: usize,
        /// How many it has to have.
        expected: usize,
    },
    /// The kind is not the one that was asked for.
    #[error("is of kind {stated}, but --kind says {asked}")]
    KindContradiction {
        /// What the query or the name of the file says.
        stated: QueryKind,
        /// What was asked for.
        asked: QueryKind,
    },
    /// The eight points and the radius are no query.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// The line is not an object of JSON.
    #[error("not a JSON object")]
    NotObject,
    /// The line is not JSON, or a value in it is not of the type that it has to be.
    #[error("{}{message} at column {column}", prefix(.place))]
    Json {
        /// Which value, such as `x of point B at t = 1`; empty for the whole line.
        place: String,
        /// What is wrong with it.
        message: String,
        /// The column, from 1.
        column: usize,
    },
    /// The number of points is not eight.
    #[error("{0} points, not 8")]
    PointCount(usize),
    /// The number of coordinates is not three.
    #[error("{point} has {count} coordinates, not 3")]
    CoordinateCount {
        /// Which point, such as `point B at t = 1`.
        point: String,
        /// How many coordinates it has.
        count: usize,
    },
    /// A text in place of a number is not a hexadecimal float.
    #[error("{place} is {}, which {reason}", quoted(.text))]
    HexFloat {
        /// Which value, such as `x of point B at t = 1`.
        place: String,
        /// The text.
        text: String,
        /// What is wrong with it.
        reason: HexFloatError,
    },
    /// The number of columns is neither seven nor six, or not that of the query's first row.
    #[error(
        "{0} columns, not the 7 of x_num,x_den,y_num,y_den,z_num,z_den,label, or on all rows of a query the 6 without label"
    )]
    ColumnCount(usize),
    /// A file of labels has not as many as there are queries.
    #[error("{labels} labels, and there are {} {queries} queries", if labels < queries { "at least" } else { "only" })]
    LabelCount {
        /// How many labels there are.
        labels: u64,
        /// How many queries were read.
        queries: u64,
    },
    /// A folder has no file of queries.
    #[error("no file of queries in this folder (.csv, .jsonl, .ndjson, .json)")]
    NoFile,
    /// A column does not hold an integer.
    #[error("{column} is {}, not an integer", quoted(.text))]
    NotInteger {
        /// The name of the column.
        column: &'static str,
        /// What it holds.
        text: String,
    },
    /// A column holds more characters than any coordinate needs.
    #[error("{0} is longer than {LONGEST_INTEGER} characters")]
    IntegerTooLong(&'static str),
    /// A denominator is 0.
    #[error("{0} is 0")]
    ZeroDenominator(&'static str),
    /// A coordinate is not exactly an `f64`.
    #[error("{axis} is not an f64: {reason}")]
    NotF64 {
        /// Which coordinate.
        axis: char,
        /// Why it is none.
        reason: NotF64,
    },
    /// A label is neither 0 nor 1.
    #[error("label is {}, neither 0 nor 1", quoted(.0))]
    Label(String),
    /// A row has another label than the first of its query.
    #[error("label is {}, but {} on line {first}, where the query starts", u8::from(*.label), u8::from(!*.label))]
    LabelDisagrees {
        /// The label of this row.
        label: bool,
        /// The line of the query's first row.
        first: u64,
    },
    /// The file ends before the last row of a query.
    #[error("ends after {rows} of the 8 rows of query {index}")]
    Truncated {
        /// How many rows of the query there are.
        rows: usize,
        /// Which query, from 0.
        index: u64,
    },
    /// The file has no query of this name.
    #[error("none of its {count} queries is {}", quoted(.id))]
    NotFound {
        /// The identifier within the file.
        id: String,
        /// How many queries the file has.
        count: u64,
    },
    /// The text is not of the form of an identifier.
    #[error(
        "not a query: that is PATH.csv#INDEX, PATH.jsonl#ID, PATH.json#ID, FAMILY:SEED:INDEX, \
         figure:NAME, or - for the standard input"
    )]
    Identifier,
    /// The text has the form of a figure, but names none.
    #[error("no such figure; there are 4.1 to 4.{}", FIGURES.len())]
    Figure,
    /// The text has the form of a generated query, but names none.
    #[error(transparent)]
    Generated(IdError),
}

impl CorpusError {
    /// What is wrong with a corpus as a whole.
    pub fn new(path: &str, problem: Problem) -> Self {
        CorpusError {
            path: path.to_owned(),
            line: None,
            problem,
        }
    }

    /// What is wrong on a line, counted from 1.
    pub fn at(path: &str, line: u64, problem: Problem) -> Self {
        CorpusError {
            line: Some(line),
            ..CorpusError::new(path, problem)
        }
    }
}

impl fmt::Display for CorpusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.path.as_str() {
            "-" => f.write_str("<stdin>")?,
            path => f.write_str(&one_line(path))?,
        }
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}", one_line(&self.problem.to_string()))
    }
}

impl std::error::Error for CorpusError {}

/// `text` with its control characters escaped, so that it stays on one line.
fn one_line(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            c if c.is_control() => c.escape_default().to_string(),
            c => c.to_string(),
        })
        .collect()
}

/// `text` in quotes, cut where it is too long for a message.
fn quoted(text: &str) -> String {
    format!("{:?}", shortened(text, 40))
}

/// `text`, or as many of its first characters as a message has room for.
pub(super) fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

fn prefix(place: &str) -> String {
    if place.is_empty() {
        String::new()
    } else {
        format!("{place}: ")
    }
}

fn describe(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::IsADirectory => "is a directory, not a file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}
