//! Anisotropic damage of anisotropic elastic material on its planes of symmetry
//! [Nairn 2017, sec. 2.5.3, eq. 44].
//!
//! For a stiffness `C` and a crack of normal `n`, eq. 44 takes `D_ij = C_ij d_j/C_jj` with damage in
//! the components 1, 5, 6 of the crack's axes alone, that is crack strains
//! `d_i ε_n,i`, `ε_n,i = Σ_j C_ij ε_j/C_ii`. With the stress `T⁰ = C:E` of the sound material:
//!
//! 1. `ε_n = T⁰_nn/K_n` and `γ_i = n·T⁰·a_i/G_i`, with `K_n = n⊗n:C:n⊗n` and `a_i`, `G_i` the principal
//!    axes and values of the shear stiffness `a·(C:sym(n⊗b))·n` in the plane;
//! 2. `T = C:(E − d_n⟨ε_n⟩ n⊗n − d_t sym(n⊗γ))`, hence `T_n = (1−d_n) K_n ε_n`, `τ_i = (1−d_t) G_i γ_i`.
//!
//! The conjecture holds where `C_15 = C_16 = C_56 = 0` on the crack's axes: elsewhere a traction
//! `−C_15 ε_n,5 − …` is left on a failed crack. So cracks form on given planes, and
//! [`check`](Material::check) refuses a plane whose normal and shear tractions are coupled in the
//! elastic material. Planes of symmetry of an orthotropic material are such planes.
//!
//! One shear damage: with `Ḡ = √(G₁G₂)` it is the traction `τ_i √(Ḡ/G_i)` that is bounded by a circle.
//! Scaled so, the damage follows from a stored energy, and the energy to failure is `𝒢_II` whatever
//! the direction; the strength along `a_i` is `τ_t √(G_i/Ḡ)`, fixed to the material, so that the law is
//! objective. Everything else is as in [`AnisotropicDamage`](crate::AnisotropicDamage), whose law on a
//! prescribed plane this is for an isotropic stiffness.

mod cracking;
mod plane;
mod sheet;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};

use self::plane::PlaneAt;
use super::crack::{AnisotropicDamageState, CrackAt, Moved};
use super::mixed_mode::MixedMode;
use super::mode::Mode;
use crate::error::{check_below, check_finite, check_scaled_toughness};
use crate::softening::Linear;
use crate::turning::width_rate;
use crate::{
    Biot, Increment, Initiation, Material, MaterialError, Response, Scale, SheetStep, Softening,
    check_parameter,
};

const NAME: &str = "orthotropic damage";

/// A plane on which a crack can start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamagePlane<N = Linear, T = Linear> {
    /// Its normal in the reference configuration; need not be of unit length.
    pub normal: Vector3<f64>,
    /// Strength, toughness and softening in opening.
    pub opening: Mode<N>,
    /// Strength, toughness and softening in sliding; the strength is that along a direction in
    /// which the shear modulus is `Ḡ`.
    pub shear: Mode<T>,
}

/// Parameters of anisotropic damage on `P` > 0 planes of an anisotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthotropicDamage<const P: usize, N = Linear, T = Linear> {
    /// Reference mass density ρ, kg/m³; > 0.
    pub density: f64,
    /// Elasticity tensor in the reference axes, Pa; symmetric and positive definite.
    pub stiffness: Tangent,
    /// The planes; the first whose surface is exceeded most gets the crack.
    pub planes: [DamagePlane<N, T>; P],
    /// When a crack that opens and slides has failed.
    pub mixed: MixedMode,
}

struct Step {
    strain: Sym,
    biot_stress: Sym,
    crack: Option<(PlaneAt, Moved)>,
    started: bool,
}

impl<const P: usize, N: Softening, T: Softening> OrthotropicDamage<P, N, T> {
    fn plane_at(&self, index: usize, scale: &Scale) -> PlaneAt {
        let stiffness = self.stiffness * scale.stiffness;
        PlaneAt::new(&stiffness, &self.planes[index].normal)
    }

    /// Index of the plane of a state's crack.
    fn index(&self, state: &AnisotropicDamageState) -> usize {
        let normal = Vector3::from(state.normal);
        let same = |plane: &DamagePlane<N, T>| plane.normal.normalize() == normal;
        self.planes.iter().position(same).unwrap_or(0)
    }

    fn crack_at(
        &self,
        index: usize,
        plane: &PlaneAt,
        width: f64,
        scale: &Scale,
    ) -> CrackAt<'_, N, T> {
        let modes = &self.planes[index];
        CrackAt {
            opening: modes.opening.at(plane.across, width, scale),
            shear: modes.shear.at(plane.along, width, scale),
            mixed: self.mixed,
            friction: 0.0,
            normal: plane.normal,
        }
    }

    /// The failure function on one plane.
    fn value(&self, index: usize, stress: &Sym, scale: &Scale) -> Initiation {
        let plane = self.plane_at(index, scale);
        let modes = &self.planes[index];
        let traction = stress.traction(&plane.normal);
        let tension = plane.normal.dot(&traction) / (modes.opening.strength * scale.strength);
        // τ_i √(Ḡ/G_i): the stiffness to sliding over G_i, along a_i.
        let scaled = [0, 1].map(|i| {
            let stiffness = plane.axes[i].dot(&plane.sliding[i].traction(&plane.normal));
            plane.axes[i].dot(&traction) * plane.along / stiffness
        });
        let shear = scaled[0].hypot(scaled[1]) / (modes.shear.strength * scale.strength);
        Initiation {
            value: tension.max(shear) - 1.0,
            normal: plane.normal,
        }
    }

    fn asked(&self, stress: &Sym, scale: &Scale) -> (usize, Initiation) {
        const { assert!(P > 0, "at least one plane") };
        let mut best = (0, self.value(0, stress, scale));
        for index in 1..P {
            let here = self.value(index, stress, scale);
            if here.value > best.1.value {
                best = (index, here);
            }
        }
        best
    }

    fn limit(&self, index: usize, scale: &Scale) -> f64 {
        let plane = self.plane_at(index, scale);
        let crack = self.crack_at(index, &plane, 1.0, scale);
        crack.opening.band_limit().min(crack.shear.band_limit())
    }

    fn check_width(&self, index: usize, width: f64, scale: &Scale) -> Result<(), MaterialError> {
        let plane = &self.planes[index];
        for mode in [plane.opening.toughness, plane.shear.toughness] {
            check_scaled_toughness(NAME, mode * scale.toughness)?;
        }
        check_below(NAME, width, self.limit(index, scale))
    }

    fn step(
        &self,
        kinematics: &Biot,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Step, MaterialError> {
        let scale = &increment.external.scale;
        let strain = kinematics.strain();
        let undamaged = self.stiffness.apply(&strain) * scale.stiffness;
        let (mut state, mut index, mut started) = (*old, self.index(old), false);
        if state.width == 0.0 {
            let (asked, initiation) = self.asked(&undamaged, scale);
            if !(initiation.value > 0.0) {
                return Ok(Step {
                    strain,
                    biot_stress: undamaged,
                    crack: None,
                    started,
                });
            }
            (index, started) = (asked, true);
            state.normal = initiation.normal.into();
            state.width = increment
                .band
                .width(&(kinematics.rotation * initiation.normal));
            self.check_width(index, state.width, scale)?;
        }
        let plane = self.plane_at(index, scale);
        let crack = self.crack_at(index, &plane, state.width, scale);
        let moved = crack.moved(&state, &plane.demand(&strain), || {
            let from = Biot::new(&increment.f_old).map_or(strain, |old| old.strain());
            plane.demand(&from)
        });
        Ok(Step {
            strain,
            biot_stress: undamaged - plane.relief(&moved),
            crack: Some((plane, moved)),
            started,
        })
    }

    /// Rate of `T` with those of strain and rotation.
    fn rates(
        &self,
        kinematics: &Biot,
        step: &Step,
        increment: &Increment,
    ) -> impl Fn(&Sym, &Matrix3<f64>) -> Sym {
        let stiffness = self.stiffness * increment.external.scale.stiffness;
        let modulus = match &step.crack {
            Some((plane, moved)) => plane.modulus(&stiffness, moved),
            None => stiffness,
        };
        move |strain_rate, rotation_rate| {
            let rate = modulus.apply(strain_rate);
            // In its first step the crack's band follows the rotation.
            let Some((plane, moved)) = step.crack.as_ref().filter(|_| step.started) else {
                return rate;
            };
            let spatial = kinematics.rotation * plane.normal;
            let turning = rotation_rate * plane.normal;
            let widening = width_rate(&increment.band, &spatial, &turning) / moved.state.width;
            let [opening, sliding] = moved.slopes.widening;
            let along = plane.sliding_stress(&moved.slopes.direction);
            let per_width =
                plane.opening * (opening / plane.across) + along * (sliding / plane.along);
            rate + per_width * widening
        }
    }

    /// The response, if units near the largest and the smallest numbers have left it finite.
    fn checked(
        response: Response<AnisotropicDamageState>,
    ) -> Result<Response<AnisotropicDamageState>, MaterialError> {
        let state = &response.state;
        if !(state.opened + state.sheared + state.opening + state.left_over).is_finite() {
            return Err(MaterialError::NotFinite { law: NAME });
        }
        check_finite(NAME, response)
    }

    fn response(
        kinematics: &Biot,
        step: &Step,
        old: &AnisotropicDamageState,
    ) -> Response<AnisotropicDamageState> {
        let crack = step.crack.as_ref();
        Response {
            stress: kinematics.turned(&step.biot_stress),
            state: crack.map_or(*old, |(_, moved)| moved.state),
            stored: 0.5 * step.biot_stress.dot(&step.strain),
            dissipated: crack.map_or(0.0, |(_, moved)| moved.dissipated),
        }
    }
}

impl<const P: usize, N: Softening, T: Softening> Material for OrthotropicDamage<P, N, T> {
    type State = AnisotropicDamageState;
    const HYPERELASTIC: bool = false;
    const STEP_ERROR: f64 = 0.0;
    const SPARSE: bool = true;
    const NAMES: &'static [&'static str] = &["opening", "opened", "sheared", "left_over", "failed"];

    fn check(&self) -> Result<(), MaterialError> {
        let density = self.density;
        check_parameter(NAME, "density", density, density > 0.0, "finite and > 0")?;
        let asymmetry = (self.stiffness - Tangent(self.stiffness.0.transpose())).max_abs()
            / self.stiffness.max_abs();
        let rule = "symmetric to 1e-9, finite";
        check_parameter(NAME, "stiffness", asymmetry, asymmetry <= 1e-9, rule)?;
        let least = self
            .stiffness
            .symmetric_part()
            .0
            .symmetric_eigenvalues()
            .min();
        check_parameter(NAME, "stiffness", least, least > 0.0, "positive definite")?;
        for (index, plane) in self.planes.iter().enumerate() {
            let length = plane.normal.norm();
            check_parameter(NAME, "normal", length, length > 0.0, "finite, not zero")?;
            plane
                .opening
                .check(NAME, ["opening.strength", "opening.toughness"])?;
            plane
                .shear
                .check(NAME, ["shear.strength", "shear.toughness"])?;
            let coupling = self.plane_at(index, &Scale::default()).coupling;
            check_parameter(
                NAME,
                "coupling of normal and shear traction",
                coupling,
                coupling <= 1e-9,
                "0: a plane of symmetry",
            )?;
        }
        self.mixed.check(NAME)
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        (0..P).try_for_each(|index| {
            let width = band.width(&self.planes[index].normal.normalize());
            self.check_width(index, width, scale)
        })
    }

    fn started_width(&self, old: &AnisotropicDamageState, new: &AnisotropicDamageState) -> f64 {
        if old.width == 0.0 { new.width } else { 0.0 }
    }

    fn isotropic(&self) -> bool {
        false
    }

    /// The drop of (34), and in a step beyond the surface the switch between planes, are jumps.
    fn continuous(&self) -> bool {
        self.mixed == MixedMode::Uncoupled && P == 1
    }

    fn density(&self) -> f64 {
        self.density
    }

    /// From a bound of the largest eigenvalue of the stiffness (the largest sum of a row), times
    /// the square of the longest stretch as in [`AnisotropicDamage`](crate::AnisotropicDamage).
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &AnisotropicDamageState, scale: &Scale) -> f64 {
        let rows = self.stiffness.0.row_iter();
        let sums = rows.map(|row| row.iter().map(|c| c.abs()).sum::<f64>());
        let largest = sums.fold(0.0, f64::max) * scale.stiffness;
        let stretch = Biot::longest_stretch(f);
        (largest / self.density).sqrt() * stretch * stretch
    }

    fn has_history(&self, state: &AnisotropicDamageState) -> bool {
        state.width != 0.0
    }

    fn update(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Response<AnisotropicDamageState>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&kinematics, increment, old)?;
        Self::checked(Self::response(&kinematics, &step, old))
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<(Response<AnisotropicDamageState>, Tangent), MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&kinematics, increment, old)?;
        let tangent =
            kinematics.turned_tangent(&step.biot_stress, self.rates(&kinematics, &step, increment));
        let response = Self::checked(Self::response(&kinematics, &step, old))?;
        Ok((response, tangent))
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<AnisotropicDamageState>>, MaterialError> {
        self.in_sheet(increment, old, with_tangent)
    }

    fn values(&self, state: &AnisotropicDamageState, out: &mut [f64]) {
        out[0] = state.opening;
        out[1] = state.opened;
        out[2] = state.sheared;
        out[3] = state.left_over;
        out[4] = f64::from(u8::from(state.failed));
    }
}

#[cfg(test)]
mod tests;
