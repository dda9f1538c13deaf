//! The law under test with its natural scales, and paths of it.

use fissure_tensor::{Band, Matrix3, Sym, Tangent};

use super::{Case, Contract, Random, case::Step};
use crate::material::{DIFFERENCE_STEP, columns, completed, difference_tangent};
use crate::{Cracking, External, Increment, Material, MaterialError, Response, Scale};

/// A law and what the generator has to know of it.
pub(super) struct Subject<'a, M> {
    pub law: &'a M,
    /// Largest stress per strain of the virgin law, Pa.
    pub stiffness: f64,
    /// Stress of the virgin law at rest, Pa; zero but for a law under pressure from the start.
    pub rest_stress: Sym,
    /// Tangent of the virgin law at rest.
    pub modulus: Tangent,
    /// Strain at which something happens: strength over stiffness, or the limit of linearity.
    pub natural: f64,
    /// Largest strain drawn for laws without a failure opening.
    pub reach: f64,
    /// Opening at which a crack has failed, m; 0 for laws that do not say.
    pub opening: f64,
    /// Widest band to draw.
    pub width: f64,
    /// Whether the scales are those that a law that cracks states.
    pub cracking: bool,
    /// The band asked for, if one was.
    pub band: Option<Band>,
    /// Sub-steps of the isoerror property.
    pub isoerror_steps: usize,
}

impl<'a, M: Material> Subject<'a, M> {
    /// Measures the natural scales of a law.
    pub fn new(law: &'a M, contract: &Contract) -> Result<Self, MaterialError> {
        law.check()?;
        let reach = if M::OBJECTIVE { 1e-2 } else { 1e-3 };
        let mut subject = Self {
            law,
            stiffness: 0.0,
            rest_stress: Sym::ZERO,
            modulus: Tangent::zero(),
            natural: contract.strain_scale.unwrap_or(reach),
            reach,
            opening: 0.0,
            width: widest_band(law),
            cracking: false,
            band: contract.band,
            isoerror_steps: contract.step_error_steps,
        };
        if let Some(band) = &contract.band {
            law.check_band(band, &Scale::default())?;
            subject.width = band.max_width();
        }
        let rest = subject.rest();
        subject.rest_stress = law.update(&rest, &law.initial())?.stress;
        for &axis in normals::<M>() {
            let stress = subject.at_strain(&uniaxial(axis, 1e-8))?.stress - subject.rest_stress;
            subject.stiffness = subject.stiffness.max(stress.max_abs() / 1e-8);
        }
        subject.modulus = law.tangent(&rest, &law.initial())?;
        if contract.strain_scale.is_none() {
            subject.natural = subject.limit_of_linearity();
        }
        // A given scale may be over the default reach: draw beyond it all the same.
        subject.reach = reach.max(2.0 * subject.natural).min(0.2);
        Ok(subject)
    }

    /// Doubles strains along the axes and in all directions until the response is not linear.
    fn limit_of_linearity(&self) -> f64 {
        let axes = normals::<M>().iter().map(|axis| uniaxial(*axis, 1.0));
        let all = axes.clone().fold(Sym::ZERO, |sum, axis| sum + axis);
        let directions = axes.chain([all]);
        let mut smallest = self.reach;
        for direction in directions {
            let mut size = 1e-9;
            while size < smallest {
                let strain = direction * size;
                let linear = self.at_strain(&strain).is_ok_and(|response| {
                    let difference = (response.stress - self.linear(&strain)).max_abs();
                    // The stretch out of the plane is a state that moves from the first strain on.
                    (M::PLANE || response.state == self.law.initial())
                        && response.dissipated == 0.0
                        && difference <= 0.1 * self.stiffness * size
                });
                if !linear {
                    smallest = size;
                }
                size *= 2.0;
            }
        }
        smallest
    }

    /// Cauchy stress of a symmetric strain from rest, to first order in it.
    fn linear(&self, strain: &Sym) -> Sym {
        let (rest, convected) = (self.rest_stress, strain.to_matrix());
        self.modulus.apply(strain)
            + rest * (1.0 - strain.trace())
            + Sym::from_matrix(&(convected * rest.to_matrix())) * 2.0
    }

    /// The zero increment at rest.
    pub fn rest(&self) -> Increment {
        self.increment(
            Matrix3::identity(),
            Matrix3::identity(),
            &Band::Uniform(self.width),
        )
    }

    /// An increment with the defaults of the battery.
    pub fn increment(&self, f_old: Matrix3<f64>, f_new: Matrix3<f64>, band: &Band) -> Increment {
        Increment {
            f_old,
            f_new,
            dt: 1.0,
            band: *band,
            external: External::default(),
        }
    }

    /// Response of the virgin law to one step to a strain.
    pub fn at_strain(&self, strain: &Sym) -> Result<Response<M::State>, MaterialError> {
        let end = Matrix3::identity() + strain.to_matrix();
        let increment = self.increment(Matrix3::identity(), end, &Band::Uniform(self.width));
        self.law.update(&increment, &self.law.initial())
    }

    /// Responses after every step of a path; the first gradient is where the virgin law starts.
    pub fn drive(
        &self,
        gradients: &[Matrix3<f64>],
        band: &Band,
        scale: &Scale,
    ) -> Result<Vec<Response<M::State>>, MaterialError> {
        let mut state = self.law.initial();
        let mut responses = Vec::with_capacity(gradients.len().saturating_sub(1));
        for pair in gradients.windows(2) {
            let mut increment = self.increment(pair[0], pair[1], band);
            increment.external.scale = *scale;
            let response = self.law.update(&increment, &state)?;
            state = response.state;
            responses.push(response);
        }
        Ok(responses)
    }

    /// The deformation gradient with the stretch that a law in plane stress has found.
    pub fn whole(&self, f: &Matrix3<f64>, state: &M::State) -> Matrix3<f64> {
        completed(self.law, f, state)
    }

    /// The strain without the components that a law in plane stress determines itself.
    pub fn controlled(&self, strain: &Sym) -> Sym {
        let mut controlled = Sym::ZERO;
        for &i in columns::<M>() {
            controlled.mandel[i] = strain.mandel[i];
        }
        controlled
    }

    /// The inverse of the virgin tangent on the components that the law can be strained by.
    pub fn compliance(&self) -> Option<Tangent> {
        let mut matrix = self.modulus.0;
        let fixed = |i: &usize| !columns::<M>().contains(i);
        for i in (0..6).filter(fixed) {
            matrix[(i, i)] = 1.0;
        }
        let mut inverse = matrix.try_inverse()?;
        for i in (0..6).filter(fixed) {
            inverse[(i, i)] = 0.0;
        }
        Some(Tangent(inverse))
    }

    /// The increment and the old state of the last step of a case; `None` if it has no step.
    pub fn last_step(&self, case: &Case) -> Result<Option<(Increment, M::State)>, MaterialError> {
        let gradients = case.gradients();
        let [.., from, to] = gradients.as_slice() else {
            return Ok(None);
        };
        let history = self.drive(
            &gradients[..gradients.len() - 1],
            &case.band,
            &Scale::default(),
        )?;
        let state = history.last().map_or(self.law.initial(), |r| r.state);
        Ok(Some((self.increment(*from, *to, &case.band), state)))
    }

    /// Whether a tangent is the default one by plain differences, which is as good as the update
    /// but resolves no bend sharper than its step.
    pub fn is_default_tangent(
        &self,
        increment: &Increment,
        old: &M::State,
        tangent: &Tangent,
    ) -> bool {
        difference_tangent(self.law, increment, old, DIFFERENCE_STEP).is_ok_and(|t| t == *tangent)
    }

    /// A band: the one asked for, else of any kind and down to a thousandth of the widest.
    pub fn draw_band(&self, random: &mut Random) -> Band {
        if let Some(band) = self.band {
            return band;
        }
        // A thinner band would need openings that are large strains.
        let thinnest = (1e-3 * self.width)
            .max(10.0 * self.opening)
            .min(0.99 * self.width);
        let width = if random.chance(0.3) {
            random.uniform(0.9, 0.99) * self.width
        } else {
            random.log_uniform(thinnest, 0.99 * self.width)
        };
        random.band(width)
    }

    /// A history of waypoints around one direction: loading, unloading, reloading and turning,
    /// with strains between round-off and beyond failure. `special` as for
    /// [`Random::strain_direction`].
    pub fn draw_path(&self, random: &mut Random, special: bool) -> Case {
        let band = self.draw_band(random);
        let size = if random.chance(0.3) {
            random.log_uniform(1e-12, self.reach)
        } else if self.opening > 0.0 && self.opening.is_finite() {
            let failure = self.natural + self.opening / band.max_width();
            let most = (1.5 * failure).min(0.2);
            if random.chance(0.5) {
                random.uniform(0.3, 1.0) * most
            } else {
                random.log_uniform(0.5 * self.natural, most)
            }
        } else {
            random.log_uniform(0.1 * self.natural, (20.0 * self.natural).min(self.reach))
        };
        let main = random.strain_direction(special) * size;
        let count = random.integer(1, 6);
        let proportional = random.chance(0.3);
        let mut case = Case::straight([], band);
        let mut reached = Sym::ZERO;
        for index in 0..count {
            let level = if index == 0 {
                1.0
            } else {
                random.uniform(-0.5, 1.5)
            };
            let mut target = main * level;
            if !proportional {
                target += random.strain_direction(special) * (0.3 * size);
            }
            let spin = if M::OBJECTIVE && random.chance(0.5) {
                random.turn() * random.log_uniform(1e-6, 1.0)
            } else {
                Default::default()
            };
            let strain = target - reached;
            case.steps.push(Step { strain, spin });
            reached = target;
        }
        case.turn = random.turn();
        case.exponent = random.integer(1, 80) as i32 - 40;
        case
    }
}

impl<'a, M: Cracking> Subject<'a, M> {
    /// As [`new`](Self::new), with the scales that a law that cracks states itself.
    pub fn cracking(law: &'a M, contract: &Contract) -> Result<Self, MaterialError> {
        let mut subject = Self::new(law, contract)?;
        subject.cracking = true;
        let scale = Scale::default();
        let strength = law.strength(&scale);
        if contract.strain_scale.is_none() {
            subject.natural = strength / subject.stiffness;
        }
        let critical = law.critical_opening(&scale);
        let endless = 20.0 * law.toughness(&scale) / strength;
        subject.opening = if critical.is_finite() {
            critical
        } else {
            endless
        };
        let limit = law.band_limit(&scale);
        if contract.band.is_none() && limit.is_finite() {
            subject.width = limit;
        }
        Ok(subject)
    }

    /// `1 − width/limit`, what the conditioning of a crack's opening divides by; not below 0.01
    /// for the widest bands drawn.
    pub fn reserve(&self, width: f64) -> f64 {
        1.0 - width / self.law.band_limit(&Scale::default())
    }

    /// The undamaged response to a path's end: the law with a strength out of reach. `None` if the
    /// strength does not follow its scale.
    pub fn undamaged(&self, f: &Matrix3<f64>, band: &Band) -> Option<Response<M::State>> {
        let scale = Scale {
            strength: 2.0_f64.powi(60),
            ..Scale::default()
        };
        if self.law.strength(&scale) < 1e10 * self.law.strength(&Scale::default()) {
            return None;
        }
        let mut increment = self.increment(Matrix3::identity(), *f, band);
        increment.external.scale = scale;
        self.law.update(&increment, &self.law.initial()).ok()
    }

    /// A crack opened in pure mode I to beyond failure in 1 to 1000 steps, with up to three cycles
    /// of unloading, into compression too. No rotations: the crack's normal is the loaded one.
    pub fn draw_opening(&self, random: &mut Random) -> Case {
        let band = self.draw_band(random);
        let strength = self.law.strength(&Scale::default());
        let pull = Sym::dyad(&random.direction()) * strength;
        let normal = self.law.initiation(&pull, &Scale::default()).normal;
        let top = 1.2 * self.natural + 1.1 * self.opening / band.width(&normal);
        let mut levels = Vec::new();
        for _ in 0..random.integer(0, 3) {
            let high = random.uniform(0.0, 1.0);
            levels.extend([high, random.uniform(-0.2, high)]);
        }
        levels.push(1.0);
        let steps = random.log_uniform(1.0, 1000.0) as usize;
        let parts = (steps / levels.len()).max(1);
        let mut strains = Vec::new();
        let mut from = 0.0;
        for level in levels {
            let part = Sym::dyad(&normal) * (top * (level - from) / parts as f64);
            strains.extend(std::iter::repeat_n(part, parts));
            from = level;
        }
        Case::straight(strains, band)
    }
}

/// The axes along which a law can be strained.
fn normals<M: Material>() -> &'static [usize] {
    if M::PLANE { &[0, 1] } else { &[0, 1, 2] }
}

fn uniaxial(axis: usize, strain: f64) -> Sym {
    let mut uniaxial = Sym::ZERO;
    uniaxial.mandel[axis] = strain;
    uniaxial
}

/// The widest uniform band of 1 m, 1/2 m, 1/4 m, … that the law accepts.
fn widest_band<M: Material>(law: &M) -> f64 {
    let mut width = 1.0;
    for _ in 0..100 {
        if law
            .check_band(&Band::Uniform(width), &Scale::default())
            .is_ok()
        {
            break;
        }
        width *= 0.5;
    }
    width
}
