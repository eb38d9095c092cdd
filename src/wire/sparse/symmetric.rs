//! A sparse symmetric matrix, put together from entries that add up.

/// Entries of a symmetric matrix in the order in which they were added.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct Triplets {
    /// Row and column, the row not below the diagonal.
    pub(in crate::wire) index: Vec<(u32, u32)>,
    pub(in crate::wire) value: Vec<f64>,
}

impl Triplets {
    /// Adds `value` to the entries `(i, j)` and `(j, i)`, which are one.
    pub(in crate::wire) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.index.push((i.min(j) as u32, i.max(j) as u32));
        self.value.push(value);
    }

    /// Adds `weight` times `row^T row`, where a row is columns and values.
    pub(in crate::wire) fn add_outer(&mut self, row: &[(usize, f64)], weight: f64) {
        for &(i, a) in row {
            for &(j, b) in row.iter().filter(|(j, _)| i <= *j) {
                self.add(i, j, weight * a * b);
            }
        }
    }
}

/// The upper triangle by columns: rows ascend within each.
#[derive(Clone, Debug)]
pub(in crate::wire) struct Symmetric {
    pub(super) starts: Vec<usize>,
    pub(super) rows: Vec<u32>,
    pub(super) values: Vec<f64>,
    /// Where each triplet goes.
    slots: Vec<u32>,
}

impl Symmetric {
    /// The structure of the matrix of size `n` with these entries; all are 0.
    pub(in crate::wire) fn new(n: usize, index: &[(u32, u32)]) -> Self {
        let by_row = sorted_by_key(n, 0..index.len() as u32, |triplet| {
            index[triplet as usize].0
        });
        let sorted = sorted_by_key(n, by_row, |triplet| index[triplet as usize].1);
        let mut matrix = Symmetric {
            starts: vec![0; n + 1],
            rows: Vec::new(),
            values: Vec::new(),
            slots: vec![0; index.len()],
        };
        let mut last = None;
        for triplet in sorted {
            let (row, column) = index[triplet as usize];
            if last != Some((column, row)) {
                last = Some((column, row));
                matrix.rows.push(row);
                matrix.starts[column as usize + 1] = matrix.rows.len();
            }
            matrix.slots[triplet as usize] = matrix.rows.len() as u32 - 1;
        }
        for column in 0..n {
            matrix.starts[column + 1] = matrix.starts[column + 1].max(matrix.starts[column]);
        }
        matrix.values = vec![0.0; matrix.rows.len()];
        matrix
    }

    /// Takes the values of the triplets it was made from.
    pub(in crate::wire) fn fill(&mut self, values: &[f64]) {
        self.values.fill(0.0);
        for (&slot, value) in self.slots.iter().zip(values) {
            self.values[slot as usize] += value;
        }
    }

    pub(super) fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// The rows above or on the diagonal and the values of a column.
    #[inline]
    pub(super) fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[column]..self.starts[column + 1];
        let rows = self.rows[range.clone()].iter().map(|&row| row as usize);
        rows.zip(self.values[range].iter().copied())
    }

    /// `b - A x`.
    pub(in crate::wire) fn residual(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        self.sums(b.to_vec(), x, |sum, term| *sum -= term)
    }

    /// For each row `b - A x`, and `|b| + |A| |x|`, the magnitude of what was summed up.
    pub(in crate::wire) fn residual_and_magnitude(&self, b: &[f64], x: &[f64]) -> Vec<[f64; 2]> {
        let start = b.iter().map(|&value| [value, value.abs()]).collect();
        self.sums(start, x, |[residual, magnitude], term| {
            *residual -= term;
            *magnitude += term.abs();
        })
    }

    /// For each row a sum that takes the terms of `A x` one by one.
    fn sums<T: Copy>(&self, mut sums: Vec<T>, x: &[f64], take: impl Fn(&mut T, f64)) -> Vec<T> {
        for (column, &at) in x.iter().enumerate() {
            let mut own = sums[column];
            for (row, value) in self.column(column) {
                if row != column {
                    take(&mut sums[row], value * at);
                }
                take(&mut own, value * x[row]);
            }
            sums[column] = own;
        }
        sums
    }
}

/// The items in ascending order of their keys, which are below `n`; those with the same key stay in order.
pub(in crate::wire) fn sorted_by_key(
    n: usize,
    items: impl IntoIterator<Item = u32, IntoIter: Clone>,
    key: impl Fn(u32) -> u32,
) -> Vec<u32> {
    let items = items.into_iter();
    let mut next = vec![0; n + 1];
    for item in items.clone() {
        next[key(item) as usize + 1] += 1;
    }
    let count = next.iter_mut().fold(0, |sum, count| {
        *count += sum;
        *count
    });
    let mut sorted = vec![0; count];
    for item in items {
        let place = &mut next[key(item) as usize];
        sorted[*place] = item;
        *place += 1;
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorted_by_key_is_a_stable_sort() {
        let keys = [5, 0, 3, 5, 5, 1, 0, 3];
        let mut expected: Vec<u32> = (0..8).rev().collect();
        expected.sort_by_key(|item| keys[*item as usize]);
        let sorted = sorted_by_key(6, (0..8).rev(), |item| keys[item as usize]);
        assert_eq!(sorted, expected);
        assert_eq!(sorted_by_key(0, [], |item| item), []);
    }
}
