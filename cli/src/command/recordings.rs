//! Recordings of a run, and of what went on from its states, read as one.

use std::collections::VecDeque;
use std::fs::File;
use std::io::BufReader;
use std::iter::Peekable;
use std::path::{Path, PathBuf};

use tunnelproof::wire::StepRecord;
use tunnelproof::wire::recording::{Header, Recording, WireSummary};

use super::Failure;

/// The steps of several recordings, of each those before the next one starts. So where a run went
/// on from a state that is older than its end, the later recording has the word, and an end that is
/// cut off is not read.
pub(super) struct Recordings<'a> {
    current: One<'a>,
    others: VecDeque<One<'a>>,
    /// The step that is due, after the first.
    due: Option<u64>,
}

struct One<'a> {
    path: &'a Path,
    header: Header,
    steps: Peekable<Recording<BufReader<File>>>,
}

impl<'a> Recordings<'a> {
    /// Opens them. They have to be of one world.
    pub(super) fn open(paths: &'a [PathBuf]) -> Result<Self, Failure> {
        let all = paths.iter().map(|path| One::open(path));
        let mut others: VecDeque<One<'_>> = all.collect::<Result<_, _>>()?;
        let current = others.pop_front().ok_or(Failure::Nothing)?;
        for other in &others {
            if !is_of_one_world(&current.header, &other.header) {
                let first = current.path.display();
                return Err(other.wrong(format!("has other wires or bodies than {first}")));
            }
        }
        Ok(Recordings {
            current,
            others,
            due: None,
        })
    }

    /// What the first one is of.
    pub(super) fn header(&self) -> &Header {
        &self.current.header
    }

    /// The next step; none at the end of the last recording.
    pub(super) fn next_step(&mut self) -> Result<Option<StepRecord>, Failure> {
        let mut until = self.start_of_next()?;
        while until.is_some() && until == self.due {
            if let Some(next) = self.others.pop_front() {
                self.current = next;
            }
            until = self.start_of_next()?;
        }
        let step = self.current.next_step()?;
        let is_before = |step: &StepRecord| until.is_none_or(|until| step.step < until);
        if let Some(until) = until
            && !step.as_ref().is_some_and(is_before)
        {
            let last = until.saturating_sub(1);
            let problem = format!("lacks step {last}, after which the next recording starts");
            return Err(self.current.wrong(problem));
        }
        self.due = step.as_ref().map(|step| step.step + 1);
        Ok(step)
    }

    /// The first step of the next recording that has any.
    fn start_of_next(&mut self) -> Result<Option<u64>, Failure> {
        while let Some(next) = self.others.front_mut() {
            match next.steps.peek() {
                Some(Ok(step)) => return Ok(Some(step.step)),
                Some(Err(error)) => {
                    let problem = error.to_string();
                    return Err(next.wrong(problem));
                }
                None => self.others.pop_front(),
            };
        }
        Ok(None)
    }
}

impl<'a> One<'a> {
    fn open(path: &'a Path) -> Result<Self, Failure> {
        let file = File::open(path).map_err(|error| Failure::file(path, error))?;
        let recording = Recording::open(BufReader::new(file));
        let recording = recording.map_err(|error| Failure::file(path, error))?;
        Ok(One {
            path,
            header: recording.header().clone(),
            steps: recording.peekable(),
        })
    }

    fn next_step(&mut self) -> Result<Option<StepRecord>, Failure> {
        let step = self.steps.next().transpose();
        step.map_err(|error| self.wrong(error))
    }

    fn wrong(&self, error: impl ToString) -> Failure {
        Failure::file(self.path, error)
    }
}

/// Settings and resolutions may change when a run goes on.
fn is_of_one_world(first: &Header, other: &Header) -> bool {
    let material = |wire: &WireSummary| wire.material;
    let wires = |header: &Header| header.wires.iter().map(material).collect::<Vec<_>>();
    first.bodies == other.bodies && wires(first) == wires(other)
}
