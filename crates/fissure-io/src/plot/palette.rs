//! Colours that colour-blind readers can tell apart.

use kuva::prelude::ColorMap;
use kuva::render::color::Color;

/// Okabe and Ito's colours, the dark ones first; yellow is left out, as it vanishes on white.
const SERIES: [&str; 7] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000",
];

/// The colour of the series of this number.
pub(super) fn series(index: usize) -> &'static str {
    SERIES[index % SERIES.len()]
}

/// Where a value is not a number.
pub(super) const MISSING: Color = Color::Rgb(190, 190, 190);

/// Which colours a field runs through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColourMap {
    /// Dark blue over green to yellow, even in brightness: damage, energy, size of a velocity.
    #[default]
    Viridis,
    /// Blue over white to red, for fields with a sign; set a range that is symmetric about zero.
    BlueRed,
    /// Light grey to black, for print: a crack in intact material.
    Greys,
}

impl ColourMap {
    /// The colour at a fraction between zero and one; others are taken to the nearer end.
    pub(super) fn at(self, fraction: f64) -> Color {
        let (map, place) = match self {
            Self::Viridis => (ColorMap::Viridis, fraction),
            Self::BlueRed => (ColorMap::RedBlue, 1.0 - fraction),
            // Not from white: intact material has to stand out from the paper.
            Self::Greys => (ColorMap::Grayscale, 0.85 - 0.85 * fraction),
        };
        map.map_rgb(place.clamp(0.0, 1.0))
            .map_or(MISSING, |(red, green, blue)| Color::Rgb(red, green, blue))
    }
}
