"""The two problems, what is shared by the peers' runs, and how a run is measured.

A block of compressible neo-Hookean material flies and rings in an empty grid: MLS-MPM with APIC,
quadratic B-splines, symplectic Euler, no boundary conditions, no output, double precision.
"""

import ctypes
import math
import os
import resource
import time
from dataclasses import dataclass

import numpy as np

YOUNG, POISSON, DENSITY = 1e6, 0.3, 1000.0
LAMBDA = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
MU = YOUNG / (2 * (1 + POISSON))


@dataclass(frozen=True)
class Problem:
    """Sizes in cells; the grid is 1 m wide, the matter in its middle, two particles an edge of a cell."""

    name: str
    dim: int
    grid: int
    matter: int
    dt: float
    warm_up: int
    steps: int

    @property
    def dx(self):
        return 1.0 / self.grid

    @property
    def particles(self):
        return (2 * self.matter) ** self.dim

    @property
    def volume(self):
        """Reference volume of a particle, m^dim."""
        return (0.5 * self.dx) ** self.dim

    @property
    def mass(self):
        """Mass of a particle, kg (in 2D of 1 m of thickness)."""
        return DENSITY * self.volume

    def start(self):
        """Positions in lattice order (the last axis runs fastest) and velocities.

        Axis `a` has the velocity `sin(2 pi x_b)`, `b` the next axis in turn; the first 1 m/s more.
        """
        first = (self.grid - self.matter) // 2
        line = (first + 0.25 + 0.5 * np.arange(2 * self.matter)) * self.dx
        axes = np.meshgrid(*[line] * self.dim, indexing="ij")
        x = np.stack([axis.ravel() for axis in axes], axis=1)
        v = np.sin(2 * math.pi * np.roll(x, -1, axis=1))
        v[:, 0] += 1.0
        return x, v


PROBLEMS = {
    "A": Problem("A", dim=2, grid=320, matter=250, dt=2e-5, warm_up=10, steps=50),
    "B": Problem("B", dim=3, grid=64, matter=40, dt=1e-4, warm_up=5, steps=15),
}


def tiny(problem):
    """The same on a few cells: compiles everything and touches next to no memory."""
    return Problem(problem.name, problem.dim, 16, 4, problem.dt, 1, 1)


def resident():
    """Resident memory of this process without what it has freed, bytes."""
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def user_time():
    """User CPU time of this process, all of its threads, s."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def measure(simulation, problem, steps=None):
    """Runs `problem` with a peer's class `simulation`; a dictionary of figures.

    `simulation(problem)` holds the particles on the peer's side; `step(n)` makes n steps and waits for
    them; `state()` gives x, v, C and F as arrays, F being that of the start of the last step.
    """
    steps = steps or problem.steps
    warm = simulation(tiny(problem))
    warm.step(2)
    warm.state()
    del warm
    before = resident()
    run = simulation(problem)
    run.step(problem.warm_up)
    user, wall = user_time(), time.perf_counter()
    run.step(steps)
    user, wall = user_time() - user, time.perf_counter() - wall
    grown = resident() - before
    updates = problem.particles * steps
    return {
        "problem": problem.name,
        "particles": problem.particles,
        "steps": problem.warm_up + steps,
        "updates_per_cpu_s": updates / user,
        "updates_per_s": updates / wall,
        "bytes_per_particle": grown / problem.particles,
        **probes(problem, *run.state()),
    }


def probes(problem, x, v, c, f):
    """What two codes of the same scheme must agree on, to round-off."""
    f = f + problem.dt * c @ f
    jacobian = np.linalg.det(f)
    log = np.log(jacobian)
    trace = (f * f).sum(axis=(1, 2)) - problem.dim
    stored = 0.5 * MU * (trace - 2 * log) + 0.5 * LAMBDA * log * log
    return {
        "mass": problem.mass * len(x),
        "momentum": (problem.mass * v.sum(axis=0)).tolist(),
        "kinetic_energy": 0.5 * problem.mass * float((v * v).sum()),
        "stored_energy": problem.volume * float(stored.sum()),
        "first_position": x[0].tolist(),
        "first_velocity": v[0].tolist(),
    }
