//! A search for the inputs at which an error comes nearest to its bound.

use super::number::Number;
use super::random::Random;

/// That an error is at most its bound.
#[derive(Clone, Debug)]
pub(in super::super) struct Claim {
    pub(in super::super) error: Number,
    pub(in super::super) bound: Number,
}

impl Claim {
    /// That nothing is off.
    pub(in super::super) fn nothing() -> Self {
        Claim {
            error: Number::zero(),
            bound: Number::from(1.0),
        }
    }

    /// The one with the larger ratio of error to bound.
    pub(in super::super) fn worse(self, other: Self) -> Self {
        if &self.error * &other.bound > &other.error * &self.bound {
            self
        } else {
            other
        }
    }

    /// That `found` is within `bound` of `exact`.
    pub(in super::super) fn within(found: f64, exact: &Number, bound: Number) -> Self {
        Claim {
            error: (&Number::from(found) - exact).abs(),
            bound,
        }
    }
}

/// Random starts, and from the best of them up the hill. Deterministic.
pub(in super::super) struct Search {
    pub(in super::super) seed: u64,
    /// How often it starts anew, for each claim.
    pub(in super::super) climbs: u32,
    /// How many starts it takes the best of.
    pub(in super::super) starts: u32,
    pub(in super::super) steps: u32,
}

impl Search {
    /// The largest ratios of error to bound found, for each claim by itself. Panics where a bound
    /// does not hold, for whichever claim.
    ///
    /// A ratio `r` also means that this search refutes a bound of less than `r` times the present
    /// one.
    pub(in super::super) fn worst<const N: usize, const CLAIMS: usize>(
        &self,
        start: impl Fn(&mut Random) -> [f64; N],
        claims: impl Fn(&[f64; N]) -> Option<[Claim; CLAIMS]>,
    ) -> [f64; CLAIMS] {
        let mut worst = [f64::NEG_INFINITY; CLAIMS];
        let mut visit = |at: &[f64; N], claim: usize| {
            let claims = claims(at)?;
            for (i, Claim { error, bound }) in claims.iter().enumerate() {
                assert!(error <= bound, "claim {i} does not hold at {at:?}");
                if bound.sign().is_gt() {
                    worst[i] = worst[i].max(error.ratio(bound));
                }
            }
            let Claim { error, bound } = &claims[claim];
            bound.sign().is_gt().then(|| error.ratio(bound))
        };
        let mut random = Random::new(self.seed);
        for claim in 0..CLAIMS {
            for _ in 0..self.climbs {
                let mut best = start(&mut random);
                let mut ratio = visit(&best, claim).unwrap_or(f64::NEG_INFINITY);
                for i in 0..self.starts + self.steps {
                    let at = if i < self.starts {
                        start(&mut random)
                    } else {
                        changed(&best, &mut random)
                    };
                    match visit(&at, claim) {
                        Some(found) if found >= ratio => (best, ratio) = (at, found),
                        _ => {}
                    }
                }
            }
        }
        worst
    }
}

fn changed<const N: usize>(values: &[f64; N], random: &mut Random) -> [f64; N] {
    let mut values = *values;
    for _ in 0..=random.below(3) {
        random.change(&mut values);
    }
    values
}
