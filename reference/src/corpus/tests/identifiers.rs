use super::*;

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
        radius: Some(0.25.into()),
        ..EDGE_EDGE
    };
    let entry = locate::locate("lattice:1:4711", options).unwrap();
    assert_eq!(entry.query.radius(), 0.25.into());
}

#[test]
fn locate_errors_say_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv").to_str().unwrap().to_owned();
    std::fs::write(&path, csv_with(ROW).repeat(3)).unwrap();
    let forms = "not a query: that is PATH.csv#INDEX, PATH.jsonl#ID, PATH.json#ID, \
                 FAMILY:SEED:INDEX, figure:NAME, or - for the standard input";
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
            format!("lettuce:1:2: {}", crate::generate::IdError::Family),
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
