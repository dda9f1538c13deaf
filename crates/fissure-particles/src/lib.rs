//! Particle columns, regions and the seeding of bodies.
