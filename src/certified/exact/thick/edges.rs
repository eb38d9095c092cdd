//! Two edges: `K = B - A`, `s L = D - C`, `M = C - A`, `N = K x L`, `f = M . N`.
//!
//! `s` is above 0: 1, but for an edge of a body that turns, whose `L` is at rest.

use super::pair::{Pair, Place, Share};
use super::vector::{Vector, add, cross, dot, is_zero, neg, one, sub, times};
use super::{Poly, Polygon, Sides, Time};
use crate::contact::Flags;

pub(in crate::certified::exact) struct Edges {
    k: Vector,
    l: Vector,
    /// `s`.
    scale: Poly,
    /// `s L`.
    sl: Vector,
    m: Vector,
    n: Vector,
    n2: Poly,
    f: Poly,
}

impl Edges {
    pub(super) fn new([a, b, c, d]: &[Vector; 4]) -> Self {
        Edges::of(sub(b, a), sub(d, c), sub(c, a), one())
    }

    /// From `K`, `L`, `M` and `s`.
    pub(in crate::certified::exact) fn of(k: Vector, l: Vector, m: Vector, scale: Poly) -> Self {
        let n = cross(&k, &l);
        Edges {
            n2: dot(&n, &n),
            f: dot(&m, &n),
            sl: times(&l, &scale),
            scale,
            k,
            l,
            m,
            n,
        }
    }

    /// The lines are nearest at `u = (M x L) . N / N . N` and `v = (M x K) . N / s N . N`. As
    /// `N = K x L`, these products are of inner products.
    fn insides(&self, [kk, kl, ll, km, lm]: [&Poly; 5]) -> Pair<2> {
        let Edges { n2, f, .. } = self;
        let minor = |a: &Poly, b: &Poly, c: &Poly, d: &Poly| {
            Poly::difference(&Poly::product(a, b), &Poly::product(c, d))
        };
        let (u, v) = (minor(km, ll, lm, kl), minor(km, kl, lm, kk));
        let sn2 = Poly::product(&self.scale, n2);
        let quotient = |n: &Poly, d: &Poly| Share::Quotient(n.clone(), d.clone());
        let place = [quotient(&u, n2), quotient(&v, &sn2)];
        let inside = vec![Poly::difference(n2, &u), Poly::difference(&sn2, &v), u, v];
        Pair::insides(f, n2, inside, place)
    }

    /// Whether an edge is a point at a time.
    fn is_point(edge: &Vector, time: &Time) -> bool {
        time.sign_of(&dot(edge, edge)).is_eq()
    }
}

impl Sides<2> for Edges {
    fn pairs(&self) -> Vec<Pair<2>> {
        use Share::{All, None};
        let Edges {
            k, l, sl, m, scale, ..
        } = self;
        let (kk, kl, ll) = (&dot(k, k), &dot(k, l), &dot(l, l));
        let (km, lm) = (&dot(k, m), &dot(l, m));
        let sll = &Poly::product(scale, ll);
        // The squared ways from A and B to C and D.
        let (m_l, m_k) = (&add(m, sl), &sub(m, k));
        let (a_c, a_d) = (&dot(m, m), &dot(m_l, m_l));
        let b_c = &dot(m_k, m_k);
        let b_d = &{
            let way = sub(m_l, k);
            dot(&way, &way)
        };
        let negative = |p: &Poly| Poly::difference(&Poly::default(), p);
        let d_on_k = &negative(&dot(m_l, k));
        let (b_on_l, c_on_k) = (&Poly::difference(lm, kl), &negative(km));
        vec![
            Pair::vertices(a_c, [None, None]),
            Pair::vertices(a_d, [None, All]),
            Pair::vertices(b_c, [All, None]),
            Pair::vertices(b_d, [All, All]),
            Pair::vertex_edge([a_c, lm, ll, sll], |[v, _]| [None, v]),
            Pair::vertex_edge([b_c, b_on_l, ll, sll], |[v, _]| [All, v]),
            Pair::vertex_edge([a_c, c_on_k, kk, kk], |[u, _]| [u, None]),
            Pair::vertex_edge([a_d, d_on_k, kk, kk], |[u, _]| [u, All]),
            self.insides([kk, kl, ll, km, lm]),
        ]
    }

    fn f(&self) -> &Poly {
        &self.f
    }

    /// From A to C and D, and from B to D and C.
    fn polygon(&self) -> Polygon {
        let Edges { k, l, sl, m, .. } = self;
        let a_d = add(m, sl);
        Polygon {
            corners: vec![m.clone(), a_d.clone(), sub(&a_d, k), sub(m, k)],
            edges: vec![l.clone(), neg(k), neg(l), k.clone()],
        }
    }

    /// Along K, A is at 0, B at `K . K`, C at `M . K` and D at `(M + s L) . K`: what both edges have
    /// of that where they are parallel.
    fn overlap(&self, time: &Time) -> Option<(Place<2>, Option<Place<2>>)> {
        let Edges { k, l, sl, m, .. } = self;
        let is_parallel = time.sign_of(&self.n2).is_eq();
        if !is_parallel || Self::is_point(k, time) || Self::is_point(l, time) {
            return None;
        }
        let (kk, ll, ml) = (dot(k, k), dot(sl, l), dot(m, l));
        let (to_c, to_d) = (dot(m, k), dot(&add(m, sl), k));
        let is_same_way = time.sign_of(&dot(k, l)).is_gt();
        let [low, high] = if is_same_way {
            [&to_c, &to_d]
        } else {
            [&to_d, &to_c]
        };
        let low_to_b = time.sign_of(&Poly::difference(&kk, low));
        let high_to_a = time.sign_of(high);
        if low_to_b.is_lt() || high_to_a.is_lt() {
            return None;
        }
        let [v_low, v_high] = match is_same_way {
            true => [Share::None, Share::All],
            false => [Share::All, Share::None],
        };
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
        Some((Place(first), is_more.then_some(Place(second))))
    }

    fn flags(&self, time: &Time) -> Flags {
        let Edges { k, l, n, n2, .. } = self;
        if time.sign_of(n2).is_ne() {
            return Flags::default();
        }
        let (first, second) = (Self::is_point(k, time), Self::is_point(l, time));
        Flags {
            temporarily_parallel: !first && !second && !is_zero(n),
            temporarily_point: first && !is_zero(k) || second && !is_zero(l),
        }
    }
}
