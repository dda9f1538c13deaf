//! What is stored particle by particle, brought to vector units component by component.

use nalgebra::SMatrix;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::{EIGHT, Lanes};
use crate::Sym;

/// Some numbers that stand in a row.
pub trait Row: Sized {
    /// The numbers of eight rows one after another, if a type is nothing but its numbers.
    fn side_by_side(_rows: &[Self; EIGHT]) -> Option<&[f64]> {
        None
    }
    /// The same, to write.
    fn side_by_side_mut(_rows: &mut [Self; EIGHT]) -> Option<&mut [f64]> {
        None
    }
    /// To read.
    fn numbers(&self) -> &[f64];
    /// To write.
    fn numbers_mut(&mut self) -> &mut [f64];
}

/// Column by column.
impl<const R: usize, const C: usize> Row for SMatrix<f64, R, C> {
    #[inline(always)]
    fn side_by_side(rows: &[Self; EIGHT]) -> Option<&[f64]> {
        Some(cast_slice(rows))
    }
    #[inline(always)]
    fn side_by_side_mut(rows: &mut [Self; EIGHT]) -> Option<&mut [f64]> {
        Some(cast_slice_mut(rows))
    }
    #[inline(always)]
    fn numbers(&self) -> &[f64] {
        self.as_slice()
    }
    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [f64] {
        self.as_mut_slice()
    }
}

/// Mandel components.
impl Row for Sym {
    #[inline(always)]
    fn numbers(&self) -> &[f64] {
        &self.mandel
    }
    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [f64] {
        &mut self.mandel
    }
}

impl<const N: usize> Row for [f64; N] {
    #[inline(always)]
    fn numbers(&self) -> &[f64] {
        self
    }
    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [f64] {
        self
    }
}

/// The first numbers of the first eight of these rows, as many as there are `columns`. Where there are fewer rows the last
/// stands in for those that are not there.
#[inline(always)]
pub fn read_columns<L: Lanes, T: Row>(lanes: L, rows: &[T], columns: &mut [L::Eight]) {
    if let Some(eight) = rows.first_chunk() {
        return read_eight(lanes, eight, columns);
    }
    for (c, column) in columns.iter_mut().enumerate() {
        *column = lanes.load(&few(rows, c));
    }
}

/// A number of each row, the last one's in the places of those that are not there. By itself, so that it is not
/// compiled for every vector unit at every use.
#[cold]
#[inline(never)]
fn few<T: Row>(rows: &[T], c: usize) -> [f64; EIGHT] {
    let mut numbers = [0.0; EIGHT];
    for (place, number) in numbers.iter_mut().enumerate() {
        *number = rows[place.min(rows.len() - 1)].numbers()[c];
    }
    numbers
}

/// The opposite of [`few`].
#[cold]
#[inline(never)]
fn write_few<T: Row>(numbers: &[f64; EIGHT], c: usize, rows: &mut [T]) {
    for (row, number) in rows.iter_mut().zip(numbers) {
        row.numbers_mut()[c] = *number;
    }
}

/// The first eight of these numbers, as [`read_columns`].
#[inline(always)]
pub fn read_numbers<L: Lanes>(lanes: L, numbers: &[f64]) -> L::Eight {
    match numbers.first_chunk() {
        Some(eight) => lanes.load(eight),
        None => {
            let mut padded = [0.0; EIGHT];
            for (place, number) in padded.iter_mut().enumerate() {
                *number = numbers[place.min(numbers.len() - 1)];
            }
            lanes.load(&padded)
        }
    }
}

/// Writes `columns` to the first numbers of the first eight of these rows, or of all if they are fewer.
#[inline(always)]
pub fn write_columns<L: Lanes, T: Row>(lanes: L, columns: &[L::Eight], rows: &mut [T]) {
    if let Some(eight) = rows.first_chunk_mut() {
        return write_eight(lanes, columns, eight);
    }
    for (c, column) in columns.iter().enumerate() {
        let mut numbers = [0.0; EIGHT];
        lanes.store(*column, &mut numbers);
        write_few(&numbers, c, rows);
    }
}

#[inline(always)]
fn read_eight<L: Lanes, T: Row>(lanes: L, rows: &[T; EIGHT], columns: &mut [L::Eight]) {
    if let Some(numbers) = T::side_by_side(rows)
        && numbers.len() == EIGHT * columns.len()
    {
        // Which of them is known when this is compiled.
        if let (Ok(two), Ok(rows)) = (<&mut [_; 2]>::try_from(&mut *columns), numbers.try_into()) {
            *two = lanes.unzip2(rows);
            return;
        }
        if let (Ok(three), Ok(rows)) = (<&mut [_; 3]>::try_from(&mut *columns), numbers.try_into())
        {
            *three = lanes.unzip3(rows);
            return;
        }
        if let (Ok(four), Ok(rows)) = (<&mut [_; 4]>::try_from(&mut *columns), numbers.try_into()) {
            *four = lanes.unzip4(rows);
            return;
        }
    }
    let mut c = 0;
    while c + 4 <= columns.len() {
        let four = chunks(flat(rows), c);
        columns[c..c + 4].copy_from_slice(&lanes.columns4(four));
        c += 4;
    }
    if c + 2 <= columns.len() {
        let two = chunks(flat(rows), c);
        columns[c..c + 2].copy_from_slice(&lanes.columns2(two));
        c += 2;
    }
    if c < columns.len() && c > 0 {
        // With the number before it: eight single ones would be read by a slow instruction.
        let [_, last] = lanes.columns2(chunks(flat(rows), c - 1));
        columns[c] = last;
    } else if c < columns.len() {
        let mut ones = [0.0; EIGHT];
        for (one, row) in ones.iter_mut().zip(rows) {
            *one = row.numbers()[c];
        }
        columns[c] = lanes.load(&ones);
    }
}

#[inline(always)]
fn write_eight<L: Lanes, T: Row>(lanes: L, columns: &[L::Eight], rows: &mut [T; EIGHT]) {
    if let Some(numbers) = T::side_by_side_mut(rows)
        && numbers.len() == EIGHT * columns.len()
    {
        if let (&[a, b], Ok(rows)) = (columns, <&mut [_; 16]>::try_from(&mut *numbers)) {
            return lanes.zip2([a, b], rows);
        }
        if let (&[a, b, c], Ok(rows)) = (columns, <&mut [_; 24]>::try_from(&mut *numbers)) {
            return lanes.zip3([a, b, c], rows);
        }
        if let (&[a, b, c, d], Ok(rows)) = (columns, numbers.try_into()) {
            return lanes.zip4([a, b, c, d], rows);
        }
    }
    let mut c = 0;
    while c + 4 <= columns.len() {
        let four = [columns[c], columns[c + 1], columns[c + 2], columns[c + 3]];
        for (row, four) in rows.iter_mut().zip(lanes.rows4(four)) {
            row.numbers_mut()[c..c + 4].copy_from_slice(&four);
        }
        c += 4;
    }
    if c + 2 <= columns.len() {
        for (row, two) in rows
            .iter_mut()
            .zip(lanes.rows2([columns[c], columns[c + 1]]))
        {
            row.numbers_mut()[c..c + 2].copy_from_slice(&two);
        }
        c += 2;
    }
    if c < columns.len() {
        let mut ones = [0.0; EIGHT];
        lanes.store(columns[c], &mut ones);
        for (row, one) in rows.iter_mut().zip(ones) {
            row.numbers_mut()[c] = one;
        }
    }
}

/// Prefetches the eight rows that stand `ahead` of the first of these, in the slice or beyond its end: where the next rows
/// of a longer column are that this is a part of.
#[inline(always)]
pub fn prefetch_rows<L: Lanes, T>(lanes: L, rows: &[T], ahead: usize) {
    const LINE: usize = 64;
    let start = rows.as_ptr().wrapping_add(ahead).cast::<u8>();
    for line in 0..(EIGHT * size_of::<T>()).div_ceil(LINE) {
        lanes.prefetch(start.wrapping_add(LINE * line));
    }
}

/// Numbers of each of eight rows from `at` on; zeros for a row that has not so many. `at` is within every row.
#[inline(always)]
pub fn chunks<const N: usize>(rows: [&[f64]; EIGHT], at: usize) -> [&[f64; N]; EIGHT] {
    let mut chunks = [&[0.0; N]; EIGHT];
    for (chunk, row) in chunks.iter_mut().zip(rows) {
        if let Some(found) = row[at..].first_chunk() {
            *chunk = found;
        }
    }
    chunks
}

/// N numbers of each of eight rows that stand side by side, from `at` on.
#[inline(always)]
pub(super) fn parts<const N: usize, const M: usize>(
    rows: &[f64; M],
    at: usize,
) -> [&[f64; N]; EIGHT] {
    let mut each = [&rows[..0]; EIGHT];
    for (each, row) in each.iter_mut().zip(rows.chunks_exact(M / EIGHT)) {
        *each = row;
    }
    chunks(each, at)
}

#[inline(always)]
fn flat<T: Row>(rows: &[T; EIGHT]) -> [&[f64]; EIGHT] {
    let mut flat: [&[f64]; EIGHT] = [&[]; EIGHT];
    for (flat, row) in flat.iter_mut().zip(rows) {
        *flat = row.numbers();
    }
    flat
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Simd, SimdTask};

    /// So many of these rows.
    struct ThereAndBack<T>([T; EIGHT], usize);

    impl<T: Row + Copy> SimdTask for ThereAndBack<T> {
        type Output = (Vec<[f64; EIGHT]>, [T; EIGHT]);

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> Self::Output {
            let count = self.0[0].numbers().len();
            let mut columns = [lanes.splat(0.0); 9];
            read_columns(lanes, &self.0[..self.1], &mut columns[..count]);
            let mut rows = self.0;
            for row in &mut rows[..self.1] {
                row.numbers_mut().fill(f64::NAN);
            }
            write_columns(lanes, &columns[..count], &mut rows[..self.1]);
            let stored = |column: &L::Eight| {
                let mut to = [0.0; EIGHT];
                lanes.store(*column, &mut to);
                to
            };
            (columns[..count].iter().map(stored).collect(), rows)
        }
    }

    fn comes_back<T: Row + Copy + PartialEq + std::fmt::Debug>(mut rows: [T; EIGHT]) {
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, number) in row.numbers_mut().iter_mut().enumerate() {
                *number = (10 * i + j) as f64;
            }
        }
        for unit in ["plain", "avx2", "avx512"]
            .into_iter()
            .filter_map(Simd::named)
        {
            for count in [1, 5, EIGHT] {
                let (columns, back) = unit.run(ThereAndBack(rows, count));
                assert_eq!(back, rows);
                for (j, column) in columns.iter().enumerate() {
                    let exact = std::array::from_fn(|i| rows[i.min(count - 1)].numbers()[j]);
                    assert_eq!(*column, exact);
                }
            }
        }
    }

    #[test]
    fn rows_of_any_length_come_back() {
        comes_back([[0.0; 1]; EIGHT]);
        comes_back([SMatrix::<f64, 2, 1>::zeros(); EIGHT]);
        comes_back([SMatrix::<f64, 3, 1>::zeros(); EIGHT]);
        comes_back([SMatrix::<f64, 2, 2>::zeros(); EIGHT]);
        comes_back([Sym::default(); EIGHT]);
        comes_back([[0.0; 7]; EIGHT]);
        comes_back([SMatrix::<f64, 3, 3>::zeros(); EIGHT]);
    }
}
