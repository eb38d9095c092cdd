//! The pairs of a mesh that may come near each other during a step.

use super::chunk::{Chunk, Screen};
use super::error::MeshError;
use super::topology::{Feature, Mesh, Pair, Thickness, half};
use super::tree::{Bounds, Grid, Lane, Meets, Task, Tree};
use crate::certified::{Positions, Precision, rounding_of};
use crate::environment;
use crate::parallel::{both, mapped, mapped_with};
use crate::query::{Coordinate, QueryKind, Radius, first_not_finite, widened};

/// A pair of a mesh by its indices: of two segments, or of a vertex and a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Candidate {
    pub(super) kind: QueryKind,
    pub(super) first: u32,
    pub(super) second: u32,
}

/// A question about a mesh: positions at both ends of a step, and the thickness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question<'a, C> {
    pub(super) mesh: &'a Mesh,
    pub(super) start: &'a [[C; 3]],
    pub(super) end: &'a [[C; 3]],
    pub(super) thickness: Thickness<'a>,
}

/// The trees of a question.
pub(super) struct Candidates<'a, C> {
    question: Question<'a, C>,
    segments: Tree,
    vertices: Tree,
    faces: Tree,
    meets: Option<Meets>,
}

impl<'a, C: Coordinate> Question<'a, C> {
    /// # Errors
    ///
    /// [`MeshError`] if an array has another length than it should have, or holds what is no
    /// coordinate or thickness.
    pub(super) fn new(
        mesh: &'a Mesh,
        start: &'a [[C; 3]],
        end: &'a [[C; 3]],
        thickness: Thickness<'a>,
    ) -> Result<Self, MeshError> {
        debug_assert_eq!(environment::check(), Ok(()));
        check_positions("start", start, mesh.vertices)?;
        check_positions("end", end, mesh.vertices)?;
        thickness.check(mesh)?;
        Ok(Question {
            mesh,
            start,
            end,
            thickness,
        })
    }

    /// The indices of A, B, C and D.
    #[inline(always)]
    pub(super) fn vertices_of(&self, candidate: &Candidate) -> [u32; 4] {
        let Candidate {
            kind,
            first,
            second,
        } = *candidate;
        match kind {
            QueryKind::EdgeEdge => {
                let ([a, b], [c, d]) = (self.mesh.segment(first), self.mesh.segment(second));
                [a, b, c, d]
            }
            QueryKind::VertexFace => {
                let [b, c, d] = self.mesh.faces[second as usize];
                [first, b, c, d]
            }
        }
    }

    /// The motion of a pair.
    #[inline(always)]
    pub(super) fn positions(&self, vertices: &[u32; 4]) -> Positions {
        let of = |all: &[[C; 3]]| vertices.map(|vertex| widened(&all[vertex as usize]));
        Positions {
            start: of(self.start),
            end: of(self.end),
        }
    }

    /// The distance at which a pair touches.
    #[inline(always)]
    pub(super) fn radius(&self, kind: QueryKind, vertices: &[u32; 4]) -> Radius {
        let (first, second) = sides(kind, vertices);
        self.thickness.between(self.mesh, first, second)
    }

    /// A pair as it is shown.
    pub(super) fn pair(&self, candidate: &Candidate) -> Pair {
        let Candidate {
            kind,
            first,
            second,
        } = *candidate;
        match kind {
            QueryKind::EdgeEdge => Pair {
                first: self.mesh.segment_feature(first),
                second: self.mesh.segment_feature(second),
            },
            QueryKind::VertexFace => Pair {
                first: Feature::Vertex(first),
                second: Feature::Face(second),
            },
        }
    }
}

/// The swept boxes of vertices, and how far each has to be moved outward.
struct Swept {
    bounds: Vec<Bounds>,
    rounding: Vec<f64>,
}

impl Swept {
    fn new<C: Coordinate>(question: &Question<C>, rounded: Option<Precision>) -> Self {
        let at = |vertex: usize| {
            let of = |all: &[[C; 3]]| widened(&all[vertex]);
            (of(question.start), of(question.end))
        };
        let count = question.mesh.vertices;
        Swept {
            bounds: mapped(count, SHARE, |vertex| {
                let (start, end) = at(vertex);
                Bounds {
                    low: [0, 1, 2].map(|i| start[i].min(end[i])),
                    high: [0, 1, 2].map(|i| start[i].max(end[i])),
                }
            }),
            rounding: mapped(count, SHARE, |vertex| match (at(vertex), rounded) {
                ((start, end), Some(precision)) => rounding_of(&start, &end, precision),
                _ => 0.0,
            }),
        }
    }

    /// The box around all vertices.
    fn around(&self) -> Bounds {
        let joined = |around: Bounds, bounds: &Bounds| around.joined(bounds);
        self.bounds.iter().fold(Bounds::NOTHING, joined)
    }

    /// The swept box of a part, moved outward by half the distance that it keeps and by what
    /// rounding moves it.
    #[inline(always)]
    fn of(&self, vertices: &[u32], kept: f64) -> Bounds {
        let mut bounds = Bounds::NOTHING;
        let mut rounding = 0f64;
        for &vertex in vertices {
            bounds = bounds.joined(&self.bounds[vertex as usize]);
            rounding = rounding.max(self.rounding[vertex as usize]);
        }
        // Above zero by more than what the roundings of the sum and of the room lose.
        let distance = (half(kept) + rounding) * (1.0 + 32.0 * f64::EPSILON);
        bounds.widened(distance)
    }
}

impl<'a, C: Coordinate> Candidates<'a, C> {
    /// All pairs that come within the thickness and a distance beyond it, also if positions on the
    /// way are `rounded`.
    pub(super) fn new(question: Question<'a, C>, beyond: f64, rounded: Option<Precision>) -> Self {
        let mesh = question.mesh;
        let swept = Swept::new(&question, rounded);
        let grid = Grid::new(&swept.around());
        let lane = |vertices: &[u32]| {
            let kept = question.thickness.of(mesh, vertices) + beyond;
            Lane::new(&swept.of(vertices, kept), mesh.group_bits(vertices), &grid)
        };
        let tree =
            |count, lane: &(dyn Fn(usize) -> Lane + Sync)| Tree::new(&mapped(count, SHARE, lane));
        // Vertices meet faces alone.
        let vertex_count = if mesh.faces.is_empty() {
            0
        } else {
            mesh.vertices
        };
        let (segments, (faces, vertices)) = both(
            || {
                tree(mesh.segment_count(), &|index| {
                    lane(&mesh.segment(index as u32))
                })
            },
            || {
                both(
                    || tree(mesh.faces.len(), &|index| lane(&mesh.faces[index])),
                    || tree(vertex_count, &|index| lane(&[index as u32])),
                )
            },
        );
        Candidates {
            question,
            segments,
            vertices,
            faces,
            meets: mesh.meets(),
        }
    }

    /// Visits all pairs, in parts: each part has a collection of its own, and these are returned in
    /// an order that depends on the mesh alone. The pairs of a part come in chunks.
    pub(super) fn visit<A: Default + Send>(
        &self,
        each: impl Fn(&mut A, &mut Screen, &Chunk) + Sync,
    ) -> Vec<A> {
        let meets = self.meets.as_ref();
        let edges = self.segments.tasks_within(PARTS, meets);
        let faces = self.vertices.tasks_with(&self.faces, PARTS, meets);
        let edges = edges.into_iter().map(|task| (QueryKind::EdgeEdge, task));
        let faces = faces.into_iter().map(|task| (QueryKind::VertexFace, task));
        let tasks: Vec<(QueryKind, Task)> = edges.chain(faces).collect();
        let share = tasks.len().div_ceil(PARTS).max(1);
        let parts: Vec<&[(QueryKind, Task)]> = tasks.chunks(share).collect();
        mapped_with(parts.len(), Screen::default, |screen, part| {
            // By each thread that takes a part.
            debug_assert_eq!(environment::check(), Ok(()));
            let mut collected = A::default();
            let mut chunk = Chunk::default();
            for (kind, task) in parts[part] {
                let mut found = |first: u32, second: u32| {
                    let candidate = Candidate {
                        kind: *kind,
                        first,
                        second,
                    };
                    let vertices = self.question.vertices_of(&candidate);
                    let (a, b) = sides(*kind, &vertices);
                    let is_shared = a.iter().any(|vertex| b.contains(vertex));
                    if is_shared || self.question.mesh.is_left_out(a, b) {
                        return;
                    }
                    if !chunk.takes(*kind) {
                        each(&mut collected, screen, &chunk);
                        chunk.clear();
                    }
                    chunk.push(candidate, vertices);
                };
                match kind {
                    QueryKind::EdgeEdge => {
                        self.segments
                            .pairs(&self.segments, task, meets, true, &mut found);
                    }
                    QueryKind::VertexFace => {
                        self.vertices
                            .pairs(&self.faces, task, meets, false, &mut found);
                    }
                }
            }
            each(&mut collected, screen, &chunk);
            collected
        })
    }
}

/// About how many parts the pairs are visited in.
const PARTS: usize = 256;

/// How many boxes a thread makes at a time.
const SHARE: usize = 1024;

/// The vertices of both sides.
#[inline(always)]
pub(super) fn sides(kind: QueryKind, vertices: &[u32; 4]) -> (&[u32], &[u32]) {
    vertices.split_at(match kind {
        QueryKind::EdgeEdge => 2,
        QueryKind::VertexFace => 1,
    })
}

fn check_positions<C: Coordinate>(
    array: &'static str,
    positions: &[[C; 3]],
    expected: usize,
) -> Result<(), MeshError> {
    if positions.len() != expected {
        return Err(MeshError::Length {
            array,
            found: positions.len(),
            expected,
        });
    }
    if let Some((vertex, axis, value)) = first_not_finite(positions) {
        return Err(MeshError::NotFinite {
            array,
            vertex,
            axis,
            value,
        });
    }
    Ok(())
}
