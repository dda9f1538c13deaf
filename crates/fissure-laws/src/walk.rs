//! Random walks through the states of a law, in step sizes from round-off to absurd.

use fissure_materials::contract::Random;
use fissure_materials::*;
use fissure_tensor::rotation;
use fissure_tensor::{Band, Matrix3, Sym, Vector3};

/// What a walk is after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Steps log-uniform in 1e-12 to 10.
    Any,
    /// Steps around the strain at which something happens.
    Natural,
    /// Tension in ever new directions, which asks for many cracks (X16).
    Turning,
    /// Opened beyond failure, then compressed, sheared and pulled (X17).
    Crushed,
    /// As `Natural`, with stiffness, strength and toughness in other units by up to 2^±900 (X15).
    Units,
    /// Steps of 0.1 to 1000 (X4).
    Huge,
}

/// A walk: where it is, and where it goes next.
pub(super) struct Walk {
    pub kind: Kind,
    pub band: Band,
    pub scale: Scale,
    /// Change of the temperature, K; the same in every step.
    pub temperature: f64,
    rotation: Matrix3<f64>,
    strain: Sym,
    /// Scales of the law: something happens, and it is all over.
    natural: f64,
    failure: f64,
    normal: Vector3<f64>,
    step: usize,
    spins: bool,
    plane: bool,
}

/// A step that a walk proposes.
pub(super) struct Proposal {
    rotation: Matrix3<f64>,
    strain: Sym,
    /// The deformation gradient at its end.
    pub f: Matrix3<f64>,
    /// Whether `det F` is in [0.2, 5] and `U` positive definite: a law may refuse all else.
    pub sound: bool,
}

/// Steps of a walk.
pub(super) const STEPS: usize = 64;

impl Walk {
    /// A walk of a random kind, from the virgin law.
    pub fn new(
        random: &mut Random,
        natural: f64,
        opening: Option<f64>,
        widest: f64,
        (spins, plane): (bool, bool),
    ) -> Self {
        let kind = match random.integer(0, 99) {
            0..=49 => Kind::Any,
            50..=74 => Kind::Natural,
            75..=84 => Kind::Turning,
            85..=94 => Kind::Crushed,
            95..=97 => Kind::Units,
            _ => Kind::Huge,
        };
        let width = random.log_uniform(1e-3 * widest, 0.99 * widest);
        let scale = match kind {
            Kind::Units => units(random),
            _ => Scale::default(),
        };
        Self {
            kind,
            band: random.band(width),
            scale,
            temperature: random.uniform(-50.0, 50.0),
            rotation: Matrix3::identity(),
            strain: Sym::ZERO,
            natural,
            failure: natural + opening.map_or(20.0 * natural, |opening| opening / width),
            normal: random.direction(),
            step: 0,
            spins,
            plane,
        }
    }

    /// The next step.
    pub fn propose(&mut self, random: &mut Random) -> Proposal {
        self.step += 1;
        let strain = match self.kind {
            Kind::Any => {
                let size = random.log_uniform(1e-12, 10.0);
                self.by_size(random, size)
            }
            Kind::Natural | Kind::Units => self.by_natural(random),
            Kind::Turning => {
                let pull = Sym::dyad(&random.direction()) * random.uniform(0.5, 3.0);
                pull * self.natural
            }
            Kind::Crushed => self.crushed(random),
            Kind::Huge => {
                let size = random.log_uniform(0.1, 1e3);
                self.by_size(random, size)
            }
        };
        let turned = if self.spins && random.chance(0.3) {
            let turn = random.turn() * random.log_uniform(1e-12, 1.0);
            rotation(&turn, turn.norm()) * self.rotation
        } else {
            self.rotation
        };
        let stretch = Matrix3::identity() + strain.to_matrix();
        let f = turned * stretch;
        let least = (strain + Sym::IDENTITY).spectrum().values[2];
        Proposal {
            rotation: turned,
            strain,
            f,
            sound: least > 0.0 && (0.2..=5.0).contains(&f.determinant()),
        }
    }

    /// Goes there; returns the strain increment.
    pub fn accept(&mut self, proposal: &Proposal) -> Sym {
        let increment = proposal.strain - self.strain;
        (self.rotation, self.strain) = (proposal.rotation, proposal.strain);
        increment
    }

    /// A step of this size in any direction; a large one mostly to a stretch that exists.
    fn by_size(&self, random: &mut Random, size: f64) -> Sym {
        if size < 0.3 || random.chance(0.1) {
            return self.strain + random.strain_direction(true) * size;
        }
        // Principal stretches up to 1 + size with a product in [0.2, 5].
        let most = size.ln_1p();
        let volume = random.uniform(-1.6, 1.6);
        let first = random.uniform(-most, most);
        let second = if self.plane {
            volume - first
        } else {
            random.uniform(-most, most)
        };
        let third = if self.plane {
            0.0
        } else {
            volume - first - second
        };
        let stretches = [first, second, third].map(f64::exp_m1);
        let axes = random.rotation();
        Sym::diagonal(stretches[0], stretches[1], stretches[2]).congruence(&axes)
    }

    /// Around rest, or up to beyond failure in one direction with something across.
    fn by_natural(&self, random: &mut Random) -> Sym {
        if random.chance(0.5) {
            let size = self.natural * random.log_uniform(1e-3, 5.0);
            return self.strain + random.strain_direction(true) * size;
        }
        let far = (1.5 * self.failure).min(0.5) * random.uniform(-0.2, 1.0);
        let across = random.strain_direction(true) * (self.natural * random.uniform(0.0, 2.0));
        Sym::dyad(&self.normal) * far + across
    }

    /// Open, shut, sheared, pulled, in turns.
    fn crushed(&self, random: &mut Random) -> Sym {
        let along = Sym::dyad(&self.normal);
        let tangent = if self.plane {
            Vector3::z().cross(&self.normal)
        } else {
            self.normal.cross(&random.direction())
        };
        let shear = Sym::dyad_of(&self.normal, &tangent);
        let size = |random: &mut Random| self.natural * random.log_uniform(1e-3, 100.0).min(20.0);
        match self.step % 4 {
            1 => along * (2.0 * self.failure).min(0.5),
            2 => along * -size(random),
            3 => along * -size(random) + shear * size(random),
            _ => along * size(random) + shear * size(random),
        }
    }
}

/// Other units by powers of two, up to 2^±900 in each factor: nothing but exponents may change until
/// a product of them leaves the numbers, which is a typed error.
fn units(random: &mut Random) -> Scale {
    let power = |exponent: f64| 2.0_f64.powf(exponent.round());
    let stress = random.uniform(-900.0, 900.0);
    let room = 900.0 - stress.abs();
    let length = if random.chance(0.5) {
        0.0
    } else {
        random.uniform(-room, room)
    };
    Scale {
        stiffness: power(stress),
        strength: power(stress),
        toughness: power(stress) * power(length),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_steps_of_every_kind_are_sound() {
        let mut random = Random::new(1);
        let mut seen = Vec::new();
        for _ in 0..300 {
            let mut walk = Walk::new(&mut random, 1e-4, Some(5e-5), 0.02, (true, false));
            let mut sound = 0;
            for _ in 0..STEPS {
                let proposal = walk.propose(&mut random);
                if proposal.sound {
                    sound += 1;
                    walk.accept(&proposal);
                }
            }
            assert!(sound * 2 >= STEPS, "{:?}: {sound}", walk.kind);
            if !seen.contains(&walk.kind) {
                seen.push(walk.kind);
            }
        }
        assert_eq!(seen.len(), 6);
    }
}
