//! The target `integers` for libFuzzer.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tunnelproof_fuzz::run("integers", bytes));
