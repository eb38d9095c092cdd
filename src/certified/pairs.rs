//! Pairs of moving points that share positions by their indices.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use super::block::{CHUNK, LANES, Source, Tile};
use super::kind::Kind;
use super::queries;
use super::stage::Stage;
use crate::contact::Hit;
use crate::query::{Counted, QueryError, Radius, first_not_finite};

/// Queries of one kind, [`EdgeEdge`](crate::EdgeEdge) or [`VertexFace`](crate::VertexFace), whose
/// points are given by their indices into arrays of positions: candidate pairs as the broad phase
/// of a mesh or of wires delivers them.
///
/// Nothing is copied. The answers are those of [`decide`](super::decide), bit for bit.
///
/// ```
/// use tunnelproof::{EdgeEdge, Pairs};
///
/// let start = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, -1.0, 1.0], [0.5, 1.0, 1.0]];
/// let mut end = start;
/// end[2][2] = -2.0;
/// end[3][2] = -2.0;
/// let pairs = Pairs::<EdgeEdge>::new(&start, &end, &[[0, 1, 2, 3]], 0.0)?;
/// let hits = pairs.decide();
/// let [(index, hit)] = &hits[..] else { panic!("they cross") };
/// assert_eq!(*index, 0);
/// assert!(hit.toi <= 1.0 / 3.0 && 1.0 / 3.0 <= hit.toi_above);
/// # Ok::<(), tunnelproof::PairsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pairs<'a, K> {
    indexed: Indexed<'a>,
    kind: PhantomData<fn() -> K>,
}

/// Queries by the indices of their points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Indexed<'a> {
    pub(crate) start: &'a [[f64; 3]],
    pub(crate) end: &'a [[f64; 3]],
    /// Of A, B, C and D, of each query.
    pub(crate) indices: &'a [[u32; 4]],
    pub(crate) radii: Radii<'a>,
}

/// The radii of queries.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Radii<'a> {
    Same(Radius),
    Each(&'a [Radius]),
}

impl<'a, K: Kind> Pairs<'a, K> {
    /// Pairs with the same radius: the indices of A, B, C and D of each, and the positions in metres
    /// at `t = 0` and at `t = 1`.
    ///
    /// # Errors
    ///
    /// [`PairsError`] if the arrays of positions differ in length, a coordinate or the radius is not
    /// a finite number, the radius is below 0, or an index is not that of a position.
    pub fn new(
        start: &'a [[f64; 3]],
        end: &'a [[f64; 3]],
        indices: &'a [[u32; 4]],
        radius: impl Into<Radius>,
    ) -> Result<Self, PairsError> {
        Self::checked(start, end, indices, Radii::Same(radius.into()))
    }

    /// The same with a radius for each pair.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new), and if there are not as many radii as pairs.
    pub fn with_radii(
        start: &'a [[f64; 3]],
        end: &'a [[f64; 3]],
        indices: &'a [[u32; 4]],
        radii: &'a [Radius],
    ) -> Result<Self, PairsError> {
        Self::checked(start, end, indices, Radii::Each(radii))
    }

    fn checked(
        start: &'a [[f64; 3]],
        end: &'a [[f64; 3]],
        indices: &'a [[u32; 4]],
        radii: Radii<'a>,
    ) -> Result<Self, PairsError> {
        let (found, expected) = (end.len(), start.len());
        if found != expected {
            let array = "end";
            return Err(PairsError::Length {
                array,
                found,
                expected,
            });
        }
        for (array, positions) in [("start", start), ("end", end)] {
            if let Some((point, axis, value)) = first_not_finite(positions) {
                return Err(PairsError::NotFinite {
                    array,
                    point,
                    axis,
                    value,
                });
            }
        }
        for (pair, indices) in indices.iter().enumerate() {
            let is_beyond = |index: &u32| *index as usize >= expected;
            if let Some(corner) = indices.iter().position(is_beyond) {
                let (index, points) = (indices[corner], expected);
                return Err(PairsError::Index {
                    pair,
                    corner,
                    index,
                    points,
                });
            }
        }
        match radii {
            Radii::Same(radius) if !radius.is_valid() => {
                let pair = None;
                return Err(PairsError::Radius { pair, radius });
            }
            Radii::Same(_) => {}
            Radii::Each(radii) if radii.len() != indices.len() => {
                return Err(PairsError::Length {
                    array: "radii",
                    found: radii.len(),
                    expected: indices.len(),
                });
            }
            Radii::Each(radii) => {
                if let Some(pair) = radii.iter().position(|radius| !radius.is_valid()) {
                    let (radius, pair) = (radii[pair], Some(pair));
                    return Err(PairsError::Radius { pair, radius });
                }
            }
        }
        let indexed = Indexed {
            start,
            end,
            indices,
            radii,
        };
        let kind = PhantomData;
        Ok(Pairs { indexed, kind })
    }

    /// How many pairs there are.
    pub fn len(&self) -> usize {
        self.indexed.indices.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All hits with the places of their pairs, in order.
    pub fn decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        queries::decide::<K::Stages>(&self.indexed, self.len())
    }

    /// As [`decide`](Self::decide): calls `hit` for each hit, in order, and says for each pair, in
    /// any order, which stage decided it. Allocates nothing.
    pub fn decide_observed(
        &self,
        hit: impl FnMut(usize, Hit<K::Place>),
        observe: impl FnMut(Stage),
    ) {
        queries::decide_range::<K::Stages>(&self.indexed, 0..self.len(), hit, observe);
    }

    /// As [`decide`](Self::decide), by all threads of the current pool.
    #[cfg(feature = "rayon")]
    pub fn par_decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        queries::par_decide::<K::Stages>(&self.indexed, self.len())
    }
}

impl Source for Indexed<'_> {
    #[inline(always)]
    fn load(&self, tiles: &mut [Tile; CHUNK / LANES], queries: Range<usize>) {
        for (lane, indices) in self.indices[queries].iter().enumerate() {
            let coordinates = &mut tiles[lane / LANES].coordinates;
            for (point, &index) in indices.iter().enumerate() {
                let index = index as usize;
                for (at, positions) in [(0, self.start), (12, self.end)] {
                    for (axis, &x) in positions[index].iter().enumerate() {
                        coordinates[at + 3 * point + axis][lane % LANES] = x;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn radius(&self, query: usize) -> Radius {
        match self.radii {
            Radii::Same(radius) => radius,
            Radii::Each(radii) => radii[query],
        }
    }

    fn are_thin(&self, queries: Range<usize>) -> Option<bool> {
        match self.radii {
            Radii::Same(radius) => Some(radius.is_zero()),
            Radii::Each(radii) => queries::are_thin(&radii[queries]),
        }
    }
}

/// Why arrays are not pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PairsError {
    /// An array does not have the length of another one: `end` that of `start`, `radii` that of the
    /// indices.
    Length {
        /// Which one.
        array: &'static str,
        /// How long it is.
        found: usize,
        /// How long the other one is.
        expected: usize,
    },
    /// A coordinate is not a finite number.
    NotFinite {
        /// `start` or `end`.
        array: &'static str,
        /// Which point.
        point: usize,
        /// Which axis.
        axis: usize,
        /// The value.
        value: f64,
    },
    /// An index is not that of a position.
    Index {
        /// Which pair.
        pair: usize,
        /// Which of its points.
        corner: usize,
        /// The index.
        index: u32,
        /// How many positions there are.
        points: usize,
    },
    /// A radius is NaN, infinite or negative.
    Radius {
        /// Of which pair, if each has its own.
        pair: Option<usize>,
        /// The radius.
        radius: Radius,
    },
}

impl fmt::Display for PairsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            PairsError::Length {
                array,
                found,
                expected,
            } => {
                let (found, expected) = match array {
                    "radii" => (
                        Counted(found, "radius", "radii"),
                        Counted(expected, "pair", "pairs"),
                    ),
                    _ => (
                        Counted(found, "position at the end", "positions at the end"),
                        Counted(expected, "position at the start", "positions at the start"),
                    ),
                };
                write!(f, "{found}, and {expected}")
            }
            PairsError::NotFinite {
                array,
                point,
                axis,
                value,
            } => write!(
                f,
                "{array}[{point}][{axis}] is {value}, not a finite number"
            ),
            PairsError::Index {
                pair,
                corner,
                index,
                points,
            } => {
                let points = Counted(points, "position", "positions");
                let verb = points.verb();
                write!(
                    f,
                    "pair {pair}: index {corner} is {index}, and there {verb} {points}"
                )
            }
            PairsError::Radius { pair, radius } => {
                if let Some(pair) = pair {
                    write!(f, "pair {pair}: ")?;
                }
                QueryError::Radius(radius).fmt(f)
            }
        }
    }
}

impl std::error::Error for PairsError {}
