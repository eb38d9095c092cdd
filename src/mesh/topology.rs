//! Vertices, edges and faces by their indices, and which of them are pairs.

use rustc_hash::FxHashSet;

use super::error::MeshError;
use super::tree::Meets;
use crate::query::Radius;

/// Vertices, edges and faces, without positions.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub(super) vertices: usize,
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) faces: Vec<[u32; 3]>,
    /// The vertices in no edge and no face, ascending.
    pub(super) points: Vec<u32>,
    /// The group of each vertex; empty if all are of group 0.
    groups: Vec<u32>,
    /// The two groups of pairs that are left out, the smaller one first.
    left_out: FxHashSet<[u32; 2]>,
}

/// A part of a mesh, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Feature {
    /// A vertex.
    Vertex(u32),
    /// An edge of [`Mesh::edges`].
    Edge(u32),
    /// A face.
    Face(u32),
}

/// Two parts of a mesh: two edges, an edge or a point and a point, or a vertex and a face.
///
/// Of two edges or points the first has the smaller index. An edge comes before a point, a vertex
/// before a face. Pairs are in order by what is first, then by what is second; those of edges and
/// points come before those of vertices and faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pair {
    /// The edge AB, or the vertex A.
    pub first: Feature,
    /// The edge CD, or the face BCD.
    pub second: Feature,
}

/// How near two parts of a mesh may come: contact is a distance of at most the thickness.
///
/// It is the radius of the pairs' queries. Two sheets of cloth of thickness `t` touch where their
/// middle surfaces are `t` apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Thickness<'a> {
    /// The same for all, in metres.
    Uniform(f64),
    /// One for each group, in order. Two parts of different thickness touch at the mean of the two, which is
    /// not rounded unless it is subnormal. A part with vertices of several groups has the largest.
    PerGroup(&'a [f64]),
}

impl From<f64> for Thickness<'_> {
    fn from(thickness: f64) -> Self {
        Thickness::Uniform(thickness)
    }
}

impl<'a> From<&'a [f64]> for Thickness<'a> {
    fn from(thickness: &'a [f64]) -> Self {
        Thickness::PerGroup(thickness)
    }
}

impl<'a, const N: usize> From<&'a [f64; N]> for Thickness<'a> {
    fn from(thickness: &'a [f64; N]) -> Self {
        Thickness::PerGroup(thickness)
    }
}

impl<'a> From<&'a Vec<f64>> for Thickness<'a> {
    fn from(thickness: &'a Vec<f64>) -> Self {
        Thickness::PerGroup(thickness)
    }
}

impl Mesh {
    /// The mesh of so many vertices, and of edges and faces by the indices of their vertices.
    ///
    /// The edges of the faces need not be given: those that are missing come after those that are.
    /// An edge or a face may have a vertex more than once; it is a segment or a point then.
    ///
    /// # Errors
    ///
    /// [`MeshError::Index`] names the first vertex that does not exist, [`MeshError::Count`] what
    /// there are more of than indices.
    pub fn new(vertices: usize, edges: &[[u32; 2]], faces: &[[u32; 3]]) -> Result<Self, MeshError> {
        check_indices("edges", edges, vertices)?;
        check_indices("faces", faces, vertices)?;
        let edges = with_edges_of(edges, faces);
        for (array, found) in [
            ("vertices", vertices),
            // Points come after them.
            ("edges", edges.len().saturating_add(vertices)),
            ("faces", faces.len()),
        ] {
            if u32::try_from(found).is_err() {
                return Err(MeshError::Count { array, found });
            }
        }
        let mut is_free = vec![true; vertices];
        for &vertex in edges.iter().flatten() {
            is_free[vertex as usize] = false;
        }
        let points = (0..).zip(is_free).filter(|(_, is_free)| *is_free);
        Ok(Mesh {
            vertices,
            edges,
            faces: faces.to_vec(),
            points: points.map(|(vertex, _)| vertex).collect(),
            groups: Vec::new(),
            left_out: FxHashSet::default(),
        })
    }

    /// Puts each vertex into a group: a number from 0, for [`leave_out`](Self::leave_out) and
    /// [`Thickness::PerGroup`]. Without it all are of group 0.
    ///
    /// What was left out is forgotten.
    ///
    /// # Errors
    ///
    /// [`MeshError::Length`] if there is not one group for each vertex.
    pub fn set_groups(&mut self, groups: &[u32]) -> Result<(), MeshError> {
        if groups.len() != self.vertices {
            return Err(MeshError::Length {
                array: "groups",
                found: groups.len(),
                expected: self.vertices,
            });
        }
        self.groups = groups.to_vec();
        self.left_out.clear();
        Ok(())
    }

    /// Leaves out the pairs of two groups, which may be the same one. A static part is a group that
    /// is left out with itself.
    ///
    /// A part with vertices of several groups is left out only if all its groups are.
    ///
    /// # Errors
    ///
    /// [`MeshError::Group`] if no vertex is in one of the groups, or in a larger one.
    pub fn leave_out(&mut self, first: u32, second: u32) -> Result<(), MeshError> {
        let groups = self.group_count();
        for value in [first, second] {
            if value as usize >= groups {
                return Err(MeshError::Group { value, groups });
            }
        }
        self.left_out.insert([first.min(second), first.max(second)]);
        Ok(())
    }

    /// How many vertices there are.
    pub fn vertex_count(&self) -> usize {
        self.vertices
    }

    /// The edges: those given, then those of faces that were missing, in the order of the faces.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The faces as given.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// How many groups there are: one more than the largest number.
    pub fn group_count(&self) -> usize {
        self.groups
            .iter()
            .max()
            // It would be 0 where `usize` has 32 bits.
            .map_or(1, |&group| (group as usize).saturating_add(1))
    }

    /// The vertices A, B, C and D of the query of a pair. A point is both ends of its edge.
    ///
    /// `None` if the two are no pair of this mesh by their kinds or indices.
    pub fn vertices_of(&self, pair: Pair) -> Option<[u32; 4]> {
        let edge = |feature| match feature {
            Feature::Edge(index) => self.edges.get(index as usize).copied(),
            Feature::Vertex(vertex) => {
                ((vertex as usize) < self.vertices).then_some([vertex, vertex])
            }
            Feature::Face(_) => None,
        };
        match (pair.first, pair.second) {
            (Feature::Vertex(vertex), Feature::Face(face)) => {
                let [b, c, d] = *self.faces.get(face as usize)?;
                ((vertex as usize) < self.vertices).then_some([vertex, b, c, d])
            }
            (first, second) => {
                let ([a, b], [c, d]) = (edge(first)?, edge(second)?);
                Some([a, b, c, d])
            }
        }
    }

    pub(super) fn group(&self, vertex: u32) -> u32 {
        match self.groups.get(vertex as usize) {
            Some(group) => *group,
            None => 0,
        }
    }

    /// The ends of a segment: the edges, then the points.
    #[inline(always)]
    pub(super) fn segment(&self, index: u32) -> [u32; 2] {
        match self.edges.get(index as usize) {
            Some(edge) => *edge,
            None => [self.points[index as usize - self.edges.len()]; 2],
        }
    }

    /// How many segments there are.
    pub(super) fn segment_count(&self) -> usize {
        self.edges.len() + self.points.len()
    }

    pub(super) fn segment_feature(&self, index: u32) -> Feature {
        match self
            .points
            .get((index as usize).wrapping_sub(self.edges.len()))
        {
            Some(point) => Feature::Vertex(*point),
            None => Feature::Edge(index),
        }
    }

    /// Whether a pair is left out for its groups.
    #[inline]
    pub(super) fn is_left_out(&self, first: &[u32], second: &[u32]) -> bool {
        let is_out = |g: u32, h: u32| self.left_out.contains(&[g.min(h), g.max(h)]);
        !self.left_out.is_empty()
            && first.iter().all(|&i| {
                let group = self.group(i);
                second.iter().all(|&j| is_out(group, self.group(j)))
            })
    }

    /// Which groups meet which, with a bit for each; `None` if all do.
    pub(super) fn meets(&self) -> Option<Meets> {
        if self.left_out.is_empty() {
            return None;
        }
        // Groups that share a bit meet what any of them does.
        let mut meets = [u64::MAX; 64];
        if self.group_count() <= 64 {
            for &[first, second] in &self.left_out {
                meets[first as usize] &= !(1 << second);
                meets[second as usize] &= !(1 << first);
            }
        }
        Some(meets)
    }

    /// The groups of some vertices, as bits.
    #[inline]
    pub(super) fn group_bits(&self, vertices: &[u32]) -> u64 {
        if self.groups.is_empty() {
            return 1;
        }
        let bits = vertices
            .iter()
            .map(|&vertex| 1 << (self.group(vertex) % 64));
        bits.fold(0, |bits, bit: u64| bits | bit)
    }
}

impl Thickness<'_> {
    /// Refuses what is no thickness of a mesh.
    pub(super) fn check(&self, mesh: &Mesh) -> Result<(), MeshError> {
        let is_valid = |value: f64| value >= 0.0 && value.is_finite();
        match *self {
            Thickness::Uniform(value) if !is_valid(value) => {
                Err(MeshError::Thickness { group: None, value })
            }
            Thickness::Uniform(_) => Ok(()),
            Thickness::PerGroup(values) => {
                let expected = mesh.group_count();
                if values.len() != expected {
                    return Err(MeshError::Length {
                        array: "thickness",
                        found: values.len(),
                        expected,
                    });
                }
                match values.iter().position(|&value| !is_valid(value)) {
                    Some(group) => Err(MeshError::Thickness {
                        group: Some(group),
                        value: values[group],
                    }),
                    None => Ok(()),
                }
            }
        }
    }

    /// Of a part of a mesh.
    #[inline]
    pub(super) fn of(&self, mesh: &Mesh, vertices: &[u32]) -> f64 {
        match *self {
            Thickness::Uniform(value) => value,
            Thickness::PerGroup(values) => vertices
                .iter()
                .map(|&vertex| values[mesh.group(vertex) as usize])
                .fold(0.0, f64::max),
        }
    }

    /// The distance at which two parts touch.
    #[inline]
    pub(super) fn between(&self, mesh: &Mesh, first: &[u32], second: &[u32]) -> Radius {
        let (first, second) = (self.of(mesh, first), self.of(mesh, second));
        match first == second {
            true => first.into(),
            false => [half(first), half(second)].into(),
        }
    }
}

/// Half of a number, exactly; rounded up where it underflows.
pub(super) fn half(x: f64) -> f64 {
    let half = x / 2.0;
    match half * 2.0 < x {
        true => half.next_up(),
        false => half,
    }
}

fn check_indices<const N: usize>(
    array: &'static str,
    parts: &[[u32; N]],
    vertices: usize,
) -> Result<(), MeshError> {
    for (index, part) in parts.iter().enumerate() {
        for (corner, &value) in part.iter().enumerate() {
            if value as usize >= vertices {
                return Err(MeshError::Index {
                    array,
                    index,
                    corner,
                    value,
                    vertices,
                });
            }
        }
    }
    Ok(())
}

/// Edges and those of faces that are not among them.
fn with_edges_of(edges: &[[u32; 2]], faces: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut known: FxHashSet<[u32; 2]> = edges.iter().copied().map(sorted).collect();
    let mut all = edges.to_vec();
    for &[a, b, c] in faces {
        for edge in [[a, b], [b, c], [c, a]] {
            if known.insert(sorted(edge)) {
                all.push(edge);
            }
        }
    }
    all
}
