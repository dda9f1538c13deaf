//! What the third dimension of a plane scene does.

use crate::SceneError;

/// A plane scene's third dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plane {
    /// No strain across the plane.
    Strain {
        /// Thickness, m.
        thickness: f64,
    },
    /// No stress across the plane: every law is wrapped in `PlaneStress`.
    Stress {
        /// Thickness, m.
        thickness: f64,
    },
}

/// How the dimensions of a scene map to the three of its tensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kinematics {
    /// Two dimensions, `F₃₃ = 1`.
    PlaneStrain {
        /// Thickness, m.
        thickness: f64,
    },
    /// Two dimensions, `σ₃₃ = 0`.
    PlaneStress {
        /// Thickness, m.
        thickness: f64,
    },
    /// Two dimensions, radius and axis; volumes, masses and forces are those of the full 2π.
    Axisymmetric,
    /// Three dimensions.
    Solid,
}

impl Kinematics {
    /// Reference volume over the measure of a particle (area or volume) at this radius, m or 1.
    pub fn depth(&self, radius: f64) -> f64 {
        match self {
            Self::PlaneStrain { thickness } | Self::PlaneStress { thickness } => *thickness,
            Self::Axisymmetric => 2.0 * std::f64::consts::PI * radius,
            Self::Solid => 1.0,
        }
    }

    pub(crate) fn check(&self) -> Result<(), SceneError> {
        match self {
            Self::PlaneStrain { thickness } | Self::PlaneStress { thickness }
                if !(*thickness > 0.0 && thickness.is_finite()) =>
            {
                Err(SceneError::Parameter {
                    parameter: "thickness",
                    value: *thickness,
                    permitted: "finite and > 0",
                })
            }
            _ => Ok(()),
        }
    }
}
