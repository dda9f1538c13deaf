//! Pulling the coated specimen: a row per run, and one for the mean of runs that differ by their seed.

use fissure::prelude::*;
use fissure_study::{
    Field, Fields, Measures, Parameters, Report as Rows, Row, SimulationRow, StudyError,
};

use super::count::{Count, against, mean};
use super::pictures::Pictures;
use crate::nairn::conjugate::StressMeasure;
use crate::nairn::drive::{drive, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::many;
use crate::nairn::numerics::{Numerics, check_whole_cells, seeding};
use crate::nairn::pictures::Snapshot;
use crate::nairn::reference::Curve;

const COATING: &str = "coating";
/// Thickness of the plane, m.
const THICKNESS: f64 = 1e-3;
/// Strains whose counts stand in the row.
const SHOWN: [f64; 5] = [0.005, 0.01, 0.015, 0.02, 0.025];
/// Strains at which a run is drawn.
const DRAWN: [f64; 3] = [0.006, 0.012, 0.024];

/// A finished run.
pub(super) struct Finished {
    pub row: SimulationRow,
    pub count: Count,
    pub snapshots: Vec<Snapshot>,
    pub stopped: Option<String>,
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let reference = reference()?;
    let mut pictures = Pictures::new(rows.out_dir(), &reference);
    let mut groups: Vec<(Parameters, Vec<Vec<[f64; 2]>>)> = Vec::new();
    for case in cases {
        check_whole_cells(case, &["h", "length", "substrate", "coating"])?;
    }
    let drawing = rows.out_dir().is_some();
    many::in_order(
        cases,
        rows,
        |case| pull(case, drawing),
        |rows, case, mut finished| {
            let compared = is_documents(case)?;
            if compared {
                let end = case.number("strain")?.min(0.025);
                let error = against(&reference, &finished.count.cracks, end);
                finished.row.errors.insert("count", error);
            }
            rows.row(with_cracks(finished.row.clone(), &finished.count.cracks))?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            pictures.add(case, &finished)?;
            match groups
                .iter_mut()
                .find(|(other, _)| same_but_seed(other, case))
            {
                Some((_, curves)) => curves.push(finished.count.cracks),
                None => groups.push((case.clone(), vec![finished.count.cracks])),
            }
            Ok(())
        },
    )?;
    for (case, curves) in groups.iter().filter(|(_, curves)| curves.len() > 1) {
        rows.row(mean_row(case, curves, &reference)?)?;
    }
    pictures.finish()
}

/// The curve of the independent code.
fn reference() -> Result<Vec<[f64; 2]>, StudyError> {
    let text = include_str!("../../../tests/data/nairn/coating.csv");
    let curve = Curve::read(text, "coating", "strain", "cracks")?;
    Ok(curve
        .x
        .into_iter()
        .zip(curve.y)
        .map(|(x, y)| [x, y])
        .collect())
}

/// Whether a case is the specimen of the document, so that its counts can be compared.
fn is_documents(case: &Parameters) -> Result<bool, StudyError> {
    for (name, value) in [
        ("length", 0.2),
        ("substrate", 0.01),
        ("coating", 2e-3),
        ("substrate_young", 1e9),
        ("coating_young", 1e10),
        ("poisson", 0.33),
        ("density", 1000.0),
        ("strength", 1e7),
        ("toughness", 100.0),
        ("speed", 4.0),
    ] {
        if case.number(name)? != value {
            return Ok(false);
        }
    }
    Ok(true)
}

fn same_but_seed(one: &Parameters, other: &Parameters) -> bool {
    one.iter()
        .filter(|(name, _)| *name != "seed")
        .all(|(name, value)| other.get(name) == Some(value))
}

fn with_cracks(row: SimulationRow, cracks: &[[f64; 2]]) -> Row {
    let row = Row::from(row);
    let mut values = match row.fields().get("values") {
        Some(Field::Group(values)) => values.clone(),
        _ => Fields::new(),
    };
    values.insert("cracks", cracks.to_vec());
    row.field("values", values)
}

/// The mean over runs that differ by their seed.
fn mean_row(
    case: &Parameters,
    curves: &[Vec<[f64; 2]>],
    reference: &[[f64; 2]],
) -> Result<Row, StudyError> {
    let slices: Vec<&[[f64; 2]]> = curves.iter().map(Vec::as_slice).collect();
    let cracks = mean(&slices);
    let mut row = SimulationRow::new("coating", case);
    row.case = format!("mean of {} runs", curves.len());
    row.solver = "explicit".to_owned();
    if is_documents(case)? {
        let end = case.number("strain")?.min(0.025);
        row.errors.insert("count", against(reference, &cracks, end));
    }
    let onsets = curves.iter().filter_map(|curve| curve.first());
    let onset = onsets.map(|first| first[0]).sum::<f64>() / curves.len() as f64;
    row.values.insert("onset_strain", onset);
    counts(
        &mut row.values,
        |strain| super::count::at(&cracks, strain),
        case,
    )?;
    Ok(with_cracks(row, &cracks))
}

fn counts(
    values: &mut Measures,
    count: impl Fn(f64) -> f64,
    case: &Parameters,
) -> Result<(), StudyError> {
    let end = case.number("strain")?;
    for strain in SHOWN.into_iter().filter(|strain| *strain <= end) {
        values.insert(format!("cracks_{:.1}%", 100.0 * strain), count(strain));
    }
    Ok(())
}

fn pull(case: &Parameters, drawing: bool) -> Result<Finished, StudyError> {
    let numerics = Numerics::of(case)?;
    let (length, speed) = (case.number("length")?, case.number("speed")?);
    let end = case.number("strain")? * length / speed;
    let grid = grid(case, &numerics, length + speed * end)?;
    let mut scene = scene(case, &numerics)?;
    let mut solver = numerics.solver(grid)?;
    let places = scene
        .body(COATING)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the coating")("no such body"))?;
    let near = (length, case.number("ends")?);
    let (mut count, mut snapshots) = (Count::default(), Vec::new());
    let mut onset_energy = f64::NAN;
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        let strain = speed * report.time / length;
        if let Some(body) = scene.body(COATING) {
            count.look(body, &places, strain, near);
        }
        if onset_energy.is_nan() && !count.cracks.is_empty() {
            onset_energy = scene.energy().kinetic;
        }
        let due = DRAWN.get(snapshots.len());
        if drawing && due.is_some_and(|due| strain >= *due) {
            let title = format!("Coating at a nominal strain of {:.1} %", 100.0 * strain);
            snapshots.push(Snapshot::of(title, scene, "normal_damage", None));
        }
        true
    })?;
    let mut row = row("coating", case, &scene, &done);
    row.threads = 1;
    let cracks = count.places.len() as f64;
    row.values = Measures::new().with("onset_strain", count.onset());
    counts(&mut row.values, |strain| count.at(strain), case)?;
    row.values = row
        .values
        .with("failed_per_crack", count.failed() as f64 / cracks)
        .with("end_cracks", count.at_ends as f64)
        .with("spacing_variation", spacing_variation(&count.places))
        .with("kinetic_onset", onset_energy)
        .with("kinetic_end", scene.energy().kinetic)
        .with("reached", scene.time() / end);
    row.values = energies(row.values, &scene);
    Ok(Finished {
        row,
        count,
        snapshots,
        stopped: done.stopped,
    })
}

/// Coefficient of variation of the distances between neighbouring cracks: 0 if they are periodic, 1
/// if they lie anywhere.
fn spacing_variation(places: &[f64]) -> f64 {
    let mut sorted = places.to_vec();
    sorted.sort_by(f64::total_cmp);
    let gaps: Vec<f64> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let number = gaps.len() as f64;
    let mean = gaps.iter().sum::<f64>() / number;
    let variance = gaps.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>() / (number - 1.0);
    variance.sqrt() / mean
}

fn grid(case: &Parameters, numerics: &Numerics, length: f64) -> Result<Grid<2>, StudyError> {
    let margin = 6.0 * numerics.spacing;
    let height = case.number("substrate")? + case.number("coating")?;
    Grid::over(
        [-margin, -margin],
        [length + margin, height + margin],
        numerics.spacing,
    )
    .map_err(StudyError::failed("making the grid"))
}

fn scene(case: &Parameters, numerics: &Numerics) -> Result<Scene<2>, StudyError> {
    let failed = || StudyError::failed("building the specimen");
    let (length, speed) = (case.number("length")?, case.number("speed")?);
    let substrate = case.number("substrate")?;
    let top = substrate + case.number("coating")?;
    let elastic = |young| -> Result<Isotropic, StudyError> {
        Ok(Isotropic {
            density: case.number("density")?,
            young,
            poisson: case.number("poisson")?,
        })
    };
    let (strength, toughness) = (case.number("strength")?, case.number("toughness")?);
    let opening = Mode {
        strength,
        toughness,
        softening: softening::Linear,
    };
    // The shear strength is high, as in the document.
    let shear = Mode {
        strength: 1e3 * strength,
        toughness: 1e6 * toughness,
        softening: softening::Linear,
    };
    let mut law = AnisotropicDamage::new(elastic(case.number("coating_young")?)?, opening, shear);
    law.onset = Onset::InPlane;
    let seeding = seeding(numerics.spacing);
    let grip = 2.0 * numerics.spacing;
    let along = Vector2::x();
    let mut scene = Scene::plane(Plane::Strain {
        thickness: THICKNESS,
    });
    scene
        .fill(
            "substrate",
            elastic(case.number("substrate_young")?)?,
            &Block::new([0.0, 0.0], [length, substrate]),
            &seeding,
        )
        .map_err(failed())?;
    StressMeasure::of(case)?.fill(
        &mut scene,
        COATING,
        law,
        &Block::new([0.0, substrate], [length, top]),
        &seeding,
    )?;
    scene
        .rigid(
            "left",
            &Block::new([-grip, 0.0], [0.0, top]),
            &seeding,
            Hold::Component(along),
            Velocity(|_| 0.0),
        )
        .map_err(failed())?
        .rigid(
            "right",
            &Block::new([length, 0.0], [length + grip, top]),
            &seeding,
            Hold::Component(along),
            Velocity(move |_| speed),
        )
        .map_err(failed())?;
    let jitter = case.number("jitter")?;
    if jitter > 0.0 {
        let noise = WhiteNoise {
            seed: case.count("seed")?,
        };
        let marginal = Marginal::Normal {
            deviation: jitter,
            least: 0.1,
        };
        scene
            .set_scales(COATING, |id, _| Scale {
                strength: marginal.of(noise.at(id)),
                ..Scale::default()
            })
            .map_err(failed())?;
    }
    Ok(scene)
}
