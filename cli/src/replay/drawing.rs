//! The frames of runs as pictures, drawn without a browser: SVG, of which other programs make a
//! video. Bodies are drawn first and wires over them.

use std::fmt::Write as _;

use nalgebra::{Quaternion, UnitQuaternion};
use tunnelproof::query::Point;
use tunnelproof::wire::Vector;

use super::Replay;
use super::camera::{Camera, Rectangle, Spot};
use super::frame::{Frame, MARKS};
use super::surface::Surface;

/// Of the whole picture, in pixels.
const SIZE: [f64; 2] = [1280.0, 720.0];
/// What the head of a picture takes.
const HEAD: f64 = 64.0;
/// What its legend takes.
const FOOT: f64 = 40.0;
/// The thinnest that a wire is drawn.
const THINNEST: f64 = 3.0;
/// How long a mark is seen, in s.
const SEEN: f64 = 0.25;
/// Of wires that are not called after a colour.
const PALETTE: [&str; 8] = [
    "#2f7fd0", "#d6592b", "#2ca02c", "#9467bd", "#c79a1b", "#17a8bd", "#b05a7a", "#7f8c3a",
];

/// Runs on one clock, beside each other.
pub struct Drawing<'a> {
    panels: Vec<Panel<'a>>,
}

/// A run and where it is drawn.
struct Panel<'a> {
    run: &'a Replay,
    camera: Camera,
    room: Rectangle,
    /// Of each body, unless it is a plane.
    surfaces: Vec<Option<Surface>>,
}

impl<'a> Drawing<'a> {
    /// Sees all that wires and bodies do in a run; of two runs, in the one that takes less room.
    pub fn new(runs: &'a [Replay]) -> Self {
        let width = SIZE[0] / runs.len().max(1) as f64;
        let seen = runs.iter().map(points);
        let seen = seen.min_by(|a, b| extent(a).total_cmp(&extent(b)));
        let seen = seen.unwrap_or_default();
        let panel = |(k, run): (usize, &'a Replay)| {
            let room = Rectangle {
                left: width * k as f64 + 24.0,
                top: HEAD,
                width: width - 48.0,
                height: SIZE[1] - HEAD - FOOT,
            };
            let bodies = run.header.bodies.iter();
            Panel {
                run,
                camera: Camera::fit(&seen, room),
                room,
                surfaces: bodies.map(|body| Surface::of(&body.shape)).collect(),
            }
        };
        Drawing {
            panels: runs.iter().enumerate().map(panel).collect(),
        }
    }

    /// How many frames there are: those of the longest run.
    pub fn frames(&self) -> usize {
        let frames = self.panels.iter().map(|panel| panel.run.frames.len());
        frames.max().unwrap_or(0)
    }

    /// A frame as an SVG document. A run that has ended shows its last one.
    pub fn frame(&self, index: usize) -> String {
        let [width, height] = SIZE;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} \
             {height}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"18\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fcfcfa\"/>\n"
        );
        for panel in &self.panels {
            if let Some(frame) = panel.frame(index) {
                panel.draw(frame, &mut svg);
            }
        }
        svg + "</svg>\n"
    }
}

/// Wires and the middles of bodies that move, in some sixty frames, but for what falls away far from where all
/// started.
fn points(run: &Replay) -> Vec<Point> {
    let Some(first) = run.frames.first() else {
        return Vec::new();
    };
    let of = |frame: &Frame| -> Vec<Point> {
        let bodies = frame.bodies.iter().zip(&first.bodies);
        let moving = bodies.filter(|(now, start)| now != start);
        let middles = moving.map(|(now, _)| Point::new(now[0], now[1], now[2]));
        frame.nodes().map(|(_, node)| node).chain(middles).collect()
    };
    let start = of(first);
    let sum: Vector = start.iter().map(|point| point.coords).sum();
    let middle = Point::from(sum / start.len().max(1) as f64);
    let far = |point: &Point| (point - middle).norm();
    let reach = start.iter().map(far).fold(0.1, f64::max);
    let every = run.frames.len().div_ceil(60);
    let some = run.frames.iter().step_by(every).flat_map(of);
    some.filter(|point| far(point) <= 4.0 * reach).collect()
}

fn extent(points: &[Point]) -> f64 {
    let first = points.first().copied().unwrap_or_default();
    let far = points.iter().map(|point| (point - first).norm());
    far.fold(0.0, f64::max)
}

impl Panel<'_> {
    fn frame(&self, index: usize) -> Option<&Frame> {
        self.run.frames.get(index).or(self.run.frames.last())
    }

    fn draw(&self, frame: &Frame, svg: &mut String) {
        self.draw_bodies(frame, svg);
        self.draw_wires(frame, svg);
        self.draw_marks(frame, svg);
        self.draw_names(frame, svg);
        self.draw_head(frame, svg);
        self.draw_legend(svg);
    }

    /// From the farthest on; of each the polygons that face the eye.
    fn draw_bodies(&self, frame: &Frame, svg: &mut String) {
        let spot = |pose: &[f64; 7]| self.camera.spot(&Point::new(pose[0], pose[1], pose[2]));
        let distance = |k: &usize| spot(&frame.bodies[*k]).map_or(0.0, |spot| spot.distance);
        let mut order: Vec<usize> = (0..frame.bodies.len()).collect();
        order.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
        for body in order {
            if let Some(surface) = self.surfaces.get(body).and_then(Option::as_ref) {
                let colour = self.body_colour(body);
                self.draw_surface(surface, &frame.bodies[body], colour, svg);
            }
        }
    }

    fn body_colour(&self, body: usize) -> &'static str {
        let named = self.run.colours.bodies.get(body).copied().flatten();
        let dynamic = self.run.header.bodies.get(body).is_some_and(|b| b.dynamic);
        named.unwrap_or(if dynamic { "#4c8dbd" } else { "#9aa3ac" })
    }

    fn draw_surface(&self, surface: &Surface, pose: &[f64; 7], colour: &str, svg: &mut String) {
        let [x, y, z, i, j, k, w] = *pose;
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
        let place = |point: &Point| Point::new(x, y, z) + turn * point.coords;
        let points: Vec<Point> = surface.points.iter().map(place).collect();
        *svg += "<g opacity=\"0.6\">\n";
        for polygon in &surface.polygons {
            let [a, b, c] = [0, 1, 2].map(|k| points[polygon[k]]);
            let normal = (b - a).cross(&(c - a));
            let normal = normal.try_normalize(0.0).unwrap_or(Vector::z());
            let facing = self.camera.facing(&normal, &a);
            let spots: Option<Vec<Spot>> = (polygon.iter())
                .map(|k| self.camera.spot(&points[*k]))
                .collect();
            let Some(spots) = spots.filter(|_| facing > 0.0) else {
                continue;
            };
            let corners: Vec<String> = (spots.iter())
                .map(|spot| format!("{:.1},{:.1}", spot.at[0], spot.at[1]))
                .collect();
            let shade = shaded(colour, 0.75 + 0.25 * facing);
            let corners = corners.join(" ");
            line(
                svg,
                format_args!(
                    "<polygon points=\"{corners}\" fill=\"{shade}\" stroke=\"{shade}\" stroke-width=\"0.7\"/>"
                ),
            );
        }
        *svg += "</g>\n";
    }

    fn wire_colour(&self, wire: usize) -> &'static str {
        let named = self.run.colours.wires.get(wire).copied().flatten();
        named.unwrap_or(PALETTE[wire % PALETTE.len()])
    }

    /// Segments, from the farthest on.
    fn draw_wires(&self, frame: &Frame, svg: &mut String) {
        let mut segments: Vec<(usize, [Spot; 2])> = Vec::new();
        let nodes: Vec<(usize, Point)> = frame.nodes().collect();
        for pair in nodes.windows(2) {
            let [(wire, a), (same, b)] = [pair[0], pair[1]];
            let ends = self.camera.spot(&a).zip(self.camera.spot(&b));
            if let Some((a, b)) = ends.filter(|_| wire == same) {
                segments.push((wire, [a, b]));
            }
        }
        let distance = |[a, b]: &[Spot; 2]| a.distance + b.distance;
        segments.sort_by(|(_, a), (_, b)| distance(b).total_cmp(&distance(a)));
        for (wire, [a, b]) in segments {
            let radius = self.run.header.wires[wire].material.radius;
            let width = self
                .camera
                .pixels(2.0 * radius, (a.distance + b.distance) / 2.0);
            let (width, colour) = (width.max(THINNEST), self.wire_colour(wire));
            line(
                svg,
                format_args!(
                    "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"{width:.1}\" \
                 stroke-linecap=\"round\"/>",
                    a.at[0], a.at[1], b.at[0], b.at[1]
                ),
            );
        }
    }

    /// What happened just now, and paler what happened a little ago.
    fn draw_marks(&self, frame: &Frame, svg: &mut String) {
        let ago = |past: &Frame| frame.time - past.time;
        let recent = |past: &&Frame| (0.0..SEEN).contains(&ago(past));
        for past in self.run.frames.iter().filter(recent) {
            for mark in &past.marks {
                let at = mark.at.map(Point::from);
                let spot = at.and_then(|at| self.camera.spot(&at));
                let kind = MARKS.iter().find(|kind| kind.what == mark.what);
                if let Some((Spot { at: [x, y], .. }, kind)) = spot.zip(kind) {
                    let opacity = 1.0 - 0.8 * ago(past) / SEEN;
                    line(
                        svg,
                        format_args!(
                            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"11\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\" opacity=\"{opacity:.2}\"/>",
                            kind.light
                        ),
                    );
                }
            }
        }
    }

    /// Of bodies; a plane is everywhere, and has no place for its name.
    fn draw_names(&self, frame: &Frame, svg: &mut String) {
        let Rectangle {
            left,
            top,
            width,
            height,
        } = self.room;
        let style = "text-anchor=\"middle\" font-size=\"15\" stroke=\"#fcfcfa\" stroke-width=\"3\" paint-order=\"stroke\"";
        let bodies = self.run.names.bodies.iter().zip(&frame.bodies);
        for ((name, pose), surface) in bodies.zip(&self.surfaces) {
            let at = Point::new(pose[0], pose[1], pose[2]);
            let spot = self.camera.spot(&at).filter(|_| surface.is_some());
            let Some(Spot { at: [x, y], .. }) = spot else {
                continue;
            };
            if x > left && x < left + width && y > top && y < top + height {
                text(svg, [x, y], style, name);
            }
        }
    }

    fn draw_head(&self, frame: &Frame, svg: &mut String) {
        let left = self.room.left;
        let how = match &*self.run.how {
            "" => &self.run.title,
            how => how,
        };
        text(svg, [left, 30.0], "font-weight=\"600\"", how);
        let is_last = self
            .run
            .frames
            .last()
            .is_some_and(|last| last.step == frame.step);
        let end = match &self.run.stopped {
            Some(why) if is_last => format!(", {why}"),
            _ => String::new(),
        };
        let clock = format!("{:.3} s{end}", frame.time);
        text(svg, [left, 54.0], "fill=\"#5b6570\"", &clock);
    }

    /// Wires, and what happened in the run so that there are marks of it.
    fn draw_legend(&self, svg: &mut String) {
        let mut x = self.room.left;
        let y = SIZE[1] - 14.0;
        let mut entry = |colour: &str, words: &str| {
            let after = x + 32.0 + 8.6 * words.chars().count() as f64;
            if after > self.room.left + self.room.width {
                return;
            }
            line(
                svg,
                format_args!(
                    "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"16\" height=\"5\" rx=\"2\" fill=\"{colour}\"/>",
                    y - 7.0
                ),
            );
            text(
                svg,
                [x + 21.0, y],
                "font-size=\"14\" fill=\"#5b6570\"",
                words,
            );
            x = after;
        };
        let happened = |what: &str| {
            let mut marks = self.run.frames.iter().flat_map(|frame| &frame.marks);
            marks.any(|mark| mark.what == what)
        };
        for kind in MARKS.iter().filter(|kind| happened(kind.what)) {
            entry(kind.light, kind.words);
        }
        for (wire, name) in self.run.names.wires.iter().enumerate() {
            entry(self.wire_colour(wire), name);
        }
    }
}

/// A colour `#rrggbb`, darker by a factor.
fn shaded(colour: &str, factor: f64) -> String {
    let part = |from: usize| {
        let digits = colour.get(from..from + 2).unwrap_or("80");
        let value = u8::from_str_radix(digits, 16).unwrap_or(0x80);
        (f64::from(value) * factor).round().min(255.0) as u8
    };
    format!("#{:02x}{:02x}{:02x}", part(1), part(3), part(5))
}

fn text(svg: &mut String, [x, y]: [f64; 2], style: &str, words: &str) {
    let words = maud::html! { (words) }.into_string();
    line(
        svg,
        format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{words}</text>"),
    );
}

fn line(svg: &mut String, element: std::fmt::Arguments) {
    // Writing to a string does not fail.
    let _ = writeln!(svg, "{element}");
}
