//! The tests: which there are, how long each takes, and which places it reaches.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};

use crate::tree::{Subject, cargo};

/// A test of a program of tests.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Test {
    pub program: PathBuf,
    pub folder: PathBuf,
    pub target: String,
    pub name: String,
    pub seconds: f64,
    /// Whether it is asked for less, where it can be.
    pub is_less: bool,
    /// Whether it takes so long that it gets only mutants that no quicker one kills.
    pub is_long: bool,
    /// Whether it passed without a mutant. Else it was stopped, and what it reaches after that is not known.
    pub is_done: bool,
    /// The places that it reaches, in order.
    pub reaches: Vec<u32>,
}

impl Test {
    /// Its program and its name.
    pub fn said(&self) -> String {
        format!("{} {}", self.target, self.name)
    }
}

#[derive(Deserialize)]
struct Artifact {
    manifest_path: Option<PathBuf>,
    target: Option<Target>,
    executable: Option<PathBuf>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
}

/// How a run of tests ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Passed,
    Failed,
    TimedOut,
}

/// The programs of tests, built: each with its package's folder, its name, and whether it is the tests of a library.
fn programs(
    tree: &Path,
    subject: &Subject,
    arguments: &[&str],
) -> Result<Vec<(PathBuf, PathBuf, Target)>> {
    let output = cargo(tree)
        .args([
            "test",
            "--profile",
            subject.profile,
            "--no-run",
            "--message-format",
            "json",
            "--features",
            subject.features,
        ])
        .args(subject.tested.iter().flat_map(|package| ["-p", package]))
        .args(arguments)
        .stderr(Stdio::inherit())
        .output()?;
    ensure!(output.status.success(), "the tests do not compile");
    let mut programs = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        if let Ok(Artifact {
            manifest_path: Some(manifest),
            target: Some(target),
            executable: Some(program),
        }) = serde_json::from_str(line)
        {
            programs.push((
                program,
                manifest
                    .parent()
                    .context("a manifest is in a folder")?
                    .to_owned(),
                target,
            ));
        }
    }
    Ok(programs)
}

/// How many times longer than the others tests run at most when they are measured.
const LONG: u32 = 20;

/// Builds the tests, and runs each alone, without any mutant: how long it takes, and what it reaches. Those that take longer than
/// `longest` are long ones; those that take [`LONG`] times that are stopped. Kept in a file, as long as the programs are the same; with
/// them what tells that.
pub fn baseline(
    tree: &Path,
    subject: &Subject,
    arguments: &[&str],
    filter: &str,
    longest: Duration,
    jobs: usize,
) -> Result<(String, Vec<Test>)> {
    let mut all = Vec::new();
    for (program, folder, target) in programs(tree, subject, arguments)? {
        let is_lib = target.kind.iter().any(|kind| kind.contains("lib"));
        let listed = Command::new(&program)
            .args(["--list", "--format", "terse"])
            .current_dir(&folder)
            .output()?;
        for test in String::from_utf8_lossy(&listed.stdout).lines() {
            if let Some(name) = test.strip_suffix(": test")
                && (!is_lib || name.starts_with(filter))
            {
                let (program, folder, target, name) = (
                    program.clone(),
                    folder.clone(),
                    target.name.clone(),
                    name.to_owned(),
                );
                all.push(Test {
                    program,
                    folder,
                    target,
                    name,
                    seconds: 0.0,
                    is_less: true,
                    is_long: false,
                    is_done: false,
                    reaches: Vec::new(),
                });
            }
        }
    }
    let kept = tree.with_file_name("tests.json");
    // In an order of their own: Cargo names programs in another one when it has built them.
    let mut stamps: Vec<_> = all
        .iter()
        .map(|test| (stamp(&test.program), &test.name))
        .collect();
    stamps.sort();
    let key = format!("{stamps:?} {}", longest.as_secs_f64());
    if let Ok(text) = fs::read_to_string(&kept)
        && let Ok((of, tests)) = serde_json::from_str::<(String, Vec<Test>)>(&text)
        && of == key
    {
        return Ok((key, tests));
    }
    let measured = spread(&all, jobs, |test| measure(test, tree, longest))?;
    let mut tests: Vec<Test> = measured.into_iter().flatten().collect();
    ensure!(!tests.is_empty(), "no test reaches what is mutated");
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    fs::write(&kept, serde_json::to_string(&(&key, &tests))?)?;
    Ok((key, tests))
}

/// When the program was built.
fn stamp(program: &Path) -> Option<std::time::SystemTime> {
    fs::metadata(program).ok()?.modified().ok()
}

/// The test with what it takes and reaches, if it reaches anything in time.
fn measure(test: &Test, tree: &Path, longest: Duration) -> Result<Option<Test>> {
    let places = tree.with_file_name(format!(
        "reached-{}-{}",
        test.target,
        test.name.replace("::", "-")
    ));
    fs::write(&places, [])?;
    let started = Instant::now();
    let most = LONG * longest;
    let end = run(test, most, |command| {
        command.env("MUTATION_REACHED", &places)
    })?;
    let reached = fs::read(&places)?;
    fs::remove_file(&places)?;
    match end {
        // Some count what only many queries have.
        End::Failed if test.is_less => {
            let is_less = false;
            return measure(
                &Test {
                    is_less,
                    ..test.clone()
                },
                tree,
                longest,
            );
        }
        End::Failed => anyhow::bail!("{} fails without any mutant", test.said()),
        _ if reached.is_empty() => return Ok(None),
        End::TimedOut => println!("takes more than {} s: {}", most.as_secs_f64(), test.said()),
        End::Passed => {}
    }
    let reaches = (0..)
        .zip(&reached)
        .filter(|(_, is)| **is != 0)
        .map(|(site, _)| site)
        .collect();
    Ok(Some(Test {
        seconds: started.elapsed().as_secs_f64(),
        is_long: started.elapsed() > longest,
        is_done: end == End::Passed,
        reaches,
        ..test.clone()
    }))
}

/// Does something with each item, on several threads; what comes of it is in the order of the items.
pub fn spread<T: Sync, R: Send>(
    items: &[T],
    jobs: usize,
    work: impl Fn(&T) -> Result<R> + Sync,
) -> Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        let thread = || -> Result<()> {
            while let Some((at, item)) =
                Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|at| Some((at, items.get(at)?)))
            {
                let result = work(item)?;
                results
                    .lock()
                    .map_err(|_| anyhow::anyhow!("a thread failed"))?
                    .push((at, result));
            }
            Ok(())
        };
        let threads: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(thread)).collect();
        threads.into_iter().try_for_each(|thread| {
            thread
                .join()
                .map_err(|_| anyhow::anyhow!("a thread failed"))?
        })
    })?;
    let mut results = results
        .into_inner()
        .map_err(|_| anyhow::anyhow!("a thread failed"))?;
    results.sort_by_key(|(at, _)| *at);
    Ok(results.into_iter().map(|(_, result)| result).collect())
}

/// What the certified path says of queries of all families, with a mutant or without one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// Times, sides, kinds, cases and flags.
    pub exact: String,
    /// These, and places with their bounds.
    pub answers: String,
    /// How many places that are mutated were passed.
    pub work: u64,
}

/// The program that asks.
pub fn asker(tree: &Path, subject: &Subject) -> Result<PathBuf> {
    let programs = programs(tree, subject, &["--test", "mutation_answers"])?;
    programs
        .into_iter()
        .map(|(program, ..)| program)
        .next()
        .context("no program asks")
}

/// What is asked of a mutant.
pub struct Questions {
    /// What [asks](asker).
    pub program: PathBuf,
    /// How many queries of each family, if that is not left to the program.
    pub count: Option<u64>,
    /// Whether work is counted.
    pub has_work: bool,
}

impl Questions {
    /// Asks; `None` if there is no answer within the limit.
    pub fn ask(&self, mutant: Option<u32>, limit: Duration) -> Result<Option<Said>> {
        let mut command = Command::new(&self.program);
        command
            .args(["--nocapture", "--test-threads", "1"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        if self.has_work {
            command.env("MUTATION_WORK", "1");
        }
        if let Some(count) = self.count {
            command.env("MUTATION_QUERIES", count.to_string());
        }
        if let Some(id) = mutant {
            command.env("MUTANT", id.to_string());
        }
        let mut child = command.spawn()?;
        let started = Instant::now();
        while child.try_wait()?.is_none() {
            if is_over(&child, started, limit) {
                child.kill()?;
                child.wait()?;
                return Ok(None);
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        let output = child.wait_with_output()?;
        let text = String::from_utf8_lossy(&output.stdout);
        Ok(text.lines().find_map(|line| {
            let (exact, rest) = line.strip_prefix("said ")?.split_once(' ')?;
            let (answers, work) = rest.split_once(' ')?;
            Some(Said {
                exact: exact.to_owned(),
                answers: answers.to_owned(),
                work: work.parse().ok()?,
            })
        }))
    }
}

/// Whether a program has had its time: of processors, so that what else they do does not matter, or ten times that if it waits.
fn is_over(program: &Child, started: Instant, limit: Duration) -> bool {
    let passed = started.elapsed();
    passed > 10 * limit || (passed > limit && processors(program).unwrap_or(passed) > limit)
}

/// The time that processors gave a program, where the system has it in `/proc`.
fn processors(program: &Child) -> Option<Duration> {
    let text = fs::read_to_string(format!("/proc/{}/stat", program.id())).ok()?;
    // What follows the name begins with the third number; the 14th and the 15th are hundredths of a second.
    let numbers = text.rsplit_once(')')?.1.split_whitespace().skip(11).take(2);
    let hundredths: Option<u64> = numbers.map(|number| number.parse::<u64>().ok()).sum();
    Some(Duration::from_millis(10 * hundredths?))
}

/// How much tests do that can be asked for less: what they do without optimisation.
const LESS: [(&str, &str); 3] = [
    ("TUNNELPROOF_CASES", "100"),
    ("TUNNELPROOF_RIGID_COUNT", "60"),
    ("TUNNELPROOF_STEPS", "200"),
];

/// Runs a test alone.
pub fn run(
    test: &Test,
    limit: Duration,
    environment: impl FnOnce(&mut Command) -> &mut Command,
) -> Result<End> {
    let mut command = Command::new(&test.program);
    command
        .args(["--exact", &test.name, "--test-threads", "1"])
        .current_dir(&test.folder)
        .env("CARGO_MANIFEST_DIR", &test.folder)
        .envs(LESS.into_iter().filter(|_| test.is_less))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    environment(&mut command);
    let mut child = command
        .spawn()
        .with_context(|| test.program.display().to_string())?;
    let started = Instant::now();
    let mut pause = Duration::from_micros(500);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(if status.success() {
                End::Passed
            } else {
                End::Failed
            });
        }
        if is_over(&child, started, limit) {
            child.kill()?;
            child.wait()?;
            return Ok(End::TimedOut);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
}
