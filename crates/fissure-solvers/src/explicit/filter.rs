//! The velocity filter of XPIC and FMPM.
//!
//! With `S` from nodes to particles and `S⁺` from particles to nodes (mass-weighted), the full
//! mass matrix is `S⁺S` in units of the lumped one. Its inverse on a nodal velocity `v` is
//! approached by `Σ_{r=1}^m (−1)^{r+1} (m over r) (S⁺S)^{r−1} v` [Hammerquist and Nairn 2017].

use fissure_grid::{FIELD, Shape};
use fissure_scene::Scene;
use nalgebra::SVector;

use super::contact::Meetings;
use super::grid_update::each_node;
use crate::constraints::Constraints;
use crate::nodes::{Field, NodeSums, element, vector};
use crate::transfers::Transfers;

/// What holds the terms of the filter, and where the impulses go that this takes.
pub(crate) struct Held<'a, const D: usize> {
    pub constraints: &'a Constraints<D>,
    /// By condition, kg·m/s.
    pub impulses: &'a mut [SVector<f64, D>],
}

/// The filtered velocity of every node from `term`, which satisfies `held`. `term` and `sums` are
/// used up.
///
/// Holding the term `r` changes it by `δ_r`; that is in all later terms too, since `S⁺S` keeps the
/// momentum, so the particles receive `m_i δ_r` as often as the coefficients from `r` on sum to:
/// `Σ_{s=r}^m (−1)^{s+1} (m over s) = (−1)^{r+1} (m−1 over r−1)`.
pub(crate) fn filter<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
    mut term: Field,
    order: usize,
    meetings: &Meetings<D>,
    mut held: Option<Held<'_, D>>,
) -> Result<Field, (usize, usize)> {
    let mut coefficient = order as f64;
    let mut from_here_on = 1.0;
    let scaled = |element: &[f64; FIELD]| element.map(|number| number * coefficient);
    let mut filtered: Field = term.iter().map(scaled).collect();
    for r in 2..=order {
        transfers.relay(scene, &term, sums)?;
        meetings.bond(sums);
        coefficient *= -((order + 1 - r) as f64) / r as f64;
        from_here_on *= -((order + 1 - r) as f64) / (r - 1) as f64;
        let relayed = &*sums;
        each_node(&mut term, |node, v| {
            *v = element(&relayed.velocity(node), true);
        });
        // Every term is held, so that the expansion inverts the mass matrix of the free nodes.
        // Holding the sum alone feeds energy in at a wall.
        if let Some(Held {
            constraints,
            impulses,
        }) = &mut held
        {
            for held in &constraints.held {
                let free = vector(&term[held.node]);
                let velocity = held.apply(&free);
                term[held.node] = element(&velocity, true);
                let impulse = (velocity - free) * (relayed.mass(held.node) * from_here_on);
                for (condition, impulse) in held.reactions(&impulse) {
                    impulses[condition] += impulse;
                }
            }
        }
        let term = &term;
        each_node(&mut filtered, |node, v| {
            for (sum, number) in v.iter_mut().zip(&term[node]) {
                *sum += number * coefficient;
            }
        });
    }
    Ok(filtered)
}
