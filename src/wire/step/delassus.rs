//! The Schur complement of contacts as a dense matrix.
//!
//! Contact velocities `u = S lambda + b` are kept up to date: a block that changes adds its three columns to them, and
//! one that does not costs nothing. It bears the name of E. Delassus (1917).

use super::friction::Block;
use crate::wire::Vector;

/// `u = S lambda + b` of all contacts.
pub(super) struct Delassus {
    /// `S` by columns, with the regularisation of normal rows on the diagonal.
    matrix: Vec<f64>,
    /// `u`: velocities less what is asked for.
    pub(super) excess: Vec<f64>,
}

impl Delassus {
    /// For the impulses that the blocks have.
    pub(super) fn new(blocks: &[Block]) -> Self {
        let biases = blocks
            .iter()
            .flat_map(|block| [block.bias.x, block.bias.y, block.bias.z]);
        let mut delassus = Delassus {
            matrix: vec![0.0; 9 * blocks.len() * blocks.len()],
            excess: biases.collect(),
        };
        delassus.fill(blocks);
        for (at, block) in blocks.iter().enumerate() {
            delassus.push(at, &block.impulse);
        }
        delassus
    }

    /// `Y^T D^-1 Y`, row by row of the factor: every two blocks that have it on their paths.
    fn fill(&mut self, blocks: &[Block]) {
        let n = 3 * blocks.len();
        let mut visits: Vec<(u32, usize, usize)> = Vec::new();
        for (at, block) in blocks.iter().enumerate() {
            let rows = block.sparse.rows.iter().enumerate();
            visits.extend(rows.map(|(place, &row)| (row, at, place)));
        }
        visits.sort_unstable();
        for visits in visits.chunk_by(|(row, ..), (other, ..)| row == other) {
            for (k, &(_, a, place)) in visits.iter().enumerate() {
                let pivot = blocks[a].pivots[place];
                let scaled = blocks[a].sparse.values[place].map(|value| value / pivot);
                for &(_, b, place) in &visits[..k] {
                    let other = &blocks[b].sparse.values[place];
                    for (column, scaled) in scaled.iter().enumerate() {
                        let start = (3 * a + column) * n + 3 * b;
                        for (sum, value) in self.matrix[start..start + 3].iter_mut().zip(other) {
                            *sum += scaled * value;
                        }
                    }
                }
            }
        }
        self.mirror(blocks);
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
                let mobility = block.mobility.column(column);
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
            largest = largest.max((block.mobility * change).amax());
        }
        largest
    }
}
