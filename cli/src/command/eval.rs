//! `eval`: a line of JSON for every query.

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;
use std::slice;

use clap::Args;
use tunnelproof_reference::certify::batch::map_chunks_in_order;
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::corpus::turning::{self, TurningEntry};
use tunnelproof_reference::corpus::{Entry, folder};
use tunnelproof_reference::report::answer;
use tunnelproof_reference::subject::Subject;

use super::output::standard_output;
use super::sources::of_files;
use super::subjects::{Asked, Programs, asked, check_turning};
use super::{Failure, Reading};

/// Answer every query of files, a line of JSON each
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof eval queries.jsonl
  tunnelproof eval --subject thesis --kind edge-edge unit-tests/*.csv
  head -1 queries.jsonl | tunnelproof eval -

A query is a line such as
  {\"id\": \"a\", \"kind\": \"edge-edge\", \"points\": [[0, 0, 0], ...]}
with the eight points A B C D at the start and A B C D at the end of the step; numbers may be hex
floats in quotes (\"0x1.8p-3\"). A .csv is in the public CCD query format.

With --turning a query is a line such as
  {\"id\": \"a\", \"kind\": \"edge-turning-edge\", \"points\": [[0, 0, 0], ...],
   \"local\": [[0, 0, 0], ...], \"poses\": [[0, 0, 0, 1, 0, 0, 0], ...]}
with the points A B at the start and A B at the end (or A and A), C D (or B C D) in the body's frame,
and the body's centre and quaternion w x y z at the start and at the end.

An exact number stands between its neighbours in f64, {\"below\": B, \"above\": A}, equal if it is
an f64 itself.")]
pub(super) struct Eval {
    /// Files of queries (.jsonl or .csv), or folders of them; - is the standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Who answers: a subject by its name, cmd: and the command of a program, or lib: and the path
    /// of a shared library
    #[arg(long, default_value = "oracle", value_parser = asked)]
    subject: Asked,
    /// The files hold queries of bodies that turn; oracle, difference, certified, programs and libraries answer them
    #[arg(long, conflicts_with_all = ["kind", "radius"])]
    turning: bool,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    reading: Reading,
}

impl Eval {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        if self.turning {
            return self.run_turning();
        }
        let answering = self.programs.start(&self.subject)?;
        let mut output = BufWriter::new(io::stdout().lock());
        for source in of_files(&self.files, &self.reading)? {
            let entries = source.entries()?;
            map_chunks_in_order(
                entries.map(|entry| entry.map_err(Failure::from)),
                CHUNK,
                |entries| answer_lines(answering.subject(), &source, &entries),
                |lines: Vec<String>| write_lines(&mut output, &lines),
            )?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Eval {
    /// The same of bodies that turn.
    fn run_turning(self) -> Result<ExitCode, Failure> {
        let answering = self.programs.start(&self.subject)?;
        check_turning(slice::from_ref(&answering))?;
        let mut output = BufWriter::new(io::stdout().lock());
        let files = self.files.iter().map(|path| folder::files(path));
        for path in files.collect::<Result<Vec<_>, _>>()?.concat() {
            map_chunks_in_order(
                turning::open(&path)?.map(|entry| entry.map_err(Failure::from)),
                CHUNK,
                |entries: Vec<TurningEntry>| turning_lines(answering.subject(), &entries),
                |lines: Vec<String>| write_lines(&mut output, &lines),
            )?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// How many queries a subject is asked for at once.
const CHUNK: usize = 64;

fn turning_lines(subject: &dyn Subject, entries: &[TurningEntry]) -> Vec<Result<String, Failure>> {
    let queries: Vec<_> = entries.iter().map(|entry| entry.query).collect();
    let answers = subject.turning_answers(&queries).into_iter().zip(entries);
    answers
        .map(|(answer, entry)| match answer {
            Ok(answer) => Ok(answer::turning_line(&entry.id, &answer)),
            Err(reason) => Err(RunError::NoAnswer {
                place: entry.id.clone(),
                reason,
            }
            .into()),
        })
        .collect()
}

fn answer_lines(
    subject: &dyn Subject,
    source: &Source,
    entries: &[Entry],
) -> Vec<Result<String, Failure>> {
    let queries: Vec<_> = entries.iter().map(|entry| entry.query).collect();
    let answers = subject.answers(&queries).into_iter().zip(entries);
    answers
        .map(|(answer, entry)| match answer {
            Ok(answer) => Ok(answer::line(&entry.id, entry.query.kind(), &answer)),
            Err(reason) => Err(RunError::NoAnswer {
                place: source.place(entry),
                reason,
            }
            .into()),
        })
        .collect()
}

pub(super) fn write_lines(output: &mut impl Write, lines: &[String]) -> Result<(), Failure> {
    lines
        .iter()
        .try_for_each(|line| writeln!(output, "{line}"))
        .and_then(|()| output.flush())
        .map_err(standard_output)
}
