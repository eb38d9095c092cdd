use std::cell::Cell;

use super::super::testing::{Sample, search};
use super::*;
use crate::certified::testing::{
    Claim, Number, Random, dot as exact_dot, points, points_and_direction,
};
use crate::query::{EdgeEdge, VertexFace};

/// That a plane keeps all corners more than the radius away a time `s` after `t`: the square of
/// what is asked is at most that of the least corner.
fn separation<K: Stages>(sample: &Sample, plane: &Turning, t: f64, s: &Number) -> Claim {
    let exact = |x: &Vector| x.map(Number::from);
    let (normal, turn) = (exact(&plane.normal), exact(&plane.turn));
    let n = [0, 1, 2].map(|i| &normal[i] + &(s * &turn[i]));
    let least = sample.least_corner::<K>(&(&Number::from(t) + s), &n);
    assert!(least.sign().is_gt());
    let reach = Number::from(sample.moving.radius);
    Claim {
        error: &(&reach * &reach) * &exact_dot(&n, &n),
        bound: &least * &least,
    }
}

/// Any planes, and those between nearest points.
fn planes_are_proved<K: Stages>(seed: u64, is_own: bool, side: &[usize]) {
    let parts = Cell::new(0);
    let claims = |x: &[f64; 32]| {
        let (t, radius) = (x[30].abs().min(1.0), x[31].abs());
        let sample = Sample::new::<K>(&x[..24], radius);
        let here = Instant::new::<K, _>(&sample.moving, t);
        let plane = if is_own {
            Turning::new(&here)
        } else {
            Turning::between([x[24], x[25], x[26]], [x[27], x[28], x[29]])
        };
        let longest = 1.0 - t;
        let while_ = sample
            .moving
            .stays_apart_turning::<K>(&here, &plane, longest);
        assert!(while_ <= longest, "not beyond what is asked");
        if !(while_ > 0.0) {
            return None;
        }
        parts.set(parts.get() + u32::from(while_ < longest));
        let claim = |share: f64| {
            let s = &Number::from(while_) * &Number::from(share);
            separation::<K>(&sample, &plane, t, &s)
        };
        Some([claim(0.0), claim(0.5).worse(claim(0.875)), claim(1.0)])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 32];
        x[..27].copy_from_slice(&points_and_direction(random, side));
        if is_own {
            x[..24].copy_from_slice(&points(random, (-100, 100)));
        }
        let size = x[24].abs().max(x[25].abs()).max(x[26].abs());
        x[27..30].fill_with(|| size * random.signed());
        x[30] = if random.coin() { 0.0 } else { random.unit() };
        x[31] = (x[0] - x[6]).abs() * random.unit();
        x
    };
    let worst = search(seed).worst(start, claims);
    println!(
        "thick: turning planes {worst:?}, {} for a part of the rest",
        parts.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 0.999) && parts.get() > 100);
}

#[test]
fn thick_planes_of_edges_separate_as_long_as_they_say() {
    planes_are_proved::<EdgeEdge>(1, false, &[0, 1]);
    planes_are_proved::<EdgeEdge>(2, true, &[0, 1]);
}

#[test]
fn thick_planes_of_a_face_separate_as_long_as_they_say() {
    planes_are_proved::<VertexFace>(3, false, &[0]);
    planes_are_proved::<VertexFace>(4, true, &[0]);
}

/// Edges that turn about the line through their nearest points, at a distance of 1: no fixed plane
/// keeps them apart, the one that turns does.
#[test]
fn thick_planes_turn_with_the_edges() {
    let turning = |z: f64, x: f64| [z, x, 1.0 - z];
    let start = [
        [-1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        turning(0.0, -1.0),
        turning(0.0, 1.0),
    ];
    // CD tilts: C goes up, D down.
    let end = [start[0], start[1], [0.0, -1.0, 1.5], [0.0, 1.0, 0.5]];
    let coordinates: Vec<f64> = [start, end].as_flattened().as_flattened().to_vec();
    let sample = Sample::new::<EdgeEdge>(&coordinates, 0.8);
    let here = Instant::new::<EdgeEdge, _>(&sample.moving, 0.0);
    let with = |turn: Vector| {
        let plane = Turning::between(here.difference, turn);
        sample
            .moving
            .stays_apart_turning::<EdgeEdge>(&here, &plane, 1.0)
    };
    let fixed = with([0.0; 3]);
    assert!((0.39..0.41).contains(&fixed), "{fixed}");
    let turned = with(Turning::new(&here).turn);
    assert!(turned >= 1.0, "{turned}");
}

/// The first root of a polynomial of degree 2, about which nothing is promised but that it is not
/// passed.
#[test]
fn thick_polynomials_stay_positive_as_long_as_they_say() {
    let certain = Cell::new([0; 2]);
    let claims = |x: &[f64; 3]| {
        let until = stays_positive(x);
        if !(until > 0.0) {
            return None;
        }
        let is_short = until < 1.0;
        let mut counts = certain.get();
        counts[usize::from(is_short)] += 1;
        certain.set(counts);
        let [a, b, c] = x.map(Number::from);
        // That the part below 0 is not larger than the rest.
        let at = |s: &Number| {
            let terms = [a.clone(), &b * s, &c * &(s * s)];
            let sum = |is_part: fn(&Number) -> bool| {
                let part = terms.iter().filter(|term| is_part(term));
                part.fold(Number::zero(), |sum, term| &sum + &term.abs())
            };
            Claim {
                error: sum(|term| term.sign().is_lt()),
                bound: sum(|term| term.sign().is_gt()),
            }
        };
        let end = Number::from(until.min(1.0));
        let part = |share: f64| at(&(&end * &Number::from(share)));
        Some([part(1.0), part(0.5).worse(part(0.9))])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 3].map(|_| random.signed() * 2f64.powi(random.whole(-40, 40)));
        if random.coin() {
            // A double root, up to a few roundings.
            x[2] = random.nudged(x[1] * x[1] / (4.0 * x[0]));
        }
        x
    };
    let worst = search(5).worst(start, claims);
    let [long, short] = certain.get();
    println!("thick: roots {worst:?}, {short} in the step, {long} after it");
    assert!(worst.iter().all(|&ratio| ratio > 0.99) && long > 100 && short > 100);
}
