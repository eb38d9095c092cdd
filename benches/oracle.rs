//! The speed of the exact oracle: the whole decision with the time of impact to the last bit, and
//! the answer with every number rounded both ways.
//!
//! `cargo bench --bench oracle` runs the default backend; add `--features gmp` for GMP. The public
//! sets are measured where `../shared/data` is present; the generated ones always.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::oracle;

mod data;

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group(format!("oracle/{}", <field::Default as Integer>::BACKEND));
    for (name, queries) in data::sets() {
        group.throughput(Throughput::Elements(queries.len() as u64));
        group.bench_with_input(BenchmarkId::new("toi", name), &queries, |b, queries| {
            b.iter(|| queries.iter().for_each(decide_toi));
        });
        group.bench_with_input(BenchmarkId::new("answer", name), &queries, |b, queries| {
            b.iter(|| queries.iter().for_each(decide_all));
        });
    }
    group.finish();
}

fn decide_toi(query: &EdgeEdge) {
    let decision = oracle::decide::<field::Default>(&Query::EdgeEdge(*query));
    black_box(decision.toi().map(|toi| toi.enclosure()));
}

fn decide_all(query: &EdgeEdge) {
    black_box(oracle::decide::<field::Default>(&Query::EdgeEdge(*query)).written());
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = bench
}
criterion_main!(benches);
