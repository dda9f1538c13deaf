//! What can go wrong while a scene is built, moved, watched or restored.

use fissure_materials::{MaterialError, Matrix3};
use fissure_particles::{ExtraError, ParticleError, ParticleId, SeedError};
use thiserror::Error;

use crate::crack::CrackError;
use crate::solution::NewtonStop;

/// Why a scene refused what it was given.
#[derive(Debug, Error)]
pub enum SceneError {
    /// A number is outside its permitted range.
    #[error("'{parameter}' is {value}; permitted: {permitted}")]
    Parameter {
        /// What it is.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The law of a body refused its parameters.
    #[error("body '{body}'")]
    Law {
        /// The body.
        body: String,
        /// What the law said.
        #[source]
        source: MaterialError,
    },
    /// A body could not be seeded.
    #[error("body '{body}'")]
    Seed {
        /// The body.
        body: String,
        /// What the seeding said.
        #[source]
        source: SeedError,
    },
    /// A body's particles were refused.
    #[error("body '{body}'")]
    Particles {
        /// The body.
        body: String,
        /// What the columns said.
        #[source]
        source: ParticleError,
    },
    /// An optional column of a body was refused.
    #[error("body '{body}'")]
    Column {
        /// The body.
        body: String,
        /// What the column said.
        #[source]
        source: ExtraError,
    },
    /// A name is taken.
    #[error(
        "the name '{name}' is taken; names of bodies, conditions, contacts and cracks are unique"
    )]
    NameTaken {
        /// The name.
        name: String,
    },
    /// Two bodies have a contact already, or are one.
    #[error(
        "contact '{name}' between '{first}' and '{second}': they must be two bodies without a contact"
    )]
    ContactTaken {
        /// The contact.
        name: String,
        /// One body.
        first: String,
        /// The other.
        second: String,
    },
    /// No body has this name.
    #[error("no body is called '{name}'")]
    UnknownBody {
        /// The name asked for.
        name: String,
    },
    /// A condition selects nothing.
    #[error("condition '{name}' selects no particle")]
    EmptySelection {
        /// The condition.
        name: String,
    },
    /// No crack has this name.
    #[error("no crack is called '{name}'")]
    UnknownCrack {
        /// The name asked for.
        name: String,
    },
    /// A crack was refused.
    #[error("crack '{crack}'")]
    Crack {
        /// The crack.
        crack: String,
        /// What the crack said.
        #[source]
        source: CrackError,
    },
    /// The law between the faces of a crack refused its parameters.
    #[error("the law between the faces of crack '{crack}'")]
    Bond {
        /// The crack.
        crack: String,
        /// What the law said.
        #[source]
        source: MaterialError,
    },
    /// An axisymmetric body reaches over the axis.
    #[error("body '{body}': a particle at radius {radius} m; permitted: > 0")]
    NegativeRadius {
        /// The body.
        body: String,
        /// Its radius, m.
        radius: f64,
    },
}

/// Why a step failed. The scene is then as it was before the step.
#[derive(Debug, Error)]
pub enum SolveError {
    /// A law could not follow a particle.
    #[error(
        "step {step}, t = {time:.6e} s: particle {} of '{body}': {source} (state {state})", id.0
    )]
    Particle {
        /// The body.
        body: String,
        /// The particle.
        id: ParticleId,
        /// The step that failed, counted from 1.
        step: u64,
        /// Time at its start, s.
        time: f64,
        /// Deformation gradient the law was given.
        deformation_gradient: Box<Matrix3<f64>>,
        /// The particle's history before the step.
        state: String,
        /// What the law said.
        source: MaterialError,
    },
    /// A particle has left the grid or reaches further than a tile's window.
    #[error("step {step}, t = {time:.6e} s: particle {} of '{body}' at {position:?} m is outside the grid", id.0)]
    Outside {
        /// The body.
        body: String,
        /// The particle.
        id: ParticleId,
        /// Where it is, m.
        position: Vec<f64>,
        /// The step that failed, counted from 1.
        step: u64,
        /// Time at its start, s.
        time: f64,
    },
    /// A particle holds a number that is not finite.
    #[error("particle {} of '{body}': {field} is not finite", id.0)]
    NotFinite {
        /// The body.
        body: String,
        /// The particle.
        id: ParticleId,
        /// The column.
        field: &'static str,
    },
    /// There is nothing to move.
    #[error("the scene holds no particles")]
    Empty,
    /// A law refused the band of the discretisation.
    #[error("body '{body}'")]
    Band {
        /// The body.
        body: String,
        /// What the law said.
        #[source]
        source: MaterialError,
    },
    /// A setting of the solver is outside its range.
    #[error("setting '{setting}' is {value}; permitted: {permitted}")]
    Setting {
        /// The setting.
        setting: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The scene's kinematics do not fit the solver's dimension or shape.
    #[error("{what} is not possible in this scene")]
    Unsupported {
        /// What was asked for.
        what: &'static str,
    },
    /// The equations of a step did not converge, however small it was cut.
    #[error(
        "step {step}, t = {time:.6e} s: no equilibrium after {cuts} cuts of the step \
         ({}; relative residual {residual:.3e}, tolerance {tolerance:.1e})", stop.text()
    )]
    NoConvergence {
        /// The step that failed, counted from 1.
        step: u64,
        /// Time at its start, s.
        time: f64,
        /// How often it was cut.
        cuts: usize,
        /// Last relative residual.
        residual: f64,
        /// What it had to reach.
        tolerance: f64,
        /// Why the last attempt ended.
        stop: NewtonStop,
    },
    /// A step that is longer than its scheme is stable for, by the speed of waves in the scene.
    #[error("a step of {step:.6e} s is not stable; permitted: at most {longest:.6e} s")]
    UnstableStep {
        /// The step asked for, s.
        step: f64,
        /// The longest stable one, s.
        longest: f64,
    },
    /// The system of equations has no unique solution.
    #[error("step {step}, t = {time:.6e} s: the tangent is singular (is every body held?)")]
    Singular {
        /// The step that failed, counted from 1.
        step: u64,
        /// Time at its start, s.
        time: f64,
    },
    /// Columns of a body do not fit one another.
    #[error("body '{body}'")]
    Particles {
        /// The body.
        body: String,
        /// What the columns said.
        #[source]
        source: ParticleError,
    },
    /// After a step that failed, velocities and stresses could not be brought back.
    #[error("body '{body}' could not be brought back to where it was before the step that failed")]
    Undo {
        /// The body.
        body: String,
    },
    /// A crack could not follow the material.
    #[error("step {step}, t = {time:.6e} s: crack '{crack}'")]
    Crack {
        /// The crack.
        crack: String,
        /// The step that failed, counted from 1.
        step: u64,
        /// Time at its start, s.
        time: f64,
        /// What the crack said.
        #[source]
        source: CrackError,
    },
    /// A watch failed.
    #[error("a watch failed")]
    Watch(#[from] WatchError),
}

/// Why a watch failed.
#[derive(Debug, Error)]
pub enum WatchError {
    /// It asked for something the scene does not have.
    #[error("no {kind} is called '{name}'")]
    Unknown {
        /// Body, condition or value.
        kind: &'static str,
        /// The name asked for.
        name: String,
    },
    /// The scene holds more energy than was put in.
    #[error(
        "step {step}, t = {time:.6e} s: {energy:.3e} J in motion, strain and dissipation, {given:.3e} J of it put in: \
         steps are too long for their scheme"
    )]
    EnergyGrowth {
        /// The step after which it was found.
        step: u64,
        /// The time then, s.
        time: f64,
        /// Kinetic, stored and dissipated energy, J.
        energy: f64,
        /// Energy put in, J.
        given: f64,
    },
    /// It could not write.
    #[error("{0}")]
    Write(#[source] Box<dyn std::error::Error + Send + Sync>),
}

/// Why a scene could not be saved or restored.
#[derive(Debug, Error)]
pub enum PersistError {
    /// A section is missing.
    #[error("section '{section}' is missing")]
    Missing {
        /// Its name.
        section: String,
    },
    /// A section does not decode.
    #[error("section '{section}' does not decode")]
    Decode {
        /// Its name.
        section: String,
        /// What the decoder said.
        #[source]
        source: postcard::Error,
    },
    /// A section fits another scene than this.
    #[error("section '{section}': {what} is {found}, the scene has {expected}")]
    Mismatch {
        /// Its name.
        section: String,
        /// What differs.
        what: &'static str,
        /// In the section.
        found: usize,
        /// In the scene.
        expected: usize,
    },
    /// A crack of this name is not in the section at its place.
    #[error("section '{section}' has crack '{found}' where the scene has '{expected}'")]
    CrackName {
        /// Name of the section.
        section: String,
        /// In the section.
        found: String,
        /// In the scene.
        expected: String,
    },
    /// A saved crack is no line.
    #[error("section '{section}'")]
    Crack {
        /// Name of the section.
        section: String,
        /// What the crack said.
        #[source]
        source: CrackError,
    },
    /// An optional column was refused.
    #[error("section '{section}'")]
    Column {
        /// Its name.
        section: String,
        /// What the column said.
        #[source]
        source: ExtraError,
    },
    /// Restored columns do not fit one another.
    #[error("section '{section}'")]
    Particles {
        /// Its name.
        section: String,
        /// What the columns said.
        #[source]
        source: ParticleError,
    },
}
