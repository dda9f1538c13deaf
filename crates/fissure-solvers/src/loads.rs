//! External forces of the conditions on the nodes.

use fissure_grid::{Shape, Stencil, tile_of};
use fissure_scene::{ConditionKind, Scene, Selection};

use crate::to_grid::{NodeLookup, Sums, Transfers};

/// Adds the loads of the conditions at `time`, N, to the nodes that their particles reach.
///
/// # Errors
/// Body and index of a particle off the grid.
pub(crate) fn add_loads<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut Sums<D>,
    time: f64,
) -> Result<(), (usize, usize)> {
    let tiles = &transfers.placement.tiles;
    for (index, condition) in scene.conditions().iter().enumerate() {
        let (ConditionKind::Force(force), Selection::Body { body, .. }) =
            (condition.kind(), condition.selection())
        else {
            continue;
        };
        let (body_index, body) = (*body, &scene.bodies()[*body]);
        let rows = transfers.placement.selected(index);
        let volume = &body.particles().volume;
        let total: f64 = rows.iter().map(|&row| volume[row as usize]).sum();
        let force = force(time);
        for &row in rows {
            let row = row as usize;
            let off_grid = (body_index, row);
            let cell = transfers.grid.cell(&body.motion().position[row]);
            let tile = cell.and_then(|cell| tiles.find(tile_of(cell)));
            let tile = tile.ok_or(off_grid)?;
            let stencil = transfers.stencil(body, tiles.coordinates(tile), row);
            let lookup = NodeLookup::new(tiles, tile);
            let share = force * (volume[row] / total);
            stencil.ok_or(off_grid)?.visit_values(|entry, weight| {
                sums.nodes[lookup.node(entry)].external_force += share * weight;
            });
        }
    }
    Ok(())
}
