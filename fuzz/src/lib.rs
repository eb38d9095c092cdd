//! What the programs in `fuzz_targets/` have in common. The targets themselves are
//! `tunnelproof_cli::fuzz`.

use tunnelproof_cli::fuzz;

/// Runs a target on the bytes of the fuzzer.
///
/// # Panics
///
/// If the target finds something, with all that there is to say of it.
pub fn run(target: &str, bytes: &[u8]) {
    let target = fuzz::by_name(target).expect("a target of this build");
    if let Err(finding) = target.run(bytes) {
        panic!("{finding}");
    }
}
