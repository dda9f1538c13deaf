//! The damage tensor and the damage strain partitioning tensor of the document.

use fissure_tensor::{Matrix6, Sym, Tangent, Vector3};

use super::tangent::{modulus, tangents};
use super::{AnisotropicDamage, AnisotropicDamageState};
use crate::{Biot, Increment, MaterialError, Scale, Softening};

impl<N: Softening, T: Softening> AnisotropicDamage<N, T> {
    /// The damage tensor `D` of `T = (1 − D):C:E` in the reference axes (eqs 1 and 3), between
    /// Mandel components: `D = (d_n/C₁₁) (C:n⊗n) ⊗ (n⊗n) + d_t Σ_t s_t⊗s_t/2`, `s_t = n⊗t + t⊗n`.
    /// For an open crack; under pressure `d_n` has no effect.
    pub fn damage_tensor(&self, state: &AnisotropicDamageState, scale: &Scale) -> Tangent {
        if state.width == 0.0 {
            return Tangent::zero();
        }
        let elastic = self.elastic_at::<false>(scale);
        let normal = Vector3::from(state.normal);
        let crack = self.crack_at::<false>(scale, state);
        let (opening, sliding) = (crack.opening_integrity(state), crack.shear_integrity(state));
        let dyad = Sym::dyad(&normal);
        let mut damage = Tangent::dyad(&elastic.stress(&dyad), &dyad)
            * ((1.0 - opening) / elastic.p_wave_modulus());
        let (first, second) = tangents(&normal, &Vector3::zeros());
        for tangential in [first, second] {
            let shear = Sym::dyad_of(&normal, &tangential) * 2.0;
            damage = damage + Tangent::dyad(&shear, &shear) * (0.5 * (1.0 - sliding));
        }
        damage
    }

    /// The damage strain partitioning tensor `Δ = ∂ε_c/∂E` at the end of an increment (eqs 6, 7, 10,
    /// 11), between Mandel components, for a crack whose plane is fixed: the part of a strain
    /// increment that goes to the crack. Zero without a crack.
    ///
    /// # Errors
    /// As [`Material::update`](crate::Material::update).
    pub fn partitioning_tensor(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Tangent, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step::<false>(&kinematics, increment, old)?;
        let elastic = self.elastic_at::<false>(&increment.external.scale);
        let Some((moved, _)) = step.crack else {
            return Ok(Tangent::zero());
        };
        let modulus = modulus(&elastic, &moved.state.normal.into(), &moved.slopes);
        let compliance = elastic.stiffness().0.try_inverse();
        let compliance = Tangent(compliance.unwrap_or_else(Matrix6::zeros));
        Ok(Tangent::identity() - Tangent::double_contraction(&compliance, &modulus))
    }
}
