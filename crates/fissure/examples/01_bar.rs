use fissure::prelude::*;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let inv: f64 = std::env::args()
        .nth(1)
        .map_or(200.0, |s| s.parse().unwrap());
    let h = 1.0 / inv;
    let l = 0.2;
    let w = 0.06;
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Prescribed(Vector3::x()),
    };
    let qs = std::env::args().nth(2).is_some();
    let ramp = if qs { 1e-12 } else { 10.0 * l / 3340.0 };
    let speed = move |t: f64| 0.01 * (t / ramp).min(1.0);
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene
        .fill(
            "bar",
            concrete,
            &Block::new([0.0, 0.0], [l, w]),
            &Spacing(h / 2.0),
        )?
        .rigid(
            "left",
            &Block::new([-h, 0.0], [0.0, w]),
            &Spacing(h / 2.0),
            Hold::Component(vector![1.0, 0.0]),
            Velocity(|_| 0.0),
        )?
        .rigid(
            "right",
            &Block::new([l, 0.0], [l + h, w]),
            &Spacing(h / 2.0),
            Hold::Component(vector![1.0, 0.0]),
            Velocity(speed),
        )?
        .set_scale(
            "bar",
            |x| x[0] > l / 2.0 && x[0] < l / 2.0 + h,
            Scale {
                strength: 0.9,
                ..Default::default()
            },
        )?;
    let grid = Grid::over([-4.0 * h, -4.0 * h], [l + 4.0 * h, w + 4.0 * h], h)?;
    let mut solver: Box<dyn Solver<2>> = if qs {
        Box::new(QuasiStatic::new(
            grid,
            shape::Linear,
            QuasiStaticSettings {
                step: 6.3e-3 / 150.0,
                ..Default::default()
            },
        )?)
    } else {
        Box::new(Explicit::new(
            grid,
            shape::Linear,
            ExplicitSettings::default(),
        )?)
    };
    let u0 = 2.0 * 61.35 / (0.9 * 2.7e6);
    let end = ramp / 2.0 + 1.25 * u0 / 0.01;
    let start = std::time::Instant::now();
    let (mut delta, mut work, mut next) = (0.0, 0.0, 0.0);
    let e = 24.9e9 / (1.0 - 0.18f64.powi(2));
    let (mut num, mut den, mut peak) = (0.0, 0.0, 0.0f64);
    while scene.time() < end {
        let report = solver.step(&mut scene, end)?;
        let d = 0.5 * (speed(report.time)) * report.dt + 0.5 * speed(report.time) * report.dt;
        delta += d;
        let p = 0.5 * (scene.reaction("right").unwrap() - scene.reaction("left").unwrap())[0];
        work += p * d;
        peak = peak.max(p);
        let tau = 0.9 * 2.7e6;
        let d0 = tau * l / e;
        let ex = w
            * 0.06
            * if delta < d0 {
                e / l * delta
            } else if delta < u0 {
                e / (l - e * u0 / tau) * (delta - u0)
            } else {
                0.0
            };
        if delta < 1.2 * u0 {
            num += (p - ex).powi(2) * d;
            den += ex * ex * d;
        }
        if delta >= next {
            next += u0 / 20.0;
            println!("{:.3} P {:9.2} exact {:9.2}", delta / u0, p, ex);
        }
    }
    let t = start.elapsed().as_secs_f64();
    let q = 0.06 * 0.06 * 61.35;
    let en = scene.energy();
    println!(
        "steps {} wall {t:.2} Mupd/s {:.3} l2 {:.4} peak {:.4} work {:.4} dissipated {:.4} imbalance {:.2e} loss {:.2e} balance {:.1e} kin {:.2e}",
        scene.step(),
        scene.particle_count() as f64 * scene.step() as f64 / t / 1e6,
        (num / den as f64).sqrt(),
        peak / (0.9 * 9720.0),
        work / q,
        en.dissipated / q,
        en.imbalance() / q,
        en.transfer_loss / q,
        en.worst_balance,
        en.kinetic / q
    );
    Ok(())
}
