use std::cell::Cell;
use std::cmp::Ordering;

use super::super::refine::Root;
use super::super::testing::{
    Claim, Exact, Number, Random, Rooted, Search, dot as exact_dot, layout, points,
};
use super::*;

/// Coordinates; how much longer than need be the bracket is, as a power of two, and on which side.
type Input = [f64; 26];

/// Where the lines meet at a root of `f`.
struct Case {
    root: Rooted,
    meeting: Meeting,
    /// The same to twice the precision.
    refined: Option<Meeting>,
}

impl Case {
    fn new(x: &Input) -> Option<Self> {
        let positions = layout(x);
        let motion = Motion::new(&positions.points());
        let cubic = Cubic::new(&motion)?;
        let exact = Exact::new(&positions);
        let root = Rooted::first(motion, &cubic, &exact, |bracket| stretched(bracket, x))?;
        let refined = Root::new(&positions, &cubic, &root.bracket);
        Some(Case {
            refined: refined.map(|refined| refined.meeting(&positions, &root.motion, &cubic)),
            meeting: root.motion.meeting(&cubic, &root.bracket),
            root,
        })
    }

    /// The exact `N . N`, `(M x L) . N` and `(M x K) . N`.
    fn products(&self) -> [[Number; 3]; 2] {
        let products =
            |normals: &[[Number; 3]; 3]| normals.each_ref().map(|x| exact_dot(x, &normals[0]));
        self.root.normals.each_ref().map(products)
    }

    /// Where the lines meet: outside (less), inside (greater), or on the border or nowhere.
    fn place(&self) -> Ordering {
        let places = self.products().map(|[n, u, v]| {
            let order = |x: &Number| x.sign().min((&n - x).sign());
            if n.sign().is_eq() {
                Ordering::Equal
            } else {
                order(&u).min(order(&v))
            }
        });
        if places[0] == places[1] {
            places[0]
        } else {
            Ordering::Equal
        }
    }

    /// Whether what `meeting` says of the place is true.
    fn is_right(&self, meeting: &Meeting) -> bool {
        match meeting.place() {
            Place::Apart => self.place().is_lt(),
            Place::Inside { .. } => self.place().is_gt() && !meeting.is_apart(),
            Place::Unclear => !meeting.is_apart(),
        }
    }

    /// The errors of the three products and of the parameters of a contact, and how far on the
    /// wrong side of an end of an edge the lines seem to meet.
    fn claims(&self) -> [Claim; 5] {
        let Meeting {
            n,
            u,
            v,
            error_n,
            error_u,
            error_v,
            ..
        } = self.meeting;
        let w = self.root.normal();
        assert_eq!(dot(&w, &w), n);
        let w = w.map(Number::from);
        let found = [(n, error_n), (u, error_u), (v, error_v)];
        let product = |i: usize| {
            let [x, y] = self.root.normals.each_ref().map(|normals| {
                let exact = exact_dot(&normals[i], &w);
                Claim::within(found[i].0, &exact, Number::from(found[i].1))
            });
            x.worse(y)
        };
        [
            product(0),
            product(1),
            product(2),
            self.parameters(),
            self.wrong_side(),
        ]
    }

    fn wrong_side(&self) -> Claim {
        let Meeting { n, u, v, .. } = self.meeting;
        let Meeting {
            error_n,
            error_u,
            error_v,
            ..
        } = self.meeting;
        if !(n > error_n) {
            return Claim::nothing();
        }
        let (error_u1, error_v1) = self.meeting.far_errors();
        let [[exact_n, exact_u, exact_v], _] = self.products();
        let sides = [
            (u, error_u, exact_u.sign()),
            (v, error_v, exact_v.sign()),
            (n - u, error_u1, (&exact_n - &exact_u).sign()),
            (n - v, error_v1, (&exact_n - &exact_v).sign()),
        ];
        let wrong = sides
            .into_iter()
            .filter(|(found, _, sign)| Number::from(*found).sign() != *sign);
        let claims = wrong.map(|(found, bound, _)| Claim {
            error: Number::from(found).abs(),
            bound: Number::from(bound),
        });
        claims.fold(Claim::nothing(), Claim::worse)
    }

    fn parameters(&self) -> Claim {
        let Place::Inside { u, v, error } = self.meeting.place() else {
            return Claim::nothing();
        };
        let [x, y] = self.products().map(|[n, exact_u, exact_v]| {
            // All times N . N.
            let [u, v, bound] = [u, v, error].map(|x| &Number::from(x) * &n);
            let error = (&u - &exact_u).abs().larger((&v - &exact_v).abs());
            Claim { error, bound }
        });
        x.worse(y)
    }
}

/// The bracket, or a longer one, of which one half has nothing to do with the root.
fn stretched(bracket: &Bracket, x: &Input) -> Option<Bracket> {
    let [power, side] = [x[24], x[25]];
    if power == 0.0 {
        return Some(*bracket);
    }
    let more = 2f64.powf(power);
    let low = if side < 0.0 {
        bracket.low - more
    } else {
        bracket.low
    };
    let high = if side > 0.0 {
        bracket.high + more
    } else {
        bracket.high
    };
    let is_bracket = (0.0..1.0).contains(&low) && high <= 1.0 && power < 0.0;
    is_bracket.then_some(Bracket {
        low,
        high,
        ..*bracket
    })
}

/// Edges that touch at a time of few bits, at an end of one of them as often as not, up to
/// rounding.
fn touching(random: &mut Random) -> [f64; 24] {
    let mut x = points(random, (0, 0));
    let t = f64::from(random.whole(1, 7)) / 8.0;
    let mut parameter = || match random.below(3) {
        0 => 0.0,
        1 => 1.0,
        _ => random.unit(),
    };
    let (u, v) = (parameter(), parameter());
    for i in 0..3 {
        let at = |p: usize| (1.0 - t) * x[3 * p + i] + t * x[3 * p + 12 + i];
        let [a, b, c, d] = [0, 1, 2, 3].map(at);
        let gap = a + u * (b - a) - c - v * (d - c);
        for p in [6, 9, 18, 21] {
            x[p + i] += gap;
        }
    }
    x
}

fn start(random: &mut Random) -> Input {
    let mut x = [0.0; 26];
    let coordinates = if random.coin() {
        touching(random)
    } else {
        points(random, (-210, 170))
    };
    x[..24].copy_from_slice(&coordinates);
    if random.coin() {
        x[24] = -1.5 - 48.0 * random.unit();
        x[25] = random.signed();
    }
    x
}

#[test]
fn locate_errors_are_within_their_bounds_and_no_claim_is_wrong() {
    let (places, wrong, settled) = (Cell::new([0; 3]), Cell::new(0), Cell::new(0));
    let claims = |x: &Input| {
        let case = Case::new(x)?;
        let meeting = case.meeting;
        let place = match meeting.place() {
            Place::Apart => 0,
            Place::Inside { .. } => 1,
            Place::Unclear => 2,
        };
        let mut counts = places.get();
        counts[place] += 1;
        places.set(counts);
        assert!(case.is_right(&meeting), "{x:?}");
        if let Some(refined) = case.refined {
            assert!(case.is_right(&refined), "to twice the precision: {x:?}");
            let is_gain = place == 2 && refined.place() != Place::Unclear;
            settled.set(settled.get() + u32::from(is_gain));
        }
        let faulty = Meeting {
            error_n: meeting.error_n / 8.0,
            error_u: meeting.error_u / 8.0,
            error_v: meeting.error_v / 8.0,
            ..meeting
        };
        wrong.set(wrong.get() + u32::from(!case.is_right(&faulty)));
        let Meeting {
            n,
            u,
            v,
            error_n,
            error_u,
            error_v,
            ..
        } = meeting;
        let is_finite = [n, u, v, error_n, error_u, error_v]
            .iter()
            .all(|x| x.is_finite());
        is_finite.then(|| case.claims())
    };
    let search = Search {
        seed: 14,
        climbs: 3,
        starts: 300,
        steps: 600,
    };
    let worst = search.worst(start, claims);
    let (places, wrong, settled) = (places.get(), wrong.get(), settled.get());
    println!(
        "locate: n, u, v, parameters, side {worst:?}; {places:?} apart, inside, unclear; with an eighth of the bounds {wrong} wrong; {settled} settled to twice the precision"
    );
    let [n, u, v, parameters, side] = worst;
    assert!(n > 0.4 && u > 0.4 && v > 0.4 && parameters > 0.1 && side > 0.15);
    assert!(places.iter().all(|&count| count > 100) && wrong > 0 && settled > 100);
}
