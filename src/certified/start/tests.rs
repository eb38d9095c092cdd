use wide::f64x2;

use super::super::exact;
use super::super::testing::Random;
use super::*;

/// Points with a common end at the start as often as not, also for the whole step; confined or not;
/// of small integers or up to rounding.
fn layout(random: &mut Random) -> Positions {
    let is_small = random.coin();
    let mut point = || {
        [0; 3].map(|_| {
            if is_small {
                f64::from(random.whole(-2, 2))
            } else {
                random.signed()
            }
        })
    };
    let (mut start, mut end) = ([0; 4].map(|_| point()), [0; 4].map(|_| point()));
    let (i, j) = ENDS[random.below(4) as usize];
    start[j] = start[i];
    match random.below(6) {
        0 | 1 => end[j] = end[i],
        2 => end[j] = [0, 1, 2].map(|h| end[i][h] + 2f64.powi(-random.whole(40, 70))),
        3 => start[j][0] += 2f64.powi(-random.whole(40, 70)),
        _ => {}
    }
    if random.coin() {
        start.iter_mut().chain(&mut end).for_each(|p| p[2] = p[0]);
    }
    if random.below(4) == 0 {
        start[random.below(4) as usize] = start[i];
    }
    let power = if random.below(4) == 0 {
        random.whole(-1000, 1000)
    } else {
        0
    };
    let scaled = |p: Vector| p.map(|x| x * 2f64.powi(power));
    Positions {
        start: start.map(scaled),
        end: end.map(scaled),
    }
}

#[test]
fn start_contact_is_that_of_the_exact_stage() {
    let mut random = Random::new(11);
    let mut cases = [0; 3];
    for _ in 0..100_000 {
        let positions = layout(&mut random);
        let motion = Motion::<f64x2>::new(&positions.points());
        let cubic = Cubic::new(&motion);
        if let Some(hit) = contact(&|| positions, &motion, cubic.as_ref()) {
            assert_eq!(Some(hit), exact::decide_edges(&positions), "{positions:?}");
            cases[match hit.case {
                Case::General => 0,
                Case::SharedStart => 1,
                _ => 2,
            }] += 1;
        }
    }
    println!("start: general, shared start, coplanar {cases:?} of 100000");
    assert!(cases.iter().all(|&count| count > 2_000));
}
