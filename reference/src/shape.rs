//! A query as a list of numbers, which shrinking and fuzzing change as they like.

use std::hash::{Hash, Hasher};

use tunnelproof::query::{Point, Query, QueryKind};

/// The numbers of a query.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Edges, or a vertex and a face.
    pub kind: QueryKind,
    /// x, y and z of A, B, C and D at `t = 0`, then at `t = 1`.
    pub numbers: [f64; 24],
    /// In metres, of the first side and of the second.
    pub radii: [f64; 2],
}

impl Shape {
    /// The numbers of a query.
    pub fn new(query: &Query) -> Self {
        let mut numbers = [0.0; 24];
        let points = query.start().iter().chain(query.end());
        for (place, number) in numbers
            .iter_mut()
            .zip(points.flat_map(|point| point.iter()))
        {
            *place = *number;
        }
        Shape {
            kind: query.kind(),
            numbers,
            radii: query.radius().parts(),
        }
    }

    /// The query, if the numbers are those of one.
    pub fn query(&self) -> Option<Query> {
        let point = |index: usize| Point::from(self.position(index));
        let (start, end) = ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point));
        Query::new(self.kind, start, end, self.radii).ok()
    }

    /// One of eight positions: A, B, C, D at the start and A, B, C, D at the end.
    pub fn position(&self, index: usize) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.numbers[3 * index + axis])
    }

    /// Puts one of the eight positions elsewhere.
    pub fn set_position(&mut self, index: usize, position: [f64; 3]) {
        self.numbers[3 * index..][..3].copy_from_slice(&position);
    }

    /// The same with another position at each index.
    pub fn permuted(&self, index: [usize; 8]) -> Self {
        let mut shape = *self;
        for (to, from) in index.into_iter().enumerate() {
            shape.set_position(to, self.position(from));
        }
        shape
    }

    /// The same with these numbers, by their index, changed; a 0 is always the positive one.
    pub fn changed(
        &self,
        indices: impl IntoIterator<Item = usize>,
        change: impl Fn(f64) -> f64,
    ) -> Self {
        let mut shape = *self;
        for index in indices {
            // Adding 0 turns -0 into 0.
            shape.numbers[index] = change(shape.numbers[index]) + 0.0;
        }
        shape
    }

    fn bits(&self) -> (QueryKind, [u64; 24], [u64; 2]) {
        let numbers = self.numbers.map(f64::to_bits);
        (self.kind, numbers, self.radii.map(f64::to_bits))
    }
}

impl PartialEq for Shape {
    /// Bit for bit.
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl Eq for Shape {}

impl Hash for Shape {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bits().hash(state);
    }
}
