use super::*;
use crate::contract::{Random, SofteningFault, check_softening};

/// Nairn's quantities at the opening `s` for `sG_c = 1`: strain at failure, `Ḡ(δ)/σ`, largest
/// slope.
#[test]
fn power_law_is_equation_47() {
    for n in [1.0, 1.5, 2.0, 4.0, 9.0] {
        let law = PowerLaw { exponent: n };
        let delta_max = (1.0 + n) / n;
        assert!((law.critical() - delta_max).abs() < 1e-15);
        assert!((law.steepest() - n / delta_max).abs() < 1e-14);
        assert!((law.stability() - (1.0 + n) / (n * n)).abs() < 1e-14);
        for i in 0..=20 {
            let delta = delta_max * f64::from(i) / 20.0;
            let energy = 0.5 * delta * (1.0 - (1.0 - n) / (1.0 + n) * (delta / delta_max).powf(n));
            assert!(
                (law.dissipated_to_origin(delta) - energy).abs() < 1e-14,
                "n {n}"
            );
        }
    }
}

#[test]
fn linear_is_equation_48_and_power_law_one() {
    let power = PowerLaw { exponent: 1.0 };
    assert_eq!(Linear.stability(), 2.0);
    for i in 0..=50 {
        let s = 0.05 * f64::from(i);
        let within = s.min(2.0);
        assert!((Linear.dissipated_to_origin(s) - 0.5 * within).abs() < 1e-15);
        assert!((power.ratio(s) - Linear.ratio(s)).abs() < 1e-15);
        assert!((power.area(s) - Linear.area(s)).abs() < 1e-15);
        assert!((power.slope(s) - Linear.slope(s)).abs() < 1e-15);
    }
}

#[test]
fn exponential_is_equation_49() {
    assert_eq!(Exponential.stability(), 1.0);
    for i in 0..=50 {
        let s = 0.3 * f64::from(i);
        let energy = 1.0 - (-s).exp() * (1.0 + 0.5 * s);
        assert!((Exponential.dissipated_to_origin(s) - energy).abs() < 1e-15);
    }
}

#[test]
fn special_cases_meet() {
    assert!((CubicStep.stability() - 4.0 / 3.0).abs() < 1e-15);
    let plain = DoubleExponential {
        decay_ratio: 3.0,
        weight: 0.0,
    };
    // Petersson's curve fails at 3.6 G/σ.
    assert!((Bilinear::default().critical() - 3.6).abs() < 1e-14);
    for i in 0..=50 {
        let s = 0.2 * f64::from(i);
        assert!((plain.ratio(s) - Exponential.ratio(s)).abs() < 1e-15);
        assert!((plain.area(s) - Exponential.area(s)).abs() < 1e-15);
        let x = (0.5 * s).min(1.0);
        assert!((CubicStep.ratio(s) - (1.0 + x * x * (2.0 * x - 3.0))).abs() < 1e-15);
        // The code of Nairn 2017: Ḡ(δ)/σ = δ/2 (1 + x²(1 − x)).
        let energy = x * (1.0 + x * x * (1.0 - x));
        assert!((CubicStep.dissipated_to_origin(s) - energy).abs() < 1e-15);
    }
}

#[test]
fn every_curve_is_a_softening_curve_and_none_is_more_stable_than_the_line() {
    fn ask<S: Softening>(curve: S) {
        assert_eq!(check_softening(&curve), Ok(()), "{curve:?}");
        assert!(curve.stability() <= 2.0, "{curve:?}");
    }
    ask(Linear);
    ask(Exponential);
    ask(CubicStep);
    ask(Bilinear::default());
    let mut random = Random::new(11);
    for _ in 0..40 {
        let kink_ratio = random.uniform(0.02, 0.98);
        ask(Bilinear {
            kink_ratio,
            kink_opening: random.uniform(0.02, 0.98) * 2.0 / (1.0 + kink_ratio),
        });
        ask(PowerLaw {
            exponent: random.log_uniform(1.0, 30.0),
        });
        let decay_ratio = 1.0 + random.log_uniform(0.05, 20.0);
        ask(DoubleExponential {
            decay_ratio,
            weight: random.uniform(-3.0, 1.0) / decay_ratio,
        });
    }
    ask(DoubleExponential {
        decay_ratio: 2.0,
        weight: 0.5,
    });
}

#[test]
fn parameters_outside_their_range_are_refused_by_name() {
    fn refused(curve: impl Softening, name: &str) {
        let answer = curve.check();
        assert!(
            matches!(answer, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
            "{curve:?}: {answer:?}"
        );
    }
    for exponent in [0.999_999, 0.5, 0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(PowerLaw { exponent }, "exponent");
    }
    let reason = PowerLaw { exponent: 0.5 }
        .check()
        .map_err(|e| e.to_string());
    assert!(reason.is_err_and(|text| text.contains("unstable for every band")));
    for kink_ratio in [0.0, 1.0, -0.5, f64::NAN, f64::INFINITY] {
        let law = Bilinear {
            kink_ratio,
            ..Bilinear::default()
        };
        refused(law, "kink_ratio");
    }
    for kink_opening in [0.0, 1.5, -1.0, f64::NAN, f64::INFINITY] {
        let law = Bilinear {
            kink_opening,
            ..Bilinear::default()
        };
        refused(law, "kink_opening");
    }
    let two = |decay_ratio, weight| DoubleExponential {
        decay_ratio,
        weight,
    };
    for decay_ratio in [1.0, 0.5, -2.0, f64::NAN, f64::INFINITY] {
        refused(two(decay_ratio, 0.1), "decay_ratio");
    }
    for weight in [0.500_001, 1.0, f64::NAN, f64::NEG_INFINITY] {
        refused(two(2.0, weight), "weight");
    }
}

/// A line with one thing made wrong.
#[derive(Clone, Copy, Debug)]
struct Wrong(&'static str);

impl Softening for Wrong {
    fn ratio(&self, s: f64) -> f64 {
        let bump = if self.0 == "ratio rises" && s > 1.0 && s < 1.01 {
            0.1
        } else {
            0.0
        };
        Linear.ratio(s) + bump
    }
    fn slope(&self, s: f64) -> f64 {
        let factor = if self.0 == "slope" { 0.999 } else { 1.0 };
        factor * Linear.slope(s)
    }
    fn area(&self, s: f64) -> f64 {
        let factor = if self.0 == "area" { 1.0001 } else { 1.0 };
        factor * Linear.area(s)
    }
    fn critical(&self) -> f64 {
        if self.0 == "critical" { 1.9 } else { 2.0 }
    }
    fn steepest(&self) -> f64 {
        match self.0 {
            "steep" => 0.49,
            "not steep" => 0.6,
            "NaN" => f64::NAN,
            _ => 0.5,
        }
    }
}

#[test]
fn a_curve_with_one_fault_is_found() {
    assert_eq!(check_softening(&Wrong("nothing")), Ok(()));
    for (fault, says) in [
        ("ratio rises", "ratio rises"),
        ("slope", "ratio against the integral of slope"),
        ("area", "area against the integral of ratio"),
        ("critical", "ratio at the end"),
        ("steep", "slope steeper than the steepest"),
        ("not steep", "steepest slope against the largest met"),
        ("NaN", "steepest slope"),
    ] {
        let found = check_softening(&Wrong(fault));
        assert!(
            matches!(found, Err(SofteningFault::Curve { what, .. }) if what == says),
            "{fault}: {found:?}"
        );
    }
}

/// Counts how often the curve inside is asked.
#[derive(Clone, Copy, Debug)]
struct Counted<S>(S, &'static std::sync::atomic::AtomicUsize);

impl<S: Softening> Softening for Counted<S> {
    fn ratio(&self, s: f64) -> f64 {
        self.1.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        self.0.ratio(s)
    }
    fn slope(&self, s: f64) -> f64 {
        self.0.slope(s)
    }
    fn area(&self, s: f64) -> f64 {
        self.0.area(s)
    }
    fn critical(&self) -> f64 {
        self.0.critical()
    }
    fn steepest(&self) -> f64 {
        self.0.steepest()
    }
}

#[test]
fn the_opening_is_found_in_few_evaluations() {
    fn ask<S: Softening>(curve: S, counter: &'static std::sync::atomic::AtomicUsize) -> usize {
        let counted = Counted(curve, counter);
        let mut random = Random::new(12);
        let mut most = 0;
        for _ in 0..5000 {
            let stiffness = curve.steepest() / random.uniform(0.001, 0.99);
            let exact = random.log_uniform(1e-12, curve.critical().min(30.0));
            let load = stiffness * exact + curve.ratio(exact);
            counter.store(0, std::sync::atomic::Ordering::Relaxed);
            let start = if random.chance(0.5) {
                0.0
            } else {
                random.uniform(0.0, exact)
            };
            let found = opening(&counted, load, stiffness, start);
            let round_off = 1e-14 * load / (stiffness + curve.slope(exact)).abs();
            assert!(
                (found - exact).abs() <= round_off + 1e-14 * exact,
                "{curve:?} {exact:e}"
            );
            most = most.max(counter.load(std::sync::atomic::Ordering::Relaxed));
        }
        println!("{curve:?}: at most {most} evaluations");
        most
    }
    static COUNTER: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
    let most = [
        ask(Linear, &COUNTER),
        ask(Bilinear::default(), &COUNTER),
        ask(PowerLaw { exponent: 3.0 }, &COUNTER),
        ask(Exponential, &COUNTER),
        ask(CubicStep, &COUNTER),
    ];
    assert!(most.into_iter().all(|count| count <= 20), "{most:?}");
}
