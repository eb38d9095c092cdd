use std::cell::Cell;
use std::cmp::Ordering;

use wide::f64x2;

use super::*;
use crate::certified::face::{as_edges, separate::star};
use crate::certified::refine::Root;
use crate::certified::testing::{
    Claim, Exact, Number, Random, Rooted, Search, dot as exact_dot, layout, points,
};

/// Coordinates; by how much longer the bracket is than need be, as a power of two, or 0.
type Input = [f64; 25];

/// Where the vertex is at a root of `f`.
struct Case {
    root: Rooted,
    raw: RawWeights,
    /// The same to twice the precision, from the edges BC and AD.
    refined: Option<RawWeights>,
}

impl Case {
    fn new(x: &Input) -> Option<Self> {
        let positions = layout(x);
        let motion = star(&positions.points());
        let cubic = Cubic::new(&motion)?;
        let exact = Exact::of(&positions, [(2, 1), (3, 1), (0, 1)]);
        let root = Rooted::first(motion, &cubic, &exact, |bracket| longer(bracket, x[24]))?;
        let edges = as_edges(&positions);
        let edge_motion = Motion::new(&edges.points::<f64x2>());
        let refined = Cubic::new(&edge_motion).and_then(|edge_cubic| {
            // It takes the bracket of one root; a longer one may hold more.
            let [low, high] = [root.bracket.low, root.bracket.high].map(Number::from);
            if exact.f.roots_in_closed(&low, &high) != 1 {
                return None;
            }
            let root = Root::new(&edges, &edge_cubic, &root.bracket)?;
            Some(of_edges(&root.meeting(&edges, &edge_motion, &edge_cubic)))
        });
        Some(Case {
            raw: raw_weights(&root.motion, &cubic, &root.bracket),
            root,
            refined,
        })
    }

    /// The exact raw weights at both ends of the interval for a vector, which may depend on these.
    fn exact(&self, w: impl Fn(&[Number; 3]) -> [Number; 3]) -> [[Number; 3]; 2] {
        self.root.normals.each_ref().map(|normals| {
            let w = w(&normals[0]);
            let [n, u, v] = normals.each_ref().map(|x| exact_dot(x, &w));
            [&(&n - &u) + &v, u, -&v]
        })
    }

    /// Inside (greater), outside (less), on an edge or not to tell.
    fn place(&self) -> Ordering {
        let places = self
            .exact(Clone::clone)
            .map(|raw| raw.iter().map(Number::sign).min());
        match places {
            [Some(x), Some(y)] if x == y => x,
            _ => Ordering::Equal,
        }
    }

    fn is_right(&self, raw: &RawWeights) -> bool {
        match raw.place() {
            Place::Apart => self.place().is_lt(),
            Place::Inside { .. } => self.place().is_gt(),
            Place::Unclear => true,
        }
    }

    /// The errors of the raw weights and of the weights.
    fn claims(&self) -> [Claim; 4] {
        let w = self.root.normal().map(Number::from);
        let [low, high] = self.exact(|_| w.clone());
        let raw = |i: usize| {
            let (found, bound) = (self.raw.values[i], self.raw.errors[i]);
            let within = |exact: &Number| Claim::within(found, exact, Number::from(bound));
            within(&low[i]).worse(within(&high[i]))
        };
        [raw(0), raw(1), raw(2), self.weights()]
    }

    fn weights(&self) -> Claim {
        let Place::Inside { weights, error } = self.raw.place() else {
            return Claim::nothing();
        };
        let claims = self.exact(Clone::clone).map(|raw| {
            // All times N . N.
            let n = &(&raw[0] + &raw[1]) + &raw[2];
            let times_n = |x: f64| &Number::from(x) * &n;
            let errors = [0, 1, 2].map(|i| (&times_n(weights[i]) - &raw[i]).abs());
            let error = times_n(error);
            errors
                .map(|found| Claim {
                    error: found,
                    bound: error.clone(),
                })
                .into_iter()
                .fold(Claim::nothing(), Claim::worse)
        });
        claims.into_iter().fold(Claim::nothing(), Claim::worse)
    }
}

/// The bracket, or one that is longer by a power of two.
fn longer(bracket: &Bracket, power: f64) -> Option<Bracket> {
    let high = match power {
        0.0 => bracket.high,
        power => bracket.high + 2f64.powf(power),
    };
    (power <= 0.0 && high <= 1.0).then_some(Bracket { high, ..*bracket })
}

/// A vertex that meets the face at a time of few bits, in an edge or a corner as often as not, up
/// to rounding.
fn touching(random: &mut Random) -> [f64; 24] {
    let mut x = points(random, (0, 0));
    let t = f64::from(random.whole(1, 7)) / 8.0;
    let mut weights = [0.0; 3].map(|_| random.unit());
    match random.below(4) {
        0 => weights[1] = 0.0,
        1 => weights = [0.0, 0.0, 1.0],
        _ => {}
    }
    let sum = weights.iter().sum::<f64>();
    for i in 0..3 {
        let at = |p: usize| (1.0 - t) * x[3 * p + i] + t * x[3 * p + 12 + i];
        let place: f64 = (0..3).map(|p| weights[p] / sum * at(1 + p)).sum();
        let gap = place - at(0);
        x[i] += gap;
        x[12 + i] += gap;
    }
    x
}

fn start(random: &mut Random) -> Input {
    let mut x = [0.0; 25];
    let coordinates = if random.coin() {
        touching(random)
    } else {
        points(random, (-210, 170))
    };
    x[..24].copy_from_slice(&coordinates);
    if random.coin() {
        x[24] = -1.5 - 48.0 * random.unit();
    }
    x
}

#[test]
fn face_shares_are_within_their_bounds_and_no_claim_is_wrong() {
    let (places, wrong, settled) = (Cell::new([0; 3]), Cell::new(0), Cell::new(0));
    let claims = |x: &Input| {
        let case = Case::new(x)?;
        let place = match case.raw.place() {
            Place::Apart => 0,
            Place::Inside { .. } => 1,
            Place::Unclear => 2,
        };
        let mut counts = places.get();
        counts[place] += 1;
        places.set(counts);
        assert!(case.is_right(&case.raw), "{x:?}");
        if let Some(refined) = case.refined {
            assert!(case.is_right(&refined), "to twice the precision: {x:?}");
            let is_gain = place == 2 && refined.place() != Place::Unclear;
            settled.set(settled.get() + u32::from(is_gain));
        }
        let faulty = RawWeights {
            errors: case.raw.errors.map(|error| error / 8.0),
            ..case.raw
        };
        wrong.set(wrong.get() + u32::from(!case.is_right(&faulty)));
        let RawWeights { values, errors } = case.raw;
        let is_finite = values.iter().chain(&errors).all(|x| x.is_finite());
        is_finite.then(|| case.claims())
    };
    let search = Search {
        seed: 21,
        climbs: 3,
        starts: 300,
        steps: 600,
    };
    let worst = search.worst(start, claims);
    let (places, wrong, settled) = (places.get(), wrong.get(), settled.get());
    println!(
        "face: raw and weights {worst:?}; {places:?} apart, inside, unclear; with an eighth of the bounds {wrong} wrong; {settled} settled to twice the precision"
    );
    let [b, c, d, weights] = worst;
    assert!(b > 0.2 && c > 0.4 && d > 0.4 && weights > 0.05);
    assert!(places.iter().all(|&count| count > 100) && wrong > 0 && settled > 50);
}

#[test]
fn face_signs_of_shares_decide_the_place() {
    let of = |values: [f64; 3]| RawWeights {
        values,
        errors: [0.25; 3],
    };
    for sign in [1.0, -1.0] {
        for i in 0..3 {
            let mut values = [sign; 3];
            assert!(matches!(of(values).place(), Place::Inside { .. }));
            values[i] = -sign;
            assert_eq!(of(values).place(), Place::Apart);
            for unclear in [0.25 * sign, -0.25 * sign, 0.0, f64::NAN] {
                values[i] = unclear;
                assert_eq!(of(values).place(), Place::Unclear, "{values:?}");
            }
            values[i] = -0.25f64.next_up() * sign;
            assert_eq!(of(values).place(), Place::Apart);
            // No other raw has a certain sign.
            let mut values = [0.0; 3];
            values[i] = sign;
            assert_eq!(of(values).place(), Place::Unclear);
        }
    }
}

#[test]
fn weights_that_are_just_above_their_errors_are_no_place() {
    let weights = |errors: [f64; 3]| RawWeights {
        values: [1.0 + f64::EPSILON; 3],
        errors,
    };
    // All signs are certain, and yet the sum is within the bound on the errors of all.
    assert!(weights([1.0; 3]).are_inside());
    assert!(matches!(weights([1.0; 3]).place(), Place::Unclear));
    let Place::Inside { error, .. } = weights([0.5; 3]).place() else {
        panic!("inside");
    };
    assert!(error > 1.0 && error < 3.0, "{error}");
}
