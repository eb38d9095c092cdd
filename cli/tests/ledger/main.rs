//! The audit's ledger is judged as narrow phases are: random scenes of every sort against a count
//! that shares nothing with it, and against linking numbers.
//!
//! `TUNNELPROOF_SCENES=2000 cargo test --release -p tunnelproof-cli --test ledger` for more
//! scenes, and `-- --nocapture` for what came of them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;
use tunnelproof::certified::Certified;
use tunnelproof::contact::Verdict;
use tunnelproof::narrow::{NarrowPhase, Report as Said, Unsupported};
use tunnelproof::query::EdgeEdge;
use tunnelproof::wire::recording::BodySummary;
use tunnelproof::wire::{Mode, NodeKind, Shape, StepRecord};
use tunnelproof_cli::audit::{Audit, Report};
use tunnelproof_cli::scenes::Scene;
use tunnelproof_cli::simulate::Narrow;

mod count;
mod link;
mod scenes;

use count::Count;
use scenes::{SORTS, Sort, scene};

/// The records of a run, up to a step that cannot be done, without touches of bodies, since this is
/// about wires alone.
fn records(scene: &Scene, mode: Mode, narrow: &dyn NarrowPhase) -> Vec<StepRecord> {
    let mut collisions = scene.collisions(mode, narrow).unwrap();
    let mut world = scene.world().unwrap();
    let steps = (0..scene.steps()).map_while(|_| world.step_colliding(&mut collisions, &[]).ok());
    let of_wires = |mut record: StepRecord| {
        record.collisions.body_crossings.clear();
        record
    };
    steps.map(of_wires).collect()
}

/// The audit, for which bodies are mere points to which wires are fixed.
fn audited(records: &[StepRecord]) -> Report {
    let point = BodySummary {
        shape: Shape::Sphere { radius: 1e-9 },
        dynamic: false,
        mass: 0.0,
    };
    let bodies = records.first().map_or(0, |record| record.bodies.len());
    let mut audit = Audit::new(&vec![point; bodies]);
    records.iter().for_each(|record| audit.step(record));
    audit.finish()
}

fn counted(records: &[StepRecord], seed: u64) -> Count {
    let mut count = Count::new(seed);
    records.iter().for_each(|record| count.step(record));
    count
}

/// The certified path, but every so many hits it says miss.
struct Careless {
    every: u64,
    hits: AtomicU64,
}

impl NarrowPhase for Careless {
    fn name(&self) -> &str {
        "careless"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Said, Unsupported> {
        let mut report = Certified.edge_edge(query)?;
        if report.verdict.is_hit() {
            let hit = self.hits.fetch_add(1, Ordering::Relaxed);
            if hit % self.every == self.every - 1 {
                report.verdict = Verdict::Miss;
            }
        }
        Ok(report)
    }
}

/// What came out of runs.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    runs: u64,
    steps: u64,
    contacts: u64,
    remeshes: u64,
    /// Passages in steps and in changes of resolution.
    passages: [u64; 2],
    /// Runs in which wires stand on the wrong side, by the count.
    standing: u64,
    ambiguous: u64,
    links: u64,
}

impl Tally {
    fn with(self, other: Tally) -> Tally {
        Tally {
            runs: self.runs + other.runs,
            steps: self.steps + other.steps,
            contacts: self.contacts + other.contacts,
            remeshes: self.remeshes + other.remeshes,
            passages: [0, 1].map(|k| self.passages[k] + other.passages[k]),
            standing: self.standing + other.standing,
            ambiguous: self.ambiguous + other.ambiguous,
            links: self.links + other.links,
        }
    }
}

/// Compares audit, count and linking numbers of a run; what differs as an error.
fn judge(records: &[StepRecord], seed: u64, is_guarded: bool) -> Result<Tally, String> {
    let (report, count) = (audited(records), counted(records, seed));
    let (audit, counted) = (&report.standing, count.standing());
    let is_ambiguous = |wires: &[usize; 2]| report.ambiguous.iter().any(|a| a.wires == *wires);
    let ruled: Vec<_> = counted
        .iter()
        .filter(|(wires, _)| !is_ambiguous(wires))
        .collect();
    if ruled != audit.iter().collect::<Vec<_>>() {
        return Err(format!("audit {audit:?}, count {counted:?}"));
    }
    if report.jumps + report.astray > 0 {
        let (jumps, astray) = (report.jumps, report.astray);
        return Err(format!("{jumps} jumps, {astray} nodes astray"));
    }
    if !(report.standing.is_empty() || report.contacts + report.remeshes_through > 0) {
        return Err("a standing tunnel without contact".to_owned());
    }
    if is_guarded && !(report.is_clean() && report.contacts == 0) {
        return Err(format!("guard mode is not clean: {report:?}"));
    }
    if !counted.is_empty() && report.is_clean() {
        return Err(format!("missed: {counted:?}"));
    }
    let links = link::differing(records, &count.sums)?;
    Ok(Tally {
        runs: 1,
        steps: records.len() as u64,
        contacts: report.contacts,
        remeshes: report.remeshes,
        passages: count.passages,
        standing: u64::from(!counted.is_empty()),
        ambiguous: u64::from(!report.ambiguous.is_empty()),
        links,
    })
}

/// A scene in both modes by three narrow phases, and in guard mode by a careless one.
fn all_runs(sort: Sort, seed: u64) -> Vec<Result<Tally, String>> {
    let text = scene(sort, seed);
    let scene = Scene::from_toml(&text).expect(&text);
    let mut all = Vec::new();
    let mut one = |mode: Mode, narrow: &dyn NarrowPhase| {
        let records = records(&scene, mode, narrow);
        let is_guarded = mode == Mode::Guard && narrow.name() == Certified.name();
        let judged = judge(&records, seed, is_guarded);
        all.push(judged.map_err(|error| format!("{mode:?} {}: {error}\n{text}", narrow.name())));
    };
    for narrow in [Narrow::Certified, Narrow::Thesis, Narrow::Discrete] {
        for mode in [Mode::Guard, Mode::Thesis] {
            one(mode, &*narrow.phase());
        }
    }
    let hits = AtomicU64::new(0);
    one(Mode::Guard, &Careless { every: 3, hits });
    all
}

#[test]
fn ledger_is_what_an_independent_count_says() {
    let scenes = std::env::var("TUNNELPROOF_SCENES");
    let scenes: u64 = scenes.map_or(130, |count| count.parse().expect("a number of scenes"));
    let mut total = Tally::default();
    let mut wrong = Vec::new();
    for (k, sort) in SORTS.into_iter().enumerate() {
        let seeds = (0..scenes).filter(|seed| *seed as usize % SORTS.len() == k);
        let seeds: Vec<u64> = seeds.collect();
        let runs: Vec<_> = seeds
            .into_par_iter()
            .map(|seed| (seed, all_runs(sort, seed)))
            .collect();
        let mut tally = Tally::default();
        for (seed, results) in runs {
            for result in results {
                match result {
                    Ok(run) => tally = tally.with(run),
                    Err(error) => wrong.push(format!("{sort:?}, seed {seed}: {error}")),
                }
            }
        }
        println!("{sort:?}: {tally:?}");
        total = total.with(tally);
    }
    println!("all: {total:?}");
    for error in wrong.iter().take(20) {
        println!("{error}");
    }
    assert!(wrong.is_empty(), "{} runs differ", wrong.len());
    assert!(total.ambiguous * 100 <= total.runs, "{total:?}");
    // Every part took part.
    assert!(
        total.passages.iter().all(|&passages| passages > 0) && total.links > 0,
        "{total:?}"
    );
    assert!(total.standing * 10 > total.runs, "{total:?}");
}

/// A run with passages, for faults to be planted in.
fn planted() -> Vec<StepRecord> {
    let of = |seed| {
        let scene = Scene::from_toml(&scene(Sort::Generic, seed)).unwrap();
        records(&scene, Mode::Thesis, &*Narrow::Discrete.phase())
    };
    let mut all = (0..100).map(of);
    all.find(|records| counted(records, 0).standing().len() > 1)
        .unwrap()
}

#[test]
fn judgement_finds_faults_of_the_ledger() {
    let records = planted();
    judge(&records, 0, false).unwrap();
    let report = audited(&records);
    let counted = counted(&records, 0).standing();
    assert_eq!(report.standing, counted);
    // A step left out, and time that runs back.
    let without = |step: usize| {
        let mut records = records.clone();
        records.remove(step);
        audited(&records).standing
    };
    assert!((0..records.len()).any(|step| without(step) != counted));
    let mut back = records.clone();
    back.reverse();
    for wire in back.iter_mut().flat_map(|record| &mut record.wires) {
        std::mem::swap(&mut wire.before, &mut wire.after);
    }
    let reversed: Vec<_> = counted.iter().map(|(wires, sum)| (*wires, -sum)).collect();
    assert_eq!(audited(&back).standing, reversed);
    assert_ne!(reversed, counted);
}

/// A ledger that does not know what is fixed together counts segments that the audit of motions
/// leaves out.
#[test]
fn judgement_finds_a_ledger_that_tears_pins_apart() {
    let is_found = |seed| {
        let scene = Scene::from_toml(&scene(Sort::Pins, seed)).unwrap();
        let records = records(&scene, Mode::Thesis, &Certified);
        let mut torn = records.clone();
        for wire in torn.iter_mut().flat_map(|record| &mut record.wires) {
            wire.kinds.fill(NodeKind::Free);
        }
        let counted = counted(&records, seed).standing();
        assert_eq!(audited(&records).standing, counted, "seed {seed}");
        audited(&torn).standing != counted || !audited(&torn).ambiguous.is_empty()
    };
    let found = (0..40).filter(|&seed| is_found(seed)).count();
    assert!(found > 5, "{found}");
}

/// Guard mode with a narrow phase that misses lets wires through: each time the audit says so.
#[test]
fn audit_finds_every_planted_passage() {
    let mut passed = 0;
    for seed in 0..40 {
        let scene = Scene::from_toml(&scene(Sort::Generic, seed)).unwrap();
        let hits = AtomicU64::new(0);
        let records = records(&scene, Mode::Guard, &Careless { every: 2, hits });
        let report = audited(&records);
        if !counted(&records, seed).standing().is_empty() {
            passed += 1;
            assert!(
                !report.standing.is_empty() && report.missed[2] > 0,
                "seed {seed}: {report:?}"
            );
        }
    }
    assert!(passed > 5, "{passed}");
}

/// A wire with two segments along x whose nodes are pinned, and one across that falls on it node to
/// node at 8 m/s.
fn node_to_node(origin: f64, radius: f64) -> Scene {
    let at = |x: f64, y: f64, z: f64| format!("[{:?}, {:?}, {z:?}]", origin + x, origin + y);
    let wire = |name: &str, kind: &str, places: [String; 3], velocity: f64| {
        let route = places
            .map(|place| format!("{{ {kind} = {place} }}"))
            .join(", ");
        format!(
            "[[wires]]\nname = \"{name}\"\nmaterial = {{ radius = {radius:?}, \
             bend_modulus = 0 }}\nresolution = 4.0\n\
             adaptive = false\nvelocity = [0, 0, {velocity:?}]\nroute = [{route}]\n"
        )
    };
    let fixed = [-4.0, 0.0, 4.0].map(|x| at(x, 0.0, 0.0));
    let falling = [-4.0, 0.0, 4.0].map(|y| at(0.0, y, 0.25));
    Scene::from_toml(&format!(
        "title = \"node to node\"\nduration = 0.125\n[settings]\nstep = 0.0625\ngravity = [0, \
         0, 0]\n{}{}",
        wire("fixed", "pinned", fixed, 0.0),
        wire("falling", "free", falling, -8.0)
    ))
    .unwrap()
}

#[test]
fn audit_counts_a_passage_from_node_to_node_wherever_it_is() {
    for (origin, radius) in [(0.0, 0.01), (1e4, 1e-6), (6.4e6, 1e-4), (1e9, 0.01)] {
        let scene = node_to_node(origin, radius);
        let records = records(&scene, Mode::Thesis, &*Narrow::Discrete.phase());
        let report = audited(&records);
        assert_eq!(report.standing.len(), 1, "{origin} m: {report:?}");
        assert_eq!(
            report.standing,
            counted(&records, 1).standing(),
            "{origin} m"
        );
        assert_eq!(report.missed[2], 4);
    }
}

/// Two wires whose first nodes are one point, one of which is thrown past the other.
#[test]
fn audit_of_wires_pinned_to_one_point_finds_nothing_in_guard_mode() {
    let wire = |name: &str, route: &str| {
        format!(
            "[[wires]]\nname = \"{name}\"\nmaterial = {{ radius = 0.005, bend_modulus = 0 }}\n\
             resolution = 3\n\
             adaptive = false\nvelocity = [0, 0, -16]\nroute = [{{ pinned = [0, 0, 0] }}, \
              {route}]\n"
        )
    };
    let text = format!(
        "title = \"one point\"\nduration = 0.125\n[settings]\nstep = 0.0625\ngravity = [0, 0, \
         0]\n{}{}",
        wire("fixed", "{ pinned = [1, 0, 0] }"),
        wire("thrown", "{ free = [1, 0.2, 0.5] }")
    );
    let scene = Scene::from_toml(&text).unwrap();
    let report = audited(&records(&scene, Mode::Guard, &Certified));
    assert!(report.is_exact() && report.contacts == 0, "{report:?}");
}

/// A wire that ends exactly on another one has passed or not.
#[test]
fn audit_calls_a_passage_at_the_end_of_a_wire_ambiguous() {
    let text = "title = \"end\"\nduration = 0.0625\n[settings]\nstep = 0.0625\ngravity = [0, \
     0, 0]\n\
        [[wires]]\nname = \"fixed\"\nmaterial = { radius = 0.005 }\nresolution = 4\n\
        route = [{ pinned = [-1, 0, 0] }, { pinned = [1, 0, 0] }]\n\
        [[wires]]\nname = \"thrown\"\nmaterial = { radius = 0.005, bend_modulus = 0 }\n\
         resolution = 4\n\
        adaptive = false\nvelocity = [0, 0, -8]\nroute = [{ free = [0, 0, 0.25] }, \
         { free = [0, 1, 0.25] }]\n";
    let scene = Scene::from_toml(text).unwrap();
    let report = audited(&records(&scene, Mode::Thesis, &Certified));
    assert!(
        report.standing.is_empty() && !report.is_clean(),
        "{report:?}"
    );
    let [ambiguous] = report.ambiguous.as_slice() else {
        unreachable!("{report:?}")
    };
    assert_eq!(
        (ambiguous.wires, ambiguous.most - ambiguous.least),
        ([0, 1], 1)
    );
}

/// Scenes of a folder beside the repository, if it is there: those named after guard mode were
/// called tunnels and are none, the others are and were missed.
#[test]
fn audit_is_right_about_scenes_on_which_it_was_wrong() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/scenes/ledger");
    for file in std::fs::read_dir(folder).into_iter().flatten() {
        let path = file.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = Scene::from_toml(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let is_guarded = name.contains("guard");
        let mode = if is_guarded {
            Mode::Guard
        } else {
            Mode::Thesis
        };
        let records = records(&scene, mode, &Certified);
        assert_eq!(audited(&records).is_clean(), is_guarded, "{name}");
        judge(&records, 1, is_guarded).expect(&name);
    }
}
