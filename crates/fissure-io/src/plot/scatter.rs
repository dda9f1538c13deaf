//! Particles where they are, coloured by what is known of them: the bar with its crack.

use std::borrow::Cow;
use std::path::Path;

use kuva::prelude::Layout;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::Primitive;

use super::PlotError;
use super::colour_bar::{self, ColourBar};
use super::figure::{self, Format};
use super::palette::{ColourMap, MISSING};
use super::view::{View, finite};

/// Largest figure, px either way; the smaller side follows from the shape of the body.
const LARGEST: f64 = 900.0;
/// Smallest sides, px: below, labels no longer fit.
const SMALLEST: (f64, f64) = (520.0, 260.0);

/// Particles of a plane problem as squares, with equal scales on both axes and a colour bar.
///
/// The figure is 900 px wide, or high for an upright body. Particles with a position that is not finite are left out;
/// those whose value is not a number are grey.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// use fissure_io::plot::ScatterPlot;
///
/// let positions: Vec<[f64; 2]> = (0..80).map(|index| [f64::from(index % 20) * 0.01, f64::from(index / 20) * 0.01]).collect();
/// let damage: Vec<f64> = positions.iter().map(|x| (-((x[0] - 0.1) / 0.01).powi(2)).exp()).collect();
/// ScatterPlot::new("Bar at 4 ms", &positions)
///     .colour("damage [-]", &damage)
///     .range(0.0, 1.0)
///     .save(folder.path().join("bar.svg"))?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct ScatterPlot<'a> {
    title: String,
    points: Cow<'a, [[f64; 2]]>,
    labels: [String; 2],
    field: String,
    values: Cow<'a, [f64]>,
    range: Option<(f64, f64)>,
    colours: ColourMap,
    size: Option<f64>,
}

impl<'a> ScatterPlot<'a> {
    /// Particles at the given positions, m, under a title that may be empty.
    pub fn new(title: &str, points: impl Into<Cow<'a, [[f64; 2]]>>) -> Self {
        Self {
            title: title.to_owned(),
            points: points.into(),
            labels: ["x [m]".to_owned(), "y [m]".to_owned()],
            field: String::new(),
            values: Cow::Borrowed(&[]),
            range: None,
            colours: ColourMap::default(),
            size: None,
        }
    }

    /// Colours the particles by a field and labels its colour bar, with the unit of the values: `"damage [-]"`.
    #[must_use]
    pub fn colour(mut self, label: &str, values: impl Into<Cow<'a, [f64]>>) -> Self {
        self.field = label.to_owned();
        self.values = values.into();
        self
    }

    /// Fixes the ends of the colours, in the unit of the values, so that frames compare; values beyond get the end's
    /// colour. Left to itself the range is that of the values.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Other colours than viridis.
    #[must_use]
    pub fn colour_map(mut self, colours: ColourMap) -> Self {
        self.colours = colours;
        self
    }

    /// Side of a particle, m. Left to itself it is guessed from the area the particles span.
    #[must_use]
    pub fn particle_size(mut self, side: f64) -> Self {
        self.size = Some(side);
        self
    }

    /// Other labels than `"x [m]"` and `"y [m]"`.
    #[must_use]
    pub fn labels(mut self, x: &str, y: &str) -> Self {
        self.labels = [x.to_owned(), y.to_owned()];
        self
    }

    /// Draws the figure to a `.png` or `.svg`, replacing a file that is there. The folder must exist.
    ///
    /// # Errors
    /// [`PlotError::Extension`], [`PlotError::Length`], [`PlotError::Range`] or [`PlotError::Empty`] before anything is
    /// written; [`PlotError::Draw`] or [`PlotError::File`] afterwards.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), PlotError> {
        let path = path.as_ref();
        let format = Format::of(path)?;
        let coloured = !self.field.is_empty() || !self.values.is_empty();
        if coloured && self.values.len() != self.points.len() {
            let (series, xs, ys) = (self.field.clone(), self.points.len(), self.values.len());
            return Err(PlotError::Length {
                path: path.to_owned(),
                series,
                xs,
                ys,
            });
        }
        let range = self.colour_range(path)?;
        let view = View::of(&self.points, self.size).ok_or_else(|| PlotError::Empty {
            path: path.to_owned(),
        })?;

        let layout = || self.layout(&view, coloured);
        let frame = ComputedLayout::from_layout(&layout());
        let mut scene = figure::frame(layout());
        scene.add(self.squares(&view, &frame, range));
        if coloured {
            let bar = ColourBar {
                label: &self.field,
                range,
                colours: self.colours,
            };
            bar.draw(
                &mut scene,
                frame.margin_left + frame.plot_width(),
                frame.margin_top,
                frame.margin_top + frame.plot_height(),
            );
        }
        figure::save(&scene, format, path)
    }

    fn colour_range(&self, path: &Path) -> Result<(f64, f64), PlotError> {
        if let Some((low, high)) = self.range {
            return match low < high && low.is_finite() && high.is_finite() {
                true => Ok((low, high)),
                false => Err(PlotError::Range {
                    path: path.to_owned(),
                    axis: self.field.clone(),
                    low,
                    high,
                }),
            };
        }
        let finite = || {
            self.values
                .iter()
                .copied()
                .filter(|value| value.is_finite())
        };
        let (low, high) = (
            finite().fold(f64::INFINITY, f64::min),
            finite().fold(f64::NEG_INFINITY, f64::max),
        );
        Ok(match (low.is_finite(), high > low) {
            (false, _) => (0.0, 1.0),
            (true, true) => (low, high),
            // A constant field still needs a bar with two ends.
            (true, false) => (
                low - 0.5 * low.abs().max(1.0),
                high + 0.5 * high.abs().max(1.0),
            ),
        })
    }

    /// Frame and canvas: the body's own shape, as large as the figure may be.
    fn layout(&self, view: &View, coloured: bool) -> Layout {
        let scale = view.scale;
        let ((x_low, x_high), (y_low, y_high)) = (view.drawn(0), view.drawn(1));
        let base = |width: f64, height: f64| {
            figure::style(Layout::new((x_low, x_high), (y_low, y_high)), &self.title)
                .with_width(width)
                .with_height(height)
                .with_show_grid(false)
                .with_x_label(scale.label(&self.labels[0]))
                .with_y_label(scale.label(&self.labels[1]))
                .with_tick_format(scale.ticks())
                .with_x_axis_min(x_low)
                .with_x_axis_max(x_high)
                .with_y_axis_min(y_low)
                .with_y_axis_max(y_high)
                .with_equal_aspect()
        };
        // The library knows the room its labels need; ask it first, then cut the canvas to the body's shape.
        let probe = ComputedLayout::from_layout(&base(LARGEST, LARGEST));
        let left = figure::left_margin(&base(LARGEST, LARGEST));
        let right = if coloured {
            colour_bar::ROOM
        } else {
            figure::RIGHT_MARGIN
        };
        let (beside, above) = (left + right, probe.margin_top + probe.margin_bottom);
        let (wide, high) = (x_high - x_low, y_high - y_low);
        let pixels = ((LARGEST - beside) / wide).min((LARGEST - above) / high);
        let (width, height) = (pixels * wide + beside, pixels * high + above);
        base(width.max(SMALLEST.0), height.max(SMALLEST.1)).with_force_margins(left, right)
    }

    fn squares(&self, view: &View, frame: &ComputedLayout, (low, high): (f64, f64)) -> Primitive {
        let unit = frame.map_x(view.scale.apply(1.0)) - frame.map_x(0.0);
        // A pixel at least; half a pixel more covers the neighbour's soft edge, which would shine through.
        let side = (view.side * unit).max(1.0) + 0.5;
        let colour = |index: usize| match self.values.get(index) {
            Some(value) if value.is_nan() => MISSING,
            Some(value) => self.colours.at((value - low) / (high - low)),
            None => self.colours.at(0.3),
        };
        let shown = || {
            self.points
                .iter()
                .enumerate()
                .filter(|(_, point)| finite(point))
        };
        Primitive::RectBatch {
            x: shown()
                .map(|(_, point)| frame.map_x(view.scale.apply(point[0])) - 0.5 * side)
                .collect(),
            y: shown()
                .map(|(_, point)| frame.map_y(view.scale.apply(point[1])) - 0.5 * side)
                .collect(),
            w: shown().map(|_| side).collect(),
            h: shown().map(|_| side).collect(),
            fills: shown().map(|(index, _)| colour(index)).collect(),
        }
    }
}
