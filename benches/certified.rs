//! The narrow phases side by side, in one run: reading the input alone, the thesis path, additive
//! CCD, the certified path one by one, in batch, and of pairs by index. Before each set, the share of
//! its queries that each stage of the certified path decides.
//!
//! `cargo bench --bench certified`. The public sets are measured where `../shared/data` is present;
//! the generated ones always; last, each family alone. The mean of a query is the time of a set over
//! its queries.

use std::collections::BTreeMap;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tunnelproof::additive::Additive;
use tunnelproof::certified::{self, Batch, Pairs, Stage};
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::{EdgeEdge, Query, Radius};
use tunnelproof::thesis::Thesis;
use tunnelproof_reference::generate::{FAMILIES, OTHER_KINDS};

mod data;
#[path = "data/faces.rs"]
mod faces;

fn bench(c: &mut Criterion) {
    for (name, queries) in data::sets().chain(data::others()) {
        println!(
            "\n{name}: {} queries, decided by {}",
            queries.len(),
            shares(&queries)
        );
        let mut batch = Batch::new();
        for query in &queries {
            batch.push(query);
        }
        let mut group = c.benchmark_group(format!("narrow/{name}"));
        group.throughput(Throughput::Elements(queries.len() as u64));
        let each =
            |work: fn(&EdgeEdge)| move |queries: &Vec<EdgeEdge>| queries.iter().for_each(work);
        for (method, work) in [
            ("read", each(read)),
            ("thesis", each(|query| answer(&Thesis::default(), query))),
            (
                "additive",
                each(|query| answer(&Additive::default(), query)),
            ),
            (
                "certified",
                each(|query| consume(certified::decide(black_box(query)))),
            ),
        ] {
            group.bench_with_input(
                BenchmarkId::from_parameter(method),
                &queries,
                |b, queries| {
                    b.iter(|| work(queries));
                },
            );
        }
        group.bench_function("certified-batch", |b| {
            b.iter(|| batch.decide_observed(|_, hit| consume(hit), |_| {}));
        });
        let points = Points::of(&queries);
        let pairs = points.pairs();
        group.bench_function("certified-pairs", |b| b.iter(|| consume(pairs.decide())));
        group.finish();
    }
}

/// With a radius, beside additive CCD with the same minimum separation.
fn bench_thick(c: &mut Criterion) {
    for (name, queries) in data::thick_sets().chain(data::thick_others()) {
        let count = queries.len();
        println!(
            "\nthick-{name}: {count} queries, decided by {}",
            shares(&queries)
        );
        let mut group = c.benchmark_group(format!("narrow/thick-{name}"));
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function("additive", |b| {
            b.iter(|| {
                for query in &queries {
                    answer(&Additive::default(), query);
                }
            });
        });
        group.bench_function("certified", |b| {
            b.iter(|| {
                for query in &queries {
                    consume(certified::decide(black_box(query)));
                }
            });
        });
        let mut batch = Batch::new();
        queries.iter().for_each(|query| batch.push(query));
        group.bench_function("certified-batch", |b| {
            b.iter(|| batch.decide_observed(|_, hit| consume(hit), |_| {}));
        });
        let points = Points::of(&queries);
        let pairs = points.pairs();
        group.bench_function("certified-pairs", |b| b.iter(|| consume(pairs.decide())));
        group.finish();
    }
}

/// Queries as pairs of points. Points that move alike are one, as in the mesh that they come from.
struct Points {
    start: Vec<[f64; 3]>,
    end: Vec<[f64; 3]>,
    indices: Vec<[u32; 4]>,
    radii: Vec<Radius>,
}

impl Points {
    fn of(queries: &[EdgeEdge]) -> Self {
        let (mut start, mut end) = (Vec::new(), Vec::new());
        let mut places = BTreeMap::new();
        let mut place = |query: &EdgeEdge, corner: usize| {
            let ends = [query.start()[corner], query.end()[corner]].map(<[f64; 3]>::from);
            *places
                .entry(ends.map(|point| point.map(f64::to_bits)))
                .or_insert_with(|| {
                    start.push(ends[0]);
                    end.push(ends[1]);
                    start.len() as u32 - 1
                })
        };
        let indices = queries.iter();
        let indices = indices.map(|query| [0, 1, 2, 3].map(|corner| place(query, corner)));
        Points {
            indices: indices.collect(),
            radii: queries.iter().map(EdgeEdge::radius).collect(),
            start,
            end,
        }
    }

    fn pairs(&self) -> Pairs<'_, EdgeEdge> {
        Pairs::with_radii(&self.start, &self.end, &self.indices, &self.radii).expect("pairs")
    }
}

fn bench_vertex_face(c: &mut Criterion) {
    for (name, queries) in data::vertex_face_sets()
        .into_iter()
        .chain(faces::of_a_sheet())
    {
        let mut batch = Batch::new();
        for query in &queries {
            batch.push(query);
        }
        let mut group = c.benchmark_group(format!("narrow/vertex-face-{name}"));
        group.throughput(Throughput::Elements(queries.len() as u64));
        group.bench_function("additive", |b| {
            b.iter(|| {
                for query in &queries {
                    consume(Additive::default().vertex_face_toi(black_box(query)));
                }
            });
        });
        group.bench_function("certified", |b| {
            b.iter(|| {
                for query in &queries {
                    consume(certified::decide(black_box(query)));
                }
            });
        });
        group.bench_function("certified-batch", |b| {
            b.iter(|| batch.decide_observed(|_, hit| consume(hit), |_| {}));
        });
        group.finish();
    }
}

/// Each family of queries, of which most are made of what is hard to decide, one by one.
fn bench_families(c: &mut Criterion) {
    const COUNT: u64 = 2000;
    let mut group = c.benchmark_group("narrow/families");
    group.throughput(Throughput::Elements(COUNT));
    for family in FAMILIES.iter().chain(OTHER_KINDS) {
        let queries: Vec<Query> = (0..COUNT).map(|index| family.query(1, index)).collect();
        group.bench_function(family.name(), |b| {
            b.iter(|| {
                for query in &queries {
                    match query {
                        Query::EdgeEdge(query) => consume(certified::decide(black_box(query))),
                        Query::VertexFace(query) => consume(certified::decide(black_box(query))),
                    }
                }
            });
        });
    }
    group.finish();
}

/// The floor: every coordinate is read, nothing is decided.
fn read(query: &EdgeEdge) {
    let points = query.start().iter().chain(query.end());
    black_box(points.map(|point| point.x + point.y + point.z).sum::<f64>());
}

fn answer(method: &impl NarrowPhase, query: &EdgeEdge) {
    consume(method.edge_edge(black_box(query)));
}

fn consume<T>(value: T) {
    black_box(value);
}

fn shares(queries: &[EdgeEdge]) -> String {
    let mut counts: BTreeMap<Stage, usize> = BTreeMap::new();
    for query in queries {
        let mut observe = |stage| *counts.entry(stage).or_default() += 1;
        consume(certified::decide_observed(query, &mut observe));
    }
    let share = |(stage, count): (Stage, usize)| {
        format!(
            "{} {:.2}%",
            stage.name(),
            100.0 * count as f64 / queries.len() as f64
        )
    };
    counts.into_iter().map(share).collect::<Vec<_>>().join(", ")
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = bench, bench_thick, bench_vertex_face, bench_families
}
criterion_main!(benches);
