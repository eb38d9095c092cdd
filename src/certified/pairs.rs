//! Pairs of moving points that share positions by their indices.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use super::block::{CHUNK, COORDINATES, LANES, SingleTile, Source, Tile};
use super::kind::{Kind, Stages};
use super::motion::Positions;
use super::queries;
use super::stage::Stage;
use super::step::{Clearance, ClearanceError};
use crate::contact::Hit;
use crate::query::{Coordinate, Counted, QueryError, Radius, first_not_finite, widened};

/// Queries of one kind, [`EdgeEdge`](crate::EdgeEdge) or [`VertexFace`](crate::VertexFace), whose
/// points are given by their indices into arrays of positions: candidate pairs as the broad phase
/// of a mesh or of wires delivers them.
///
/// Nothing is copied. The answers are those of [`decide`](super::decide), bit for bit.
/// [`advance_pairs`](super::advance_pairs) gives positions to store.
///
/// Leave out pairs whose sides share a point, such as neighbouring edges: they touch at time 0.
///
/// Positions are `f64`, or `f32` for `C`: `Pairs::<EdgeEdge, f32>::new(…)`. What is decided of `f32` is as
/// exact; [`Hit::toi_f32`] rounds the time down to one.
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
/// // The points and the normal of a contact are asked of its query.
/// let query = pairs.get(*index).expect("it is one of them");
/// assert!((hit.points(&query).0.point.x - 0.5).abs() < 1e-9);
/// # Ok::<(), tunnelproof::PairsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pairs<'a, K, C = f64> {
    pub(super) indexed: Indexed<'a, C>,
    kind: PhantomData<fn() -> K>,
}

/// Queries by the indices of their points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Indexed<'a, C = f64> {
    pub(crate) start: &'a [[C; 3]],
    pub(crate) end: &'a [[C; 3]],
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

impl<'a, K: Kind, C: Coordinate> Pairs<'a, K, C> {
    /// Pairs with the same radius: the indices of A, B, C and D of each, and the positions in metres
    /// at `t = 0` and at `t = 1`.
    ///
    /// The radius is the distance at which two sides touch, such as the sum of the radii of two
    /// wires. That is what [`Mesh`](crate::Mesh) calls the thickness.
    ///
    /// All positions are looked at, also those that no pair has: they have to be finite, and for a
    /// few pairs of many positions this takes longest.
    ///
    /// # Errors
    ///
    /// [`PairsError`] if the arrays of positions differ in length, a coordinate or the radius is not
    /// a finite number, the radius is below 0, or an index is not that of a position.
    pub fn new(
        start: &'a [[C; 3]],
        end: &'a [[C; 3]],
        indices: &'a [[u32; 4]],
        radius: impl Into<Radius>,
    ) -> Result<Self, PairsError> {
        Self::checked(start, end, indices, Radii::Same(radius.into()))
    }

    /// The same with a radius for each pair: `r.into()` of a number, `[r, s].into()` of the exact sum
    /// of two.
    ///
    /// Pairs with a radius above 0 and pairs without one are decided faster in two lists: side by side, all
    /// go through the stages for a radius first.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new), and if there are not as many radii as pairs.
    pub fn with_radii(
        start: &'a [[C; 3]],
        end: &'a [[C; 3]],
        indices: &'a [[u32; 4]],
        radii: &'a [Radius],
    ) -> Result<Self, PairsError> {
        Self::checked(start, end, indices, Radii::Each(radii))
    }

    fn checked(
        start: &'a [[C; 3]],
        end: &'a [[C; 3]],
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

    /// The query of a pair, if there is one: a copy, for the [points](Hit::points) and the
    /// [normal](Hit::normal) of a hit.
    pub fn get(&self, pair: usize) -> Option<K> {
        let query = || K::Stages::query(&self.indexed.positions(pair), self.indexed.radius(pair));
        (pair < self.len()).then(query)
    }

    /// Some of the pairs, if there are all of these; their places are counted from the first of
    /// them. Nothing is checked again: for an engine with threads of its own. Make parts of some thousand
    /// pairs: of 32, each pair takes half as long again. Steps of parts are no step of the whole.
    pub fn part(&self, pairs: Range<usize>) -> Option<Self> {
        let Indexed {
            start,
            end,
            indices,
            radii,
        } = self.indexed;
        let indexed = Indexed {
            start,
            end,
            indices: indices.get(pairs.clone())?,
            radii: match radii {
                Radii::Same(radius) => Radii::Same(radius),
                Radii::Each(radii) => Radii::Each(radii.get(pairs)?),
            },
        };
        let kind = PhantomData;
        Some(Pairs { indexed, kind })
    }

    /// All hits with the places of their pairs, in order. Fewer than 16 pairs are decided one by one, as
    /// several at once take longer then.
    pub fn decide(&self) -> Vec<(usize, Hit<K::Place>)> {
        queries::decide::<K::Stages>(&self.indexed, self.len())
    }

    /// As [`decide`](Self::decide): calls `hit` for each hit, in order, and says for each pair, in
    /// any order, which stage decided it. Allocates nothing, but where
    /// coordinates span so many powers of two that integers need the heap.
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

impl<C: Coordinate> Indexed<'_, C> {
    /// Puts the coordinates of a group of pairs, counted from the first of the chunk, into the lanes
    /// of the rows of its tile: a row of a group is one write.
    #[inline(always)]
    fn load_group<T: Copy>(
        &self,
        rows: &mut [[T; LANES]; COORDINATES],
        group: usize,
        [p, q, r, s]: &[[u32; 4]; GROUP],
        of: impl Fn(C) -> T,
    ) {
        let lane = group * GROUP % LANES;
        let end = &self.end[..self.start.len()];
        for point in 0..4 {
            let at = |pair: &[u32; 4]| pair[point] as usize;
            let (p, q, r, s) = (at(p), at(q), at(r), at(s));
            for (first, positions) in [(0, self.start), (12, end)] {
                let (p, q, r, s) = (&positions[p], &positions[q], &positions[r], &positions[s]);
                for axis in 0..3 {
                    let lanes = &mut rows[first + 3 * point + axis][lane..][..GROUP];
                    lanes.copy_from_slice(&[of(p[axis]), of(q[axis]), of(r[axis]), of(s[axis])]);
                }
            }
        }
    }
}

/// How many pairs are read at once.
const GROUP: usize = 4;

/// Fewer pairs than a group, and the first of them in the lanes that are left.
#[inline(always)]
fn filled(rest: &[[u32; 4]]) -> [[u32; 4]; GROUP] {
    let mut all = [rest[0]; GROUP];
    all[..rest.len()].copy_from_slice(rest);
    all
}

impl<C: Coordinate> Source for Indexed<'_, C> {
    #[inline(always)]
    fn load(&self, tiles: &mut [Tile; CHUNK / LANES], queries: Range<usize>) {
        let (whole, rest) = self.indices[queries].as_chunks();
        for (group, indices) in whole.iter().enumerate() {
            let rows = &mut tiles[group * GROUP / LANES].coordinates;
            self.load_group(rows, group, indices, C::into);
        }
        if !rest.is_empty() {
            let group = whole.len();
            let rows = &mut tiles[group * GROUP / LANES].coordinates;
            self.load_group(rows, group, &filled(rest), C::into);
        }
    }

    const IS_SINGLE: bool = C::IS_SINGLE;

    #[inline(always)]
    fn load_single(&self, tiles: &mut [SingleTile; CHUNK / LANES], queries: Range<usize>) {
        let (whole, rest) = self.indices[queries].as_chunks();
        for (group, indices) in whole.iter().enumerate() {
            let rows = &mut tiles[group * GROUP / LANES];
            self.load_group(rows, group, indices, C::single);
        }
        if !rest.is_empty() {
            let group = whole.len();
            let rows = &mut tiles[group * GROUP / LANES];
            self.load_group(rows, group, &filled(rest), C::single);
        }
    }

    #[inline(always)]
    fn positions(&self, query: usize) -> Positions {
        let of = |all: &[[C; 3]]| self.indices[query].map(|index| widened(&all[index as usize]));
        Positions {
            start: of(self.start),
            end: of(self.end),
        }
    }

    #[inline(always)]
    fn radius(&self, query: usize) -> Radius {
        match self.radii {
            Radii::Same(radius) => radius,
            Radii::Each(radii) => radii[query],
        }
    }

    fn are_thin(&self, queries: Range<usize>) -> bool {
        match self.radii {
            Radii::Same(radius) => radius.is_zero(),
            Radii::Each(radii) => radii[queries].iter().all(Radius::is_zero),
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
    /// The pairs of a step are not of the same positions.
    Positions,
    /// The clearance of a step has no meaning.
    Clearance(Clearance),
}

impl From<ClearanceError> for PairsError {
    fn from(ClearanceError(clearance): ClearanceError) -> Self {
        PairsError::Clearance(clearance)
    }
}

impl fmt::Display for PairsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            PairsError::Length {
                array,
                found,
                expected,
            } => {
                let entries = Counted(found, "entry", "entries");
                write!(f, "{array} has {entries}, and ")?;
                match array {
                    "radii" => {
                        let pairs = Counted(expected, "pair", "pairs");
                        write!(f, "there {} {pairs}", pairs.verb())
                    }
                    _ => write!(f, "start has {expected}"),
                }
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
                let point = ['A', 'B', 'C', 'D'][corner];
                let verb = Counted(points, "", "").verb();
                write!(
                    f,
                    "pair {pair}: point {point} is position {index}, and there {verb} {points}, \
                     counted from 0"
                )
            }
            PairsError::Radius { pair, radius } => {
                if let Some(pair) = pair {
                    write!(f, "pair {pair}: ")?;
                }
                QueryError::Radius(radius).fmt(f)
            }
            PairsError::Positions => {
                f.write_str("edges and faces are lists of different positions")
            }
            PairsError::Clearance(clearance) => ClearanceError(clearance).fmt(f),
        }
    }
}

impl std::error::Error for PairsError {}
