//! Contacts as blocks of three rows: their mobility, and one sweep of projected Gauss-Seidel over
//! them.

use std::ops::Range;

use nalgebra::Matrix3;
use smallvec::SmallVec;

use super::carrier::{Carrier, Columns, velocity_of};
use super::coulomb::{Mobility, solve_block};
use super::rows::normal_row;
use super::system::System;
use crate::wire::contact::ContactConstraint;
use crate::wire::settings::Settings;
use crate::wire::sparse::SparseColumns;
use crate::wire::vector::{Vector, frame};
use crate::wire::world::World;

/// One contact as a block of three rows: normal and two tangents.
pub(super) struct Block {
    /// Normal and tangents.
    pub(super) frame: Matrix3<f64>,
    pub(super) terms: SmallVec<[(Carrier, f64); 4]>,
    /// Where its path is.
    pub(super) path: Range<usize>,
    /// `Y^T D^-1 Y`, with the regularisation of the normal row.
    pub(super) mobility: Mobility,
    sigma: f64,
    /// Velocity without contact impulses, less what is asked for.
    pub(super) bias: Vector,
    pub(super) friction: f64,
    pub(super) impulse: Vector,
}

/// What the sweeps came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Swept {
    /// Impulse of each contact on its place A, along x, y, z, in N s.
    pub(super) impulses: Vec<Vector>,
    /// The same as columns and values, both places.
    pub(super) columns: Vec<(usize, f64)>,
    /// Sweeps done.
    pub(super) sweeps: usize,
    /// The largest change of a contact's velocity in the last sweep, in m/s.
    pub(super) residual: f64,
    /// Whether there was too little to spend on as many sweeps as are set.
    pub(super) is_cut: bool,
}

impl Swept {
    /// Whether the contacts have converged, or there are no more sweeps.
    pub(super) fn is_done(&self, settings: &Settings) -> bool {
        self.is_converged(settings) || self.sweeps >= settings.sweeps
    }

    /// Whether the last sweep changed no more than is tolerated.
    pub(super) fn is_converged(&self, settings: &Settings) -> bool {
        self.sweeps > 0 && self.residual <= settings.contact_tolerance
    }

    /// Sweeps until it is done, at most `most` times.
    pub(super) fn repeat(
        &mut self,
        settings: &Settings,
        most: usize,
        mut sweep: impl FnMut() -> f64,
    ) {
        let end = self.sweeps.saturating_add(most);
        while self.sweeps < end && !self.is_done(settings) {
            self.residual = sweep();
            self.sweeps += 1;
        }
    }
}

/// All contacts, and what their impulses sum up to.
pub(super) struct Blocks {
    pub(super) list: Vec<Block>,
    pub(super) paths: Paths,
}

/// The ways of contacts to the root of the elimination tree, one after the other, as sweeps go
/// through them: rows, and what `Y` has there.
pub(super) struct Paths {
    rows: Vec<u32>,
    values: Vec<[f64; 3]>,
    /// Of every row of the factor.
    factor: Vec<Entry>,
}

/// What sweeps need of a row of the factor, side by side.
#[derive(Clone, Copy)]
struct Entry {
    /// `D^-1 Y lambda`.
    z: f64,
    /// `D`.
    pivot: f64,
}

impl Blocks {
    pub(super) fn new(
        world: &World,
        system: &System,
        contacts: &[ContactConstraint],
        free: &[f64],
        impulses: &[Vector],
    ) -> Self {
        let pivots = system.pivots().iter();
        let mut paths = Paths {
            rows: Vec::new(),
            values: Vec::new(),
            factor: pivots.map(|&pivot| Entry { z: 0.0, pivot }).collect(),
        };
        let list = contacts.iter().zip(impulses).map(|(contact, impulse)| {
            let block = Block::new(world, system, contact, free, impulse, &mut paths);
            paths.push(&block.path, &block.impulse);
            block
        });
        let list = list.collect();
        Blocks { list, paths }
    }

    /// Takes the multiple of all impulses that is best, at most 1: a start that does not suit these
    /// contacts, or sweeps that do not converge, may have more energy in them than there is.
    pub(super) fn scale_to_best(&mut self) {
        let excess = self.list.iter().map(|block| block.excess(&self.paths));
        let excess: Vec<f64> = excess.flat_map(|e| [e.x, e.y, e.z]).collect();
        let scale = best_multiple(&self.list, &excess);
        if scale < 1.0 {
            for block in &mut self.list {
                block.impulse *= scale;
            }
            for entry in &mut self.paths.factor {
                entry.z *= scale;
            }
        }
    }

    /// Multiplications of a sweep, about.
    pub(super) fn multiplications(&self) -> usize {
        /// Of a contact, beside its path.
        const OWN: usize = 100;
        6 * self.paths.rows.len() + OWN * self.list.len()
    }

    /// Rows of the factor.
    pub(super) fn rows(&self) -> usize {
        self.paths.factor.len()
    }

    /// Rows, values and pivots on the path of a block.
    pub(super) fn path(&self, block: &Block) -> impl Iterator<Item = (u32, [f64; 3], f64)> {
        let entries = self.paths.entries(&block.path);
        entries.map(|(row, &three)| (row, three, self.paths.factor[row as usize].pivot))
    }

    /// One sweep; by how much the velocity of a contact changes at most, in m/s.
    pub(super) fn relax(&mut self) -> f64 {
        let mut largest = 0.0_f64;
        for block in &mut self.list {
            let change = block.solve(&block.excess(&self.paths));
            self.paths.push(&block.path, &change);
            largest = largest.max((block.mobility.matrix() * change).amax());
        }
        largest
    }
}

/// The multiple of all impulses `l`, from 0 to 1, at which `l . (S l / 2 + b)` is least, from
/// velocities less what is asked for, `S l + b`. At a solution of Coulomb's law with these
/// directions it is 1: what pushes has `u = 0`, and friction takes energy.
pub(super) fn best_multiple(blocks: &[Block], excess: &[f64]) -> f64 {
    let pairs = blocks.iter().zip(excess.chunks_exact(3));
    let (curved, linear) = pairs.fold((0.0, 0.0), |(curved, linear), (block, excess)| {
        let due = block.impulse.dot(&block.bias);
        let now = block.impulse.dot(&Vector::from_column_slice(excess));
        (curved + now - due, linear + due)
    });
    best_fraction(curved, linear)
}

/// Where `curved s^2 / 2 + linear s` is least from 0 to 1; 0 if that is not finite.
pub(super) fn best_fraction(curved: f64, linear: f64) -> f64 {
    if !(curved.is_finite() && linear.is_finite()) {
        0.0
    } else if curved > 0.0 {
        (-linear / curved).clamp(0.0, 1.0)
    } else if linear <= 0.0 {
        1.0
    } else {
        0.0
    }
}

impl Paths {
    /// Takes the next path; where it is.
    fn add(&mut self, path: SparseColumns) -> Range<usize> {
        let start = self.rows.len();
        self.rows.extend(path.rows);
        self.values.extend(path.values);
        start..self.rows.len()
    }

    fn entries(&self, path: &Range<usize>) -> impl Iterator<Item = (u32, &[f64; 3])> {
        let rows = self.rows[path.clone()].iter().copied();
        rows.zip(&self.values[path.clone()])
    }

    /// Adds `D^-1 Y impulse` to `z`.
    pub(super) fn push(&mut self, path: &Range<usize>, impulse: &Vector) {
        let rows = &self.rows[path.clone()];
        for (&row, three) in rows.iter().zip(&self.values[path.clone()]) {
            let sum = three[0] * impulse.x + three[1] * impulse.y + three[2] * impulse.z;
            let entry = &mut self.factor[row as usize];
            entry.z += sum / entry.pivot;
        }
    }
}

impl Block {
    fn new(
        world: &World,
        system: &System,
        contact: &ContactConstraint,
        free: &[f64],
        impulse: &Vector,
        paths: &mut Paths,
    ) -> Self {
        let frame = frame(&contact.normal);
        let terms = system.layout.contact(world, contact);
        let path = paths.add(system.forward(&columns(&frame, &terms)));
        let mut mobility = Matrix3::zeros();
        for (at, three) in paths.entries(&path) {
            let row = Vector::from_row_slice(three);
            mobility += row * row.transpose() / paths.factor[at as usize].pivot;
        }
        let speed = velocity_of(world, &contact.a) - velocity_of(world, &contact.b);
        let [target, sigma] = normal_row(&world.settings, contact, speed.dot(&contact.normal));
        mobility[(0, 0)] += sigma;
        let velocity: Vector = terms
            .iter()
            .map(|(carrier, weight)| carrier.velocity(free) * *weight)
            .sum();
        Block {
            bias: frame * velocity - Vector::new(target, 0.0, 0.0),
            impulse: frame * impulse,
            friction: contact.friction,
            frame,
            terms,
            path,
            mobility: Mobility::new(mobility),
            sigma,
        }
    }

    /// Velocity less what is asked for, at the impulses so far.
    pub(super) fn excess(&self, paths: &Paths) -> Vector {
        let mut sum = self.bias;
        sum.x += self.sigma * self.impulse.x;
        for (row, three) in paths.entries(&self.path) {
            sum += Vector::from_row_slice(three) * paths.factor[row as usize].z;
        }
        sum
    }

    /// Solves the block with all others held, from its velocity less what is asked for; by how much
    /// its impulse changes.
    pub(super) fn solve(&mut self, excess: &Vector) -> Vector {
        let others = excess - self.mobility.matrix() * self.impulse;
        let impulse = solve_block(&self.mobility, &others, self.friction, &self.impulse);
        let change = impulse - self.impulse;
        self.impulse = impulse;
        change
    }
}

/// The three rows of a contact by columns.
fn columns(
    frame: &Matrix3<f64>,
    terms: &SmallVec<[(Carrier, f64); 4]>,
) -> SmallVec<[(usize, [f64; 3]); 24]> {
    let mut all: SmallVec<[(usize, [f64; 3]); 24]> = SmallVec::new();
    for (carrier, weight) in terms {
        let rows = [0, 1, 2].map(|row| {
            let mut columns = Columns::new();
            let direction = frame.row(row).transpose() * *weight;
            carrier.columns(&direction, &mut columns);
            columns
        });
        let entries = (0..rows[0].len()).map(|i| (rows[0][i].0, [0, 1, 2].map(|r| rows[r][i].1)));
        all.extend(entries);
    }
    all
}
