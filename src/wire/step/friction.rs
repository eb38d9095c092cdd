//! Contacts and friction: projected Gauss-Seidel on 3x3 blocks, in the space of the factor.
//!
//! Contact impulses `lambda` change the contact velocities by `S lambda` with the Schur
//! complement `S = C K^-1 C^T = Y^T D^-1 Y`, `L Y = C^T`. Sweeps do not need `S`: the sum `z = D^-1
//! Y lambda` is kept, and a block reads and writes the few entries of `z` on the path of its points
//! to the root of the elimination tree. So a sweep costs in proportion to the number of contacts.
//! Some dozens of contacts that do not converge in a few sweeps go on with `S` itself
//! ([`Delassus`]): there a sweep is faster, and what sweeps come to can be extrapolated
//! ([`anderson`]).

use std::ops::RangeInclusive;

use super::anderson;
use super::budget::Budget;
use super::carrier::Columns;
use super::contact_blocks::{Blocks, Swept, best_multiple};
use super::delassus::Delassus;
use super::system::System;
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::settings::Settings;
use crate::wire::world::World;

/// How many contacts have their Schur complement formed if they do not converge in
/// [`FIRST_SWEEPS`]. Fewer cost little either way; more are solved by
/// [gradients](super::conjugate_gradients), and swept where that fails.
pub(super) const FORMED: RangeInclusive<usize> = 8..=256;

/// Sweeps that are tried before the Schur complement is formed.
const FIRST_SWEEPS: usize = 10;

/// Contact impulses for the system as factored, from a start on. `free` is the solution
/// without contacts. What is left of the budget limits how many sweeps there are, beyond
/// [`FIRST_SWEEPS`].
///
/// Sweeps with a formed Schur complement come three to ten times as close to the solution; three
/// fifths of the sweeps are enough for them.
pub(super) fn sweep(
    world: &World,
    system: &System,
    contacts: &[ContactConstraint],
    free: &[f64],
    start: &[Vector],
    budget: &mut Budget,
) -> Swept {
    let settings = &world.settings;
    let mut blocks = Blocks::new(world, system, contacts, free, start);
    blocks.scale_to_best();
    let mut swept = Swept::default();
    swept.repeat(settings, FIRST_SWEEPS, || blocks.relax());
    budget.spend(swept.sweeps * blocks.multiplications());
    if !swept.is_done(settings) {
        let [forming, cost] = Delassus::multiplications(&blocks);
        let is_formed =
            FORMED.contains(&contacts.len()) && budget.times(forming + FIRST_SWEEPS * cost) > 0;
        let (most, cost) = if is_formed {
            budget.spend(forming);
            (settings.sweeps * 3 / 5, cost)
        } else {
            (settings.sweeps, blocks.multiplications())
        };
        let limit = most.min(FIRST_SWEEPS + budget.times(cost));
        let limited = Settings {
            sweeps: limit,
            ..settings.clone()
        };
        if is_formed {
            let mut delassus = Delassus::new(&blocks);
            anderson::sweep(&mut delassus, &mut blocks.list, &limited, &mut swept);
            if !swept.is_converged(settings) {
                let scale = best_multiple(&blocks.list, &delassus.excess);
                for block in &mut blocks.list {
                    block.impulse *= scale;
                }
            }
        } else {
            swept.repeat(&limited, usize::MAX, || blocks.relax());
            if !swept.is_converged(settings) {
                blocks.scale_to_best();
            }
        }
        budget.spend((swept.sweeps - FIRST_SWEEPS) * cost);
        swept.is_cut = limit < most && !swept.is_converged(settings);
    }
    for block in &blocks.list {
        let impulse = block.frame.tr_mul(&block.impulse);
        for (carrier, weight) in &block.terms {
            let mut columns = Columns::new();
            carrier.columns(&(impulse * *weight), &mut columns);
            swept.columns.extend(columns);
        }
        swept.impulses.push(impulse);
    }
    swept
}

/// The largest change of a contact's velocity, in m/s, that one more sweep from these impulses
/// would make.
pub(super) fn contact_residual(
    world: &World,
    system: &System,
    contacts: &[ContactConstraint],
    free: &[f64],
    impulses: &[Vector],
) -> f64 {
    Blocks::new(world, system, contacts, free, impulses).relax()
}

#[cfg(test)]
mod tests;
