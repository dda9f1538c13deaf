//! Elastic-decohesive law with several failure planes at a point [Sanchez 2010, sec. 3.5.3, 4.5].
//!
//! `ε = εᵉ + Σ_j sym(u_j ⊗ n_j)/L_j` (4.5.15), `T = C:εᵉ`, with the Biot strain, so that the law is
//! objective. What starts, opens and closes a plane is its [`Decohesion`]: [`ModeOne`] or
//! [`GeologicalFlow`]. All planes are returned together, until every `F_j` is within round-off of
//! zero or below; the document's single pass over the planes leaves earlier ones violated by later.
//!
//! # When the coupled return is unique, and the threshold angle
//! In opening, active planes `N_j = n_j ⊗ n_j` with softening moduli `h_j = τ L_j/u₀` (any curve:
//! `h = τ² L steepest/G`) solve a system with the matrix `A_jk = N_j:C:N_k − h_j δ_jk`,
//! `N_j:C:N_k = λ + 2μ cos²θ_jk`. One plane: `λ + 2μ > h`, the band limit (4.5.17). Two planes:
//! `A` is positive definite only if `(λ + 2μ − h)² > (λ + 2μ cos²θ)²`, that is
//! ```text
//! 2μ sin²θ > h                                                      (threshold)
//! ```
//! The `N_j` span three dimensions in the plane and six in space, so more than three or six active
//! softening planes always are dependent, `A` is indefinite and the return is not unique. The law
//! therefore
//! - starts a new plane only if its normal is at least the threshold angle from all others, and
//!   refuses a threshold angle below the bound;
//! - selects the order of returns by a rule that does not see the storage order (`relax`), which in
//!   opening descends to a local minimum of the incremental potential, unique where `A` is positive
//!   definite.
//!
//! In a direction nearer than the threshold angle to a plane the stress may exceed the strength; no
//! plane starts there, nor anywhere once `N` planes are stored.
//!
//! # Variants
//! [`Planes::Fixed`] keeps the first plane alone. [`Planes::Multiple`] adds planes. [`Planes::Rotating`]
//! is one plane whose normal is the first principal direction of the strain in every step: its
//! traction has no shear by construction; where two principal strains cross, it changes direction
//! at once and the response is steep. Its band is that of its first direction: one that followed would change the
//! strain `u/L` at the same opening, work that the softening curve does not know of.

mod cracking;
mod decohesion;
mod dense;
mod geological_flow;
mod law;
mod mode_one;
mod relax;
mod start;
mod state;
mod tangent;
#[cfg(test)]
mod tests;
mod turn;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};

pub use decohesion::{Decohesion, Rank, Trial};
pub use geological_flow::GeologicalFlow;
pub use mode_one::{ModeOne, Shear, Unloading};
pub use state::{MultiCrackState, Plane};

use crate::{
    Biot, Increment, Isotropic, MaterialError, Response, Scale,
    error::{check_below, check_scaled_toughness},
    sound::sound,
    stress_measure::Conjugate,
    turning::{Turning, width_rate},
};
use relax::{elastic_strain, relax};
use start::Next;
use tangent::{Turn, coupled, given, stress_rate};

const NAME: &str = "elastic-decohesive law with several planes";

/// Least angle between planes where the bound is smaller: 15°.
const LEAST_THRESHOLD: f64 = std::f64::consts::PI / 12.0;

/// How many planes there are and whether they turn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Planes {
    /// One, with the normal with which it starts.
    #[default]
    Fixed,
    /// Up to `N`, at least this angle apart, radians, in (0, π/2]. `None`: the larger of 15° and
    /// the bound of uniqueness of the widest direction with a reserve of a quarter, `sin²θ = 1.25 h/(2μ)`.
    Multiple(Option<f64>),
    /// One that follows the first principal direction of the strain.
    Rotating,
}

/// The law: elasticity, what planes do, and how many there are (at most `N`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultiCrack<const N: usize, D> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// What starts, opens and closes a plane.
    pub decohesion: D,
    /// How many planes there are and whether they turn.
    pub planes: Planes,
}

/// What a step came to.
struct Step<const N: usize> {
    kinematics: Biot,
    strain: Sym,
    biot_stress: Sym,
    /// Where the planes started from, those that started in the step included.
    start: MultiCrackState<N>,
    state: MultiCrackState<N>,
    /// Whether no closed form says how the planes follow the strain: they were returned in turn (see
    /// [`Relaxed`](relax::Relaxed)), or the end is on an edge ([`Next::Edge`]).
    has_no_rate: bool,
}

impl<const N: usize, D: Decohesion> MultiCrack<N, D> {
    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            elastic: self.elastic.scaled(scale),
            decohesion: self.decohesion.scaled(scale),
            planes: self.planes,
        }
    }

    /// Largest band with a unique response of one plane, m (4.5.17).
    fn limit(&self) -> f64 {
        self.elastic.p_wave_modulus() / self.decohesion.steepest()
    }

    fn check_width(&self, width: f64) -> Result<(), MaterialError> {
        check_scaled_toughness(NAME, self.decohesion.toughness())?;
        check_below(NAME, width, self.limit())
    }

    /// `sin²` of the least angle between planes over a band of this width for which the return of
    /// two is unique, `h/(2μ)`; over 1 if no angle will do.
    pub fn unique_above(&self, width: f64) -> f64 {
        self.decohesion.steepest() * width / (2.0 * self.elastic.shear_modulus())
    }

    /// `sin²` of the threshold angle that a further plane keeps from this one. Of two planes the wider band is the less
    /// stable; it is that of the widest direction, so that directions to keep from are a cone.
    fn threshold(&self, plane: &Plane, band: &Band) -> f64 {
        if let Planes::Multiple(Some(angle)) = self.planes {
            return angle.sin().powi(2);
        }
        let width = band.max_width().max(plane.width);
        (1.25 * self.unique_above(width)).max(LEAST_THRESHOLD.sin().powi(2))
    }

    /// Most planes allowed.
    fn most(&self) -> usize {
        match self.planes {
            Planes::Fixed | Planes::Rotating => N.min(1),
            Planes::Multiple(_) => N,
        }
    }

    /// The law of one particle (see [`Self::scaled`]) over a step.
    fn step<const SHEET: bool>(
        &self,
        f: &Matrix3<f64>,
        band: &Band,
        old: &MultiCrackState<N>,
    ) -> Result<Step<N>, MaterialError> {
        let kinematics = Biot::new(f)?;
        let strain = kinematics.strain();
        let mut start = *old;
        if self.planes == Planes::Rotating {
            turn(start.planes_mut(), &leading::<SHEET>(&strain));
        }
        let (mut state, mut has_no_rate) = (start, false);
        let (elastic, decohesion) = (&self.elastic, &self.decohesion);
        loop {
            let planes = state.planes_mut();
            let relaxed = relax(decohesion, elastic, &strain, start.planes(), planes)?;
            let stress = relaxed.stress;
            has_no_rate |= relaxed.in_turn;
            let next = self.starting::<SHEET>(&stress, &state, &kinematics, band)?;
            let Next::Start(plane) = next else {
                has_no_rate |= matches!(next, Next::Edge);
                return Ok(Step {
                    kinematics,
                    strain,
                    biot_stress: stress,
                    start,
                    state,
                    has_no_rate,
                });
            };
            start.push(plane);
            state.push(plane);
        }
    }

    fn response(
        &self,
        step: &Step<N>,
        old: &MultiCrackState<N>,
    ) -> Result<Response<MultiCrackState<N>>, MaterialError> {
        let planes = step.state.planes();
        let elastic_strain = elastic_strain(&step.strain, planes);
        let mut stored = 0.5 * step.biot_stress.dot(&elastic_strain);
        let mut dissipated = 0.0;
        for (index, plane) in planes.iter().enumerate() {
            // A plane of before as it was, turned or not; one that started as it started.
            let before = match old.planes().get(index) {
                Some(before) => *before,
                None => step.start.planes()[index],
            };
            stored += self.decohesion.stored(&self.elastic, plane) / plane.width;
            let trial = self.trial(&step.biot_stress, plane);
            let lost = self.decohesion.dissipated(&before, plane, &trial);
            dissipated += lost / plane.width;
        }
        let stress = step.kinematics.cauchy(&step.biot_stress);
        // In units in which a square overflows the energies do before the stress.
        if !(stress.is_finite() && stored.is_finite() && dissipated.is_finite()) {
            return Err(MaterialError::NotFinite { law: NAME });
        }
        Ok(Response {
            stress,
            state: step.state,
            stored,
            dissipated,
        })
    }
}

impl<const N: usize, D: Decohesion> MultiCrack<N, D> {
    /// The update of one particle (see [`Self::scaled`]), in a solid or with the constants of a sheet.
    fn respond<const SHEET: bool>(
        &self,
        increment: &Increment,
        old: &MultiCrackState<N>,
    ) -> Result<Response<MultiCrackState<N>>, MaterialError> {
        if old.planes().is_empty() {
            // A margin for round-off: the exact test decides at the surface.
            let accepts = |stress: &Sym| self.decohesion.upper_bound(stress) < -1e-9;
            if let Some(response) = sound::<Conjugate, _>(&self.elastic, &increment.f_new, accepts)
            {
                return Ok(response);
            }
        }
        let step = self.step::<SHEET>(&increment.f_new, &increment.band, old)?;
        self.response(&step, old)
    }

    /// What a plane sees at the end of a step.
    fn trial(&self, stress: &Sym, plane: &Plane) -> Trial {
        Trial {
            elastic: self.elastic,
            stress: *stress + self.elastic.stress(&plane.strain()),
            slack: 0.0,
        }
    }

    /// The spatial tangent at a thickness that stays; `None` if the planes' does not converge or has no closed form.
    fn tangent_of<const SHEET: bool>(
        &self,
        step: &Step<N>,
        band: &Band,
        old: &MultiCrackState<N>,
    ) -> Option<Tangent> {
        if step.has_no_rate {
            return None;
        }
        let kinematics = &step.kinematics;
        let started = step.state.planes().len() > old.planes().len();
        if !started && self.planes != Planes::Rotating {
            let rates = self.release_rates(&step.start, &step.state, &step.biot_stress);
            let modulus = coupled(&self.elastic, step.state.planes(), &rates)?;
            return Some(kinematics.spatial_tangent(&step.biot_stress, &modulus));
        }
        let rate = |strain_rate: &Sym, rotation_rate: &Matrix3<f64>| {
            let rate = self.turning_rate::<SHEET>(step, band, old, strain_rate, rotation_rate);
            rate.unwrap_or(Sym::ZERO * f64::NAN)
        };
        let tangent = kinematics.conjugate_tangent(&step.biot_stress, rate);
        tangent.is_finite().then_some(tangent)
    }

    fn release_rates(
        &self,
        start: &MultiCrackState<N>,
        state: &MultiCrackState<N>,
        stress: &Sym,
    ) -> [[Sym; 3]; N] {
        let mut rates = [[Sym::ZERO; 3]; N];
        let planes = start.planes().iter().zip(state.planes());
        for (rate, (start, plane)) in rates.iter_mut().zip(planes) {
            *rate = self
                .decohesion
                .release_rate(start, plane, &self.trial(stress, plane));
        }
        rates
    }

    /// Rate of the stress in a step in which planes turn, with those of strain and rotation: the step again, plane by plane as
    /// they start, since each turns with the stress that those before it have left.
    fn turning_rate<const SHEET: bool>(
        &self,
        step: &Step<N>,
        band: &Band,
        old: &MultiCrackState<N>,
        strain_rate: &Sym,
        rotation_rate: &Matrix3<f64>,
    ) -> Option<Sym> {
        let mut start = MultiCrackState::from_planes(&step.start.planes()[..old.planes().len()]);
        let mut state = start;
        let mut turns = [Turn::default(); N];
        let rotating = self.planes == Planes::Rotating;
        let led = leading::<SHEET>(&step.strain);
        let follow = |normal: &Vector3<f64>| Turning::principal(&led, normal).rate(strain_rate);
        if rotating {
            for (turn, plane) in turns.iter_mut().zip(start.planes()) {
                turn.normal = follow(&plane.normal());
            }
        }
        loop {
            let planes = state.planes_mut();
            let mut stress = relax(
                &self.decohesion,
                &self.elastic,
                &step.strain,
                start.planes(),
                planes,
            )
            .ok()?
            .stress;
            let rates = self.release_rates(&start, &state, &stress);
            let mut besides = [Sym::ZERO; N];
            for (index, plane) in start.planes().iter().enumerate() {
                let trial = self.trial(&stress, &state.planes()[index]);
                besides[index] = given(&self.decohesion, plane, &turns[index], &trial);
            }
            let planes = state.planes();
            let mut rate = stress_rate(&self.elastic, planes, &rates, &besides, strain_rate)?;
            let count = planes.len();
            let Some(plane) = step.start.planes().get(count) else {
                return Some(rate);
            };
            let normal = plane.normal();
            let turn = if rotating {
                follow(&normal)
            } else {
                if SHEET {
                    (stress.mandel[2], rate.mandel[2]) = (0.0, 0.0);
                }
                let threshold = |plane: &Plane| self.threshold(plane, band);
                let turned = turns.map(|turn| turn.normal);
                let stresses = [&stress, &rate];
                start::normal_rate(
                    &self.decohesion,
                    stresses,
                    planes,
                    &turned[..count],
                    &normal,
                    threshold,
                )
            };
            let spatial = step.kinematics.rotation * normal;
            let turning = rotation_rate * normal + step.kinematics.rotation * turn;
            turns[count] = Turn {
                normal: turn,
                width: width_rate(band, &spatial, &turning),
            };
            start.push(*plane);
            state.push(*plane);
        }
    }
}

/// The strain whose first principal direction a rotating plane follows: in a sheet that of the strains in its plane. A plane
/// along the sheet would open against no stress at all, and the thickness would leap to where it has none.
fn leading<const SHEET: bool>(strain: &Sym) -> Sym {
    let mut strain = *strain;
    if SHEET {
        strain.mandel[2] = -2.0 * strain.norm();
    }
    strain
}

/// Turns planes to the first principal direction of a strain; the opening goes along.
fn turn(planes: &mut [Plane], strain: &Sym) {
    for plane in planes {
        let normal = strain.spectrum().vectors[0];
        if plane.normal() == normal {
            continue; // a zero increment moves no bit
        }
        let traction = plane.normal().dot(&Vector3::from(plane.traction));
        plane.normal = normal.into();
        plane.traction = (normal * traction).into();
    }
}
