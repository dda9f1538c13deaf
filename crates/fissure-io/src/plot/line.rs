//! Curves over a common axis.

use std::borrow::Cow;
use std::path::Path;

use kuva::prelude::Layout;
use kuva::render::layout::ComputedLayout;

use super::axis::Axis;
use super::figure::{self, Format};
use super::legend::Legend;
use super::pen::Pen;
use super::scale::Scale;
use super::stroke::{Frame, Pixel};
use super::{PlotError, palette};

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Style {
    /// A solid line.
    #[default]
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// Markers alone, as for measurements; their shape changes from series to series.
    Markers,
    /// A solid line with markers, as for few computed points.
    LineAndMarkers,
}

/// Curves with labelled axes and a legend that keeps out of their way.
///
/// A number that is not finite interrupts its curve; on a logarithmic axis zero and below do so too.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// use fissure_io::plot::{LinePlot, Style};
///
/// let delta = [0.0, 1e-5, 2e-5, 4e-5]; // m
/// LinePlot::new("Notched beam")
///     .x_label("deflection [m]")
///     .y_label("force [N]")
///     .series("computed", &delta, &[0.0, 410.0, 560.0, 180.0], Style::Line)
///     .series("measured", &delta, &[0.0, 395.0, 540.0, 200.0], Style::Markers)
///     .save(folder.path().join("beam.svg"))?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct LinePlot<'a> {
    title: String,
    x: Axis,
    y: Axis,
    series: Vec<Series<'a>>,
    legend: bool,
    size: (f64, f64),
}

#[derive(Debug, Clone)]
struct Series<'a> {
    name: String,
    xs: Cow<'a, [f64]>,
    ys: Cow<'a, [f64]>,
    style: Style,
}

impl<'a> LinePlot<'a> {
    /// An empty figure, 900 by 600 px, under a title that may be empty.
    pub fn new(title: &str) -> Self {
        let (x, y) = (Axis::default(), Axis::default());
        Self {
            title: title.to_owned(),
            x,
            y,
            series: Vec::new(),
            legend: true,
            size: (900.0, 600.0),
        }
    }

    /// Label of the horizontal axis, with the unit of the numbers handed over: `"delta [m]"`.
    #[must_use]
    pub fn x_label(mut self, label: &str) -> Self {
        self.x.label = label.to_owned();
        self
    }

    /// Label of the vertical axis.
    #[must_use]
    pub fn y_label(mut self, label: &str) -> Self {
        self.y.label = label.to_owned();
        self
    }

    /// Makes the horizontal axis logarithmic.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.x.logarithmic = true;
        self
    }

    /// Makes the vertical axis logarithmic.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.y.logarithmic = true;
        self
    }

    /// Fixes the ends of the horizontal axis, in the unit of its numbers. Left to itself it holds all points.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x.range = Some((low, high));
        self
    }

    /// Fixes the ends of the vertical axis.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y.range = Some((low, high));
        self
    }

    /// Adds a curve. A series without a name is not in the legend.
    #[must_use]
    pub fn series(
        mut self,
        name: &str,
        xs: impl Into<Cow<'a, [f64]>>,
        ys: impl Into<Cow<'a, [f64]>>,
        style: Style,
    ) -> Self {
        self.series.push(Series {
            name: name.to_owned(),
            xs: xs.into(),
            ys: ys.into(),
            style,
        });
        self
    }

    /// Leaves the legend out.
    #[must_use]
    pub fn without_legend(mut self) -> Self {
        self.legend = false;
        self
    }

    /// Another size than 900 by 600 px.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.size = (width.into(), height.into());
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
        self.check(path)?;
        let (x, y) = self.fitted().ok_or_else(|| PlotError::Empty {
            path: path.to_owned(),
        })?;
        let layout = || self.layout(&x, &y);

        // The legend goes into a free corner; if there is none, the frame makes room for it.
        let legend = Legend {
            entries: self.named().collect(),
        };
        let left = figure::left_margin(&layout());
        let beside = |right: f64| layout().with_force_margins(left, right);
        let probe = ComputedLayout::from_layout(&beside(figure::RIGHT_MARGIN));
        let corner = legend.free_corner(&Frame::of(&probe), &self.curves(&x, &y, &probe).concat());
        let shown = self.legend && !legend.entries.is_empty();
        let layout = || match shown && corner.is_none() {
            true => beside(legend.room()),
            false => beside(figure::RIGHT_MARGIN),
        };

        let computed = ComputedLayout::from_layout(&layout());
        let frame = Frame::of(&computed);
        let mut scene = figure::frame(layout());
        for (index, pieces) in self.curves(&x, &y, &computed).iter().enumerate() {
            for piece in pieces {
                self.pen(index).draw(&mut scene, piece, &frame);
            }
        }
        if shown {
            legend.draw(&mut scene, corner.unwrap_or_else(|| Legend::beside(&frame)));
        }
        figure::save(&scene, format, path)
    }

    fn check(&self, path: &Path) -> Result<(), PlotError> {
        for series in &self.series {
            let (xs, ys) = (series.xs.len(), series.ys.len());
            if xs != ys {
                return Err(PlotError::Length {
                    path: path.to_owned(),
                    series: series.name.clone(),
                    xs,
                    ys,
                });
            }
        }
        for axis in [&self.x, &self.y] {
            if let (Some((low, high)), false) = (axis.range, axis.range_is_sound()) {
                return Err(PlotError::Range {
                    path: path.to_owned(),
                    axis: axis.label.clone(),
                    low,
                    high,
                });
            }
        }
        Ok(())
    }

    /// The axes with their ends; none if no point can be shown.
    fn fitted(&self) -> Option<(Fitted<'_>, Fitted<'_>)> {
        let pairs = self
            .series
            .iter()
            .flat_map(|series| series.xs.iter().zip(series.ys.iter()));
        let mut shown = pairs.filter(|&(&x, &y)| self.x.shows(x) && self.y.shows(y));
        let (&x, &y) = shown.next()?;
        let widen = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let start = ((x, x), (y, y));
        let (xs, ys) = shown.fold(start, |(xs, ys), (&x, &y)| (widen(xs, x), widen(ys, y)));
        let fit = |axis, data| Fitted {
            axis,
            ends: Axis::ends(axis, data),
            scale: axis.scale(data),
        };
        Some((fit(&self.x, xs), fit(&self.y, ys)))
    }

    /// Per series its uninterrupted parts, px.
    fn curves(
        &self,
        x: &Fitted<'_>,
        y: &Fitted<'_>,
        layout: &ComputedLayout,
    ) -> Vec<Vec<Vec<Pixel>>> {
        let pixel = |&(a, b): &(f64, f64)| {
            (
                layout.map_x(x.scale.apply(a)),
                layout.map_y(y.scale.apply(b)),
            )
        };
        let curve = |series: &Series<'_>| {
            let points: Vec<(f64, f64)> = series
                .xs
                .iter()
                .copied()
                .zip(series.ys.iter().copied())
                .collect();
            let parts = points.split(|&(a, b)| !x.axis.shows(a) || !y.axis.shows(b));
            parts
                .filter(|part| !part.is_empty())
                .map(|part| part.iter().map(pixel).collect())
                .collect()
        };
        self.series.iter().map(curve).collect()
    }

    fn pen(&self, index: usize) -> Pen {
        Pen {
            style: self.series[index].style,
            colour: palette::series(index),
            index,
        }
    }

    fn named(&self) -> impl Iterator<Item = (&str, Pen)> {
        let all = self.series.iter().enumerate();
        all.filter(|(_, series)| !series.name.is_empty())
            .map(|(index, series)| (series.name.as_str(), self.pen(index)))
    }

    fn layout(&self, x: &Fitted<'_>, y: &Fitted<'_>) -> Layout {
        let ((x_low, x_high), (y_low, y_high)) = (x.drawn_ends(), y.drawn_ends());
        let layout = figure::style(Layout::new((x_low, x_high), (y_low, y_high)), &self.title)
            .with_width(self.size.0)
            .with_height(self.size.1)
            .with_x_label(x.scale.label(&x.axis.label))
            .with_y_label(y.scale.label(&y.axis.label))
            .with_x_tick_format(x.scale.ticks())
            .with_y_tick_format(y.scale.ticks())
            .with_x_axis_min(x_low)
            .with_x_axis_max(x_high)
            .with_y_axis_min(y_low)
            .with_y_axis_max(y_high);
        let layout = if x.axis.logarithmic {
            layout.with_log_x()
        } else {
            layout
        };
        if y.axis.logarithmic {
            layout.with_log_y()
        } else {
            layout
        }
    }
}

/// An axis that knows its data.
struct Fitted<'a> {
    axis: &'a Axis,
    /// In the unit of the data.
    ends: (f64, f64),
    scale: Scale,
}

impl Fitted<'_> {
    fn drawn_ends(&self) -> (f64, f64) {
        (self.scale.apply(self.ends.0), self.scale.apply(self.ends.1))
    }
}
