//! The table: shape × transfer × space, and the stress updates for FLIP.

use fissure::prelude::{ExplicitSettings, StressUpdate, Transfer};

/// A shape function by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    /// Multilinear.
    Linear,
    /// uGIMP.
    Gimp,
    /// CPDI.
    Cpdi,
    /// Quadratic B-splines.
    Bspline2,
    /// Cubic B-splines.
    Bspline3,
}

impl ShapeKind {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Linear,
        Self::Gimp,
        Self::Cpdi,
        Self::Bspline2,
        Self::Bspline3,
    ];

    /// Farthest node a particle reaches along an axis, in cells, with `per_axis` particles a cell.
    pub fn support(self, per_axis: u32) -> f64 {
        let half = 0.5 / f64::from(per_axis);
        match self {
            Self::Linear => 1.0,
            Self::Gimp | Self::Cpdi => 1.0 + half,
            Self::Bspline2 => 1.5,
            Self::Bspline3 => 2.0,
        }
    }
}

/// What the third dimension does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Plane strain.
    Plane,
    /// Radius and axis.
    Axisymmetric,
    /// Three dimensions.
    Solid,
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// What the third dimension does.
    pub space: Space,
    /// Shape function.
    pub shape: ShapeKind,
    /// Transfer.
    pub transfer: Transfer,
    /// Stress update.
    pub update: StressUpdate,
}

impl Case {
    /// Settings of the solver, with a Courant number.
    pub fn settings(&self, cfl: f64) -> ExplicitSettings {
        ExplicitSettings {
            cfl,
            transfer: self.transfer,
            stress_update: self.update,
            ..Default::default()
        }
    }

    /// Terms of the velocity filter; 1 where there is none.
    pub fn order(&self) -> usize {
        match self.transfer {
            Transfer::Xpic { order } | Transfer::Fmpm { order } => order,
            _ => 1,
        }
    }
}

/// Every shape with every transfer in a space: FLIP with all three stress updates, the others with
/// the stress last.
pub fn cases(space: Space) -> Vec<Case> {
    let flip = Transfer::Flip { pic: 0.0 };
    let mut columns = vec![
        (flip, StressUpdate::First),
        (flip, StressUpdate::Last),
        (flip, StressUpdate::Musl),
        (Transfer::Flip { pic: 0.05 }, StressUpdate::Last),
        (Transfer::Pic, StressUpdate::Last),
        (Transfer::Apic, StressUpdate::Last),
    ];
    columns.extend((2..=5).map(|order| (Transfer::Xpic { order }, StressUpdate::Last)));
    columns.extend((2..=3).map(|order| (Transfer::Fmpm { order }, StressUpdate::Last)));
    ShapeKind::ALL
        .iter()
        .flat_map(|&shape| {
            columns.iter().map(move |&(transfer, update)| Case {
                space,
                shape,
                transfer,
                update,
            })
        })
        .collect()
}
