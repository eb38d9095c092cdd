//! `docs/conformance.md` names what exists, and leaves out no algorithm.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use tunnelproof_reference::figures::FIGURES;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).expect(path)
}

/// The tables of the page: rows of cells, the head first, without the line below it.
fn tables() -> Vec<Vec<Vec<String>>> {
    let page = read("docs/conformance.md");
    let lines: Vec<&str> = page.lines().collect();
    let groups = lines.split(|line| !line.starts_with('|'));
    groups
        .filter(|group| !group.is_empty())
        .map(|group| {
            let rows = group.iter().filter(|line| !line.starts_with("| ---"));
            rows.map(|line| cells(line)).collect()
        })
        .collect()
}

fn cells(line: &str) -> Vec<String> {
    let cells = line.trim_matches('|').split('|');
    cells.map(|cell| cell.trim().to_owned()).collect()
}

/// The texts in backquotes.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// A name and the file that it is in, relative to the root.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    name: String,
    file: String,
}

/// The columns of names, by their heads: the folder that their files are in, and whether they hold
/// tests.
const COLUMNS: [(&str, &str, bool); 7] = [
    ("engine", "src/", false),
    ("shadow", "reference/src/shadow/", false),
    ("oracle", "reference/src/oracle/", false),
    ("judge", "reference/src/", false),
    ("tests of the engine", "src/thesis/", true),
    ("tests of the shadow", "reference/src/shadow/tests/", true),
    ("tests", "", true),
];

/// The names in a cell, each of which is a link to its file.
fn places(cell: &str, folder: &str) -> Vec<Place> {
    let links = cell.split(", ").filter(|link| link.starts_with('['));
    let places: Vec<Place> = links
        .map(|link| {
            let link = link.strip_prefix("[`").and_then(|l| l.strip_suffix(')'));
            let (name, file) = link.and_then(|l| l.split_once("`](../")).expect(cell);
            assert!(file.starts_with(folder), "{file} is not in {folder}");
            let (name, file) = (name.to_owned(), file.to_owned());
            Place { name, file }
        })
        .collect();
    assert_eq!(
        places.len(),
        quoted(cell).count(),
        "a name without link in {cell}"
    );
    places
}

/// A column of names.
struct Column {
    head: &'static str,
    is_test: bool,
    cells: Vec<Vec<Place>>,
}

fn columns(table: &[Vec<String>]) -> Vec<Column> {
    let (heads, rows) = table.split_first().expect("a table has a head");
    let of_names = heads.iter().enumerate().filter_map(|(index, text)| {
        let column = COLUMNS.iter().find(|(head, ..)| head == text)?;
        Some((index, column))
    });
    of_names
        .map(|(index, &(head, folder, is_test))| Column {
            head,
            is_test,
            cells: rows.iter().map(|row| places(&row[index], folder)).collect(),
        })
        .collect()
}

/// The table with such a head.
fn table_of(heads: &[&str]) -> Vec<Vec<String>> {
    let table = tables().into_iter().find(|table| table[0] == heads);
    table.unwrap_or_else(|| panic!("no table {heads:?}"))
}

/// The numbers of the algorithms in a table of them.
fn numbers(table: &[Vec<String>]) -> Vec<u8> {
    let of_row = |row: &Vec<String>| row[0].split(',').next().unwrap().parse().unwrap();
    table[1..].iter().map(of_row).collect()
}

fn is_part_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether a text defines an item or a field of this name.
fn defines(text: &str, name: &str) -> bool {
    let is_end = |rest: &str| !rest.starts_with(is_part_of_name);
    let kinds = ["fn ", "struct ", "enum ", "static ", "pub "];
    kinds.iter().any(|kind| {
        let item = format!("{kind}{name}");
        text.match_indices(&item)
            .any(|(at, _)| is_end(&text[at + item.len()..]))
    })
}

/// Whether a text has a test of this name, by itself or in the table of a macro that makes one of each entry.
fn tests(text: &str, name: &str) -> bool {
    let mut lines = text.lines().map(str::trim_start);
    let function = format!("fn {name}(");
    let entry = format!("{name}: \"");
    if text.contains("fn $test() {") && lines.clone().any(|line| line.starts_with(&entry)) {
        return true;
    }
    while let Some(line) = lines.next() {
        if line == "#[test]" && lines.next().is_some_and(|line| line.starts_with(&function)) {
            return true;
        }
    }
    false
}

/// `Name` of the thesis and `name` of the sources, made comparable.
fn plain(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}

/// The functions of a folder whose documentation starts with `Algorithm N`, with that number.
fn documented(folder: &str) -> BTreeSet<(u8, Place)> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(root().join(folder)).expect(folder) {
        let entry = entry.expect(folder);
        if entry.path().is_dir() {
            continue;
        }
        let file = folder.to_owned() + &entry.file_name().to_string_lossy();
        let text = read(&file);
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            let Some(rest) = line.strip_prefix("/// Algorithm ") else {
                continue;
            };
            let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
            let item = lines.find(|line| !line.starts_with("///"));
            let Some((_, signature)) = item.and_then(|item| item.split_once("fn ")) else {
                continue;
            };
            let name = signature.chars().take_while(|&c| is_part_of_name(c));
            let place = Place {
                name: name.collect(),
                file: file.clone(),
            };
            found.insert((digits.parse().expect(line), place));
        }
    }
    found
}

#[test]
fn conformance_names_items_that_exist_and_tests_that_run() {
    let mut missing = Vec::new();
    let mut count = 0;
    for table in tables() {
        for column in columns(&table) {
            for place in column.cells.into_iter().flatten() {
                let text = read(&place.file);
                let exists = if column.is_test { tests } else { defines };
                if !exists(&text, &place.name) {
                    missing.push(place);
                }
                count += 1;
            }
        }
    }
    assert!(missing.is_empty(), "not there: {missing:#?}");
    assert!(count > 100, "only {count} names were found in the page");
}

#[test]
fn conformance_has_a_place_and_a_test_in_every_cell() {
    for table in tables() {
        for column in columns(&table) {
            for (index, cell) in column.cells.iter().enumerate() {
                let row = &table[index + 1];
                let is_exempt = row.contains(&"all 0".to_owned());
                assert!(!cell.is_empty() || is_exempt, "an empty cell in {row:?}");
            }
        }
    }
}

#[test]
fn conformance_has_every_algorithm_once_under_its_name() {
    let table = table_of(&["algorithm", "text", "engine", "shadow", "oracle"]);
    let numbers = numbers(&table);
    assert_eq!(numbers, (1..=20).collect::<Vec<u8>>());
    let mut columns = columns(&table);
    columns.retain(|column| column.head != "oracle");
    let folders = ["src/thesis/", "reference/src/shadow/"];
    assert_eq!(columns.len(), folders.len());
    for (column, folder) in columns.into_iter().zip(folders) {
        let mut named = BTreeSet::new();
        for ((row, number), cell) in table[1..].iter().zip(&numbers).zip(column.cells) {
            let [place] = cell.as_slice() else {
                panic!("not one function in {row:?}");
            };
            let of_text = quoted(&row[0]).next().unwrap();
            assert_eq!(plain(&place.name), plain(of_text));
            named.insert((*number, place.clone()));
        }
        assert_eq!(named, documented(folder), "{folder}");
    }
}

#[test]
fn conformance_has_tests_of_whatever_has_a_function() {
    let tested = [
        (
            "algorithm",
            &["algorithm", "text", "engine", "shadow", "oracle"][..],
        ),
        ("function", &["function", "text", "engine", "shadow"][..]),
    ];
    for (what, functions) in tested {
        let functions = table_of(functions);
        let tests = table_of(&[what, "tests of the engine", "tests of the shadow"]);
        let names = |table: &[Vec<String>]| -> Vec<String> {
            table.iter().map(|row| row[0].clone()).collect()
        };
        assert_eq!(names(&functions), names(&tests));
    }
    let surrounding = table_of(&["text", "what", "engine", "judge"]);
    let tests = table_of(&["text", "tests"]);
    let texts: Vec<&String> = surrounding.iter().map(|row| &row[0]).collect();
    assert_eq!(texts, tests.iter().map(|row| &row[0]).collect::<Vec<_>>());
}

#[test]
fn conformance_has_every_figure_with_its_case_and_time() {
    let tables = tables();
    let table = tables.iter().find(|table| table[0][0] == "figure").unwrap();
    assert_eq!(table.len(), 1 + FIGURES.len());
    for (row, figure) in table[1..].iter().zip(&FIGURES) {
        let time = figure.contact.map_or("none".to_owned(), |contact| {
            format!("{}/{}", contact.toi.numerator, contact.toi.denominator)
        });
        assert_eq!(row[..3], [figure.name, figure.case.name(), &time]);
    }
}
