//! Two features, one of each side, and when their distance is that of the whole.
//!
//! A feature is a vertex, an edge or the face without what bounds it. Of two convex sets the
//! nearest points are each in one feature, and there they are also the nearest points of what the
//! features span: of lines, planes, or single points.

use crate::algebraic::Algebraic;
use crate::field::Integer;
use crate::poly::Poly;

use super::locus::Place;
use super::motion::End;
use super::vector::Vector;

/// Two features.
#[derive(Clone, Debug)]
pub(super) struct Pair<Z> {
    /// The squared distance of what they span is this by [`denominator`](Self::denominator).
    pub(super) numerator: Poly<Z>,
    /// At least 0; where it is 0, other features with fewer points are as near.
    pub(super) denominator: Poly<Z>,
    /// At least 0, all of them, where the nearest points of what they span are on the features or
    /// where these end.
    pub(super) inside: Vec<Poly<Z>>,
    /// These nearest points.
    pub(super) place: Place<Z>,
}

impl<Z: Integer> Pair<Z> {
    /// Two vertices with this way from one to the other.
    pub(super) fn vertices(way: &Vector<Z>, place: Place<Z>) -> Self {
        Pair {
            numerator: way.dot(way),
            denominator: Poly::constant(Z::one()),
            inside: Vec::new(),
            place,
        }
    }

    /// A vertex `X` and an edge `YZ`. With `w = X - Y` and `E = Z - Y` the squared distance from
    /// the line is `|w x E|^2 / E.E`, the nearest point is `w.E / E.E` of the way from `Y`.
    pub(super) fn end(end: &End<Z>, place: impl FnOnce(&[Poly<Z>; 3]) -> Place<Z>) -> Self {
        let along = end.along();
        let place = place(&along);
        let [from_y, to_z, denominator] = along;
        Pair {
            numerator: end.turn.dot(&end.turn),
            denominator,
            inside: vec![from_y, to_z],
            place,
        }
    }

    /// Whether the nearest points of what they span are on the features at this time.
    pub(super) fn holds(&self, time: &Algebraic<Z>) -> bool {
        let not_negative = |poly: &Poly<Z>| time.sign_of(poly).is_ge();
        self.inside.iter().all(not_negative) && time.sign_of(&self.denominator).is_gt()
    }

    /// Whether it is nearer than another one, at a time at which both hold.
    pub(super) fn is_nearer(&self, other: &Self, time: &Algebraic<Z>) -> bool {
        let mut difference = self.numerator.mul(&other.denominator);
        difference.sub_product(&other.numerator, &self.denominator);
        time.sign_of(&difference).is_lt()
    }
}
