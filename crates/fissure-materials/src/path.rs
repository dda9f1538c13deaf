//! What a material point is put through: ordered legs, each controlled per component by strain or
//! stress, or by entries of the deformation gradient.
//!
//! The strain is that of a symmetric deformation gradient, `F = 1 + ε`: the Biot strain `U − 1`,
//! tensor components. The stress is Cauchy's. A rotation on top is [`Path::spin`]'s; strain and
//! stress are then those in the frame that turns with the point. Over a leg every target is
//! approached in a straight line from the value at its start.

mod histories;

use fissure_tensor::{Band, Matrix3, Vector3};

use crate::External;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// First.
    X,
    /// Second.
    Y,
    /// Third.
    Z,
}

/// A component of a symmetric tensor, in the order of the Mandel components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Normal along x.
    XX,
    /// Normal along y.
    YY,
    /// Normal along z.
    ZZ,
    /// Shear in the plane yz.
    YZ,
    /// Shear in the plane xz.
    XZ,
    /// Shear in the plane xy.
    XY,
}

/// What one component is driven to by the end of a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// The strain stays where it is at the start of the leg.
    Held,
    /// Strain (tensor component of `U − 1`).
    Strain(f64),
    /// Cauchy stress, Pa.
    Stress(f64),
}

/// One leg of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Control of xx, yy, zz, yz, xz, xy.
    pub control: [Control; 6],
    /// Steps; > 0.
    pub steps: usize,
    /// Length of a step, s; ≥ 0.
    pub dt: f64,
    /// Rotation vector of the rigid rotation superposed over the leg, rad; applied after the
    /// stretch and on top of that of the legs before.
    pub spin: Vector3<f64>,
}

/// What one entry of the deformation gradient is driven to by the end of a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// The entry stays where it is at the start of the leg.
    Held,
    /// The entry itself: 1 on the diagonal and 0 off it at rest.
    Value(f64),
    /// The entry follows from the Cauchy stress of these indices in the fixed axes, Pa. Of `F_ij`
    /// and `F_ji` at most one: the stress does not determine a rotation.
    Stress(f64),
}

/// A leg that drives the deformation gradient, in the fixed axes and with whatever rotation it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradientLeg {
    /// Control of `F`, row by row.
    pub entries: [[Entry; 3]; 3],
    /// Steps; > 0.
    pub steps: usize,
    /// Length of a step, s; ≥ 0.
    pub dt: f64,
}

/// One leg of a path, by what it controls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// Strain, stress and a rotation.
    Stretch(Leg),
    /// Entries of the deformation gradient.
    Gradient(GradientLeg),
}

impl Stage {
    /// Steps of the leg.
    pub fn steps(&self) -> usize {
        match self {
            Self::Stretch(leg) => leg.steps,
            Self::Gradient(leg) => leg.steps,
        }
    }

    /// Length of a step, s.
    pub fn dt(&self) -> f64 {
        match self {
            Self::Stretch(leg) => leg.dt,
            Self::Gradient(leg) => leg.dt,
        }
    }
}

/// When a step is divided. The parts are halves, quarters and so on; samples are still one a step.
/// The tolerance is that of one part: what a crack's direction is off by at its start may grow later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubSteps {
    /// How often a part may be halved; 0 never divides.
    pub halvings: u32,
    /// A part is halved while taking it in two changes the stress by more than this, Pa, and where
    /// dissipation starts while the stress changes by more than this over the part; infinite to
    /// divide only what the law refuses or where no equilibrium is found.
    pub tolerance: f64,
}

impl Default for SubSteps {
    /// Steps are taken whole.
    fn default() -> Self {
        Self {
            halvings: 0,
            tolerance: f64::INFINITY,
        }
    }
}

/// Ordered legs with the band and the surroundings of the point.
///
/// ```
/// use fissure_materials::{Axis, Band, Path};
/// // Uniaxial stress to 0.2 % strain in 200 steps, back to zero in 100, then 5 cycles.
/// let path = Path::new(Band::cube(1e-3))
///     .uniaxial(Axis::X, 2e-3, 200)
///     .back(0.0, 100)
///     .cycle(1e-3, 0.0, 5, 50);
/// assert_eq!(path.legs.len(), 12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The legs, first to last.
    pub legs: Vec<Stage>,
    /// Width over which a crack is smeared.
    pub band: Band,
    /// Temperature, nodal damage and parameter scale.
    pub external: External,
    /// When steps are divided.
    pub sub_steps: SubSteps,
    /// Components that [`back`](Self::back) drives: those of the last leg that were not merely held.
    driven: [bool; 6],
    /// Step length of the legs to come, s.
    dt: f64,
}

impl From<Axis> for Component {
    /// The normal component along the axis.
    fn from(axis: Axis) -> Self {
        match axis {
            Axis::X => Self::XX,
            Axis::Y => Self::YY,
            Axis::Z => Self::ZZ,
        }
    }
}

impl Axis {
    /// Unit vector along the axis.
    pub fn vector(self) -> Vector3<f64> {
        match self {
            Self::X => Vector3::x(),
            Self::Y => Vector3::y(),
            Self::Z => Vector3::z(),
        }
    }
}

impl Path {
    /// No legs yet; steps of one second, nothing external.
    pub fn new(band: Band) -> Self {
        Self {
            legs: Vec::new(),
            band,
            external: External::default(),
            sub_steps: SubSteps::default(),
            driven: [false; 6],
            dt: 1.0,
        }
    }

    /// Sets what is external to the law: temperature, nodal damage, parameter scale.
    pub fn external(self, external: External) -> Self {
        Self { external, ..self }
    }

    /// Divides steps where that is needed, on all legs.
    pub fn sub_steps(self, sub_steps: SubSteps) -> Self {
        Self { sub_steps, ..self }
    }

    /// Sets the step length of the legs added from here on, s.
    pub fn time_step(self, dt: f64) -> Self {
        Self { dt, ..self }
    }

    /// Uniaxial strain: one normal strain to `to`, the others held.
    pub fn uniaxial_strain(self, axis: Axis, to: f64, steps: usize) -> Self {
        self.strain(axis.into(), to, steps)
    }

    /// Uniaxial stress: one normal strain to `to`, every other stress to zero.
    ///
    /// Softening makes the point snap back at a narrower band than in uniaxial strain: for an
    /// isotropic law where Young's modulus takes the place of the P-wave modulus in
    /// [`band_limit`](crate::Cracking::band_limit).
    pub fn uniaxial(self, axis: Axis, to: f64, steps: usize) -> Self {
        let component = Component::from(axis);
        self.drive(
            [Control::Stress(0.0); 6],
            &[component],
            Control::Strain(to),
            steps,
        )
    }

    /// Pure shear in the plane normal to `about`: the tensor shear strain to `to`, the others held.
    pub fn shear(self, about: Axis, to: f64, steps: usize) -> Self {
        let component = match about {
            Axis::X => Component::YZ,
            Axis::Y => Component::XZ,
            Axis::Z => Component::XY,
        };
        self.strain(component, to, steps)
    }

    /// All three normal strains to `to`, the shears held.
    pub fn hydrostatic(self, to: f64, steps: usize) -> Self {
        let normals = [Component::XX, Component::YY, Component::ZZ];
        self.drive([Control::Held; 6], &normals, Control::Strain(to), steps)
    }

    /// One strain component to `to`, the others held.
    pub fn strain(self, component: Component, to: f64, steps: usize) -> Self {
        self.drive([Control::Held; 6], &[component], Control::Strain(to), steps)
    }

    /// One stress component to `to`, Pa, every other stress to zero. Beyond the strength of a
    /// softening law there is no equilibrium: the point then stops with
    /// [`PointError::NoEquilibrium`](crate::PointError::NoEquilibrium).
    pub fn stress(self, component: Component, to: f64, steps: usize) -> Self {
        self.drive(
            [Control::Stress(0.0); 6],
            &[component],
            Control::Stress(to),
            steps,
        )
    }

    /// Any leg. [`back`](Self::back) then drives the components whose target is not zero.
    pub fn leg(mut self, leg: Leg) -> Self {
        self.driven = leg.control.map(|control| match control {
            Control::Held => false,
            Control::Strain(to) | Control::Stress(to) => to != 0.0,
        });
        self.legs.push(Stage::Stretch(leg));
        self
    }

    /// Entries of the deformation gradient, row by row, to the ends given.
    ///
    /// ```
    /// use fissure_materials::{Band, Entry::*, Hencky, Isotropic, Path, Point};
    /// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
    /// // Simple shear with free normal stresses.
    /// let path = Path::new(Band::cube(1e-3)).entries(
    ///     [
    ///         [Stress(0.0), Value(0.01), Held],
    ///         [Held, Stress(0.0), Held],
    ///         [Held, Held, Stress(0.0)],
    ///     ],
    ///     10,
    /// );
    /// let law = Hencky { elastic: steel };
    /// let samples = Point::new(&law)?.drive(&path)?;
    /// assert!(samples[9].cauchy().xx().abs() < 1.0);
    /// # Ok::<(), fissure_materials::PointError>(())
    /// ```
    pub fn entries(mut self, entries: [[Entry; 3]; 3], steps: usize) -> Self {
        self.driven = [false; 6];
        let dt = self.dt;
        self.legs
            .push(Stage::Gradient(GradientLeg { entries, steps, dt }));
        self
    }

    /// All of the deformation gradient to `to`.
    pub fn gradient(self, to: &Matrix3<f64>, steps: usize) -> Self {
        let entries = [0, 1, 2].map(|i| [0, 1, 2].map(|j| Entry::Value(to[(i, j)])));
        self.entries(entries, steps)
    }

    /// The driven components of the last leg to another end, everything else as in that leg but
    /// without its spin. Adds nothing to a path without legs or after a leg of gradients.
    pub fn back(mut self, to: f64, steps: usize) -> Self {
        if let Some(Stage::Stretch(last)) = self.legs.last() {
            let mut control = last.control;
            for (control, driven) in control.iter_mut().zip(self.driven) {
                match control {
                    Control::Strain(end) | Control::Stress(end) if driven => *end = to,
                    _ => {}
                }
            }
            self.legs.push(Stage::Stretch(self.leg_of(control, steps)));
        }
        self
    }

    /// `times` round trips of the last leg's control: to `there` and to `home`, `steps` each way.
    pub fn cycle(self, there: f64, home: f64, times: usize, steps: usize) -> Self {
        (0..times).fold(self, |path, _| path.back(there, steps).back(home, steps))
    }

    /// Turns the point about `axis` by `turns` full turns, evenly over the steps of the last leg, unless
    /// that drives the gradient.
    pub fn spin(mut self, axis: Axis, turns: f64) -> Self {
        if let Some(Stage::Stretch(leg)) = self.legs.last_mut() {
            leg.spin = axis.vector() * (std::f64::consts::TAU * turns);
        }
        self
    }

    fn leg_of(&self, control: [Control; 6], steps: usize) -> Leg {
        Leg {
            control,
            steps,
            dt: self.dt,
            spin: Vector3::zeros(),
        }
    }

    fn drive(
        mut self,
        mut control: [Control; 6],
        components: &[Component],
        end: Control,
        steps: usize,
    ) -> Self {
        self.driven = [false; 6];
        for &component in components {
            control[component as usize] = end;
            self.driven[component as usize] = true;
        }
        self.legs.push(Stage::Stretch(self.leg_of(control, steps)));
        self
    }
}
