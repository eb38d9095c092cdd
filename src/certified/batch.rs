//! Many queries at once, coordinates in separate arrays.
//!
//! How they are decided: `queries`.

use std::marker::PhantomData;
use std::ops::Range;

use super::block::{CHUNK, LANES, Source, Tile};
use super::kind::{Kind, Stages};
use super::motion::Positions;
use super::queries;
use super::stage::Stage;
use crate::contact::Hit;
use crate::query::{Point, QueryError, Radius, check};

/// Queries of one kind, [`EdgeEdge`](crate::query::EdgeEdge) or
/// [`VertexFace`](crate::query::VertexFace), as a structure of arrays.
///
/// It is for candidate pairs as a broad phase delivers them, of which few touch. The answers are
/// those of [`decide`](super::decide), bit for bit. Where few touch, it takes longer to add a query than to decide it: use
/// [`Pairs`](super::Pairs) if points are in arrays.
///
/// ```
/// use tunnelproof::{Batch, EdgeEdge, Point};
///
/// let p = Point::new;
/// let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.5, -1.0, 1.0), p(0.5, 1.0, 1.0)];
/// let mut batch = Batch::new();
/// for depth in [0.5, 3.0] {
///     let mut end = start;
///     end[2].z -= depth;
///     end[3].z -= depth;
///     batch.push(&EdgeEdge::new(start, end, 0.0)?);
/// }
/// let hits = batch.decide();
/// let [(index, hit)] = &hits[..] else { panic!("one of them touches") };
/// assert_eq!(*index, 1);
/// assert!(hit.toi <= 1.0 / 3.0 && 1.0 / 3.0 <= hit.toi_above);
/// # Ok::<(), tunnelproof::QueryError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Batch<K> {
    /// Coordinate `3 p + i` is axis `i` of point `p`: A, B, C, D at `t = 0`, then at `t = 1`.
    coordinates: [Vec<f64>; 24],
    /// As long as the coordinates, or empty if all are 0.
    radii: Vec<Radius>,
    kind: PhantomData<fn() -> K>,
}

impl<K> Default for Batch<K> {
    fn default() -> Self {
        Batch {
            coordinates: Default::default(),
            radii: Vec::new(),
            kind: PhantomData,
        }
    }
}

impl<K: Kind> Batch<K> {
    /// No queries.
    pub fn new() -> Self {
        Self::default()
    }

    /// How many queries there are.
    pub fn len(&self) -> usize {
        self.coordinates[0].len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Removes all queries and keeps the memory.
    pub fn clear(&mut self) {
        self.coordinates.iter_mut().for_each(Vec::clear);
        self.radii.clear();
    }

    /// Adds a query.
    pub fn push(&mut self, query: &K) {
        let (start, end, radius) = (query.start(), query.end(), query.radius());
        if !(radius.is_zero() && self.radii.is_empty()) {
            self.radii.resize(self.len(), Radius::ZERO);
            self.radii.push(radius);
        }
        let points = start.iter().chain(end);
        let values = points.flat_map(|point| [point.x, point.y, point.z]);
        for (array, value) in self.coordinates.iter_mut().zip(values) {
            array.push(value);
        }
    }

    /// The queries of whole arrays, of which `3 p + i` holds axis `i` of point `p`: A, B, C, D at
    /// `t = 0`, then at `t = 1`. All have the same radius.
    ///
    /// # Errors
    ///
    /// [`BatchError`] if the arrays differ in length or hold a number that is not finite, or if the
    /// radius is not a finite number of at least 0.
    pub fn from_arrays(
        coordinates: [Vec<f64>; 24],
        radius: impl Into<Radius>,
    ) -> Result<Self, BatchError> {
        let radius = radius.into();
        if !radius.is_valid() {
            return Err(BatchError::Radius(radius));
        }
        let radii = if radius.is_zero() {
            Vec::new()
        } else {
            vec![radius; coordinates[0].len()]
        };
        let kind = PhantomData;
        let batch = Batch {
            coordinates,
            radii,
            kind,
        };
        let length = batch.len();
        if let Some(array) = batch
            .coordinates
            .iter()
            .position(|array| array.len() != length)
        {
            let found = batch.coordinates[array].len();
            return Err(BatchError::Length {
                array,
                found,
                expected: length,
            });
        }
        for index in 0..length {
            let Positions { start, end } = batch.positions(index);
            check(&start.map(Point::from), &end.map(Point::from), radius)
                .map_err(|error| BatchError::Query { index, error })?;
        }
        Ok(batch)
    }

    /// A query, if there is one: a copy, for the [points](Hit::points) and the
    /// [normal](Hit::normal) of a hit.
    pub fn get(&self, index: usize) -> Option<K> {
        let query = || K::Stages::query(&self.positions(index), self.radius(index));
        (index < self.len()).then(query)
    }

    /// All hits with the places of their queries, in order.
    pub fn decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        queries::decide::<K::Stages>(self, self.len())
    }

    /// As [`decide`](Self::decide): calls `hit` for each hit, in order, and says for each query, in
    /// any order, which stage decided it. Allocates nothing, but where
    /// coordinates span so many powers of two that integers need the heap.
    pub fn decide_observed(
        &self,
        hit: impl FnMut(usize, Hit<K::Place>),
        observe: impl FnMut(Stage),
    ) {
        queries::decide_range::<K::Stages>(self, 0..self.len(), hit, observe);
    }

    /// As [`decide`](Self::decide), by all threads of the current pool.
    #[cfg(feature = "rayon")]
    pub fn par_decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        queries::par_decide::<K::Stages>(self, self.len())
    }
}

impl<K> Source for Batch<K> {
    #[inline(always)]
    fn load(&self, tiles: &mut [Tile; CHUNK / LANES], queries: Range<usize>) {
        for (row, array) in self.coordinates.iter().enumerate() {
            let array = &array[queries.clone()];
            if let Ok(whole) = <&[f64; CHUNK]>::try_from(array) {
                for (tile, lanes) in tiles.iter_mut().zip(whole.as_chunks().0) {
                    tile.coordinates[row] = *lanes;
                }
            } else {
                for (lane, &x) in array.iter().enumerate() {
                    tiles[lane / LANES].coordinates[row][lane % LANES] = x;
                }
            }
        }
    }

    #[inline(always)]
    fn positions(&self, index: usize) -> Positions {
        let of = |i: usize| self.coordinates[i][index];
        let at = |i: usize| [of(i), of(i + 1), of(i + 2)];
        Positions {
            start: [at(0), at(3), at(6), at(9)],
            end: [at(12), at(15), at(18), at(21)],
        }
    }

    #[inline(always)]
    fn radius(&self, index: usize) -> Radius {
        self.radii.get(index).copied().unwrap_or(Radius::ZERO)
    }

    fn are_thin(&self, queries: Range<usize>) -> bool {
        let radii = self.radii.get(queries).unwrap_or_default();
        radii.iter().all(Radius::is_zero)
    }
}

/// Why arrays are not a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BatchError {
    /// An array is not as long as the first.
    Length {
        /// Which of the 24 arrays.
        array: usize,
        /// How long it is.
        found: usize,
        /// How long the first is.
        expected: usize,
    },
    /// The radius is NaN, infinite or negative.
    Radius(Radius),
    /// A coordinate is not a finite number.
    Query {
        /// Which query, from 0.
        index: usize,
        /// What is wrong with it.
        error: QueryError,
    },
}

impl std::fmt::Display for BatchError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            BatchError::Length {
                array,
                found,
                expected,
            } => {
                write!(
                    f,
                    "array {array} has {found} numbers, the first has {expected}"
                )
            }
            BatchError::Radius(radius) => QueryError::Radius(*radius).fmt(f),
            BatchError::Query { index, error } => write!(f, "query {index}: {error}"),
        }
    }
}

impl std::error::Error for BatchError {}
