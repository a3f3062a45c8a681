//! A matrix of which most entries are nothing.

use rayon::prelude::*;

/// Rows of entries that are not 0, in the order of their columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sparse {
    /// Where each row begins; one more than there are rows.
    pub starts: Vec<usize>,
    /// The column of each entry.
    pub columns: Vec<u32>,
    /// The entries.
    pub values: Vec<f32>,
    /// How many columns there are.
    pub width: usize,
}

impl Sparse {
    /// A matrix of rows.
    #[must_use]
    pub fn from_rows(rows: &[Vec<(u32, f32)>], width: usize) -> Self {
        let count = rows.iter().map(Vec::len).sum();
        let mut all = Self {
            starts: Vec::with_capacity(rows.len() + 1),
            columns: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
            width,
        };
        all.starts.push(0);
        for row in rows {
            all.columns.extend(row.iter().map(|entry| entry.0));
            all.values.extend(row.iter().map(|entry| entry.1));
            all.starts.push(all.columns.len());
        }
        all
    }

    /// How many rows there are.
    #[must_use]
    pub fn height(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The columns and values of a row.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> (&[u32], &[f32]) {
        let range = self.starts[row]..self.starts[row + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// The sum of a row.
    #[must_use]
    pub fn sum(&self, row: usize) -> f64 {
        self.row(row).1.iter().map(|v| f64::from(*v)).sum()
    }

    /// The matrix with rows and columns exchanged.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut starts = vec![0usize; self.width + 1];
        for &column in &self.columns {
            starts[column as usize + 1] += 1;
        }
        for i in 0..self.width {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut columns = vec![0u32; self.columns.len()];
        let mut values = vec![0f32; self.columns.len()];
        for row in 0..self.height() {
            let (of, entries) = self.row(row);
            for (&column, &value) in of.iter().zip(entries) {
                let at = &mut next[column as usize];
                (columns[*at], values[*at]) = (row as u32, value);
                *at += 1;
            }
        }
        Self { starts, columns, values, width: self.height() }
    }

    /// The product with a matrix of `count` columns whose rows follow each other, a row of it for each column of this.
    #[must_use]
    pub fn times(&self, right: &[f32], count: usize) -> Vec<f32> {
        let mut product = vec![0f32; self.height() * count];
        product.par_chunks_mut(count).enumerate().for_each(|(row, sum)| self.add_row(row, right, sum));
        product
    }

    /// Adds a row's product with a matrix to `sum`, which has as many columns as that.
    #[inline]
    pub fn add_row(&self, row: usize, right: &[f32], sum: &mut [f32]) {
        let count = sum.len();
        let (columns, values) = self.row(row);
        for (&column, &value) in columns.iter().zip(values) {
            let from = &right[column as usize * count..][..count];
            for (sum, v) in sum.iter_mut().zip(from) {
                *sum += value * v;
            }
        }
    }

    /// Bytes that it takes.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.starts.len() * 8 + self.columns.len() * 8
    }
}

/// Rows of entries that are another number in every spectral sample: what surfaces send each other by way of mirrors and glass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectralRows {
    /// Where each row begins; one more than there are rows.
    pub starts: Vec<usize>,
    /// The column of each entry.
    pub columns: Vec<u32>,
    /// The entries, each of as many numbers as there are samples.
    pub values: Vec<f32>,
    /// How many samples there are.
    pub samples: usize,
}

impl SpectralRows {
    /// Rows that are put together.
    #[must_use]
    pub fn from_rows(rows: &[(Vec<u32>, Vec<f32>)], samples: usize) -> Self {
        let mut all = Self { starts: vec![0], samples, ..Self::default() };
        for (columns, values) in rows {
            all.columns.extend(columns);
            all.values.extend(values);
            all.starts.push(all.columns.len());
        }
        all
    }

    /// The columns of a row, and their numbers in all samples.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> (&[u32], &[f32]) {
        let (from, to) = (self.starts[row], self.starts[row + 1]);
        (&self.columns[from..to], &self.values[from * self.samples..to * self.samples])
    }

    /// Adds a row's product with a matrix of which each row has all samples once or several times.
    #[inline]
    pub fn add_row(&self, row: usize, right: &[f32], sum: &mut [f32]) {
        let count = sum.len();
        let (columns, values) = self.row(row);
        for (&column, values) in columns.iter().zip(values.chunks(self.samples)) {
            let from = &right[column as usize * count..][..count];
            for (sum, from) in sum.chunks_mut(self.samples).zip(from.chunks(self.samples)) {
                for ((sum, v), f) in sum.iter_mut().zip(from).zip(values) {
                    *sum += f * v;
                }
            }
        }
    }

    /// Bytes that it takes.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.starts.len() * 8 + self.columns.len() * 4 + self.values.len() * 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_columns_and_products() {
        let rows = vec![vec![(0, 1.0), (2, 2.0)], vec![], vec![(1, 3.0)]];
        let matrix = Sparse::from_rows(&rows, 3);
        assert_eq!((matrix.height(), matrix.sum(0)), (3, 3.0));
        assert_eq!(matrix.times(&[1.0, 10.0, 2.0, 20.0, 3.0, 30.0], 2), [7.0, 70.0, 0.0, 0.0, 6.0, 60.0]);
        let turned = matrix.transposed();
        assert_eq!(turned.row(2), (&[0u32][..], &[2.0f32][..]));
        assert_eq!(turned.transposed(), matrix);
    }
}
