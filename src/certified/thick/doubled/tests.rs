use super::super::testing::{Sample, nearly_parallel, search};
use super::*;
use crate::certified::testing::{Claim, Number, Random, dot as exact_dot, points};
use crate::query::{EdgeEdge, VertexFace};

/// The squared distance less that of the radius, to twice the precision, against the exact one.
fn excess_is_within_its_bound<K: Stages>(seed: u64) {
    let claims = |x: &[f64; 29]| {
        let t = x[24].abs().min(1.0);
        let [u, v] = [x[25], x[26]].map(|x| x.abs().min(1.0));
        let parts = [x[27], x[28]].map(f64::abs);
        let sample = Sample::new::<K>(&x[..24], parts[0] + parts[1]);
        let (_, size) = sample.moving.reaches();
        let here = Instant::new::<K, _>(&sample.moving, t);
        let spot = Spot { u, v, ..here.spot };
        let (value, error) =
            excess::<K, _>(&sample.positions.points::<f64x2>(), parts, t, &spot, &size);
        let difference = sample.difference(&Number::from(t), &[u, v].map(Number::from));
        let radius = &Number::from(parts[0]) + &Number::from(parts[1]);
        let exact = &exact_dot(&difference, &difference) - &(&radius * &radius);
        // The rounding to `f64` is counted where the value is used.
        let bound = Number::from(error + 1.01 * U * value.abs());
        Some([Claim::within(value, &exact, bound)])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 29];
        x[..24].copy_from_slice(&points(random, (-100, 100)));
        x[24..].fill_with(|| random.signed());
        x
    };
    let worst = search(seed).worst(start, claims);
    println!("thick: to twice the precision {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 1e-2));
}

#[test]
fn thick_squares_of_edges_are_within_their_bound() {
    excess_is_within_its_bound::<EdgeEdge>(1);
}

#[test]
fn thick_squares_of_a_face_are_within_their_bound() {
    excess_is_within_its_bound::<VertexFace>(2);
}

#[test]
fn slopes_to_twice_the_precision_are_within_their_bound() {
    let claims = |x: &[f64; 27]| {
        let t = x[24].abs().min(1.0);
        let sample = Sample::new::<EdgeEdge>(&x[..24], 1.0);
        let here = Instant::new::<EdgeEdge, _>(&sample.moving, t);
        let [u, v] = [x[25], x[26]].map(|x| x.abs().min(1.0));
        let here = here.at_spot(Spot { u, v, ..here.spot });
        let points = sample.positions.points();
        let edges = edges_at::<EdgeEdge>(&points, t);
        let values = slopes_at::<EdgeEdge>(&points, &edges, t, &here);
        let ([k, l], size) = sample.moving.reaches();
        let time = Number::from(t);
        let difference = sample.difference(&time, &[u, v].map(Number::from));
        let [exact_k, exact_l, _] = sample.at(&time);
        let claim = |value: f64, vector: &[Number; 3], reach: &[f64; 3]| {
            let bound = Number::from(SLOPE_ERROR * dot(reach, &size) + 1.01 * U * value.abs());
            Claim::within(value, &exact_dot(vector, &difference), bound)
        };
        Some([
            claim(values[0], &exact_k, &k),
            claim(values[1], &exact_l, &l),
        ])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 27];
        x[..24].copy_from_slice(&nearly_parallel(random));
        x[24..].fill_with(|| random.unit());
        x
    };
    let worst = search(2).worst(start, claims);
    println!("thick: slopes to twice the precision {worst:?}");
    assert!(worst.iter().all(|&ratio| ratio > 1e-2));
}
