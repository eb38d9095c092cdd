use super::super::decide_thick_edges;
use super::*;
use crate::certified::testing::Random;
use crate::query::Radius;

type Corner = [f64; 3];

fn vector(random: &mut Random, most: i32) -> Corner {
    [0; 3].map(|_: i32| f64::from(random.whole(-most, most)))
}

fn moved(from: &Corner, by: &Corner, times: f64) -> Corner {
    [0, 1, 2].map(|axis: usize| from[axis] + times * by[axis])
}

/// Two edges along one direction, which turns and stretches; where that is 0 both are points.
fn parallel(random: &mut Random) -> Positions {
    let (direction, turned) = (vector(random, 3), vector(random, 3));
    let [along, across] = [0; 2].map(|_: i32| f64::from(random.whole(-3, 3)));
    let at = |random: &mut Random, direction: &Corner| {
        let (a, c) = (vector(random, 4), vector(random, 4));
        [
            a,
            moved(&a, direction, along),
            c,
            moved(&c, direction, across),
        ]
    };
    Positions {
        start: at(random, &direction),
        end: at(random, &turned),
    }
}

/// Whether each number of a place is within its error of the exact one, which the other is near.
fn is_same(own: &Hit<EdgePlace>, general: &Hit<EdgePlace>) -> bool {
    let rest = |hit: &Hit<EdgePlace>| {
        (
            hit.toi,
            hit.toi_above,
            hit.kind,
            hit.side,
            hit.case,
            hit.flags,
        )
    };
    let error = own.place.error + general.place.error;
    let near =
        |p: EdgePoint, q: EdgePoint| (p.u - q.u).abs() <= error && (p.v - q.v).abs() <= error;
    let seconds = match (own.place.second, general.place.second) {
        (Some(own), Some(general)) => near(own, general),
        (own, general) => own.is_none() && general.is_none(),
    };
    rest(own) == rest(general) && near(own.place.first, general.place.first) && seconds
}

#[test]
fn parallel_edges_near_at_the_start_are_as_in_the_general_stage() {
    let mut random = Random::new(31);
    let radius = Radius::from(64.0);
    let (mut points, mut stretches) = (0, 0);
    for _ in 0..4_000 {
        // Parallel at the start, and then as may be.
        let Positions { start, end } = parallel(&mut random);
        let end = if random.coin() {
            end
        } else {
            [0; 4].map(|_: i32| vector(&mut random, 4))
        };
        let positions = Positions { start, end };
        let own = near_start_of_parallel_edges(&positions).expect("they are parallel");
        let general = decide_thick_edges(&positions, radius).expect("they are near");
        assert!(
            is_same(&own, &general),
            "{positions:?}: {own:?} {general:?}"
        );
        points += u32::from(start[0] == start[1] || start[2] == start[3]);
        stretches += u32::from(own.place.second.is_some());
    }
    assert!(points > 500 && stretches > 500, "{points} {stretches}");
}

#[test]
fn edges_that_are_not_parallel_at_the_start_are_left_to_others() {
    let start = [[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0]];
    for end in [start, [[0.0; 3]; 4]] {
        assert_eq!(
            near_start_of_parallel_edges(&Positions { start, end }),
            None
        );
        assert!(!are_always_parallel(&Positions { start, end }));
    }
    // 61 bits apart.
    let far = [
        [0.0; 3],
        [2f64.powi(61), 0.0, 0.0],
        [0.0; 3],
        [1.0, 0.0, 0.0],
    ];
    let positions = Positions {
        start: far,
        end: far,
    };
    assert_eq!(near_start_of_parallel_edges(&positions), None);
    assert!(!are_always_parallel(&positions));
}

#[test]
fn contact_of_parallel_edges_later_is_as_in_the_general_stage() {
    let mut random = Random::new(32);
    let (mut certain, mut stretches, mut unclear) = (0, 0, 0);
    for _ in 0..12_000 {
        let positions = parallel(&mut random);
        assert!(are_always_parallel(&positions));
        let radius = Radius::from(f64::from(random.whole(1, 7)) / 4.0);
        let Some(general) = decide_thick_edges(&positions, radius) else {
            continue;
        };
        if general.toi_above == 0.0 {
            continue;
        }
        let toi = [general.toi, general.toi_above];
        match contact_of_parallel_edges(&positions, toi) {
            Some(own) => {
                assert!(
                    is_same(&own, &general),
                    "{positions:?} {radius:?}: {own:?} {general:?}"
                );
                certain += 1;
                stretches += u32::from(own.place.second.is_some());
            }
            None => unclear += 1,
        }
    }
    // Unclear are points, and ends that are just beside each other.
    assert!(
        certain > 1_000 && stretches > 300 && unclear < 2 * certain,
        "{certain} {stretches} {unclear}"
    );
}

/// Values and signs of polynomials against exact ones, for coefficients of every size and times at
/// which they are nearly 0.
#[test]
fn quadratic_values_are_within_their_bound_and_signs_are_certain() {
    let mut random = Random::new(33);
    let mut certain = 0;
    for _ in 0..20_000 {
        let bits = 1 + random.below(40) as i32;
        let root = f64::from(random.whole(1, 1 << 20)) * 2f64.powi(-20);
        let [b, c] = [0; 2].map(|_: i32| (random.signed() * 2f64.powi(bits)) as i128);
        // Times 2^40, exactly: 0 at the root, but for what is added.
        let t = (root * 2f64.powi(20)) as i128;
        let off = i128::from(random.whole(-2, 2));
        let quadratic = Quadratic([off - (b << 20) * t - c * t * t, b << 40, c << 40]);
        let exact = off as f64;
        let (value, error) = quadratic.at(root);
        assert!((value - exact).abs() <= error, "{quadratic:?} {root}");
        let sign = quadratic.sign_at(Time::After(root));
        if quadratic.0 != [0; 3]
            && let Some(sign) = sign
        {
            assert_eq!(sign, off.cmp(&0), "{quadratic:?} {root}");
            certain += 1;
        }
    }
    assert!(certain > 1_000, "{certain}");
}
