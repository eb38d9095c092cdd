//! A picture of two cases: the cantilever that is bent far, and the folded chain.

use std::error::Error;
use std::fmt::Write as _;

use tunnelproof::query::Point;

use crate::analytic::elastica::{MATTIASSON, cantilever};
use crate::analytic::falling::{LENGTH, by_energy, let_go};

const STYLE: &str = "
svg { --paper: #ffffff; --ink: #1f2328; --soft: #59636e; --line: #d1d9e0; --ours: #0969da }
@media (prefers-color-scheme: dark) {
  svg { --paper: #0d1117; --ink: #f0f6fc; --soft: #9198a1; --line: #3d444d; --ours: #58a6ff }
}
.paper { fill: var(--paper); stroke: var(--line) }
text { font-family: system-ui, sans-serif; fill: var(--ink); font-size: 21px }
.title { font-size: 26px; font-weight: 600 }
.soft { fill: var(--soft) }
.exact { fill: none; stroke: var(--soft); stroke-width: 5; opacity: 0.45 }
.ours { fill: none; stroke: var(--ours); stroke-width: 1.5 }
.node { fill: var(--ours) }
.stone { fill: var(--soft) }
.wall { stroke: var(--ink); stroke-width: 3 }
";

const SIZE: [f64; 2] = [1000.0, 560.0];

/// The picture as SVG.
pub(crate) fn draw() -> Result<String, Box<dyn Error>> {
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
         <title>Rods bent by loads lie on the published curves; the end of a folded chain falls \
         ahead of a stone, as energy says.</title>\n<style>{STYLE}</style>\n\
         <rect class=\"paper\" x=\"0.5\" y=\"0.5\" width=\"{}\" height=\"{}\" rx=\"8\"/>\n",
        width - 1.0,
        height - 1.0
    );
    rods(&mut svg)?;
    chain(&mut svg)?;
    svg.push_str("</svg>");
    Ok(svg)
}

fn text(svg: &mut String, [x, y]: [f64; 2], class: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{words}</text>"
    );
}

fn line(svg: &mut String, class: &str, points: impl Iterator<Item = [f64; 2]>) {
    let points: Vec<_> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    let _ = writeln!(
        svg,
        "<polyline class=\"{class}\" points=\"{}\"/>",
        points.join(" ")
    );
}

fn dot(svg: &mut String, class: &str, [x, y]: [f64; 2], radius: f64) {
    let _ = writeln!(
        svg,
        "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>"
    );
}

/// Cantilevers on the curves of the elastica.
fn rods(svg: &mut String) -> Result<(), Box<dyn Error>> {
    let place = |[x, z]: [f64; 2]| [60.0 + 400.0 * x, 130.0 - 400.0 * z];
    text(svg, [30.0, 44.0], "title", "A rod under a load at its end");
    text(
        svg,
        [30.0, 76.0],
        "soft",
        "grey: elastica, blue: the stepper",
    );
    let wall = [[0.0, 0.06], [0.0, -0.06]];
    line(svg, "wall", wall.into_iter().map(place));
    for (load, _, _) in MATTIASSON {
        line(svg, "exact", elastica(load).into_iter().map(place));
        let wire = cantilever(load)?;
        let flat = |point: Point| place([point.x, point.z]);
        let nodes: Vec<_> = wire.nodes()[1..]
            .iter()
            .map(|node| flat(node.position))
            .collect();
        line(svg, "ours", nodes.iter().copied());
        for node in nodes.iter().step_by(4) {
            dot(svg, "node", *node, 3.5);
        }
        let [x, y] = nodes[nodes.len() - 1];
        text(svg, [x + 10.0, y + 6.0], "", &format!("{load}"));
    }
    text(svg, [150.0, 510.0], "soft", "numbers: P L\u{b2} / E I");
    Ok(())
}

/// The curve of a cantilever of length 1: its angle has `theta'' = -load cos(theta)` with
/// `theta = 0` at the wall and `theta' = 0` at the end.
fn elastica(load: f64) -> Vec<[f64; 2]> {
    const PARTS: usize = 400;
    let rate = |[angle, bend, ..]: [f64; 4]| {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        [bend, -load * cos, cos, -sin]
    };
    let on = |at: [f64; 4], by: f64, rate: [f64; 4]| [0, 1, 2, 3].map(|k| at[k] + by * rate[k]);
    let shoot = |bend: f64| {
        let part = 1.0 / PARTS as f64;
        let mut at = [0.0, bend, 0.0, 0.0];
        let mut curve = vec![[0.0, 0.0]];
        for _ in 0..PARTS {
            // Runge and Kutta's method of fourth order.
            let first = rate(at);
            let second = rate(on(at, part / 2.0, first));
            let third = rate(on(at, part / 2.0, second));
            let fourth = rate(on(at, part, third));
            for k in 0..4 {
                let mean = first[k] + 2.0 * (second[k] + third[k]) + fourth[k];
                at[k] += part / 6.0 * mean;
            }
            curve.push([at[2], at[3]]);
        }
        (at[1], curve)
    };
    let mut bracket = [0.0, load];
    for _ in 0..60 {
        let middle = (bracket[0] + bracket[1]) / 2.0;
        bracket[usize::from(shoot(middle).0 > 0.0)] = middle;
    }
    shoot(bracket[0]).1
}

/// A chain of which an end falls, beside a stone and what conservation of energy says.
fn chain(svg: &mut String) -> Result<(), Box<dyn Error>> {
    const STEP: f64 = 2.5e-4;
    text(
        svg,
        [540.0, 44.0],
        "title",
        "A folded chain, one end let go",
    );
    text(
        svg,
        [540.0, 76.0],
        "soft",
        "line: its end by energy; dot: a stone",
    );
    let mut world = let_go(128, STEP)?;
    let gravity = -world.settings().gravity.z;
    for (k, fallen) in [0.0, 0.2, 0.4, 0.6, 0.75, 0.9].into_iter().enumerate() {
        let time = by_energy(gravity, fallen).0;
        while world.time() + STEP / 2.0 < time {
            world.step(&[])?;
        }
        let place = |x: f64, z: f64| [565.0 + 73.0 * k as f64 + 400.0 * x, 130.0 - 380.0 * z];
        let nodes = world.wires()[0].nodes();
        line(
            svg,
            "ours",
            nodes
                .iter()
                .map(|node| place(node.position.x, node.position.z)),
        );
        let end = nodes[nodes.len() - 1].position;
        let mark = [-0.03, 0.06].map(|x| place(x, -fallen * LENGTH));
        line(svg, "exact", mark.into_iter());
        dot(svg, "node", place(end.x, end.z), 4.5);
        dot(svg, "stone", place(0.07, -gravity * time * time / 2.0), 5.0);
        let [x, _] = place(-0.03, 0.0);
        text(svg, [x, 540.0], "soft", &format!("{time:.2}s"));
    }
    Ok(())
}
