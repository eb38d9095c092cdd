//! Lets a shared library answer queries in a process of its own, so that a crash in it is not one
//! of the judge.
//!
//! `include/tunnelproof_subject.h` says what the library offers, `docs/bring-your-own.md` how
//! queries and answers are framed.

use std::ffi::c_int;
use std::fmt;
use std::fs::File;
use std::io::{self, BufReader, Read, Write};

use libloading::Library;
use tunnelproof_float_env::{Control, with_own};

/// `tunnelproof_edge_edge` and `tunnelproof_vertex_face`.
type Answer = unsafe extern "C" fn(*const [f64; 24], *const [f64; 2], *mut f64) -> c_int;

/// The bytes of a query after those of its length.
const QUERY: usize = 224;
/// The bytes of an answer after those of its length.
const ANSWER: u32 = 24;
/// The answer to queries of a kind that the library does not take.
const UNSUPPORTED: c_int = 2;

/// The names of the functions, by the number of the kind of query.
const FUNCTIONS: [&str; 2] = ["tunnelproof_edge_edge", "tunnelproof_vertex_face"];

/// What this project's own C library calls them, so that libraries that are linked with it can
/// define the functions above.
const OWN_FUNCTIONS: [&str; 2] = [
    "tunnelproof_certified_edge_edge",
    "tunnelproof_certified_vertex_face",
];

/// A shared library that answers queries.
pub struct Host {
    functions: [Option<Answer>; 2],
    /// The floating-point environment that the library has set for itself, as one that is linked
    /// with `-ffast-math` does when it is loaded: it answers in this one, as in the user's program.
    environment: Control,
    answers: Output,
    /// Keeps the functions where they are.
    _library: Library,
}

#[cfg(unix)]
type Output = File;
#[cfg(not(unix))]
type Output = io::Stdout;

/// A library that cannot answer.
#[derive(Debug)]
pub enum HostError {
    /// The standard output cannot be kept from it.
    Output(io::Error),
    /// It cannot be loaded.
    Load(libloading::Error),
    /// It has none of the functions.
    NoFunction,
}

impl Host {
    /// Loads the library at this path. Its initialisers run: do this in a process of its own. From
    /// now on, what the process writes to the standard output goes to the standard error, but for
    /// the answers. What they do to the floating-point environment holds while the library answers,
    /// and at no other time.
    ///
    /// # Errors
    ///
    /// [`HostError`] if it cannot be loaded or has none of the functions.
    pub fn load(path: &str) -> Result<Self, HostError> {
        // Before its initialisers run, which may print.
        let answers = own_output().map_err(HostError::Output)?;
        let mut environment = Control::DEFAULT;
        // SAFETY: the user asks for the code in this library to be run; whatever its initialisers
        // do, they do in a process that has nothing to lose. Nothing else runs there.
        let library = unsafe { with_own(&mut environment, || Library::new(path)) };
        let library = library.map_err(HostError::Load)?;
        let find = |names: [&str; 2]| {
            names.map(|name| {
                // SAFETY: the header gives these names this type, and the library says by them that
                // it keeps to the header; our own library has these.
                let function = unsafe { library.get::<Answer>(name.as_bytes()) };
                function.ok().map(|function| *function)
            })
        };
        let mut functions = find(FUNCTIONS);
        // A library is searched together with those that it is linked with. One that is linked with
        // ours and has no functions of its own is not to be judged by ours.
        if functions == [None; 2] && names_own_functions(path) {
            functions = find(OWN_FUNCTIONS);
        }
        match functions.iter().any(Option::is_some) {
            true => Ok(Host {
                functions,
                environment,
                answers,
                _library: library,
            }),
            false => Err(HostError::NoFunction),
        }
    }

    /// Answers framed queries from the standard input on the standard output, to the end of the
    /// input.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if the input is cut off, or the output cannot be written.
    pub fn serve(&mut self) -> io::Result<()> {
        let mut queries = BufReader::new(io::stdin().lock());
        while let Some(query) = read(&mut queries)? {
            // At once: an answer that a crash at the next query loses would be counted as that of
            // this one.
            let answer = self.answer(&query);
            self.answers.write_all(&answer)?;
            self.answers.flush()?;
        }
        Ok(())
    }

    fn answer(&mut self, query: &[u8; QUERY]) -> Vec<u8> {
        let number = |index: usize| {
            let at = 16 + 8 * index;
            let bytes = query[at..at + 8].iter().rev();
            f64::from_bits(bytes.fold(0, |bits, byte| bits << 8 | u64::from(*byte)))
        };
        let radius: [f64; 2] = std::array::from_fn(number);
        let points: [f64; 24] = std::array::from_fn(|index| number(index + 2));
        let mut toi = f64::NAN;
        let function = self.functions.get(usize::from(query[8])).copied().flatten();
        let verdict = match function {
            None => UNSUPPORTED,
            // SAFETY: the function has the type of the header; the three pointers are to memory of
            // the sizes that the header states, which lives until the call ends, and only `toi` is
            // given to be written. It is foreign code, and nothing else runs there.
            Some(function) => unsafe {
                with_own(&mut self.environment, || {
                    function(&raw const points, &raw const radius, &raw mut toi)
                })
            },
        };
        let mut answer = ANSWER.to_le_bytes().to_vec();
        answer.extend(&query[..8]);
        answer.extend(verdict.to_le_bytes());
        answer.extend([0; 4]);
        answer.extend(toi.to_le_bytes());
        answer
    }
}

impl fmt::Display for HostError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            HostError::Output(error) => {
                write!(f, "the standard output cannot be kept from it: {error}")
            }
            HostError::Load(error) => write!(f, "cannot be loaded: {error}"),
            HostError::NoFunction => {
                let [edges, face] = FUNCTIONS;
                write!(
                    f,
                    "has neither {edges} nor {face}; include/tunnelproof_subject.h declares them"
                )
            }
        }
    }
}

impl std::error::Error for HostError {}

/// Whether the names of our own library's functions are in a file.
fn names_own_functions(path: &str) -> bool {
    let bytes = std::fs::read(path).unwrap_or_default();
    let is_named = |name: &str| {
        bytes
            .windows(name.len())
            .any(|part| part == name.as_bytes())
    };
    OWN_FUNCTIONS.iter().all(|name| is_named(name))
}

/// The next query; `None` at the end.
fn read(queries: &mut impl Read) -> io::Result<Option<[u8; QUERY]>> {
    let mut frame = [0; QUERY + 4];
    let mut filled = 0;
    while filled < frame.len() {
        let count = match queries.read(&mut frame[filled..]) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            other => other?,
        };
        match count {
            0 if filled == 0 => return Ok(None),
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            count => filled += count,
        }
    }
    let mut query = [0; QUERY];
    query.copy_from_slice(&frame[4..]);
    Ok(Some(query))
}

/// The standard output, which from now on is the standard error for everyone else in this process.
#[cfg(unix)]
fn own_output() -> io::Result<Output> {
    let own = rustix::io::dup(rustix::stdio::stdout())?;
    rustix::stdio::dup2_stdout(rustix::stdio::stderr())?;
    Ok(File::from(own))
}

/// The standard output, which the library may write to as well.
#[cfg(not(unix))]
fn own_output() -> io::Result<Output> {
    Ok(io::stdout())
}
