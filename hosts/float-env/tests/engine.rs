//! The engine outside of its preconditions: every question ends, and none panics, in every rounding
//! mode and with subnormal numbers flushed to zero. Answers may be wrong there.
//!
//! `cargo test --release -p tunnelproof-float-env --test engine`; `TUNNELPROOF_QUERIES` sets the
//! number of queries of each family. Without `--release` the engine's own check of its environment
//! would panic.
#![cfg(all(
    not(debug_assertions),
    any(
        target_arch = "x86_64",
        all(target_arch = "x86", target_feature = "sse2"),
        target_arch = "aarch64"
    )
))]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use tunnelproof::mesh::Mesh;
use tunnelproof::{
    Batch, Clearance, EdgeEdge, Kind, Query, VertexFace, advance, decide, decide_discrete,
    decide_exactly, environment,
};
use tunnelproof_float_env::Control;
use tunnelproof_reference::generate;

/// MXCSR with all exceptions masked: a rounding mode, FTZ and DAZ.
#[cfg(not(target_arch = "aarch64"))]
const SETTINGS: [(&str, u64); 8] = [
    ("downward", 0x3f80),
    ("upward", 0x5f80),
    ("toward zero", 0x7f80),
    ("flush to zero", 0x9f80),
    ("denormals are zero", 0x1fc0),
    ("both", 0x9fc0),
    ("both and downward", 0xbfc0),
    ("both and upward", 0xdfc0),
];

/// FPCR: a rounding mode, and flush-to-zero.
#[cfg(target_arch = "aarch64")]
const SETTINGS: [(&str, u64); 6] = [
    ("upward", 1 << 22),
    ("downward", 2 << 22),
    ("toward zero", 3 << 22),
    ("flush to zero", 1 << 24),
    ("flush to zero and upward", 5 << 22),
    ("flush to zero and downward", 6 << 22),
];

/// How long a query may take at most, many times what the slowest one takes.
const PATIENCE: Duration = Duration::from_secs(30);

fn number(name: &str, usual: usize) -> usize {
    std::env::var(name).map_or(usual, |text| text.parse().unwrap())
}

/// A seed of its own for each run, if it is asked for.
fn seed() -> u64 {
    number("TUNNELPROOF_SEED", 24) as u64
}

/// What is to be asked, and how many questions were begun.
struct Work {
    queries: Vec<Query>,
    done: AtomicUsize,
}

/// Whether a query touches, and when, in the bits of the answer.
fn toi<K: Kind>(query: &K) -> u64 {
    decide(query).map_or(u64::MAX, |hit| hit.toi.to_bits())
}

/// All questions about one query.
fn ask<K: Kind>(query: &K) -> u64 {
    let answer = toi(query);
    if let Some(hit) = decide(query) {
        std::hint::black_box((hit.points(query), hit.normal(query), hit.contact(query)));
    }
    std::hint::black_box(decide_exactly(query));
    for clearance in [
        Clearance::None,
        Clearance::Distance(1e-3),
        Clearance::Share(0.5),
    ] {
        std::hint::black_box(advance(query, clearance).ok());
    }
    answer
}

/// Asks about all queries, one by one, in a batch and as meshes.
#[inline(never)]
fn ask_all(work: &Work, answers: &mut [u64]) {
    for (answer, query) in answers.iter_mut().zip(&work.queries) {
        work.done.fetch_add(1, Ordering::Relaxed);
        *answer = match query {
            Query::EdgeEdge(query) => {
                std::hint::black_box(decide_discrete(query));
                ask(query)
            }
            Query::VertexFace(query) => ask(query),
        };
    }
    let mut edges = Batch::<EdgeEdge>::new();
    let mut faces = Batch::<VertexFace>::new();
    for query in &work.queries {
        match query {
            Query::EdgeEdge(query) => edges.push(query),
            Query::VertexFace(query) => faces.push(query),
        }
    }
    std::hint::black_box((edges.decide(), faces.decide()));
    let pair = Mesh::new(4, &[[0, 1], [2, 3]], &[]).unwrap();
    let face = Mesh::new(4, &[], &[[1, 2, 3]]).unwrap();
    for query in &work.queries {
        work.done.fetch_add(1, Ordering::Relaxed);
        let mesh = match query {
            Query::EdgeEdge(_) => &pair,
            Query::VertexFace(_) => &face,
        };
        let of = |points: &[tunnelproof::Point; 4]| points.map(<[f64; 3]>::from);
        let (start, end) = (of(query.start()), of(query.end()));
        let thickness = query.radius().rounded();
        std::hint::black_box(mesh.step(&start, &end, thickness).ok());
        std::hint::black_box(mesh.all_contacts(&start, &end, thickness).ok());
    }
}

#[inline(never)]
fn check(is_refused: &mut bool) {
    *is_refused = environment::check().is_err();
}

/// Runs in an environment.
fn within(control: Control, run: impl FnOnce()) {
    // SAFETY: what runs is called as a host in another language would call it, and so through
    // functions that are not inlined; that its answers may be wrong is what is tested.
    unsafe { control.set() };
    run();
    // SAFETY: it is the default.
    unsafe { Control::DEFAULT.set() };
}

/// Asks about queries in all environments; in how many answers each differs from the default one.
fn asked_everywhere(source: &str, queries: &[Query]) -> Vec<usize> {
    let new_work = || Work {
        queries: queries.to_vec(),
        done: AtomicUsize::new(0),
    };
    let mut expected = vec![0; queries.len()];
    ask_all(&new_work(), &mut expected);
    let settings = SETTINGS.iter().map(|&(name, bits)| {
        let (send, receive) = mpsc::channel();
        let work = Arc::new(new_work());
        let at = work.clone();
        thread::spawn(move || {
            let mut answers = vec![0; work.queries.len()];
            within(Control::from_bits(bits), || ask_all(&work, &mut answers));
            send.send(answers).ok();
        });
        let mut last = usize::MAX;
        let answers = loop {
            match receive.recv_timeout(PATIENCE) {
                Ok(answers) => break answers,
                Err(RecvTimeoutError::Timeout) => {
                    let done = at.done.load(Ordering::Relaxed);
                    assert_ne!(last, done, "{source} hangs at question {done}: {name}");
                    last = done;
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let done = at.done.load(Ordering::Relaxed);
                    panic!("{source} panics at question {done}: {name}");
                }
            }
        };
        let differ = answers.iter().zip(&expected).filter(|(a, b)| a != b);
        differ.count()
    });
    settings.collect()
}

/// Queries that have taken longest where the rounding is another one: family, seed and index.
const SLOWEST: [(&str, u64, u64); 1] = [("thick_scales", 7, 286)];

#[test]
fn slowest_queries_end() {
    for (family, seed, index) in SLOWEST {
        let query = generate::by_name(family).unwrap().query(seed, index);
        asked_everywhere(family, &[query]);
    }
}

#[test]
fn every_question_ends_in_every_environment() {
    let count = number("TUNNELPROOF_QUERIES", 50) as u64;
    for family in generate::all() {
        let queries: Vec<Query> = (0..count).map(|i| family.query(seed(), i)).collect();
        let differ = asked_everywhere(family.name(), &queries);
        println!(
            "{:24} {count} queries, other answers: {differ:?}",
            family.name()
        );
    }
}

#[test]
fn the_check_refuses_every_other_environment() {
    assert_eq!(environment::check(), Ok(()));
    for (name, bits) in SETTINGS {
        let mut is_refused = false;
        within(Control::from_bits(bits), || check(&mut is_refused));
        assert!(is_refused, "{name}");
    }
}
