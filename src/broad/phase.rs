//! The broad phase: items in, pairs out.

use super::aabb::Aabb;
use super::brute;
use super::error::BroadError;
use super::grid::HierarchicalGrid;
use super::item_id::ItemId;
use super::items::{Items, Pair};
use super::sweep::SweepAndPrune;

/// How a [`BroadPhase`] searches. The pairs do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Boxes sorted along one axis, from step to step: for scenes that are long in some direction,
    /// change little, or mix sizes.
    #[default]
    SweepAndPrune,
    /// Cells for each size of box: for many boxes in all directions.
    HierarchicalGrid,
    /// Every pair of all: for a few dozen boxes, and to compare with.
    BruteForce,
}

/// What a method keeps from search to search.
#[derive(Clone, Debug)]
enum Search {
    SweepAndPrune(SweepAndPrune),
    HierarchicalGrid(HierarchicalGrid),
    BruteForce,
}

/// Boxes that come, move and go, and the pairs of them that overlap.
#[derive(Clone, Debug)]
pub struct BroadPhase {
    items: Items,
    search: Search,
    pairs: Vec<Pair>,
}

impl BroadPhase {
    /// A broad phase without items.
    pub fn new(method: Method) -> Self {
        let search = match method {
            Method::SweepAndPrune => Search::SweepAndPrune(SweepAndPrune::default()),
            Method::HierarchicalGrid => Search::HierarchicalGrid(HierarchicalGrid::default()),
            Method::BruteForce => Search::BruteForce,
        };
        BroadPhase {
            items: Items::default(),
            search,
            pairs: Vec::new(),
        }
    }

    /// A new item. Its id is the one that was freed last, else the next number.
    pub fn insert(&mut self, aabb: Aabb) -> ItemId {
        self.items.insert(aabb)
    }

    /// The box of an item from now on.
    ///
    /// # Errors
    ///
    /// [`BroadError::UnknownItem`] if there is no such item.
    pub fn set(&mut self, item: ItemId, aabb: Aabb) -> Result<(), BroadError> {
        self.items.set(item, aabb)
    }

    /// Takes an item out and returns its box.
    ///
    /// # Errors
    ///
    /// [`BroadError::UnknownItem`] if there is no such item.
    pub fn remove(&mut self, item: ItemId) -> Result<Aabb, BroadError> {
        self.items.remove(item)
    }

    /// The box of an item, if there is one.
    pub fn aabb(&self, item: ItemId) -> Option<&Aabb> {
        self.items.get(item)
    }

    /// How many items there are.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there are no items.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every pair of items whose boxes have a point in common and that `keep` does not refuse, each
    /// once, in order.
    ///
    /// `keep` is asked once for each pair whose boxes overlap, in no certain order: here go pairs
    /// that nobody has a question about, such as segments that share a node.
    pub fn pairs(&mut self, mut keep: impl FnMut(Pair) -> bool) -> &[Pair] {
        let BroadPhase {
            items,
            search,
            pairs,
        } = self;
        pairs.clear();
        let mut found = |pair| {
            if keep(pair) {
                pairs.push(pair);
            }
        };
        match search {
            Search::SweepAndPrune(search) => search.each_pair(items, &mut found),
            Search::HierarchicalGrid(search) => search.each_pair(items, &mut found),
            Search::BruteForce => brute::each_pair(items, &mut found),
        }
        pairs.sort_unstable();
        pairs
    }
}
