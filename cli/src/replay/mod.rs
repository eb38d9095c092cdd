//! A run as one page of HTML to watch: three dimensions, charts and a time line on one clock. It
//! needs nothing else, no network; `LIBRARIES.txt` beside this file names the libraries in it and
//! their licences.

use std::collections::BTreeMap;

use crate::scenes::Scene;
use maud::{DOCTYPE, PreEscaped, html};
use serde::Serialize;
use tunnelproof::query::Point;
use tunnelproof::wire::recording::Header;
use tunnelproof::wire::{
    BodyCrossingOutcome, BodyRecord, ContactRecord, ContactSite, CrossingOutcome, NodeKind, Pose,
    StepRecord, Vector, WireRecord,
};

use crate::audit::{Finding, Report};

#[cfg(test)]
mod tests;

/// The most frames of a page; of longer runs it shows every second step, or third, and so on.
const MOST_FRAMES: u64 = 2000;

/// A run, step by step.
#[derive(Debug, Serialize)]
pub struct Replay {
    title: String,
    header: Header,
    /// What wires and bodies are called.
    names: Names,
    frames: Vec<Frame>,
    #[serde(skip)]
    stride: u64,
    /// What happened since the last frame.
    #[serde(skip)]
    events: Events,
}

#[derive(Debug, Serialize)]
struct Names {
    wires: Vec<String>,
    bodies: Vec<String>,
}

/// An instant. Lengths in 0.01 mm, forces in 0.01 N, rounded.
#[derive(Debug, Serialize)]
struct Frame {
    /// In s.
    time: f64,
    #[serde(skip)]
    step: u64,
    /// Nodes of each wire: x, y, z one after the other.
    wires: Vec<Vec<f64>>,
    /// Of each node: f free, p pinned, e eye, c contact.
    kinds: Vec<String>,
    /// Tension of each segment in N.
    tensions: Vec<Vec<f64>>,
    /// Position and quaternion (x, y, z, w) of each body.
    bodies: Vec<[f64; 7]>,
    /// Angular speed of each body in rad/s.
    spin: Vec<f64>,
    /// ContactSite, normal and force on A of each contact.
    contacts: Vec<[f64; 9]>,
    /// Kinetic, potential, elastic, in J.
    energy: [f64; 3],
    /// Pairs of segments that met on their way.
    met: usize,
    /// What happened, by name: `prevented`, `tunnelled`, `returned`, `missed`.
    events: Events,
}

type Events = BTreeMap<&'static str, usize>;

impl Replay {
    /// A run of so many steps that is to come. Wires and bodies have numbers.
    pub fn new(title: &str, header: Header, steps: u64) -> Self {
        let numbered = |what, count| (0..count).map(|k| format!("{what} {k}")).collect();
        Replay {
            title: title.to_owned(),
            names: Names {
                wires: numbered("wire", header.wires.len()),
                bodies: numbered("body", header.bodies.len()),
            },
            header,
            frames: Vec::new(),
            stride: steps.div_ceil(MOST_FRAMES).max(1),
            events: Events::new(),
        }
    }

    /// The same with the names that wires and bodies have in the scene that is run.
    pub fn named_as_in(mut self, scene: &Scene) -> Self {
        self.names = Names {
            wires: scene.wires.iter().map(|wire| wire.name.clone()).collect(),
            bodies: scene.bodies.iter().map(|body| body.name.clone()).collect(),
        };
        self
    }

    /// Adds the next step.
    pub fn step(&mut self, record: &StepRecord) {
        if self.frames.is_empty() {
            let start = Frame::before(record, self.header.settings.step);
            self.frames.push(start);
        }
        for crossing in &record.collisions.crossings {
            let name = match crossing.outcome {
                CrossingOutcome::Prevented => "prevented",
                CrossingOutcome::Tunnelled => "tunnelled",
                CrossingOutcome::Returned => "returned",
                CrossingOutcome::Grazed => continue,
            };
            *self.events.entry(name).or_default() += 1;
        }
        for crossing in &record.collisions.body_crossings {
            let name = match crossing.outcome {
                BodyCrossingOutcome::Prevented => "prevented",
                BodyCrossingOutcome::Passed => "tunnelled",
            };
            *self.events.entry(name).or_default() += 1;
        }
        if (record.step + 1).is_multiple_of(self.stride) {
            let events = std::mem::take(&mut self.events);
            let frame = Frame::after(record, self.header.settings.step, events);
            self.frames.push(frame);
        }
    }

    /// The page. What the audit found is marked on the time line.
    pub fn page(mut self, audit: Option<&Report>) -> serde_json::Result<String> {
        let findings = audit.map_or(&[][..], |audit| &audit.findings);
        for finding in findings.iter().filter(|finding| finding.is_tunnel()) {
            self.mark(finding);
        }
        // No text in it may end the element.
        let run = serde_json::to_string(&self)?.replace('<', "\\u003c");
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    link rel="icon" href="data:,";
                    style { (PreEscaped(include_str!("uplot.min.css"))) (PreEscaped(include_str!("style.css"))) }
                }
                body {
                    header { h1 { (self.title) } p { (self.subtitle(audit)) } p #events {} }
                    div #view { div #legend {} }
                    div #charts {}
                    div #controls {
                        button #play type="button" { "Play" }
                        select #speed aria-label="Speed" {
                            @for (factor, text) in [("0.05", "1/20"), ("0.25", "1/4"), ("1", "1"), ("4", "4")] {
                                option value=(factor) selected[factor == "1"] { "× " (text) }
                            }
                        }
                        div #line {
                            input #time type="range" min="0" value="0" step="1" aria-label="Time";
                            svg #marks viewBox="0 0 1003 10" preserveAspectRatio="none" {}
                        }
                        span #clock {}
                    }
                    script #run type="application/json" { (PreEscaped(run)) }
                    script { (PreEscaped(include_str!("libraries.min.js"))) }
                    script { (PreEscaped(include_str!("page.js"))) }
                }
            }
        };
        Ok(page.into_string() + "\n")
    }

    fn subtitle(&self, audit: Option<&Report>) -> String {
        let step = self.header.settings.step;
        match audit {
            None => format!("step {step:.4} s, not audited"),
            Some(report) if report.is_clean() => {
                format!("step {step:.4} s, audited: nothing passed unnoticed")
            }
            Some(report) => format!(
                "step {step:.4} s, audited: {} contacts missed, {} standing tunnels, {} ambiguous",
                report.missed.iter().sum::<u64>() + report.body_missed,
                report.standing.len() + report.body_standing.len(),
                report.ambiguous.len()
            ),
        }
    }

    /// Marks the first frame that is not before a finding.
    fn mark(&mut self, finding: &Finding) {
        let shows = |frame: &&mut Frame| frame.step > finding.step;
        if let Some(frame) = self.frames.iter_mut().find(shows) {
            *frame.events.entry("missed").or_default() += 1;
        }
    }
}

impl Frame {
    /// Where a step starts.
    fn before(record: &StepRecord, step: f64) -> Self {
        let rest = |body: &BodyRecord| BodyRecord {
            before: body.before,
            between: Vec::new(),
            after: body.before,
        };
        let mut start = record.clone();
        start.contacts.clear();
        start.collisions.pairs.clear();
        start.bodies = record.bodies.iter().map(rest).collect();
        for wire in &mut start.wires {
            wire.after.clone_from(&wire.before);
            wire.tensions.fill(0.0);
        }
        let mut frame = Frame::after(&start, step, Events::new());
        (frame.time, frame.step) = (record.time - step, 0);
        frame
    }

    fn after(record: &StepRecord, step: f64, events: Events) -> Self {
        let flat = |wire: &WireRecord| wire.after.iter().flat_map(triple).collect();
        let energy = &record.energy;
        let met = |said: &&tunnelproof::wire::PairRecord| {
            matches!(said.answer, tunnelproof::wire::PairAnswer::Met { .. })
        };
        Frame {
            time: record.time,
            step: record.step + 1,
            wires: record.wires.iter().map(flat).collect(),
            kinds: record.wires.iter().map(kinds).collect(),
            tensions: (record.wires.iter())
                .map(|wire| wire.tensions.iter().copied().map(cent).collect())
                .collect(),
            bodies: record.bodies.iter().map(|body| pose(&body.after)).collect(),
            spin: record.bodies.iter().map(|body| spin(body, step)).collect(),
            contacts: record
                .contacts
                .iter()
                .map(|contact| drawn(record, contact))
                .collect(),
            energy: [energy.kinetic, energy.potential, energy.elastic].map(cent),
            met: record.collisions.pairs.iter().filter(met).count(),
            events,
        }
    }
}

fn cent(number: f64) -> f64 {
    (number * 100.0).round() / 100.0
}

fn triple(point: &Point) -> [f64; 3] {
    [point.x, point.y, point.z].map(|x| (x * 1e5).round() / 1e5)
}

fn kinds(wire: &WireRecord) -> String {
    let letter = |kind: &NodeKind| match kind {
        NodeKind::Pinned => 'p',
        NodeKind::Eye { .. } => 'e',
        NodeKind::Contact { .. } => 'c',
        // Free, or a kind that the page has no colour for.
        _ => 'f',
    };
    wire.kinds.iter().map(letter).collect()
}

fn pose(pose: &Pose) -> [f64; 7] {
    let [x, y, z] = triple(&pose.position);
    let [i, j, k, w] = pose.orientation.coords.into();
    [x, y, z, i, j, k, w]
}

/// The angle of a step's turn over its time, which is how the stepper turns a body.
fn spin(body: &BodyRecord, step: f64) -> f64 {
    let (mut last, mut angle) = (body.before.orientation, 0.0);
    for pose in body.between.iter().chain([&body.after]) {
        angle += (pose.orientation * last.inverse()).angle();
        last = pose.orientation;
    }
    let spin = angle / step;
    (spin * 1e4).round() / 1e4
}

fn drawn(record: &StepRecord, ContactRecord { contact, force }: &ContactRecord) -> [f64; 9] {
    let at = place(record, &contact.a).or_else(|| place(record, &contact.b));
    let at = triple(&at.unwrap_or(Point::origin()));
    let parts = [
        at,
        contact.normal.into(),
        Vector::from(force.map(cent)).into(),
    ];
    let mut all = [0.0; 9];
    for (to, from) in all.iter_mut().zip(parts.as_flattened()) {
        *to = *from;
    }
    all
}

/// Where a place is after the motion of a step.
pub(crate) fn place(record: &StepRecord, place: &ContactSite) -> Option<Point> {
    match place {
        ContactSite::World => None,
        ContactSite::Body { body, local } => {
            let pose = &record.bodies.get(body.0)?.after;
            Some(pose.position + pose.orientation * local)
        }
        ContactSite::Wire { wire, arc } => {
            let wire = record.wires.get(wire.0)?;
            let next = wire.arcs.partition_point(|node| node <= arc);
            let next = next.clamp(1, wire.arcs.len().checked_sub(1)?);
            let [start, end] = [wire.arcs[next - 1], wire.arcs[next]];
            let share = ((arc - start) / (end - start)).clamp(0.0, 1.0);
            Some(wire.after[next - 1].lerp(&wire.after[next], share))
        }
    }
}
