//! What `certify` and `merge` write: JSON with its schema, JUnit, shards put together.

use std::fs;
use std::io::Write;
use std::process::Output;

use serde_json::Value;
use tempfile::TempDir;

use crate::run::{stderr, stdout, tunnelproof};

/// Small, with wires of two queries each, faults of each kind, and a number of queries that shards
/// do not divide.
const FAMILIES: [&str; 6] = [
    "--family",
    "lattice,joint,slow",
    "--count",
    "211",
    "--seed",
    "5",
];

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Folder(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).unwrap()
    }

    /// Runs with the names of files in this folder after each option that writes one.
    fn run(&self, arguments: &[&str]) -> Output {
        let path = |argument: &&str| match argument.strip_prefix('@') {
            Some(name) => self.path(name),
            None => (*argument).to_owned(),
        };
        let arguments: Vec<_> = arguments.iter().map(path).collect();
        let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
        tunnelproof(&arguments)
    }

    fn certify(&self, arguments: &[&str]) -> Output {
        let output = self.run(&[&["certify"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        output
    }

    /// Judges the families in so many shards, in `0.json` and so on.
    fn shards(&self, of: usize) -> Vec<String> {
        let names = (0..of).map(|index| format!("@{index}.json"));
        let names: Vec<_> = names.collect();
        for (index, name) in names.iter().enumerate() {
            let shard = format!("{}/{of}", index + 1);
            self.certify(&[&FAMILIES[..], &["--shard", &shard, "--json", name]].concat());
        }
        names
    }
}

fn assert_is_valid(result: &Value) {
    let schema =
        serde_json::from_str(include_str!("../../../reference/schema/certificate.json")).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let errors: Vec<_> = schema.iter_errors(result).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{errors:?}");
}

#[test]
fn merge_of_shards_is_the_whole_to_the_last_byte() {
    let folder = Folder::new();
    let whole = folder.certify(
        &[
            &FAMILIES[..],
            &["--json", "@whole.json", "--html", "@whole.html"],
        ]
        .concat(),
    );
    let mut names = folder.shards(3);
    names.reverse();
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    let merged = folder.run(
        &[
            &["merge"],
            &names[..],
            &["--json", "@merged.json", "--html", "@merged.html"],
        ]
        .concat(),
    );
    assert_eq!(merged.status.code(), Some(0), "{}", stderr(&merged));
    assert_eq!(stdout(&merged), stdout(&whole));
    for kind in ["json", "html"] {
        let [merged, whole] =
            ["merged", "whole"].map(|name| folder.read(&format!("{name}.{kind}")));
        assert!(merged == whole, "{kind} differs");
    }
    // The shards have different queries, all of them together.
    let queries = |name: &str| folder.json(name)["total"]["queries"].as_u64().unwrap();
    assert_eq!(
        ["0.json", "1.json", "2.json"]
            .map(queries)
            .iter()
            .sum::<u64>(),
        633
    );
    assert_eq!(queries("whole.json"), 633);
    assert!(queries("0.json") < 300);
    assert_is_valid(&folder.json("whole.json"));
    assert_is_valid(&folder.json("0.json"));
}

#[test]
fn merge_of_what_is_not_one_certification_is_refused() {
    let folder = Folder::new();
    folder.shards(2);
    folder.certify(&["--family", "slow", "--count", "5", "--json", "@other.json"]);
    fs::write(folder.path("broken.json"), "{}").unwrap();
    let doctored = folder.read("1.json").replace("\"differs\"", "\"odd\"");
    fs::write(folder.path("doctored.json"), doctored).unwrap();
    for (names, at, what) in [
        (&["@0.json"][..], "0.json", "shard 2/2 is missing"),
        (
            &["@0.json", "@0.json"],
            "0.json",
            "shard 1/2 is there twice",
        ),
        (
            &["@1.json", "@other.json"],
            "other.json",
            "is of another number of shards than the first",
        ),
        (
            &["@0.json", "@broken.json"],
            "broken.json",
            "not a result of this version of certify",
        ),
        (
            &["@0.json", "@doctored.json"],
            "doctored.json",
            "fault is \"odd\"",
        ),
        (&["@none.json"], "none.json", "no such file"),
    ] {
        let output = folder.run(&[&["merge"], names].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.starts_with(&folder.path(at)), "{message}");
        assert!(message.contains(what), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

#[test]
fn certify_resumes_from_a_result_of_the_same_command() {
    let folder = Folder::new();
    let arguments = [&FAMILIES[..], &["--json", "@result.json", "--resume"]].concat();
    let first = folder.certify(&arguments);
    let second = folder.certify(&arguments);
    assert_eq!(stdout(&first), stdout(&second));
    // What is there is taken, whatever it says.
    let doctored = folder
        .read("result.json")
        .replace("\"joints\": 105", "\"joints\": 999");
    fs::write(folder.path("result.json"), doctored).unwrap();
    assert!(stdout(&folder.certify(&arguments)).contains("999 joints"));
    let other = folder.run(&[
        "certify",
        "--family",
        "slow",
        "--json",
        "@result.json",
        "--resume",
    ]);
    assert_eq!(other.status.code(), Some(2));
    assert!(
        stderr(&other).contains("is of another command"),
        "{}",
        stderr(&other)
    );
}

/// The result of the first so many sources.
fn first_sources(result: &Value, count: usize) -> Value {
    let mut part = result.clone();
    part["sources"].as_array_mut().unwrap().truncate(count);
    part
}

/// A checkout and an installed program are the same certification.
#[test]
fn certify_resumes_wherever_its_program_was_started_from() {
    let folder = Folder::new();
    let arguments = [&FAMILIES[..], &["--json", "@result.json", "--resume"]].concat();
    let whole = folder.certify(&arguments);
    let result = folder.read("result.json");
    let [checkout, installed] = ["cargo run --release --", "tunnelproof"];
    let other = match result.contains(checkout) {
        true => result.replace(checkout, installed),
        false => result.replace("\"tunnelproof", &format!("\"{checkout}")),
    };
    assert_ne!(other, result);
    let doctored = other.replace("\"joints\": 105", "\"joints\": 999");
    fs::write(folder.path("result.json"), doctored).unwrap();
    let resumed = folder.certify(&arguments);
    assert!(
        stdout(&resumed).contains("999 joints"),
        "{}",
        stdout(&resumed)
    );
    assert_eq!(stdout(&resumed).replace("999", "105"), stdout(&whole));
}

/// Bodies that turn have every form of the certificate.
#[test]
fn certificates_are_of_bodies_that_turn_too() {
    let folder = Folder::new();
    let blind = r#"cmd:sh -c 'while read -r line; do echo "{\"hit\": false}"; done'"#;
    let arguments = |more: &[&'static str]| {
        let own = [
            "--family",
            "turning_lattice,lattice",
            "--count",
            "40",
            "--subject",
            blind,
        ];
        [&own[..], more].concat()
    };
    let files = [
        "--json",
        "@whole.json",
        "--html",
        "@whole.html",
        "--junit",
        "@whole.xml",
    ];
    let whole = folder.certify(&arguments(&files));
    assert!(
        stdout(&whole).contains("80 queries of 2 sources: "),
        "{}",
        stdout(&whole)
    );
    assert!(
        folder
            .read("whole.html")
            .contains("What moves in turning_lattice:1:")
    );
    let junit = folder.read("whole.xml");
    assert!(
        junit.contains("name=\"turning_lattice\"") && junit.contains("explain turning_lattice:1:")
    );
    let result = folder.json("whole.json");
    assert_is_valid(&result);
    let worst = &result["sources"][0]["subjects"][0]["faults"]["tunnel"]["worst"];
    assert!(worst["query"]["poses"].is_array(), "{worst}");
    folder.certify(&arguments(&["--shard", "1/2", "--json", "@1.json"]));
    folder.certify(&arguments(&["--shard", "2/2", "--json", "@2.json"]));
    let names = ["merge", "@1.json", "@2.json", "--json", "@merged.json"];
    assert!(folder.run(&names).status.success());
    let sources = |name: &str| folder.json(name)["sources"].clone();
    assert_eq!(sources("merged.json"), sources("whole.json"));
}

#[test]
fn certify_goes_on_where_it_was_interrupted() {
    let folder = Folder::new();
    let result = |name: &str| {
        [&FAMILIES[..], &["--json", &format!("@{name}"), "--resume"]]
            .concat()
            .join("\n")
    };
    let certify = |name: &str| {
        let arguments = result(name);
        folder.certify(&arguments.split('\n').collect::<Vec<_>>())
    };
    let whole = certify("whole.json");
    assert!(!fs::exists(folder.path("whole.json.part")).unwrap());
    let part = first_sources(&folder.json("whole.json"), 2);
    fs::write(folder.path("other.json.part"), part.to_string()).unwrap();
    assert_eq!(stdout(&certify("other.json")), stdout(&whole));
    assert_eq!(folder.read("other.json"), folder.read("whole.json"));
    assert!(!fs::exists(folder.path("other.json.part")).unwrap());
    // What is kept is taken, whatever it says.
    let doctored = part.to_string().replace("\"joints\":105", "\"joints\":999");
    fs::write(folder.path("third.json.part"), doctored).unwrap();
    assert!(stdout(&certify("third.json")).contains("999 joints"));
    // Unless it is of something else.
    let swapped = part
        .to_string()
        .replace("\"name\":\"joint\"", "\"name\":\"grazing\"");
    fs::write(folder.path("fourth.json.part"), swapped).unwrap();
    let arguments = result("fourth.json");
    let arguments: Vec<_> = ["certify"]
        .into_iter()
        .chain(arguments.split('\n'))
        .collect();
    let refused = folder.run(&arguments);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("fourth.json.part: is of another list of sources"));
}

#[test]
fn badge_says_whether_the_one_subject_passes() {
    let folder = Folder::new();
    for (subject, said) in [("certified", "passes 422 queries"), ("additive", "fails: ")] {
        let few = [
            "--family",
            "slow,lattice",
            "--count",
            "211",
            "--badge",
            "@badge.svg",
        ];
        folder.certify(&[&few[..], &["--subject", subject]].concat());
        let text = folder.read("badge.svg");
        let badge = roxmltree::Document::parse(&text).unwrap();
        let texts = badge.descendants().filter(|node| node.has_tag_name("text"));
        let texts: Vec<_> = texts.filter_map(|node| node.text()).collect();
        assert!(
            texts[0].starts_with("tunnelproof ") && texts[1].starts_with(said),
            "{texts:?}"
        );
    }
    let two = folder.run(&[
        "certify",
        "--subject",
        "oracle,certified",
        "--badge",
        "@two.svg",
    ]);
    assert_eq!(two.status.code(), Some(2));
    assert_eq!(
        stderr(&two),
        "--badge: is about one subject, and 2 are judged\n"
    );
}

#[test]
fn junit_has_a_case_for_each_subject_and_source() {
    let folder = Folder::new();
    folder.certify(&[
        "--subject",
        "oracle,additive,shadow",
        "--family",
        "slow,face_uniform",
        "--count",
        "100",
        "--junit",
        "@junit.xml",
        "--json",
        "@result.json",
    ]);
    let text = folder.read("junit.xml");
    let document = roxmltree::Document::parse(&text).unwrap();
    let suites = document
        .descendants()
        .filter(|node| node.has_tag_name("testsuite"));
    let mut seen = Vec::new();
    for suite in suites {
        let cases = suite
            .children()
            .filter(|node| node.has_tag_name("testcase"));
        for case in cases {
            let outcome = case.children().find(|node| node.is_element());
            let outcome = outcome.map_or("passed", |node| node.tag_name().name());
            seen.push((
                suite.attribute("name").unwrap(),
                case.attribute("name").unwrap(),
                outcome,
            ));
        }
        let count = |name: &str| suite.attribute(name).unwrap().parse::<usize>().unwrap();
        let own = seen
            .iter()
            .filter(|(name, ..)| Some(*name) == suite.attribute("name"));
        let own: Vec<_> = own.collect();
        let of = |outcome: &str| own.iter().filter(|(.., other)| *other == outcome).count();
        assert_eq!(
            [count("tests"), count("failures"), count("skipped")],
            [2, of("failure"), of("skipped")]
        );
    }
    assert_eq!(
        seen,
        [
            ("oracle", "slow", "passed"),
            ("oracle", "face_uniform", "passed"),
            ("additive", "slow", "failure"),
            ("additive", "face_uniform", "skipped"),
            ("shadow", "slow", "passed"),
            ("shadow", "face_uniform", "skipped"),
            ("judges", "slow", "passed"),
            ("judges", "face_uniform", "passed"),
        ]
    );
    let failures = folder.json("result.json")["failures"].to_string();
    let failure = document
        .descendants()
        .find(|node| node.has_tag_name("failure"))
        .unwrap();
    assert!(
        failures.contains(failure.attribute("message").unwrap()),
        "{failures}"
    );
    assert!(failure.text().unwrap().contains("explain slow:1:"));
}

#[test]
fn packed_files_are_read_as_what_is_packed() {
    let folder = Folder::new();
    let evaluated = |name: &str| stdout(&folder.run(&["eval", name]));
    let line = r#"{"id":"a","kind":"edge-edge","points":[[0,0,0],[1,0,0],[0.5,-1,1],[0.5,1,1],[0,0,0],[1,0,0],[0.5,-1,-2],[0.5,1,-2]]}"#;
    let text = format!("{line}\n").repeat(300);
    fs::write(folder.path("a.jsonl"), &text).unwrap();
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gzip.write_all(text.as_bytes()).unwrap();
    fs::write(folder.path("a.jsonl.gz"), gzip.finish().unwrap()).unwrap();
    let level = ruzstd::encoding::CompressionLevel::Fastest;
    let zstd = ruzstd::encoding::compress_to_vec(text.as_bytes(), level);
    fs::write(folder.path("a.jsonl.zst"), &zstd).unwrap();
    let plain = evaluated("@a.jsonl");
    assert_eq!(plain.lines().count(), 300);
    assert_eq!(evaluated("@a.jsonl.gz"), plain);
    assert_eq!(evaluated("@a.jsonl.zst"), plain);
    fs::write(folder.path("cut.jsonl.zst"), &zstd[..zstd.len() - 3]).unwrap();
    let cut = folder.run(&["eval", "@cut.jsonl.zst"]);
    assert_eq!(cut.status.code(), Some(2), "{}", stderr(&cut));
    assert_eq!(stderr(&cut).lines().count(), 1);
    let explained = folder.run(&["explain", &format!("{}#a", folder.path("a.jsonl.gz"))]);
    assert_eq!(explained.status.code(), Some(0), "{}", stderr(&explained));
}
