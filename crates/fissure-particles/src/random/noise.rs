//! Standard normal numbers from a seed.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use crate::particles::ParticleId;

/// Streams below this belong to particles.
const FIELDS: u64 = 1 << 32;

/// A standard normal number per particle, without correlation: by the seed and the id alone.
///
/// ```
/// use fissure_particles::{ParticleId, WhiteNoise};
///
/// let noise = WhiteNoise { seed: 7 };
/// assert_eq!(noise.at(ParticleId(3)), WhiteNoise { seed: 7 }.at(ParticleId(3)));
/// assert_ne!(noise.at(ParticleId(3)), noise.at(ParticleId(4)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WhiteNoise {
    /// Another seed gives other numbers.
    pub seed: u64,
}

impl WhiteNoise {
    /// The number of a particle.
    pub fn at(&self, id: ParticleId) -> f64 {
        Normals::new(self.seed, u64::from(id.0)).pair().0
    }
}

/// Standard normal numbers, two at a time (Box and Muller), from a stream of ChaCha8.
pub(super) struct Normals(ChaCha8Rng);

impl Normals {
    fn new(seed: u64, stream: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut source = ChaCha8Rng::from_seed(key);
        source.set_stream(stream);
        Self(source)
    }

    /// The stream of a field.
    pub(super) fn of_field(seed: u64) -> Self {
        Self::new(seed, FIELDS)
    }

    pub(super) fn pair(&mut self) -> (f64, f64) {
        const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;
        let mut bits = || (self.0.next_u64() >> 11) as f64;
        // In (0, 1], so that the logarithm is finite.
        let length = (-2.0 * libm::log((bits() + 1.0) * UNIT)).sqrt();
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * bits() * UNIT);
        (length * cosine, length * sine)
    }
}
