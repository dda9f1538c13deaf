//! Growth by energy release: `J ≥ G_c`, straight on or where the hoop stress is largest.

use fissure_scene::{CrackLine, End, Growth, GrowthCriterion, GrowthError, Scene};
use nalgebra::Vector2;

use super::{Annulus, Intensity, PlaneElastic, Rates, TipField, TipFrame, interaction, j_integral};
use crate::MeasureError;
use crate::error::check_positive;

/// The angle from the tip's direction, to its left, at which the hoop stress is largest [Erdogan and
/// Sih 1963]:
///
/// ```text
/// K_I sin θ + K_II (3 cos θ − 1) = 0,   θ = 2 atan( −2 K_II / (K_I + √(K_I² + 8 K_II²)) )        (4)
/// ```
///
/// 70.5° away from the sliding face in pure mode II; 0 if there is no intensity.
///
/// ```
/// use fissure_diagnostics::fracture::{Intensity, hoop_angle};
/// let theta = hoop_angle(&Intensity { k1: 0.0, k2: 1.0 });
/// assert!((theta.to_degrees() + 70.528_779).abs() < 1e-6);
/// ```
pub fn hoop_angle(k: &Intensity) -> f64 {
    if k.k2 == 0.0 {
        return 0.0;
    }
    let root = k.k1 + (k.k1 * k.k1 + 8.0 * k.k2 * k.k2).sqrt();
    2.0 * (-2.0 * k.k2 / root).atan()
}

/// Where a crack goes when it goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GrowthDirection {
    /// Straight on.
    SelfSimilar,
    /// Where the hoop stress is largest, [`hoop_angle`].
    #[default]
    MaximumHoop,
}

/// Least share of the domain that is taken where there is no room for it.
const LEAST: f64 = 0.25;

/// Distance of a tip to the nearest other crack, m.
fn room(scene: &Scene<2>, crack: usize, tip: &TipFrame) -> f64 {
    let lines = scene.cracks().iter().enumerate();
    let others = lines.filter(|(other, _)| *other != crack);
    others
        .map(|(_, other)| other.line().foot(&tip.position).distance)
        .fold(f64::INFINITY, f64::min)
}

/// Lets a tip grow by a fixed length when the energy release rate reaches the toughness.
///
/// J is taken over a domain around the tip ([`j_integral`]). If another crack is nearer than its
/// outer radius the domain shrinks with the distance, and if the body does not fill it, it is
/// halved, both down to a quarter. A tip as near as that to a surface or to another crack goes straight
/// on if it grew when it was last asked: what is left between them is released at a rate that only
/// rises. Else it stays where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyReleaseGrowth {
    /// Name of the body that cracks.
    pub body: String,
    /// Its elastic constants.
    pub elastic: PlaneElastic,
    /// Toughness G_c, J/m².
    pub toughness: f64,
    /// Domain of the integrals, m.
    pub domain: Annulus,
    /// How far a tip goes at a time, m.
    pub increment: f64,
    /// Where it goes.
    pub direction: GrowthDirection,
    /// Inertia in J: rates of change come from two consecutive questions at different times
    /// ([`Rates`]), so a tip is first judged at the second.
    pub inertia: bool,
    /// What was seen when it was last asked.
    pub rates: Rates,
    /// The tips that grew then.
    pub running: Vec<(usize, End)>,
}

impl EnergyReleaseGrowth {
    /// A criterion without inertia.
    ///
    /// # Errors
    /// [`MeasureError::Parameter`] for constants, a toughness, radii or an increment outside their
    /// ranges.
    pub fn new(
        body: &str,
        elastic: PlaneElastic,
        toughness: f64,
        domain: Annulus,
        increment: f64,
        direction: GrowthDirection,
    ) -> Result<Self, MeasureError> {
        elastic.check()?;
        domain.check()?;
        check_positive("toughness", toughness)?;
        check_positive("increment of a crack", increment)?;
        Ok(Self {
            body: body.to_owned(),
            elastic,
            toughness,
            domain,
            increment,
            direction,
            inertia: false,
            rates: Rates::default(),
            running: Vec::new(),
        })
    }

    /// The same with inertia.
    #[must_use]
    pub fn with_inertia(mut self) -> Self {
        self.inertia = true;
        self
    }

    /// The tip with the mean direction of the crack over the domain's middle radius. The direction of
    /// a last piece that is shorter than that would be answered by the next one turning back.
    fn frame(&self, crack: &CrackLine, end: End) -> TipFrame {
        let middle = 0.5 * (self.domain.inner + self.domain.outer);
        TipFrame::over(crack, end, middle)
    }

    /// Energy release rate (J/m²) and intensities of a tip over the largest domain that fits;
    /// `None` at a surface.
    ///
    /// # Errors
    /// What [`TipField::of`], [`j_integral`] or [`interaction`] refuse, but for a domain that the body
    /// does not fill.
    pub fn measure(
        &self,
        scene: &Scene<2>,
        crack: usize,
        end: End,
    ) -> Result<Option<(f64, Intensity)>, MeasureError> {
        let growing = scene.cracks().get(crack);
        let growing = growing.ok_or(MeasureError::Parameter {
            parameter: "number of the crack",
            value: crack as f64,
            permitted: "below the number of cracks in the scene",
        })?;
        let tip = self.frame(growing, end);
        let room = room(scene, crack, &tip);
        let rates = self.inertia.then_some(&self.rates);
        let radius = self.domain.outer;
        let (body, elastic) = (&self.body, &self.elastic);
        let field = TipField::of(scene, body, &tip.position, radius, elastic, rates)?;
        let mut share = (room / radius).min(1.0);
        while share >= LEAST {
            let domain = Annulus {
                inner: share * self.domain.inner,
                outer: share * radius,
            };
            match j_integral(&field, &tip, &domain) {
                Ok(j) => {
                    let k = interaction(&field, &tip, &domain, elastic)?;
                    return Ok(Some((j, k)));
                }
                Err(MeasureError::Coverage { .. }) => share *= 0.5,
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }
}

impl GrowthCriterion for EnergyReleaseGrowth {
    fn growth(
        &mut self,
        scene: &Scene<2>,
        crack: usize,
        end: End,
    ) -> Result<Option<Growth>, GrowthError> {
        let undecided = |source| {
            let named = scene.cracks().get(crack);
            GrowthError::Criterion {
                crack: named.map_or_else(String::new, |crack| crack.name().to_owned()),
                source: Box::new(source),
            }
        };
        if self.inertia {
            self.rates.look(scene, &self.body).map_err(undecided)?;
            if !self.rates.are_known() {
                return Ok(None);
            }
        }
        let ran = self.running.iter().position(|tip| *tip == (crack, end));
        let ran = ran.map(|place| self.running.swap_remove(place)).is_some();
        let measured = self.measure(scene, crack, end).map_err(undecided)?;
        let tip = self.frame(&scene.cracks()[crack], end);
        let angle = match (measured, self.direction) {
            (Some((j, _)), _) if !(j >= self.toughness) => return Ok(None),
            (Some((_, k)), GrowthDirection::MaximumHoop) => hoop_angle(&k),
            (Some(_), GrowthDirection::SelfSimilar) => 0.0,
            (None, _) if ran => 0.0,
            (None, _) => return Ok(None),
        };
        self.running.push((crack, end));
        let (sine, cosine) = angle.sin_cos();
        Ok(Some(Growth {
            direction: tip.axes() * Vector2::new(cosine, sine),
            length: self.increment,
        }))
    }
}
