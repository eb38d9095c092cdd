//! Who answers: subjects of the registry, and programs of the user.

use std::process;
use std::slice;
use std::time::Duration;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof::narrow::Tolerance;
use tunnelproof_reference::certify::table;
use tunnelproof_reference::program::wire::Wire;
use tunnelproof_reference::program::{self, Command, Program};
use tunnelproof_reference::registry;
use tunnelproof_reference::subject::Subject;

use super::Failure;
use super::sources::once;

/// A subject that is asked for.
#[derive(Clone)]
pub(super) enum Asked {
    Known(&'static dyn Subject),
    /// A program, by the text that asks for it: `cmd:` and a command, or `lib:` and the path of a
    /// library.
    Program(String),
}

impl Asked {
    fn name(&self) -> &str {
        match self {
            Asked::Known(subject) => subject.name(),
            Asked::Program(name) => name,
        }
    }
}

/// Several of them, separated by commas. A command has commas of its own: it ends the list. So may
/// the path of a library: what ends it is a comma before another subject.
#[derive(Clone)]
pub(super) struct AskedList(Vec<Asked>);

/// How programs are asked.
#[derive(Args)]
pub(super) struct Programs {
    /// How a program reads queries and writes answers
    #[arg(long, value_name = "FORM", default_value = "lines", value_parser = wire())]
    wire: Wire,
    /// How long a program may take for an answer, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = program::TIME_LIMIT.as_secs_f64(), value_parser = seconds, allow_negative_numbers = true)]
    time_limit: f64,
}

/// What programs are permitted.
#[derive(Args, Clone, Copy, Default)]
pub(super) struct Permit {
    /// How far off the programs and libraries that are judged declare their answers to be: "near" in
    /// metres for a hit of a pair that only comes so near, "late" in steps for a time of impact
    #[arg(long, value_name = "near=METRES,late=STEPS", value_parser = tolerance)]
    permit: Option<Tolerance>,
}

/// A subject that answers.
pub(super) enum Answering {
    Known(&'static dyn Subject),
    Program(Box<Program>),
}

/// What the name of a program starts with.
const COMMAND: &str = "cmd:";

/// What the name of a shared library starts with. It is one more program: this one, with the
/// library in it.
const LIBRARY: &str = "lib:";

/// That these can be asked about bodies that turn.
///
/// # Errors
///
/// A subject that is known to take none.
pub(super) fn check_turning(answering: &[Answering]) -> Result<(), Failure> {
    let takers = registry::turning_subjects().map(|subject| subject.name());
    let mut names = answering.iter().map(|one| one.subject().name());
    match names.find(|name| registry::by_name(name).is_some() && !takers.contains(name)) {
        None => Ok(()),
        Some(name) => Err(Failure::Program {
            name: name.to_owned(),
            reason: format!(
                "takes no queries of bodies that turn; {} do, and programs (cmd:, lib:)",
                takers.join(", ")
            ),
        }),
    }
}

/// The command of a process that hosts a library, which is seen to have what it needs.
fn hosted(path: &str, time_limit: Duration) -> Result<Command, String> {
    if path.is_empty() {
        return Err(format!("no path after {LIBRARY}"));
    }
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let own = own.to_string_lossy().into_owned();
    let check = process::Command::new(&own)
        .args(["lib-host", "--check", path])
        .output();
    let check = check.map_err(|error| error.to_string())?;
    if !check.status.success() {
        let message = String::from_utf8_lossy(&check.stderr);
        let message = message.trim().strip_prefix(path).unwrap_or(message.trim());
        let message = message.trim_start_matches(": ");
        return Err(match message.is_empty() {
            true => format!("loading it ended with {}", check.status),
            false => message.replace('\n', " "),
        });
    }
    Ok(Command {
        words: [own, "lib-host".to_owned(), path.to_owned()].to_vec(),
        wire: Wire::Binary,
        time_limit,
    })
}

impl Programs {
    const USUAL: Programs = Programs {
        wire: Wire::Lines,
        time_limit: program::TIME_LIMIT.as_secs_f64(),
    };

    /// Starts the subject, if it is a program.
    pub(super) fn start(&self, asked: &Asked) -> Result<Answering, Failure> {
        let answering = self.start_one(asked)?;
        self.check_used(slice::from_ref(&answering))?;
        Ok(answering)
    }

    fn start_one(&self, asked: &Asked) -> Result<Answering, Failure> {
        let name = match asked {
            Asked::Known(subject) => return Ok(Answering::Known(*subject)),
            Asked::Program(name) => name,
        };
        let failure = |reason: String| Failure::Program {
            name: name.clone(),
            reason,
        };
        let limit = Duration::from_secs_f64(self.time_limit);
        let command = match name.strip_prefix(LIBRARY) {
            Some(path) => hosted(path, limit),
            None => {
                let text = name.strip_prefix(COMMAND).unwrap_or(name);
                Command::parse(text, self.wire, limit).map_err(|error| error.to_string())
            }
        };
        let command = command.map_err(failure)?;
        let program = Program::start(name, command);
        let program = program.map_err(|error| failure(format!("cannot be started: {error}")))?;
        Ok(Answering::Program(Box::new(program)))
    }

    /// That a program can be asked casts of boxes.
    ///
    /// # Errors
    ///
    /// A program that reads lines.
    pub(super) fn check_casts(&self, program: &Program) -> Result<(), Failure> {
        match program.name().starts_with(LIBRARY) || self.wire == Wire::Binary {
            true => Ok(()),
            false => Err(Failure::Program {
                name: program.name().to_owned(),
                reason: "casts of boxes are asked in bytes alone: pass --wire binary".to_owned(),
            }),
        }
    }

    /// The values of the options, to be written.
    pub(super) fn values(&self) -> [String; 2] {
        [self.wire.name().to_owned(), self.time_limit.to_string()]
    }

    /// The options that are not the default ones, to be written.
    pub(super) fn options(&self) -> String {
        let [wire, limit] = self.values();
        let [lines, seconds] = Programs::USUAL.values();
        let options = [("wire", wire, lines), ("time-limit", limit, seconds)].into_iter();
        let options = options.filter(|(_, value, usual)| value != usual);
        let options = options.map(|(name, value, _)| format!("--{name} {value}"));
        options.collect::<Vec<_>>().join(" ")
    }

    /// Starts all of them, each once.
    pub(super) fn start_all(&self, lists: &[AskedList]) -> Result<Vec<Answering>, Failure> {
        let asked = once(lists.iter().flat_map(|AskedList(list)| list), |asked| {
            asked.name()
        });
        let answering = asked.into_iter().map(|asked| self.start_one(asked));
        let answering = answering.collect::<Result<Vec<_>, _>>()?;
        self.check_used(&answering)?;
        Ok(answering)
    }

    /// That an option which says how programs are asked is not there without any.
    pub(super) fn check_used(&self, answering: &[Answering]) -> Result<(), Failure> {
        let options = self.options();
        match options.is_empty() || answering.iter().any(|one| one.program().is_some()) {
            true => Ok(()),
            false => Err(Failure::NoProgram(options)),
        }
    }
}

impl Permit {
    /// Declares it of all programs among them. It is an error if there is none.
    pub(super) fn grant(self, answering: &mut [Answering]) -> Result<(), Failure> {
        let Some(tolerance) = self.permit else {
            return Ok(());
        };
        let option = self.options();
        let mut is_granted = false;
        for answering in answering {
            if let Answering::Program(program) = answering {
                program.declare(tolerance);
                is_granted = true;
            }
        }
        is_granted.then_some(()).ok_or(Failure::NoProgram(option))
    }

    /// The option, if it is given, to be written.
    pub(super) fn options(self) -> String {
        let value = self.value();
        value.map_or_else(String::new, |value| format!("--permit {value}"))
    }

    /// The value of the option, to be written.
    pub(super) fn value(self) -> Option<String> {
        let written = |tolerance| match table::tolerance(tolerance) {
            nothing if nothing.is_empty() => "near=0".to_owned(),
            some => some,
        };
        self.permit.map(written)
    }
}

impl Answering {
    pub(super) fn subject(&self) -> &dyn Subject {
        match self {
            Answering::Known(subject) => *subject,
            Answering::Program(program) => program.as_ref(),
        }
    }

    /// The program, if it is one.
    pub(super) fn program(&self) -> Option<&Program> {
        match self {
            Answering::Known(_) => None,
            Answering::Program(program) => Some(program),
        }
    }
}

fn is_program(text: &str) -> bool {
    text.starts_with(COMMAND) || text.starts_with(LIBRARY)
}

/// Reads the name of a subject, or a command.
pub(super) fn asked(text: &str) -> Result<Asked, String> {
    if is_program(text) {
        return Ok(Asked::Program(text.to_owned()));
    }
    registry::by_name(text).map(Asked::Known).ok_or_else(|| {
        let names = registry::subjects().map(|subject| subject.name().to_owned());
        let names = names.join(", ");
        format!("no such subject; there are {names}, {COMMAND}COMMAND and {LIBRARY}PATH")
    })
}

/// Reads a list of them.
pub(super) fn asked_list(text: &str) -> Result<AskedList, String> {
    let mut list = Vec::new();
    let mut rest = Some(text);
    while let Some(text) = rest.map(str::trim_start) {
        let is_end = |comma: &usize| {
            let next = text[comma + 1..].split(',').next();
            !is_program(text)
                || text.starts_with(LIBRARY) && next.is_some_and(|next| asked(next.trim()).is_ok())
        };
        let mut commas = text.match_indices(',').map(|(comma, _)| comma);
        let (first, more) = match commas.find(is_end) {
            Some(comma) => (&text[..comma], Some(&text[comma + 1..])),
            None => (text, None),
        };
        // What stands behind a command is the command's.
        let is_command = first.starts_with(COMMAND);
        list.push(asked(if is_command { first } else { first.trim_end() })?);
        rest = more;
    }
    Ok(AskedList(list))
}

fn wire() -> impl TypedValueParser<Value = Wire> {
    PossibleValuesParser::new(Wire::ALL.map(Wire::name))
        .try_map(|name| Wire::from_name(&name).ok_or("unknown form"))
}

/// Reads what is permitted, such as `late=1e-9,near=1e-8`.
fn tolerance(text: &str) -> Result<Tolerance, String> {
    let [mut near, mut late] = [None; 2];
    for part in text.split(',') {
        let (name, value) = part
            .split_once('=')
            .ok_or_else(|| format!("{part:?} is not near=METRES or late=STEPS"))?;
        let place = match name {
            "near" => &mut near,
            "late" => &mut late,
            _ => return Err(format!("{name:?} is neither near nor late")),
        };
        let number = value.parse::<f64>().ok();
        let number = number.filter(|number| *number >= 0.0 && number.is_finite());
        let number = number.ok_or_else(|| format!("{name} is {value:?}, not a number from 0"))?;
        if place.replace(number).is_some() {
            return Err(format!("{name} is there twice"));
        }
    }
    Ok(Tolerance {
        near: near.unwrap_or(0.0),
        late: late.unwrap_or(0.0),
    })
}

/// Reads a time, of a day at most.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 86_400.0 => Ok(seconds),
        _ => Err("not a number above 0, of at most 86400".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_subjects_are_split_at_commas_before_subjects() {
        let names = |text| {
            let AskedList(list) = asked_list(text).ok()?;
            let names: Vec<_> = list.iter().map(Asked::name).collect();
            Some(names.join(" | "))
        };
        for (text, expected) in [
            ("oracle,certified", "oracle | certified"),
            (" oracle, certified ", "oracle | certified"),
            (
                "lib:a.so, oracle , lib:b.so",
                "lib:a.so | oracle | lib:b.so",
            ),
            ("lib:a.so,oracle,lib:b.so", "lib:a.so | oracle | lib:b.so"),
            ("lib:a,b.so,cmd:./c 1,2", "lib:a,b.so | cmd:./c 1,2"),
            ("oracle, cmd:./c ", "oracle | cmd:./c "),
            ("oracle,cmd:./c 1,oracle", "oracle | cmd:./c 1,oracle"),
        ] {
            assert_eq!(names(text).as_deref(), Some(expected), "{text}");
        }
        assert_eq!(names("oracle,nobody"), None);
    }
}
