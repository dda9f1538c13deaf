//! Eight material points at once, for laws that are short enough to run on a vector unit.
//!
//! A body's particles come in groups of eight, component by component. A law that answers them in a
//! loop over the eight places, without branches and calls in it, is compiled to vector instructions.

use fissure_tensor::simd::EIGHT;
use fissure_tensor::{Matrix3, Sym};

/// The ends of steps of eight points that have no history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EightPoints {
    /// Deformation gradients: component `3 i + j` is `F_ij` of each point.
    pub deformation_gradient: [[f64; EIGHT]; 9],
    /// [`Scale::stiffness`](crate::Scale::stiffness) of each point.
    pub stiffness: [f64; EIGHT],
    /// [`Scale::strength`](crate::Scale::strength) of each point.
    pub strength: [f64; EIGHT],
}

impl EightPoints {
    /// Eight times this one.
    #[inline(always)]
    pub fn of(f: &Matrix3<f64>) -> Self {
        let mut points = Self {
            deformation_gradient: [[0.0; EIGHT]; 9],
            stiffness: [1.0; EIGHT],
            strength: [1.0; EIGHT],
        };
        for place in 0..EIGHT {
            points.set(place, f);
        }
        points
    }

    /// Sets the deformation gradient of a point.
    #[inline(always)]
    pub fn set(&mut self, place: usize, f: &Matrix3<f64>) {
        for i in 0..3 {
            for j in 0..3 {
                self.deformation_gradient[3 * i + j][place] = f[(i, j)];
            }
        }
    }

    /// Deformation gradient of a point, row by row.
    #[inline(always)]
    pub fn gradient(&self, place: usize) -> [f64; 9] {
        let f = &self.deformation_gradient;
        [
            f[0][place],
            f[1][place],
            f[2][place],
            f[3][place],
            f[4][place],
            f[5][place],
            f[6][place],
            f[7][place],
            f[8][place],
        ]
    }
}

/// What a law answers for eight points that stay without a history and dissipate nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EightResponses {
    /// Cauchy stresses in Mandel components, Pa.
    pub stress: [[f64; EIGHT]; 6],
    /// Stored energies, J per reference m³.
    pub stored: [f64; EIGHT],
    /// Speeds of the fastest waves, m/s.
    pub wave_speed: [f64; EIGHT],
}

impl Default for EightResponses {
    #[inline(always)]
    fn default() -> Self {
        Self {
            stress: [[0.0; EIGHT]; 6],
            stored: [0.0; EIGHT],
            wave_speed: [0.0; EIGHT],
        }
    }
}

impl EightResponses {
    /// Sets what is answered for a point.
    #[inline(always)]
    pub fn set(&mut self, place: usize, stress: &Sym, stored: f64, wave_speed: f64) {
        for (component, value) in self.stress.iter_mut().zip(stress.mandel) {
            component[place] = value;
        }
        self.stored[place] = stored;
        self.wave_speed[place] = wave_speed;
    }

    /// Stress of a point.
    #[inline(always)]
    pub fn stress(&self, place: usize) -> Sym {
        let s = &self.stress;
        Sym {
            mandel: [
                s[0][place],
                s[1][place],
                s[2][place],
                s[3][place],
                s[4][place],
                s[5][place],
            ],
        }
    }
}
