//! The elastic bar: convergence with the grid spacing [Sanchez 2010, sec. 5.3, Table 5.2].

use fissure::prelude::*;

use super::bar::{BODY, Bar};
use super::softening::load;
use crate::framework::{Parameters, Report as Rows, Row, SimulationRow, StudyError};

/// Mean strain of the bar: so small that the geometry does not change within the errors studied.
const STRAIN: f64 = 1e-7;

/// Slopes of Table 5.2 by angle, degrees.
const TABLE_5_2: [(f64, f64); 4] = [
    (0.0, 1.4354),
    (15.0, 0.9482),
    (30.0, 0.8573),
    (45.0, 0.8982),
];

pub(super) fn run(cases: &[&Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut series: Vec<Series> = Vec::new();
    for case in cases {
        let row = pull(case)?;
        let (angle, fill) = (case.number("angle")?, case.choice("fill")?.to_owned());
        let point = (row.h, row.load_error);
        match series
            .iter_mut()
            .find(|s| s.angle == angle && s.fill == fill)
        {
            Some(series) => series.points.push(point),
            None => series.push(Series {
                angle,
                fill,
                points: vec![point],
            }),
        }
        rows.row(row.row)?;
    }
    for series in series.iter().filter(|series| series.points.len() > 1) {
        rows.row(series.row())?;
    }
    Ok(())
}

/// Errors of one angle and filling over the spacing.
struct Series {
    angle: f64,
    fill: String,
    points: Vec<(f64, f64)>,
}

impl Series {
    fn row(&self) -> Row {
        let log_error = |(_, error): &(f64, f64)| error.ln();
        let errors: Vec<f64> = self.points.iter().map(log_error).collect();
        let log_h: Vec<f64> = self.points.iter().map(|(h, _)| h.ln()).collect();
        // "a least squares fit to the log E_p vs. h⁻¹ data": decades of error per 100/m.
        let inverse_h: Vec<f64> = self.points.iter().map(|(h, _)| 1.0 / h).collect();
        let worded = slope(&inverse_h, &errors) / std::f64::consts::LN_10 * 100.0;
        let document = TABLE_5_2.iter().find(|(angle, _)| *angle == self.angle);
        Row::other("tensile-bar")
            .field("case", "elastic slopes")
            .field("angle", self.angle)
            .field("fill", self.fill.as_str())
            .field("slope", slope(&log_h, &errors))
            .field("decades_per_100_inverse_m", worded)
            .field("table_5_2", document.map_or(f64::NAN, |(_, slope)| *slope))
    }
}

/// Slope of the least-squares line.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let mean = |v: &[f64]| v.iter().sum::<f64>() / n;
    let (mx, my) = (mean(x), mean(y));
    let covariance: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let variance: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
    covariance / variance
}

struct Pulled {
    row: SimulationRow,
    h: f64,
    load_error: f64,
}

fn pull(case: &Parameters) -> Result<Pulled, StudyError> {
    match case.choice("shape")? {
        "gimp" => pull_on(case, shape::Gimp),
        "cpdi" => pull_on(case, shape::Cpdi),
        "bspline2" => pull_on(case, shape::Bspline2),
        "bspline3" => pull_on(case, shape::Bspline3),
        _ => pull_on(case, shape::Linear),
    }
}

/// One quasi-static step; the load against the elongation between sections 0.1 L inside the ends.
fn pull_on<S: Shape<2>>(case: &Parameters, shape: S) -> Result<Pulled, StudyError> {
    if case.choice("solver")? != "quasi-static" {
        let reason = "the elastic study is quasi-static";
        return Err(StudyError::combination(case, &["case", "solver"], reason));
    }
    let bar = Bar::new(case)?;
    let grid = bar.grid()?;
    let way = STRAIN * bar.length;
    let mut scene = bar.scene(&grid, move |_| way)?;
    let before = gauge_sections(&bar, &scene);
    let start = std::time::Instant::now();
    let mut solver = QuasiStatic::new(grid, shape, QuasiStaticSettings::default())
        .map_err(StudyError::failed("setting up"))?;
    solver
        .step(&mut scene, 1.0)
        .map_err(StudyError::failed(format!("running {}", case.label())))?;
    let wall_s = start.elapsed().as_secs_f64();
    let strain = strain_between(&bar, &scene, &before);
    let exact = bar.exact();
    let stiffness = exact.area * exact.modulus;
    let load_error = (load(&scene, &bar.axis()) / (stiffness * strain) - 1.0).abs();
    // The document's own measure (eq. 5.2.44) compares with the elongation of the whole bar.
    let whole = (load(&scene, &bar.axis()) / (stiffness * STRAIN) - 1.0).abs();
    let mut row = SimulationRow::new("tensile-bar", case);
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = wall_s;
    row.errors.insert("gauge_load", load_error);
    row.errors.insert("load", whole);
    row.values.insert("gauge_strain", strain / STRAIN);
    row.state_hash = 0;
    Ok(Pulled {
        h: bar.spacing,
        load_error: whole,
        row,
    })
}

/// Particles within half a cell of the sections 0.1 L inside the ends, with where they start.
fn gauge_sections(bar: &Bar, scene: &Scene<2>) -> [Vec<(usize, Vector2<f64>)>; 2] {
    [0.1, 0.9].map(|section| {
        let Some(body) = scene.body(BODY) else {
            return Vec::new();
        };
        let position = &body.particles().motion.position;
        let near = |x: &Vector2<f64>| {
            (bar.along(x) - section * bar.length).abs() <= 0.5 * bar.spacing * (1.0 + 1e-9)
        };
        let ids = body.particles().id.iter().zip(position);
        ids.filter(|(_, x)| near(x))
            .map(|(id, x)| (id.0 as usize, *x))
            .collect()
    })
}

/// Mean strain between the gauge sections.
fn strain_between(bar: &Bar, scene: &Scene<2>, before: &[Vec<(usize, Vector2<f64>)>; 2]) -> f64 {
    let Some(body) = scene.body(BODY) else {
        return f64::NAN;
    };
    let mut by_id = vec![Vector2::zeros(); body.particles().len()];
    for (id, x) in body
        .particles()
        .id
        .iter()
        .zip(&body.particles().motion.position)
    {
        by_id[id.0 as usize] = *x;
    }
    let mean = |section: &[(usize, Vector2<f64>)]| {
        let along = |f: fn(&(Vector2<f64>, Vector2<f64>)) -> Vector2<f64>| {
            let values = section.iter().map(|(id, x)| f(&(*x, by_id[*id])));
            values.sum::<Vector2<f64>>() / section.len() as f64
        };
        let start = bar.along(&along(|(x, _)| *x));
        let way = along(|(x, now)| now - x).dot(&bar.axis());
        (start, way)
    };
    let (start, start_way) = mean(&before[0]);
    let (end, end_way) = mean(&before[1]);
    (end_way - start_way) / (end - start)
}
