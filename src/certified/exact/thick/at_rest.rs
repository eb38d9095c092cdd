//! Two sides at one time: how far apart they are, and where they are nearest.
//!
//! As the differences of a point of the second side and one of the first are `M + v L - u K`, all
//! squared distances are sums of products of the six inner products of `K`, `L` and `M`. With these
//! a question takes some fifty products of integers. By vectors of polynomials
//! ([`Sides`](super::Sides)), which are constants here, it is the same and takes nine times as many
//! instructions.

use std::cmp::Ordering;

use crate::certified::exact::coordinates::{self, Point, dot, in_unit, radius_in_unit, sub};
use crate::certified::exact::integer::{Integer, ratio};

/// Inner products of `K`, `L` and `M`, and the square of the radius.
pub(super) struct AtRest {
    kk: Integer,
    kl: Integer,
    ll: Integer,
    km: Integer,
    lm: Integer,
    mm: Integer,
    radius: Square,
}

/// The square of the radius: `square 2^shift` in the unit of the coordinates, squared.
struct Square {
    square: Integer,
    shift: i64,
}

/// The features that are nearest, those with the fewest points.
pub(super) struct Nearest<const W: usize> {
    /// The squared distance of what they span is `numerator / denominator`; the latter is above 0.
    numerator: Integer,
    denominator: Integer,
    place: [Share; W],
}

/// A number in `[0, 1]`.
enum Share {
    Zero,
    One,
    /// A quotient, whose denominator is above 0.
    Quotient(Integer, Integer),
}

use Share::{One, Quotient, Zero};

impl<const W: usize> Nearest<W> {
    /// The numbers that say where the nearest points are, as
    /// [`Place::values`](super::Place::values).
    pub(super) fn values(&self) -> [f64; W] {
        values(&self.place)
    }
}

fn values<const W: usize>(place: &[Share; W]) -> [f64; W] {
    place.each_ref().map(|share| match share {
        Zero => 0.0,
        One => 1.0,
        Quotient(n, d) => ratio(n, d).clamp(0.0, 1.0),
    })
}

/// What is known of the nearest features so far.
struct Search<const W: usize>(Option<Nearest<W>>);

impl<const W: usize> Search<W> {
    /// Takes features at this squared distance, if they are nearer than those before.
    fn try_at(
        &mut self,
        numerator: Integer,
        denominator: &Integer,
        place: impl FnOnce() -> [Share; W],
    ) {
        let is_nearer = |best: &Nearest<W>| {
            times(&numerator, &best.denominator) < times(&best.numerator, denominator)
        };
        if self.0.as_ref().is_none_or(is_nearer) {
            self.0 = Some(Nearest {
                numerator,
                denominator: denominator.clone(),
                place: place(),
            });
        }
    }

    /// The same of two vertices.
    fn try_vertices(&mut self, squared: &Integer, place: [Share; W]) {
        self.try_at(squared.clone(), &Integer::from(1), || place);
    }

    /// The same of a vertex and an edge, if the nearest point is on it: with the way `w` from the
    /// vertex to the edge's start and the edge's vector `e` these are `w . w`, `w . e` and `e . e`.
    /// `place` gets the shares of the edge's end and of its start.
    fn try_edge(
        &mut self,
        ww: &Integer,
        we: &Integer,
        ee: &Integer,
        place: impl FnOnce([Share; 2]) -> [Share; W],
    ) {
        let rest = plus(ee, we);
        if ee.is_zero() || we.sign().is_gt() || rest.sign().is_lt() {
            return;
        }
        let numerator = minus(&times(ww, ee), &times(we, we));
        self.try_at(numerator, ee, || {
            let quotient = |n| Quotient(n, ee.clone());
            place([quotient(negative(we)), quotient(rest)])
        });
    }
}

impl AtRest {
    /// Two edges: `K = B - A`, `L = D - C`, `M = C - A`.
    pub(super) fn edges(points: &[[f64; 3]; 4], radii: [f64; 2]) -> Self {
        let unit = coordinates::unit(points.iter().flatten());
        AtRest::edges_in(&in_unit(points, unit), unit, radii)
    }

    /// The same, the points in multiples of `2^unit`.
    pub(super) fn edges_in([a, b, c, d]: &[Point; 4], unit: i32, radii: [f64; 2]) -> Self {
        AtRest::of([&sub(b, a), &sub(d, c), &sub(c, a)], unit, radii)
    }

    /// A vertex A and a face BCD: `K = B - C`, `L = D - B`, `M = B - A`, so that `u` and `v` are the
    /// weights of C and D.
    pub(super) fn face(points: &[[f64; 3]; 4], radii: [f64; 2]) -> Self {
        let unit = coordinates::unit(points.iter().flatten());
        AtRest::face_in(&in_unit(points, unit), unit, radii)
    }

    /// The same, the points in multiples of `2^unit`.
    pub(super) fn face_in([a, b, c, d]: &[Point; 4], unit: i32, radii: [f64; 2]) -> Self {
        AtRest::of([&sub(b, c), &sub(d, b), &sub(b, a)], unit, radii)
    }

    fn of([k, l, m]: [&Point; 3], unit: i32, radii: [f64; 2]) -> Self {
        let own = coordinates::unit(radii.iter());
        let radius = radius_in_unit(radii, own);
        AtRest {
            kk: dot(k, k),
            kl: dot(k, l),
            ll: dot(l, l),
            km: dot(k, m),
            lm: dot(l, m),
            mm: dot(m, m),
            radius: Square {
                square: times(&radius, &radius),
                shift: 2 * i64::from(own - unit),
            },
        }
    }

    /// The square of the normal `K x L`.
    fn n2(&self) -> Integer {
        minus(&times(&self.kk, &self.ll), &times(&self.kl, &self.kl))
    }

    /// Whether two edges are parallel or one is a point, or a face has no area.
    pub(super) fn is_flat(&self) -> bool {
        self.n2().is_zero()
    }

    /// The squared distance of the nearest features compared with that of the radius.
    pub(super) fn compare<const W: usize>(&self, nearest: &Nearest<W>) -> Ordering {
        let Square { square, shift } = &self.radius;
        let up = |by: i64| by.max(0).unsigned_abs();
        let own = nearest.numerator.shifted(up(-shift));
        own.cmp(&times(square, &nearest.denominator).shifted(up(*shift)))
    }

    /// `|w|^2` at the corner `u = 0`, `v = 1`.
    fn at_v(&self) -> Integer {
        plus(&plus(&self.mm, &self.ll), &twice(&self.lm))
    }

    /// `|w|^2` at the corner `u = 1`, `v = 0`.
    fn at_u(&self) -> Integer {
        minus(&plus(&self.mm, &self.kk), &twice(&self.km))
    }

    /// Where two edges are nearest.
    pub(super) fn nearest_of_edges(&self) -> Option<Nearest<2>> {
        let AtRest {
            kk, kl, ll, km, lm, ..
        } = self;
        let (a_c, a_d, b_c) = (&self.mm, &self.at_v(), &self.at_u());
        let b_d = &minus(&plus(a_d, kk), &twice(&plus(km, kl)));
        let mut nearest = Search(None);
        nearest.try_vertices(a_c, [Zero, Zero]);
        nearest.try_vertices(a_d, [Zero, One]);
        nearest.try_vertices(b_c, [One, Zero]);
        nearest.try_vertices(b_d, [One, One]);
        nearest.try_edge(a_c, lm, ll, |[v, _]| [Zero, v]);
        nearest.try_edge(b_c, &minus(lm, kl), ll, |[v, _]| [One, v]);
        nearest.try_edge(a_c, &negative(km), kk, |[u, _]| [u, Zero]);
        nearest.try_edge(a_d, &negative(&plus(km, kl)), kk, |[u, _]| [u, One]);
        self.try_inside(&mut nearest, |u, v, n2| {
            let is_inside = is_share(&u, n2) && is_share(&v, n2);
            is_inside.then(|| [u, v].map(|share| Quotient(share, n2.clone())))
        });
        nearest.0
    }

    /// Where a vertex and a face are nearest: the weights of B, C and D.
    pub(super) fn nearest_of_face(&self) -> Option<Nearest<3>> {
        let AtRest {
            kk, kl, ll, km, lm, ..
        } = self;
        let (to_b, to_c, to_d) = (&self.mm, &self.at_u(), &self.at_v());
        // From C to D.
        let last = plus(&plus(kk, ll), &twice(kl));
        let along_last = minus(&plus(km, lm), &plus(kk, kl));
        let mut nearest = Search(None);
        nearest.try_vertices(to_b, [One, Zero, Zero]);
        nearest.try_vertices(to_c, [Zero, One, Zero]);
        nearest.try_vertices(to_d, [Zero, Zero, One]);
        nearest.try_edge(to_b, &negative(km), kk, |[c, b]| [b, c, Zero]);
        nearest.try_edge(to_c, &along_last, &last, |[d, c]| [Zero, c, d]);
        nearest.try_edge(to_b, lm, ll, |[d, b]| [b, Zero, d]);
        self.try_inside(&mut nearest, |c, d, n2| {
            let b = minus(&minus(n2, &c), &d);
            let is_inside = [&b, &c, &d].iter().all(|share| share.sign().is_ge());
            is_inside.then(|| [b, c, d].map(|share| Quotient(share, n2.clone())))
        });
        nearest.0
    }

    /// The place at which the difference is nearest to 0 without a border: `u` and `v` times `N . N`,
    /// and that, are given to `inside`, which says what place that is, if it is one. `|w|^2` is there
    /// `M . w`, as `w` is perpendicular to `K` and `L`.
    fn try_inside<const W: usize>(
        &self,
        nearest: &mut Search<W>,
        inside: impl FnOnce(Integer, Integer, &Integer) -> Option<[Share; W]>,
    ) {
        let AtRest {
            kk, kl, ll, km, lm, ..
        } = self;
        let n2 = self.n2();
        if n2.is_zero() {
            return;
        }
        let u = minus(&times(km, ll), &times(lm, kl));
        let v = minus(&times(km, kl), &times(lm, kk));
        let by_place = minus(&times(lm, &v), &times(km, &u));
        let numerator = plus(&times(&self.mm, &n2), &by_place);
        if let Some(place) = inside(u, v, &n2) {
            nearest.try_at(numerator, &n2, || place);
        }
    }

    /// The ends of the part along which two edges are nearest, the second one if that is more than a
    /// point, where they are parallel and beside each other; as
    /// [`Sides::overlap`](super::Sides::overlap).
    pub(super) fn overlap_of_edges(&self) -> Option<([f64; 2], Option<[f64; 2]>)> {
        let AtRest {
            kk, kl, ll, km, lm, ..
        } = self;
        if !self.is_flat() || kk.is_zero() || ll.is_zero() {
            return None;
        }
        let (to_c, to_d) = (km, &plus(km, kl));
        let is_same_way = kl.sign().is_gt();
        let ([low, high], [v_low, v_high]) = match is_same_way {
            true => ([to_c, to_d], [Zero, One]),
            false => ([to_d, to_c], [One, Zero]),
        };
        let low_to_b = kk.cmp(low);
        let high_to_a = high.sign();
        if low_to_b.is_lt() || high_to_a.is_lt() {
            return None;
        }
        let on_ab = |at: &Integer| Quotient(at.clone(), kk.clone());
        let on_cd = |at: Integer| Quotient(at, ll.clone());
        let first = match low.sign().is_le() {
            true => [Zero, on_cd(negative(lm))],
            false => [on_ab(low), v_low],
        };
        let second = match (*kk).cmp(high).is_le() {
            true => [One, on_cd(minus(kl, lm))],
            false => [on_ab(high), v_high],
        };
        let is_more = low_to_b.is_gt() && high_to_a.is_gt();
        Some((values(&first), is_more.then(|| values(&second))))
    }
}

/// Whether `0 <= n <= d`.
fn is_share(n: &Integer, d: &Integer) -> bool {
    n.sign().is_ge() && n <= d
}

fn plus(a: &Integer, b: &Integer) -> Integer {
    Integer::sum(a, b)
}

fn minus(a: &Integer, b: &Integer) -> Integer {
    Integer::difference(a, b)
}

fn times(a: &Integer, b: &Integer) -> Integer {
    Integer::product(a, b)
}

fn twice(a: &Integer) -> Integer {
    a.shifted(1)
}

fn negative(a: &Integer) -> Integer {
    let mut negative = a.clone();
    negative.negate();
    negative
}

#[cfg(test)]
mod tests;
