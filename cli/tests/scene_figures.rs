//! The figures of scenes that documents tell: what `simulate --audit` says of them. Each is a row of a
//! table; one that is no longer there is printed with its document.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::process::Command;

use serde_json::Value;

const SCENES: &str = include_str!("../../docs/scene-outcomes.md");
const THICKNESS: &str = include_str!("../../docs/thickness.md");

/// What is said of a run.
struct Run(Value);

impl Run {
    fn of(scene: &str, more: &[&str]) -> Self {
        let path = format!("{}/scenes/{scene}.toml", env!("CARGO_MANIFEST_DIR"));
        let output = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
            .args(["simulate", &path, "--audit", "--json", "-"])
            .args(more)
            .output()
            .unwrap();
        Run(serde_json::from_slice(&output.stdout).unwrap())
    }

    /// With a share of the thickness guarded.
    fn guarded(scene: &str, kappa: &str) -> Self {
        Run::of(scene, &["--guarded-thickness", kappa])
    }

    fn count(&self, part: &str, name: &str) -> u64 {
        self.0[part][name].as_u64().unwrap()
    }

    /// With commas between thousands.
    fn grouped(&self, part: &str, name: &str) -> String {
        tunnelproof_reference::certify::table::grouped(self.count(part, name))
    }

    fn list(&self, name: &str) -> usize {
        self.0["audit"][name].as_array().unwrap().len()
    }

    /// How far wires stand in each other, as a share of their thickness.
    fn penetration(&self, name: &str) -> String {
        match self.0["audit"][name]["high"].as_f64() {
            None => "none".to_owned(),
            Some(share) if share < 1e-3 => format!("{:.3}%", 100.0 * share),
            Some(share) => format!("{:.1}%", 100.0 * share),
        }
    }
}

/// Asserts that a document has these rows.
fn assert_has(document: &str, name: &str, rows: &[String]) {
    let lost: Vec<_> = rows.iter().filter(|row| !document.contains(*row)).collect();
    let lost: Vec<_> = lost.into_iter().map(String::as_str).collect();
    assert!(lost.is_empty(), "not in {name}:\n{}", lost.join("\n"));
}

const BUILT_IN: [&str; 4] = [
    "basic-collision",
    "pulling-anchor",
    "twisting-under-load",
    "chains-on-deck",
];

#[test]
#[cfg_attr(debug_assertions, ignore = "runs scenes for seconds")]
fn figures_of_the_built_in_scenes_are_those_of_a_run() {
    let row = |scene: &&str| {
        let run = Run::of(scene, &[]);
        let missed: u64 = (0..3)
            .map(|k| run.0["audit"]["missed"][k].as_u64().unwrap())
            .sum();
        let untimely = [&run.0["audit"]["late"][0], &run.0["audit"]["early"][0]];
        let untimely: u64 = untimely.iter().map(|count| count.as_u64().unwrap()).sum();
        format!(
            "| {scene} | {} | {} | {} | {} | {} | {missed} | {untimely} | {} |",
            run.grouped("audit", "steps"),
            run.grouped("audit", "pairs"),
            run.count("audit", "prevented"),
            run.count("audit", "remeshes"),
            run.count("summary", "refused"),
            run.list("standing"),
        )
    };
    let rows: Vec<_> = BUILT_IN.iter().map(row).collect();
    assert_has(SCENES, "docs/scene-outcomes.md", &rows);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "runs scenes for seconds")]
fn figures_of_thin_bodies_are_those_of_a_run() {
    let row = |(scene, what): &(&str, &str)| {
        let run = Run::of(scene, &[]);
        assert_eq!(run.count("audit", "body_missed"), 0, "{scene}");
        assert_eq!(run.count("audit", "body_contacts"), 0, "{scene}");
        format!(
            "| `{scene}`: {what} | {} | {} | {} | {} |",
            run.count("summary", "steps"),
            run.count("summary", "prevented_bodies"),
            run.count("summary", "prevented_cores"),
            run.count("summary", "held"),
        )
    };
    let scenes = [
        ("thin-blade", "a blade falls onto a taut wire"),
        ("propeller", "a propeller turns into a bundle of ropes"),
        ("net", "a net catches a ball"),
        ("plate-edge", "wires fall onto the edge of a plate"),
        ("closing-hook", "two jaws close on a rope and lift it"),
        ("two-plates", "two thin plates are thrown at each other"),
    ];
    let rows: Vec<_> = scenes.iter().map(row).collect();
    assert_has(SCENES, "docs/scene-outcomes.md", &rows);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "runs scenes for seconds")]
fn figures_of_guarded_thickness_are_those_of_a_run() {
    let scenes = [
        ("knot-of-chain", "an overhand knot is drawn tight"),
        ("pile-of-chain", "a coil of 60 short segments falls"),
    ];
    let mut rows = Vec::new();
    for (scene, what) in scenes {
        for (kappa, first) in [
            ("0", format!("| `{scene}`: {what} |")),
            ("0.5", "| |".to_owned()),
        ] {
            let run = Run::guarded(scene, kappa);
            rows.push(format!(
                "{first} {kappa} | {} | {} | {} | {} | {} |",
                run.count("summary", "steps"),
                run.count("summary", "prevented"),
                run.count("summary", "held"),
                run.penetration("deepest"),
                run.penetration("standing_penetration"),
            ));
        }
    }
    for scene in BUILT_IN {
        let runs = ["0", "0.5"].map(|kappa| Run::guarded(scene, kappa));
        let both = |value: &dyn Fn(&Run) -> String| runs.each_ref().map(value).join(" / ");
        rows.push(format!(
            "| {scene} | {} | {} | {} | {} |",
            both(&|run| run.count("summary", "prevented").to_string()),
            both(&|run| run.count("summary", "held").to_string()),
            both(&|run| run.penetration("deepest")),
            both(&|run| run.penetration("standing_penetration")),
        ));
        for run in &runs {
            assert_eq!(run.list("findings"), 0, "{scene}");
        }
    }
    assert_has(THICKNESS, "docs/thickness.md", &rows);
}
