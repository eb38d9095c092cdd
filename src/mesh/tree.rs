//! Trees of boxes, and the pairs of their items whose boxes overlap.
//!
//! A tree is a pyramid. Items are sorted along a curve that keeps neighbours together (Morton, "A
//! computer oriented geodetic data base", 1966), and lie in blocks of [`WIDTH`]. The boxes around
//! the blocks lie in blocks of the next level, and so on up to a single one. Two blocks of a level
//! are compared lane by lane; where two lanes overlap, the blocks below them are compared.
//!
//! Boxes are stored in `f32`, after a [`Grid`] that maps coordinates of `f64`. The map is monotone:
//! each of its operations is. So boxes that overlap do so in `f32` as well, whatever is rounded,
//! and no bound of an error is needed.

use pulp::{Simd, WithSimd};
use wide::f32x8;

use crate::registers::with_widest;

/// How many boxes lie side by side.
const WIDTH: usize = 8;

/// The box of an item: its least and its largest coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

impl Bounds {
    /// Holds nothing, and overlaps nothing.
    pub(super) const NOTHING: Bounds = Bounds {
        low: [f64::INFINITY; 3],
        high: [f64::NEG_INFINITY; 3],
    };

    /// The box around both.
    #[inline(always)]
    pub(super) fn joined(&self, other: &Bounds) -> Bounds {
        Bounds {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }

    /// Moved outward by a distance on all sides, at least.
    #[inline(always)]
    pub(super) fn widened(&self, distance: f64) -> Bounds {
        if distance == 0.0 {
            return *self;
        }
        Bounds {
            low: self.low.map(|x| (x - distance).next_down()),
            high: self.high.map(|x| (x + distance).next_up()),
        }
    }
}

/// A monotone map of coordinates to `f32`, which spends the bits of these on a box around
/// everything.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    low: [f64; 3],
    scale: f64,
}

impl Grid {
    /// For items in a box.
    pub(super) fn new(around: &Bounds) -> Self {
        let low = around.low.map(|x| x.max(-f64::MAX));
        // Half of each, as the difference may overflow.
        let size = (0..3)
            .map(|i| around.high[i] / 2.0 - low[i] / 2.0)
            .fold(0.0, f64::max);
        // A power of two or not does not matter. It has to be finite, and above 0.
        let scale = (CELLS / 2.0 / size).clamp(f64::MIN_POSITIVE, f64::MAX);
        Grid { low, scale }
    }

    /// In `f32`; monotone.
    fn map(&self, axis: usize, x: f64) -> f32 {
        ((x - self.low[axis]) * self.scale) as f32
    }
}

/// How many parts a side of the box around everything has, as far as a curve distinguishes them.
const CELLS: f64 = 1024.0;

/// Boxes side by side.
#[derive(Clone, Debug)]
#[repr(align(32))]
struct Block {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    /// The box around all of them.
    least: [f32; 3],
    largest: [f32; 3],
    /// The groups in each box, as bits.
    groups: [u64; WIDTH],
}

impl Block {
    fn of(boxes: &[Lane]) -> Self {
        let mut block = Block {
            // No box: overlaps none, not even an infinite one.
            low: [[f32::NAN; WIDTH]; 3],
            high: [[f32::NAN; WIDTH]; 3],
            least: [0.0; 3],
            largest: [0.0; 3],
            groups: [0; WIDTH],
        };
        let around = around(boxes);
        (block.least, block.largest) = (around.low, around.high);
        for (i, lane) in boxes.iter().enumerate() {
            for axis in 0..3 {
                block.low[axis][i] = lane.low[axis];
                block.high[axis][i] = lane.high[axis];
            }
            block.groups[i] = lane.groups;
        }
        block
    }

    /// The lanes of another block that a lane of this one overlaps, as bits.
    #[inline(always)]
    fn overlaps(&self, lane: usize, other: &Block) -> u32 {
        let box_of = |rows: &[[f32; WIDTH]; 3]| [rows[0][lane], rows[1][lane], rows[2][lane]];
        other.lanes_over(&box_of(&self.low), &box_of(&self.high))
    }

    /// The lanes that overlap the box around all of another block, as bits.
    #[inline(always)]
    fn overlap_all(&self, other: &Block) -> u32 {
        self.lanes_over(&other.least, &other.largest)
    }

    /// The lanes that overlap a box, as bits.
    #[inline(always)]
    fn lanes_over(&self, low: &[f32; 3], high: &[f32; 3]) -> u32 {
        let axis = |i: usize| {
            let [low, high] = [f32x8::splat(low[i]), f32x8::splat(high[i])];
            let [own_low, own_high] = [&self.low, &self.high].map(|rows| f32x8::new(rows[i]));
            low.simd_le(own_high) & own_low.simd_le(high)
        };
        (axis(0) & axis(1) & axis(2)).to_bitmask()
    }
}

/// One box and the groups in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lane {
    low: [f32; 3],
    high: [f32; 3],
    groups: u64,
}

impl Lane {
    pub(super) fn new(bounds: &Bounds, groups: u64, grid: &Grid) -> Self {
        Lane {
            low: std::array::from_fn(|i| grid.map(i, bounds.low[i])),
            high: std::array::from_fn(|i| grid.map(i, bounds.high[i])),
            groups,
        }
    }

    /// Holds nothing.
    const NOTHING: Lane = Lane {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
        groups: 0,
    };

    fn joined(&self, other: &Lane) -> Lane {
        Lane {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
            groups: self.groups | other.groups,
        }
    }
}

/// The box around some.
fn around(boxes: &[Lane]) -> Lane {
    let joined = |around: Lane, lane: &Lane| around.joined(lane);
    boxes.iter().fold(Lane::NOTHING, joined)
}

/// Which groups meet which: bit `h` of entry `g`. Groups from 64 on share these bits.
pub(super) type Meets = [u64; 64];

/// A tree of boxes.
#[derive(Debug)]
pub(super) struct Tree {
    /// The lowest level first; the last one has one block, unless there are no items.
    levels: Vec<Vec<Block>>,
    /// The items in the lanes of the lowest level.
    items: Vec<u32>,
}

/// Two blocks of a level that are to be compared.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Task {
    level: usize,
    first: usize,
    second: usize,
}

impl Tree {
    /// The tree of items with these boxes.
    pub(super) fn new(lanes: &[Lane]) -> Self {
        let items = sorted(lanes);
        let ordered: Vec<Lane> = items.iter().map(|&item| lanes[item as usize]).collect();
        let mut levels = Vec::new();
        let mut level = ordered;
        // Ends: each level is a part of the one below it.
        while !level.is_empty() {
            levels.push(level.chunks(WIDTH).map(Block::of).collect::<Vec<_>>());
            if level.len() <= WIDTH {
                break;
            }
            level = level.chunks(WIDTH).map(around).collect();
        }
        Tree { levels, items }
    }

    /// What compares all items of this tree with each other, in parts; about as many as asked for.
    pub(super) fn tasks_within(&self, count: usize, meets: Option<&Meets>) -> Vec<Task> {
        let Some(level) = self.levels.len().checked_sub(1) else {
            return Vec::new();
        };
        let root = Task {
            level,
            first: 0,
            second: 0,
        };
        self.expanded(self, vec![root], count, meets, true)
    }

    /// What compares all items of this tree with all of another one, in parts.
    pub(super) fn tasks_with(
        &self,
        other: &Tree,
        count: usize,
        meets: Option<&Meets>,
    ) -> Vec<Task> {
        let heights = self.levels.len().min(other.levels.len());
        let Some(level) = heights.checked_sub(1) else {
            return Vec::new();
        };
        let pairs = (0..self.levels[level].len())
            .flat_map(|first| (0..other.levels[level].len()).map(move |second| (first, second)));
        let tasks = pairs.map(|(first, second)| Task {
            level,
            first,
            second,
        });
        self.expanded(other, tasks.collect(), count, meets, false)
    }

    /// Tasks split until there are enough of them.
    fn expanded(
        &self,
        other: &Tree,
        mut tasks: Vec<Task>,
        count: usize,
        meets: Option<&Meets>,
        within: bool,
    ) -> Vec<Task> {
        // Ends: all tasks are of one level, which is lower each time.
        while tasks.len() < count && tasks.iter().any(|task| task.level > 0) {
            let mut next = Vec::new();
            for task in tasks {
                self.compare(other, &task, meets, within, &mut |first, second| {
                    next.push(Task {
                        level: task.level - 1,
                        first,
                        second,
                    });
                });
            }
            tasks = next;
        }
        tasks
    }

    /// Calls `found` for each two items of a task whose boxes overlap, in an order that depends on
    /// the boxes alone. The items of a tree compared with itself come once, smaller index first.
    pub(super) fn pairs(
        &self,
        other: &Tree,
        task: &Task,
        meets: Option<&Meets>,
        within: bool,
        found: &mut impl FnMut(u32, u32),
    ) {
        with_widest(Search {
            trees: [self, other],
            task: *task,
            meets,
            within,
            found,
        });
    }

    /// Calls `found` for each two boxes of a task that overlap, with their places in the level
    /// below. At the lowest level these are items, and no item is compared with itself.
    #[inline(always)]
    fn compare(
        &self,
        other: &Tree,
        task: &Task,
        meets: Option<&Meets>,
        within: bool,
        found: &mut impl FnMut(usize, usize),
    ) {
        let Task {
            level,
            first,
            second,
        } = *task;
        let (a, b) = (&self.levels[level][first], &other.levels[level][second]);
        let is_self = within && first == second;
        let mut rows = a.overlap_all(b);
        // Ends: a lane is taken out each time.
        while rows != 0 {
            let i = rows.trailing_zeros() as usize;
            rows &= rows - 1;
            let mut lanes = a.overlaps(i, b);
            if is_self {
                lanes &= u32::MAX << (i + usize::from(level == 0));
            }
            while lanes != 0 {
                let j = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                if meets.is_none_or(|meets| meet(meets, a.groups[i], b.groups[j])) {
                    found(first * WIDTH + i, second * WIDTH + j);
                }
            }
        }
    }
}

/// The search for the pairs of a task, for the widest registers there are.
struct Search<'a, F> {
    trees: [&'a Tree; 2],
    task: Task,
    meets: Option<&'a Meets>,
    within: bool,
    found: &'a mut F,
}

impl<F: FnMut(u32, u32)> WithSimd for Search<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Search {
            trees: [tree, other],
            task,
            meets,
            within,
            found,
        } = self;
        let mut open = vec![task];
        // Ends: a task is replaced by tasks of the level below.
        while let Some(task) = open.pop() {
            tree.compare(other, &task, meets, within, &mut |first, second| {
                if let Some(level) = task.level.checked_sub(1) {
                    open.push(Task {
                        level,
                        first,
                        second,
                    });
                    return;
                }
                let (first, second) = (tree.items[first], other.items[second]);
                match within && second < first {
                    true => found(second, first),
                    false => found(first, second),
                }
            });
        }
    }
}

/// Whether any group of one set meets one of the other.
pub(super) fn meet(meets: &Meets, mut first: u64, second: u64) -> bool {
    while first != 0 {
        if meets[first.trailing_zeros() as usize] & second != 0 {
            return true;
        }
        first &= first - 1;
    }
    false
}

/// The items in the order of a curve through their middles.
fn sorted(lanes: &[Lane]) -> Vec<u32> {
    const BITS: u32 = 10;
    const MASK: u32 = (1 << BITS) - 1;
    let code = |lane: &Lane| {
        let axis = |i: usize| spread(((lane.low[i] + lane.high[i]) * 0.5) as u32) << i;
        axis(0) | axis(1) | axis(2)
    };
    let mut items: Vec<(u32, u32)> = lanes.iter().map(code).zip(0..).collect();
    let mut sorted = items.clone();
    // By its digits, the lowest first; each pass keeps the order of the one before.
    for shift in [0, BITS, 2 * BITS] {
        let digit = |code: u32| (code >> shift & MASK) as usize;
        let mut starts = [0; 1 << BITS];
        for (code, _) in &items {
            starts[digit(*code)] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            (*start, sum) = (sum, sum + *start);
        }
        for item in &items {
            let start = &mut starts[digit(item.0)];
            sorted[*start] = *item;
            *start += 1;
        }
        std::mem::swap(&mut items, &mut sorted);
    }
    items.into_iter().map(|(_, item)| item).collect()
}

/// The lowest ten bits of a number, with two zeros before each.
fn spread(x: u32) -> u32 {
    let x = x.min(1023);
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}
