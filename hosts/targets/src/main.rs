//! Prints a line for each part: its name and the digest of its answers.
//!
//! `targets [COUNT [PART...]]`: so many queries of each family, 100 by default; of the parts named, or of all.

use std::process::ExitCode;

use tunnelproof_targets::Part;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let count = arguments.next().map_or(Ok(100), |text| text.parse());
    let Ok(count) = count else {
        eprintln!("usage: targets [COUNT [PART...]]");
        return ExitCode::from(2);
    };
    let names: Vec<String> = arguments.collect();
    let is_asked = |part: &Part| names.is_empty() || names.iter().any(|name| name == part.name());
    for part in Part::all().filter(is_asked) {
        println!("{} {:016x}", part.name(), part.digest(count));
    }
    ExitCode::SUCCESS
}
