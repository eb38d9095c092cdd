//! Every pair of all: right by inspection, so what the other methods are tested by; fast enough for
//! a few dozen items.

use super::items::{Items, Pair};

/// Calls `found` with every pair of which the boxes overlap.
pub(super) fn each_pair(items: &Items, found: &mut impl FnMut(Pair)) {
    let mut rest = items.iter();
    while let Some((first, aabb)) = rest.next() {
        for (second, other) in rest.clone() {
            if aabb.overlaps(other) {
                found(Pair::new(first, second));
            }
        }
    }
}
