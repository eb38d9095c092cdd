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

/// `tunnelproof_edge_turning_edge` and `tunnelproof_vertex_turning_face`: points, points of the body,
/// its poses.
type TurningAnswer = unsafe extern "C" fn(
    *const f64,
    *const f64,
    *const [f64; 14],
    *const [f64; 2],
    *mut f64,
) -> c_int;

/// `tunnelproof_turning_edge_turning_edge` and `tunnelproof_turning_vertex_turning_face`.
type BodiesAnswer =
    unsafe extern "C" fn(*const [f64; 12], *const [f64; 28], *const [f64; 2], *mut f64) -> c_int;

/// `tunnelproof_box_cast`.
type CastAnswer =
    unsafe extern "C" fn(*const [c_int; 2], *const [f64; 30], *const [f64; 2], *mut f64) -> c_int;

/// The bytes of a query after those of its length.
const QUERY: usize = 224;
/// The bytes of a cast of a box after those of its length.
const CAST: usize = 272;
/// The bytes of queries of bodies that turn after those of the length: of an edge and a body, a vertex
/// and a body, and two bodies.
const TURNING: [usize; 3] = [288, 264, 352];
/// The bytes of an answer after those of its length.
const ANSWER: u32 = 24;
/// The answer to queries of a kind that the library does not take.
const UNSUPPORTED: c_int = 2;

/// The names of the functions, by the number of the kind of query.
const FUNCTIONS: [&str; 2] = ["tunnelproof_edge_edge", "tunnelproof_vertex_face"];

/// Those of an edge and of a vertex against a body that turns.
const TURNING_FUNCTIONS: [&str; 2] = [
    "tunnelproof_edge_turning_edge",
    "tunnelproof_vertex_turning_face",
];

/// Those of two bodies that turn.
const BODIES_FUNCTIONS: [&str; 2] = [
    "tunnelproof_turning_edge_turning_edge",
    "tunnelproof_turning_vertex_turning_face",
];

/// The name of the function that answers casts of boxes.
const CAST_FUNCTION: &str = "tunnelproof_box_cast";

/// What this project's own C library calls them, so that libraries that are linked with it can
/// define the functions above.
const OWN_FUNCTIONS: [&str; 2] = [
    "tunnelproof_certified_edge_edge",
    "tunnelproof_certified_vertex_face",
];

/// A shared library that answers queries.
pub struct Host {
    functions: [Option<Answer>; 2],
    turning: [Option<TurningAnswer>; 2],
    bodies: [Option<BodiesAnswer>; 2],
    cast: Option<CastAnswer>,
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
        // SAFETY: the header gives these names this type, and the library says by them that it keeps
        // to the header; our own library has these.
        let find = |names: [&str; 2]| names.map(|name| unsafe { symbol::<Answer>(&library, name) });
        // SAFETY: as above, each with the type that the header gives it.
        let turning = TURNING_FUNCTIONS.map(|name| unsafe { symbol(&library, name) });
        // SAFETY: as above.
        let bodies = BODIES_FUNCTIONS.map(|name| unsafe { symbol(&library, name) });
        let mut functions = find(FUNCTIONS);
        // A library is searched together with those that it is linked with. One that is linked with
        // ours and has no functions of its own is not to be judged by ours.
        if functions == [None; 2] && names_own_functions(path) {
            functions = find(OWN_FUNCTIONS);
        }
        // SAFETY: as above.
        let cast = unsafe { symbol::<CastAnswer>(&library, CAST_FUNCTION) };
        let has_any = functions.iter().any(Option::is_some)
            || turning.iter().any(Option::is_some)
            || bodies.iter().any(Option::is_some)
            || cast.is_some();
        match has_any {
            true => Ok(Host {
                functions,
                turning,
                bodies,
                cast,
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

    fn answer(&mut self, query: &[u8]) -> Vec<u8> {
        let mut toi = f64::NAN;
        let verdict = match query[8] {
            0 | 1 => self.query(query, &mut toi),
            2 => self.cast(query, &mut toi),
            3 => self.turning::<12, 6>(query, 0, &mut toi),
            4 => self.turning::<6, 9>(query, 1, &mut toi),
            _ => self.bodies(query, &mut toi),
        };
        let mut answer = ANSWER.to_le_bytes().to_vec();
        answer.extend(&query[..8]);
        answer.extend(verdict.to_le_bytes());
        answer.extend([0; 4]);
        answer.extend(toi.to_le_bytes());
        answer
    }

    fn query(&mut self, query: &[u8], toi: &mut f64) -> c_int {
        let radius: [f64; 2] = numbers(query, 0);
        let points: [f64; 24] = numbers(query, 2);
        let function = self.functions.get(usize::from(query[8])).copied().flatten();
        let Some(function) = function else {
            return UNSUPPORTED;
        };
        // SAFETY: the function has the type of the header; the three pointers are to memory of the
        // sizes that the header states, which lives until the call ends, and only `toi` is given to be
        // written. It is foreign code, and nothing else runs there.
        unsafe {
            with_own(&mut self.environment, || {
                function(&raw const points, &raw const radius, &raw mut *toi)
            })
        }
    }

    /// A query of `POINTS` coordinates in space and `LOCAL` in the body's frame.
    fn turning<const POINTS: usize, const LOCAL: usize>(
        &mut self,
        query: &[u8],
        function: usize,
        toi: &mut f64,
    ) -> c_int {
        let radius: [f64; 2] = numbers(query, 0);
        let points: [f64; POINTS] = numbers(query, 2);
        let local: [f64; LOCAL] = numbers(query, 2 + POINTS);
        let poses: [f64; 14] = numbers(query, 2 + POINTS + LOCAL);
        let Some(function) = self.turning[function] else {
            return UNSUPPORTED;
        };
        // SAFETY: as of a query, with five pointers.
        unsafe {
            with_own(&mut self.environment, || {
                function(
                    points.as_ptr(),
                    local.as_ptr(),
                    &raw const poses,
                    &raw const radius,
                    &raw mut *toi,
                )
            })
        }
    }

    /// A query of two bodies that turn.
    fn bodies(&mut self, query: &[u8], toi: &mut f64) -> c_int {
        let radius: [f64; 2] = numbers(query, 0);
        let local: [f64; 12] = numbers(query, 2);
        let poses: [f64; 28] = numbers(query, 14);
        let Some(function) = self.bodies[usize::from(query[8] == 6)] else {
            return UNSUPPORTED;
        };
        // SAFETY: as of a query, with four pointers.
        unsafe {
            with_own(&mut self.environment, || {
                function(
                    &raw const local,
                    &raw const poses,
                    &raw const radius,
                    &raw mut *toi,
                )
            })
        }
    }

    fn cast(&mut self, query: &[u8], toi: &mut f64) -> c_int {
        let shapes = [12, 14].map(|at| c_int::from(query[at]));
        let radius: [f64; 2] = numbers(query, 0);
        let bodies: [f64; 30] = numbers(query, 2);
        let Some(function) = self.cast else {
            return UNSUPPORTED;
        };
        // SAFETY: as of a query, with four pointers.
        unsafe {
            with_own(&mut self.environment, || {
                function(
                    &raw const shapes,
                    &raw const bodies,
                    &raw const radius,
                    &raw mut *toi,
                )
            })
        }
    }
}

/// The function of this name, if the library has it.
///
/// # Safety
///
/// If it has, the function is of this type.
unsafe fn symbol<T: Copy>(library: &Library, name: &str) -> Option<T> {
    // SAFETY: the caller's promise.
    let function = unsafe { library.get::<T>(name.as_bytes()) };
    function.ok().map(|function| *function)
}

/// The bytes of a query of this kind after those of its length; `None` if there is no such kind.
fn length_of(kind: u8) -> Option<usize> {
    let [edge, vertex, bodies] = TURNING;
    match kind {
        0 | 1 => Some(QUERY),
        2 => Some(CAST),
        3 => Some(edge),
        4 => Some(vertex),
        5 | 6 => Some(bodies),
        _ => None,
    }
}

/// Numbers of a frame, from this one on.
fn numbers<const N: usize>(frame: &[u8], first: usize) -> [f64; N] {
    std::array::from_fn(|index| {
        let at = 16 + 8 * (first + index);
        let bytes = frame[at..at + 8].iter().rev();
        f64::from_bits(bytes.fold(0, |bits, byte| bits << 8 | u64::from(*byte)))
    })
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
                    "has neither {edges} nor {face} nor another function that include/tunnelproof_subject.h declares"
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

/// The next query, of the length of its kind; `None` at the end.
fn read(queries: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut length = [0; 4];
    if !fill(queries, &mut length)? {
        return Ok(None);
    }
    let length = u32::from_le_bytes(length) as usize;
    if !TURNING.contains(&length) && length != QUERY && length != CAST {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let mut query = vec![0; length];
    match fill(queries, &mut query)? {
        true if length_of(query[8]) == Some(length) => Ok(Some(query)),
        true => Err(io::ErrorKind::InvalidData.into()),
        false => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

/// Fills the bytes, all of them or, at the end of the input, none: then it is `false`.
fn fill(input: &mut impl Read, bytes: &mut [u8]) -> io::Result<bool> {
    let mut filled = 0;
    while filled < bytes.len() {
        let count = match input.read(&mut bytes[filled..]) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            other => other?,
        };
        match count {
            0 if filled == 0 => return Ok(false),
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            count => filled += count,
        }
    }
    Ok(true)
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
