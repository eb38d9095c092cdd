//! Whoever answers queries: the judges themselves and the engines that are judged.

use tunnelproof::certified::{self, FaceHit};
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::Query;

use crate::answer::ExactAnswer;

/// Someone who answers queries.
pub trait Subject: Sync {
    /// The name used in tables and on the command line.
    fn name(&self) -> &str;

    /// The answer to a query.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] for a query that the subject does not take.
    fn answer(&self, query: &Query) -> Result<Answer, Unsupported>;

    /// The distance in metres within which a hit without contact is what the subject declares of
    /// itself; 0 for one that claims exactness.
    fn declared_distance(&self) -> f64 {
        0.0
    }
}

/// What a subject says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// An exact subject: every number enclosed by its neighbours.
    Exact(ExactAnswer),
    /// The certified path: everything exact but the parameters, which have a stated error.
    Certified(certified::Verdict),
    /// An engine: every number in `f64`.
    Engine(Report),
}

/// The engine's certified path as a subject, held to all that it promises.
pub struct Certified;

impl Subject for Certified {
    fn name(&self) -> &str {
        "certified"
    }

    fn answer(&self, query: &Query) -> Result<Answer, Unsupported> {
        match query {
            Query::EdgeEdge(query) => Ok(Answer::Certified(certified::decide(query))),
            Query::VertexFace(query) => {
                let hit = certified::decide_vertex_face(query);
                Ok(Answer::Certified(match hit {
                    None => certified::Verdict::Miss,
                    Some(hit) => certified::Verdict::Hit(in_place_of_edges(&hit)),
                }))
            }
        }
    }
}

/// A contact with a face in the form of one of edges: the weights of C and D are the parameters, as in
/// the exact answer.
fn in_place_of_edges(hit: &FaceHit) -> certified::Hit {
    let [_, u, v] = hit.weights;
    certified::Hit {
        toi: hit.toi,
        toi_above: hit.toi_above,
        kind: hit.kind,
        side: hit.side,
        first: certified::Parameters { u, v },
        second: None,
        parameter_error: hit.weight_error,
        case: hit.case,
        flags: hit.flags,
    }
}

/// An engine as a subject.
pub struct Engine<N>(pub N);

impl<N: NarrowPhase> Subject for Engine<N> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn answer(&self, query: &Query) -> Result<Answer, Unsupported> {
        match query {
            Query::EdgeEdge(query) => self.0.edge_edge(query),
            Query::VertexFace(query) => self.0.vertex_face(query),
        }
        .map(Answer::Engine)
    }

    fn declared_distance(&self) -> f64 {
        self.0.declared_distance()
    }
}
