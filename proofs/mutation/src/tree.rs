//! A copy of the project, in which the sources of a folder have all their mutants.

use std::collections::BTreeSet;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;

use crate::mutant::Mutant;
use crate::rewrite::{Numbers, constants, rewrite};

/// What is mutated: the crate, and the module of it by its file.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The folder of the crate's package, from that of the project.
    pub package: &'static str,
    /// The folders and files that are mutated, from that of the project.
    pub sources: &'static [&'static str],
    /// The packages that have the tests.
    pub tested: &'static [&'static str],
    /// The features of the package that are on.
    pub features: &'static str,
    /// The profile that it is built by.
    pub profile: &'static str,
    /// The source of the test that asks for answers.
    pub answers: &'static str,
}

/// Copies what Git knows of the project but the files `except`. What did not change is not written, so that it is not compiled anew.
fn copy(project: &Path, tree: &Path, except: &BTreeSet<&str>) -> Result<()> {
    let listed = Command::new("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .current_dir(project)
        .output()?;
    ensure!(
        listed.status.success(),
        "git ls-files: {}",
        String::from_utf8_lossy(&listed.stderr)
    );
    let listed = String::from_utf8(listed.stdout)?;
    let names: BTreeSet<&str> = listed
        .split_terminator('\0')
        .filter(|name| project.join(name).is_file())
        .collect();
    // What an earlier run copied, and is there no more.
    let list = tree.with_file_name("files");
    if let Ok(earlier) = fs::read_to_string(&list) {
        for name in earlier.split_terminator('\0') {
            if !names.contains(name) && tree.join(name).is_file() {
                fs::remove_file(tree.join(name))?;
            }
        }
    }
    for name in names.difference(except) {
        put(&tree.join(name), &fs::read(project.join(name))?)?;
    }
    put(&list, listed.as_bytes())
}

/// Writes a file unless it has these contents.
fn put(path: &Path, contents: &[u8]) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == contents) {
        return Ok(());
    }
    fs::create_dir_all(path.parent().context("a file is in a folder")?)?;
    fs::write(path, contents).with_context(|| path.display().to_string())
}

/// A source that is mutated.
struct Source {
    name: String,
    text: String,
    file: syn::File,
}

/// The files of the folders, without modules of tests.
fn sources(project: &Path, subject: &Subject) -> Result<Vec<Source>> {
    let mut paths = Vec::new();
    for source in subject.sources {
        walk(&project.join(source), &mut paths)?;
    }
    let mut sources = Vec::new();
    let mut tests = BTreeSet::new();
    for path in paths {
        let text = fs::read_to_string(&path)?;
        let file = syn::parse_file(&text).with_context(|| path.display().to_string())?;
        for item in &file.items {
            if let syn::Item::Mod(module) = item
                && module.content.is_none()
                && module
                    .attrs
                    .iter()
                    .any(|attribute| attribute.path().is_ident("cfg"))
            {
                let stem = path
                    .file_stem()
                    .and_then(|stem| stem.to_str())
                    .unwrap_or_default();
                let folder = match stem {
                    "mod" | "lib" => path.with_file_name(""),
                    _ => path.with_extension(""),
                };
                tests.insert(folder.join(module.ident.to_string()));
            }
        }
        let name = path.strip_prefix(project)?.display().to_string();
        sources.push((path, Source { name, text, file }));
    }
    let is_test = |path: &Path| {
        tests
            .iter()
            .any(|test| path.with_extension("") == *test || path.starts_with(test))
    };
    Ok(sources
        .into_iter()
        .filter(|(path, _)| !is_test(path))
        .map(|(_, source)| source)
        .collect())
}

fn walk(path: &Path, found: &mut Vec<PathBuf>) -> Result<()> {
    if path.is_dir() {
        let mut entries = fs::read_dir(path)?
            .map(|entry| Ok(entry?.path()))
            .collect::<Result<Vec<_>>>()?;
        entries.sort();
        return entries.iter().try_for_each(|entry| walk(entry, found));
    }
    if path.extension().is_some_and(|extension| extension == "rs") {
        found.push(path.to_owned());
    }
    Ok(())
}

/// Copies the project, with all mutants in its sources with `part` in their path but those that do not compile, which the compiler is
/// asked for, and returns the mutants. Their numbers are the same for every `part`.
pub fn mutate(project: &Path, tree: &Path, subject: &Subject, part: &str) -> Result<Vec<Mutant>> {
    let sources = sources(project, subject)?;
    let lib = Path::new(subject.package).join("src/lib.rs");
    let lib = lib.strip_prefix(".").unwrap_or(&lib);
    let written = sources.iter().map(|source| &*source.name);
    let written = written.chain(lib.to_str()).collect();
    copy(project, tree, &written)?;
    let manifest = fs::read_to_string(project.join("Cargo.toml"))?;
    put(
        &tree.join("Cargo.toml"),
        without_lints(&manifest)?.as_bytes(),
    )?;
    let names = sources
        .iter()
        .flat_map(|source| constants(&source.file))
        .collect();
    // Of an earlier run on the same sources: then nothing is compiled anew.
    let mut hasher = DefaultHasher::new();
    part.hash(&mut hasher);
    for source in &sources {
        (&source.name, &source.text).hash(&mut hasher);
    }
    let (kept, key) = (tree.with_file_name("dropped.json"), hasher.finish());
    let mut dropped: BTreeSet<u32> = fs::read_to_string(&kept)
        .ok()
        .and_then(|text| serde_json::from_str::<(u64, BTreeSet<u32>)>(&text).ok())
        .filter(|(of, _)| *of == key)
        .map(|(_, dropped)| dropped)
        .unwrap_or_default();
    loop {
        let (mut numbers, mut mutants) = (Numbers::default(), Vec::new());
        for source in &sources {
            let rewritten = rewrite(
                &source.name,
                &source.text,
                &source.file,
                &names,
                &dropped,
                &mut numbers,
            );
            let is_mutated = source.name.contains(part);
            let text = if is_mutated {
                &rewritten.text
            } else {
                &source.text
            };
            put(&tree.join(&source.name), text.as_bytes())?;
            if is_mutated {
                mutants.extend(rewritten.mutants);
            }
        }
        let package = tree.join(subject.package);
        let schema = format!(
            "{}\nconst SITES: u32 = {};\n",
            include_str!("schema.rs"),
            numbers.sites
        );
        put(&package.join("src/mutation.rs"), schema.as_bytes())?;
        let asker = package.join("tests/mutation_answers.rs");
        put(&asker, subject.answers.as_bytes())?;
        let text = fs::read_to_string(project.join(lib))?;
        put(
            &tree.join(lib),
            format!("{text}\n#[doc(hidden)]\npub mod mutation;\n").as_bytes(),
        )?;
        let refused = refused(tree, subject)?;
        if refused.is_empty() {
            put(&kept, serde_json::to_string(&(key, &dropped))?.as_bytes())?;
            println!(
                "{} mutants in {} files; {} more do not compile",
                mutants.len(),
                sources
                    .iter()
                    .filter(|source| source.name.contains(part))
                    .count(),
                dropped.len()
            );
            return Ok(mutants);
        }
        let before = dropped.len();
        dropped.extend(refused);
        ensure!(dropped.len() > before, "the same mutants are refused again");
        eprintln!("{} mutants that do not compile", dropped.len());
    }
}

#[derive(Deserialize)]
struct Message {
    message: Option<Diagnostic>,
}

#[derive(Deserialize)]
struct Diagnostic {
    level: String,
    rendered: Option<String>,
    spans: Vec<Place>,
}

#[derive(Deserialize)]
struct Place {
    file_name: String,
    line_start: usize,
    line_end: usize,
    is_primary: bool,
}

/// A manifest that allows everything that is not an error.
fn without_lints(manifest: &str) -> Result<String> {
    const OPENING: &str = "[workspace.lints.rust]\n";
    let (before, lints) = manifest.split_once(OPENING).context("no lints")?;
    let (_, after) = lints.split_once("[package]").context("no package")?;
    Ok(format!(
        "{before}{OPENING}warnings = \"allow\"\n\n[package]{after}"
    ))
}

/// The mutants that the compiler refuses.
fn refused(tree: &Path, subject: &Subject) -> Result<BTreeSet<u32>> {
    let package = tree.join(subject.package);
    let output = cargo(tree)
        .args([
            "check",
            "--profile",
            subject.profile,
            "--lib",
            "--message-format",
            "json",
            "--features",
            subject.features,
            "--manifest-path",
        ])
        .arg(package.join("Cargo.toml"))
        .output()?;
    let mut refused = BTreeSet::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(Message {
            message: Some(said),
        }) = serde_json::from_str::<Message>(line)
        else {
            continue;
        };
        if said.level != "error" || said.spans.is_empty() {
            continue;
        }
        let before = refused.len();
        for place in said.spans.iter().filter(|place| place.is_primary) {
            let text = fs::read_to_string(tree.join(&place.file_name))
                .or_else(|_| fs::read_to_string(package.join(&place.file_name)))?;
            let lines = text
                .lines()
                .skip(place.line_start - 1)
                .take(place.line_end - place.line_start + 1);
            for mark in lines.flat_map(|line| line.split("/*m").skip(1)) {
                refused.extend(
                    mark.split("*/")
                        .next()
                        .and_then(|id| id.parse::<u32>().ok()),
                );
            }
        }
        if refused.len() == before && refused.is_empty() {
            eprintln!("{}", said.rendered.unwrap_or_default());
        }
    }
    ensure!(
        output.status.success() || !refused.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Ok(refused)
}

/// Cargo for the copy. It builds in the project's `target`, three folders up, where what it depends on is built once.
pub fn cargo(tree: &Path) -> Command {
    let mut command = Command::new("cargo");
    command
        .current_dir(tree)
        .env("CARGO_TARGET_DIR", tree.join("../../.."));
    command
}
