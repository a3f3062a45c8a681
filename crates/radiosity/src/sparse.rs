//! A matrix of which most entries are nothing.

use rayon::prelude::*;

/// Columns of a product that are summed at once: a register of AVX2.
const BLOCK: usize = 8;
/// Sums that are under way at once for each column, so that no addition waits for the one before.
const SUMS: usize = 4;

/// Adds a row's product with `WIDTH` columns, from `first` on, of a matrix of `count` columns.
#[inline]
fn add_block<const WIDTH: usize>(
    (columns, values): (&[u32], &[f32]),
    right: &[f32],
    (first, count): (usize, usize),
    to: &mut [f32; WIDTH],
) {
    let mut sums = [[0f32; WIDTH]; SUMS];
    let add = |sum: &mut [f32; WIDTH], column: u32, value: f32| {
        let from = &right[column as usize * count + first..][..WIDTH];
        for (sum, v) in sum.iter_mut().zip(from) {
            *sum = value.mul_add(*v, *sum);
        }
    };
    let (columns, values) = (columns.chunks_exact(SUMS), values.chunks_exact(SUMS));
    let rest = columns.remainder().iter().zip(values.remainder());
    for (columns, values) in columns.zip(values) {
        for (i, sum) in sums.iter_mut().enumerate() {
            add(sum, columns[i], values[i]);
        }
    }
    for (sum, (&column, &value)) in sums.iter_mut().zip(rest) {
        add(sum, column, value);
    }
    let [a, b, c, d] = sums;
    for (i, to) in to.iter_mut().enumerate() {
        *to += (a[i] + b[i]) + (c[i] + d[i]);
    }
}

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

    /// Adds a row's product with a matrix to `sum`, which has as many columns as that. Each column's sum has an order of its own that
    /// depends on the row alone.
    #[inline]
    pub fn add_row(&self, row: usize, right: &[f32], sum: &mut [f32]) {
        let count = sum.len();
        let row = self.row(row);
        let mut first = 0;
        // A line of the cache while there are columns enough, then a register, then half of one.
        for wide in sum.chunks_exact_mut(2 * BLOCK) {
            if let Ok(wide) = wide.try_into() {
                add_block::<{ 2 * BLOCK }>(row, right, (first, count), wide);
            }
            first += 2 * BLOCK;
        }
        for wide in sum[first..].chunks_exact_mut(BLOCK) {
            if let Ok(wide) = wide.try_into() {
                add_block::<BLOCK>(row, right, (first, count), wide);
            }
            first += BLOCK;
        }
        for wide in sum[first..].chunks_exact_mut(BLOCK / 2) {
            if let Ok(wide) = wide.try_into() {
                add_block::<{ BLOCK / 2 }>(row, right, (first, count), wide);
            }
            first += BLOCK / 2;
        }
        if first < count {
            let rest = &mut sum[first..];
            for (&column, &value) in row.0.iter().zip(row.1) {
                let from = &right[column as usize * count..][first..count];
                for (sum, v) in rest.iter_mut().zip(from) {
                    *sum = value.mul_add(*v, *sum);
                }
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
        if self.samples == BLOCK {
            for (lamp, sum) in sum.chunks_exact_mut(BLOCK).enumerate() {
                let mut all = [0f32; BLOCK];
                for (&column, values) in columns.iter().zip(values.chunks_exact(BLOCK)) {
                    let from = &right[column as usize * count + lamp * BLOCK..][..BLOCK];
                    for ((all, v), f) in all.iter_mut().zip(from).zip(values) {
                        *all = f.mul_add(*v, *all);
                    }
                }
                sum.iter_mut().zip(all).for_each(|(sum, v)| *sum += v);
            }
            return;
        }
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

    /// Numbers between -1 and 1 without a pattern that matters.
    fn numbers(count: usize) -> Vec<f32> {
        (0..count).map(|i| ((i * i) as f32 * 0.37 + i as f32).sin()).collect()
    }

    #[test]
    fn sums_have_one_order_whatever_the_width_and_the_threads() {
        let (height, width) = (40, 60);
        let values = numbers(height * width);
        let rows: Vec<Vec<(u32, f32)>> = (0..height)
            .map(|row| {
                let seen = (0..width).filter(|column| (row + column * column) % 7 < row % 6);
                seen.map(|column| (column as u32, values[row * width + column])).collect()
            })
            .collect();
        let matrix = Sparse::from_rows(&rows, width);
        for count in [1, 3, 4, 5, 8, 15, 16, 24, 31] {
            let right = numbers(width * count);
            let expected = |row: usize, column: usize| {
                // Four sums in turn for the columns of registers and halves, one for those that are left over.
                let several = if column < count / 4 * 4 { 4 } else { 1 };
                let mut sums = [0f32; 4];
                for (at, (from, value)) in rows[row].iter().enumerate() {
                    let sum = &mut sums[at % several];
                    *sum = value.mul_add(right[*from as usize * count + column], *sum);
                }
                (sums[0] + sums[1]) + (sums[2] + sums[3])
            };
            for threads in [1, 2, 5] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let product = pool.install(|| matrix.times(&right, count));
                for (at, found) in product.iter().enumerate() {
                    let bits = expected(at / count, at % count).to_bits();
                    assert_eq!(found.to_bits(), bits, "{count} columns, {threads} threads: {at}");
                }
            }
        }
    }

    #[test]
    fn spectral_rows_multiply_sample_by_sample() {
        for samples in [3, 8] {
            let columns = vec![0u32, 2, 3];
            let values = numbers(3 * samples);
            let rows =
                SpectralRows::from_rows(&[(vec![], vec![]), (columns.clone(), values.clone())], samples);
            let count = 2 * samples;
            let right = numbers(4 * count);
            let mut sum = vec![1.0; count];
            rows.add_row(1, &right, &mut sum);
            for (i, found) in sum.iter().enumerate() {
                let of = |(k, column): (usize, &u32)| {
                    f64::from(values[k * samples + i % samples])
                        * f64::from(right[*column as usize * count + i])
                };
                let exact = 1.0 + columns.iter().enumerate().map(of).sum::<f64>();
                assert!((f64::from(*found) - exact).abs() < 1e-5, "{samples} samples: {found} {exact}");
            }
        }
    }
}
