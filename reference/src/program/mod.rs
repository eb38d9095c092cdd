//! Subjects that are programs: started once for each thread, asked over their standard input, and
//! judged to the end whatever they do.
//!
//! `docs/bring-your-own.md` says what a program has to do. Nothing that it does ends the run: a
//! crash, a hang or garbage is a [`Lapse`] of the query whose answer was due, the program is
//! started again, and the queries after it are asked again. So each query is asked until there is
//! an answer or a lapse, once.
//!
//! [`wire`] is how queries and answers are written, in [`lines`](mod@lines) or in [`frames`];
//! `worker` is one running program.

use std::fmt;
use std::io;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use tunnelproof::narrow::Tolerance;
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::boxes::BoxCast;
use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Subject};

pub mod frames;
pub mod lines;
mod stderr;
pub mod wire;
mod worker;

#[cfg(test)]
mod tests;

use stderr::Stderr;
use wire::{AskedQuery, Wire};
use worker::{GRACE, Worker};

/// How long a program may take for an answer, unless something else is asked for.
pub const TIME_LIMIT: Duration = Duration::from_secs(5);

/// A program that hangs on so many queries in a row is not asked any more.
const MOST_HANGS: u64 = 20;

/// A program as a subject.
pub struct Program {
    name: String,
    command: Command,
    tolerance: Tolerance,
    /// Running programs that nobody is asking.
    idle: Mutex<Vec<Worker>>,
    stderr: Arc<Mutex<Stderr>>,
    starts: AtomicU64,
    hangs_in_a_row: AtomicU64,
}

/// How a program is started and asked.
#[derive(Clone, Debug)]
pub struct Command {
    /// The program and its arguments.
    pub words: Vec<String>,
    /// How queries and answers are written.
    pub wire: Wire,
    /// How long it may take for an answer.
    pub time_limit: Duration,
}

/// What a program did besides answering.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conduct {
    /// How often it was started.
    pub starts: u64,
    /// Answers that were there at the end though nothing was asked any more.
    pub surplus: u64,
    /// What it wrote to its standard error; of much the end.
    pub stderr: String,
}

/// A text is no command.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CommandError {
    /// There is no word in it.
    Empty,
    /// A quote in it is not closed.
    Quotes,
}

impl Command {
    /// The command of this text, split into words as a POSIX shell splits them; nothing else of a
    /// shell.
    ///
    /// # Errors
    ///
    /// [`CommandError`] if there is no word, or a quote is not closed.
    pub fn parse(text: &str, wire: Wire, time_limit: Duration) -> Result<Self, CommandError> {
        let words = shlex::split(text).ok_or(CommandError::Quotes)?;
        match words.is_empty() {
            true => Err(CommandError::Empty),
            false => Ok(Command {
                words,
                wire,
                time_limit,
            }),
        }
    }
}

impl Conduct {
    /// Adds what the same program did elsewhere.
    pub fn add(&mut self, other: Conduct) {
        self.starts += other.starts;
        self.surplus += other.surplus;
        self.stderr += &other.stderr;
    }
}

impl Program {
    /// The program with this command, started once to see that it can be.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if it cannot be started.
    pub fn start(name: impl Into<String>, command: Command) -> io::Result<Self> {
        let program = Program {
            name: name.into(),
            command,
            tolerance: Tolerance::NONE,
            idle: Mutex::default(),
            stderr: Arc::default(),
            starts: AtomicU64::new(0),
            hangs_in_a_row: AtomicU64::new(0),
        };
        let worker = program.start_worker()?;
        program.idle().push(worker);
        Ok(program)
    }

    /// Declares how far off its answers may be; nothing, unless this is called.
    pub fn declare(&mut self, tolerance: Tolerance) {
        self.tolerance = tolerance;
    }

    /// Ends the running programs, by the end of their input, and says what they did.
    pub fn finish(&self) -> Conduct {
        let idle = std::mem::take(&mut *self.idle());
        let surplus = idle.into_iter().map(Worker::finish).sum();
        self.wait_for_stderr();
        Conduct {
            starts: self.starts.load(Ordering::Relaxed),
            surplus,
            stderr: lock(&self.stderr).text(),
        }
    }

    /// The answers to casts of boxes, as many and in their order, of what is asked in
    /// [bytes](Wire::Binary); the other form has no such queries.
    pub fn cast_answers(&self, casts: &[BoxCast]) -> Vec<Result<Answer, NoAnswer>> {
        self.all_answers(casts)
    }

    /// Waits until all that was written there is kept; whoever reads it holds the other references.
    /// What a program started itself may keep it open: that is not waited for.
    fn wait_for_stderr(&self) {
        let start = Instant::now();
        while Arc::strong_count(&self.stderr) > 1 && start.elapsed() < GRACE {
            thread::sleep(Duration::from_millis(1));
        }
    }

    fn idle(&self) -> MutexGuard<'_, Vec<Worker>> {
        lock(&self.idle)
    }

    fn start_worker(&self) -> io::Result<Worker> {
        self.starts.fetch_add(1, Ordering::Relaxed);
        Worker::start(&self.command, Arc::clone(&self.stderr))
    }

    /// Answers to the first of these queries, at least one. The last of them may be a lapse that
    /// ended the program.
    fn some_answers(&self, queries: &[impl AskedQuery]) -> Vec<Result<Answer, NoAnswer>> {
        if self.hangs_in_a_row.load(Ordering::Relaxed) >= MOST_HANGS {
            let detail = format!("it hung on {MOST_HANGS} queries in a row");
            let lapse = Lapse::new(LapseKind::GivenUp, detail);
            return vec![Err(lapse.into()); queries.len()];
        }
        let idle = self.idle().pop();
        let mut worker = match idle.map_or_else(|| self.start_worker(), Ok) {
            Ok(worker) => worker,
            Err(error) => {
                let detail = format!("cannot be started: {error}");
                return vec![Err(Lapse::new(LapseKind::Crashed, detail).into())];
            }
        };
        let mut answers = Vec::with_capacity(queries.len());
        match worker.ask(queries, &mut answers) {
            Ok(()) => self.idle().push(worker),
            Err(lapse) => answers.push(Err(lapse.into())),
        }
        self.count_hangs(&answers);
        answers
    }

    /// Answers to all of these queries; refusals, if they cannot be written in the form that it reads.
    fn all_answers<Q: AskedQuery>(&self, queries: &[Q]) -> Vec<Result<Answer, NoAnswer>> {
        if !Q::has_form(self.command.wire) {
            let refusals = queries.iter().map(|query| Err(query.refusal()));
            return refusals.collect();
        }
        let mut answers = Vec::with_capacity(queries.len());
        while answers.len() < queries.len() {
            answers.extend(self.some_answers(&queries[answers.len()..]));
        }
        answers
    }

    /// Only the last answer can be a hang.
    fn count_hangs(&self, answers: &[Result<Answer, NoAnswer>]) {
        let is_hang = |answer: &Result<_, NoAnswer>| matches!(answer, Err(NoAnswer::Lapse(lapse)) if lapse.kind == LapseKind::Hung);
        if !answers.iter().all(is_hang) {
            self.hangs_in_a_row.store(0, Ordering::Relaxed);
        }
        if answers.last().is_some_and(is_hang) {
            self.hangs_in_a_row.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Subject for Program {
    fn name(&self) -> &str {
        &self.name
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        self.some_answers(std::slice::from_ref(query)).remove(0)
    }

    fn answers(&self, queries: &[Query]) -> Vec<Result<Answer, NoAnswer>> {
        self.all_answers(queries)
    }

    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        self.all_answers(std::slice::from_ref(query)).remove(0)
    }

    /// Of what is asked in [lines](Wire::Lines); the other form has no such queries.
    fn turning_answers(&self, queries: &[RigidQuery]) -> Vec<Result<Answer, NoAnswer>> {
        self.all_answers(queries)
    }

    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.finish();
    }
}

impl fmt::Display for CommandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            CommandError::Empty => "names no program",
            CommandError::Quotes => "has a quote that is not closed",
        })
    }
}

impl std::error::Error for CommandError {}

/// What a lock guards here stays whole if a thread panics.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
