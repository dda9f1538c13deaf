//! The bar that says what the colours mean, to the right of a frame.

use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use kuva::render::render_utils::generate_ticks;

use super::figure::{LABEL_SIZE, TICK_SIZE};
use super::palette::ColourMap;
use super::scale::{Scale, decimal};

/// Room the bar needs beside the frame, px: gap, bar, numbers, label.
pub(super) const ROOM: f64 = 128.0;
const GAP: f64 = 22.0;
const WIDTH: f64 = 20.0;
const STRIPS: u32 = 256;

/// What the bar shows.
pub(super) struct ColourBar<'a> {
    pub label: &'a str,
    /// In the unit of the field.
    pub range: (f64, f64),
    pub colours: ColourMap,
}

impl ColourBar<'_> {
    /// Draws beside a frame whose right side is at `right`, between `top` and `bottom`, all in px.
    pub fn draw(&self, scene: &mut Scene, right: f64, top: f64, bottom: f64) {
        let (left, height) = (right + GAP, bottom - top);
        self.strips(scene, left, top, height);
        scene.add(outline(left, top, WIDTH, height));

        let scale = Scale::linear(self.range.0.abs().max(self.range.1.abs()));
        let (low, high) = (scale.apply(self.range.0), scale.apply(self.range.1));
        let count = (height / 55.0).clamp(2.0, 6.0) as usize;
        for tick in generate_ticks(low, high, count) {
            let y = bottom - height * (tick - low) / (high - low);
            if !(top - 0.5..=bottom + 0.5).contains(&y) {
                continue;
            }
            let end = left + WIDTH;
            scene.add(Primitive::Line {
                x1: end,
                y1: y,
                x2: end + 5.0,
                y2: y,
                stroke: INK,
                stroke_width: 1.0,
                stroke_dasharray: None,
            });
            scene.add(text(
                decimal(tick),
                (end + 9.0, y + 0.36 * f64::from(TICK_SIZE)),
                TICK_SIZE,
                TextAnchor::Start,
                None,
            ));
        }
        let place = (left + ROOM - GAP - 14.0, 0.5 * (top + bottom));
        scene.add(text(
            scale.label(self.label),
            place,
            LABEL_SIZE,
            TextAnchor::Middle,
            Some(-90.0),
        ));
    }

    fn strips(&self, scene: &mut Scene, left: f64, top: f64, height: f64) {
        let strip = height / f64::from(STRIPS);
        let steps = || (0..STRIPS).map(f64::from);
        scene.add(Primitive::RectBatch {
            x: steps().map(|_| left).collect(),
            y: steps().map(|step| top + step * strip).collect(),
            w: steps().map(|_| WIDTH).collect(),
            // They overlap, lest the paper shines through between them; the last one must not stand out below.
            h: steps()
                .map(|step| (2.0 * strip).min(height - step * strip))
                .collect(),
            fills: steps()
                .map(|step| self.colours.at(1.0 - (step + 0.5) / f64::from(STRIPS)))
                .collect(),
        });
    }
}

const INK: Color = Color::Rgb(0x33, 0x33, 0x33);

fn outline(x: f64, y: f64, width: f64, height: f64) -> Primitive {
    let (fill, stroke) = (Color::None, Some(INK));
    Primitive::Rect {
        x,
        y,
        width,
        height,
        fill,
        stroke,
        stroke_width: Some(1.0),
        opacity: None,
    }
}

fn text(
    content: String,
    (x, y): (f64, f64),
    size: u32,
    anchor: TextAnchor,
    rotate: Option<f64>,
) -> Primitive {
    Primitive::Text {
        x,
        y,
        content,
        size,
        anchor,
        rotate,
        bold: false,
        color: None,
    }
}
