"""The problems in plain numpy: slow, written apart from the others, to check them.

Variant `numpy` is the same scheme; `numpy-gradient` takes forces and velocity gradient from the gradients
of the functions in place of the moving least squares, as many codes do: what such a code is compared with.
"""

import itertools

import numpy as np

from problem import LAMBDA, MU

VERSION = np.__version__


class Simulation:
    """The particles of a problem in numpy's arrays."""

    def __init__(self, problem, by_gradient):
        self.problem, self.by_gradient = problem, by_gradient
        d, n = problem.dim, problem.particles
        self.x, self.v = problem.start()
        self.affine = np.zeros((n, d, d))
        self.velocity_gradient = self.affine
        self.f = np.broadcast_to(np.eye(d), (n, d, d)).copy()

    def nodes(self):
        """For each node of the stencil: its flat index, function, gradient and arm, all per particle."""
        p = self.problem
        s = self.x / p.dx
        base = np.floor(s - 0.5).astype(int)
        s -= base
        values = [0.5 * (1.5 - s) ** 2, 0.75 - (s - 1) ** 2, 0.5 * (s - 0.5) ** 2]
        slopes = [(s - 1.5) / p.dx, -2 * (s - 1) / p.dx, (s - 0.5) / p.dx]
        axes = range(p.dim)
        for offset in itertools.product(range(3), repeat=p.dim):
            index = np.ravel_multi_index([base[:, a] + offset[a] for a in axes], (p.grid,) * p.dim)
            weight = np.prod([values[offset[a]][:, a] for a in axes], axis=0)
            gradient = np.stack(
                [
                    np.prod([(slopes if a == b else values)[offset[a]][:, a] for a in axes], axis=0)
                    for b in axes
                ],
                axis=1,
            )
            yield index, weight[:, None], gradient, (np.array(offset) - s) * p.dx

    def one_step(self):
        p, d = self.problem, self.problem.dim
        self.f = self.f + p.dt * self.velocity_gradient @ self.f
        log = np.log(np.linalg.det(self.f))[:, None, None]
        transposed = self.f.transpose(0, 2, 1)
        kirchhoff = MU * (self.f @ transposed - np.eye(d)) + LAMBDA * log * np.eye(d)
        mass, momentum = np.zeros((p.grid**d, 1)), np.zeros((p.grid**d, d))
        moment = p.dx**2 / 4
        for index, weight, gradient, arm in self.nodes():
            force_arm = gradient if self.by_gradient else weight * arm / moment
            impulse = -p.dt * p.volume * apply(kirchhoff, force_arm)
            np.add.at(mass, index, p.mass * weight)
            np.add.at(momentum, index, p.mass * weight * (self.v + apply(self.affine, arm)) + impulse)
        velocity = np.divide(momentum, mass, out=np.zeros_like(momentum), where=mass > 0)
        self.v, self.affine = np.zeros_like(self.v), np.zeros_like(self.affine)
        by_gradient = np.zeros_like(self.affine)
        for index, weight, gradient, arm in self.nodes():
            node = velocity[index]
            self.v += weight * node
            self.affine += (weight * node)[:, :, None] * arm[:, None, :] / moment
            by_gradient += node[:, :, None] * gradient[:, None, :]
        self.velocity_gradient = by_gradient if self.by_gradient else self.affine
        self.x = self.x + p.dt * self.v

    def step(self, count):
        for _ in range(count):
            self.one_step()

    def state(self):
        return self.x, self.v, self.velocity_gradient, self.f


def apply(matrices, vectors):
    """The product of each particle's matrix and vector."""
    return np.einsum("nij,nj->ni", matrices, vectors)


def simulation(variant):
    return lambda problem: Simulation(problem, variant == "numpy-gradient")
