#!/usr/bin/env python3
"""Makes volume meshes with densities by Gmsh, meshio and TetGen, and weighs them with numpy alone.

    python3 tests/judge/volume_meshes.py FOLDER

Writes files in every dialect into FOLDER, and prints a list of {"file", "moments", "tetrahedra"} as JSON. The moments are
∫ d of 1, x, y, z, xy, yz, xz, x², y², z², by a Gauss rule of degree 5 in each tetrahedron, with the density d linear
between its corners or constant in it. The Gauss rule shares no formula with the program's closed form.
"""

import itertools
import json
import sys
from pathlib import Path

import gmsh
import meshio
import numpy as np

try:
    import tetgen
except ImportError:
    tetgen = None


def gauss():
    """The 15-point rule of degree 5 on a tetrahedron (Keast, CMAME 55, 1986, rule 6), as shares and weights."""
    points, weights = [[0.25] * 4], [0.030283678097089]
    for share, weight in ((1 / 3, 0.006026785714286), (0.090909090909091, 0.011645249086029)):
        for corner in range(4):
            shares = [share] * 4
            shares[corner] = 1 - 3 * share
            points.append(shares)
            weights.append(weight)
    share = 0.066550153573664
    for pair in itertools.combinations(range(4), 2):
        shares = [0.5 - share] * 4
        for corner in pair:
            shares[corner] = share
        points.append(shares)
        weights.append(0.010949141561386)
    weights = np.array(weights)
    return np.array(points), weights / weights.sum()


def moments(points, cells, densities):
    """densities: one for each cell and corner, shape (cells, 4)."""
    corners = points[cells]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    total = np.zeros(10)
    for shares, weight in zip(*gauss()):
        x, y, z = np.einsum("k,ikd->di", shares, corners)
        mass = volumes * weight * (densities @ shares)
        total += [np.sum(mass * f) for f in (np.ones_like(x), x, y, z, x * y, y * z, x * z, x * x, y * y, z * z)]
    return total.tolist()


def ball(size):
    """A ball with a slot, meshed by Gmsh, which stays open for export."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    body = gmsh.model.occ.addSphere(3, 4, 5, 20)
    slot = gmsh.model.occ.addBox(-30, 2, 5, 60, 4, 40)
    gmsh.model.occ.cut([(3, body)], [(3, slot)])
    gmsh.model.occ.synchronize()
    for name, value in (("MeshSizeMax", size), ("MeshSizeMin", size), ("SaveAll", 1)):
        gmsh.option.setNumber(f"Mesh.{name}", value)
    gmsh.model.mesh.generate(3)
    tags, points, _ = gmsh.model.mesh.getNodes()
    kinds, elements, corners = gmsh.model.mesh.getElements(3)
    assert list(kinds) == [4], kinds
    places = {tag: index for index, tag in enumerate(tags)}
    cells = np.array([places[tag] for tag in corners[0]]).reshape(-1, 4)
    return tags, points.reshape(-1, 3), elements[0], cells


def field(points):
    return 0.5 + 0.4 * np.sin(0.2 * points[:, 0] + 0.1 * points[:, 2])


def main(folder):
    found = []

    def claim(file, points, cells, densities):
        values = moments(points, cells, densities)
        found.append({"file": file, "moments": values, "tetrahedra": len(cells)})

    tags, points, elements, cells = ball(5)
    at_corners = field(points)
    in_cells = field(points[cells].mean(axis=1))
    views = []
    for kind, numbers, values in (("NodeData", tags, at_corners), ("ElementData", elements, in_cells)):
        view = gmsh.view.add("density")
        gmsh.view.addHomogeneousModelData(view, 0, gmsh.model.getCurrent(), kind, numbers, values)
        views.append((kind, view))
    gmsh.option.setNumber("PostProcessing.SaveMesh", 0)
    for version, binary, (kind, view) in itertools.product((2.2, 4.1), (0, 1), views):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        file = f"gmsh{version}-{'binary' if binary else 'text'}-{kind}.msh"
        gmsh.write(str(folder / file))
        gmsh.view.write(view, str(folder / file), append=True)
        densities = at_corners[cells] if kind == "NodeData" else np.repeat(in_cells[:, None], 4, axis=1)
        claim(file, points, cells, densities)
    for binary in (0, 1):
        gmsh.option.setNumber("Mesh.Binary", binary)
        file = f"gmsh-{'binary' if binary else 'text'}.vtk"
        gmsh.write(str(folder / file))
        claim(file, points, cells, np.ones((len(cells), 4)))
    gmsh.finalize()

    for version, binary, on in itertools.product(("vtk42", "vtk51"), (False, True), ("corners", "cells")):
        data = {"point_data": {"density": at_corners}} if on == "corners" else {"cell_data": {"density": [in_cells]}}
        mesh = meshio.Mesh(points, [("tetra", cells)], **data)
        file = f"meshio-{version}-{'binary' if binary else 'text'}-{on}.vtk"
        meshio.write(folder / file, mesh, file_format=version, binary=binary)
        densities = at_corners[cells] if on == "corners" else np.repeat(in_cells[:, None], 4, axis=1)
        claim(file, points, cells, densities)

    if tetgen:
        corners = np.array(list(itertools.product((0.0, 30.0), (0.0, 20.0), (0.0, 10.0))))
        faces = np.array(
            [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
             [1, 5, 7], [1, 7, 3]])
        made = tetgen.TetGen(corners, faces)
        result = made.tetrahedralize(switches="pq1.4a20Q")
        points, cells = result[0], result[1]
        values = field(points)
        for first in (0, 1):
            nodes = [f"{len(points)} 3 1 0"]
            nodes += [f"{i + first} {x!r} {y!r} {z!r} {d!r}" for i, ((x, y, z), d) in
                      enumerate(zip(points.tolist(), values.tolist()))]
            lines = [f"{len(cells)} 4 0"]
            lines += [f"{i + first} {a} {b} {c} {d}" for i, (a, b, c, d) in enumerate((cells + first).tolist())]
            for end, text in (("node", nodes), ("ele", lines)):
                (folder / f"tetgen-{first}.{end}").write_text("\n".join(text) + "\n# Generated by TetGen\n")
            claim(f"tetgen-{first}.node", points, cells, values[cells])
    print(json.dumps(found))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
