//! Cracks against strain.

use fissure::prelude::*;

use crate::nairn::failed::Places;

/// How many cracks there were at which strain: groups of failed particles that touch at rest.
#[derive(Clone, Debug, Default)]
pub(super) struct Count {
    /// Nominal strain and number of cracks, where the number changes.
    pub cracks: Vec<[f64; 2]>,
    /// Groups near the grips, at the end.
    pub at_ends: usize,
    /// Places of the cracks along the specimen, at the end, m.
    pub places: Vec<f64>,
    failed: usize,
}

impl Count {
    /// Looks at the coating after a step. Groups whose middle is within `ends` of either end of
    /// `length` are not counted.
    pub(super) fn look(
        &mut self,
        body: &Body<2>,
        places: &Places<2>,
        strain: f64,
        (length, ends): (f64, f64),
    ) {
        let failed = body.value("failed").unwrap_or_default();
        let number = failed.iter().filter(|failed| **failed > 0.5).count();
        if number == self.failed {
            return;
        }
        self.failed = number;
        let groups = places.groups(&places.failed(body));
        let middle = |group: &Vec<Vector2<f64>>| {
            group.iter().map(|x| x[0]).sum::<f64>() / group.len() as f64
        };
        let inside = |x: &f64| *x > ends && *x < length - ends;
        self.places = groups.iter().map(middle).filter(inside).collect();
        self.at_ends = groups.len() - self.places.len();
        let count = self.places.len() as f64;
        if self.cracks.last().map_or(0.0, |last| last[1]) != count {
            self.cracks.push([strain, count]);
        }
    }

    /// Strain of the first crack; NaN without one.
    pub(super) fn onset(&self) -> f64 {
        self.cracks.first().map_or(f64::NAN, |first| first[0])
    }

    /// Number of cracks at a strain.
    pub(super) fn at(&self, strain: f64) -> f64 {
        at(&self.cracks, strain)
    }

    /// Number of failed particles at the end.
    pub(super) fn failed(&self) -> usize {
        self.failed
    }
}

/// A curve of steps at a place.
pub(super) fn at(steps: &[[f64; 2]], strain: f64) -> f64 {
    let after = steps.partition_point(|step| step[0] <= strain);
    after.checked_sub(1).map_or(0.0, |last| steps[last][1])
}

/// The mean of several curves of steps, at every step of any of them.
pub(super) fn mean(curves: &[&[[f64; 2]]]) -> Vec<[f64; 2]> {
    let mut strains: Vec<f64> = curves.iter().flat_map(|c| c.iter().map(|s| s[0])).collect();
    strains.sort_by(f64::total_cmp);
    strains.dedup();
    let number = curves.len() as f64;
    let value = |strain: f64| curves.iter().map(|c| at(c, strain)).sum::<f64>() / number;
    strains.into_iter().map(|s| [s, value(s)]).collect()
}

/// The largest difference of a curve from that of the independent code at every 0.05 % of strain up
/// to `end`, over what is allowed: the larger of three cracks and 15 %.
pub(super) fn against(reference: &[[f64; 2]], cracks: &[[f64; 2]], end: f64) -> f64 {
    let mut worst = 0.0_f64;
    for i in 1..=(end / 5e-4 + 1e-9) as usize {
        let strain = 5e-4 * i as f64;
        let expected = at(reference, strain);
        worst = worst.max((at(cracks, strain) - expected).abs() / (0.15 * expected).max(3.0));
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_of_steps() {
        let (a, b) = ([[0.1, 1.0], [0.3, 4.0]], [[0.2, 2.0]]);
        assert_eq!(
            [0.05, 0.1, 0.29, 0.3, 1.0].map(|x| at(&a, x)),
            [0.0, 1.0, 1.0, 4.0, 4.0]
        );
        let mean = mean(&[&a, &b]);
        assert_eq!(mean, [[0.1, 0.5], [0.2, 1.5], [0.3, 3.0]]);
        let many = [[1e-4, 40.0]];
        assert!((against(&many, &[[1e-4, 34.0]], 1e-3) - 1.0).abs() < 1e-12);
        assert!((against(&many, &[], 1e-3) - 40.0 / 6.0).abs() < 1e-12);
    }
}
