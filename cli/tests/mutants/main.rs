//! Faults planted in the sources of the thesis path, the shadow, the oracle and the certified path
//! are found by `certify`, or by `thesis_vs_shadow` on its seeds, within a minute each.
//!
//! Builds the program once for each fault, which takes minutes, so it has to be asked for:
//!
//! ```text
//! cargo test --release --test mutants -- --ignored --nocapture
//! ```

use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs};

use tunnelproof_cli::fuzz;

mod table;
mod workspace;

use table::{Culprit, MUTANTS, Mutant};
use workspace::{Said, Workspace};

/// The folder of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// How long a fault may stay unfound, building not counted.
const LONGEST: Duration = Duration::from_secs(60);

/// Judges on everything, certified path and shadow: who is wrong is outvoted.
const CERTIFY: &[&str] = &[
    "certify",
    "--strict",
    "--subject",
    "oracle,shadow,certified",
    "--count",
    "500",
];

/// The same with a radius above 0, on what the thesis and its shadow do not treat.
const CERTIFY_THICK: &[&str] = &[
    "certify",
    "--strict",
    "--subject",
    "oracle,certified",
    "--family",
    "thick_uniform,thick_lattice,thick_face_uniform,thick_face_lattice",
    "--count",
    "300",
];

/// The same of bodies that turn: many queries of the families that the oracle decides quickly, and fewer
/// of the others.
const CERTIFY_TURNING: [(&str, &str); 2] = [
    (
        "turning_uniform,turning_lattice,turning_confined,turning_grazing,turning_plates,\
         turning_scales,turning_thick_uniform,turning_thick_lattice,turning_thick_tangent,\
         turning_thick_beside,turning_thick_scales",
        "1000",
    ),
    (
        "turning_bodies_uniform,turning_thick_brief,turning_thick_confined",
        "250",
    ),
];

/// How many seeds of each family the thesis path is replayed on.
const SEEDS: u64 = 64;

/// The same for certified steps. What is found is shrunk, which takes longer than to find it.
const SEEDS_OF_STEPS: u64 = 4;

/// The seeds of a target, in a folder of that name.
fn corpus(name: &str, seeds: u64) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("corpus")
        .join(name);
    fs::create_dir_all(&folder).expect("a folder can be made");
    let target = fuzz::by_name(name).expect("a target");
    for (index, seed) in target.seeds(seeds).iter().enumerate() {
        fs::write(folder.join(format!("seed-{index:04}")), seed).expect("a file can be written");
    }
    folder
}

/// Runs what finds the faults of someone.
fn examine(workspace: &Workspace, culprit: Culprit) -> Said {
    let replay = |target: &str, seeds| {
        let corpus = corpus(target, seeds);
        workspace.run(&["replay", &corpus.to_string_lossy()], LONGEST)
    };
    match culprit {
        Culprit::Thesis => replay("thesis_vs_shadow", SEEDS),
        Culprit::Step => replay("step_vs_oracle", SEEDS_OF_STEPS),
        Culprit::Thick => workspace.run(CERTIFY_THICK, LONGEST),
        Culprit::Turning => {
            let certify = |(families, count)| {
                let judges = ["certify", "--strict", "--one-judge"];
                let subjects = ["--subject", "oracle,certified"];
                let queries = ["--family", families, "--count", count];
                let all = [&judges[..], &subjects[..], &queries[..]].concat();
                workspace.run(&all, LONGEST)
            };
            let [many, few] = CERTIFY_TURNING;
            let said = certify(many);
            // What the many do not find, the few may.
            match said.code {
                Some(0) => certify(few),
                _ => said,
            }
        }
        _ => workspace.run(CERTIFY, LONGEST),
    }
}

/// The lines that name who is wrong.
fn findings(said: &Said) -> Vec<&str> {
    let replayed = said.stdout.lines();
    let replayed = replayed.filter(|line| {
        [": thesis_vs_shadow: ", ": step_vs_oracle: "]
            .iter()
            .any(|target| line.contains(target))
    });
    let strict = said.stderr.lines();
    let strict = strict.filter_map(|line| line.strip_prefix("--strict: "));
    replayed.chain(strict).collect()
}

/// Whether the findings are those of a fault of this one, and of no other: a wrong oracle differs
/// from the shadow and from the certified path, a wrong shadow from the oracle alone.
fn names(culprit: Culprit, findings: &[&str]) -> bool {
    let has = |start: &str| findings.iter().any(|line| line.starts_with(start));
    let wrong = ["shadow: ", "oracle and shadow disagree", "certified: "].map(has);
    match culprit {
        Culprit::Thesis | Culprit::Step => !findings.is_empty(),
        Culprit::Shadow => wrong == [true, true, false],
        Culprit::Oracle => wrong == [true, true, true],
        Culprit::Certified | Culprit::Thick | Culprit::Turning => wrong == [false, false, true],
    }
}

#[test]
fn mutants_have_a_text_that_occurs_once() {
    for Mutant { file, text, .. } in MUTANTS {
        let path = root().join(file);
        let source = fs::read_to_string(path).expect(file);
        assert_eq!(source.matches(text).count(), 1, "{file}: {text}");
    }
}

#[test]
fn mutants_have_every_package_of_the_workspace() {
    assert!(Workspace::new("packages").is_whole());
}

/// `TUNNELPROOF_MUTANTS` is a part of the file names, or of the faults, of those to plant.
#[test]
#[ignore = "extensive: builds the program once for each fault"]
fn mutants_are_found_within_a_minute() {
    let workspace = Workspace::new("mutants");
    workspace.build();
    for culprit in [
        Culprit::Thesis,
        Culprit::Oracle,
        Culprit::Thick,
        Culprit::Step,
        Culprit::Turning,
    ] {
        let said = examine(&workspace, culprit);
        assert_eq!(
            (said.code, findings(&said)),
            (Some(0), vec![]),
            "without a fault"
        );
        println!(
            "{:6.1} s  no fault: nothing is found",
            said.time.as_secs_f64()
        );
    }
    let asked = env::var("TUNNELPROOF_MUTANTS").unwrap_or_default();
    let mut unfound = Vec::new();
    let is_asked = |m: &&Mutant| m.file.contains(&asked) || m.fault.contains(&asked);
    for mutant in MUTANTS.iter().filter(is_asked) {
        let said = workspace.with(mutant, || {
            workspace.build();
            examine(&workspace, mutant.culprit)
        });
        let findings = findings(&said);
        let is_found = said.code == Some(1) && names(mutant.culprit, &findings);
        let (seconds, file, fault) = (said.time.as_secs_f64(), mutant.file, mutant.fault);
        let found = if is_found { "found" } else { "NOT FOUND" };
        println!("{seconds:6.1} s  {found}: {file}: {fault}");
        for finding in findings.iter().take(3) {
            println!("{:10}{finding}", "");
        }
        if !is_found {
            unfound.push(format!("{file}: {fault}: {} findings", findings.len()));
        }
    }
    assert!(unfound.is_empty(), "{unfound:#?}");
}
