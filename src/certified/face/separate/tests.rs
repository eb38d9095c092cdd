use std::cell::Cell;

use wide::f64x2;

use super::*;
use crate::certified::kind::Stages;
use crate::certified::testing::{
    Claim, Exact, Number, Random, Search, layout, points, points_and_direction, range,
};
use crate::query::VertexFace;

/// How much farther along `d` the corners are than the vertex, at the start or at the end.
fn exact_margin(exact: &Exact, d: &Vector, t: f64) -> Number {
    let [k, l, m] = exact.along(d, t);
    &Number::zero().smaller(k).smaller(l) - &m
}

fn margin(star: &Motion<f64x2>, d: &Vector) -> f64x2 {
    let [k, l, m] = [&star.k, &star.l, &star.m].map(|x| dot(x, &both(d)));
    k.smaller(l).smaller(f64x2::both(0.0)) - m
}

#[test]
fn face_margins_are_within_their_bound_and_no_claim_is_wrong() {
    let claimed = Cell::new(0);
    let claims = |x: &[f64; 27]| {
        let positions = layout(x);
        let points = positions.points::<f64x2>();
        let (boxes, star, d) = (
            VertexFace::boxes(&points, 0.0),
            star(&points),
            [x[24], x[25], x[26]],
        );
        let exact = Exact::of(&positions, [(2, 1), (3, 1), (0, 1)]);
        let exact = [0.0, 1.0].map(|t| exact_margin(&exact, &d, t));
        if is_separated_by(&star, d, &boxes) {
            assert!(exact.iter().all(|margin| margin.sign().is_gt()), "{x:?}");
            claimed.set(claimed.get() + 1);
        }
        let bound = boxes.bound(&d);
        if !bound.is_finite() {
            return None;
        }
        let margin = margin(&star, &d);
        let [at_start, at_end] = exact;
        let is_finite = margin.start().is_finite() && margin.end().is_finite();
        is_finite.then(|| {
            [
                Claim::within(margin.start(), &at_start, Number::from(bound)),
                Claim::within(margin.end(), &at_end, Number::from(bound)),
            ]
        })
    };
    let search = Search {
        seed: 22,
        climbs: 8,
        starts: 200,
        steps: 2000,
    };
    let worst = search.worst(|random| points_and_direction(random, &[0]), claims);
    println!("face: margins {worst:?}, {} claims", claimed.get());
    assert!(worst.iter().all(|&ratio| ratio > 0.08) && claimed.get() > 500);
}

#[test]
fn face_boxes_are_disjoint_exactly_where_an_axis_separates() {
    let mut random = Random::new(23);
    let mut counts = [0; 2];
    for _ in 0..200_000 {
        let x = points(&mut random, (-1074, 1020));
        let are_disjoint = (0..3).any(|i| {
            let (vertex, face) = (range(&x, i, &[0]), range(&x, i, &[1, 2, 3]));
            vertex.1 < face.0 || face.1 < vertex.0
        });
        let boxes = VertexFace::boxes(&layout(&x).points::<f64x2>(), 0.0);
        assert_eq!(boxes.are_disjoint, are_disjoint, "{x:?}");
        counts[usize::from(are_disjoint)] += 1;
    }
    println!("face: boxes {counts:?}");
    assert!(counts.iter().all(|&count| count > 5_000));
}
