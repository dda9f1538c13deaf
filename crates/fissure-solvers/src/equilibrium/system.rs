//! The linear system of a Newton iteration.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{Scene, SolveError};
use nalgebra::{SMatrix, SVector};

use super::choice::{Iterative, Method, Preconditioning};
use super::freedoms::Freedoms;
use super::links::Links;
use super::stiffness::{Stiffness, diagonal_blocks};
use crate::constraints::Constraints;
use crate::linear::{
    BlockMatrix, Diagonal, Direct, Identity, Incomplete, KrylovSettings, LinearError, NodeBlocks,
    Operator, Outcome, Preconditioner, conjugate_gradients, gmres,
};
use crate::transfers::Transfers;

/// Unknowns, matrix and factorisation of a step; what depends on the pattern alone is kept while
/// it stands.
#[derive(Default)]
pub(crate) struct System<const D: usize> {
    pub links: Links<D>,
    pub freedoms: Freedoms<D>,
    pub stiffness: Stiffness<D>,
    /// What joins nodes besides the particles; `links.joined` holds their nodes.
    pub springs: Vec<Spring<D>>,
    /// Blocks that jumps within cells add.
    pub further: Vec<Block<D>>,
    direct: Option<Direct<D>>,
}

/// A block of the stiffness by numbers of active nodes.
pub(crate) struct Block<const D: usize> {
    pub row: usize,
    pub column: usize,
    pub block: SMatrix<f64, D, D>,
}

/// A spring between two active nodes.
pub(crate) struct Spring<const D: usize> {
    /// Their numbers.
    pub numbers: [usize; 2],
    /// Derivative of the force on the second by its displacement against the first, with its sign turned, N/m.
    pub stiffness: SMatrix<f64, D, D>,
}

/// The derivative of the unbalanced forces, with its sign turned: `stiffness` times the tangent plus
/// `inertia` times the masses of the active nodes.
#[derive(Clone, Copy)]
pub(crate) struct Jacobian<'a> {
    pub stiffness: f64,
    pub inertia: f64,
    pub masses: &'a [f64],
}

impl Jacobian<'_> {
    /// Of equilibrium without inertia.
    pub(crate) const STATIC: Self = Self {
        stiffness: 1.0,
        inertia: 0.0,
        masses: &[],
    };

    /// From a stiffness.
    fn complete<const D: usize>(&self, matrix: &mut BlockMatrix<D>) {
        if self.stiffness != 1.0 {
            matrix
                .blocks
                .iter_mut()
                .for_each(|block| *block *= self.stiffness);
        }
        for (node, mass) in self.masses.iter().enumerate() {
            matrix.add_to_diagonal(node, self.inertia * mass);
        }
    }

    /// The nodal masses.
    pub(crate) fn mass_preconditioner<const D: usize>(&self) -> Diagonal {
        let inertia = self.inertia;
        Diagonal::new(self.masses.iter().flat_map(|mass| [inertia * mass; D]))
    }

    /// From a stiffness times `x`.
    pub(crate) fn complete_product<const D: usize>(&self, x: &[f64], product: &mut [f64]) {
        product.iter_mut().for_each(|y| *y *= self.stiffness);
        let nodes = product.chunks_exact_mut(D).zip(x.chunks_exact(D));
        for ((product, x), mass) in nodes.zip(self.masses) {
            for (y, x) in product.iter_mut().zip(x) {
                *y += self.inertia * mass * x;
            }
        }
    }
}

/// Multiplies a vector of the active nodes by the Jacobian.
pub(crate) type Multiply<'a> = dyn FnMut(&[f64], &mut [f64]) -> Result<(), SolveError> + 'a;

/// Why no correction was found.
#[derive(Debug)]
pub(crate) enum NoCorrection {
    /// The linear system has no usable solution.
    Linear,
    /// A difference of residuals could not be taken.
    Refused(SolveError),
}

impl From<LinearError> for NoCorrection {
    fn from(_: LinearError) -> Self {
        Self::Linear
    }
}

impl From<SolveError> for NoCorrection {
    fn from(error: SolveError) -> Self {
        Self::Refused(error)
    }
}

impl<const D: usize> System<D> {
    /// Finds the unknowns of a step.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(crate) fn find<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
        constraints: &Constraints<D>,
    ) -> Result<(), (usize, usize)> {
        self.links.find(transfers, scene)?;
        self.freedoms.collect(&self.links, constraints);
        Ok(())
    }

    /// Sums the stiffness of the trial state.
    pub(crate) fn assemble(&mut self, scene: &Scene<D>, tangents: &[Vec<Tangent>]) {
        if !self.stiffness.prepare(&self.links) {
            self.direct = None;
        }
        self.stiffness.assemble(&self.links, scene, tangents);
        let matrix = &mut self.stiffness.matrix;
        for Spring { numbers, stiffness } in &self.springs {
            for row in 0..2 {
                for column in 0..2 {
                    let place = matrix.pattern().place(numbers[row], numbers[column]);
                    let sign = if row == column { 1.0 } else { -1.0 };
                    if let Some(place) = place {
                        matrix.blocks[place] += stiffness * sign;
                    }
                }
            }
        }
        for further in &self.further {
            if let Some(place) = matrix.pattern().place(further.row, further.column) {
                matrix.blocks[place] += further.block;
            }
        }
    }

    /// The held components' changes of the active nodes, from those of all nodes; `None` if all are zero.
    fn held_changes(&self, held: &[SVector<f64, D>]) -> Option<Vec<f64>> {
        let active = self.links.active.iter();
        let changes: Vec<f64> = active
            .flat_map(|&node| held[node as usize].iter().copied())
            .collect();
        changes
            .iter()
            .any(|change| *change != 0.0)
            .then_some(changes)
    }

    /// Solves `J δu = force − J δu_held` by one factorisation for every pair of forces (on the active nodes)
    /// and changes of what is held (vectors of all nodes); returns the free components of each `δu` of the
    /// active nodes.
    pub(crate) fn correct<S: Shape<D>, const N: usize>(
        &mut self,
        scene: &Scene<D>,
        transfers: &Transfers<'_, S, D>,
        tangents: &[Vec<Tangent>],
        jacobian: Jacobian<'_>,
        rights: [(Vec<f64>, &[SVector<f64, D>]); N],
        damping: f64,
    ) -> Result<[Vec<f64>; N], LinearError> {
        self.assemble(scene, tangents);
        let changes = rights.each_ref().map(|(_, held)| self.held_changes(held));
        let mut forces = rights.map(|(force, _)| force);
        let matrix = &mut self.stiffness.matrix;
        jacobian.complete(matrix);
        for (force, changes) in forces.iter_mut().zip(changes) {
            if let Some(changes) = changes {
                take_off(force, |product| matrix.multiply(&changes, product));
            }
            self.freedoms.turn(force);
        }
        self.freedoms.take_out(matrix);
        let direct = match &mut self.direct {
            Some(direct) => direct,
            none => {
                let positions = self.links.positions(transfers);
                none.insert(Direct::new(matrix.pattern(), &positions)?)
            }
        };
        direct.factorise(matrix, damping)?;
        for force in &mut forces {
            direct.solve(matrix, force)?;
            self.freedoms.turn_back(force);
        }
        Ok(forces)
    }

    /// Negative pivots of the last factorisation, if it has counted them.
    pub(crate) fn negative_pivots(&self) -> Option<usize> {
        self.direct.as_ref().and_then(Direct::negative_pivots)
    }

    /// The same by Krylov iterations with the assembled matrix, to a relative residual `accuracy`.
    #[allow(clippy::too_many_arguments)] // The system is made of all of them.
    pub(crate) fn iterate_assembled(
        &mut self,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
        jacobian: Jacobian<'_>,
        mut force: Vec<f64>,
        held: &[SVector<f64, D>],
        iterative: &Iterative,
        accuracy: f64,
    ) -> Result<(Vec<f64>, Outcome), LinearError> {
        self.assemble(scene, tangents);
        let changes = self.held_changes(held);
        let matrix = &mut self.stiffness.matrix;
        jacobian.complete(matrix);
        if let Some(changes) = changes {
            take_off(&mut force, |product| matrix.multiply(&changes, product));
        }
        self.freedoms.turn(&mut force);
        self.freedoms.take_out(matrix);
        let preconditioner: Box<dyn Preconditioner> = match iterative.preconditioner {
            Preconditioning::None => Box::new(Identity),
            Preconditioning::Mass => Box::new(jacobian.mass_preconditioner::<D>()),
            Preconditioning::NodeBlocks => Box::new(NodeBlocks::new(matrix)?),
            Preconditioning::Incomplete => Box::new(match iterative.method {
                Method::ConjugateGradients => Incomplete::cholesky(matrix)?,
                Method::Gmres => Incomplete::lu(matrix)?,
            }),
        };
        let mut x = vec![0.0; force.len()];
        let Ok(outcome) = krylov(
            iterative,
            accuracy,
            matrix,
            &*preconditioner,
            &force,
            &mut x,
        );
        self.freedoms.turn_back(&mut x);
        Ok((x, outcome))
    }

    /// The same with a function that multiplies a vector of the active nodes by the Jacobian.
    pub(crate) fn iterate(
        &self,
        mut force: Vec<f64>,
        held: &[SVector<f64, D>],
        iterative: &Iterative,
        accuracy: f64,
        preconditioner: &dyn Preconditioner,
        product: &mut Multiply<'_>,
    ) -> Result<(Vec<f64>, Outcome), SolveError> {
        if let Some(changes) = self.held_changes(held) {
            let mut taken = Ok(());
            take_off(&mut force, |image| taken = product(&changes, image));
            taken?;
        }
        self.freedoms.turn(&mut force);
        let mut x = vec![0.0; force.len()];
        let mut operator = Turned {
            freedoms: &self.freedoms,
            size: force.len(),
            product,
        };
        let outcome = krylov(
            iterative,
            accuracy,
            &mut operator,
            preconditioner,
            &force,
            &mut x,
        )?;
        self.freedoms.turn_back(&mut x);
        Ok((x, outcome))
    }

    /// The diagonal blocks of the Jacobian as a preconditioner, without a matrix.
    pub(crate) fn node_blocks(
        &self,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
        jacobian: Jacobian<'_>,
    ) -> Result<NodeBlocks<D>, LinearError> {
        let mut diagonal = diagonal_blocks(&self.links, scene, tangents);
        jacobian.complete(&mut diagonal);
        self.freedoms.take_out(&mut diagonal);
        NodeBlocks::new(&diagonal)
    }
}

/// `force −= product`.
fn take_off(force: &mut [f64], product: impl FnOnce(&mut [f64])) {
    let mut image = vec![0.0; force.len()];
    product(&mut image);
    force.iter_mut().zip(&image).for_each(|(f, y)| *f -= y);
}

fn krylov<O: Operator>(
    iterative: &Iterative,
    accuracy: f64,
    operator: &mut O,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    x: &mut [f64],
) -> Result<Outcome, O::Error> {
    let settings = KrylovSettings {
        tolerance: accuracy,
        max_iterations: iterative.max_iterations,
        restart: iterative.restart,
    };
    match iterative.method {
        Method::ConjugateGradients => {
            conjugate_gradients(operator, preconditioner, b, x, &settings)
        }
        Method::Gmres => gmres(operator, preconditioner, b, x, &settings),
    }
}

/// A product in components along the axes as one in those along the held nodes' own directions.
struct Turned<'a, 'b, const D: usize> {
    freedoms: &'a Freedoms<D>,
    size: usize,
    product: &'a mut Multiply<'b>,
}

impl<const D: usize> Operator for Turned<'_, '_, D> {
    type Error = SolveError;

    fn size(&self) -> usize {
        self.size
    }

    fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), SolveError> {
        let mut along_axes = x.to_vec();
        self.freedoms.turn_back(&mut along_axes);
        (self.product)(&along_axes, y)?;
        self.freedoms.turn(y);
        Ok(())
    }
}
