//! The items of a broad phase: boxes by their ids.

use super::aabb::Aabb;
use super::error::BroadError;
use super::item_id::ItemId;

/// Two items, the one of the smaller id first. Pairs are in the order of their first ids, then of
/// their second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Pair {
    first: ItemId,
    second: ItemId,
}

impl Pair {
    /// The pair of two items that are not the same, in either order.
    pub(super) fn new(one: ItemId, other: ItemId) -> Self {
        debug_assert_ne!(one, other);
        Pair {
            first: one.min(other),
            second: one.max(other),
        }
    }

    /// The item of the smaller id.
    pub fn first(&self) -> ItemId {
        self.first
    }

    /// The item of the larger id.
    pub fn second(&self) -> ItemId {
        self.second
    }
}

/// Boxes by id.
#[derive(Clone, Debug, Default)]
pub(super) struct Items {
    boxes: Vec<Option<Aabb>>,
    /// Ids without a box, the one to give next last.
    free: Vec<ItemId>,
}

impl Items {
    pub(super) fn insert(&mut self, aabb: Aabb) -> ItemId {
        match self.free.pop() {
            Some(item) => {
                self.boxes[item.0] = Some(aabb);
                item
            }
            None => {
                self.boxes.push(Some(aabb));
                ItemId(self.boxes.len() - 1)
            }
        }
    }

    pub(super) fn set(&mut self, item: ItemId, aabb: Aabb) -> Result<(), BroadError> {
        *self.slot(item)? = aabb;
        Ok(())
    }

    pub(super) fn remove(&mut self, item: ItemId) -> Result<Aabb, BroadError> {
        let aabb = *self.slot(item)?;
        self.boxes[item.0] = None;
        self.free.push(item);
        Ok(aabb)
    }

    fn slot(&mut self, item: ItemId) -> Result<&mut Aabb, BroadError> {
        let slot = self.boxes.get_mut(item.0).and_then(Option::as_mut);
        slot.ok_or(BroadError::UnknownItem(item))
    }

    pub(super) fn get(&self, item: ItemId) -> Option<&Aabb> {
        self.boxes.get(item.0)?.as_ref()
    }

    /// How many items there are.
    pub(super) fn len(&self) -> usize {
        self.boxes.len() - self.free.len()
    }

    /// How many ids there have been: each index is below it.
    pub(super) fn ids(&self) -> usize {
        self.boxes.len()
    }

    /// All items in the order of their ids.
    pub(super) fn iter(&self) -> impl Iterator<Item = (ItemId, &Aabb)> + Clone {
        let boxes = self.boxes.iter().enumerate();
        boxes.filter_map(|(index, aabb)| Some((ItemId(index), aabb.as_ref()?)))
    }
}
