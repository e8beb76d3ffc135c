//! Random numbers from a seed.

use glam::DVec3;

/// Numbers in [0, 1) from a seed, by SplitMix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Returns the next number.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a direction of length 1.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let vector = DVec3::from_array(std::array::from_fn(|_| 2.0 * self.next() - 1.0));
            if (0.1..1.0).contains(&vector.length()) {
                return vector.normalize();
            }
        }
    }
}
