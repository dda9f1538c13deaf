//! The velocity filter of XPIC and FMPM.
//!
//! With `S` from nodes to particles and `S⁺` from particles to nodes (mass-weighted), the full
//! mass matrix is `S⁺S` in units of the lumped one. Its inverse on a nodal velocity `v` is
//! approached by `Σ_{r=1}^m (−1)^{r+1} (m over r) (S⁺S)^{r−1} v` [Hammerquist and Nairn 2017].

use fissure_grid::{FIELD, Shape};
use fissure_scene::Scene;

use super::grid_update::each_node;
use crate::constraints::Constraints;
use crate::nodes::{Field, NodeSums, element, vector};
use crate::transfers::Transfers;

/// The filtered velocity of every node from `term`, which satisfies `held`. `term` and `sums` are
/// used up.
pub(crate) fn filter<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
    mut term: Field,
    order: usize,
    held: Option<&Constraints<D>>,
) -> Result<Field, (usize, usize)> {
    let mut coefficient = order as f64;
    let scaled = |element: &[f64; FIELD]| element.map(|number| number * coefficient);
    let mut filtered: Field = term.iter().map(scaled).collect();
    for r in 2..=order {
        transfers.relay(scene, &term, sums)?;
        coefficient *= -((order + 1 - r) as f64) / r as f64;
        let relayed = &*sums;
        each_node(&mut term, |node, v| {
            *v = element(&relayed.velocity(node), true);
        });
        // Every term is held, so that the expansion inverts the mass matrix of the free nodes.
        // Holding the sum alone feeds energy in at a wall.
        for held in held.into_iter().flat_map(|constraints| &constraints.held) {
            let velocity = held.apply(&vector(&term[held.node]));
            term[held.node] = element(&velocity, true);
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
