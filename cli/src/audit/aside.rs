//! Wires moved aside by an infinitesimal, and how often two segments of them pass through each
//! other.
//!
//! Every node is moved by a vector times one infinitesimal. Nodes fixed to one point have one
//! vector, so what is fixed together stays together. In one half of the positions all other nodes
//! of a wire have one vector as well, and a wire against itself another one for the later one of
//! the two segments: what counts is the difference of the two. It does not depend on arc length,
//! which changes where wire slides over a contact node. In the other half free nodes have a vector
//! that is a cubic polynomial in arc length, so that what is straight, or slides along itself, does
//! not stay so. A node that comes to ride a body, or leaves it, jumps there by an infinitesimal; if
//! something touches it just then, the positions may differ, and that is ambiguous.

use tunnelproof::query::{EdgeEdge, Point};
use tunnelproof::wire::{NodeKind, SegmentId};

use super::first_contact;
use tunnelproof_reference::oracle::{passages_beside, passages_inside};

/// In how many positions passages are counted. Each second one is opposite to the one before.
pub(super) const POSITIONS: usize = 32;

/// Signed passages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passages {
    /// In each position; `None` where segments moved aside still touch at an end.
    pub(super) by_position: [Option<i64>; POSITIONS],
    /// Whether a contact is at the end of a wire, so that it may depend on the position.
    pub(super) at_end: bool,
}

/// A node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Arc length in m.
    pub(super) arc: f64,
    pub(super) kind: NodeKind,
    pub(super) at: Point,
}

/// A segment and what fixes its ends at the start and at the end of a motion.
#[derive(Clone, Copy)]
pub(super) struct Held {
    pub(super) id: SegmentId,
    pub(super) ends: [[Node; 2]; 2],
    /// Whether its first node is the first of the wire, and its last the last.
    pub(super) is_last: [bool; 2],
}

/// The passages of two segments whose motion is this query, each with its own points of it.
pub(super) fn passages(query: &EdgeEdge, two: [Held; 2]) -> Passages {
    if let Some(passages) = passages_inside(query) {
        return Passages {
            by_position: [Some(passages); POSITIONS],
            at_end: false,
        };
    }
    let is_later = |k: usize| two[k].id.wire == two[1 - k].id.wire && two[k].id > two[1 - k].id;
    let by_position = std::array::from_fn(|position| {
        let of = |time: usize, k: usize, end: usize| {
            let (wire, node) = (two[k].id.wire.0, &two[k].ends[time][end]);
            offset(position, [wire as u64, u64::from(is_later(k))], node)
        };
        let four = |time| {
            [
                of(time, 0, 0),
                of(time, 0, 1),
                of(time, 1, 0),
                of(time, 1, 1),
            ]
        };
        passages_beside(query, &[0, 1].map(four))
    });
    let at_end = [0, 1, 2, 3]
        .into_iter()
        .any(|k| two[k / 2].is_last[k % 2] && is_met(query, k));
    Passages {
        by_position,
        at_end,
    }
}

/// Whether A, B, C or D, by number, meets the other edge.
fn is_met(query: &EdgeEdge, which: usize) -> bool {
    let alone = |points: &[Point; 4]| {
        let mut points = *points;
        points[which ^ 1] = points[which];
        points
    };
    let query = EdgeEdge::new(alone(query.start()), alone(query.end()), 0.0);
    query.is_ok_and(|query| first_contact(query).is_some())
}

/// The vector of a node of a wire in a position.
fn offset(position: usize, [wire, later]: [u64; 2], node: &Node) -> [i64; 3] {
    let by_arc = position >= POSITIONS / 2 && node.kind == NodeKind::Free;
    match fixed(node) {
        Some(place) => vector(position, place),
        None if by_arc => {
            let powers = [0, 1, 2, 3].map(|k| {
                let size = node.arc.powi(k as i32);
                vector(position, [wire, 2, k, 0]).map(|x| (x as f64 * size).round() as i64)
            });
            [0, 1, 2].map(|h| powers.iter().map(|power| power[h]).sum())
        }
        None => vector(position, [wire, later, 0, 0]),
    }
}

/// The point that a node is fixed to for good.
fn fixed(Node { kind, at, .. }: &Node) -> Option<[u64; 4]> {
    // 0 and -0 are one point.
    let bits = |x: f64| (x + 0.0).to_bits();
    let of = |carrier: u64, point: [f64; 3]| {
        let [x, y, z] = point.map(bits);
        [!carrier, x, y, z]
    };
    match *kind {
        NodeKind::Pinned => Some(of(0, [at.x, at.y, at.z])),
        NodeKind::Eye { body, local } => Some(of(body.0 as u64 + 1, local.into())),
        _ => None,
    }
}

/// The vector of a place, or of a wire, in a position.
fn vector(position: usize, place: [u64; 4]) -> [i64; 3] {
    const BITS: u32 = 24;
    let seed = place
        .into_iter()
        .fold(position as u64 / 2, |seed, word| mixed(seed ^ mixed(word)));
    let opposite = if position.is_multiple_of(2) { 1 } else { -1 };
    let component = |k: u64| {
        let (low, size) = (-(1i64 << (BITS - 1)), 1u64 << BITS);
        opposite * (low + (mixed(seed.wrapping_add(k)) % size) as i64)
    };
    [1, 2, 3].map(component)
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
fn mixed(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
