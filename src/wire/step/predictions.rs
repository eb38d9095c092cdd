//! What is predicted of contacts and chains, from one solution to the next.
//!
//! Each solution has impulses, which are the next prediction. In the matrix, laws become harder with each
//! one, so that a few are enough. By conjugate gradients they keep their softness, and what a stiff wire
//! carries comes closer by little at each: there the next prediction is [extrapolated](super::anderson).

use super::anderson::{History, Sample};
use super::rows::Softened;
use super::system::{ContactMethod, System};
use crate::wire::Vector;

/// Predictions that are taken as they come, before any is extrapolated: the first ones find out what
/// touches.
const PLAIN: usize = 2;

/// The predictions of a solve.
pub(super) struct Predictions {
    count: usize,
    history: History,
    /// The unit of each predicted number, in which a change moves what it belongs to alike.
    units: Vec<f64>,
}

impl Predictions {
    pub(super) fn new(system: &System) -> Self {
        let contacts = system.implicit.iter();
        let contacts = contacts.flat_map(|contact| [contact.mobility(); 3]);
        let chains = softened(system).map(|soft| soft.softness.mobility);
        Predictions {
            count: 0,
            history: History::default(),
            units: contacts.chain(chains).map(f64::sqrt).collect(),
        }
    }

    /// Makes the next one, after a solution.
    pub(super) fn update(&mut self, system: &mut System, x: &[f64]) {
        self.count += 1;
        let is_extrapolated = system.method == ContactMethod::ByGradients;
        let before = if is_extrapolated {
            values(system)
        } else {
            Vec::new()
        };
        for row in &mut system.rows {
            row.update_prediction(x);
        }
        for contact in &mut system.implicit {
            contact.update_prediction(x);
        }
        if !is_extrapolated {
            system.rows.iter_mut().for_each(|row| row.harden());
            let contacts = system.implicit.iter_mut();
            contacts.for_each(|contact| contact.harden());
            return;
        }
        let values = values(system);
        let changes = values.iter().zip(&before).zip(&self.units);
        let changes = changes.map(|((after, before), unit)| unit * (after - before));
        let changes = changes.collect();
        let mut sample = Sample { changes, values };
        self.history.learn(&sample);
        if self.count > PLAIN {
            self.history.extrapolate(&mut sample);
            predict(system, &sample.values);
        }
    }
}

/// All that is predicted: impulses of contacts, then multipliers of chains.
fn values(system: &System) -> Vec<f64> {
    let contacts = system.implicit.iter().flat_map(|contact| {
        let impulse = contact.prediction();
        [impulse.x, impulse.y, impulse.z]
    });
    let chains = softened(system).map(|soft| soft.predicted);
    contacts.chain(chains).collect()
}

/// Predicts the same, within what the laws allow.
fn predict(system: &mut System, values: &[f64]) {
    let (impulses, multipliers) = values.split_at(3 * system.implicit.len());
    for (contact, impulse) in system.implicit.iter_mut().zip(impulses.chunks_exact(3)) {
        contact.predict(&Vector::from_column_slice(impulse));
    }
    let chains = system
        .rows
        .iter_mut()
        .filter_map(|row| row.softened.as_mut());
    for (soft, multiplier) in chains.zip(multipliers) {
        soft.predict(*multiplier);
    }
}

fn softened(system: &System) -> impl Iterator<Item = &Softened> {
    system.rows.iter().filter_map(|row| row.softened.as_ref())
}
