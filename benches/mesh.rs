//! Steps of whole meshes: a sheet of cloth, rolled up, that falls and trembles; without thickness
//! and with one, in `f64` and in `f32`.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench mesh` on one thread; all without the variable.
//! `TUNNELPROOF_SIDES=50,100,1600 cargo bench --bench mesh` times sheets of
//! so many vertices on each side instead, and says what a candidate costs.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Instant;

#[path = "data/sheet.rs"]
mod sheet;

use sheet::{Position, rolled_sheet};

fn in_f32(positions: &[Position]) -> Vec<[f32; 3]> {
    let single = |position: &Position| position.map(|x| x as f32);
    positions.iter().map(single).collect()
}

fn bench_sheets(c: &mut Criterion) {
    let mut group = c.benchmark_group("mesh");
    for side in [50, 200] {
        let (mesh, start, end) = rolled_sheet(side);
        let finite = "positions are finite, one for each vertex";
        for thickness in [0.0, 0.002] {
            let step = mesh.step(&start, &end, thickness).expect(finite);
            println!("\n{:?} candidates, step {}", step.candidates, step.step);
            let candidates = step.candidates.iter().sum::<usize>();
            group.throughput(Throughput::Elements(candidates as u64));
            let id = |what: &str| BenchmarkId::new(what, format!("{side}x{side}/{thickness}"));
            group.bench_function(id("is-free"), |b| {
                b.iter(|| black_box(mesh.is_free(&start, &end, thickness)));
            });
            group.bench_function(id("first-contact"), |b| {
                b.iter(|| black_box(mesh.first_contact(&start, &end, thickness)));
            });
            group.bench_function(id("step"), |b| {
                b.iter(|| black_box(mesh.step(&start, &end, thickness)));
            });
            let (start, end) = (in_f32(&start), in_f32(&end));
            group.bench_function(id("step-f32"), |b| {
                b.iter(|| black_box(mesh.step(&start, &end, thickness)));
            });
        }
    }
    group.finish();
}

/// The time of a step and of a first contact, the best of three, for sheets of these sizes.
fn scaling(sides: &str) {
    println!("vertices, candidates, first contact, step, step for each candidate");
    for side in sides.split(',') {
        let (mesh, start, end) = rolled_sheet(side.parse().expect("sides are numbers"));
        let best = |ask: &dyn Fn()| {
            let time = || {
                let clock = Instant::now();
                ask();
                clock.elapsed().as_secs_f64()
            };
            (0..3).map(|_| time()).fold(f64::INFINITY, f64::min)
        };
        let step = || mesh.step(&start, &end, 0.0).expect("finite");
        let candidates = step().candidates.iter().sum::<usize>();
        let first = best(&|| {
            let _ = black_box(mesh.first_contact(&start, &end, 0.0));
        });
        let step = best(&|| drop(black_box(step())));
        println!(
            "{}, {candidates}, {:.1} ms, {:.1} ms, {:.0} ns",
            start.len(),
            first * 1e3,
            step * 1e3,
            step * 1e9 / candidates as f64,
        );
    }
}

fn bench(c: &mut Criterion) {
    match std::env::var("TUNNELPROOF_SIDES") {
        Ok(sides) => scaling(&sides),
        Err(_) => bench_sheets(c),
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = bench
}
criterion_main!(benches);
