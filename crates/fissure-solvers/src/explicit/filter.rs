//! The velocity filter of XPIC and FMPM.
//!
//! With `S` from nodes to particles and `S⁺` from particles to nodes (mass-weighted), the full
//! mass matrix is `S⁺S` in units of the lumped one. Its inverse on a nodal velocity `v` is
//! approached by `Σ_{r=1}^m (−1)^{r+1} (m over r) (S⁺S)^{r−1} v` [Hammerquist and Nairn 2017].

use fissure_grid::{Shape, Stencil};
use fissure_scene::Scene;
use nalgebra::SVector;

use super::grid_update::{NodeMotion, velocity};
use crate::constraints::Constraints;
use crate::to_grid::{Gift, Sums, Transfers};

/// What holds the terms of the filter, and where the impulses go that this takes.
pub(crate) struct Held<'a, const D: usize> {
    pub constraints: &'a Constraints<D>,
    /// By condition, kg·m/s.
    pub impulses: &'a mut [SVector<f64, D>],
}

/// Fills `filtered` of every node from the velocity that `source` picks, which satisfies `held`.
///
/// Holding the term `r` changes it by `δ_r`; that is in all later terms too, since `S⁺S` keeps the
/// momentum, so the particles receive `m_i δ_r` as often as the coefficients from `r` on sum to:
/// `Σ_{s=r}^m (−1)^{s+1} (m over s) = (−1)^{r+1} (m−1 over r−1)`.
pub(crate) fn filter<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    scratch: &mut Sums<D>,
    nodes: &mut [NodeMotion<D>],
    order: usize,
    source: impl Fn(&NodeMotion<D>) -> SVector<f64, D>,
    mut held: Option<Held<'_, D>>,
) -> Result<(), (usize, usize)> {
    let mut coefficient = order as f64;
    let mut from_here_on = 1.0;
    let mut term: Vec<SVector<f64, D>> = nodes.iter().map(source).collect();
    for (node, v) in nodes.iter_mut().zip(&term) {
        node.filtered = v * coefficient;
    }
    for r in 2..=order {
        transfers.to_grid(scene, scratch, |body, index, stencil, lookup| {
            let mut v = SVector::zeros();
            stencil.visit_values(|entry, weight| v += term[lookup.node(entry)] * weight);
            Gift {
                mass: body.particles().mass[index],
                velocity: v,
                affine: None,
                stress: None,
                acceleration: SVector::zeros(),
            }
        })?;
        coefficient *= -((order + 1 - r) as f64) / r as f64;
        from_here_on *= -((order + 1 - r) as f64) / (r - 1) as f64;
        for (v, sum) in term.iter_mut().zip(&scratch.nodes) {
            *v = velocity(sum);
        }
        // Every term is held, so that the expansion inverts the mass matrix of the free nodes.
        // Holding the sum alone feeds energy in at a wall.
        if let Some(Held {
            constraints,
            impulses,
        }) = &mut held
        {
            for held in &constraints.held {
                let free = term[held.node];
                term[held.node] = held.apply(&free);
                let share = scratch.nodes[held.node].mass * from_here_on;
                let impulse = (term[held.node] - free) * share;
                for (condition, impulse) in held.reactions(&impulse) {
                    impulses[condition] += impulse;
                }
            }
        }
        for (node, v) in nodes.iter_mut().zip(&term) {
            node.filtered += v * coefficient;
        }
    }
    Ok(())
}
