//! The certified step: how far two sides may move, and the positions that are stored.
//!
//! A time of impact is exact, but positions at that time are rounded, and rounded edges may lie
//! past each other. So a step needs room for its rounding:
//!
//! - **What rounding does.** [`interpolate`] is off by at most `e` for a coordinate (below). The
//!   motion from the start to the stored positions is linear, and so is the exact one; the two
//!   differ most at their end. So no point of a side is off by more than the largest error `E` of
//!   the side's corners, and the distance of the sides by more than the sum `E1 + E2`, at any time.
//! - **What follows.** If the exact motion keeps a distance of at least `r + E1 + E2` on `[0, s]`,
//!   with bounds that are strictly larger than the errors, the stored motion keeps a distance above
//!   `r`. The time of impact with the radius `r + E1 + E2`, rounded down, is such an `s`.
//! - **Where the two start too near for that**, stored motions are decided themselves: they are
//!   queries like any other.
//!
//! # The error of a coordinate
//!
//! `u = 2^-53`, `X` the larger magnitude of start `a` and end `b`, `D = |b - a|`, and `h = 2^-1075`
//! for underflow. A difference and a sum round by a factor `1 + d`, `|d| <= u / (1 + u)`, and do
//! not underflow; a product by such a factor and `h`.
//!
//! - `fl(b - a)` finite: the product with `s <= 1` is off `(b - a) s` by at most `(2 u + u^2) D + h`,
//!   so the sum by at most `u X + (1 + u) ((2 u + u^2) D + h)`, as the sum before rounding is
//!   within that error of a number between `a` and `b`.
//! - `fl(b - a)` infinite: then `D > 2^1023`. The two products are off by at most
//!   `(2 u + u^2) X + h` each in proportion to `1 - s` and `s`, the sum by `(3 u + 3 u^2) X + 2 h`
//!   altogether, and `X <= D`.
//! - Keeping the result between `a` and `b`, where the exact value is, does not move it away.
//!
//! So `u (X + 3 D) (1 + 2^-20) + 2^-1070` is larger: the factor covers the rounding of the bound
//! itself, and the last term the underflow of both (`u a` and `u b` are each off by at most `h`). Where `a = b` the error is 0.
//!
//! # Positions in `f32`
//!
//! [`Precision::F32`] rounds the ends of the motion to `f32` first, and what is computed then to the
//! nearest `f32`, where the start is one too: a number between them rounds to one between them, so nothing overflows. What is
//! computed is at most `X`, so with `v = 2^-24` it is off by at most `v X` more, and by `2^-150`
//! where it underflows. The factor on `v` covers what the roundings of the bound lose, less than
//! `2^-50 v X`, and `2^-149`, twice what is needed, what they lose where it underflows.

use std::cmp::Ordering;
use std::fmt;

use super::cascade::decide_motion;
use super::ends::{Ends, Plain, larger};
use super::kind::{Kind, Stages};
use super::motion::Positions;
use super::thick::{self, apart_until, start_distance, starts_within};
use crate::contact::Hit;
use crate::environment;
use crate::query::{Coordinate, Point, Radius, Short};

/// How far apart the two sides are kept, beyond their radius.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Clearance {
    /// They do not touch, and no more.
    #[default]
    None,
    /// So many metres.
    Distance(f64),
    /// If they would come within the radius: this share of what they have beyond it at the start,
    /// from 0 to below 1.
    Share(f64),
}

/// A clearance that is not a finite distance of 0 or more, or a share from 0 to below 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearanceError(pub Clearance);

impl fmt::Display for ClearanceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Clearance::Share(share) => {
                let share = Short(share);
                write!(
                    f,
                    "the share is {share}; it has to be 0 or more, and below 1"
                )
            }
            Clearance::Distance(distance) => {
                let distance = Short(distance);
                write!(
                    f,
                    "the clearance is {distance}; it has to be finite, and 0 or more"
                )
            }
            Clearance::None => f.write_str("no clearance is a valid one"),
        }
    }
}

impl std::error::Error for ClearanceError {}

/// The numbers in which positions are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Precision {
    /// `f64`.
    #[default]
    F64,
    /// `f32`. The motion is towards the nearest `f32` of each coordinate at its end, and what starts
    /// at an `f32` is stored as one. A coordinate that starts elsewhere is stored as an `f64`, but at
    /// the end.
    F32,
}

impl Precision {
    /// That of positions of a type.
    #[inline(always)]
    pub(crate) fn of<C: Coordinate>() -> Self {
        match C::IS_SINGLE {
            true => Precision::F32,
            false => Precision::F64,
        }
    }

    /// Whether what is between two numbers is stored as an `f32`.
    #[inline(always)]
    fn is_single(self, start: f64, end: f64) -> bool {
        let is_single = |x: f64| f64::from(x as f32) == x;
        (self == Precision::F32) & is_single(start) & is_single(end)
    }

    /// The number that a coordinate moves to. What is not finite stays so.
    fn target(self, x: f64) -> f64 {
        match self {
            Precision::F32 if x.is_finite() => {
                f64::from(x.clamp(f32::MIN.into(), f32::MAX.into()) as f32)
            }
            _ => x,
        }
    }
}

/// A step that is proved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Advance {
    /// How much of the step is made, from 0 to 1.
    pub step: f64,
    /// The points A, B, C and D to store: those of [`interpolate_in`] at this step.
    pub points: [Point; 4],
    /// Straight motion from the start to these points keeps a distance above this, both ends
    /// included. `None` where no step is proved, so that the points stay.
    pub kept: Option<Radius>,
    /// Why the step is not a whole one.
    pub blocked: Option<Blocked>,
}

/// Why a step ends early.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Blocked {
    /// A larger step would bring the two sides nearer than is kept, or a rounding error of that.
    Ahead,
    /// The two sides come nearer, and start so near to what is kept that rounding has no room. A few
    /// steps were tried; the largest of them that is proved is made, or none.
    Rounding,
    /// The two sides touch at the start, radius or not: no motion from there is apart.
    Touching,
}

/// The largest step, nearly, that keeps two sides apart, and the positions to store.
///
/// A step that ends [`Ahead`](Blocked::Ahead) is at most a part in 2^24 shorter than the time of
/// impact, unless rounding leaves room for less: then it is decided, and as large as the room for
/// rounding lets it be.
///
/// The query says where the points are, where they want to go, and the radius. The next step starts
/// at the stored points, so nothing ever passes through anything, however many steps follow.
///
/// The distance that is kept is the radius and the [`Clearance`]. Two sides that start nearer than
/// that keep nine tenths of what they have beyond the radius, or of their distance if they start
/// within the radius; where rounding leaves no room even for that, they keep the radius, or do not
/// touch. They are free to part.
///
/// # Guarantee
///
/// Straight motion from `query.start()` to [`Advance::points`] keeps a distance above
/// [`Advance::kept`], exactly, in real arithmetic. The preconditions are those of
/// [`decide`](super::decide).
///
/// # Errors
///
/// [`ClearanceError`] if the clearance is not a finite distance of 0 or more, or a share
/// from 0 to below 1.
///
/// # Example
///
/// ```
/// use tunnelproof::{Clearance, EdgeEdge, Point, advance, decide};
///
/// let p = Point::new;
/// let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 0.7), p(0.0, 1.0, 0.7)];
/// let mut end = start;
/// end[2].z = -1.0;
/// end[3].z = -1.0;
/// let moved = advance(&EdgeEdge::new(start, end, 0.0)?, Clearance::None)?;
/// // Nearly as far as the contact, and the stored positions are still apart.
/// assert!((moved.step - 0.7 / 1.7).abs() < 1e-7);
/// assert!(decide(&EdgeEdge::new(start, moved.points, 0.0)?).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn advance<K: Kind>(query: &K, clearance: Clearance) -> Result<Advance, ClearanceError> {
    advance_in(query, clearance, Precision::F64)
}

/// [`advance`], with positions that are stored in `f32` where that is asked.
///
/// The guarantee is the same, and about the numbers that are stored: if all coordinates of
/// `query.start()` are `f32`, so are those of [`Advance::points`], and `as f32` changes none of them.
/// A whole step ends at the nearest `f32` of each coordinate of `query.end()`, or the largest where
/// that is beyond it. There is less room: two sides that are nearer than some 2^-21 of their
/// coordinates, beyond what they keep, may be [`Rounding`](Blocked::Rounding).
///
/// # Errors
///
/// As [`advance`].
///
/// # Example
///
/// ```
/// use tunnelproof::{Clearance, EdgeEdge, Point, Precision, advance_in, decide};
///
/// let p = |x: f32, y: f32, z: f32| Point::new(x.into(), y.into(), z.into());
/// let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 0.7), p(0.0, 1.0, 0.7)];
/// let mut end = start;
/// end[2].z = -1.0;
/// end[3].z = -1.0;
/// let query = EdgeEdge::new(start, end, 0.0)?;
/// let moved = advance_in(&query, Clearance::None, Precision::F32)?;
/// let z = moved.points[2].z as f32;
/// assert_eq!(f64::from(z), moved.points[2].z);
/// assert!(z > 0.0 && z < 1e-6);
/// assert!(decide(&EdgeEdge::new(start, moved.points, 0.0)?).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn advance_in<K: Kind>(
    query: &K,
    clearance: Clearance,
    precision: Precision,
) -> Result<Advance, ClearanceError> {
    debug_assert_eq!(environment::check(), Ok(()));
    let clearance = clearance.checked()?;
    let end = query.end().map(|point| point.map(|x| precision.target(x)));
    let positions = Positions::of(query.start(), &end);
    let (step, kept, blocked) = furthest::<K>(&positions, query.radius(), clearance, precision);
    Ok(Advance {
        step,
        points: positions.stored(step, precision).map(Point::from),
        kept,
        blocked,
    })
}

/// The position to store at a step from 0 to 1: `start + (end - start) * step`, kept between the
/// two; `start` at 0 and `end` at 1, exactly. A point that does not move stays where it is.
///
/// Where `end - start` overflows it is `start * (1 - step) + end * step`.
///
/// The proof of [`advance`] is of the positions that this function gives. A step outside of
/// `[0, 1]` counts as the nearer one of the two; NaN gives NaN where the point moves.
pub fn interpolate(start: &Point, end: &Point, step: f64) -> Point {
    interpolate_in(start, end, step, Precision::F64)
}

/// The position to store at a step, that of the proof of [`advance_in`]. With [`Precision::F32`] it
/// is what [`interpolate`] gives between the start and the nearest `f32` of the end, rounded to the
/// nearest `f32` where the start is one.
pub fn interpolate_in(start: &Point, end: &Point, step: f64, precision: Precision) -> Point {
    let end = end.map(|x| precision.target(x));
    stored(&(*start).into(), &end.into(), step, precision).into()
}

/// As [`interpolate_in`], with an end that is its own [target](Precision::target).
#[inline(always)]
pub(super) fn stored(
    start: &[f64; 3],
    end: &[f64; 3],
    step: f64,
    precision: Precision,
) -> [f64; 3] {
    [0, 1, 2].map(|i| coordinate_in(start[i], end[i], step, precision))
}

impl Positions {
    /// The positions to store at a step.
    fn stored(&self, step: f64, precision: Precision) -> [[f64; 3]; 4] {
        std::array::from_fn(|i| stored(&self.start[i], &self.end[i], step, precision))
    }
}

#[inline(always)]
fn coordinate_in(start: f64, end: f64, step: f64, precision: Precision) -> f64 {
    let between = coordinate(start, end, step);
    match precision.is_single(start, end) {
        true => f64::from(between as f32),
        false => between,
    }
}

#[inline(always)]
fn coordinate(start: f64, end: f64, step: f64) -> f64 {
    // The end comes first: it may be a zero of the other sign than the start.
    if step >= 1.0 {
        return end;
    }
    if step <= 0.0 || start == end {
        return start;
    }
    let difference = end - start;
    let between = if difference.is_finite() {
        start + difference * step
    } else {
        start * (1.0 - step) + end * step
    };
    let (low, high) = (start.min(end), start.max(end));
    // As `clamp`, which panics where both are NaN.
    if between < low {
        low
    } else if between > high {
        high
    } else {
        between
    }
}

/// More than the error of [`coordinate`], at any step.
#[inline(always)]
fn rounding(start: f64, end: f64) -> f64 {
    const U: f64 = f64::EPSILON / 2.0;
    const SLACK: f64 = 1.0 + 1.0 / 1_048_576.0;
    /// 2^-1070.
    const UNDERFLOW: f64 = f64::from_bits(16);
    let size = start.abs().max(end.abs());
    let difference = (end * U - start * U).abs();
    let error = ((size * U + 3.0 * difference) * SLACK) + UNDERFLOW;
    if start == end { 0.0 } else { error }
}

/// More than the error of [`coordinate_in`], at any step.
#[inline(always)]
fn rounding_in(start: f64, end: f64, precision: Precision) -> f64 {
    /// 2^-24, and more than what multiplication and sums lose.
    const V: f64 = 1.0 / 16_777_216.0 * (1.0 + 1.0 / 1_048_576.0);
    /// 2^-149.
    const LEAST: f64 = 1.401298464324817e-45;
    let double = rounding(start, end);
    let single = start.abs().max(end.abs()) * V + LEAST + double;
    if (start != end) & precision.is_single(start, end) {
        single
    } else {
        double
    }
}

impl Clearance {
    /// Itself, if it means something.
    pub(crate) fn checked(self) -> Result<Self, ClearanceError> {
        let is_valid = match self {
            Clearance::None => true,
            Clearance::Distance(distance) => distance >= 0.0 && distance.is_finite(),
            Clearance::Share(share) => (0.0..1.0).contains(&share),
        };
        match is_valid {
            true => Ok(self),
            false => Err(ClearanceError(self)),
        }
    }
}

/// The share that two sides keep of what they have, if they start nearer than they should.
const NEAR: f64 = 0.9;

/// The share of a time of impact up to which planes have to prove a step: they do, unless the two
/// sides approach slowly.
const NEARLY: f64 = 1.0 - 1.0 / 16_777_216.0;

/// How often a step is halved where the rounding of positions is in the way.
const HALVINGS: i32 = 10;

/// What a motion is proved to keep of the distance of two sides, and how long.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limit {
    /// They keep a distance above this.
    pub(crate) kept: Radius,
    /// Whether that is all they should keep: the radius and the clearance.
    pub(crate) is_whole: bool,
    /// The time up to which the exact motion does so, rounded down; `None` if all of it does.
    pub(crate) toi: Option<f64>,
    /// Rounded positions do so up to this step, as far as planes prove it; 0 if they prove it of
    /// none.
    pub(crate) until: f64,
    /// Whether that is less than half of the time of impact by a decision: there is hardly room for
    /// rounding, and larger steps may be proved one by one.
    pub(crate) is_short: bool,
}

impl Limit {
    /// Whether a decision may prove more than planes did.
    pub(crate) fn is_rough(&self) -> bool {
        self.until < self.toi.unwrap_or(1.0) * NEARLY
    }

    /// As far as a decision proves it.
    pub(crate) fn decided<K: Kind>(mut self, positions: &Positions, precision: Precision) -> Self {
        let radius = with_room::<K::Stages>(positions, self.kept, precision);
        if let Some(radius) = radius {
            let toi = first_toi::<K>(positions, radius);
            self.until = self.until.max(toi.unwrap_or(1.0));
        }
        self.is_short = self.toi.is_some_and(|toi| self.until < 0.5 * toi);
        self
    }
}

/// The [`Limit`] of a motion; `None` if the two sides touch at the start.
pub(super) fn limit<K: Kind>(
    positions: &Positions,
    radius: Radius,
    clearance: Clearance,
    precision: Precision,
) -> Option<Limit> {
    let starts_within =
        |kept: Radius| !kept.is_zero() && starts_within::<K::Stages>(positions, kept);
    let touches = |kept| starts_within(kept) || first_toi::<K>(positions, kept).is_some();
    // About. What is kept is decided for what it is. Where a side is thin, another point may be taken
    // for the nearest, and the distance is less: that is found out where what follows fails.
    let distance = || start_distance::<K::Stages>(positions);
    let decided = || decided_distance::<K::Stages>(positions, distance());
    let beyond_of = |share: f64, distance: f64| with(radius, share * (distance - radius.rounded()));
    let beyond = |share: f64| beyond_of(share, distance());
    let beyond_decided = |share: f64| beyond(share).and_then(|_| beyond_of(share, decided()));
    let wanted = || match clearance {
        Clearance::None => Some(radius),
        Clearance::Distance(distance) => with(radius, distance),
        Clearance::Share(_) if !touches(radius) => Some(radius),
        Clearance::Share(share) => beyond(share),
    };
    let share_decided = || match clearance {
        Clearance::Share(share) => beyond_decided(share),
        _ => None,
    };
    // The first two are all that they should keep.
    let candidates: [&dyn Fn() -> Option<Radius>; 8] = [
        &wanted,
        &share_decided,
        &|| beyond(NEAR),
        &|| beyond_decided(NEAR),
        &|| Some(radius),
        &|| with(Radius::ZERO, NEAR * distance()),
        &|| with(Radius::ZERO, NEAR * decided()),
        &|| Some(Radius::ZERO),
    ];
    for (rank, candidate) in candidates.into_iter().enumerate() {
        let Some(kept) = candidate() else { continue };
        // What is cheap to see at the start needs no time of impact.
        if starts_within(kept) {
            continue;
        }
        let hit = first_contact::<K>(positions, kept);
        // The time of impact is 0: the two start as near as that.
        if hit.is_some_and(|hit| hit.toi_above == 0.0) {
            continue;
        }
        let toi = hit.map(|hit| hit.toi);
        let radius = with_room::<K::Stages>(positions, kept, precision);
        let until = radius.map_or(0.0, |radius| {
            apart_until::<K::Stages>(&positions.points(), radius)
        });
        return Some(Limit {
            kept,
            is_whole: rank < 2,
            toi,
            until,
            is_short: false,
        });
    }
    None
}

/// The distance of the two sides at the start, or `most` if that is less: at most a part in 2^20 less
/// than it is, and 0 where it is hardly a number.
fn decided_distance<K: Stages>(positions: &Positions, most: f64) -> f64 {
    /// The bits of some 2^-1042, and of a part in 2^20.
    const LEAST: u64 = 1 << 32;
    let is_above = |bits: u64| {
        let distance = f64::from_bits(bits);
        K::compare_distance(positions, distance.into(), 0.0) == Ordering::Greater
    };
    // Most of those that are asked about touch.
    if !is_above(LEAST) {
        return 0.0;
    }
    // Numbers above 0 are ordered as their bits are.
    let (mut low, mut high) = (LEAST, most.max(0.0).to_bits());
    // Ends: the difference is halved.
    while high.saturating_sub(low) > LEAST {
        let middle = low + (high - low) / 2;
        if is_above(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::from_bits(low.min(high))
}

/// Whether straight motion to the rounded positions at a step keeps a distance above this.
pub(super) fn is_apart_until<K: Kind>(
    positions: &Positions,
    kept: Radius,
    step: f64,
    precision: Precision,
) -> bool {
    let stored = Positions {
        start: positions.start,
        end: positions.stored(step, precision),
    };
    first_toi::<K>(&stored, kept).is_none()
}

/// Steps to try where rounding is in the way: one, and halves of it.
pub(super) fn halved(step: f64) -> impl Iterator<Item = f64> {
    (0..=HALVINGS).map(move |k| step * 0.5f64.powi(k))
}

/// The step of [`Advance`], what is kept, and why it is no more.
fn furthest<K: Kind>(
    positions: &Positions,
    radius: Radius,
    clearance: Clearance,
    precision: Precision,
) -> (f64, Option<Radius>, Option<Blocked>) {
    let Some(mut limit) = limit::<K>(positions, radius, clearance, precision) else {
        return (0.0, None, Some(Blocked::Touching));
    };
    let Some(toi) = limit.toi else {
        return (1.0, Some(limit.kept), None);
    };
    if limit.is_rough() {
        limit = limit.decided::<K>(positions, precision);
    }
    let Limit {
        kept,
        until,
        is_short,
        ..
    } = limit;
    let moves = |step: f64| positions.stored(step, precision) != positions.start;
    let is_proved = until > 0.0 && moves(until);
    let ahead = (until, Some(kept), Some(Blocked::Ahead));
    if is_proved && !is_short {
        return ahead;
    }
    let is_apart = |step: f64| is_apart_until::<K>(positions, kept, step, precision);
    // Ends: there are so many halvings and no more.
    let mut larger = halved(toi).take_while(|&step| step > until);
    let step = larger.find(|&step| moves(step) && is_apart(step));
    match step {
        Some(step) => (step, Some(kept), Some(Blocked::Rounding)),
        None if is_proved => ahead,
        None => (0.0, None, Some(Blocked::Rounding)),
    }
}

/// The first contact of a motion within a radius.
#[inline]
fn first_contact<K: Kind>(positions: &Positions, radius: Radius) -> Option<Hit<K::Place>> {
    decide_motion::<K::Stages>(|| *positions, radius, &mut |_| {})
}

/// When the two sides of a motion first come within a radius, rounded down.
#[inline(always)]
pub(crate) fn first_toi<K: Kind>(positions: &Positions, radius: Radius) -> Option<f64> {
    match radius.is_zero() {
        true => first_contact::<K>(positions, radius).map(|hit| hit.toi),
        false => thick::toi::<K::Stages>(positions, radius),
    }
}

/// At least a distance and the sum of the rounding errors of both sides.
#[inline(always)]
fn with_room<K: Stages>(
    positions: &Positions,
    kept: Radius,
    precision: Precision,
) -> Option<Radius> {
    with(kept, room::<K, _>(&positions.points::<Plain>(), precision))
}

/// At least the sum of the rounding errors of both sides.
#[inline(always)]
pub(super) fn room<K: Stages, E: Ends>(points: &[[E; 3]; 4], precision: Precision) -> f64 {
    let of = |[x, y, z]: &[E; 3]| {
        let axis = |x: &E| rounding_in(x.start(), x.end(), precision);
        axis(x) + axis(y) + axis(z)
    };
    let [a, b, c, d] = points;
    let (a, b, c, d) = (of(a), of(b), of(c), of(d));
    let both = match K::FIRST {
        1 => a + larger(larger(b, c), d),
        _ => larger(a, b) + larger(c, d),
    };
    both * (1.0 + 8.0 * f64::EPSILON)
}

/// Above the sum of two numbers of at least 0, unless it is infinite.
///
/// The sum is off by a factor of at least `1 - u`, and so is its product with `1 + 8 u`. What that
/// loses where it underflows is far below what is added.
#[inline(always)]
pub(super) fn widened(radius: f64, room: f64) -> f64 {
    (radius + room) * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// More than the rounding error of a position: the sum of those along the axes is at least their
/// Euclidean sum.
#[inline(always)]
pub(crate) fn rounding_of(start: &[f64; 3], end: &[f64; 3], precision: Precision) -> f64 {
    let axis = |i: usize| rounding_in(start[i], end[i], precision);
    axis(0) + axis(1) + axis(2)
}

/// At least the radius and a distance; `None` if one is not a number of 0 or more.
fn with(radius: Radius, distance: f64) -> Option<Radius> {
    let sum = radius.beyond(distance);
    sum.is_valid().then_some(sum)
}

#[cfg(test)]
mod tests;
