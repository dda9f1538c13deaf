//! The tangent stiffness and what it does to prescribed displacements.

use fissure_grid::{Shape, Stencil};
use fissure_materials::Tangent;
use fissure_scene::{Kinematics, Run, Scene};
use fissure_tensor::{Sym, Vector3};
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::freedoms::{Freedoms, NONE};
use super::sparse::{Singular, SparseSystem};
use crate::transfers::Transfers;

/// A weight, or a gradient times the spacing, below this is round-off of a node that is not reached.
const REACHED: f64 = 1e-14;

/// A node that a particle reaches, at the start of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link<const D: usize> {
    pub node: u32,
    pub weight: f64,
    pub gradient: SVector<f64, D>,
}

/// The nodes that every particle reaches in a step, and the pattern of the stiffness they make.
#[derive(Default)]
pub(crate) struct Assembly<const D: usize> {
    links: Vec<Link<D>>,
    /// First link of every particle, counted through all bodies, and the end.
    starts: Vec<u32>,
    /// `(body, run, first particle of the run counted through all bodies)`.
    runs: Vec<(usize, Run, usize)>,
    system: Option<System>,
}

/// A solver and what its pattern was made for.
struct System {
    sparse: SparseSystem,
    nodes: Vec<u32>,
    equations: Vec<u32>,
}

impl<const D: usize> Assembly<D> {
    /// Lists the nodes that every particle reaches.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(crate) fn link<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
    ) -> Result<(), (usize, usize)> {
        self.links.clear();
        self.starts.clear();
        self.runs.clear();
        let placement = transfers.placement;
        let spacing = transfers.grid.spacing();
        for (body_index, body) in scene.bodies().iter().enumerate() {
            for run in &placement.runs[body_index] {
                self.runs.push((body_index, *run, self.starts.len()));
                let nodes = placement.nodes(run.window);
                let coordinates = placement.coordinates(run.window);
                for index in run.start as usize..run.end as usize {
                    let stencil = transfers.stencil(body, coordinates, index);
                    let stencil = stencil.ok_or((body_index, index))?;
                    let first = self.links.len();
                    self.starts.push(first as u32);
                    stencil.visit(|entry, weight, gradient| {
                        if weight > REACHED || gradient.amax() * spacing > REACHED {
                            add_link(&mut self.links, first, nodes.node(entry), weight, gradient);
                        }
                    });
                }
            }
        }
        self.starts.push(self.links.len() as u32);
        Ok(())
    }

    /// Marks the nodes that any particle reaches.
    pub(crate) fn reached(&self, node_count: usize) -> Vec<bool> {
        let mut reached = vec![false; node_count];
        for link in &self.links {
            reached[link.node as usize] = true;
        }
        reached
    }

    fn of(&self, particle: usize) -> &[Link<D>] {
        &self.links[self.starts[particle] as usize..self.starts[particle + 1] as usize]
    }

    #[allow(clippy::too_many_arguments)] // The system is made of all of them.
    /// Solves `K δu = right − K δu_held` and adds `δu` to the free components of `displacement`;
    /// `held` holds the change of the held components as vectors.
    pub(crate) fn solve(
        &mut self,
        scene: &Scene<D>,
        kinematics: Kinematics,
        tangents: &[Vec<Tangent>],
        freedoms: &Freedoms<D>,
        right: &mut [f64],
        held: &[SVector<f64, D>],
        displacement: &mut [SVector<f64, D>],
        damping: f64,
    ) -> Result<(), Singular> {
        self.analyse(freedoms)?;
        let this = &*self;
        let parts: Vec<Part> = this
            .runs
            .par_iter()
            .map(|(body, run, first)| {
                let mut part = Part::default();
                let particles = scene.bodies()[*body].particles();
                for (row, index) in (run.start as usize..run.end as usize).enumerate() {
                    let f_old = &particles.motion.deformation_gradient[index];
                    let f_new = &particles.trial.deformation_gradient[index];
                    let stiffness = Stiffness::new(
                        this.of(first + row),
                        kinematics,
                        &relative::<D>(f_new, f_old),
                        particles.volume[index] * f_new.determinant(),
                        &particles.trial.stress[index],
                        &tangents[*body][index],
                        particles.trial.position[index][0],
                    );
                    stiffness.emit(freedoms, held, &mut part);
                }
                part
            })
            .collect();
        let mut values = Vec::new();
        for part in parts {
            values.extend_from_slice(&part.values);
            for (equation, force) in part.forces {
                right[equation as usize] -= force;
            }
        }
        let system = self.system.as_mut().ok_or(Singular)?;
        system.sparse.solve(values, damping, right)?;
        for (node, u) in freedoms.nodes.iter().zip(displacement) {
            for (direction, &equation) in node.directions.iter().zip(&node.equations) {
                if equation != NONE {
                    *u += direction * right[equation as usize];
                }
            }
        }
        Ok(())
    }

    /// Analyses the pattern unless the last one still fits.
    fn analyse(&mut self, freedoms: &Freedoms<D>) -> Result<(), Singular> {
        let fits = self.system.as_ref().is_some_and(|system| {
            let nodes = self.links.iter().map(|link| link.node);
            let equations = freedoms.nodes.iter().flat_map(|node| node.equations);
            system.nodes.len() == self.links.len()
                && system.nodes.iter().copied().eq(nodes)
                && system.equations.iter().copied().eq(equations)
        });
        if fits {
            return Ok(());
        }
        let particles = self.starts.len() - 1;
        let entries = (0..particles).flat_map(|particle| {
            let equations: Vec<u32> = equations(self.of(particle), freedoms).collect();
            let columns = equations.clone();
            let pairs = equations.into_iter().flat_map(move |row| {
                let columns = columns.clone();
                columns.into_iter().map(move |column| (row, column))
            });
            pairs.collect::<Vec<_>>()
        });
        self.system = Some(System {
            sparse: SparseSystem::new(freedoms.count, entries)?,
            nodes: self.links.iter().map(|link| link.node).collect(),
            equations: freedoms
                .nodes
                .iter()
                .flat_map(|node| node.equations)
                .collect(),
        });
        Ok(())
    }
}

/// Adds a node to a particle's links; one that it reaches twice (CPDI) is summed.
fn add_link<const D: usize>(
    links: &mut Vec<Link<D>>,
    first: usize,
    node: usize,
    weight: f64,
    gradient: SVector<f64, D>,
) {
    let node = node as u32;
    if let Some(link) = links[first..].iter_mut().find(|link| link.node == node) {
        link.weight += weight;
        link.gradient += gradient;
        return;
    }
    links.push(Link {
        node,
        weight,
        gradient,
    });
}

/// Equations of a particle's nodes, node by node.
fn equations<const D: usize>(
    links: &[Link<D>],
    freedoms: &Freedoms<D>,
) -> impl Iterator<Item = u32> {
    links
        .iter()
        .flat_map(|link| freedoms.nodes[link.node as usize].equations)
        .filter(|&equation| equation != NONE)
}

/// `f⁻ᵀ` of the step's own deformation `f = F_new F_old⁻¹`, in the scene's dimensions.
pub(crate) fn relative<const D: usize>(
    f_new: &nalgebra::Matrix3<f64>,
    f_old: &nalgebra::Matrix3<f64>,
) -> SMatrix<f64, D, D> {
    // f⁻ᵀ = F_new⁻ᵀ F_oldᵀ; both determinants are positive, since the law has accepted them.
    let inverse = f_new
        .try_inverse()
        .unwrap_or_else(nalgebra::Matrix3::identity);
    let transposed = inverse.transpose() * f_old.transpose();
    SMatrix::from_fn(|i, j| transposed[(i, j)])
}

/// What a run adds to the system.
#[derive(Default)]
struct Part {
    values: Vec<f64>,
    /// `K δu_held` by equation.
    forces: Vec<(u32, f64)>,
}

/// Strain rates per unit nodal displacement of one particle, and the stresses that answer them.
struct Stiffness<'a, const D: usize> {
    links: &'a [Link<D>],
    /// Gradients in the deformed configuration.
    gradients: Vec<SVector<f64, D>>,
    volume: f64,
    stress: &'a Sym,
    tangent: &'a Tangent,
    /// `1/r` of an axisymmetric scene, else 0.
    inverse_radius: f64,
}

impl<'a, const D: usize> Stiffness<'a, D> {
    fn new(
        links: &'a [Link<D>],
        kinematics: Kinematics,
        relative: &SMatrix<f64, D, D>,
        volume: f64,
        stress: &'a Sym,
        tangent: &'a Tangent,
        radius: f64,
    ) -> Self {
        Self {
            links,
            gradients: links.iter().map(|link| relative * link.gradient).collect(),
            volume,
            stress,
            tangent,
            inverse_radius: if kinematics == Kinematics::Axisymmetric {
                1.0 / radius
            } else {
                0.0
            },
        }
    }

    /// Strain of a unit displacement of a node along `direction`.
    fn strain(&self, link: usize, direction: &SVector<f64, D>) -> Sym {
        let hoop = direction[0] * self.links[link].weight * self.inverse_radius;
        let (g, q) = (widen(&self.gradients[link]), widen(direction));
        let mut strain = Sym::dyad_of(&q, &g);
        strain.mandel[2] += hoop;
        strain
    }

    fn emit(&self, freedoms: &Freedoms<D>, held: &[SVector<f64, D>], part: &mut Part) {
        // (link, direction, equation, strain) of every component; held ones carry their change.
        let mut columns = Vec::with_capacity(self.links.len() * D);
        let mut prescribed = Vec::new();
        for (link, entry) in self.links.iter().enumerate() {
            let node = &freedoms.nodes[entry.node as usize];
            for (direction, &equation) in node.directions.iter().zip(&node.equations) {
                if equation != NONE {
                    columns.push((link, direction, equation, self.strain(link, direction)));
                }
            }
            let change = held[entry.node as usize];
            if change.amax() > 0.0 {
                prescribed.push((link, change, self.strain(link, &change)));
            }
        }
        let stresses: Vec<Sym> = columns
            .iter()
            .map(|(.., strain)| self.tangent.apply(strain))
            .collect();
        // The law's tangent need not be symmetric: rows test, columns answer.
        for (row, row_direction, _, row_strain) in &columns {
            for ((column, column_direction, ..), stress) in columns.iter().zip(&stresses) {
                let turning = self.turning(*row, row_direction, *column, column_direction);
                part.values
                    .push(self.volume * (row_strain.dot(stress) + turning));
            }
        }
        for (column, change, strain) in &prescribed {
            let stress = self.tangent.apply(strain);
            for (row, direction, equation, row_strain) in &columns {
                let turning = self.turning(*row, direction, *column, change);
                let force = self.volume * (row_strain.dot(&stress) + turning);
                part.forces.push((*equation, force));
            }
        }
    }

    /// The geometric term: what the present stress does on a change of place.
    fn turning(
        &self,
        row: usize,
        row_direction: &SVector<f64, D>,
        column: usize,
        column_direction: &SVector<f64, D>,
    ) -> f64 {
        let traction = self.stress.traction(&widen(&self.gradients[column]));
        let mut turning =
            row_direction.dot(column_direction) * widen(&self.gradients[row]).dot(&traction);
        let hoop = self.inverse_radius * self.inverse_radius * self.stress.zz();
        turning += hoop
            * row_direction[0]
            * column_direction[0]
            * self.links[row].weight
            * self.links[column].weight;
        turning
    }
}

fn widen<const D: usize>(v: &SVector<f64, D>) -> Vector3<f64> {
    Vector3::from_fn(|i, _| if i < D { v[i] } else { 0.0 })
}
