use std::cell::Cell;

use super::super::testing::{Sample, search};
use super::*;
use crate::certified::testing::{Claim, Number, Random, dot as exact_dot, points_and_direction};
use crate::query::{EdgeEdge, VertexFace};

fn directions_are_proved<K: Stages>(seed: u64, side: &[usize]) {
    let parts = Cell::new(0);
    let claims = |x: &[f64; 28]| {
        let (n, radius) = ([x[24], x[25], x[26]], x[27].abs());
        let sample = Sample::new::<K>(&x[..24], radius);
        let until = sample.moving.stays_apart_by::<K>(&n);
        if until <= 0.0 {
            return None;
        }
        parts.set(parts.get() + u32::from(until < 1.0));
        let n = n.map(Number::from);
        let claim = |t: f64| {
            let least = sample.least_corner::<K>(&Number::from(t), &n);
            assert!(least.sign().is_gt());
            let reach = &Number::from(radius) * &Number::from(radius);
            Claim {
                error: &reach * &exact_dot(&n, &n),
                bound: &least * &least,
            }
        };
        Some([claim(0.0), claim(until.min(1.0))])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 28];
        x[..27].copy_from_slice(&points_and_direction(random, side));
        x[27] = x[0] * random.unit();
        x
    };
    let worst = search(seed).worst(start, claims);
    println!(
        "thick: directions {worst:?}, {} for a part of the step",
        parts.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 0.999) && parts.get() > 100);
}

#[test]
fn thick_directions_separate_edges_as_long_as_they_say() {
    directions_are_proved::<EdgeEdge>(1, &[0, 1]);
}

#[test]
fn thick_directions_separate_a_face_as_long_as_they_say() {
    directions_are_proved::<VertexFace>(2, &[0]);
}
