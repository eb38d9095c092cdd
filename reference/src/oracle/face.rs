//! The motion of a vertex and a face: its polynomials, its case, and where they touch.

use std::cmp::Ordering;

use tunnelproof::contact::{Case, Flags};

use crate::algebraic::Algebraic;
use crate::answer::Feature;
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::locus::{Locus, Parameter, Place, Position};
use super::motion::{End, Motion, way};
use super::pair::Pair;
use super::vector::{Vector, quotient};

/// The polynomials of a vertex A and a face BCD: `w = A - B`, `E1 = C - B`, `E2 = D - B`,
/// `N = E1 x E2`, `f = w . N`.
///
/// A point of the face is `B + u E1 + v E2` with `u`, `v` and `1 - u - v` at least 0.
#[derive(Clone, Debug)]
pub(super) struct Face<Z> {
    w: Vector<Z>,
    e1: Vector<Z>,
    e2: Vector<Z>,
    n: Vector<Z>,
    f: Poly<Z>,
}

impl<Z: Integer> Motion<Z> for Face<Z> {
    fn f(&self) -> &Poly<Z> {
        &self.f
    }

    fn case(&self) -> Case {
        if self.n.is_zero() {
            Case::Degenerate
        } else if self.f.is_zero() {
            Case::Coplanar
        } else {
            Case::General
        }
    }

    /// A with BC, CD and BD.
    fn ends(&self) -> Vec<End<Z>> {
        let [to_b, to_c, to_d] = self.ways();
        let edges = [(&to_b, &to_c), (&to_c, &to_d), (&to_b, &to_d)];
        edges.map(|(y, z)| End::new(y.clone(), z.clone())).into()
    }

    fn meetings(&self) -> Vec<Vector<Z>> {
        self.ways().into()
    }

    fn locus(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        match self.n.axis_at(time) {
            Some((axis, sign)) => self.locus_in_plane(time, axis, sign),
            None => self.locus_on_edges(time),
        }
    }

    /// The place on the face that is nearest to the vertex is a single one.
    fn overlap(&self, _time: &Algebraic<Z>) -> Option<Locus<Z>> {
        None
    }

    fn flags(&self, time: &Algebraic<Z>) -> Flags {
        if self.n.axis_at(time).is_some() {
            return Flags::default();
        }
        let is_point = |time: &Algebraic<Z>| self.e1.is_zero_at(time) && self.e2.is_zero_at(time);
        let is_always_point = self.e1.is_zero() && self.e2.is_zero();
        Flags {
            temporarily_parallel: !is_point(time) && !self.n.is_zero(),
            temporarily_point: is_point(time) && !is_always_point,
        }
    }

    fn pairs(&self) -> Vec<Pair<Z>> {
        let mut pairs = Vec::with_capacity(7);
        for (corner, way) in self.ways().iter().enumerate() {
            pairs.push(Pair::vertices(way, corner_place(corner)));
        }
        for (edge, end) in self.ends().iter().enumerate() {
            pairs.push(Pair::end(end, |along| edge_place(edge, along)));
        }
        pairs.push(self.inside());
        pairs
    }

    fn vanishing(&self) -> Vec<(&'static str, bool)> {
        let Face { w, e1, e2, n, f } = self;
        vec![
            ("w", w.is_zero()),
            ("E1", e1.is_zero()),
            ("E2", e2.is_zero()),
            ("E1 x E2", n.is_zero()),
            ("f", f.is_zero()),
        ]
    }

    fn meeting(&self, time: &Algebraic<Z>) -> Option<[f64; 2]> {
        let (axis, _) = self.n.axis_at(time)?;
        let quotient = |numerator| quotient(time, &numerator, &self.n.0[axis]);
        Some(self.weights(axis).map(quotient))
    }
}

impl<Z: Integer> Face<Z> {
    pub(super) fn new(points: &Scaled<Z>) -> Self {
        let [w, e1, e2] = [(1, 0), (1, 2), (1, 3)].map(|(from, to)| way(points, from, to));
        Face::of(w, e1, e2)
    }

    /// From `w`, `E1` and `E2`, all times the same.
    pub(super) fn of(w: Vector<Z>, e1: Vector<Z>, e2: Vector<Z>) -> Self {
        let n = e1.cross(&e2);
        let f = w.dot(&n);
        Face { w, e1, e2, n, f }
    }

    /// From A to B, C and D.
    fn ways(&self) -> [Vector<Z>; 3] {
        [self.w.neg(), self.e1.sub(&self.w), self.e2.sub(&self.w)]
    }

    /// Where `f` is 0, `u` and `v` times a component of `N`: from `w = u E1 + v E2`, crossed with
    /// `E2` and with `E1`, `w x E2 = u N` and `E1 x w = v N`.
    fn weights(&self, axis: usize) -> [Poly<Z>; 2] {
        let Face { w, e1, e2, .. } = self;
        [w.cross_component(e2, axis), e1.cross_component(w, axis)]
    }

    /// The vertex is in the plane of the face, which has an area.
    fn locus_in_plane(&self, time: &Algebraic<Z>, axis: usize, sign: Ordering) -> Option<Locus<Z>> {
        let n = &self.n.0[axis];
        let [u, v] = self.weights(axis);
        let of_c = Position::of(time, &u, n, sign)?;
        let of_d = Position::of(time, &v, n, sign)?;
        let both = u.add(&v);
        let of_both = Position::of(time, &both, n, sign)?;
        let feature = feature([of_both.end.is_lt(), of_c.start.is_gt(), of_d.start.is_gt()]);
        let parameter = |numerator| Parameter::Quotient(numerator, n.clone());
        Some(Locus {
            first: Place {
                u: parameter(u),
                v: parameter(v),
                of_face: Some(feature),
            },
            second: None,
            cuts_inside: feature == FACE,
        })
    }

    /// The face is a segment or a point, and so its edges are all of it.
    fn locus_on_edges(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        let ways = self.ways();
        let mut corners = ways.iter().enumerate();
        if let Some((corner, _)) = corners.find(|(_, way)| way.is_zero_at(time)) {
            return Some(Locus::at(corner_place(corner)));
        }
        let ends = self.ends();
        let is_on = |end: &End<Z>| end.turn.is_zero_at(time) && time.sign_of(&end.between).is_le();
        let (edge, end) = ends.iter().enumerate().find(|(_, end)| is_on(end))?;
        Some(Locus::at(edge_place(edge, &end.along())))
    }

    /// The vertex and the face without its edges. The vertex is `|f| / |N|` from the plane, and its
    /// foot there has `u = (w x E2) . N / N.N` and `v = (E1 x w) . N / N.N`.
    fn inside(&self) -> Pair<Z> {
        let Face { w, e1, e2, n, f } = self;
        let (n2, u, v) = (n.dot(n), w.cross(e2).dot(n), e1.cross(w).dot(n));
        let parameter = |numerator: &Poly<Z>| Parameter::Quotient(numerator.clone(), n2.clone());
        Pair {
            numerator: f.mul(f),
            place: Place {
                u: parameter(&u),
                v: parameter(&v),
                of_face: Some(FACE),
            },
            inside: vec![n2.sub(&u).sub(&v), u, v],
            denominator: n2,
        }
    }
}

const FACE: Feature = feature([true; 3]);

/// The part of the face on which these of the weights of B, C and D are above 0.
const fn feature([b, c, d]: [bool; 3]) -> Feature {
    Feature::spanned_by([false, b, c, d])
}

/// B, C or D.
fn corner_place<Z: Integer>(corner: usize) -> Place<Z> {
    use Parameter::{End, Start};
    let (u, v) = [(Start, Start), (End, Start), (Start, End)][corner].clone();
    Place {
        u,
        v,
        of_face: Some(Feature::vertex(1 + corner)),
    }
}

/// The point of BC, CD or BD that is [`End::along`] it.
fn edge_place<Z: Integer>(edge: usize, [from_y, to_z, all]: &[Poly<Z>; 3]) -> Place<Z> {
    let share = |part: &Poly<Z>| Parameter::Quotient(part.clone(), all.clone());
    let (u, v, weights) = match edge {
        0 => (share(from_y), Parameter::Start, [true, true, false]),
        1 => (share(to_z), share(from_y), [false, true, true]),
        _ => (Parameter::Start, share(from_y), [true, false, true]),
    };
    Place {
        u,
        v,
        of_face: Some(feature(weights)),
    }
}
