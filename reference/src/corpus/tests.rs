use std::io::Cursor;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use tunnelproof::query::{Point, QueryKind};

use super::jsonl::Numbers;
use super::*;
use crate::field::{self, Integer};

const EDGE_EDGE: ReadOptions = ReadOptions {
    kind: Some(QueryKind::EdgeEdge),
    radius: None,
};

const EIGHT: &str = "[[0,0,0],[1,0,0],[0,1,1],[0,1,2],[0,0,0],[1,0,0],[0,-1,1],[0,-1,2]]";

fn read_text(path: &str, text: impl Into<Vec<u8>>, options: ReadOptions) -> Vec<String> {
    let format = Format::of_path(path);
    match read(Cursor::new(text.into()), path, format, options) {
        Ok(entries) => entries
            .map(|entry| match entry {
                Ok(entry) => format!("{:?} {}", entry.line, entry.id),
                Err(error) => error.to_string(),
            })
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}

fn entries(path: &str, text: impl Into<Vec<u8>>, options: ReadOptions) -> Vec<Entry> {
    read(
        Cursor::new(text.into()),
        path,
        Format::of_path(path),
        options,
    )
    .unwrap()
    .map(Result::unwrap)
    .collect()
}

/// The one message that a jsonl line gives, without `a.jsonl:1: `.
fn line_error(line: &str) -> String {
    let said = read_text("a.jsonl", line, EDGE_EDGE);
    assert_eq!(said.len(), 1, "{line}: {said:?}");
    let message = said[0].strip_prefix("a.jsonl:1: ").expect(&said[0]);
    message.to_owned()
}

fn csv_of(rows: &[&str]) -> String {
    rows.iter().map(|row| format!("{row}\n")).collect()
}

const ROW: &str = "1,2,3,4,5,8,0";

fn csv_with(row: &str) -> String {
    csv_of(&[ROW, ROW, row, ROW, ROW, ROW, ROW, ROW])
}

/// The one message that a csv gives whose third row this is, without `a.csv:3: `.
fn row_error(row: &str) -> String {
    let said = read_text("a.csv", csv_with(row), EDGE_EDGE);
    assert_eq!(said.len(), 1, "{row}: {said:?}");
    let message = said[0].strip_prefix("a.csv:3: ").expect(&said[0]);
    message.to_owned()
}

#[test]
fn jsonl_read_every_field() {
    let text = concat!(
        r#"{"id": "a b", "kind": "vertex-face", "radius": "0x1p-2", "label": true, "#,
        r#""note": [1e999], "points": [["0x1.8p-3", -0.0, 1e-320], [9007199254740993, 0.1, 1E5], "#,
        r#"[0,0,0], [0,0,0], [0,0,0], [0,0,0], [0,0,0], [-1,-2,-3]]}"#,
    );
    let read = entries("a.jsonl", text, ReadOptions::default());
    let [entry] = read.as_slice() else {
        panic!("{read:?}");
    };
    assert_eq!(entry.id, "a b");
    assert_eq!(entry.label, Some(true));
    assert_eq!(entry.line, Some(1));
    assert_eq!(entry.query.kind(), QueryKind::VertexFace);
    assert_eq!(entry.query.radius(), 0.25);
    let [a, b, ..] = entry.query.start();
    assert_eq!(
        (a.x, a.y.to_bits(), a.z),
        (0.1875, (-0f64).to_bits(), 1e-320)
    );
    assert_eq!((b.x, b.y, b.z), (9007199254740992.0, 0.1, 1e5));
    assert_eq!(entry.query.end()[3], Point::new(-1.0, -2.0, -3.0));
}

#[test]
fn jsonl_read_leaves_out_what_has_a_default() {
    let text = format!("\u{feff}\r\n  \n{{\"points\": {EIGHT}}}\r\n\n\t{{\"points\": {EIGHT}}}");
    let read = entries("a.jsonl", text, EDGE_EDGE);
    let ids: Vec<_> = read
        .iter()
        .map(|entry| (entry.line, entry.id.as_str()))
        .collect();
    assert_eq!(ids, [(Some(3), "3"), (Some(5), "5")]);
    assert_eq!(read[0].label, None);
    assert_eq!(read[0].query.radius(), 0.0);
    assert_eq!(read[0].query.kind(), QueryKind::EdgeEdge);
}

#[test]
fn jsonl_read_label_is_a_truth_value() {
    for (label, value) in [
        ("0", Some(false)),
        ("1", Some(true)),
        ("false", Some(false)),
        ("true", Some(true)),
        ("null", None),
    ] {
        let text = format!(r#"{{"label": {label}, "points": {EIGHT}}}"#);
        assert_eq!(
            entries("a.jsonl", text, EDGE_EDGE)[0].label,
            value,
            "{label}"
        );
    }
}

#[test]
fn jsonl_read_radius_option_overrides() {
    let options = ReadOptions {
        radius: Some(0.5),
        ..EDGE_EDGE
    };
    let text = format!(r#"{{"radius": 2, "points": {EIGHT}}}"#);
    assert_eq!(
        entries("a.jsonl", text.as_str(), options)[0].query.radius(),
        0.5
    );
    assert_eq!(entries("a.jsonl", text, EDGE_EDGE)[0].query.radius(), 2.0);
}

#[test]
fn jsonl_errors_name_the_value() {
    let points = |points: &str| format!(r#"{{"points": [{points}]}}"#);
    let zeros = |count: usize| vec!["[0,0,0]"; count].join(",");
    let sixth = |point: &str| points(&format!("{},{point},{}", zeros(5), zeros(2)));
    let field = |field: &str| format!(r#"{{{field}, "points": {EIGHT}}}"#);
    for (line, message) in [
        (points(&zeros(7)), "7 points, not 8"),
        (points(""), "0 points, not 8"),
        (points(&zeros(9)), "9 points, not 8"),
        (sixth("[0,0]"), "point B at t = 1 has 2 coordinates, not 3"),
        (
            sixth("[0,0,0,0]"),
            "point B at t = 1 has 4 coordinates, not 3",
        ),
        (
            sixth("[0,NaN,0]"),
            "y of point B at t = 1: expected value at column 56",
        ),
        (
            sixth("[0,0,1e999]"),
            "z of point B at t = 1: number out of range at column 62",
        ),
        (
            sixth("[-Infinity,0,0]"),
            "x of point B at t = 1: invalid number at column 55",
        ),
        (
            sixth("[0,0,null]"),
            "z of point B at t = 1: invalid type: null, expected a number or a hexadecimal float \
             in quotes at column 61",
        ),
        (
            sixth("7"),
            "point B at t = 1: invalid type: integer `7`, expected a sequence at column 53",
        ),
        (
            sixth(r#"["NaN",0,0]"#),
            "x of point B at t = 1 is \"NaN\", which is not a finite number",
        ),
        (
            sixth(r#"[0,"0.5",0]"#),
            "y of point B at t = 1 is \"0.5\", which is not a hexadecimal float such as 0x1.8p-3",
        ),
        (
            sixth(r#"[0,0,"0x1p1024"]"#),
            "z of point B at t = 1 is \"0x1p1024\", which is not an f64: its magnitude is 2^1024 \
             or more",
        ),
        (
            sixth(r#"[0,0,"0x1.00000000000008p0"]"#),
            "z of point B at t = 1 is \"0x1.00000000000008p0\", which is not an f64: it has 54 \
             significant bits, an f64 has 53",
        ),
        (
            sixth(r#"[0,0,"-0x1p-1075"]"#),
            "z of point B at t = 1 is \"-0x1p-1075\", which is not an f64: it is not a multiple \
             of 2^-1074",
        ),
        (
            field(r#""radius": -1"#),
            "radius is -1, not a finite number of at least 0",
        ),
        (
            field(r#""radius": "inf""#),
            "radius is \"inf\", which is not a finite number",
        ),
        (
            field(r#""radius": []"#),
            "radius: invalid type: sequence, expected a number or a hexadecimal float in quotes \
             at column 13",
        ),
        (
            field(r#""kind": "edge""#),
            "kind is \"edge\", neither edge-edge nor vertex-face",
        ),
        (
            field(r#""kind": "vertex-face""#),
            "is of kind vertex-face, but --kind says edge-edge",
        ),
        (
            field(r#""id": 7"#),
            "id: invalid type: integer `7`, expected a string at column 8",
        ),
        (
            field(r#""label": 2"#),
            "label: 2 is none of 0, 1, false and true at column 11",
        ),
        (
            field(r#""label": "1""#),
            "label: \"1\" is none of 0, 1, false and true at column 13",
        ),
        (
            field(r#""points": []"#),
            "duplicate field `points` at column 23",
        ),
        (
            r#"{"id": "a"}"#.into(),
            "missing field `points` at column 11",
        ),
        (
            r#"{"points": [[1"#.into(),
            "point A at t = 0: EOF while parsing a list at column 14",
        ),
        (points(&zeros(8)) + "]", "trailing characters at column 78"),
        ("[1, 2]".into(), "not a JSON object"),
        ("1,2,3".into(), "not a JSON object"),
        ("nonsense".into(), "not a JSON object"),
    ] {
        assert_eq!(line_error(&line), message, "{line}");
    }
}

#[test]
fn jsonl_kind_missing_is_an_error() {
    let text = format!("{{\"points\": {EIGHT}}}");
    assert_eq!(
        read_text("edge-edge.jsonl", text, ReadOptions::default()),
        ["edge-edge.jsonl:1: the line names neither edge-edge nor vertex-face; pass --kind"]
    );
}

#[test]
fn jsonl_error_has_its_line_and_ends_the_corpus() {
    let good = format!("{{\"points\": {EIGHT}}}\n");
    let text = format!("{good}\n{good}{{\n{good}");
    assert_eq!(
        read_text("dir/a.jsonl", text, EDGE_EDGE),
        [
            "Some(1) 1",
            "Some(3) 3",
            "dir/a.jsonl:4: EOF while parsing an object at column 1"
        ]
    );
}

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
fn csv_read_values_exactly() {
    let last = "6,4,-3,-6,-12345678901234567890123456789,-12345678901234567890123456789,1";
    let rows = [
        "0,1,-0,5,+1,+2,1",
        " 1 , 2 , -3 , 4 , 5 , 8 , 1 ",
        "1,9223372036854775808,1,18446744073709551616,7,-2,1",
        "6000,1000,0,-3,9007199254740992,1,1",
        last,
        last,
        last,
        last,
    ];
    let text = csv_of(&rows[..3]) + &rows[3..].join("\r\n") + "\r\n\r\n";
    let read = entries("set/edge-edge/a.csv", text, ReadOptions::default());
    assert_eq!(read[0].id, "set/edge-edge/a.csv#0");
    let start = read[0].query.start();
    assert_eq!(read[0].label, Some(true));
    assert_eq!(start[0], Point::new(0.0, 0.0, 0.5));
    assert!(start[0].y.is_sign_positive());
    assert_eq!(start[1], Point::new(0.5, -0.75, 0.625));
    assert_eq!(start[2], Point::new(2f64.powi(-63), 2f64.powi(-64), -3.5));
    assert_eq!(start[3], Point::new(6.0, 0.0, 9007199254740992.0));
    assert_eq!(read[0].query.end()[0], Point::new(1.5, 0.5, 1.0));
}

#[test]
fn csv_errors_name_the_column() {
    let two = |bits: u64| field::Default::one().shl(bits).to_string();
    let huge = format!("0,1,{},1,0,1,0", two(1024));
    let odd = field::Default::one().shl(1024).add(&field::Default::one());
    let huge_and_odd = format!("0,1,0,1,{odd},1,0");
    let many_bits = format!("0,1,{odd},{},0,1,0", two(1024));
    let fine = format!("0,1,0,1,3,-{},0", two(1075));
    for (row, message) in [
        (
            "1,2,3,4,5,8",
            "6 columns, not the 7 of x_num,x_den,y_num,y_den,z_num,z_den,label",
        ),
        (
            "1,2,3,4,5,8,0,",
            "8 columns, not the 7 of x_num,x_den,y_num,y_den,z_num,z_den,label",
        ),
        ("1,2,3,four,5,8,0", "y_den is \"four\", not an integer"),
        ("1.5,1,3,4,5,8,0", "x_num is \"1.5\", not an integer"),
        ("1,2,3,4,,8,0", "z_num is \"\", not an integer"),
        ("0x1,2,3,4,5,8,0", "x_num is \"0x1\", not an integer"),
        ("1,2,nan,4,5,8,0", "y_num is \"nan\", not an integer"),
        ("1,2,3,4,5,0,0", "z_den is 0"),
        ("0,0,3,4,5,8,0", "x_den is 0"),
        ("1,-0,3,4,5,8,0", "x_den is 0"),
        (
            "1,3,3,4,5,8,0",
            "x is not an f64: its denominator is not a power of two",
        ),
        (
            "1,2,3,4,10,-12,0",
            "z is not an f64: its denominator is not a power of two",
        ),
        (
            "9007199254740993,1,3,4,5,8,0",
            "x is not an f64: it has 54 significant bits, an f64 has 53",
        ),
        (
            &many_bits,
            "y is not an f64: it has 1025 significant bits, an f64 has 53",
        ),
        (&huge, "y is not an f64: its magnitude is 2^1024 or more"),
        (
            &huge_and_odd,
            "z is not an f64: its magnitude is 2^1024 or more",
        ),
        (&fine, "z is not an f64: it is not a multiple of 2^-1074"),
        ("1,2,3,4,5,8,2", "label is \"2\", neither 0 nor 1"),
        ("1,2,3,4,5,8,", "label is \"\", neither 0 nor 1"),
        (
            "1,2,3,4,5,8,1",
            "label is 1, but 0 on line 1, where the query starts",
        ),
        (
            "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx,2,3,4,5,8,0",
            "x_num is \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...\", not an integer",
        ),
    ] {
        assert_eq!(row_error(row), message, "{row}");
    }
}

#[test]
fn csv_error_has_its_line_and_ends_the_corpus() {
    let good = csv_with(ROW);
    let text = format!("{good}\n{}{good}", csv_with("1,2,3,4,5,b,0"));
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        [
            "Some(1) a.csv#0",
            "a.csv:12: z_den is \"b\", not an integer"
        ]
    );
    let text = format!("{good}{}\n\n", csv_of(&[ROW; 5]));
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        [
            "Some(1) a.csv#0",
            "a.csv:13: ends after 5 of the 8 rows of query 1"
        ]
    );
    let text = format!(
        "{good}{good}{}",
        csv_with("1,2,3,4,5,8,1").replace(",0\n", ",1\n")
    );
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        ["Some(1) a.csv#0", "Some(9) a.csv#1", "Some(17) a.csv#2"]
    );
}

#[test]
fn csv_kind_in_path_nearest_component_decides() {
    for (path, kind) in [
        ("edge-edge/a.csv", Some(QueryKind::EdgeEdge)),
        ("/x/my-vertex-face-set/y/a.csv", Some(QueryKind::VertexFace)),
        ("edge-edge/vertex-face/a.csv", Some(QueryKind::VertexFace)),
        ("vertex-face/a.edge-edge.csv", Some(QueryKind::EdgeEdge)),
        (
            "edge-edge/edge-edge-and-vertex-face.csv",
            Some(QueryKind::EdgeEdge),
        ),
        ("edge/edge.csv", None),
        ("edge-edge/../a.csv", Some(QueryKind::EdgeEdge)),
        ("a.csv", None),
    ] {
        assert_eq!(csv::kind_in_path(path), kind, "{path}");
    }
}

#[test]
fn csv_kind_missing_or_contradictory_is_an_error() {
    assert_eq!(
        read_text("a.csv", csv_with(ROW), ReadOptions::default()),
        ["a.csv: the path names neither edge-edge nor vertex-face; pass --kind"]
    );
    assert_eq!(
        read_text("vertex-face/a.csv", csv_with(ROW), EDGE_EDGE),
        ["vertex-face/a.csv: is of kind vertex-face, but --kind says edge-edge"]
    );
}

#[test]
fn csv_radius_option_is_checked() {
    let options = ReadOptions {
        radius: Some(-1.0),
        ..EDGE_EDGE
    };
    assert_eq!(
        read_text("a.csv", csv_with(ROW), options),
        ["a.csv:1: radius is -1, not a finite number of at least 0"]
    );
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
        ["<stdin>: the path names neither edge-edge nor vertex-face; pass --kind"]
    );
}

#[test]
fn corpus_error_is_one_line() {
    let said = read_text("a\nb.jsonl", r#"{"kind": "x\ny"}"#, EDGE_EDGE);
    assert_eq!(said, ["a\\nb.jsonl:1: missing field `points` at column 16"]);
    let text = format!(r#"{{"kind": "x\ny", "points": {EIGHT}}}"#);
    assert_eq!(
        line_error(&text),
        r#"kind is "x\\ny", neither edge-edge nor vertex-face"#.replace("\\\\", "\\")
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

#[test]
fn locate_finds_what_the_identifier_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("a#1.csv"), csv_with(ROW).repeat(3)).unwrap();
    let id = format!("{}#2", path("a#1.csv"));
    let entry = locate::locate(&id, EDGE_EDGE).unwrap();
    assert_eq!((entry.id, entry.line), (id, Some(17)));

    let full = format!("{}#x", path("b.jsonl"));
    let line = |id: &str| format!("{{\"id\": \"{id}\", \"points\": {EIGHT}}}\n");
    std::fs::write(
        path("b.jsonl"),
        line("c.csv#1") + &line(&full) + &line("last"),
    )
    .unwrap();
    for (id, line) in [("c.csv#1", 1), ("x", 2), ("last", 3)] {
        let entry = locate::locate(&format!("{}#{id}", path("b.jsonl")), EDGE_EDGE).unwrap();
        assert_eq!(entry.line, Some(line), "{id}");
    }

    let entry = locate::locate("lattice:1:4711", ReadOptions::default()).unwrap();
    let family = crate::generate::by_name("lattice").unwrap();
    assert_eq!(entry.query, family.query(1, 4711));
    assert_eq!((entry.id.as_str(), entry.line), ("lattice:1:4711", None));
    let options = ReadOptions {
        radius: Some(0.25),
        ..EDGE_EDGE
    };
    let entry = locate::locate("lattice:1:4711", options).unwrap();
    assert_eq!(entry.query.radius(), 0.25);
}

#[test]
fn locate_errors_say_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv").to_str().unwrap().to_owned();
    std::fs::write(&path, csv_with(ROW).repeat(3)).unwrap();
    let forms = "not a query: that is PATH.csv#INDEX, PATH.jsonl#ID, FAMILY:SEED:INDEX, or - for \
                 the standard input";
    for (id, message) in [
        (
            format!("{path}#3"),
            format!("{path}: none of its 3 queries is \"3\""),
        ),
        (path.clone(), format!("{path}: {forms}")),
        ("nonsense#1".into(), format!("nonsense#1: {forms}")),
        ("no.csv#1".into(), "no.csv: no such file".into()),
        (
            "lettuce:1:2".into(),
            "lettuce:1:2: no such family; there are uniform, lattice".into(),
        ),
        (
            "lattice:1:b".into(),
            "lattice:1:b: the index is not an integer from 0 to 18446744073709551615".into(),
        ),
    ] {
        let error = locate::locate(&id, EDGE_EDGE).unwrap_err();
        assert_eq!(error.to_string(), message, "{id}");
    }
    let options = ReadOptions {
        kind: Some(QueryKind::VertexFace),
        radius: None,
    };
    assert_eq!(
        locate::locate("lattice:1:2", options)
            .unwrap_err()
            .to_string(),
        "lattice:1:2: is of kind edge-edge, but --kind says vertex-face"
    );
}

/// Every csv file in `folder` and below.
fn csv_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(csv_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "csv") {
            files.push(path);
        }
    }
    files
}

#[test]
fn csv_read_public_sample_queries() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/ccd-sample-queries");
    if !root.is_dir() {
        eprintln!("skipped: {} is not there", root.display());
        return;
    }
    let files = csv_files(&root);
    assert!(!files.is_empty());
    for file in files {
        let path = file.to_str().unwrap();
        let rows = std::fs::read_to_string(path).unwrap().lines().count();
        let entries: Result<Vec<_>, _> = open(path, ReadOptions::default()).unwrap().collect();
        assert_eq!(entries.unwrap().len(), rows / 8, "{path}");
        assert_eq!(rows % 8, 0, "{path}");
    }
}

fn finite() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        (0u64..1 << 53).prop_map(f64::from_bits),
        prop_oneof![
            Just(0.0),
            Just(-0.0),
            Just(f64::MAX),
            Just(1e308),
            Just(-5e-324)
        ],
    ]
    .prop_map(|value| if value.is_finite() { value } else { 0.1 })
}

fn eight_points() -> impl Strategy<Value = [Point; 8]> {
    proptest::array::uniform8(proptest::array::uniform3(finite()))
        .prop_map(|points| points.map(Point::from))
}

fn query(kind: QueryKind, points: [Point; 8], radius: f64) -> Query {
    let [a, b, c, d, a1, b1, c1, d1] = points;
    Query::new(kind, [a, b, c, d], [a1, b1, c1, d1], radius).unwrap()
}

fn bits(query: &Query) -> Vec<u64> {
    let points = query.start().iter().chain(query.end());
    let coordinates = points.flat_map(|point| [point.x, point.y, point.z]);
    coordinates
        .chain([query.radius()])
        .map(f64::to_bits)
        .collect()
}

/// A finite `f64` as the fraction of two integers.
fn fraction(value: f64) -> [field::Default; 2] {
    let magnitude = value.abs().to_bits();
    let (mantissa, exponent) = match magnitude >> 52 {
        0 => (magnitude, -1074),
        biased => (magnitude & ((1 << 52) - 1) | 1 << 52, biased as i64 - 1075),
    };
    let mantissa = field::Default::from_i64(if value < 0.0 {
        -(mantissa as i64)
    } else {
        mantissa as i64
    });
    let power = |bits: i64| field::Default::one().shl(bits.max(0) as u64);
    [mantissa.mul(&power(exponent)), power(-exponent)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn jsonl_write_then_read_gives_the_same_bits(
        id: String,
        is_vertex_face: bool,
        points in eight_points(),
        radius in finite(),
        label: Option<bool>,
        is_hexadecimal: bool,
    ) {
        let kind = if is_vertex_face { QueryKind::VertexFace } else { QueryKind::EdgeEdge };
        let query = query(kind, points, radius.abs());
        let entry = Entry { id, query, label, line: Some(1) };
        let numbers = if is_hexadecimal { Numbers::Hexadecimal } else { Numbers::Decimal };
        let line = jsonl::write(&entry, numbers);
        prop_assert!(!line.contains('\n'));
        let read = entries("a.jsonl", line, ReadOptions::default());
        prop_assert_eq!(bits(&read[0].query), bits(&entry.query));
        prop_assert_eq!(&read, &[entry]);
    }

    /// Every `f64` as a fraction, with the same factor in numerator and denominator.
    #[test]
    fn csv_read_fractions_gives_the_same_bits(
        points in eight_points(),
        factor in prop_oneof![Just(1), any::<i64>().prop_filter("not 0", |factor| *factor != 0)],
        label: bool,
    ) {
        let factor = field::Default::from_i64(factor);
        let mut text = String::new();
        for point in &points {
            for &value in point.iter() {
                let [numerator, denominator] = fraction(value).map(|part| part.mul(&factor));
                text += &format!("{numerator},{denominator},");
            }
            text += &format!("{}\n", u8::from(label));
        }
        // A fraction has no zero with a sign.
        let points = points.map(|point| Point::from(point.coords.map(|value| value + 0.0)));
        let read = entries("a.csv", text, EDGE_EDGE);
        prop_assert_eq!(bits(&read[0].query), bits(&query(QueryKind::EdgeEdge, points, 0.0)));
        prop_assert_eq!(read[0].label, Some(label));
    }

    #[test]
    fn corpus_read_never_panics_on_bytes(text: Vec<u8>) {
        for path in ["a.jsonl", "a.csv", "-"] {
            for said in read_text(path, text.clone(), EDGE_EDGE) {
                prop_assert!(!said.contains('\n'));
            }
        }
    }

    /// Texts that come close to a query.
    #[test]
    fn corpus_read_never_panics_on_broken_queries(
        cut in 0usize..400,
        put in "[-0-9a-z\\[\\]{},:\"\\.\n]{0,6}",
    ) {
        let json = format!(r#"{{"id": "a", "kind": "edge-edge", "label": 1, "points": {EIGHT}}}"#);
        for (path, text) in [("a.jsonl", json), ("a.csv", csv_with(ROW).repeat(2))] {
            let cut = cut % text.len();
            let text = format!("{}{put}{}", &text[..cut], &text[cut + 1..]);
            for said in read_text(path, text, EDGE_EDGE) {
                prop_assert!(!said.contains('\n'));
            }
        }
    }
}
