//! The shear of the document advanced by increments: on the ellipse that its authors withdrew
//! [Nairn 2017, eqs 20-25], or on a circle as their later code does. For comparing with them.
//!
//! Opening is that of [`AnisotropicDamage`]. The shear traction along two axes in the crack's plane
//! is advanced by the increment of the strain (`ellipse.rs`, `circle.rs`), so that the answer depends
//! on the steps; [`AnisotropicDamage`] is the limit of the circle for short steps, in a step of any
//! size.
//!
//! The ellipse has a damage for either axis and is *not objective*: what it answers depends on the
//! two axes, which nothing physical chooses (sheared along an axis or halfway between them it
//! reaches the same peak of 20 MPa, but just before failure it carries 0.12 or 10.1 MPa).
//! Nor are stored plus dissipated energy the work: with both shears damaged the tractions are not
//! the secant ones that eq. 24 speaks of. Use [`AnisotropicDamage`] for anything but a comparison.
//!
//! The first axis is a principal direction at onset in tension and the direction of the shear at
//! onset in shear. Failure (34) is judged at the end of the step; there is no friction, and the
//! tangent is the difference one.

use fissure_tensor::{Band, Matrix3, Sym, Vector3};
use serde::{Deserialize, Serialize};

use super::crack::Demand;
use super::ellipse::Sheared;
use super::mode::ModeAt;
use super::{AnisotropicDamage, AnisotropicDamageState, MixedMode};
use super::{circle, ellipse};
use crate::error::check_finite;
use crate::softening::Linear;
use crate::{
    Biot, Increment, Material, MaterialError, Response, Scale, SheetStep, Softening,
    check_parameter,
};

const NAME: &str = "incremental anisotropic damage";

/// The document's two shear damages on an ellipse [Nairn 2017, eqs 20-25], withdrawn by its authors:
/// not objective (`OBJECTIVE = false`), and only for reproducing that paper.
pub type EllipticalDamage<N = Linear, T = Linear> = IncrementalDamage<true, N, T>;

/// One shear damage on a circle, stepped as the authors' code does: only for reproducing its
/// histories. [`AnisotropicDamage`] is its limit for short steps.
pub type SteppedCircleDamage<N = Linear, T = Linear> = IncrementalDamage<false, N, T>;

/// Anisotropic damage with the shear advanced by increments, on an ellipse or a circle, for comparison
/// with the authors' results; see [`EllipticalDamage`] and [`SteppedCircleDamage`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncrementalDamage<const ELLIPSE: bool, N = Linear, T = Linear> {
    /// Parameters; without friction.
    pub parameters: AnisotropicDamage<N, T>,
}

/// History of [`IncrementalDamage`]. All zero until a crack starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct IncrementalState {
    /// Unit normal of the crack in the reference configuration; zero if there is none.
    pub normal: [f64; 3],
    /// First axis in the crack's plane.
    pub axis: [f64; 3],
    /// Band of the crack, m.
    pub width: f64,
    /// Dimensionless opening up to which the crack has softened.
    pub opened: f64,
    /// Dimensionless slidings along the two axes up to which it has softened; the first alone on a
    /// circle.
    pub sheared: [f64; 2],
    /// Shear strain of the crack along the two axes now (engineering).
    pub shear_strain: [f64; 2],
    /// Opening now, m.
    pub opening: f64,
    /// Whether the crack carries nothing any more.
    pub failed: bool,
}

impl IncrementalState {
    fn frame(&self) -> [Vector3<f64>; 3] {
        let (normal, axis) = (Vector3::from(self.normal), Vector3::from(self.axis));
        [normal, axis, normal.cross(&axis)]
    }
}

/// The modes of one particle.
struct Modes<'a, N, T> {
    opening: ModeAt<'a, N>,
    shear: ModeAt<'a, T>,
}

impl<N: Softening, T: Softening> Modes<'_, N, T> {
    /// Energy dissipated so far, J/m³: eq. 31 for each of the three.
    fn spent(&self, state: &IncrementalState) -> f64 {
        let [first, second] = state.sheared.map(|s| self.shear.dissipated_fraction(s));
        let opening = self.opening.dissipated_fraction(state.opened);
        (opening * self.opening.toughness + (first + second) * self.shear.toughness) / state.width
    }

    /// The sum of (34).
    fn criterion(&self, state: &IncrementalState, mixed: &MixedMode) -> f64 {
        let (m, n) = match mixed {
            MixedMode::Coupled {
                opening_exponent,
                shear_exponent,
            } => (*opening_exponent, *shear_exponent),
            MixedMode::Uncoupled => return 0.0,
        };
        let [first, second] = state
            .sheared
            .map(|s| self.shear.dissipated_fraction(s).powf(n));
        self.opening.dissipated_fraction(state.opened).powf(m) + first + second
    }
}

impl<const ELLIPSE: bool, N: Softening, T: Softening> IncrementalDamage<ELLIPSE, N, T> {
    /// With the parameters of the law.
    pub fn new(parameters: AnisotropicDamage<N, T>) -> Self {
        Self { parameters }
    }

    fn modes<const SHEET: bool>(&self, width: f64, scale: &Scale) -> Modes<'_, N, T> {
        let elastic = self.parameters.elastic_at::<SHEET>(scale);
        Modes {
            opening: self
                .parameters
                .opening
                .at(elastic.p_wave_modulus(), width, scale),
            shear: self
                .parameters
                .shear
                .at(elastic.shear_modulus(), width, scale),
        }
    }

    /// A new crack, if the stress asks for one.
    fn started<const SHEET: bool>(
        &self,
        stress: &Sym,
        kinematics: &Biot,
        band: &Band,
        scale: &Scale,
    ) -> Result<Option<IncrementalState>, MaterialError> {
        let surface = self.parameters.surface::<SHEET>(scale);
        if surface.is_surely_below(stress) {
            return Ok(None);
        }
        let initiation = surface.asked(stress).initiation;
        if !(initiation.value > 0.0) {
            return Ok(None);
        }
        let normal = initiation.normal;
        let width = band.width(&(kinematics.rotation * normal));
        self.parameters.check_width::<SHEET>(width, scale)?;
        // Along the shear if there is one, else along a principal direction.
        let traction = stress.traction(&normal);
        let shear = traction - normal * normal.dot(&traction);
        let axis = if shear.norm() > 1e-6 * stress.max_abs() {
            shear
        } else {
            let vectors = stress.spectrum().vectors;
            let across = vectors
                .into_iter()
                .min_by(|a, b| normal.dot(a).abs().total_cmp(&normal.dot(b).abs()));
            across.unwrap_or_else(|| normal.cross(&Vector3::ith(normal.iamin(), 1.0)))
        };
        let axis = (axis - normal * normal.dot(&axis)).normalize();
        Ok(Some(IncrementalState {
            normal: normal.into(),
            axis: axis.into(),
            width,
            ..IncrementalState::default()
        }))
    }

    /// The strain of the increment's start and end, without heat.
    fn strains(&self, increment: &Increment, end: &Biot) -> (Sym, Sym) {
        let heat =
            Sym::IDENTITY * (self.parameters.thermal_expansion * increment.external.temperature);
        let to = end.strain() - heat;
        let from = Biot::new(&increment.f_old).map_or(to, |start| start.strain() - heat);
        (from, to)
    }

    fn updated<const SHEET: bool>(
        &self,
        increment: &Increment,
        old: &IncrementalState,
    ) -> Result<Response<IncrementalState>, MaterialError> {
        let scale = &increment.external.scale;
        let elastic = self.parameters.elastic_at::<SHEET>(scale);
        let kinematics = Biot::new(&increment.f_new)?;
        let (from, to) = self.strains(increment, &kinematics);
        let undamaged = elastic.stress(&to);
        let mut state = *old;
        if state.width == 0.0 {
            match self.started::<SHEET>(&undamaged, &kinematics, &increment.band, scale)? {
                Some(started) => state = started,
                None => {
                    return Ok(Response {
                        stress: kinematics.turned(&undamaged),
                        state,
                        stored: 0.5 * undamaged.dot(&to),
                        dissipated: 0.0,
                    });
                }
            }
        }
        let modes = self.modes::<SHEET>(state.width, scale);
        let before = modes.spent(&state);
        let [normal, first, second] = state.frame();
        let [start, end] = [from, to].map(|strain| Demand::new(&elastic, &normal, &strain));
        let [old_shear, shear] = [start, end].map(|d| [d.shear.dot(&first), d.shear.dot(&second)]);
        let mut released = 0.0;
        if !state.failed {
            if let Some(opened) = modes.opening.soften(end.normal, state.opened) {
                state.opened = opened;
            }
            let moved = if ELLIPSE {
                ellipse::moved
            } else {
                circle::moved
            };
            let sheared = moved(
                &modes.shear,
                &Sheared {
                    softened: state.sheared,
                    traction: [0, 1].map(|i| old_shear[i] - state.shear_strain[i]),
                },
                [0, 1].map(|i| shear[i] - old_shear[i]),
            );
            state.sheared = sheared.softened;
            // Kept to the last bit by a zero increment.
            if shear != old_shear || state.width != old.width {
                state.shear_strain = [0, 1].map(|i| shear[i] - sheared.traction[i]);
            }
            if modes.criterion(&state, &self.parameters.mixed) >= 1.0 {
                let open = end.normal.max(0.0);
                let opening = modes.opening.integrity(state.opened) * modes.opening.modulus;
                released = 0.5 * opening * open * open
                    + stored_in_shear(&modes.shear, &state, &sheared.traction, ELLIPSE);
                state.failed = true;
            }
        }
        let mut integrity = modes.opening.integrity(state.opened);
        if state.failed {
            integrity = 0.0;
            state.shear_strain = shear;
        }
        let normal_strain = (1.0 - integrity) * end.normal.max(0.0);
        state.opening = normal_strain * state.width;
        let sliding = first * state.shear_strain[0] + second * state.shear_strain[1];
        let crack = Sym::dyad(&normal) * normal_strain + Sym::dyad_of(&normal, &sliding);
        let biot_stress = undamaged - elastic.stress(&crack);
        let traction = [0, 1].map(|i| shear[i] - state.shear_strain[i]);
        // Without the crack's shear, and then what the secant shear holds.
        let rest = 0.5 * biot_stress.dot(&(to - Sym::dyad_of(&normal, &end.shear)));
        let stored = rest + stored_in_shear(&modes.shear, &state, &traction, ELLIPSE);
        let spent = modes.spent(&state) - before + released;
        let response = Response {
            stress: kinematics.turned(&biot_stress),
            state,
            stored,
            // `max` would hide a NaN.
            dissipated: if spent < 0.0 { 0.0 } else { spent },
        };
        check_finite(NAME, response)
    }
}

impl<const ELLIPSE: bool, N: Softening, T: Softening> Material
    for IncrementalDamage<ELLIPSE, N, T>
{
    type State = IncrementalState;
    /// On the ellipse the answer depends on the axes in the crack's plane.
    const OBJECTIVE: bool = !ELLIPSE;
    const HYPERELASTIC: bool = false;
    const SPARSE: bool = true;
    const NAMES: &'static [&'static str] =
        &["opening", "opened", "sheared_1", "sheared_2", "failed"];

    fn check(&self) -> Result<(), MaterialError> {
        self.parameters.check()?;
        let friction = self.parameters.friction;
        check_parameter(
            NAME,
            "friction",
            friction,
            friction == 0.0,
            "0: it has none",
        )
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.parameters.check_band(band, scale)
    }

    fn started_width(&self, old: &IncrementalState, new: &IncrementalState) -> f64 {
        if old.width == 0.0 { new.width } else { 0.0 }
    }

    fn isotropic(&self) -> bool {
        false
    }

    fn continuous(&self) -> bool {
        false
    }

    fn density(&self) -> f64 {
        self.parameters.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, _state: &IncrementalState, scale: &Scale) -> f64 {
        self.parameters
            .wave_speed(f, &AnisotropicDamageState::default(), scale)
    }

    fn has_history(&self, state: &IncrementalState) -> bool {
        state.width != 0.0
    }

    fn update(
        &self,
        increment: &Increment,
        old: &IncrementalState,
    ) -> Result<Response<IncrementalState>, MaterialError> {
        self.updated::<false>(increment, old)
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &IncrementalState,
        _with_tangent: bool,
    ) -> Result<Option<SheetStep<IncrementalState>>, MaterialError> {
        let Some(flat) = self.parameters.flattened(increment) else {
            return Ok(None);
        };
        let response = self.updated::<true>(&flat, old)?;
        let thickening = self.parameters.thickening(&flat, &response.stress)?;
        Ok(Some(SheetStep {
            response,
            thickening,
            tangent: None,
        }))
    }

    fn values(&self, state: &IncrementalState, out: &mut [f64]) {
        out[0] = state.opening;
        out[1] = state.opened;
        out[2] = state.sheared[0];
        out[3] = state.sheared[1];
        out[4] = f64::from(u8::from(state.failed));
    }
}

/// `Σ τ_i²/(2 (1−d_i) G)` of tractions over `G`, J/m³.
fn stored_in_shear<T: Softening>(
    shear: &ModeAt<'_, T>,
    state: &IncrementalState,
    traction: &[f64; 2],
    ellipse: bool,
) -> f64 {
    let terms = [0, 1].map(|i| {
        let softened = if ellipse {
            state.sheared[i]
        } else {
            state.sheared[0]
        };
        let integrity = shear.integrity(softened);
        if state.failed || integrity == 0.0 {
            0.0
        } else {
            traction[i] * traction[i] / integrity
        }
    });
    0.5 * shear.modulus * (terms[0] + terms[1])
}

mod cracking;
#[cfg(test)]
mod tests;
