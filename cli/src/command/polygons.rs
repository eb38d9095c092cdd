//! A folder of files for ParaView.

use std::fs;
use std::path::Path;

use tunnelproof::wire::{StepRecord, World};
use tunnelproof_cli::vtk::{self, Bodies};

use super::Failure;
use super::output::unwritable;

/// A folder of files for ParaView under way.
pub(super) struct Polygons<'a> {
    folder: &'a Path,
    radii: Vec<f64>,
    /// A step in s.
    step: f64,
    bodies: Bodies,
    times: Vec<(u64, f64)>,
}

impl<'a> Polygons<'a> {
    /// Makes the folder.
    pub(super) fn new(folder: &'a Path, world: &World) -> Result<Self, Failure> {
        fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
        let radii = world.wires().iter().map(|wire| wire.material().radius);
        Ok(Polygons {
            folder,
            radii: radii.collect(),
            step: world.settings().step,
            bodies: Bodies::new(world.bodies().iter().map(|body| body.shape())),
            times: Vec::new(),
        })
    }

    /// Writes what is after a step.
    pub(super) fn step(&mut self, record: &StepRecord) -> Result<(), Failure> {
        self.times.push((record.step, record.time));
        let text = vtk::polygons(record, &self.radii, self.step);
        self.write(&vtk::file(record.step), &text)?;
        if self.bodies.is_empty() {
            return Ok(());
        }
        self.write(
            &vtk::bodies_file(record.step),
            &self.bodies.polygons(record),
        )
    }

    /// Puts all steps on their clock.
    pub(super) fn finish(&self) -> Result<(), Failure> {
        let clock = vtk::collection(&self.times, !self.bodies.is_empty());
        self.write("steps.pvd", &clock)
    }

    fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.folder.join(name);
        fs::write(&path, text).map_err(|error| unwritable(&path, error))
    }
}
