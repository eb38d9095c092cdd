//! Steps of whole meshes: a sheet of cloth, rolled up, that falls and trembles; without thickness
//! and with one.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench mesh` on one thread; all without the variable.
//! `TUNNELPROOF_SIDES=50,100,1600 cargo bench --bench mesh` times sheets of
//! so many vertices on each side instead, and says what a candidate costs.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::hint::black_box;
use std::time::Instant;
use tunnelproof::Mesh;

type Position = [f64; 3];

/// A square sheet of so many vertices on each side, rolled up in turns 7.5 cm apart.
fn rolled_sheet(side: u32) -> (Mesh, Vec<Position>, Vec<Position>) {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let spacing = 1.0 / f64::from(side);
    let mut noise = |size: f64| [(); 3].map(|()| rng.random_range(-0.5..0.5) * size * spacing);
    let (mut start, mut end) = (Vec::new(), Vec::new());
    for i in 0..side {
        for j in 0..side {
            let [x, y] = [i, j].map(|k| f64::from(k) * spacing);
            let angle = 12.0 * x;
            let radius = 0.2 + 0.012 * angle;
            let tremble = noise(0.1);
            let at = [radius * angle.cos(), radius * angle.sin(), y];
            let at = [0, 1, 2].map(|k| at[k] + tremble[k]);
            let tremble = noise(0.3);
            start.push(at);
            end.push([
                0.98 * at[0] + tremble[0],
                at[1] + 0.01 + tremble[1],
                at[2] - 0.5 * spacing + tremble[2],
            ]);
        }
    }
    let mut faces = Vec::new();
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            let [a, b] = [i * side + j, (i + 1) * side + j];
            faces.extend([[a, a + 1, b], [a + 1, b + 1, b]]);
        }
    }
    let mesh = Mesh::new(start.len(), &[], &faces).expect("indices are those of vertices");
    (mesh, start, end)
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
