use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;

use super::*;
use crate::answer::Enclosure;
use crate::field::OrderedField;

type P = Poly<BigInt>;

fn poly(coefficients: &[i64]) -> P {
    Poly::new(coefficients.iter().map(|&c| BigInt::from(c)).collect())
}

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(BigInt::from(n), BigInt::from(d))
}

/// The product of `d t - n` over the given rationals `n / d`.
fn with_roots(roots: &[(i64, i64)]) -> P {
    roots
        .iter()
        .fold(poly(&[1]), |p, &(n, d)| p.mul(&poly(&[-n, d])))
}

/// Number of distinct roots in `(0, 1)` by Sturm's theorem: the second way to count.
fn sturm_count(p: &P) -> usize {
    // The theorem wants ends that are not multiple roots: divide them out.
    let mut p = p.clone();
    for end in [poly(&[0, 1]), poly(&[-1, 1])] {
        while p.evaluate_dyadic(&-&end.coefficients()[0], 0) == BigInt::from(0) {
            p = p.div_exact(&end);
        }
    }
    let mut chain = vec![p.clone(), p.derivative()];
    while let [.., a, b] = chain.as_slice()
        && b.degree() > 0
    {
        // -remainder, times a positive constant
        let leading = b.leading().unwrap();
        let mut r = a.clone();
        while !r.is_zero() && r.degree() >= b.degree() {
            let shift = r.degree() - b.degree();
            let top = r.leading().unwrap().clone();
            let mut shifted = vec![BigInt::from(0); shift];
            shifted.extend(b.coefficients().iter().map(|c| c * &top));
            let square = leading * leading;
            r = r.scale(&square).sub(&Poly::new(shifted).scale(leading));
        }
        if r.is_zero() {
            break;
        }
        chain.push(r.neg());
    }
    let variations = |values: Vec<BigInt>| crate::poly::sign_variations(&values);
    let at = |n: i64| {
        chain
            .iter()
            .map(|q| q.evaluate_dyadic(&BigInt::from(n), 0))
            .collect()
    };
    variations(at(0)) - variations(at(1))
}

#[test]
fn isolate_roots_known_rational_roots() {
    let p = with_roots(&[
        (1, 3),
        (1, 2),
        (1, 2),
        (0, 1),
        (1, 1),
        (3, 4),
        (7, 5),
        (-1, 2),
    ]);
    let roots: Vec<_> = isolate_roots(&p)
        .iter()
        .map(|r| r.rational().unwrap())
        .collect();
    assert_eq!(
        roots,
        [
            ratio(0, 1),
            ratio(1, 3),
            ratio(1, 2),
            ratio(3, 4),
            ratio(1, 1)
        ]
    );
    assert!(isolate_roots(&poly(&[])).is_empty());
    assert!(isolate_roots(&poly(&[5])).is_empty());
}

#[test]
fn algebraic_rational_is_none_for_an_irrational() {
    // 2 t^2 = 1
    let root = isolate_roots(&poly(&[-1, 0, 2])).remove(0);
    assert_eq!(root.rational(), None);
    let enclosure = root.enclosure();
    assert_eq!(enclosure.above, enclosure.below.next_up());
    assert!((enclosure.below - 0.5f64.sqrt()).abs() <= f64::EPSILON);
}

#[test]
fn algebraic_enclosure_is_exact_for_f64_roots_and_tight_for_others() {
    let one = |p: &P| isolate_roots(p).remove(0).enclosure();
    assert_eq!(one(&poly(&[-5, 8])), Enclosure::exactly(0.625));
    let third = one(&poly(&[-1, 3]));
    assert_eq!(
        third,
        Enclosure {
            below: 1.0 / 3.0,
            above: (1.0f64 / 3.0).next_up()
        }
    );
    // 2^-1074 and half of it.
    let tiny = Poly::new(vec![BigInt::from(-1), BigInt::from(1) << 1074]);
    assert_eq!(one(&tiny), Enclosure::exactly(f64::from_bits(1)));
    let half = Poly::new(vec![BigInt::from(-1), BigInt::from(1) << 1075]);
    assert_eq!(
        one(&half),
        Enclosure {
            below: 0.0,
            above: f64::from_bits(1)
        }
    );
    // The double root of (2^60 t - 1)^2 (t^2 + 1).
    let line = Poly::new(vec![BigInt::from(-1), BigInt::from(1) << 60]);
    let double = line.mul(&line).mul(&poly(&[1, 0, 1]));
    assert_eq!(one(&double), Enclosure::exactly(2f64.powi(-60)));
}

#[test]
fn algebraic_separates_roots_that_f64_cannot() {
    // (3^80 t - 3^79)(3^80 t - 3^79 - 1): two roots about 2^-127 apart.
    let big = BigInt::from(3).pow(80);
    let third = BigInt::from(3).pow(79);
    let a = Poly::new(vec![-third.clone(), big.clone()]);
    let b = Poly::new(vec![-(&third + BigInt::from(1)), big]);
    let roots = isolate_roots(&a.mul(&b));
    assert_eq!(roots.len(), 2);
    assert_eq!(roots[0].enclosure(), roots[1].enclosure());
    assert_eq!(roots[0].compare(&roots[1]), Ordering::Less);
    assert_eq!(roots[0].sign_of(&b), Ordering::Less);
    assert_eq!(roots[0].sign_of(&a), Ordering::Equal);
    assert_eq!(roots[1].sign_of(&a), Ordering::Greater);
    assert_eq!(roots[0].rational(), Some(ratio(1, 3)));
}

#[test]
fn algebraic_enclose_quotient_known_values() {
    let root = isolate_roots(&poly(&[-1, 0, 2])).remove(0);
    // t^2 = 1/2 at the root.
    assert_eq!(
        root.enclose_quotient(&poly(&[0, 0, 1]), &poly(&[1])),
        Enclosure::exactly(0.5)
    );
    assert_eq!(
        root.enclose_quotient(&poly(&[0, 0, -2]), &poly(&[-1])),
        Enclosure::exactly(1.0)
    );
    assert_eq!(
        root.enclose_quotient(&poly(&[-1, 0, 2]), &poly(&[0, 1])),
        Enclosure::exactly(0.0)
    );
    assert_eq!(
        root.enclose_quotient(&poly(&[0, 1]), &poly(&[1])),
        root.enclosure()
    );
    let third = root.enclose_quotient(&poly(&[0, 0, 2]), &poly(&[3]));
    assert_eq!(
        third,
        Enclosure {
            below: 1.0 / 3.0,
            above: (1.0f64 / 3.0).next_up()
        }
    );
}

fn any_poly(degree: usize) -> impl Strategy<Value = P> {
    prop_oneof![
        prop::collection::vec(-9i64..9, 1..=degree + 1).prop_map(|c| poly(&c)),
        prop::collection::vec(-(1i64 << 60)..(1 << 60), 1..=degree + 1).prop_map(|c| poly(&c)),
        prop::collection::vec((0i64..9, 1i64..9), 1..=degree).prop_map(|roots| with_roots(&roots)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn isolate_roots_counts_like_sturm(p in any_poly(5)) {
        let roots = isolate_roots(&p);
        if !p.is_zero() {
            let is = |r: &Algebraic<BigInt>, n| r.compare_ratio(&ratio(n, 1)).is_eq();
            let inside = roots.iter().filter(|r| !is(r, 0) && !is(r, 1)).count();
            prop_assert_eq!(inside, sturm_count(&p));
            let zero = BigInt::from(0);
            prop_assert_eq!(roots.iter().any(|r| is(r, 0)), p.coefficients()[0] == zero);
            prop_assert_eq!(roots.iter().any(|r| is(r, 1)), p.at_one() == zero);
        }
        for pair in roots.windows(2) {
            prop_assert_eq!(pair[0].compare(&pair[1]), Ordering::Less);
        }
        for root in &roots {
            prop_assert_eq!(root.sign_of(&p), Ordering::Equal);
            let Enclosure { below, above } = root.enclosure();
            prop_assert!(below == above || above == below.next_up());
            let at = |c: f64| root.compare_ratio(&BigRational::from_float(c).unwrap());
            prop_assert_eq!(at(below) == Ordering::Equal, below == above);
            prop_assert!(at(below).is_ge() && at(above).is_le());
        }
    }

    #[test]
    fn algebraic_comparisons_agree_with_rationals(
        b in 1i64..=12, d in 1i64..=12, a in 0i64..=12, c in 0i64..=12, q in any_poly(4),
    ) {
        let (a, c) = (a % (b + 1), c % (d + 1));
        // Hidden in polynomials of higher degree, so that the number does not look rational.
        let hidden = |n: i64, d: i64, other: &[i64]| {
            let p = poly(&[-n, d]).mul(&poly(other));
            isolate_roots(&p).into_iter().find(|r| r.compare_ratio(&ratio(n, d)).is_eq()).unwrap()
        };
        let x = hidden(a, b, &[-1, 0, 2]);
        let y = hidden(c, d, &[-1, 0, 0, 3]);
        prop_assert_eq!(x.compare(&y), ratio(a, b).cmp(&ratio(c, d)));
        prop_assert_eq!(y.compare(&x), ratio(c, d).cmp(&ratio(a, b)));
        prop_assert_eq!(x.rational(), Some(ratio(a, b)));
        prop_assert_eq!(Algebraic::ratio(&ratio(a, b)).compare(&x), Ordering::Equal);
        let value = q.coefficients().iter().rev().fold(BigRational::from_i64(0), |v, c| {
            v * ratio(a, b) + BigRational::from_integer(c.clone())
        });
        prop_assert_eq!(x.sign_of(&q), value.sign());
    }

    #[test]
    fn f64_round_trips_through_dyadics(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let (mantissa, exponent) = super::enclose::decompose(value);
        let exact = BigRational::from_float(value).unwrap();
        let two = BigRational::from_i64(2);
        prop_assert_eq!(BigRational::from_i64(mantissa) * two.pow(exponent as i32), exact);
        prop_assert!(mantissa % 2 != 0 || value == 0.0);
    }
}
