//! The trait every constitutive law implements.

use std::fmt::Debug;

use fissure_tensor::{Band, Matrix3, Sym, Tangent};
use serde::{Serialize, de::DeserializeOwned};

use crate::{EightPoints, EightResponses, Increment, MaterialError, Response, Scale, SheetStep};

/// A constitutive law: a pure function from an increment and an old state to a new state.
///
/// The stress is total: it follows from `f_new` and the state, so a zero increment changes
/// nothing and no old stress is handed over. Only [`density`](Self::density),
/// [`wave_speed`](Self::wave_speed) and [`update`](Self::update) have to be written.
pub trait Material: Send + Sync + 'static {
    /// History of one particle; `()` costs nothing. Serde keeps it in checkpoints bit for bit.
    type State: Copy
        + Default
        + PartialEq
        + Debug
        + Send
        + Sync
        + Serialize
        + DeserializeOwned
        + 'static;

    /// Whether a rotation on top of a deformation only rotates the stress. A law that uses the
    /// small strain of `F` says `false`, and the contract checks leave finite rotations out.
    const OBJECTIVE: bool = true;

    /// Whether `stored` is the energy whose derivative is the stress at *finite* strain, so that
    /// stored plus dissipated energy equals the work done. Small-strain laws say `false`: for them
    /// it holds to first order in the strain.
    const HYPERELASTIC: bool = true;

    /// Whether the answer depends on the length of the step in time. The contract checks hold a
    /// zero increment of a rate-dependent law to nothing, since it may relax.
    const RATE_DEPENDENT: bool = false;

    /// Largest difference between the stress of one increment of up to five times the strain at
    /// which the law leaves its linear range, straight and from rest or from a uniaxial stretch,
    /// and that of the same increment in many, over stiffness times increment; the contract
    /// checks hold the law to it. 0 for a law that such a division does not change.
    const STEP_ERROR: f64 = 1.0;

    /// The same in plane stress, where the thickness turns a straight strain from its direction.
    const STEP_ERROR_IN_PLANE_STRESS: f64 = Self::STEP_ERROR;

    /// Whether the law determines its out-of-plane components itself, as in plane stress: it reads
    /// only the in-plane components of `F`, states the rest in
    /// [`out_of_plane_stretch`](Self::out_of_plane_stretch), and its tangent has none. The contract
    /// checks then strain and turn it in the plane.
    const PLANE: bool = false;

    /// Whether bodies keep the states of those particles alone that have a history, which spares
    /// the others all but four bytes. For laws whose state is that of
    /// [`without_history`](Self::without_history) until something happens that seldom does, as
    /// damage.
    const SPARSE: bool = false;

    /// Whether the stress of a point without a history is that of its deformation gradient, to the last bit, however it
    /// came there (and whatever the step and the band). The explicit solver then keeps one copy of the stresses of such
    /// points instead of two, and asks for them again should a step fail. The contract checks hold the law to it.
    const STRESS_FROM_GRADIENT: bool = false;

    /// Names of what [`values`](Self::values) writes, for output and probes.
    const NAMES: &'static [&'static str] = &[];

    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`] with the field, the value and the rule.
    fn check(&self) -> Result<(), MaterialError> {
        Ok(())
    }

    /// Refuses a band for which the response would not be unique [Sanchez 2010, eq. 4.5.17].
    ///
    /// # Errors
    /// [`MaterialError::Band`] with the width and the limit.
    fn check_band(&self, _band: &Band, _scale: &Scale) -> Result<(), MaterialError> {
        Ok(())
    }

    /// Width of the widest crack that a step from `old` to `new` started, m; 0 if it started none.
    ///
    /// A law that wraps another and narrows the limit of the band, as
    /// [`PlaneStress`](crate::PlaneStress) does, holds the cracks of the law inside to it.
    fn started_width(&self, _old: &Self::State, _new: &Self::State) -> f64 {
        0.0
    }

    /// Whether the virgin law has no preferred direction in the reference configuration.
    fn isotropic(&self) -> bool {
        true
    }

    /// Whether the stress is continuous in the end of a step. A law in which something drops at once
    /// (a failure that leaves a traction, a crack that starts on another plane by a hair's breadth)
    /// says `false`, and the contract checks leave the jumps of P11 out.
    fn continuous(&self) -> bool {
        true
    }

    /// Reference mass density, kg/m³.
    fn density(&self) -> f64;

    /// Speed of the fastest wave, m/s; bounds the explicit step.
    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64;

    /// State of an undeformed particle.
    fn initial(&self) -> Self::State {
        Self::State::default()
    }

    /// Whether a state has to be kept; if not, it is that of
    /// [`without_history`](Self::without_history) at the deformation gradient it was reached at.
    /// Asked of [`SPARSE`](Self::SPARSE) laws only.
    fn has_history(&self, state: &Self::State) -> bool {
        *state != self.initial()
    }

    /// The state of a particle to which nothing has happened, at its deformation gradient.
    fn without_history(&self, _f: &Matrix3<f64>) -> Self::State {
        self.initial()
    }

    /// Stress, state and energies at the end of an increment.
    ///
    /// # Errors
    /// A deformation that the law cannot take, or a local iteration that fails.
    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError>;

    /// What [`update`](Self::update) and [`wave_speed`](Self::wave_speed) answer, to the last bit, for eight
    /// points that have no history, do not get one in this step, and are given nothing from outside
    /// but factors on stiffness and strength.
    ///
    /// `None`, as by default, sends the points to `update` one by one. A law answers so where one of
    /// the eight is out of the ordinary too: fails, cracks, strains beyond what its short form
    /// covers. To gain from a vector unit the method must be `#[inline(always)]` with what it
    /// calls, and go through the points in a loop of few branches. Laws that determine their own
    /// thickness are not asked.
    #[inline(always)]
    fn update_eight(&self, _points: &EightPoints) -> Option<EightResponses> {
        None
    }

    /// Spatial tangent for the Truesdell rate: `c : d = (δτ − dτ − τd)/J` for the change `δτ` of
    /// the Kirchhoff stress under `F → (1 + d) F`, Pa. The solver adds the geometric term.
    ///
    /// The default takes central differences of [`update`](Self::update).
    ///
    /// # Errors
    /// As `update`.
    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        difference_tangent(self, increment, old, DIFFERENCE_STEP)
    }

    /// Whether the tangent of a step between these states is more than the default differences.
    /// [`PlaneStress`](crate::PlaneStress) does not condense those: it takes its own.
    fn has_own_tangent(&self, _old: &Self::State, _new: &Self::State) -> bool {
        true
    }

    /// Both at once, for laws that share work between them.
    ///
    /// # Errors
    /// As `update`.
    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        Ok((self.update(increment, old)?, self.tangent(increment, old)?))
    }

    /// A step in plane stress, from a law that has it in closed form; `None` from the others, whose
    /// thickness [`PlaneStress`](crate::PlaneStress) looks for. Only the in-plane components of the
    /// deformation gradients are to be read. The tangent may be left out.
    ///
    /// # Errors
    /// As `update`.
    fn plane_stress(
        &self,
        _increment: &Increment,
        _old: &Self::State,
        _with_tangent: bool,
    ) -> Result<Option<SheetStep<Self::State>>, MaterialError> {
        Ok(None)
    }

    /// Writes one number per entry of [`NAMES`](Self::NAMES).
    fn values(&self, _state: &Self::State, _out: &mut [f64]) {}

    /// `F₃₃` that the state holds, for laws that determine it (plane stress).
    fn out_of_plane_stretch(&self, _state: &Self::State) -> Option<f64> {
        None
    }
}

/// Relative step of the default tangent.
pub(crate) const DIFFERENCE_STEP: f64 = 1e-6;

/// The tangent of [`Material::tangent`] by central differences with relative step `step`.
///
/// # Errors
/// As [`Material::update`].
pub fn difference_tangent<M: Material + ?Sized>(
    law: &M,
    increment: &Increment,
    old: &M::State,
    step: f64,
) -> Result<Tangent, MaterialError> {
    let kirchhoff = |d: &Sym, sign: f64| -> Result<Sym, MaterialError> {
        let f = (Matrix3::identity() + d.to_matrix() * (sign * step)) * increment.f_new;
        let response = law.update(&increment.with_end(f), old)?;
        Ok(response.stress * completed(law, &f, &response.state).determinant())
    };
    let here = law.update(increment, old)?;
    let jacobian = completed(law, &increment.f_new, &here.state).determinant();
    let stress = here.stress.to_matrix();
    let mut matrix = fissure_tensor::Matrix6::zeros();
    for &column in columns::<M>() {
        let mut d = Sym::ZERO;
        d.mandel[column] = 1.0;
        let difference = (kirchhoff(&d, 1.0)? - kirchhoff(&d, -1.0)?) / (2.0 * step * jacobian);
        // `dτ + τd` over J: twice the symmetric part of `d·σ`.
        let convected = Sym::from_matrix(&(d.to_matrix() * stress)) * 2.0;
        matrix.set_column(column, &(difference - convected).mandel.into());
    }
    Ok(Tangent(matrix))
}

/// Mandel components that a law can be strained by: all, or xx, yy and xy in the plane.
pub(crate) fn columns<M: Material + ?Sized>() -> &'static [usize] {
    if M::PLANE {
        &[0, 1, 5]
    } else {
        &[0, 1, 2, 3, 4, 5]
    }
}

/// The deformation gradient with the out-of-plane components that the law found; as it is for a
/// law that reads them.
pub(crate) fn completed<M: Material + ?Sized>(
    law: &M,
    f: &Matrix3<f64>,
    state: &M::State,
) -> Matrix3<f64> {
    match law.out_of_plane_stretch(state) {
        Some(stretch) => {
            let [a, b, c, d] = [f.m11, f.m12, f.m21, f.m22];
            Matrix3::new(a, b, 0.0, c, d, 0.0, 0.0, 0.0, stretch)
        }
        None => *f,
    }
}
