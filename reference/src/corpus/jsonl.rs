//! Queries as lines of JSON, one query a line.
//!
//! ```json
//! {"id": "a", "kind": "edge-edge", "points": [[0, 0, 0], ...], "radius": 0, "label": 1}
//! ```
//!
//! - `points`: the eight points A, B, C, D at `t = 0`, then A, B, C, D at `t = 1`, in metres. A
//!   coordinate is a JSON number, which is read as the nearest `f64`, or a hexadecimal float in
//!   quotes (`"0x1.8p-3"`), which is read exactly.
//! - `id`: any text. Without one, a query is known by the number of its line.
//! - `kind`: `edge-edge` or `vertex-face`; may be left out where the caller gives the kind.
//! - `radius`: in metres, a number, or two in brackets whose exact sum it is; 0 if left out.
//! - `label`: whether it is known to be a hit, `0`, `1`, `false` or `true`; may be left out.
//!
//! - `note`: anything; not read.
//!
//! Other fields are refused: a misspelt `radius` would be a wrong answer. `null` stands for no `id`
//! and for no `label`, and is refused elsewhere.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error as _, IgnoredAny, Visitor};
use serde_json::{Value, json};
use serde_path_to_error::{Path, Segment};
use tunnelproof::query::{Point, Query, QueryKind, Radius};

use super::error::{CorpusError, Problem, shortened};
use super::lines::Line;
use super::{Entry, ReadOptions, hexfloat};

/// How [`write()`] writes numbers. Both are read back as the same `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// The shortest decimal whose nearest `f64` is the number.
    Decimal,
    /// Hexadecimal floats, in quotes.
    Hexadecimal,
}

/// A query as a line of JSON, without the line end.
pub fn write(entry: &Entry, numbers: Numbers) -> String {
    let number = |value| number(value, numbers);
    let query = &entry.query;
    let points: Vec<_> = (query.start().iter().chain(query.end()))
        .map(|point| [number(point.x), number(point.y), number(point.z)])
        .collect();
    let label = match entry.label {
        Some(label) => format!(r#","label":{label}"#),
        None => String::new(),
    };
    format!(
        r#"{{"id":{},"kind":"{}","points":{},"radius":{}{label}}}"#,
        json!(entry.id),
        query.kind(),
        json!(points),
        radius(query.radius(), numbers),
    )
}

/// A radius as JSON: the number, or the two whose sum it is.
pub fn radius(radius: Radius, numbers: Numbers) -> Value {
    match radius.parts() {
        [radius, 0.0] => number(radius, numbers),
        parts => json!(parts.map(|part| number(part, numbers))),
    }
}

pub(super) fn number(value: f64, numbers: Numbers) -> Value {
    match numbers {
        Numbers::Decimal => json!(value),
        Numbers::Hexadecimal => json!(hexfloat::format(value)),
    }
}

/// The queries of the given lines.
pub(super) fn entries<I: Iterator<Item = Result<Line, CorpusError>>>(
    lines: I,
    path: &str,
    options: ReadOptions,
) -> impl Iterator<Item = Result<Entry, CorpusError>> + use<I> {
    let path = path.to_owned();
    lines.map(move |line| {
        let line = line?;
        entry(&line, options).map_err(|problem| CorpusError::at(&path, line.number, problem))
    })
}

/// The query of one line.
pub(super) fn entry(line: &Line, options: ReadOptions) -> Result<Entry, Problem> {
    let record = Record::read(&line.text)?;
    let stated = match record.kind {
        Some(name) => Some(QueryKind::from_name(&name).ok_or(Problem::KindUnknown(name))?),
        None => None,
    };
    let kind = options.kind_of(stated)?;
    let mut points = [Point::origin(); 8];
    if record.points.len() != points.len() {
        return Err(Problem::PointCount(record.points.len()));
    }
    for (index, coordinates) in record.points.into_iter().enumerate() {
        points[index] = point(index, coordinates)?;
    }
    let [a, b, c, d, a1, b1, c1, d1] = points;
    let radius = match record.radius {
        Some(radii) => radii.sum()?,
        None => Radius::ZERO,
    };
    Ok(Entry {
        id: record.id.unwrap_or_else(|| line.number.to_string()),
        query: Query::new(
            kind,
            [a, b, c, d],
            [a1, b1, c1, d1],
            options.radius.unwrap_or(radius),
        )?,
        label: record.label.map(|Label(hit)| hit),
        line: Some(line.number),
    })
}

fn point(index: usize, coordinates: Vec<Number>) -> Result<Point, Problem> {
    let count = coordinates.len();
    let coordinates: [Number; 3] =
        coordinates
            .try_into()
            .map_err(|_| Problem::CoordinateCount {
                point: point_name(index),
                count,
            })?;
    let mut point = Point::origin();
    for (axis, number) in coordinates.into_iter().enumerate() {
        point[axis] = number.value(|| coordinate_name(index, axis))?;
    }
    Ok(point)
}

/// The line as JSON has it.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    id: Option<String>,
    #[serde(default, deserialize_with = "given")]
    kind: Option<String>,
    points: Vec<Vec<Number>>,
    #[serde(default, deserialize_with = "given")]
    radius: Option<Radii>,
    label: Option<Label>,
    #[serde(default, rename = "note")]
    _note: IgnoredAny,
}

/// A value that is not `null`.
pub(super) fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

impl Record {
    fn read(text: &str) -> Result<Self, Problem> {
        if !text.trim_start().starts_with('{') {
            return Err(Problem::NotObject);
        }
        let mut json = serde_json::Deserializer::from_str(text);
        let record = serde_path_to_error::deserialize(&mut json).map_err(|error| {
            match is_of_turning(error.path()) {
                true => Problem::Turning,
                false => problem(place(error.path()), error.inner()),
            }
        })?;
        json.end().map_err(|error| problem(String::new(), &error))?;
        Ok(record)
    }
}

/// Whether a field is one of a query of bodies that turn, which no other query has.
fn is_of_turning(path: &Path) -> bool {
    let first = path.iter().next();
    matches!(first, Some(Segment::Map { key }) if key == "local" || key == "poses")
}

pub(super) fn problem(place: String, error: &serde_json::Error) -> Problem {
    let column = error.column();
    let message = error.to_string();
    let message = match message.rsplit_once(" at line ") {
        Some((message, _)) => message,
        None => &message,
    };
    Problem::Json {
        place,
        message: shortened(message, 120),
        column,
    }
}

/// The value at this path, in the words of [`tunnelproof::query::QueryError`].
fn place(path: &Path) -> String {
    let is_known = |segment: &&Segment| !matches!(segment, Segment::Unknown);
    let segments: Vec<_> = path.iter().filter(is_known).collect();
    match segments[..] {
        [Segment::Map { key }, Segment::Seq { index }] if key == "points" && *index < 8 => {
            point_name(*index)
        }
        [
            Segment::Map { key },
            Segment::Seq { index },
            Segment::Seq { index: axis },
        ] if key == "points" && *index < 8 && *axis < 3 => coordinate_name(*index, *axis),
        [] => String::new(),
        _ => shortened(&path.to_string(), 60),
    }
}

fn point_name(index: usize) -> String {
    let name = ['A', 'B', 'C', 'D'][index % 4];
    format!("point {name} at t = {}", index / 4)
}

fn coordinate_name(index: usize, axis: usize) -> String {
    format!("{} of {}", ['x', 'y', 'z'][axis], point_name(index))
}

/// A JSON number or a text that stands for one.
pub(super) enum Number {
    Decimal(f64),
    Text(String),
}

impl Number {
    pub(super) fn value(self, place: impl Fn() -> String) -> Result<f64, Problem> {
        match self {
            Number::Decimal(value) => Ok(value),
            Number::Text(text) => hexfloat::parse(&text).map_err(|reason| Problem::HexFloat {
                place: place(),
                text,
                reason,
            }),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl Visitor<'_> for Reader {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a hexadecimal float in quotes")
            }

            fn visit_u64<E>(self, value: u64) -> Result<Number, E> {
                Ok(Number::Decimal(value as f64))
            }

            fn visit_i64<E>(self, value: i64) -> Result<Number, E> {
                Ok(Number::Decimal(value as f64))
            }

            fn visit_f64<E>(self, value: f64) -> Result<Number, E> {
                Ok(Number::Decimal(value))
            }

            fn visit_str<E>(self, text: &str) -> Result<Number, E> {
                Ok(Number::Text(text.to_owned()))
            }
        }

        deserializer.deserialize_any(Reader)
    }
}

/// A number, or two whose sum is meant.
#[derive(serde::Deserialize)]
#[serde(
    untagged,
    expecting = "neither a number nor two numbers in brackets (hexadecimal floats in quotes)"
)]
pub(super) enum Radii {
    One(Number),
    Two([Number; 2]),
}

impl Radii {
    pub(super) fn sum(self) -> Result<Radius, Problem> {
        let place = || "radius".to_owned();
        Ok(match self {
            Radii::One(radius) => radius.value(place)?.into(),
            Radii::Two([first, second]) => [first.value(place)?, second.value(place)?].into(),
        })
    }
}

/// Whether a query is known to be a hit.
pub(super) struct Label(pub(super) bool);

impl<'de> Deserialize<'de> for Label {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::Bool(hit) => Ok(Label(hit)),
            value if value == json!(0) => Ok(Label(false)),
            value if value == json!(1) => Ok(Label(true)),
            value => Err(D::Error::custom(format_args!(
                "{} is none of 0, 1, false and true",
                shortened(&value.to_string(), 40)
            ))),
        }
    }
}
