//! What files say, and that malformed ones are refused.

use std::fs;

use tempfile::TempDir;

use super::*;

mod audit;

/// A triangle, and a vertex that falls through it to a height.
fn falling(height: f64) -> String {
    format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.25 0.25 {height}\nf 1 2 3\n")
}

/// Files in a folder of their own, and a motion between two of them.
fn motion(files: [(&str, &[u8]); 2]) -> Result<Motion, String> {
    motion_in(files, Precision::F64)
}

fn motion_in(files: [(&str, &[u8]); 2], precision: Precision) -> Result<Motion, String> {
    let folder = TempDir::new().unwrap();
    let [start, end] = files.map(|(name, content)| {
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        path.to_str().unwrap().to_owned()
    });
    Motion::read(&start, &end, precision).map_err(|error| {
        error
            .to_string()
            .replace(folder.path().to_str().unwrap(), "")
    })
}

fn alone(name: &str, content: &[u8]) -> Result<Motion, String> {
    let (_, extension) = name.split_once('.').unwrap();
    motion([(name, content), (&format!("end.{extension}"), content)])
}

#[test]
fn obj_numbers_are_the_nearest_and_polygons_are_fans() {
    let text = "# a square and a wire\nmtllib a.mtl\nv 0.1 -0 1e-320 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\n\
                vt 0 0\ng a b\nf 1/1 2/1 3//7 -1\nv 5 5 5\nl 5 1 -4\np 5\n";
    let motion = alone("a.obj", text.as_bytes()).unwrap();
    let Parts {
        vertices,
        edges,
        faces,
    } = &motion.start;
    assert_eq!(
        vertices[0].map(f64::to_bits),
        [0.1, -0.0, 1e-320].map(f64::to_bits)
    );
    assert_eq!(vertices.len(), 5);
    assert_eq!(faces, &[[0, 1, 2], [0, 2, 3]]);
    assert_eq!(edges, &[[4, 0], [0, 1]]);
}

#[test]
fn obj_that_is_malformed_is_refused_with_its_line() {
    for (line, what) in [
        ("v 1 2", "a vertex of 2 coordinates, not 3"),
        ("v 1 2 x", "\"x\" is not a number"),
        ("v 1", "a vertex of 1 coordinate, not 3"),
        ("v 1 2 3 red", "\"red\" is not a number"),
        ("v 0 nan 0", "\"nan\" is not a finite number"),
        ("v 1e999 0 0", "\"1e999\" is not a finite number"),
        ("f 1 2", "a face has 3 vertices or more, not 2"),
        ("l 1", "a line has 2 vertices or more, not 1"),
        ("f 1 2 0", "there is no vertex 0; there are 2 vertices"),
        ("f 1 2 -9", "there is no vertex -9; there are 2 vertices"),
        ("f 1 2 99999999999", "there is no vertex 99999999999"),
        ("f 1 3 2", "there is no vertex 3; there are 2 vertices"),
        ("f 1 2 \\\n 3", "there is no vertex 3; there are 2 vertices"),
        ("v 1 2 \rl 1 2", "a vertex of 2 coordinates, not 3"),
        ("f 1 2 /1", "\"/1\" is no vertex"),
        ("curv 0 1 1 2", "\"curv\" is no statement"),
    ] {
        let text = format!("v 0 0 0\nv 1 0 0\n{line}\n");
        let error = alone("a.obj", text.as_bytes()).unwrap_err();
        assert!(error.starts_with("/a.obj:3: "), "{error}");
        assert!(error.contains(what), "{error} does not say {what}");
    }
    let error = alone("a.obj", b"").unwrap_err();
    assert!(error.starts_with("/a.obj: holds no vertex"), "{error}");
}

#[test]
fn obj_lines_end_as_on_any_system_and_go_on_after_a_backslash() {
    // A vertex may come after the face that names it.
    let text = "v 0 0 0\nv 1 \\\n0 0 # the second\nf 1 2 \\\n  3\nv 0 1 0\n";
    let expected = alone("a.obj", text.as_bytes()).unwrap().start;
    assert_eq!((expected.vertices.len(), expected.faces.len()), (3, 1));
    let marked = format!("\u{feff}{text}");
    for text in [marked, text.replace('\n', "\r\n"), text.replace('\n', "\r")] {
        assert_eq!(alone("a.obj", text.as_bytes()).unwrap().start, expected);
    }
}

/// A square as a polygon, an edge beside it, and a property that is passed over.
fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nelement vertex 5\nproperty double x\nproperty double y\n\
         property float z\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_index\n\
         element other 1\nproperty list uchar float weights\nelement edge 1\nproperty int vertex1\n\
         property uint vertex2\nend_header\n"
    )
}

const CORNERS: [(f64, f64, f32); 5] = [
    (0.1, 0.0, 0.5),
    (1.0, 0.0, 0.0),
    (1.0, 1.0, 0.0),
    (0.0, 1.0, 0.0),
    (2.0, 2.0, 2.0),
];

fn ply_text() -> String {
    let vertices = CORNERS.map(|(x, y, z)| format!("{x} {y} {z} 255\n"));
    ply_header("ascii") + &vertices.concat() + "4 0 1 2 3\n2 0.5 1\n4 0\n"
}

fn ply_binary(format: &str, is_big: bool) -> Vec<u8> {
    // Bytes of a little-endian number, in the order of the file.
    let ordered = |mut bytes: Vec<u8>| {
        if is_big {
            bytes.reverse();
        }
        bytes
    };
    let mut bytes = ply_header(format).into_bytes();
    for (x, y, z) in CORNERS {
        bytes.extend(ordered(x.to_le_bytes().to_vec()));
        bytes.extend(ordered(y.to_le_bytes().to_vec()));
        bytes.extend(ordered(z.to_le_bytes().to_vec()));
        bytes.push(255);
    }
    let whole = |value: u32| ordered(value.to_le_bytes().to_vec());
    bytes.push(4);
    bytes.extend((0..4).flat_map(whole));
    bytes.extend([&[1][..], &ordered(1f32.to_le_bytes().to_vec())].concat());
    bytes.extend([4, 0].into_iter().flat_map(whole));
    bytes
}

#[test]
fn ply_of_all_encodings_says_the_same() {
    let text = alone("a.ply", ply_text().as_bytes()).unwrap().start;
    assert_eq!(text.vertices[0], [0.1, 0.0, 0.5]);
    assert_eq!(text.faces, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(text.edges, [[4, 0]]);
    for (format, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let binary = alone("a.ply", &ply_binary(format, is_big)).unwrap().start;
        assert_eq!(binary, text, "{format}");
    }
}

#[test]
fn ply_that_is_malformed_is_refused() {
    let text = ply_text();
    for (content, what) in [
        (
            text.replace("4 0 1 2 3\n", "2 0 1\n"),
            "face 0 has 2 vertices",
        ),
        (
            text.replace("4 0 1 2 3\n", "4 0 1 2 -1\n"),
            "face 0 has no list vertex_indices",
        ),
        (
            text.replace("4 0 1 2 3\n", "4 0 1 2 9\n"),
            "there are 5 vertices",
        ),
        (
            text.replace("4 0 1 2 3\n", "4 0 1 2\n"),
            ":22: is no PLY: Couldn't read element line: Expected 4 list elements, but found only 3",
        ),
        (
            text.replace("property double x\n", "property double w\n"),
            "no numbers x, y and z",
        ),
        (
            text.replace("int vertex1", "float vertex1"),
            "vertex1 and vertex2",
        ),
        (
            text.replace("0.1 0 0.5 255", "x 0 0.5 255"),
            ":17: is no PLY",
        ),
        (
            text.replace("element vertex 5", "element vertex 99999999"),
            "is too short for 99999999",
        ),
        (text.replace("end_header\n", ""), "is no PLY"),
        (text.clone() + "1 2 3\n", "6 bytes after the last element"),
        (
            "plx\n".to_owned(),
            "a.ply:1: is no PLY: the first line is not \"ply\"",
        ),
        (String::new(), "is no PLY: Unexpected end of file"),
    ] {
        let error = alone("a.ply", content.as_bytes()).unwrap_err();
        assert!(error.contains(what), "{error} does not say {what}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    let nothing =
        "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nend_header\n";
    assert!(
        alone("a.ply", nothing.as_bytes())
            .unwrap_err()
            .contains("too short")
    );
}

#[test]
fn files_cut_short_or_changed_anywhere_never_panic() {
    let stl = stl_binary(&[SHEET[0], SHEET[1]]);
    let binary = ply_binary("binary_big_endian", true);
    let files: [(&str, Vec<u8>); 5] = [
        ("a.ply", ply_text().into_bytes()),
        ("b.ply", binary),
        ("a.obj", falling(1.0).into_bytes()),
        ("a.stl", stl),
        ("b.stl", stl_text(&SHEET).into_bytes()),
    ];
    for (name, content) in files {
        assert!(alone(name, &content).is_ok());
        for at in 0..content.len() {
            let _ = alone(name, &content[..at]);
            for byte in [0, b'\n', b'9', 0xff] {
                let mut changed = content.clone();
                changed[at] = byte;
                let _ = alone(name, &changed);
            }
        }
    }
}

/// Two triangles with a common edge.
const SHEET: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, -0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]],
];

fn stl_binary(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    // Many programs write this word into binary files, too.
    let mut bytes = b"solid ".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text(triangles: &[[[f32; 3]; 3]]) -> String {
    let facets = triangles.iter().map(|triangle| {
        let corners = triangle.map(|[x, y, z]| format!("  vertex {x} {y} {z}\n"));
        let corners = corners.concat();
        format!("facet normal 0 0 0\n outer loop\n{corners} endloop\nendfacet\n")
    });
    format!("solid\n{}endsolid\n", facets.collect::<String>())
}

#[test]
fn stl_corners_at_the_same_place_are_one_vertex() {
    let text = alone("a.stl", stl_text(&SHEET).as_bytes()).unwrap();
    assert_eq!(text.start.faces, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(text.start.vertices.len(), 4);
    assert_eq!(text.start.vertices[3], [1.0, 1.0, f64::from(0.1f32)]);
    let binary = alone("a.stl", &stl_binary(&SHEET)).unwrap();
    assert_eq!((binary.start, binary.end), (text.start, text.end));
}

#[test]
fn stl_that_parts_or_is_malformed_is_refused() {
    let mut parted = SHEET;
    parted[1][2][2] = 0.5;
    let [start, end] = [SHEET, parted].map(|sheet| stl_binary(&sheet));
    let error = motion([("a.stl", &start), ("b.stl", &end)]).unwrap_err();
    assert!(
        error.starts_with("/b.stl: corner 2 of triangle 1 parts"),
        "{error}"
    );
    let error = motion([("a.stl", &start), ("b.stl", &stl_binary(&SHEET[..1]))]).unwrap_err();
    assert!(error.contains("has 1 triangle, not 2"), "{error}");
    let error = motion([("a.stl", &start), ("b.obj", b"v 0 0 0")]).unwrap_err();
    assert!(error.contains("b.obj: is of another format"), "{error}");
    let twice = stl_text(&SHEET).repeat(2);
    let error = alone("a.stl", twice.as_bytes()).unwrap_err();
    assert!(error.contains("several solids"), "{error}");
    let error = alone("a.stl", &start[..start.len() - 1]).unwrap_err();
    assert!(error.contains("is no STL"), "{error}");
    let nan = [[[f32::NAN; 3]; 3]];
    let error = alone("a.stl", &stl_binary(&nan)).unwrap_err();
    assert!(error.contains("x of vertex 0 is NaN"), "{error}");
}

#[test]
fn meshes_that_differ_are_refused_by_what_differs() {
    let start = falling(1.0) + "l 1 4\n";
    for (end, what) in [
        (start.clone() + "v 9 9 9\n", "has 5 vertices, not 4"),
        (start.clone() + "l 1 2\n", "has 2 edges, not 1"),
        (start.clone() + "f 1 2 4\n", "has 2 triangles, not 1"),
        (
            start.replace("f 1 2 3", "f 1 3 2"),
            "triangle 0 has the vertices [0, 2, 1], not [0, 1, 2]",
        ),
        (
            start.replace("l 1 4", "l 2 4"),
            "edge 0 has the vertices [1, 3], not [0, 3]",
        ),
    ] {
        let error = motion([("a.obj", start.as_bytes()), ("b.obj", end.as_bytes())]).unwrap_err();
        assert!(
            error.starts_with("/b.obj: ") && error.contains(what),
            "{error}"
        );
        assert!(
            error.ends_with("it has to be the mesh of /a.obj"),
            "{error}"
        );
    }
}

#[test]
fn positions_in_f32_are_the_nearest_and_are_written_in_as_many_bits() {
    let text = falling(0.1);
    let files = [("a.obj", text.as_bytes()), ("b.obj", text.as_bytes())];
    let motion = motion_in(files, Precision::F32).unwrap();
    let tenth = f64::from(0.1f32);
    assert_eq!(
        (motion.start.vertices[3][2], motion.end[3][2]),
        (tenth, tenth)
    );
    let hard = [0.1f32, f32::MAX, f32::from_bits(1), 16_777_217.0 / 3.0].map(f64::from);
    let hard = hard.map(|x| [x, -x, -0.0]);
    for (format, name) in [
        (WritableFormat::Ply, "b.ply"),
        (WritableFormat::Obj, "b.obj"),
    ] {
        let written = format.write(&motion, &hard, Precision::F32);
        let read = alone(name, &written).unwrap().start;
        let bits = |x: &Position| x.map(f64::to_bits);
        assert!(
            read.vertices.iter().map(bits).eq(hard.iter().map(bits)),
            "{name}"
        );
        assert_eq!(read.faces, motion.start.faces);
    }
    let written = WritableFormat::Ply.write(&motion, &hard, Precision::F32);
    assert!(String::from_utf8_lossy(&written).contains("property float x\nproperty float y\n"));
    let text = falling(-1e39);
    for (files, name) in [
        ([("a.obj", text.as_bytes()), files[1]], "a"),
        ([files[0], ("b.obj", text.as_bytes())], "b"),
    ] {
        let error = motion_in(files, Precision::F32).unwrap_err();
        let expected = format!("/{name}.obj: z of vertex 3 is -1e39, which is beyond f32");
        assert_eq!(error, expected);
    }
}

#[test]
fn positions_written_are_read_as_the_same_bits() {
    let motion = alone("a.obj", (falling(1.0) + "l 1 4\n").as_bytes()).unwrap();
    let hard = [
        [0.1 + 0.2, -0.0, 5e-324],
        [f64::MAX, f64::MIN_POSITIVE, 1.0 / 3.0],
        [-1e-310, 1e23, 123_456_789.123_456_79],
        [1e300, 1.5, -2.5e-7],
    ];
    for (format, name) in [
        (WritableFormat::Ply, "b.ply"),
        (WritableFormat::Obj, "b.obj"),
    ] {
        let written = format.write(&motion, &hard, Precision::F64);
        let read = alone(name, &written).unwrap().start;
        let bits = |positions: &[Position]| -> Vec<u64> {
            positions.iter().flatten().map(|x| x.to_bits()).collect()
        };
        assert_eq!(bits(&read.vertices), bits(&hard), "{name}");
        assert_eq!(
            (read.edges, read.faces),
            (motion.start.edges.clone(), motion.start.faces.clone())
        );
    }
}
