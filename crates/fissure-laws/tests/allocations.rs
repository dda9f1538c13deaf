//! An update of a law allocates nothing.

use std::alloc::System;

use fissure_laws::{LAWS, Space, Values};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Allocations of the cases that a measurement of speed is made of, all its updates apart: those are hundreds of thousands.
const CASES: usize = 200;

/// One test, since the allocator counts what all tests do.
#[test]
fn updates_sound_and_damaging_allocate_nothing() {
    for entry in LAWS {
        for space in [Space::Solid, Space::PlaneStress] {
            if !entry.is_for(space) {
                continue;
            }
            let law = (entry.build)(&Values::own(entry), space);
            let region = Region::new(HEAP);
            law.speed(1);
            let change = region.change();
            let count = change.allocations + change.reallocations;
            assert!(count < CASES, "{} in {space:?}: {count}", entry.name);
        }
    }
}
