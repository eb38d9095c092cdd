//! How a program is asked and answers.

use std::io::{self, BufRead};

use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;

use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Said};

use super::{frames, lines};

/// The form of queries and answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Wire {
    /// A line of JSON each; see [`lines`](mod@lines).
    #[default]
    Lines,
    /// A frame of bytes each; see [`frames`].
    Binary,
}

/// What a program writes for one query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Message {
    /// The number of the query, if it is stated.
    pub(super) id: Option<u64>,
    pub(super) reply: Reply,
}

/// What a program says of one query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reply {
    Said(Said),
    /// That it does not take such queries.
    Unsupported,
}

impl Wire {
    /// Every form.
    pub const ALL: [Wire; 2] = [Wire::Lines, Wire::Binary];

    /// The name used on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Wire::Lines => "lines",
            Wire::Binary => "binary",
        }
    }

    /// The form with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        Wire::ALL.into_iter().find(|wire| wire.name() == name)
    }

    /// Appends a query with a number.
    pub(super) fn write(self, id: u64, query: &Query, bytes: &mut Vec<u8>) {
        match self {
            Wire::Lines => lines::write(id, query, bytes),
            Wire::Binary => frames::write(id, query, bytes),
        }
    }

    /// The bytes of the next message; `None` at the end. A message that is longer than any answer
    /// has to be is cut.
    pub(super) fn read(self, reader: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
        match self {
            Wire::Lines => lines::read(reader),
            Wire::Binary => frames::read(reader),
        }
    }

    /// What these bytes say.
    pub(super) fn parse(self, bytes: &[u8]) -> Result<Message, Lapse> {
        let message = match self {
            Wire::Lines => lines::parse(bytes),
            Wire::Binary => frames::parse(bytes),
        };
        message.map_err(|detail| Lapse::new(LapseKind::Unreadable, detail))
    }
}

impl Reply {
    /// The reply to this query as a subject gives it.
    pub(super) fn to(self, query: &Query) -> Result<Answer, NoAnswer> {
        match self {
            Reply::Said(said) => Ok(Answer::Said(said)),
            Reply::Unsupported if query.radius().is_zero() => {
                Err(Unsupported::Kind(query.kind()).into())
            }
            Reply::Unsupported => Err(Unsupported::Radius(query.radius()).into()),
        }
    }
}
