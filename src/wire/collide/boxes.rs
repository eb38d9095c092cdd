//! The boxes of a numbered list of things in a broad phase.

use crate::broad::{Aabb, BroadError, BroadPhase, ItemId, Method, Pair};
use crate::wire::clock::Clock;

/// Thing `k` of the list is item `k`.
pub(super) struct Boxes {
    broad: BroadPhase,
    items: Vec<ItemId>,
    /// Wall-clock time in s of all calls.
    pub(super) seconds: f64,
}

impl Boxes {
    pub(super) fn new(method: Method) -> Self {
        Boxes {
            broad: BroadPhase::new(method),
            items: Vec::new(),
            seconds: 0.0,
        }
    }

    /// Gives every thing its box; returns the items.
    pub(super) fn place(
        &mut self,
        boxes: impl ExactSizeIterator<Item = Result<Aabb, BroadError>>,
    ) -> Result<&[ItemId], BroadError> {
        let mut clock = Clock::start();
        while self.items.len() > boxes.len() {
            if let Some(item) = self.items.pop() {
                self.broad.remove(item)?;
            }
        }
        for (k, aabb) in boxes.enumerate() {
            match self.items.get(k) {
                Some(&item) => self.broad.set(item, aabb?)?,
                None => self.items.push(self.broad.insert(aabb?)),
            }
        }
        self.seconds += clock.lap();
        Ok(&self.items)
    }

    /// Pairs of things whose boxes meet and that `keep` does not refuse, by their numbers.
    pub(super) fn pairs(&mut self, mut keep: impl FnMut([usize; 2]) -> bool) -> &[Pair] {
        let numbers = |pair: Pair| [pair.first().index(), pair.second().index()];
        let mut clock = Clock::start();
        let pairs = self.broad.pairs(|pair| keep(numbers(pair)));
        self.seconds += clock.lap();
        pairs
    }
}
