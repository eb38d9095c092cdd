//! All that was found, and of what.

use crate::program::Conduct;

use super::block::Block;
use super::caller::Caller;
use super::run::Panel;
use super::shard::Shard;
use super::tally::Tally;

/// What was judged, by whom, and what came of it.
pub struct Findings<'a> {
    /// Who judged and who was judged.
    pub panel: Panel<'a>,
    /// What they were judged on.
    pub settings: Settings,
    /// What was found on each source.
    pub blocks: Vec<Block>,
    /// The same over all of them.
    pub total: Block,
    /// What the subjects that are programs did besides answering, by their names.
    pub programs: Vec<(String, Conduct)>,
}

/// What is judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The command that judges all of it again.
    pub command: String,
    /// Who asked, which says what a command that explains a find looks like.
    pub caller: Caller,
    /// The seed of the families.
    pub seed: u64,
    /// How many queries of each family.
    pub count: u64,
    /// Which part of the queries was judged.
    pub shard: Shard,
}

impl Settings {
    /// Whether the same is judged in the same way, but for which part of the queries, and wherever the
    /// program was started from.
    pub fn are_of_same_certification(&self, other: &Settings) -> bool {
        let parts = |settings: &Settings| (settings.own_command(), settings.seed, settings.count);
        parts(self) == parts(other) && self.caller.asks_as(&other.caller)
    }

    /// The command without what it begins with.
    fn own_command(&self) -> String {
        let own = match &self.caller {
            Caller::Shell { program, .. } => self.command.strip_prefix(program.as_str()),
            Caller::Test | Caller::Python => None,
        };
        own.unwrap_or(&self.command).to_owned()
    }
}

impl<'a> Findings<'a> {
    /// What was found on each source, and on all of them together.
    pub fn new(
        panel: Panel<'a>,
        settings: Settings,
        blocks: Vec<Block>,
        programs: Vec<(String, Conduct)>,
    ) -> Self {
        let mut total = Block {
            name: "all".to_owned(),
            ..Block::default()
        };
        blocks.iter().for_each(|block| total.merge(block.clone()));
        total
            .tallies
            .resize_with(panel.subjects.len(), Tally::default);
        let subjects = panel.subjects.iter().zip(&mut total.tallies);
        for (judged, tally) in subjects {
            let own = programs
                .iter()
                .find(|(name, _)| name == judged.subject.name());
            tally.surplus = own.map_or(0, |(_, conduct)| conduct.surplus);
        }
        Findings {
            panel,
            settings,
            blocks,
            total,
            programs,
        }
    }
}
