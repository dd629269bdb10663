#!/usr/bin/env python3
"""Prints the volume of any mesh filled by its generalised winding number: where it is above one half is material.

usage: winding_volume.py MODEL [POINTS]
Barill et al., "Fast winding numbers for soups and clouds", ACM TOG 37, 2018, as libigl has it; the points are a scrambled
Sobol sequence in the bounding box, in eight runs, whose spread is the error. Needs numpy, scipy and libigl; shares no code
with the program that it judges. Volumes are in the cube of the file's unit.
"""
import sys

import igl
import numpy as np
from scipy.stats import qmc


def read(path):
    """Returns the corners of all triangles, polygons cut as fans."""
    if path.endswith(".obj"):
        vertices, faces = [], []
        for line in open(path, encoding="utf-8", errors="replace"):
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [c - 1 if c > 0 else len(vertices) + c for c in corners]
                faces += [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
        return np.array(vertices), np.array(faces)
    data = open(path, "rb").read()
    count = int(np.frombuffer(data, "<u4", 1, 80)[0])
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    corners = np.frombuffer(data, record, count, 84)["corners"].astype(float).reshape(-1, 3)
    return corners, np.arange(3 * count).reshape(-1, 3)


def main():
    path, points = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1 << 17
    vertices, faces = read(path)
    low, high = vertices[faces].min((0, 1)), vertices[faces].max((0, 1))
    shares = []
    for run in range(8):
        unit = qmc.Sobol(3, scramble=True, rng=run).random(points)
        at = low + unit * (high - low)
        winding = igl.fast_winding_number(vertices, faces.astype(np.int64), np.ascontiguousarray(at))
        shares.append((np.asarray(winding) > 0.5).mean())
    box = (high - low).prod()
    error = np.std(shares, ddof=1) / np.sqrt(len(shares)) * box
    print(f"{np.mean(shares) * box:.9g} ± {error:.2g}")


if __name__ == "__main__":
    main()
