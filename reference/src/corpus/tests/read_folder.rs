//! Folders of queries, and labels that stand beside them.

use std::fs;
use std::path::Path;

use tunnelproof::query::QueryKind;

use super::*;
use crate::corpus::folder;

/// A scene of the newer benchmark with two queries of edges and one of a face, labelled so.
fn scene(edges: &str, face: &str) -> tempfile::TempDir {
    let scene = tempfile::tempdir().unwrap();
    let row = "1,2,3,4,5,8\n".repeat(8);
    for (name, text) in [
        ("queries/7ee.csv", row.repeat(2)),
        ("queries/7vf.csv", row.clone()),
        ("mma_bool/7ee_mma_bool.json", edges.to_owned()),
        ("mma_bool/7vf_mma_bool.json", face.to_owned()),
        ("boxes/7ee.json", "[[0,1]]".to_owned()),
        ("frames/7.ply", "ply".to_owned()),
    ] {
        let path = scene.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    scene
}

fn files(folder: &Path) -> Vec<String> {
    folder::files(folder.to_str().unwrap()).unwrap()
}

/// The kinds and labels of all queries of a scene, or the first error.
fn all(scene: &tempfile::TempDir) -> Result<Vec<(QueryKind, Option<bool>)>, String> {
    let entries = files(scene.path()).into_iter().map(|path| {
        let entries = open(&path, ReadOptions::default()).map_err(|error| error.to_string())?;
        entries
            .map(|entry| entry.map_err(|error| error.to_string()))
            .map(|entry| entry.map(|entry| (entry.query.kind(), entry.label)))
            .collect::<Result<Vec<_>, _>>()
    });
    Ok(entries.collect::<Result<Vec<_>, _>>()?.concat())
}

#[test]
fn folder_of_the_newer_benchmark_is_read_with_its_labels() {
    let scene = scene("[true,0]", "[1]");
    let names = files(scene.path());
    let ends: Vec<_> = names.iter().map(|name| &name[name.len() - 15..]).collect();
    assert_eq!(ends, ["queries/7ee.csv", "queries/7vf.csv"]);
    assert_eq!(
        all(&scene).unwrap(),
        [
            (QueryKind::EdgeEdge, Some(true)),
            (QueryKind::EdgeEdge, Some(false)),
            (QueryKind::VertexFace, Some(true)),
        ]
    );
}

#[test]
fn labels_that_are_not_those_of_the_queries_are_refused() {
    for (labels, message) in [
        ("[1]", "1 labels, and there are at least 2 queries"),
        ("[1,0,1]", "3 labels, and there are only 2 queries"),
        ("[1,2]", "label is \"2\", neither 0 nor 1"),
        ("{}", "invalid type: map, expected a sequence at column 0"),
    ] {
        let scene = scene(labels, "[1]");
        let error = all(&scene).unwrap_err();
        assert!(error.contains("7ee_mma_bool.json: "), "{error}");
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn six_columns_without_labels_beside_are_not_labelled() {
    let scene = scene("[1,0]", "[1]");
    fs::remove_dir_all(scene.path().join("mma_bool")).unwrap();
    assert!(
        all(&scene)
            .unwrap()
            .iter()
            .all(|(_, label)| label.is_none())
    );
}

#[test]
fn folder_has_the_files_of_queries_but_no_schema_and_an_empty_one_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let empty = folder::files(folder.path().to_str().unwrap()).unwrap_err();
    assert!(empty.to_string().contains("no file of queries"), "{empty}");
    for (name, text) in [
        ("b.json", "{\n \"schema\": \"schema.json\",\n"),
        (
            "schema.json",
            "{\n  \"$schema\": \"https://json-schema.org\"\n}",
        ),
        ("a.jsonl.gz", ""),
        ("README.md", ""),
        ("turning/c.json", ""),
    ] {
        fs::create_dir_all(at("turning")).unwrap();
        fs::write(at(name), text).unwrap();
    }
    let found = files(folder.path());
    let named = |names: &[&str]| -> Vec<_> {
        let path = |name: &&str| at(name).to_str().unwrap().to_owned();
        names.iter().map(path).collect()
    };
    assert_eq!(found, named(&["a.jsonl.gz", "b.json"]));
    assert!(folder::is_schema(at("schema.json").to_str().unwrap()));
    // Those of bodies that turn are left out beside that schema alone.
    fs::remove_file(at("schema.json")).unwrap();
    let found = files(folder.path());
    assert_eq!(found, named(&["a.jsonl.gz", "b.json", "turning/c.json"]));
}

/// The scene that is there on some machines only.
#[test]
fn sample_of_the_newer_benchmark_is_read_with_a_label_for_each_query() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let sample = |up: &str| root.join(up).join("shared/data/scalable-ccd-sample");
    let mut samples = ["..", "../.."].map(sample).into_iter();
    let Some(sample) = samples.find(|sample| sample.is_dir()) else {
        return;
    };
    let mut count = [0; 2];
    for path in files(&sample) {
        for entry in open(&path, ReadOptions::default()).unwrap() {
            count[usize::from(entry.unwrap().label.unwrap())] += 1;
        }
    }
    assert_eq!(count.iter().sum::<i32>(), 263 + 92);
    assert!(count.iter().all(|count| *count > 0), "{count:?}");
}
