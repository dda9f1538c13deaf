//! Random numbers by id and by place against their sampling errors: mean, variance, correlation and
//! distribution; what negative eigenvalues do; the same numbers whatever the order and the threads.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use fissure_particles::{
    Correlation, FieldError, FieldSampler, Marginal, ParticleId, RandomField, WhiteNoise,
};
use nalgebra::SVector;

/// A bound of so many standard errors is passed by all of a few hundred estimates at a time.
const SIGMAS: f64 = 4.0;

/// Mean and standard error of independent numbers.
fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0);
    (mean, (square / n).sqrt())
}

/// Whether numbers have this mean by their own standard error.
fn has_mean(values: impl Iterator<Item = f64>, exact: f64) -> bool {
    let (mean, error) = mean(&values.collect::<Vec<_>>());
    (mean - exact).abs() <= SIGMAS * error
}

/// Largest distance of the empirical distribution from `exact`, times the root of the number.
fn kolmogorov(mut values: Vec<f64>, exact: impl Fn(f64) -> f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len() as f64;
    let distances = values.iter().enumerate().map(|(i, &v)| {
        let f = exact(v);
        (f - i as f64 / n).abs().max((f - (i + 1) as f64 / n).abs())
    });
    distances.fold(0.0, f64::max) * n.sqrt()
}

fn noise(seed: u64) -> Vec<f64> {
    (0..200_000)
        .map(|id| WhiteNoise { seed }.at(ParticleId(id)))
        .collect()
}

#[test]
fn noise_is_standard_normal_and_without_correlation() {
    let (a, b) = (noise(1), noise(2));
    assert!(has_mean(a.iter().copied(), 0.0));
    assert!(has_mean(a.iter().map(|z| z * z), 1.0));
    assert!(has_mean(a.iter().map(|z| z * z * z), 0.0));
    assert!(has_mean(a.iter().map(|z| z.powi(4)), 3.0));
    // From one id to the next, and from one seed to the next.
    assert!(has_mean(a.windows(2).map(|pair| pair[0] * pair[1]), 0.0));
    assert!(has_mean(a.iter().zip(&b).map(|(a, b)| a * b), 0.0));
    let normal = |z: f64| 0.5 * libm::erfc(-z / std::f64::consts::SQRT_2);
    let distance = kolmogorov(a.clone(), normal);
    // Exceeded by one sample in a thousand.
    assert!(distance <= 1.95, "{distance}");
    // The test sees a deviation of 2 %.
    assert!(kolmogorov(a, |z| normal(0.98 * z)) > 1.95);
}

#[test]
fn marginals_have_mean_1_and_their_distribution() {
    let z = noise(3);
    for (marginal, deviation) in [
        (
            Marginal::Normal {
                deviation: 0.2,
                least: 0.1,
            },
            0.2,
        ),
        (Marginal::LogNormal { deviation: 0.5 }, 0.5),
        (Marginal::Weibull { modulus: 1.0 }, 1.0),
        (Marginal::Weibull { modulus: 8.0 }, {
            let moment = |k: f64| libm::tgamma(1.0 + k / 8.0);
            (moment(2.0) / (moment(1.0) * moment(1.0)) - 1.0).sqrt()
        }),
    ] {
        marginal.check().unwrap();
        let factors: Vec<f64> = z.iter().map(|&z| marginal.of(z)).collect();
        assert!(factors.iter().all(|f| *f > 0.0));
        assert!(has_mean(factors.iter().copied(), 1.0), "{marginal:?}");
        let squares = factors.iter().map(|f| (f - 1.0) * (f - 1.0));
        assert!(has_mean(squares, deviation * deviation), "{marginal:?}");
        // Finite, positive and growing far into the tails.
        let tails: Vec<f64> = (-30..=30).map(|z| marginal.of(f64::from(z))).collect();
        assert!(
            tails.iter().all(|f| f.is_finite() && *f > 0.0),
            "{marginal:?}"
        );
        assert!(tails.is_sorted(), "{marginal:?}");
    }
    let modulus = 8.0;
    let factors = z
        .iter()
        .map(|&z| Marginal::Weibull { modulus }.of(z))
        .collect();
    let scale = 1.0 / libm::tgamma(1.0 + 1.0 / modulus);
    let distance = kolmogorov(factors, |f| 1.0 - (-(f / scale).powf(modulus)).exp());
    assert!(distance <= 1.95, "{distance}");
}

#[test]
fn marginals_outside_their_range_are_refused() {
    for bad in [
        Marginal::Normal {
            deviation: 0.0,
            least: 0.1,
        },
        Marginal::Normal {
            deviation: f64::NAN,
            least: 0.1,
        },
        Marginal::Normal {
            deviation: 0.1,
            least: 0.0,
        },
        Marginal::Normal {
            deviation: 0.1,
            least: 1.0,
        },
        Marginal::LogNormal { deviation: -1.0 },
        Marginal::Weibull { modulus: 0.1 },
        Marginal::Weibull {
            modulus: f64::INFINITY,
        },
    ] {
        let refused = bad.check();
        assert!(
            matches!(refused, Err(FieldError::Parameter { .. })),
            "{bad:?}"
        );
    }
}

/// Mean of `z(x) z(x + lag)` over the lattice of a field.
fn product<const D: usize>(field: &RandomField<D>, lag: [usize; D]) -> f64 {
    let points = field.points();
    let (mut sum, mut count) = (0.0, 0.0);
    for (place, value) in field.values().iter().enumerate() {
        let (mut rest, mut stride, mut other, mut inside) = (place, 1, place, true);
        for axis in 0..D {
            inside &= rest % points[axis] + lag[axis] < points[axis];
            rest /= points[axis];
            other += lag[axis] * stride;
            stride *= points[axis];
        }
        if inside {
            sum += value * field.values()[other];
            count += 1.0;
        }
    }
    sum / count
}

/// Largest deviation of the products of many draws from a correlation, in standard errors, and the
/// largest standard error.
fn deviation<const D: usize>(
    fields: &[RandomField<D>],
    spacing: f64,
    lags: &[[usize; D]],
    correlation: &Correlation,
) -> (f64, f64) {
    let (mut worst, mut coarsest) = (0.0_f64, 0.0_f64);
    for lag in lags {
        let products: Vec<f64> = fields.iter().map(|field| product(field, *lag)).collect();
        let (found, error) = mean(&products);
        let steps: usize = lag.iter().map(|k| k * k).sum();
        let exact = correlation.at(spacing * (steps as f64).sqrt());
        worst = worst.max((found - exact).abs() / error);
        coarsest = coarsest.max(error);
    }
    (worst, coarsest)
}

const CORRELATIONS: [Correlation; 5] = [
    Correlation::Exponential { alpha: 60.0 },
    Correlation::Gaussian { length: 0.08 },
    Correlation::Matern {
        length: 0.06,
        order: 0,
    },
    Correlation::Matern {
        length: 0.06,
        order: 1,
    },
    Correlation::Matern {
        length: 0.06,
        order: 2,
    },
];

fn is_distributed<const D: usize>(max: [f64; D], spacing: f64, draws: u64, lags: &[[usize; D]]) {
    for correlation in CORRELATIONS {
        let sampler = FieldSampler::new([0.0; D], max, spacing, correlation).unwrap();
        assert!(
            sampler.embedding().negative <= 1e-12,
            "{:?}",
            sampler.embedding()
        );
        let fields: Vec<_> = (0..draws).map(|seed| sampler.draw(seed)).collect();
        let means = fields.iter().map(|field| mean(field.values()).0);
        assert!(has_mean(means, 0.0), "{correlation:?}");
        let (worst, coarsest) = deviation(&fields, spacing, lags, &correlation);
        println!(
            "{D}D {correlation:?} {:?}: worst of {} lags {worst:.2} standard errors of at most {coarsest:.4}",
            sampler.embedding().size,
            lags.len()
        );
        assert!(worst <= SIGMAS, "{correlation:?}: {worst} standard errors");
        // What is 30 % longer is told apart.
        let longer = match correlation {
            Correlation::Exponential { alpha } => Correlation::Exponential {
                alpha: alpha / 1.3_f64.powf(1.5),
            },
            Correlation::Gaussian { length } => Correlation::Gaussian {
                length: 1.3 * length,
            },
            Correlation::Matern { length, order } => Correlation::Matern {
                length: 1.3 * length,
                order,
            },
        };
        assert!(
            deviation(&fields, spacing, lags, &longer).0 > SIGMAS,
            "{correlation:?}"
        );
    }
}

#[test]
fn fields_in_the_plane_have_their_mean_variance_and_correlation() {
    let lags = [
        [0, 0],
        [1, 0],
        [0, 2],
        [3, 0],
        [2, 2],
        [0, 5],
        [4, 3],
        [8, 1],
        [12, 12],
    ];
    is_distributed([0.8, 0.5], 0.02, 120, &lags);
}

#[test]
fn fields_in_space_have_their_mean_variance_and_correlation() {
    let lags = [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 1],
        [0, 0, 2],
        [2, 1, 2],
        [4, 0, 3],
    ];
    is_distributed([0.3, 0.36, 0.24], 0.03, 150, &lags);
}

#[test]
fn a_long_correlation_is_embedded_in_a_longer_period_or_cut_and_reported() {
    let sampler = |length, permitted| {
        let correlation = Correlation::Gaussian { length };
        FieldSampler::permitting([0.0; 2], [1.0, 1.0], 0.05, correlation, permitted)
    };
    // 0.6 of the box: the first period is too short.
    let doubled = sampler(0.6, 0.0).unwrap();
    assert!(doubled.embedding().doublings > 0 && doubled.embedding().negative <= 1e-12);
    // Six times the box: no period within the limit is long enough.
    let Err(FieldError::Negative {
        share,
        permitted,
        points,
    }) = sampler(6.0, 0.0)
    else {
        panic!("a field that cannot be embedded");
    };
    assert!(
        share > 1e-12 && permitted == 0.0 && points == 320 * 320,
        "{share} {points}"
    );
    let cut = sampler(6.0, 0.9).unwrap();
    assert_eq!(
        (cut.embedding().negative, cut.embedding().points()),
        (share, points)
    );
    println!("left out: {share:.2e} on {:?}", cut.embedding().size);
    // Correlations are wrong by twice the share at most.
    let fields: Vec<_> = (0..200).map(|seed| cut.draw(seed)).collect();
    for lag in [[0, 0], [10, 0], [20, 20]] {
        let products: Vec<f64> = fields.iter().map(|field| product(field, lag)).collect();
        let (found, error) = mean(&products);
        let steps: usize = lag.iter().map(|k| k * k).sum();
        let exact = Correlation::Gaussian { length: 6.0 }.at(0.05 * (steps as f64).sqrt());
        assert!(
            (found - exact).abs() <= 2.0 * share + SIGMAS * error,
            "{lag:?}: {found} for {exact}"
        );
    }
}

#[test]
fn sizes_and_boxes_that_make_no_lattice_are_refused() {
    let smooth = Correlation::Gaussian { length: 0.1 };
    let over = |max: f64, spacing| FieldSampler::new([0.0; 3], [1.0, max, 1.0], spacing, smooth);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(
            matches!(over(bad, 0.05), Err(FieldError::Extent { axis: 1, .. })),
            "{bad}"
        );
        assert!(
            matches!(over(1.0, bad), Err(FieldError::Parameter { .. })),
            "{bad}"
        );
    }
    assert!(matches!(over(1.0, 1e-3), Err(FieldError::TooLarge { .. })));
    assert!(matches!(
        over(1e300, 1e-3),
        Err(FieldError::TooLarge { .. })
    ));
}

#[test]
fn between_lattice_points_a_field_keeps_its_variance() {
    let correlation = Correlation::Exponential { alpha: 60.0 };
    let sampler = FieldSampler::new([-0.1, 0.2], [0.3, 0.5], 0.02, correlation).unwrap();
    let fields: Vec<_> = (0..1500).map(|seed| sampler.draw(seed)).collect();
    let at = |field: &RandomField<2>, x: f64, y: f64| field.at(&SVector::from([x, y])).unwrap();
    for (x, y) in [(0.11, 0.31), (0.105, 0.323), (-0.1, 0.5), (0.2999, 0.2)] {
        assert!(
            has_mean(fields.iter().map(|f| at(f, x, y).powi(2)), 1.0),
            "{x} {y}"
        );
        let other = fields.iter().map(|f| at(f, x, y) * at(f, 0.15, 0.35));
        let (found, error) = mean(&other.collect::<Vec<_>>());
        let exact = correlation.at((x - 0.15_f64).hypot(y - 0.35));
        assert!(
            (found - exact).abs() <= SIGMAS * error + 0.01,
            "{found} for {exact}"
        );
    }
    let field = &fields[0];
    assert_eq!(field.points(), [21, 16]);
    for (place, value) in field.values().iter().enumerate() {
        let (i, j) = (place % 21, place / 21);
        let found = at(field, -0.1 + 0.02 * i as f64, 0.2 + 0.02 * j as f64);
        assert!(
            (found - value).abs() <= 1e-9,
            "{i} {j}: {found} for {value}"
        );
    }
    for outside in [[-0.11, 0.3], [0.31, 0.3], [0.1, 0.51], [f64::NAN, 0.3]] {
        assert_eq!(field.at(&SVector::from(outside)), None);
    }
}

#[test]
fn a_seed_gives_the_same_bits_on_any_number_of_threads_and_machine() {
    let correlation = Correlation::Exponential { alpha: 60.0 };
    let sampler = FieldSampler::new([0.0; 2], [0.4, 0.3], 0.02, correlation).unwrap();
    let field = sampler.draw(11);
    for threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        assert!(pool.install(|| sampler.draw(11)) == field);
    }
    assert!(sampler.draw(12) != field);
    // Written down once: a change of these numbers changes everyone's fields.
    let found = [
        WhiteNoise { seed: 11 }.at(ParticleId(0)),
        WhiteNoise { seed: 11 }.at(ParticleId(7)),
        field.values()[0],
        field.values()[100],
    ];
    println!("{found:?}");
    let written = [
        -0.8003766055910906,
        -0.3208239162395577,
        -0.08536281135148105,
        -0.6806169877174859,
    ];
    for (found, written) in found.iter().zip(written) {
        assert!((found - written).abs() <= 1e-14, "{found} for {written}");
    }
}
