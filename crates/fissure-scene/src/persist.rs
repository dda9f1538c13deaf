//! A scene as named sections of bytes, and back.
//!
//! What a scene is made of (laws, conditions, functions of time) is code; what has happened to it
//! is data. A checkpoint holds the data: build the same scene, then restore it.

use fissure_particles::{Motion, ParticleId, Particles};
use nalgebra::SVector;
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::condition::Selection;
use crate::crack::CrackLine;
use crate::{EnergyTotals, PersistError, Scene};

/// A named part of a saved scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// The section of the cracks, of scenes that have any.
const CRACKS: &str = "cracks";

#[derive(Serialize, Deserialize)]
struct Clock<const D: usize> {
    time: f64,
    load_time: f64,
    step: u64,
    energy: EnergyTotals,
    reactions: Vec<SVector<f64, D>>,
    contact_forces: Vec<SVector<f64, D>>,
    rigid: Vec<Vec<SVector<f64, D>>>,
}

#[derive(Serialize, Deserialize)]
struct Columns<const D: usize> {
    id: Vec<ParticleId>,
    mass: Vec<f64>,
    volume: Vec<f64>,
    motion: Motion<D>,
    extra: Vec<String>,
}

impl<const D: usize> Scene<D> {
    /// Everything that steps have changed, as sections.
    ///
    /// # Errors
    /// A state or column that does not encode.
    pub fn save(&self) -> Result<Vec<Section>, PersistError> {
        let rigid = self.conditions.iter().map(|c| match &c.selection {
            Selection::Rigid { position, .. } => position.clone(),
            Selection::Body { .. } | Selection::Places(_) => Vec::new(),
        });
        let clock = Clock {
            time: self.time,
            load_time: self.load_time,
            step: self.step,
            energy: self.energy,
            reactions: self.reactions.clone(),
            contact_forces: self.contact_forces.clone(),
            rigid: rigid.collect(),
        };
        let mut sections = vec![encode("scene".to_owned(), &clock)?];
        if !self.cracks.is_empty() {
            sections.push(encode(CRACKS.to_owned(), &self.cracks)?);
        }
        for body in &self.bodies {
            let particles = &body.particles;
            let extra: Vec<String> = particles.extra.names().map(str::to_owned).collect();
            let columns = Columns {
                id: particles.id.clone(),
                mass: particles.mass.clone(),
                volume: particles.volume.clone(),
                motion: particles.motion.clone(),
                extra: extra.clone(),
            };
            sections.push(encode(format!("{}/particles", body.name), &columns)?);
            let name = format!("{}/states", body.name);
            let bytes = body.law.save().map_err(|source| PersistError::Decode {
                section: name.clone(),
                source,
            })?;
            sections.push(Section { name, bytes });
            for column in &extra {
                let name = format!("{}/extra/{column}", body.name);
                let bytes =
                    particles
                        .extra
                        .save(column)
                        .map_err(|source| PersistError::Column {
                            section: name.clone(),
                            source,
                        })?;
                sections.push(Section { name, bytes });
            }
        }
        Ok(sections)
    }

    /// Puts saved sections into a scene built by the same code.
    ///
    /// # Errors
    /// A section that is missing, does not decode or does not fit; the scene may then be partly
    /// restored and is to be dropped.
    pub fn restore(&mut self, sections: &[Section]) -> Result<(), PersistError> {
        let clock: Clock<D> = decode(sections, "scene")?;
        self.time = clock.time;
        self.load_time = clock.load_time;
        self.step = clock.step;
        self.energy = clock.energy;
        self.reactions = clock.reactions;
        self.contact_forces = clock.contact_forces;
        fits(
            "scene",
            "number of conditions",
            clock.rigid.len(),
            self.conditions.len(),
        )?;
        for (condition, saved) in self.conditions.iter_mut().zip(clock.rigid) {
            if let Selection::Rigid { position, .. } = &mut condition.selection {
                fits(
                    "scene",
                    "number of rigid particles",
                    saved.len(),
                    position.len(),
                )?;
                *position = saved;
            }
        }
        self.restore_cracks(sections)?;
        for body in &mut self.bodies {
            let name = format!("{}/particles", body.name);
            let columns: Columns<D> = decode(sections, &name)?;
            fits(
                &name,
                "number of particles",
                columns.id.len(),
                body.particles.len(),
            )?;
            let Columns {
                id,
                mass,
                volume,
                motion,
                extra,
            } = columns;
            let restored = Particles::from_columns(id, mass, volume, motion);
            let mut particles = restored.map_err(|source| PersistError::Particles {
                section: name,
                source,
            })?;
            // Columns by their present types, which the scene's own code registered.
            std::mem::swap(&mut particles.extra, &mut body.particles.extra);
            for column in extra {
                let name = format!("{}/extra/{column}", body.name);
                let bytes = bytes(sections, &name)?;
                particles
                    .extra
                    .load(&column, bytes)
                    .map_err(|source| PersistError::Column {
                        section: name,
                        source,
                    })?;
            }
            body.particles = particles;
            let name = format!("{}/states", body.name);
            body.law.restore(bytes(sections, &name)?, &name)?;
        }
        self.edits += 1;
        Ok(())
    }

    fn restore_cracks(&mut self, sections: &[Section]) -> Result<(), PersistError> {
        let saved = sections.iter().any(|section| section.name == CRACKS);
        if self.cracks.is_empty() && !saved {
            return Ok(());
        }
        let cracks: Vec<CrackLine> = decode(sections, CRACKS)?;
        fits(CRACKS, "number of cracks", cracks.len(), self.cracks.len())?;
        for (saved, own) in cracks.iter().zip(&self.cracks) {
            if saved.name() != own.name() {
                return Err(PersistError::CrackName {
                    section: CRACKS.to_owned(),
                    found: saved.name().to_owned(),
                    expected: own.name().to_owned(),
                });
            }
            saved.check().map_err(|source| PersistError::Crack {
                section: CRACKS.to_owned(),
                source,
            })?;
        }
        self.cracks = cracks;
        Ok(())
    }
}

fn encode<T: Serialize>(name: String, value: &T) -> Result<Section, PersistError> {
    match postcard::to_stdvec(value) {
        Ok(bytes) => Ok(Section { name, bytes }),
        Err(source) => Err(PersistError::Decode {
            section: name,
            source,
        }),
    }
}

fn bytes<'a>(sections: &'a [Section], name: &str) -> Result<&'a [u8], PersistError> {
    let section = sections.iter().find(|section| section.name == name);
    let section = section.ok_or_else(|| PersistError::Missing {
        section: name.to_owned(),
    })?;
    Ok(&section.bytes)
}

fn decode<T: DeserializeOwned>(sections: &[Section], name: &str) -> Result<T, PersistError> {
    postcard::from_bytes(bytes(sections, name)?).map_err(|source| PersistError::Decode {
        section: name.to_owned(),
        source,
    })
}

fn fits(
    section: &str,
    what: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), PersistError> {
    if found == expected {
        return Ok(());
    }
    Err(PersistError::Mismatch {
        section: section.to_owned(),
        what,
        found,
        expected,
    })
}
