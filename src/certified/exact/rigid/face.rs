//! A vertex A and a face BCD of a turning body, in the body's frame and times `D`: `w = A - B`,
//! with `E1 = C - B`, `E2 = D - B` and `N = E1 x E2` at rest.

use std::cmp::Ordering;

use super::confined::End;
use super::motion::InBody;
use super::{Locus, Sides, is_between};
use crate::certified::exact::thick::vector::{Vector, cross, dot, is_zero, neg, sub};
use crate::certified::exact::thick::{self, Place, Poly, Reach, Share, Time};
use crate::certified::rigid::Turning;
use crate::contact::{Case, Flags};
use crate::query::Radius;

#[derive(Clone)]
pub(super) struct Face {
    /// From A to B, C and D.
    ways: [Vector; 3],
    e1: Vector,
    e2: Vector,
    n: Vector,
    d: Poly,
    f: Poly,
    unit: i32,
}

impl Face {
    pub(super) fn new(query: &Turning<'_, 1, 3>) -> Self {
        let InBody {
            first: [a],
            second: [b, c, last],
            d,
            unit,
        } = InBody::new(query);
        let (e1, e2) = (sub(&c, &b), sub(&last, &b));
        let n = cross(&e1, &e2);
        let ways = [&b, &c, &last].map(|corner| {
            let corner: Vector = corner.each_ref().map(|x| Poly::product(x, &d));
            sub(&corner, &a)
        });
        let w = neg(&ways[0]);
        Face {
            f: dot(&w, &n),
            ways,
            e1,
            e2,
            n,
            d,
            unit,
        }
    }

    /// The same with a radius.
    pub(super) fn thick(&self, radius: Radius) -> (thick::Face, Reach) {
        let Face {
            ways, e1, e2, d, ..
        } = self.clone();
        let reach = Reach::new(radius.parts(), self.unit, &d);
        let x = neg(&ways[0]);
        (thick::Face::of(e1, e2, x, d), reach)
    }

    /// The vertex is in the plane: `w x E2 = u D N` and `E1 x w = v D N`.
    fn locus_in_plane(&self, time: &Time, axis: usize, sign: Ordering) -> Option<Locus<3>> {
        let w = neg(&self.ways[0]);
        let dn = Poly::product(&self.d, &self.n[axis]);
        let [u, v] = [cross(&w, &self.e2), cross(&self.e1, &w)].map(|[x, y, z]| match axis {
            0 => x,
            1 => y,
            _ => z,
        });
        let both = Poly::sum(&u, &v);
        let insides = [
            is_between(time, &u, &dn, sign)?,
            is_between(time, &v, &dn, sign)?,
            is_between(time, &both, &dn, sign)?,
        ];
        let rest = Poly::difference(&dn, &both);
        let share = |n: Poly| Share::Quotient(n, dn.clone());
        Some(Locus {
            first: Place([rest, u, v].map(share)),
            second: None,
            is_inside: insides == [true; 3],
        })
    }

    /// The face is a segment or a point: its edges are all of it.
    fn locus_on_edges(&self, time: &Time) -> Option<Locus<3>> {
        use Share::{All, None};
        let is_here = |way: &Vector| way.iter().all(|c| time.sign_of(c).is_eq());
        if let Some(corner) = self.ways.iter().position(is_here) {
            let mut place = [None, None, None];
            place[corner] = All;
            return Some(Locus::at(Place(place)));
        }
        let ends = self.ends();
        let (edge, end) = ends
            .iter()
            .enumerate()
            .find(|(_, end)| end.is_on_edge(time))?;
        let [from_y, to_z, all] = &end.along;
        let share = |part: &Poly| Share::Quotient(part.clone(), all.clone());
        let (y, z) = (share(to_z), share(from_y));
        Some(Locus::at(Place(match edge {
            0 => [y, z, None],
            1 => [None, y, z],
            _ => [y, None, z],
        })))
    }
}

impl Sides<3> for Face {
    fn f(&self) -> &Poly {
        &self.f
    }

    fn ends(&self) -> Vec<End> {
        let [b, c, d] = &self.ways;
        let edges = [
            (b, c, &self.e1),
            (c, d, &sub(&self.e2, &self.e1)),
            (b, d, &self.e2),
        ];
        edges.map(|(y, z, edge)| End::new(y, z, edge)).into()
    }

    fn locus(&self, time: &Time) -> Option<Locus<3>> {
        let signs = self
            .n
            .iter()
            .map(|component| component.coefficient(0).sign());
        match signs.enumerate().find(|(_, sign)| sign.is_ne()) {
            Some((axis, sign)) => self.locus_in_plane(time, axis, sign),
            None => self.locus_on_edges(time),
        }
    }

    fn case(&self) -> Case {
        if is_zero(&self.n) {
            Case::Degenerate
        } else if self.f.is_zero() {
            Case::Coplanar
        } else {
            Case::General
        }
    }

    /// A rigid face does not change its shape.
    fn flags(&self, _time: &Time) -> Flags {
        Flags::default()
    }
}
