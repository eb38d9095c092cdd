//! `mesh-step`: the first contact of a mesh, the largest certified step, and the positions to store.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use tunnelproof::Coordinate;
use tunnelproof::certified::{Clearance, Precision};
use tunnelproof::mesh::MeshError;
use tunnelproof_cli::meshes::audit::{Audit, Claims};
use tunnelproof_cli::meshes::{Motion, Position, WritableFormat};
use tunnelproof_cli::report::mesh::{Seconds, StepReport};

use super::keep::{Keep, precision};
use super::output::{JsonOutput, OutputFile};
use super::{Failure, not_negative};

/// Find the first contact of a mesh in motion, and the largest step that is proved to touch nothing
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof mesh-step start.ply end.ply
  tunnelproof mesh-step start.obj end.obj --radius 0.001 --out safe.ply
  tunnelproof mesh-step start.stl end.stl --json - --audit

START and END are one mesh with other positions: .ply (ascii or binary), .obj or .stl (ascii or
binary). Every vertex moves on a straight line. Every edge is compared with every edge, and every
vertex with every face. Parts that share a vertex are left out.

A polygon with more than three corners becomes a fan of triangles around its first corner.
Triangles are numbered in the order of the file, from 0. PLY elements edge (vertex1, vertex2) and
OBJ lines l are edges. The edges of triangles come after them. A vertex in no edge is a point.
An STL holds f32 and has no shared vertices. Corners at the same place in START, in all three
coordinates, become one vertex. They have to be together in END, too.

Exit code 0: nothing touches in the whole step. 1: something does. 3: --audit finds a fault in the
answer, whether something touches or not.")]
pub(super) struct MeshStep {
    /// The mesh at the start of the step
    start: String,
    /// The same mesh at its end
    end: String,
    /// The thickness in metres: contact is a distance of at most R
    #[arg(long, value_name = "R", default_value_t = 0.0, value_parser = not_negative, allow_negative_numbers = true)]
    radius: f64,
    #[command(flatten)]
    keep: Keep,
    /// Store positions in these numbers. With f32, those of both files are rounded to f32 as they are
    /// read
    #[arg(long, value_name = "PRECISION", default_value = "f64", value_parser = precision())]
    precision: Precision,
    /// Write the result to this file, as JSON; - is the standard output, in place of the summary
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
    /// Write the mesh at the positions to store to this file: .ply (binary, 64 bits, or 32 of f32) or
    /// .obj. Not .stl, which holds f32 and has no shared vertices
    #[arg(long, value_name = "SAFE")]
    out: Option<String>,
    /// Ask the exact oracle about every pair whose swept boxes meet, and about the motion to the
    /// positions to store
    #[arg(long)]
    audit: bool,
}

/// The exit code of an answer that the oracle does not confirm: not that of a contact, which is an
/// answer like any other.
const FAULT: u8 = 3;

/// The files to write, seen to be writable.
struct Outputs {
    json: JsonOutput,
    safe: Option<(WritableFormat, OutputFile)>,
}

impl MeshStep {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let motion = Motion::read(&self.start, &self.end, self.precision)?;
        let outputs = self.outputs()?;
        let asked = match self.precision {
            Precision::F32 => self.ask(&motion, |x| x as f32),
            _ => self.ask(&motion, |x| x),
        };
        let (report, positions) = asked.map_err(|error| Failure::file(&self.start, error))?;
        if let Some((format, file)) = outputs.safe {
            file.write_bytes(&format.write(&motion, &positions, self.precision))?;
        }
        outputs.json.write(|| Ok(report.json()), || report.text())?;
        Ok(match (report.has_fault(), report.touches()) {
            (true, _) => ExitCode::from(FAULT),
            (false, true) => ExitCode::FAILURE,
            (false, false) => ExitCode::SUCCESS,
        })
    }

    fn outputs(&self) -> Result<Outputs, Failure> {
        let safe = self.out.as_deref().map(|path| {
            let format = WritableFormat::of_path(path)?;
            Ok::<_, Failure>((format, OutputFile::create(Path::new(path))?))
        });
        let json = self.json.as_deref();
        let same = |json: &&Path| {
            self.out
                .as_deref()
                .is_some_and(|out| Path::new(out) == *json)
        };
        if let Some(path) = json.filter(same) {
            let problem = "--json and --out name the same file";
            return Err(Failure::file(path, problem));
        }
        Ok(Outputs {
            json: JsonOutput::create(json)?,
            safe: safe.transpose()?,
        })
    }

    /// What the engine says of a motion, whose coordinates are numbers of a type already, and what the
    /// oracle says of that; and the positions to store.
    fn ask<C: Coordinate>(
        &self,
        motion: &Motion,
        of: impl Fn(f64) -> C,
    ) -> Result<(StepReport, Vec<Position>), MeshError> {
        let Motion { mesh, start, end } = motion;
        let typed = |all: &[Position]| all.iter().map(|x| x.map(&of)).collect::<Vec<_>>();
        let (start, end) = (&typed(&start.vertices), &typed(end));
        let clearance = self.keep.clearance();
        let clock = Instant::now();
        let first = mesh.first_contact(start, end, self.radius)?;
        let first_seconds = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let step = mesh.step_with_clearance(start, end, self.radius, clearance)?;
        let seconds = Seconds {
            first_contact: first_seconds,
            step: clock.elapsed().as_secs_f64(),
        };
        let audit = self.audit.then(|| {
            let contacts = mesh.all_contacts(start, end, self.radius)?;
            let claims = Claims {
                radius: self.radius,
                clearance: beyond(clearance),
                first: first.as_ref(),
                contacts: &contacts,
                step: &step,
            };
            Ok::<_, MeshError>(Audit::new(motion, &claims))
        });
        let report = StepReport::new(mesh, first.as_ref(), &step, seconds, audit.transpose()?);
        let positions = step.positions.iter();
        let positions = positions.map(|position| position.map(Into::into));
        Ok((report, positions.collect()))
    }
}

/// What all pairs are kept apart beyond the radius.
fn beyond(clearance: Clearance) -> f64 {
    match clearance {
        Clearance::Distance(distance) => distance,
        _ => 0.0,
    }
}
