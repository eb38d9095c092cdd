//! The target `oracle_vs_difference` for libFuzzer.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tunnelproof_fuzz::run("oracle_vs_difference", bytes));
