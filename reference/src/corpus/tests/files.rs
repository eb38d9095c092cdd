use super::*;

#[test]
fn lines_that_are_not_text_are_errors() {
    let good = format!("{{\"points\": {EIGHT}}}\n");
    let mut text = good.clone().into_bytes();
    text.extend(b"{\"id\": \"\xff\"}\n");
    assert_eq!(
        read_text("a.jsonl", text, EDGE_EDGE),
        ["Some(1) 1", "a.jsonl:2: line is not UTF-8"]
    );
    let long = format!("{good}{}\n", " ".repeat(1 << 20));
    assert_eq!(
        read_text("a.jsonl", long, EDGE_EDGE),
        ["Some(1) 1", "a.jsonl:2: line is longer than 1048576 bytes"]
    );
    let longest = format!("{good}{}\n{good}", " ".repeat((1 << 20) - 1));
    assert_eq!(
        read_text("a.jsonl", longest, EDGE_EDGE),
        ["Some(1) 1", "Some(3) 3"]
    );
}

#[test]
fn corpus_endless_line_is_refused() {
    for format in [None, Some(Format::Csv), Some(Format::Jsonl)] {
        let endless = BufReader::new(std::io::repeat(b'1'));
        let mut entries = read(endless, "-", format, EDGE_EDGE).unwrap();
        let error = entries.next().unwrap().unwrap_err();
        assert_eq!(
            error.to_string(),
            "<stdin>:1: line is longer than 1048576 bytes"
        );
        assert!(entries.next().is_none());
    }
}

/// A reader that cannot be read.
struct Broken;

impl io::Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        Err(io::Error::other("the cable is cut"))
    }
}

#[test]
fn corpus_query_is_there_before_the_rest_is_read() {
    let text = format!("{{\"points\": {EIGHT}}}\n");
    let reader = io::Read::chain(Cursor::new(text), BufReader::new(Broken));
    let mut entries = read(reader, "-", None, EDGE_EDGE).unwrap();
    assert_eq!(entries.next().unwrap().unwrap().line, Some(1));
    let error = entries.next().unwrap().unwrap_err();
    assert_eq!(error.to_string(), "<stdin>:2: the cable is cut");
    assert!(entries.next().is_none());
}

#[test]
fn corpus_without_a_query_is_an_error() {
    for text in ["", "\n", "\u{feff}", " \r\n\t\n"] {
        for path in ["a.jsonl", "a.csv"] {
            assert_eq!(
                read_text(path, text, EDGE_EDGE),
                [format!("{path}: holds no query")],
                "{text:?}"
            );
        }
    }
}

#[test]
fn corpus_on_stdin_shows_its_format_by_its_first_line() {
    let json = format!("\n {{\"points\": {EIGHT}}}");
    assert_eq!(read_text("-", json, EDGE_EDGE), ["Some(2) 2"]);
    assert_eq!(read_text("-", csv_with(ROW), EDGE_EDGE), ["Some(1) -#0"]);
    assert_eq!(
        read_text("-", "hello", EDGE_EDGE),
        ["<stdin>:1: not a JSON object"]
    );
    assert_eq!(
        read_text("-", csv_with(ROW), ReadOptions::default()),
        ["<stdin>: states no kind; pass --kind edge-edge or --kind vertex-face"]
    );
}

#[test]
fn corpus_error_is_one_line() {
    let said = read_text("a\nb.jsonl", r#"{"kind": "x\ny"}"#, EDGE_EDGE);
    assert_eq!(said, ["a\\nb.jsonl:1: missing field `points` at column 16"]);
    let text = format!(r#"{{"kind": "x\ny", "points": {EIGHT}}}"#);
    assert_eq!(
        read_text("a.jsonl", text, EDGE_EDGE),
        [r#"a.jsonl:1: kind is "x\ny", neither edge-edge nor vertex-face"#]
    );
}

#[test]
fn open_errors_name_the_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::create_dir(path("dir.csv")).unwrap();
    std::fs::write(path("a.txt"), csv_with(ROW)).unwrap();
    std::fs::write(path("empty.jsonl"), "").unwrap();
    for (name, message) in [
        ("missing.csv", "no such file"),
        ("dir.csv", "is a directory, not a file"),
        (
            "a.txt",
            "neither a .jsonl (.json, .ndjson) nor a .csv file; - reads the standard input",
        ),
        ("empty.jsonl", "holds no query"),
    ] {
        let path = path(name);
        let error = open(&path, EDGE_EDGE).and_then(|mut entries| entries.next().unwrap());
        assert_eq!(error.unwrap_err().to_string(), format!("{path}: {message}"));
    }
}

#[cfg(not(feature = "packed"))]
#[test]
fn open_names_the_feature_that_packed_files_need() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv.gz");
    std::fs::write(&path, csv_with(ROW)).unwrap();
    let error = open(path.to_str().unwrap(), EDGE_EDGE).err().unwrap();
    let said = error.to_string();
    assert!(
        said.ends_with("need the feature `packed` of tunnelproof-reference"),
        "{said}"
    );
}

#[test]
fn open_reads_files_of_either_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for name in ["a.jsonl", "a.json", "a.ndjson", "a.JSONL"] {
        std::fs::write(
            path(name),
            format!("{{\"id\": \"q\", \"points\": {EIGHT}}}\n"),
        )
        .unwrap();
        let read: Vec<_> = open(&path(name), EDGE_EDGE).unwrap().collect();
        assert_eq!(read.len(), 1);
        assert_eq!(read[0].as_ref().unwrap().id, "q");
    }
    std::fs::write(path("a.csv"), csv_with(ROW).repeat(3)).unwrap();
    let read: Result<Vec<_>, _> = open(&path("a.csv"), EDGE_EDGE).unwrap().collect();
    let read = read.unwrap();
    assert_eq!(read.len(), 3);
    assert_eq!(read[2].id, format!("{}#2", path("a.csv")));
    assert_eq!(read[2].line, Some(17));
}
