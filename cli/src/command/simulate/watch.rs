//! Who looks at every step of `simulate`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use tunnelproof::wire::recording::Recorder;
use tunnelproof::wire::{StepRecord, World};
use tunnelproof_cli::audit::Audit;
use tunnelproof_cli::replay::Replay;
use tunnelproof_cli::simulate::StepTable;

use super::Simulate;
use super::plan::Plan;
use crate::command::Failure;
use crate::command::output::unwritable;
use crate::command::polygons::Polygons;

/// Who looks at every step.
pub(super) struct Watch<'a> {
    recorder: Option<(Recorder<File>, &'a Path)>,
    pub(super) audit: Option<Audit>,
    pub(super) replay: Option<Replay>,
    vtk: Option<Polygons<'a>>,
    table: Option<Table<'a>>,
}

/// A table over time under way.
struct Table<'a> {
    lines: StepTable,
    file: BufWriter<File>,
    path: &'a Path,
}

impl<'a> Watch<'a> {
    pub(super) fn new(options: &'a Simulate, plan: &Plan) -> Result<Self, Failure> {
        let world = &plan.start.world;
        let record = |path: &'a Path| -> Result<_, Failure> {
            let file = File::create(path).map_err(|error| unwritable(path, error))?;
            let recorder =
                Recorder::new(file, world).map_err(|error| Failure::file(path, error))?;
            Ok((recorder, path))
        };
        let is_shown = options.replay.is_some() || options.frames.is_some();
        Ok(Watch {
            vtk: (options.vtk.as_deref())
                .map(|folder| Polygons::new(folder, world))
                .transpose()?,
            recorder: options.record.as_deref().map(record).transpose()?,
            table: options
                .csv
                .as_deref()
                .map(|path| Table::new(path, world))
                .transpose()?,
            audit: options.audit.then(|| Audit::of_world(world)),
            replay: is_shown.then(|| plan.empty_replay(plan.narrow)),
        })
    }

    pub(super) fn step(&mut self, record: &StepRecord) -> Result<(), Failure> {
        if let Some((recorder, path)) = &mut self.recorder {
            recorder
                .record(record)
                .map_err(|error| Failure::file(path, error))?;
        }
        if let Some(audit) = &mut self.audit {
            audit.step(record);
        }
        if let Some(replay) = &mut self.replay {
            replay.step(record);
        }
        if let Some(polygons) = &mut self.vtk {
            polygons.step(record)?;
        }
        if let Some(table) = &mut self.table {
            table.step(record)?;
        }
        Ok(())
    }

    /// Writes what is left to be written.
    pub(super) fn finish(&mut self) -> Result<(), Failure> {
        if let Some(polygons) = &self.vtk {
            polygons.finish()?;
        }
        self.table.as_mut().map_or(Ok(()), Table::finish)
    }
}

impl<'a> Table<'a> {
    fn new(path: &'a Path, world: &World) -> Result<Self, Failure> {
        let file = File::create(path).map_err(|error| unwritable(path, error))?;
        let mut table = Table {
            lines: StepTable::of(world),
            file: BufWriter::new(file),
            path,
        };
        table.write(&StepTable::head())?;
        Ok(table)
    }

    fn step(&mut self, record: &StepRecord) -> Result<(), Failure> {
        let line = self.lines.line(record);
        self.write(&line)
    }

    fn finish(&mut self) -> Result<(), Failure> {
        let end = self.file.flush();
        end.map_err(|error| unwritable(self.path, error))
    }

    fn write(&mut self, text: &str) -> Result<(), Failure> {
        let written = self.file.write_all(text.as_bytes());
        written.map_err(|error| unwritable(self.path, error))
    }
}
