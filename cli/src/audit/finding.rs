//! What an audit finds.

use std::fmt;

use nalgebra::center;
use serde::{Serialize, Serializer};
use tunnelproof::query::{Point, Query};
use tunnelproof::wire::SegmentId;

use tunnelproof_reference::certify::caller::Caller;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::corpus::jsonl::Numbers;

/// Something that is not as it has to be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The step, from 0.
    pub step: u64,
    /// What is wrong.
    #[serde(flatten)]
    pub what: What,
    /// The segments, numbered as before the motion; of a change of resolution, numbered as before the
    /// change, the first that it takes out or divides, and the one that is met.
    #[serde(serialize_with = "as_text")]
    pub segments: Vec<SegmentId>,
    /// The bodies of a contact that was reported, with these segments or with each other.
    pub of_bodies: Vec<usize>,
    /// The witness, as a line that `explain` reads: of a body, the part of its way that decides.
    #[serde(serialize_with = "as_line")]
    pub query: Option<AnyQuery>,
}

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum What {
    /// Midlines meet in the motion that was made, and it was not reported.
    Missed {
        /// Who missed it.
        by: Culprit,
        /// Whether they pass through each other inside both segments. A contact at a node may be a passage too.
        crossing: bool,
    },
    /// The time of impact that was reported is after the exact one: by how much, as a part of the step.
    Late {
        /// How much.
        by: f64,
    },
    /// The time of impact that was reported is before the exact one, rounded down.
    Early {
        /// How much.
        by: f64,
    },
    /// Midlines were reported to meet, and do not.
    False,
    /// A change of resolution passes through another segment.
    Remesh,
    /// Segments come as near as the share of their thickness that is guarded, or nearer than they
    /// were.
    Nearer {
        /// Who missed it.
        by: Culprit,
        /// Whether they were closer than that share where the motion started.
        were_near: bool,
    },
    /// A change of resolution does.
    RemeshNearer {
        /// Whether they were closer than that share before the change.
        were_near: bool,
    },
    /// A wire does not start where the step before left it.
    Jump {
        /// The wire.
        wire: usize,
    },
    /// A wire does not start with the radius, the arc lengths or the kinds of nodes with which the
    /// step before left it.
    Altered {
        /// The wire.
        wire: usize,
        /// What differs.
        field: Field,
        /// The first node that differs.
        at: Option<usize>,
    },
    /// A node is not where what it is fixed to has it, by more than is rounded.
    Astray {
        /// The wire.
        wire: usize,
        /// The node.
        node: usize,
        /// The body that it is fixed to; none if it is pinned, and moved.
        body: Option<usize>,
        /// Whether it is so where the step ends. Otherwise where it starts.
        at_end: bool,
    },
    /// Numbers that are no motion: not finite, not in order, too few or too many.
    Unsound {
        /// The wire.
        wire: usize,
        /// Which numbers.
        field: Field,
        /// The first that is not, in its list.
        at: Option<usize>,
    },
    /// A step that does not follow the one before, or has a number that is none of a step.
    StepUnsound {
        /// Which.
        field: StepField,
    },
    /// A midline comes to touch the core of a body, and it was not reported.
    BodyMissed {
        /// The body.
        body: usize,
        /// When, as a part of the step.
        toi: f64,
        /// Whether it passes through a face or an edge inside of both.
        crossing: bool,
    },
    /// A change of resolution passes through the core of a body.
    BodyRemesh {
        /// The body.
        body: usize,
        /// Where on the wire: arc length of the node that is taken out or put in, in m.
        arc: f64,
    },
    /// Two cores come to touch, and it was not reported.
    CoreMissed {
        /// The bodies.
        bodies: [usize; 2],
        /// When, as a part of the step.
        toi: f64,
        /// Whether parts of both pass through each other inside of both.
        crossing: bool,
    },
    /// A body does not start where the step before left it.
    BodyJump {
        /// The body.
        body: usize,
    },
    /// Poses that are no motion of a body, or not of length 1, or are not at the times of those of another one, or a body
    /// whose shape is not known.
    BodyUnsound {
        /// The body.
        body: usize,
    },
}

/// A list of numbers of a wire, as its record calls it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Field {
    /// The radius.
    Radius,
    /// Arc lengths of nodes.
    Arcs,
    /// What carries nodes.
    Kinds,
    /// Where nodes start.
    Before,
    /// Where nodes end.
    After,
    /// Tensions of segments.
    Tensions,
    /// Its torque.
    Torque,
    /// Its twist.
    Twist,
}

/// A number of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepField {
    /// Its number.
    Number,
    /// The time at its end.
    Time,
    /// The share of the thickness that is guarded.
    GuardedThickness,
}

/// Who missed a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Culprit {
    /// The broad phase did not name the pair.
    Broad,
    /// The pair was excluded as too slow.
    Exclusion,
    /// The narrow phase said that they do not meet.
    Narrow,
}

impl Finding {
    /// Whether something passed, or may have passed, unnoticed: the others are about numbers.
    pub fn is_tunnel(&self) -> bool {
        !matches!(
            self.what,
            What::Late { .. } | What::Early { .. } | What::False
        )
    }

    /// Whether nobody has looked at how something got where it is.
    pub fn is_jump(&self) -> bool {
        matches!(
            self.what,
            What::Jump { .. }
                | What::Altered { .. }
                | What::Astray { .. }
                | What::Unsound { .. }
                | What::StepUnsound { .. }
                | What::BodyJump { .. }
                | What::BodyUnsound { .. }
        )
    }

    /// The command that explains the witness to whoever asked, ready to paste.
    pub fn command(&self, caller: &Caller) -> Option<String> {
        let id = format!("step-{}", self.step);
        let query = self.query.as_ref();
        query.map(|query| caller.explain_query(&id, query))
    }

    /// Where the witness is: the middle of its first two points where it ends.
    pub fn place(&self) -> Option<Point> {
        let [a, b, ..] = match self.query.as_ref()? {
            AnyQuery::Linear(Query::EdgeEdge(query)) => *query.end(),
            AnyQuery::Linear(_) => return None,
            AnyQuery::Turning(query) => query.positions(1.0),
        };
        Some(center(&a, &b))
    }
}

fn as_text<S: Serializer>(segments: &[SegmentId], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(segments.iter().map(|id| [id.wire.0, id.segment]))
}

fn as_line<S: Serializer>(query: &Option<AnyQuery>, serializer: S) -> Result<S::Ok, S::Error> {
    let line = |query: &AnyQuery| query.line("witness", Numbers::Decimal);
    query.as_ref().map(line).serialize(serializer)
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}: {}", self.step, self.what)?;
        let segment = |id: &SegmentId| format!("wire {} segment {}", id.wire.0, id.segment);
        let bodies = self.of_bodies.iter().map(|body| format!("body {body}"));
        let things: Vec<String> = self.segments.iter().map(segment).chain(bodies).collect();
        match things.is_empty() {
            true => Ok(()),
            false => write!(f, ": {}", things.join(" and ")),
        }
    }
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            What::Missed { by, crossing } => {
                let what = if *crossing { "crossing" } else { "contact" };
                write!(f, "{what} missed by {by}")
            }
            What::Late { by } => write!(f, "time of impact {by:e} of a step late"),
            What::Early { by } => write!(f, "time of impact {by:e} of a step early"),
            What::False => f.write_str("reported to meet, and do not"),
            What::Remesh => f.write_str("a change of resolution passes through"),
            What::Nearer { by, were_near } => {
                write!(f, "{}, missed by {by}", nearer(*were_near))
            }
            What::RemeshNearer { were_near } => {
                write!(f, "a change of resolution: {}", nearer(*were_near))
            }
            What::Jump { wire } => {
                write!(
                    f,
                    "wire {wire} does not start where the step before left it"
                )
            }
            What::BodyMissed {
                body,
                toi,
                crossing,
            } => {
                let what = if *crossing { "crossing" } else { "contact" };
                write!(f, "{what} with body {body} missed, at {toi} of the step")
            }
            What::CoreMissed {
                bodies: [a, b],
                toi,
                crossing,
            } => {
                let what = if *crossing { "crossing" } else { "contact" };
                write!(
                    f,
                    "{what} of bodies {a} and {b} missed, at {toi} of the step"
                )
            }
            What::BodyRemesh { body, arc } => {
                write!(
                    f,
                    "a change of resolution at {arc} m passes through body {body}"
                )
            }
            What::BodyJump { body } => {
                write!(
                    f,
                    "body {body} does not start where the step before left it"
                )
            }
            What::BodyUnsound { body } => {
                write!(
                    f,
                    "body {body} has poses that are no motion, or no known shape"
                )
            }
            What::Altered { wire, field, at } => {
                write!(
                    f,
                    "wire {wire} does not start as the step before left it: {}",
                    entry(*field, *at)
                )
            }
            What::Astray {
                wire,
                node,
                body,
                at_end,
            } => {
                let when = if *at_end { "ends" } else { "starts" };
                match body {
                    Some(body) => write!(
                        f,
                        "node {node} of wire {wire} is fixed to body {body}, and not there where \
                         the step {when}"
                    ),
                    None => write!(f, "node {node} of wire {wire} is pinned, and moves"),
                }
            }
            What::Unsound { wire, field, at } => {
                write!(
                    f,
                    "wire {wire} has numbers that are no motion: {}",
                    entry(*field, *at)
                )
            }
            What::StepUnsound { field } => f.write_str(match field {
                StepField::Number => "its number does not follow that of the step before",
                StepField::Time => "its time is not after that of the step before, or not finite",
                StepField::GuardedThickness => "its guarded thickness is no share",
            }),
        }
    }
}

/// A number of a list, or the list.
fn entry(field: Field, at: Option<usize>) -> String {
    at.map_or(field.to_string(), |at| format!("{field}[{at}]"))
}

fn nearer(were_near: bool) -> &'static str {
    match were_near {
        true => "nearer than they were, inside the guarded thickness",
        false => "inside the guarded thickness",
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Field::Radius => "radius",
            Field::Arcs => "arcs",
            Field::Kinds => "kinds",
            Field::Before => "before",
            Field::After => "after",
            Field::Tensions => "tensions",
            Field::Torque => "torque",
            Field::Twist => "twist",
        })
    }
}

impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Culprit::Broad => "the broad phase",
            Culprit::Exclusion => "the exclusion of slow pairs",
            Culprit::Narrow => "the narrow phase",
        })
    }
}
