//! Where two edges touch at one time at which they are coplanar.

use std::cmp::Ordering;

use crate::contact::Flags;

use super::motion::{Motion, Quadratic, add, negate, subtract};
use super::time::{Time, sign};
use super::width::{Number, Width};

/// The points that two touching edges share at one time.
pub(super) struct Locus<L: Width> {
    pub(super) first: Place<L>,
    /// The other end of an overlap of more than a point.
    pub(super) second: Option<Place<L>>,
    /// Whether the lines meet at an angle, in a point that is strictly inside both edges.
    pub(super) cuts_inside: bool,
    pub(super) flags: Flags,
}

/// A point of both edges.
pub(super) struct Place<L: Width> {
    pub(super) u: Parameter<L>,
    pub(super) v: Parameter<L>,
}

/// A parameter on an edge at a time that is known from the context.
pub(super) enum Parameter<L: Width> {
    /// 0.
    Start,
    /// 1.
    End,
    /// Strictly between 0 and 1: the quotient of two polynomials.
    Quotient(Quadratic<L>, Quadratic<L>),
}

/// The indices of the ends A and C.
const A: usize = 0;
const C: usize = 2;

impl<L: Width> Parameter<L> {
    /// `n / d`, if it is in `[0, 1]`, for a denominator of the given sign, which is not 0.
    pub(super) fn new(
        time: &Time<L>,
        n: Quadratic<L>,
        d: Quadratic<L>,
        sign_of_d: Ordering,
    ) -> Option<Self> {
        let from_start = time.sign_of(&n);
        if from_start.is_eq() {
            return Some(Parameter::Start);
        }
        if from_start != sign_of_d {
            return None;
        }
        match time.sign_of(&subtract::<L>(&n, &d)) {
            Ordering::Equal => Some(Parameter::End),
            sign if sign == sign_of_d => None,
            _ => Some(Parameter::Quotient(n, d)),
        }
    }

    /// Its value, with an error of at most [`PARAMETER_ERROR`](super::PARAMETER_ERROR).
    pub(super) fn value(&self, time: &Time<L>) -> f64 {
        match self {
            Parameter::Start => 0.0,
            Parameter::End => 1.0,
            Parameter::Quotient(n, d) => time.quotient(n, d),
        }
    }

    /// Whether it is strictly between 0 and 1.
    pub(super) fn is_interior(&self) -> bool {
        matches!(self, Parameter::Quotient(..))
    }
}

impl<L: Width> Motion<L> {
    /// Where the edges touch at a time at which `f` is 0; `None` if they do not.
    pub(super) fn locus(&self, time: &Time<L>) -> Option<Locus<L>> {
        match nonzero_axis(&self.n, time) {
            Some((axis, sign)) => self.locus_transversal(time, axis, sign),
            None => self.locus_parallel(time),
        }
    }

    /// The lines meet in one point. From `A + u K = C + v L`: `M x L = u N` and `M x K = v N`,
    /// which one component of `N` that is not 0 solves.
    #[inline(never)]
    fn locus_transversal(&self, time: &Time<L>, axis: usize, sign: Ordering) -> Option<Locus<L>> {
        let n = &self.n[axis];
        let u = Parameter::new(time, self.m.cross_component(&self.l, axis), n.clone(), sign)?;
        let v = Parameter::new(time, self.m.cross_component(&self.k, axis), n.clone(), sign)?;
        Some(Locus {
            cuts_inside: u.is_interior() && v.is_interior(),
            first: Place { u, v },
            second: None,
            flags: Flags::default(),
        })
    }

    /// The edges are parallel, or one of them is a point, or both are.
    #[inline(never)]
    fn locus_parallel(&self, time: &Time<L>) -> Option<Locus<L>> {
        let (kk, ll) = (self.k.dot(&self.k), self.l.dot(&self.l));
        let first_is_point = time.sign_of(&kk).is_eq();
        let second_is_point = time.sign_of(&ll).is_eq();
        let vanishes = |end: usize| {
            let turn = &self.ends()[end].turn;
            turn.iter().all(|component| time.sign_of(component).is_eq())
        };
        let flags = Flags {
            temporarily_parallel: !first_is_point && !second_is_point && !self.is_parallel(),
            temporarily_point: first_is_point && !self.k.is_zero()
                || second_is_point && !self.l.is_zero(),
        };
        let (first, second) = match (first_is_point, second_is_point) {
            (false, false) if vanishes(C) => self.overlap(time, &kk, &ll)?,
            (true, false) if vanishes(A) => {
                // v = (A - C) . L / L . L
                let n = negate::<L>(&self.m.dot(&self.l));
                let v = Parameter::new(time, n, ll, Ordering::Greater)?;
                (
                    Place {
                        u: Parameter::Start,
                        v,
                    },
                    None,
                )
            }
            (false, true) if vanishes(C) => {
                // u = (C - A) . K / K . K
                let u = Parameter::new(time, self.m.dot(&self.k), kk, Ordering::Greater)?;
                (
                    Place {
                        u,
                        v: Parameter::Start,
                    },
                    None,
                )
            }
            (true, true) if time.sign_of(&self.m.dot(&self.m)).is_eq() => {
                let place = Place {
                    u: Parameter::Start,
                    v: Parameter::Start,
                };
                (place, None)
            }
            _ => return None,
        };
        Some(Locus {
            first,
            second,
            cuts_inside: false,
            flags,
        })
    }

    /// Whether the directions are parallel for the whole step.
    pub(super) fn is_parallel(&self) -> bool {
        self.n.iter().flatten().all(Number::is_zero)
    }

    /// Both edges are on one line and neither is a point: the ends of what they share are ends of
    /// the edges that are on the other edge. Whether it is more than a point follows from the signs
    /// of [`between`](super::motion::End::between): an end is strictly inside the other edge, or A
    /// and B are both ends of the other edge.
    fn overlap(
        &self,
        time: &Time<L>,
        kk: &Quadratic<L>,
        ll: &Quadratic<L>,
    ) -> Option<(Place<L>, Option<Place<L>>)> {
        let signs = self.ends().each_ref().map(|end| time.sign_of(&end.between));
        if signs.iter().all(|sign| sign.is_gt()) {
            return None;
        }
        let [a, b, _, _] = signs;
        let is_more = signs.iter().any(|sign| sign.is_lt()) || a.is_eq() && b.is_eq();
        let same_way = time.sign_of(&self.k.dot(&self.l)).is_gt();
        let (mk, ml) = (self.m.dot(&self.k), self.m.dot(&self.l));
        let inside = |n, d: &Quadratic<L>| Parameter::new(time, n, d.clone(), Ordering::Greater);
        // Where A, B, C and D are on the other edge.
        let at_a = || {
            Some(Place {
                u: Parameter::Start,
                v: inside(negate::<L>(&ml), ll)?,
            })
        };
        let at_b = || {
            let n = subtract::<L>(&self.k.dot(&self.l), &ml);
            Some(Place {
                u: Parameter::End,
                v: inside(n, ll)?,
            })
        };
        let at_c = || {
            Some(Place {
                u: inside(mk.clone(), kk)?,
                v: Parameter::Start,
            })
        };
        let at_d = || {
            let n = add::<L>(&mk, &self.k.dot(&self.l));
            Some(Place {
                u: inside(n, kk)?,
                v: Parameter::End,
            })
        };
        let first = match (a.is_le(), b.is_le() && !is_more, same_way) {
            (true, _, _) => at_a(),
            (_, true, _) => at_b(),
            (_, _, true) => at_c(),
            (_, _, false) => at_d(),
        }?;
        let second = match (is_more, b.is_le(), same_way) {
            (false, _, _) => None,
            (true, true, _) => at_b(),
            (true, false, true) => at_d(),
            (true, false, false) => at_c(),
        };
        Some((first, second))
    }
}

/// A component of a vector that is not 0 at the time, and its sign: the largest of those for which
/// floating point shows it, else any.
pub(super) fn nonzero_axis<L: Width>(
    vector: &[Quadratic<L>; 3],
    time: &Time<L>,
) -> Option<(usize, Ordering)> {
    let quick = vector
        .each_ref()
        .map(|component| time.quick_value_of(component));
    let values = quick.iter().map(|value| value.unwrap_or(0.0)).enumerate();
    let largest = values.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
    let shown = sign(largest.1).filter(|sign| sign.is_ne());
    shown.map(|sign| (largest.0, sign)).or_else(|| {
        let open = (0..3).filter(|&h| quick[h].is_none());
        let exact = open.map(|h| (h, time.sign_of(&vector[h])));
        exact.into_iter().find(|(_, sign)| sign.is_ne())
    })
}
