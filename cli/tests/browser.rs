//! The pages of `sweep`, `tune`, `certify` and `simulate` in a real browser: they are drawn, on a
//! telephone and on a desk, light and dark, without an error on the console; the last one plays.
//!
//! The browser is Chromium, without a window. Where there is none the test is skipped and says so;
//! with `TUNNELPROOF_BROWSER=required` in the environment it fails.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// What a page says of itself once it is drawn.
const MEASURE: &str = r#"<script>
addEventListener("load", () => {
  const box = e => { const r = e.getBoundingClientRect(); return [r.width, r.height]; };
  const all = (selector) => [...document.querySelectorAll(selector)];
  const paperOf = picture => {
    const pen = document.createElement("canvas").getContext("2d");
    pen.drawImage(picture, 0, 0);
    return `rgb(${[...pen.getImageData(5, 5, 1, 1).data].slice(0, 3).join(", ")})`;
  };
  parent.postMessage(JSON.stringify({
    width: innerWidth,
    overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    paper: getComputedStyle(document.body).backgroundColor,
    ink: getComputedStyle(document.body).color,
    card: all("figure > svg > rect").map(e => getComputedStyle(e).fill)
      .concat(all("figure").map(e => getComputedStyle(e).backgroundColor))[0],
    charts: all("figure > svg").map(e => [e.parentNode.id, ...box(e), e.querySelectorAll("text").length,
      e.querySelectorAll("circle, rect, polyline").length]),
    letters: all("figure > svg text").filter(e => e.textContent.trim())
      .map(e => parseFloat(getComputedStyle(e).fontSize) * e.ownerSVGElement.getScreenCTM().a),
    cut: all("figure > svg text").filter(e => {
      const [text, chart] = [e, e.ownerSVGElement].map(e => e.getBoundingClientRect());
      return text.left < chart.left || text.right > chart.right || text.top < chart.top || text.bottom > chart.bottom;
    }).map(e => e.textContent),
    numbers: all("figure > svg").map(e => [...e.querySelectorAll("text")].filter(e => e.textContent.trim() && !isNaN(e.textContent)).length),
    pictures: all("figure > img").map(e => [e.complete, e.naturalWidth, paperOf(e)]),
  }), "*");
});
</script></body>"#;

/// What the page of a run says of itself after all its controls were used, and it has played for a while.
const PLAY: &str = concat!(
    "<script>",
    include_str!("browser/play.js"),
    "</script></body>"
);

/// The program, if there is one.
fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let is_there = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    let found = names.into_iter().find(|name| is_there(name));
    let is_required = std::env::var("TUNNELPROOF_BROWSER").is_ok_and(|value| value == "required");
    assert!(
        found.is_some() || !is_required,
        "none of {names:?} is installed"
    );
    if found.is_none() {
        eprintln!("skipped: none of {names:?} is installed");
    }
    found
}

/// What a page says of itself in a frame of this width, and what stands on the console.
fn drawn(browser: &str, page: &Path, measure: &str, width: u32, is_dark: bool) -> (Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let html = fs::read_to_string(page).unwrap();
    assert_eq!(html.matches("</body>").count(), 1);
    fs::write(
        folder.path().join("page.html"),
        html.replace("</body>", measure),
    )
    .unwrap();
    let frame = format!(
        r#"<meta name="color-scheme" content="light dark"><iframe src="page.html" width="{width}" height="800" style="border:0"></iframe>
        <pre id="said"></pre><script>onmessage = e => said.textContent = e.data</script>"#
    );
    let path = folder.path().join("frame.html");
    fs::write(&path, frame).unwrap();
    let scheme = if is_dark { 0 } else { 1 };
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--disable-dev-shm-usage",
        ])
        .args([
            "--window-size=1400,1000",
            "--virtual-time-budget=20000",
            "--enable-logging=stderr",
        ])
        .arg(format!("--blink-settings=preferredColorScheme={scheme}"))
        .arg(format!(
            "--user-data-dir={}",
            folder.path().join("profile").display()
        ))
        .arg("--dump-dom")
        .arg(format!("file://{}", path.display()))
        .output()
        .unwrap();
    let dom = String::from_utf8(output.stdout).unwrap();
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let console = log
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .collect::<Vec<_>>()
        .join("\n");
    let said = dom
        .split("<pre id=\"said\">")
        .nth(1)
        .and_then(|rest| rest.split("</pre>").next());
    let said = said.unwrap_or_else(|| panic!("nothing was said: {dom}\n{log}"));
    let said = said.replace("&gt;", ">").replace("&amp;", "&");
    let said = serde_json::from_str(&said).unwrap_or_else(|_| panic!("{said:?}\n{log}"));
    (said, console)
}

/// How bright a colour is, from 0 to 255: `rgb(R, G, B)`.
fn brightness(colour: &Value) -> f64 {
    let text = colour.as_str().unwrap();
    let numbers = text
        .trim_start_matches("rgb(")
        .trim_end_matches(')')
        .split(", ");
    numbers
        .map(|number| number.parse::<f64>().unwrap())
        .sum::<f64>()
        / 3.0
}

fn assert_is_drawn(browser: &str, page: &Path, charts: &[&str], pictures: usize) {
    for (width, is_dark) in [(390, false), (390, true), (1280, false), (1280, true)] {
        let (said, console) = drawn(browser, page, MEASURE, width, is_dark);
        let at = format!("{} at {width}, dark: {is_dark}: {said:#}", page.display());
        assert_eq!(console, "", "{at}");
        assert_eq!(said["width"], width, "{at}");
        assert_eq!(said["overflow"], 0, "{at}");
        assert_eq!(brightness(&said["paper"]) < 128.0, is_dark, "{at}");
        assert_eq!(brightness(&said["card"]) < 128.0, is_dark, "{at}");
        assert_eq!(brightness(&said["ink"]) > 128.0, is_dark, "{at}");
        let found: Vec<_> = said["charts"].as_array().unwrap().iter().collect();
        let names: Vec<_> = found
            .iter()
            .map(|chart| chart[0].as_str().unwrap())
            .collect();
        assert_eq!(names, charts, "{at}");
        for chart in found {
            let number = |index: usize| chart[index].as_f64().unwrap();
            assert!(
                number(1) > 300.0 && number(2) > 200.0,
                "too small: {chart} {at}"
            );
            assert!(number(3) > 6.0 && number(4) > 4.0, "empty: {chart} {at}");
        }
        assert_eq!(said["cut"], Value::Array(Vec::new()), "{at}");
        let numbers = said["numbers"].as_array().unwrap().iter();
        // Two or more on each axis.
        assert!(
            numbers.clone().all(|count| count.as_u64() >= Some(5)),
            "{at}"
        );
        let letters = said["letters"].as_array().unwrap().iter();
        let smallest = letters
            .map(|height| height.as_f64().unwrap())
            .fold(99.0, f64::min);
        assert!(smallest >= 9.0, "letters of {smallest} pixels: {at}");
        let drawn = said["pictures"].as_array().unwrap();
        assert_eq!(drawn.len(), pictures, "{at}");
        for picture in drawn {
            assert_eq!(picture[0], true, "{at}");
            assert!(picture[1].as_f64().unwrap() > 0.0, "{at}");
            assert_eq!(brightness(&picture[2]) < 128.0, is_dark, "{at}");
        }
    }
}

fn run(arguments: &[&str], page: &Path) {
    let output = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .args(arguments)
        .arg("--html")
        .arg(page)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

const SMALL: [&str; 4] = ["--family", "near_coplanar,joint", "--count", "60"];

#[test]
fn browser_draws_the_page_of_a_sweep() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("sweep.html");
    run(&[&["sweep", "--no-cache"], &SMALL[..]].concat(), &page);
    let thresholds = [
        "dist",
        "dist_1d",
        "t",
        "coefficients_quadratic",
        "coefficients_cubic",
    ];
    let charts = thresholds.map(|name| [format!("{name}-answers"), format!("{name}-gaps")]);
    let charts: Vec<_> = charts.as_flattened().iter().map(String::as_str).collect();
    let html = fs::read_to_string(&page).unwrap();
    let pictures = html.matches("<img").count();
    assert!(pictures >= 4, "{pictures} pictures of witnesses");
    assert_is_drawn(
        browser,
        &page,
        &[&charts[..], &["front", "gaps"]].concat(),
        pictures,
    );
}

#[test]
fn browser_draws_heat_maps() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("heat.html");
    let axes = [
        "--threshold",
        "dist",
        "--steps",
        "6",
        "--threshold",
        "t",
        "--steps",
        "5",
    ];
    run(
        &[&["sweep", "--no-cache"], &SMALL[..], &axes[..]].concat(),
        &page,
    );
    let pictures = fs::read_to_string(&page).unwrap().matches("<img").count();
    let charts = ["heat-crossings", "heat-false-hits", "front", "gaps"];
    assert_is_drawn(browser, &page, &charts, pictures);
}

#[test]
fn browser_draws_the_page_of_a_search() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("tune.html");
    run(
        &[
            &["tune", "--no-cache"],
            &SMALL[..],
            &["--unseen-count", "50"],
        ]
        .concat(),
        &page,
    );
    assert_is_drawn(browser, &page, &["front-by-count", "front-by-gap"], 0);
}

#[test]
fn browser_draws_a_certificate() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("certificate.html");
    let program = format!(
        "cmd:{} eval --subject thesis -",
        env!("CARGO_BIN_EXE_tunnelproof")
    );
    let subjects = ["--subject", "additive,certified", "--subject", &program];
    run(&[&["certify"], &SMALL[..], &subjects[..]].concat(), &page);
    let html = fs::read_to_string(&page).unwrap();
    assert!(!html.contains("<script") && !html.contains("src=\"http"));
    let pictures = html.matches("<img").count();
    assert!(pictures >= 4, "{pictures} pictures of witnesses");
    assert_is_drawn(browser, &page, &[], pictures);
}

#[test]
fn browser_sees_an_error_on_the_console() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("broken.html");
    let broken = "<!DOCTYPE html><body><script>nothing.is_there()</script></body>";
    fs::write(&page, broken).unwrap();
    let (_, console) = drawn(browser, &page, MEASURE, 390, false);
    assert!(console.contains("nothing is not defined"), "{console}");
}

/// Writes the page of a scene of the thesis.
fn simulate(arguments: &[&str], page: &Path) {
    let output = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .arg("simulate")
        .args(arguments)
        .arg("--replay")
        .arg(page)
        .output()
        .unwrap();
    assert!(output.status.success());
}

/// Every control of the page of a run was used and did something, on a telephone and on a desk.
fn assert_plays(browser: &str, page: &Path, views: usize) -> Vec<Value> {
    let look = |(width, is_dark)| {
        let (said, console) = drawn(browser, page, PLAY, width, is_dark);
        let at = format!("{} at {width}, dark: {is_dark}: {said:#}", page.display());
        assert_eq!(console, "", "{at}");
        assert_eq!(said["width"], width, "{at}");
        assert_eq!(said["overflow"], 0, "{at}");
        assert_eq!(brightness(&said["paper"]) < 128.0, is_dark, "{at}");
        assert_eq!(said["wrong"], Value::Array(Vec::new()), "{at}");
        assert_eq!(said["controls"], said["used"], "{at}");
        let number = |value: &Value| value.as_f64().unwrap();
        let list = |name: &str| said[name].as_array().unwrap().clone();
        assert_eq!(list("views").len(), views, "{at}");
        for view in list("views") {
            assert!(number(&view["width"]) > 250.0, "{at}");
            assert!(number(&view["height"]) > 200.0, "{at}");
            // What is to be seen reaches from border to border, but for some pixels.
            assert!((0.9..=1.0).contains(&number(&view["fills"])), "{at}");
            // An empty picture of this size is some hundreds of bytes.
            assert!(number(&view["drawn"]) > 5000.0, "{at}");
            assert_eq!(view["moved"], true, "{at}");
        }
        assert!(number(&said["played"]) >= 1.0, "{at}");
        assert_eq!(said["covered"], 0, "{at}");
        let charts = list("charts");
        assert!(charts.len() >= 3, "{at}");
        assert!(
            charts.iter().all(|chart| number(&chart[1]) > 2000.0),
            "{at}"
        );
        said
    };
    let sizes = [(390, false), (390, true), (1400, false), (1400, true)];
    sizes.into_iter().map(look).collect()
}

fn texts(said: &Value, name: &str) -> Vec<String> {
    let all = said[name].as_array().unwrap().iter();
    all.map(|text| text.as_str().unwrap().to_owned()).collect()
}

#[test]
fn browser_plays_the_page_of_the_longest_run() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("run.html");
    simulate(&["pulling-anchor"], &page);
    for said in assert_plays(browser, &page, 1) {
        // Of bodies and of wires, whatever the wires are coloured by.
        let names = ["cylinder", "near box", "far box", "hanging", "pulled"];
        assert_eq!(texts(&said, "names"), names);
    }
}

#[test]
fn browser_plays_the_page_of_two_runs_on_one_clock() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("run.html");
    let beside = ["--audit", "--beside", "discrete"];
    let scene = ["basic-collision", "--duration", "1.5"];
    simulate(&[&scene[..], &beside[..]].concat(), &page);
    for said in assert_plays(browser, &page, 2) {
        // Both runs, each on its half of the time line.
        let marks = texts(&said, "marks");
        for mark in ["prevented", "missed"] {
            assert!(marks.iter().any(|found| found == mark), "{said:#}");
        }
        let legend = texts(&said, "legend").join("; ");
        for words in [
            "pinned",
            "prevented",
            "missed",
            "normal of a contact",
            "N or more",
        ] {
            assert!(legend.contains(words), "{words}: {said:#}");
        }
    }
}

/// A wire whose damping is too much for `f64`.
const TOO_STIFF: &str = r#"
title = "too stiff"
duration = 1
[[wires]]
name = "chain"
material = { radius = 0.02, bend_modulus = 0, stretch_damping = 1e308 }
resolution = 3
adaptive = false
route = [{ pinned = [0, 0, 0] }, { pinned = [2, 0, 0] }, { free = [2, 1, 0.2] }]
"#;

/// What the page of a run without a step says of itself.
const STAND: &str = r#"<script>
addEventListener("load", () => setTimeout(() => {
  byId("play").click();
  byId("on").click();
  const text = selector => document.querySelector(selector).textContent;
  parent.postMessage(JSON.stringify({
    head: text(".head"), alone: text(".alone"), clock: byId("clock").textContent, nodes: runs[0].frames[0].wires[0].length / 3,
    names: [...document.querySelectorAll(".over .name")].map(one => one.textContent),
    overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  }), "*");
}, 100));
</script></body>"#;

#[test]
fn browser_shows_the_start_of_a_run_whose_first_step_fails() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (page, scene) = (
        folder.path().join("run.html"),
        folder.path().join("stiff.toml"),
    );
    fs::write(&scene, TOO_STIFF).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .arg("simulate")
        .args([scene.as_path(), Path::new("--replay"), page.as_path()])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    for width in [390, 1400] {
        let (said, console) = drawn(browser, &page, STAND, width, false);
        assert_eq!(console, "", "{said:#}");
        let text = |name: &str| said[name].as_str().unwrap();
        assert!(text("head").contains("stopped: step 0"), "{said:#}");
        assert!(text("alone").contains("no step was made"), "{said:#}");
        assert_eq!(text("clock"), "0.000 s");
        assert_eq!(said["names"], serde_json::json!(["chain"]), "{said:#}");
        assert!(said["nodes"].as_f64() >= Some(3.0), "{said:#}");
        assert_eq!(said["overflow"], 0, "{said:#}");
    }
}

#[test]
fn browser_colours_wires_that_are_called_after_a_colour() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("run.html");
    simulate(&["chains-on-deck", "--duration", "2"], &page);
    let (said, console) = drawn(browser, &page, PLAY, 1400, false);
    assert_eq!(console, "");
    assert_eq!(said["tone"], "name", "{said:#}");
    // What does not move is in the picture too, if it is small.
    for name in ["brown box", "blue box"] {
        let names = texts(&said, "names");
        assert!(names.iter().any(|shown| shown == name), "{said:#}");
    }
    let legend = texts(&said, "legend");
    assert!(legend.iter().any(|words| words == "brown"), "{said:#}");
}
