//! The Schur complement of contacts as a dense matrix.
//!
//! Contact velocities `u = S lambda + b` are kept up to date: a block that changes adds
//! its three columns to them, and one that does not costs nothing. It bears the name of E. Delassus
//! (1917).

use super::contact_blocks::{Block, Blocks};
use crate::wire::Vector;
use crate::wire::sparse::sorted_by_key;

/// `u = S lambda + b` of all contacts.
pub(super) struct Delassus {
    /// `S` by columns, with the regularisation of normal rows on the diagonal.
    matrix: Vec<f64>,
    /// `u`: velocities less what is asked for.
    pub(super) excess: Vec<f64>,
}

impl Delassus {
    /// For the impulses that the blocks have.
    pub(super) fn new(blocks: &Blocks) -> Self {
        let list = &blocks.list;
        let biases = list
            .iter()
            .flat_map(|block| [block.bias.x, block.bias.y, block.bias.z]);
        let mut delassus = Delassus {
            matrix: vec![0.0; 9 * list.len() * list.len()],
            excess: biases.collect(),
        };
        delassus.fill(blocks);
        for (at, block) in list.iter().enumerate() {
            delassus.push(at, &block.impulse);
        }
        delassus
    }

    /// Multiplications that it takes to form it, at most, and of a sweep.
    pub(super) fn multiplications(blocks: &Blocks) -> [usize; 2] {
        let contacts = blocks.list.len();
        [blocks.multiplications() * contacts, 9 * contacts * contacts]
    }

    /// `Y^T D^-1 Y`, row by row of the factor: every two blocks that have it on their paths.
    fn fill(&mut self, blocks: &Blocks) {
        let n = 3 * blocks.list.len();
        let mut visits = Vec::new();
        for (at, block) in blocks.list.iter().enumerate() {
            let path = blocks.path(block);
            visits.extend(path.map(|(row, three, pivot)| (row, at, three, pivot)));
        }
        let order = 0..visits.len() as u32;
        let order = sorted_by_key(blocks.rows(), order, |visit| visits[visit as usize].0);
        let row = |visit: &u32| visits[*visit as usize].0;
        for of_row in order.chunk_by(|visit, next| row(visit) == row(next)) {
            for (k, &visit) in of_row.iter().enumerate() {
                let (_, a, three, pivot) = visits[visit as usize];
                let scaled = three.map(|value| value / pivot);
                for &visit in &of_row[..k] {
                    let (_, b, other, _) = visits[visit as usize];
                    for (column, scaled) in scaled.iter().enumerate() {
                        let start = (3 * a + column) * n + 3 * b;
                        for (sum, value) in self.matrix[start..start + 3].iter_mut().zip(other) {
                            *sum += scaled * value;
                        }
                    }
                }
            }
        }
        self.mirror(&blocks.list);
    }

    /// What is above the diagonal goes below, too; on it are the mobilities of the blocks.
    fn mirror(&mut self, blocks: &[Block]) {
        let n = 3 * blocks.len();
        for column in 0..n {
            for row in 0..column - column % 3 {
                self.matrix[row * n + column] = self.matrix[column * n + row];
            }
        }
        for (at, block) in blocks.iter().enumerate() {
            for column in 0..3 {
                let start = (3 * at + column) * n + 3 * at;
                let mobility = block.mobility.matrix().column(column);
                self.matrix[start..start + 3].copy_from_slice(mobility.as_slice());
            }
        }
    }

    /// Changes the impulse of a block.
    pub(super) fn push(&mut self, at: usize, change: &Vector) {
        if change.iter().all(|component| *component == 0.0) {
            return;
        }
        let n = self.excess.len();
        let (x, rest) = self.matrix[3 * at * n..(3 * at + 3) * n].split_at(n);
        let (y, z) = rest.split_at(n);
        for (((sum, x), y), z) in self.excess.iter_mut().zip(x).zip(y).zip(z) {
            *sum += x * change.x + y * change.y + z * change.z;
        }
    }

    /// One sweep; by how much the velocity of a contact changes at most, in m/s.
    pub(super) fn relax(&mut self, blocks: &mut [Block]) -> f64 {
        let mut largest = 0.0_f64;
        for (at, block) in blocks.iter_mut().enumerate() {
            let excess = &self.excess[3 * at..3 * at + 3];
            let change = block.solve(&Vector::from_column_slice(excess));
            self.push(at, &change);
            largest = largest.max((block.mobility.matrix() * change).amax());
        }
        largest
    }
}
