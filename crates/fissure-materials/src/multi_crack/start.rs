//! Where a further plane may start: the largest failure function at least the threshold angle from
//! the planes there are.
//!
//! If the unrestricted maximum is far enough from all of them, it is that. Else it lies on the cone
//! about one of them: each cone is walked round in steps of 5°, the best allowed point refined, and
//! the best of all cones taken. The stress therefore exceeds the strength only in directions nearer
//! than the threshold to a plane, and a plane starts at the threshold as the stress turns past it,
//! not later with a drop.

use std::f64::consts::TAU;

use fissure_tensor::{Band, Matrix3, Sym, Vector3};

use super::{
    Decohesion, MultiCrack, MultiCrackState, Plane, Planes, Rank, leading, relax::tolerance,
    turn::on_cone_rate,
};
use crate::{Biot, Initiation, MaterialError};

/// Points on a cone.
const POINTS: u32 = 72;

/// Over the bound, so that round-off does not put a direction on a cone back inside.
const HAIR: f64 = 1.0 + 1e-9;

/// Closer than this to the bound in `sin²` a direction is on the cone.
const ON_CONE: f64 = 1e-8;

/// The directions at one angle to a plane: its normal, and `sin²` of the angle.
#[derive(Clone, Copy)]
struct Cone {
    axis: Vector3<f64>,
    sine_squared: f64,
}

impl Cone {
    fn misses(&self, normal: &Vector3<f64>) -> f64 {
        (normal.cross(&self.axis).norm_squared() - self.sine_squared).abs()
    }

    /// Cosine of the angle, on the side of a direction.
    fn cosine(&self, near: &Vector3<f64>) -> f64 {
        let cosine = (1.0 - self.sine_squared).max(0.0).sqrt();
        cosine.copysign(self.axis.dot(near))
    }
}

/// Where two cones meet next to a direction.
fn corner([one, other]: [Cone; 2], near: &Vector3<f64>) -> Option<Vector3<f64>> {
    let (a, b) = (one.cosine(near), other.cosine(near));
    let between = one.axis.dot(&other.axis);
    let across = one.axis.cross(&other.axis);
    let rest = across.norm_squared();
    let (x, y) = ((a - between * b) / rest, (b - between * a) / rest);
    let square = (1.0 - x * a - y * b) / rest;
    if !(square > 0.0) {
        return None;
    }
    let side = square.sqrt().copysign(across.dot(near));
    Some(one.axis * x + other.axis * y + across * side)
}

/// What a stress asks for when planes have been returned.
pub(super) enum Next {
    /// Nothing.
    Nothing,
    /// Nothing, but whichever way the strain goes on another plane starts: two principal stresses coincide, so that as good as
    /// the planes there are a whole circle of directions is on the surface.
    Edge,
    /// This plane.
    Start(Plane),
}

impl<const N: usize, D: Decohesion> MultiCrack<N, D> {
    /// What a stress asks for; in a sheet a plane across it.
    pub(super) fn starting<const SHEET: bool>(
        &self,
        stress: &Sym,
        state: &MultiCrackState<N>,
        kinematics: &Biot,
        band: &Band,
    ) -> Result<Next, MaterialError> {
        let mut stress = *stress;
        if SHEET {
            // Needed to hold the thickness only; see `sheet.rs`.
            stress.mandel[2] = 0.0;
        }
        let stress = &stress;
        let planes = state.planes();
        if planes.len() >= self.most() || self.decohesion.upper_bound(stress) <= 0.0 {
            return Ok(Next::Nothing);
        }
        let width_of = |normal: &Vector3<f64>| band.width(&(kinematics.rotation * normal));
        let threshold = |plane: &Plane| self.threshold(plane, band);
        let found = initiation(&self.decohesion, stress, planes, threshold);
        let Some(Initiation { value, mut normal }) = found else {
            return Ok(Next::Nothing);
        };
        let slack = self.slack(stress, planes, kinematics);
        let is_beyond = |share: f64| {
            let stress = *stress * share;
            self.decohesion.along(&stress, &normal, Rank::Further) > 0.0
        };
        if value <= 0.0 || (slack > 0.0 && !is_beyond(1.0 - slack)) {
            let on_edge = slack > 0.0 && is_beyond(1.0 + slack) && is_edge(stress);
            return Ok(if on_edge { Next::Edge } else { Next::Nothing });
        }
        if self.planes == Planes::Rotating {
            // As in every later step, to the last bit.
            normal = leading::<SHEET>(&kinematics.strain()).spectrum().vectors[0];
        }
        let width = width_of(&normal);
        // The door saw neither this rotation nor, for a band with an edge of zero, this normal.
        self.check_width(width)?;
        let traction = self
            .decohesion
            .onset_traction(stress, &normal, rank(planes));
        Ok(Next::Start(Plane::new(&normal, width, traction)))
    }

    /// The share of a stress by which directions may be beyond the surface that the planes there are have been returned to. A
    /// plane that started so would do nothing, and its direction would be chance. The first has none.
    fn slack(&self, stress: &Sym, planes: &[Plane], kinematics: &Biot) -> f64 {
        if planes.is_empty() {
            return 0.0;
        }
        let strain = kinematics.strain();
        16.0 * tolerance(&self.decohesion, &self.elastic, &strain, planes) / stress.norm()
    }
}

/// Two principal stresses nearer than this, over the stress, are the same.
const SAME: f64 = 1e-9;

/// Whether two principal stresses coincide.
fn is_edge(stress: &Sym) -> bool {
    let [first, second, third] = stress.eigenvalues();
    (first - second).min(second - third) <= SAME * stress.norm()
}

/// Of the plane that comes to those there are.
fn rank(planes: &[Plane]) -> Rank {
    if planes.is_empty() {
        Rank::First
    } else {
        Rank::Further
    }
}

/// The largest failure function and its direction outside the cones; `None` if there is no such
/// direction on them. `threshold` gives `sin²` of the angle to keep from a plane, in whatever direction.
fn initiation<D: Decohesion>(
    decohesion: &D,
    stress: &Sym,
    planes: &[Plane],
    threshold: impl Fn(&Plane) -> f64,
) -> Option<Initiation> {
    let free = |normal: &Vector3<f64>| {
        planes.iter().all(|plane| {
            let sine_squared = normal.cross(&plane.normal()).norm_squared();
            sine_squared >= threshold(plane)
        })
    };
    let rank = rank(planes);
    let first = decohesion.initiation(stress, rank);
    if first.value <= 0.0 || free(&first.normal) {
        return Some(first);
    }
    let cone_of = |plane: &Plane| Cone {
        axis: plane.normal(),
        sine_squared: threshold(plane) * HAIR,
    };
    let mut best: Option<Initiation> = None;
    for plane in planes {
        let cone = cone_of(plane);
        let Cone { axis, sine_squared } = cone;
        if sine_squared >= 1.0 {
            return None;
        }
        // The direction of the unrestricted maximum starts the walk: it turns with the stress.
        let across = first.normal - axis * axis.dot(&first.normal);
        let Some(side) = across.try_normalize(1e-6).or_else(|| {
            let other = if axis.z.abs() < 0.9 {
                Vector3::z()
            } else {
                Vector3::x()
            };
            axis.cross(&other).try_normalize(0.0)
        }) else {
            continue;
        };
        let third = axis.cross(&side);
        let (sine, cosine) = (sine_squared.sqrt(), (1.0 - sine_squared).sqrt());
        let at = |angle: f64| {
            let (y, x) = angle.sin_cos();
            let normal = axis * cosine + (side * x + third * y) * sine;
            let value = if free(&normal) {
                decohesion.along(stress, &normal, rank)
            } else {
                f64::NEG_INFINITY
            };
            Initiation { value, normal }
        };
        let mut found = round(at);
        // The walk comes to a corner with another cone by halves; it is known to round-off.
        for other in planes.iter().map(cone_of) {
            if other.axis != axis
                && other.misses(&found.normal) < ON_CONE
                && let Some(normal) = corner([cone, other], &found.normal)
                && free(&normal)
            {
                let value = decohesion.along(stress, &normal, rank);
                found = Initiation { value, normal };
            }
        }
        if found.value > best.map_or(f64::NEG_INFINITY, |b| b.value) {
            best = Some(found);
        }
    }
    best
}

/// Change of the normal that [`initiation`] gave with the stress and the turning of the planes.
pub(super) fn normal_rate<D: Decohesion>(
    decohesion: &D,
    stress: [&Sym; 2],
    planes: &[Plane],
    rates: &[Vector3<f64>],
    normal: &Vector3<f64>,
    threshold: impl Fn(&Plane) -> f64,
) -> Vector3<f64> {
    let rank = rank(planes);
    if decohesion.initiation(stress[0], rank).normal == *normal {
        return decohesion.normal_rate(stress, normal, rank);
    }
    let along = |stress: &Sym, normal: &Vector3<f64>| decohesion.along(stress, normal, rank);
    let mut on: [Option<Turned>; 2] = [None; 2];
    let mut gaps = [f64::INFINITY; 2];
    for (plane, rate) in planes.iter().zip(rates) {
        let turned = Turned {
            cone: Cone {
                axis: plane.normal(),
                sine_squared: threshold(plane),
            },
            rate: *rate,
        };
        let gap = turned.cone.misses(normal);
        if gap < gaps[0] {
            (gaps[1], on[1]) = (gaps[0], on[0]);
            (gaps[0], on[0]) = (gap, Some(turned));
        } else if gap < gaps[1] {
            (gaps[1], on[1]) = (gap, Some(turned));
        }
    }
    match on {
        [Some(one), Some(other)] if gaps[1] < ON_CONE => corner_rate([one, other], normal),
        [Some(one), _] => {
            let axes = [&one.cone.axis, &one.rate];
            on_cone_rate(along, stress, axes, normal)
        }
        _ => Vector3::zeros(),
    }
}

/// A cone with the rate of its axis.
#[derive(Clone, Copy)]
struct Turned {
    cone: Cone,
    rate: Vector3<f64>,
}

/// How the corner of two cones moves with them: `n·a = cos θ` for both, and `n·n = 1`, differentiated.
fn corner_rate(turned: [Turned; 2], normal: &Vector3<f64>) -> Vector3<f64> {
    let [right, other_right] = turned.map(|turned| -normal.dot(&turned.rate));
    let [one, other] = turned.map(|turned| turned.cone.axis);
    let system = Matrix3::from_rows(&[one.transpose(), other.transpose(), normal.transpose()]);
    let inverse = system.try_inverse().unwrap_or_else(Matrix3::zeros);
    inverse * Vector3::new(right, other_right, 0.0)
}

/// The largest value round a cone: a scan, and steps to either side that are halved.
fn round(at: impl Fn(f64) -> Initiation) -> Initiation {
    let step = TAU / f64::from(POINTS);
    let (mut angle, mut best) = (0.0, at(0.0));
    for index in 1..POINTS {
        let here = step * f64::from(index);
        let candidate = at(here);
        if candidate.value > best.value {
            (angle, best) = (here, candidate);
        }
    }
    let mut size = 0.5 * step;
    while size > 1e-9 {
        let (left, right) = (at(angle - size), at(angle + size));
        let (side, candidate) = if left.value > right.value {
            (-size, left)
        } else {
            (size, right)
        };
        if candidate.value > best.value {
            angle += side;
            best = candidate;
        } else {
            size *= 0.5;
        }
    }
    polished(at, angle, best)
}

/// A maximum is flat, so comparing values finds it to the root of round-off only: where it lies
/// between free directions, the zero of the slope finds it to round-off.
fn polished(at: impl Fn(f64) -> Initiation, start: f64, best: Initiation) -> Initiation {
    const H: f64 = 1e-3;
    let mut angle = start;
    for _ in 0..4 {
        let value = |steps: f64| at(angle + steps * H).value;
        let (a, b, c, d) = (value(-2.0), value(-1.0), value(1.0), value(2.0));
        let slope = (8.0 * (c - b) - (d - a)) / (12.0 * H);
        let bend = (16.0 * (b + c) - (a + d) - 30.0 * value(0.0)) / (12.0 * H * H);
        if !(slope.is_finite() && bend < 0.0 && (slope / bend).abs() < H) {
            return best;
        }
        angle -= slope / bend;
    }
    at(angle)
}
