//! Files of test vectors.

use tunnelproof::query::Point;

use super::*;

fn document(vectors: &[&str]) -> String {
    format!(
        "{{\n \"source\": \"a test\",\n \"vectors\": [\n{}\n ]\n}}\n",
        vectors.join(",\n")
    )
}

fn vector(id: &str, points: &str, hit: bool) -> String {
    format!(
        "  {{\n   \"id\": \"{id}\",\n   \"points\": {points},\n   \"result\": {{\"hit\": {hit}}}\n  }}"
    )
}

#[test]
fn vector_file_gives_labelled_queries() {
    let text = document(&[&vector("a", EIGHT, true), &vector("b#c", EIGHT, false)]);
    let entries = entries("a.json", text, ReadOptions::default());
    let ids: Vec<_> = entries
        .iter()
        .map(|entry| (entry.id.as_str(), entry.label))
        .collect();
    assert_eq!(ids, [("a", Some(true)), ("b#c", Some(false))]);
    assert_eq!(entries[0].query.kind(), QueryKind::EdgeEdge);
    assert_eq!(entries[0].query.start()[3], Point::new(0.0, 1.0, 2.0));
}

#[test]
fn vector_file_takes_the_kind_that_a_vector_states() {
    let face =
        vector("a", EIGHT, true).replace("\"points\"", "\"kind\": \"vertex-face\", \"points\"");
    let text = document(&[&face, &vector("b", EIGHT, true)]);
    let entries = entries("a.json", text, ReadOptions::default());
    let kinds: Vec<_> = entries.iter().map(|entry| entry.query.kind()).collect();
    assert_eq!(kinds, [QueryKind::VertexFace, QueryKind::EdgeEdge]);
}

#[test]
fn vector_file_errors_say_where() {
    let read = |text: String| read_text("a.json", text, ReadOptions::default());
    let bad = vector("b", "[[0,0,0]]", true);
    assert_eq!(
        read(document(&[&vector("a", EIGHT, true), &bad])),
        ["None a", "a.json#b: 1 points, not 8"]
    );
    let cut = &document(&[&bad])[..20];
    let [error] = &read(cut.to_owned())[..] else {
        panic!("one error");
    };
    assert!(error.starts_with("a.json:2: vectors: EOF"), "{error}");
    let [error] = &read("{\n\"queries\": []\n}".to_owned())[..] else {
        panic!("one error");
    };
    assert!(
        error.starts_with("a.json:3: vectors: missing field"),
        "{error}"
    );
}

#[test]
fn locate_finds_a_vector_by_its_id() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../vectors/errata.json");
    let id = format!("{path}#erratum:strict-skip");
    let entry = locate::locate(&id, ReadOptions::default()).unwrap();
    assert_eq!(
        (entry.id.as_str(), entry.label),
        ("erratum:strict-skip", Some(true))
    );
}
