"""The problems in Taichi, CPU back end on one thread.

Variant `taichi` writes its loops as Taichi runs them on any number of threads, with atomic sums at the
nodes; `taichi-serial` asks for serial loops, which need none.
"""

import os

import numpy as np
import taichi as ti

from problem import LAMBDA, MU

ti.init(
    arch=ti.cpu, default_fp=ti.f64, cpu_max_num_threads=1, log_level=ti.WARN,
    offline_cache_file_path=os.path.join(os.environ["PEERS_CACHE"], "taichi"),
)

VERSION = ".".join(str(part) for part in ti.__version__)


@ti.data_oriented
class Simulation:
    """The particles of a problem in Taichi's fields."""

    def __init__(self, problem, serial):
        self.problem, self.serial = problem, serial
        d, n = problem.dim, problem.particles
        self.dim, self.n = d, n
        self.dx, self.dt = problem.dx, problem.dt
        self.mass, self.volume = problem.mass, problem.volume
        self.x = ti.Vector.field(d, ti.f64, n)
        self.v = ti.Vector.field(d, ti.f64, n)
        self.c = ti.Matrix.field(d, d, ti.f64, n)
        self.f = ti.Matrix.field(d, d, ti.f64, n)
        self.grid = ti.Vector.field(d + 1, ti.f64, (problem.grid,) * d)
        x, v = problem.start()
        self.x.from_numpy(x)
        self.v.from_numpy(v)
        self.f.from_numpy(np.broadcast_to(np.eye(d), (n, d, d)).copy())

    @ti.func
    def weights(self, s):
        """Quadratic B-splines of the three nodes around; s in (0.5, 1.5) from the first."""
        return [0.5 * (1.5 - s) ** 2, 0.75 - (s - 1.0) ** 2, 0.5 * (s - 0.5) ** 2]

    @ti.kernel
    def one_step(self):
        for node in ti.grouped(self.grid):
            self.grid[node].fill(0.0)
        ti.loop_config(serialize=self.serial)
        for p in range(self.n):
            position = self.x[p] / self.dx
            base = ti.cast(position - 0.5, ti.i32)
            s = position - base
            w = self.weights(s)
            f = self.f[p] + self.dt * self.c[p] @ self.f[p]
            self.f[p] = f
            unit = ti.Matrix.identity(ti.f64, self.dim)
            stress = MU * (f @ f.transpose() - unit) + LAMBDA * ti.log(f.determinant()) * unit
            affine = self.mass * self.c[p] - (4.0 * self.dt * self.volume / self.dx**2) * stress
            momentum = self.mass * self.v[p]
            for offset in ti.static(ti.grouped(ti.ndrange(*((3,) * self.dim)))):
                arm = (offset.cast(ti.f64) - s) * self.dx
                weight = 1.0
                for axis in ti.static(range(self.dim)):
                    weight *= w[offset[axis]][axis]
                q = weight * (momentum + affine @ arm)
                for axis in ti.static(range(self.dim)):
                    self.grid[base + offset][axis] += q[axis]
                self.grid[base + offset][self.dim] += weight * self.mass
        for node in ti.grouped(self.grid):
            mass = self.grid[node][self.dim]
            if mass > 0.0:
                for axis in ti.static(range(self.dim)):
                    self.grid[node][axis] /= mass
        ti.loop_config(serialize=self.serial)
        for p in range(self.n):
            position = self.x[p] / self.dx
            base = ti.cast(position - 0.5, ti.i32)
            s = position - base
            w = self.weights(s)
            v = ti.Vector.zero(ti.f64, self.dim)
            moment = ti.Matrix.zero(ti.f64, self.dim, self.dim)
            for offset in ti.static(ti.grouped(ti.ndrange(*((3,) * self.dim)))):
                weight = 1.0
                for axis in ti.static(range(self.dim)):
                    weight *= w[offset[axis]][axis]
                g = ti.Vector.zero(ti.f64, self.dim)
                for axis in ti.static(range(self.dim)):
                    g[axis] = weight * self.grid[base + offset][axis]
                v += g
                moment += g.outer_product(offset.cast(ti.f64) - s)
            self.v[p] = v
            self.c[p] = (4.0 / self.dx) * moment
            self.x[p] += self.dt * v

    def step(self, count):
        for _ in range(count):
            self.one_step()
        ti.sync()

    def state(self):
        return tuple(a.to_numpy() for a in (self.x, self.v, self.c, self.f))


def simulation(variant):
    return lambda problem: Simulation(problem, variant == "taichi-serial")
