"""Makes the meshes beside this file, with gmsh 4.15 (`pip install gmsh`): `python meshes.py`."""

import math

import gmsh


def square():
    """A unit square of quadrilaterals without a pattern."""
    gmsh.model.add("square")
    occ = gmsh.model.occ
    face = occ.addRectangle(0, 0, 0, 1, 1)
    occ.synchronize()
    sides = {"bottom": (0.5, 0), "right": (1, 0.5), "top": (0.5, 1), "left": (0, 0.5)}
    for tag, (name, (x, y)) in enumerate(sides.items(), 1):
        e = 1e-3
        found = gmsh.model.getEntitiesInBoundingBox(
            x - 0.5 * (y in (0, 1)) - e, y - 0.5 * (x in (0, 1)) - e, -e,
            x + 0.5 * (y in (0, 1)) + e, y + 0.5 * (x in (0, 1)) + e, e, 1)
        gmsh.model.addPhysicalGroup(1, [curve for _, curve in found], tag, name)
    corner = gmsh.model.getEntitiesInBoundingBox(-e, -e, -e, e, e, e, 0)
    gmsh.model.addPhysicalGroup(0, [point for _, point in corner], 5, "corner")
    gmsh.model.addPhysicalGroup(2, [face], 6, "body")
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.3)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.option.setNumber("Mesh.Algorithm", 8)
    gmsh.option.setNumber("Mesh.RecombineAll", 1)
    gmsh.option.setNumber("Mesh.SubdivisionAlgorithm", 1)
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write("square.msh")


def bar():
    """A bar of 0.2 m x 0.06 m at 15 degrees in elements of 0.01 m along it, with room around."""
    gmsh.model.add("bar")
    geo = gmsh.model.geo
    xs, ys = [-0.04, 0.0, 0.2, 0.24], [-0.01, 0.0, 0.06, 0.07]
    h, angle = 0.01, math.radians(15.0)
    place = lambda x, y: (x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle), 0.0)
    point = {(i, j): geo.addPoint(*place(x, y)) for i, x in enumerate(xs) for j, y in enumerate(ys)}
    along = {(i, j): geo.addLine(point[i, j], point[i + 1, j]) for i in range(3) for j in range(4)}
    across = {(i, j): geo.addLine(point[i, j], point[i, j + 1]) for i in range(4) for j in range(3)}
    face = {}
    for i in range(3):
        for j in range(3):
            loop = geo.addCurveLoop([along[i, j], across[i + 1, j], -along[i, j + 1], -across[i, j]])
            face[i, j] = geo.addPlaneSurface([loop])
    count = lambda a, b: round((b - a) / h) + 1
    for (i, _), line in along.items():
        geo.mesh.setTransfiniteCurve(line, count(xs[i], xs[i + 1]))
    for (_, j), line in across.items():
        geo.mesh.setTransfiniteCurve(line, count(ys[j], ys[j + 1]))
    for surface in face.values():
        geo.mesh.setTransfiniteSurface(surface)
        geo.mesh.setRecombine(2, surface)
    geo.synchronize()
    bar = face.pop((1, 1))
    gmsh.model.addPhysicalGroup(2, [bar], 1, "bar")
    gmsh.model.addPhysicalGroup(2, list(face.values()), 2, "around")
    gmsh.model.addPhysicalGroup(1, [across[1, 1]], 3, "left end")
    gmsh.model.addPhysicalGroup(1, [across[2, 1]], 4, "right end")
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.write("bar_15.msh")


gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 1)
square()
gmsh.clear()
gmsh.option.setNumber("Mesh.RecombineAll", 0)
gmsh.option.setNumber("Mesh.SubdivisionAlgorithm", 0)
gmsh.option.setNumber("Mesh.MeshSizeMin", 0)
gmsh.option.setNumber("Mesh.MeshSizeMax", 1e22)
bar()
gmsh.finalize()
