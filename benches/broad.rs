//! The broad phases side by side: a step of scenes of 10 to 10,000 segments, setting all boxes
//! included. Before each, how many pairs need a test in its fifth step.
//!
//! `cargo bench --bench broad`; instructions instead of time: `cargo bench --bench instructions`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

mod scenes;

use scenes::{METHODS, Run, SCENES, SIZES};

fn bench(c: &mut Criterion) {
    for (name, scene) in SCENES {
        let mut group = c.benchmark_group(format!("broad/{name}"));
        for count in SIZES {
            group.throughput(Throughput::Elements(count as u64));
            for method in METHODS {
                let mut run = Run::new(scene(count), method);
                let pairs = (0..5).map(|_| run.step()).last().unwrap_or(0);
                println!("\n{pairs} pairs");
                let id = BenchmarkId::new(method.0, count);
                group.bench_function(id, |b| b.iter(|| run.step()));
            }
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = bench
}
criterion_main!(benches);
