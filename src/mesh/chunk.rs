//! Pairs of a mesh that are asked together, as the first stages take several at once.

use super::candidates::{Candidate, Question};
use crate::certified::{CHUNK, Indexed, MayTouch, Precision, Radii};
use crate::query::{Coordinate, EdgeEdge, QueryKind, Radius, VertexFace};

/// Pairs of a kind.
pub(super) struct Chunk {
    pub(super) kind: QueryKind,
    candidates: [Candidate; CHUNK],
    vertices: [[u32; 4]; CHUNK],
    count: usize,
}

impl Default for Chunk {
    fn default() -> Self {
        let kind = QueryKind::EdgeEdge;
        let none = Candidate {
            kind,
            first: 0,
            second: 0,
        };
        Chunk {
            kind,
            candidates: [none; CHUNK],
            vertices: [[0; 4]; CHUNK],
            count: 0,
        }
    }
}

impl Chunk {
    /// Whether there is room for a pair of this kind.
    #[inline(always)]
    pub(super) fn takes(&self, kind: QueryKind) -> bool {
        self.count == 0 || self.count < CHUNK && self.kind == kind
    }

    /// Adds a pair that it [takes](Self::takes), with the indices of its points.
    #[inline(always)]
    pub(super) fn push(&mut self, candidate: Candidate, vertices: [u32; 4]) {
        self.kind = candidate.kind;
        self.candidates[self.count] = candidate;
        self.vertices[self.count] = vertices;
        self.count += 1;
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }
}

/// What asks chunks which of their pairs may touch.
pub(super) struct Screen(Box<MayTouch>);

impl Default for Screen {
    fn default() -> Self {
        Screen(Box::new(MayTouch::new()))
    }
}

impl Screen {
    /// Calls `each` for pairs of a chunk, in order, with the indices of their points: for all that
    /// touch, and for some that do not.
    #[inline(always)]
    pub(super) fn may_touch<C: Coordinate>(
        &mut self,
        question: &Question<C>,
        chunk: &Chunk,
        each: impl FnMut(&Candidate, &[u32; 4]),
    ) {
        let radius = |vertices: &[u32; 4]| question.radius(chunk.kind, vertices);
        self.ask(question, chunk, radius, None, each);
    }

    /// The same for what rounded positions at any step touch, or come within a distance beyond the
    /// thickness.
    #[inline(always)]
    pub(super) fn may_touch_rounded<C: Coordinate>(
        &mut self,
        question: &Question<C>,
        chunk: &Chunk,
        beyond: f64,
        each: impl FnMut(&Candidate, &[u32; 4]),
    ) {
        let radius = |vertices: &[u32; 4]| question.radius(chunk.kind, vertices).beyond(beyond);
        self.ask(question, chunk, radius, Some(Precision::of::<C>()), each);
    }

    #[inline(always)]
    fn ask<C: Coordinate>(
        &mut self,
        question: &Question<C>,
        chunk: &Chunk,
        radius: impl Fn(&[u32; 4]) -> Radius,
        rounded: Option<Precision>,
        mut each: impl FnMut(&Candidate, &[u32; 4]),
    ) {
        let Screen(screen) = self;
        let vertices = &chunk.vertices[..chunk.count];
        let mut radii = [Radius::ZERO; CHUNK];
        for (to, vertices) in radii.iter_mut().zip(vertices) {
            *to = radius(vertices);
        }
        let source = Indexed {
            start: question.start,
            end: question.end,
            indices: vertices,
            radii: Radii::Each(&radii[..chunk.count]),
        };
        let open = |index: usize| each(&chunk.candidates[index], &chunk.vertices[index]);
        match (chunk.kind, rounded) {
            (QueryKind::EdgeEdge, None) => screen.of::<EdgeEdge>(&source, chunk.count, open),
            (QueryKind::VertexFace, None) => screen.of::<VertexFace>(&source, chunk.count, open),
            (QueryKind::EdgeEdge, Some(precision)) => {
                screen.with_room::<EdgeEdge>(&source, chunk.count, precision, open);
            }
            (QueryKind::VertexFace, Some(precision)) => {
                screen.with_room::<VertexFace>(&source, chunk.count, precision, open);
            }
        }
    }
}
