use proptest::prelude::*;

use super::super::dyadic::tests::middle;
use super::super::isolate::Place;
use super::super::isolate::tests::{isolated, poly};
use super::*;

/// The sign by halving until the polynomial has no root and no other sign near the root; `None` if
/// it seems to be 0 there.
fn sign_by_halving(
    p: &Poly,
    q: &Poly,
    before: Ordering,
    low: &Dyadic,
    high: &Dyadic,
) -> Option<Ordering> {
    let (mut low, mut high) = (low.clone(), high.clone());
    for _ in 0..80 {
        let middle = middle(&low, &high);
        match p.sign_at(&middle) {
            Ordering::Equal => return Some(q.sign_at(&middle)),
            sign if sign == before => low = middle,
            _ => high = middle,
        }
    }
    let signs = (q.sign_at(&low), q.sign_at(&high));
    (signs.0 == signs.1 && signs.0.is_ne()).then_some(signs.0)
}

/// Narrows a cell until neither end is a root.
fn proved(p: &Poly, before: Ordering, low: &Dyadic, high: &Dyadic) -> Option<(Dyadic, Dyadic)> {
    let (mut low, mut high) = (low.clone(), high.clone());
    while p.sign_at(&low).is_eq() || p.sign_at(&high).is_eq() {
        let middle = middle(&low, &high);
        match p.sign_at(&middle) {
            Ordering::Equal => return None,
            sign if sign == before => low = middle,
            _ => high = middle,
        }
    }
    Some((low, high))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn sign_at_root_is_the_one_found_by_halving(
        p in prop::collection::vec(-6i64..=6, 2..=4),
        q in prop::collection::vec(-6i64..=6, 1..=3),
        share in any::<bool>(),
    ) {
        // Half of the time the linear factor q[0] + q[1] t is one of both.
        let p = match (share, q.as_slice(), p.as_slice()) {
            (true, [a, b, ..], [c, d, e, ..]) if *b != 0 => vec![a * c, a * d + b * c, a * e + b * d, b * e],
            _ => p,
        };
        let q = if share && q.len() == 3 { vec![q[0] * q[2], q[0] + q[1] * q[2], q[1]] } else { q };
        prop_assume!(p.iter().any(|&c| c != 0));
        let isolated = isolated(poly(&p));
        for cell in isolated.cells() {
            let Place::Between { poly: index, low, high, before } = &cell.place else {
                continue;
            };
            let p = isolated.poly(*index);
            let Some((low, high)) = proved(p, *before, low, high) else {
                continue;
            };
            let sign = sign_at_root(p, poly(&q), *before, &low, &high);
            match sign_by_halving(p, &poly(&q), *before, &low, &high) {
                Some(expected) => prop_assert_eq!(sign, expected),
                // So near 0, with coefficients this small, it is 0.
                None => prop_assert_eq!(sign, Ordering::Equal),
            }
        }
    }
}
