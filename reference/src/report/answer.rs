//! An answer as a line of JSON.
//!
//! | field | meaning |
//! | --- | --- |
//! | `id` | the query |
//! | `hit` | whether there is contact; a miss has, besides, only `case` |
//! | `toi` | time of impact |
//! | `kind_of_contact` | `crossing` or `graze` at `toi`; exact subjects and the certified path only |
//! | `crosses` | whether any contact of the step is a crossing; exact subjects only |
//! | `side` | sign of `f` just before `toi`; exact subjects and the certified path only |
//! | `case` | the case of the motion; left out by subjects without cases |
//! | `temporarily_parallel`, `temporarily_point` | the configuration at `toi` |
//! | `features` | what touches: a vertex or an edge of each edge, or the vertex and a corner, an edge or all of the face, by their points; exact subjects only |
//! | `u`, `v` | edge parameters of the contact, or the weights of C and D on the face |
//! | `overlap` | `u` and `v` of the other end, if the edges overlap, or are nearest, in more than a point |
//! | `points` | in metres, of the contact (and the overlap's other end); engines only |
//! | `normal` | unit vector from the first side to the second, if the engine gives one |
//! | `relative_velocity` | direction in which the second side moves relative to the first there; engines only |
//!
//! A number that an exact subject may not be able to write as an `f64` (`toi`, `u`, `v`) is
//! `{"below": B, "above": A}`: the largest `f64` not above it and the smallest not below it, equal
//! where it is an `f64`. The certified path gives `toi` like that, and `u` and `v` with its stated
//! error on both sides. An engine's own `f64` stands in both.

use serde::Serialize;
use tunnelproof::contact::{
    self, Case, Contact, ContactPoint, EdgePlace, EdgePoint, FacePlace, Flags, Hit, Verdict,
};
use tunnelproof::narrow::Report;
use tunnelproof::query::QueryKind;

use crate::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use crate::subject::{Answer, Said};

/// The answer to the query of this kind called `id`, without the line end.
///
/// A number that is NaN or infinite, which only a broken engine gives, is written as `null`.
pub fn line(id: &str, kind: QueryKind, answer: &Answer) -> String {
    let line = Line {
        id,
        answer: Fields::new(kind, answer),
    };
    serde_json::to_string(&line).expect("fields of text and numbers are JSON")
}

/// The answer to a query of a body that turns, of which no engine is asked.
pub fn turning_line(id: &str, answer: &Answer) -> String {
    line(id, QueryKind::EdgeEdge, answer)
}

#[derive(Serialize)]
struct Line<'a> {
    id: &'a str,
    #[serde(flatten)]
    answer: Fields,
}

/// The fields of an answer but the identifier.
#[derive(Serialize)]
pub struct Fields {
    hit: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    toi: Option<Bounds>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kind_of_contact: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    crosses: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<i8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<&'static str>,
    #[serde(flatten)]
    flags: Option<FlagFields>,
    #[serde(skip_serializing_if = "Option::is_none")]
    features: Option<[String; 2]>,
    #[serde(flatten)]
    first: Option<Place>,
    #[serde(skip_serializing_if = "Option::is_none")]
    overlap: Option<Place>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    relative_velocity: Option<[f64; 3]>,
}

#[derive(Serialize)]
struct FlagFields {
    temporarily_parallel: bool,
    temporarily_point: bool,
}

#[derive(Serialize)]
struct Place {
    u: Bounds,
    v: Bounds,
}

#[derive(Serialize)]
struct Bounds {
    below: f64,
    above: f64,
}

impl Fields {
    /// The fields of this answer to a query of this kind.
    pub fn new(kind: QueryKind, answer: &Answer) -> Self {
        match answer {
            Answer::Exact(exact) => Self::exact(exact),
            Answer::Certified(hit) => Self::certified(hit.as_ref()),
            Answer::Engine(report) => Self::engine(kind, report),
            Answer::Said(said) => Self::said(said),
        }
    }

    /// The fields of an exact answer.
    pub fn exact(answer: &ExactAnswer) -> Self {
        let case = Some(answer.case.name());
        let Some(ExactHit {
            toi,
            kind,
            crosses,
            side,
            features,
            first,
            second,
            flags,
        }) = answer.hit
        else {
            return Fields {
                case,
                ..Self::miss()
            };
        };
        Fields {
            hit: true,
            toi: Some(toi.into()),
            kind_of_contact: Some(kind.name()),
            crosses: Some(crosses),
            side: Some(side),
            case,
            flags: Some(flags.into()),
            features: Some(features.map(|feature| feature.to_string())),
            first: Some(first.into()),
            overlap: second.map(Place::from),
            ..Self::miss()
        }
    }

    fn certified(hit: Option<&Hit<contact::Place>>) -> Self {
        let Some(hit) = hit else {
            return Self::miss();
        };
        let (first, overlap) = match hit.place {
            contact::Place::Edges(EdgePlace {
                first,
                second,
                error,
            }) => {
                let place = |EdgePoint { u, v }| Place::around([u, v], error);
                (place(first), second.map(place))
            }
            contact::Place::Face(FacePlace { weights, error }) => {
                let [_, c, d] = weights;
                (Place::around([c, d], error), None)
            }
        };
        Fields {
            hit: true,
            toi: Some(Bounds {
                below: hit.toi,
                above: hit.toi_above,
            }),
            kind_of_contact: Some(hit.kind.name()),
            side: Some(hit.side),
            case: Some(hit.case.name()),
            flags: Some(hit.flags.into()),
            first: Some(first),
            overlap,
            ..Self::miss()
        }
    }

    fn engine(kind: QueryKind, report: &Report) -> Self {
        let case = report.case.map(|case| case.name());
        let Verdict::Hit(Contact {
            toi,
            first,
            second,
            normal,
        }) = report.verdict
        else {
            return Fields {
                case,
                ..Self::miss()
            };
        };
        let points = std::iter::once(first).chain(second);
        Fields {
            hit: true,
            toi: Some(Enclosure::exactly(toi).into()),
            case,
            flags: Some(report.flags.into()),
            first: Some(Place::of_engine(kind, &first)),
            overlap: second.map(|second| Place::of_engine(kind, &second)),
            points: points.map(|at| at.point.into()).collect(),
            normal: normal.map(Into::into),
            relative_velocity: first.relative_velocity.map(Into::into),
            ..Self::miss()
        }
    }

    fn said(said: &Said) -> Self {
        Fields {
            hit: said.toi.is_some(),
            toi: said.toi.map(Bounds::from),
            case: said.case.map(Case::name),
            ..Self::miss()
        }
    }

    fn miss() -> Self {
        Fields {
            hit: false,
            toi: None,
            kind_of_contact: None,
            crosses: None,
            side: None,
            case: None,
            flags: None,
            features: None,
            first: None,
            overlap: None,
            points: Vec::new(),
            normal: None,
            relative_velocity: None,
        }
    }
}

impl Place {
    /// What an engine says of a contact of queries of this kind.
    fn of_engine(kind: QueryKind, at: &ContactPoint) -> Self {
        let [_, b, c, d] = at.weights;
        let [u, v] = match kind {
            QueryKind::EdgeEdge => [b, d],
            QueryKind::VertexFace => [c, d],
        };
        let exactly = |value| Enclosure::exactly(value).into();
        Place {
            u: exactly(u),
            v: exactly(v),
        }
    }

    /// Two numbers with an error.
    fn around(values: [f64; 2], error: f64) -> Self {
        let [u, v] = values.map(|value| Bounds {
            below: (value - error).max(0.0),
            above: (value + error).min(1.0),
        });
        Place { u, v }
    }
}

impl From<Enclosure> for Bounds {
    fn from(Enclosure { below, above }: Enclosure) -> Self {
        Bounds { below, above }
    }
}

impl From<Flags> for FlagFields {
    fn from(flags: Flags) -> Self {
        FlagFields {
            temporarily_parallel: flags.temporarily_parallel,
            temporarily_point: flags.temporarily_point,
        }
    }
}

impl From<Parameters> for Place {
    fn from(Parameters { u, v }: Parameters) -> Self {
        Place {
            u: u.into(),
            v: v.into(),
        }
    }
}
