//! Prints a line for each part: its name and the digest of its answers.
//!
//! `targets [COUNT]`: so many queries of each family, 100 by default.

use std::process::ExitCode;

use tunnelproof_targets::Part;

fn main() -> ExitCode {
    let count = std::env::args().nth(1).map_or(Ok(100), |text| text.parse());
    let Ok(count) = count else {
        eprintln!("usage: targets [COUNT]");
        return ExitCode::from(2);
    };
    for part in Part::all() {
        println!("{} {:016x}", part.name(), part.digest(count));
    }
    ExitCode::SUCCESS
}
