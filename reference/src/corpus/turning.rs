//! Queries of bodies that turn, as lines of JSON, one query a line.
//!
//! ```json
//! {"id": "a", "kind": "edge-turning-edge", "points": [[0, 0, 0], ...], "local": [[0, 0, 0], ...],
//!  "poses": [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0.5]], "radius": 0}
//! ```
//!
//! - `kind`: `edge-turning-edge` or `vertex-turning-face`; of two bodies `turning-edge-turning-edge`
//!   or `turning-vertex-turning-face`.
//! - `points`: the points in space, at `t = 0` and then at `t = 1`: A, B, A, B, or A, A. Two bodies
//!   have none.
//! - `local`: the points in the body's frame: C, D, or B, C, D. Of two bodies A, B, C, D, those of
//!   the first side in the frame of the first body.
//! - `poses`: of the body at `t = 0` and at `t = 1`, seven numbers each: x, y, z of the centre and
//!   w, x, y, z of the quaternion. Of two bodies four, the first body's before the second one's.
//! - `id`, `radius`, `label` and `note`, and numbers: as in [`jsonl`].

use std::fs::File;
use std::io::{self, BufRead, BufReader};

use nalgebra::Quaternion;
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::json;
use serde_path_to_error::Segment;
use tunnelproof::query::{Point, Radius};
use tunnelproof::rigid::{Pose, RigidQuery, RigidQueryKind, Side};

use super::error::{CorpusError, Problem, shortened};
use super::jsonl::{self, Label, Number, Numbers, Radii, given, number};
use super::lines::{Line, Lines};
use super::packed::Packing;
use super::until_error;
use crate::generate::{GeneratedId, RigidId};

/// A query of a body that turns, of a corpus.
#[derive(Clone, Debug, PartialEq)]
pub struct TurningEntry {
    /// What the query is known by.
    pub id: String,
    /// The query.
    pub query: RigidQuery,
    /// Whether it is known to be a hit; `None` if the corpus does not say.
    pub label: Option<bool>,
}

/// The numbers of a query, in the order of the fields.
pub struct Fields {
    /// The points in space at both ends of the step; none if both sides turn.
    pub points: Vec<[f64; 3]>,
    /// The points in the frame of the body, or of the first body and then of the second one.
    pub local: Vec<[f64; 3]>,
    /// The poses of the body, or of the first body and then of the second one.
    pub poses: Vec<[f64; 7]>,
}

impl Fields {
    /// The numbers of a query.
    pub fn of(query: &RigidQuery) -> Self {
        let mut fields = Fields {
            points: Vec::new(),
            local: Vec::new(),
            poses: Vec::new(),
        };
        let plain = |point: &Point| [point.x, point.y, point.z];
        for side in query.sides() {
            match side {
                Side::Straight { start, end } => {
                    fields.points.extend(start.iter().chain(end).map(plain));
                }
                Side::Turning { local, motion } => {
                    fields.local.extend(local.iter().map(plain));
                    fields
                        .poses
                        .extend([motion.start(), motion.end()].map(numbers));
                }
            }
        }
        fields
    }

    /// The query of this kind with these numbers.
    ///
    /// # Errors
    ///
    /// [`Problem`] says what is wrong with them.
    pub fn query(&self, kind: RigidQueryKind, radius: Radius) -> Result<RigidQuery, Problem> {
        let lengths = kind.lengths();
        for (place, count, expected) in [
            ("points", self.points.len(), lengths.points),
            ("local", self.local.len(), lengths.local),
            ("poses", self.poses.len(), lengths.poses),
        ] {
            if count != expected {
                return Err(Problem::Length {
                    place: place.to_owned(),
                    count,
                    expected,
                });
            }
        }
        let points = |rows: &[[f64; 3]]| rows.iter().copied().map(Point::from).collect::<Vec<_>>();
        let poses: Vec<Pose> = self.poses.iter().copied().map(pose).collect();
        let query = RigidQuery::from_lists(
            kind,
            &points(&self.points),
            &points(&self.local),
            &poses,
            radius,
        );
        Ok(query?)
    }
}

fn numbers(
    Pose {
        centre,
        quaternion: q,
    }: &Pose,
) -> [f64; 7] {
    [centre.x, centre.y, centre.z, q.w, q.i, q.j, q.k]
}

/// A query as a line of JSON, without the line end.
pub fn write(entry: &TurningEntry, numbers: Numbers) -> String {
    let Fields {
        points,
        local,
        poses,
    } = Fields::of(&entry.query);
    let of_points = |points: Vec<[f64; 3]>| -> Vec<_> {
        let point = |p: [f64; 3]| p.map(|x| number(x, numbers));
        points.into_iter().map(point).collect()
    };
    let label = match entry.label {
        Some(label) => format!(r#","label":{label}"#),
        None => String::new(),
    };
    let points = match points.is_empty() {
        true => String::new(),
        false => format!(r#""points":{},"#, json!(of_points(points))),
    };
    let poses = poses
        .into_iter()
        .map(|pose| pose.map(|x| number(x, numbers)));
    format!(
        r#"{{"id":{},"kind":"{}",{points}"local":{},"poses":{},"radius":{}{label}}}"#,
        json!(entry.id),
        entry.query.kind(),
        json!(of_points(local)),
        json!(poses.collect::<Vec<_>>()),
        jsonl::radius(entry.query.radius(), numbers),
    )
}

/// Opens a corpus: the file at `path`, packed or not, or the standard input for `-`.
///
/// # Errors
///
/// [`CorpusError`] if there is no such file.
pub fn open(
    path: &str,
) -> Result<Box<dyn Iterator<Item = Result<TurningEntry, CorpusError>> + Send>, CorpusError> {
    if path == "-" {
        return Ok(Box::new(read(BufReader::new(io::stdin()), path)));
    }
    let refuse = |error| CorpusError::new(path, Problem::Io(error));
    let file = File::open(path).map_err(refuse)?;
    let file = Packing::of_path(path).0.unpack(file).map_err(refuse)?;
    Ok(Box::new(read(file, path)))
}

/// The query that an identifier names: `FAMILY:SEED:INDEX`, `PATH#ID` or, for the first on the
/// standard input, `-`.
///
/// # Errors
///
/// [`CorpusError`] if there is no such query.
pub fn locate(text: &str) -> Result<TurningEntry, CorpusError> {
    let refuse = |problem| CorpusError::new(text, problem);
    if let Some(id) = RigidId::parse(text) {
        return Ok(TurningEntry {
            id: text.to_owned(),
            query: id
                .map_err(|error| refuse(Problem::Generated(error)))?
                .query(),
            label: None,
        });
    }
    if text.parse::<GeneratedId>().is_ok() {
        return Err(refuse(Problem::NotTurning));
    }
    let (path, id) = match text.rsplit_once('#') {
        Some((path, id)) => (path, Some(id)),
        None if text == "-" => (text, None),
        None => return Err(refuse(Problem::NotNamed)),
    };
    let mut count = 0;
    for entry in open(path)? {
        let entry = entry?;
        if id.is_none_or(|id| entry.id == id) {
            return Ok(entry);
        }
        count += 1;
    }
    let id = id.unwrap_or_default().to_owned();
    Err(refuse(Problem::NotFound { id, count }))
}

/// Reads a corpus that is called `path`.
pub fn read<R: BufRead + Send + 'static>(
    reader: R,
    path: &str,
) -> impl Iterator<Item = Result<TurningEntry, CorpusError>> + use<R> {
    let name = path.to_owned();
    let entries = Lines::new(reader, path).map(move |line| {
        let line = line?;
        entry(&line).map_err(|problem| CorpusError::at(&name, line.number, problem))
    });
    until_error(entries)
}

/// The query of one text.
///
/// # Errors
///
/// [`Problem`] says what is wrong with it.
pub fn parse(text: &str) -> Result<TurningEntry, Problem> {
    entry(&Line {
        number: 1,
        text: text.to_owned(),
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    id: Option<String>,
    kind: String,
    #[serde(default)]
    points: Vec<Vec<Number>>,
    #[serde(default)]
    local: Option<Vec<Vec<Number>>>,
    #[serde(default)]
    poses: Option<Vec<Vec<Number>>>,
    #[serde(default, deserialize_with = "given")]
    radius: Option<Radii>,
    label: Option<Label>,
    #[serde(default, rename = "note")]
    _note: IgnoredAny,
}

fn entry(line: &Line) -> Result<TurningEntry, Problem> {
    if !line.text.trim_start().starts_with('{') {
        return Err(Problem::NotObject);
    }
    let mut json = serde_json::Deserializer::from_str(&line.text);
    let record: Record = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let is_known = |segment: &Segment| !matches!(segment, Segment::Unknown);
        let place = match error.path().iter().any(is_known) {
            true => shortened(&error.path().to_string(), 60),
            false => String::new(),
        };
        jsonl::problem(place, error.inner())
    })?;
    let end = json.end();
    end.map_err(|error| jsonl::problem(String::new(), &error))?;
    if record.local.is_none() && record.poses.is_none() && record.points.len() == 8 {
        return Err(Problem::NotTurning);
    }
    let fields = Fields {
        points: rows("points", record.points)?,
        local: rows("local", record.local.unwrap_or_default())?,
        poses: rows("poses", record.poses.unwrap_or_default())?,
    };
    let radius = match record.radius {
        Some(radii) => radii.sum()?,
        None => Radius::ZERO,
    };
    let kind = RigidQueryKind::from_name(&record.kind)
        .ok_or_else(|| Problem::TurningKindUnknown(record.kind.clone()))?;
    let query = fields.query(kind, radius)?;
    Ok(TurningEntry {
        id: record.id.unwrap_or_else(|| line.number.to_string()),
        query,
        label: record.label.map(|Label(hit)| hit),
    })
}

/// Rows of this many numbers.
fn rows<const N: usize>(
    field: &'static str,
    rows: Vec<Vec<Number>>,
) -> Result<Vec<[f64; N]>, Problem> {
    let row = |(index, row): (usize, Vec<Number>)| {
        let place = |column: usize| format!("{field}[{index}][{column}]");
        let numbers = row.into_iter().enumerate();
        let numbers: Result<Vec<f64>, _> = numbers
            .map(|(column, number)| number.value(|| place(column)))
            .collect();
        array(|| format!("{field}[{index}]"), numbers?)
    };
    rows.into_iter().enumerate().map(row).collect()
}

fn array<T, const N: usize>(place: impl Fn() -> String, items: Vec<T>) -> Result<[T; N], Problem> {
    let count = items.len();
    items.try_into().map_err(|_| Problem::Length {
        place: place(),
        count,
        expected: N,
    })
}

fn pose([x, y, z, w, i, j, k]: [f64; 7]) -> Pose {
    Pose::new(Point::new(x, y, z), Quaternion::new(w, i, j, k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::RIGID_FAMILIES;

    #[test]
    fn turning_lines_are_read_back_bit_for_bit() {
        for family in RIGID_FAMILIES {
            for index in 0..50 {
                let entry = TurningEntry {
                    id: format!("{}:1:{index}", family.name()),
                    query: family.query(1, index),
                    label: Some(index % 2 == 0),
                };
                for numbers in [Numbers::Decimal, Numbers::Hexadecimal] {
                    assert_eq!(parse(&write(&entry, numbers)).unwrap(), entry);
                }
            }
        }
    }

    #[test]
    fn turning_lines_that_are_wrong_say_where() {
        let good = r#"{"kind":"vertex-turning-face","points":[[0,0,0],[0,0,1]],"local":[[0,0,0],[1,0,0],[0,1,0]],"poses":[[0,0,0,1,0,0,0],[0,0,0,1,0,0,0.5]]}"#;
        assert!(parse(good).is_ok());
        for (from, to, message) in [
            (
                "vertex-turning-face",
                "edge-edge",
                "kind is \"edge-edge\", not edge-turning-edge, vertex-turning-face,",
            ),
            ("[0,0,1]]", "[0,0]]", "points[1] has 2 items, not 3"),
            (",[0,1,0]]", "]", "local has 2 items, not 3"),
            (
                "1,0,0,0.5",
                "0,0,0,0",
                "the quaternion at t = 1 is 0; it needs a length",
            ),
            ("[1,0,0]", "[1,0,\"z\"]", "local[1][2]"),
            (
                "\"points\"",
                "\"radius\":-1,\"points\"",
                "the radius is -1; it has to be finite, and 0 or more",
            ),
            ("\"points\"", "\"radios\":1,\"points\"", "unknown field"),
        ] {
            let error = parse(&good.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
