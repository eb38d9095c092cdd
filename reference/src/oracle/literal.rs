//! The description of contact evaluated at every candidate: slow, plain, and the test of the rest.

use tunnelproof::query::Query;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::scaled::Scaled;

use super::motion_of;
use super::pair::Pair;
use super::proximity::Square;

/// The first contact time, from the definition alone.
///
/// `contact(t)` is: for some two features, what they span has nearest points on both of them and is
/// at most the radius apart. All of it are signs of polynomials, which change at their roots only.
pub(super) fn first_contact<Z: Integer>(query: &Query) -> Option<Algebraic<Z>> {
    let points = Scaled::new(query);
    let pairs = motion_of(query, &points).pairs();
    let square = Square::new(&query.radius().parts(), points.exponent);
    let excesses: Vec<_> = pairs.iter().map(|pair| square.excess(pair)).collect();

    let mut candidates = vec![Algebraic::zero()];
    let of_pairs = |pair: &'_ Pair<Z>| {
        let mut polys = pair.inside.clone();
        polys.push(pair.denominator.clone());
        polys
    };
    let polys = pairs.iter().flat_map(of_pairs);
    for poly in polys.chain(excesses.iter().cloned()) {
        candidates.extend(isolate_roots(&poly));
    }
    candidates.sort_by(Algebraic::compare);

    let is_contact = |time: &Algebraic<Z>| {
        let mut described = pairs.iter().zip(&excesses);
        described.any(|(pair, excess)| time.sign_of(excess).is_le() && pair.holds(time))
    };
    candidates.into_iter().find(is_contact)
}
