//! Two features, one of each side, and when their distance is that of the two sides.

use super::vector::one;
use super::{Poly, Reach, Time};
use crate::certified::exact::dyadic::Dyadic;
use crate::certified::exact::integer::Integer;

/// Two features.
pub(super) struct Pair<const W: usize> {
    /// The squared distance of what they span is `numerator / denominator`, in the unit of the
    /// vectors.
    numerator: Poly,
    /// At least 0; where it is 0, features with fewer points are as near.
    denominator: Poly,
    /// At least 0, all of them, where the nearest points are inside the features or where these
    /// end.
    inside: Vec<Poly>,
    /// The nearest points.
    pub(super) place: Place<W>,
}

/// Numbers that say where the nearest points are.
#[derive(Clone)]
pub(in crate::certified::exact) struct Place<const W: usize>(
    pub(in crate::certified::exact) [Share; W],
);

/// A parameter on an edge or a weight in a face, in `[0, 1]` at a time that is known from the
/// context.
#[derive(Clone)]
pub(in crate::certified::exact) enum Share {
    /// 0.
    None,
    /// 1.
    All,
    /// The quotient of two polynomials.
    Quotient(Poly, Poly),
}

impl<const W: usize> Place<W> {
    pub(in crate::certified::exact) fn values(&self, time: &Time) -> [f64; W] {
        self.0.each_ref().map(|share| match share {
            Share::None => 0.0,
            Share::All => 1.0,
            Share::Quotient(n, d) => time.quotient(n, d).max(0.0),
        })
    }
}

impl<const W: usize> Pair<W> {
    /// Two vertices at this squared distance.
    pub(super) fn vertices(squared: &Poly, place: [Share; W]) -> Self {
        Pair {
            numerator: squared.clone(),
            denominator: one(),
            inside: Vec::new(),
            place: Place(place),
        }
    }

    /// A vertex `X` and an edge `YZ`. With the way `w = Y - X` and a vector `E` of which `Z - Y` is a
    /// multiple by a factor above 0, given are `w . w`, `w . E`, `E . E` and `(Z - Y) . E`. The line is
    /// `|w x E| / |E|` away, and `|w x E|^2` is `(w . w) (E . E) - (w . E)^2`; the nearest point is
    /// `-w . E` and `(Z - X) . E` from the ends, times `|E|`. Both shares of their sum are given to
    /// `place`.
    pub(super) fn vertex_edge(
        [ww, we, ee, step]: [&Poly; 4],
        place: impl FnOnce([Share; 2]) -> [Share; W],
    ) -> Self {
        let share = Poly::difference(&Poly::default(), we);
        let rest = Poly::sum(we, step);
        let quotient = |n: &Poly| Share::Quotient(n.clone(), step.clone());
        Pair {
            numerator: Poly::difference(&Poly::product(ww, ee), &Poly::product(we, we)),
            place: Place(place([quotient(&share), quotient(&rest)])),
            inside: vec![share, rest],
            denominator: ee.clone(),
        }
    }

    /// Two edges, or a vertex and a face, whose lines or plane and point are `|f| / |N|` apart. The
    /// shares times `N . N` are `inside`, as far as they have to be at least 0.
    pub(super) fn insides(f: &Poly, n2: &Poly, inside: Vec<Poly>, place: [Share; W]) -> Self {
        Pair {
            numerator: Poly::product(f, f),
            denominator: n2.clone(),
            inside,
            place: Place(place),
        }
    }

    /// A positive multiple of `numerator - R^2 denominator`: 0 where what they span is at the
    /// distance.
    pub(super) fn excess(&self, Reach { square, shift }: &Reach) -> Poly {
        let up = |by: i64| by.max(0).unsigned_abs();
        let own = self.numerator.shifted(up(-shift));
        let square = square.shifted(up(*shift));
        Poly::difference(&own, &Poly::product(&square, &self.denominator))
    }

    /// Whether the nearest points of what they span are on the features at a time.
    pub(super) fn holds(&self, time: &Time) -> bool {
        self.inside
            .iter()
            .all(|inside| time.sign_of(inside).is_ge())
            && time.sign_of(&self.denominator).is_gt()
    }

    /// The first of the nearest of those that hold at the start.
    pub(super) fn nearest_at_start(pairs: &[Self]) -> Option<&Self> {
        let start = Dyadic::zero();
        let mut nearest: Option<&Self> = None;
        for pair in pairs
            .iter()
            .filter(|pair| pair.holds(&Time::At(start.clone())))
        {
            let is_nearer = |other: &Self| {
                let [own_p, own_q] = [&pair.numerator, &pair.denominator].map(|p| p.coefficient(0));
                let [p, q] = [&other.numerator, &other.denominator].map(|p| p.coefficient(0));
                Integer::product(own_p, q) < Integer::product(p, own_q)
            };
            if nearest.is_none_or(is_nearer) {
                nearest = Some(pair);
            }
        }
        nearest
    }
}
