use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use super::*;

/// A program in which every mutant changes what it prints.
const PROGRAM: &str = r#"
const UNIT: f64 = 0.25;

fn sum(a: f64, b: f64) -> f64 {
    a + UNIT * b
}

fn within(x: u32, low: u32, high: u32) -> bool {
    low <= x && x < high
}

fn either(a: bool, b: bool) -> bool {
    !a || b
}

fn sign(x: i32) -> &'static str {
    match x {
        0 => "none",
        x if x > 1 => "plus",
        _ => "minus",
    }
}

fn halves(mut n: u32) -> u32 {
    n >>= 1;
    n
}

#[cfg(test)]
mod tests {
    fn never() -> f64 {
        1.0 + 1.0
    }
}

fn main() {
    println!("{} {}", sum(3.0, 8.0), sum(-0.5, 2.0));
    println!("{:?}", [1, 2, 3, 7, 8, 9].map(|x| within(x, 2, 8)));
    println!("{:?}", [(false, false), (false, true), (true, false), (true, true)].map(|(a, b)| either(a, b)));
    println!("{:?}", [-1, 0, 1, 2].map(sign));
    println!("{}", halves(6));
}
"#;

fn rewritten() -> (Rewritten, Numbers) {
    let file = syn::parse_file(PROGRAM).expect("the program parses");
    let names = constants(&file);
    assert_eq!(names, BTreeSet::from(["UNIT".to_owned()]));
    let mut numbers = Numbers::default();
    let rewritten = rewrite(
        "program.rs",
        PROGRAM,
        &file,
        &names,
        &BTreeSet::new(),
        &mut numbers,
    );
    (rewritten, numbers)
}

/// What a program says with a mutant, or without one.
fn said(program: &PathBuf, mutant: Option<u32>) -> String {
    let mut command = Command::new(program);
    if let Some(id) = mutant {
        command.env("MUTANT", id.to_string());
    }
    let output = command.output().expect("the program runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn compiled(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("mutation-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("there is room");
    let source = folder.join(name).with_extension("rs");
    fs::write(&source, text).expect("there is room");
    let status = Command::new("rustc")
        .args(["--edition", "2024", "--cap-lints=allow", "-o"])
        .arg(folder.join(name))
        .arg(&source)
        .status();
    assert!(status.expect("there is a compiler").success(), "{text}");
    folder.join(name)
}

#[test]
fn every_mutant_does_what_it_says_and_none_does_nothing() {
    let (rewritten, numbers) = rewritten();
    let schema = include_str!("../schema.rs");
    let text = format!(
        "{}\nmod mutation {{ {schema}\nconst SITES: u32 = {}; }}",
        rewritten.text, numbers.sites
    );
    let (plain, mutated) = (compiled("plain", PROGRAM), compiled("mutated", &text));
    let usual = said(&plain, None);
    assert_eq!(said(&mutated, None), usual);
    let unnoticed: Vec<_> = rewritten
        .mutants
        .iter()
        .filter(|mutant| mutant.function != "main" && said(&mutated, Some(mutant.id)) == usual)
        .map(|mutant| &*mutant.what)
        .collect();
    assert_eq!(unnoticed, [""; 0]);
    fs::remove_dir_all(plain.with_file_name("")).expect("the folder is ours");
}

#[test]
fn mutants_are_those_of_the_rules() {
    let (rewritten, _) = rewritten();
    let of = |kind| {
        let own = rewritten
            .mutants
            .iter()
            .filter(move |mutant| mutant.kind == kind);
        own.map(|mutant| (&*mutant.function, &*mutant.what))
            .collect::<Vec<_>>()
    };
    assert!(of(Kind::Constant).contains(&("sum", "UNIT -> UNIT / 2")));
    assert!(of(Kind::Operator).contains(&("within", "low <= x && x < high: && -> ||")));
    assert!(of(Kind::Operator).contains(&("within", "x < high: < -> ==")));
    assert!(of(Kind::Operator).contains(&("halves", "n >>= 1: >>= -> <<=")));
    assert_eq!(of(Kind::Unary)[0], ("either", "!a: without !"));
    assert!(of(Kind::Body).contains(&("sum", "returns -1.0")));
    assert_eq!(
        of(Kind::Arm),
        [
            ("sign", "without the arm 0"),
            ("sign", "the condition x > 1 is true"),
            ("sign", "the condition x > 1 is false")
        ]
    );
    assert!(
        rewritten
            .mutants
            .iter()
            .all(|mutant| mutant.function != "never")
    );
}
