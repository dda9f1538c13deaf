"""The problems in NVIDIA Warp, CPU back end (which runs a kernel on one thread)."""

import os

import numpy as np
import warp as wp

from problem import LAMBDA, MU

wp.config.quiet = True
wp.config.kernel_cache_dir = os.path.join(os.environ["PEERS_CACHE"], "warp")
wp.set_module_options({"enable_backward": False})
wp.init()

VERSION = wp.__version__

lam = wp.constant(wp.float64(LAMBDA))
mu = wp.constant(wp.float64(MU))
zero = wp.constant(wp.float64(0.0))
half = wp.constant(wp.float64(0.5))
one = wp.constant(wp.float64(1.0))
two = wp.constant(wp.float64(2.0))


@wp.func
def spline(s: wp.float64):
    """Quadratic B-spline of the three nodes around; s in (0.5, 1.5) from the first."""
    a = wp.float64(1.5) - s
    b = s - one
    c = s - half
    return wp.vec3d(half * a * a, wp.float64(0.75) - b * b, half * c * c)


@wp.kernel
def scatter2(
    x: wp.array(dtype=wp.vec2d), v: wp.array(dtype=wp.vec2d), c: wp.array(dtype=wp.mat22d),
    f: wp.array(dtype=wp.mat22d), grid: wp.array2d(dtype=wp.vec3d),
    dx: wp.float64, dt: wp.float64, mass: wp.float64, volume: wp.float64,
):
    p = wp.tid()
    s = x[p] / dx
    bi = wp.int32(s[0] - half)
    bj = wp.int32(s[1] - half)
    sx = s[0] - wp.float64(bi)
    sy = s[1] - wp.float64(bj)
    wx = spline(sx)
    wy = spline(sy)
    fp = f[p] + dt * (c[p] * f[p])
    f[p] = fp
    pressure = lam * wp.log(wp.determinant(fp)) - mu
    stress = mu * (fp * wp.transpose(fp)) + wp.diag(wp.vec2d(pressure, pressure))
    affine = mass * c[p] - (dt * volume * wp.float64(4.0) / (dx * dx)) * stress
    offset = wp.vec3d(zero, one, two)
    momentum = mass * v[p]
    for i in range(3):
        for j in range(3):
            arm = wp.vec2d((offset[i] - sx) * dx, (offset[j] - sy) * dx)
            q = momentum + affine * arm
            w = wx[i] * wy[j]
            wp.atomic_add(grid, bi + i, bj + j, wp.vec3d(w * q[0], w * q[1], w * mass))


@wp.kernel
def velocities2(grid: wp.array2d(dtype=wp.vec3d)):
    i, j = wp.tid()
    g = grid[i, j]
    if g[2] > zero:
        grid[i, j] = wp.vec3d(g[0] / g[2], g[1] / g[2], g[2])


@wp.kernel
def gather2(
    x: wp.array(dtype=wp.vec2d), v: wp.array(dtype=wp.vec2d), c: wp.array(dtype=wp.mat22d),
    grid: wp.array2d(dtype=wp.vec3d), dx: wp.float64, dt: wp.float64,
):
    p = wp.tid()
    s = x[p] / dx
    bi = wp.int32(s[0] - half)
    bj = wp.int32(s[1] - half)
    sx = s[0] - wp.float64(bi)
    sy = s[1] - wp.float64(bj)
    wx = spline(sx)
    wy = spline(sy)
    offset = wp.vec3d(zero, one, two)
    mean = wp.vec2d(zero, zero)
    moment = wp.mat22d(zero, zero, zero, zero)
    for i in range(3):
        for j in range(3):
            g = grid[bi + i, bj + j]
            w = wx[i] * wy[j]
            gv = wp.vec2d(w * g[0], w * g[1])
            mean = mean + gv
            moment = moment + wp.outer(gv, wp.vec2d(offset[i] - sx, offset[j] - sy))
    v[p] = mean
    c[p] = (wp.float64(4.0) / dx) * moment
    x[p] = x[p] + dt * mean


@wp.kernel
def scatter3(
    x: wp.array(dtype=wp.vec3d), v: wp.array(dtype=wp.vec3d), c: wp.array(dtype=wp.mat33d),
    f: wp.array(dtype=wp.mat33d), grid: wp.array3d(dtype=wp.vec4d),
    dx: wp.float64, dt: wp.float64, mass: wp.float64, volume: wp.float64,
):
    p = wp.tid()
    s = x[p] / dx
    bi = wp.int32(s[0] - half)
    bj = wp.int32(s[1] - half)
    bk = wp.int32(s[2] - half)
    sx = s[0] - wp.float64(bi)
    sy = s[1] - wp.float64(bj)
    sz = s[2] - wp.float64(bk)
    wx = spline(sx)
    wy = spline(sy)
    wz = spline(sz)
    fp = f[p] + dt * (c[p] * f[p])
    f[p] = fp
    pressure = lam * wp.log(wp.determinant(fp)) - mu
    stress = mu * (fp * wp.transpose(fp)) + wp.diag(wp.vec3d(pressure, pressure, pressure))
    affine = mass * c[p] - (dt * volume * wp.float64(4.0) / (dx * dx)) * stress
    offset = wp.vec3d(zero, one, two)
    momentum = mass * v[p]
    for i in range(3):
        for j in range(3):
            for k in range(3):
                arm = wp.vec3d(
                    (offset[i] - sx) * dx, (offset[j] - sy) * dx, (offset[k] - sz) * dx
                )
                q = momentum + affine * arm
                w = wx[i] * wy[j] * wz[k]
                wp.atomic_add(
                    grid, bi + i, bj + j, bk + k, wp.vec4d(w * q[0], w * q[1], w * q[2], w * mass)
                )


@wp.kernel
def velocities3(grid: wp.array3d(dtype=wp.vec4d)):
    i, j, k = wp.tid()
    g = grid[i, j, k]
    if g[3] > zero:
        grid[i, j, k] = wp.vec4d(g[0] / g[3], g[1] / g[3], g[2] / g[3], g[3])


@wp.kernel
def gather3(
    x: wp.array(dtype=wp.vec3d), v: wp.array(dtype=wp.vec3d), c: wp.array(dtype=wp.mat33d),
    grid: wp.array3d(dtype=wp.vec4d), dx: wp.float64, dt: wp.float64,
):
    p = wp.tid()
    s = x[p] / dx
    bi = wp.int32(s[0] - half)
    bj = wp.int32(s[1] - half)
    bk = wp.int32(s[2] - half)
    sx = s[0] - wp.float64(bi)
    sy = s[1] - wp.float64(bj)
    sz = s[2] - wp.float64(bk)
    wx = spline(sx)
    wy = spline(sy)
    wz = spline(sz)
    offset = wp.vec3d(zero, one, two)
    mean = wp.vec3d(zero, zero, zero)
    moment = wp.mat33d(zero, zero, zero, zero, zero, zero, zero, zero, zero)
    for i in range(3):
        for j in range(3):
            for k in range(3):
                g = grid[bi + i, bj + j, bk + k]
                w = wx[i] * wy[j] * wz[k]
                gv = wp.vec3d(w * g[0], w * g[1], w * g[2])
                mean = mean + gv
                arm = wp.vec3d(offset[i] - sx, offset[j] - sy, offset[k] - sz)
                moment = moment + wp.outer(gv, arm)
    v[p] = mean
    c[p] = (wp.float64(4.0) / dx) * moment
    x[p] = x[p] + dt * mean


KERNELS = {2: (scatter2, velocities2, gather2), 3: (scatter3, velocities3, gather3)}
TYPES = {2: (wp.vec2d, wp.mat22d, wp.vec3d), 3: (wp.vec3d, wp.mat33d, wp.vec4d)}


class Simulation:
    """The particles of a problem in Warp's arrays."""

    def __init__(self, problem):
        self.problem = problem
        d, n = problem.dim, problem.particles
        vector, matrix, node = TYPES[d]
        x, v = problem.start()
        self.x = wp.array(x, dtype=vector, device="cpu")
        self.v = wp.array(v, dtype=vector, device="cpu")
        self.c = wp.zeros(n, dtype=matrix, device="cpu")
        self.f = wp.array(np.broadcast_to(np.eye(d), (n, d, d)), dtype=matrix, device="cpu")
        self.grid = wp.zeros((problem.grid,) * d, dtype=node, device="cpu")

    def step(self, count):
        p = self.problem
        scatter, velocities, gather = KERNELS[p.dim]
        particles = [self.x, self.v, self.c]
        for _ in range(count):
            self.grid.zero_()
            wp.launch(
                scatter, p.particles, device="cpu",
                inputs=[*particles, self.f, self.grid, p.dx, p.dt, p.mass, p.volume],
            )
            wp.launch(velocities, self.grid.shape, device="cpu", inputs=[self.grid])
            wp.launch(
                gather, p.particles, device="cpu", inputs=[*particles, self.grid, p.dx, p.dt]
            )
        wp.synchronize()

    def state(self):
        return tuple(a.numpy() for a in (self.x, self.v, self.c, self.f))


def simulation(_variant):
    return Simulation
