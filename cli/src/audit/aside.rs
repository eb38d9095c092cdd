//! Wires moved aside by an infinitesimal, and how often two segments of them pass through each
//! other.
//!
//! Every node is moved by a vector times one infinitesimal. Nodes fixed to one point have one
//! vector, the others have that of their wire. So wires stay wires, and what is fixed together
//! stays together. It does not depend on arc length, which changes where wire slides over a contact
//! node. A wire against itself has another vector for the later one of the two segments: what
//! counts is the difference of the two.

use tunnelproof::query::{EdgeEdge, Point};
use tunnelproof::wire::{NodeKind, SegmentId};

use tunnelproof_reference::oracle::{passages_beside, passages_inside};

/// In how many positions passages are counted. Each second one is opposite to the one before.
pub(super) const POSITIONS: usize = 16;

/// Signed passages in each position; `None` where segments moved aside still touch at an end.
pub(super) type Passages = [Option<i64>; POSITIONS];

/// A segment and what fixes its ends at the start and at the end of a motion.
#[derive(Clone, Copy)]
pub(super) struct Held {
    pub(super) id: SegmentId,
    pub(super) ends: [[(NodeKind, Point); 2]; 2],
}

/// The passages of two segments whose motion is this query, each with its own points of it.
pub(super) fn passages(query: &EdgeEdge, two: [Held; 2]) -> Passages {
    if let Some(passages) = passages_inside(query) {
        return [Some(passages); POSITIONS];
    }
    let is_later = |k: usize| two[k].id.wire == two[1 - k].id.wire && two[k].id > two[1 - k].id;
    let wire = |k: usize| [two[k].id.wire.0 as u64, u64::from(is_later(k)), 0, 0];
    std::array::from_fn(|position| {
        let of = |time: usize, k: usize, end: usize| {
            let fixed = fixed(two[k].ends[time][end]);
            offset(position, fixed.unwrap_or_else(|| wire(k)))
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
    })
}

/// The point that a node is fixed to for good.
fn fixed((kind, at): (NodeKind, Point)) -> Option<[u64; 4]> {
    // 0 and -0 are one point.
    let bits = |x: f64| (x + 0.0).to_bits();
    let of = |carrier: u64, point: [f64; 3]| {
        let [x, y, z] = point.map(bits);
        [!carrier, x, y, z]
    };
    match kind {
        NodeKind::Pinned => Some(of(0, [at.x, at.y, at.z])),
        NodeKind::Eye { body, local } => Some(of(body.0 as u64 + 1, local.into())),
        _ => None,
    }
}

/// The vector of a place in a position.
fn offset(position: usize, place: [u64; 4]) -> [i64; 3] {
    const BITS: u32 = 16;
    let seed = place
        .into_iter()
        .fold(position as u64 / 2, |seed, word| mixed(seed ^ mixed(word)));
    let opposite = if position % 2 == 0 { 1 } else { -1 };
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
