//! The floating-point environment that every proof assumes: rounding to nearest and gradual
//! underflow.
//!
//! Rust programs run in it, and Rust itself assumes it. A host in another language may have set
//! another one for its threads: a rounding mode (`fesetround`), or subnormal numbers flushed to
//! zero (FTZ and DAZ, as the start-up code of `-ffast-math` sets them). Then a contact may be
//! missed and a hit may be false. Every question still ends: loops that floating point guides have
//! a bound.
//!
//! [`check`] says whether the current thread is in it. Debug builds check it at every question. The
//! libraries for C and Python set it around each call, and restore that of their caller.
//!
//! ```
//! use tunnelproof::environment;
//!
//! // Once for each thread of a host, before its first question.
//! environment::check()?;
//! # Ok::<(), environment::EnvironmentError>(())
//! ```
//!
//! The environment belongs to a thread, and on Linux a new thread takes over that of the thread
//! that starts it. Those of a pool of rayon are asked by `pool.broadcast(|_| environment::check())`.

use std::fmt;
use std::hint::black_box;

// The x87 unit rounds to 64 bits first, and no check of a thread could change that.
#[cfg(all(target_arch = "x86", not(target_feature = "sse2")))]
compile_error!(
    "tunnelproof needs SSE2 on x86: without it f64 arithmetic is done by the x87 unit, which rounds to \
     64 bits first, and the proofs do not hold; build for i686, or with -C target-feature=+sse2"
);

/// What is wrong with a floating-point environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// Operations do not round to nearest, ties to even, at once to 53 bits.
    Rounding,
    /// Subnormal numbers are flushed to zero, as operands or as results.
    Subnormals,
}

impl fmt::Display for EnvironmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            EnvironmentError::Rounding => {
                "this thread does not round to nearest; call fesetround(FE_TONEAREST)"
            }
            EnvironmentError::Subnormals => {
                "this thread flushes subnormal numbers to zero; switch off FTZ and DAZ"
            }
        })
    }
}

impl std::error::Error for EnvironmentError {}

/// Whether the current thread rounds to nearest and keeps subnormal numbers, by a few operations
/// whose results depend on it.
///
/// Exceptions that are not masked cannot be seen like this: they interrupt the program, here as
/// anywhere.
///
/// # Errors
///
/// [`EnvironmentError`] if it does not.
#[inline(never)]
pub fn check() -> Result<(), EnvironmentError> {
    match (rounds_to_nearest(), keeps_subnormals()) {
        (true, true) => Ok(()),
        (true, false) => Err(EnvironmentError::Subnormals),
        (false, _) => Err(EnvironmentError::Rounding),
    }
}

/// What the compiler may not compute by itself: `x + y`.
fn sum(x: f64, y: f64) -> u64 {
    black_box(black_box(x) + black_box(y)).to_bits()
}

/// The same: `x y`.
fn product(x: f64, y: f64) -> u64 {
    black_box(black_box(x) * black_box(y)).to_bits()
}

/// No other mode gives all of these: upward not the first, downward not the second, toward zero not
/// the third, ties away from zero not the first, and the last one is that of a sum which is rounded
/// to 64 bits before.
fn rounds_to_nearest() -> bool {
    const E: f64 = f64::EPSILON;
    let above = 1.0 + E;
    (sum(1.0, E / 2.0) == 1f64.to_bits())
        & (sum(-1.0, -E / 2.0) == (-1f64).to_bits())
        & (sum(1.0, 0.75 * E) == above.to_bits())
        & (sum(above, E / 2.0) == (above + E).to_bits())
        & (sum(1.0, E / 2.0 + E * E) == above.to_bits())
}

/// A result that is subnormal, and an operand; compared as bits, as a comparison of subnormal
/// numbers may be one of zeros.
fn keeps_subnormals() -> bool {
    const LEAST: f64 = f64::from_bits(1);
    /// 2^1000.
    const LARGE: f64 = f64::from_bits((1023 + 1000) << 52);
    (product(f64::MIN_POSITIVE, 0.5) == 1 << 51)
        & (sum(LEAST, LEAST) == 2)
        & (product(LEAST, LARGE) == (1023 - 74) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn check_accepts_the_environment_of_rust() {
        assert_eq!(check(), Ok(()));
    }

    #[test]
    fn errors_say_what_to_do() {
        let rounding = EnvironmentError::Rounding.to_string();
        assert!(rounding.contains("FE_TONEAREST"));
        let subnormals = EnvironmentError::Subnormals.to_string();
        assert!(subnormals.contains("FTZ"));
    }
}
