//! J and K on exact fields put on particles, at rest and in motion.

mod exact;

use exact::{GLASS, Lattice, add, griffith, williams};
use fissure_diagnostics::MeasureError;
use fissure_diagnostics::fit_slope;
use fissure_diagnostics::fracture::{
    Annulus, FaceJump, FaceLoad, NearTip, PlaneElastic, TipField, apparent_tip, contours,
    interaction, j_integral, opening_intensity,
};
use fissure_scene::Polyline;
use fissure_tensor::Matrix3;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::PI;

/// Load small enough that what is of second order in the strain does not show.
const SMALL: f64 = 1e-3;

fn ring(inner: f64, outer: f64) -> Annulus {
    Annulus { inner, outer }
}

fn relative(found: f64, exact: f64) -> f64 {
    (found / exact - 1.0).abs()
}

/// Both states of the plane, all modes with a T-stress, the tip anywhere in its cell and the lattice
/// at any angle to the crack, a domain of six cells.
#[test]
fn intensities_of_exact_fields() {
    let h = 1e-3;
    for plane_stress in [false, true] {
        let elastic = PlaneElastic {
            plane_stress,
            ..GLASS
        };
        for k in [[1e6, 0.0], [0.0, 1e6], [1.2e6, -0.5e6]] {
            let k = k.map(|k| k * SMALL);
            let field = williams(elastic, k, 2e6 * SMALL);
            let j = elastic.energy_release(k[0], k[1]);
            let size = k[0].hypot(k[1]);
            for (tip, angle) in [(0.0, 0.0), (0.2, 0.0), (0.4, 0.0), (0.3, 0.3), (0.0, 0.6)] {
                let lattice = Lattice {
                    tip,
                    angle,
                    ..Lattice::new(h, 6.0 * h)
                };
                let (field, frame) = (lattice.field(&elastic, &field), lattice.frame());
                let ring = ring(2.0 * h, 6.0 * h);
                let found = interaction(&field, &frame, &ring, &elastic).unwrap();
                let bound = if angle == 0.0 { 1e-3 } else { 1.5e-2 };
                for (found, exact) in [(found.k1, k[0]), (found.k2, k[1])] {
                    assert!((found - exact).abs() < bound * size, "{k:?} {tip} {angle}");
                }
                let error = relative(j_integral(&field, &frame, &ring).unwrap(), j);
                assert!(error < bound, "{k:?} {tip} {angle}: {error:e}");
            }
        }
    }
}

/// Griffith's crack: the domain is a part of the crack, so the field is not only singular.
#[test]
fn griffith_crack_at_second_order() {
    let (a, sigma, tau) = (0.025, 1e7 * SMALL, 0.5e7 * SMALL);
    let k = [sigma, tau].map(|s| s * (PI * a).sqrt());
    let exact = griffith(GLASS, a, sigma, tau);
    let rings = [(0.05, 0.25), (0.1, 0.3), (0.1, 0.4), (0.15, 0.5)];
    let rings = rings.map(|(inner, outer)| ring(inner * a, outer * a));
    let (mut cells, mut errors) = (Vec::new(), Vec::new());
    for (resolution, bound) in [(25.0, 4e-4), (50.0, 1e-4), (100.0, 2.5e-5)] {
        let h = a / resolution;
        let mut worst = 0.0f64;
        for tip in [0.0, 0.25, 0.4] {
            let lattice = Lattice {
                tip,
                ..Lattice::new(h, 0.55 * a)
            };
            let (field, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
            for ring in &rings {
                let found = interaction(&field, &frame, ring, &GLASS).unwrap();
                let j = j_integral(&field, &frame, ring).unwrap();
                let j = relative(j, GLASS.energy_release(k[0], k[1]));
                worst = worst.max(relative(found.k1, k[0])).max(j);
                worst = worst.max(relative(found.k2, k[1]));
            }
            let spread = contours(&field, &frame, &rings).unwrap().spread;
            assert!(spread < bound, "a/h {resolution}, {tip}: spread {spread:e}");
        }
        println!("a/h {resolution}: {worst:e}");
        assert!(worst < bound, "a/h {resolution}: {worst:e}");
        cells.push(h);
        errors.push(worst);
    }
    let order = fit_slope(&cells, &errors).unwrap().exponent;
    println!("order {order}");
    assert!(order > 1.7, "{order}");
}

/// A body turned with its crack, by any angle: the same J and K, though F is far from 1.
#[test]
fn turning_the_loaded_body_changes_nothing() {
    let (h, k) = (1e-3, [1.2e6, -0.5e6]);
    let exact = williams(GLASS, k, 2e6);
    let measure = |turn: f64| {
        let lattice = Lattice {
            turn,
            ..Lattice::new(h, 6.0 * h)
        };
        let (field, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
        let ring = ring(2.0 * h, 6.0 * h);
        let found = interaction(&field, &frame, &ring, &GLASS).unwrap();
        [
            j_integral(&field, &frame, &ring).unwrap(),
            found.k1,
            found.k2,
        ]
    };
    let still = measure(0.0);
    for turn in [0.7, 1.9, 3.1, -2.4] {
        for (turned, still) in measure(turn).into_iter().zip(still) {
            assert!(
                relative(turned, still) < 1e-9,
                "{turn}: {turned} for {still}"
            );
        }
    }
}

/// P-waves along the crack of a body with ν = 0, which leave its faces free, over a static field:
/// with the waves' inertia J and K are those of the static field, in every domain; without, not.
#[test]
fn waves_over_a_crack_at_rest() {
    let elastic = PlaneElastic {
        young: 70e9,
        poisson: 0.0,
        plane_stress: false,
    };
    let (density, speed) = (2500.0, (70e9f64 / 2500.0).sqrt());
    let (k, h) = ([1e6 * SMALL, 0.4e6 * SMALL], 1e-3);
    let (number, strain) = (2.0 * PI / (30.0 * h), 1e-4 * SMALL);
    let singular = williams(elastic, k, 0.0);
    // u = (strain/number) sin(number (x − c t)) at a phase.
    for phase in [0.0, 0.8, 2.5] {
        let moving = |x: &Vector2<f64>| {
            let e = strain * (number * x.x + phase).cos();
            let wave = NearTip {
                stress: Matrix2::new(elastic.young * e, 0.0, 0.0, 0.0),
                gradient: Matrix2::new(e, 0.0, 0.0, 0.0),
            };
            add(singular(x), wave)
        };
        let lattice = Lattice::new(h, 12.5 * h);
        let frame = lattice.frame();
        let mut field = lattice.field(&elastic, &moving);
        for sample in &mut field.samples {
            let argument = number * (sample.position - frame.position).x + phase;
            let (sine, cosine) = argument.sin_cos();
            sample.density = density;
            sample.velocity.x = -speed * strain * cosine;
            sample.acceleration.x = -speed * speed * number * strain * sine;
            sample.gradient_rate.m11 = speed * number * strain * sine;
        }
        let rings = [(2.0, 8.0), (3.0, 10.0), (4.0, 12.0)].map(|(i, o)| ring(i * h, o * h));
        let exact = elastic.energy_release(k[0], k[1]);
        for ring in &rings {
            let found = interaction(&field, &frame, ring, &elastic).unwrap();
            let errors = [
                relative(j_integral(&field, &frame, ring).unwrap(), exact),
                relative(found.k1, k[0]),
                relative(found.k2, k[1]),
            ];
            println!("{phase}: {errors:?}");
            assert!(
                errors.iter().all(|error| *error < 2e-3),
                "{phase}: {errors:?}"
            );
        }
        for sample in &mut field.samples {
            sample.acceleration = Vector2::zeros();
        }
        let static_j = contours(&field, &frame, &rings).unwrap();
        let wrong = relative(static_j.mean, exact).max(static_j.spread);
        assert!(wrong > 0.02, "{phase}: {wrong}");
    }
}

/// A crack that runs steadily in mode I [Freund 1990, sec. 4.3]: J with the kinetic energy is
/// `A(V) K²/E′` in every domain.
#[test]
fn a_crack_that_runs_steadily() {
    let elastic = PlaneElastic {
        young: 70e9,
        poisson: 0.25,
        plane_stress: false,
    };
    let (density, k, h) = (2500.0, 1e6 * SMALL, 1e-3);
    let mu = elastic.shear_modulus();
    let slow = (mu / density).sqrt();
    // c_d² = c_s² (κ + 1)/(κ − 1).
    let fast = slow * ((elastic.kolosov() + 1.0) / (elastic.kolosov() - 1.0)).sqrt();
    for share in [0.3, 0.6] {
        let speed = share * slow;
        let alpha = [fast, slow].map(|c| (1.0 - (speed / c).powi(2)).sqrt());
        let [ad, as_] = alpha;
        let rayleigh = 4.0 * ad * as_ - (1.0 + as_ * as_).powi(2);
        // u₁ and u₂ are sums of real and imaginary parts of √(x + iα y).
        let size = k / (mu * (2.0 * PI).sqrt() * rayleigh);
        let slopes = |x: &Vector2<f64>| {
            let half = |a: f64| {
                let y = a * x.y;
                let (r, theta) = (x.x.hypot(y), y.atan2(x.x));
                (r.powf(-0.5), 0.5 * theta)
            };
            let ((rd, td), (rs, ts)) = (half(ad), half(as_));
            let (d, s) = (1.0 + as_ * as_, 2.0 * ad * as_);
            let gradient = Matrix2::new(
                d * rd * td.cos() - s * rs * ts.cos(),
                ad * d * rd * td.sin() - as_ * s * rs * ts.sin(),
                ad * d * rd * td.sin() - 2.0 * ad * rs * ts.sin(),
                -ad * ad * d * rd * td.cos() + s * rs * ts.cos(),
            ) * size;
            let lambda = mu * (fast * fast / (slow * slow) - 2.0);
            let strain = (gradient + gradient.transpose()) * 0.5;
            let stress = strain * (2.0 * mu) + Matrix2::identity() * (lambda * strain.trace());
            NearTip { stress, gradient }
        };
        // The field is right: free faces, and K ahead.
        for x in [-1.0, -0.3] {
            let face = slopes(&Vector2::new(x, 1e-13)).stress;
            let scale = k / (2.0 * PI).sqrt();
            assert!(
                face.m22.abs() < 1e-9 * scale && face.m12.abs() < 1e-9 * scale,
                "{face}"
            );
        }
        let ahead = slopes(&Vector2::new(0.5, 0.0)).stress.m22 * PI.sqrt();
        assert!(relative(ahead, k) < 1e-12, "{ahead}");

        let lattice = Lattice {
            tip: 0.2,
            ..Lattice::new(h, 12.5 * h)
        };
        let frame = lattice.frame();
        let mut field = lattice.field(&elastic, &slopes);
        let delta = 1e-4 * h;
        for sample in &mut field.samples {
            let x = sample.position - frame.position;
            let along = |x: &Vector2<f64>| slopes(x).gradient;
            let (l, r) = (x - Vector2::x() * delta, x + Vector2::x() * delta);
            sample.density = density;
            sample.velocity = -along(&x).column(0) * speed;
            sample.gradient_rate = (along(&r) - along(&l)) * (-speed / (2.0 * delta));
            sample.acceleration = sample.gradient_rate.column(0) * -speed;
        }
        let factor = speed * speed * ad / ((1.0 - elastic.poisson) * slow * slow * rayleigh);
        let exact = factor * k * k / elastic.effective_modulus();
        for (inner, outer) in [(2.0, 8.0), (4.0, 12.0)] {
            let ring = ring(inner * h, outer * h);
            let error = relative(j_integral(&field, &frame, &ring).unwrap(), exact);
            println!("V = {share} c_s: {error:e}");
            assert!(error < 2e-3, "V = {share} c_s: {error:e}");
        }
        // The kinetic energy is a part of it that is not small.
        for sample in &mut field.samples {
            sample.velocity = Vector2::zeros();
            sample.acceleration = Vector2::zeros();
        }
        let without = j_integral(&field, &frame, &ring(4.0 * h, 12.0 * h)).unwrap();
        assert!(relative(without, exact) > 0.02, "V = {share} c_s");
    }
}

/// Pressure in a crack: the loads on the faces make up for the missing remote load.
#[test]
fn pressure_on_the_faces() {
    let (a, h, p) = (0.025, 0.5e-3, 1e7 * SMALL);
    // Tension across a free crack less the uniform field: the crack alone under pressure.
    let opened = griffith(GLASS, a, p, 0.0);
    let whole = griffith(GLASS, 1e-30, p, 0.0);
    let exact = |x: &Vector2<f64>| {
        let (with, without) = (opened(x), whole(&Vector2::new(1.0, 1.0)));
        NearTip {
            stress: with.stress - without.stress,
            gradient: with.gradient - without.gradient,
        }
    };
    let lattice = Lattice::new(h, 0.5 * a);
    let (mut field, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
    let ring = ring(0.1 * a, 0.45 * a);
    let bare = interaction(&field, &frame, &ring, &GLASS).unwrap();
    let length = 0.5 * h;
    field.faces = (0..)
        .map(|i| (f64::from(i) + 0.5) * length)
        .take_while(|r| *r < 0.5 * a)
        .map(|r| {
            let open =
                |r: f64| 4.0 * p / GLASS.effective_modulus() * (a * a - (a - r).powi(2)).sqrt();
            let change = open(r - 0.5 * length) - open(r + 0.5 * length);
            FaceLoad {
                position: frame.position - frame.direction * r,
                length,
                traction: Vector2::new(0.0, p),
                jump_change: Vector2::new(0.0, change),
            }
        })
        .collect();
    let k = p * (PI * a).sqrt();
    let found = interaction(&field, &frame, &ring, &GLASS).unwrap();
    let j = j_integral(&field, &frame, &ring).unwrap();
    let errors = [
        relative(found.k1, k),
        relative(j, GLASS.energy_release(k, 0.0)),
    ];
    println!("{errors:?}; without the faces {}", bare.k1 / k - 1.0);
    assert!(errors[0] < 5e-4 && errors[1] < 5e-4, "{errors:?}");
    assert!(found.k2.abs() < 1e-6 * k);
    assert!(relative(bare.k1, k) > 0.05);
}

/// Strains that alternate within the cells: K does not see them, J does, means over cells take them
/// out.
#[test]
fn alternating_strains_and_means_over_cells() {
    let (h, k) = (1e-3, [1.2e3, -0.5e3]);
    let lattice = Lattice::new(h, 6.0 * h);
    let frame = lattice.frame();
    let mut field = lattice.field(&GLASS, &williams(GLASS, k, 2e3));
    let odd = |x: f64| 1.0 - 2.0 * (2.0 * x / h).floor().rem_euclid(2.0);
    for sample in &mut field.samples {
        let x = sample.position - frame.position;
        let factor = 1.0 + 0.2 * odd(x.x) * odd(x.y);
        let strain = sample.deformation_gradient - Matrix3::identity();
        sample.deformation_gradient = Matrix3::identity() + strain * factor;
        sample.stress = sample.stress * factor;
        sample.stored *= factor * factor;
    }
    let crack = Polyline::new(vec![frame.position - frame.direction, frame.position]).unwrap();
    let means = field.averaged(&frame.position, h, &crack, &GLASS).unwrap();
    let measure = |field: &TipField| {
        let ring = ring(2.0 * h, 6.0 * h);
        let found = interaction(field, &frame, &ring, &GLASS).unwrap();
        let j = j_integral(field, &frame, &ring).unwrap();
        let j = relative(j, GLASS.energy_release(k[0], k[1]));
        (relative(found.k1, k[0]).max(relative(found.k2, k[1])), j)
    };
    let ((raw_k, raw_j), (k, j)) = (measure(&field), measure(&means));
    assert!(raw_k < 1e-3 && raw_j > 0.03, "{raw_k:e} {raw_j:e}");
    assert!(k < 5e-3 && j < 4e-3, "{k:e} {j:e}");
    assert!(
        field
            .averaged(&frame.position, 0.0, &crack, &GLASS)
            .is_err()
    );
}

#[test]
fn intensities_from_the_opening() {
    let (a, sigma) = (0.025, 1e7);
    let k = sigma * (PI * a).sqrt();
    let jumps: Vec<FaceJump> = (4..12)
        .map(|i| {
            let r = f64::from(i) * 0.5e-3;
            let open = 4.0 * sigma / GLASS.effective_modulus() * (a * a - (a - r).powi(2)).sqrt();
            FaceJump {
                distance: r,
                opening: open,
                sliding: -0.5 * open,
            }
        })
        .collect();
    let found = opening_intensity(&jumps, 0.0, &GLASS).unwrap();
    assert!(relative(found.k1, k) < 1e-3, "{}", found.k1 / k);
    assert!(relative(found.k2, -0.5 * k) < 1e-3);
    // The same faces seen from a place that is not their tip.
    let shift = 0.4e-3;
    let mut shifted = jumps.clone();
    shifted.iter_mut().for_each(|jump| jump.distance -= shift);
    let ahead = apparent_tip(&shifted).unwrap();
    assert!((ahead - shift).abs() < 1e-9, "{ahead}");
    let found = opening_intensity(&shifted, ahead, &GLASS).unwrap();
    assert!(relative(found.k1, k) < 1e-3 && relative(found.k2, -0.5 * k) < 1e-3);
    assert!(opening_intensity(&shifted, 0.0, &GLASS).unwrap().k1 > 1.05 * k);

    for bad in [
        &jumps[..1],
        &[jumps[0], jumps[0]],
        &[FaceJump::default(), jumps[0]],
    ] {
        let refused = opening_intensity(bad, 0.0, &GLASS);
        assert!(matches!(refused, Err(MeasureError::Parameter { .. })));
    }
    let refused = apparent_tip(&jumps[..2]);
    assert!(matches!(refused, Err(MeasureError::Parameter { .. })));
    for bad in [[jumps[0]; 3], [FaceJump::default(); 3]] {
        let refused = apparent_tip(&bad);
        assert!(matches!(refused, Err(MeasureError::NotFinite { .. })));
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let h = 1e-3;
    let exact = williams(GLASS, [1e3, 0.0], 0.0);
    let lattice = Lattice::new(h, 5.0 * h);
    let (field, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
    let refused = |field: &TipField, ring: &Annulus| j_integral(field, &frame, ring);
    // The domain is larger than the body.
    let outside = refused(&field, &ring(2.0 * h, 8.0 * h));
    assert!(matches!(outside, Err(MeasureError::Coverage { coverage }) if coverage < 0.95));
    let empty = refused(&TipField::default(), &ring(2.0 * h, 4.0 * h));
    assert!(matches!(empty, Err(MeasureError::Coverage { .. })));
    for (inner, outer) in [
        (4.0, 4.0),
        (-1.0, 4.0),
        (f64::NAN, 4.0),
        (1.0, f64::INFINITY),
    ] {
        let none = refused(&field, &ring(inner * h, outer * h));
        assert!(matches!(none, Err(MeasureError::Parameter { .. })));
    }
    let mut broken = field.clone();
    let row = broken.samples.iter().position(|sample| {
        let r = (sample.position - frame.position).norm();
        r > 2.5 * h && r < 3.5 * h
    });
    broken.samples[row.unwrap()].stored = f64::NAN;
    let nan = refused(&broken, &ring(2.0 * h, 4.0 * h));
    assert_eq!(nan, Err(MeasureError::NotFinite { measure: "J" }));
}
