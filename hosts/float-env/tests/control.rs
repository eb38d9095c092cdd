//! The control bits around a call: set to the default, restored, also after a panic.
#![cfg(any(
    target_arch = "x86_64",
    all(target_arch = "x86", target_feature = "sse2"),
    target_arch = "aarch64"
))]

use std::hint::black_box;
use std::panic::catch_unwind;

use tunnelproof_float_env::{Control, with_default, with_own};

/// Control bits of all kinds: rounding modes, flush-to-zero, exceptions that are not masked.
#[cfg(not(target_arch = "aarch64"))]
const WORDS: [u64; 6] = [0x3f80, 0x5f80, 0x7f80, 0x9fc0, 0xffc0, 0x0000];

/// Control bits of all kinds: rounding modes and flush-to-zero.
#[cfg(target_arch = "aarch64")]
const WORDS: [u64; 4] = [1 << 22, 2 << 22, 3 << 22, 1 << 24];

/// Calls a function as a host in this environment calls a library.
fn called_by_host<T>(control: Control, library: extern "C" fn(&mut T), answer: &mut T) -> Control {
    // SAFETY: nothing but the call, of a function that is `extern "C"` and may be called in any
    // environment, happens until the default is restored.
    unsafe { control.set() };
    library(answer);
    let left = Control::current();
    // SAFETY: it is the default.
    unsafe { Control::DEFAULT.set() };
    left
}

/// What is rounded away from 0 to nearest, underflows, and is not a number, in the default
/// environment.
fn computed() -> [u64; 4] {
    let (one, least) = (black_box(1.0f64), black_box(f64::MIN_POSITIVE));
    let nothing = black_box(0.0) / black_box(0.0);
    [one / 10.0, -one / 10.0, least / 3.0, nothing].map(f64::to_bits)
}

#[inline(never)]
extern "C" fn compute(answer: &mut ([u64; 4], bool)) {
    *answer = with_default(|| (computed(), Control::current().is_default()));
}

#[inline(never)]
extern "C" fn compute_unprotected(answer: &mut ([u64; 4], bool)) {
    *answer = (computed(), Control::current().is_default());
}

#[inline(never)]
extern "C" fn fail(is_caught: &mut bool) {
    let failed = catch_unwind(|| with_default(|| assert!(black_box(false), "as planned")));
    *is_caught = failed.is_err();
}

#[test]
fn with_default_computes_in_the_default_and_restores_the_callers_control_bits() {
    assert!(Control::current().is_default());
    let expected = computed();
    for control in WORDS.map(Control::from_bits) {
        let mut answer = ([0; 4], false);
        let left = called_by_host(control, compute, &mut answer);
        assert_eq!(answer, (expected, true), "{control:?}");
        assert_eq!(left, control);
    }
    let mut answer = ([0; 4], false);
    called_by_host(Control::DEFAULT, compute, &mut answer);
    assert_eq!(answer, (expected, true));
}

#[test]
fn without_it_these_environments_compute_other_numbers() {
    let expected = computed();
    // But for the last one on x86, in which the first inexact result would interrupt.
    for control in &WORDS.map(Control::from_bits)[..4] {
        let mut answer = ([0; 4], false);
        called_by_host(*control, compute_unprotected, &mut answer);
        assert!(answer.0 != expected && !answer.1, "{control:?}");
    }
}

#[test]
fn control_bits_are_restored_after_a_panic() {
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    for control in WORDS.map(Control::from_bits) {
        let mut is_caught = false;
        let left = called_by_host(control, fail, &mut is_caught);
        assert!(is_caught && left == control, "{control:?}");
    }
    std::panic::set_hook(quiet);
}

#[test]
fn threads_that_are_started_inside_have_the_default() {
    extern "C" fn start(is_default: &mut bool) {
        *is_default = with_default(|| {
            let started = std::thread::spawn(|| Control::current().is_default());
            started.join().is_ok_and(|is_default| is_default)
        });
    }
    for control in WORDS.map(Control::from_bits) {
        let mut is_default = false;
        called_by_host(control, start, &mut is_default);
        assert!(is_default, "{control:?}");
    }
}

#[test]
fn foreign_code_keeps_its_own_environment_and_leaves_the_callers_alone() {
    let own_word = Control::from_bits(WORDS[2]);
    let mut own = Control::DEFAULT;
    let mut calls = Vec::new();
    for _ in 0..2 {
        // SAFETY: what is called does not compute with floating-point numbers.
        calls.push(unsafe {
            with_own(&mut own, || {
                let found = Control::current();
                own_word.set();
                found
            })
        });
        assert!(Control::current().is_default());
    }
    assert_eq!(calls, [Control::DEFAULT, own_word]);
}
