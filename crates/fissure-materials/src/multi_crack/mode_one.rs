//! Decohesion by the normal traction alone, with the choices the source leaves open.
//!
//! `F_n = τ_n/τ_nf − ratio(u τ/G)`, started by Rankine [Sanchez 2010, eqs 3.5.61-3.5.63 for any
//! softening curve]. The return of one plane is the root of `t₀ − (E₁/L) u = τ ratio(u τ/G)`.
//!
//! - *Unloading.* `Permanent` (as printed): the opening stays. `Secant`: traction and opening go
//!   back to zero together, `t = κ_s u` with `κ_s = τ ratio(κ)/κ`, and the plane shuts at zero.
//! - *Shear.* `Elastic` (as printed) keeps the full shear stiffness along the plane, failed or not;
//!   in a body this locks and the crack spreads over several cells. `Coulomb` keeps none: no shear
//!   while open, friction under pressure. `Damaged` lets the shear stiffness fall with the opening,
//!   `t_t = (1 − ω) t₀_t`, `ω = κ/(κ + τ ratio L/E₁)`, zero at failure; then `Coulomb`.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{
    Decohesion, Plane, Rank, Trial,
    decohesion::{contact, pressure, slide, slide_rate},
};
use crate::{
    Initiation, Isotropic, MaterialError, Scale, Softening, check_parameter,
    criteria::{FailureCriterion, Rankine},
    softening::{Linear, opening},
    turning::Turning,
};

const NAME: &str = "mode-I decohesion";

/// What a partly open plane does when it is unloaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unloading {
    /// The opening stays; a partly open plane under compression answers elastically.
    #[default]
    Permanent,
    /// The opening falls in proportion to the traction, to nothing.
    Secant,
}

/// How much shear a plane carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shear {
    /// All of it, elastically.
    Elastic,
    /// None while open; friction under pressure, with this coefficient, dimensionless, ≥ 0.
    Coulomb(f64),
    /// Stiffness falling with the opening; after failure friction with this coefficient.
    Damaged(f64),
}

/// Opening by normal traction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeOne<S = Linear> {
    /// Tensile strength τ_nf, Pa; > 0.
    pub strength: f64,
    /// Fracture energy G_f, J/m²; > 0.
    pub toughness: f64,
    /// Softening curve.
    pub softening: S,
    /// What unloading does.
    pub unloading: Unloading,
    /// Shear along the plane.
    pub shear: Shear,
}

impl<S: Softening> ModeOne<S> {
    fn friction(&self) -> f64 {
        match self.shear {
            Shear::Elastic => 0.0,
            Shear::Coulomb(friction) | Shear::Damaged(friction) => friction,
        }
    }

    /// Opening per dimensionless opening, m.
    fn length(&self) -> f64 {
        self.toughness / self.strength
    }

    /// Traction per opening of the unloading line, Pa/m.
    fn secant(&self, softened: f64) -> f64 {
        self.strength * self.softening.ratio(softened) / (softened * self.length())
    }

    /// `ω`, from 0 to 1.
    fn damage(&self, elastic: &Isotropic, plane: &Plane) -> f64 {
        let opening = plane.softened * self.length();
        let left = self.strength * self.softening.ratio(plane.softened);
        let elastic_part = left * plane.width / elastic.p_wave_modulus();
        if opening > 0.0 {
            opening / (opening + elastic_part)
        } else {
            0.0
        }
    }

    /// `dω/du` while the plane softens, 1/m.
    fn damage_rate(&self, elastic: &Isotropic, plane: &Plane) -> f64 {
        let opening = plane.softened * self.length();
        let per_traction = plane.width / elastic.p_wave_modulus();
        let left = self.strength * self.softening.ratio(plane.softened) * per_traction;
        let slope = self.strength / self.length() * self.softening.slope(plane.softened);
        (left - opening * slope * per_traction) / (opening + left).powi(2)
    }

    /// Change of the opening with the normal traction of the trial, m/Pa.
    fn opening_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> f64 {
        let stiffness = trial.normal_stiffness(new);
        if new.failed {
            return if trial.parts(new) {
                1.0 / stiffness
            } else {
                0.0
            };
        }
        if new.softened > old.softened {
            let slope = self.strength / self.length() * self.softening.slope(new.softened);
            return 1.0 / (stiffness + slope);
        }
        match self.unloading {
            Unloading::Secant if trial.parts(new) => 1.0 / (stiffness + self.secant(new.softened)),
            Unloading::Permanent | Unloading::Secant => 0.0,
        }
    }

    /// Moves the opening of a plane that has not failed; returns it.
    fn open(&self, plane: &mut Plane, traction: f64, trial: &Trial) -> f64 {
        let stiffness = trial.normal_stiffness(plane);
        let length = self.length();
        let reached = plane.softened * length;
        let limit = self.strength * self.softening.ratio(plane.softened);
        if traction - stiffness * reached <= limit + trial.slack {
            return match self.unloading {
                Unloading::Permanent => reached,
                Unloading::Secant if plane.softened > 0.0 => {
                    let secant = stiffness + self.secant(plane.softened);
                    (traction / secant).clamp(0.0, reached)
                }
                Unloading::Secant => 0.0,
            };
        }
        let load = traction / self.strength;
        let dimensionless = stiffness * length / self.strength;
        plane.softened = opening(&self.softening, load, dimensionless, plane.softened);
        plane.failed = plane.softened >= self.softening.critical();
        if plane.failed {
            plane.softened = self.softening.critical();
            return traction / stiffness;
        }
        plane.softened * length
    }
}

impl<S: Softening> Decohesion for ModeOne<S> {
    fn associated(&self) -> bool {
        matches!(self.shear, Shear::Elastic | Shear::Coulomb(0.0))
    }

    fn opens_alone(&self) -> bool {
        true
    }

    /// The damage in shear is measured against the modulus across the plane of the solid, not of the
    /// sheet.
    fn has_sheet_form(&self) -> bool {
        !matches!(self.shear, Shear::Damaged(_))
    }

    fn check(&self) -> Result<(), MaterialError> {
        let positive =
            |field, value: f64| check_parameter(NAME, field, value, value > 0.0, "finite and > 0");
        positive("strength", self.strength)?;
        positive("toughness", self.toughness)?;
        self.softening.check()?;
        let friction = self.friction();
        check_parameter(
            NAME,
            "friction",
            friction,
            friction >= 0.0,
            "finite and >= 0",
        )
    }

    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            strength: self.strength * scale.strength,
            toughness: self.toughness * scale.toughness,
            ..*self
        }
    }

    fn strength(&self) -> f64 {
        self.strength
    }

    fn toughness(&self) -> f64 {
        self.toughness
    }

    fn critical(&self) -> f64 {
        self.softening.critical()
    }

    fn steepest(&self) -> f64 {
        self.strength / self.length() * self.softening.steepest()
    }

    fn ratio(&self, softened: f64) -> f64 {
        self.softening.ratio(softened)
    }

    fn dissipated_fraction(&self, softened: f64) -> f64 {
        let area = self.softening.area(softened);
        match self.unloading {
            Unloading::Secant if softened < self.softening.critical() => {
                area - 0.5 * softened * self.softening.ratio(softened)
            }
            Unloading::Permanent | Unloading::Secant => area,
        }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>, _rank: Rank) -> f64 {
        let strength = self.strength;
        Rankine { strength }.along(stress, normal)
    }

    fn upper_bound(&self, stress: &Sym) -> f64 {
        let strength = self.strength;
        Rankine { strength }.upper_bound(stress)
    }

    fn initiation(&self, stress: &Sym, _rank: Rank) -> Initiation {
        let strength = self.strength;
        Rankine { strength }.initiation(stress)
    }

    fn normal_rate(&self, stress: [&Sym; 2], normal: &Vector3<f64>, _rank: Rank) -> Vector3<f64> {
        Turning::principal(stress[0], normal).rate(stress[1])
    }

    fn onset_traction(&self, stress: &Sym, normal: &Vector3<f64>, _rank: Rank) -> Vector3<f64> {
        // All of it shrunk to the surface: as on a proportional path.
        let traction = stress.traction(normal);
        traction * (self.strength / normal.dot(&traction))
    }

    fn release(&self, old: &Plane, trial: &Trial) -> Plane {
        let limit = |pressure: f64| self.friction() * pressure;
        // Without a limit there is no slack in sliding: planes that leapt over it, each moving the others, would do so for ever.
        let free = Trial {
            slack: 0.0,
            ..*trial
        };
        let sliding = |limit: f64| if limit == 0.0 { &free } else { trial };
        if old.failed {
            let pressed = limit(pressure(old, trial));
            let mut plane = contact(old, sliding(pressed), limit);
            if self.shear == Shear::Elastic {
                plane.slip = [0.0; 3];
            }
            return plane;
        }
        let mut plane = *old;
        let traction = trial.normal_traction(old);
        plane.opening = self.open(&mut plane, traction, trial);
        let pressure = pressure(&plane, trial);
        let slip = match self.shear {
            Shear::Elastic => Vector3::zeros(),
            Shear::Damaged(_) if !plane.failed => {
                let damage = self.damage(&trial.elastic, &plane);
                trial.shear_traction(old) * (damage / trial.shear_stiffness(old))
            }
            Shear::Coulomb(_) | Shear::Damaged(_) => {
                slide(old, sliding(limit(pressure)), limit(pressure))
            }
        };
        plane.slip = slip.into();
        plane
    }

    fn release_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> [Sym; 3] {
        let normal = new.normal();
        let opening = self.opening_rate(old, new, trial);
        let stiffness = trial.normal_stiffness(new);
        let damaged = matches!(self.shear, Shear::Damaged(_)) && !new.failed;
        // The derivative of the jump with the traction on the plane.
        let mut rate = normal * normal.transpose() * opening;
        if damaged {
            let plane = Matrix3::identity() - normal * normal.transpose();
            let flexibility = 1.0 / trial.shear_stiffness(new);
            rate += plane * (self.damage(&trial.elastic, new) * flexibility);
            if new.softened > old.softened {
                let turned = trial.shear_traction(new) * flexibility;
                let growth = self.damage_rate(&trial.elastic, new) * opening;
                rate += turned * normal.transpose() * growth;
            }
        } else if self.shear != Shear::Elastic {
            let pressure = pressure(new, trial);
            let limit = self.friction() * pressure;
            if let Some((with_traction, with_limit)) = slide_rate(old, trial, limit) {
                rate += with_traction;
                if pressure > 0.0 {
                    let limit_rate = self.friction() * (stiffness * opening - 1.0);
                    rate += with_limit * normal.transpose() * limit_rate;
                }
            }
        }
        let row = |i: usize| Sym::dyad_of(&rate.row(i).transpose(), &normal);
        [row(0), row(1), row(2)]
    }

    fn stored(&self, elastic: &Isotropic, plane: &Plane) -> f64 {
        if plane.failed || plane.softened == 0.0 {
            return 0.0;
        }
        let normal = match self.unloading {
            Unloading::Permanent => 0.0,
            Unloading::Secant => 0.5 * self.secant(plane.softened) * plane.opening.powi(2),
        };
        let shear = match self.shear {
            Shear::Damaged(_) => {
                let damage = self.damage(elastic, plane);
                let stiffness = elastic.shear_modulus() / plane.width;
                0.5 * (1.0 - damage) / damage * stiffness * plane.slip().norm_squared()
            }
            Shear::Elastic | Shear::Coulomb(_) => 0.0,
        };
        normal + shear
    }

    /// Exact for the opening. Friction: mean limit times slip. Damaged shear: the uncracked
    /// shear traction `t₀` taken linear in `ω`, `½ ∫ t₀²/(μ/L) dω`.
    fn dissipated(&self, old: &Plane, new: &Plane, trial: &Trial) -> f64 {
        let [before, after] = [old, new].map(|plane| self.dissipated_fraction(plane.softened));
        let opening = self.toughness * (after - before).max(0.0);
        opening + self.dissipated_in_shear(&trial.elastic, old, new)
    }
}

impl<S: Softening> ModeOne<S> {
    fn dissipated_in_shear(&self, elastic: &Isotropic, old: &Plane, new: &Plane) -> f64 {
        let sliding = || {
            let pressure = |p: &Plane| (-p.normal().dot(&Vector3::from(p.traction))).max(0.0);
            let limit = 0.5 * self.friction() * (pressure(old) + pressure(new));
            limit * (new.slip() - old.slip()).norm()
        };
        let stiffness = elastic.shear_modulus() / new.width;
        match self.shear {
            Shear::Elastic => 0.0,
            Shear::Coulomb(_) => sliding(),
            Shear::Damaged(_) if old.failed => sliding(),
            Shear::Damaged(_) => {
                let (before, after) = (self.damage(elastic, old), self.damage(elastic, new));
                let uncracked = |plane: &Plane, damage: f64| {
                    if damage > 0.0 {
                        plane.slip() * (stiffness / damage)
                    } else {
                        Vector3::zeros()
                    }
                };
                let after_shear = uncracked(new, after);
                let before_shear = if old.softened > 0.0 {
                    uncracked(old, before)
                } else {
                    // The plane starts: its traction is that at onset.
                    let (normal, traction) = (old.normal(), Vector3::from(old.traction));
                    traction - normal * normal.dot(&traction)
                };
                let (a, b) = (before_shear, after_shear);
                let square = (a.norm_squared() + a.dot(&b) + b.norm_squared()) / 3.0;
                0.5 * square / stiffness * (after - before).max(0.0)
            }
        }
    }
}
