//! A library that the linker loads before the program may have set another floating-point environment,
//! as the start-up code of `-ffast-math` does.

use crate::lib_subject::library;
use crate::run::{code, command, stderr};

/// Sets bits of MXCSR when it is loaded.
fn setter(bits: u32) -> String {
    format!(
        "#include <xmmintrin.h>\n\
         __attribute__((constructor)) static void set(void) {{ _mm_setcsr(_mm_getcsr() | {bits}u); }}\n"
    )
}

#[test]
fn nothing_is_said_in_another_environment() {
    let folder = tempfile::tempdir().unwrap();
    let environments = [
        ("downward", 0x2000, "does not round to nearest"),
        ("to_zero", 0x6000, "does not round to nearest"),
        ("fast_math", 0x8040, "flushes subnormal numbers to zero"),
    ];
    for (name, bits, problem) in environments {
        let library = library(folder.path(), name, &setter(bits));
        for arguments in [&["certify", "--count", "1"][..], &["explain", "figure:4.1"]] {
            let output = command(arguments)
                .env("LD_PRELOAD", &library)
                .output()
                .unwrap();
            assert_eq!(code(&output), 2, "{name}: {arguments:?}");
            assert!(output.stdout.is_empty());
            let said = stderr(&output);
            assert!(said.starts_with("floating-point environment: "), "{said}");
            assert!(said.contains(problem), "{said}");
            assert!(said.contains("see LD_PRELOAD"), "{said}");
            assert_eq!(said.lines().count(), 1);
        }
    }
    let library = library(folder.path(), "nothing", &setter(0));
    let output = command(&["explain", "figure:4.1"])
        .env("LD_PRELOAD", &library)
        .output();
    assert_eq!(code(&output.unwrap()), 0);
}
