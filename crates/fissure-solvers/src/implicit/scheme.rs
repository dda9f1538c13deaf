//! How displacement, velocity and acceleration of the nodes go together.
//!
//! With `v`, `a` the velocity and acceleration at the start of the step, `u` the displacement over it, and
//! a dash for the end:
//!
//! ```text
//! θ              v' = u/Δt                          m (v' − v)/Δt = μ f' + (1 − μ) f
//! Newmark        a' = (u − Δt v − Δt² (½ − β) a)/(β Δt²),   v' = v + Δt ((1 − γ) a + γ a')
//! generalised α  m ((1 − α_m) a' + α_m a) = (1 − α_f) f' + α_f f
//!                α_m = (2ρ − 1)/(ρ + 1),  α_f = ρ/(ρ + 1),  γ = ½ − α_m + α_f,  β = (1 − α_m + α_f)²/4
//! ```
//!
//! [Sanchez 2010, eq. 4.2.20; Chung and Hulbert 1993, with the names of their eqs 14 to 17]. Held
//! components follow the prescribed velocity: `u = Δt v'` in the first, `u = Δt (v + v')/2` in the others.

use nalgebra::SVector;

use super::settings::Integration;

/// The numbers of a scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scheme {
    Theta { weight: f64 },
    Alpha(Alpha),
}

/// Those of generalised α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Alpha {
    mass: f64,
    force: f64,
    beta: f64,
    gamma: f64,
}

impl Scheme {
    pub(crate) fn new(integration: Integration) -> Self {
        match integration {
            Integration::Theta { weight } => Self::Theta { weight },
            Integration::Newmark { beta, gamma } => Self::Alpha(Alpha {
                mass: 0.0,
                force: 0.0,
                beta,
                gamma,
            }),
            Integration::GeneralizedAlpha {
                spectral_radius: radius,
            } => {
                let mass = (2.0 * radius - 1.0) / (radius + 1.0);
                let force = radius / (radius + 1.0);
                Self::Alpha(Alpha {
                    mass,
                    force,
                    beta: (1.0 - mass + force).powi(2) / 4.0,
                    gamma: 0.5 - mass + force,
                })
            }
        }
    }

    /// Whether particles carry accelerations from step to step.
    pub(crate) fn carries(&self) -> bool {
        matches!(self, Self::Alpha(_))
    }

    /// The longest stable step, if there is one, over the time that the fastest wave needs across a cell.
    ///
    /// A node's change of velocity reaches it again as `r = S⁺S` of it, `0 ≤ r ≤ 1`, while the displacement has all of it. Of an
    /// oscillator of frequency ω with `q = k/(1 + μ k)`, `k = ω² Δt²`, the step has the trace `2 − q (1 + r μ)` and the
    /// determinant `1 − q (1 + r μ − r)`, and is stable for `q (2 + 2 r μ − r) ≤ 4`: the least for short waves, of which particles
    /// give next to nothing back, `r = 0`. With `ω ≤ 2 c/h` that is `Δt ≤ h/(c √(2 (1 − 2 μ)))`.
    pub(crate) fn longest_step(&self) -> Option<f64> {
        match self {
            Self::Theta { weight } if *weight < 0.5 => {
                Some((2.0 * (1.0 - 2.0 * weight)).sqrt().recip())
            }
            _ => None,
        }
    }

    /// Shares of the forces at the start and at the end of the step that balance inertia.
    pub(crate) fn force_shares(&self) -> (f64, f64) {
        match self {
            Self::Theta { weight } => (1.0 - weight, *weight),
            Self::Alpha(alpha) => (alpha.force, 1.0 - alpha.force),
        }
    }

    /// Derivative of what balances the forces by the displacement, over the mass, 1/s².
    pub(crate) fn inertia(&self, dt: f64) -> f64 {
        match self {
            Self::Theta { .. } => 1.0 / (dt * dt),
            Self::Alpha(alpha) => (1.0 - alpha.mass) / (alpha.beta * dt * dt),
        }
    }

    /// Where Newton's method begins: the displacement at constant velocity and acceleration.
    pub(crate) fn predicted<const D: usize>(&self, start: &Start<D>, dt: f64) -> SVector<f64, D> {
        match self {
            Self::Theta { .. } => start.velocity * dt,
            Self::Alpha(_) => start.velocity * dt + start.acceleration * (0.5 * dt * dt),
        }
    }

    /// Displacement of a held component that starts with one velocity and ends with another.
    pub(crate) fn held(&self, start: f64, end: f64, dt: f64) -> f64 {
        match self {
            Self::Theta { .. } => dt * end,
            Self::Alpha(_) => 0.5 * dt * (start + end),
        }
    }

    /// The node at the end of the step.
    pub(crate) fn end<const D: usize>(
        &self,
        start: &Start<D>,
        displacement: &SVector<f64, D>,
        dt: f64,
    ) -> End<D> {
        match self {
            Self::Theta { .. } => {
                let velocity = displacement / dt;
                let acceleration = (velocity - start.velocity) / dt;
                End {
                    velocity,
                    acceleration,
                    balanced: acceleration,
                }
            }
            Self::Alpha(alpha) => {
                let Start {
                    velocity: v,
                    acceleration: a,
                } = start;
                let rest = displacement - v * dt - a * ((0.5 - alpha.beta) * dt * dt);
                let acceleration = rest / (alpha.beta * dt * dt);
                let mean = a * (1.0 - alpha.gamma) + acceleration * alpha.gamma;
                End {
                    velocity: v + mean * dt,
                    acceleration,
                    balanced: acceleration * (1.0 - alpha.mass) + a * alpha.mass,
                }
            }
        }
    }

    /// Way and shares of the forces (start, end) that make the works of a step.
    ///
    /// With θ they are those that the kinetic energies of the grid balance to round-off.
    pub(crate) fn work<const D: usize>(
        &self,
        start: &SVector<f64, D>,
        end: &SVector<f64, D>,
        displacement: &SVector<f64, D>,
        dt: f64,
    ) -> (SVector<f64, D>, (f64, f64)) {
        match self {
            Self::Theta { .. } => ((start + end) * (0.5 * dt), self.force_shares()),
            Self::Alpha(_) => (*displacement, (0.5, 0.5)),
        }
    }
}

/// A node at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Start<const D: usize> {
    /// m/s.
    pub velocity: SVector<f64, D>,
    /// m/s².
    pub acceleration: SVector<f64, D>,
}

/// A node at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End<const D: usize> {
    /// m/s.
    pub velocity: SVector<f64, D>,
    /// m/s².
    pub acceleration: SVector<f64, D>,
    /// What times the mass balances the forces, m/s².
    pub balanced: SVector<f64, D>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An oscillator of frequency 1 rad/s, thrown from rest: displacement and velocity after `steps` steps.
    fn oscillator(integration: Integration, until: f64, steps: usize) -> (f64, f64) {
        let scheme = Scheme::new(integration);
        let dt = until / steps as f64;
        let (mut x, mut v, mut a) = (0.0, 1.0, 0.0);
        for _ in 0..steps {
            let start = Start {
                velocity: SVector::<f64, 1>::new(v),
                acceleration: SVector::<f64, 1>::new(a),
            };
            let (first, last) = scheme.force_shares();
            let residual = |u: f64| {
                let balanced = scheme.end(&start, &SVector::<f64, 1>::new(u), dt).balanced[0];
                -first * x - last * (x + u) - balanced
            };
            // One Newton iteration, since the residual is linear in u.
            let u = residual(0.0) / (scheme.inertia(dt) + last);
            assert!(residual(u).abs() <= 1e-11 * (1.0 + scheme.inertia(dt)) * (1.0 + u.abs()));
            let end = scheme.end(&start, &SVector::<f64, 1>::new(u), dt);
            (x, v, a) = (x + u, end.velocity[0], end.acceleration[0]);
        }
        (x, v)
    }

    fn order(integration: Integration) -> f64 {
        let error = |steps| {
            let (x, v) = oscillator(integration, 2.0, steps);
            (x - 2.0_f64.sin()).hypot(v - 2.0_f64.cos())
        };
        (error(400) / error(800)).log2()
    }

    #[test]
    fn observed_orders() {
        let theta = |weight| Integration::Theta { weight };
        let alpha = |spectral_radius| Integration::GeneralizedAlpha { spectral_radius };
        let newmark = |beta, gamma| Integration::Newmark { beta, gamma };
        for (integration, expected) in [
            (theta(0.0), 1.0),
            (theta(0.5), 1.0),
            (theta(1.0), 1.0),
            (alpha(0.0), 2.0),
            (alpha(0.5), 2.0),
            (alpha(0.8), 2.0),
            (alpha(1.0), 2.0),
            (newmark(0.25, 0.5), 2.0),
            (newmark(0.36, 0.7), 1.0),
        ] {
            let order = order(integration);
            assert!((order - expected).abs() <= 0.02, "{integration:?}: {order}");
        }
    }

    /// An oscillator of which the particles give back `r` of each change of velocity stays bounded up to the longest step,
    /// whatever `r`; with `r = 0` no farther.
    #[test]
    fn the_longest_step_is_that() {
        for weight in [0.0, 0.1, 0.25, 0.4] {
            let scheme = Scheme::new(Integration::Theta { weight });
            let (first, last) = scheme.force_shares();
            // ω = 2 for waves across two cells that take a unit of time each.
            let size = |share: f64, returned: f64| {
                let dt = share * scheme.longest_step().unwrap();
                let (mut x, mut v) = (1.0_f64, 0.0);
                for _ in 0..20_000 {
                    let start = Start {
                        velocity: SVector::<f64, 1>::new(v),
                        acceleration: SVector::zeros(),
                    };
                    let residual = |u: f64| {
                        let end = scheme.end(&start, &SVector::<f64, 1>::new(u), dt);
                        -4.0 * (first * x + last * (x + u)) - end.balanced[0]
                    };
                    let u = residual(0.0) / (scheme.inertia(dt) + 4.0 * last);
                    let end = scheme.end(&start, &SVector::<f64, 1>::new(u), dt);
                    (x, v) = (x + u, v + returned * (end.velocity[0] - v));
                }
                x.abs()
            };
            for returned in [0.0, 0.25, 0.5, 0.9] {
                assert!(size(0.99, returned) <= 1e3, "{weight} {returned}");
            }
            assert!(!(size(1.01, 0.0) <= 1e6), "{weight}");
        }
        let half = Scheme::new(Integration::Theta { weight: 0.5 });
        assert_eq!(half.longest_step(), None);
    }

    /// Of a motion far too fast for the step the spectral radius is left, step by step.
    #[test]
    fn dissipation_is_what_was_asked_for() {
        for radius in [0.0, 0.3, 0.8, 1.0] {
            let alpha = Integration::GeneralizedAlpha {
                spectral_radius: radius,
            };
            let size = |steps: usize| oscillator(alpha, 1e6 * steps as f64, steps).0.abs();
            // Transients of a double root die out like n ρ^n.
            let left = (size(420) / size(400)).powf(1.0 / 20.0);
            let expected: f64 = radius;
            if expected < 0.5 {
                assert!(size(60) <= 1e-9 * size(1), "{radius}");
            } else {
                assert!((left - expected).abs() <= 0.01, "{radius}: {left}");
            }
        }
    }
}
