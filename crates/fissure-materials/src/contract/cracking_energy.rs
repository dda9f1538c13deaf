//! P8 fracture energy, and the part of P24 that bands and cracking parameters make up.

use fissure_tensor::Band;

use super::{gauge::Gauge, runner::Property};
use crate::{Cracking, Scale};

/// In pure opening, for bands up to 0.99 of the limit, in 1 to 1000 steps and with cycles: the
/// energy dissipated per volume times the crack's band is its dissipated fraction of the
/// toughness at every step, and all of it once the opening is beyond the critical one; the band
/// is that of the crack's normal. Bound: `1e-10` of the toughness over `1 − band/limit`; with the
/// work of P6 the same holds for what is done on the point.
pub(super) fn fracture_energy<M: Cracking>() -> Property<M> {
    Property {
        name: "P8 fracture energy",
        hint: "Cracking::toughness, the softening curve (unit area) and the band disagree",
        share: 0.5,
        draw: |subject, random| subject.draw_opening(random),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let (law, scale) = (subject.law, Scale::default());
            let responses = subject.drive(&case.gradients(), &case.band, &scale)?;
            let toughness = law.toughness(&scale);
            let critical = law.critical_opening(&scale);
            let mut dissipated = 0.0;
            for response in &responses {
                dissipated += response.dissipated;
                let cracks = law.cracks(&response.state);
                let [crack] = cracks.as_slice() else {
                    continue;
                };
                let width = case.band.width(&crack.normal);
                let wrong_width = (crack.width - width).abs();
                gauge.check(
                    wrong_width,
                    1e-9 * width,
                    "the crack's width is not its band's, m",
                );
                let bound = 1e-10 * toughness / subject.reserve(crack.width);
                let energy = dissipated * crack.width;
                gauge.check(
                    (energy - crack.dissipated_fraction * toughness).abs(),
                    bound,
                    "energy per crack area is not the stated fraction of the toughness, J/m²",
                );
                if crack.opening > critical * (1.0 + 1e-9) {
                    gauge.require(
                        crack.failed,
                        "a crack is wider than critical and not failed",
                    );
                }
                gauge.softened = true;
                if crack.failed {
                    gauge.failed = true;
                    gauge.check(
                        (energy - toughness).abs(),
                        bound,
                        "energy per crack area to failure is not the toughness, J/m²",
                    );
                }
            }
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// Strength, toughness, critical opening and band limit are positive at any scale; a band of 0.99
/// of the limit is accepted; 1.01 of it, zero, negative, infinite and NaN are refused, and so is a
/// toughness that its scale makes infinite or NaN.
pub(super) fn band_validation<M: Cracking>() -> Property<M> {
    Property {
        name: "P24 band validation",
        hint: "Material::check_band and Cracking::band_limit disagree, or NaN passes",
        share: 0.25,
        draw: |subject, random| subject.draw_path(random, false),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let law = subject.law;
            // Scales between 1 and 1 + π: the case's own vector serves as the source.
            let [stiffness, strength, toughness] =
                [case.turn.x, case.turn.y, case.turn.z].map(|x| 1.0 + x.abs());
            let scale = Scale {
                stiffness,
                strength,
                toughness,
            };
            let positive = law.strength(&scale) > 0.0
                && law.toughness(&scale) > 0.0
                && law.critical_opening(&scale) > 0.0
                && law.band_limit(&scale) > 0.0;
            gauge.require(
                positive,
                "strength, toughness, critical opening or band limit is not > 0",
            );
            let limit = law.band_limit(&scale);
            let accepts = |width: f64| law.check_band(&Band::Uniform(width), &scale).is_ok();
            if limit.is_finite() {
                gauge.require(accepts(0.99 * limit), "a band under the limit is refused");
                gauge.require(!accepts(1.01 * limit), "a band over the limit is accepted");
            }
            for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                let refused = !accepts(width);
                gauge.require(refused, "a zero, negative or not finite band is accepted");
            }
            for toughness in [f64::INFINITY, f64::NAN] {
                let scale = Scale { toughness, ..scale };
                let refused = law.check_band(&case.band, &scale).is_err();
                gauge.require(refused, "a toughness scaled to no number is accepted");
            }
            Ok(gauge)
        },
        must_apply: true,
    }
}
