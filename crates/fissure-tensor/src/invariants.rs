//! Invariants of symmetric tensors: of the tensor, `I`, and of its deviator, `J`.

use crate::Sym;

impl Sym {
    /// Determinant.
    #[inline(always)]
    pub fn determinant(&self) -> f64 {
        let (yz, xz, xy) = (self.yz(), self.xz(), self.xy());
        self.xx() * (self.yy() * self.zz() - yz * yz) - xy * (xy * self.zz() - yz * xz)
            + xz * (xy * yz - self.yy() * xz)
    }

    /// Second invariant of the deviator, `J₂ = s:s/2`.
    #[inline(always)]
    pub fn j2(&self) -> f64 {
        let s = self.deviator();
        0.5 * s.dot(&s)
    }

    /// Third invariant of the deviator, `J₃ = det s`.
    #[inline]
    pub fn j3(&self) -> f64 {
        self.deviator().determinant()
    }

    /// Von Mises equivalent of a stress, `√(3 J₂)`.
    #[inline]
    pub fn von_mises(&self) -> f64 {
        (3.0 * self.j2()).sqrt()
    }

    /// Second principal invariant, `I₂ = ((tr A)² - A:A)/2`: the sum of the principal 2×2 minors.
    /// The first is [`Sym::trace`].
    #[inline]
    pub fn i2(&self) -> f64 {
        let (yz, xz, xy) = (self.yz(), self.xz(), self.xy());
        (self.yy() * self.zz() - yz * yz)
            + (self.xx() * self.zz() - xz * xz)
            + (self.xx() * self.yy() - xy * xy)
    }

    /// Third principal invariant, `I₃ = det A`.
    #[inline]
    pub fn i3(&self) -> f64 {
        self.determinant()
    }

    /// Lode angle `θ` in radians, `0 ≤ θ ≤ π/3`, with `cos 3θ = (3√3/2) J₃/J₂^(3/2)`.
    ///
    /// `θ = 0` where the two smaller eigenvalues coincide (uniaxial tension), `π/6` in pure shear,
    /// `π/3` where the two larger ones do (uniaxial compression); 0 for a multiple of the identity.
    /// Taken from the eigenvalues, `tan θ = √3 (λ₂-λ₃)/(2λ₁-λ₂-λ₃)`: the arc cosine would lose half
    /// of the digits at both ends.
    pub fn lode_angle(&self) -> f64 {
        let [first, second, third] = self.eigenvalues();
        let (upper, lower) = (first - second, second - third);
        (3.0_f64.sqrt() * lower).atan2(2.0 * upper + lower)
    }
}
