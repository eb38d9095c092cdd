//! Instructions per query by callgrind: a count that repeats exactly, whatever else the machine does.
//!
//! `cargo bench --bench instructions`, where `valgrind` is present; elsewhere it says so and ends. Each
//! method runs over each set under `valgrind --tool=callgrind`, and once more without doing anything, to
//! take off what reading the queries costs.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a measurement that goes wrong ends by panicking"
)]

use std::env;
use std::hint::black_box;
use std::process::Command;

use tunnelproof::additive::Additive;
use tunnelproof::certified::{self, Batch};
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::EdgeEdge;
use tunnelproof::thesis::Thesis;

mod data;

const METHODS: [&str; 4] = ["thesis", "additive", "certified", "certified-batch"];

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let [run, set, method] = arguments.as_slice()
        && run == "run"
    {
        work(set, method);
        return;
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not here: no instructions counted");
        return;
    }
    println!("instructions per query");
    println!(
        "{:<24}{:>10}{}",
        "set",
        "queries",
        METHODS.map(|m| format!("{m:>17}")).concat()
    );
    for (set, queries) in data::sets() {
        let idle = instructions(set, "none");
        let idle_batch = instructions(set, "none-batch");
        let cells = METHODS.map(|method| {
            let base = if method.ends_with("batch") {
                idle_batch
            } else {
                idle
            };
            let each = (instructions(set, method) - base) / queries.len() as u64;
            format!("{each:>17}")
        });
        println!("{set:<24}{:>10}{}", queries.len(), cells.concat());
    }
}

/// The instructions of one run over a set, all included.
fn instructions(set: &str, method: &str) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(env::current_exe().unwrap())
        .args(["run", set, method])
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stderr);
    let count = report
        .lines()
        .find_map(|line| line.split("Collected : ").nth(1))
        .unwrap_or_else(|| panic!("callgrind says no count: {report}"));
    count.trim().parse().unwrap()
}

fn work(set: &str, method: &str) {
    let queries = data::set(set).unwrap();
    let each = |answer: &dyn Fn(&EdgeEdge)| queries.iter().for_each(answer);
    let batch = || {
        let mut batch = Batch::new();
        for query in &queries {
            batch.push(query).unwrap();
        }
        batch
    };
    match method {
        "none" => {}
        "none-batch" => consume(batch()),
        "thesis" => each(&|query| consume(Thesis::default().edge_edge(query))),
        "additive" => each(&|query| consume(Additive::default().edge_edge(query))),
        "certified" => each(&|query| consume(certified::decide(query))),
        "certified-batch" => batch().decide(|_, hit| consume(hit)),
        _ => panic!("no such method: {method}"),
    }
}

fn consume<T>(value: T) {
    black_box(value);
}
