//! Lines and markers in pixels. The plotting library draws frame and labels; it neither clips a curve in PNG nor carries a
//! dash from one segment to the next, so that a finely sampled dashed line comes out solid.

use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{PathData, Primitive, Scene};

use super::line::Style;

/// A place in the figure, px from the upper left corner.
pub(super) type Pixel = (f64, f64);

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

/// The rectangle between the axes, px.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Frame {
    pub fn of(layout: &ComputedLayout) -> Self {
        let (left, top) = (layout.margin_left, layout.margin_top);
        Self {
            left,
            right: left + layout.plot_width(),
            top,
            bottom: top + layout.plot_height(),
        }
    }

    /// Whether a point lies inside; a point on an axis does, rounding or not.
    pub fn holds(&self, (x, y): Pixel) -> bool {
        (self.left - 0.5..=self.right + 0.5).contains(&x)
            && (self.top - 0.5..=self.bottom + 0.5).contains(&y)
    }

    /// The parts of a curve that lie inside.
    pub fn clip(&self, points: &[Pixel]) -> Vec<Vec<Pixel>> {
        let mut pieces: Vec<Vec<Pixel>> = Vec::new();
        for (&start, &end) in points.iter().zip(points.iter().skip(1)) {
            let Some((enter, leave)) = self.clip_segment(start, end) else {
                continue;
            };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&enter) => piece.push(leave),
                _ => pieces.push(vec![enter, leave]),
            }
        }
        pieces
    }

    /// Liang and Barsky: the segment's parameter shrinks to where it is inside of each side.
    fn clip_segment(&self, (x, y): Pixel, (to_x, to_y): Pixel) -> Option<(Pixel, Pixel)> {
        let (dx, dy) = (to_x - x, to_y - y);
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let sides = [
            (-dx, x - self.left),
            (dx, self.right - x),
            (-dy, y - self.top),
            (dy, self.bottom - y),
        ];
        for (towards, room) in sides {
            if towards == 0.0 && room < 0.0 {
                return None;
            } else if towards < 0.0 {
                first = first.max(room / towards);
            } else if towards > 0.0 {
                last = last.min(room / towards);
            }
        }
        let at = |share: f64| match share {
            // The ends themselves, bit for bit, so that neighbouring segments are seen to join.
            0.0 => (x, y),
            1.0 => (to_x, to_y),
            _ => (x + share * dx, y + share * dy),
        };
        (first <= last).then(|| (at(first), at(last)))
    }
}

/// The inked parts of a curve, measured along it.
fn dashed(points: &[Pixel], pattern: [f64; 2]) -> Vec<Vec<Pixel>> {
    let mut strokes = Vec::new();
    let mut stroke: Vec<Pixel> = points.first().copied().into_iter().collect();
    let (mut part, mut left) = (0, pattern[0]);
    for (&(x, y), &(to_x, to_y)) in points.iter().zip(points.iter().skip(1)) {
        let length = (to_x - x).hypot(to_y - y);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let share = gone / length;
            let turn = (x + share * (to_x - x), y + share * (to_y - y));
            stroke.push(turn);
            if part == 0 {
                strokes.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![turn];
            }
            part = 1 - part;
            left = pattern[part];
        }
        left -= length - gone;
        if part == 0 {
            stroke.push((to_x, to_y));
        }
    }
    if part == 0 && stroke.len() > 1 {
        strokes.push(stroke);
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(points: &[Pixel]) -> f64 {
        points
            .windows(2)
            .map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1))
            .sum()
    }

    #[test]
    fn dashes_run_on_over_the_points_of_a_curve() {
        // A hundred pixels in steps far shorter than a dash.
        let points: Vec<Pixel> = (0..=400)
            .map(|step| (f64::from(step) * 0.25, 7.0))
            .collect();
        let strokes = dashed(&points, [9.0, 5.0]);
        assert_eq!(strokes.len(), 8, "100 = 7 (9 + 5) + 2");
        for (index, stroke) in strokes.iter().enumerate() {
            let expected = if index == 7 { 2.0 } else { 9.0 };
            assert!(
                (length(stroke) - expected).abs() < 1e-9,
                "{index}: {}",
                length(stroke)
            );
            assert!((stroke[0].0 - 14.0 * index as f64).abs() < 1e-9);
        }
        assert_eq!(
            dashed(&[(0.0, 0.0), (100.0, 0.0)], [9.0, 5.0]).len(),
            8,
            "one long segment"
        );
    }

    #[test]
    fn a_curve_ends_at_the_frame() {
        let frame = Frame {
            left: 0.0,
            right: 10.0,
            top: 0.0,
            bottom: 10.0,
        };
        // In, out over the top, back in further right.
        let pieces = frame.clip(&[(1.0, 5.0), (2.0, 4.0), (3.0, -4.0), (5.0, -4.0), (5.0, 5.0)]);
        assert_eq!(
            pieces,
            [
                vec![(1.0, 5.0), (2.0, 4.0), (2.5, 0.0)],
                vec![(5.0, 0.0), (5.0, 5.0)]
            ]
        );
        assert!(frame.clip(&[(-5.0, -1.0), (15.0, -1.0)]).is_empty());
        assert_eq!(
            frame.clip(&[(-5.0, 5.0), (15.0, 5.0)]),
            [vec![(0.0, 5.0), (10.0, 5.0)]]
        );
    }
}
