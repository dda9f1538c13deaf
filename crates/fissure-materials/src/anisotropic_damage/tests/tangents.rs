use super::*;

/// A hundredth of the bound in the battery: 1e-8 of the stiffness against Richardson-extrapolated
/// differences, in every branch, at a step of about 1e-5 of the failure strain.
#[test]
fn tangents_agree_with_extrapolated_differences() -> Result<(), MaterialError> {
    let mix = Matrix3::new(0.2, 0.5, -0.1, 0.0, -0.3, 0.2, 0.1, 0.0, 0.1);
    let turn = rotation(&Vector3::new(0.3, -1.0, 0.6), 1.2);
    let rough = AnisotropicDamage {
        friction: 0.5,
        ..law()
    };
    let shearing = AnisotropicDamage {
        shear: Mode {
            strength: 1e6,
            ..law().shear
        },
        ..law()
    };
    let tension = Matrix3::identity() * 0.3;
    let shut = Matrix3::new(-0.4, 0.3, 0.0, 0.3, -0.1, 0.0, 0.0, 0.0, 0.0);
    let held = Matrix3::new(-0.4, 0.25, 0.0, 0.25, -0.1, 0.02, 0.0, 0.02, 0.0);
    let paths: [(&AnisotropicDamage, &[Matrix3<f64>]); 9] = [
        (&rough, &[mix * 1e-4]),
        (&rough, &[(mix + tension) * 2e-2]), // onset in tension
        (
            &rough,
            &[(mix + tension) * 1e-2, (mix + tension) * 2e-2 + shut * 1e-2],
        ), // both soften
        (&rough, &[(mix + tension) * 2e-2, (mix + tension) * 1e-2]), // unloading
        (&rough, &[mix * 1.0, mix * 0.7]),   // failed, open
        (&rough, &[(mix + tension) * 0.3, shut * 0.02]), // failed, shut, sliding
        (&rough, &[(mix + tension) * 0.3, shut * 0.02, held * 0.02]), // sticking
        (&shearing, &[mix * 1e-2]),          // onset in shear
        (&shearing, &[mix * 1e-2, mix * 1.3e-2]),
    ];
    let mut worst = 0.0_f64;
    for (law, path) in paths {
        for band in [
            Band::cube(WIDTH),
            Band::Projected([0.6 * WIDTH, WIDTH, 0.8 * WIDTH]),
        ] {
            let gradients: Vec<_> = path
                .iter()
                .map(|h| turn * (Matrix3::identity() + h))
                .collect();
            let (mut old, mut state) = (Matrix3::identity(), law.initial());
            let (last, before) = gradients.split_last().expect("a path");
            for f in before {
                let step = Increment {
                    band,
                    ..increment(old, *f)
                };
                state = law.update(&step, &state)?.state;
                old = *f;
            }
            let step = Increment {
                band,
                ..increment(old, *last)
            };
            let analytic = law.tangent(&step, &state)?;
            let difference = |h| crate::material::difference_tangent(law, &step, &state, h);
            let h = 1e-5 * OPEN;
            let extrapolated = (difference(0.5 * h)? * 4.0 - difference(h)?) * (1.0 / 3.0);
            let gap = (analytic - extrapolated).max_abs() / ELASTIC.p_wave_modulus();
            worst = worst.max(gap);
            assert!(gap < 1e-8, "{path:?} {band:?}: {gap:e}");
        }
    }
    println!("tangents: {worst:e} of the stiffness");
    Ok(())
}

/// `D` and `Δ`: `T = (1 − D):C:E` (eq. 1), rows along the crack are zero, `D:C` symmetric
/// (sec. 2.5.2), eigenvalues of the secant between 0 and those of `C` (P13).
#[test]
fn the_tensors_are_those_of_the_document() -> Result<(), MaterialError> {
    let f = gradient(0.4 * OPEN, 0.3 * SLID, -0.2 * SLID);
    let (last, _) = through(&across_x(), &[f], 1)?;
    let (law, scale) = (across_x(), Scale::default());
    let damage = law.damage_tensor(&last.state, &scale);
    let stiffness = ELASTIC.stiffness();
    let secant = Tangent::double_contraction(&(Tangent::identity() - damage), &stiffness);
    let kinematics = Biot::new(&f)?;
    let stress = kinematics.turned(&secant.apply(&kinematics.strain()));
    assert!((stress - last.stress).max_abs() < 1e-9 * 3e6);
    assert!((secant - Tangent(secant.0.transpose())).max_abs() < 1e-6);
    let values = secant.0.symmetric_eigenvalues();
    assert!(
        values.min() >= 0.0 && values.max() <= 1.0001 * stiffness.0.symmetric_eigenvalues().max()
    );
    // Eq. 3 in the crack's axes, x being the normal.
    let ratio = ELASTIC.poisson / (1.0 - ELASTIC.poisson);
    assert!((damage.0[(1, 0)] / damage.0[(0, 0)] - ratio).abs() < 1e-12);
    let next = gradient(0.45 * OPEN, 0.32 * SLID, -0.22 * SLID);
    let partition = law.partitioning_tensor(&increment(f, next), &last.state)?;
    for row in 1..4 {
        assert!(partition.0.row(row).norm() < 1e-12, "row {row}");
    }
    // While opening damage grows, Δ₁₁ = dδ/dε = 1/(1 + ε_n0 f') (eq. 17).
    let slope = 3e6 / ELASTIC.p_wave_modulus() / OPEN;
    assert!((partition.0[(0, 0)] * (1.0 - slope) - 1.0).abs() < 1e-12);
    // Elastic: Δ = Dᵀ (sec. 2.2.1).
    let back = law.partitioning_tensor(
        &increment(f, gradient(0.3 * OPEN, 0.2 * SLID, 0.0)),
        &last.state,
    )?;
    assert!((back - Tangent(damage.0.transpose())).max_abs() < 1e-12);
    Ok(())
}
