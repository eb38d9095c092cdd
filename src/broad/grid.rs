//! Hierarchical grid: cells of a size for each size of box.
//!
//! The levels have cells of a power of two metres. A box is on the finest level whose cells are
//! longer than it is, so it meets at most two of them on an axis, and it is entered in all that it
//! meets. The boxes come in the order of their levels, coarsest first; each is looked up in the
//! cells that it meets on every level that has boxes, before it is entered itself.
//!
//! **No pair is missed, none is named twice.** The cell of a coordinate is a monotone function of
//! it, rounding included. So where two boxes overlap, the ranges of cells that they meet overlap,
//! on any level; on the level of the box that was entered first, both meet the cell of which each
//! coordinate is the larger one of the two ranges' first ones. There, and nowhere else, the pair is
//! counted.
//!
//! **No input is slow.** Where a level has no more boxes than a box meets cells on it, they are
//! compared one by one. So a box looks up at most as many cells as there are boxes.
//!
//! Source: Ericson, Real-Time Collision Detection, 7.2; the proof is this project's.

use std::ops::Range;

use rustc_hash::FxHashMap;

use super::aabb::Aabb;
use super::item_id::ItemId;
use super::items::{Items, Pair};

/// The level of all that is longer than 2^1022 metres, or infinite. It has one cell.
const TOP: u64 = 2045;

/// Cells are at least this many binary digits above the last one of a coordinate in them, so that
/// their numbers fit.
const DIGITS: u64 = 50;

/// A cell of one level.
type Cell = [i64; 3];

/// What is kept from search to search: memory, and nothing else.
#[derive(Clone, Debug, Default)]
pub(super) struct HierarchicalGrid {
    /// The items, coarsest level first.
    entries: Vec<Entry>,
    levels: Vec<Level>,
    /// The last link of every cell that was entered. Never iterated over: its order is no matter.
    cells: FxHashMap<(u64, Cell), usize>,
    links: Vec<Link>,
}

#[derive(Clone, Debug)]
struct Entry {
    item: ItemId,
    aabb: Aabb,
    level: u64,
    /// The cells that it meets on its level.
    met: CellRange,
}

/// The entries of a level so far.
#[derive(Clone, Debug)]
struct Level {
    level: u64,
    entries: Range<usize>,
}

/// An entry in a cell, and the one before it in the same cell.
#[derive(Clone, Debug)]
struct Link {
    entry: usize,
    before: Option<usize>,
}

/// The cells that a box meets on some level.
#[derive(Clone, Copy, Debug)]
struct CellRange {
    first: Cell,
    last: Cell,
}

impl HierarchicalGrid {
    /// Calls `found` with every pair of which the boxes overlap.
    pub(super) fn each_pair(&mut self, items: &Items, found: &mut impl FnMut(Pair)) {
        self.entries.clear();
        self.entries.extend(items.iter().map(Entry::new));
        self.entries
            .sort_unstable_by_key(|e| (TOP - e.level, e.item));
        self.levels.clear();
        self.cells.clear();
        self.links.clear();
        for index in 0..self.entries.len() {
            for level in &self.levels {
                self.look_up(&self.entries[index], level, found);
            }
            self.enter(index);
        }
    }

    /// Compares an entry with those of a level that were entered before it.
    fn look_up(&self, entry: &Entry, level: &Level, found: &mut impl FnMut(Pair)) {
        let met = CellRange::new(&entry.aabb, level.level);
        let entered = &self.entries[level.entries.clone()];
        if entered.len() <= met.count() {
            let overlapping = entered.iter().filter(|e| e.aabb.overlaps(&entry.aabb));
            overlapping.for_each(|other| found(Pair::new(entry.item, other.item)));
            return;
        }
        for cell in met.cells() {
            let mut link = self.cells.get(&(level.level, cell));
            while let Some(Link {
                entry: other,
                before,
            }) = link.map(|&link| &self.links[link])
            {
                let other = &self.entries[*other];
                if met.first_shared(&other.met) == cell && entry.aabb.overlaps(&other.aabb) {
                    found(Pair::new(entry.item, other.item));
                }
                link = before.as_ref();
            }
        }
    }

    /// Enters an entry in the cells that it meets.
    fn enter(&mut self, index: usize) {
        let Entry { level, met, .. } = self.entries[index];
        for cell in met.cells() {
            let link = self.links.len();
            let before = self.cells.insert((level, cell), link);
            self.links.push(Link {
                entry: index,
                before,
            });
        }
        match self.levels.last_mut() {
            Some(last) if last.level == level => last.entries.end = index + 1,
            _ => self.levels.push(Level {
                level,
                entries: index..index + 1,
            }),
        }
    }
}

impl Entry {
    fn new((item, &aabb): (ItemId, &Aabb)) -> Self {
        let level = level(&aabb);
        Entry {
            item,
            aabb,
            level,
            met: CellRange::new(&aabb, level),
        }
    }
}

/// The level of a box: the exponent field of its longest side, as `f64` stores it. Cells of level
/// `n` are `2^(n - 1022)` metres long, so longer than that side.
fn level(aabb: &Aabb) -> u64 {
    let exponent = |x: f64| (x.to_bits() >> 52) & 0x7ff;
    let axis = |axis: usize| {
        let (low, high) = (aabb.low[axis], aabb.high[axis]);
        // Of [inf, inf] the side is NaN, of which the exponent is the largest too.
        let size = low.abs().max(high.abs());
        exponent(high - low).max(exponent(size).saturating_sub(DIGITS))
    };
    axis(0).max(axis(1)).max(axis(2)).min(TOP)
}

/// The cell of a coordinate on one axis: monotone in `x`, at most `2^50` in magnitude on the level
/// of a box that `x` is in, and above.
fn cell(x: f64, level: u64) -> i64 {
    // 2^(1022 - level); on the top level 0, where all products are 0 or, as of infinity, NaN: cell
    // 0.
    let per_metre = f64::from_bits((TOP - level) << 52);
    (x * per_metre).floor() as i64
}

impl CellRange {
    fn new(aabb: &Aabb, level: u64) -> Self {
        let cells = |corner: &[f64; 3]| corner.map(|x| cell(x, level));
        CellRange {
            first: cells(&aabb.low),
            last: cells(&aabb.high),
        }
    }

    /// How many cells: two on an axis at most, or three where coordinates underflow.
    fn count(&self) -> usize {
        let on = |axis: usize| (self.last[axis] - self.first[axis] + 1) as usize;
        on(0) * on(1) * on(2)
    }

    fn cells(self) -> impl Iterator<Item = Cell> {
        let on = move |axis: usize| self.first[axis]..=self.last[axis];
        on(0).flat_map(move |x| on(1).flat_map(move |y| on(2).map(move |z| [x, y, z])))
    }

    /// The first cell that two ranges share, if they share one.
    fn first_shared(&self, other: &CellRange) -> Cell {
        [0, 1, 2].map(|axis| self.first[axis].max(other.first[axis]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_meets_at_most_two_cells_on_an_axis_and_not_all_in_one() {
        let mut both = 0;
        for exponent in (1..2046).step_by(3) {
            let unit = f64::from_bits(exponent << 52);
            for place in [0.0, 0.1, 0.7, -0.3, 1.0, 37.0, -1e9, 1e15, -1e300] {
                for size in [1.0, 1.0 + f64::EPSILON, 1.5, 2.0 - f64::EPSILON] {
                    let low = place * unit;
                    let (low, high) = ([low; 3], [low + size * unit; 3]);
                    if !high[0].is_finite() {
                        continue;
                    }
                    let aabb = Aabb { low, high };
                    let met = CellRange::new(&aabb, level(&aabb));
                    assert!(met.first[0].abs() <= 1 << DIGITS, "{aabb:?} meets {met:?}");
                    let count = met.count();
                    assert!(count == 1 || count == 8, "{aabb:?} meets {met:?}");
                    both += u32::from(count == 8);
                }
            }
        }
        assert!(both > 1000, "{both}");
    }

    #[test]
    fn cell_of_a_level_is_longer_than_a_box_on_it_by_a_factor_of_two_at_most() {
        for size in [1e-3, 0.1, 1.0, 1.0f64.next_down(), 2.0, 1e3, 1e300] {
            let [low, high] = [[0.0; 3], [0.0, size, 0.0]];
            let level = level(&Aabb { low, high });
            assert_eq!(cell(size, level), 0);
            assert_eq!(cell(2.0 * size, level), 1);
        }
    }

    #[test]
    fn cells_are_monotone_where_coordinates_underflow() {
        let places = [-1.0, -1e-300, -5e-324, -0.0, 0.0, 5e-324, 1e-300, 1.0];
        // The levels in whose range 1 is.
        for level in 973..=TOP {
            let cells = places.map(|x| cell(x, level));
            assert!(cells.is_sorted(), "level {level}: {cells:?}");
        }
    }
}
