use std::cell::Cell;

use wide::f64x2;

use super::super::motion::Positions;
use super::super::testing::{
    Claim, Exact, Number, Random, Search, layout, points, points_and_direction, range,
};
use super::*;
use crate::certified::kind::Stages;
use crate::query::EdgeEdge;

fn stages(positions: &Positions) -> (SweptBoxes, Motion<f64x2>) {
    let points = positions.points();
    (EdgeEdge::boxes(&points, 0.0), Motion::new(&points))
}

/// How much farther along `d` C and D are than A and B, at the start or at the end.
fn exact_margin(exact: &Exact, d: &Vector, t: f64) -> Number {
    let [k, l, m] = exact.along(d, t);
    &(&m + &l.smaller(Number::zero())) - &k.larger(Number::zero())
}

/// The margins at both ends of the step as `is_separated_by` computes them, and their error bound.
fn margin(motion: &Motion<f64x2>, d: &Vector, boxes: &SweptBoxes) -> (f64x2, f64) {
    let zero = f64x2::both(0.0);
    let [k, l, m] = [&motion.k, &motion.l, &motion.m].map(|x| dot(x, &both(d)));
    let [x, y, z] = [0, 1, 2].map(|i| boxes.extent[i] * d[i].abs());
    let bound = (x + y + z) * (24.0 * U) + TINY;
    (m + l.smaller(zero) - k.larger(zero), bound)
}

#[test]
fn separate_margins_are_within_their_bound_and_no_claim_is_wrong() {
    let (claimed, largest) = (Cell::new(0), Cell::new(0.0));
    let claims = |x: &[f64; 27]| {
        let positions = layout(x);
        let (boxes, motion) = stages(&positions);
        let d = [x[24], x[25], x[26]];
        let is_separated = motion.is_separated_by(d, &boxes);
        let (margin, bound) = margin(&motion, &d, &boxes);
        let is_above = margin.start() > bound && margin.end() > bound;
        assert_eq!(is_separated, is_above && bound < LARGEST, "{x:?}");
        if !(bound < LARGEST) {
            return None;
        }
        largest.set(bound.max(largest.get()));
        let exact = Exact::new(&positions);
        let (at_start, at_end) = (exact_margin(&exact, &d, 0.0), exact_margin(&exact, &d, 1.0));
        if is_separated {
            assert!(at_start.sign().is_gt() && at_end.sign().is_gt(), "{x:?}");
            claimed.set(claimed.get() + 1);
        }
        Some([
            Claim::within(margin.start(), &at_start, Number::from(bound)),
            Claim::within(margin.end(), &at_end, Number::from(bound)),
        ])
    };
    let search = Search {
        seed: 1,
        climbs: 8,
        starts: 200,
        steps: 2000,
    };
    let worst = search.worst(|random| points_and_direction(random, &[0, 1]), claims);
    println!(
        "separate: margins {worst:?}, {} claims, bounds up to {:e}",
        claimed.get(),
        largest.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 0.1));
    assert!(claimed.get() > 500 && largest.get() > LARGEST / 16.0);
}

/// Edges that are apart by little more than the bound, and the direction of the gap: claims and
/// refusals meet at a gap that is a small multiple of the rounding errors.
#[test]
fn separate_claims_begin_near_the_bound() {
    let mut random = Random::new(2);
    let (mut claimed, mut refused) = (f64::INFINITY, 0.0f64);
    for _ in 0..20_000 {
        let mut x = [0.0; 24].map(|_| random.signed());
        let gap = 2f64.powi(random.whole(-60, -40));
        for p in 0..8 {
            x[3 * p + 2] = match p % 4 {
                0 | 1 => -random.unit() * 2f64.powi(-random.whole(0, 60)),
                _ => gap,
            };
        }
        let positions = layout(&x);
        let (boxes, motion) = stages(&positions);
        let d = [0.0, 0.0, 1.0];
        let exact = Exact::new(&positions);
        let margin = exact_margin(&exact, &d, 0.0).smaller(exact_margin(&exact, &d, 1.0));
        let units = margin.ratio(&Number::from(U * boxes.extent[2]));
        if motion.is_separated_by(d, &boxes) {
            claimed = claimed.min(units);
        } else {
            refused = refused.max(units);
        }
    }
    println!("separate: claims from {claimed} u S, refusals to {refused} u S");
    assert!(claimed > 24.0 - 22.0 && claimed < 48.0 && refused < 48.0 && refused > 2.0);
}

#[test]
fn separate_boxes_are_exact() {
    let mut random = Random::new(3);
    let mut counts = [0; 2];
    for _ in 0..200_000 {
        let x = points(&mut random, (-1074, 1020));
        let (boxes, _) = stages(&layout(&x));
        let mut are_disjoint = false;
        for i in 0..3 {
            let (ab, cd) = (range(&x, i, &[0, 1]), range(&x, i, &[2, 3]));
            are_disjoint |= ab.1 < cd.0 || cd.1 < ab.0;
            let all = range(&x, i, &[0, 1, 2, 3]);
            assert_eq!(boxes.extent[i], all.1 - all.0);
        }
        assert_eq!(boxes.are_disjoint, are_disjoint, "{x:?}");
        counts[usize::from(are_disjoint)] += 1;
    }
    println!("separate: boxes {counts:?}");
    assert!(counts.iter().all(|&count| count > 5_000));
}

/// Along each axis and in both orders: boxes that share one coordinate, and boxes an ulp apart.
#[test]
fn separate_boxes_that_touch_are_not_disjoint() {
    for (i, value) in [0, 1, 2]
        .into_iter()
        .flat_map(|i| [(i, 0.0), (i, 1.0), (i, -1e300)])
    {
        for (p, at) in [(0, f64::NEG_INFINITY), (2, f64::INFINITY)]
            .into_iter()
            .flat_map(|x| [x; 1])
        {
            let mut x = [0.0; 24];
            for point in 0..8 {
                x[3 * point + i] = value;
            }
            assert!(!stages(&layout(&x)).0.are_disjoint);
            let next = if at > 0.0 {
                value.next_up()
            } else {
                value.next_down()
            };
            for point in [p, p + 1, p + 4] {
                x[3 * point + i] = next;
            }
            assert!(!stages(&layout(&x)).0.are_disjoint);
            x[3 * (p + 5) + i] = next;
            assert!(stages(&layout(&x)).0.are_disjoint);
        }
    }
}
