//! Writes the seeds of every fuzz target, always the same ones, for libFuzzer to start from.
//!
//! ```text
//! cargo run --release -p tunnelproof-cli --example fuzz_corpus [FOLDER]
//! ```
//!
//! `FOLDER` is `fuzz/corpus`, where `cargo fuzz run` looks, if it is not given; each target has a
//! folder of its own in it. Targets that need GMP are there with `--features gmp`.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use tunnelproof_cli::fuzz::{SEEDS, TARGETS};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).unwrap_or("fuzz/corpus".to_owned()));
    for target in TARGETS {
        let folder = folder.join(target.name);
        fs::create_dir_all(&folder)?;
        let seeds = target.seeds(SEEDS);
        for (index, seed) in seeds.iter().enumerate() {
            fs::write(folder.join(format!("seed-{index:02}")), seed)?;
        }
        println!("{}: {} files", folder.display(), seeds.len());
    }
    Ok(())
}
