//! One input of a property: a path from rest, small enough to print and to shrink.

use std::fmt;

use fissure_tensor::{Band, Matrix3, Sym, Vector3, rotation};

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Added to the Biot strain `U − 1`.
    pub strain: Sym,
    /// Rotation vector applied on top of the rotation so far, rad.
    pub spin: Vector3<f64>,
}

/// One input of a property. What the last step and `turn` mean is in the property's doc.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The path from the undeformed material: `F = R·(1 + Σ strain)`.
    pub steps: Vec<Step>,
    /// Band over which cracks are smeared.
    pub band: Band,
    /// Rotation vector of the properties that compare two frames, rad.
    pub turn: Vector3<f64>,
    /// Power of two of the properties that change units; another choice where a property says so.
    pub exponent: i32,
}

impl Case {
    /// A path without rotations.
    pub fn straight(strains: impl IntoIterator<Item = Sym>, band: Band) -> Self {
        let spin = Vector3::zeros();
        let steps = strains.into_iter().map(|strain| Step { strain, spin });
        Self {
            steps: steps.collect(),
            band,
            turn: Vector3::zeros(),
            exponent: 0,
        }
    }

    /// Rotation and strain at the start and after every step: one more than there are steps.
    pub fn points(&self) -> Vec<(Matrix3<f64>, Sym)> {
        let mut point = (Matrix3::identity(), Sym::ZERO);
        let mut points = vec![point];
        for step in &self.steps {
            point = step.apply(&point, 1.0);
            points.push(point);
        }
        points
    }

    /// Deformation gradients at the same points.
    pub fn gradients(&self) -> Vec<Matrix3<f64>> {
        self.points().iter().map(gradient).collect()
    }

    /// Largest strain on the path.
    pub fn max_strain(&self) -> f64 {
        let strains = self.points();
        strains.iter().map(|(_, e)| e.norm()).fold(0.0, f64::max)
    }
}

impl Step {
    /// The fraction `part` of the step from a rotation and strain.
    pub fn apply(&self, from: &(Matrix3<f64>, Sym), part: f64) -> (Matrix3<f64>, Sym) {
        let angle = self.spin.norm() * part;
        // Left alone without a spin, so that plane and symmetric gradients stay so bit for bit.
        let turned = if angle == 0.0 {
            from.0
        } else {
            rotation(&self.spin, angle) * from.0
        };
        (turned, from.1 + self.strain * part)
    }
}

/// `R·(1 + E)`.
pub(super) fn gradient((rotation, strain): &(Matrix3<f64>, Sym)) -> Matrix3<f64> {
    rotation * (Matrix3::identity() + strain.to_matrix())
}

impl fmt::Display for Case {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(out, "band {:?}", self.band)?;
        if self.turn != Vector3::zeros() {
            writeln!(out, "rotation vector {:?}", self.turn.as_slice())?;
        }
        if self.exponent != 0 {
            writeln!(out, "exponent or choice {}", self.exponent)?;
        }
        const SHOWN: usize = 12;
        for (index, step) in self.steps.iter().take(SHOWN).enumerate() {
            let e = &step.strain;
            write!(
                out,
                "step {}: strain increment [xx {:e}, yy {:e}, zz {:e}, yz {:e}, xz {:e}, xy {:e}]",
                index + 1,
                e.xx(),
                e.yy(),
                e.zz(),
                e.yz(),
                e.xz(),
                e.xy()
            )?;
            if step.spin != Vector3::zeros() {
                write!(out, ", spin {:?}", step.spin.as_slice())?;
            }
            writeln!(out)?;
        }
        if self.steps.len() > SHOWN {
            writeln!(out, "… and {} steps more", self.steps.len() - SHOWN)?;
        }
        Ok(())
    }
}
