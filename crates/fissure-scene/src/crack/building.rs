//! A user puts cracks into a scene.

use super::{CrackError, CrackLine, CrackSettings, EndState};
use crate::Scene;
use crate::error::SceneError;

impl Scene<2> {
    /// Adds a closed crack along these points (m), which move with the material:
    /// `scene.crack("notch", &[[0.0, 0.05], [0.025, 0.05]], CrackSettings { first: EndState::Mouth,
    /// ..Default::default() })?`.
    ///
    /// # Errors
    /// A line that meets itself, a coefficient of friction outside its range, an end arrested by a
    /// crack that is not there, a name that is taken.
    pub fn crack(
        &mut self,
        name: &str,
        points: &[[f64; 2]],
        settings: CrackSettings,
    ) -> Result<&mut Self, SceneError> {
        self.free_name(name)?;
        let cracks = self.cracks.len();
        let refused = |source| SceneError::Crack {
            crack: name.to_owned(),
            source,
        };
        for end in [settings.first, settings.last] {
            match end {
                EndState::Arrested { by } if by >= cracks => {
                    return Err(refused(CrackError::Unknown { crack: by, cracks }));
                }
                _ => {}
            }
        }
        let crack = CrackLine::new(name, points, settings).map_err(refused)?;
        self.cracks.push(crack);
        self.edits += 1;
        Ok(self)
    }
}
