use std::cell::Cell;

use super::super::testing::{Sample, search};
use super::*;
use crate::certified::kind::Stages;
use crate::certified::testing::{Random, points};
use crate::query::{EdgeEdge, VertexFace};

fn nearest_places_are_within_their_bounds<K: Stages>(seed: u64) {
    // Inside, on a side, at a corner.
    let counts = Cell::new([0; 3]);
    let claims = |x: &[f64; 26]| {
        let (t, while_) = (x[24].abs().min(1.0), x[25].abs().min(0.1));
        let sample = Sample::new::<K>(&x[..24], 1.0);
        let here = Instant::new::<K, _>(&sample.moving, t);
        let nearness = sample.moving.nearness::<K>(&here, while_)?;
        if !nearness.error.is_finite() {
            return None;
        }
        let held = here
            .spot
            .directions
            .iter()
            .filter(|direction| !direction.is_free)
            .count();
        let mut count = counts.get();
        count[held] += 1;
        counts.set(count);
        Some(nearness.claims::<K>(&sample, &here.spot, t, while_))
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 26];
        x[..24].copy_from_slice(&points(random, (-100, 100)));
        x[24] = random.unit();
        x[25] = random.unit() * 2f64.powi(-random.whole(0, 80));
        x
    };
    let worst = search(seed).worst(start, claims);
    println!("thick: nearest places {worst:?}, {:?}", counts.get());
    // The bounds take every error for the largest, and add up magnitudes.
    assert!(worst.iter().all(|&ratio| ratio > 1e-3));
    assert!(counts.get().iter().all(|&count| count > 100));
}

#[test]
fn thick_nearest_places_of_edges_are_within_their_bounds() {
    nearest_places_are_within_their_bounds::<EdgeEdge>(1);
}

#[test]
fn thick_nearest_places_in_a_face_are_within_their_bounds() {
    nearest_places_are_within_their_bounds::<VertexFace>(2);
}
