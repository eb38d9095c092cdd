use tunnelproof::query::{Point, Radius};

use super::*;

/// The one message that a jsonl line gives, without `a.jsonl:1: `.
fn line_error(line: &str) -> String {
    let said = read_text("a.jsonl", line, EDGE_EDGE);
    assert_eq!(said.len(), 1, "{line}: {said:?}");
    let message = said[0].strip_prefix("a.jsonl:1: ").expect(&said[0]);
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
    assert_eq!(entry.query.radius(), 0.25.into());
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
    assert_eq!(read[0].query.radius(), Radius::ZERO);
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
        radius: Some([0.5, 0.25].into()),
        ..EDGE_EDGE
    };
    let text = format!(r#"{{"radius": 2, "points": {EIGHT}}}"#);
    assert_eq!(
        entries("a.jsonl", text.as_str(), options)[0].query.radius(),
        [0.5, 0.25].into()
    );
    assert_eq!(
        entries("a.jsonl", text, EDGE_EDGE)[0].query.radius(),
        2.0.into()
    );
}

#[test]
fn jsonl_errors_name_the_value() {
    let points = |points: &str| format!(r#"{{"points": [{points}]}}"#);
    let zeros = |count: usize| vec!["[0,0,0]"; count].join(",");
    let sixth = |point: &str| points(&format!("{},{point},{}", zeros(5), zeros(2)));
    let field = |field: &str| format!(r#"{{{field}, "points": {EIGHT}}}"#);
    for (line, message) in [
        (
            field(r#""raduis": 0.5"#),
            "raduis: unknown field `raduis`, expected one of `id`, `kind`, `points`, `radius`, `label`, \
             `note` at column 9",
        ),
        (
            field(r#""radius": null"#),
            "radius: neither a number nor two numbers in brackets (hexadecimal floats in quotes) \
             at column 15",
        ),
        (
            field(r#""kind": null"#),
            "kind: invalid type: null, expected a string at column 13",
        ),
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
            "the radius is -1; it has to be finite, and 0 or more",
        ),
        (
            field(r#""radius": "inf""#),
            "radius is \"inf\", which is not a finite number",
        ),
        (
            field(r#""radius": []"#),
            "radius: neither a number nor two numbers in brackets (hexadecimal floats in quotes) \
             at column 13",
        ),
        (
            field(r#""radius": [1, 2, 3]"#),
            "radius: neither a number nor two numbers in brackets (hexadecimal floats in quotes) \
             at column 20",
        ),
        (
            field(r#""radius": [1, -2]"#),
            "the radius is 1 + -2; both have to be finite, and 0 or more",
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
        ["edge-edge.jsonl:1: states no kind; pass --kind edge-edge or --kind vertex-face"]
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
