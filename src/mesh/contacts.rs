//! The contacts of a mesh during a step.

use std::sync::atomic::{AtomicBool, Ordering};

use super::candidates::{Candidate, Candidates, Question};
use super::error::MeshError;
use super::topology::{Mesh, Pair, Thickness};
use crate::certified::{Positions, first_toi};
use crate::contact::{Contact, ContactKind, single_below};
use crate::query::{Coordinate, EdgeEdge, Point, Query, QueryKind, Radius, VertexFace};

/// The first contact of a pair during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshContact {
    /// The pair.
    pub pair: Pair,
    /// The largest `f64` that is not above the exact time of impact, in `[0, 1]`. Positions rounded
    /// at this time may already be past the contact: [`Mesh::step`] gives positions to store.
    pub toi: f64,
    /// The smallest `f64` that is not below it.
    pub toi_above: f64,
    /// Whether the two swap sides; see [`Hit::kind`](crate::Hit::kind).
    pub kind: ContactKind,
    /// Points, weights and normal.
    pub contact: Contact,
}

impl MeshContact {
    /// The largest `f32` that is not above the exact time of impact: `toi as f32` may be above it.
    pub fn toi_f32(&self) -> f32 {
        single_below(self.toi)
    }
}

impl Mesh {
    /// The contact of the least time of impact during straight motion from `start` to `end`; of
    /// several with the same `toi`, that of the first pair.
    ///
    /// Positions are in metres, one for each vertex, in `f64` or in `f32`. Certified: none is missed and none is false.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if there is not one position for each vertex, a coordinate is not finite, or
    /// the thickness is not a finite number of at least 0.
    pub fn first_contact<'a, C: Coordinate>(
        &self,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<Option<MeshContact>, MeshError> {
        let question = Question::new(self, start, end, thickness.into())?;
        let candidates = Candidates::new(question, 0.0, None);
        let parts = candidates.visit(|first: &mut Option<(f64, Candidate)>, screen, chunk| {
            screen.may_touch(&question, chunk, |candidate, vertices| {
                // Nothing is earlier than the start, and of several contacts there the first counts.
                let is_later = |(toi, known): (f64, Candidate)| toi == 0.0 && known < *candidate;
                if first.is_some_and(is_later) {
                    return;
                }
                if let Some(toi) = question.toi(candidate.kind, vertices) {
                    let found = (toi, *candidate);
                    *first = Some(first.map_or(found, |known| earlier(known, found)));
                }
            });
        });
        let first = parts.into_iter().flatten().reduce(earlier);
        Ok(first.and_then(|(_, candidate)| question.contact(&candidate)))
    }

    /// The first contact of each pair that touches during straight motion from `start` to `end`, in
    /// the order of the pairs.
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact).
    pub fn all_contacts<'a, C: Coordinate>(
        &self,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<Vec<MeshContact>, MeshError> {
        let question = Question::new(self, start, end, thickness.into())?;
        let candidates = Candidates::new(question, 0.0, None);
        let parts = candidates.visit(|found: &mut Vec<_>, screen, chunk| {
            screen.may_touch(&question, chunk, |candidate, vertices| {
                if question.toi(candidate.kind, vertices).is_some() {
                    let contact = question.contact(candidate);
                    found.extend(contact.map(|contact| (*candidate, contact)));
                }
            });
        });
        let mut contacts: Vec<_> = parts.into_iter().flatten().collect();
        contacts.sort_unstable_by_key(|(candidate, _)| *candidate);
        Ok(contacts.into_iter().map(|(_, contact)| contact).collect())
    }

    /// Whether no pair touches during straight motion from `start` to `end`.
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact).
    pub fn is_free<'a, C: Coordinate>(
        &self,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<bool, MeshError> {
        let question = Question::new(self, start, end, thickness.into())?;
        let candidates = Candidates::new(question, 0.0, None);
        let is_free = AtomicBool::new(true);
        candidates.visit(|(): &mut (), screen, chunk| {
            if !is_free.load(Ordering::Relaxed) {
                return;
            }
            screen.may_touch(&question, chunk, |candidate, vertices| {
                let is_open = is_free.load(Ordering::Relaxed);
                if is_open && question.toi(candidate.kind, vertices).is_some() {
                    is_free.store(false, Ordering::Relaxed);
                }
            });
        });
        Ok(is_free.into_inner())
    }

    /// The query that is asked about a pair: for other questions about it.
    ///
    /// # Errors
    ///
    /// As [`first_contact`](Self::first_contact). `Ok(None)` if the two are no pair of this mesh by
    /// their kinds or indices.
    pub fn query<'a, C: Coordinate>(
        &self,
        pair: Pair,
        start: &[[C; 3]],
        end: &[[C; 3]],
        thickness: impl Into<Thickness<'a>>,
    ) -> Result<Option<Query>, MeshError> {
        let question = Question::new(self, start, end, thickness.into())?;
        let kind = match pair.second {
            super::Feature::Face(_) => QueryKind::VertexFace,
            _ => QueryKind::EdgeEdge,
        };
        Ok(self
            .vertices_of(pair)
            .and_then(|vertices| question.query(kind, &vertices)))
    }
}

impl<C: Coordinate> Question<'_, C> {
    /// When a pair touches first.
    #[inline]
    fn toi(&self, kind: QueryKind, vertices: &[u32; 4]) -> Option<f64> {
        let positions = self.positions(vertices);
        let radius = self.radius(kind, vertices);
        match kind {
            QueryKind::EdgeEdge => first_toi::<EdgeEdge>(&positions, radius),
            QueryKind::VertexFace => first_toi::<VertexFace>(&positions, radius),
        }
    }

    /// The query of a pair. All its numbers are finite; so it is always one.
    fn query(&self, kind: QueryKind, vertices: &[u32; 4]) -> Option<Query> {
        let Positions { start, end } = self.positions(vertices);
        let [start, end] = [start, end].map(|points| points.map(Point::from));
        let radius: Radius = self.radius(kind, vertices);
        match kind {
            QueryKind::EdgeEdge => EdgeEdge::new(start, end, radius).map(Query::EdgeEdge).ok(),
            QueryKind::VertexFace => VertexFace::new(start, end, radius)
                .map(Query::VertexFace)
                .ok(),
        }
    }

    /// The contact of a pair that touches.
    fn contact(&self, candidate: &Candidate) -> Option<MeshContact> {
        let pair = self.pair(candidate);
        let query = self.query(candidate.kind, &self.vertices_of(candidate))?;
        let (toi, toi_above, kind, contact) = match &query {
            Query::EdgeEdge(query) => {
                let hit = crate::decide(query)?;
                (hit.toi, hit.toi_above, hit.kind, hit.contact(query))
            }
            Query::VertexFace(query) => {
                let hit = crate::decide(query)?;
                (hit.toi, hit.toi_above, hit.kind, hit.contact(query))
            }
        };
        Some(MeshContact {
            pair,
            toi,
            toi_above,
            kind,
            contact,
        })
    }
}

/// The earlier one of two contacts; of the same time, that of the first pair.
fn earlier(known: (f64, Candidate), found: (f64, Candidate)) -> (f64, Candidate) {
    match (found.0, found.1) < (known.0, known.1) {
        true => found,
        false => known,
    }
}
