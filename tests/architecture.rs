//! The module graph in `docs/architecture.md` is what the sources import: nothing more, nothing
//! less. So the thesis path and the certified path cannot come to know each other, nor the shadow
//! and the oracle, without a change of that page.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Graph = BTreeMap<String, BTreeSet<String>>;

/// A crate whose modules are checked.
struct Package {
    /// What starts the names of its modules in the page.
    name: &'static str,
    sources: &'static str,
    /// Paths to modules of this project as the sources write them, and what they are called in the
    /// page.
    roots: &'static [(&'static str, &'static str)],
}

const PACKAGES: [Package; 3] = [
    Package {
        name: "engine",
        sources: "src",
        roots: &[("crate", "engine")],
    },
    Package {
        name: "reference",
        sources: "reference/src",
        roots: &[
            ("crate", "reference"),
            ("tunnelproof_reference", "reference"),
            ("tunnelproof", "engine"),
        ],
    },
    Package {
        name: "cli",
        sources: "cli/src",
        roots: &[
            ("crate", "cli"),
            ("tunnelproof_cli", "cli"),
            ("tunnelproof_reference", "reference"),
            ("tunnelproof", "engine"),
        ],
    },
];

/// Modules that `main.rs` and `lib.rs` stand for.
const CRATE_FILES: [&str; 2] = ["lib", "main"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The edges written in the page: lines `engine::query -> engine::contact, ...` in its last block.
fn documented() -> Graph {
    let page = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let block = page
        .rsplit("```")
        .nth(1)
        .expect("the page ends in a fenced block");
    let edges = block.lines().filter_map(|line| line.split_once("->"));
    edges
        .map(|(from, to)| {
            let to = to
                .split(',')
                .map(|name| name.trim().to_owned())
                .filter(|n| !n.is_empty());
            (from.trim().to_owned(), to.collect())
        })
        .collect()
}

/// Every `.rs` file below a folder with the top-level module that it belongs to.
fn sources(folder: &Path) -> Vec<(String, PathBuf)> {
    fn visit(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                visit(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    let mut files = Vec::new();
    visit(folder, &mut files);
    files.sort();
    let module = |path: &PathBuf| {
        let first = path
            .strip_prefix(folder)
            .unwrap()
            .components()
            .next()
            .unwrap();
        Path::new(first.as_os_str())
            .file_stem()
            .unwrap()
            .to_str()
            .unwrap()
            .to_owned()
    };
    files
        .into_iter()
        .map(|path| (module(&path), path))
        .collect()
}

/// The code without comments and without the test module that may end the file.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n")
}

/// The modules named after `root::` or within `root::{...}`.
fn imports(code: &str, root: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let identifier = |text: &str| {
        text.chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect::<String>()
    };
    for (at, _) in code.match_indices(&format!("{root}::")) {
        if code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let rest = &code[at + root.len() + 2..];
        let Some(group) = rest.strip_prefix('{') else {
            found.insert(identifier(rest));
            continue;
        };
        let mut depth = 0;
        let mut start = true;
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => start = true,
                _ if start && c.is_alphabetic() => {
                    found.insert(identifier(&group[i..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    found
}

fn actual() -> Graph {
    let mut graph = Graph::new();
    for package in &PACKAGES {
        let files = sources(&root().join(package.sources));
        let modules: BTreeSet<String> = files.iter().map(|(module, _)| module.clone()).collect();
        for (module, path) in &files {
            if CRATE_FILES.contains(&module.as_str())
                || path.file_stem().is_some_and(|s| s == "tests")
            {
                continue;
            }
            let code = code(&fs::read_to_string(path).unwrap());
            let edges = graph
                .entry(format!("{}::{module}", package.name))
                .or_default();
            for (prefix, owner) in package.roots {
                let named = imports(&code, prefix).into_iter();
                let foreign = *owner != package.name;
                let named =
                    named.filter(|name| foreign || modules.contains(name) && name != module);
                edges.extend(named.map(|name| format!("{owner}::{name}")));
            }
        }
    }
    graph
}

#[test]
fn architecture_module_graph_is_the_documented_one() {
    let (documented, actual) = (documented(), actual());
    let all: BTreeSet<&String> = documented.keys().chain(actual.keys()).collect();
    let mut differences = Vec::new();
    for module in all {
        match (documented.get(module), actual.get(module)) {
            (Some(d), Some(a)) if d == a => {}
            (Some(_), None) => differences.push(format!("{module} is documented, not there")),
            (_, Some(a)) => {
                let list: Vec<&str> = a.iter().map(String::as_str).collect();
                differences.push(format!("the sources say: {module} -> {}", list.join(", ")));
            }
            (None, None) => {}
        }
    }
    assert!(
        differences.is_empty(),
        "docs/architecture.md differs:\n{}",
        differences.join("\n")
    );
}

#[test]
fn architecture_judges_do_not_know_each_other_and_the_engine_knows_no_judge() {
    let graph = actual();
    let reaches = |from: &str, to: &str| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from.to_owned()];
        while let Some(module) = open.pop() {
            if seen.insert(module.clone()) {
                open.extend(graph.get(&module).into_iter().flatten().cloned());
            }
        }
        seen.contains(to)
    };
    assert!(!reaches("reference::oracle", "reference::shadow"));
    assert!(!reaches("reference::shadow", "reference::oracle"));
    assert!(!reaches("engine::thesis", "engine::certified"));
    assert!(!reaches("engine::certified", "engine::thesis"));
    let oracle = &graph["reference::oracle"];
    assert!(!oracle.contains("engine::thesis") && !oracle.contains("engine::certified"));
    let engine = graph
        .iter()
        .filter(|(module, _)| module.starts_with("engine"));
    for (module, edges) in engine {
        assert!(
            edges.iter().all(|edge| edge.starts_with("engine")),
            "{module}"
        );
    }
    // Otherwise whoever judges an engine of their own compiles the stepper.
    let judge = graph
        .iter()
        .filter(|(module, _)| module.starts_with("reference"));
    for (module, edges) in judge {
        assert!(!edges.contains("engine::wire"), "{module}");
    }
    // The graph is not empty for a reason that the other test would share.
    assert!(reaches("reference::oracle", "reference::poly"));
}

#[test]
fn imports_are_found_in_groups_and_paths() {
    let code =
        "use crate::a::B; use crate::{c::{D, E}, f};\nfn g() { crate::h::i(); mycrate::x() }";
    let found: Vec<String> = imports(code, "crate").into_iter().collect();
    assert_eq!(found, ["a", "c", "f", "h"]);
}

/// The names of enums of errors in a source that are closed: who matches them breaks when one grows.
fn closed_errors(text: &str) -> Vec<String> {
    let is_error =
        |name: &str| name.ends_with("Error") || ["Fault", "Reason", "Unsupported"].contains(&name);
    let lines: Vec<_> = text.lines().map(str::trim).collect();
    let enums = lines.iter().enumerate().filter_map(|(at, line)| {
        let name = line.strip_prefix("pub enum ")?.strip_suffix(" {")?;
        let attributes = lines[..at]
            .iter()
            .rev()
            .take_while(|line| line.starts_with("#["));
        let is_open = attributes
            .into_iter()
            .any(|line| *line == "#[non_exhaustive]");
        (is_error(name) && !is_open).then(|| name.to_owned())
    });
    enums.collect()
}

#[test]
fn enums_of_errors_of_the_engine_may_grow() {
    let mut seen = 0;
    for (_, path) in sources(&root().join("src")) {
        let text = fs::read_to_string(&path).unwrap();
        seen += text.matches("Error {\n").count();
        assert_eq!(closed_errors(&text), [""; 0], "{}", path.display());
    }
    assert!(seen > 8, "{seen}");
    assert_eq!(
        closed_errors("#[derive(Debug)]\npub enum AnError {"),
        ["AnError"]
    );
}
