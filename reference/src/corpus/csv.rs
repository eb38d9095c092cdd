//! Queries in the public CCD query format, eight rows a query.
//!
//! A row is a point: `x_num,x_den,y_num,y_den,z_num,z_den,label`, integers of any size. The rows
//! are A, B, C, D at `t = 0`, then A, B, C, D at `t = 1`. Every coordinate has to be exactly an
//! `f64`; the fraction need not be in lowest terms and its denominator may be negative. The label,
//! 1 for a hit and 0 for a miss, is the same on the eight rows. The format comes with "A Large
//! Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection" (Wang,
//! Ferguson, Schneider, Jiang, Attene, Panozzo, ACM TOG 2021). The newer benchmark has six columns:
//! its labels are in a file beside ([`super::folder`]).
//!
//! A file does not say which kind its queries are, but the sets name the kinds in their folders or
//! files; see [`kind_in_path`].

use std::path::{Component, Path};

use tunnelproof::query::{Point, Query, QueryKind, Radius};

use super::dyadic::{exact_f64, exact_quotient};
use super::error::{CorpusError, Problem};
use super::folder::Labels;
use super::lines::Line;
use super::{Entry, ReadOptions};
use crate::field::{self, Integer};

/// The longest integer that is read, in characters: that of a subnormal `f64` takes 1,100, a
/// fraction need not be in lowest terms, and the time that conversion takes grows with the square.
pub(super) const LONGEST_INTEGER: usize = 1 << 13;

const COLUMNS: [&str; 7] = [
    "x_num", "x_den", "y_num", "y_den", "z_num", "z_den", "label",
];

/// The kind that a path names, by a component that holds `edge-edge` or `vertex-face`, or by a file
/// name of digits and `ee` or `vf`, such as `227ee.csv`.
///
/// The component nearest to the file decides, the file's own name first. One that holds both names
/// says nothing.
pub fn kind_in_path(path: &str) -> Option<QueryKind> {
    Path::new(path).components().rev().find_map(|component| {
        let Component::Normal(name) = component else {
            return None;
        };
        let name = name.to_string_lossy();
        let holds = |kind: QueryKind| name.contains(kind.name());
        match (holds(QueryKind::EdgeEdge), holds(QueryKind::VertexFace)) {
            (true, false) => Some(QueryKind::EdgeEdge),
            (false, true) => Some(QueryKind::VertexFace),
            _ => kind_in_short(&name),
        }
    })
}

/// The kind that a file name of digits and two letters says.
fn kind_in_short(name: &str) -> Option<QueryKind> {
    let (name, _) = name.split_once('.')?;
    match name.trim_start_matches(|c: char| c.is_ascii_digit()) {
        rest if rest == name => None,
        "ee" => Some(QueryKind::EdgeEdge),
        "vf" => Some(QueryKind::VertexFace),
        _ => None,
    }
}

/// The queries of the given lines.
///
/// # Errors
///
/// [`Problem::KindMissing`] or [`Problem::KindContradiction`] if the kind is not known; a file of
/// labels beside it that is none.
pub(super) fn entries<I: Iterator<Item = Result<Line, CorpusError>>>(
    lines: I,
    path: &str,
    options: ReadOptions,
) -> Result<impl Iterator<Item = Result<Entry, CorpusError>> + use<I>, CorpusError> {
    let kind = options
        .kind_of(kind_in_path(path))
        .map_err(|problem| CorpusError::new(path, problem))?;
    Ok(Entries {
        lines,
        path: path.to_owned(),
        kind,
        radius: options.radius.unwrap_or_default(),
        labels: Labels::beside(path)?,
        index: 0,
    })
}

struct Entries<I> {
    lines: I,
    path: String,
    kind: QueryKind,
    radius: Radius,
    /// Those of queries that state none.
    labels: Option<Labels>,
    index: u64,
}

impl<I: Iterator<Item = Result<Line, CorpusError>>> Iterator for Entries<I> {
    type Item = Result<Entry, CorpusError>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.lines.next() {
            Some(first) => Some(first.and_then(|first| self.entry(&first))),
            None => self.finish().err().map(Err),
        }
    }
}

impl<I: Iterator<Item = Result<Line, CorpusError>>> Entries<I> {
    /// Sees, once, that there is no label left.
    fn finish(&mut self) -> Result<(), CorpusError> {
        let labels = self.labels.take();
        labels.map_or(Ok(()), |labels| labels.finish(self.index))
    }

    /// The label of the query that is being read, if it states none itself.
    fn label_beside(&self) -> Result<Option<bool>, CorpusError> {
        let labels = self.labels.as_ref();
        labels.map(|labels| labels.get(self.index)).transpose()
    }

    /// The query whose first row is given; the others are read.
    fn entry(&mut self, first: &Line) -> Result<Entry, CorpusError> {
        let (point, label) = self.row(first)?;
        let mut points = [point; 8];
        let mut last = first.number;
        for (rows, point) in points.iter_mut().enumerate().skip(1) {
            let index = self.index;
            let Some(line) = self.lines.next() else {
                let problem = Problem::Truncated { rows, index };
                return Err(CorpusError::at(&self.path, last, problem));
            };
            let line = line?;
            last = line.number;
            let (position, own) = self.row(&line)?;
            if let Some(problem) = differs(label, own, first.number) {
                return Err(CorpusError::at(&self.path, last, problem));
            }
            *point = position;
        }
        let [a, b, c, d, a1, b1, c1, d1] = points;
        let query = Query::new(self.kind, [a, b, c, d], [a1, b1, c1, d1], self.radius)
            .map_err(|error| CorpusError::at(&self.path, first.number, error.into()))?;
        let label = match label {
            Some(label) => Some(label),
            None => self.label_beside()?,
        };
        let id = format!("{}#{}", self.path, self.index);
        self.index += 1;
        Ok(Entry {
            id,
            query,
            label,
            line: Some(first.number),
        })
    }

    fn row(&self, line: &Line) -> Result<(Point, Option<bool>), CorpusError> {
        row(&line.text).map_err(|problem| CorpusError::at(&self.path, line.number, problem))
    }
}

/// What is wrong with the label of a row of a query whose first row, on this line, has another.
fn differs(first: Option<bool>, own: Option<bool>, line: u64) -> Option<Problem> {
    match (first, own) {
        (Some(first), Some(label)) if first != label => {
            Some(Problem::LabelDisagrees { label, first: line })
        }
        (Some(_), None) => Some(Problem::ColumnCount(COLUMNS.len() - 1)),
        (None, Some(_)) => Some(Problem::ColumnCount(COLUMNS.len())),
        _ => None,
    }
}

/// A point, and the label if there is a column for it.
fn row(text: &str) -> Result<(Point, Option<bool>), Problem> {
    let mut cells = [""; COLUMNS.len()];
    let mut count = 0;
    for cell in text.split(',') {
        if let Some(place) = cells.get_mut(count) {
            *place = cell.trim();
        }
        count += 1;
    }
    let has_label = match count.checked_sub(COLUMNS.len() - 1) {
        Some(more @ 0..=1) => more == 1,
        _ => return Err(Problem::ColumnCount(count)),
    };
    let mut point = Point::origin();
    for axis in 0..3 {
        point[axis] = coordinate(axis, cells[2 * axis], cells[2 * axis + 1])?;
    }
    match cells[6] {
        _ if !has_label => Ok((point, None)),
        "0" => Ok((point, Some(false))),
        "1" => Ok((point, Some(true))),
        label => Err(Problem::Label(label.to_owned())),
    }
}

/// The `f64` that is exactly `numerator / denominator`.
fn coordinate(axis: usize, numerator: &str, denominator: &str) -> Result<f64, Problem> {
    // Without integers on the heap where the denominator is a power of two, as it mostly is.
    if let (Ok(n), Ok(d)) = (numerator.parse::<i64>(), denominator.parse::<u64>())
        && d.is_power_of_two()
        && let Ok(value) = exact_f64(n < 0, n.unsigned_abs(), -i64::from(d.trailing_zeros()))
    {
        return Ok(value);
    }
    let integer = |column: usize, text: &str| {
        if text.len() > LONGEST_INTEGER {
            return Err(Problem::IntegerTooLong(COLUMNS[column]));
        }
        field::Default::from_decimal(text).ok_or_else(|| Problem::NotInteger {
            column: COLUMNS[column],
            text: text.to_owned(),
        })
    };
    let numerator = integer(2 * axis, numerator)?;
    let denominator = integer(2 * axis + 1, denominator)?;
    if denominator.is_zero() {
        return Err(Problem::ZeroDenominator(COLUMNS[2 * axis + 1]));
    }
    exact_quotient(&numerator, &denominator).map_err(|reason| Problem::NotF64 {
        axis: ['x', 'y', 'z'][axis],
        reason,
    })
}
