//! A small seeded generator, so that the battery needs no dependency and a failure has a seed.

use std::f64::consts::{PI, TAU};

use fissure_tensor::{Band, Matrix3, Sym, Vector3, rotation};

/// SplitMix64 [Steele, Lea, Flood 2014] with the distributions the battery draws from.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
    plane: bool,
}

impl Random {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self {
            state: seed,
            plane: false,
        }
    }

    /// Whether directions and strains are drawn in the xy plane, and rotations about z.
    pub fn in_plane(self, plane: bool) -> Self {
        Self { plane, ..self }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// Uniform in the logarithm between two positive bounds.
    pub fn log_uniform(&mut self, low: f64, high: f64) -> f64 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    /// Whether an event of this probability happens.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform(0.0, 1.0) < probability
    }

    /// A whole number in `low..=high`.
    pub fn integer(&mut self, low: usize, high: usize) -> usize {
        low + (self.bits() % (high - low + 1) as u64) as usize
    }

    /// A direction, uniform on the sphere, or on the circle in the plane.
    pub fn direction(&mut self) -> Vector3<f64> {
        if self.plane {
            let (s, c) = self.uniform(0.0, TAU).sin_cos();
            return Vector3::new(c, s, 0.0);
        }
        let z = self.uniform(-1.0, 1.0);
        let (s, c) = self.uniform(0.0, TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vector3::new(r * c, r * s, z)
    }

    /// A rotation vector of any direction, or along z in the plane, up to half a turn.
    pub fn turn(&mut self) -> Vector3<f64> {
        let direction = if self.plane {
            Vector3::z() * if self.chance(0.5) { 1.0 } else { -1.0 }
        } else {
            self.direction()
        };
        direction * self.uniform(0.0, PI)
    }

    /// A rotation.
    pub fn rotation(&mut self) -> Matrix3<f64> {
        let turn = self.turn();
        rotation(&turn, turn.norm())
    }

    /// A symmetric tensor of unit norm with any Lode angle, any ratio of mean to deviator and any
    /// axes; three in four in tension. With `special`, one in five has repeated eigenvalues or its
    /// axes along the coordinates, where codes branch.
    pub fn strain_direction(&mut self, special: bool) -> Sym {
        let special = special && self.chance(0.2);
        if self.plane {
            return self.plane_strain_direction(special);
        }
        let lode = if special {
            PI / 3.0 * self.integer(0, 5) as f64
        } else {
            self.uniform(0.0, TAU)
        };
        let slope = self.uniform(-0.5 * PI, 0.5 * PI);
        let mean = slope.sin().abs() * if self.chance(0.75) { 1.0 } else { -1.0 };
        let deviator = slope.cos() * (2.0_f64 / 3.0).sqrt();
        let [a, b, c] = [0.0, 1.0, 2.0]
            .map(|i: f64| mean / 3.0_f64.sqrt() + deviator * (lode - i * TAU / 3.0).cos());
        let principal = Sym::diagonal(a, b, c);
        if special && self.chance(0.5) {
            principal
        } else {
            principal.congruence(&self.rotation())
        }
    }

    /// As [`strain_direction`](Self::strain_direction), with the components xx, yy and xy only.
    fn plane_strain_direction(&mut self, special: bool) -> Sym {
        let angle = if special {
            // Equal, uniaxial, and pure shear.
            0.25 * PI * self.integer(0, 7) as f64
        } else {
            self.uniform(0.0, TAU)
        };
        let (a, b) = angle.sin_cos();
        let tension = if self.chance(0.75) { 1.0 } else { -1.0 };
        let sign = if a + b < 0.0 { -tension } else { tension };
        let principal = Sym::diagonal(a * sign, b * sign, 0.0);
        if special && self.chance(0.5) {
            principal
        } else {
            principal.congruence(&self.rotation())
        }
    }

    /// A band of one of the three kinds whose widest value over all normals is `width`.
    pub fn band(&mut self, width: f64) -> Band {
        let edges = [0; 3].map(|_| self.uniform(0.5, 1.0) * width);
        match self.integer(0, 3) {
            0 => {
                let scale = width / Band::Projected(edges).max_width();
                Band::Projected(edges.map(|edge| edge * scale))
            }
            1 => {
                let scale = width / Band::Section(edges).max_width();
                Band::Section(edges.map(|edge| edge * scale))
            }
            _ => Band::Uniform(width),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_unit_norm_and_both_signs() {
        let mut random = Random::new(7);
        let mut tension = 0;
        for _ in 0..1000 {
            let strain = random.strain_direction(true);
            assert!((strain.norm() - 1.0).abs() < 1e-12);
            tension += usize::from(strain.trace() > 0.0);
        }
        assert!((650..850).contains(&tension), "{tension}");
    }

    #[test]
    fn plane_draws_stay_in_the_plane() {
        let mut random = Random::new(7).in_plane(true);
        let mut tension = 0;
        for _ in 0..1000 {
            let strain = random.strain_direction(true);
            assert!((strain.norm() - 1.0).abs() < 1e-12);
            assert_eq!(strain.mandel[2..5], [0.0; 3]);
            assert_eq!(random.direction().z, 0.0);
            let turn = random.turn();
            assert_eq!((turn.x, turn.y), (0.0, 0.0));
            tension += usize::from(strain.trace() > 0.0);
        }
        assert!((600..850).contains(&tension), "{tension}");
    }

    #[test]
    fn bands_are_as_wide_as_asked() {
        let mut random = Random::new(3);
        for _ in 0..100 {
            let width = random.band(0.25).max_width();
            assert!((width - 0.25).abs() < 1e-12, "{width}");
        }
    }
}
