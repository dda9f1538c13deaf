//! Exact fields around crack tips, put on particles.
#![allow(dead_code, reason = "each user takes a part")]

use fissure_diagnostics::fracture::{NearTip, PlaneElastic, TipField, TipFrame, TipSample};
use fissure_tensor::{Matrix3, Sym};
use nalgebra::{Complex, Matrix2, Rotation2, Vector2};

pub const GLASS: PlaneElastic = PlaneElastic {
    young: 70e9,
    poisson: 0.25,
    plane_stress: false,
};

/// Stress and displacement gradient at a place, in the axes of the tip.
pub type Exact<'a> = &'a dyn Fn(&Vector2<f64>) -> NearTip;

/// Williams' singular fields with a T-stress.
pub fn williams(elastic: PlaneElastic, k: [f64; 2], t: f64) -> impl Fn(&Vector2<f64>) -> NearTip {
    let uniform = uniform(&elastic, Matrix2::new(t, 0.0, 0.0, 0.0));
    move |x| add(NearTip::of(&elastic, k, x), uniform)
}

/// Griffith's crack of half length `a` in an infinite plane under a remote tension `sigma` across it
/// and shear `tau` (Westergaard; the tension is uniaxial), about its right tip.
pub fn griffith(
    elastic: PlaneElastic,
    a: f64,
    sigma: f64,
    tau: f64,
) -> impl Fn(&Vector2<f64>) -> NearTip {
    let uniform = uniform(&elastic, Matrix2::new(-sigma, 0.0, 0.0, 0.0));
    move |x| {
        let z = Complex::new(x.x + a, x.y);
        let root = (z - a).sqrt() * (z + a).sqrt();
        let (function, slope) = (z / root, -(a * a) / (root * root * root));
        let (mu, kappa, y) = (elastic.shear_modulus(), elastic.kolosov(), x.y);
        let (big, small) = (0.5 * (kappa + 1.0), 0.5 * (kappa - 1.0));
        let (re, im) = (function.re * sigma, function.im * sigma);
        let (dre, dim) = (slope.re * sigma * y, slope.im * sigma * y);
        let open = NearTip {
            stress: Matrix2::new(re - dim, -dre, -dre, re + dim),
            gradient: Matrix2::new(
                small * re - dim,
                -(small + 1.0) * im - dre,
                big * im - dre,
                (big - 1.0) * re + dim,
            ) / (2.0 * mu),
        };
        let (re, im) = (function.re * tau, function.im * tau);
        let (dre, dim) = (slope.re * tau * y, slope.im * tau * y);
        let slide = NearTip {
            stress: Matrix2::new(2.0 * im + dre, re - dim, re - dim, -dre),
            gradient: Matrix2::new(
                big * im + dre,
                (big + 1.0) * re - dim,
                -small * re - dim,
                (small - 1.0) * im - dre,
            ) / (2.0 * mu),
        };
        add(add(open, slide), uniform)
    }
}

/// A homogeneous stress.
fn uniform(elastic: &PlaneElastic, stress: Matrix2<f64>) -> NearTip {
    let mean = 0.25 * (3.0 - elastic.kolosov()) * stress.trace();
    NearTip {
        stress,
        gradient: (stress - Matrix2::identity() * mean) / (2.0 * elastic.shear_modulus()),
    }
}

pub fn add(a: NearTip, b: NearTip) -> NearTip {
    NearTip {
        stress: a.stress + b.stress,
        gradient: a.gradient + b.gradient,
    }
}

/// Where particles are put: a square lattice of 2×2 per cell, the crack between two rows of it.
#[derive(Clone, Copy)]
pub struct Lattice {
    /// Width of a cell, m.
    pub cell: f64,
    /// Place of the tip in its cell along the crack, 0 to 1.
    pub tip: f64,
    /// Angle between the lattice and the crack; 0 is along it.
    pub angle: f64,
    /// Radius that is filled, m.
    pub radius: f64,
    /// Rigid motion of body and crack together after loading.
    pub turn: f64,
}

impl Lattice {
    pub fn new(cell: f64, radius: f64) -> Self {
        Self {
            cell,
            tip: 0.0,
            angle: 0.0,
            radius,
            turn: 0.0,
        }
    }

    /// Places relative to the tip, in its axes.
    pub fn places(&self) -> Vec<Vector2<f64>> {
        let spacing = 0.5 * self.cell;
        let count = (1.5 * self.radius / spacing) as i32 + 2;
        let (turn, shift) = (Rotation2::new(self.angle), self.tip * self.cell);
        let lattice = (-count..count).flat_map(|j| (-count..count).map(move |i| (i, j)));
        lattice
            .map(|(i, j)| {
                let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
                turn * Vector2::new(x * spacing - shift, y * spacing)
            })
            .filter(|x| x.norm() < self.radius)
            .collect()
    }

    pub fn frame(&self) -> TipFrame {
        TipFrame {
            position: Vector2::new(0.3, -0.2),
            direction: Rotation2::new(self.turn) * Vector2::x(),
        }
    }

    /// The field on particles.
    pub fn field(&self, elastic: &PlaneElastic, exact: Exact<'_>) -> TipField {
        let (turn, frame) = (Rotation2::new(self.turn), self.frame());
        let samples = self.places().into_iter().map(|x| {
            let near = exact(&x);
            let stress = turn * near.stress * turn.inverse();
            let f = turn * (Matrix2::identity() + near.gradient);
            let across = match elastic.plane_stress {
                true => 0.0,
                false => elastic.poisson * stress.trace(),
            };
            let stress = Sym::new(stress.m11, stress.m22, across, 0.0, 0.0, stress.m12);
            TipSample {
                position: frame.position + turn * x,
                area: 0.25 * self.cell * self.cell,
                density: 2500.0,
                deformation_gradient: Matrix3::new(
                    f.m11, f.m12, 0.0, f.m21, f.m22, 0.0, 0.0, 0.0, 1.0,
                ),
                stress,
                stored: elastic.stored_energy(&stress),
                ..TipSample::default()
            }
        });
        TipField {
            samples: samples.collect(),
            faces: Vec::new(),
        }
    }
}
