//! Where two edges touch at one time.

use std::cmp::Ordering;

use crate::algebraic::Algebraic;
use crate::answer::{Enclosure, Parameters};
use crate::field::Integer;
use crate::poly::Poly;

use super::motion::Motion;

/// The points that two touching edges share at one time.
#[derive(Clone, Debug)]
pub(super) struct Locus<Z> {
    pub(super) first: Place<Z>,
    /// The other end of an overlap of more than a point.
    pub(super) second: Option<Place<Z>>,
    /// Whether the lines meet at an angle, in a point that is interior to both edges.
    pub(super) cuts_inside: bool,
}

/// A point of both edges.
#[derive(Clone, Debug)]
pub(super) struct Place<Z> {
    u: Parameter<Z>,
    v: Parameter<Z>,
}

/// A parameter on an edge, at a time that is known from the context.
#[derive(Clone, Debug)]
enum Parameter<Z> {
    Start,
    End,
    Quotient(Poly<Z>, Poly<Z>),
}

impl<Z: Integer> Place<Z> {
    pub(super) fn parameters(&self, time: &Algebraic<Z>) -> Parameters {
        let enclose = |parameter: &Parameter<Z>| match parameter {
            Parameter::Start => Enclosure::exactly(0.0),
            Parameter::End => Enclosure::exactly(1.0),
            Parameter::Quotient(n, d) => time.enclose_quotient(n, d),
        };
        Parameters {
            u: enclose(&self.u),
            v: enclose(&self.v),
        }
    }
}

/// What a quotient of polynomials is at a time, relative to the interval `[0, 1]`.
struct Position {
    /// Compared with 0.
    start: Ordering,
    /// Compared with 1.
    end: Ordering,
}

impl Position {
    /// The position of `n / d`, given the sign of `d`, which is not 0.
    fn of<Z: Integer>(
        time: &Algebraic<Z>,
        n: &Poly<Z>,
        d: &Poly<Z>,
        sign_of_d: Ordering,
    ) -> Option<Self> {
        let oriented = |sign: Ordering| {
            if sign_of_d.is_lt() {
                sign.reverse()
            } else {
                sign
            }
        };
        let start = oriented(time.sign_of(n));
        if start.is_lt() {
            return None;
        }
        let end = oriented(time.sign_of(&n.sub(d)));
        end.is_le().then_some(Position { start, end })
    }

    fn is_interior(&self) -> bool {
        self.start.is_gt() && self.end.is_lt()
    }
}

impl<Z: Integer> Motion<Z> {
    /// Where the edges touch at a time at which `f` is 0; `None` if they do not.
    pub(super) fn locus(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        match self.transversal_axis(time) {
            Some((axis, sign)) => self.locus_transversal(time, axis, sign),
            None => match (self.k.is_zero_at(time), self.l.is_zero_at(time)) {
                (false, false) => self.locus_parallel(time),
                (true, false) => self.locus_first_is_point(time),
                (false, true) => self.locus_second_is_point(time),
                (true, true) => self.m.is_zero_at(time).then(|| Locus {
                    first: Place {
                        u: Parameter::Start,
                        v: Parameter::Start,
                    },
                    second: None,
                    cuts_inside: false,
                }),
            },
        }
    }

    /// A component of `N` that is not 0 at the time, and its sign. The ones that the time's bounds
    /// show come first: to see that a component is 0 costs more.
    pub(super) fn transversal_axis(&self, time: &Algebraic<Z>) -> Option<(usize, Ordering)> {
        let shown = |h: usize| {
            let component = &self.n.0[h];
            (
                h,
                if component.is_zero() {
                    None
                } else {
                    time.try_sign_of(component)
                },
            )
        };
        let quick = [0, 1, 2]
            .map(shown)
            .into_iter()
            .find_map(|(h, sign)| Some((h, sign?)));
        quick.filter(|(_, sign)| sign.is_ne()).or_else(|| {
            let exact = |h: usize| (h, time.sign_of(&self.n.0[h]));
            [0, 1, 2]
                .into_iter()
                .map(exact)
                .find(|(_, sign)| sign.is_ne())
        })
    }

    /// The lines meet in one point. From `A + u K = C + v L`: `M x L = u N` and `M x K = v N`, which
    /// one component of `N` that is not 0 solves.
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
            first: Place { u, v },
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
        let first = Place {
            u: Parameter::Start,
            v: Parameter::Quotient(n, d),
        };
        Some(Locus {
            first,
            second: None,
            cuts_inside: false,
        })
    }

    /// `C = D`: that point against the edge `AB`, at `u = (C - A) . K / K . K`.
    fn locus_second_is_point(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        if !self.m.cross(&self.k).is_zero_at(time) {
            return None;
        }
        let (n, d) = (self.m.dot(&self.k), self.k.dot(&self.k));
        Position::of(time, &n, &d, Ordering::Greater)?;
        let first = Place {
            u: Parameter::Quotient(n, d),
            v: Parameter::Start,
        };
        Some(Locus {
            first,
            second: None,
            cuts_inside: false,
        })
    }

    /// Both have a direction, the same up to sign: the overlap on the common line, if it is one.
    fn locus_parallel(&self, time: &Algebraic<Z>) -> Option<Locus<Z>> {
        if !self.m.cross(&self.k).is_zero_at(time) {
            return None;
        }
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
            Place {
                u: Parameter::Start,
                v: at_a(),
            }
        } else {
            Place {
                u: along(low),
                v: v_low,
            }
        };
        let is_point = low_to_b.is_eq() || high_to_a.is_eq();
        let second = (!is_point).then(|| {
            if time.sign_of(&high.sub(&kk)).is_ge() {
                Place {
                    u: Parameter::End,
                    v: at_b(),
                }
            } else {
                Place {
                    u: along(high),
                    v: v_high,
                }
            }
        });
        Some(Locus {
            first,
            cuts_inside: false,
            second,
        })
    }
}
