//! What a body's particles know around a crack tip.

use std::collections::BTreeMap;

use fissure_particles::ParticleId;
use fissure_scene::{Body, CrackLine, End, Kinematics, Polyline, Scene, Side};
use fissure_tensor::{Matrix3, Sym};
use nalgebra::{Matrix2, Vector2};

use super::PlaneElastic;
use crate::MeasureError;
use crate::error::check_positive;

/// Where a tip is and where it points, now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipFrame {
    /// The tip, m.
    pub position: Vector2<f64>,
    /// Unit vector along the crack out of it.
    pub direction: Vector2<f64>,
}

impl TipFrame {
    /// The tip at an end of a crack.
    pub fn of(crack: &CrackLine, end: End) -> Self {
        let (position, direction) = crack.tip(end);
        Self {
            position,
            direction,
        }
    }

    /// The tip at an end of a crack, with the direction of the straight way to it from the point at
    /// `distance` (m) behind it: of a crack with kinks, its mean direction.
    pub fn over(crack: &CrackLine, end: End, distance: f64) -> Self {
        let own = Self::of(crack, end);
        let way = own.position - crack.behind(end, distance).0;
        Self {
            direction: way.try_normalize(0.0).unwrap_or(own.direction),
            ..own
        }
    }

    /// The axes of the tip as columns: along the crack, and to its left.
    pub fn axes(&self) -> Matrix2<f64> {
        let t = self.direction;
        Matrix2::new(t.x, -t.y, t.y, t.x)
    }
}

/// One particle near a tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TipSample {
    /// Present position, m.
    pub position: Vector2<f64>,
    /// Reference area (volume over thickness), m².
    pub area: f64,
    /// Reference density, kg/m³.
    pub density: f64,
    /// Deformation gradient.
    pub deformation_gradient: Matrix3<f64>,
    /// Cauchy stress, Pa.
    pub stress: Sym,
    /// Stored energy per reference volume, J/m³.
    pub stored: f64,
    /// Velocity, m/s.
    pub velocity: Vector2<f64>,
    /// Acceleration less that of the body force, m/s².
    pub acceleration: Vector2<f64>,
    /// Rate of the in-plane deformation gradient, 1/s.
    pub gradient_rate: Matrix2<f64>,
}

impl TipSample {
    /// The in-plane deformation gradient.
    pub(super) fn gradient(&self) -> Matrix2<f64> {
        let f = &self.deformation_gradient;
        Matrix2::new(f.m11, f.m12, f.m21, f.m22)
    }

    /// The in-plane Cauchy stress, Pa.
    pub(super) fn plane_stress(&self) -> Matrix2<f64> {
        let (s, xy) = (&self.stress, self.stress.xy());
        Matrix2::new(s.xx(), xy, xy, s.yy())
    }
}

/// A loaded piece of the faces of a crack: contact, friction, pressure in it, a traction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceLoad {
    /// Its middle, m.
    pub position: Vector2<f64>,
    /// Its length, m.
    pub length: f64,
    /// Traction on the face to the left of the tip's direction, Pa; on the other acts its opposite.
    pub traction: Vector2<f64>,
    /// Jump (displacement of that face less that of the other) at its end nearer to the tip less that
    /// at its other end, m.
    pub jump_change: Vector2<f64>,
}

/// The particles around a tip, and the loads on the crack's faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TipField {
    /// The particles.
    pub samples: Vec<TipSample>,
    /// Loads on the faces; none on faces that are free.
    pub faces: Vec<FaceLoad>,
}

impl TipField {
    /// The particles of a plane body within `radius` (m) of a point.
    ///
    /// The stored energy is that of `elastic` under the particle's stress. Accelerations and rates
    /// of the deformation gradient come from `rates`; without it they are zero (quasi-static) but
    /// for the scene's body force. The velocities count only with `rates`.
    ///
    /// # Errors
    /// [`MeasureError::UnknownBody`], [`MeasureError::Parameter`],
    /// [`MeasureError::Kinematics`] in an axisymmetric scene.
    pub fn of(
        scene: &Scene<2>,
        body: &str,
        centre: &Vector2<f64>,
        radius: f64,
        elastic: &PlaneElastic,
        rates: Option<&Rates>,
    ) -> Result<Self, MeasureError> {
        check_positive("radius of the field", radius)?;
        elastic.check()?;
        let thickness = thickness(scene)?;
        let body = named(scene, body)?;
        let particles = body.particles();
        let mut samples = Vec::new();
        for (i, x) in particles.motion.position.iter().enumerate() {
            if !((x - centre).norm() < radius) {
                continue;
            }
            let (volume, stress) = (particles.volume[i], particles.motion.stress[i]);
            let f = particles.motion.deformation_gradient[i];
            let rate = rates.and_then(|rates| rates.of(particles.id[i]));
            let (acceleration, gradient_rate) = rate.unwrap_or_default();
            let velocity = match rates {
                Some(_) => particles.motion.velocity[i],
                None => Vector2::zeros(),
            };
            let body_force = scene.body_acceleration(x, scene.time());
            samples.push(TipSample {
                position: *x,
                area: volume / thickness,
                density: particles.mass[i] / volume,
                deformation_gradient: f,
                stress,
                stored: elastic.stored_energy(&stress) * f.determinant(),
                velocity,
                acceleration: acceleration - body_force.unwrap_or_default(),
                gradient_rate,
            });
        }
        Ok(Self {
            samples,
            faces: Vec::new(),
        })
    }
}

impl TipField {
    /// The same with stress, deformation gradient and stored energy of each particle replaced by the
    /// means, weighted by area, of the particles in the same square cell on the same side of the crack.
    ///
    /// Particles hold more than nodes feel: strains that alternate within a cell do no work on the
    /// nodes and stay. K, linear in the strains, does not see them; J, of second order, counts their
    /// energy. With the cells of the solver (`origin` a corner of one, `cell` their width, m) these
    /// means take them out, at the price of the field's own change within a cell.
    ///
    /// # Errors
    /// [`MeasureError::Parameter`] for a cell that is not positive or constants out of range.
    pub fn averaged(
        &self,
        origin: &Vector2<f64>,
        cell: f64,
        crack: &Polyline,
        elastic: &PlaneElastic,
    ) -> Result<Self, MeasureError> {
        check_positive("width of a cell", cell)?;
        elastic.check()?;
        let key = |sample: &TipSample| {
            let x = (sample.position - origin) / cell;
            let side = crack.side(&sample.position) == Side::Plus;
            (x.x.floor() as i64, x.y.floor() as i64, side)
        };
        let mut sums: BTreeMap<_, (f64, Sym, Matrix3<f64>)> = BTreeMap::new();
        for sample in &self.samples {
            let none = (0.0, Sym::ZERO, Matrix3::zeros());
            let (area, stress, gradient) = sums.entry(key(sample)).or_insert(none);
            *area += sample.area;
            *stress += sample.stress * sample.area;
            *gradient += sample.deformation_gradient * sample.area;
        }
        let mut field = self.clone();
        for sample in &mut field.samples {
            if let Some((area, stress, gradient)) = sums.get(&key(sample)) {
                sample.stress = *stress / *area;
                sample.deformation_gradient = gradient / *area;
                sample.stored = elastic.stored_energy(&sample.stress)
                    * sample.deformation_gradient.determinant();
            }
        }
        Ok(field)
    }
}

/// The thickness of a plane scene, m.
pub(super) fn thickness(scene: &Scene<2>) -> Result<f64, MeasureError> {
    match scene.kinematics() {
        Kinematics::PlaneStrain { thickness } | Kinematics::PlaneStress { thickness } => {
            Ok(thickness)
        }
        Kinematics::Axisymmetric | Kinematics::Solid => Err(MeasureError::Kinematics {
            measure: "a plane crack tip",
        }),
    }
}

/// The body of this name.
pub(super) fn named<'a>(scene: &'a Scene<2>, name: &str) -> Result<&'a Body<2>, MeasureError> {
    scene.body(name).ok_or_else(|| MeasureError::UnknownBody {
        name: name.to_owned(),
    })
}

/// Accelerations and rates of the deformation gradient of a body's particles, from what they did
/// between two looks at the scene: `ü = (v₂ − v₁)/(t₂ − t₁)`, `Ḟ = (F₂ − F₁)/(t₂ − t₁)`.
///
/// They belong to the middle of that interval and are means over it: a few steps smooth what a
/// single step's transfer adds to a particle's velocity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rates {
    looks: [Look; 2],
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Look {
    time: f64,
    /// By particle id; `None` of ids that are not in the body.
    motion: Vec<Option<(Vector2<f64>, Matrix2<f64>)>>,
}

impl Rates {
    /// Looks at a body; a second look at the same time changes nothing.
    ///
    /// # Errors
    /// [`MeasureError::UnknownBody`].
    pub fn look(&mut self, scene: &Scene<2>, body: &str) -> Result<(), MeasureError> {
        let body = named(scene, body)?;
        let time = scene.time();
        if !self.looks[1].motion.is_empty() && !(time > self.looks[1].time) {
            return Ok(());
        }
        self.looks.swap(0, 1);
        let [_, now] = &mut self.looks;
        now.time = time;
        now.motion.clear();
        let (ids, motion) = (&body.particles().id, &body.particles().motion);
        let highest = ids.iter().map(|id| id.0 as usize + 1).max().unwrap_or(0);
        now.motion.resize(highest, None);
        for (i, id) in ids.iter().enumerate() {
            let f = Body::<2>::in_space(&motion.deformation_gradient[i]);
            now.motion[id.0 as usize] = Some((motion.velocity[i], f));
        }
        Ok(())
    }

    /// Whether there were two looks.
    pub fn are_known(&self) -> bool {
        !self.looks[0].motion.is_empty()
    }

    /// Acceleration (m/s²) and rate of the deformation gradient (1/s) of a particle; `None` before
    /// the second look.
    pub fn of(&self, id: ParticleId) -> Option<(Vector2<f64>, Matrix2<f64>)> {
        let [old, new] = &self.looks;
        let (v1, f1) = (*old.motion.get(id.0 as usize)?)?;
        let (v2, f2) = (*new.motion.get(id.0 as usize)?)?;
        let dt = new.time - old.time;
        Some(((v2 - v1) / dt, (f2 - f1) / dt))
    }
}
