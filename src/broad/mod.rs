//! The broad phase: which pairs of moving things may meet during a step.
//!
//! Whatever moves gets a box that holds it for the whole step ([`Aabb::swept`]). A [`BroadPhase`]
//! keeps such boxes as items and names every pair of which the boxes have a point in common, once
//! and in order. How it searches is chosen by a [`Method`]: sweep-and-prune (`sweep`), hierarchical
//! grid (`grid`), or every pair of all (`brute`), by which the others are tested. All methods name
//! the same pairs, bit for bit: none has a tolerance.
//!
//! No method rests on what it remembers: from one search to the next it keeps a place to start
//! from, never a result. Whatever the boxes are (infinite, without extent, all the same) a search
//! ends, and takes at worst the time that asking about every pair would take, times a constant.
//!
//! [`SlowPairs`] is a layer above: of the pairs found, it leaves out those that are provably too
//! far apart to meet for as far as they move.
//!
//! Bounds are rounded outward throughout: the neighbour (`next_up`, `next_down`) of a rounded
//! result lies beyond the exact one, overflow and underflow included.
//!
//! Source: the thesis, 2.3.1 and 3.2.3; Ericson, Real-Time Collision Detection, 7.2 and 7.5.
//!
//! ```
//! use tunnelproof::broad::{Aabb, BroadPhase, Method};
//! use tunnelproof::query::Point;
//!
//! let mut broad = BroadPhase::new(Method::SweepAndPrune);
//! let still = [Point::new(0.0, -1.0, 0.0), Point::new(0.0, 1.0, 0.0)];
//! let [from, to] = [0.5, -0.5].map(|z| [Point::new(-1.0, 0.0, z), Point::new(1.0, 0.0, z)]);
//! let resting = broad.insert(Aabb::swept(&still, &still, 0.01)?);
//! let falling = broad.insert(Aabb::swept(&from, &to, 0.01)?);
//! let pairs = broad.pairs(|_| true);
//! assert_eq!((pairs[0].first(), pairs[0].second()), (resting, falling));
//! # Ok::<(), tunnelproof::broad::BroadError>(())
//! ```

mod aabb;
mod brute;
mod error;
mod grid;
mod item_id;
mod items;
mod phase;
mod separation;
mod slow;
mod sweep;
#[cfg(test)]
mod tests;

pub use aabb::Aabb;
pub use error::BroadError;
pub use item_id::ItemId;
pub use items::Pair;
pub use phase::{BroadPhase, Method};
#[cfg(feature = "recording")]
pub(crate) use slow::Placed;
pub use slow::{Exclusions, SlowPairs};
