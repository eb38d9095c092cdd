//! The pages hold together: links lead somewhere, files that are named exist, the index has every
//! page, the front page is short, and the thesis is cited wherever it is named.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Folders without pages of this project.
const SKIPPED: [&str; 5] = ["target", ".git", "corpus", "artifacts", "node_modules"];

/// The most lines of the front page.
const FRONT_PAGE: usize = 180;

/// The most lines of any other page.
const PAGE: usize = 400;

const CITATION: [&str; 3] = ["Michael Brandl", "Umeå", "https://docslib.org/doc/4281663/"];

/// The folders of the sources, by which a path in backquotes is known.
const SOURCES: [&str; 15] = [
    "benches/",
    "c/",
    "cli/",
    "docs/",
    "examples/",
    "fuzz/",
    "hosts/",
    "include/",
    "proofs/",
    "python/",
    "reference/",
    "src/",
    "tests/",
    "vectors/",
    "web/",
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Every page, relative to the root, with its text.
fn pages() -> Vec<(PathBuf, String)> {
    fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_dir() && !path.is_symlink() && !SKIPPED.contains(&&*name) {
                visit(&path, found);
            } else if name.ends_with(".md") && !path.is_symlink() {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    visit(&root(), &mut found);
    found.sort();
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        (path.strip_prefix(root()).unwrap().to_owned(), text)
    };
    found.into_iter().map(read).collect()
}

/// The lines outside of fenced code.
fn prose(text: &str) -> String {
    let mut is_code = false;
    let mut prose = String::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            prose += line;
            prose.push('\n');
        }
    }
    prose
}

/// What the links and pictures of a page lead to.
fn links(text: &str) -> Vec<String> {
    let prose = prose(text);
    let inline = prose.split("](").skip(1).filter_map(|rest| {
        let (target, _) = rest.split_once(')')?;
        Some(target.to_owned())
    });
    let definitions = prose.lines().filter_map(|line| {
        let (_, target) = line.strip_prefix('[')?.split_once("]: ")?;
        Some(target.to_owned())
    });
    inline.chain(definitions).collect()
}

/// The anchors of the headings, as GitHub makes them.
fn anchors(text: &str) -> BTreeSet<String> {
    let prose = prose(text);
    let headings = prose.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let heading = line.trim_start_matches('#').trim().to_lowercase();
            let kept = heading
                .chars()
                .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// The path without `..` and `.`.
fn resolved(path: &Path) -> PathBuf {
    let mut resolved = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => assert!(resolved.pop(), "{} leaves the root", path.display()),
            Component::CurDir => {}
            other => resolved.push(other),
        }
    }
    resolved
}

/// What is wrong with a link of a page.
fn fault(page: &Path, target: &str) -> Option<String> {
    if target.contains("://") {
        return None;
    }
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = match file {
        "" => page.to_owned(),
        _ => resolved(&page.parent().unwrap().join(file)),
    };
    let full = root().join(&path);
    if !full.exists() {
        return Some(format!("{}: no file {target}", page.display()));
    }
    let is_known = || anchors(&fs::read_to_string(&full).unwrap()).contains(anchor);
    (!anchor.is_empty() && !is_known()).then(|| format!("{}: no heading {target}", page.display()))
}

#[test]
fn documents_have_no_broken_links() {
    let mut faults = Vec::new();
    let mut count = 0;
    for (page, text) in pages() {
        for target in links(&text) {
            faults.extend(fault(&page, &target));
            count += 1;
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(count > 200, "only {count} links were found");
}

#[test]
fn documents_have_broken_links_found() {
    let page = Path::new("docs/README.md");
    assert_eq!(fault(page, "broad.md#cost"), None);
    assert_eq!(fault(page, "../README.md"), None);
    assert!(fault(page, "nowhere.md").is_some());
    assert!(fault(page, "broad.md#nowhere").is_some());
    assert!(fault(page, "#nowhere").is_some());
    let text = "[a](b.md) ![c](d.svg)\n```\n[e](f)\n```\n[g]: h.md\n";
    assert_eq!(links(text), ["b.md", "d.svg", "h.md"]);
}

#[test]
fn documents_name_files_that_exist() {
    let is_path = |text: &&str| {
        let plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
        SOURCES.iter().any(|source| text.starts_with(source)) && text.chars().all(plain)
    };
    let mut missing = Vec::new();
    for (page, text) in pages() {
        let folder = root().join(page.parent().unwrap());
        let prose = prose(&text);
        let quoted = prose.split('`').skip(1).step_by(2).filter(is_path);
        // What fuzzing leaves is not part of the sources.
        let quoted = quoted
            .filter(|path| !path.starts_with("fuzz/artifacts") && !path.starts_with("fuzz/corpus"));
        for path in quoted {
            if !root().join(path).exists() && !folder.join(path).exists() {
                missing.push(format!("{}: {path}", page.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

/// Every Rust source, relative to the root.
fn sources(folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !path.is_symlink() && !SKIPPED.contains(&&*name) {
            sources(&path, found);
        } else if name.ends_with(".rs") {
            found.insert(path.strip_prefix(root()).unwrap().to_owned());
        }
    }
}

#[test]
fn documents_name_sources_that_exist() {
    let mut files = BTreeSet::new();
    sources(&root(), &mut files);
    let mut missing = Vec::new();
    for (page, text) in pages() {
        let prose = prose(&text);
        let quoted = prose.split('`').skip(1).step_by(2);
        let quoted = quoted.filter(|text| text.ends_with(".rs") && !text.contains(' '));
        for name in quoted {
            if !files.iter().any(|file| file.ends_with(name)) {
                missing.push(format!("{}: {name}", page.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn documents_are_short_and_in_the_index() {
    let index = fs::read_to_string(root().join("docs/README.md")).unwrap();
    let listed: BTreeSet<String> = links(&index).into_iter().collect();
    for (page, text) in pages() {
        let lines = text.lines().count();
        let most = if page == Path::new("README.md") {
            FRONT_PAGE
        } else {
            PAGE
        };
        assert!(lines <= most, "{} has {lines} lines", page.display());
        if let Ok(name) = page.strip_prefix("docs") {
            let name = name.to_string_lossy();
            assert!(
                name == "README.md" || listed.contains(&*name),
                "{name} is not in docs/README.md"
            );
        }
    }
}

#[test]
fn documents_cite_the_thesis_where_they_name_it() {
    for (page, text) in pages() {
        let is_exempt = page == Path::new("CHANGELOG.md");
        let prose = prose(&text);
        // Code in backquotes left out: a module and a subject are called so.
        let words: String = prose.split('`').step_by(2).collect();
        if is_exempt || !words.to_lowercase().contains("thesis") {
            continue;
        }
        for part in CITATION {
            let is_cited = text.contains(part);
            assert!(
                is_cited,
                "{} names the thesis without {part}",
                page.display()
            );
        }
    }
}
