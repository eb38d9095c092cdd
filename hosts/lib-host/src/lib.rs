//! Lets a shared library answer queries in a process of its own, so that a crash in it is not one
//! of the judge.
//!
//! `include/tunnelproof_subject.h` says what the library offers, `docs/bring-your-own.md` how
//! queries and answers are framed. This is the only package with `unsafe`.

use std::ffi::c_int;
use std::fmt;
use std::fs::File;
use std::io::{self, BufReader, Read, Write};

use libloading::Library;

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

/// A shared library that answers queries.
pub struct Host {
    functions: [Option<Answer>; 2],
    /// Keeps the functions where they are.
    _library: Library,
}

/// A library that cannot answer.
#[derive(Debug)]
pub enum HostError {
    /// It cannot be loaded.
    Load(libloading::Error),
    /// It has none of the functions.
    NoFunction,
}

impl Host {
    /// Loads the library at this path. Its initialisers run: do this in a process of its own.
    ///
    /// # Errors
    ///
    /// [`HostError`] if it cannot be loaded or has none of the functions.
    pub fn load(path: &str) -> Result<Self, HostError> {
        // SAFETY: the user asks for the code in this library to be run; whatever its initialisers
        // do, they do in a process that has nothing to lose.
        let library = unsafe { Library::new(path) }.map_err(HostError::Load)?;
        let functions = FUNCTIONS.map(|name| {
            // SAFETY: the header gives these names this type, and the library says by them that it
            // keeps to the header.
            let function = unsafe { library.get::<Answer>(name.as_bytes()) };
            function.ok().map(|function| *function)
        });
        match functions.iter().any(Option::is_some) {
            true => Ok(Host {
                functions,
                _library: library,
            }),
            false => Err(HostError::NoFunction),
        }
    }

    /// Answers framed queries from the standard input on the standard output, to the end of the
    /// input. What the library itself writes to the standard output goes to the standard error.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if the input is cut off, or the output cannot be written.
    pub fn serve(&self) -> io::Result<()> {
        let mut queries = BufReader::new(io::stdin().lock());
        let mut answers = own_output()?;
        while let Some(query) = read(&mut queries)? {
            // At once: an answer that a crash at the next query loses would be counted as that of
            // this one.
            answers.write_all(&self.answer(&query))?;
            answers.flush()?;
        }
        Ok(())
    }

    fn answer(&self, query: &[u8; QUERY]) -> Vec<u8> {
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
            // given to be written.
            Some(function) => unsafe {
                function(&raw const points, &raw const radius, &raw mut toi)
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

/// The next query; `None` at the end.
fn read(queries: &mut impl Read) -> io::Result<Option<[u8; QUERY]>> {
    let mut frame = [0; QUERY + 4];
    let mut filled = 0;
    while filled < frame.len() {
        match queries.read(&mut frame[filled..])? {
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
fn own_output() -> io::Result<File> {
    let own = rustix::io::dup(rustix::stdio::stdout())?;
    rustix::stdio::dup2_stdout(rustix::stdio::stderr())?;
    Ok(File::from(own))
}

/// The standard output, which the library may write to as well.
#[cfg(not(unix))]
fn own_output() -> io::Result<io::Stdout> {
    Ok(io::stdout())
}
