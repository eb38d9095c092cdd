//! Two edges or a vertex and a face as a set of differences.
//!
//! The vectors from a point of one side to a point of the other are `M + v L - u K`, with `(u, v)` in the unit
//! square for edges and in the triangle `u, v >= 0`, `u + v <= 1` for a face. They fill a parallelogram or a
//! triangle whose corners move linearly; the distance of the two sides is its distance from 0.

use crate::certified::motion::{Vector, dot};

/// What is different between edges and a face.
pub(super) trait Shape {
    /// From which of A, B, C and D to which one `K`, `L` and `M` are.
    const WAYS: [(usize, usize); 3];

    /// The corners as `(u, v)`; each number is 0 or 1.
    const CORNERS: &'static [(f64, f64)];

    /// About where the difference is nearest to 0.
    fn nearest(gram: &Gram) -> Spot;

    /// How far a place is at least from where it may not move any more.
    fn clearance(spot: &Spot) -> f64;

    /// By how much the first order conditions of the nearest place fail, in `u` and in `v`, given half of the
    /// gradient of the squared distance: for the nearest place `(u*, v*)`, the product of the gradient with
    /// `(u - u*, v - v*)` is at most that of these with the magnitudes.
    fn slack(spot: &Spot, gradient: [f64; 2]) -> [f64; 2];
}

/// Scalar products of `K`, `L` and `M` at one time.
pub(super) struct Gram {
    pub(super) kk: f64,
    pub(super) ll: f64,
    pub(super) kl: f64,
    mk: f64,
    ml: f64,
}

/// A place, and which way it may move without leaving the part of the boundary that it is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) free: Free,
}

/// Directions in which a place may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Free {
    /// It is a corner.
    Nowhere,
    /// On a side.
    Along(f64, f64),
    /// Inside.
    Everywhere,
}

impl Gram {
    pub(super) fn new(k: &Vector, l: &Vector, m: &Vector) -> Self {
        Gram {
            kk: dot(k, k),
            ll: dot(l, l),
            kl: dot(k, l),
            mk: dot(m, k),
            ml: dot(m, l),
        }
    }

    /// `|K x L|^2`.
    pub(super) fn determinant(&self) -> f64 {
        self.kk * self.ll - self.kl * self.kl
    }

    /// Where no boundary is in the way, times the determinant.
    fn centre(&self) -> (f64, f64) {
        let Gram { kk, ll, kl, mk, ml } = self;
        (mk * ll - ml * kl, mk * kl - ml * kk)
    }
}

/// Two edges: `K = B - A`, `L = D - C`, `M = C - A`.
pub(super) struct Edges;

impl Shape for Edges {
    const WAYS: [(usize, usize); 3] = [(0, 1), (2, 3), (0, 2)];

    const CORNERS: &'static [(f64, f64)] = &[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];

    /// The nearest `v` for the `u` of the lines' nearest points, then the nearest `u` for that (Ericson,
    /// Real-Time Collision Detection, 5.1.9).
    fn nearest(gram: &Gram) -> Spot {
        let u = share(gram.centre().0, gram.determinant());
        let v = share(u * gram.kl - gram.ml, gram.ll);
        let u = share(gram.mk + v * gram.kl, gram.kk);
        let is_inside = |x: f64| x > 0.0 && x < 1.0;
        let free = match (is_inside(u), is_inside(v)) {
            (true, true) => Free::Everywhere,
            (true, false) => Free::Along(1.0, 0.0),
            (false, true) => Free::Along(0.0, 1.0),
            (false, false) => Free::Nowhere,
        };
        Spot { u, v, free }
    }

    fn clearance(spot: &Spot) -> f64 {
        let of = |x: f64| x.min(1.0 - x);
        match spot.free {
            Free::Nowhere => 1.0,
            Free::Along(x, _) => of(if x == 0.0 { spot.v } else { spot.u }),
            Free::Everywhere => of(spot.u).min(of(spot.v)),
        }
    }

    fn slack(spot: &Spot, [u, v]: [f64; 2]) -> [f64; 2] {
        let slack = |x: f64, slope: f64| match x {
            0.0 => (-slope).max(0.0),
            1.0 => slope.max(0.0),
            _ => slope.abs(),
        };
        [slack(spot.u, u), slack(spot.v, v)]
    }
}

/// A vertex A and a face BCD, with the weights `u` of C and `v` of D: `K = B - C`, `L = D - B`, `M = B - A`.
pub(super) struct Face;

impl Shape for Face {
    const WAYS: [(usize, usize); 3] = [(2, 1), (1, 3), (0, 1)];

    const CORNERS: &'static [(f64, f64)] = &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];

    /// The foot in the plane, or the nearest of the nearest points of the sides.
    fn nearest(gram: &Gram) -> Spot {
        let (determinant, centre) = (gram.determinant(), gram.centre());
        let (u, v) = (centre.0 / determinant, centre.1 / determinant);
        if u > 0.0 && v > 0.0 && u + v < 1.0 {
            let free = Free::Everywhere;
            return Spot { u, v, free };
        }
        let Gram { kk, ll, kl, mk, ml } = gram;
        let third = share(kk - mk - ml + kl, ll + kk + 2.0 * kl);
        // One and what is left of it add up to 1 exactly.
        let rest = 1.0 - third;
        let places = [
            (share(*mk, *kk), 0.0, (1.0, 0.0)),
            (0.0, share(-ml, *ll), (0.0, 1.0)),
            (rest, 1.0 - rest, (1.0, -1.0)),
        ];
        let height = |(u, v, _): (f64, f64, _)| {
            u * (u * kk - 2.0 * mk) + v * (v * ll + 2.0 * ml) - 2.0 * u * v * kl
        };
        let [first, second, third] = places;
        let nearer = |x, y| if height(y) < height(x) { y } else { x };
        let (u, v, way) = nearer(nearer(first, second), third);
        let is_corner = [u, v, u + v]
            .iter()
            .filter(|x| **x == 0.0 || **x == 1.0)
            .count()
            > 1;
        let free = if is_corner {
            Free::Nowhere
        } else {
            Free::Along(way.0, way.1)
        };
        Spot { u, v, free }
    }

    fn clearance(spot: &Spot) -> f64 {
        let weights = [1.0 - spot.u - spot.v, spot.u, spot.v];
        let used = weights.into_iter().filter(|weight| *weight != 0.0);
        match spot.free {
            Free::Nowhere => 1.0,
            _ => used.fold(1.0, f64::min),
        }
    }

    /// With the corners `e` and their weights `b`, the product of the gradient with the difference is the sum of
    /// `b* g . (x - e)`, and with `b` for `b*` it is 0: so it is that of `(b* - b) g . (x - e)`, where terms below 0
    /// with `b = 0` only help.
    fn slack(spot: &Spot, [gu, gv]: [f64; 2]) -> [f64; 2] {
        let &Spot { u, v, .. } = spot;
        let from_b = gu * u + gv * v;
        let slack = |weight: f64, rise: f64| {
            if weight == 0.0 {
                rise.max(0.0)
            } else {
                rise.abs()
            }
        };
        let (b, c, d) = (
            slack(1.0 - u - v, from_b),
            slack(u, from_b - gu),
            slack(v, from_b - gv),
        );
        [b + c, b + d]
    }
}

/// `n / d` in `[0, 1]`; 0 if it is not a number.
fn share(n: f64, d: f64) -> f64 {
    let share = n / d;
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}
