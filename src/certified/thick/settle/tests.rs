use super::super::shape::{Edges, Face};
use super::*;
use crate::certified::separate::SweptBoxes;
use crate::certified::testing::{
    Claim, Exact, Number, Random, Search, dot as exact_dot, layout, points,
};

fn number(x: &Twice) -> Number {
    let x = x.lanes()[0];
    &Number::from(x.high) + &Number::from(x.low)
}

/// The differences and the corners along a normal, to twice the precision, against exact ones.
fn sums_are_within_their_bounds<S: Shape>(seed: u64) {
    let claims = |x: &[f64; 31]| {
        let positions = layout(&x[..24]);
        let t = x[24].abs().min(1.0);
        let boxes = SweptBoxes::new(&positions.points::<f64x2>());
        let moving = Moving::<f64x2>::new::<S>(&positions, boxes, 1.0);
        let here = Instants::<S>::new(&positions, &moving, [t, t]);
        let place = [(x[25], x[26]), (x[27], x[28])];
        let place = place.map(|(high, low)| {
            Twice::both(two_sum(high.abs().min(1.0), 1e-17 * low.clamp(-1.0, 1.0)))
        });
        let way = here.way(&place);
        let exact = Exact::of(&positions, S::WAYS.map(|(from, to)| (to, from)));
        let at = Number::from(t);
        let [k, l, m] = [&exact.k, &exact.l, &exact.m].map(|x| x.each_ref().map(|p| p.at(&at)));
        let [u, v] = place.each_ref().map(number);
        let of = |i: usize| {
            let expected = &(&m[i] + &(&v * &l[i])) - &(&u * &k[i]);
            Claim {
                error: (&number(&way[i]) - &expected).abs(),
                bound: Number::from(128.0 * H * here.size[i] + f64::MIN_POSITIVE),
            }
        };
        let claim = of(0).worse(of(1)).worse(of(2));
        // M along the way.
        let n = way.each_ref().map(number);
        let along = dot_twice(&here.vectors[2], &way);
        let rounded = way.map(|x| x.lanes()[0].high.abs());
        let product = Claim {
            error: (&number(&along) - &exact_dot(&m, &n)).abs(),
            bound: Number::from(
                96.0 * H * dot(&rounded, &here.size) * (1.0 + 1e-6) + f64::MIN_POSITIVE,
            ),
        };
        Some([claim, product])
    };
    let search = Search {
        seed,
        climbs: 4,
        starts: 200,
        steps: 1500,
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 31];
        x[..24].copy_from_slice(&points(random, (-100, 100)));
        x[24..].fill_with(|| random.signed());
        x
    };
    let worst = search.worst(start, claims);
    println!("thick: to twice the precision {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 1e-2));
}

#[test]
fn thick_sums_of_edges_are_within_their_bounds() {
    sums_are_within_their_bounds::<Edges>(1);
}

#[test]
fn thick_sums_of_a_face_are_within_their_bounds() {
    sums_are_within_their_bounds::<Face>(2);
}
