//! The speed of the exact judges. Of the oracle: the whole decision with the time of impact to the
//! last bit, and the answer with every number rounded both ways. Of the shadow: the answer.
//!
//! `cargo bench --bench oracle` runs the default backend; add `--features gmp` for GMP. The public
//! sets are measured where `../shared/data` is present; the generated ones always.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof::thesis::Repairs;
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::{oracle, shadow};

mod data;

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group(format!("oracle/{}", <field::Default as Integer>::BACKEND));
    let edges = data::sets().map(|(name, queries)| {
        let queries = queries.into_iter().map(Query::EdgeEdge);
        (name.to_owned(), queries.collect())
    });
    let faces = data::vertex_face_sets().into_iter().map(|(name, queries)| {
        let queries = queries.into_iter().map(Query::VertexFace);
        (format!("vertex-face-{name}"), queries.collect())
    });
    for (name, queries) in edges.chain(faces) {
        let queries: Vec<Query> = queries;
        group.throughput(Throughput::Elements(queries.len() as u64));
        group.bench_with_input(BenchmarkId::new("toi", &name), &queries, |b, queries| {
            b.iter(|| queries.iter().for_each(decide_toi));
        });
        group.bench_with_input(BenchmarkId::new("answer", &name), &queries, |b, queries| {
            b.iter(|| queries.iter().for_each(decide_all));
        });
    }
    group.finish();
    let mut group = c.benchmark_group(format!("shadow/{}", <field::Default as Integer>::BACKEND));
    for (name, queries) in data::sets() {
        group.throughput(Throughput::Elements(queries.len() as u64));
        group.bench_with_input(BenchmarkId::new("answer", name), &queries, |b, queries| {
            b.iter(|| queries.iter().for_each(answer_by_shadow));
        });
    }
    group.finish();
}

fn answer_by_shadow(query: &EdgeEdge) {
    black_box(shadow::edge_edge::<field::Default>(query, Repairs::ALL));
}

fn decide_toi(query: &Query) {
    let decision = oracle::decide::<field::Default>(query);
    black_box(decision.toi().map(|toi| toi.enclosure()));
}

fn decide_all(query: &Query) {
    black_box(oracle::decide::<field::Default>(query).written());
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = bench
}
criterion_main!(benches);
