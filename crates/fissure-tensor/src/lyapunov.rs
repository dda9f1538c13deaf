//! The equation `U·X + X·U = H` for symmetric `U`, `H`.

use crate::Sym;

/// Solves `U·X + X·U = H` for symmetric positive definite `U`; the unit of `X` is that of `H/U`.
///
/// It turns Biot into second Piola-Kirchhoff stress (`U·S + S·U = 2T`) and the rate of `C = U²`
/// into that of `U`. On the eigenvectors of `U` the components separate, `X_ij = H_ij/(λ_i + λ_j)`.
/// Where `U` has no out-of-plane shear (`yz = xz = 0`) the equation falls apart into a 3×3 system
/// for the in-plane components of `X`, a 2×2 system for its out-of-plane shears, which any `H` may
/// have, and one equation for `zz`; these are eliminated directly, without eigenvectors.
///
/// The residual is of the order of round-off times `|U||X|` whatever the condition of `U`. A `U`
/// that is not positive definite gives a meaningless or non-finite result.
pub fn solve_lyapunov(u: &Sym, h: &Sym) -> Sym {
    if u.mandel[3] == 0.0 && u.mandel[4] == 0.0 {
        return plane(u, h);
    }
    let spectrum = u.spectrum();
    let basis = spectrum.basis();
    let local = h.congruence(&basis.transpose());
    let v = spectrum.values;
    Sym::new(
        local.xx() / (2.0 * v[0]),
        local.yy() / (2.0 * v[1]),
        local.zz() / (2.0 * v[2]),
        local.yz() / (v[1] + v[2]),
        local.xz() / (v[0] + v[2]),
        local.xy() / (v[0] + v[1]),
    )
    .congruence(&basis)
}

/// Elimination in the order of the diagonal, which is stable for a positive definite `U`. Dividing
/// by `det U` instead would put the relative error of that difference on every component.
fn plane(u: &Sym, h: &Sym) -> Sym {
    let (a, d, c, b) = (u.xx(), u.yy(), u.zz(), u.xy());
    // 2a·xx + 2b·xy = hxx, 2d·yy + 2b·xy = hyy, b·(xx + yy) + (a + d)·xy = hxy.
    let (over_a, over_d) = (1.0 / a, 1.0 / d);
    let pivot = (a - b * b * over_d) + (d - b * b * over_a);
    let (x, y) = (0.5 * over_a * h.xx(), 0.5 * over_d * h.yy());
    let xy = (h.xy() - b * (x + y)) / pivot;
    let (xx, yy) = (x - b * over_a * xy, y - b * over_d * xy);
    // (a + c)·xz + b·yz = hxz, b·xz + (d + c)·yz = hyz.
    let over_ac = 1.0 / (a + c);
    let yz = (h.yz() - b * over_ac * h.xz()) / ((d + c) - b * b * over_ac);
    let xz = over_ac * (h.xz() - b * yz);
    Sym::new(xx, yy, h.zz() / (2.0 * c), yz, xz, xy)
}
