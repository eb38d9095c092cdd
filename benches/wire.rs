//! A step of the wire stepper against the number of segments: whole, and by phase.
//!
//! `cargo bench --bench wire`. A steel wire sags between two pins and swings; wires rest on a deck
//! and on each other. Before each number, the mean time by phase and segment, so that growth shows.

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::wire::{Phases, StepRecord, World};

#[path = "data/crossed.rs"]
mod crossed;
#[path = "data/span.rs"]
mod span;

/// Without contacts.
fn swing(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    for segments in span::SEGMENTS {
        let world = span::world(segments);
        let mut other = world.clone();
        let step = || other.step(&[]).expect("a step that can be done");
        println!("\n{segments} segments: {}", phases(segments, step));
        group.throughput(Throughput::Elements(segments as u64));
        let id = BenchmarkId::from_parameter(segments);
        group.bench_function(id, |b| {
            let start = || world.clone();
            let step = |mut world: World| {
                black_box(world.step(&[]).expect("a step that can be done"));
                world
            };
            b.iter_batched(start, step, BatchSize::LargeInput);
        });
    }
    group.finish();
}

/// With contacts in proportion to the segments.
fn rest(c: &mut Criterion) {
    let mut group = c.benchmark_group("step-with-contacts");
    for segments in span::SEGMENTS {
        let (mut world, mut collisions) = crossed::world(segments);
        let mut step = || {
            let record = world.step_colliding(&mut collisions, &[]);
            record.expect("a step that can be done")
        };
        let contacts = step().contacts.len();
        let phases = phases(segments, &mut step);
        println!("\n{segments} segments, {contacts} contacts: {phases}");
        group.throughput(Throughput::Elements(segments as u64));
        let id = BenchmarkId::from_parameter(segments);
        group.bench_function(id, |b| b.iter(|| black_box(step())));
    }
    group.finish();
}

/// Mean time by phase and segment over some steps.
fn phases(segments: usize, mut step: impl FnMut() -> StepRecord) -> String {
    const STEPS: usize = 20;
    let names = [
        "assembly",
        "factor",
        "solve",
        "contacts",
        "broad",
        "narrow",
        "commit",
        "resolution",
    ];
    let mut sum = [0.0; 8];
    for _ in 0..STEPS {
        let Phases {
            assembly,
            factor,
            solve,
            contacts,
            broad,
            narrow,
            commit,
            resolution,
        } = step().phases;
        let phases = [
            assembly, factor, solve, contacts, broad, narrow, commit, resolution,
        ];
        for (sum, phase) in sum.iter_mut().zip(phases) {
            *sum += phase;
        }
    }
    let text = names.iter().zip(sum).map(|(name, seconds)| {
        let each = seconds / (STEPS * segments) as f64;
        format!("{name} {:.0} ns", each * 1e9)
    });
    format!("{} per segment", text.collect::<Vec<_>>().join(", "))
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = swing, rest
}
criterion_main!(benches);
