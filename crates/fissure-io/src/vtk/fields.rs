//! Columns of a scene as arrays of a frame.

use fissure_scene::{Body, Scene, WatchError};
use fissure_tensor::Sym;
use nalgebra::SVector;

use super::PointCloud;

/// What is written besides the positions.
#[derive(Debug, Default)]
pub(super) struct Fields {
    pub velocity: bool,
    pub stress: bool,
    pub jacobian: bool,
    pub ids: bool,
    pub bodies: bool,
    pub values: Vec<String>,
    pub all_values: bool,
}

impl Fields {
    /// The particles of all bodies, body after body, with these fields.
    pub fn cloud<const D: usize>(
        &self,
        scene: &Scene<D>,
    ) -> Result<PointCloud<'static>, WatchError> {
        let mut cloud = PointCloud::new(each(scene, |_, b, i| in_three(&b.motion().position[i])));
        if self.velocity {
            let velocity = each(scene, |_, b, i| in_three(&b.motion().velocity[i]));
            cloud = cloud.vector("velocity [m/s]", velocity);
        }
        if self.stress {
            let stress = each(scene, |_, b, i| vtk_order(&b.motion().stress[i]));
            cloud = cloud.symmetric("stress [Pa]", stress);
        }
        if self.jacobian {
            let f = |b: &Body<D>, i: usize| b.motion().deformation_gradient[i].determinant();
            cloud = cloud.scalar("jacobian", each(scene, |_, b, i| f(b, i)));
        }
        if self.ids {
            cloud = cloud.ids("id", each(scene, |_, b, i| b.particles().id[i].0));
        }
        if self.bodies {
            cloud = cloud.ids("body", each(scene, |index, _, _| index as u32));
        }
        for name in self.value_names(scene) {
            cloud = cloud.scalar(name, values(scene, name)?);
        }
        Ok(cloud)
    }

    /// Those asked for by name, then, if all are, the others as the bodies bring them.
    fn value_names<'a, const D: usize>(&'a self, scene: &'a Scene<D>) -> Vec<&'a str> {
        let mut names: Vec<&str> = self.values.iter().map(String::as_str).collect();
        if self.all_values {
            for name in scene.bodies().iter().flat_map(|body| body.law().names()) {
                if !names.contains(name) {
                    names.push(name);
                }
            }
        }
        names
    }
}

/// One entry per particle, body after body; the closure gets the body's index, the body and the particle's row.
fn each<T, const D: usize>(
    scene: &Scene<D>,
    entry: impl Fn(usize, &Body<D>, usize) -> T,
) -> Vec<T> {
    let mut column = Vec::with_capacity(scene.particle_count());
    for (index, body) in scene.bodies().iter().enumerate() {
        column.extend((0..body.particles().len()).map(|row| entry(index, body, row)));
    }
    column
}

/// A value of the laws; NaN where a body's law has none of that name.
fn values<const D: usize>(scene: &Scene<D>, name: &str) -> Result<Vec<f64>, WatchError> {
    let mut column = Vec::with_capacity(scene.particle_count());
    let mut known = false;
    for body in scene.bodies() {
        match body.value(name) {
            Some(values) => {
                known = true;
                column.extend(values);
            }
            None => column.resize(column.len() + body.particles().len(), f64::NAN),
        }
    }
    if known {
        return Ok(column);
    }
    Err(WatchError::Unknown {
        kind: "value of a law",
        name: name.to_owned(),
    })
}

fn in_three<const D: usize>(vector: &SVector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|i| if i < D { vector[i] } else { 0.0 })
}

/// xx, yy, zz, xy, yz, xz.
fn vtk_order(stress: &Sym) -> [f64; 6] {
    [
        stress.xx(),
        stress.yy(),
        stress.zz(),
        stress.xy(),
        stress.yz(),
        stress.xz(),
    ]
}
