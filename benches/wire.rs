//! A step of the wire stepper against the number of segments: whole, and by phase.
//!
//! `cargo bench --bench wire`. A steel wire sags between two pins and swings. Before each number, the mean
//! time by phase and segment, so that growth shows.

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::wire::{Phases, World};

#[path = "data/span.rs"]
mod span;

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    for segments in span::SEGMENTS {
        let world = span::world(segments);
        println!("\n{segments} segments: {}", phases(world.clone()));
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

/// Mean time by phase and segment over some steps.
fn phases(mut world: World) -> String {
    const STEPS: usize = 20;
    let mut sum = [0.0; 7];
    for _ in 0..STEPS {
        let record = world.step(&[]).expect("a step that can be done");
        let Phases {
            assembly,
            factor,
            solve,
            contacts,
            collision,
            commit,
            resolution,
        } = record.phases;
        let phases = [
            assembly, factor, solve, contacts, collision, commit, resolution,
        ];
        for (sum, phase) in sum.iter_mut().zip(phases) {
            *sum += phase;
        }
    }
    let segments = world.wires()[0].segments().len();
    let names = [
        "assembly",
        "factor",
        "solve",
        "contacts",
        "collision",
        "commit",
        "resolution",
    ];
    let text = names.iter().zip(sum).map(|(name, seconds)| {
        let each = seconds / (STEPS * segments) as f64;
        format!("{name} {:.0} ns", each * 1e9)
    });
    format!("{} per segment", text.collect::<Vec<_>>().join(", "))
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = bench
}
criterion_main!(benches);
