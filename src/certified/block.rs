//! The first stages of the cascade for many queries at once.
//!
//! They are arithmetic without branches, so over arrays the compiler does several queries in one
//! instruction, as many as the [registers](crate::registers) of the processor hold.

use std::array;
use std::marker::PhantomData;
use std::ops::Range;

use pulp::WithSimd;

use super::crossing;
use super::cubic::Cubic;
use super::ends::{Ends, Plain};
use super::kind::Stages;
use super::motion::{Motion, Positions, reach};
use super::single;
use super::stage::Stage;
use super::step::{Precision, room, widened};
use super::thick::{self, Reached, Touch, rounded_up};
use crate::contact::Hit;
use crate::query::Radius;
use crate::registers::with_widest;

/// How many queries lie side by side: a few registers, whatever the processor.
pub(crate) const LANES: usize = 8;

/// The coordinates of [`LANES`] queries, and what the stages have found of them.
///
/// Row `3 p + i` is axis `i` of point `p`: A, B, C, D at `t = 0`, then at `t = 1`.
#[derive(Clone, Copy)]
pub(crate) struct Tile {
    pub(crate) coordinates: [[f64; LANES]; COORDINATES],
    found: [[f64; LANES]; FOUND],
}

pub(super) const COORDINATES: usize = 24;

/// The same coordinates of [`LANES`] queries in `f32`.
pub(crate) type SingleTile = [[f32; LANES]; COORDINATES];

/// What stages hand on: the cubic and the time of a crossing, or what [`Planes`] take.
const FOUND: usize = 6;

/// How many queries are asked the first two stages before the later ones take what is open.
pub(crate) const CHUNK: usize = 32;

/// How many may be open: what a chunk leaves beside less than another one.
const MOST_OPEN: usize = 2 * CHUNK;

/// Queries of a kind, wherever they are.
pub(crate) trait Source {
    /// Puts the coordinates of up to [`CHUNK`] queries into as many lanes of tiles, in order. Lanes
    /// without a query may hold anything.
    fn load(&self, tiles: &mut [Tile; CHUNK / LANES], queries: Range<usize>);

    /// Whether all coordinates are `f32`.
    const IS_SINGLE: bool = false;

    /// As [`load`](Self::load), of coordinates that [are `f32`](Self::IS_SINGLE).
    fn load_single(&self, _tiles: &mut [SingleTile; CHUNK / LANES], _queries: Range<usize>) {}

    /// The coordinates of a query.
    fn positions(&self, query: usize) -> Positions;

    /// The distance at which its sides touch.
    fn radius(&self, query: usize) -> Radius;

    /// Whether no query of some has a radius above 0.
    fn are_thin(&self, queries: Range<usize>) -> bool;
}

/// Queries that no stage has decided so far.
pub(super) struct Open {
    /// The last ones are for a chunk that is new, if it has no place behind what is open: that has
    /// to fill its tiles.
    tiles: [Tile; (MOST_OPEN + CHUNK) / LANES],
    /// Of a chunk in `f32`, while it is asked.
    singles: [SingleTile; CHUNK / LANES],
    /// Which queries they are, ascending.
    queries: [usize; MOST_OPEN],
    count: usize,
}

impl Open {
    pub(super) fn new() -> Self {
        Open {
            tiles: [Tile {
                coordinates: [[0.0; LANES]; COORDINATES],
                found: [[0.0; LANES]; FOUND],
            }; (MOST_OPEN + CHUNK) / LANES],
            singles: [[[0.0; LANES]; COORDINATES]; CHUNK / LANES],
            queries: [0; MOST_OPEN],
            count: 0,
        }
    }

    /// Where a new chunk begins: behind what is open, if it fills its tiles.
    #[inline(always)]
    fn next_place(&self) -> usize {
        let is_aligned = self.count.is_multiple_of(LANES);
        let place = if is_aligned { self.count } else { MOST_OPEN };
        debug_assert!(place <= MOST_OPEN);
        place
    }

    /// Whether there is no room for what a chunk may leave.
    pub(super) fn is_full(&self) -> bool {
        self.count > MOST_OPEN - CHUNK
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    pub(super) fn queries(&self) -> &[usize] {
        &self.queries[..self.count]
    }

    /// The positions of the query that is open at this place.
    #[inline(always)]
    pub(super) fn positions(&self, place: usize) -> Positions {
        let (tile, lane) = (&self.tiles[place / LANES], place % LANES);
        let at = |row: usize| [0, 1, 2].map(|i| tile.coordinates[row + i][lane]);
        Positions {
            start: [at(0), at(3), at(6), at(9)],
            end: [at(12), at(15), at(18), at(21)],
        }
    }

    /// One of the numbers found.
    #[inline(always)]
    fn row(&self, place: usize, row: usize) -> f64 {
        self.tiles[place / LANES].found[row][place % LANES]
    }

    #[inline(always)]
    fn found(&self, place: usize) -> [f64; FOUND] {
        let (tile, lane) = (&self.tiles[place / LANES], place % LANES);
        tile.found.map(|row| row[lane])
    }

    /// The cubic of the query that is open at this place, which has this motion; after
    /// [`screen`](Self::screen).
    pub(super) fn cubic<E: Ends>(&self, place: usize, motion: &Motion<E>) -> Option<Cubic> {
        let cubic = cubic_of(motion, &self.found(place));
        cubic.is_valid().then_some(cubic)
    }

    /// The time of contact of the query that is open at this place, as
    /// [`crossing::time`] says it, if [it was asked](Self::time_crossings); after
    /// [`screen`](Self::screen).
    pub(super) fn crossing_time(&self, place: usize) -> Option<f64> {
        let [.., time] = self.found(place);
        (!time.is_nan()).then_some(time)
    }

    /// How far the planes of the query that is open at this place reach, after
    /// [`screen_thick`](Self::screen_thick).
    pub(super) fn reached(&self, place: usize) -> Reached {
        reached_of(&self.found(place))
    }

    /// Puts the [positions](Self::positions) of some queries, no more than [`CHUNK`], at the first
    /// places. Nothing may be open; nor are these.
    pub(super) fn put(&mut self, source: &impl Source, queries: Range<usize>) {
        if let Some(tiles) = self.tiles.first_chunk_mut() {
            source.load(tiles, queries);
        }
    }

    /// Adds what the first two stages leave of some queries without a radius, no more than
    /// [`CHUNK`].
    pub(super) fn add<K: Stages, S: Source>(
        &mut self,
        source: &S,
        queries: Range<usize>,
        observe: &mut impl FnMut(Stage),
    ) {
        let decided = if S::IS_SINGLE {
            with_widest(FirstSingle {
                open: self,
                source,
                queries,
                kind: PhantomData::<K>,
            })
        } else {
            with_widest(First::<_, _, _, 2, 0> {
                open: self,
                source,
                queries,
                test: Apart::<K>(PhantomData),
                prepare: |_: &mut [Tile; CHUNK / LANES], _: Range<usize>| {},
            })
        };
        report([Stage::Boxes, Stage::Direction], decided, observe);
    }

    /// The same for queries with radii. One without may be among them: it is asked with a radius of the least number above
    /// 0, and what is apart by more than that does not touch.
    pub(super) fn add_thick<K: Stages>(
        &mut self,
        source: &impl Source,
        queries: Range<usize>,
        observe: &mut impl FnMut(Stage),
    ) {
        let test = ApartThick::<K>(PhantomData);
        let decided = self.first_thick(source, queries, test);
        report([Stage::Boxes, Stage::Direction], decided, observe);
    }

    /// The same for radii and the room that the rounding of positions takes.
    pub(super) fn add_with_room<K: Stages>(
        &mut self,
        source: &impl Source,
        queries: Range<usize>,
        precision: Precision,
    ) {
        let kind = PhantomData::<K>;
        match precision {
            Precision::F64 => self.first_thick(source, queries, ApartWithRoom::<K, false>(kind)),
            Precision::F32 => self.first_thick(source, queries, ApartWithRoom::<K, true>(kind)),
        };
    }

    fn first_thick(
        &mut self,
        source: &impl Source,
        queries: Range<usize>,
        test: impl Test<2, 4>,
    ) -> [u32; 2] {
        let prepare = |tiles: &mut [Tile; CHUNK / LANES], queries: Range<usize>| {
            // Most have the same.
            let mut last = (Radius::ZERO, rounded_up(Radius::ZERO));
            for (lane, query) in queries.enumerate() {
                let radius = source.radius(query);
                if radius != last.0 {
                    last = (radius, rounded_up(radius));
                }
                tiles[lane / LANES].found[0][lane % LANES] = last.1;
            }
        };
        with_widest(First::<_, _, _, 2, 4> {
            open: self,
            source,
            queries,
            test,
            prepare,
        })
    }

    /// The third stage, and the fourth as far as it goes without a branch: a miss at the only root.
    pub(super) fn screen<K: Stages>(&mut self, observe: &mut impl FnMut(Stage)) {
        self.test([Stage::Signs], Signs::<K>(PhantomData), observe);
        self.test([Stage::Roots], Roots::<K>(PhantomData), observe);
    }

    /// The fourth stage, for the times of contacts; after [`screen`](Self::screen), if it
    /// leaves enough queries.
    pub(super) fn time_crossings<K: Stages>(&mut self) {
        if self.count >= CROSSINGS {
            self.test([], Crossings::<K>(PhantomData), &mut |_| {});
        }
    }

    /// The contacts that planes lead to, after [`screen_thick`](Self::screen_thick); whether they
    /// are asked for: that takes enough queries.
    pub(super) fn find_touches<K: Stages>(&mut self, source: &impl Source) -> bool {
        let may_touch = |&place: &usize| has_ended(self.row(place, 3)) || self.row(place, 1) == 0.0;
        let touching = (0..self.count).filter(may_touch).count();
        let is_asked = touching >= CROSSINGS && 2 * touching >= self.count;
        if is_asked {
            for place in 0..self.count {
                let radii = source.radius(self.queries[place]).parts();
                let (tile, lane) = (&mut self.tiles[place / LANES], place % LANES);
                [tile.found[4][lane], tile.found[5][lane]] = radii;
            }
            self.test([], Touches::<K>(PhantomData), &mut |_| {});
            self.test([], Passages::<K>(PhantomData), &mut |_| {});
        }
        is_asked
    }

    /// The contact of the query that is open at this place, if it is certain, and else how far planes
    /// reach; after [`find_touches`](Self::find_touches) has asked.
    pub(super) fn touch<K: Stages>(&self, place: usize) -> Result<Hit<K::Place>, Reached> {
        let found @ [toi, t, u, v, error, passage] = self.found(place);
        if toi == NONE {
            return Err(reached_of(&found));
        }
        let touch = Touch { toi, u, v, error };
        touch.hit::<K>(passage).ok_or(Reached::ByPlanes {
            t,
            planes: 0,
            is_last: true,
        })
    }

    /// Planes that separate for the whole step or the next part of it.
    pub(super) fn screen_thick<K: Stages>(&mut self, observe: &mut impl FnMut(Stage)) {
        self.test([Stage::Planes], Fixed::<K>(PhantomData), observe);
        for _ in 0..PLANES {
            let asked = self.count;
            self.test([Stage::Planes], Planes::<K>(PhantomData), observe);
            let advancing = (0..self.count).filter(|&place| !has_ended(self.row(place, 3)));
            if STRAGGLERS * advancing.count() <= asked {
                break;
            }
        }
    }

    fn test<const N: usize, const R: usize, T: Test<N, R>>(
        &mut self,
        stages: [Stage; N],
        test: T,
        observe: &mut impl FnMut(Stage),
    ) {
        let decided = with_widest(Next { open: self, test });
        report(stages, decided, observe);
    }

    /// Keeps a query, which is at a place not before those that are kept: its coordinates and so
    /// many numbers that have been found.
    #[inline(always)]
    fn keep(&mut self, place: usize, query: usize, found: usize) {
        if place != self.count {
            let (from, lane) = (place / LANES, place % LANES);
            let (to, to_lane) = (self.count / LANES, self.count % LANES);
            for row in 0..COORDINATES {
                self.tiles[to].coordinates[row][to_lane] = self.tiles[from].coordinates[row][lane];
            }
            for row in 0..found {
                self.tiles[to].found[row][to_lane] = self.tiles[from].found[row][lane];
            }
        }
        self.queries[self.count] = query;
        self.count += 1;
    }

    /// Keeps a query of a tile of the chunk in `f32`.
    #[inline(always)]
    fn keep_single(&mut self, tile: usize, lane: usize, query: usize) {
        let (to, to_lane) = (self.count / LANES, self.count % LANES);
        for row in 0..COORDINATES {
            self.tiles[to].coordinates[row][to_lane] = f64::from(self.singles[tile][row][lane]);
        }
        self.queries[self.count] = query;
        self.count += 1;
    }
}

/// Of a tile in `f32` from which so many queries are left, all are widened at once.
const MOST_LEFT: u32 = 5;

fn report<const N: usize>(stages: [Stage; N], decided: [u32; N], observe: &mut impl FnMut(Stage)) {
    for (stage, count) in stages.into_iter().zip(decided) {
        for _ in 0..count {
            observe(stage);
        }
    }
}

/// `N` tests of a query and `R` numbers that they find, without a branch.
trait Test<const N: usize, const R: usize> {
    /// How many of the numbers found are of use afterwards.
    const HELD: usize;

    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; N], [f64; R]);
}

/// Stages 1 and 2.
struct Apart<K>(PhantomData<K>);

impl<K: Stages> Test<2, 0> for Apart<K> {
    const HELD: usize = 0;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], _: &[f64; FOUND]) -> ([bool; 2], [f64; 0]) {
        let boxes = K::boxes(points, 0.0);
        let is_separated = K::is_separated_by_centres(&K::motion(points), &boxes);
        ([boxes.are_disjoint, is_separated], [])
    }
}

/// The same with a radius, and how far the direction separates.
struct ApartThick<K>(PhantomData<K>);

impl<K: Stages> Test<2, 4> for ApartThick<K> {
    const HELD: usize = 4;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 2], [f64; 4]) {
        let radius = found[0];
        let (are_disjoint, proved) = thick::apart_until_by_centres::<K, _>(points, radius);
        ([are_disjoint, proved >= 1.0], [radius, proved, 0.0, 0.0])
    }
}

/// The same with the room that positions take which are rounded.
struct ApartWithRoom<K, const IS_SINGLE: bool>(PhantomData<K>);

impl<K: Stages, const IS_SINGLE: bool> Test<2, 4> for ApartWithRoom<K, IS_SINGLE> {
    const HELD: usize = 4;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 2], [f64; 4]) {
        let precision = if IS_SINGLE {
            Precision::F32
        } else {
            Precision::F64
        };
        let radius = widened(found[0], room::<K, _>(points, precision));
        let (are_disjoint, proved) = thick::apart_until_by_centres::<K, _>(points, radius);
        ([are_disjoint, proved >= 1.0], [radius, proved, 0.0, 0.0])
    }
}

/// Stage 3.
struct Signs<K>(PhantomData<K>);

impl<K: Stages> Test<1, FOUND> for Signs<K> {
    const HELD: usize = FOUND;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], _: &[f64; FOUND]) -> ([bool; 1], [f64; FOUND]) {
        let cubic = Cubic::unchecked(&K::motion(points));
        let is_decided = cubic.is_valid() & cubic.has_no_root();
        let [b0, b1, b2, b3] = cubic.bernstein;
        ([is_decided], [b0, b1, b2, b3, cubic.permanent, f64::NAN])
    }
}

#[inline(always)]
fn cubic_of<E: Ends>(
    Motion { k, l, m }: &Motion<E>,
    &[b0, b1, b2, b3, permanent, _]: &[f64; FOUND],
) -> Cubic {
    Cubic::of_parts([b0, b1, b2, b3], permanent, [reach(k), reach(l), reach(m)])
}

/// Stage 4, for a miss at the only root in each half of the step.
struct Roots<K>(PhantomData<K>);

impl<K: Stages> Test<1, 0> for Roots<K> {
    const HELD: usize = FOUND;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 1], [f64; 0]) {
        let motion = K::motion(points);
        let cubic = cubic_of(&motion, found);
        let are_apart = crossing::are_apart::<K, _>(&motion, &cubic);
        ([cubic.is_valid() & are_apart], [])
    }
}

/// Stage 4, for the time of a contact.
struct Crossings<K>(PhantomData<K>);

/// How many queries have to be open for it to pay.
const CROSSINGS: usize = 3;

impl<K: Stages> Test<0, FOUND> for Crossings<K> {
    const HELD: usize = FOUND;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 0], [f64; FOUND]) {
        let motion = K::motion(points);
        let cubic = cubic_of(&motion, found);
        let time = crossing::time::<K, _>(points, &motion, &cubic);
        let [b0, b1, b2, b3, permanent, _] = *found;
        let time = if cubic.is_valid() { time } else { 0.0 };
        ([], [b0, b1, b2, b3, permanent, time])
    }
}

/// With a radius: the plane that stays, between the points that are nearest where the direction
/// from middle to middle fails.
struct Fixed<K>(PhantomData<K>);

impl<K: Stages> Test<1, 0> for Fixed<K> {
    const HELD: usize = 4;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 1], [f64; 0]) {
        let [radius, proved, ..] = *found;
        ([thick::are_apart_from::<K, _>(points, radius, proved)], [])
    }
}

/// With a radius: the next plane, which turns.
struct Planes<K>(PhantomData<K>);

/// How many planes that turn are tried here.
const PLANES: u32 = 8;

/// One of so many is not worth another plane for all.
const STRAGGLERS: usize = 6;

impl<K: Stages> Test<1, 4> for Planes<K> {
    const HELD: usize = 4;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 1], [f64; 4]) {
        let [radius, t, planes, last, ..] = *found;
        let next = thick::next_plane::<K, _>(points, radius, t);
        let has_ended = has_ended(last);
        let t = if has_ended { t } else { next.t };
        let planes = if has_ended { planes } else { planes + 1.0 };
        let last = if has_ended | next.is_last { 1.0 } else { 0.0 };
        ([next.is_apart & !has_ended], [radius, t, planes, last])
    }
}

/// The time of a contact that is not certain.
const NONE: f64 = -1.0;

/// With a radius: the contact after the last plane, or at the start. Where it is certain, its place
/// is where the number of planes was.
struct Touches<K>(PhantomData<K>);

impl<K: Stages> Test<0, FOUND> for Touches<K> {
    const HELD: usize = FOUND;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 0], [f64; FOUND]) {
        let [radius, t, planes, last, first, second] = *found;
        let (touch, is_certain) = Touch::new::<K, _>(points, radius, [first, second], t);
        let is_touch = is_certain & (has_ended(last) | (t == 0.0));
        let of = |touch: f64, none: f64| if is_touch { touch } else { none };
        let toi = of(touch.toi, NONE);
        let place = [of(touch.u, planes), of(touch.v, last), touch.error];
        ([], [toi, t, place[0], place[1], place[2], 0.0])
    }
}

/// How the two pass each other without their radius, after [`Touches`].
struct Passages<K>(PhantomData<K>);

impl<K: Stages> Test<0, FOUND> for Passages<K> {
    const HELD: usize = FOUND;

    #[inline(always)]
    fn of(&self, points: &[[Plain; 3]; 4], found: &[f64; FOUND]) -> ([bool; 0], [f64; FOUND]) {
        let [toi, t, u, v, error, _] = *found;
        let passage = Touch::passage::<K, _>(points, toi);
        ([], [toi, t, u, v, error, passage])
    }
}

/// Whether a plane was the last that leads farther, as rows say it.
#[inline(always)]
fn has_ended(last: f64) -> bool {
    last > 0.0
}

fn reached_of(&[_, t, planes, last, ..]: &[f64; FOUND]) -> Reached {
    Reached::ByPlanes {
        t,
        planes: planes as u32,
        is_last: has_ended(last),
    }
}

/// The queries of a tile that tests decide, as bits; what they find is put into the tile.
#[inline(always)]
fn test_tile<const N: usize, const R: usize>(
    test: &impl Test<N, R>,
    Tile { coordinates, found }: &mut Tile,
) -> [u64; N] {
    let mut decided = [[false; LANES]; N];
    for i in 0..LANES {
        let of = |row: usize| Plain::new(coordinates[row][i], coordinates[row + 12][i]);
        let at = |row: usize| [of(row), of(row + 1), of(row + 2)];
        let before = array::from_fn(|row| found[row][i]);
        let (is_decided, after) = test.of(&[at(0), at(3), at(6), at(9)], &before);
        for (lanes, is_decided) in decided.iter_mut().zip(is_decided) {
            lanes[i] = is_decided;
        }
        for (row, after) in found.iter_mut().zip(after) {
            row[i] = after;
        }
    }
    decided.map(bits)
}

/// The bit `i` of the result is that of lane `i`.
#[inline(always)]
fn bits(lanes: [bool; LANES]) -> u64 {
    let bytes = u64::from_le_bytes(lanes.map(u8::from));
    // Byte `i`, 0 or 1, comes to bit `56 + i`: no two summands meet.
    bytes.wrapping_mul(0x0102_0408_1020_4080) >> 56
}

/// The first lanes of a tile, as bits.
#[inline(always)]
fn first_lanes(count: usize) -> u64 {
    (1 << count) - 1
}

/// How many queries each test decides, of those that the ones before it do not, and the mask of
/// those that are left.
#[inline(always)]
fn counted<const N: usize>(decided: [u64; N], mut open: u64, counts: &mut [u32; N]) -> u64 {
    for (decided, count) in decided.into_iter().zip(counts) {
        *count += (decided & open).count_ones();
        open &= !decided;
    }
    open
}

/// The first test of queries that are new.
struct First<'a, S, T, F, const N: usize, const R: usize> {
    open: &'a mut Open,
    source: &'a S,
    queries: Range<usize>,
    test: T,
    /// Puts in what the test takes beside the coordinates.
    prepare: F,
}

impl<S, T, F, const N: usize, const R: usize> WithSimd for First<'_, S, T, F, N, R>
where
    S: Source,
    T: Test<N, R>,
    F: Fn(&mut [Tile; CHUNK / LANES], Range<usize>),
{
    type Output = [u32; N];

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        let First {
            open,
            source,
            queries,
            test,
            prepare,
        } = self;
        let mut counts = [0; N];
        let at = open.next_place();
        debug_assert!(queries.len() <= CHUNK);
        if let Some(tiles) = open.tiles[at / LANES..].first_chunk_mut() {
            source.load(tiles, queries.clone());
            prepare(tiles, queries.clone());
        }
        for first in (0..queries.len()).step_by(LANES) {
            let kept = test_tile(&test, &mut open.tiles[(at + first) / LANES]);
            let lanes = first_lanes(LANES.min(queries.len() - first));
            for lane in Lanes(counted(kept, lanes, &mut counts)) {
                open.keep(at + first + lane, queries.start + first + lane, T::HELD);
            }
        }
        counts
    }
}

/// The first two stages of queries that are new, without a radius, in `f32`.
struct FirstSingle<'a, S, K> {
    open: &'a mut Open,
    source: &'a S,
    queries: Range<usize>,
    kind: PhantomData<K>,
}

impl<S: Source, K: Stages> WithSimd for FirstSingle<'_, S, K> {
    type Output = [u32; 2];

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        let FirstSingle {
            open,
            source,
            queries,
            ..
        } = self;
        let mut counts = [0; 2];
        let at = open.next_place();
        debug_assert!(queries.len() <= CHUNK);
        source.load_single(&mut open.singles, queries.clone());
        for first in (0..queries.len()).step_by(LANES) {
            let single = &open.singles[first / LANES];
            let decided = test_single_tile::<K>(single);
            let lanes = first_lanes(LANES.min(queries.len() - first));
            let left = counted(decided, lanes, &mut counts);
            if left.count_ones() >= MOST_LEFT {
                widen(&mut open.tiles[(at + first) / LANES], single);
                for lane in Lanes(left) {
                    open.keep(at + first + lane, queries.start + first + lane, 0);
                }
            } else {
                for lane in Lanes(left) {
                    open.keep_single(first / LANES, lane, queries.start + first + lane);
                }
            }
        }
        counts
    }
}

/// The queries of a tile that the first two stages decide, as bits.
#[inline(always)]
fn test_single_tile<K: Stages>(coordinates: &SingleTile) -> [u64; 2] {
    let mut decided = [[false; LANES]; 2];
    for i in 0..LANES {
        let of = |row: usize| [coordinates[row][i], coordinates[row + 12][i]];
        let at = |row: usize| [of(row), of(row + 1), of(row + 2)];
        let [boxes, direction] = single::are_apart::<K>(&[at(0), at(3), at(6), at(9)]);
        decided[0][i] = boxes;
        decided[1][i] = direction;
    }
    [bits(decided[0]), bits(decided[1])]
}

#[allow(
    clippy::needless_range_loop,
    reason = "loops over iterators take 6% more instructions of a candidate"
)]
#[inline(always)]
fn widen(tile: &mut Tile, single: &SingleTile) {
    for row in 0..COORDINATES {
        for lane in 0..LANES {
            tile.coordinates[row][lane] = f64::from(single[row][lane]);
        }
    }
}

/// The lanes of a mask, ascending.
struct Lanes(u64);

impl Iterator for Lanes {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let lane = self.0.trailing_zeros() as usize;
        let is_some = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        is_some.then_some(lane)
    }
}

/// A test of the queries that are open.
struct Next<'a, T, const N: usize, const R: usize> {
    open: &'a mut Open,
    test: T,
}

impl<T: Test<N, R>, const N: usize, const R: usize> WithSimd for Next<'_, T, N, R> {
    type Output = [u32; N];

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        let mut counts = [0; N];
        let open = self.open;
        let all = std::mem::take(&mut open.count);
        for first in (0..all).step_by(LANES) {
            let decided = test_tile(&self.test, &mut open.tiles[first / LANES]);
            let lanes = first_lanes(LANES.min(all - first));
            for lane in Lanes(counted(decided, lanes, &mut counts)) {
                open.keep(first + lane, open.queries[first + lane], T::HELD);
            }
        }
        counts
    }
}
