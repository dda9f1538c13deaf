//! A plate of concrete whose strength varies from place to place.
//!
//! New here: random fields and scales by place. Read before: `01_bar`.
#![allow(clippy::print_stdout)]

use fissure::prelude::*;

const SIZE: [f64; 2] = [0.4, 0.2]; // m
const H: f64 = 0.01; // m, of the particles
const LENGTH: f64 = 0.04; // m, over which the strength varies

fn main() -> Result<(), Error> {
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene.fill("plate", concrete, &Block::new([0.0; 2], SIZE), &Spacing(H))?;

    // A lattice through the particles. The correlation is exp(−(d/ℓ)^1.5).
    let correlation = Correlation::Exponential {
        alpha: LENGTH.powf(-1.5),
    };
    let half = 0.5 * H;
    let (min, max) = ([half; 2], [SIZE[0] - half, SIZE[1] - half]);
    let sampler = FieldSampler::new(min, max, H, correlation)?;
    let embedding = sampler.embedding();
    println!(
        "embedding {:?}, negative {:.1e}",
        embedding.size, embedding.negative
    );

    let weibull = Marginal::Weibull { modulus: 12.0 };
    weibull.check()?;
    let field = sampler.draw(2024);
    scene.set_scales("plate", |_, x| Scale {
        strength: field.at(x).map_or(f64::NAN, |z| weibull.of(z)),
        ..Scale::default()
    })?;

    let body = &scene.bodies()[0];
    let scales = body.scales().unwrap_or(&[]);
    let strengths = || scales.iter().map(|scale| scale.0.strength);
    let count = scales.len() as f64;
    let mean = strengths().sum::<f64>() / count;
    let square = strengths().map(|s| (s - mean) * (s - mean)).sum::<f64>() / count;
    let weakest = strengths().fold(f64::INFINITY, f64::min);
    println!("strength over its mean in {count} particles");
    println!(
        "mean {mean:.3}, deviation {:.3}, least {weakest:.3}",
        square.sqrt()
    );

    // Weak places dark.
    let [columns, rows] = SIZE.map(|size| (size / H).round() as usize);
    let mut picture = vec![vec![' '; columns]; rows];
    for (x, scale) in body.motion().position.iter().zip(scales) {
        let (i, j) = ((x[0] / H) as usize, (x[1] / H) as usize);
        picture[j][i] = match scale.0.strength {
            s if s < 0.85 => '#',
            s if s < 0.95 => '+',
            s if s < 1.05 => '.',
            _ => ' ',
        };
    }
    for row in picture.iter().rev() {
        println!("|{}|", row.iter().collect::<String>());
    }
    Ok(())
}
