//! The exact response of the bar [Sanchez 2010, eqs 5.2.7-5.2.26].

/// A plane-strain bar that opens at one section with linear softening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exact {
    /// Length, m.
    pub length: f64,
    /// Section, m².
    pub area: f64,
    /// `E/(1 − ν²)`, Pa (eq. 5.2.7).
    pub modulus: f64,
    /// Strength of the section that opens, Pa.
    pub strength: f64,
    /// Its fracture energy, J/m².
    pub toughness: f64,
}

impl Exact {
    /// Opening at which the traction vanishes, m: `u₀ = 2G/τ`.
    pub fn critical_opening(&self) -> f64 {
        2.0 * self.toughness / self.strength
    }

    /// Elongation at the peak, m (eq. 5.2.17).
    pub fn peak_elongation(&self) -> f64 {
        self.strength * self.length / self.modulus
    }

    /// Load at the peak, N.
    pub fn peak_load(&self) -> f64 {
        self.strength * self.area
    }

    /// Length from which the bar snaps back under controlled elongation, m (eq. 5.2.15).
    pub fn length_limit(&self) -> f64 {
        self.modulus * self.critical_opening() / self.strength
    }

    /// Load at an elongation, N (eq. 5.2.19).
    pub fn load(&self, elongation: f64) -> f64 {
        let critical = self.critical_opening();
        if elongation < self.peak_elongation() {
            self.area * self.modulus / self.length * elongation
        } else if elongation < critical {
            let softening = self.modulus / (self.length - self.length_limit());
            self.area * softening * (elongation - critical)
        } else {
            0.0
        }
    }

    /// Stored energy at an elongation, J.
    pub fn stored(&self, elongation: f64) -> f64 {
        let load = self.load(elongation);
        0.5 * load * load * self.length / (self.area * self.modulus)
    }

    /// Work done up to an elongation, J (eq. 5.2.26, with the sign of its second term mended:
    /// it then gives `area · toughness` at the critical opening). Integrated piece by piece: the
    /// load is linear between its kinks.
    pub fn work(&self, elongation: f64) -> f64 {
        let kinks = [
            self.peak_elongation(),
            self.critical_opening(),
            f64::INFINITY,
        ];
        let (mut work, mut start) = (0.0, 0.0);
        for kink in kinks {
            let end = elongation.min(kink);
            if end > start {
                work += 0.5 * (self.load(start) + self.load(end)) * (end - start);
                start = end;
            }
        }
        work
    }

    /// Energy to break the section, J.
    pub fn energy(&self) -> f64 {
        self.area * self.toughness
    }
}

#[cfg(test)]
mod tests {
    use super::Exact;

    #[test]
    fn table_5_1_gives_the_documents_numbers() {
        let exact = Exact {
            length: 0.2,
            area: 0.06 * 0.06,
            modulus: 24.9e9 / (1.0 - 0.18_f64.powi(2)),
            strength: 2.7e6,
            toughness: 61.35,
        };
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() <= 1e-4, "{a} against {b}");
        close(exact.critical_opening(), 45.444e-6);
        close(exact.peak_elongation(), 20.984e-6);
        close(exact.peak_load(), 9720.0);
        close(exact.length_limit(), 0.4331);
        close(exact.work(exact.critical_opening()), 0.22086);
        close(exact.stored(exact.peak_elongation()), 0.10198);
        close(exact.work(1e-3), exact.energy());
    }
}
