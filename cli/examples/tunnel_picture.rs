//! Draws the picture of the README: a wire that falls on two others at 10 m/s, with detection at
//! the ends of steps alone and with guard mode. Each half is drawn from the recording of a
//! simulation of the scene `basic-collision`.
//!
//! ```text
//! cargo run --release -p tunnelproof-cli --example tunnel_picture > docs/pictures/tunnel.svg
//! ```
//!
//! It moves by itself. Who prefers reduced motion, and who prints it, sees how it ends.

use std::error::Error;
use std::fmt::Write;

use tunnelproof::certified::Certified;
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::Point;
use tunnelproof::wire::recording::{Recorder, Recording};
use tunnelproof::wire::{Mode, StepRecord};
use tunnelproof_cli::scenes::{Scene, SceneError};
use tunnelproof_cli::simulate::{Discrete, Run};

/// Steps that are drawn after the start.
const STEPS: usize = 3;

/// How long the picture rests at the start, takes for a step, and rests at the end, in s.
const PACE: [f64; 3] = [0.9, 0.8, 2.7];

/// Points of a wire that are drawn: as many in every step, whatever its resolution is.
const DRAWN: usize = 25;

const STYLE: &str = "
svg { --paper: #ffffff; --ink: #1f2328; --soft: #59636e; --line: #d1d9e0; --still: #6e7781;
  --bad: #cf222e; --good: #1a7f37 }
@media (prefers-color-scheme: dark) {
  svg { --paper: #0d1117; --ink: #f0f6fc; --soft: #9198a1; --line: #3d444d; --still: #8b949e;
    --bad: #ff7b72; --good: #56d364 }
}
.paper { fill: var(--paper); stroke: var(--line) }
text { font-family: system-ui, sans-serif; fill: var(--ink); text-anchor: middle }
.title { font-size: 25px; font-weight: 600 }
.note { font-size: 22px; fill: var(--soft) }
.wire { fill: none; stroke-width: 7; stroke-linecap: round; stroke-linejoin: round }
.edge { stroke: var(--paper); stroke-width: 13 }
.still { stroke: var(--still) }
.bad { stroke: var(--bad) }
.good { stroke: var(--good) }
.past { stroke-opacity: 0.35; stroke-width: 5 }
.word { font-size: 25px; font-weight: 600 }
.word.bad { fill: var(--bad); stroke: none }
.word.good { fill: var(--good); stroke: none }
.ended { display: none }
@media (prefers-reduced-motion: reduce), print { .moving { display: none } .ended { display: inline } }
";

/// Half of the picture.
struct Panel {
    title: &'static str,
    words: &'static str,
    class: &'static str,
    narrow: &'static dyn NarrowPhase,
    left: f64,
}

/// The wires at an instant, each as [`DRAWN`] points. The last one falls.
type Frame = Vec<Vec<Point>>;

/// Records the scene, and reads the wires at the start and after each step from the recording.
fn frames(scene: &Scene, narrow: &dyn NarrowPhase) -> Result<Vec<Frame>, Box<dyn Error>> {
    let mut recorder = Recorder::new(Vec::new(), &scene.world()?)?;
    let run = Run {
        scene,
        narrow,
        mode: Mode::Guard,
    };
    let mut refused = None;
    run.go(|_, record| {
        refused = refused.take().or(recorder.record(record).err());
        Ok::<(), SceneError>(())
    })?;
    if let Some(error) = refused {
        return Err(error.into());
    }
    let bytes = recorder.into_inner();
    let records: Vec<StepRecord> = Recording::open(&*bytes)?.collect::<Result<_, _>>()?;
    let first = records.first().ok_or("a scene without steps")?;
    let start = first.wires.iter().map(|wire| drawn(&wire.before)).collect();
    let after = |record: &StepRecord| record.wires.iter().map(|wire| drawn(&wire.after)).collect();
    Ok(std::iter::once(start)
        .chain(records.iter().map(after))
        .collect())
}

/// Points at equal distances along a wire.
fn drawn(nodes: &[Point]) -> Vec<Point> {
    let lengths = nodes.windows(2).map(|ends| (ends[1] - ends[0]).norm());
    let mut along = vec![0.0];
    along.extend(lengths.scan(0.0, |sum, length| {
        *sum += length;
        Some(*sum)
    }));
    let total = along.last().copied().unwrap_or(0.0);
    let at = |k: usize| {
        let wanted = total * k as f64 / (DRAWN - 1) as f64;
        let next = along.partition_point(|length| *length < wanted);
        let next = next.clamp(1, nodes.len() - 1);
        let share = (wanted - along[next - 1]) / (along[next] - along[next - 1]);
        nodes[next - 1].lerp(&nodes[next], share)
    };
    (0..DRAWN).map(at).collect()
}

/// The wire seen from the front, from the right and from above, in the units of the picture.
fn points(wire: &[Point], left: f64) -> String {
    let points = wire.iter().map(|p| {
        let x = left + 180.0 + 150.0 * p.x + 32.0 * p.y;
        let y = 180.0 - 250.0 * p.z - 62.0 * p.y;
        format!("{x:.1},{y:.1}")
    });
    points.collect::<Vec<_>>().join(" ")
}

/// When each frame is reached, as a part of the whole; the last one twice.
fn key_times() -> Vec<f64> {
    let [before, step, after] = PACE;
    let whole = before + step * STEPS as f64 + after;
    let reached = (0..=STEPS).map(|k| (before + step * k as f64) / whole);
    std::iter::once(0.0).chain(reached).chain([1.0]).collect()
}

fn animate(attribute: &str, mode: &str, values: &[String], times: &[f64]) -> String {
    let times: Vec<String> = times.iter().map(|time| format!("{time:.4}")).collect();
    let [before, step, after] = PACE;
    format!(
        "<animate attributeName=\"{attribute}\" calcMode=\"{mode}\" dur=\"{:.1}s\" repeatCount=\"indefinite\" \
         keyTimes=\"{}\" values=\"{}\"/>",
        before + step * STEPS as f64 + after,
        times.join(";"),
        values.join(";")
    )
}

/// The shape of a wire that moves, called by a name. Without animation it is as at the end.
fn moving_shape(name: &str, frames: &[Frame], wire: usize, left: f64) -> String {
    let at = |frame: &Frame| points(&frame[wire], left);
    let all: Vec<String> = frames.iter().map(at).collect();
    let [first, .., last] = &all[..] else {
        return String::new();
    };
    let values: Vec<String> = [first]
        .into_iter()
        .chain(&all)
        .chain([last])
        .cloned()
        .collect();
    let animation = animate("points", "linear", &values, &key_times());
    format!("<polyline id=\"{name}\" points=\"{last}\">{animation}</polyline>\n")
}

/// A wire with a border that parts it from what is behind it; `seen` says when.
fn bordered(shape: &str, class: &str, seen: &str) -> String {
    format!(
        "<g{seen}<use href=\"#{shape}\" class=\"wire edge\"/><use href=\"#{shape}\" class=\"wire {class}\"/></g>\n"
    )
}

/// When the falling wire gets below the height of the others, as a part of the whole, if it does.
fn passes_at(frames: &[Frame]) -> Option<f64> {
    let height = |frame: &Frame| Some(frame.last()?.get(DRAWN / 2)?.z);
    let below = frames.iter().position(|frame| height(frame) < Some(0.0))?;
    let [from, to] = [
        height(&frames[below.checked_sub(1)?])?,
        height(&frames[below])?,
    ];
    let times = key_times();
    let [start, end] = [times[below], times[below + 1]];
    Some(start + (end - start) * from / (from - to))
}

/// The rest of a tag, and what makes its element visible until a time or from it on: a part of the
/// whole. Without a time that is always or never.
fn visible(until: bool, then: Option<f64>) -> String {
    let [before, after] = match until {
        true => ["visible", "hidden"],
        false => ["hidden", "visible"],
    };
    match then {
        None => format!(" visibility=\"{before}\">"),
        Some(0.0) => format!(" visibility=\"{after}\">"),
        Some(then) => {
            let values = [before, after].map(str::to_owned);
            let animation = animate("visibility", "discrete", &values, &[0.0, then]);
            format!(" visibility=\"{after}\">{animation}")
        }
    }
}

/// Where the falling wire was, as it passes on.
fn past(panel: &Panel, frames: &[Frame], step: usize, moves: bool) -> Option<String> {
    let line = points(frames[step].last()?, panel.left);
    let then = key_times().get(step + 1).copied()?;
    let seen = visible(false, Some(if moves { then } else { 0.0 }));
    let class = panel.class;
    Some(format!(
        "<polyline class=\"wire {class} past\" points=\"{line}\"{seen}</polyline>\n"
    ))
}

/// The fixed wires, and the falling one above or below them; in motion, or as it ends.
fn scene(panel: &Panel, frames: &[Frame], moves: bool) -> Option<String> {
    let shape = |wire: usize| format!("{}{wire}{}", panel.class, if moves { "" } else { "end" });
    let then = passes_at(frames).map(|then| if moves { then } else { 0.0 });
    let falling = frames.first()?.len() - 1;
    let [mut below, mut above] = [String::new(), String::new()];
    for (step, frame) in frames.iter().enumerate().take(frames.len() - 1) {
        let is_below = frame.last()?.get(DRAWN / 2)?.z < 0.0;
        *if is_below { &mut below } else { &mut above } += &past(panel, frames, step, moves)?;
    }
    below += &bordered(&shape(falling), panel.class, &visible(false, then));
    above += &bordered(&shape(falling), panel.class, &visible(true, then));
    let fixed = (0..falling).map(|wire| bordered(&shape(wire), "still", ">"));
    Some(below + &fixed.collect::<String>() + &above)
}

/// Half of the picture: what moves, how it ends for who wants no motion, and words.
fn draw(panel: &Panel, frames: &[Frame]) -> Option<String> {
    let Panel {
        title,
        words,
        class,
        left,
        ..
    } = panel;
    let end = frames.last()?;
    let mut picture = String::from("<defs>\n");
    for (wire, nodes) in end.iter().enumerate() {
        picture += &moving_shape(&format!("{class}{wire}"), frames, wire, *left);
        let line = points(nodes, *left);
        writeln!(
            picture,
            "<polyline id=\"{class}{wire}end\" points=\"{line}\"/>"
        )
        .ok()?;
    }
    picture += "</defs>\n";
    for (class, moves) in [("moving", true), ("ended", false)] {
        let scene = scene(panel, frames, moves)?;
        write!(picture, "<g class=\"{class}\">\n{scene}</g>\n").ok()?;
    }
    let x = left + 180.0;
    for (class, y, words) in [
        ("title", 42, title),
        (&*format!("word {class}"), 342, words),
    ] {
        writeln!(
            picture,
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{words}</text>"
        )
        .ok()?;
    }
    Some(picture)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::embedded("basic-collision")?;
    scene.duration = scene.settings.step * STEPS as f64;
    let panels = [
        Panel {
            title: "discrete detection",
            words: "through both wires",
            class: "bad",
            narrow: &Discrete,
            left: 0.0,
        },
        Panel {
            title: "tunnelproof",
            words: "held by both wires",
            class: "good",
            narrow: &Certified,
            left: 360.0,
        },
    ];
    println!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 400\" role=\"img\">\n\
         <title>A wire falls on two others: through them, or held by them</title>\n\
         <style>{STYLE}</style>\n\
         <rect class=\"paper\" x=\"0.5\" y=\"0.5\" width=\"719\" height=\"399\" rx=\"8\"/>"
    );
    for panel in &panels {
        let frames = frames(&scene, panel.narrow)?;
        print!("{}", draw(panel, &frames).ok_or("a scene without wires")?);
    }
    let slower = (PACE[1] / scene.settings.step).round();
    println!(
        "<text class=\"note\" x=\"360\" y=\"382\">The same wire at 10 m/s, in steps of 1/60 s, {slower} times slower</text>\n</svg>"
    );
    Ok(())
}
