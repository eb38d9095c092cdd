//! How a program is asked and answers.

use std::io::{self, BufRead};

use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{Query, Radius};
use tunnelproof::rigid::RigidQuery;

use crate::boxes::BoxCast;
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

/// A query that a program is asked.
pub(super) trait AskedQuery {
    /// Appends it with a number, in a [form that it has](Self::has_form).
    fn write(&self, wire: Wire, id: u64, bytes: &mut Vec<u8>);

    /// Whether it can be written in this form.
    fn has_form(wire: Wire) -> bool;

    /// That a subject does not take it.
    fn refusal(&self) -> NoAnswer;
}

impl AskedQuery for Query {
    fn write(&self, wire: Wire, id: u64, bytes: &mut Vec<u8>) {
        match wire {
            Wire::Lines => lines::write(id, self, bytes),
            Wire::Binary => frames::write(id, self, bytes),
        }
    }

    fn has_form(_wire: Wire) -> bool {
        true
    }

    fn refusal(&self) -> NoAnswer {
        refusal(Unsupported::Kind(self.kind()), self.radius()).into()
    }
}

impl AskedQuery for RigidQuery {
    fn write(&self, wire: Wire, id: u64, bytes: &mut Vec<u8>) {
        match wire {
            Wire::Lines => lines::write_rigid(id, self, bytes),
            Wire::Binary => frames::write_rigid(id, self, bytes),
        }
    }

    fn has_form(_wire: Wire) -> bool {
        true
    }

    fn refusal(&self) -> NoAnswer {
        refusal(Unsupported::Turning(self.kind()), self.radius()).into()
    }
}

impl AskedQuery for BoxCast {
    fn write(&self, _wire: Wire, id: u64, bytes: &mut Vec<u8>) {
        bytes.extend(frames::of_cast(id, self));
    }

    fn has_form(wire: Wire) -> bool {
        wire == Wire::Binary
    }

    fn refusal(&self) -> NoAnswer {
        Lapse::new(LapseKind::Refused, "does not take such casts of boxes").into()
    }
}

fn refusal(kind: Unsupported, radius: Radius) -> Unsupported {
    match radius.is_zero() {
        true => kind,
        false => Unsupported::Radius(radius),
    }
}

impl Reply {
    /// The reply to this query as a subject gives it.
    pub(super) fn to(self, query: &impl AskedQuery) -> Result<Answer, NoAnswer> {
        match self {
            Reply::Said(said) => Ok(Answer::Said(said)),
            Reply::Unsupported => Err(query.refusal()),
        }
    }
}
