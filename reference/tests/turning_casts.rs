//! Bodies that are cast and turn: what the bench permits for another clock is enough.

use std::fs;

use tunnelproof::rigid::{RigidMotion, RigidQuery, Side};
use tunnelproof_reference::generate::{RigidFamily, TURNING_CAST_FAMILIES};

/// By how many metres the motion is beside one at a constant rate, at most: the angles differ by so much at
/// samples of the step, times the distance of a point from the centre.
fn beside_a_constant_rate(query: &RigidQuery) -> f64 {
    let beside = query.sides().map(|side| match side {
        Side::Turning { local, motion } => {
            let reach = local.iter().map(|point| point.coords.norm());
            angle_between_clocks(motion) * reach.fold(0.0, f64::max)
        }
        // None of these: then it is farther off than anything that is permitted.
        Side::Straight { .. } => f64::INFINITY,
    });
    beside.iter().sum()
}

fn angle_between_clocks(motion: &RigidMotion) -> f64 {
    let whole = motion.degrees().to_radians();
    let [start, end] = motion.quaternions();
    let angle = |t: f64| {
        let q: Vec<f64> = (0..4).map(|i| (1.0 - t) * start[i] + t * end[i]).collect();
        let along: f64 = q.iter().zip(&start).map(|(x, y)| x * y).sum();
        let sizes = [&q[..], &start[..]].map(|q| q.iter().map(|x| x * x).sum::<f64>().sqrt());
        2.0 * (along / (sizes[0] * sizes[1])).min(1.0).acos()
    };
    let samples = (0..=64).map(|i| f64::from(i) / 64.0);
    samples.fold(0.0, |most: f64, t| most.max((angle(t) - whole * t).abs()))
}

/// What `peers/run` has for a family, in metres.
fn permitted(family: &RigidFamily) -> f64 {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../peers/run");
    let text = fs::read_to_string(path).expect("the bench is there");
    let name = format!("    \"{}\": ", family.name());
    let line = text.lines().find_map(|line| line.strip_prefix(&name));
    let value = line.and_then(|value| value.strip_suffix(','));
    value
        .and_then(|value| value.parse().ok())
        .expect("a number")
}

#[test]
fn turning_cast_families_are_within_what_the_bench_permits() {
    for family in TURNING_CAST_FAMILIES {
        let queries = (0..7000).map(|index| family.query(1, index));
        let most = queries
            .map(|query| beside_a_constant_rate(&query))
            .fold(0.0, f64::max);
        let permitted = permitted(family);
        println!("{}: {most:.5} of {permitted}", family.name());
        assert!(most < permitted, "{}: {most} {permitted}", family.name());
        // Not much more than is needed: it hides what is wrong.
        assert!(
            most > permitted / 6.0,
            "{}: {most} {permitted}",
            family.name()
        );
    }
}
