//! Many queries at once, coordinates in separate arrays.
//!
//! The first stages of the cascade are taken for a block of queries at once (`block`); what they
//! leave goes through the rest one by one, with its coordinates from the block.

use std::marker::PhantomData;
use std::ops::Range;

use super::block::{BLOCK, Block};
use super::cascade::{decide_motion, decide_rest};
use super::kind::Kind;
use super::motion::Positions;
use super::stage::Stage;
use crate::contact::Hit;
use crate::environment;
use crate::query::{Point, QueryError, Radius, check};

/// How many blocks are not screened after one for which that did not pay.
const UNSCREENED: u32 = 15;

/// Queries of one kind, [`EdgeEdge`](crate::query::EdgeEdge) or
/// [`VertexFace`](crate::query::VertexFace), as a structure of arrays.
///
/// It is for candidate pairs as a broad phase delivers them, of which few touch. The answers are
/// those of [`decide`](super::decide), bit for bit.
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

    /// All hits with the places of their queries, in order.
    pub fn decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        let mut hits = Vec::new();
        self.decide_observed(|index, hit| hits.push((index, hit)), |_| {});
        hits
    }

    /// As [`decide`](Self::decide): calls `hit` for each hit, in order, and says for each query, in
    /// any order, which stage decided it. Allocates nothing.
    pub fn decide_observed(
        &self,
        hit: impl FnMut(usize, Hit<K::Place>),
        observe: impl FnMut(Stage),
    ) {
        self.decide_range(0..self.len(), hit, observe);
    }

    /// As [`decide`](Self::decide), by all threads of the current pool.
    #[cfg(feature = "rayon")]
    pub fn par_decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        use rayon::prelude::*;

        const CHUNK: usize = 16 * BLOCK;
        let starts = (0..self.len()).into_par_iter().step_by(CHUNK);
        let hits = starts.flat_map_iter(|start| {
            let mut hits = Vec::new();
            let end = self.len().min(start + CHUNK);
            self.decide_range(start..end, |index, hit| hits.push((index, hit)), |_| {});
            hits
        });
        hits.collect()
    }

    fn decide_range(
        &self,
        range: Range<usize>,
        mut hit: impl FnMut(usize, Hit<K::Place>),
        mut observe: impl FnMut(Stage),
    ) {
        // By each thread that takes a part.
        debug_assert_eq!(environment::check(), Ok(()));
        let mut block = Block::new();
        let mut unscreened = 0;
        for start in range.clone().step_by(BLOCK) {
            let end = range.end.min(start + BLOCK);
            let radii = self.radii.get(start..end).unwrap_or_default();
            block.fill(self.coordinates.each_ref().map(|array| &array[start..end]));
            // Blocks with and without a radius are screened, mixed ones are not.
            let is_thick = !radii.is_empty() && radii.iter().all(|radius| !radius.is_zero());
            let is_thin = radii.iter().all(Radius::is_zero);
            let is_screened = unscreened == 0 && (is_thick || is_thin);
            let pays = if !is_screened {
                unscreened = u32::saturating_sub(unscreened, 1);
                true
            } else if is_thick {
                block.fill_radii(radii);
                block.screen_thick::<K::Stages>(&mut observe)
            } else {
                block.screen::<K::Stages>(&mut observe)
            };
            if !pays {
                unscreened = UNSCREENED;
            }
            for (place, &i) in block.open().iter().enumerate() {
                let index = start + usize::from(i);
                let positions = || block.positions(place);
                let found = if is_screened && is_thin {
                    decide_rest::<K::Stages>(positions, &mut observe)
                } else {
                    decide_motion::<K::Stages>(positions, self.radius(index), &mut observe)
                };
                if let Some(found) = found {
                    hit(index, found);
                }
            }
        }
    }

    fn radius(&self, index: usize) -> Radius {
        self.radii.get(index).copied().unwrap_or(Radius::ZERO)
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
