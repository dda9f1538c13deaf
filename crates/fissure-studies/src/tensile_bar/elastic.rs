//! The elastic bar: convergence with the grid spacing [Sanchez 2010, sec. 5.3, Table 5.2].

use fissure::diagnostics::fit_slope;
use fissure::prelude::*;
use fissure_study::{Parameters, Report as Rows, Row, SimulationRow, StudyError};

use super::NAME;
use crate::bar::{BODY, Bar, load};
use crate::method::{Method, on_threads};

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
        let pulled = on_threads(case, || pull(case))?;
        let h = pulled.row.h;
        for (measure, error) in [("gauge_load", pulled.gauge_load), ("load", pulled.load)] {
            let named = |s: &&mut Series| s.fits(case, measure);
            match series.iter_mut().find(named) {
                Some(series) => series.points.push((h, error)),
                None => series.push(Series {
                    angle: case.number("angle")?,
                    fill: case.choice("fill")?.to_owned(),
                    shape: pulled.row.shape.clone(),
                    case: (*case).clone(),
                    measure,
                    points: vec![(h, error)],
                }),
            }
        }
        rows.row(pulled.row)?;
    }
    for series in series.iter().filter(|series| series.points.len() > 1) {
        rows.row(series.row())?;
    }
    Ok(())
}

/// Errors of one angle, filling and shape over the spacing.
struct Series {
    angle: f64,
    fill: String,
    shape: String,
    case: Parameters,
    measure: &'static str,
    points: Vec<(f64, f64)>,
}

impl Series {
    /// Whether a run differs from this series in the spacing at most.
    fn fits(&self, case: &Parameters, measure: &str) -> bool {
        let rest = |parameters: &Parameters| -> Vec<String> {
            let others = parameters.iter().filter(|(name, _)| *name != "h");
            others
                .map(|(name, value)| format!("{name}={value}"))
                .collect()
        };
        measure == self.measure && rest(case) == rest(&self.case)
    }

    fn row(&self) -> Row {
        let (h, errors): (Vec<f64>, Vec<f64>) = self.points.iter().copied().unzip();
        let order = fit_slope(&h, &errors).map_or(f64::NAN, |law| law.exponent);
        // "a least squares fit to the log E_p vs. h⁻¹ data": decades of error per 100/m.
        let inverse_h: Vec<f64> = h.iter().map(|h| 0.01 / h).collect();
        let decades: Vec<f64> = errors.iter().map(|error| error.log10()).collect();
        let document = TABLE_5_2.iter().find(|(angle, _)| *angle == self.angle);
        Row::other(NAME)
            .field("case", "elastic slopes")
            .field("angle", self.angle)
            .field("fill", self.fill.as_str())
            .field("shape", self.shape.as_str())
            .field("measure", self.measure)
            .field("slope", order)
            .field("decades_per_100_inverse_m", slope(&inverse_h, &decades))
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
    /// Error of the load against the elongation between the gauge sections.
    gauge_load: f64,
    /// Error of the load against the elongation of the whole bar (eq. 5.2.44).
    load: f64,
}

/// One quasi-static step; the load against the elongation between sections 0.1 L inside the ends.
fn pull(case: &Parameters) -> Result<Pulled, StudyError> {
    let mut method = Method::of(case)?;
    method.steps = 1;
    if method.is_dynamic() {
        let reason = "the elastic study is quasi-static";
        return Err(StudyError::combination(case, &["case", "solver"], reason));
    }
    let bar = Bar::new(case)?;
    let grid = bar.grid()?;
    let way = STRAIN * bar.length;
    let mut scene = bar.scene(&grid, move |_| way)?;
    let before = gauge_sections(&bar, &scene);
    let start = std::time::Instant::now();
    let mut solver = method.build(grid, BandSource::default(), 1.0)?;
    solver
        .step(&mut scene, 1.0)
        .map_err(StudyError::failed(format!("running {}", case.label())))?;
    let wall_s = start.elapsed().as_secs_f64();
    let strain = strain_between(&bar, &scene, &before);
    let exact = bar.exact();
    let stiffness = exact.area * exact.modulus;
    let gauge_load = (load(&scene, &bar.axis()) / (stiffness * strain) - 1.0).abs();
    // The document's own measure (eq. 5.2.44) compares with the elongation of the whole bar.
    let whole = (load(&scene, &bar.axis()) / (stiffness * STRAIN) - 1.0).abs();
    let mut row = SimulationRow::new(NAME, case);
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = wall_s;
    row.errors.insert("gauge_load", gauge_load);
    row.errors.insert("load", whole);
    row.values.insert("gauge_strain", strain / STRAIN);
    row.state_hash = fissure::diagnostics::state_hash(&scene);
    Ok(Pulled {
        row,
        gauge_load,
        load: whole,
    })
}

/// Particles near a section, by id, with where they start.
type Section = Vec<(usize, Vector2<f64>)>;

/// Particles within half a cell of the sections 0.1 L inside the ends.
fn gauge_sections(bar: &Bar, scene: &Scene<2>) -> [Section; 2] {
    [0.1, 0.9].map(|section| {
        let Some(body) = scene.body(BODY) else {
            return Vec::new();
        };
        let near = |x: &Vector2<f64>| {
            (bar.along(x) - section * bar.length).abs() <= 0.5 * bar.spacing * (1.0 + 1e-9)
        };
        let ids = body.particles().id.iter().zip(body.motion().position);
        ids.filter(|(_, x)| near(x))
            .map(|(id, x)| (id.0 as usize, *x))
            .collect()
    })
}

/// Mean strain between the gauge sections; NaN if a section is empty.
fn strain_between(bar: &Bar, scene: &Scene<2>, sections: &[Section; 2]) -> f64 {
    let Some(body) = scene.body(BODY) else {
        return f64::NAN;
    };
    let mut now = vec![Vector2::zeros(); body.particles().len()];
    for (id, x) in body.particles().id.iter().zip(body.motion().position) {
        now[id.0 as usize] = *x;
    }
    // Mean place along the bar at first, and mean way from there.
    let [left, right] = sections.each_ref().map(|section| {
        let count = section.len() as f64;
        let place: f64 = section.iter().map(|(_, x)| bar.along(x)).sum();
        let ways = section.iter().map(|(id, x)| now[*id] - x);
        let way: f64 = ways.map(|way| way.dot(&bar.axis())).sum();
        (place / count, way / count)
    });
    (right.1 - left.1) / (right.0 - left.0)
}
