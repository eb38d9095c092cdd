//! The step of pairs by index.

use std::ops::Range;
use std::ptr;

use super::block::{CHUNK, Source};
use super::kind::Kind;
use super::pairs::{Indexed, Pairs, PairsError, Radii};
use super::queries::MayTouch;
use super::step::{Blocked, Clearance, Limit, Precision};
use super::together::{Moved, PairMotion, Together};
use crate::environment;
use crate::parallel::mapped_with;
use crate::query::{Coordinate, EdgeEdge, QueryKind, Radius, VertexFace};

/// A step of all points that is proved, with positions in `f64`, or in `f32` for `C`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PairsStep<C = f64> {
    /// How much of the step is made, from 0 to 1.
    pub step: f64,
    /// The positions to store, of all points: those of [`interpolate_in`](super::interpolate_in) at
    /// this step, in the precision of their type, so the end itself at 1 and the start at 0.
    pub positions: Vec<[C; 3]>,
    /// The pairs for which the step is no larger, edges first, in order; none if it is a whole one.
    pub limits: Vec<PairsLimit>,
    /// The pairs that keep less than they should, as they start nearer than that or as rounding leaves
    /// no room for more, in order, with what they keep.
    pub near: Vec<(ListedPair, Radius)>,
}

/// A pair that ends a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PairsLimit {
    /// The pair.
    pub pair: ListedPair,
    /// Why it does.
    pub blocked: Blocked,
}

/// A pair by its place in the list of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ListedPair {
    /// Which list.
    pub kind: QueryKind,
    /// The place in it, from 0.
    pub index: usize,
}

/// The largest step, nearly, that keeps all pairs apart by more than their radius and a clearance,
/// and the positions to store. How nearly is said at [`advance`](super::advance).
///
/// Both lists are of the same points. One of them may be empty. Positions that are given in `f32` are
/// returned in `f32`, and what is proved of them is as exact. There is less room then: two sides that
/// are nearer than some 2^-21 of their coordinates, beyond what they keep, may be [`Blocked::Rounding`].
///
/// # Guarantee
///
/// Straight motion of all points from the start to [`PairsStep::positions`] keeps each pair that does
/// not touch at the start farther apart than its radius and the clearance, exactly, in real
/// arithmetic. A pair that starts nearer
/// than that keeps nine tenths of what it has beyond the radius, or of its distance if it starts
/// within the radius; where rounding leaves no room even for that, it keeps the radius, or does not
/// touch. [`PairsStep::near`] names such pairs. They are free to part. With [`Clearance::Share`] a
/// pair that would come within the radius keeps that share of what it has beyond it.
///
/// A pair that is in neither list stays apart as well, if the boxes around its two sides are farther
/// apart, along an axis, than its radius and a [`Clearance::Distance`]. The box of a side is that
/// around all its points both at the start and at the end. Stored positions are in these boxes. That is
/// what the broad phase has to see to, with its rounding outward. The next step starts at the stored
/// positions, with new lists: then nothing passes through anything in these pairs, however many steps
/// follow. The preconditions are those of [`decide`](super::decide).
///
/// The step is 0 if a pair touches at the start, radius or not, or if rounding leaves no room to any
/// step tried: [`PairsStep::limits`] names the pairs. Two sides that share a point touch always:
/// leave them out of the lists. Where [`Blocked::Rounding`] ends a step, it may be as small as some
/// rounding errors, so do not wait for 0. Part these pairs, or let them move otherwise.
///
/// # Errors
///
/// [`PairsError`] if the lists are not of the same positions, or the clearance is not a finite
/// distance of 0 or more, or a share from 0 to below 1.
///
/// # Example
///
/// ```
/// use tunnelproof::{Clearance, Pairs, advance_pairs};
///
/// // A hair above another one, and a vertex above a face, all of which fall.
/// let start = [
///     [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, -1.0, 1.0], [0.5, 1.0, 1.0],
///     [2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 1.0, 0.0], [2.2, 0.3, 0.7],
/// ];
/// let mut end = start;
/// for point in [2, 3, 7] {
///     end[point][2] -= 1.5;
/// }
/// let edges = Pairs::new(&start, &end, &[[0, 1, 2, 3]], 0.01)?;
/// let faces = Pairs::new(&start, &end, &[[7, 4, 5, 6]], 0.01)?;
/// let moved = advance_pairs(&edges, &faces, Clearance::None)?;
/// // The vertex stops just above the face, and the hair as early.
/// assert!(moved.positions[7][2] > 0.01 && moved.positions[7][2] < 0.010001);
/// assert!((moved.step - 0.46).abs() < 1e-6);
/// // The next step starts there.
/// let rest = Pairs::<tunnelproof::EdgeEdge>::new(&start, &moved.positions, &[[0, 1, 2, 3]], 0.01)?;
/// assert!(rest.decide().is_empty());
/// # Ok::<(), tunnelproof::PairsError>(())
/// ```
pub fn advance_pairs<C: Coordinate>(
    edges: &Pairs<EdgeEdge, C>,
    faces: &Pairs<VertexFace, C>,
    clearance: Clearance,
) -> Result<PairsStep<C>, PairsError> {
    let clearance = clearance.checked()?;
    let (edges, faces) = (&edges.indexed, &faces.indexed);
    let are_same = |a: &[[C; 3]], b: &[[C; 3]]| ptr::eq(a, b) || a == b;
    if !are_same(edges.start, faces.start) || !are_same(edges.end, faces.end) {
        return Err(PairsError::Positions);
    }
    let mut close = close_pairs::<EdgeEdge, C>(edges, QueryKind::EdgeEdge, clearance);
    close.extend(close_pairs::<VertexFace, C>(
        faces,
        QueryKind::VertexFace,
        clearance,
    ));
    let together = Together {
        start: edges.start,
        end: edges.end,
        motion: &|pair: &ListedPair| match pair.kind {
            QueryKind::EdgeEdge => motion(edges, pair),
            QueryKind::VertexFace => motion(faces, pair),
        },
    };
    let Moved {
        step,
        positions,
        limits,
        near,
    } = together.moved(close);
    let limits = limits.into_iter();
    Ok(PairsStep {
        step,
        positions,
        limits: limits
            .map(|(pair, blocked)| PairsLimit { pair, blocked })
            .collect(),
        near,
    })
}

/// The limits of the pairs of a list that may come too near.
fn close_pairs<K: Kind, C: Coordinate>(
    indexed: &Indexed<C>,
    kind: QueryKind,
    clearance: Clearance,
) -> Vec<(ListedPair, Option<Limit>)> {
    let count = indexed.indices.len();
    let screen = || Box::new(MayTouch::new());
    let parts = mapped_with(count.div_ceil(PART), screen, |screen, part| {
        // By each thread that takes a part.
        debug_assert_eq!(environment::check(), Ok(()));
        let mut close = Vec::new();
        let pairs = part * PART..count.min((part + 1) * PART);
        for first in pairs.clone().step_by(CHUNK) {
            let chunk = first..pairs.end.min(first + CHUNK);
            ask::<K, C>(indexed, chunk, clearance, screen, |index| {
                let pair = ListedPair { kind, index };
                let radius = indexed.radius(index);
                let motion = motion(indexed, &pair);
                close.push((pair, motion.limit(radius, clearance, Precision::of::<C>())));
            });
        }
        close
    });
    parts.concat()
}

/// Calls `each` for pairs, of a chunk, of which rounded positions at any step may come too near.
fn ask<K: Kind, C: Coordinate>(
    indexed: &Indexed<C>,
    chunk: Range<usize>,
    clearance: Clearance,
    screen: &mut MayTouch,
    mut each: impl FnMut(usize),
) {
    let beyond = match clearance {
        Clearance::Distance(distance) => distance,
        _ => 0.0,
    };
    let mut radii = [Radius::ZERO; CHUNK];
    for (radius, pair) in radii.iter_mut().zip(chunk.clone()) {
        *radius = indexed.radius(pair).beyond(beyond);
    }
    let (first, count) = (chunk.start, chunk.len());
    let source = Indexed {
        indices: &indexed.indices[chunk],
        radii: Radii::Each(&radii[..count]),
        ..*indexed
    };
    screen.with_room::<K>(&source, count, Precision::of::<C>(), |place| {
        each(first + place)
    });
}

fn motion<C: Coordinate>(indexed: &Indexed<C>, pair: &ListedPair) -> PairMotion {
    PairMotion {
        kind: pair.kind,
        positions: indexed.positions(pair.index),
    }
}

/// How many pairs a thread takes at a time.
const PART: usize = 4096;
