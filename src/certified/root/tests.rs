use super::super::testing::{Claim, Number, Polynomial, Random, Search};
use super::*;

/// Four coefficients, the exponent of the error in units of the least one, an argument, and for
/// each coefficient where in its error the exact one is, from -1 to 1.
type Input = [f64; 10];

/// A cubic, and one of those that it may stand for.
struct Case {
    cubic: Cubic,
    exact: Polynomial,
    t: f64,
}

impl Case {
    /// `None` where the numbers mean nothing, or no stage would let them through.
    fn new(&[b0, b1, b2, b3, factor, t, s0, s1, s2, s3]: &Input) -> Option<Self> {
        let (bernstein, shares) = ([b0, b1, b2, b3], [s0, s1, s2, s3]);
        let size = bernstein.iter().fold(0.0, |size: f64, b| size.max(b.abs()));
        // No determinant is larger than the permanent, P = error / 16 u.
        let error = 16.0 * U * size * factor;
        let is_case = error > 2f64.powi(-700)
            && size * factor < 2f64.powi(542)
            && factor >= 1.0
            && (0.0..=1.0).contains(&t)
            && shares.iter().all(|share| share.abs() <= 1.0);
        if !is_case {
            return None;
        }
        let exact = [0, 1, 2, 3].map(|i| {
            let share = &Number::from(shares[i]) * &Number::from(error);
            &Number::from(bernstein[i]) + &share
        });
        Some(Case {
            cubic: Cubic {
                bernstein,
                error,
                permanent: error / (16.0 * U),
                reach: [[1.0; 3]; 3],
            },
            exact: Polynomial::of_bernstein(&exact),
            t,
        })
    }

    /// The same with a bound that is too small: the exact cubic is none of those it allows.
    fn faulty(&self) -> Cubic {
        Cubic {
            error: self.cubic.error / 4.0,
            ..self.cubic
        }
    }
}

/// The coefficients of `(t - r)(t - s)(t - q)`, up to rounding.
fn of_roots(r: f64, s: f64, q: f64) -> [f64; 4] {
    let (e1, e2, e3) = (r + s + q, r * s + s * q + q * r, r * s * q);
    [
        -e3,
        e2 / 3.0 - e3,
        (2.0 * e2 - e1) / 3.0 - e3,
        (1.0 - r) * (1.0 - s) * (1.0 - q),
    ]
}

fn root(random: &mut Random) -> f64 {
    let distance = random.signed() * 2f64.powi(-random.whole(0, 54));
    match random.below(5) {
        0 => distance,
        1 => 1.0 + distance,
        2 => 0.5 + distance,
        3 => 1.2 * random.signed(),
        _ => 0.3 + distance,
    }
}

fn start(random: &mut Random) -> Input {
    let bernstein = match random.below(4) {
        0 => [0.0; 4].map(|_| random.signed()),
        1 => [0.0; 4].map(|_| random.signed() * 2f64.powi(-random.whole(0, 54))),
        2 => [0.0; 4].map(|_| random.small()),
        _ => of_roots(root(random), root(random), root(random)),
    };
    let power = if random.coin() {
        random.whole(-640, 530)
    } else {
        0
    };
    let factor = if random.coin() {
        2f64.powi(random.whole(0, 30))
    } else {
        1.0
    };
    let is_near_error = random.coin();
    let [b0, b1, b2, b3] = bernstein.map(|b| {
        let is_small = is_near_error && random.coin();
        let b = if is_small { 128.0 * U * factor * b } else { b };
        b * 2f64.powi(power)
    });
    let t = random.whole(-6, 4).clamp(0, 1);
    let t = if random.coin() {
        random.unit()
    } else {
        f64::from(t)
    };
    let kind = random.below(3);
    let mut share = || match kind {
        0 => random.signed(),
        _ => {
            if random.coin() {
                1.0
            } else {
                -1.0
            }
        }
    };
    [
        b0,
        b1,
        b2,
        b3,
        factor,
        t,
        share(),
        share(),
        share(),
        share(),
    ]
}

#[test]
fn root_values_slopes_and_curvatures_are_within_their_bounds() {
    let claims = |x: &Input| {
        let Case { cubic, exact, t } = Case::new(x)?;
        let at = Number::from(t);
        let derivative = exact.derivative();
        let (value, slope) = cubic.evaluate(t);
        let bends = derivative.derivative();
        let bend = bends
            .at(&Number::zero())
            .abs()
            .larger(bends.at(&Number::from(1.0)).abs());
        // How much of what is added for errors is needed.
        let added = Number::from(cubic.error).times(32);
        let without = &Number::from(cubic.curvature()) - &added;
        let curvature = Claim {
            error: &bend - &without,
            bound: added,
        };
        Some([
            Claim::within(value, &exact.at(&at), Number::from(cubic.value_error())),
            Claim::within(
                slope,
                &derivative.at(&at),
                Number::from(cubic.slope_error()),
            ),
            curvature,
        ])
    };
    let search = Search {
        seed: 5,
        climbs: 6,
        starts: 200,
        steps: 3000,
    };
    let worst = search.worst(start, claims);
    println!("root: value, slope, curvature {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 0.5));
}

/// Whether the exact cubic has one root in the bracket, inside, and its sign changes as it should.
fn holds_one(exact: &Polynomial, bracket: &Bracket) -> bool {
    let (low, high) = (Number::from(bracket.low), Number::from(bracket.high));
    let (before, after) = (exact.at(&low).sign(), exact.at(&high).sign());
    let is_crossed =
        before.is_ne() && after == before.reverse() && after.is_gt() == bracket.is_rising;
    is_crossed && exact.roots(&low, &high) == 1
}

/// Whether the brackets are those of all roots in `[0, 1]`; `None` if there is no claim.
fn isolates(cubic: &Cubic, exact: &Polynomial) -> Option<bool> {
    let brackets = cubic.isolate(|_, _| false)?;
    let brackets = brackets.as_slice();
    let is_ascending = brackets.windows(2).all(|pair| pair[0].high <= pair[1].low);
    let count = exact.roots_in_closed(&Number::zero(), &Number::from(1.0));
    let hold = brackets.iter().all(|bracket| holds_one(exact, bracket));
    Some(is_ascending && hold && count == brackets.len())
}

/// Whether the brackets are those of all roots but some between `p` and `q`, where none matters.
fn isolates_outside(cubic: &Cubic, exact: &Polynomial, p: f64, q: f64) -> Option<bool> {
    let brackets = cubic.isolate(|low, high| p <= low && high <= q)?;
    let brackets = brackets.as_slice();
    let is_ascending = brackets.windows(2).all(|pair| pair[0].high <= pair[1].low);
    let hold = brackets.iter().all(|bracket| holds_one(exact, bracket));
    let [zero, p, q, one] = [0.0, p, q, 1.0].map(Number::from);
    let all = exact.roots_in_closed(&zero, &one);
    let between = exact.roots_in_closed(&p, &q);
    let count = brackets.len();
    Some(is_ascending && hold && (all - between..=all).contains(&count))
}

/// The same for each half of the step.
fn halves_are_right(cubic: &Cubic, exact: &Polynomial) -> Option<bool> {
    let mut claims = None;
    for (half, ends) in cubic.halves().iter().zip([[0.0, 0.5], [0.5, 1.0]]) {
        let [low, high] = ends.map(Number::from);
        let count = || exact.roots_in_closed(&low, &high);
        let is_right = match (half.has_none, half.has_one) {
            (true, true) => false,
            (true, false) => count() == 0,
            (false, true) => count() == 1 && holds_one(exact, &half.bracket),
            (false, false) => continue,
        };
        claims = Some(claims.unwrap_or(true) && is_right);
    }
    claims
}

/// Whether `sharpen` keeps the root of each bracket, with a slope that nowhere in it is less, and so
/// does one step of it.
fn sharpens(cubic: &Cubic, exact: &Polynomial, brackets: &Brackets) -> Option<bool> {
    let mut claims = None;
    let once = |bracket| Some(cubic.sharpen_once(bracket)).filter(|(_, least)| *least > 0.0);
    let each = |bracket| [cubic.sharpen(bracket), once(bracket)].map(|sharp| (bracket, sharp));
    for (bracket, sharp) in brackets.as_slice().iter().flat_map(each) {
        let Some((sharp, least)) = sharp else {
            continue;
        };
        let (low, high) = (Number::from(sharp.low), Number::from(sharp.high));
        let slope = exact.derivative().least_magnitude(&low, &high);
        let is_right = exact.roots_in_closed(&low, &high) == 1
            && (bracket.low <= sharp.low && sharp.high <= bracket.high)
            && !(Number::from(least) > slope);
        claims = Some(claims.unwrap_or(true) && is_right);
    }
    claims
}

/// That a check holds for many cases, and that it finds a bound that is too small.
fn check_all(seed: u64, count: u32, check: impl Fn(&Cubic, &Case) -> Option<bool>) {
    let mut random = Random::new(seed);
    let (mut claims, mut found) = (0, 0);
    for _ in 0..count {
        let input = start(&mut random);
        let Some(case) = Case::new(&input) else {
            continue;
        };
        if let Some(is_right) = check(&case.cubic, &case) {
            assert!(is_right, "{input:?}");
            claims += 1;
        }
        found += u32::from(check(&case.faulty(), &case) == Some(false));
    }
    println!("root: {claims} claims of {count}, with a quarter of the bound {found} wrong");
    assert!(claims > count / 4 && found > 0);
}

#[test]
fn root_brackets_hold_one_root_each_and_there_is_no_other() {
    check_all(6, 12_000, |cubic, case| isolates(cubic, &case.exact));
}

#[test]
fn root_brackets_leave_out_no_root_that_matters() {
    check_all(10, 12_000, |cubic, case| {
        let share = 0.25 * case.t;
        let parts = [(0.0, share), (0.5 - share, 0.5 + share), (1.0 - share, 1.0)];
        let claims = parts.map(|(p, q)| isolates_outside(cubic, &case.exact, p, q));
        let mut claims = claims.into_iter().flatten();
        claims
            .next()
            .map(|first| first && claims.all(|claim| claim))
    });
}

#[test]
fn root_halves_are_right() {
    check_all(7, 12_000, |cubic, case| {
        halves_are_right(cubic, &case.exact)
    });
}

#[test]
fn root_first_half_is_the_first_that_is_open() {
    let mut random = Random::new(14);
    let mut counts = [0; 4];
    for _ in 0..12_000 {
        let Some(Case { cubic, t, .. }) = Case::new(&start(&mut random)) else {
            continue;
        };
        // At roots before some time there is no contact.
        let is_apart = |half: &Half| half.has_none || (half.has_one && half.bracket.high < t);
        let [lower, upper] = cubic.halves();
        let of = |half: &Half| (half.has_one, half.bracket.low, half.bracket.high);
        let (first, place) = match (is_apart(&lower), is_apart(&upper)) {
            (false, _) => (Some(lower), 0),
            (true, false) => (Some(upper), 1),
            (true, true) => (None, 2),
        };
        let found = cubic.first_half(is_apart);
        assert_eq!(found.is_none(), first.is_none());
        if let (Some(found), Some(first)) = (&found, &first) {
            assert_eq!(found.has_one, first.has_one);
            // Without a root that is known the bracket says nothing.
            assert!(!found.has_one || of(found) == of(first));
            counts[3] += usize::from(found.has_one);
        }
        counts[place] += 1;
    }
    assert!(counts.into_iter().all(|count| count > 100), "{counts:?}");
}

#[test]
fn root_sharpened_brackets_keep_the_root_and_its_slope() {
    check_all(8, 12_000, |cubic, case| {
        sharpens(cubic, &case.exact, &case.cubic.isolate(|_, _| false)?)
    });
}

#[test]
fn root_sharpened_brackets_are_as_short_as_the_error_allows() {
    let claims = |x: &Input| {
        let Case { cubic, exact, .. } = Case::new(x)?;
        let brackets = cubic.isolate(|_, _| false)?;
        let (sharp, _) = cubic.sharpen(brackets.as_slice().first()?)?;
        let (low, high) = (Number::from(sharp.low), Number::from(sharp.high));
        if low == high {
            return None;
        }
        let (root, _) = exact.enclose(&low, &high, 60);
        let error = (&root - &low.middle(&high)).abs();
        let bound = &(&high - &low) * &Number::power(-1);
        Some([Claim { error, bound }])
    };
    let search = Search {
        seed: 9,
        climbs: 4,
        starts: 200,
        steps: 2000,
    };
    let [worst] = search.worst(start, claims);
    println!("root: distance from the middle of a sharpened bracket {worst}");
    assert!(worst > 0.5);
}
