//! Pulling the notched plate: a row per case.

use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use super::growth::Growth;
use super::pictures::Pictures;
use crate::nairn::conjugate::StressMeasure;
use crate::nairn::drive::{drive, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::many;
use crate::nairn::numerics::{Numerics, check_whole_cells, seeding};
use crate::nairn::pictures::Snapshot;

const BODY: &str = "plate";
/// Thickness of the plane, m.
const THICKNESS: f64 = 1e-3;
/// When the stress is drawn, s (fig. 6).
const DRAWN: f64 = 77e-6;
/// Onset of the independent code with 30 MPa and 600 J/m² on 1 mm cells, s, and its speed, m/s.
const REFERENCE: (f64, f64) = (54.5566e-6, 571.0);
/// Onset that the document's explicit crack has, s.
const DOCUMENT: f64 = 54e-6;
/// Factors that leave nothing to fail, and keep the limit of the band.
const SEVERED: Scale = Scale {
    stiffness: 1.0,
    strength: 1e-3,
    toughness: 1e-6,
};

pub(super) struct Finished {
    pub row: SimulationRow,
    pub growth: Growth,
    pub snapshot: Option<Snapshot>,
    pub stopped: Option<String>,
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut pictures = Pictures::new(rows.out_dir());
    for case in cases {
        check_whole_cells(case, &["width", "height", "crack"])?;
    }
    let drawing = rows.out_dir().is_some();
    many::in_order(
        cases,
        rows,
        |case| pull(case, drawing),
        |rows, case, finished| {
            rows.row(finished.row.clone())?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            pictures.add(case, &finished)
        },
    )?;
    pictures.finish()
}

fn pull(case: &Parameters, drawing: bool) -> Result<Finished, StudyError> {
    let numerics = Numerics::of(case)?;
    let plate = Plate::new(case)?;
    let end = case.number("end")?;
    let mut scene = plate.scene(case)?;
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let places = scene
        .body(BODY)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the plate")("no such body"))?;
    let (mut growth, mut snapshot) = (Growth::default(), None);
    let through = plate.width - 2.0 * plate.spacing;
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        let Some(body) = scene.body(BODY) else {
            return false;
        };
        let failed = body.value("failed").unwrap_or_default();
        let pairs = body.particles().id.iter().zip(failed);
        let ahead = pairs
            .filter(|(_, failed)| *failed > 0.5)
            .filter_map(|(id, _)| places.at(*id))
            .filter(|x| plate.is_ahead(x))
            .map(|x| x[0]);
        let tip = ahead.fold(f64::NAN, f64::max);
        if tip.is_finite() {
            growth.push(report.time, tip);
        }
        if drawing && snapshot.is_none() && report.time >= DRAWN {
            let title = format!("Axial stress at {:.0} µs", 1e6 * report.time);
            snapshot = Some(Snapshot::of_stress(title, scene, 1));
        }
        !(tip > through)
    })?;
    let mut row = row("edge-notch", case, &scene, &done);
    row.threads = 1;
    let failed = scene.body(BODY).map_or(0, |body| {
        let failed = places.failed(body);
        failed.iter().filter(|x| plate.is_ahead(x)).count()
    });
    let length = growth.tip.last().copied().unwrap_or(plate.crack);
    let (from, to) = plate.measured();
    let (onset, speed) = (growth.onset(), growth.speed(from, to));
    let growth_area = (length - plate.crack) * THICKNESS;
    row.errors = Measures::new();
    if plate.is_documents() {
        row.errors.insert("onset", (onset / DOCUMENT - 1.0).abs());
        if plate.strength == 30e6 && plate.toughness == 600.0 && plate.spacing == 1e-3 {
            row.errors
                .insert("onset_reference", (onset / REFERENCE.0 - 1.0).abs());
            row.errors
                .insert("speed_reference", (speed / REFERENCE.1 - 1.0).abs());
        }
    }
    row.values = Measures::new()
        .with("onset_us", 1e6 * onset)
        .with("speed_m_s", speed)
        .with("length_mm", 1e3 * length)
        .with(
            "failed_rows",
            failed as f64 / ((length - plate.crack) / (0.5 * plate.spacing)),
        )
        .with(
            "dissipated_per_area",
            scene.energy().dissipated / growth_area,
        );
    row.values = energies(row.values, &scene);
    Ok(Finished {
        row,
        growth,
        snapshot,
        stopped: done.stopped,
    })
}

/// The plate that one set of parameters describes.
struct Plate {
    width: f64,
    height: f64,
    crack: f64,
    speed: f64,
    spacing: f64,
    strength: f64,
    toughness: f64,
    young: f64,
    severed: bool,
}

impl Plate {
    fn new(case: &Parameters) -> Result<Self, StudyError> {
        let plate = Self {
            width: case.number("width")?,
            height: case.number("height")?,
            crack: case.number("crack")?,
            speed: case.number("speed")?,
            spacing: case.number("h")?,
            strength: case.number("strength")?,
            toughness: case.number("toughness")?,
            young: case.number("young")?,
            severed: case.choice("notch")? == "severed",
        };
        if !(plate.crack < plate.width) {
            return Err(StudyError::combination(
                case,
                &["crack", "width"],
                "the notch cuts the plate",
            ));
        }
        Ok(plate)
    }

    /// Whether geometry and loading are those of the document.
    fn is_documents(&self) -> bool {
        (self.width, self.height, self.crack) == (0.05, 0.1, 0.025)
            && self.speed == 3.1623
            && self.young == 2.5e9
    }

    /// The cell row just above the mid-plane, in the length of the notch.
    fn is_notch(&self, x: &Vector2<f64>) -> bool {
        x[0] < self.crack && x[1] > 0.0 && x[1] < self.spacing
    }

    /// Within the ligament: ahead of the notch, away from grips.
    fn is_ahead(&self, x: &Vector2<f64>) -> bool {
        x[0] > self.crack && x[1].abs() < 0.4 * self.height
    }

    /// The tips between which the speed is measured, m: 30 to 45 mm of 25 to 50 mm.
    fn measured(&self) -> (f64, f64) {
        let ligament = self.width - self.crack;
        (self.crack + 0.2 * ligament, self.crack + 0.8 * ligament)
    }

    fn grid(&self, end: f64) -> Result<Grid<2>, StudyError> {
        let margin = 6.0 * self.spacing;
        let reach = 0.5 * self.height + margin + self.speed * end;
        let reach = (reach / self.spacing).ceil() * self.spacing;
        Grid::over(
            [-margin, -reach],
            [self.width + margin, reach],
            self.spacing,
        )
        .map_err(StudyError::failed("making the grid"))
    }

    fn scene(&self, case: &Parameters) -> Result<Scene<2>, StudyError> {
        let failed = || StudyError::failed("building the plate");
        let elastic = Isotropic {
            density: case.number("density")?,
            young: self.young,
            poisson: case.number("poisson")?,
        };
        let opening = Mode {
            strength: self.strength,
            toughness: self.toughness,
            softening: softening::Linear,
        };
        // Pure mode I: shear plays no part.
        let shear = Mode {
            strength: 1e3 * self.strength,
            toughness: 1e6 * self.toughness,
            softening: softening::Linear,
        };
        let mut law = AnisotropicDamage::new(elastic, opening, shear);
        law.onset = Onset::InPlane;
        let half = 0.5 * self.height;
        let seeding = seeding(self.spacing);
        let block = Block::new([0.0, -half], [self.width, half]);
        let mut scene = Scene::plane(Plane::Strain {
            thickness: THICKNESS,
        });
        let measure = StressMeasure::of(case)?;
        if self.severed {
            measure.fill(&mut scene, BODY, law, &block, &seeding)?;
            scene
                .set_scale(BODY, |x| self.is_notch(x), SEVERED)
                .map_err(failed())?;
        } else {
            let plate = Where::new([0.0, -half], [self.width, half], |x| !self.is_notch(x));
            measure.fill(&mut scene, BODY, law, &plate, &seeding)?;
        }
        let (grip, speed) = (2.0 * self.spacing, self.speed);
        let hold = Hold::Component(Vector2::y());
        scene
            .rigid(
                "bottom",
                &Block::new([0.0, -half - grip], [self.width, -half]),
                &seeding,
                hold,
                Velocity(move |_| -speed),
            )
            .map_err(failed())?
            .rigid(
                "top",
                &Block::new([0.0, half], [self.width, half + grip]),
                &seeding,
                hold,
                Velocity(move |_| speed),
            )
            .map_err(failed())?;
        Ok(scene)
    }
}
