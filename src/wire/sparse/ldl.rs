//! `A = L D L^T` of a sparse quasi-definite matrix, row by row, without pivoting.
//!
//! A symmetric matrix `[[H, G^T], [G, -S]]` with `H` and `S` positive definite has such a
//! factorisation in every order of elimination (Vanderbei, SIAM J. Optim. 5, 1995). The algorithm
//! is the up-looking one of Davis (ACM TOMS 31, 2005): row `k` of `L` solves a triangular system
//! with the rows before it, whose pattern is read off the elimination tree.

use super::Symmetric;

/// No parent: the root of an elimination tree.
const ROOT: u32 = u32::MAX;

/// A factorisation: its structure, which depends on the pattern of the matrix alone, and its
/// values.
#[derive(Clone, Debug)]
pub(in crate::wire) struct Ldl {
    parent: Vec<u32>,
    /// Where the rows of `L` start in `pattern`.
    row_starts: Vec<usize>,
    /// The columns of each row of `L`, in the order in which the row is solved for.
    pattern: Vec<u32>,
    /// Where the columns of `L` start; its diagonal, all ones, is not stored.
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
    /// Multiplications of a factorisation.
    multiplications: usize,
}

/// Three sparse columns with a common pattern.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct SparseColumns {
    /// Rows that may differ from 0, ascending.
    pub(in crate::wire) rows: Vec<u32>,
    /// The values of the three columns in each of these rows.
    pub(in crate::wire) values: Vec<[f64; 3]>,
}

impl Ldl {
    /// The elimination tree and the size of every column of `L`, for the pattern of `matrix`.
    pub(in crate::wire) fn analyse(matrix: &Symmetric) -> Self {
        let n = matrix.size();
        let mut parent = vec![ROOT; n];
        let mut count = vec![0_usize; n];
        let mut seen: Vec<u32> = (0..n as u32).collect();
        for k in 0..n {
            seen[k] = k as u32;
            for (row, _) in matrix.column(k) {
                let mut i = row;
                while seen[i] != k as u32 {
                    if parent[i] == ROOT {
                        parent[i] = k as u32;
                    }
                    count[i] += 1;
                    seen[i] = k as u32;
                    i = parent[i] as usize;
                }
            }
        }
        let mut starts = vec![0; n + 1];
        for k in 0..n {
            starts[k + 1] = starts[k] + count[k];
        }
        // A column with `c` entries below the diagonal is used by the row of each of them.
        let multiplications = count.iter().map(|c| c * (c + 1) / 2 + c);
        let mut ldl = Ldl {
            multiplications: multiplications.sum(),
            rows: vec![0; starts[n]],
            values: vec![0.0; starts[n]],
            diagonal: vec![0.0; n],
            row_starts: Vec::with_capacity(n + 1),
            pattern: Vec::with_capacity(starts[n]),
            parent,
            starts,
        };
        ldl.find_patterns(matrix);
        ldl
    }

    /// The columns of each row of `L`, a child in the elimination tree before its parent, and the
    /// rows of each column.
    fn find_patterns(&mut self, matrix: &Symmetric) {
        let n = matrix.size();
        let mut filled = self.starts.clone();
        let mut seen = vec![ROOT; n];
        let (mut pattern, mut path) = (vec![0; n], Vec::new());
        self.row_starts.push(0);
        for k in 0..n {
            seen[k] = k as u32;
            let mut top = n;
            for (row, _) in matrix.column(k) {
                let mut i = row;
                while seen[i] != k as u32 {
                    seen[i] = k as u32;
                    path.push(i);
                    i = self.parent[i] as usize;
                }
                while let Some(i) = path.pop() {
                    top -= 1;
                    pattern[top] = i as u32;
                }
            }
            for &i in &pattern[top..] {
                self.rows[filled[i as usize]] = k as u32;
                filled[i as usize] += 1;
            }
            self.pattern.extend_from_slice(&pattern[top..]);
            self.row_starts.push(self.pattern.len());
        }
    }

    /// Computes the values for a matrix of the pattern that was analysed. `positive` tells for each
    /// pivot whether it has to be above 0 or below.
    ///
    /// # Errors
    ///
    /// The first pivot that is on the wrong side of 0 by more than rounding, 0 without a sum, or
    /// not finite: the matrix is not quasi-definite.
    pub(in crate::wire) fn factor(
        &mut self,
        matrix: &Symmetric,
        positive: &[bool],
    ) -> Result<(), usize> {
        let mut filled = self.starts.clone();
        let mut y = vec![0.0; matrix.size()];
        for (k, &positive) in positive.iter().enumerate() {
            for (row, value) in matrix.column(k) {
                y[row] += value;
            }
            let own = y[k];
            let pivot = self.row(k, &mut y, &mut filled);
            let good = if positive { pivot > 0.0 } else { pivot < 0.0 };
            self.diagonal[k] = if good && pivot.is_finite() {
                pivot
            } else {
                self.replaced(k, own, pivot, positive, &filled).ok_or(k)?
            };
        }
        Ok(())
    }

    /// What stands for a pivot on the wrong side of 0: on the right side, a little more than is
    /// rounded in the sum that it is. So the factors are those of a matrix that differs by no more
    /// than that. None if more than rounding is wrong.
    fn replaced(
        &self,
        k: usize,
        own: f64,
        pivot: f64,
        positive: bool,
        filled: &[usize],
    ) -> Option<f64> {
        /// As parts of what is summed up: what may be wrong, and what is taken.
        const PARTS: [f64; 2] = [1e-12, 1e-15];
        let row = &self.pattern[self.row_starts[k]..self.row_starts[k + 1]];
        let terms = row.iter().map(|&i| {
            let l = self.values[filled[i as usize] - 1];
            (l * l * self.diagonal[i as usize]).abs()
        });
        let magnitude = own.abs() + terms.sum::<f64>();
        let [wrong, taken] = PARTS.map(|part| part * magnitude);
        let is_rounded = magnitude > 0.0 && magnitude.is_finite() && pivot.abs() <= wrong;
        let taken = if positive { taken } else { -taken };
        is_rounded.then_some(taken)
    }

    /// Row `k` of `L`: solves for it with the columns that are filled so far. Returns the pivot.
    fn row(&mut self, k: usize, y: &mut [f64], filled: &mut [usize]) -> f64 {
        let mut pivot = std::mem::take(&mut y[k]);
        for &i in &self.pattern[self.row_starts[k]..self.row_starts[k + 1]] {
            let i = i as usize;
            let value = std::mem::take(&mut y[i]);
            let end = filled[i];
            // Rows that are not active are zeros.
            if value != 0.0 {
                let column = self.starts[i]..end;
                for (&row, l) in self.rows[column.clone()].iter().zip(&self.values[column]) {
                    y[row as usize] -= l * value;
                }
            }
            let l = value / self.diagonal[i];
            pivot -= l * value;
            self.values[end] = l;
            filled[i] = end + 1;
        }
        pivot
    }

    /// Solves `A x = b` in place.
    pub(in crate::wire) fn solve(&self, x: &mut [f64]) {
        for k in 0..x.len() {
            let value = x[k];
            for (row, l) in self.column(k) {
                x[row] -= l * value;
            }
        }
        self.finish(x);
    }

    /// Solves `D L^T x = z` in place.
    pub(in crate::wire) fn finish(&self, z: &mut [f64]) {
        for k in (0..z.len()).rev() {
            let scaled = z[k] / self.diagonal[k];
            z[k] = self
                .column(k)
                .fold(scaled, |sum, (row, l)| sum - l * z[row]);
        }
    }

    /// Solves `L Y = C` for three sparse columns `C`, given by rows in any order. Only the rows on
    /// the way from there to the root of the elimination tree take part.
    pub(in crate::wire) fn forward(&self, columns: &[(usize, [f64; 3])]) -> SparseColumns {
        let rows = self.path(columns.iter().map(|&(row, _)| row as u32).collect());
        let place = |row: usize| rows.partition_point(|&other| (other as usize) < row);
        let mut values = vec![[0.0; 3]; rows.len()];
        for (row, three) in columns {
            add(&mut values[place(*row)], three, 1.0);
        }
        for k in 0..rows.len() {
            let three = values[k];
            let mut at = k;
            for (row, l) in self.column(rows[k] as usize) {
                while (rows[at] as usize) < row {
                    at += 1;
                }
                add(&mut values[at], &three, -l);
            }
        }
        SparseColumns { rows, values }
    }

    /// The rows on the way from any of `open` to the root, ascending: a parent comes after its
    /// children, so the least open row is the next.
    fn path(&self, mut open: Vec<u32>) -> Vec<u32> {
        let mut rows = Vec::new();
        while let Some(&least) = open.iter().min() {
            rows.push(least);
            open.retain(|&row| row != least);
            let parent = self.parent[least as usize];
            if parent != ROOT {
                open.push(parent);
            }
        }
        rows
    }

    /// Multiplications and divisions of a factorisation.
    pub(in crate::wire) fn multiplications(&self) -> usize {
        self.multiplications
    }

    /// Those of a solve.
    pub(in crate::wire) fn multiplications_of_solve(&self) -> usize {
        2 * self.values.len() + self.diagonal.len()
    }

    /// The pivots, row by row.
    pub(in crate::wire) fn pivots(&self) -> &[f64] {
        &self.diagonal
    }

    #[inline]
    fn column(&self, k: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[k]..self.starts[k + 1];
        let rows = self.rows[range.clone()].iter().map(|&row| row as usize);
        rows.zip(self.values[range].iter().copied())
    }
}

fn add(sum: &mut [f64; 3], term: &[f64; 3], weight: f64) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += weight * term;
    }
}

#[cfg(test)]
mod tests;
