//! Where two edges, or a vertex and a face, touch or are nearest to each other at one time.

use std::cmp::Ordering;

use crate::algebraic::Algebraic;
use crate::answer::{Enclosure, Feature, Parameters};
use crate::field::Integer;
use crate::poly::Poly;

/// The points of contact at one time, or those that are nearest to each other.
#[derive(Clone, Debug)]
pub(super) struct Locus<Z> {
    pub(super) first: Place<Z>,
    /// The other end of an overlap of more than a point.
    pub(super) second: Option<Place<Z>>,
    /// Whether contact is inside: the lines meet at an angle, in a point that is interior to both
    /// edges, or the vertex is strictly inside the face.
    pub(super) cuts_inside: bool,
}

impl<Z> Locus<Z> {
    /// A single place, where nothing passes through anything.
    pub(super) fn at(first: Place<Z>) -> Self {
        Locus {
            first,
            second: None,
            cuts_inside: false,
        }
    }
}

/// A point of either side.
#[derive(Clone, Debug)]
pub(super) struct Place<Z> {
    pub(super) u: Parameter<Z>,
    pub(super) v: Parameter<Z>,
    /// The part of the face that it is on; `None` for edges, whose parameters tell.
    pub(super) of_face: Option<Feature>,
}

/// A parameter on an edge, at a time that is known from the context.
#[derive(Clone, Debug)]
pub(super) enum Parameter<Z> {
    /// 0.
    Start,
    /// 1.
    End,
    /// A quotient of polynomials, in `[0, 1]`.
    Quotient(Poly<Z>, Poly<Z>),
}

impl<Z: Integer> Place<Z> {
    /// A point of each edge.
    pub(super) fn of_edges(u: Parameter<Z>, v: Parameter<Z>) -> Self {
        Place {
            u,
            v,
            of_face: None,
        }
    }

    /// The features that touch, given the parameters of the place.
    pub(super) fn features(&self, parameters: &Parameters) -> [Feature; 2] {
        match self.of_face {
            Some(feature) => [Feature::vertex(0), feature],
            None => parameters.features_of_edges(),
        }
    }

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
pub(super) struct Position {
    /// Compared with 0.
    pub(super) start: Ordering,
    /// Compared with 1.
    pub(super) end: Ordering,
}

impl Position {
    /// The position of `n / d`, given the sign of `d`, which is not 0.
    pub(super) fn of<Z: Integer>(
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

    pub(super) fn is_interior(&self) -> bool {
        self.start.is_gt() && self.end.is_lt()
    }
}
