//! Draws the picture of the README: a wire that falls on two others at 10 m/s, with detection at
//! the ends of steps alone and with guard mode, each from a simulation of the scene
//! `basic-collision`.
//!
//! ```text
//! cargo run --release -p tunnelproof-cli --example tunnel_picture > docs/pictures/tunnel.svg
//! ```

use std::error::Error;
use std::fmt::Write;

use tunnelproof::certified::Certified;
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::Point;
use tunnelproof::wire::Mode;
use tunnelproof_cli::scenes::{Scene, SceneError};
use tunnelproof_cli::simulate::{Discrete, Run};

/// Steps that are drawn after the start.
const STEPS: usize = 3;

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
polyline { fill: none; stroke-width: 7; stroke-linecap: round; stroke-linejoin: round }
.edge { stroke: var(--paper); stroke-width: 13 }
.still { stroke: var(--still) }
.bad { stroke: var(--bad) }
.good { stroke: var(--good) }
.past { stroke-opacity: 0.35; stroke-width: 5 }
.word { font-size: 25px; font-weight: 600 }
.word.bad { fill: var(--bad); stroke: none }
.word.good { fill: var(--good); stroke: none }
";

/// Half of the picture.
struct Panel {
    title: &'static str,
    words: &'static str,
    class: &'static str,
    narrow: &'static dyn NarrowPhase,
    left: f64,
}

/// The nodes of every wire at the start and after each step.
type Frames = Vec<Vec<Vec<Point>>>;

fn simulate(scene: &Scene, narrow: &dyn NarrowPhase) -> Result<Frames, SceneError> {
    let mut frames: Frames = Vec::new();
    let run = Run {
        scene,
        narrow,
        mode: Mode::Guard,
    };
    run.go(|_, record| {
        if frames.is_empty() {
            frames.push(
                record
                    .wires
                    .iter()
                    .map(|wire| wire.before.clone())
                    .collect(),
            );
        }
        frames.push(record.wires.iter().map(|wire| wire.after.clone()).collect());
        Ok::<(), SceneError>(())
    })?;
    frames.truncate(STEPS + 1);
    Ok(frames)
}

/// The wire seen from the front, from the right and from above, in the units of the picture.
fn polyline(wire: &[Point], left: f64, class: &str) -> String {
    let points = wire.iter().map(|p| {
        let x = left + 180.0 + 150.0 * p.x + 32.0 * p.y;
        let y = 180.0 - 250.0 * p.z - 62.0 * p.y;
        format!("{x:.1},{y:.1}")
    });
    let points: Vec<String> = points.collect();
    let points = points.join(" ");
    format!("<polyline class=\"{class}\" points=\"{points}\"/>\n")
}

/// A wire with a border that parts it from what is behind it.
fn bordered(wire: &[Point], left: f64, class: &str) -> String {
    polyline(wire, left, "edge") + &polyline(wire, left, class)
}

/// The fixed wires, the falling one at each step above or below them, and the words.
fn draw(panel: &Panel, frames: &Frames) -> Option<String> {
    let (_, fixed) = frames.last()?.split_last()?;
    let (mut below, mut above) = (String::new(), String::new());
    for (step, frame) in frames.iter().enumerate() {
        let falling = frame.last()?;
        let past = if step + 1 < frames.len() { " past" } else { "" };
        let line = bordered(falling, panel.left, &format!("{}{past}", panel.class));
        let is_below = falling.get(falling.len() / 2)?.z < 0.0;
        *if is_below { &mut below } else { &mut above } += &line;
    }
    let fixed = fixed.iter().map(|wire| bordered(wire, panel.left, "still"));
    let mut picture = below + &fixed.collect::<String>() + &above;
    let x = panel.left + 180.0;
    let Panel {
        title,
        words,
        class,
        ..
    } = panel;
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
    let x = panel.left + 64.0;
    writeln!(
        picture,
        "<text class=\"note\" x=\"{x}\" y=\"140\">start</text>"
    )
    .ok()?;
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
        let frames = simulate(&scene, panel.narrow)?;
        print!("{}", draw(panel, &frames).ok_or("a scene without wires")?);
    }
    println!(
        "<text class=\"note\" x=\"360\" y=\"382\">The same wire at 10 m/s, step by step of 1/60 s</text>\n</svg>"
    );
    Ok(())
}
