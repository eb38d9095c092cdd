//! Whether the two sides pass through each other, and from where.

use std::cmp::Ordering;

use tunnelproof::query::Radius;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;

use super::part::Distance;
use super::polygon::Polygon;

/// The last of `times` before `time`, or the start; and the first after it, or the end.
fn neighbours<Z: Integer>(times: &[Algebraic<Z>], time: &Algebraic<Z>) -> [Algebraic<Z>; 2] {
    let before = times.iter().rfind(|other| other.compare(time).is_lt());
    let after = times.iter().find(|other| other.compare(time).is_gt());
    [
        before.cloned().unwrap_or_else(Algebraic::zero),
        after.cloned().unwrap_or_else(end),
    ]
}

fn end<Z: Integer>() -> Algebraic<Z> {
    Algebraic::dyadic(Z::one(), 0)
}

/// Fractions just before and just after a time strictly inside the step: none of `times`, which are
/// in order, is between either and it.
fn around<Z: Integer>(times: &[Algebraic<Z>], time: &Algebraic<Z>) -> [Algebraic<Z>; 2] {
    let [before, after] = neighbours(times, time);
    [before.between(time), time.between(&after)]
}

fn is_inside<Z: Integer>(time: &Algebraic<Z>) -> bool {
    time.compare(&Algebraic::zero()).is_gt() && time.compare(&end()).is_lt()
}

impl<Z: Integer> Polygon<Z> {
    /// The times of crossings without radius, in the sense of [`crate::answer`].
    pub(super) fn crossings(&self) -> Vec<Algebraic<Z>> {
        let contact = Distance::new(self, Radius::ZERO, 0);
        let volume = self.volume();
        if !volume.is_zero() {
            return self.general_crossings(&volume, &contact);
        }
        match self.is_on_line() {
            true => self.collinear_crossings(&contact),
            false => self.planar_crossings(&contact),
        }
    }

    /// The volume has different signs before and after, and the origin is strictly inside the
    /// polygon.
    fn general_crossings(&self, volume: &Poly<Z>, contact: &Distance<Z>) -> Vec<Algebraic<Z>> {
        let roots = isolate_roots(volume);
        let crosses = |time: &&Algebraic<Z>| {
            is_inside(time) && contact.is_strictly_inside(time) && {
                let [before, after] = around(&roots, time).map(|time| time.sign_of(volume));
                before != after
            }
        };
        roots.iter().filter(crosses).cloned().collect()
    }

    /// The origin passes through the line of an edge: the corners turn around it one way before and
    /// the other way after.
    fn planar_crossings(&self, contact: &Distance<Z>) -> Vec<Algebraic<Z>> {
        let mut crossings = Vec::new();
        for &edge in self.edges() {
            let roots = isolate_roots(&self.turn(edge));
            // The normal is a vector without a zero, times the common divisor of its components:
            // it reverses its direction where that changes its sign.
            let [x, y, z] = self.normal(edge);
            let divisor = x.gcd(&y).gcd(&z);
            let times = isolate_roots(&divisor);
            let turns_back = |time: &Algebraic<Z>| {
                let [before, after] = around(&times, time).map(|time| time.sign_of(&divisor));
                before != after
            };
            let touches = |time: &Algebraic<Z>| {
                time.sign_of(self.dot(edge.0, edge.1)).is_lt() || contact.overlaps(time)
            };
            let crosses =
                |time: &&Algebraic<Z>| is_inside(time) && touches(time) && turns_back(time);
            crossings.extend(roots.iter().filter(crosses).cloned());
        }
        crossings
    }

    /// Contact begins: a corner is at the origin, and there is no contact before.
    fn collinear_crossings(&self, contact: &Distance<Z>) -> Vec<Algebraic<Z>> {
        let at_origin = |corner| isolate_roots(self.dot(corner, corner));
        let mut times: Vec<_> = (0..self.number_of_corners()).flat_map(at_origin).collect();
        times.sort_by(Algebraic::compare);
        let begins = |time: &&Algebraic<Z>| {
            let was_apart = || {
                let [before, _] = neighbours(&times, time);
                !contact.is_contact(&before.between(time))
            };
            is_inside(time) && was_apart()
        };
        times.iter().filter(begins).cloned().collect()
    }

    /// The sign of the triple product just before a time; 0 at the start.
    pub(super) fn side_before(&self, time: &Algebraic<Z>) -> Ordering {
        let volume = self.volume();
        if time.compare(&Algebraic::zero()).is_eq() || volume.is_zero() {
            return Ordering::Equal;
        }
        let [before, _] = neighbours(&isolate_roots(&volume), time);
        before.between(time).sign_of(&volume)
    }
}

impl<Z: Integer> Distance<Z> {
    /// Whether two edges touch in more than a point.
    fn overlaps(&self, time: &Algebraic<Z>) -> bool {
        self.is_contact(time) && self.nearest(time).2.is_some()
    }
}
