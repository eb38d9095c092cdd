//! Orders of elimination.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
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

/// Least degree: of the blocks of unknowns that are left, the one that is tied to the fewest
/// unknowns is next, and what it was tied to is then tied together (Tinney and Walker, Proc. IEEE
/// 55, 1967; George and Liu, SIAM Review 31, 1989). `ties` are the neighbours of each block,
/// ascending.
///
/// With the order, how many multiplications eliminating the blocks takes; none if that is more than
/// `most`.
pub(in crate::wire) fn least_degree(
    sizes: &[usize],
    mut ties: Vec<Vec<usize>>,
    most: usize,
) -> Option<(Vec<usize>, usize)> {
    let degree = |ties: &[usize]| ties.iter().map(|&block| sizes[block]).sum::<usize>();
    let degrees = ties.iter().map(|ties| degree(ties)).enumerate();
    // What is known to have another degree stays in there and is passed over.
    let mut open: BinaryHeap<_> = degrees
        .map(|(block, degree)| Reverse((degree, block)))
        .collect();
    let mut order = Vec::with_capacity(sizes.len());
    let mut is_done = vec![false; sizes.len()];
    let mut multiplications = 0;
    while let Some(Reverse((known, block))) = open.pop() {
        if is_done[block] || known != degree(&ties[block]) {
            continue;
        }
        multiplications += sizes[block] * (sizes[block] + known).pow(2);
        if multiplications > most {
            return None;
        }
        is_done[block] = true;
        order.push(block);
        let clique = std::mem::take(&mut ties[block]);
        for &other in &clique {
            let joined = union(&ties[other], &clique);
            let left = |tie: &usize| *tie != block && *tie != other;
            ties[other] = joined.into_iter().filter(left).collect();
            open.push(Reverse((degree(&ties[other]), other)));
        }
    }
    Some((order, multiplications))
}

/// Both lists, ascending, as one.
fn union(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut both = Vec::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    while let (Some(x), Some(y)) = (a.peek(), b.peek()) {
        let least = **x.min(y);
        both.push(least);
        a.next_if(|x| **x == least);
        b.next_if(|y| **y == least);
    }
    both.extend(a.chain(b));
    both
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

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

    /// Block by block, all pairs of those that are left looked at each time.
    fn least_degree_slowly(sizes: &[usize], ties: &[Vec<usize>]) -> (Vec<usize>, usize) {
        let n = sizes.len();
        let mut tied: Vec<Vec<bool>> = ties
            .iter()
            .map(|ties| (0..n).map(|block| ties.contains(&block)).collect())
            .collect();
        let mut left: Vec<usize> = (0..n).collect();
        let (mut order, mut multiplications) = (Vec::new(), 0);
        while !left.is_empty() {
            let degree = |block: usize| -> usize {
                let others = left.iter().filter(|&&other| tied[block][other]);
                others.map(|&other| sizes[other]).sum()
            };
            let next = left.iter().copied().min_by_key(|&block| degree(block));
            let next = next.expect("a block is left");
            multiplications += sizes[next] * (sizes[next] + degree(next)).pow(2);
            order.push(next);
            left.retain(|&block| block != next);
            for &a in &left {
                for &b in left.iter().filter(|&&b| b != a) {
                    tied[a][b] |= tied[next][a] && tied[next][b];
                }
            }
        }
        (order, multiplications)
    }

    #[test]
    fn least_degree_is_that_of_all_blocks_that_are_left() {
        let rng = &mut ChaCha8Rng::seed_from_u64(1);
        for _ in 0..200 {
            let n = rng.random_range(1..30);
            let sizes: Vec<usize> = (0..n).map(|_| rng.random_range(1..8)).collect();
            let density = rng.random_range(0.02..0.4);
            let mut ties = vec![Vec::new(); n];
            for a in 0..n {
                for b in a + 1..n {
                    if rng.random_bool(density) {
                        ties[a].push(b);
                        ties[b].push(a);
                    }
                }
            }
            ties.iter_mut().for_each(|ties| ties.sort_unstable());
            let (order, multiplications) = least_degree_slowly(&sizes, &ties);
            let enough = least_degree(&sizes, ties.clone(), multiplications);
            assert_eq!(enough, Some((order, multiplications)));
            assert_eq!(least_degree(&sizes, ties, multiplications - 1), None);
        }
    }

    #[test]
    fn least_degree_of_a_long_chain_takes_little() {
        let n = 100_000;
        let ties = (0..n).map(|k: usize| {
            let after = (k + 1 < n).then_some(k + 1);
            k.checked_sub(1).into_iter().chain(after).collect()
        });
        let order = least_degree(&vec![7; n], ties.collect(), n * 7 * 14 * 14);
        assert_eq!(order.map(|(order, _)| order.len()), Some(n));
    }
}
