//! The table: shape × transfer × stress update × space.

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

/// Every shape with every transfer that it can have and every stress update in a space.
pub fn cases(space: Space) -> Vec<Case> {
    let mut transfers = vec![
        Transfer::Flip { pic: 0.0 },
        Transfer::Flip { pic: 0.05 },
        Transfer::Pic,
        Transfer::Apic,
        Transfer::Mls,
    ];
    transfers.extend((2..=5).map(|order| Transfer::Xpic { order }));
    transfers.extend((2..=3).map(|order| Transfer::Fmpm { order }));
    let updates = [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl];
    let rows = ShapeKind::ALL.into_iter().flat_map(|shape| {
        let splines = matches!(shape, ShapeKind::Bspline2 | ShapeKind::Bspline3);
        let columns = transfers
            .iter()
            .filter(move |&&transfer| splines || transfer != Transfer::Mls)
            .flat_map(|&transfer| updates.map(|u| (transfer, u)));
        columns.map(move |(transfer, update)| Case {
            space,
            shape,
            transfer,
            update,
        })
    });
    rows.collect()
}
