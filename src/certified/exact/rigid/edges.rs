//! An edge AB and an edge CD of a turning body, in the body's frame and times `D`: `K = B - A`,
//! `M = C - A`, `D L` with `L = D - C` at rest, and `N = K x L`, of degree 3, or 4 if both turn.

use std::cmp::Ordering;

use super::confined::End;
use super::motion::InBody;
use super::{Locus, Sides, is_between};
use crate::certified::exact::thick::vector::{Vector, add, cross, dot, is_zero, neg, sub};
use crate::certified::exact::thick::{self, Place, Poly, Reach, Share, Time};
use crate::certified::rigid::Turning;
use crate::contact::{Case, Flags};
use crate::query::Radius;

#[derive(Clone)]
pub(super) struct Edges {
    k: Vector,
    l: Vector,
    /// `D L`.
    dl: Vector,
    m: Vector,
    n: Vector,
    d: Poly,
    f: Poly,
    unit: i32,
}

impl Edges {
    pub(super) fn new(query: &Turning<'_, 2, 2>) -> Self {
        let InBody {
            first: [a, b],
            second: [c, end],
            d,
            unit,
        } = InBody::new(query);
        let times_d = |v: &Vector| -> Vector { v.each_ref().map(|x| Poly::product(x, &d)) };
        let (k, l, m) = (sub(&b, &a), sub(&end, &c), sub(&times_d(&c), &a));
        let n = cross(&k, &l);
        Edges {
            dl: times_d(&l),
            f: dot(&m, &n),
            k,
            l,
            m,
            n,
            d,
            unit,
        }
    }

    /// The same with a radius.
    pub(super) fn thick(&self, radius: Radius) -> (thick::Edges, Reach) {
        let Edges { k, l, m, d, .. } = self.clone();
        let reach = Reach::new(radius.parts(), self.unit, &d);
        (thick::Edges::of(k, l, m, d), reach)
    }

    fn vanishes(v: &Vector, time: &Time) -> bool {
        v.iter().all(|component| time.sign_of(component).is_eq())
    }

    /// A component of `N` that is not 0, and its sign.
    fn axis(&self, time: &Time) -> Option<(usize, Ordering)> {
        let signs = self.n.iter().map(|component| time.sign_of(component));
        signs.enumerate().find(|(_, sign)| sign.is_ne())
    }

    /// The lines meet in one point: `M x L = u N` and `M x K = v D N`.
    fn locus_at_angle(&self, time: &Time, axis: usize, sign: Ordering) -> Option<Locus<2>> {
        let (u, n) = (cross_component(&self.m, &self.l, axis), &self.n[axis]);
        let inside_first = is_between(time, &u, n, sign)?;
        let v = cross_component(&self.m, &self.k, axis);
        let dn = Poly::product(&self.d, n);
        let inside_second = is_between(time, &v, &dn, sign)?;
        Some(Locus {
            first: Place([Share::Quotient(u, n.clone()), Share::Quotient(v, dn)]),
            second: None,
            is_inside: inside_first && inside_second,
        })
    }

    /// `AB` is a point, at `v = -M . L / D L . L` of CD, which is none.
    fn locus_of_first_point(&self, time: &Time) -> Option<Locus<2>> {
        if !Self::vanishes(&cross(&self.m, &self.l), time) {
            return None;
        }
        let v = Poly::difference(&Poly::default(), &dot(&self.m, &self.l));
        let length = dot(&self.dl, &self.l);
        is_between(time, &v, &length, Ordering::Greater)?;
        Some(Locus::at(Place([Share::None, Share::Quotient(v, length)])))
    }

    /// `CD` is a point, at `u = M . K / K . K` of AB, which is none.
    fn locus_of_second_point(&self, time: &Time) -> Option<Locus<2>> {
        if !Self::vanishes(&cross(&self.m, &self.k), time) {
            return None;
        }
        let (u, length) = (dot(&self.m, &self.k), dot(&self.k, &self.k));
        is_between(time, &u, &length, Ordering::Greater)?;
        Some(Locus::at(Place([Share::Quotient(u, length), Share::None])))
    }

    /// Both are on one line. Along K, A is at 0, B at `K . K`, C at `M . K` and D at
    /// `(M + D L) . K`.
    fn overlap(&self, time: &Time) -> Option<Locus<2>> {
        let Edges { k, l, dl, m, .. } = self;
        let (kk, ll, ml) = (dot(k, k), dot(dl, l), dot(m, l));
        let (to_c, to_d) = (dot(m, k), dot(&add(m, dl), k));
        let is_same_way = time.sign_of(&dot(k, l)).is_gt();
        let ([low, high], [v_low, v_high]) = match is_same_way {
            true => ([&to_c, &to_d], [Share::None, Share::All]),
            false => ([&to_d, &to_c], [Share::All, Share::None]),
        };
        let low_to_b = time.sign_of(&Poly::difference(&kk, low));
        let high_to_a = time.sign_of(high);
        if low_to_b.is_lt() || high_to_a.is_lt() {
            return None;
        }
        let on_ab = |at: &Poly| Share::Quotient(at.clone(), kk.clone());
        let on_cd = |at: Poly| Share::Quotient(at, ll.clone());
        let at_a = Poly::difference(&Poly::default(), &ml);
        let at_b = Poly::difference(&dot(k, l), &ml);
        let first = match time.sign_of(low).is_le() {
            true => [Share::None, on_cd(at_a)],
            false => [on_ab(low), v_low],
        };
        let second = match time.sign_of(&Poly::difference(&kk, high)).is_le() {
            true => [Share::All, on_cd(at_b)],
            false => [on_ab(high), v_high],
        };
        let is_more = low_to_b.is_gt() && high_to_a.is_gt();
        Some(Locus {
            first: Place(first),
            second: is_more.then_some(Place(second)),
            is_inside: false,
        })
    }
}

impl Sides<2> for Edges {
    fn f(&self) -> &Poly {
        &self.f
    }

    fn ends(&self) -> Vec<End> {
        let Edges { k, l, dl, m, .. } = self;
        let (a_c, a_d) = (m, &add(m, dl));
        let (b_c, b_d) = (&sub(a_c, k), &sub(a_d, k));
        vec![
            End::new(a_c, a_d, l),
            End::new(b_c, b_d, l),
            End::new(&neg(a_c), &neg(b_c), k),
            End::new(&neg(a_d), &neg(b_d), k),
        ]
    }

    fn locus(&self, time: &Time) -> Option<Locus<2>> {
        if let Some((axis, sign)) = self.axis(time) {
            return self.locus_at_angle(time, axis, sign);
        }
        match (Self::vanishes(&self.k, time), is_zero(&self.l)) {
            (false, false) => {
                let is_on_one_line = Self::vanishes(&cross(&self.m, &self.k), time);
                is_on_one_line.then(|| self.overlap(time))?
            }
            (true, false) => self.locus_of_first_point(time),
            (false, true) => self.locus_of_second_point(time),
            (true, true) => {
                Self::vanishes(&self.m, time).then(|| Locus::at(Place([Share::None, Share::None])))
            }
        }
    }

    fn case(&self) -> Case {
        if !self.f.is_zero() {
            Case::General
        } else if is_zero(&self.k) || is_zero(&self.l) {
            Case::Degenerate
        } else if is_zero(&self.m) {
            Case::SharedStart
        } else if !is_zero(&self.n) {
            Case::Coplanar
        } else if is_zero(&cross(&self.m, &self.k)) {
            Case::Collinear
        } else {
            Case::Parallel
        }
    }

    fn flags(&self, time: &Time) -> Flags {
        if self.axis(time).is_some() {
            return Flags::default();
        }
        let is_first_point = Self::vanishes(&self.k, time);
        Flags {
            temporarily_parallel: !is_first_point && !is_zero(&self.l) && !is_zero(&self.n),
            temporarily_point: is_first_point && !is_zero(&self.k),
        }
    }
}

/// A component of the cross product.
fn cross_component(x: &Vector, y: &Vector, axis: usize) -> Poly {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    Poly::difference(&Poly::product(&x[i], &y[j]), &Poly::product(&x[j], &y[i]))
}
