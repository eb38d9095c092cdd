//! One running program.
//!
//! A thread writes to it and two read from it, so that it can neither block this side nor be
//! blocked by it for good: neither side waits for a pipe that the other has to empty.

use std::io::{self, BufReader, Write};
use std::process::{Child, ChildStdin, Command as Process, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use crate::subject::{Answer, Lapse, LapseKind, NoAnswer};

use super::Command;
use super::stderr::{self, Stderr};
use super::wire::{AskedQuery, Wire};

/// How many messages are read ahead.
const AHEAD: usize = 256;

/// How long a program that has closed its output may take to end.
pub(super) const GRACE: Duration = Duration::from_secs(1);

/// A running program with nothing asked of it. Ended when it is dropped.
pub(super) struct Worker {
    child: Child,
    /// `None` once its input has ended.
    input: Option<Sender<Vec<u8>>>,
    output: Receiver<Vec<u8>>,
    wire: Wire,
    time_limit: Duration,
    asked: u64,
}

impl Worker {
    /// Starts a program.
    pub(super) fn start(command: &Command, stderr: Arc<Mutex<Stderr>>) -> io::Result<Self> {
        let mut process = Process::new(&command.words[0]);
        process
            .args(&command.words[1..])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        in_own_group(&mut process);
        let mut child = process.spawn()?;
        let (input, queries) = channel();
        let (messages, output) = sync_channel(AHEAD);
        if let Some(stdin) = child.stdin.take() {
            thread::spawn(move || write_all(stdin, queries));
        }
        if let Some(stdout) = child.stdout.take() {
            let wire = command.wire;
            let mut reader = BufReader::new(stdout);
            thread::spawn(move || {
                while let Ok(Some(message)) = wire.read(&mut reader) {
                    if messages.send(message).is_err() {
                        return;
                    }
                }
            });
        }
        if let Some(from) = child.stderr.take() {
            thread::spawn(move || stderr::keep(from, &stderr));
        }
        Ok(Worker {
            child,
            input: Some(input),
            output,
            wire: command.wire,
            time_limit: command.time_limit,
            asked: 0,
        })
    }

    /// Asks all queries and adds the answers, in their order.
    ///
    /// # Errors
    ///
    /// [`Lapse`] of the query after those with answers. The program is then out of step or has
    /// ended: it can be asked nothing more.
    pub(super) fn ask(
        &mut self,
        queries: &[impl AskedQuery],
        answers: &mut Vec<Result<Answer, NoAnswer>>,
    ) -> Result<(), Lapse> {
        if self.output.try_recv().is_ok() {
            let detail = "wrote an answer before anything was asked";
            return Err(Lapse::new(LapseKind::Misplaced, detail));
        }
        let first = self.asked;
        let mut bytes = Vec::new();
        for (id, query) in (first..).zip(queries) {
            query.write(self.wire, id, &mut bytes);
        }
        self.asked += queries.len() as u64;
        if let Some(input) = &self.input {
            // A program that has ended is noticed when its answer is due.
            let _ = input.send(bytes);
        }
        for (id, query) in (first..).zip(queries) {
            let message = self.wire.parse(&self.message()?)?;
            if let Some(other) = message.id.filter(|other| *other != id) {
                let detail = format!("wrote the answer to id {other} where id {id} is due");
                return Err(Lapse::new(LapseKind::Misplaced, detail));
            }
            answers.push(message.reply.to(query));
        }
        Ok(())
    }

    /// The next message, waited for until it is late.
    fn message(&mut self) -> Result<Vec<u8>, Lapse> {
        self.output
            .recv_timeout(self.time_limit)
            .map_err(|error| match error {
                RecvTimeoutError::Timeout => {
                    let detail = format!("no answer within {:?}", self.time_limit);
                    Lapse::new(LapseKind::Hung, detail)
                }
                RecvTimeoutError::Disconnected => Lapse::new(LapseKind::Crashed, self.ending()),
            })
    }

    /// How the program ended that has closed its output.
    fn ending(&mut self) -> String {
        match self.wait(GRACE) {
            Some(status) => format!("ended with {status}"),
            None => "closed its output".to_owned(),
        }
    }

    /// Waits until the program has ended, but no longer than this.
    fn wait(&mut self, longest: Duration) -> Option<ExitStatus> {
        let start = Instant::now();
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if start.elapsed() < longest => thread::sleep(Duration::from_millis(1)),
                _ => return None,
            }
        }
    }

    /// Ends the input and waits for the program to end. Says how many messages were left.
    pub(super) fn finish(mut self) -> u64 {
        self.input = None;
        let start = Instant::now();
        let mut left = 0;
        while let Some(time) = self.time_limit.checked_sub(start.elapsed()) {
            match self.output.recv_timeout(time) {
                Ok(_) => left += 1,
                Err(_) => break,
            }
        }
        self.wait(GRACE);
        left
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        if !matches!(self.child.try_wait(), Ok(Some(_))) {
            kill(&mut self.child);
            let _ = self.child.wait();
        }
    }
}

fn write_all(mut stdin: ChildStdin, queries: Receiver<Vec<u8>>) {
    for bytes in queries {
        if stdin
            .write_all(&bytes)
            .and_then(|()| stdin.flush())
            .is_err()
        {
            return;
        }
    }
}

/// So that what the program starts itself can be ended with it.
#[cfg(unix)]
fn in_own_group(process: &mut Process) {
    std::os::unix::process::CommandExt::process_group(process, 0);
}

#[cfg(not(unix))]
fn in_own_group(_process: &mut Process) {}

/// Ends a program and, where there are groups of processes, all that it has started.
fn kill(child: &mut Child) {
    #[cfg(unix)]
    {
        use rustix::process::{Pid, Signal, kill_process_group};
        if let Ok(id) = i32::try_from(child.id())
            && let Some(group) = Pid::from_raw(id)
        {
            let _ = kill_process_group(group, Signal::KILL);
        }
    }
    let _ = child.kill();
}
