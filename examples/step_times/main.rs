//! Prints how long the steps of hard scenes take, and what their contacts come to.
//!
//! `cargo run --release --example step_times [SCENE...]`

use std::error::Error;
use std::time::Instant;

use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::wire::{Collisions, Mode, StepRecord};

mod scenes;

use scenes::{SCENES, Scene};

const COLUMNS: [&str; 11] = [
    "scene",
    "steps",
    "segments",
    "contacts, most",
    "median, ms",
    "longest, ms",
    "longest by median",
    "cut short",
    "residual, median, m/s",
    "at the end, m/s",
    "fastest node at the end, m/s",
];

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let of_all = wanted.is_empty();
    for name in &wanted {
        if !SCENES.iter().any(|scene| scene.name == name) {
            let names: Vec<&str> = SCENES.iter().map(|scene| scene.name).collect();
            return Err(format!("no scene {name:?}; there are {}", names.join(", ")).into());
        }
    }
    println!("| {} |", COLUMNS.join(" | "));
    println!("| --- {}|", "| --: ".repeat(COLUMNS.len() - 1));
    for scene in SCENES {
        if of_all || wanted.iter().any(|name| scene.name == name) {
            println!("{}", row(scene)?);
        }
    }
    Ok(())
}

/// What a step was.
struct Step {
    seconds: f64,
    record: StepRecord,
}

fn row(scene: &Scene) -> Result<String, Box<dyn Error>> {
    let mut world = (scene.make)()?;
    let mut collisions = Collisions::new(Mode::Guard, Method::SweepAndPrune, &Certified);
    if let Some(share) = scene.thickness {
        collisions = collisions.with_guarded_thickness(share)?;
    }
    let mut steps = Vec::new();
    for _ in 0..scene.steps {
        let clock = Instant::now();
        let record = world.step_colliding(&mut collisions, &[])?;
        let seconds = clock.elapsed().as_secs_f64();
        steps.push(Step { seconds, record });
    }
    let solvers = || steps.iter().map(|step| &step.record.solver);
    let times = sorted(steps.iter().map(|step| 1e3 * step.seconds));
    let residuals = sorted(solvers().map(|solver| solver.contact_residual));
    let last = &steps[steps.len() - 1].record;
    let segments = last.wires.iter().map(|wire| wire.tensions.len());
    let contacts = steps.iter().map(|step| step.record.contacts.len());
    let step = world.settings().step;
    let speeds = last.wires.iter().flat_map(|wire| {
        let ends = wire.before.iter().zip(&wire.after);
        ends.map(|(before, after)| (after - before).norm() / step)
    });
    let [median, longest] = [times[times.len() / 2], times[times.len() - 1]];
    Ok(format!(
        "| {} | {} | {} | {} | {:.1} | {:.0} | {:.0} | {} | {:.0e} | {:.0e} | {:.0e} |",
        scene.name,
        steps.len(),
        segments.sum::<usize>(),
        contacts.max().unwrap_or(0),
        median,
        longest,
        longest / median,
        solvers().filter(|solver| solver.cut_short).count(),
        residuals[residuals.len() / 2],
        last.solver.contact_residual,
        speeds.fold(0.0, f64::max),
    ))
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}
