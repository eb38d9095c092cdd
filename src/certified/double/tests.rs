use wide::f64x2;

use super::super::ends::Plain;
use super::super::testing::{Claim, Number, Random, Search};
use super::*;

/// The exact value of a double-double.
fn exact(x: Double<f64>) -> Number {
    &Number::from(x.high) + &Number::from(x.low)
}

fn both_exact(x: Double<f64x2>) -> [Number; 2] {
    x.lanes().map(exact)
}

/// Numbers whose products neither over- nor underflow, with nothing in common or nearly equal.
fn pair(random: &mut Random) -> [f64; 2] {
    let a = (1.0 + random.unit()) * random.signed().signum();
    let power = 2f64.powi(random.whole(-400, 400));
    let b = match random.below(4) {
        0 => -random.nudged(a),
        1 => random.small() + 0.125,
        2 => (1.0 + random.unit()) * 2f64.powi(random.whole(-110, 110)),
        _ => random.signed(),
    };
    [a * power, b * power]
}

#[test]
fn double_sums_differences_and_products_have_no_error() {
    let mut random = Random::new(10);
    let mut inexact = 0;
    for _ in 0..200_000 {
        let ([a, b], [c, d]) = (pair(&mut random), pair(&mut random));
        let (x, y) = (f64x2::new([a, c]), f64x2::new([b, d]));
        let of = |f: fn(&Number, &Number) -> Number| {
            [(a, b), (c, d)].map(|(a, b)| f(&a.into(), &b.into()))
        };
        assert_eq!(both_exact(two_sum(x, y)), of(|a, b| a + b), "{x:?} {y:?}");
        assert_eq!(
            both_exact(two_difference(x, y)),
            of(|a, b| a - b),
            "{x:?} {y:?}"
        );
        assert_eq!(
            both_exact(two_product(x, y)),
            of(|a, b| a * b),
            "{x:?} {y:?}"
        );
        // As Plain and f64 do.
        let plain = two_product(Plain::new(a, c), Plain::new(b, d))
            .lanes()
            .map(exact);
        assert_eq!(plain, of(|a, b| a * b));
        assert_eq!(exact(two_sum(a, b)), of(|a, b| a + b)[0]);
        inexact += u32::from(two_sum(a, b).low != 0.0 && two_product(x, y).low.start() != 0.0);
    }
    assert!(inexact > 50_000);
}

/// Two double-doubles: high parts, and low parts in units of half an ulp.
type Input = [f64; 4];

fn double(high: f64, share: f64) -> Option<Double<f64>> {
    let half_ulp = 0.5 * (high.abs().next_up() - high.abs());
    let low = share * half_ulp;
    (share.abs() <= 1.0 && high.abs() > 2f64.powi(-400) && high.abs() < 2f64.powi(400))
        .then_some(Double { high, low })
}

fn doubles(random: &mut Random) -> Input {
    let [a, b] = pair(random);
    let mut share = || {
        if random.coin() {
            random.signed()
        } else {
            random.signed().signum()
        }
    };
    [a, share(), b, share()]
}

#[test]
fn double_operations_are_within_their_bounds() {
    let claims = |&[a, p, b, q]: &Input| {
        let (x, y) = (double(a, p)?, double(b, q)?);
        let (m, n) = (exact(x), exact(y));
        let relative = |found: Double<f64>, exact_value: Number, units: i64, size: Number| {
            // |low| is at most half an ulp of high.
            assert_eq!(found.high + found.low, found.high);
            Claim {
                error: (&exact(found) - &exact_value).abs(),
                bound: &size.times(units) * &Number::power(-106),
            }
        };
        let first = |x: Double<Plain>| x.lanes()[0];
        let wide = |x: Double<f64>| Double {
            high: Plain::both(x.high),
            low: Plain::both(x.low),
        };
        let size = &m.abs() + &n.abs();
        let product = &m * &n;
        Some([
            relative(x.add(y), &m + &n, 8, size.clone()),
            relative(x.sub(y), &m - &n, 8, size),
            relative(
                first(wide(x).mul(wide(y))),
                product.clone(),
                8,
                product.abs(),
            ),
        ])
    };
    let search = Search {
        seed: 11,
        climbs: 8,
        starts: 500,
        steps: 6000,
    };
    let worst = search.worst(doubles, claims);
    println!("double: add, sub, mul {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 0.2));
}
