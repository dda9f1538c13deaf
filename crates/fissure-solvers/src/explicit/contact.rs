//! Contact where two fields meet at a node.
//!
//! At a node with the fields `a` and `b` the normal is that of the plane between their particles, from `a` to `b`
//! (`plane`). The gap is measured between particles, not nodes, so that bodies do not feel each other from cells away:
//! `g = min_b (x·n − r) − max_a (x·n + r)` over the particles that reach the node, with their extents `r` along the
//! normal. Between the faces of a crack normal and gap are the crack's own.
//!
//! A step may close the gap and no more: the relative normal velocity after it is at least `−max(g, 0)/Δt`. The impulse
//! this takes is limited from below by zero, the tangential one by friction times it. Fields without a contact between
//! them get a common velocity, as if they were one. Nodes that the tip of a crack is passing are held by a spring besides
//! (`release`), the force of which is that of the end of the step; so is that of a law between faces (`bonds`). Three and more fields at a node are treated pair by pair with
//! impulses that add up (projected Gauss-Seidel).

mod plane;
mod surface;

use fissure_grid::Shape;
use fissure_scene::{Scene, SolveError};
use nalgebra::SVector;
use rayon::prelude::*;

use self::plane::normal_between;
use self::surface::Surface;
use crate::bonds::{Glue, GlueTotals, areas};
use crate::checks::outside;
use crate::crack_motion::faces;
use crate::groups::Label;
use crate::nodes::{Field, MASSIVE, NodeSums, element, vector};
use crate::release::{Release, Tie};
use crate::transfers::Transfers;

/// Rounds over the pairs of a node where more than two fields meet.
const ROUNDS: usize = 30;

/// When the gap between bodies is taken. That between faces of a crack is always of the start: the sum of what strained,
/// to which the step adds.
#[derive(Clone, Copy)]
pub(crate) enum Gap<'f> {
    /// Before the particles have moved.
    Start,
    /// After they have moved with this field.
    End(&'f Field),
}

/// Two fields at a node.
#[derive(Clone, Copy, Debug)]
struct Meeting<const D: usize> {
    /// Their nodes.
    nodes: [usize; 2],
    /// What they do to each other; `None` for a bond.
    law: Option<Law>,
    /// From the first to the second; zero for a bond.
    normal: SVector<f64, D>,
    /// m; negative where they overlap.
    gap: f64,
    /// Between the faces of a crack near its tip; its jump is of the second field.
    tie: Tie<D>,
    /// The law between the faces, by its place among those of the step.
    glue: Option<usize>,
}

/// How two fields touch.
#[derive(Clone, Copy, Debug)]
struct Law {
    between: Between,
    friction: f64,
}

/// What two fields are separated by.
#[derive(Clone, Copy, Debug)]
enum Between {
    /// Bodies with a contact of the scene: which, and whether the field of its second body comes
    /// second.
    Bodies(usize, bool),
    /// The faces of a crack of the scene: which, and whether the second field is on its plus side.
    Faces(usize, bool),
}

impl<const D: usize> Meeting<D> {
    /// The crack between the fields, and the sign of the second one's side.
    fn faces(&self) -> Option<(usize, f64)> {
        match self.law?.between {
            Between::Faces(crack, plus) => Some((crack, if plus { 1.0 } else { -1.0 })),
            Between::Bodies(..) => None,
        }
    }

    fn is_of_bodies(&self) -> bool {
        matches!(self.law.map(|law| law.between), Some(Between::Bodies(..)))
    }
}

/// Where fields meet in a step.
#[derive(Debug, Default)]
pub(crate) struct Meetings<const D: usize> {
    meetings: Vec<Meeting<D>>,
    /// Where the meetings of each split node begin, and the end.
    starts: Vec<u32>,
    /// Laws between faces.
    glues: Vec<Glue<D>>,
}

/// Impulses on the second fields of meetings, kg·m/s.
#[derive(Clone, Debug)]
pub(crate) struct Impulses<const D: usize> {
    /// Of every meeting.
    all: Vec<SVector<f64, D>>,
    /// What of it is of the law between the faces, where there is one.
    glued: Vec<SVector<f64, D>>,
}

impl<const D: usize> Meetings<D> {
    /// Finds the meetings, with normals and gaps at the start of a step in which nothing moves by
    /// more than `margin`, m.
    ///
    /// # Errors
    /// A particle off the grid.
    pub(crate) fn find<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
        release: &Release<D>,
        margin: f64,
    ) -> Result<(), SolveError> {
        self.meetings.clear();
        self.starts.clear();
        self.glues.clear();
        let splits = &transfers.placement.splits;
        if splits.copies.is_empty() {
            return Ok(());
        }
        let off_grid = |(body, index)| outside(scene, body, index);
        let areas = areas(transfers, scene).map_err(off_grid)?;
        let surface = Surface { transfers, scene };
        // Faces of cracks know their normals and gaps: particles are asked only where bodies may touch.
        let bounds = match scene.contacts() {
            [] => Vec::new(),
            _ => surface.bounds().map_err(off_grid)?,
        };
        let (mut wanted, mut copies) = (vec![false; splits.copies.len()], Vec::new());
        for here in splits.nodes() {
            self.starts.push(self.meetings.len() as u32);
            for (a, b) in pairs(here) {
                let pair = [splits.copies[a], splits.copies[b]];
                let law = law(scene, pair.map(|copy| copy.label));
                let mut meeting = Meeting {
                    nodes: pair.map(|copy| copy.node as usize),
                    law,
                    normal: SVector::zeros(),
                    gap: 0.0,
                    tie: Tie::free(),
                    glue: None,
                };
                match law.map(|law| law.between) {
                    None => {}
                    Some(Between::Faces(crack, in_order)) => {
                        let grid = transfers.grid;
                        let x = transfers.placement.node_position(grid, meeting.nodes[0]);
                        (meeting.normal, meeting.gap) = faces(&scene.cracks()[crack], in_order, &x);
                        meeting.tie = release.tie(scene, grid, crack, &x);
                        let mut sides = meeting.nodes;
                        if !in_order {
                            meeting.tie.jump *= -1.0;
                            sides.swap(0, 1);
                        }
                        let glue = Glue::at(scene, crack, &x, sides, &areas, grid.spacing());
                        meeting.glue = glue.map(|glue| {
                            self.glues.push(glue);
                            self.glues.len() - 1
                        });
                    }
                    Some(Between::Bodies(..)) => {
                        // The box of a field without particles is near none.
                        if !bounds[a].is_near(&bounds[b], margin) {
                            continue;
                        }
                        (wanted[a], wanted[b]) = (true, true);
                    }
                }
                copies.push((a, b));
                self.meetings.push(meeting);
            }
        }
        self.starts.push(self.meetings.len() as u32);
        if !wanted.contains(&true) {
            return Ok(());
        }
        let clouds = surface.clouds(&wanted).map_err(off_grid)?;
        self.meetings
            .par_iter_mut()
            .zip(copies)
            .filter(|(meeting, _)| meeting.is_of_bodies())
            .for_each(|(meeting, (a, b))| {
                let (a, b) = (&clouds[a], &clouds[b]);
                meeting.normal = normal_between(&a.places, &b.places);
                meeting.gap = -(a.extent(&meeting.normal) + b.extent(&-meeting.normal));
            });
        Ok(())
    }

    /// Gives bonded fields a common velocity, as if their particles had been summed to one node.
    pub(crate) fn bond(&self, sums: &mut NodeSums<D>) {
        for pair in self.starts.windows(2) {
            let here = &self.meetings[pair[0] as usize..pair[1] as usize];
            let rounds = if here.len() > 1 { ROUNDS } else { 1 };
            let bonds = here.iter().filter(|meeting| meeting.law.is_none());
            for Meeting { nodes, .. } in (0..rounds).flat_map(|_| bonds.clone()) {
                let masses = nodes.map(|node| sums.mass(node));
                let mass = masses[0] + masses[1];
                if mass > 0.0 {
                    let common = (sums.momentum(nodes[0]) + sums.momentum(nodes[1])) / mass;
                    for (&node, own) in nodes.iter().zip(masses) {
                        sums.set_momentum(node, &(common * own));
                    }
                }
            }
        }
    }

    /// Changes the velocities in `field` so that no gap is more than closed within `dt`; of an accelerated field
    /// (`ties`) the springs take their part.
    pub(crate) fn part(
        &self,
        sums: &NodeSums<D>,
        field: &mut Field,
        dt: f64,
        gap: Gap<'_>,
        ties: bool,
    ) -> Impulses<D> {
        let mut impulses = Impulses {
            all: vec![SVector::zeros(); self.meetings.len()],
            glued: vec![SVector::zeros(); self.glues.len()],
        };
        for pair in self.starts.windows(2) {
            let here = pair[0] as usize..pair[1] as usize;
            let rounds = if here.len() > 1 { ROUNDS } else { 1 };
            for _ in 0..rounds {
                for k in here.clone() {
                    self.part_pair(k, sums, field, dt, (gap, ties), &mut impulses);
                }
            }
        }
        impulses
    }

    fn part_pair(
        &self,
        k: usize,
        sums: &NodeSums<D>,
        field: &mut Field,
        dt: f64,
        (gap, ties): (Gap<'_>, bool),
        impulses: &mut Impulses<D>,
    ) {
        let meeting = &self.meetings[k];
        let impulse = impulses.all[k];
        let [a, b] = meeting.nodes;
        let (mass_a, mass_b) = (sums.mass(a), sums.mass(b));
        if !(mass_a > 0.0 && mass_b > 0.0) {
            return;
        }
        let reduced = mass_a * mass_b / (mass_a + mass_b);
        let jump = |field: &Field| vector::<D>(&field[b]) - vector(&field[a]);
        let wanted = if let Some(law) = meeting.law {
            let normal = &meeting.normal;
            let gap = match gap {
                Gap::End(moved) if meeting.is_of_bodies() => {
                    meeting.gap + dt * jump(moved).dot(normal)
                }
                _ => meeting.gap,
            };
            let free = jump(field) - impulse / reduced;
            let mut spring = if ties && meeting.tie.stiffness > 0.0 {
                meeting.tie.impulse(&free, reduced, dt)
            } else {
                SVector::zeros()
            };
            if ties && let Some(place) = meeting.glue {
                let glue = &self.glues[place];
                let sign = meeting.faces().map_or(1.0, |(_, sign)| sign);
                let tie = &meeting.tie;
                let found = glue.impulse(&(free * sign), (tie, sign), reduced, dt);
                spring = found.tie * sign;
                impulses.glued[place] = found.glue * sign;
                spring += impulses.glued[place];
            }
            let relative = free + spring / reduced;
            let closing = relative.dot(normal);
            let push = -reduced * (closing + gap.max(0.0) / dt);
            let push = push.max(0.0);
            let along = (relative - normal * closing) * -reduced;
            let most = if push > 0.0 { law.friction * push } else { 0.0 };
            let length = along.norm();
            let held = if length > most {
                along * (most / length)
            } else {
                along
            };
            spring + normal * push + held
        } else {
            impulse - jump(field) * reduced
        };
        let change = wanted - impulse;
        impulses.all[k] = wanted;
        for (node, velocity) in [(a, -change / mass_a), (b, change / mass_b)] {
            let massive = field[node][MASSIVE] > 0.0;
            field[node] = element(&(vector(&field[node]) + velocity), massive);
        }
    }

    /// Energy that the impulses took, J, if `end` are the velocities of the nodes after all: of contact and springs, and of
    /// the laws between faces.
    pub(crate) fn energy(
        &self,
        sums: &NodeSums<D>,
        end: &Field,
        impulses: &Impulses<D>,
    ) -> [f64; 2] {
        let mean = |node: usize| (sums.velocity(node) + vector(&end[node])) * 0.5;
        let mut taken = [0.0; 2];
        for (meeting, impulse) in self.meetings.iter().zip(&impulses.all) {
            let [a, b] = meeting.nodes;
            let way: SVector<f64, D> = mean(a) - mean(b);
            let glued = meeting.glue.map_or(0.0, |k| impulses.glued[k].dot(&way));
            taken[0] += impulse.dot(&way) - glued;
            taken[1] += glued;
        }
        taken
    }

    /// What the laws between faces make of a step that strains with these velocities.
    pub(crate) fn glued(&self, straining: &Field, dt: f64) -> GlueTotals {
        let mut totals = GlueTotals::default();
        for meeting in &self.meetings {
            let (Some(place), Some((crack, sign))) = (meeting.glue, meeting.faces()) else {
                continue;
            };
            let [a, b] = meeting.nodes;
            let way = (vector::<D>(&straining[b]) - vector(&straining[a])) * (dt * sign);
            if let Some(step) = self.glues[place].after(&way) {
                totals.add(crack, step);
            }
        }
        totals
    }

    /// Jumps of the nodes that are held by springs after a step that strains with these velocities: crack, place (m), and how far the
    /// plus field is from the minus one (m).
    pub(crate) fn tied<'s>(
        &'s self,
        place: impl Fn(usize) -> SVector<f64, D> + 's,
        straining: &'s Field,
        dt: f64,
    ) -> impl Iterator<Item = (usize, SVector<f64, D>, SVector<f64, D>)> + 's {
        let tied = self.meetings.iter().filter(|m| m.tie.stiffness > 0.0);
        tied.filter_map(move |meeting| {
            let (crack, sign) = meeting.faces()?;
            let [a, b] = meeting.nodes;
            let jump = meeting.tie.jump + (vector::<D>(&straining[b]) - vector(&straining[a])) * dt;
            Some((crack, place(a), jump * sign))
        })
    }

    /// Force of each contact on its second body, N.
    pub(crate) fn forces(
        &self,
        scene: &Scene<D>,
        impulses: &Impulses<D>,
        dt: f64,
    ) -> Vec<SVector<f64, D>> {
        let mut forces = vec![SVector::zeros(); scene.contacts().len()];
        for (meeting, impulse) in self.meetings.iter().zip(&impulses.all) {
            if let Some(Between::Bodies(contact, in_order)) = meeting.law.map(|law| law.between) {
                let sign = if in_order { 1.0 } else { -1.0 };
                forces[contact] += impulse * (sign / dt);
            }
        }
        forces
    }
}

/// The pairs of a range.
fn pairs(range: std::ops::Range<usize>) -> impl Iterator<Item = (usize, usize)> {
    let end = range.end;
    range.flat_map(move |a| (a + 1..end).map(move |b| (a, b)))
}

/// What separates two fields, if anything.
fn law<const D: usize>(scene: &Scene<D>, [a, b]: [Label; 2]) -> Option<Law> {
    if a.body == b.body {
        let (crack, in_order) = a.crack_between(b)?;
        return Some(Law {
            between: Between::Faces(crack, in_order),
            friction: scene.cracks()[crack].contact().friction(),
        });
    }
    let [first, second] = [a, b].map(|label| (label.body as usize).checked_sub(1));
    let index = scene.contact_between(first?, second?)?;
    let contact = &scene.contacts()[index];
    Some(Law {
        between: Between::Bodies(index, Some(contact.bodies()[1]) == second),
        friction: contact.law().friction(),
    })
}
