use super::*;

fn poly(coefficients: &[i128]) -> Poly {
    let coefficients: Vec<_> = coefficients.iter().map(|&c| Integer::from(c)).collect();
    Poly::new(&coefficients)
}

/// What is said to be a bracket and holds no root, as floating point may say outside of its
/// preconditions: one sign throughout, a root at an end alone, and the signs reversed.
fn without_root(visit: impl Fn(Bracket)) {
    let (zero, one) = (Dyadic::zero(), Dyadic::one());
    let [less, greater] = [Ordering::Less, Ordering::Greater];
    let wrong = [
        (&[1, 0, 1][..], [less, greater]),
        (&[0, 1], [less, less]),
        (&[0, 0, 3, 1], [less, less]),
        (&[-1, 1], [less, less]),
        (&[1, -2, 1], [greater, greater]),
        (&[0, 1, -1], [less, greater]),
        (&[-1, 2], [greater, greater]),
    ];
    for (coefficients, signs) in wrong {
        let poly = poly(coefficients);
        for before in signs {
            visit(Bracket::new(&poly, zero.clone(), one.clone(), before));
        }
    }
}

#[test]
fn bracket_settle_ends_without_a_root() {
    without_root(|mut bracket| {
        let most = bracket.most_exponent(1, 0);
        match bracket.settle() {
            Settled::At(at) => assert!(at.exponent <= most + u64::from(MOST_BITS)),
            Settled::Between(below, above) => assert!(below < above),
        }
    });
}

#[test]
fn bracket_signs_end_without_a_root() {
    without_root(|bracket| {
        for q in [&[0, 1][..], &[-1, 1], &[1, 3], &[-1, 3, 5], &[0, 7, 0, -7]] {
            bracket.sign_of(poly(q));
        }
    });
}

#[test]
fn bracket_quotients_end_without_a_root() {
    without_root(|bracket| {
        for d in [&[0, 1][..], &[1, -1], &[0, 0, 1], &[0, 1, -1]] {
            let quotient = bracket.quotient(&poly(&[0, 1]), &poly(d));
            assert!(!quotient.is_nan());
        }
    });
}

#[test]
fn bracket_of_a_root_next_to_an_end_settles() {
    // The only root is 2^-900, and the one of the other is 1 less that; both far from the end.
    let small = |negate: bool| {
        let mut one = Integer::from(1);
        if negate {
            one.negate();
        }
        Poly::<4>::new(&[one, Integer::from(if negate { 1 } else { -1 }).shifted(900)])
    };
    for (poly, before) in [
        (small(true), Ordering::Less),
        (small(false), Ordering::Greater),
    ] {
        let mut bracket = Bracket::new(&poly, Dyadic::zero(), Dyadic::one(), before);
        let root = 2f64.powi(-900);
        match bracket.settle() {
            Settled::At(at) => assert_eq!((at.below(), at.above()), (root, root)),
            Settled::Between(..) => panic!("it is a number of f64"),
        }
    }
}
