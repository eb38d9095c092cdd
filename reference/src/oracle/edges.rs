//! The motion of two edges: its polynomials, its case, and where the edges touch.

use std::cmp::Ordering;

use tunnelproof::contact::{Case, Flags};

use crate::algebraic::Algebraic;
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::locus::{Locus, Parameter, Place, Position};
use super::motion::{End, Motion, way};
use super::pair::Pair;
use super::vector::{Vector, quotient};

/// The polynomials of two edges: `K = B - A`, `L = D - C`, `M = C - A`, `N = K x L`, `f = M . N`.
#[derive(Clone, Debug)]
pub(super) struct Edges<Z> {
    k: Vector<Z>,
    l: Vector<Z>,
    m: Vector<Z>,
    n: Vector<Z>,
    f: Poly<Z>,
}

impl<Z: Integer> Motion<Z> for Edges<Z> {
    fn f(&self) -> &Poly<Z> {
        &self.f
    }

    /// Thesis 3.1.1, figure 3.2.
    fn case(&self) -> Case {
        if self.k.is_zero() || self.l.is_zero() {
            Case::Degenerate
        } else if self.m.is_zero() {
            Case::SharedStart
        } else if self.n.is_zero() {
            if self.k.cross(&self.m).is_zero() {
                Case::Collinear
            } else {
                Case::Parallel
            }
        } else if self.f.is_zero() {
            Case::Coplanar
        } else {
            Case::General
        }
    }

    /// A, B, C and D, each with the other edge.
    fn ends(&self) -> Vec<End<Z>> {
        let [a_to_c, a_to_d, b_to_c, b_to_d] = self.ways();
        let (c_to_a, d_to_a) = (a_to_c.neg(), a_to_d.neg());
        let (c_to_b, d_to_b) = (b_to_c.neg(), b_to_d.neg());
        vec![
            End::new(a_to_c, a_to_d),
            End::new(b_to_c, b_to_d),
            End::new(c_to_a, c_to_b),
            End::new(d_to_a, d_to_b),
        ]
    }

    fn meetings(&self) -> Vec<Vector<Z>> {
        self.ways().into()
    }

    fn locus(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        if let Some((axis, sign)) = self.n.axis_at(time) {
            return self.locus_transversal(time, axis, sign);
        }
        match (self.k.is_zero_at(time), self.l.is_zero_at(time)) {
            (false, false) => {
                let is_on_one_line = self.m.cross(&self.k).is_zero_at(time);
                is_on_one_line.then(|| self.overlap_parallel(time))?
            }
            (true, false) => self.locus_first_is_point(time),
            (false, true) => self.locus_second_is_point(time),
            (true, true) => {
                let place = Place::of_edges(Parameter::Start, Parameter::Start);
                self.m.is_zero_at(time).then(|| Locus::at(place))
            }
        }
    }

    fn overlap(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        let has_plane = self.n.axis_at(time).is_some();
        if has_plane || self.k.is_zero_at(time) || self.l.is_zero_at(time) {
            return None;
        }
        self.overlap_parallel(time)
    }

    fn flags(&self, time: &Algebraic<Z>) -> Flags {
        let Edges { k, l, n, .. } = self;
        if self.n.axis_at(time).is_some() {
            return Flags::default();
        }
        let (first, second) = (k.is_zero_at(time), l.is_zero_at(time));
        Flags {
            temporarily_parallel: !first && !second && !n.is_zero(),
            temporarily_point: first && !k.is_zero() || second && !l.is_zero(),
        }
    }

    fn pairs(&self) -> Vec<Pair<Z>> {
        use Parameter::{End, Quotient, Start};
        let mut pairs = Vec::with_capacity(9);
        let corners = [(Start, Start), (Start, End), (End, Start), (End, End)];
        for (way, (u, v)) in self.ways().iter().zip(corners) {
            pairs.push(Pair::vertices(way, Place::of_edges(u, v)));
        }
        for (index, end) in self.ends().iter().enumerate() {
            pairs.push(Pair::end(end, |[along, _, all]| {
                let other = Quotient(along.clone(), all.clone());
                let own = if index % 2 == 0 { Start } else { End };
                match index {
                    0 | 1 => Place::of_edges(own, other),
                    _ => Place::of_edges(other, own),
                }
            }));
        }
        pairs.push(self.insides());
        pairs
    }

    fn vanishing(&self) -> Vec<(&'static str, bool)> {
        let Edges { k, l, m, n, f } = self;
        vec![
            ("K", k.is_zero()),
            ("L", l.is_zero()),
            ("M", m.is_zero()),
            ("K x L", n.is_zero()),
            ("K x M", k.cross(m).is_zero()),
            ("f", f.is_zero()),
        ]
    }

    fn meeting(&self, time: &Algebraic<Z>) -> Option<[f64; 2]> {
        let (axis, _) = self.n.axis_at(time)?;
        let Edges { k, l, m, n, .. } = self;
        let quotient = |numerator| quotient(time, &numerator, &n.0[axis]);
        Some([m.cross_component(l, axis), m.cross_component(k, axis)].map(quotient))
    }
}

impl<Z: Integer> Edges<Z> {
    pub(super) fn new(points: &Scaled<Z>) -> Self {
        let [k, l, m] = [(0, 1), (2, 3), (0, 2)].map(|(from, to)| way(points, from, to));
        Edges::of(k, l, m)
    }

    /// From `K`, `L` and `M`, all times the same.
    pub(super) fn of(k: Vector<Z>, l: Vector<Z>, m: Vector<Z>) -> Self {
        let n = k.cross(&l);
        let f = m.dot(&n);
        Edges { k, l, m, n, f }
    }

    /// From A to C and to D, from B to C and to D.
    fn ways(&self) -> [Vector<Z>; 4] {
        let to_d = self.m.add(&self.l);
        let (b_to_c, b_to_d) = (self.m.sub(&self.k), to_d.sub(&self.k));
        [self.m.clone(), to_d, b_to_c, b_to_d]
    }

    /// Both edges without their ends. The lines are `|f| / |N|` from each other and nearest at
    /// `u = U / N.N`, `v = W / N.N`, with `U = (M x L) . N` and `W = (M x K) . N`.
    fn insides(&self) -> Pair<Z> {
        let Edges { k, l, m, n, f } = self;
        let (n2, u, w) = (n.dot(n), m.cross(l).dot(n), m.cross(k).dot(n));
        let parameter = |numerator: &Poly<Z>| Parameter::Quotient(numerator.clone(), n2.clone());
        Pair {
            numerator: f.mul(f),
            place: Place::of_edges(parameter(&u), parameter(&w)),
            inside: vec![n2.sub(&u), u, n2.sub(&w), w],
            denominator: n2,
        }
    }

    /// The lines meet in one point. From `A + u K = C + v L`: `M x L = u N` and `M x K = v N`,
    /// which one component of `N` that is not 0 solves.
    fn locus_transversal(
        &self,
        time: &Algebraic<Z>,
        axis: usize,
        sign: Ordering,
    ) -> Option<Locus<Z>> {
        let n = &self.n.0[axis];
        let u = self.m.cross_component(&self.l, axis);
        let on_first = Position::of(time, &u, n, sign)?;
        let v = self.m.cross_component(&self.k, axis);
        let on_second = Position::of(time, &v, n, sign)?;
        let (u, v) = (
            Parameter::Quotient(u, n.clone()),
            Parameter::Quotient(v, n.clone()),
        );
        Some(Locus {
            first: Place::of_edges(u, v),
            second: None,
            cuts_inside: on_first.is_interior() && on_second.is_interior(),
        })
    }

    /// `A = B`: that point against the edge `CD`, at `v = (A - C) . L / L . L`.
    fn locus_first_is_point(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        if !self.m.cross(&self.l).is_zero_at(time) {
            return None;
        }
        let (n, d) = (self.m.dot(&self.l).neg(), self.l.dot(&self.l));
        Position::of(time, &n, &d, Ordering::Greater)?;
        let v = Parameter::Quotient(n, d);
        Some(Locus::at(Place::of_edges(Parameter::Start, v)))
    }

    /// `C = D`: that point against the edge `AB`, at `u = (C - A) . K / K . K`.
    fn locus_second_is_point(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        if !self.m.cross(&self.k).is_zero_at(time) {
            return None;
        }
        let (n, d) = (self.m.dot(&self.k), self.k.dot(&self.k));
        Position::of(time, &n, &d, Ordering::Greater)?;
        let u = Parameter::Quotient(n, d);
        Some(Locus::at(Place::of_edges(u, Parameter::Start)))
    }

    /// Both have a direction, the same up to sign: the part in which they are beside each other, or
    /// on each other if they are on one line.
    fn overlap_parallel(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        // Along K, in units of 1 / K.K: A at 0, B at K.K, C at c and D at d.
        let (kk, ll) = (self.k.dot(&self.k), self.l.dot(&self.l));
        let c = self.m.dot(&self.k);
        let d = self.m.add(&self.l).dot(&self.k);
        let at_a = || Parameter::Quotient(self.m.dot(&self.l).neg(), ll.clone());
        let at_b = || Parameter::Quotient(self.k.sub(&self.m).dot(&self.l), ll.clone());
        let along = |n: &Poly<Z>| Parameter::Quotient(n.clone(), kk.clone());
        let same_way = time.sign_of(&self.k.dot(&self.l)).is_gt();
        let (low, high, v_low, v_high) = if same_way {
            (&c, &d, Parameter::Start, Parameter::End)
        } else {
            (&d, &c, Parameter::End, Parameter::Start)
        };
        let low_to_b = time.sign_of(&low.sub(&kk));
        let high_to_a = time.sign_of(high);
        if low_to_b.is_gt() || high_to_a.is_lt() {
            return None;
        }
        let first = if time.sign_of(low).is_le() {
            Place::of_edges(Parameter::Start, at_a())
        } else {
            Place::of_edges(along(low), v_low)
        };
        let is_point = low_to_b.is_eq() || high_to_a.is_eq();
        let second = (!is_point).then(|| {
            if time.sign_of(&high.sub(&kk)).is_ge() {
                Place::of_edges(Parameter::End, at_b())
            } else {
                Place::of_edges(along(high), v_high)
            }
        });
        Some(Locus {
            first,
            cuts_inside: false,
            second,
        })
    }
}
