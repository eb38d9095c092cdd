//! The first stages of the cascade for many queries at once.
//!
//! They are arithmetic without branches, so over arrays the compiler does several queries in one
//! instruction, as many as the registers of the processor hold: what it has is found out at run
//! time. The answers are the same in every bit, as no operation is contracted or reordered.

use std::array;
use std::marker::PhantomData;

use pulp::{Arch, WithSimd};

use super::cubic::Cubic;
use super::ends::{Ends, Plain};
use super::kind::Stages;
use super::motion::Positions;
use super::stage::Stage;
use super::thick::{self, rounded_up};
use crate::query::Radius;

/// How many queries go through a stage together: enough that few lanes are idle in the later
/// stages, few enough that their coordinates stay in the cache.
pub(super) const BLOCK: usize = 256;

/// How many queries lie side by side: a few registers, whatever the processor.
const LANES: usize = 8;

/// The coordinates of [`LANES`] queries, and numbers not below their radii.
type Tile = [[f64; LANES]; ROWS];

const RADIUS: usize = 24;
const ROWS: usize = 25;

/// Queries that go through the first stages together; those that a stage decides are taken out.
pub(super) struct Block {
    tiles: [Tile; BLOCK / LANES],
    /// Which queries are still open, ascending.
    open: [u16; BLOCK],
    count: usize,
}

impl Block {
    pub(super) fn new() -> Self {
        Block {
            tiles: [[[0.0; LANES]; ROWS]; BLOCK / LANES],
            open: [0; BLOCK],
            count: 0,
        }
    }

    /// Takes up to [`BLOCK`] queries. Lanes without one keep what they had, which does no harm.
    pub(super) fn fill(&mut self, coordinates: [&[f64]; 24]) {
        self.count = coordinates[0].len();
        self.open = array::from_fn(|i| i as u16);
        for (row, array) in coordinates.into_iter().enumerate() {
            let (whole, rest) = array.as_chunks::<LANES>();
            for (tile, lanes) in self.tiles.iter_mut().zip(whole) {
                tile[row] = *lanes;
            }
            if let Some(tile) = self.tiles.get_mut(whole.len()) {
                tile[row][..rest.len()].copy_from_slice(rest);
            }
        }
    }

    /// The radii of the queries, all above 0.
    pub(super) fn fill_radii(&mut self, radii: &[Radius]) {
        for (i, radius) in radii.iter().enumerate() {
            self.tiles[i / LANES][RADIUS][i % LANES] = rounded_up(*radius);
        }
    }

    /// The positions of the query that is open at this place.
    #[inline(always)]
    pub(super) fn positions(&self, place: usize) -> Positions {
        let (tile, lane) = (&self.tiles[place / LANES], place % LANES);
        let at = |row: usize| [tile[row][lane], tile[row + 1][lane], tile[row + 2][lane]];
        Positions {
            start: [at(0), at(3), at(6), at(9)],
            end: [at(12), at(15), at(18), at(21)],
        }
    }

    pub(super) fn open(&self) -> &[u16] {
        &self.open[..self.count]
    }

    /// The first three stages, and the fourth as far as it goes without a branch: a miss at the
    /// only root. Stops after the first two where they decide little: then most of these pairs
    /// touch, and one by one is faster. Returns whether it went on.
    pub(super) fn screen<K: Stages>(&mut self, observe: &mut impl FnMut(Stage)) -> bool {
        let all = self.count;
        let apart = self.test(Apart::<K>(PhantomData));
        self.take_out([Stage::Boxes, Stage::Direction], &apart, observe);
        if 4 * self.count > 3 * all {
            return false;
        }
        let signs = self.test(Signs::<K>(PhantomData));
        self.take_out([Stage::Signs], &signs, observe);
        let roots = self.test(Roots::<K>(PhantomData));
        self.take_out([Stage::Roots], &roots, observe);
        true
    }

    /// The first two stages with radii above 0. Returns whether they decide so much that it pays.
    pub(super) fn screen_thick<K: Stages>(&mut self, observe: &mut impl FnMut(Stage)) -> bool {
        let all = self.count;
        let apart = self.test(ApartThick::<K>(PhantomData));
        self.take_out([Stage::Boxes, Stage::Direction], &apart, observe);
        4 * self.count <= 3 * all
    }

    fn test<const N: usize, T: Test<N>>(&self, test: T) -> Answers<N> {
        Arch::new().dispatch(Each::<N, T> { block: self, test })
    }
}

/// What tests say of each query.
type Answers<const N: usize> = [[[bool; N]; LANES]; BLOCK / LANES];

/// `N` tests of a query, without a branch.
trait Test<const N: usize> {
    fn of(&self, points: &[[Plain; 3]; 4], radius: f64) -> [bool; N];
}

/// Stages 1 and 2.
struct Apart<K>(PhantomData<K>);

impl<K: Stages> Test<2> for Apart<K> {
    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], _: f64) -> [bool; 2] {
        let boxes = K::boxes(points, 0.0);
        let is_separated = K::is_separated_by_centres(&K::motion(points), &boxes);
        [boxes.are_disjoint, is_separated]
    }
}

/// The same with a radius.
struct ApartThick<K>(PhantomData<K>);

impl<K: Stages> Test<2> for ApartThick<K> {
    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], radius: f64) -> [bool; 2] {
        thick::are_apart::<K, _>(points, radius)
    }
}

/// Stage 3.
struct Signs<K>(PhantomData<K>);

impl<K: Stages> Test<1> for Signs<K> {
    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], _: f64) -> [bool; 1] {
        let cubic = Cubic::unchecked(&K::motion(points));
        [cubic.is_valid() & cubic.has_no_root()]
    }
}

/// Stage 4, for a miss at the only root in each half of the step.
struct Roots<K>(PhantomData<K>);

impl<K: Stages> Test<1> for Roots<K> {
    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], _: f64) -> [bool; 1] {
        let motion = K::motion(points);
        let cubic = Cubic::unchecked(&motion);
        let [lower, upper] = cubic.halves();
        let is_apart_in = |half| K::is_apart_in(&motion, &cubic, half);
        let is_apart = is_apart_in(&lower) & is_apart_in(&upper);
        [cubic.is_valid() & is_apart]
    }
}

/// A test of each open query; what it says beyond these means nothing.
struct Each<'a, const N: usize, T> {
    block: &'a Block,
    test: T,
}

impl<const N: usize, T: Test<N>> WithSimd for Each<'_, N, T> {
    type Output = Answers<N>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        let mut answers = [[[false; N]; LANES]; BLOCK / LANES];
        let tiles = self.block.tiles.iter();
        let tiles = tiles.take(self.block.count.div_ceil(LANES));
        for (tile, answers) in tiles.zip(&mut answers) {
            for i in 0..LANES {
                let of = |row: usize| Plain::new(tile[row][i], tile[row + 12][i]);
                let at = |row: usize| [of(row), of(row + 1), of(row + 2)];
                answers[i] = self.test.of(&[at(0), at(3), at(6), at(9)], tile[RADIUS][i]);
            }
        }
        answers
    }
}

impl Block {
    /// Takes out the queries that a stage decided.
    #[inline(always)]
    fn take_out<const N: usize>(
        &mut self,
        stages: [Stage; N],
        decided: &Answers<N>,
        observe: &mut impl FnMut(Stage),
    ) {
        let mut kept = [0; BLOCK];
        let mut count = 0;
        for (i, decided) in decided.as_flattened().iter().enumerate().take(self.count) {
            let stage = stages
                .iter()
                .zip(decided)
                .find(|(_, is_decided)| **is_decided);
            if let Some((stage, _)) = stage {
                observe(*stage);
            }
            kept[count] = i;
            count += usize::from(stage.is_none());
        }
        for (i, &from) in kept[..count].iter().enumerate() {
            for row in 0..ROWS {
                self.tiles[i / LANES][row][i % LANES] = self.tiles[from / LANES][row][from % LANES];
            }
            self.open[i] = self.open[from];
        }
        self.count = count;
    }
}
