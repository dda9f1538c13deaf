//! A law as the studies see it: any type behind one object.

use fissure_materials::PointError;
use fissure_materials::contract::{Contract, Random, Summary, Violation};
use fissure_materials::*;
use fissure_tensor::Sym;

use super::fuzz::{self, Fuzzed};
use super::isoerror::{self, Map};
use super::speed::{self, Speed};
use super::subject::{State, Subject, out_of_plane, virgin_compliance};

/// Where a law is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Three dimensions, or plane strain.
    Solid,
    /// Plane stress.
    PlaneStress,
}

impl Space {
    /// The names on the command line.
    pub const NAMES: &'static [&'static str] = &["solid", "plane-stress"];

    /// The space of a name.
    pub fn of(name: &str) -> Self {
        match name {
            "plane-stress" => Self::PlaneStress,
            _ => Self::Solid,
        }
    }
}

/// Cracking strain `ε − C⁻¹:T` of a law on the Biot strain, with the virgin stiffness `C`; in plane
/// stress its in-plane components.
fn crack_strain<M: Material>(law: &M, sample: &Sample<M::State>) -> Sym {
    let Some(compliance) = virgin_compliance(law) else {
        return Sym::ZERO;
    };
    let mut strain = sample.strain - compliance.apply(&sample.biot_stress());
    for i in out_of_plane::<M>() {
        strain.mandel[*i] = 0.0;
    }
    strain
}

/// One sample of a path, whatever the law.
#[derive(Clone, Debug)]
pub struct Reached {
    /// Leg, from 0.
    pub leg: usize,
    /// Step in the leg, from 1.
    pub step: usize,
    /// Time, s.
    pub time: f64,
    /// `U − 1`.
    pub strain: Sym,
    /// Cauchy stress in the fixed axes, Pa.
    pub stress: Sym,
    /// Cauchy stress in the frame that turns with the point, Pa.
    pub turned_stress: Sym,
    /// Cracking strain; only of laws that crack.
    pub crack_strain: Option<Sym>,
    /// Energies per reference volume, J/m³: stored, dissipated so far, work so far.
    pub energies: [f64; 3],
    /// The values that the law shows of its state.
    pub values: Vec<f64>,
}

/// An event on a path, whatever the law.
#[derive(Clone, Debug)]
pub struct Happened {
    /// What.
    pub kind: EventKind,
    /// To which crack.
    pub crack: usize,
    /// Where on the leg, 0 to 1.
    pub fraction: f64,
    /// The point there.
    pub reached: Reached,
}

/// A path that was followed as far as the law went.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Names of the values.
    pub names: &'static [&'static str],
    /// One entry a step.
    pub samples: Vec<Reached>,
    /// What happened to cracks.
    pub events: Vec<Happened>,
    /// Why the point stopped, if it did.
    pub stopped: Option<PointError>,
}

/// Any law.
pub trait Law: Send + Sync {
    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// As [`Material::check`].
    fn check(&self) -> Result<(), MaterialError>;
    /// Strain at which something happens.
    fn natural_strain(&self) -> f64;
    /// A band that suits the law, m: half its limit, or 10 mm.
    fn band(&self) -> f64;
    /// Strain at which all is over for this band: a crack has failed, or ten natural strains.
    fn failure_strain(&self, band: f64) -> f64;
    /// Largest difference between one step and many that the law states.
    fn step_error(&self) -> f64;
    /// Bytes of a state, and whether a body keeps the states of particles with a history alone
    /// ([`Material::SPARSE`]).
    fn state_size(&self) -> (usize, bool);
    /// Puts the law through the public contract.
    ///
    /// # Errors
    /// The first property that does not hold.
    fn check_contract(&self, contract: &Contract) -> Result<Summary, Violation>;
    /// Follows a path.
    fn follow(&self, path: &Path) -> Followed;
    /// Looks for what must not happen.
    fn fuzz(&self, updates: u64, seed: u64) -> Fuzzed;
    /// Largest relative error of the energy to failure over that many paths; NaN for a law that
    /// does not crack.
    fn energy_error(&self, paths: usize, seed: u64) -> f64;
    /// Time of an update over that of neo-Hookean elasticity.
    fn speed(&self, seed: u64) -> Speed;
    /// Error of one step against `parts` over a plane of increments.
    fn isoerror(&self, band: f64, cells: usize, parts: usize, level: f64) -> Map;
}

impl<S: Subject> Law for S {
    fn check(&self) -> Result<(), MaterialError> {
        self.law().check()
    }

    fn natural_strain(&self) -> f64 {
        self.strain()
    }

    fn band(&self) -> f64 {
        let limit = self.band_limit();
        if limit.is_finite() { 0.5 * limit } else { 0.01 }
    }

    fn failure_strain(&self, band: f64) -> f64 {
        let opened = self.fracture().map(|fracture| fracture.opening / band);
        self.strain() + opened.unwrap_or(9.0 * self.strain())
    }

    fn step_error(&self) -> f64 {
        S::M::STEP_ERROR
    }

    fn state_size(&self) -> (usize, bool) {
        (size_of::<State<S>>(), S::M::SPARSE)
    }

    fn check_contract(&self, contract: &Contract) -> Result<Summary, Violation> {
        self.contract(contract)
    }

    fn follow(&self, path: &Path) -> Followed {
        let law = self.law();
        let cracks = self.fracture().is_some();
        let reached = |sample: &Sample<State<S>>| {
            let mut values = vec![f64::NAN; S::M::NAMES.len()];
            law.values(&sample.state, &mut values);
            Reached {
                leg: sample.leg,
                step: sample.step,
                time: sample.time,
                strain: sample.strain,
                stress: sample.cauchy(),
                turned_stress: sample.stress,
                crack_strain: cracks.then(|| crack_strain(law, sample)),
                energies: [sample.stored, sample.dissipated, sample.work],
                values,
            }
        };
        let (mut samples, mut events) = (Vec::new(), Vec::new());
        let outcome = Subject::follow(
            self,
            path,
            &mut |sample| samples.push(reached(sample)),
            &mut |event| {
                events.push(Happened {
                    kind: event.kind,
                    crack: event.crack,
                    fraction: event.fraction,
                    reached: reached(&event.sample),
                });
            },
        );
        Followed {
            names: S::M::NAMES,
            samples,
            events,
            stopped: outcome.err(),
        }
    }

    fn fuzz(&self, updates: u64, seed: u64) -> Fuzzed {
        fuzz::fuzz(self, updates, seed)
    }

    fn energy_error(&self, paths: usize, seed: u64) -> f64 {
        let mut random = Random::new(seed).in_plane(S::M::PLANE);
        super::energy::error(self, paths, &mut random)
    }

    fn speed(&self, seed: u64) -> Speed {
        speed::speed(self, self.band(), seed)
    }

    fn isoerror(&self, band: f64, cells: usize, parts: usize, level: f64) -> Map {
        isoerror::map(self, band, cells, parts, level)
    }
}
