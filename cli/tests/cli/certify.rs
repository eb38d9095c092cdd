//! `certify`: its table, what `--strict` fails, `--json`.

use std::fs;
use std::process::Command;

use serde_json::Value;

use crate::run::{CROSSING, PROGRAM, code, file, stderr, stdout, tunnelproof, with_input};

#[test]
fn certify_table_is_the_same_on_any_number_of_threads() {
    let table = |threads| {
        let output = tunnelproof(&[
            "certify",
            "--count",
            "250",
            "--seed",
            "9",
            "--threads",
            threads,
        ]);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
        stdout(&output)
    };
    let one = table("1");
    assert_eq!(one, table("2"));
    assert_eq!(one, table("2"));
    assert!(
        one.contains("oracle and shadow agree on all 4,012 queries"),
        "{one}"
    );
    // But for the names of the witnesses.
    let mut lines = one
        .lines()
        .filter_map(|line| line.split(" explain ").next());
    assert!(lines.all(|line| line.chars().count() <= 100), "{one}");
}

#[test]
fn certify_strict_passes_the_exact_subjects_and_fails_the_published_text() {
    let certify = |subjects| {
        tunnelproof(&[
            "certify",
            "--strict",
            "--count",
            "2000",
            "--subject",
            subjects,
        ])
    };
    assert_eq!(code(&certify("oracle,shadow")), 0);
    let output = certify("oracle,shadow-published");
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).starts_with("--strict: shadow-published: "));
    assert!(!stdout(&output).contains("unexplained"));
}

#[test]
fn certify_strict_fails_on_a_wrong_label() {
    let label = |label: &str| CROSSING.replace("\"id\"", &format!("\"label\":{label},\"id\""));
    for (text, expected) in [(label("1"), 0), (label("0"), 1)] {
        let (_folder, path) = file("labelled.jsonl", text);
        let output = tunnelproof(&["certify", "--strict", "--subject", "oracle", &path]);
        assert_eq!(code(&output), expected, "{}", stdout(&output));
    }
}

#[cfg(unix)]
#[test]
fn certify_witness_from_the_standard_input_comes_with_its_query() {
    let label = CROSSING.replace("\"id\"", "\"label\":0,\"id\"");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.json");
    let output = with_input(&["certify", "--json", path.to_str().unwrap(), "-"], &label);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let results: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let witness = &results["total"]["wrong_labels"]["worst"];
    let command = witness["command"].as_str().unwrap();
    let command = command.replace("cargo run --release --", PROGRAM);
    let explained = Command::new("sh").args(["-c", &command]).output().unwrap();
    assert!(stdout(&explained).contains("exactly   1/3"), "{command}");
}

#[test]
fn certify_of_nothing_is_refused() {
    let output = tunnelproof(&["certify", "--strict", "--family", "lattice", "--count", "0"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (2, ""));
    assert_eq!(stderr(&output), "--count 0: no query is left to judge\n");
    let output = tunnelproof(&["certify", "--count", "0"]);
    assert!(stdout(&output).contains("agree on all 12 queries"));
}

#[test]
fn certify_json_holds_rows_and_witnesses_that_explain_understands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.json");
    let path = path.to_str().unwrap();
    let output = tunnelproof(&["certify", "--count", "250", "--json", path]);
    assert_eq!(code(&output), 0);
    let results: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(results["sources"].as_array().unwrap().len(), 17);
    assert_eq!(results["total"]["queries"], 4012);
    assert_eq!(
        results["total"]["agreements"]["shadow"]["disagreements"]["count"],
        0
    );
    let published = &results["total"]["subjects"][2];
    assert_eq!(published["subject"], "shadow-published");
    let tunnel = &published["faults"]["tunnel"];
    assert!(tunnel["count"].as_u64().unwrap() > 0);
    let witness = &tunnel["worst"];
    let explained = tunnelproof(&["explain", witness["id"].as_str().unwrap()]);
    assert!(stdout(&explained).contains("tunnel"));
    for query in ["query", "query_hexadecimal"] {
        let explained = with_input(&["explain", "-"], &witness[query].to_string());
        assert!(
            stdout(&explained).contains("tunnel"),
            "{}",
            stderr(&explained)
        );
    }
}

#[test]
fn certify_json_is_refused_before_the_work_if_it_cannot_be_written() {
    let output = tunnelproof(&["certify", "--json", "no/such/folder/out.json"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (2, ""));
    assert!(stderr(&output).starts_with("no/such/folder/out.json: cannot be written: "));
}

#[test]
fn certify_shrinks_its_witnesses_on_demand() {
    let output = tunnelproof(&[
        "certify",
        "--subject",
        "thesis",
        "--family",
        "lattice",
        "--count",
        "300",
        "--shrink",
    ]);
    let text = stdout(&output);
    let (_, shrunk) = text.split_once("\nShrunk:\n").unwrap();
    assert!(shrunk.contains("thesis, tunnel: "), "{shrunk}");
    let command = shrunk.lines().nth(1).unwrap();
    assert!(
        command.contains("echo '{") && command.ends_with("explain -"),
        "{command}"
    );
}

#[test]
fn certify_faces_and_radii_asks_only_those_who_take_them() {
    let families = "face_lattice,thick_lattice,thick_face_lattice";
    let output = tunnelproof(&[
        "certify",
        "--strict",
        "--family",
        families,
        "--count",
        "200",
        "--subject",
        "oracle,shadow,additive",
    ]);
    let text = stdout(&output);
    assert!(
        text.contains("oracle and difference agree on all "),
        "{text}"
    );
    assert!(text.contains("not asked"), "{text}");
    assert!(!text.contains("DISAGREE"), "{text}");
    let explained = tunnelproof(&["explain", "thick_face_lattice:1:3"]);
    assert_eq!(code(&explained), 0, "{}", stderr(&explained));
    assert!(
        stdout(&explained).contains("not asked"),
        "{}",
        stdout(&explained)
    );
}

#[test]
fn certify_refuses_to_read_no_files_in_another_way() {
    for (option, value) in [("--radius", "0.5"), ("--kind", "vertex-face")] {
        let output = tunnelproof(&["certify", option, value, "--family", "lattice"]);
        assert_eq!(output.status.code(), Some(2));
        let error = format!("{option} says how files are read, and no file of queries is named\n");
        assert_eq!(String::from_utf8_lossy(&output.stderr), error);
    }
    for radius in ["nan", "-1", "1e999", "0.1+inf"] {
        let output = tunnelproof(&["certify", &format!("--radius={radius}"), "a.jsonl"]);
        assert_eq!(output.status.code(), Some(2));
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            error.contains("it has to be a finite number, 0 or more"),
            "{error}"
        );
    }
}

#[test]
fn certify_puts_those_that_fail_first_and_folds_what_has_no_fault() {
    let arguments = [
        "certify",
        "--count",
        "300",
        "--family",
        "uniform,lattice",
        "--subject",
    ];
    let summary = tunnelproof(&[&arguments[..], &["certified,thesis"]].concat());
    let text = stdout(&summary);
    let line = |start: &str| text.lines().position(|line| line.starts_with(start));
    assert!(
        line("  thesis").unwrap() < line("  certified").unwrap(),
        "{text}"
    );
    assert!(text.contains("  thesis    FAILS "), "{text}");
    assert!(text.contains("  certified passes"), "{text}");
    for meaning in ["tunnels ", "missed grazes ", "worst late "] {
        assert!(line(&format!("  {meaning}")).is_some(), "{meaning}: {text}");
    }
    assert!(text.contains(" --subject thesis\n"), "{text}");
    assert!(
        !text.contains("\u{1b}"),
        "colours where there is no terminal"
    );
    let details = tunnelproof(&[&arguments[..], &["certified", "--details"]].concat());
    let text = stdout(&details);
    for family in ["uniform: 300 queries", "lattice: 300 queries"] {
        let line = text.lines().find(|line| line.starts_with(family)).unwrap();
        assert!(line.ends_with(": no fault"), "{line}");
    }
    assert!(text.contains("small integers"), "{text}");
}

#[test]
fn certify_reads_folders_and_names_wrong_labels() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        path
    };
    // Two edges that cross, twice, once labelled as a miss.
    let rows = "0,1,0,1,0,1\n1,1,0,1,0,1\n1,2,-1,1,1,1\n1,2,1,1,1,1\n\
                0,1,0,1,0,1\n1,1,0,1,0,1\n1,2,-1,1,-2,1\n1,2,1,1,-2,1\n";
    fs::write(at("scene/queries/7ee.csv"), rows.repeat(2)).unwrap();
    fs::write(at("scene/mma_bool/7ee_mma_bool.json"), "[true, false]").unwrap();
    let path = folder.path().to_str().unwrap();
    let output = tunnelproof(&["certify", "--strict", "--subject", "oracle", path]);
    let text = stdout(&output);
    assert_eq!(code(&output), 1, "{text}");
    assert!(
        text.contains("oracle and labels DISAGREE on 1 of 2 queries"),
        "{text}"
    );
    let name = format!("{path}/scene/queries/7ee.csv#1");
    assert!(text.contains(&format!("  wrong label: {name}\n")), "{text}");
    let explained = tunnelproof(&["explain", &name]);
    assert!(
        stdout(&explained).contains("exactly   1/3"),
        "{}",
        stderr(&explained)
    );
    let answers = tunnelproof(&["eval", path]);
    assert_eq!(stdout(&answers).lines().count(), 2, "{}", stderr(&answers));
}

#[test]
fn families_are_listed_with_spaces_and_an_unknown_one_is_named_alone() {
    let certify = |families| tunnelproof(&["certify", "--count", "10", "--family", families]);
    let apart = certify("uniform, lattice");
    assert_eq!(code(&apart), 0, "{}", stderr(&apart));
    assert_eq!(stdout(&apart), stdout(&certify("uniform,lattice")));
    let unknown = certify("uniform,latice");
    assert_eq!(code(&unknown), 2);
    let said = stderr(&unknown);
    assert!(
        said.contains("invalid value 'latice' for '--family"),
        "{said}"
    );
    assert!(said.contains("a similar value exists: 'lattice'"), "{said}");
    assert!(!said.contains("near_coplanar"), "{said}");
}
