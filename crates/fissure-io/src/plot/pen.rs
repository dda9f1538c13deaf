//! The look of a series: its line and its markers, in the frame and in the legend.

use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, Scene};

use super::line::Style;
use super::stroke::{Frame, Pixel, dashed};

const LINE_WIDTH: f64 = 2.2;
const MARKER_RADIUS: f64 = 4.5;

/// Lengths of ink and gap, px; none for a solid line.
fn dashes(style: Style) -> Option<[f64; 2]> {
    match style {
        Style::Dashed => Some([9.0, 5.0]),
        Style::Dotted => Some([2.0, 4.0]),
        Style::Line | Style::Markers | Style::LineAndMarkers => None,
    }
}

/// How one series looks: the same in the frame and in the legend.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    pub style: Style,
    pub colour: &'static str,
    /// Number of the series, which chooses the shape of its markers.
    pub index: usize,
}

impl Pen {
    /// Draws an uninterrupted curve as far as it lies in the frame.
    pub fn draw(self, scene: &mut Scene, points: &[Pixel], frame: &Frame) {
        if self.has_line() {
            for piece in frame.clip(points) {
                self.line(scene, &piece);
            }
        }
        if self.has_markers() {
            for &point in points.iter().filter(|point| frame.holds(**point)) {
                self.marker(scene, point);
            }
        }
    }

    /// Draws what a legend shows: a level line, one marker.
    pub fn sample(self, scene: &mut Scene, (from, to): (f64, f64), y: f64) {
        if self.has_line() {
            self.line(scene, &[(from, y), (to, y)]);
        }
        if self.has_markers() {
            self.marker(scene, (0.5 * (from + to), y));
        }
    }

    fn has_line(self) -> bool {
        self.style != Style::Markers
    }

    fn has_markers(self) -> bool {
        matches!(self.style, Style::Markers | Style::LineAndMarkers)
    }

    fn line(self, scene: &mut Scene, points: &[Pixel]) {
        let strokes = match dashes(self.style) {
            Some(pattern) => dashed(points, pattern),
            None => vec![points.to_vec()],
        };
        for points in strokes {
            let stroke = Color::from(self.colour);
            scene.add(Primitive::PolyLine {
                points,
                stroke,
                stroke_width: LINE_WIDTH,
                stroke_dasharray: None,
            });
        }
    }

    fn marker(self, scene: &mut Scene, (x, y): Pixel) {
        let r = MARKER_RADIUS;
        let corners: &[Pixel] = match self.index % 5 {
            0 => {
                let fill = Color::from(self.colour);
                return scene.add(Primitive::Circle {
                    cx: x,
                    cy: y,
                    r,
                    fill,
                    fill_opacity: None,
                    stroke: None,
                    stroke_width: None,
                });
            }
            1 => &[(-r, -r), (r, -r), (r, r), (-r, r)],
            2 => &[(0.0, -1.2 * r), (1.15 * r, 0.8 * r), (-1.15 * r, 0.8 * r)],
            3 => &[
                (0.0, -1.35 * r),
                (1.35 * r, 0.0),
                (0.0, 1.35 * r),
                (-1.35 * r, 0.0),
            ],
            _ => &[(0.0, 1.2 * r), (1.15 * r, -0.8 * r), (-1.15 * r, -0.8 * r)],
        };
        let to = |&(dx, dy): &Pixel| format!("{:.2},{:.2}", x + dx, y + dy);
        let d = format!(
            "M{} Z",
            corners.iter().map(to).collect::<Vec<_>>().join(" L")
        );
        let (fill, stroke) = (Some(Color::from(self.colour)), Color::from(self.colour));
        scene.add(Primitive::Path(Box::new(PathData {
            d,
            fill,
            stroke,
            stroke_width: 0.5,
            opacity: None,
            stroke_dasharray: None,
        })));
    }
}
