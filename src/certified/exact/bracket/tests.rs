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

#[test]
fn divide_about_is_within_a_cell() {
    let mut random = 1u64;
    let mut limb = || {
        random = random
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        random
    };
    for bits in [49, 64, 100, 128, 1000, 3000] {
        for length in 1..80 {
            let mut limbs: Vec<u64> = (0..length).map(|_| limb()).collect();
            let d = Integer::from_magnitude(false, &limbs);
            // Anywhere, and so near both ends that whole digits are 0 or full.
            let last = limbs.len() - 1;
            limbs[last] = limb() % limbs[last].max(1);
            let middle = Integer::from_magnitude(false, &limbs);
            let below = Integer::difference(&d, &Integer::from(1));
            for n in [Integer::ZERO, Integer::from(1), middle, below, d.clone()] {
                let index = divide_about(n.clone(), d.clone(), bits);
                // |2^bits n - index d| <= 2 d
                let mut rest = n.shifted(bits.into());
                rest.sub_shifted(&Integer::product(&index, &d), 0);
                assert!(!rest.exceeds(&d.shifted(1)), "{bits} bits, {length} limbs");
            }
        }
    }
}

#[test]
fn bracket_narrows_for_a_sign_in_few_turns() {
    // t^3 + t = 1
    let poly = poly(&[-1, 1, 0, 1]);
    let turns = |is_far: bool| {
        let new = Bracket::new(&poly, Dyadic::zero(), Dyadic::one(), Ordering::Less);
        let mut bracket = Bracket { is_far, ..new };
        let mut turns = 0;
        while bracket.exponent() < 20_000 {
            assert!(bracket.refine().is_none(), "it is no binary number");
            turns += 1;
        }
        let signs = bracket.ends().map(|at| bracket.poly.sign_at(at));
        assert_eq!(signs, [Ordering::Less, Ordering::Greater]);
        turns
    };
    assert!(turns(true) < 50, "{} turns", turns(true));
    assert!(turns(false) > 400);
}
