//! The slowest queries that were searched for: what they may take of memory and stack, and that they
//! are answered as the oracle answers them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::thread;

use allocation_counter::measure;
use tunnelproof::certified::{Kind, decide, decide_exactly};
use tunnelproof::contact::{Case, ContactKind, Flags};
use tunnelproof::query::Query;
use tunnelproof_reference::corpus::{self, Entry, ReadOptions};
use tunnelproof_reference::{field, oracle};

/// Bytes of the heap, at most.
const MEMORY: u64 = 1 << 20;

/// Bytes of the stack: as little as embedded hosts give a thread. Frames are larger where nothing
/// is optimised.
const STACK: usize = if cfg!(debug_assertions) { 512 } else { 64 } << 10;

fn queries() -> Vec<Entry> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/worst/queries.jsonl");
    let entries = corpus::open(path, ReadOptions::default()).unwrap();
    entries.map(|entry| entry.unwrap()).collect()
}

fn ask<K: Kind>(query: &K) {
    black_box(decide_exactly(query));
    if let Some(hit) = black_box(decide(query)) {
        black_box(hit.normal(query));
    }
}

fn answer(query: &Query) {
    match query {
        Query::EdgeEdge(query) => ask(query),
        Query::VertexFace(query) => ask(query),
    }
}

#[test]
fn worst_queries_need_no_more_stack_than_64_kb() {
    let queries = queries();
    assert!(queries.len() > 20);
    let all = move || queries.iter().for_each(|entry| answer(&entry.query));
    // An overflow aborts the process.
    let thread = thread::Builder::new().stack_size(STACK).spawn(all);
    thread.unwrap().join().unwrap();
}

#[test]
fn worst_queries_need_no_more_memory_than_1_mb() {
    for Entry { id, query, .. } in queries() {
        let most = measure(|| answer(&query)).bytes_max;
        eprintln!("{id}: {most} bytes");
        assert!(most <= MEMORY, "{id}: {most} bytes");
    }
}

/// The time, and what is exact beside it.
type Exact = (f64, f64, ContactKind, i8, Case, Flags);

fn certified(query: &Query) -> Option<Exact> {
    fn of<K: Kind>(query: &K) -> Option<Exact> {
        let hit = decide_exactly(query)?;
        Some((
            hit.toi,
            hit.toi_above,
            hit.kind,
            hit.side,
            hit.case,
            hit.flags,
        ))
    }
    match query {
        Query::EdgeEdge(query) => of(query),
        Query::VertexFace(query) => of(query),
    }
}

#[test]
fn worst_queries_are_answered_as_the_oracle_does() {
    for Entry { id, query, .. } in queries() {
        let exact = oracle::decide::<field::Default>(&query).written();
        let hit = exact.hit.map(|hit| {
            let toi = hit.toi;
            (
                toi.below, toi.above, hit.kind, hit.side, exact.case, hit.flags,
            )
        });
        assert_eq!(certified(&query), hit, "{id}");
    }
}

/// Every loop of the certified path that is not over a range has a comment that begins with `Ends:` and
/// says why.
#[test]
fn every_loop_of_the_certified_path_says_why_it_ends() {
    fn visit(folder: &Path, loops: &mut usize) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            // What tests compute with.
            if path.ends_with("testing") {
                continue;
            }
            if path.is_dir() {
                visit(&path, loops);
                continue;
            }
            if path.ends_with("tests.rs") {
                continue;
            }
            let source = fs::read_to_string(&path).unwrap();
            let lines: Vec<&str> = source.lines().map(str::trim_start).collect();
            for (at, line) in lines.iter().enumerate() {
                if line.ends_with("loop {") || line.starts_with("while ") {
                    *loops += 1;
                    let above = lines[..at].iter().rev();
                    let comment = above.take_while(|line| line.starts_with("//"));
                    let says = comment.into_iter().any(|line| line.contains("Ends:"));
                    assert!(says, "{}:{}", path.display(), at + 1);
                }
            }
        }
    }
    let mut loops = 0;
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    visit(&root.join("src/certified"), &mut loops);
    assert!(loops > 20, "{loops}");
}
