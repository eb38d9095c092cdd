//! The commands, what they have in common, and how they end.
//!
//! Exit code 0 is success, 1 a judged failure, 2 bad input or output that cannot be written, 3 an
//! answer of `mesh-step` that the audit does not confirm, 130 that Ctrl-C ended it; then one line on the standard error says what is wrong. Whoever closes the
//! standard output early wants no more: that is success.

use std::fmt;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, value_parser};
use tunnelproof::certified::ClearanceError;
use tunnelproof::environment::{self, EnvironmentError};
use tunnelproof::query::{QueryKind, Radius};
use tunnelproof_cli::meshes::MeshFileError;
use tunnelproof_cli::scenes::SceneError;
use tunnelproof_cli::sweep::{AxisError, DomainError};
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::corpus::{CorpusError, ReadOptions};
use tunnelproof_reference::generate::RigidId;
use tunnelproof_reference::report::merge::MergeError;

mod advance;
mod audit;
mod axes;
mod certificate;
mod certify;
mod certify_boxes;
mod eval;
mod explain;
mod gap;
mod keep;
mod keeping;
mod lib_host;
mod merge;
mod mesh_step;
mod output;
mod pages;
mod polygons;
mod progress;
mod recordings;
mod replay;
mod resume;
mod shell;
mod shrink;
mod simulate;
mod slowest;
mod sources;
mod subjects;
mod sweep;
mod table;
mod tune;
mod vectors;

/// Judges continuous collision detection of moving edges against exact arithmetic.
#[derive(Parser)]
#[command(name = "tunnelproof", version, arg_required_else_help = true)]
pub(crate) struct Cli {
    /// Threads to work on, at most 1024; by default RAYON_NUM_THREADS, or one for each core
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Eval(eval::Eval),
    Certify(certify::Certify),
    CertifyBoxes(certify_boxes::CertifyBoxes),
    Merge(merge::Merge),
    #[command(hide = true)]
    LibHost(lib_host::LibHost),
    Explain(explain::Explain),
    Gap(gap::Gap),
    Advance(advance::Advance),
    MeshStep(mesh_step::MeshStep),
    Shrink(shrink::Shrink),
    Slowest(slowest::Slowest),
    Replay(replay::Replay),
    Vectors(vectors::Vectors),
    Sweep(sweep::Sweep),
    Tune(tune::Tune),
    Simulate(simulate::Simulate),
    Audit(audit::Audit),
    Table(table::Table),
    Completions(shell::Completions),
    Man(shell::Man),
}

/// How files are read.
#[derive(Args)]
struct Reading {
    /// The kind of the queries, where neither the file's path nor the query says it
    #[arg(long, value_parser = kind())]
    kind: Option<QueryKind>,
    /// Ask for a distance of at most R metres, whatever the queries of files say; not of bodies that turn
    ///
    /// A number, or two whose exact sum is meant: 0.01+0.02
    #[arg(long, value_name = "R", value_parser = radius, allow_negative_numbers = true)]
    radius: Option<Radius>,
}

/// Why a command ends early.
enum Failure {
    /// Bad input.
    Input(RunError),
    /// The output cannot be written.
    Output {
        /// What is written.
        name: String,
        /// Why it cannot be.
        error: io::Error,
    },
    /// A program that is to be judged cannot be started.
    Program {
        /// What asks for it.
        name: String,
        /// Why it cannot be started.
        reason: String,
    },
    /// A result cannot be read or put together with others.
    Merge {
        /// The file of the result.
        path: String,
        /// What is wrong with it.
        error: MergeError,
    },
    /// A file that is not what it should be.
    File {
        /// Its path, or the name of a scene.
        path: String,
        /// What is wrong with it.
        problem: String,
    },
    /// There is nothing to do.
    Nothing,
    /// An option is about files, and there is none.
    NoFile(&'static str),
    /// An option is about programs, and there is none.
    NoProgram(String),
    /// Nothing says which fuzz target the file at this path is for.
    Target(String),
    /// The thresholds cannot be swept like that.
    Axis(AxisError),
    /// There is no such scene.
    Domain(DomainError),
    /// Two sides cannot be kept apart like that.
    Clearance(ClearanceError),
    /// A file is no mesh, or two are no motion of one.
    Mesh(MeshFileError),
    /// How bad a missed crossing is, is no such number.
    Penalty(f64),
    /// Ctrl-C cannot be listened to.
    Interruption(ctrlc::Error),
    /// Nothing here holds in this floating-point environment.
    Environment(EnvironmentError),
    /// The threads cannot be started.
    Threads(rayon::ThreadPoolBuildError),
}

impl Cli {
    pub(crate) fn run(self) -> ExitCode {
        match self.start() {
            Ok(code) => code,
            Err(Failure::Output { error, .. }) if error.kind() == io::ErrorKind::BrokenPipe => {
                ExitCode::SUCCESS
            }
            Err(failure) => {
                eprintln!("{failure}");
                ExitCode::from(2)
            }
        }
    }

    fn start(self) -> Result<ExitCode, Failure> {
        // The environment of a library that was loaded before the program, for one.
        environment::check().map_err(Failure::Environment)?;
        if let Some(threads) = self.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads.into())
                .build_global()
                .map_err(Failure::Threads)?;
        }
        match self.command {
            Command::Eval(eval) => eval.run(),
            Command::Certify(certify) => certify.run(),
            Command::CertifyBoxes(certify) => certify.run(),
            Command::Merge(merge) => merge.run(),
            Command::LibHost(host) => host.run(),
            Command::Explain(explain) => explain.run(),
            Command::Gap(gap) => gap.run(),
            Command::Advance(advance) => advance.run(),
            Command::MeshStep(step) => step.run(),
            Command::Shrink(shrink) => shrink.run(),
            Command::Slowest(slowest) => slowest.run(),
            Command::Replay(replay) => replay.run(),
            Command::Vectors(vectors) => vectors.run(),
            Command::Sweep(sweep) => sweep.run(),
            Command::Tune(tune) => tune.run(),
            Command::Simulate(simulate) => simulate.run(),
            Command::Audit(audit) => audit.run(),
            Command::Table(table) => table.run(),
            Command::Completions(completions) => completions.run(),
            Command::Man(man) => man.run(),
        }
    }
}

impl Failure {
    /// What is wrong with a file, or with an option.
    fn file(path: impl AsRef<Path>, problem: impl ToString) -> Self {
        Failure::File {
            path: path.as_ref().display().to_string(),
            problem: problem.to_string(),
        }
    }

    fn merge(path: &str, error: MergeError) -> Self {
        let path = path.to_owned();
        Failure::Merge { path, error }
    }
}

impl Reading {
    /// Whether an option says how to read files that there are none of.
    fn check(&self, files: &[String]) -> Result<(), Failure> {
        match self.given() {
            Some(option) if files.is_empty() => Err(Failure::NoFile(option)),
            _ => Ok(()),
        }
    }

    /// The first option that is given.
    fn given(&self) -> Option<&'static str> {
        let options = [
            ("--radius", self.radius.is_some()),
            ("--kind", self.kind.is_some()),
        ];
        let given = options.into_iter().find(|(_, is_given)| *is_given);
        given.map(|(option, _)| option)
    }

    /// That no option says how to read a query that it does not hold for.
    fn check_unused(&self, query: &str, what: &str) -> Result<(), Failure> {
        match self.given() {
            Some(option) => Err(Failure::file(
                query,
                format!("is {what}, which {option} is not for"),
            )),
            None => Ok(()),
        }
    }

    /// Whether the query of this name is of bodies that turn.
    fn is_turning(&self, turning: bool, query: &str) -> Result<bool, Failure> {
        let is_turning = turning || RigidId::parse(query).is_some();
        if is_turning {
            self.check_unused(query, "a query of bodies that turn")?;
        }
        Ok(is_turning)
    }

    fn options(&self) -> ReadOptions {
        ReadOptions {
            kind: self.kind,
            radius: self.radius,
        }
    }
}

fn radius(text: &str) -> Result<Radius, String> {
    Ok(match text.split_once('+') {
        Some((first, second)) => [not_negative(first.trim())?, not_negative(second.trim())?].into(),
        None => not_negative(text)?.into(),
    })
}

/// A number of queries, or a seed.
fn whole(text: &str) -> Result<u64, String> {
    let most = u64::MAX;
    let problem = |_| format!("it has to be a whole number from 0 to {most}");
    text.parse().map_err(problem)
}

/// A finite number of at least 0, as options give it.
fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("it has to be a finite number, 0 or more".to_owned()),
    }
}

/// A share of something, from 0 and below 1.
fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..1.0).contains(&value) => Ok(value),
        _ => Err("it has to be a number from 0 and below 1".to_owned()),
    }
}

fn kind() -> impl TypedValueParser<Value = QueryKind> {
    let kinds = [QueryKind::EdgeEdge, QueryKind::VertexFace];
    PossibleValuesParser::new(kinds.map(QueryKind::name))
        .try_map(|name| QueryKind::from_name(&name).ok_or("unknown kind"))
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        Failure::Input(error)
    }
}

impl From<CorpusError> for Failure {
    fn from(error: CorpusError) -> Self {
        Failure::Input(error.into())
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Failure::file("scene", error)
    }
}

impl From<AxisError> for Failure {
    fn from(error: AxisError) -> Self {
        Failure::Axis(error)
    }
}

impl From<ClearanceError> for Failure {
    fn from(error: ClearanceError) -> Self {
        Failure::Clearance(error)
    }
}

impl From<MeshFileError> for Failure {
    fn from(error: MeshFileError) -> Self {
        Failure::Mesh(error)
    }
}

impl From<DomainError> for Failure {
    fn from(error: DomainError) -> Self {
        Failure::Domain(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Input(error) => error.fmt(f),
            Failure::Output { name, error } => write!(f, "{name}: cannot be written: {error}"),
            Failure::Program { name, reason } => write!(f, "{name}: {reason}"),
            Failure::Merge { path, error } => write!(f, "{path}: {error}"),
            Failure::File { path, problem } => write!(f, "{path}: {problem}"),
            Failure::NoProgram(option) => write!(
                f,
                "{option} is for programs and libraries, and none is asked: \
                 add --subject cmd:PROGRAM or --subject lib:FILE"
            ),
            Failure::Nothing => f.write_str("--count 0: no query is left to judge"),
            Failure::Target(path) => {
                write!(f, "{path}: is in no folder of a fuzz target; pass --target")
            }
            Failure::Axis(error) => error.fmt(f),
            Failure::Domain(error) => error.fmt(f),
            Failure::NoFile(option) => write!(
                f,
                "{option} says how files are read, and no file of queries is named"
            ),
            Failure::Clearance(error) => error.fmt(f),
            Failure::Mesh(error) => error.fmt(f),
            Failure::Penalty(value) => {
                write!(f, "--penalty is {value}, not a finite number above 0")
            }
            Failure::Interruption(error) => write!(f, "Ctrl-C: {error}"),
            Failure::Environment(error) => write!(
                f,
                "floating-point environment: {error}. A library that is loaded at the start \
                 has set this: see LD_PRELOAD, and what was built with -ffast-math"
            ),
            Failure::Threads(error) => write!(f, "--threads: {error}"),
        }
    }
}
