use wide::f64x2;

use super::super::shape::{Edges, Face, Free};
use super::*;
use crate::certified::motion::Positions;
use crate::certified::separate::SweptBoxes;
use crate::certified::testing::{
    Claim, Exact, Number, Random, Search, dot as exact_dot, layout, points,
};

/// `u` and `v` of the exact nearest points of the lines, or in the plane, times `N^2`, and `N^2`.
fn centre(exact: &Exact, t: f64) -> ([Number; 2], Number) {
    let [n, ml, mk] = exact.normals(&Number::from(t));
    ([exact_dot(&ml, &n), exact_dot(&mk, &n)], exact_dot(&n, &n))
}

fn errors_are_bounded<S: Shape>(seed: u64) {
    let claims = |x: &[f64; 25]| {
        let positions: Positions = layout(&x[..24]);
        let t = x[24].abs().min(1.0).next_down().max(0.0);
        let boxes = SweptBoxes::new(&positions.points::<f64x2>());
        let moving = Moving::<f64x2>::new::<S>(&positions, boxes, 1.0);
        let (spot, _) = moving.nearest::<S>(t);
        let error = parameter_error::<S, _>(&moving, t, &spot)?;
        if spot.free != Free::Everywhere || !error.is_finite() {
            return None;
        }
        let exact = Exact::of(&positions, S::WAYS.map(|(from, to)| (to, from)));
        // The time of impact is anywhere up to the next number.
        let at = |t: f64| {
            let ([u, v], n2) = centre(&exact, t);
            let is_inside = |x: &Number| x.sign().is_gt() && (&n2 - x).sign().is_gt();
            let is_face_left = S::CORNERS.len() == 4 || (&(&n2 - &u) - &v).sign().is_gt();
            if !(is_inside(&u) && is_inside(&v) && is_face_left) {
                return Claim::nothing();
            }
            let claim = |found: f64, exact: &Number| Claim {
                error: (&(&Number::from(found) * &n2) - exact).abs(),
                bound: &Number::from(error) * &n2,
            };
            claim(spot.u, &u).worse(claim(spot.v, &v))
        };
        Some([at(t), at(t.next_up())])
    };
    let search = Search {
        seed,
        climbs: 6,
        starts: 200,
        steps: 1500,
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 25];
        x[..24].copy_from_slice(&points(random, (-100, 100)));
        x[24] = random.unit();
        x
    };
    let worst = search.worst(start, claims);
    println!("thick: places {worst:?}");
    // The bound is generous: it sums up magnitudes where the errors are of either sign, and takes a quarter of N^2.
    assert!(worst.iter().all(|&ratio| ratio > 1e-4));
}

#[test]
fn thick_places_of_edges_are_within_their_error() {
    errors_are_bounded::<Edges>(1);
}

#[test]
fn thick_places_in_a_face_are_within_their_error() {
    errors_are_bounded::<Face>(2);
}
