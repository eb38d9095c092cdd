//! Pareto local search (Paquete, Chiarandini, Stützle 2004) on the lattice of settings.
//!
//! From a few settings on, every member of the front is explored once: all settings that differ
//! from it in one threshold are judged, and offered to the front. The search ends when all members
//! are explored. Then no change of a single threshold of any member leads to a setting that the
//! front does not dominate. There is nothing random in it.

use std::collections::{HashMap, HashSet};

use serde::Serialize;

use crate::sweep::{Counts, Interrupted, Part, Sample, Watch};
use tunnelproof_reference::certify::tally::Fault;

use super::front::Front;
use super::lattice::{Lattice, Place};

/// What a setting costs on a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Crossings that get through, of edges and of wires at nodes.
    pub missed_crossings: u64,
    /// Other contacts that are missed.
    pub missed_grazes: u64,
    /// Hits without contact.
    pub false_hits: u64,
    /// The gaps of the false hits together, in metres, by their estimates in floating point.
    pub total_gap: f64,
}

/// A setting and its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The setting.
    pub place: Place,
    /// What it costs.
    pub cost: Cost,
}

/// What is weighed against missed crossings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// The number of false hits.
    Count,
    /// The gaps of the false hits together.
    Gap,
}

impl Aim {
    /// The two numbers that should be small.
    pub fn objectives(self, cost: &Cost) -> [f64; 2] {
        let price = match self {
            Aim::Count => cost.false_hits as f64,
            Aim::Gap => cost.total_gap,
        };
        [cost.missed_crossings as f64, price]
    }
}

impl Cost {
    /// What was counted, with the gaps of the false hits.
    pub fn new(counts: &Counts, sample: &Sample) -> Self {
        Cost {
            missed_crossings: counts.missed_crossings(),
            missed_grazes: counts.count(Fault::MissedGraze),
            false_hits: counts.count(Fault::FalseHit),
            total_gap: counts.total_gap(sample),
        }
    }
}

/// Judges settings of a lattice on some parts of a sample, each once.
pub struct Judge<'a> {
    lattice: Lattice,
    sample: &'a Sample,
    parts: &'a [Part],
    watch: Watch<'a>,
    known: HashMap<Place, Cost>,
}

impl<'a> Judge<'a> {
    /// Nothing is judged yet.
    pub fn new(lattice: Lattice, sample: &'a Sample, parts: &'a [Part], watch: Watch<'a>) -> Self {
        Judge {
            lattice,
            sample,
            parts,
            watch,
            known: HashMap::new(),
        }
    }

    /// The settings.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// How many settings were judged.
    pub fn judged(&self) -> usize {
        self.known.len()
    }

    /// What a setting costs.
    ///
    /// # Errors
    ///
    /// [`Interrupted`] if the watch says so.
    pub fn cost(&mut self, place: Place) -> Result<Cost, Interrupted> {
        if let Some(cost) = self.known.get(&place) {
            return Ok(*cost);
        }
        let setting = self.lattice.setting(place);
        let answer = |query: &_| setting.answer(query);
        let counts = self.sample.judge(&answer, self.parts, &self.watch)?;
        let cost = Cost::new(&counts, self.sample);
        self.known.insert(place, cost);
        Ok(cost)
    }
}

/// The front of the settings whose thresholds that are not `free` are as in one of the starts.
///
/// # Errors
///
/// [`Interrupted`] if the watch of the judge says so.
pub fn search(
    judge: &mut Judge,
    aim: Aim,
    starts: &[Place],
    free: [bool; 5],
) -> Result<Front<Member>, Interrupted> {
    let mut front = Front::default();
    let mut offer = |front: &mut Front<Member>, place| {
        let cost = judge.cost(place)?;
        front.offer(aim.objectives(&cost), Member { place, cost });
        Ok(())
    };
    for &place in starts {
        offer(&mut front, place)?;
    }
    let mut explored = HashSet::new();
    loop {
        let unexplored = |place: &Place| !explored.contains(place);
        let next = front.members().map(|member| member.place).find(unexplored);
        let Some(place) = next else {
            return Ok(front);
        };
        explored.insert(place);
        for place in Lattice::neighbours(place, free) {
            offer(&mut front, place)?;
        }
    }
}
