//! One number that two scenes share if and only if their particles and cracks do, to the last bit.

use fissure_scene::{Body, Scene};

/// Hash of the present state of all particles and cracks of a scene.
///
/// FNV-1a of 64 bits (Fowler, Noll and Vo) over, for each body in the scene's order,
/// the number of its particles and, in ascending order of the particles' ids: id, mass, reference
/// volume, position, velocity, deformation gradient, stress (Mandel components), affine velocity if
/// there is one, and the law's named values; then, for each crack, the number of its vertices and their
/// positions and jumps. Numbers go in with the bits of their `f64`, lowest
/// byte first, so it tells `0.0` from `-0.0`, and every machine agrees on it as far as its
/// arithmetic does.
///
/// It does not depend on how the particles are sorted. Not in it: time, energies, reactions, rigid
/// bodies, optional columns, trial motion, and what of a law's state has no name.
///
/// ```
/// use fissure_diagnostics::state_hash;
/// use fissure_materials::Isotropic;
/// use fissure_particles::{Block, Spacing};
/// use fissure_scene::{Plane, Scene};
///
/// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
/// let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
/// scene.fill("bar", steel, &Block::new([0.0, 0.0], [0.02, 0.01]), &Spacing(5e-3))?;
/// let before = state_hash(&scene);
/// scene.bodies_mut()[0].reorder(&[7, 3, 0, 1, 2, 6, 5, 4])?;
/// assert_eq!(state_hash(&scene), before);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn state_hash<const D: usize>(scene: &Scene<D>) -> u64 {
    let mut hash = Fnv::default();
    for body in scene.bodies() {
        hash_body(&mut hash, body);
    }
    for crack in scene.cracks() {
        hash.word(crack.line().points().len() as u64);
        for (x, jump) in crack.line().points().iter().zip(crack.jump()) {
            hash.numbers(x.as_slice());
            hash.numbers(jump.as_slice());
        }
    }
    hash.0
}

fn hash_body<const D: usize>(hash: &mut Fnv, body: &Body<D>) {
    let (particles, motion) = (body.particles(), &body.particles().motion);
    let values: Vec<Vec<f64>> = (0..body.law().names().len())
        .map(|value| body.law().values(value, &motion.deformation_gradient))
        .collect();
    let mut order: Vec<usize> = (0..particles.len()).collect();
    order.sort_unstable_by_key(|&i| particles.id[i]);
    hash.word(particles.len() as u64);
    for i in order {
        hash.word(u64::from(particles.id[i].0));
        hash.numbers(&[particles.mass[i], particles.volume[i]]);
        hash.numbers(motion.position[i].as_slice());
        hash.numbers(motion.velocity[i].as_slice());
        hash.numbers(motion.deformation_gradient[i].as_slice());
        hash.numbers(&motion.stress[i].mandel);
        if let Some(affine) = motion.affine.get(i) {
            hash.numbers(affine.as_slice());
        }
        values
            .iter()
            .for_each(|column| hash.numbers(&column[i..=i]));
    }
}

struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers
            .iter()
            .for_each(|number| self.word(number.to_bits()));
    }
}

#[cfg(test)]
mod tests {
    use super::Fnv;

    #[test]
    fn bytes_hash_as_the_published_function() {
        // The function as published, byte by byte: "a" and seven zeros.
        let mut expected: u64 = 0xcbf2_9ce4_8422_2325;
        for byte in [0x61_u8, 0, 0, 0, 0, 0, 0, 0] {
            expected ^= u64::from(byte);
            expected = expected.wrapping_mul(1_099_511_628_211);
        }
        let mut hash = Fnv::default();
        hash.word(0x61);
        assert_eq!(hash.0, expected);
        let (mut plus, mut minus) = (Fnv::default(), Fnv::default());
        plus.numbers(&[0.0]);
        minus.numbers(&[-0.0]);
        assert_ne!(plus.0, minus.0);
    }
}
