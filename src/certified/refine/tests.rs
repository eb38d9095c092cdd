use std::cell::Cell;

use super::super::motion::Motion;
use super::super::testing::{Claim, Exact, Number, Random, Search, layout, points};
use super::*;

/// The cubic and the first bracket.
fn first_bracket(positions: &Positions) -> Option<(Cubic, Bracket)> {
    let cubic = Cubic::new(&Motion::<f64x2>::new(&positions.points()))?;
    let bracket = *cubic.isolate(|_, _| false)?.as_slice().first()?;
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
        let found = Claim::within(
            evaluate(&positions.points::<f64x2>(), Double { high: t, low: 0.0 }),
            &value,
            Number::zero(),
        )
        .error;
        // The last rounding, to f64, is relative.
        let rounding = &value.abs() * &Number::power(-53);
        let bound = &Number::from(cubic.permanent) * &Number::from(VALUE_ERROR);
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

/// Edges of small whole coordinates that may touch at a multiple of 1/8 of the step, at times an
/// ulp or a few changed: their roots are `f64`s, or next to one.
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
        let root = Root::new(&positions, &cubic, &bracket);
        let Some(below) = root.and_then(|root| root.round_down()) else {
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
