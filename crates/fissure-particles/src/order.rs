//! Sorting particles and bringing columns into a new order.

use rayon::prelude::*;

use crate::error::ParticleError;

/// Fewer rows than this are moved by one thread: a second one would cost more than it saves.
const PARALLEL_FROM: usize = 1 << 14;

/// Writes to `out` the rows of `keys` in ascending order of their keys; rows of equal key keep
/// their order.
///
/// `out[new] = old`, as [`Particles::reorder`](crate::Particles::reorder) wants it. The result
/// depends on `keys` alone. Keys which are nearly sorted already, as those of particles between two
/// sorts, cost hardly more than one pass. Of more than `u32::MAX` keys only the first `u32::MAX`
/// are sorted (no body is that large), and the reordering then refuses the short order.
pub fn sort_permutation(keys: &[u64], out: &mut Vec<u32>) {
    out.clear();
    out.extend((0..u32::MAX).zip(keys).map(|(row, _)| row));
    out.sort_by_key(|&row| keys[row as usize]);
}

/// Brings a column which a body does not hold itself, such as the states of its law, into a new
/// order: row `i` becomes what row `order[i]` was. `spare` is scratch; keep it between calls and
/// nothing is allocated.
///
/// # Errors
/// [`ParticleError::ColumnLength`] if `order` and `column` differ in length,
/// [`ParticleError::NotAPermutation`] if an entry is no row. That each row occurs once is not
/// checked here but in [`Particles::reorder`](crate::Particles::reorder).
pub fn reorder_column<T: Copy + Send + Sync>(
    order: &[u32],
    column: &mut Vec<T>,
    spare: &mut Vec<T>,
) -> Result<(), ParticleError> {
    let len = column.len();
    check_length(order, len)?;
    if let Some(row) = order.iter().position(|&old| old as usize >= len) {
        return Err(ParticleError::NotAPermutation {
            row,
            value: order[row],
            len,
        });
    }
    gather(order, column, spare);
    std::mem::swap(column, spare);
    Ok(())
}

/// Refuses an order which is not a permutation of `0..len`. `seen` is scratch.
pub(crate) fn check_permutation(
    order: &[u32],
    len: usize,
    seen: &mut Vec<bool>,
) -> Result<(), ParticleError> {
    check_length(order, len)?;
    seen.clear();
    seen.resize(len, false);
    for (row, &value) in order.iter().enumerate() {
        match seen.get_mut(value as usize) {
            Some(seen) if !*seen => *seen = true,
            _ => return Err(ParticleError::NotAPermutation { row, value, len }),
        }
    }
    Ok(())
}

fn check_length(order: &[u32], expected: usize) -> Result<(), ParticleError> {
    if order.len() == expected {
        return Ok(());
    }
    Err(ParticleError::ColumnLength {
        column: "order",
        found: order.len(),
        expected,
    })
}

/// Row `i` of `to` becomes row `order[i]` of `from`. The entries of `order` are valid rows.
pub(crate) fn gather<T: Copy + Send + Sync>(order: &[u32], from: &[T], to: &mut Vec<T>) {
    if order.len() < PARALLEL_FROM {
        to.clear();
        to.extend(order.iter().map(|&old| from[old as usize]));
    } else {
        order
            .par_iter()
            .map(|&old| from[old as usize])
            .collect_into_vec(to);
    }
}

/// The rows of `from` in this order.
pub(crate) fn gathered<T: Copy + Send + Sync>(order: &[u32], from: &[T]) -> Vec<T> {
    let mut to = Vec::new();
    gather(order, from, &mut to);
    to
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn equal_keys_keep_their_order() {
        let mut order = vec![7];
        sort_permutation(&[2, 1, 2, 0, 1], &mut order);
        assert_eq!(order, [3, 1, 4, 0, 2]);
    }

    #[test]
    fn what_is_no_permutation_is_refused() {
        let mut seen = Vec::new();
        assert!(check_permutation(&[1, 0, 2], 3, &mut seen).is_ok());
        assert!(matches!(
            check_permutation(&[1, 0, 1], 3, &mut seen),
            Err(ParticleError::NotAPermutation {
                row: 2,
                value: 1,
                len: 3
            })
        ));
        assert!(matches!(
            check_permutation(&[1, 0, 3], 3, &mut seen),
            Err(ParticleError::NotAPermutation {
                row: 2,
                value: 3,
                ..
            })
        ));
        assert!(matches!(
            check_permutation(&[0, 1], 3, &mut seen),
            Err(ParticleError::ColumnLength {
                found: 2,
                expected: 3,
                ..
            })
        ));
        let (mut column, mut spare) = (vec![1.0, 2.0], Vec::new());
        assert!(reorder_column(&[0, 2], &mut column, &mut spare).is_err());
        assert!(reorder_column(&[0], &mut column, &mut spare).is_err());
        assert_eq!(column, [1.0, 2.0]);
    }

    #[test]
    fn many_rows_move_as_few_do() {
        let len = 2 * PARALLEL_FROM + 3;
        let mut column: Vec<u64> = (0..len as u64)
            .map(|i| i.wrapping_mul(0x9E37_79B9_7F4A_7C15))
            .collect();
        let expected = {
            let mut sorted = column.clone();
            sorted.sort_unstable();
            sorted
        };
        let (mut order, mut spare) = (Vec::new(), Vec::new());
        sort_permutation(&column, &mut order);
        reorder_column(&order, &mut column, &mut spare).unwrap();
        assert_eq!(column, expected);
    }

    proptest! {
        #[test]
        fn sorting_gives_a_stable_permutation(keys in prop::collection::vec(0_u64..20, 0..200)) {
            let mut order = Vec::new();
            sort_permutation(&keys, &mut order);
            prop_assert!(check_permutation(&order, keys.len(), &mut Vec::new()).is_ok());
            let sorted: Vec<(u64, u32)> = order.iter().map(|&i| (keys[i as usize], i)).collect();
            prop_assert!(sorted.is_sorted());
        }
    }
}
