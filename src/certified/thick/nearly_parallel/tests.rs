use std::cell::Cell;

use super::super::testing::{Sample, nearly_parallel, search};
use super::*;
use crate::certified::testing::Random;
use crate::query::EdgeEdge;

#[test]
fn nearest_places_of_nearly_parallel_edges_are_within_their_bounds() {
    // At a corner from which it is farther everywhere, and elsewhere.
    let counts = Cell::new([0; 2]);
    let claims = |x: &[f64; 27]| {
        let (t, while_) = (x[24].abs().min(1.0), x[25].abs().min(0.1));
        let sample = Sample::new::<EdgeEdge>(&x[..24], 1.0);
        let here = Instant::new::<EdgeEdge, _>(&sample.moving, t);
        let side = (x[26].abs() * 4.0) as usize % 4;
        let spot = EdgeEdge::nearest_on_sides(&here.gram)
            .into_iter()
            .nth(side)?;
        let here = here.at_spot(spot);
        let nearness =
            sample
                .moving
                .nearness_at_boundary::<EdgeEdge>(&sample.positions, &here, t, while_)?;
        if !nearness.error.is_finite() {
            return None;
        }
        let mut count = counts.get();
        count[usize::from(nearness.error > 0.0)] += 1;
        counts.set(count);
        Some(nearness.claims::<EdgeEdge>(&sample, &spot, t, while_))
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 27];
        x[..24].copy_from_slice(&nearly_parallel(random));
        x[24] = random.unit();
        x[25] = random.unit() * 2f64.powi(-random.whole(10, 80));
        x[26] = random.unit();
        x
    };
    let worst = search(1).worst(start, claims);
    println!(
        "thick: nearest places of nearly parallel edges {worst:?}, {:?}",
        counts.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 1e-3));
    assert!(counts.get().iter().all(|&count| count > 100));
}

#[test]
fn edges_that_are_parallel_once_are_never_said_not_to_be() {
    let random = &mut Random::new(3);
    let mut said = 0;
    for _ in 0..2000 {
        // L is 2 K and turns past it at a time, exactly.
        let whole = |random: &mut Random| f64::from(random.whole(-1000, 1000));
        let k = [0.0; 3].map(|_| whole(random));
        let power = 2f64.powi(-random.whole(0, 30));
        let turn = [0.0; 3].map(|_| whole(random) * power);
        let parallel_at = f64::from(random.whole(1, 255)) / 256.0;
        let edge = |t: f64| [0, 1, 2].map(|i: usize| 2.0 * k[i] + (t - parallel_at) * turn[i]);
        let far = [0.0; 3].map(|_| whole(random));
        let end = |edge: [f64; 3]| [0, 1, 2].map(|i: usize| far[i] + edge[i]);
        let coordinates = [
            [0.0; 3],
            k,
            far,
            end(edge(0.0)),
            [0.0; 3],
            k,
            far,
            end(edge(1.0)),
        ];
        let sample = Sample::new::<EdgeEdge>(coordinates.as_flattened(), 1.0);
        let is_said = |t: f64, while_: f64| {
            let here = Instant::new::<EdgeEdge, _>(&sample.moving, t);
            let edges = edges_at::<EdgeEdge>(&sample.positions.points(), t);
            let (reaches, _) = sample.moving.reaches();
            is_never_parallel(&edges, &here, &reaches, while_)
        };
        let before = 2f64.powi(-random.whole(9, 50));
        assert!(!is_said(parallel_at, 0.0));
        assert!(!is_said(parallel_at - before, before));
        assert!(!is_said(parallel_at - before, 2.0 * before));
        said += u32::from(is_said(parallel_at - before, 0.5 * before));
    }
    assert!(said > 1400, "{said}");
}
