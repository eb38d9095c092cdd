//! The target `turning_vs_oracle` for libFuzzer.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tunnelproof_fuzz::run("turning_vs_oracle", bytes));
