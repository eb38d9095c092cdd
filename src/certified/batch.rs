//! Many queries at once, coordinates in separate arrays.
//!
//! The first stages of the cascade are arithmetic without branches, so over arrays the compiler does
//! several queries in one instruction. What they leave goes through the rest one by one.

use super::cascade::{self, Stage};
use super::cubic::Cubic;
use super::motion::{Motion, Positions};
use super::separate::SweptBoxes;
use super::verdict::Verdict;
use crate::narrow::Unsupported;
use crate::query::{EdgeEdge, Point, QueryError};

/// Edge-edge queries of radius 0 as a structure of arrays.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Coordinate `3 p + i` is axis `i` of point `p`: A, B, C, D at `t = 0`, then at `t = 1`.
    coordinates: [Vec<f64>; 24],
}

/// How many queries go through a stage together: their coordinates fit in the first-level cache.
const BLOCK: usize = 64;

impl Batch {
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
    }

    /// Adds a query.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] for a radius above 0.
    pub fn push(&mut self, query: &EdgeEdge) -> Result<(), Unsupported> {
        if query.radius() != 0.0 {
            return Err(Unsupported::Radius(query.radius()));
        }
        let points = query.start().iter().chain(query.end());
        let values = points.flat_map(|point| [point.x, point.y, point.z]);
        for (array, value) in self.coordinates.iter_mut().zip(values) {
            array.push(value);
        }
        Ok(())
    }

    /// The queries of whole arrays, of which `3 p + i` holds axis `i` of point `p`: A, B, C, D at
    /// `t = 0`, then at `t = 1`.
    ///
    /// # Errors
    ///
    /// [`BatchError`] if the arrays differ in length or hold a number that is not finite.
    pub fn from_arrays(coordinates: [Vec<f64>; 24]) -> Result<Self, BatchError> {
        let batch = Batch { coordinates };
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
            batch
                .query(index)
                .map_err(|error| BatchError::Query { index, error })?;
        }
        Ok(batch)
    }

    /// Decides every query, in order; see [`decide`](super::decide).
    pub fn decide(&self, mut verdict: impl FnMut(usize, Verdict)) {
        self.decide_observed(&mut verdict, &mut |_| {});
    }

    /// As [`decide`](Self::decide), and says which stage decided each query.
    pub fn decide_observed(
        &self,
        verdict: &mut impl FnMut(usize, Verdict),
        observe: &mut impl FnMut(Stage),
    ) {
        for start in (0..self.len()).step_by(BLOCK) {
            let end = (start + BLOCK).min(self.len());
            self.decide_block(start, end, verdict, observe);
        }
    }

    fn decide_block(
        &self,
        start: usize,
        end: usize,
        verdict: &mut impl FnMut(usize, Verdict),
        observe: &mut impl FnMut(Stage),
    ) {
        // A copy, which the compiler knows not to overlap with anything; what is beyond the end is 0.
        let mut block = [[0.0; BLOCK]; 24];
        for (copy, array) in block.iter_mut().zip(&self.coordinates) {
            copy[..end - start].copy_from_slice(&array[start..end]);
        }
        let mut decided_by = [OPEN; BLOCK];
        screen(&block, &mut decided_by);
        for (index, &stage) in (start..end).zip(&decided_by) {
            match SCREENS.get(usize::from(stage)) {
                Some(&stage) => {
                    observe(stage);
                    verdict(index, Verdict::Miss);
                }
                None => verdict(index, cascade::decide_rest(&self.positions(index), observe)),
            }
        }
    }

    #[inline(always)]
    fn positions(&self, index: usize) -> Positions {
        let at = |p: usize| [0, 1, 2].map(|i| self.coordinates[3 * p + i][index]);
        Positions {
            start: [0, 1, 2, 3].map(at),
            end: [4, 5, 6, 7].map(at),
        }
    }

    fn query(&self, index: usize) -> Result<EdgeEdge, QueryError> {
        let Positions { start, end } = self.positions(index);
        EdgeEdge::new(start.map(Point::from), end.map(Point::from), 0.0)
    }
}

/// The stages that [`screen`] runs, by the number it gives them.
const SCREENS: [Stage; 3] = [Stage::Boxes, Stage::Direction, Stage::Signs];

/// What [`screen`] leaves.
const OPEN: u8 = SCREENS.len() as u8;

/// The first stages for all queries of a block, without a branch.
#[inline(never)]
fn screen(block: &[[f64; BLOCK]; 24], decided_by: &mut [u8; BLOCK]) {
    let mut masks = [[false; BLOCK]; 3];
    for i in 0..BLOCK {
        let at = |p: usize| [block[3 * p][i], block[3 * p + 1][i], block[3 * p + 2][i]];
        let positions = Positions {
            start: [at(0), at(1), at(2), at(3)],
            end: [at(4), at(5), at(6), at(7)],
        };
        let boxes = SweptBoxes::new(&positions);
        let motion = Motion::new(&positions);
        masks[0][i] = boxes.are_disjoint;
        masks[1][i] = motion.is_separated_by_centres(&boxes);
    }
    for i in 0..BLOCK {
        let at = |p: usize| [block[3 * p][i], block[3 * p + 1][i], block[3 * p + 2][i]];
        let positions = Positions {
            start: [at(0), at(1), at(2), at(3)],
            end: [at(4), at(5), at(6), at(7)],
        };
        let cubic = Cubic::unchecked(&Motion::new(&positions));
        masks[2][i] = cubic.is_valid() & cubic.has_no_root();
    }
    for (i, stage) in decided_by.iter_mut().enumerate() {
        let first = (0..OPEN).find(|&mask| masks[usize::from(mask)][i]);
        *stage = first.unwrap_or(OPEN);
    }
}

/// Why arrays are not a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
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
            BatchError::Query { index, error } => write!(f, "query {index}: {error}"),
        }
    }
}

impl std::error::Error for BatchError {}
