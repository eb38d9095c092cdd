//! The order in which the nodes of a wire are eliminated.

use std::ops::Range;

/// Runs of at most this many nodes are eliminated from one end to the other.
const LEAF: usize = 6;

/// Nested dissection of a chain: both halves, then the node between them (George, SIAM J. Numer.
/// Anal. 10, 1973). Fill stays proportional to the length, and the path from a node to the last one
/// grows with its logarithm only, which is what a contact costs.
pub(in crate::wire) fn dissect(run: Range<usize>, order: &mut Vec<usize>) {
    if run.len() <= LEAF {
        order.extend(run);
        return;
    }
    let middle = run.start + run.len() / 2;
    dissect(run.start..middle, order);
    dissect(middle + 1..run.end, order);
    order.push(middle);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dissection_visits_every_node_once_and_separators_last() {
        for length in [0, 1, 6, 7, 8, 100, 1023] {
            let mut order = Vec::new();
            dissect(5..5 + length, &mut order);
            assert_eq!(order.len(), length);
            if length > LEAF {
                assert_eq!(order[length - 1], 5 + length / 2);
            }
            order.sort_unstable();
            assert!(order.into_iter().eq(5..5 + length));
        }
    }
}
