//! A law as the studies see it: any type behind one object.

use fissure::materials::PointError;
use fissure::materials::contract::{Contract, Random, Summary, Violation};
use fissure::prelude::*;
use nalgebra::Matrix6;

use super::fuzz::{self, Fuzzed};
use super::isoerror::{self, Map};
use super::speed::{self, Speed};

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

/// What a law that cracks says of its fracture in opening.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fracture {
    pub toughness: f64,
    /// Opening at which nothing is carried; twenty `G/σ` for a law that never gets there.
    pub opening: f64,
    /// Whether it gets there.
    pub fails: bool,
    pub band_limit: f64,
}

/// A law with what it says of its cracks, if it has any.
pub(super) trait Subject: Send + Sync {
    type M: Material;
    fn law(&self) -> &Self::M;
    /// Strain at which something happens.
    fn strain(&self) -> f64;
    fn fracture(&self) -> Option<Fracture>;
    /// Widest band, m; may be infinite.
    fn band_limit(&self) -> f64;
    fn cracks(&self, state: &State<Self>) -> Vec<Crack>;
    fn irreversible(&self, state: &State<Self>) -> Vec<f64>;
    fn contract(&self, contract: &Contract) -> Result<Summary, Violation>;
    fn follow(
        &self,
        path: &Path,
        visit: &mut dyn FnMut(&Sample<State<Self>>),
        happens: &mut dyn FnMut(&Event<State<Self>>),
    ) -> Result<(), PointError>;
}

/// The state of a subject's law.
pub(super) type State<S> = <<S as Subject>::M as Material>::State;

struct Plain<M> {
    law: M,
    strain: f64,
    band_limit: f64,
}

struct Cracked<M>(M);

/// A law whose strength is lowered over bands beyond the limit of the one inside.
struct Lowered<M>(LoweredStrength<M>);

/// Widest band drawn for a lowered strength, over the limit of the full one.
const LOWERED_REACH: f64 = 10.0;

/// A law that does not crack; `strain` is where it leaves its linear range.
pub(super) fn plain<M: Material>(law: M, strain: f64, space: Space) -> Box<dyn Law> {
    banded(law, strain, f64::INFINITY, space)
}

/// A law that does not crack and has a limit of its band.
pub(super) fn banded<M: Material>(
    law: M,
    strain: f64,
    band_limit: f64,
    space: Space,
) -> Box<dyn Law> {
    match space {
        Space::Solid => Box::new(Plain {
            law,
            strain,
            band_limit,
        }),
        Space::PlaneStress => {
            let law = PlaneStress(law);
            // As the wrapper lowers it: by what the thickness gives way.
            let inside = virgin_tangent(&law.0).0[(0, 0)];
            let relief = virgin_tangent(&law).0[(0, 0)] / inside;
            Box::new(Plain {
                law,
                strain,
                band_limit: band_limit * relief,
            })
        }
    }
}

/// A law that cracks, with its strength lowered over wide bands.
pub(super) fn lowered<M: Cracking>(law: M, space: Space) -> Box<dyn Law> {
    match space {
        Space::Solid => Box::new(Lowered(LoweredStrength(law))),
        Space::PlaneStress => Box::new(Lowered(LoweredStrength(PlaneStress(law)))),
    }
}

/// A law that cracks.
pub(super) fn cracking<M: Cracking>(law: M, space: Space) -> Box<dyn Law> {
    match space {
        Space::Solid => Box::new(Cracked(law)),
        Space::PlaneStress => Box::new(Cracked(PlaneStress(law))),
    }
}

impl<M: Material> Subject for Plain<M> {
    type M = M;
    fn law(&self) -> &M {
        &self.law
    }
    fn strain(&self) -> f64 {
        self.strain
    }
    fn fracture(&self) -> Option<Fracture> {
        None
    }
    fn band_limit(&self) -> f64 {
        self.band_limit
    }
    fn cracks(&self, _: &M::State) -> Vec<Crack> {
        Vec::new()
    }
    fn irreversible(&self, _: &M::State) -> Vec<f64> {
        Vec::new()
    }
    fn contract(&self, contract: &Contract) -> Result<Summary, Violation> {
        contract.check(&self.law)
    }
    fn follow(
        &self,
        path: &Path,
        visit: &mut dyn FnMut(&Sample<M::State>),
        _: &mut dyn FnMut(&Event<M::State>),
    ) -> Result<(), PointError> {
        Point::new(&self.law)?.drive_with(path, visit)
    }
}

/// What a law that cracks says of itself, under the name of its subject.
macro_rules! cracking_subject {
    ($subject:ident, $law:ty) => {
        impl<M: Cracking> Subject for $subject<M> {
            type M = $law;
            fn law(&self) -> &$law {
                &self.0
            }
            fn strain(&self) -> f64 {
                self.0.strength(&Scale::default()) / stiffness(&self.0)
            }
            fn fracture(&self) -> Option<Fracture> {
                Some(self.said())
            }
            fn band_limit(&self) -> f64 {
                self.said().band_limit
            }
            fn cracks(&self, state: &State<Self>) -> Vec<Crack> {
                self.0.cracks(state)
            }
            fn irreversible(&self, state: &State<Self>) -> Vec<f64> {
                self.0.irreversible(state)
            }
            fn contract(&self, contract: &Contract) -> Result<Summary, Violation> {
                self.checked(contract)
            }
            fn follow(
                &self,
                path: &Path,
                visit: &mut dyn FnMut(&Sample<State<Self>>),
                happens: &mut dyn FnMut(&Event<State<Self>>),
            ) -> Result<(), PointError> {
                Point::new(&self.0)?.visit_with_events(path, visit, happens)
            }
        }
    };
}
cracking_subject!(Cracked, M);
cracking_subject!(Lowered, LoweredStrength<M>);

impl<M: Cracking> Cracked<M> {
    fn said(&self) -> Fracture {
        fracture(&self.0)
    }

    fn checked(&self, contract: &Contract) -> Result<Summary, Violation> {
        contract.check_cracking(&self.0)
    }
}

impl<M: Cracking> Lowered<M> {
    /// Of the widest band drawn, where the strength is lowest and the opening largest.
    fn said(&self) -> Fracture {
        let full = fracture(&self.0.0);
        Fracture {
            opening: full.opening * (LOWERED_REACH / 0.99).sqrt(),
            band_limit: full.band_limit * LOWERED_REACH,
            ..full
        }
    }

    /// What it says of its cracks is of the full strength, so that the checks of cracks do not
    /// apply.
    fn checked(&self, contract: &Contract) -> Result<Summary, Violation> {
        contract.check(&self.0)
    }
}

fn fracture<M: Cracking>(law: &M) -> Fracture {
    let scale = Scale::default();
    let (strength, toughness) = (law.strength(&scale), law.toughness(&scale));
    let critical = law.critical_opening(&scale);
    Fracture {
        toughness,
        fails: critical.is_finite(),
        opening: critical.min(20.0 * toughness / strength),
        band_limit: law.band_limit(&scale),
    }
}

/// Largest entry of the virgin tangent, Pa.
pub(super) fn stiffness<M: Material>(law: &M) -> f64 {
    virgin_tangent(law).max_abs()
}

fn virgin_tangent<M: Material>(law: &M) -> Tangent {
    let rest = Increment::to(Matrix3::identity());
    let tangent = law.tangent(&rest, &law.initial());
    tangent.unwrap_or(Tangent(Matrix6::from_element(f64::NAN)))
}

/// Cracking strain `ε − C⁻¹:T` of a law on the Biot strain, with the virgin stiffness `C`; in plane
/// stress its in-plane components.
fn crack_strain<M: Material>(law: &M, sample: &Sample<M::State>) -> Sym {
    let mut matrix = virgin_tangent(law).0;
    let out_of_plane: &[usize] = if M::PLANE { &[2, 3, 4] } else { &[] };
    for &i in out_of_plane {
        matrix[(i, i)] = 1.0;
    }
    let Some(inverse) = matrix.try_inverse() else {
        return Sym::ZERO;
    };
    let mut strain = sample.strain - Tangent(inverse).apply(&sample.biot_stress());
    for &i in out_of_plane {
        strain.mandel[i] = 0.0;
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
    /// Bytes that the state of a particle takes in a body: without a history, and with one.
    fn bytes(&self) -> [usize; 2];
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

    fn bytes(&self) -> [usize; 2] {
        fissure::scene::state_bytes::<S::M>()
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
