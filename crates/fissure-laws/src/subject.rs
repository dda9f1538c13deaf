//! The kinds of law: those that crack, those that do not, and those whose strength is lowered.

use fissure_materials::contract::{Contract, Summary, Violation};
use fissure_materials::*;
use fissure_tensor::{Matrix3, Sym, Tangent, Vector3};
use nalgebra::Matrix6;

use crate::law::{Law, Space};

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
    /// Whether stress along a plane has its part in whether it opens.
    fn sees_along(&self) -> bool;
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
    fn sees_along(&self) -> bool {
        false
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
            fn sees_along(&self) -> bool {
                sees_along(&self.0)
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

fn sees_along<M: Cracking>(law: &M) -> bool {
    let scale = Scale::default();
    let strength = law.strength(&scale);
    let of = |along: f64| {
        let stress = Sym::diagonal(0.5 * strength, along, 0.0);
        law.failure_along(&stress, &Vector3::x(), &scale)
    };
    of(0.0) != of(-0.5 * strength)
}

/// Largest entry of the virgin tangent, Pa.
pub(super) fn stiffness<M: Material>(law: &M) -> f64 {
    virgin_tangent(law).max_abs()
}

pub(super) fn virgin_tangent<M: Material>(law: &M) -> Tangent {
    let rest = Increment::to(Matrix3::identity());
    let tangent = law.tangent(&rest, &law.initial());
    tangent.unwrap_or(Tangent(Matrix6::from_element(f64::NAN)))
}

/// Inverse of the virgin stiffness, 1/Pa; in plane stress of the in-plane components, and one for each of the others.
pub(super) fn virgin_compliance<M: Material>(law: &M) -> Option<Tangent> {
    let mut matrix = virgin_tangent(law).0;
    for i in out_of_plane::<M>() {
        matrix[(*i, *i)] = 1.0;
    }
    matrix.try_inverse().map(Tangent)
}

/// Mandel positions of what a law in plane stress determines itself.
pub(super) fn out_of_plane<M: Material>() -> &'static [usize] {
    if M::PLANE { &[2, 3, 4] } else { &[] }
}
