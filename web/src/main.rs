//! The playground as one page, and what its answers are natively.
//!
//! - `playground page MODULE OUT`: writes the page with this module of WebAssembly in it.
//! - `playground queries COUNT`: writes queries of all families by turns, a line each.
//! - `playground answers`: what the certified path says of the queries on the standard input, a line each.

use std::error::Error;
use std::io::{BufRead, Write};
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs, io};

mod gallery;
mod page;

use serde_json::{Value, json};
use tunnelproof_reference::corpus::Entry;
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::generate;

/// The seed of the queries that are compared.
const SEED: u64 = 20;

fn main() -> ExitCode {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        ["page", module, out] => page(Path::new(module), Path::new(out)),
        ["queries", count] => queries(count),
        ["answers"] => answers(),
        _ => Err("usage: playground page MODULE OUT | queries COUNT | answers".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("playground: {error}");
            ExitCode::from(2)
        }
    }
}

fn page(module: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = fs::read(module).map_err(|error| format!("{}: {error}", module.display()))?;
    let page = page::write(&bytes)?;
    fs::write(out, page).map_err(|error| format!("{}: {error}", out.display()))?;
    Ok(())
}

fn queries(count: &str) -> Result<(), Box<dyn Error>> {
    let families: Vec<_> = generate::all().collect();
    let mut out = io::stdout().lock();
    for number in 0..count.parse::<usize>()? {
        let family = families[number % families.len()];
        let index = (number / families.len()) as u64;
        let id = format!("{}:{SEED}:{index}", family.name());
        let entry = Entry::unlabelled(id, family.query(SEED, index));
        writeln!(out, "{}", jsonl::write(&entry, Numbers::Hexadecimal))?;
    }
    Ok(())
}

fn answers() -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let query: Value = serde_json::from_str(&line?)?;
        let question = json!({ "ask": "certified", "query": query }).to_string();
        writeln!(out, "{}", tunnelproof_web::answer(&question))?;
    }
    Ok(())
}
