//! Two edges or a vertex and a face as a set of differences.
//!
//! The vectors from a point of one side to a point of the other are `M + v L - u K`, with `(u, v)`
//! in the unit square for edges and in the triangle `u, v >= 0`, `u + v <= 1` for a face. They fill
//! a parallelogram or a triangle whose corners move linearly; the distance of the two sides is its
//! distance from 0.

use super::ends::{larger, smaller};
use super::motion::{Vector, dot};

/// Scalar products of `K`, `L` and `M` at one time.
#[derive(Clone, Copy)]
pub(super) struct Gram {
    pub(super) kk: f64,
    pub(super) ll: f64,
    pub(super) kl: f64,
    mk: f64,
    ml: f64,
}

/// A place, and two directions from it: the whole set is in
/// `(u, v) + s directions[0] + r directions[1]`, with a number of at least 0 for a direction that
/// is not free.
///
/// The determinant of the directions is 1 or -1, and their numbers are 0, 1 or -1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) directions: [Direction; 2],
}

/// A direction in which a place may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Direction {
    pub(super) u: f64,
    pub(super) v: f64,
    /// Whether backwards too.
    pub(super) is_free: bool,
}

impl Gram {
    #[inline(always)]
    pub(super) fn new([k, l, m]: &[Vector; 3]) -> Self {
        Gram {
            kk: dot(k, k),
            ll: dot(l, l),
            kl: dot(k, l),
            mk: dot(m, k),
            ml: dot(m, l),
        }
    }

    /// `|K x L|^2`.
    #[inline(always)]
    pub(super) fn determinant(&self) -> f64 {
        self.kk * self.ll - self.kl * self.kl
    }

    /// Where no boundary is in the way, times the determinant.
    #[inline(always)]
    fn centre(&self) -> (f64, f64) {
        let Gram { kk, ll, kl, mk, ml } = self;
        (mk * ll - ml * kl, mk * kl - ml * kk)
    }
}

/// The nearest `v` for the `u` of the lines' nearest points, then the nearest `u` for that
/// (Ericson, Real-Time Collision Detection, 5.1.9).
#[inline(always)]
pub(super) fn nearest_on_edges(gram: &Gram) -> Spot {
    // Divisions that do not wait for each other.
    let (of_k, of_l) = (1.0 / gram.kk, 1.0 / gram.ll);
    let u = clamped(gram.centre().0 / gram.determinant());
    let v = clamped((u * gram.kl - gram.ml) * of_l);
    let u = clamped((gram.mk + v * gram.kl) * of_k);
    Spot::on_edges(u, v)
}

/// The nearest places for `u` of 0 and 1, and for `v` of 0 and 1.
pub(super) fn nearest_to_ends(gram: &Gram) -> [Spot; 4] {
    let of_end = |u: f64| Spot::on_edges(u, clamped((u * gram.kl - gram.ml) / gram.ll));
    let on_end = |v: f64| Spot::on_edges(clamped((gram.mk + v * gram.kl) / gram.kk), v);
    [of_end(0.0), of_end(1.0), on_end(0.0), on_end(1.0)]
}

impl Spot {
    /// A place in the unit square.
    #[inline(always)]
    fn on_edges(u: f64, v: f64) -> Self {
        // The sign of the direction that leads inside, and whether the other one does too.
        let inward = |x: f64| (if x == 1.0 { -1.0 } else { 1.0 }, x > 0.0 && x < 1.0);
        let ((along_u, u_is_free), (along_v, v_is_free)) = (inward(u), inward(v));
        let directions = [
            Direction::new(along_u, 0.0, u_is_free),
            Direction::new(0.0, along_v, v_is_free),
        ];
        Spot { u, v, directions }
    }
}

/// The foot in the plane, or the nearest of the nearest points of the sides. Without a branch.
#[inline(always)]
pub(super) fn nearest_on_face(gram: &Gram) -> Spot {
    let (determinant, centre) = (gram.determinant(), gram.centre());
    let (u, v) = (centre.0 / determinant, centre.1 / determinant);
    let is_inside = (u > 0.0) & (v > 0.0) & (u + v < 1.0);
    let Gram { kk, ll, kl, mk, ml } = gram;
    let third = clamped((kk - mk - ml + kl) / (ll + kk + 2.0 * kl));
    // One and what is left of it add up to 1 exactly.
    let rest = 1.0 - third;
    // Each side with the direction along it and one into the face.
    let sides = [
        [clamped(mk / kk), 0.0, 1.0, 0.0, 0.0, 1.0],
        [0.0, clamped(-ml / ll), 0.0, 1.0, 1.0, 0.0],
        [rest, 1.0 - rest, 1.0, -1.0, -1.0, 0.0],
    ];
    let height = |[u, v, ..]: &[f64; 6]| {
        u * (u * kk - 2.0 * mk) + v * (v * ll + 2.0 * ml) - 2.0 * u * v * kl
    };
    let [first, second, third] = sides;
    let nearer = |x, y| chosen(height(&y) < height(&x), y, x);
    let side = nearer(nearer(first, second), third);
    // At a corner, the directions along both of its sides.
    let [u_side, v_side, ..] = side;
    let is_at = |u: f64, v: f64| (u_side == u) & (v_side == v);
    let corners = [
        (is_at(0.0, 0.0), [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        (is_at(1.0, 0.0), [1.0, 0.0, -1.0, 0.0, -1.0, 1.0]),
        (is_at(0.0, 1.0), [0.0, 1.0, 0.0, -1.0, 1.0, -1.0]),
    ];
    let mut place = side;
    let mut is_corner = false;
    for (is_here, corner) in corners {
        place = chosen(is_here, corner, place);
        is_corner |= is_here;
    }
    let inside = [u, v, 1.0, 0.0, 0.0, 1.0];
    let [u, v, first_u, first_v, second_u, second_v] = chosen(is_inside, inside, place);
    let directions = [
        Direction::new(first_u, first_v, is_inside | !is_corner),
        Direction::new(second_u, second_v, is_inside),
    ];
    Spot { u, v, directions }
}

/// One or the other, number by number.
#[inline(always)]
fn chosen(is_first: bool, first: [f64; 6], second: [f64; 6]) -> [f64; 6] {
    let of = |i: usize| if is_first { first[i] } else { second[i] };
    [of(0), of(1), of(2), of(3), of(4), of(5)]
}

impl Direction {
    #[inline(always)]
    fn new(u: f64, v: f64, is_free: bool) -> Self {
        Direction { u, v, is_free }
    }
}

/// What of a number is in `[0, 1]`; 0 if it is not a number.
#[inline(always)]
fn clamped(x: f64) -> f64 {
    smaller(larger(x, 0.0), 1.0)
}
