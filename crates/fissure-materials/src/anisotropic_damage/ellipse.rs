//! The return of two shear tractions to the document's ellipse [Nairn 2017, eqs 20-25].
//!
//! In units of strain: `x_i = τ_i/G`, semi-axes `A_i = γ_t0 f(δ_i)`, trial `e_i = x_i + (1−d_i) Δγ_i`.
//! 1. On or inside the ellipse: elastic, the crack's strain grows by `d_i Δγ_i`.
//! 2. Else the part of the increment up to the ellipse is elastic, and signs are turned so that
//!    the tractions there are not negative.
//! 3. If both shears grow, `x_i = e_i − y_i`, `y_i = δ̇_i − d_i Δγ_i`, with the return along the
//!    normal of the new ellipse (eqs 21-23): `y_i = μ x_i/A_i²` with one `μ` on which the new
//!    traction lies on the new ellipse.
//! 4. If one alone grows (eq. 25), the other is elastic, `c² = 1 − (x_j/A_j)²`, and the growing one
//!    goes as a single mode with `c A_k` for its strength.
//!
//! Every equation is a bracketed one in a single unknown and is bisected, so that a result always
//! comes back. A component that swings past zero to its other strength while the other grows is
//! taken in two parts.

use super::mode::ModeAt;
use crate::Softening;

/// Bisections of a bracket; more than a double has digits.
const BISECTIONS: usize = 64;

/// The shear of an elliptical crack: largest crack strains, dimensionless, and tractions over `G`.
#[derive(Clone, Copy)]
pub(super) struct Sheared {
    pub softened: [f64; 2],
    pub traction: [f64; 2],
}

/// One mode seen in strains.
struct Axis<'a, S> {
    mode: &'a ModeAt<'a, S>,
    softened: f64,
}

impl<S: Softening> Axis<'_, S> {
    /// Strains per dimensionless opening.
    fn unit(&self) -> f64 {
        self.mode.stiffness * self.initiation()
    }

    /// `γ_t0`.
    fn initiation(&self) -> f64 {
        self.mode.strength / self.mode.modulus
    }

    /// `A` with the crack's strain grown by `growth`.
    fn semi_axis(&self, growth: f64) -> f64 {
        let softened = self.softened + growth / self.unit();
        self.initiation() * self.mode.softening.ratio(softened)
    }

    fn integrity(&self) -> f64 {
        self.mode.integrity(self.softened)
    }

    fn grown(&self, growth: f64) -> f64 {
        (self.softened + growth / self.unit()).min(self.mode.softening.critical())
    }
}

/// Where a function that falls from positive to negative crosses zero.
fn bisect(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// `(x/A)²`, nothing for a component that carries nothing.
fn share(x: f64, semi_axis: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        (x / semi_axis) * (x / semi_axis)
    }
}

/// Moves the shear by an increment of the engineering strains.
pub(super) fn moved<S: Softening>(
    mode: &ModeAt<'_, S>,
    start: &Sheared,
    increment: [f64; 2],
) -> Sheared {
    let (mut now, mut left) = (*start, increment);
    for _ in 0..4 {
        match part(mode, &now, left) {
            (next, None) => return next,
            (next, Some(rest)) => (now, left) = (next, rest),
        }
    }
    now
}

/// Moves by as much of the increment as one set of signs covers; the rest if there is one.
fn part<S: Softening>(
    mode: &ModeAt<'_, S>,
    start: &Sheared,
    increment: [f64; 2],
) -> (Sheared, Option<[f64; 2]>) {
    let axes = start.softened.map(|softened| Axis { mode, softened });
    let secant = [0, 1].map(|i| axes[i].integrity());
    let semi_axes = [0, 1].map(|i| axes[i].semi_axis(0.0));
    let at =
        |fraction: f64| [0, 1].map(|i| start.traction[i] + secant[i] * increment[i] * fraction);
    let excess = |x: [f64; 2]| share(x[0], semi_axes[0]) + share(x[1], semi_axes[1]) - 1.0;
    let inside = |x: [f64; 2]| excess(x) <= 1e-12;
    if inside(at(1.0)) {
        let next = Sheared {
            traction: at(1.0),
            ..*start
        };
        return (next, None);
    }
    let elastic = bisect(0.0, 1.0, |fraction| -excess(at(fraction)));
    // A start on the ellipse is there to round-off only.
    let elastic = if inside(start.traction) && elastic < 1e-9 {
        0.0
    } else {
        elastic
    };
    let on_ellipse = at(elastic);
    let sign = on_ellipse.map(|x| if x < 0.0 { -1.0 } else { 1.0 });
    let strain = [0, 1].map(|i| sign[i] * increment[i] * (1.0 - elastic));
    let from = [0, 1].map(|i| sign[i] * on_ellipse[i]);
    let trial = [0, 1].map(|i| from[i] + secant[i] * strain[i]);
    let growing = strain.map(|strain| strain > 0.0);
    let mut next = *start;
    let mut rest = None;
    match growing {
        [true, true] => {
            let growth = both_grow(&axes, trial, [0, 1].map(|i| strain[i] * (1.0 - secant[i])));
            for i in 0..2 {
                next.softened[i] = axes[i].grown(growth[i].max(0.0));
                let y = growth[i] - strain[i] * (1.0 - secant[i]);
                next.traction[i] = sign[i] * (trial[i] - y);
            }
        }
        [first, second] if first != second => {
            let (k, j) = if first { (0, 1) } else { (1, 0) };
            let mut fraction = 1.0;
            if trial[j] < -semi_axes[j] {
                // To zero now, and the rest with the other sign.
                fraction = from[j] / (from[j] - trial[j]);
                rest = Some([0, 1].map(|i| sign[i] * strain[i] * (1.0 - fraction)));
            }
            let across = from[j] + (trial[j] - from[j]) * fraction;
            let along = from[k] + (trial[k] - from[k]) * fraction;
            let c = (1.0 - share(across, semi_axes[j])).max(0.0).sqrt();
            let growth = one_grows(&axes[k], c, along, secant[k]);
            next.softened[k] = axes[k].grown(growth);
            next.traction[k] = sign[k] * c * axes[k].semi_axis(growth);
            next.traction[j] = sign[j] * across;
        }
        _ => next.traction = on_ellipse, // outside and none grows: round-off
    }
    (next, rest)
}

/// The growths of both crack strains (eqs 21-23).
fn both_grow<S: Softening>(
    axes: &[Axis<'_, S>; 2],
    trial: [f64; 2],
    elastic: [f64; 2],
) -> [f64; 2] {
    let returned = |multiplier: f64| {
        [0, 1].map(|i| {
            bisect(0.0, trial[i].max(0.0), |y| {
                let semi_axis = axes[i].semi_axis(y + elastic[i]);
                (trial[i] - y) * multiplier - y * semi_axis * semi_axis
            })
        })
    };
    let excess = |multiplier: f64| {
        let y = returned(multiplier);
        let shares = [0, 1].map(|i| share(trial[i] - y[i], axes[i].semi_axis(y[i] + elastic[i])));
        shares[0] + shares[1] - 1.0
    };
    let size = axes[0].initiation() * axes[0].initiation();
    let mut high = size;
    for _ in 0..200 {
        // NaN, of a component without strength, counts as inside.
        if !(excess(high) > 0.0) {
            break;
        }
        high *= 4.0;
    }
    let y = returned(bisect(0.0, high, excess));
    [0, 1].map(|i| y[i] + elastic[i])
}

/// The growth of one crack strain with the other traction given (eq. 25).
fn one_grows<S: Softening>(axis: &Axis<'_, S>, c: f64, trial: f64, secant: f64) -> f64 {
    let limit = c * axis.semi_axis(0.0);
    if secant == 0.0 || trial <= limit {
        return 0.0;
    }
    let strain = (trial - limit) / secant;
    bisect(0.0, limit + strain, |growth| {
        limit + strain - growth - c * axis.semi_axis(growth)
    })
}
