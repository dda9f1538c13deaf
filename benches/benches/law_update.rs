//! One call of a law: elastic, and the elastic-decohesive law before its crack, with a crack that
//! opens, and with the tangent.

#![allow(missing_docs)] // criterion's macros make undocumented functions

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use fissure::prelude::*;

fn increment(strain: f64) -> Increment {
    let mut f = Matrix3::identity();
    f.m11 += strain;
    f.m12 += 0.1 * strain;
    Increment {
        band: Band::Projected([0.01; 3]),
        ..Increment::to(f)
    }
}

fn laws(criterion: &mut Criterion) {
    let elastic = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };
    let concrete = Decohesive {
        elastic,
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let (sound, cracked, further) = (increment(5e-5), increment(1e-3), increment(1.1e-3));
    let virgin = concrete.initial();
    let crack = concrete.update(&cracked, &virgin).expect("a crack").state;
    let mut group = criterion.benchmark_group("law update");
    group.bench_function("isotropic", |b| {
        b.iter(|| elastic.update(black_box(&sound), &()));
    });
    group.bench_function("decohesive, sound", |b| {
        b.iter(|| concrete.update(black_box(&sound), black_box(&virgin)));
    });
    group.bench_function("decohesive, opening", |b| {
        b.iter(|| concrete.update(black_box(&further), black_box(&crack)));
    });
    group.bench_function("decohesive, opening, with tangent", |b| {
        b.iter(|| concrete.update_with_tangent(black_box(&further), black_box(&crack)));
    });
    group.finish();
}

criterion_group!(benches, laws);
criterion_main!(benches);
