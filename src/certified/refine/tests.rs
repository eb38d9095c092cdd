use std::cell::Cell;

use super::super::ends::Plain;
use super::super::motion::Motion;
use super::super::testing::{Claim, Exact, Number, Random, Search, layout, points};
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
fn refine_sums_differences_and_products_have_no_error() {
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
fn refine_operations_are_within_their_bounds() {
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
        let (product, scaled) = (&m * &n, &m * &Number::from(y.high));
        Some([
            relative(x.add(y), &m + &n, 8, size.clone()),
            relative(x.sub(y), &m - &n, 8, size),
            relative(
                first(wide(x).mul(wide(y))),
                product.clone(),
                8,
                product.abs(),
            ),
            relative(
                first(wide(x).scale(wide(y).high)),
                scaled.clone(),
                4,
                scaled.abs(),
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
    println!("refine: add, sub, mul, scale {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 0.2));
}

/// The cubic and the first bracket.
fn first_bracket(positions: &Positions) -> Option<(Cubic, Bracket)> {
    let cubic = Cubic::new(&Motion::<f64x2>::new(&positions.points()))?;
    let bracket = *cubic.isolate()?.as_slice().first()?;
    Some((cubic, bracket))
}

#[test]
fn refine_evaluate_is_within_its_bound() {
    let claims = |x: &[f64; 24]| {
        let positions = layout(x);
        let (cubic, bracket) = first_bracket(&positions)?;
        let (sharp, _) = cubic.sharpen(&bracket)?;
        let t = 0.5 * (sharp.low + sharp.high);
        let value = Exact::new(&positions).f.at(&Number::from(t));
        let found = Claim::within(evaluate(&positions, t), &value, Number::zero()).error;
        // The last rounding, to f64, is relative.
        let rounding = &value.abs() * &Number::power(-53);
        let bound = &Number::from(cubic.error) * &Number::power(-49);
        Some([Claim {
            error: (&found - &rounding).larger(Number::zero()),
            bound,
        }])
    };
    let start = |random: &mut Random| points(random, (-215, 179));
    let search = Search {
        seed: 12,
        climbs: 12,
        starts: 500,
        steps: 5000,
    };
    let [worst] = search.worst(start, claims);
    println!("refine: f in double-double {worst}");
    // The bound adds up all factors and terms as if each were at its largest at the root.
    assert!(worst > 0.005);
}

/// Edges of small whole coordinates that may touch at a multiple of 1/8 of the step, at times an ulp
/// or a few changed: their roots are `f64`s, or next to one.
fn on_grid(random: &mut Random) -> [f64; 24] {
    let mut x = [0.0; 24].map(|_| f64::from(random.whole(-8, 8)));
    for _ in 0..random.below(3) {
        let i = random.below(24) as usize;
        let power = random.whole(-53, -20);
        x[i] += random.signed().signum() * 2f64.powi(power);
    }
    x
}

/// Whether the exact root is between `below` and the next `f64`, and the one in the bracket.
fn is_root_above(positions: &Positions, bracket: &Bracket, below: f64) -> bool {
    let exact = Exact::new(positions).f;
    let (low, high) = (Number::from(below), Number::from(below.next_up()));
    let signs = (exact.at(&low).sign(), exact.at(&high).sign());
    let is_rising = signs.0.is_lt() && signs.1.is_gt();
    let is_falling = signs.0.is_gt() && signs.1.is_lt();
    let is_crossed = if bracket.is_rising {
        is_rising
    } else {
        is_falling
    };
    is_crossed && below >= bracket.low.next_down() && below <= bracket.high
}

#[test]
fn refine_round_down_is_the_largest_f64_not_above_the_root() {
    let (decided, left, wrong) = (Cell::new(0), Cell::new(0), Cell::new(0));
    let count = |cell: &Cell<u32>| cell.set(cell.get() + 1);
    let claims = |x: &[f64; 24]| {
        let positions = layout(x);
        let (cubic, bracket) = first_bracket(&positions)?;
        // The root in f64 alone is not good enough.
        let (sharp, _) = cubic.sharpen(&bracket)?;
        if !is_root_above(&positions, &bracket, 0.5 * (sharp.low + sharp.high)) {
            count(&wrong);
        }
        let Some(below) = round_down(&positions, &cubic, &bracket) else {
            count(&left);
            return None;
        };
        count(&decided);
        assert!(is_root_above(&positions, &bracket, below), "{x:?}");
        // How near to one of its neighbours the root is, of at most half an ulp.
        let (low, high) = (Number::from(below), Number::from(below.next_up()));
        let (root, _) = Exact::new(&positions).f.enclose(&low, &high, 60);
        let bound = &(&high - &low) * &Number::power(-1);
        Some([Claim {
            error: (&root - &low.middle(&high)).abs(),
            bound,
        }])
    };
    let start = |random: &mut Random| {
        if random.coin() {
            on_grid(random)
        } else {
            points(random, (-215, 179))
        }
    };
    let search = Search {
        seed: 13,
        climbs: 4,
        starts: 1500,
        steps: 1500,
    };
    let [nearest] = search.worst(start, claims);
    let (decided, left, wrong) = (decided.get(), left.get(), wrong.get());
    println!(
        "refine: {decided} decided, {left} left, nearest to an f64 2^{} ulp, in f64 alone {wrong} wrong",
        ((1.0 - nearest) / 2.0).log2()
    );
    assert!(nearest > 1.0 - 2f64.powi(-12) && decided > 1000 && left > 50 && wrong > 1000);
}
