use super::super::{Edges, Face, Pair, Reach, Sides, Time, decide_near_edges, decide_near_face};
use super::super::{integers, passage_of_edges};
use super::*;
use crate::certified::exact::dyadic::Dyadic;
use crate::certified::exact::passage_of_face;
use crate::certified::exact::thick::{compare_distance_of_edges, compare_distance_of_face};
use crate::certified::exact::thick::{decide_thick_edges, decide_thick_face};
use crate::certified::motion::Positions;
use crate::certified::testing::Random;
use crate::query::Radius;

type Corner = [f64; 3];

/// Points with small whole coordinates, often at rest, some of them off by less than an ulp of 1; AB
/// and CD are often parallel.
fn positions(random: &mut Random) -> Positions {
    let is_off = random.whole(0, 2) == 0;
    let corner = |random: &mut Random| -> Corner {
        [0; 3].map(|_: i32| {
            let whole = f64::from(random.whole(-2, 2));
            if is_off && whole == 0.0 {
                f64::from(random.whole(-3, 3)) * 2f64.powi(-60)
            } else {
                whole
            }
        })
    };
    let mut start = [0; 4].map(|_: i32| corner(random));
    if random.coin() {
        let [a, b, c, _] = start;
        let times = f64::from(random.whole(-2, 2));
        start[3] = [0, 1, 2].map(|i: usize| c[i] + times * (b[i] - a[i]));
    }
    let end = if random.coin() {
        start
    } else {
        [0; 4].map(|_: i32| corner(random))
    };
    Positions { start, end }
}

/// The definition: the least sign of those pairs of features that hold at a time.
fn by_pairs<const W: usize>(sides: &impl Sides<W>, reach: &Reach, time: f64) -> Ordering {
    let time = Time::At(Dyadic::from_f64(time));
    let pairs = sides.pairs();
    let holding = pairs.iter().filter(|pair| pair.holds(&time));
    let signs = holding.map(|pair: &Pair<W>| time.sign_of(&pair.excess(reach)));
    signs.min().expect("vertices hold")
}

fn radius(random: &mut Random) -> Radius {
    // Often the exact distance.
    Radius::from(f64::from(random.whole(1, 3)))
}

#[test]
fn distances_are_those_of_the_nearest_pair_of_features() {
    let mut random = Random::new(71);
    let mut signs = [0; 3];
    for _ in 0..2_000 {
        let positions = positions(&mut random);
        let radius = radius(&mut random);
        let time = f64::from(random.whole(0, 2)) / 2.0;
        let (points, reach) = integers(&positions, radius.parts());
        let edges = compare_distance_of_edges(&positions, radius, time);
        let expected = by_pairs(&Edges::new(&points), &reach, time);
        assert_eq!(edges, expected, "{positions:?} {radius:?} {time}");
        let face = compare_distance_of_face(&positions, radius, time);
        let expected = by_pairs(&Face::new(&points), &reach, time);
        assert_eq!(face, expected, "{positions:?} {radius:?} {time}");
        for sign in [edges, face] {
            signs[(sign as i8 + 1) as usize] += 1;
        }
    }
    assert!(signs.iter().all(|&count| count > 50), "{signs:?}");
}

#[test]
fn contacts_at_the_start_are_those_of_polynomials_bit_for_bit() {
    let mut random = Random::new(72);
    let (mut hits, mut stretches) = (0, 0);
    for _ in 0..2_000 {
        let positions = positions(&mut random);
        let radius = radius(&mut random);
        let (points, reach) = integers(&positions, radius.parts());
        let own = decide_thick_edges(&positions, radius).filter(|hit| hit.toi_above == 0.0);
        let general = decide_near_edges(&Edges::new(&points), &reach, || {
            passage_of_edges(&positions)
        });
        let general = general.filter(|hit| hit.toi_above == 0.0);
        assert_eq!(own, general, "{positions:?} {radius:?}");
        stretches += u32::from(own.is_some_and(|hit| hit.place.second.is_some()));

        let Positions { start, end } = positions;
        let [start, end] = [start, end].map(|[a, b, c, d]| [b, c, a, d]);
        let passage = || passage_of_face(&Positions { start, end });
        let own = decide_thick_face(&positions, radius, passage);
        let own = own.filter(|hit| hit.toi_above == 0.0);
        let general = decide_near_face(&Face::new(&points), &reach, passage);
        assert_eq!(
            own,
            general.filter(|hit| hit.toi_above == 0.0),
            "{positions:?} {radius:?}"
        );
        hits += u32::from(own.is_some());
    }
    assert!(hits > 500 && stretches > 50, "{hits} {stretches}");
}
