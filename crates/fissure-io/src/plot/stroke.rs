//! What is left of a curve inside a frame, and of that under a dash pattern. The plotting library neither clips a curve
//! in PNG nor carries a dash from one segment to the next, so that a finely sampled dashed line would come out solid.

use kuva::render::layout::ComputedLayout;

/// A place in the figure, px from the upper left corner.
pub(super) type Pixel = (f64, f64);

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
pub(super) fn dashed(points: &[Pixel], pattern: [f64; 2]) -> Vec<Vec<Pixel>> {
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
