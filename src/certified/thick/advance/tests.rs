use std::cell::Cell;

use wide::f64x2;

use super::super::shape::{Edges, Face};
use super::*;
use crate::certified::testing::{
    Claim, Exact, Number, Polynomial, Random, Search, dot as exact_dot, layout,
    points_and_direction,
};

/// Whether a plane keeps all corners more than the radius apart at a time, as a claim: the square of what is asked
/// is at most that of the least corner.
fn separation<S: Shape>(exact: &Exact, n: &Vector, radius: f64, t: f64) -> Claim {
    let (t, n) = (Number::from(t), n.map(Number::from));
    let along = |x: &[Polynomial; 3]| exact_dot(&x.each_ref().map(|p| p.at(&t)), &n);
    let (k, l, m) = (along(&exact.k), along(&exact.l), along(&exact.m));
    let corners = S::CORNERS.iter().map(|&(u, v)| {
        let (u, v) = (Number::from(u), Number::from(v));
        &(&m + &(&v * &l)) - &(&u * &k)
    });
    let least = corners.reduce(Number::smaller).expect("a corner");
    assert!(least.sign().is_gt());
    let reach = &Number::from(radius) * &Number::from(radius);
    Claim {
        error: &reach * &exact_dot(&n, &n),
        bound: &least * &least,
    }
}

fn spans_are_proved<S: Shape>(seed: u64, side: &[usize]) {
    let parts = Cell::new(0);
    let claims = |x: &[f64; 28]| {
        let positions = layout(&x[..24]);
        let n = [x[24], x[25], x[26]];
        let radius = x[27].abs();
        let boxes = SweptBoxes::new(&positions.points::<f64x2>());
        let moving = Moving::<f64x2>::new::<S>(&positions, boxes, radius);
        let span = moving.span::<S>(&n, 1.0);
        if !(span.from <= span.to && span.from <= 1.0) {
            return None;
        }
        if !span.is_all() {
            parts.set(parts.get() + 1);
        }
        let exact = Exact::of(&positions, S::WAYS.map(|(from, to)| (to, from)));
        Some([span.from, span.to.min(1.0)].map(|t| separation::<S>(&exact, &n, radius, t)))
    };
    let search = Search {
        seed,
        climbs: 6,
        starts: 200,
        steps: 1500,
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 28];
        x[..27].copy_from_slice(&points_and_direction(random, side));
        x[27] = x[0] * random.unit();
        x
    };
    let worst = search.worst(start, claims);
    println!(
        "thick: planes {worst:?}, {} for a part of the step",
        parts.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 0.999) && parts.get() > 100);
}

#[test]
fn thick_planes_of_edges_separate_as_long_as_they_say() {
    spans_are_proved::<Edges>(1, &[0, 1]);
}

#[test]
fn thick_planes_of_a_face_separate_as_long_as_they_say() {
    spans_are_proved::<Face>(2, &[0]);
}
