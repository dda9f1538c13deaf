//! Paths with a name: tables, Willam's test, random walks.

use fissure_tensor::{Matrix3, Sym};

use super::{Component, Control, Path};
use crate::contract::Random;
use crate::equilibrium::components;

impl Path {
    /// A leg of `steps` per row of a table of controls of xx, yy, zz, yz, xz, xy.
    pub fn table(self, rows: impl IntoIterator<Item = [Control; 6]>, steps: usize) -> Self {
        rows.into_iter().fold(self, |path, control| {
            let leg = path.leg_of(control, steps);
            path.leg(leg)
        })
    }

    /// A leg of `steps` per row of a table of strains.
    pub fn strains(self, rows: impl IntoIterator<Item = Sym>, steps: usize) -> Self {
        let rows = rows.into_iter();
        self.table(rows.map(|row| components(&row).map(Control::Strain)), steps)
    }

    /// A leg of `steps` per row of a table of deformation gradients.
    pub fn gradients(self, rows: impl IntoIterator<Item = Matrix3<f64>>, steps: usize) -> Self {
        rows.into_iter()
            .fold(self, |path, row| path.gradient(&row, steps))
    }

    /// Willam's test of rotating principal axes: tension in x with free lateral strain up to the
    /// strain `peak` (strength over Young's modulus), then strain increments
    /// `Δε_xx : Δε_yy : Δγ_xy = 0.5 : 0.75 : 1` up to `reach` more in `Δγ_xy`; z is free of stress
    /// throughout [Willam, Pramono and Sture 1987]. Each of the two legs takes `steps`.
    pub fn willam(self, peak: f64, reach: f64, poisson: f64, steps: usize) -> Self {
        let strain = |xx, yy, xy| {
            let mut control = [Control::Held; 6];
            control[Component::XX as usize] = Control::Strain(xx);
            control[Component::YY as usize] = Control::Strain(yy);
            control[Component::XY as usize] = Control::Strain(xy);
            control[Component::ZZ as usize] = Control::Stress(0.0);
            control
        };
        let lateral = -poisson * peak;
        let turning = strain(peak + 0.5 * reach, lateral + 0.75 * reach, 0.5 * reach);
        self.table([strain(peak, lateral, 0.0), turning], steps)
    }

    /// `legs` random strain increments, each over `steps`: any direction, norm log-uniform between
    /// a thousandth of `reach` and `reach`; a walk that would leave the ball of that radius stops
    /// at its surface. The same seed gives the same walk; `plane` keeps it to xx, yy and xy.
    pub fn random_walk(
        self,
        seed: u64,
        reach: f64,
        legs: usize,
        steps: usize,
        plane: bool,
    ) -> Self {
        let mut random = Random::new(seed).in_plane(plane);
        let mut strain = Sym::ZERO;
        let ends = (0..legs).map(|_| {
            strain += random.strain_direction(true) * random.log_uniform(1e-3 * reach, reach);
            strain = strain * (reach / strain.norm()).min(1.0);
            strain
        });
        self.strains(ends, steps)
    }
}
