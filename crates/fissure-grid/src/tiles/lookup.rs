//! From coordinates to the number of a tile.

use super::ABSENT;

/// Open-addressing table with linear probing. It is only ever asked for one key, never walked, so its order cannot show.
#[derive(Clone, Debug, Default)]
pub(super) struct Lookup {
    /// Tile numbers, [`ABSENT`] where free; a power of two of them, at least half free.
    slots: Vec<u32>,
}

impl Lookup {
    /// Numbers `tiles`, each of which occurs once, by their position.
    pub(super) fn rebuild<const D: usize>(&mut self, tiles: &[[i32; D]]) {
        self.slots.clear();
        self.slots
            .resize((2 * tiles.len()).next_power_of_two(), ABSENT);
        let mask = self.slots.len() - 1;
        for (number, &coordinates) in tiles.iter().enumerate() {
            let mut slot = hash(coordinates) & mask;
            while self.slots[slot] != ABSENT {
                slot = (slot + 1) & mask;
            }
            // Memory ends long before 2^32 tiles.
            self.slots[slot] = number as u32;
        }
    }

    /// The number of the tile at `coordinates` among the `tiles` given to [`Lookup::rebuild`].
    #[inline]
    pub(super) fn find<const D: usize>(
        &self,
        tiles: &[[i32; D]],
        coordinates: [i32; D],
    ) -> Option<u32> {
        let mask = self.slots.len().checked_sub(1)?;
        let mut slot = hash(coordinates) & mask;
        loop {
            let number = self.slots[slot];
            if number == ABSENT {
                return None;
            }
            if tiles.get(number as usize) == Some(&coordinates) {
                return Some(number);
            }
            slot = (slot + 1) & mask;
        }
    }
}

/// Mixes coordinates; the high half is returned, where a product mixes best.
#[inline]
fn hash<const D: usize>(coordinates: [i32; D]) -> usize {
    let mixed = coordinates.iter().fold(0_u64, |mixed, &coordinate| {
        (mixed.rotate_left(29) ^ u64::from(coordinate as u32)).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    });
    (mixed >> 32) as usize
}
