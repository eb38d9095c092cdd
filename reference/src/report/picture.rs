//! A query as a picture, as the thesis draws its cases (4.1.1): both edges at the start, at the end
//! and at the time of impact, the paths of their ends, and the points of contact.

use std::fmt::Write as _;

use nalgebra::{Vector2, Vector3};
use tunnelproof::query::Query;

use crate::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};

use super::labels::Labels;
use super::view::View;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 640.0;
/// The part of the picture that the edges are drawn in: left, top, right, bottom.
const FRAME: [f64; 4] = [70.0, 80.0, 890.0, 510.0];
/// How much space the edges leave at the frame for labels.
const INK: &str = "#1f2933";
const PAPER: &str = "#fcfcfa";

/// The colours of an edge.
struct Paint {
    solid: &'static str,
    faint: &'static str,
    dark: &'static str,
}

const PAINTS: [Paint; 2] = [
    Paint {
        solid: "#2f7fd0",
        faint: "#d5e6f7",
        dark: "#14508f",
    },
    Paint {
        solid: "#3aa655",
        faint: "#d6f0dc",
        dark: "#17672d",
    },
];

/// When an edge is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum When {
    Start,
    End,
    Impact,
}

/// One edge at one time, in pixels.
struct Stroke {
    edge: usize,
    when: When,
    ends: [Vector2<f64>; 2],
    nearness: f64,
}

/// The picture of an edge-edge query and its exact answer, an SVG document.
pub fn draw(title: &str, query: &Query, answer: &ExactAnswer) -> String {
    let scene = Scene::new(query, answer);
    let mut svg = String::new();
    header(&mut svg, title);
    scene.draw_paths(&mut svg);
    scene.draw_edges(&mut svg);
    scene.draw_contacts(&mut svg);
    scene.draw_labels(&mut svg);
    caption(&mut svg, answer, scene.is_drawn_apart);
    legend(&mut svg, answer);
    svg.push_str("</svg>\n");
    svg
}

/// Everything in pixels.
struct Scene {
    start: [Vector2<f64>; 4],
    end: [Vector2<f64>; 4],
    strokes: Vec<Stroke>,
    contacts: Vec<Vector2<f64>>,
    /// Whether all points are (nearly) on a line, so that start, impact and end are moved apart.
    is_drawn_apart: bool,
}

impl Scene {
    fn new(query: &Query, answer: &ExactAnswer) -> Self {
        let start = query.start().map(|point| point.coords);
        let end = query.end().map(|point| point.coords);
        let toi = answer.hit.map(|hit| middle(hit.toi));
        let at = |t: f64| [0, 1, 2, 3].map(|i| start[i] * (1.0 - t) + end[i] * t);
        let impact = toi.map(at);
        let contacts = answer
            .hit
            .iter()
            .zip(&impact)
            .flat_map(|(hit, points)| contacts(hit, points));
        let contacts: Vec<_> = contacts.collect();
        let all: Vec<_> = start.iter().chain(&end).chain(&contacts).copied().collect();
        let view = View::of(&all, &[[0, 1], [2, 3], [4, 5], [6, 7]]);
        let sheet = Sheet::new(view, &all);
        let place = |points: [Vector3<f64>; 4], when| {
            [0, 1, 2, 3].map(|i| sheet.place(&points[i], when, i / 2))
        };
        let mut strokes = Vec::new();
        let times = [
            (Some(start), When::Start),
            (Some(end), When::End),
            (impact, When::Impact),
        ];
        for (points, when) in times {
            let Some(points) = points else { continue };
            let placed = place(points, when);
            strokes.extend([0, 1].map(|edge| Stroke {
                edge,
                when,
                ends: [placed[2 * edge], placed[2 * edge + 1]],
                nearness: view.nearness(&((points[2 * edge] + points[2 * edge + 1]) * 0.5)),
            }));
        }
        strokes.sort_by(|a, b| a.nearness.total_cmp(&b.nearness));
        Scene {
            start: place(start, When::Start),
            end: place(end, When::End),
            strokes,
            contacts: contacts.iter().map(|at| sheet.place_contact(at)).collect(),
            is_drawn_apart: sheet.is_drawn_apart,
        }
    }

    fn draw_paths(&self, svg: &mut String) {
        for i in 0..4 {
            let (from, to) = (self.start[i], self.end[i]);
            let middle = (from + to) * 0.5;
            let marker = if (to - from).norm() > 30.0 {
                format!(r#" marker-mid="url(#arrow{})""#, i / 2)
            } else {
                String::new()
            };
            let points = [from, middle, to]
                .map(|p| format!("{:.1},{:.1}", p.x, p.y))
                .join(" ");
            let _ = writeln!(
                svg,
                r#"<polyline points="{points}" fill="none" stroke="{}" stroke-width="1.3" stroke-opacity="0.75"{marker}/>"#,
                PAINTS[i / 2].solid
            );
        }
    }

    /// The far ones first; those at the time of impact on top.
    fn draw_edges(&self, svg: &mut String) {
        let (thin, thick): (Vec<_>, Vec<_>) = self
            .strokes
            .iter()
            .partition(|stroke| stroke.when == When::Impact);
        for stroke in thick {
            let paint = &PAINTS[stroke.edge];
            match stroke.when {
                When::Start => {
                    stroke.draw(svg, PAPER, 14.0, "");
                    stroke.draw(svg, paint.solid, 11.0, "");
                    stroke.draw(svg, paint.faint, 8.6, "");
                }
                When::End | When::Impact => {
                    stroke.draw(svg, PAPER, 14.0, "");
                    stroke.draw(svg, paint.solid, 11.0, "");
                }
            }
        }
        for stroke in thin {
            stroke.draw(svg, PAPER, 6.0, "");
            stroke.draw(svg, PAINTS[stroke.edge].dark, 3.4, "");
        }
    }

    fn draw_contacts(&self, svg: &mut String) {
        if let [a, b] = self.contacts[..] {
            let _ = writeln!(
                svg,
                r##"<line x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}" stroke="#f08c1a" stroke-width="7" stroke-opacity="0.55" stroke-linecap="round"/>"##,
                a.x, a.y, b.x, b.y
            );
        }
        for at in &self.contacts {
            let _ = writeln!(
                svg,
                r##"<circle cx="{:.1}" cy="{:.1}" r="8.5" fill="url(#sphere)" stroke="#a8560a" stroke-width="1.2"/>"##,
                at.x, at.y
            );
        }
    }

    fn draw_labels(&self, svg: &mut String) {
        let lines = self.strokes.iter().map(|stroke| stroke.ends);
        let paths = (0..4).map(|i| [self.start[i], self.end[i]]);
        let mut labels = Labels::new(
            lines.chain(paths).collect(),
            self.contacts.clone(),
            FRAME_OUTER,
        );
        for (points, index) in [(&self.start, '\u{2080}'), (&self.end, '\u{2081}')] {
            for i in 0..4 {
                let other = points[i ^ 1];
                let at = labels.place(points[i], points[i] - other);
                let name = ['A', 'B', 'C', 'D'][i];
                text(
                    svg,
                    at,
                    "middle",
                    17,
                    PAINTS[i / 2].dark,
                    "600",
                    &format!("{name}{index}"),
                );
            }
        }
    }
}

/// Where labels may be.
const FRAME_OUTER: [f64; 4] = [24.0, 52.0, 936.0, 548.0];

impl Stroke {
    fn draw(&self, svg: &mut String, colour: &str, width: f64, more: &str) {
        let [a, b] = self.ends;
        let _ = writeln!(
            svg,
            r#"<line x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}" stroke="{colour}" stroke-width="{width}" stroke-linecap="round"{more}/>"#,
            a.x, a.y, b.x, b.y
        );
    }
}

/// From space to pixels.
struct Sheet {
    view: View,
    middle: Vector2<f64>,
    scale: f64,
    is_drawn_apart: bool,
}

impl Sheet {
    fn new(view: View, points: &[Vector3<f64>]) -> Self {
        let projected: Vec<_> = points.iter().map(|point| view.project(point)).collect();
        let low = projected
            .iter()
            .fold(Vector2::repeat(f64::MAX), |low, p| low.inf(p));
        let high = projected
            .iter()
            .fold(Vector2::repeat(f64::MIN), |high, p| high.sup(p));
        let size = high - low;
        let [left, top, right, bottom] = FRAME;
        let fit = |room: f64, size: f64| if size > 0.0 { room / size } else { f64::MAX };
        let scale = fit(right - left, size.x).min(fit(bottom - top, size.y));
        Sheet {
            view,
            middle: (low + high) * 0.5,
            scale: if scale < f64::MAX { scale } else { 0.0 },
            is_drawn_apart: size.y <= 0.03 * size.x,
        }
    }

    fn place(&self, point: &Vector3<f64>, when: When, edge: usize) -> Vector2<f64> {
        let lane = match when {
            When::Start => -120.0,
            When::Impact => 0.0,
            When::End => 120.0,
        };
        let shift = if edge == 0 { -9.0 } else { 9.0 };
        let apart = if self.is_drawn_apart {
            lane + shift
        } else {
            0.0
        };
        self.place_contact(point) + Vector2::new(0.0, apart)
    }

    fn place_contact(&self, point: &Vector3<f64>) -> Vector2<f64> {
        let at = (self.view.project(point) - self.middle) * self.scale;
        let [left, top, right, bottom] = FRAME;
        Vector2::new((left + right) / 2.0 + at.x, (top + bottom) / 2.0 - at.y)
    }
}

/// The points of contact in space: one, or the two ends of an overlap.
fn contacts(hit: &ExactHit, at: &[Vector3<f64>; 4]) -> Vec<Vector3<f64>> {
    let on_first = |place: Parameters| {
        let u = middle(place.u);
        let v = middle(place.v);
        // Rounding moves the two apart by less than a pixel.
        let [a, b, c, d] = at;
        ((a * (1.0 - u) + b * u) + (c * (1.0 - v) + d * v)) * 0.5
    };
    std::iter::once(hit.first)
        .chain(hit.second)
        .map(on_first)
        .collect()
}

fn middle(number: Enclosure) -> f64 {
    number.below + (number.above - number.below) * 0.5
}

fn header(svg: &mut String, title: &str) {
    let title = escape(&elided(title, 80));
    let _ = writeln!(
        svg,
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="DejaVu Sans, Helvetica, Arial, sans-serif">
<title>{title}</title>
<defs>
<radialGradient id="sphere" cx="0.36" cy="0.32" r="0.75"><stop offset="0" stop-color="#ffe0b0"/><stop offset="0.45" stop-color="#f79a2d"/><stop offset="1" stop-color="#d96f0b"/></radialGradient>
{}{}</defs>
<rect width="{WIDTH}" height="{HEIGHT}" fill="{PAPER}"/>"##,
        arrow(0),
        arrow(1),
    );
    text_escaped(
        svg,
        Vector2::new(32.0, 38.0),
        "start",
        18,
        INK,
        "600",
        &title,
    );
}

fn arrow(edge: usize) -> String {
    format!(
        "<marker id=\"arrow{edge}\" viewBox=\"0 0 10 10\" refX=\"6\" refY=\"5\" markerUnits=\"userSpaceOnUse\" markerWidth=\"11\" markerHeight=\"11\" orient=\"auto\"><path d=\"M1 1 L9 5 L1 9 Z\" fill=\"{}\"/></marker>\n",
        PAINTS[edge].solid
    )
}

fn caption(svg: &mut String, answer: &ExactAnswer, is_drawn_apart: bool) {
    let (headline, detail) = match answer.hit {
        None => ("No contact".to_owned(), format!("{} case", answer.case)),
        Some(hit) => (
            format!("{} at t {}", capitalised(hit.kind.name()), about(hit.toi)),
            details(answer, &hit),
        ),
    };
    text(
        svg,
        Vector2::new(32.0, 582.0),
        "start",
        17,
        INK,
        "600",
        &headline,
    );
    text(
        svg,
        Vector2::new(32.0, 604.0),
        "start",
        13,
        "#52606d",
        "400",
        &detail,
    );
    if is_drawn_apart {
        let note = "All points are (nearly) on one line: start, impact and end are drawn apart.";
        text(
            svg,
            Vector2::new(32.0, 624.0),
            "start",
            12,
            "#7b8794",
            "400",
            note,
        );
    }
}

fn details(answer: &ExactAnswer, hit: &ExactHit) -> String {
    let mut parts = vec![format!("{} case", answer.case)];
    if hit.flags.temporarily_parallel {
        parts.push("temporarily parallel".to_owned());
    }
    if hit.flags.temporarily_point {
        parts.push("temporarily a point".to_owned());
    }
    let place = |place: Parameters| format!("u {}, v {}", about(place.u), about(place.v));
    parts.push(match hit.second {
        None => place(hit.first),
        Some(second) => format!("from {} to {}", place(hit.first), place(second)),
    });
    parts.join(" \u{b7} ")
}

/// `= 0.5`, or `\u{2248} 0.333333` where six digits are not the whole number.
fn about(number: Enclosure) -> String {
    let rounded = format!("{:.6}", number.below);
    let short = rounded.trim_end_matches('0').trim_end_matches('.');
    match number.is_exact() && short.parse() == Ok(number.below) {
        true => format!("= {short}"),
        false if number.below != 0.0 && number.below < 1e-4 => {
            format!("\u{2248} {:.3e}", number.below)
        }
        false => format!("\u{2248} {rounded}"),
    }
}

fn legend(svg: &mut String, answer: &ExactAnswer) {
    let mut x = if answer.hit.is_some() { 532.0 } else { 652.0 };
    let sample = |svg: &mut String, x: f64, kind: When| {
        for (edge, y) in [(0, 571.0), (1, 583.0)] {
            let (a, b) = (Vector2::new(x, y), Vector2::new(x + 26.0, y));
            let paint = &PAINTS[edge];
            let stroke = Stroke {
                edge,
                when: kind,
                ends: [a, b],
                nearness: 0.0,
            };
            match kind {
                When::Start => {
                    stroke.draw(svg, paint.solid, 8.0, "");
                    stroke.draw(svg, paint.faint, 5.6, "");
                }
                When::End => stroke.draw(svg, paint.solid, 8.0, ""),
                When::Impact => stroke.draw(svg, paint.dark, 3.4, ""),
            }
        }
    };
    let label = |svg: &mut String, x: f64, words: &str| {
        text(svg, Vector2::new(x, 582.0), "start", 13, INK, "400", words);
    };
    let mut entries = vec![(When::Start, "start"), (When::End, "end")];
    if answer.hit.is_some() {
        entries.insert(1, (When::Impact, "impact"));
    }
    for (when, words) in entries {
        sample(svg, x, when);
        label(svg, x + 38.0, words);
        x += 58.0 + 8.0 * words.len() as f64;
    }
    if answer.hit.is_some() {
        let _ = writeln!(
            svg,
            r##"<circle cx="{:.1}" cy="577" r="7" fill="url(#sphere)" stroke="#a8560a" stroke-width="1"/>"##,
            x + 4.0
        );
        label(svg, x + 18.0, "contact");
    }
    for (edge, name, y) in [(0, "AB", 604.0), (1, "CD", 604.0)] {
        let at = Vector2::new(858.0 + 40.0 * edge as f64, y);
        text(svg, at, "start", 14, PAINTS[edge].solid, "600", name);
    }
}

fn text(
    svg: &mut String,
    at: Vector2<f64>,
    anchor: &str,
    size: u32,
    colour: &str,
    weight: &str,
    words: &str,
) {
    text_escaped(svg, at, anchor, size, colour, weight, &escape(words));
}

fn text_escaped(
    svg: &mut String,
    at: Vector2<f64>,
    anchor: &str,
    size: u32,
    colour: &str,
    weight: &str,
    words: &str,
) {
    let _ = writeln!(
        svg,
        r#"<text x="{:.1}" y="{:.1}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}" fill="{colour}" stroke="{PAPER}" stroke-width="3" stroke-linejoin="round" paint-order="stroke">{words}</text>"#,
        at.x, at.y
    );
}

/// Text as XML may hold it.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// `text` without its middle if it is longer than `longest` characters.
fn elided(text: &str, longest: usize) -> String {
    let count = text.chars().count();
    if count <= longest {
        return text.to_owned();
    }
    let head: String = text.chars().take(longest / 3).collect();
    let tail: String = text
        .chars()
        .skip(count - (longest - longest / 3 - 1))
        .collect();
    format!("{head}\u{2026}{tail}")
}

fn capitalised(word: &str) -> String {
    let mut chars = word.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(chars).collect()
    })
}
