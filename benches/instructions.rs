//! Instructions per query of the narrow phases, and per segment and step of the broad phases and of
//! the wire stepper, by callgrind: a count that repeats exactly, whatever else the machine does.
//!
//! `cargo bench --bench instructions`, where `valgrind` is present; elsewhere it says so and ends.
//! Each method runs over each set under `valgrind --tool=callgrind`, and once more without doing
//! anything, to take off what reading the queries costs. A broad phase runs for one step, which
//! sorts and fills, and for [`STEPS`] more; a wire is stepped not at all, and for as many.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a measurement that goes wrong ends by panicking"
)]

use std::env;
use std::hint::black_box;
use std::process::Command;

use tunnelproof::additive::Additive;
use tunnelproof::broad::Method;
use tunnelproof::certified::{self, Batch};
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::EdgeEdge;
use tunnelproof::thesis::Thesis;

#[path = "data/crossed.rs"]
mod crossed;
mod data;
mod scenes;
#[path = "data/span.rs"]
mod span;

/// Steps of a broad phase or of a wire that are counted.
const STEPS: usize = 4;

const METHODS: [&str; 4] = ["thesis", "additive", "certified", "certified-batch"];
const THICK_METHODS: [&str; 2] = ["additive", "certified"];
const FACE_METHODS: [&str; 2] = ["certified", "certified-batch"];

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["run", set, method] => return work(&edges(set), method),
        ["run-thick", set, method] => return work(&data::thick(&edges(set)), method),
        ["run-vertex-face", set, method] => return work_vertex_face(set, method),
        ["step", scene, count, method, steps] => {
            return step(
                scene,
                count.parse().unwrap(),
                method,
                steps.parse().unwrap(),
            );
        }
        ["wire", scene, segments, steps] => {
            return step_wire(scene, segments.parse().unwrap(), steps.parse().unwrap());
        }
        _ => {}
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not here: no instructions counted");
        return;
    }
    narrow_phases();
    broad_phases();
    wires();
}

fn narrow_phases() {
    println!("instructions per query of two edges");
    let sets = data::sets().map(|(set, queries)| (set, queries.len()));
    table("run", METHODS, sets);
    println!("\ninstructions per query of two edges with a radius");
    let sets = data::sets().map(|(set, queries)| (set, queries.len()));
    table("run-thick", THICK_METHODS, sets);
    println!("\ninstructions per query of a vertex and a face");
    let sets = data::vertex_face_sets();
    let sets = sets.iter().map(|(set, queries)| (*set, queries.len()));
    table("run-vertex-face", FACE_METHODS, sets);
}

fn table<const N: usize>(
    kind: &str,
    methods: [&str; N],
    sets: impl Iterator<Item = (&'static str, usize)>,
) {
    let head = methods.map(|m| format!("{m:>17}")).concat();
    println!("{:<24}{:>10}{head}", "set", "queries");
    for (set, count) in sets {
        let idle = instructions(&[kind, set, "none"]);
        let idle_batch = instructions(&[kind, set, "none-batch"]);
        let cells = methods.map(|method| {
            let base = if method.ends_with("batch") {
                idle_batch
            } else {
                idle
            };
            let each = (instructions(&[kind, set, method]) - base) / count as u64;
            format!("{each:>17}")
        });
        println!("{set:<24}{count:>10}{}", cells.concat());
    }
}

fn broad_phases() {
    println!("\ninstructions per segment and step, and pairs that need a test in the last step");
    let names = scenes::METHODS.map(|(name, ..)| format!("{name:>26}"));
    println!("{:<8}{:>9}{}", "scene", "segments", names.concat());
    for (name, scene) in scenes::SCENES {
        for count in scenes::SIZES {
            let cells = scenes::METHODS.map(|method| {
                let steps = |steps: usize| {
                    let (count, steps) = (count.to_string(), steps.to_string());
                    instructions(&["step", name, &count, method.0, &steps])
                };
                let each = (steps(1 + STEPS) - steps(1)) / (STEPS * count) as u64;
                let pairs = last_step(scene(count), method, 1 + STEPS);
                format!("{each:>16}{pairs:>10}")
            });
            println!("{name:<8}{count:>9}{}", cells.concat());
        }
    }
}

fn wires() {
    println!("\ninstructions of the wire stepper per segment and step");
    println!("{:>17}{:>17}{:>17}", "", "swing", "contacts");
    for segments in span::SEGMENTS {
        let cells = ["swing", "contacts"].map(|scene| {
            let steps = |steps: usize| {
                let (segments, steps) = (segments.to_string(), steps.to_string());
                instructions(&["wire", scene, &segments, &steps])
            };
            let each = (steps(STEPS) - steps(0)) / (STEPS * segments) as u64;
            format!("{each:>17}")
        });
        println!("{segments:>8} segments{}", cells.concat());
    }
}

/// The instructions of one run of this program, all included.
fn instructions(arguments: &[&str]) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(env::current_exe().unwrap())
        .args(arguments)
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stderr);
    let count = report
        .lines()
        .find_map(|line| line.split("Collected : ").nth(1))
        .unwrap_or_else(|| panic!("callgrind says no count: {report}"));
    count.trim().parse().unwrap()
}

fn edges(set: &str) -> Vec<EdgeEdge> {
    let mut sets = data::all().into_iter();
    let (_, make) = sets.find(|(name, _)| *name == set).unwrap();
    make()
}

fn work(queries: &[EdgeEdge], method: &str) {
    let each = |answer: &dyn Fn(&EdgeEdge)| queries.iter().for_each(answer);
    let batch = || {
        let mut batch = Batch::new();
        for query in queries {
            batch.push(query);
        }
        batch
    };
    match method {
        "none" => {}
        "none-batch" => consume(batch()),
        "thesis" => each(&|query| consume(Thesis::default().edge_edge(query))),
        "additive" => each(&|query| consume(Additive::default().edge_edge(query))),
        "certified" => each(&|query| consume(certified::decide(query))),
        "certified-batch" => batch().decide_observed(|_, hit| consume(hit), |_| {}),
        _ => panic!("no such method: {method}"),
    }
}

fn work_vertex_face(set: &str, method: &str) {
    let sets = data::vertex_face_sets();
    let (_, queries) = sets.iter().find(|(name, _)| *name == set).unwrap();
    let batch = || {
        let mut batch = Batch::new();
        for query in queries {
            batch.push(query);
        }
        batch
    };
    match method {
        "none" => {}
        "none-batch" => consume(batch()),
        "certified" => queries
            .iter()
            .for_each(|query| consume(certified::decide(query))),
        "certified-batch" => batch().decide_observed(|_, hit| consume(hit), |_| {}),
        _ => panic!("no such method: {method}"),
    }
}

fn step(scene: &str, count: usize, method: &str, steps: usize) {
    let mut scenes = scenes::SCENES.into_iter();
    let (_, scene) = scenes.find(|(name, _)| *name == scene).unwrap();
    let mut methods = scenes::METHODS.into_iter();
    let method = methods.find(|(name, ..)| *name == method).unwrap();
    consume(last_step(scene(count), method, steps));
}

/// The pairs that need a test in the last of some steps.
fn last_step(scene: scenes::Scene, method: (&str, Method, bool), steps: usize) -> usize {
    let mut run = scenes::Run::new(scene, method);
    (0..steps).map(|_| run.step()).last().unwrap_or(0)
}

fn step_wire(scene: &str, segments: usize, steps: usize) {
    if scene == "swing" {
        let mut world = span::world(segments);
        return (0..steps).for_each(|_| consume(world.step(&[]).unwrap()));
    }
    let (mut world, mut collisions) = crossed::world(segments);
    for _ in 0..steps {
        consume(world.step_colliding(&mut collisions, &[]).unwrap());
    }
}

fn consume<T>(value: T) {
    black_box(value);
}
