//! Mutation analysis: are the tests of the project changed in their verdict by every small change of its sources?
//!
//! The changes are those of [cargo-mutants](https://mutants.rs), and every constant in floating point halved, doubled and set to 0.
//! All mutants are in one build, which is told by its environment which of them is on. So a mutant costs the tests that reach it, and
//! no compilation.

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use clap::Parser;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use mutant::{Kind, Mutant};
use suite::{End, Questions, Said, Test};
use tree::Subject;

mod mutant;
mod rewrite;
mod suite;
mod tree;

/// Changes the sources in every small way, one at a time, and says which changes no test notices
#[derive(Parser)]
#[command(after_help = AFTER)]
struct Options {
    /// What is mutated: the certified path, or the judges
    #[arg(long, default_value = "certified", value_parser = ["certified", "judges"])]
    subject: String,
    /// Only so many mutants, drawn at random
    #[arg(long, value_name = "N")]
    sample: Option<usize>,
    /// The seed of the draw
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only mutants of this kind: constant, operator, unary, body or arm
    #[arg(long, value_parser = Kind::ALL.map(Kind::name))]
    kind: Option<String>,
    /// Only mutants in files with this in their path; the others are built as they are, which takes a small part of the time
    #[arg(long, value_name = "PART", default_value = "")]
    file: String,
    /// Only the mutants of these numbers
    #[arg(
        long,
        value_name = "IDS",
        value_delimiter = ',',
        overrides_with = "mutant"
    )]
    mutant: Vec<u32>,
    /// Threads
    #[arg(long, default_value_t = 2)]
    jobs: usize,
    /// Tests that take longer than this get only mutants that no other test kills
    #[arg(long, value_name = "S", default_value = "8", value_parser = seconds)]
    longest: Duration,
    /// For how long each of these is run on a mutant that gives the same exact answers; with 0 only mutants that give others get
    /// them
    #[arg(long, value_name = "S", default_value = "5", value_parser = seconds)]
    patience: Duration,
    /// How many queries of each family a mutant is asked that no quick test kills, and a fifth of that of bodies that turn:
    /// 100 of the certified path and 50 of the judges if not given
    #[arg(long, value_name = "N")]
    queries: Option<u64>,
    /// Do not count the work that answers take: those that cost more, or less, are said to be the same
    #[arg(long)]
    no_work: bool,
    /// Only these programs of tests, by their names; the unit tests are "lib"
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    tests: Vec<String>,
    /// End with 1 if an exact answer is another one and no test fails
    #[arg(long)]
    strict: bool,
    /// Count the mutants, and run no test
    #[arg(long)]
    list: bool,
    /// Built by the profile of tests, with little optimisation and all checks: that takes less time for few mutants
    #[arg(long)]
    dev: bool,
    /// The project; what is kept is in its `target/mutation`
    #[arg(long, default_value = ".")]
    project: PathBuf,
}

fn seconds(text: &str) -> Result<Duration> {
    Ok(Duration::try_from_secs_f64(text.parse()?)?)
}

const AFTER: &str = "\
Goes on where it was stopped: results are kept in target/mutation/SUBJECT, for as long as the programs of tests stay the same.";

const CERTIFIED: Subject = Subject {
    package: ".",
    sources: &["src/certified"],
    tested: &["tunnelproof"],
    features: "tunnelproof/rayon",
    profile: "release",
    answers: include_str!("certified.rs.txt"),
};
const JUDGES: Subject = Subject {
    package: "reference",
    sources: &[
        "reference/src/oracle",
        "reference/src/algebraic",
        "reference/src/poly.rs",
        "reference/src/places.rs",
        "reference/src/scaled.rs",
        "reference/src/normal.rs",
        "reference/src/normal",
        "reference/src/shadow",
        "reference/src/difference",
    ],
    tested: &["tunnelproof", "tunnelproof-reference"],
    features: "",
    profile: "release",
    answers: include_str!("judges.rs.txt"),
};

/// The tests of the certified path: unit tests, and those of whole answers.
const CERTIFIED_TESTS: &[&str] = &[
    "lib",
    "advance",
    "certified",
    "conformance",
    "discrete",
    "figures",
    "normal",
    "rigid",
    "rigid_normal",
    "symmetry",
    "thick",
    "underflow",
    "vertex_face",
    "cascade",
    "pairs",
    "worst",
    "mesh",
];
const JUDGES_TESTS: &[&str] = &[
    "lib",
    "agreement",
    "conformance",
    "rigid",
    "vertex_face",
    "figures",
    "normal",
    "difference",
    "errata",
    "field",
];

#[derive(Clone, Debug, Deserialize, Serialize)]
struct Outcome {
    id: u32,
    verdict: Verdict,
    /// The test that noticed.
    by: Option<String>,
    seconds: f64,
}

impl Outcome {
    /// Says which mutant it is of if no test noticed that.
    fn print(&self, mutant: &Mutant) {
        if !matches!(self.verdict, Verdict::Killed | Verdict::TimedOut) {
            println!("{}: {}", self.verdict.name(), said(mutant));
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Verdict {
    /// A test fails.
    Killed,
    /// A test does not end.
    TimedOut,
    /// All tests pass, and yet exact answers are others.
    Wrong,
    /// All tests pass, exact answers are the same, and places or their bounds are others.
    Places,
    /// All tests pass, and all answers are the same, but they take more work, or less.
    Costs,
    /// All tests pass, and answers and work are the same.
    Same,
    /// No test and no answer reaches it.
    Unreached,
}

impl Verdict {
    const ALL: [Self; 7] = [
        Self::Killed,
        Self::TimedOut,
        Self::Wrong,
        Self::Places,
        Self::Costs,
        Self::Same,
        Self::Unreached,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Killed => "killed",
            Self::TimedOut => "timed out",
            Self::Wrong => "wrong",
            Self::Places => "places",
            Self::Costs => "costs",
            Self::Same => "same",
            Self::Unreached => "unreached",
        }
    }
}

fn main() -> Result<()> {
    let options = Options::parse();
    let project = fs::canonicalize(&options.project)?;
    let (subject, tests, filter) = match options.subject.as_str() {
        "certified" => (CERTIFIED, CERTIFIED_TESTS, "certified::"),
        "judges" => (JUDGES, JUDGES_TESTS, ""),
        other => bail!("no subject {other}"),
    };
    let profile = if options.dev { "dev" } else { subject.profile };
    let subject = Subject { profile, ..subject };
    // Files alone are built apart, so that what has all mutants is kept.
    let part = if options.file.is_empty() {
        ""
    } else {
        "-files"
    };
    let folder = project.join(format!("target/mutation/{}{part}", options.subject));
    let tree = folder.join("tree");
    let mutants = tree::mutate(&project, &tree, &subject, &options.file)?;
    ensure!(
        !mutants.is_empty(),
        "no mutants in files with {:?} in their path",
        options.file
    );
    let wanted = wanted(&mutants, &options);
    if options.list {
        for mutant in &wanted {
            println!("{}", said(mutant));
        }
        return Ok(());
    }
    let named = tests
        .iter()
        .copied()
        .filter(|name| options.tests.is_empty() || options.tests.iter().any(|asked| asked == name));
    let arguments: Vec<_> = named
        .flat_map(|name| match name {
            "lib" => vec!["--lib"],
            name => vec!["--test", name],
        })
        .collect();
    if let Some(other) = options.tests.iter().find(|name| !tests.contains(&&***name)) {
        bail!(
            "no tests {other} for this subject: there are {}",
            tests.join(", ")
        );
    }
    let asker = suite::asker(&tree, &subject)?;
    let (key, tests) = suite::baseline(
        &tree,
        &subject,
        &arguments,
        filter,
        options.longest,
        options.jobs,
    )?;
    println!(
        "{} tests, {:.0} s in all",
        tests.len(),
        tests.iter().map(|test| test.seconds).sum::<f64>()
    );
    let outcomes = judge(&wanted, &tests, &key, &tree, asker, &options)?;
    report(&wanted, &outcomes);
    let wrong: Vec<_> = wanted
        .iter()
        .filter(|mutant| {
            let outcome = outcomes.get(&mutant.id);
            outcome.is_some_and(|outcome| outcome.verdict == Verdict::Wrong)
        })
        .collect();
    if options.strict && !wrong.is_empty() {
        let asked: Vec<_> = std::env::args().skip(1).collect();
        for mutant in wrong {
            eprintln!(
                "wrong: {}\n  again: cargo run --release --manifest-path proofs/mutation/Cargo.toml -- {} --mutant {}",
                said(mutant),
                asked.join(" "),
                mutant.id
            );
        }
        bail!("exact answers are others, and no test notices");
    }
    Ok(())
}

fn wanted(mutants: &[Mutant], options: &Options) -> Vec<Mutant> {
    let mut wanted: Vec<_> = mutants
        .iter()
        .filter(|mutant| {
            options
                .kind
                .as_deref()
                .is_none_or(|kind| mutant.kind.name() == kind)
                && (options.mutant.is_empty() || options.mutant.contains(&mutant.id))
        })
        .cloned()
        .collect();
    if let Some(sample) = options.sample {
        wanted.shuffle(&mut rand_chacha::ChaCha8Rng::seed_from_u64(options.seed));
        wanted.truncate(sample);
        wanted.sort_by_key(|mutant| mutant.id);
    }
    wanted
}

/// What the tests say of each mutant, by its number.
fn judge(
    mutants: &[Mutant],
    tests: &[Test],
    key: &str,
    tree: &Path,
    asker: PathBuf,
    options: &Options,
) -> Result<HashMap<u32, Outcome>> {
    let mut reaching: HashMap<u32, Vec<&Test>> = HashMap::new();
    for test in tests {
        for &site in &test.reaches {
            reaching.entry(site).or_default().push(test);
        }
    }
    let started = Instant::now();
    let questions = Questions {
        program: asker,
        count: options.queries,
        has_work: !options.no_work,
    };
    let usual = questions
        .ask(None, Duration::from_secs(600))?
        .context("the sources as they are give no answers")?;
    let judge = Judge {
        reaching,
        questions,
        usual,
        limit: 20 * started.elapsed() + Duration::from_secs(5),
        patience: options.patience,
        kills: Mutex::new(HashMap::new()),
    };
    let mut hasher = DefaultHasher::new();
    (key, options.patience, options.queries, options.no_work).hash(&mut hasher);
    let path = tree.with_file_name(format!("results-{:016x}.jsonl", hasher.finish()));
    let mut known = HashMap::new();
    if let Ok(file) = File::open(&path) {
        for line in BufReader::new(file).lines() {
            if let Ok(outcome) = serde_json::from_str::<Outcome>(&line?) {
                known.insert(outcome.id, outcome);
            }
        }
    }
    let (earlier, left): (Vec<&Mutant>, Vec<&Mutant>) = mutants
        .iter()
        .partition(|mutant| known.contains_key(&mutant.id));
    for mutant in earlier {
        known[&mutant.id].print(mutant);
    }
    let file = Mutex::new((File::options().create(true).append(true).open(path)?, 0));
    let started = Instant::now();
    let outcomes = suite::spread(&left, options.jobs, |mutant| {
        let outcome = judge.look(mutant)?;
        outcome.print(mutant);
        let mut file = file
            .lock()
            .map_err(|_| anyhow::anyhow!("a thread failed"))?;
        writeln!(file.0, "{}", serde_json::to_string(&outcome)?)?;
        file.1 += 1;
        if file.1 % 200 == 0 {
            eprintln!(
                "{} of {} in {:.0} s",
                file.1,
                left.len(),
                started.elapsed().as_secs_f64()
            );
        }
        Ok(outcome)
    })?;
    known.extend(outcomes.into_iter().map(|outcome| (outcome.id, outcome)));
    Ok(known)
}

/// What is needed to judge a mutant.
struct Judge<'a> {
    /// The tests that reach a place, the quickest first.
    reaching: HashMap<u32, Vec<&'a Test>>,
    /// What is asked of the rest, what is said without a mutant, and how long that may take.
    questions: Questions,
    usual: Said,
    limit: Duration,
    /// How long a long test runs on a mutant of which no exact answer differs.
    patience: Duration,
    /// How many mutants each test killed so far, by the function that is mutated: what killed one kills its neighbours.
    kills: Mutex<HashMap<String, HashMap<String, usize>>>,
}

impl Judge<'_> {
    /// Runs the tests that reach it until one fails. If none does, answers and work are compared, and it gets the long tests too: whole
    /// if what is exact differs, else for some seconds each.
    fn look(&self, mutant: &Mutant) -> Result<Outcome> {
        let started = Instant::now();
        let outcome = |(verdict, by): (Verdict, Option<&Test>)| Outcome {
            id: mutant.id,
            verdict,
            by: by.map(Test::said),
            seconds: started.elapsed().as_secs_f64(),
        };
        if let Some(killed) = self.test(mutant, |test| !test.is_long, None)? {
            return Ok(outcome(killed));
        }
        let verdict = match self.questions.ask(Some(mutant.id), self.limit)? {
            Some(said) if said == self.usual && !self.reaching.contains_key(&mutant.site) => {
                Verdict::Unreached
            }
            Some(said) if said == self.usual => Verdict::Same,
            Some(said) if said.answers == self.usual.answers => Verdict::Costs,
            Some(said) if said.exact == self.usual.exact => Verdict::Places,
            _ => Verdict::Wrong,
        };
        let most = (verdict != Verdict::Wrong).then_some(self.patience);
        if most.is_some_and(|most| most.is_zero()) {
            return Ok(outcome((verdict, None)));
        }
        let killed = self.test(mutant, |test| test.is_long, most)?;
        Ok(outcome(killed.unwrap_or((verdict, None))))
    }

    /// The verdict of the first of some tests that fails. Those that run for `most` are stopped then, and say nothing.
    fn test(
        &self,
        mutant: &Mutant,
        is_asked: impl Fn(&Test) -> bool,
        most: Option<Duration>,
    ) -> Result<Option<(Verdict, Option<&Test>)>> {
        let tests = self.reaching.get(&mutant.site).into_iter().flatten();
        let mut tests: Vec<_> = tests.filter(|test| is_asked(test)).collect();
        let place = format!("{} {}", mutant.file, mutant.function);
        if let Some(kills) = self.kills()?.get(&place) {
            tests.sort_by_key(|test| Reverse(kills.get(&test.said()).copied()));
        }
        for test in tests {
            let ends = Duration::from_secs_f64(1.0 + 10.0 * test.seconds);
            let limit = most.unwrap_or(ends);
            let id = mutant.id.to_string();
            match suite::run(test, limit, |command| command.env("MUTANT", id))
                .context("a test cannot be run")?
            {
                End::Passed => {}
                End::Failed => {
                    let mut kills = self.kills()?;
                    *kills
                        .entry(place)
                        .or_default()
                        .entry(test.said())
                        .or_default() += 1;
                    return Ok(Some((Verdict::Killed, Some(test))));
                }
                End::TimedOut if limit < ends || !test.is_done => {}
                End::TimedOut => return Ok(Some((Verdict::TimedOut, Some(test)))),
            }
        }
        Ok(None)
    }

    fn kills(&self) -> Result<MutexGuard<'_, HashMap<String, HashMap<String, usize>>>> {
        self.kills
            .lock()
            .map_err(|_| anyhow::anyhow!("a thread failed"))
    }
}

fn said(mutant: &Mutant) -> String {
    format!(
        "#{} {}:{}:{} {}: {}",
        mutant.id, mutant.file, mutant.line, mutant.column, mutant.function, mutant.what
    )
}

fn report(mutants: &[Mutant], outcomes: &HashMap<u32, Outcome>) {
    let mut table: BTreeMap<Kind, [usize; 7]> = BTreeMap::new();
    for mutant in mutants {
        if let Some(outcome) = outcomes.get(&mutant.id) {
            table.entry(mutant.kind).or_default()[outcome.verdict as usize] += 1;
        }
    }
    let names = Verdict::ALL.map(|verdict| format!("{:>10}", verdict.name()));
    println!("\n{:10} {:>8} {}", "kind", "mutants", names.join(""));
    let mut all = [0; 7];
    for (kind, counts) in &table {
        row(kind.name(), counts);
        for (sum, count) in all.iter_mut().zip(counts) {
            *sum += count;
        }
    }
    row("all", &all);
}

fn row(name: &str, counts: &[usize; 7]) {
    let numbers = counts.map(|count| format!("{count:>10}"));
    println!(
        "{name:10} {:>8} {}",
        counts.iter().sum::<usize>(),
        numbers.join("")
    );
}
