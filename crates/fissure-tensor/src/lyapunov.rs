//! The equation `U·X + X·U = H` for symmetric `U`, `H`.

use crate::Sym;

/// Solves `U·X + X·U = H` for symmetric positive definite `U`.
///
/// It turns Biot into second Piola-Kirchhoff stress (`U·S + S·U = 2T`) and the rate of `C = U²`
/// into that of `U`. Closed form by Cayley-Hamilton: with `X = a H + b (U·H + H·U) + …` the
/// components couple only through the invariants; here the block form is used where `U` has no
/// out-of-plane shear and the spectral form elsewhere.
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

/// `U` is block diagonal, a 2×2 block `A` and `c`: the block of `X` is
/// `(H det A + adj(A)·H·adj(A)) / (2 tr A det A)`, the mixed column solves `(A + c) x = h`.
fn plane(u: &Sym, h: &Sym) -> Sym {
    let (a, d, c, b) = (u.xx(), u.yy(), u.zz(), u.xy());
    let (hxx, hyy, hxy) = (h.xx(), h.yy(), h.xy());
    let det = a * d - b * b;
    let scale = 1.0 / (2.0 * (a + d) * det);
    let xx = scale * (hxx * det + d * d * hxx - 2.0 * b * d * hxy + b * b * hyy);
    let yy = scale * (hyy * det + b * b * hxx - 2.0 * a * b * hxy + a * a * hyy);
    let xy = scale * (hxy * det + (a * d + b * b) * hxy - b * d * hxx - a * b * hyy);
    let (ac, dc) = (a + c, d + c);
    let mixed = 1.0 / (ac * dc - b * b);
    let xz = mixed * (dc * h.xz() - b * h.yz());
    let yz = mixed * (ac * h.yz() - b * h.xz());
    Sym::new(xx, yy, h.zz() / (2.0 * c), yz, xz, xy)
}
