//! Names of the things that have boxes.

/// One item of a broad phase. The id of an item removed is given again to a later one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ItemId(pub(super) usize);

impl ItemId {
    /// A number below the largest count of items there has been: fit to index what else is known of
    /// the items.
    pub fn index(self) -> usize {
        self.0
    }
}
