//! The description of contact of a vertex and a face, evaluated at every candidate: slow and plain.
//!
//! With `w = A - B`, `E1 = C - B`, `E2 = D - B`, `N = E1 x E2`, `f = w . N`, `n2 = N . N`,
//! `c = (w x E2) . N`, `d = (E1 x w) . N` and `b = n2 - c - d`, `contact(t)` is: `n2 > 0` and
//! `f = 0` and `b, c, d >= 0`; or A is on BC, CD or DB. `X` is on `YZ` where
//! `(Y - X) x (Z - X) = 0` and `(Y - X) . (Z - X) <= 0`.

use std::cmp::Ordering;

use num_bigint::BigInt;
use tunnelproof::contact::{Case, ContactKind, Flags};
use tunnelproof::query::{Query, VertexFace};
use tunnelproof_reference::algebraic::{Algebraic, isolate_roots};
use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::poly::Poly;
use tunnelproof_reference::scaled::Scaled;

type Polynomial = Poly<BigInt>;
type Time = Algebraic<BigInt>;
type Vector = [Polynomial; 3];

/// The exact first contact.
#[derive(Debug)]
pub(crate) struct Contact {
    pub(crate) toi: Enclosure,
    pub(crate) kind: ContactKind,
    pub(crate) side: i8,
    /// Of B, C and D.
    pub(crate) weights: [Enclosure; 3],
    pub(crate) case: Case,
    pub(crate) flags: Flags,
}

/// An edge from `Y` to `Z` and the vertex `X`.
struct Edge {
    turn: Vector,
    between: Polynomial,
    /// `(X - Y) . (Z - Y)` and `|Z - Y|^2`.
    along: Polynomial,
    length: Polynomial,
}

struct Motion {
    f: Polynomial,
    /// From A to B, C and D.
    ways: [Vector; 3],
    n2: Polynomial,
    /// The weights of B, C and D times `n2`.
    weights: [Polynomial; 3],
    edges: [Edge; 3],
}

pub(crate) fn first_contact(query: &VertexFace) -> Option<Contact> {
    let motion = Motion::new(query);
    let candidates = motion.candidates();
    let toi = candidates.iter().find(|time| motion.touch(time))?;
    Some(Contact {
        toi: toi.enclosure(),
        kind: motion.kind(toi),
        side: motion.side(toi),
        weights: motion.weights(toi),
        case: motion.case(),
        flags: motion.flags(toi),
    })
}

impl Motion {
    fn new(query: &VertexFace) -> Self {
        let points = Scaled::<BigInt>::new(&Query::VertexFace(*query));
        let to = |y: usize, x: usize| -> Vector {
            [0, 1, 2].map(|i| {
                let at = |p: &[[BigInt; 3]; 4]| p[y][i].clone() - p[x][i].clone();
                Poly::line(&at(&points.start), &at(&points.end))
            })
        };
        let edge = |y: usize, z: usize| Edge {
            turn: cross(&to(y, 0), &to(z, 0)),
            between: dot(&to(y, 0), &to(z, 0)),
            along: dot(&to(0, y), &to(z, y)),
            length: dot(&to(z, y), &to(z, y)),
        };
        let (w, e1, e2) = (to(0, 1), to(2, 1), to(3, 1));
        let n = cross(&e1, &e2);
        let n2 = dot(&n, &n);
        let (c, d) = (dot(&cross(&w, &e2), &n), dot(&cross(&e1, &w), &n));
        Motion {
            f: dot(&w, &n),
            ways: [to(1, 0), to(2, 0), to(3, 0)],
            weights: [n2.sub(&c).sub(&d), c, d],
            n2,
            edges: [edge(1, 2), edge(2, 3), edge(3, 1)],
        }
    }

    fn candidates(&self) -> Vec<Time> {
        let of_edges = self
            .edges
            .iter()
            .flat_map(|edge| edge.turn.iter().chain([&edge.between]));
        let polys = self
            .weights
            .iter()
            .chain([&self.n2, &self.f])
            .chain(of_edges);
        let mut times: Vec<Time> = polys
            .flat_map(isolate_roots)
            .chain([Time::zero()])
            .collect();
        times.sort_by(Time::compare);
        times
    }

    fn touch(&self, time: &Time) -> bool {
        let is_inside = time.sign_of(&self.n2).is_gt()
            && time.sign_of(&self.f).is_eq()
            && self
                .weights
                .iter()
                .all(|weight| time.sign_of(weight).is_ge());
        is_inside || self.edges.iter().any(|edge| edge.is_met(time))
    }

    fn kind(&self, time: &Time) -> ContactKind {
        let is_on_line = |edge: &Edge| edge.turn.iter().all(Poly::is_zero);
        let crosses = if self.f.is_zero() {
            self.edges.iter().all(is_on_line) || self.edges.iter().any(|edge| edge.is_passed(time))
        } else {
            let is_inside = |weight: &Polynomial| time.sign_of(weight).is_gt();
            order(&self.f, time).0 % 2 == 1 && self.weights.iter().all(is_inside)
        };
        let Enclosure { below, above } = time.enclosure();
        if crosses && above > 0.0 && below < 1.0 {
            ContactKind::Crossing
        } else {
            ContactKind::Graze
        }
    }

    fn side(&self, time: &Time) -> i8 {
        if self.f.is_zero() || time.is_zero() {
            return 0;
        }
        let (order, sign) = order(&self.f, time);
        let before = if order % 2 == 1 { sign.reverse() } else { sign };
        before as i8
    }

    fn weights(&self, time: &Time) -> [Enclosure; 3] {
        if time.sign_of(&self.n2).is_gt() {
            return self
                .weights
                .each_ref()
                .map(|weight| time.enclose_quotient(weight, &self.n2));
        }
        let (zero, one) = (Enclosure::exactly(0.0), Enclosure::exactly(1.0));
        let corner = self.ways.iter().position(|way| is_zero(way, time));
        if let Some(corner) = corner {
            let mut weights = [zero; 3];
            weights[corner] = one;
            return weights;
        }
        let edge = self.edges.iter().position(|edge| edge.is_met(time));
        let edge = edge.expect("a contact");
        let Edge { along, length, .. } = &self.edges[edge];
        let near = time.enclose_quotient(&length.sub(along), length);
        let far = time.enclose_quotient(along, length);
        match edge {
            0 => [near, far, zero],
            1 => [zero, near, far],
            _ => [far, zero, near],
        }
    }

    fn case(&self) -> Case {
        match (self.n2.is_zero(), self.f.is_zero()) {
            (true, _) => Case::Degenerate,
            (false, true) => Case::Coplanar,
            (false, false) => Case::General,
        }
    }

    fn flags(&self, time: &Time) -> Flags {
        let lengths = self.edges.each_ref().map(|edge| &edge.length);
        let is_point = lengths.iter().all(|length| time.sign_of(length).is_eq());
        let has_area = time.sign_of(&self.n2).is_gt();
        Flags {
            temporarily_parallel: !has_area && !is_point && !self.n2.is_zero(),
            temporarily_point: is_point && !lengths.iter().all(|length| length.is_zero()),
        }
    }
}

fn is_zero(vector: &Vector, time: &Time) -> bool {
    vector
        .iter()
        .all(|component| time.sign_of(component).is_eq())
}

impl Edge {
    fn is_met(&self, time: &Time) -> bool {
        is_zero(&self.turn, time) && time.sign_of(&self.between).is_le()
    }

    /// Whether the vertex passes through the line of the edge strictly inside it.
    fn is_passed(&self, time: &Time) -> bool {
        self.is_met(time)
            && time.sign_of(&self.between).is_lt()
            && self
                .turn
                .iter()
                .any(|turn| !turn.is_zero() && order(turn, time).0 == 1)
    }
}

/// The multiplicity of a root and the sign of the first derivative that is not 0 there.
fn order(poly: &Polynomial, time: &Time) -> (usize, Ordering) {
    let mut derivative = poly.clone();
    for order in 0.. {
        let sign = time.sign_of(&derivative);
        if sign.is_ne() {
            return (order, sign);
        }
        derivative = derivative.derivative();
    }
    unreachable!("a polynomial that is not 0")
}

fn cross(x: &Vector, y: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| x[i].mul(&y[j]).sub(&x[j].mul(&y[i])))
}

fn dot(x: &Vector, y: &Vector) -> Polynomial {
    let [a, b, c] = [0, 1, 2].map(|i| x[i].mul(&y[i]));
    a.add(&b).add(&c)
}
