//! What all figures share: fonts, frame, and the way to a file.

use std::io::Write;
use std::path::Path;

use kuva::prelude::{Layout, PngBackend, ScatterPlot, SvgBackend, Theme};
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Scene, render_multiple};

use super::PlotError;
use crate::file::{self, Survive};

/// Sizes of letters, px of a figure 900 wide.
pub(super) const TITLE_SIZE: u32 = 21;
pub(super) const LABEL_SIZE: u32 = 18;
pub(super) const TICK_SIZE: u32 = 15;
pub(super) const LEGEND_SIZE: u32 = 15;

/// Right of a frame with nothing beside it, px: half the last number of the axis stands there.
pub(super) const RIGHT_MARGIN: f64 = 36.0;

/// Left of a frame, px: what the library finds the numbers and the label need, and a little air between the two.
pub(super) fn left_margin(layout: &Layout) -> f64 {
    ComputedLayout::from_layout(layout).margin_left + 10.0
}

/// What a file's name says it shall hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Png,
    Svg,
}

impl Format {
    /// Asked before anything is drawn.
    pub fn of(path: &Path) -> Result<Self, PlotError> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some(extension) if extension.eq_ignore_ascii_case("png") => Ok(Self::Png),
            Some(extension) if extension.eq_ignore_ascii_case("svg") => Ok(Self::Svg),
            _ => Err(PlotError::Extension {
                path: path.to_owned(),
            }),
        }
    }
}

/// The look of every figure.
pub(super) fn style(layout: Layout, title: &str) -> Layout {
    let theme = Theme {
        grid_color: "#e4e4e4".to_owned(),
        axis_color: "#333333".to_owned(),
        tick_color: "#333333".to_owned(),
        legend_border: "#bbbbbb".to_owned(),
        ..Theme::light()
    };
    let layout = if title.is_empty() {
        layout
    } else {
        layout.with_title(title)
    };
    layout
        .with_theme(theme)
        .with_box_axes()
        .with_title_size(TITLE_SIZE)
        .with_label_size(LABEL_SIZE)
        .with_tick_size(TICK_SIZE)
        .with_body_size(LEGEND_SIZE)
}

/// A drawing of title, axes and labels alone.
pub(super) fn frame(layout: Layout) -> Scene {
    // Without any plot the library leaves the axes out; one without points shows them.
    render_multiple(vec![ScatterPlot::new().into()], layout)
}

/// Writes a finished drawing, replacing a file that is there in one piece.
pub(super) fn save(scene: &Scene, format: Format, path: &Path) -> Result<(), PlotError> {
    let bytes = match format {
        Format::Svg => SvgBackend::new().render_scene(scene).into_bytes(),
        Format::Png => PngBackend::new()
            // Two pixels for each of the figure's: fine print stays sharp on today's screens.
            .with_scale(2.0)
            .render_scene(scene)
            .map_err(|message| PlotError::Draw {
                path: path.to_owned(),
                message,
            })?,
    };
    file::replace(path, Survive::Process, |out| out.write_all(&bytes))?;
    Ok(())
}
