//! `explain`: one query, its exact answer, what everyone says of it, and a picture.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use tunnelproof_cli::report::{self, cast, picture};
use tunnelproof_reference::boxes::BoxId;
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::turning;
use tunnelproof_reference::oracle::{decide_query, decide_rigid_query};
use tunnelproof_reference::registry;
use tunnelproof_reference::report::boxes;
use tunnelproof_reference::report::explanation::Explanation;

use super::output::{OutputFile, print};
use super::subjects::{Answering, AskedList, Permit, Programs, asked_list, check_turning};
use super::{Failure, Reading, certify};

/// Explain the exact answer to one query, and what every subject says
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof explain figure:4.3
  tunnelproof explain lattice:1:4711 --svg picture.svg
  tunnelproof explain turning_plates:1:6 --svg picture.svg
  tunnelproof explain cast_box_lattice:1:3 --svg picture.svg
  tunnelproof explain 'unit-tests/edge-edge/data_0_1.csv#12'
  tunnelproof explain vectors/errata.json#erratum:strict-skip --svg picture.svg
  head -1 queries.jsonl | tunnelproof explain -")]
pub(super) struct Explain {
    /// figure:NAME, FAMILY:SEED:INDEX, PATH.csv#INDEX, PATH.jsonl#ID, PATH.json#ID of a test
    /// vector, or
    /// - for a line on the standard input
    query: String,
    /// Write a picture to this file
    #[arg(long, value_name = "OUT")]
    svg: Option<PathBuf>,
    /// More subjects to ask, such as cmd: and the command of a program
    #[arg(long, value_parser = asked_list)]
    subject: Vec<AskedList>,
    /// PATH#ID and - are of queries of bodies that turn; families of them are known by name
    #[arg(long, conflicts_with_all = ["kind", "radius"])]
    turning: bool,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    #[command(flatten)]
    reading: Reading,
}

impl Explain {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        if let Some(id) = BoxId::parse(&self.query) {
            self.reading.check_unused(&self.query, "a cast of a box")?;
            return self.run_box(&id.map_err(|error| Failure::file(&self.query, error))?);
        }
        if self.reading.is_turning(self.turning, &self.query)? {
            return self.run_turning();
        }
        let entry = locate(&self.query, self.reading.options())?;
        let svg = self.svg.as_deref().map(OutputFile::create).transpose()?;
        let mut more = self.programs.start_all(&self.subject)?;
        self.permit.grant(&mut more)?;
        let subjects = registry::subjects().into_iter();
        // The known ones are asked without being named.
        let programs = more.iter().filter(|more| more.program().is_some());
        let subjects = subjects.chain(programs.map(Answering::subject));
        let subjects: Vec<_> = subjects.map(certify::judged).collect();
        let text = format!(
            "{}\n\n{}",
            entry.id,
            Explanation::new(&entry.query, &subjects)
        );
        if let Some(file) = svg {
            let answer = decide_query(&entry.query);
            file.write(&picture::draw(&entry.id, &entry.query, &answer))?;
        }
        print(&text)?;
        Ok(ExitCode::SUCCESS)
    }

    /// The numbers of a cast of a box, and its exact answer; programs are not asked.
    fn run_box(&self, id: &BoxId) -> Result<ExitCode, Failure> {
        if !self.subject.is_empty() {
            let problem = "is a cast of a box, about which nobody is asked: certify-boxes asks";
            return Err(Failure::file(&self.query, problem));
        }
        self.programs.check_used(&[])?;
        self.permit.grant(&mut [])?;
        let svg = self.svg.as_deref().map(OutputFile::create).transpose()?;
        let cast = id.cast();
        let answer = tunnelproof_reference::boxes::decide(&cast);
        if let Some(file) = svg {
            file.write(&cast::draw(&self.query, &cast, &answer))?;
        }
        print(&boxes::explain(id, &answer))?;
        Ok(ExitCode::SUCCESS)
    }

    /// The same of a body that turns.
    fn run_turning(self) -> Result<ExitCode, Failure> {
        let entry = turning::locate(&self.query)?;
        let svg = self.svg.as_deref().map(OutputFile::create).transpose()?;
        let answer = decide_rigid_query(&entry.query);
        if let Some(file) = svg {
            file.write(&picture::draw_turning(&entry.id, &entry.query, &answer))?;
        }
        let mut more = self.programs.start_all(&self.subject)?;
        self.permit.grant(&mut more)?;
        check_turning(&more)?;
        let programs = more.iter().filter(|more| more.program().is_some());
        let subjects = registry::turning_subjects().into_iter();
        let subjects = subjects.chain(programs.map(Answering::subject));
        let subjects: Vec<_> = subjects.map(certify::judged).collect();
        print(&report::turning::explain(&entry, &answer, &subjects))?;
        Ok(ExitCode::SUCCESS)
    }
}
