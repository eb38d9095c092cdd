//! The contact normal: what [`normal`](crate::certified::normal) says of linear motion, here in the
//! frame of the second side's body, and turned into space by `M(q)`.
//!
//! All vectors are times something above 0, on which no direction depends. Where contact is inside
//! both sides it is the perpendicular `N = K x L` with the sign of `f = M . N` just before, which is
//! [`Hit::side`]: `N` is not 0 at the contact, and the points move continuously, so that the feet of
//! the perpendicular are inside just before as well. With a radius it is also the vector between
//! the nearest points, `M + v L - u K`. What neither shows is decided in integers
//! (`exact::thick::normal`).
//!
//! The exact time is within `toi_above - toi` of `toi`, and `u` and `v` are within the error of the
//! place; [`Rough`] carries both to the result. The time is off by an ulp, which turns a vector by
//! about as much as roundings do: numbers of twice the precision would add little.

use super::differences::{Arm, Differences, into_space};
use super::rough::Rough;
use super::term::{Vector, add, cross, scaled, sub};
use super::turning::Turning;
use crate::certified::kind::Stages;
use crate::certified::motion;
use crate::certified::normal::{At, Bounded, Normal, exact, is_inside, nearest};
use crate::contact::Hit;

impl<const FIRST: usize, const SECOND: usize> Turning<'_, FIRST, SECOND> {
    /// The contact normal of a hit whose place has this error; `exactly` has it from integers, for
    /// the two numbers next to the time.
    ///
    /// `None` only where the sides touch at the start, for a hit of this query.
    pub(super) fn normal<K: Stages>(
        &self,
        hit: &Hit<K::Place>,
        error: f64,
        exactly: impl FnOnce([f64; 2]) -> Option<motion::Vector>,
    ) -> Option<Normal> {
        let (weights, second) = K::weights(&hit.place);
        let [_, b, c, d] = weights;
        // u and v: those of C and D of a face.
        let shares = match K::FIRST {
            1 => [c, d],
            _ => [b, d],
        };
        // B too must have a weight, of a face.
        let is_inside = [shares[0], shares[1], b]
            .iter()
            .all(|&share| is_inside(share, error));
        let at = At::new(hit, error);
        let time = Rough::new(hit.toi, hit.toi_above - hit.toi);
        let of = Differences::<Rough>::new::<K, FIRST, SECOND>(self, time);
        let turned = |v: Vector<Rough>| {
            let v = into_space(self.second.motion, time, &v);
            Bounded::of(v.map(|x| (x.value(), x.error())))
        };
        let perpendicular =
            || turned(cross(&of.k.vector, &of.l.vector)).directed(f64::from(hit.side));
        let between = || turned(of.at(shares.map(|share| Rough::new(share, error))));
        nearest(
            is_inside && second.is_none(),
            self.radius,
            &at,
            perpendicular,
            between,
        )
        .or_else(|| exactly([hit.toi, hit.toi_above]).map(exact))
    }
}

impl Differences<Rough> {
    /// `D (M + v L - u K)`.
    fn at(&self, [u, v]: [Rough; 2]) -> Vector<Rough> {
        let along = |arm: &Arm<Rough>, share: Rough| match arm.rests {
            true => scaled(&self.d.mul(share), &arm.vector),
            false => scaled(&share, &arm.vector),
        };
        sub(&add(&self.m, &along(&self.l, v)), &along(&self.k, u))
    }
}
