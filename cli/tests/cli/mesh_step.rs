//! `mesh-step`: what it prints and writes, and how it ends.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::run::{assert_refused, code, command, json, stderr, stdout, tunnelproof};

/// A triangle, and above it at a height a vertex and an edge.
fn obj(height: &str) -> String {
    format!(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.25 0.25 {height}\nv 0.5 -1 {height}\nv 0.5 2 {height}\nf 1 2 3\nl 5 6\n"
    )
}

/// Files in a folder.
struct Files {
    folder: TempDir,
}

impl Files {
    fn new(files: &[(&str, &[u8])]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in files {
            fs::write(folder.path().join(name), content).unwrap();
        }
        Files { folder }
    }

    /// A start and an end that fall through the triangle at three quarters, and an end that does
    /// not.
    fn falling() -> Self {
        Files::new(&[
            ("start.obj", obj("3").as_bytes()),
            ("end.obj", obj("-1").as_bytes()),
            ("above.obj", obj("1").as_bytes()),
        ])
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    fn run(&self, start: &str, end: &str, options: &[&str]) -> Output {
        let files = [start, end].map(|name| self.path(name));
        let files = files.each_ref().map(String::as_str);
        tunnelproof(&[&["mesh-step"][..], &files, options].concat())
    }

    fn json(&self, start: &str, end: &str, options: &[&str]) -> Value {
        let output = self.run(start, end, &[options, &["--json", "-"]].concat());
        assert!(code(&output) < 2, "{}", stderr(&output));
        serde_json::from_str(&stdout(&output)).unwrap()
    }
}

#[test]
fn mesh_step_ends_with_1_where_something_touches_and_0_where_nothing_does() {
    let files = Files::falling();
    let output = files.run("start.obj", "end.obj", &[]);
    assert_eq!((code(&output), stderr(&output).as_str()), (1, ""));
    let text = stdout(&output);
    for line in [
        "6 vertices, 4 edges, 1 triangle",
        "candidate pairs: 3 edge-edge, 1 vertex-face",
        "first contact: edge 0 (4-5) and edge 1 (0-1) at 0.75",
        "on ",
    ] {
        assert!(text.contains(line), "{text} has no {line}");
    }
    let output = files.run("start.obj", "above.obj", &[]);
    assert_eq!(code(&output), 0);
    assert!(stdout(&output).contains("first contact: none\nstep: 1\n"));
}

#[test]
fn mesh_step_has_the_stated_fields() {
    let files = Files::falling();
    let found = files.json("start.obj", "end.obj", &["--threads", "2", "--audit"]);
    assert_eq!(found["toi"], json!({"below": 0.75, "above": 0.75}));
    let first = json!({
        "kind": "edge-edge",
        "features": [{"kind": "edge", "index": 0}, {"kind": "edge", "index": 1}],
        "vertices": [4, 5, 0, 1],
    });
    assert_eq!(found["pair"], first);
    let step = found["step"].as_f64().unwrap();
    assert!(step < 0.75 && step > 0.7499, "{step}");
    assert_eq!(found["limits"][0]["blocked"], "ahead");
    assert!(found["limits"][0]["pair"]["features"].is_array());
    assert_eq!(found["near"], json!([]));
    let counts = ["vertices", "edges", "faces", "threads"].map(|name| found[name].as_u64());
    assert_eq!(counts, [6, 4, 1, 2].map(Some));
    assert!(found["seconds"]["first_contact"].as_f64().unwrap() > 0.0);
    assert!(found["seconds"]["step"].as_f64().unwrap() > 0.0);
    assert_eq!(
        found["candidates"],
        json!({"edge-edge": 3, "vertex-face": 1})
    );
    let audit = &found["audit"];
    assert_eq!(audit["pairs"], json!({"edge-edge": 3, "vertex-face": 1}));
    assert_eq!(
        (&audit["contacts"], &audit["disagreements"]),
        (&3.into(), &0.into())
    );
    assert_eq!(
        (&audit["stored_contacts"], &audit["faults"]),
        (&0.into(), &json!([]))
    );
    let found = files.json("start.obj", "above.obj", &[]);
    assert!(found["toi"].is_null() && found["pair"].is_null() && found["audit"].is_null());
}

#[test]
fn mesh_step_json_dash_is_the_standard_output() {
    let files = Files::falling();
    let output = command(&["mesh-step", "start.obj", "above.obj", "--json", "-"])
        .current_dir(files.folder.path())
        .output()
        .unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(serde_json::from_slice::<Value>(&output.stdout).is_ok());
    assert!(!Path::new(&files.path("-")).exists());
    let path = files.path("found.json");
    let output = files.run("start.obj", "above.obj", &["--json", &path]);
    assert!(stdout(&output).starts_with("6 vertices"));
    assert_eq!(json(&path)["step"], 1.0);
}

#[test]
fn mesh_step_writes_positions_that_touch_nothing() {
    let files = Files::falling();
    for name in ["safe.obj", "safe.ply"] {
        let out = files.path(name);
        let output = files.run("start.obj", "end.obj", &["--out", &out, "--audit"]);
        assert_eq!((code(&output), stderr(&output).as_str()), (1, ""));
        // From the start to these, and on from these.
        let output = files.run("start.obj", name, &["--audit"]);
        assert_eq!(code(&output), 0, "{}", stdout(&output));
        assert!(stdout(&output).contains("; contacts: 0; disagreements: 0"));
        let output = files.run(name, "start.obj", &["--audit"]);
        assert_eq!(code(&output), 0, "{}", stdout(&output));
    }
    // In f32: from what is read as f32 to what is written as f32.
    for name in ["single.obj", "single.ply"] {
        let out = files.path(name);
        let single = ["--precision", "f32", "--radius", "0.1", "--audit"];
        let output = files.run(
            "start.obj",
            "end.obj",
            &[&single[..], &["--out", &out]].concat(),
        );
        assert_eq!((code(&output), stderr(&output).as_str()), (1, ""));
        for (start, end) in [("start.obj", name), (name, "start.obj")] {
            let output = files.run(start, end, &single);
            assert_eq!(code(&output), 0, "{}", stdout(&output));
        }
        let exact = ["--radius", "0.1", "--audit"];
        let output = files.run("start.obj", name, &exact);
        assert_eq!(code(&output), 0, "{}", stdout(&output));
    }
    let written = fs::read(files.path("single.ply")).unwrap();
    assert!(String::from_utf8_lossy(&written).contains("property float x"));
    let out = files.path("safe.stl");
    let output = files.run("start.obj", "end.obj", &["--out", &out]);
    assert_refused(&output, &out, None, "an STL holds f32");
    let out = files.path("no/safe.ply");
    let output = files.run("start.obj", "end.obj", &["--out", &out]);
    assert_refused(&output, &out, None, "cannot be written");
}

#[test]
fn mesh_step_keeps_the_radius_and_the_clearance() {
    let files = Files::falling();
    let options = ["--radius", "0.125", "--audit"];
    let found = files.json("start.obj", "end.obj", &options);
    assert_eq!(found["toi"]["below"], 0.71875);
    assert_eq!(found["audit"]["disagreements"], 0);
    let with = |more: [&str; 2]| {
        let found = files.json("start.obj", "end.obj", &[&options, &more[..]].concat());
        assert_eq!(found["audit"]["stored_contacts"], 0, "{found}");
        found["step"].as_f64().unwrap()
    };
    assert!((with(["--clearance", "0.1"]) - 0.69375).abs() < 1e-6);
    assert!((with(["--share", "0.5"]) - 0.359375).abs() < 1e-6);
    // They start nearer than that, and part.
    let parting = ["--radius", "0.125", "--clearance", "9", "--audit"];
    let found = files.json("above.obj", "start.obj", &parting);
    assert_eq!((&found["step"], &found["toi"]), (&1.0.into(), &Value::Null));
    let near = &found["near"][0];
    assert!(near["kept"].as_f64().unwrap() > 0.125 && near["pair"]["kind"].is_string());
    assert_eq!(found["audit"]["stored_contacts"], 0);
}

#[test]
fn mesh_step_reads_every_format() {
    let triangles = |height: f32| {
        let corner = |x: f32, y: f32, z: f32| format!("vertex {x} {y} {z}\n");
        let facet = |corners: String| {
            format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n")
        };
        let low = corner(0.0, 0.0, 0.0) + &corner(1.0, 0.0, 0.0) + &corner(0.0, 1.0, 0.0);
        let high = corner(0.1, 0.1, height) + &corner(5.0, 0.1, 4.0) + &corner(0.1, 5.0, 4.0);
        format!("solid two\n{}{}endsolid two\n", facet(low), facet(high))
    };
    let ply = |height: f32| {
        let header = "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\n\
            property double z\nelement face 1\nproperty list uchar int vertex_indices\n\
            element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
        let points = obj(&height.to_string());
        let points = points.lines().filter_map(|line| line.strip_prefix("v "));
        let points: String = points.map(|point| format!("{point}\n")).collect();
        format!("{header}{points}3 0 1 2\n4 5\n")
    };
    let files = Files::new(&[
        ("start.stl", triangles(3.0).as_bytes()),
        ("end.stl", triangles(-1.0).as_bytes()),
        ("start.ply", ply(3.0).as_bytes()),
        ("end.ply", ply(-1.0).as_bytes()),
        ("end.obj", obj("-1").as_bytes()),
    ]);
    for (start, end) in [
        ("start.stl", "end.stl"),
        ("start.ply", "end.ply"),
        ("start.ply", "end.obj"),
    ] {
        let output = files.run(start, end, &["--audit"]);
        assert_eq!(code(&output), 1, "{}{}", stdout(&output), stderr(&output));
        assert!(stdout(&output).contains("at 0.75"), "{}", stdout(&output));
        assert!(
            stdout(&output).contains("; disagreements: 0"),
            "{}",
            stdout(&output)
        );
    }
}

#[test]
fn mesh_step_refuses_bad_input() {
    let files = Files::new(&[
        ("start.obj", obj("3").as_bytes()),
        ("bad.obj", b"v 0 0\n"),
        ("other.obj", b"v 0 0 0\n"),
        ("a.txt", b""),
    ]);
    let path = |name: &str| files.path(name);
    let refused = |start: &str, end: &str, at: &str, line: Option<u32>, what: &str| {
        let output = files.run(start, end, &[]);
        assert_refused(&output, &path(at), line, what);
        assert_eq!(stdout(&output), "");
    };
    refused("bad.obj", "start.obj", "bad.obj", Some(1), "2 coordinates");
    refused("start.obj", "bad.obj", "bad.obj", Some(1), "2 coordinates");
    refused(
        "start.obj",
        "other.obj",
        "other.obj",
        None,
        "has 1 vertex, not 6",
    );
    refused(
        "a.txt",
        "start.obj",
        "a.txt",
        None,
        "neither a .ply nor an .obj nor a .stl",
    );
    refused("no.ply", "start.obj", "no.ply", None, "no such file");
    for options in [
        &["--radius", "-1"][..],
        &["--radius", "nan"],
        &["--clearance", "1", "--share", "0.5"],
    ] {
        assert_eq!(code(&files.run("start.obj", "start.obj", options)), 2);
    }
}

#[test]
fn mesh_step_refuses_one_file_for_two_results() {
    let files = Files::falling();
    let out = files.path("safe.obj");
    let output = files.run("start.obj", "end.obj", &["--json", &out, "--out", &out]);
    assert_refused(&output, &out, None, "--json and --out name the same file");
    assert!(!Path::new(&out).exists());
}

#[cfg(unix)]
#[test]
fn mesh_step_writes_what_a_link_stands_for() {
    let files = Files::falling();
    let (link, target) = (files.path("link.obj"), files.path("target.obj"));
    fs::write(&target, "").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let output = files.run("start.obj", "above.obj", &["--out", &link]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(Path::new(&link).is_symlink());
    assert!(
        fs::read_to_string(&target)
            .unwrap()
            .starts_with("v 0.0 0.0 0.0")
    );
}

#[test]
fn mesh_step_refuses_numbers_below_0_by_name() {
    let files = Files::falling();
    for option in ["--radius", "--clearance", "--share"] {
        let output = files.run("start.obj", "end.obj", &[option, "-1"]);
        assert_eq!(code(&output), 2);
        assert!(
            stderr(&output).contains("invalid value '-1' for"),
            "{}",
            stderr(&output)
        );
    }
    let output = files.run("start.obj", "end.obj", &["--out", "/nowhere/safe.ply"]);
    assert_refused(&output, "/nowhere/safe.ply", None, "cannot be written");
    assert!(!stderr(&output).contains(".tmp"));
}
