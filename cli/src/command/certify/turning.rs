//! Families of bodies that turn, judged in a run of their own.

use std::process::ExitCode;

use tunnelproof_reference::certify::rigid::{RigidBlock, RigidPanel, RigidSource, failures, text};
use tunnelproof_reference::registry::{SECOND_OF_TURNS, turning_subjects};
use tunnelproof_reference::subject::RigidSubject;

use super::Certify;
use crate::command::output::print;
use crate::command::subjects::AnsweringTurns;
use crate::command::{Failure, progress};

impl Certify {
    pub(super) fn run_turning(self) -> Result<ExitCode, Failure> {
        self.refuse_with_turning()?;
        let mut answering = self.programs.start_all_turning(&self.subject)?;
        self.permit.grant_turning(&mut answering)?;
        let second = turning_subjects();
        let second = second.iter().find(|known| known.name == SECOND_OF_TURNS);
        let panel = RigidPanel {
            second: match self.one_judge {
                true => None,
                false => second.map(|second| second as &dyn RigidSubject),
            },
            subjects: answering.iter().map(AnsweringTurns::subject).collect(),
        };
        let blocks = self.judge_turning(&panel);
        print(&text(&panel, self.seed, &blocks, self.certificate.shown()))?;
        let mut total = RigidBlock::default();
        blocks.into_iter().for_each(|block| total.merge(block));
        let failures = failures(&panel, &total);
        if !self.certificate.strict || failures.is_empty() {
            return Ok(ExitCode::SUCCESS);
        }
        failures
            .iter()
            .for_each(|failure| eprintln!("--strict: {failure}"));
        Ok(ExitCode::FAILURE)
    }

    fn judge_turning(&self, panel: &RigidPanel) -> Vec<RigidBlock> {
        let families = self.turning_families();
        let progress = progress::of(families.len() as u64 * self.count);
        let judged = families.into_iter().map(|family| {
            progress.set_message(family.name());
            let source = RigidSource {
                family,
                seed: self.seed,
                count: self.count,
            };
            panel.run(source, |judged| progress.inc(judged))
        });
        let blocks = judged.collect();
        progress.finish_and_clear();
        blocks
    }

    /// What such a run cannot have.
    fn refuse_with_turning(&self) -> Result<(), Failure> {
        let problem = match () {
            () if self.count == 0 => return Err(Failure::Nothing),
            () if !self.linear_families().is_empty() => {
                "and other families are judged in a run each"
            }
            () if !self.files.is_empty() => "and files are judged in a run each",
            () if self.shrink => "have no --shrink",
            () if !self.shard.is_whole() => "have no --shard",
            () if self.resume || self.certificate.has_file() => {
                "have no --json, --html, --junit and --badge"
            }
            () => return Ok(()),
        };
        Err(Failure::File {
            path: "--family".to_owned(),
            problem: format!("families of bodies that turn {problem}"),
        })
    }
}
