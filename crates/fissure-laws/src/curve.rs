//! A softening curve chosen by name. A law with a curve known when it is compiled is faster; here one
//! law of any curve is compiled instead of one for each.

use fissure_materials::{MaterialError, Softening, softening};

use crate::parameter::Values;

/// Any curve of the library but the linear one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Curve {
    Bilinear(softening::Bilinear),
    PowerLaw(softening::PowerLaw),
    Exponential(softening::Exponential),
    CubicStep(softening::CubicStep),
    DoubleExponential(softening::DoubleExponential),
}

impl Curve {
    pub fn bilinear(values: &Values<'_>) -> Self {
        Self::Bilinear(softening::Bilinear {
            kink_opening: values.number("kink_opening"),
            kink_ratio: values.number("kink_ratio"),
        })
    }

    pub fn power_law(values: &Values<'_>) -> Self {
        let exponent = values.number("exponent");
        Self::PowerLaw(softening::PowerLaw { exponent })
    }

    pub fn double_exponential(values: &Values<'_>) -> Self {
        Self::DoubleExponential(softening::DoubleExponential {
            decay_ratio: values.number("decay_ratio"),
            weight: values.number("weight"),
        })
    }

    /// That of the choice `curve`; `None` for the linear one.
    pub fn chosen(values: &Values<'_>) -> Option<Self> {
        match values.choice("curve") {
            "bilinear" => Some(Self::bilinear(values)),
            "power-law" => Some(Self::power_law(values)),
            "exponential" => Some(Self::Exponential(softening::Exponential)),
            "cubic-step" => Some(Self::CubicStep(softening::CubicStep)),
            "double-exponential" => Some(Self::double_exponential(values)),
            _ => None,
        }
    }
}

macro_rules! of_the_curve {
    ($self:ident, $curve:ident => $value:expr) => {
        match $self {
            Self::Bilinear($curve) => $value,
            Self::PowerLaw($curve) => $value,
            Self::Exponential($curve) => $value,
            Self::CubicStep($curve) => $value,
            Self::DoubleExponential($curve) => $value,
        }
    };
}

impl Softening for Curve {
    fn ratio(&self, s: f64) -> f64 {
        of_the_curve!(self, curve => curve.ratio(s))
    }
    fn slope(&self, s: f64) -> f64 {
        of_the_curve!(self, curve => curve.slope(s))
    }
    fn area(&self, s: f64) -> f64 {
        of_the_curve!(self, curve => curve.area(s))
    }
    fn critical(&self) -> f64 {
        of_the_curve!(self, curve => curve.critical())
    }
    fn steepest(&self) -> f64 {
        of_the_curve!(self, curve => curve.steepest())
    }
    fn check(&self) -> Result<(), MaterialError> {
        of_the_curve!(self, curve => curve.check())
    }
    fn stability(&self) -> f64 {
        of_the_curve!(self, curve => curve.stability())
    }
    fn dissipated_to_origin(&self, s: f64) -> f64 {
        of_the_curve!(self, curve => curve.dissipated_to_origin(s))
    }
}
