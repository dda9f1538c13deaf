//! What the curves are called, where it is in nobody's way.

use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::figure::LEGEND_SIZE;
use super::pen::Pen;
use super::stroke::{Frame, Pixel};

/// Width of a letter, px, on the safe side.
const LETTER: f64 = 0.6 * LEGEND_SIZE as f64;
/// Height of a line, px.
const LINE: f64 = 1.5 * LEGEND_SIZE as f64;
/// Length of a drawn sample, long enough for two dashes, px.
const SAMPLE: f64 = 34.0;
/// Between the box and what is in it, the sample and its name, px.
const PADDING: f64 = 10.0;
/// Between the box and the frame, px.
const INSET: f64 = 12.0;

/// Names with their pens.
#[derive(Debug)]
pub(super) struct Legend<'a> {
    pub entries: Vec<(&'a str, Pen)>,
}

impl Legend<'_> {
    /// Width a figure gives up for a legend beside the frame, px.
    pub fn room(&self) -> f64 {
        self.width() + 2.0 * INSET
    }

    /// The upper left corner of a place within the frame that no curve crosses.
    pub fn free_corner(&self, frame: &Frame, curves: &[Vec<Pixel>]) -> Option<Pixel> {
        let (width, height) = (self.width(), self.height());
        if width > 0.6 * (frame.right - frame.left) || height > 0.6 * (frame.bottom - frame.top) {
            return None;
        }
        let (right, bottom) = (frame.right - INSET - width, frame.bottom - INSET - height);
        let (left, top) = (frame.left + INSET, frame.top + INSET);
        let corners = [(right, top), (left, top), (right, bottom), (left, bottom)];
        corners.into_iter().find(|&(x, y)| {
            let air = 6.0;
            let place = Frame {
                left: x - air,
                right: x + width + air,
                top: y - air,
                bottom: y + height + air,
            };
            curves.iter().all(|curve| {
                place.clip(curve).is_empty() && !curve.iter().any(|&point| place.holds(point))
            })
        })
    }

    /// The upper left corner beside the frame.
    pub fn beside(frame: &Frame) -> Pixel {
        (frame.right + INSET, frame.top)
    }

    /// Draws the box and its entries.
    pub fn draw(&self, scene: &mut Scene, (x, y): Pixel) {
        scene.add(Primitive::Rect {
            x,
            y,
            width: self.width(),
            height: self.height(),
            fill: Color::Rgb(255, 255, 255),
            stroke: Some(Color::Rgb(0xbb, 0xbb, 0xbb)),
            stroke_width: Some(1.0),
            opacity: None,
        });
        for (row, (name, pen)) in self.entries.iter().enumerate() {
            let middle = y + 0.5 * PADDING + (row as f64 + 0.5) * LINE;
            let (from, to) = (x + PADDING, x + PADDING + SAMPLE);
            pen.sample(scene, (from, to), middle);
            scene.add(Primitive::Text {
                x: to + PADDING,
                y: middle + 0.36 * f64::from(LEGEND_SIZE),
                content: (*name).to_owned(),
                size: LEGEND_SIZE,
                anchor: TextAnchor::Start,
                rotate: None,
                bold: false,
                color: None,
            });
        }
    }

    fn width(&self) -> f64 {
        let letters = self
            .entries
            .iter()
            .map(|(name, _)| name.chars().count())
            .max()
            .unwrap_or(0);
        3.0 * PADDING + SAMPLE + letters as f64 * LETTER
    }

    fn height(&self) -> f64 {
        self.entries.len() as f64 * LINE + PADDING
    }
}
