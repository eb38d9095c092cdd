//! Instructions per query of the narrow phases, and per segment and step of the broad phases and of
//! the wire stepper, by callgrind: a count that repeats exactly, whatever else the machine does.
//!
//! `cargo bench --bench instructions`, where `valgrind` is present; elsewhere it says so and ends.
//! Each method runs over each set under `valgrind --tool=callgrind`, and once more without doing
//! anything, to take off what reading the queries costs. A broad phase runs for one step, which
//! sorts and fills, and for [`STEPS`] more; a wire is stepped not at all, and for as many.
//!
//! `cargo bench --bench instructions -- check` counts the certified path, the broad phase and the
//! stepper alone, and ends with 1 where one of them takes a fiftieth more than `instructions.txt`
//! says. `-- record` writes that file. Other compilers and other processors count otherwise: with
//! these it shows the difference, and ends with 0.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a measurement that goes wrong ends by panicking"
)]

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::hint::black_box;
use std::process::{Command, exit};

use tunnelproof::additive::Additive;
use tunnelproof::broad::Method;
use tunnelproof::certified::{self, Batch};
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::{Coordinate, EdgeEdge, VertexFace};
use tunnelproof::thesis::Thesis;
use tunnelproof::{Clearance, Pairs, advance_pairs};

#[path = "data/crossed.rs"]
mod crossed;
mod data;
mod scenes;
#[path = "data/sheet.rs"]
mod sheet;
#[path = "data/span.rs"]
mod span;

/// Steps of a broad phase or of a wire that are counted.
const STEPS: usize = 4;

const METHODS: [&str; 4] = ["thesis", "additive", "certified", "certified-batch"];
const THICK_METHODS: [&str; 3] = ["additive", "certified", "certified-batch"];
const FACE_METHODS: [&str; 2] = ["certified", "certified-batch"];

/// What is counted, as it was recorded.
const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions.txt");

/// Of the wire stepper.
const WIRE_SCENES: [&str; 2] = ["swing", "contacts"];

/// How many segments a guarded scene has.
const GUARDED_SEGMENTS: usize = 100;

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["run", set, method] => return work(&made(data::all(), set), method),
        ["run-thick", set, method] => return work(&made(data::all_thick(), set), method),
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
        ["sheet", asked, "f64", count] => return ask_sheet(|x| x, asked, count.parse().unwrap()),
        ["sheet", asked, _, count] => {
            return ask_sheet(|x| x as f32, asked, count.parse().unwrap());
        }
        _ => {}
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not here: no instructions counted");
        return;
    }
    match arguments[..] {
        ["check", ..] => exit(check(&guarded())),
        ["record", ..] => record(&guarded()),
        _ => {
            narrow_phases();
            broad_phases();
            wires();
            sheets();
        }
    }
}

/// Counts by name.
type Counts = BTreeMap<String, u64>;

/// What this project has to answer for.
fn guarded() -> Counts {
    let mut counts = Counts::new();
    for (kind, _, methods, sets) in kinds() {
        let own = methods.iter().filter(|name| name.starts_with("certified"));
        let own: Vec<&str> = own.copied().collect();
        for (set, count) in sets {
            for (method, each) in own.iter().zip(per_query(kind, set, &own, count)) {
                counts.insert(format!("{kind} {set} {method}"), each);
            }
        }
    }
    let count = GUARDED_SEGMENTS;
    for (scene, _) in scenes::SCENES {
        for (method, ..) in scenes::METHODS {
            let each = per_segment(&["step", scene, &count.to_string(), method], 1, count);
            counts.insert(format!("step {scene} {method}"), each);
        }
    }
    for scene in WIRE_SCENES {
        let each = per_segment(&["wire", scene, &count.to_string()], 0, count);
        counts.insert(format!("wire {scene}"), each);
    }
    counts
}

/// Compares with what was recorded: the exit code.
fn check(counts: &Counts) -> i32 {
    let text = fs::read_to_string(RECORD).expect("benches/instructions.txt is there");
    let recorded = text.lines().filter(|line| !line.starts_with('#'));
    let recorded = recorded.map(|line| line.rsplit_once(' ').expect("a name and a count"));
    let recorded: BTreeMap<&str, u64> = recorded
        .map(|(name, count)| (name, count.parse().expect("a count")))
        .collect();
    let mut code = 0;
    println!("{:<48}{:>10}{:>10}{:>9}", "", "recorded", "now", "");
    for (name, &now) in counts {
        let Some(&before) = recorded.get(name.as_str()) else {
            println!("{name:<48}{:>10}{now:>10}   not recorded", "");
            code = 1;
            continue;
        };
        let is_more = now * 50 > before * 51;
        let share = 100.0 * (now as f64 / before as f64 - 1.0);
        let verdict = if is_more { "   more by over 2%" } else { "" };
        println!("{name:<48}{before:>10}{now:>10}{share:>+8.1}%{verdict}");
        code = if is_more { 1 } else { code };
    }
    let recorded_by = text.lines().next().unwrap_or_default();
    if recorded_by != here() {
        println!("recorded by {recorded_by}\nhere        {}", here());
        println!("another compiler or processor: nothing follows from the difference");
        return 0;
    }
    if code != 0 {
        println!("if it is meant: cargo bench --bench instructions -- record");
    }
    code
}

fn record(counts: &Counts) {
    let lines = counts
        .iter()
        .map(|(name, count)| format!("{name} {count}\n"));
    let text = format!("{}\n{}", here(), lines.collect::<String>());
    fs::write(RECORD, text).expect("benches/instructions.txt can be written");
}

/// The compiler and the processor, as a comment.
fn here() -> String {
    let output = Command::new("rustc").arg("--version").output();
    let compiler = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let mut lines = processor.lines();
    let model = lines.find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    let model = model.unwrap_or(env::consts::ARCH);
    format!("# {}, {model}", compiler.unwrap_or_default().trim())
}

/// What a kind of query is called here and in words, who answers it, and the sets with their sizes.
type Kind = (
    &'static str,
    &'static str,
    &'static [&'static str],
    Vec<(&'static str, usize)>,
);

fn kinds() -> [Kind; 3] {
    let sizes = |(set, queries): (_, Vec<EdgeEdge>)| (set, queries.len());
    let (edges, thick) = (data::sets().map(sizes), data::thick_sets().map(sizes));
    let faces = data::vertex_face_sets().into_iter();
    let faces = faces.map(|(set, queries)| (set, queries.len()));
    [
        ("run", "two edges", &METHODS, edges.collect()),
        (
            "run-thick",
            "two edges with a radius",
            &THICK_METHODS,
            thick.collect(),
        ),
        (
            "run-vertex-face",
            "a vertex and a face",
            &FACE_METHODS,
            faces.collect(),
        ),
    ]
}

fn narrow_phases() {
    for (kind, words, methods, sets) in kinds() {
        println!("instructions per query of {words}");
        let head: String = methods.iter().map(|m| format!("{m:>17}")).collect();
        println!("{:<24}{:>10}{head}", "set", "queries");
        for (set, count) in sets {
            let cells = per_query(kind, set, methods, count).into_iter();
            let cells: String = cells.map(|each| format!("{each:>17}")).collect();
            println!("{set:<24}{count:>10}{cells}");
        }
        println!();
    }
}

/// Of each method, without what reading a set of so many queries costs.
fn per_query(kind: &str, set: &str, methods: &[&str], count: usize) -> Vec<u64> {
    let idle = ["none", "none-batch"].map(|method| instructions(&[kind, set, method]));
    let each = |method: &&str| {
        let base = idle[usize::from(method.ends_with("batch"))];
        (instructions(&[kind, set, method]) - base) / count as u64
    };
    methods.iter().map(each).collect()
}

/// Of a step of a scene of so many segments, after so many steps.
fn per_segment(words: &[&str], first: usize, count: usize) -> u64 {
    let steps = |steps: usize| instructions(&[words, &[steps.to_string().as_str()]].concat());
    (steps(first + STEPS) - steps(first)) / (STEPS * count) as u64
}

fn broad_phases() {
    println!("instructions per segment and step, and pairs that need a test in the last step");
    let names = scenes::METHODS.map(|(name, ..)| format!("{name:>26}"));
    println!("{:<8}{:>9}{}", "scene", "segments", names.concat());
    for (name, scene) in scenes::SCENES {
        for count in scenes::SIZES {
            let cells = scenes::METHODS.map(|method| {
                let each = per_segment(&["step", name, &count.to_string(), method.0], 1, count);
                let pairs = last_step(scene(count), method, 1 + STEPS);
                format!("{each:>16}{pairs:>10}")
            });
            println!("{name:<8}{count:>9}{}", cells.concat());
        }
    }
}

fn wires() {
    println!("\ninstructions of the wire stepper per segment and step");
    let head = WIRE_SCENES.map(|scene| format!("{scene:>17}")).concat();
    println!("{:>17}{head}", "");
    for segments in span::SEGMENTS {
        let cells = WIRE_SCENES.map(|scene| {
            let each = per_segment(&["wire", scene, &segments.to_string()], 0, segments);
            format!("{each:>17}")
        });
        println!("{segments:>8} segments{}", cells.concat());
    }
}

/// What is asked of a rolled-up sheet.
const OF_A_SHEET: [&str; 4] = ["step", "first-contact", "advance-pairs", "decide-pairs"];

fn sheets() {
    println!("\ninstructions of a rolled-up sheet per vertex and question");
    let names = OF_A_SHEET.map(|name| format!("{name:>17}"));
    println!("{:<9}{}", "positions", names.concat());
    for precision in ["f64", "f32"] {
        let cells = OF_A_SHEET.map(|asked| {
            let times = |count| instructions(&["sheet", asked, precision, count]);
            let each = (times("2") - times("1")) / u64::from(SIDE * SIDE);
            format!("{each:>17}")
        });
        println!("{precision:<9}{}", cells.concat());
    }
}

/// How many vertices the sheet has on each side, and how thick it is.
const SIDE: u32 = 50;
const THICKNESS: f64 = 0.002;

/// Asks something about the sheet so many times, with positions that are stored as `stored` says.
fn ask_sheet<C: Coordinate>(stored: impl Fn(f64) -> C, asked: &str, count: usize) {
    let (mesh, start, end) = sheet::rolled_sheet(SIDE);
    let typed = |all: &[sheet::Position]| -> Vec<[C; 3]> {
        all.iter().map(|position| position.map(&stored)).collect()
    };
    let (start, end) = (typed(&start), typed(&end));
    // Some pairs, as a broad phase lists them.
    let next = |i: usize| [7, 50, 151, 500].map(|far| i + far);
    let (all, mut edges, mut faces) = (mesh.edges(), Vec::new(), Vec::new());
    for (i, &[a, b]) in all.iter().enumerate() {
        let others = next(i).into_iter().filter_map(|other| all.get(other));
        edges.extend(others.map(|&[c, d]| [a, b, c, d]));
    }
    for a in 0..SIDE * SIDE {
        let others = next(a as usize).into_iter();
        let others = others.filter_map(|other| mesh.faces().get(other));
        faces.extend(others.map(|&[b, c, d]| [a, b, c, d]));
    }
    edges.retain(|[a, b, others @ ..]| !others.contains(a) && !others.contains(b));
    faces.retain(|[a, face @ ..]| !face.contains(a));
    let edges = Pairs::<EdgeEdge, C>::new(&start, &end, &edges, THICKNESS).unwrap();
    let faces = Pairs::<VertexFace, C>::new(&start, &end, &faces, THICKNESS).unwrap();
    for _ in 0..count {
        match asked {
            "step" => consume(mesh.step(&start, &end, THICKNESS)),
            "first-contact" => consume(mesh.first_contact(&start, &end, THICKNESS)),
            "advance-pairs" => consume(advance_pairs(&edges, &faces, Clearance::None)),
            _ => consume((edges.decide(), faces.decide())),
        }
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
    // It counts up to an instruction that it does not know, too.
    assert!(output.status.success(), "{arguments:?} fails: {report}");
    let count = report
        .lines()
        .find_map(|line| line.split("Collected : ").nth(1))
        .unwrap_or_else(|| panic!("callgrind says no count: {report}"));
    count.trim().parse().unwrap()
}

fn made(sets: Vec<data::Set>, set: &str) -> Vec<EdgeEdge> {
    let mut sets = sets.into_iter();
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
