//! Sweep-and-prune: boxes in the order of their lower ends along one axis.
//!
//! A box is compared with those that begin before it ends, on that axis. The order is kept from
//! search to search and mended by insertion sort, which takes linear time where little has changed;
//! where much has, it gives up for an ordinary sort. The axis is the one on which the fewest
//! intervals overlap, counted exactly, so that a thousand things lying on one plane do not matter;
//! it is counted again when a sweep has come to compare twice as many. Order and axis are hints:
//! the pairs do not depend on them.
//!
//! Source: Baraff, Dynamic Simulation of Non-Penetrating Rigid Bodies, 5.3 (one list for each
//! axis); Ericson, Real-Time Collision Detection, 7.5.2 (one axis). One list does: the other two
//! axes cost four comparisons, less than two more lists in order.

use super::aabb::Aabb;
use super::item_id::ItemId;
use super::items::{Items, Pair};

/// Moves for each item after which insertion sort gives up: about as many as an ordinary sort
/// makes.
const PATIENCE: usize = 16;

/// What is kept from search to search.
#[derive(Clone, Debug, Default)]
pub(super) struct SweepAndPrune {
    axis: usize,
    /// How many intervals overlapped on the axis when it was chosen.
    expected: usize,
    /// The items of the last search in order.
    order: Vec<LowEnd>,
    /// By id, whether an item is in `order`.
    is_ordered: Vec<bool>,
    /// The boxes in order.
    boxes: Vec<(ItemId, Aabb)>,
}

/// Where a box begins on the axis.
#[derive(Clone, Copy, Debug)]
struct LowEnd {
    at: f64,
    item: ItemId,
}

impl SweepAndPrune {
    /// Calls `found` with every pair of which the boxes overlap.
    pub(super) fn each_pair(&mut self, items: &Items, found: &mut impl FnMut(Pair)) {
        if self.order.is_empty() {
            self.choose_axis(items);
        }
        self.refresh(items);
        sort(&mut self.order);
        let compared = self.sweep(items, found);
        if compared > 2 * (self.expected + items.len()) {
            self.choose_axis(items);
        }
    }

    /// Takes in which items there are now and where they begin, in the order of last time.
    fn refresh(&mut self, items: &Items) {
        let axis = self.axis;
        let is_ordered = &mut self.is_ordered;
        is_ordered.clear();
        is_ordered.resize(items.ids(), false);
        self.order.retain_mut(|end| {
            let aabb = items.get(end.item);
            if let Some(aabb) = aabb {
                end.at = aabb.low[axis];
                is_ordered[end.item.index()] = true;
            }
            aabb.is_some()
        });
        let new = items.iter().filter(|(item, _)| !is_ordered[item.index()]);
        self.order.extend(new.map(|(item, aabb)| LowEnd {
            at: aabb.low[axis],
            item,
        }));
    }

    /// Compares each box with those that begin within it; returns how many comparisons it made.
    fn sweep(&mut self, items: &Items, found: &mut impl FnMut(Pair)) -> usize {
        let in_order = self.order.iter();
        let in_order = in_order.filter_map(|end| Some((end.item, *items.get(end.item)?)));
        self.boxes.clear();
        self.boxes.extend(in_order);
        let mut compared = 0;
        for (index, (item, aabb)) in self.boxes.iter().enumerate() {
            let end = aabb.high[self.axis];
            let rest = self.boxes[index + 1..].iter();
            for (other, other_box) in rest.take_while(|(_, b)| b.low[self.axis] <= end) {
                compared += 1;
                if aabb.overlaps(other_box) {
                    found(Pair::new(*item, *other));
                }
            }
        }
        compared
    }

    /// Takes the axis on which the fewest intervals overlap.
    fn choose_axis(&mut self, items: &Items) {
        let counts = [0, 1, 2].map(|axis| count_overlaps(items, axis));
        let fewest = (0..3).min_by_key(|&axis| counts[axis]).unwrap_or(0);
        (self.axis, self.expected) = (fewest, counts[fewest]);
    }
}

/// How many pairs of boxes overlap on one axis: what a sweep along it compares.
///
/// Of two intervals, both begin before the other's end if they overlap, else one does. So with `n`
/// the number of all, the number of (end, beginning not after it) is `n + n (n - 1) / 2 +
/// overlaps`.
fn count_overlaps(items: &Items, axis: usize) -> usize {
    let sorted = |end: fn(&Aabb) -> &[f64; 3]| {
        let mut ends: Vec<f64> = items.iter().map(|(_, aabb)| end(aabb)[axis]).collect();
        ends.sort_unstable_by(f64::total_cmp);
        ends
    };
    let (lows, highs) = (sorted(|aabb| &aabb.low), sorted(|aabb| &aabb.high));
    let (mut begun, mut both) = (0, 0);
    for (ended, high) in highs.iter().enumerate() {
        while lows.get(begun).is_some_and(|low| low <= high) {
            begun += 1;
        }
        // Of the `n (n - 1) / 2 + n`, this end's share is `ended + 1`.
        both += begun - (ended + 1);
    }
    both
}

/// Sorts by where boxes begin, in linear time if they nearly are in order.
fn sort(ends: &mut [LowEnd]) {
    let mut moves = PATIENCE * ends.len();
    for index in 1..ends.len() {
        let end = ends[index];
        let before = ends[..index].iter().rev();
        let distance = before.take_while(|other| end.at < other.at).count();
        ends[index - distance..=index].rotate_right(1);
        if distance > moves {
            ends.sort_unstable_by(|a, b| a.at.total_cmp(&b.at));
            return;
        }
        moves -= distance;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(boxes: impl IntoIterator<Item = [[f64; 3]; 2]>) -> Items {
        let mut items = Items::default();
        for [low, high] in boxes {
            items.insert(Aabb { low, high });
        }
        items
    }

    #[test]
    fn sweep_compares_what_was_counted_on_the_axis_of_the_fewest() {
        // On one plane (z), in three columns (y), all begun at different x.
        let boxes = (0..100).map(|i| {
            let [x, y] = [f64::from(i * 37 % 100), f64::from(i % 3)];
            [[x, y, 0.0], [x + 1.5, y + 0.5, 1.0]]
        });
        let items = items(boxes);
        assert_eq!([0, 1, 2].map(|axis| count_overlaps(&items, axis))[2], 4950);
        for axis in 0..3 {
            let mut search = SweepAndPrune {
                axis,
                ..SweepAndPrune::default()
            };
            search.refresh(&items);
            sort(&mut search.order);
            let compared = search.sweep(&items, &mut |_| {});
            assert_eq!(compared, count_overlaps(&items, axis), "axis {axis}");
        }
        let mut search = SweepAndPrune::default();
        search.each_pair(&items, &mut |_| {});
        assert_eq!((search.axis, search.expected), (0, 99));
    }

    #[test]
    fn sweep_changes_its_axis_when_the_scene_turns() {
        let row = |axis: usize| {
            (0..100).map(move |i| {
                let mut low = [0.0; 3];
                low[axis] = f64::from(i);
                [low, low]
            })
        };
        let mut search = SweepAndPrune::default();
        search.each_pair(&items(row(1)), &mut |_| {});
        assert_eq!(search.axis, 1);
        search.each_pair(&items(row(2)), &mut |_| {});
        assert_eq!(search.axis, 2);
    }

    #[test]
    fn sort_is_in_order_whether_it_gives_up_or_not() {
        let item = items([[[0.0; 3]; 2]]).iter().next().unwrap().0;
        for (count, step) in [(1000, 1), (1000, 999), (1000, 17), (3, 2), (1, 0), (0, 0)] {
            let at = |i: usize| (i * step % 1000) as f64 - 500.0;
            let mut ends: Vec<LowEnd> = (0..count).map(|i| LowEnd { at: at(i), item }).collect();
            sort(&mut ends);
            assert!(ends.is_sorted_by(|a, b| a.at <= b.at), "{count} by {step}");
        }
    }
}
