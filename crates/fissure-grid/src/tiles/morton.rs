//! Order along a Morton (Z) curve.

use std::cmp::Ordering;

/// Compares along the curve without forming interleaved keys, so that any coordinates are allowed: the axis whose
/// coordinates differ in the highest bit decides, the last such axis first (Chan 2002).
#[inline]
pub(super) fn morton<const D: usize>(a: &[i32; D], b: &[i32; D]) -> Ordering {
    let mut decisive = D - 1;
    let mut highest = 0_u32;
    for axis in (0..D).rev() {
        let difference = (a[axis] ^ b[axis]) as u32;
        // Has `difference` a higher leading bit than `highest`?
        if highest < difference && highest < (highest ^ difference) {
            decisive = axis;
            highest = difference;
        }
    }
    a[decisive].cmp(&b[decisive])
}
