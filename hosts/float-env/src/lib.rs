//! Runs a computation in the default floating-point environment: rounding to nearest, gradual
//! underflow, exceptions masked.
//!
//! Rust assumes this environment, and so do the proofs of `tunnelproof`. A host in another language
//! may have set another one: a rounding mode by `fesetround`, flush-to-zero by the start-up code of
//! `-ffast-math`, exceptions that interrupt by `feenableexcept`. Libraries that such a host calls
//! start with [`with_default`]:
//!
//! ```
//! use tunnelproof_float_env::{Control, with_default};
//!
//! let sum = with_default(|| 0.1 + 0.2);
//! assert_eq!(sum, 0.30000000000000004);
//! assert!(Control::current().is_default());
//! ```
//!
//! # Exception flags
//!
//! Flags that the computation raises stay raised, as after any function that computes in `double`;
//! flags that were raised before stay so as well. A host that wants neither saves and restores them
//! by `feholdexcept` and `fesetenv`. An exception that the host does not mask does not interrupt the
//! computation, nor afterwards by a flag that the computation left.
//!
//! # Threads
//!
//! The environment belongs to a thread. On Linux a new thread takes over that of the thread that
//! starts it, so that a pool of threads has for ever what its first user had. A library that starts
//! its pool inside of [`with_default`], and runs no foreign code on it, has a pool in the default
//! environment. Where foreign code runs, [`with_restored`] and [`with_own`] keep its changes away from
//! what follows.
//!
//! # Targets
//!
//! x86-64, x86 with SSE2 (where Rust computes by SSE2; the control word of the x87 unit is left
//! alone) and AArch64. On other targets the functions do nothing but to call what they are given:
//! WebAssembly has no other environment, elsewhere the host has to take care.

mod caller;
#[cfg(any(
    target_arch = "x86_64",
    all(target_arch = "x86", target_feature = "sse2"),
    target_arch = "aarch64"
))]
mod register;
#[cfg(not(any(
    target_arch = "x86_64",
    all(target_arch = "x86", target_feature = "sse2"),
    target_arch = "aarch64"
)))]
#[path = "no_register.rs"]
mod register;

use std::hint::black_box;

use caller::Caller;
use register::{CONTROL, DEFAULT, Word};

/// What controls the floating-point operations of a thread: rounding mode, treatment of subnormal
/// numbers, masks of exceptions. The flags of exceptions are no part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Control(Word);

impl Control {
    /// What Rust assumes: rounding to nearest, gradual underflow, exceptions masked.
    pub const DEFAULT: Control = Control(DEFAULT);

    /// That of the current thread.
    #[inline(always)]
    pub fn current() -> Self {
        Control(register::read() & CONTROL)
    }

    /// Whether it is the default.
    #[inline(always)]
    pub fn is_default(self) -> bool {
        self == Self::DEFAULT
    }

    /// The control bits as the processor's register has them (MXCSR or FPCR); 0 on other targets.
    pub fn bits(self) -> u64 {
        self.0.into()
    }

    /// That of a register with these bits; flags of exceptions are left out.
    pub fn from_bits(bits: u64) -> Self {
        Control(bits as Word & CONTROL)
    }

    /// Makes it that of the current thread. The flags of exceptions stay.
    ///
    /// # Safety
    ///
    /// Rust code computes with floating-point numbers only in the default environment, and the
    /// compiler may move its operations: unless this is the default, it has to be restored before
    /// any Rust code computes, and nothing but foreign code may run in between.
    #[inline(always)]
    pub unsafe fn set(self) {
        // SAFETY: no bit but control bits differs from the register's word, so none that is
        // reserved is set. The rest is the caller's promise.
        unsafe { register::write(register::read() & !CONTROL | self.0) };
    }
}

/// Calls a function in the default environment, and restores the control bits of the calling thread
/// afterwards, also if the function panics.
///
/// It costs a few nanoseconds where the environment is the default already. See the [crate] for
/// flags, threads and targets.
#[inline]
pub fn with_default<T>(compute: impl FnOnce() -> T) -> T {
    let control = Control::current();
    match control.is_default() {
        true => compute(),
        false => restored(control, compute),
    }
}

/// The same where the environment is another one.
///
/// No floating-point operation moves across the changes of the register: the function is called
/// through a pointer that the compiler knows nothing about, so that it has to take the call for one
/// that has effects, as those changes have.
#[cold]
#[inline(never)]
fn restored<T, F: FnOnce() -> T>(control: Control, compute: F) -> T {
    let _caller = Caller::leave(control);
    let call: fn(F) -> T = black_box(|compute| compute());
    call(compute)
}

/// Calls foreign code in the environment of the calling thread, and restores the control bits
/// afterwards, whatever it has changed; also if it panics.
#[inline(never)]
pub fn with_restored<T>(foreign: impl FnOnce() -> T) -> T {
    let _caller = Caller::current();
    foreign()
}

/// Calls foreign code in an environment of its own: the one that it left when it was called last,
/// at first the default. Afterwards the environment of the calling thread is what it was.
///
/// So what a foreign library sets for itself, such as flush-to-zero when it is loaded, does not
/// reach the code that calls it.
///
/// # Safety
///
/// The function does nothing but to call foreign code: Rust code must not compute with
/// floating-point numbers in it.
#[inline(never)]
pub unsafe fn with_own<T>(own: &mut Control, foreign: impl FnOnce() -> T) -> T {
    let caller = Caller::current();
    // SAFETY: nothing but foreign code runs until the guard restores what there was, by the
    // caller's promise.
    unsafe { own.set() };
    let answer = foreign();
    *own = Control::current();
    drop(caller);
    answer
}
