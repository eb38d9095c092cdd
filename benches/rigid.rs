//! Bodies that turn: the certified path beside the linear query of the chords and conservative
//! advancement, on pairs of a scene of wires and boxes, of up to 5, 30 and 90 degrees in a step.
//!
//! `cargo bench --bench rigid`. The mean of a query is the time of a set over its queries. The sets
//! are the pairs that do not touch, as nearly all are that a broad phase delivers, all pairs, and
//! both again with a radius of 1 mm. Those that touch are asked with the contact normal and without.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::rigid::EdgeTurningEdge;
use tunnelproof::{EdgeEdge, decide, decide_rigid};

#[path = "data/advancement.rs"]
mod advancement;
#[path = "data/bodies.rs"]
mod bodies;
#[path = "data/boxes.rs"]
mod boxes;

fn bench(c: &mut Criterion) {
    for degrees in [5.0, 30.0, 89.0] {
        let pairs = bodies::pairs(degrees);
        for radius in [0.0, 1e-3] {
            let all: Vec<_> = pairs
                .iter()
                .map(|query| with_radius(query, radius))
                .collect();
            let (hits, misses): (Vec<_>, Vec<_>) = all
                .iter()
                .copied()
                .partition(|query| decide_rigid(query).is_some());
            let name = format!("rigid/{degrees}-degrees-radius-{radius}");
            println!(
                "\n{name}: {} pairs, {} of them touch",
                all.len(),
                hits.len()
            );
            measure(c, &format!("{name}/misses"), &misses);
            measure(c, &format!("{name}/all"), &all);
            measure_normals(c, &format!("{name}/hits"), &hits);
        }
    }
}

fn measure(c: &mut Criterion, name: &str, queries: &[EdgeTurningEdge]) {
    let chords: Vec<_> = queries.iter().map(chord).collect();
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function("linear", |b| {
        b.iter(|| {
            chords
                .iter()
                .for_each(|query| consume(decide(black_box(query))))
        });
    });
    group.bench_function("certified", |b| {
        b.iter(|| {
            let mut queries = queries.iter();
            queries
                .by_ref()
                .for_each(|query| consume(decide_rigid(black_box(query))));
        });
    });
    group.bench_function("conservative-advancement", |b| {
        b.iter(|| {
            let mut queries = queries.iter();
            queries
                .by_ref()
                .for_each(|query| consume(advancement::toi(black_box(query))));
        });
    });
    group.finish();
}

fn measure_normals(c: &mut Criterion, name: &str, queries: &[EdgeTurningEdge]) {
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function("certified", |b| {
        b.iter(|| {
            queries
                .iter()
                .for_each(|query| consume(decide_rigid(black_box(query))))
        });
    });
    group.bench_function("certified-with-normal", |b| {
        b.iter(|| {
            queries.iter().for_each(|query| {
                consume(decide_rigid(black_box(query)).map(|hit| hit.normal(query)));
            });
        });
    });
    group.finish();
}

fn with_radius(query: &EdgeTurningEdge, radius: f64) -> EdgeTurningEdge {
    let (start, end, local) = (*query.start(), *query.end(), *query.local());
    EdgeTurningEdge::with_radius(start, end, local, *query.motion(), radius).expect("finite")
}

fn chord(query: &EdgeTurningEdge) -> EdgeEdge {
    let (start, end) = (query.positions(0.0), query.positions(1.0));
    EdgeEdge::new(start, end, query.radius()).expect("finite")
}

fn consume<T>(value: T) {
    black_box(value);
}

fn short() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_secs(1))
}

criterion_group! { name = benches; config = short(); targets = bench }
criterion_main!(benches);
