#!/usr/bin/env python3
"""Weighs two stacks of images by itself: numpy and its own reader of PNG files, nothing of the program.

    python3 tests/judge/judge_dithered.py FOLDER

FOLDER holds layers.json, materials.json and a folder of images for each material. No pixel may have both materials. The
mass, the centre and the inertia tensor of both together must be those that materials.json says were reached, within
1e-9 of the mass, 1e-6 mm and 1e-7 of the trace of the tensor. Exit code 0: all agrees; 1: something does not; 2: nothing to judge.
"""

import json
import struct
import sys
import zlib
from pathlib import Path

import numpy as np


def read_png(path):
    """Returns the pixels of a black and white PNG file without filters, as booleans."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            columns, rows, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (1, 0), path
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    width = (columns + 7) // 8
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(rows, 1 + width)
    assert not lines[:, 0].any(), f"{path} has a filter"
    return np.unpackbits(lines[:, 1:], axis=1)[:, :columns].astype(bool)


def moments(image, plate, layer):
    """Returns mass, first and second moments of a layer of boxes, mm3 to mm5."""
    width, depth = plate["pixel_mm"]
    height = plate["layer_mm"]
    rows, columns = np.nonzero(image)
    x = plate["corner_mm"][0] + (columns + 0.5) * width
    y = plate["corner_mm"][1] - (rows + 0.5) * depth
    z = np.full(len(x), (layer + 0.5) * height)
    points = np.stack([x, y, z])
    second = points @ points.T + len(x) * np.diag([width**2, depth**2, height**2]) / 12
    voxel = width * depth * height
    return voxel * len(x), voxel * points.sum(axis=1), voxel * second


def main(folder):
    stacks = json.loads((folder / "layers.json").read_text())["plates"]
    claim = json.loads((folder / "materials.json").read_text())
    mass, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    if len(stacks) != 2 or stacks[0]["layers"] == 0:
        return 2
    volumes = [0.0, 0.0]
    for layer in range(stacks[0]["layers"]):
        images = [read_png(folder / it["folder"] / f"{layer:05}.png") for it in stacks]
        if (images[0] & images[1]).any():
            print(f"layer {layer} has pixels of both materials")
            return 1
        for which, (image, plate) in enumerate(zip(images, stacks)):
            density = claim["materials"][which]["density_g_cm3"] * 1e-3
            v, f, s = moments(image, plate, layer)
            volumes[which] += v
            mass, first, second = mass + density * v, first + density * f, second + density * s
    center = first / mass
    spread = second - mass * np.outer(center, center)
    inertia = np.trace(spread) * np.eye(3) - spread
    reached = claim["reached"]
    off = {
        "mass": abs(mass / reached["mass_g"] - 1),
        "center_mm": np.abs(center - reached["center_mm"]).max(),
        "inertia": np.abs(inertia - reached["inertia_g_mm2"]).max() / np.trace(inertia),
        "volumes": max(abs(v / it["volume_mm3"] - 1) for v, it in zip(volumes, claim["materials"])),
    }
    print(", ".join(f"{name} {value:.1e}" for name, value in off.items()))
    agrees = off["mass"] < 1e-9 and off["center_mm"] < 1e-6 and off["inertia"] < 1e-7 and off["volumes"] < 1e-9
    return 0 if agrees else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
