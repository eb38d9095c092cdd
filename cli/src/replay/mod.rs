//! A run as a page to watch, and as a sequence of pictures: three dimensions, charts and a time line
//! on one clock, of one run or of two. `LIBRARIES.txt` beside this file names the libraries in the
//! page and their licences.

use crate::scenes::Scene;
use crate::simulate::Summary;
use serde::Serialize;
use tunnelproof::wire::recording::Header;
use tunnelproof::wire::{StepRecord, World};

use crate::audit::{Finding, Report};

mod camera;
mod colour;
mod drawing;
mod frame;
mod page;
mod surface;

/// What an audit found, in a line: what there is none of is left out.
fn verdict(report: &Report) -> String {
    let nearer = report.nearer.iter().chain(&report.remeshes_nearer);
    let found = [
        (
            report.missed.iter().sum::<u64>() + report.body_missed + report.core_missed,
            "contacts missed",
        ),
        (
            report.remeshes_through + report.body_remeshes_through,
            "changes that pass",
        ),
        (report.standing.len() as u64, "standing tunnels"),
        (
            (report.body_standing.len() + report.core_standing.len()) as u64,
            "standing in bodies",
        ),
        (report.ambiguous.len() as u64, "ambiguous"),
        (report.jumps + report.astray, "jumps"),
        (nearer.sum(), "nearer than guarded"),
    ];
    let found = found.iter().filter(|(count, _)| *count > 0);
    let found: Vec<String> = found
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    match found.is_empty() {
        true => "nothing passed unnoticed".to_owned(),
        false => found.join(", "),
    }
}

#[cfg(test)]
mod tests;

pub use drawing::Drawing;
pub(crate) use frame::place;
use frame::{Frame, Mark};
pub use page::page;
pub(crate) use surface::Surface;

/// The most frames of a page; of longer runs it shows every second step, or third, and so on.
const MOST_FRAMES: u64 = 2000;

/// A run, step by step.
#[derive(Debug, Serialize)]
pub struct Replay {
    #[serde(skip)]
    title: String,
    /// Of several runs, which this is.
    how: String,
    /// What its audit says.
    #[serde(skip)]
    verdict: String,
    /// Why it has fewer steps than the scene, if it has.
    #[serde(skip)]
    stopped: Option<String>,
    header: Header,
    names: Names,
    colours: Colours,
    frames: Vec<Frame>,
    #[serde(skip)]
    stride: u64,
    /// What happened since the last frame.
    #[serde(skip)]
    marks: Vec<Mark>,
    /// What scripted bodies and reels did so far, in J.
    #[serde(skip)]
    work: f64,
}

/// What wires and bodies are called.
#[derive(Debug, Serialize)]
struct Names {
    wires: Vec<String>,
    bodies: Vec<String>,
}

/// The colours that their names say.
#[derive(Debug, Serialize)]
struct Colours {
    wires: Vec<Option<&'static str>>,
    bodies: Vec<Option<&'static str>>,
}

impl Names {
    fn colours(&self) -> Colours {
        let of = |names: &[String]| names.iter().map(|name| colour::of_name(name)).collect();
        Colours {
            wires: of(&self.wires),
            bodies: of(&self.bodies),
        }
    }
}

impl Replay {
    /// A run of so many steps that is to come. Wires and bodies have numbers.
    pub fn new(title: &str, header: Header, steps: u64) -> Self {
        let numbered = |what, count| (0..count).map(|k| format!("{what} {k}")).collect();
        let names = Names {
            wires: numbered("wire", header.wires.len()),
            bodies: numbered("body", header.bodies.len()),
        };
        Replay {
            title: title.to_owned(),
            how: String::new(),
            verdict: "not audited".to_owned(),
            stopped: None,
            colours: names.colours(),
            names,
            header,
            frames: Vec::new(),
            stride: steps.div_ceil(MOST_FRAMES).max(1),
            marks: Vec::new(),
            work: 0.0,
        }
    }

    /// The same with the names that wires and bodies have in the scene that is run.
    pub fn named_as_in(mut self, scene: &Scene) -> Self {
        self.names = Names {
            wires: scene.wires.iter().map(|wire| wire.name.clone()).collect(),
            bodies: scene.bodies.iter().map(|body| body.name.clone()).collect(),
        };
        self.colours = self.names.colours();
        self
    }

    /// The same, called something, which tells it from a run beside it.
    pub fn called(mut self, how: &str) -> Self {
        how.clone_into(&mut self.how);
        self
    }

    /// Adds the next step.
    pub fn step(&mut self, record: &StepRecord) {
        if self.frames.is_empty() {
            let start = Frame::before(record, self.header.settings.step);
            self.frames.push(start);
        }
        self.marks.extend(frame::marks(record));
        self.work += record.work;
        if (record.step + 1).is_multiple_of(self.stride) {
            let marks = std::mem::take(&mut self.marks);
            let frame = Frame::after(record, self.header.settings.step, marks, self.work);
            self.frames.push(frame);
        }
    }

    /// The same after its last step; without any it shows where the world starts. Says why it stopped, if it did
    /// before its time.
    pub fn ended(mut self, start: &World, summary: &Summary) -> Self {
        if self.frames.is_empty() {
            self.frames.push(Frame::start(start));
        }
        let stopped = summary.stopped.as_ref();
        self.stopped = stopped.map(|why| format!("stopped: {why}"));
        self
    }

    /// The same with what its audit found marked.
    pub fn audited(mut self, report: &Report) -> Self {
        self.verdict = format!("audited: {}", verdict(report));
        let findings = report.findings.iter();
        for finding in findings.filter(|finding| finding.is_tunnel()) {
            self.mark(finding);
        }
        self
    }

    /// Marks the first frame that is not before a finding.
    fn mark(&mut self, finding: &Finding) {
        let shows = |frame: &&mut Frame| frame.step > finding.step;
        if let Some(frame) = self.frames.iter_mut().find(shows) {
            let at = finding.place().as_ref().map(frame::triple);
            let what = if finding.is_jump() {
                "jumped"
            } else {
                "missed"
            };
            frame.marks.push(Mark { what, at });
        }
    }
}
