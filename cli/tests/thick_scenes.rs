//! Scenes of thick chains: nothing comes within the share of the thickness that is guarded, by the
//! audit, and every step is done.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof::certified::Certified;
use tunnelproof::wire::{Mode, StepRecord};
use tunnelproof_cli::audit::{Audit, Report};
use tunnelproof_cli::scenes::Scene;

/// A scene for so many steps: its last record, and the audit.
fn run(text: &str, steps: u64) -> (StepRecord, Report) {
    let scene = Scene::from_toml(text).unwrap();
    let mut world = scene.world().unwrap();
    let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    let mut audit = Audit::of_world(&world);
    let mut last = StepRecord::default();
    for _ in 0..steps {
        last = world.step_colliding(&mut collisions, &[]).unwrap();
        audit.step(&last);
    }
    (last, audit.finish())
}

#[test]
fn knot_of_chain_is_drawn_tight_keeps_half_of_its_thickness_and_rests() {
    let (last, report) = run(include_str!("../scenes/knot-of-chain.toml"), 300);
    assert!(report.is_exact(), "{report:?}");
    assert_eq!(report.guarded_thickness, 0.5);
    assert!(report.thick_pairs > 0);
    let deepest = report.deepest.unwrap();
    assert!(deepest.low > 0.1 && deepest.high < 0.51, "{deepest:?}");
    // The ends came as far as their script.
    assert!((last.bodies[1].after.position.x - 0.487).abs() < 0.02);
    // It has been at rest for a second.
    let ways = last.wires[0].before.iter().zip(&last.wires[0].after);
    let longest = ways.map(|(before, after)| (after - before).norm());
    let fastest = 60.0 * longest.fold(0.0, f64::max);
    assert!(fastest < 1e-9, "{fastest} m/s");
}

#[test]
fn pile_of_chain_has_half_of_its_thickness_kept_by_the_guard() {
    let (last, report) = run(include_str!("../scenes/pile-of-chain.toml"), 60);
    assert!(report.is_exact(), "{report:?}");
    assert!(report.prevented > 0 && report.thick_pairs > 0);
    let deepest = report.deepest.unwrap();
    assert!(deepest.low > 0.1 && deepest.high < 0.51, "{deepest:?}");
    assert!(last.contacts.len() > 50);
}
