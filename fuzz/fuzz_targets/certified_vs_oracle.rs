//! The target `certified_vs_oracle` for libFuzzer.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tunnelproof_fuzz::run("certified_vs_oracle", bytes));
