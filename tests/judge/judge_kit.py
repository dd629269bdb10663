#!/usr/bin/env python3
"""An independent judge of a kit: Python, numpy and trimesh, nothing of the program.

    python3 tests/judge/judge_kit.py KIT [KIT ...]

Reads the parts (STL or 3MF) and hollowed.stl, and from checklist.json only where each part belongs (print_from_model), the ballast
(shape, mass and place of each part), the rods of hardware, dowels and films of glue, the goal, the density, the wall, the build
volume, the volumes of pins and sockets, the drain holes, the cuts and the cleaning rule, and what was promised. Puts the parts together,
integrates them again, and prints promise against measurement. Exit code 0: all agree; 1: something does not; 2: no kit.
"""

import hashlib
import json
import math
import re
import struct
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import scipy.ndimage
import trimesh

GRAVITY_MM_S2 = 9806.65
AXIS_OFFSET_LIMIT_MM = 0.005
AXIS_TILT_LIMIT_DEG = 0.05
PIN_TOLERANCE_MM = 0.02
GAP_TOLERANCE_MM = 1e-3
WALL_TOLERANCE_MM = 0.01
VOLUME_SUM_LIMIT_RATIO = 1e-6
RESTING_LIMIT_MM = 1e-4
SUPPORT_BAND_RATIO = 0.002
# Two programs integrate the same f32 triangles in f64: they agree to about 1e-12; 1e-7 leaves room for the digits of
# the checklist and for sums over a million triangles that are not compensated here.
AGREEMENT_RATIO = 1e-7
# Critical speeds divide by a difference of moments, which costs up to two digits.
SPEED_AGREEMENT_RATIO = 1e-5
# The metacentric height by the waterplane's second moment, against the program's by righting arms at a small heel.
METACENTRE_AGREEMENT_RATIO = 1e-3
WATERLINE_TOLERANCE_MM = 0.02
# How far a top's contact may be from its lowest point.
CONTACT_LIMIT_MM = 0.05
# The contact of a leaning top rolls as long as it goes on by steps no longer than this share of the longest side, and is
# no further from the axis than on a ball with the longest side as its radius.
STEP_RATIO = 0.05
# How many directions a foot is leaned in.
LEAN_DIRECTIONS = 72
# Pins, sockets and engraved marks take this share off one of a joint's faces at most.
FILM_RATIO = 0.1
# Triangles this many times longer than most are cut into pieces before near ones are looked for.
LONG = 4
# Pairs of triangles held in memory at once.
PAIRS_AT_ONCE = 4_000_000
# More pairs than this are not looked at: minutes and gigabytes, and a surface made of slivers.
PAIRS_LIMIT = 40_000_000
# How many places along the axis of an opening between two cells are looked at.
OPENING_STEPS = 9
# How many places on the voids of cells are looked at from the other side of their walls.
CELL_SAMPLES = 2000
# How many points of a void's wall are looked at, from so many places across each mouth in two directions.
SIGHT_SAMPLES = 400
# Triangles that are tried first, as they were in the way last.
LAST_MET = 64
SIGHT_ACROSS = 20
SIGHT_ALONG = 64
# Hanging places smaller than a square of so many line widths a side are carried by what is beside them.
SUPPORT_LINES = 3
# A part may enclose this much resin against the film: a socket or a letter drains.
CUP_LIMIT_MM3 = 150.0
# The sides of every pin and socket, and how near a point of a part must be to where it should be, mm.
PEG_SIDES = 48
ON_SURFACE_MM = 2e-3
# Vertices at one place in two files: single precision at a few hundred millimetres.
SAME_PLACE_MM = 1e-4
# Triangles that are cut are looked at in points at most this far apart, mm.
SAMPLE_MM = 1.0
# Triangles around drain holes are cut into pieces at most this large, mm.
HOLE_RIM_MM = 0.1
# What is farther off than this is not measured.
FAR_OFF_MM = 0.1
# The strokes of a seven-segment character: left, right, bottom and top, in strokes; and which strokes a character has.
SEGMENTS = [(0, 4, 0, 1), (0, 4, 3.5, 4.5), (0, 4, 7, 8), (0, 1, 1.4, 3.1), (0, 1, 4.9, 6.6), (3, 4, 1.4, 3.1), (3, 4, 4.9, 6.6)]
CHARACTERS = {"0": "023456", "1": "56", "2": "01236", "3": "01256", "4": "1456", "5": "01245", "6": "012345", "7": "256", "8": "0123456", "9": "012456", "P": "12346"}
# The endings of files that somebody could print by mistake.
PRINTABLE = {".3mf", ".amf", ".bgcode", ".g", ".gco", ".gcode", ".obj", ".ply", ".stl", ".x3g"}
# How many points of the voids are measured to the outside.
WALL_SAMPLES = 50_000


class Table:
    """The lines of the verdict."""

    def __init__(self):
        self.failed = False

    def line(self, name, promised, measured, passes):
        self.failed |= not passes
        show = lambda x: f"{x:.9g}" if isinstance(x, float) else str(x)
        print(f"  {'ok  ' if passes else 'FAIL'} {name:<34} {show(promised):>18} {show(measured):>18}")

    def same(self, name, promised, measured, ratio=AGREEMENT_RATIO, scale=None):
        if promised is None or measured is None:
            self.line(name, promised, measured, promised is None and measured is None)
            return
        scale = abs(measured) if scale is None else scale
        self.line(name, float(promised), float(measured), abs(promised - measured) <= ratio * scale)

    def none(self, name, count):
        self.line(name, 0, "not looked at" if count is None else count, not count)

    def at_most(self, name, limit, measured):
        self.line(f"{name} ≤", float(limit), float(measured), bool(measured <= limit))

    def at_least(self, name, limit, measured):
        self.line(f"{name} ≥", float(limit), float(measured), bool(measured >= limit))


def read_stl(path):
    """The corners of a binary STL as an (n, 3, 3) array of f64: own reader, no repair, no merging."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    if len(data) != 84 + 50 * count:
        raise ValueError(f"{path} is not a whole binary STL")
    rows = np.frombuffer(data, dtype=np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), offset=84)
    return rows["v"].astype(np.float64)


def read_3mf(path):
    """The corners of the one object of a 3MF part as an (n, 3, 3) array: single precision, as slicers read it."""
    with zipfile.ZipFile(path) as package:
        root = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    if root.get("unit") != "millimeter":
        raise ValueError(f"{path} is in {root.get('unit')}")
    vertices = [[np.float32(v.get(axis)) for axis in "xyz"] for v in root.iter(core + "vertex")]
    triangles = [[int(t.get(corner)) for corner in ("v1", "v2", "v3")] for t in root.iter(core + "triangle")]
    return np.array(vertices, dtype=np.float64)[np.array(triangles)]


def read_part(path):
    return read_3mf(path) if path.suffix == ".3mf" else read_stl(path)


def welded(corners):
    """The triangles with one vertex for each place."""
    vertices, index = np.unique(corners.reshape(-1, 3) + 0.0, axis=0, return_inverse=True)
    return trimesh.Trimesh(vertices, index.reshape(-1, 3), process=False)


def moments(corners):
    """Volume, first and second moments in closed form, over tetrahedra to the box's middle."""
    middle = (corners.reshape(-1, 3).min(axis=0) + corners.reshape(-1, 3).max(axis=0)) / 2
    a, b, c = (corners[:, i] - middle for i in range(3))
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))
    total = a + b + c
    volume = math.fsum(sixfold) / 6
    first = np.array([math.fsum(column) for column in (sixfold[:, None] * total).T]) / 24
    squares = sum(np.einsum("n,ni,nj->nij", sixfold, v, v) for v in (a, b, c, total))
    second = np.array([[math.fsum(squares[:, i, j]) for j in range(3)] for i in range(3)]) / 120
    moved = second + np.outer(first, middle) + np.outer(middle, first) + volume * np.outer(middle, middle)
    return volume, first + volume * middle, moved


def mean_squares(shape):
    """The mean squares across and along the axis of a homogeneous ball, disc or bored hexagon, mm²."""
    if shape["kind"] == "ball":
        return shape["diameter_mm"] ** 2 / 20, shape["diameter_mm"] ** 2 / 20
    along = shape["thickness_mm"] ** 2 / 12
    if shape["kind"] == "disc":
        return shape["diameter_mm"] ** 2 / 16, along
    flats, bore = shape["across_flats_mm"], shape["bore_mm"]
    # A hexagon is six triangles with their apex in the middle: height flats/2, base flats/√3.
    height, base = flats / 2, flats / math.sqrt(3)
    hexagon = 6 * base * height / 2, 6 * (base * height**3 / 4 + height * base**3 / 48) / 2
    hole = math.pi * bore**2 / 4, math.pi * bore**4 / 64
    return (hexagon[1] - hole[1]) / (hexagon[0] - hole[0]), along


def loaded(body, ballast):
    """A body with parts of ballast in it: the tensors add about the common centre (Steiner)."""
    volume, mass, center, inertia = body
    pieces = [(mass, center, inertia)]
    for part in ballast:
        axis = np.array(part["axis"], float) / np.linalg.norm(part["axis"])
        across, along = mean_squares(part["shape"])
        tensor = part["mass_g"] * ((across + along) * np.eye(3) + (across - along) * np.outer(axis, axis))
        pieces.append((part["mass_g"], np.array(part["center_mm"], float), tensor))
    return volume, *together(pieces)


def ballast_room(part, material, voids):
    """The gap between a part of ballast and the material, mm; negative where it does not lie in a void."""
    center, shape = np.array(part["center_mm"], float), part["shape"]
    if shape["kind"] == "ball":
        points, reach = center[None], shape["diameter_mm"] / 2
    else:
        radius = shape["diameter_mm"] / 2 if shape["kind"] == "disc" else shape["across_flats_mm"] / math.sqrt(3)
        _, axes = frame({"axis": part["axis"], "origin_mm": [0, 0, 0]})
        angles = np.linspace(0, 2 * math.pi, 97)[:-1]
        rim = radius * (np.cos(angles)[:, None] * axes[0] + np.sin(angles)[:, None] * axes[1])
        points = np.concatenate([center + rim + h * axes[2] for h in (-shape["thickness_mm"] / 2, shape["thickness_mm"] / 2)])
        reach = 0.0
    gap = trimesh.proximity.closest_point(material, points)[1].min() - reach
    inside = any(welded(void[:, ::-1]).contains(points).all() for void in voids)
    return gap if inside else -abs(gap)


def filled(body, voids, density_g_mm3):
    """A body whose voids (turned inward) are full of another material."""
    volume, mass, center, inertia = body
    v, first, second = (-sum(part) for part in zip(*map(moments, voids)))
    middle = first / v
    central = (second - v * np.outer(middle, middle)) * density_g_mm3
    pieces = [(mass, center, inertia), (v * density_g_mm3, middle, np.trace(central) * np.eye(3) - central)]
    return volume, *together(pieces)


def together(pieces):
    """Mass, centre and inertia of pieces of known mass, centre and inertia (Steiner)."""
    total = math.fsum(m for m, _, _ in pieces)
    middle = sum(m * c for m, c, _ in pieces) / total
    moved = lambda m, d: m * (d @ d * np.eye(3) - np.outer(d, d))
    return total, middle, sum(t + moved(m, c - middle) for m, c, t in pieces)


def rod_moments(rod):
    """Volume, first and second moments of a round bar: a stack of discs, summed by Gauss and Legendre, 64 to a stretch."""
    start, end = np.array(rod["from_mm"], float), np.array(rod["to_mm"], float)
    length, radius = np.linalg.norm(end - start), rod["diameter_mm"] / 2
    axis = (end - start) / length
    across = np.eye(3) - np.outer(axis, axis)
    straight = length - radius if rod["round_end"] else length
    disc = lambda z: radius**2 - rod["hole_mm"] ** 2 / 4 if z <= straight else radius**2 - (z - straight) ** 2
    fourth = lambda z: radius**4 - rod["hole_mm"] ** 4 / 16 if z <= straight else (radius**2 - (z - straight) ** 2) ** 2
    volume, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    nodes, weights = np.polynomial.legendre.leggauss(64)
    for low, high in ((0.0, straight), (straight, length)):
        for z, weight in zip((low + high) / 2 + nodes * (high - low) / 2, weights * (high - low) / 2):
            area, middle = math.pi * disc(z) * weight, start + axis * z
            volume, first = volume + area, first + area * middle
            second += area * np.outer(middle, middle) + across * (math.pi / 4 * fourth(z) * weight)
    return volume, first, second


def body(parts, density_g_mm3, hardware=(), films=()):
    """Volume printed, mass, centre and inertia about the centre of parts (their corners in the model frame), rods and films of glue."""
    volume, mass, first, second = 0.0, 0.0, np.zeros(3), np.zeros((3, 3))
    for corners in parts:
        v, f, s = moments(corners)
        volume, mass = volume + v, mass + v * density_g_mm3
        first, second = first + f * density_g_mm3, second + s * density_g_mm3
    for rod in hardware:
        v, f, s = (m * rod["density_g_cm3"] / 1000 for m in rod_moments(rod))
        mass, first, second = mass + v, first + f, second + s
    for film in films:
        weight, middle = film["thickness_mm"] * film["density_g_cm3"] / 1000, np.array(film["center_mm"])
        grams = film["area_mm2"] * weight
        mass, first = mass + grams, first + grams * middle
        second = second + np.array(film["squares_mm4"]) * weight + grams * np.outer(middle, middle)
    center = first / mass
    central = second - mass * np.outer(center, center)
    return volume, mass, center, np.trace(central) * np.eye(3) - central


def lines_through(corners, points, direction):
    """For each point the heights along the unit direction at which its line meets the triangles."""
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    u = np.cross(direction, helper) / np.linalg.norm(np.cross(direction, helper))
    v = np.cross(direction, u)
    flat, height = corners @ np.stack([u, v], 1), corners @ direction
    turn = lambda p, q: p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    for point in points:
        a, b, c = (flat[:, i] - [point @ u, point @ v] for i in range(3))
        weights = np.stack([turn(b, c), turn(c, a), turn(a, b)], 1)
        area = weights.sum(axis=1)
        met = (area != 0) & (weights * np.sign(area)[:, None] >= 0).all(axis=1)
        yield np.sort((weights[met] * height[met]).sum(axis=1) / area[met]) - point @ direction


def judge_hardware(table, sheet, outer):
    """Whether every rod is clear of the material, and a yo-yo's halves are as far apart as they should be."""
    corners, goal = np.concatenate(outer), sheet["goal"]
    axis = np.array(goal["axis"], float) / np.linalg.norm(goal["axis"])
    for rod in sheet.get("hardware", []):
        table.same(f"{rod['id']} {rod['what']}, g", rod["mass_g"], rod_moments(rod)[0] * rod["density_g_cm3"] / 1000)
        start, end = np.array(rod["from_mm"], float), np.array(rod["to_mm"], float)
        length, along = np.linalg.norm(end - start), (end - start) / np.linalg.norm(end - start)
        helper = np.eye(3)[np.argmin(np.abs(along))]
        u = np.cross(along, helper) / np.linalg.norm(np.cross(along, helper))
        v = np.cross(along, u)
        # Lines on the rod's mantle, and just outside it where the printed socket still has room: between the rod's ends
        # no surface is met, and its middle is in the open.
        for radius, name in ((rod["diameter_mm"] / 2, "mantle"), (rod["hole_mm"] / 2 + 1e-3, "core")):
            around = [start + radius * (math.cos(t) * u + math.sin(t) * v) for t in np.arange(24) * math.pi / 12 + 0.05]
            met = list(lines_through(corners, np.array(around), along))
            inside = sum(int(((h > 1e-3) & (h < length - 1e-3)).any() or (h > length / 2).sum() % 2) for h in met)
            table.none(f"{rod['id']} lines of its {name} in material", inside)
    gap, axles = sheet.get("string_gap_mm"), [rod for rod in sheet.get("hardware", []) if rod["what"] == "axle"]
    if gap and axles:
        origin, axes = frame(goal)
        radius = axles[0]["socket_mm"] / 2 + 0.4 * sheet["wall"]["required_mm"]
        points = [origin + radius * (math.cos(t) * axes[0] + math.sin(t) * axes[1]) for t in np.arange(12) * math.pi / 6 + 0.1]
        gaps = [h[h > 0].min() - h[h < 0].max() for h in lines_through(corners, np.array(points), axis)]
        table.same("string gap at its narrowest, mm", gap, min(gaps), 1e-4)
        table.same("string gap at its widest, mm", gap, max(gaps), 1e-4)
        # Each half must surround the axle over at least its diameter: counted on levels 10 µm apart.
        z = (np.array([axles[0]["from_mm"], axles[0]["to_mm"]], float) - origin) @ axis
        met = [np.sort(h) for h in lines_through(corners, np.array(points), axis)]
        for half, ends in (("A", (0, z.max())), ("B", (z.min(), 0))):
            levels = np.arange(ends[0] + 0.005, ends[1], 0.01)
            walled = np.all([np.searchsorted(h, levels) % 2 == 1 for h in met], axis=0)
            grip = 0.01 * walled.sum()
            table.line(f"half {half} holds the axle over, mm", f">= {axles[0]['diameter_mm']:.3f}", f"{grip:.3f}", grip >= axles[0]["diameter_mm"] - 0.02)
        table.line("parts by halves", "A, B", ", ".join(sorted({str(p.get("half")) for p in sheet["parts"]})), {p.get("half") for p in sheet["parts"]} == {"A", "B"})


def judge_size(table, sheet, parts):
    """Whether the finished size is that of the parts put together with what stands out of them."""
    if "finished_size_mm" not in sheet:
        return
    points = [np.concatenate(part).reshape(-1, 3) for part in parts]
    for rod in sheet.get("hardware", []):
        start, end = np.array(rod["from_mm"], float), np.array(rod["to_mm"], float)
        along, radius = (end - start) / np.linalg.norm(end - start), rod["diameter_mm"] / 2
        flat = radius * np.sqrt(np.maximum(1 - along**2, 0))
        last = [end - along * radius - radius, end - along * radius + radius] if rod["round_end"] else [end - flat, end + flat]
        points.append(np.array([start - flat, start + flat, *last]))
    points = np.concatenate(points)
    for axis, promised, found in zip("xyz", sheet["finished_size_mm"], points.max(axis=0) - points.min(axis=0)):
        table.same(f"finished size along {axis}, mm", promised, found, 1e-4)


def frame(goal):
    """Origin and rotation (rows: x, y, z of the goal) with z along the axis."""
    z = np.array(goal["axis"], float)
    z /= np.linalg.norm(z)
    helper = np.eye(3)[np.argmin(np.abs(z))]
    x = helper - z * helper.dot(z)
    x /= np.linalg.norm(x)
    return np.array(goal["origin_mm"], float), np.array([x, np.cross(z, x), z])


def figures(goal, mass, center, inertia, outer):
    """What the goal asks of a body, from its mass properties alone."""
    origin, axes = frame(goal)
    local, tensor = axes @ (center - origin), axes @ inertia @ axes.T
    transverse, axial = np.linalg.eigvalsh(tensor[:2, :2])[-1], tensor[2, 2]
    found = {"principal_moments_g_mm2": np.linalg.eigvalsh(inertia)}
    if goal["kind"] == "stand":
        feet_z = (outer - origin) @ axes[2]
        ground, height = feet_z.min(), np.ptp(feet_z)
        feet = ((outer - origin) @ axes[:2].T)[feet_z <= ground + SUPPORT_BAND_RATIO * height]
        found["center_height_mm"] = local[2] - ground
        found["topples_deg"] = math.degrees(math.atan2(inside_distance(feet, local[:2]), local[2] - ground))
        return found
    if goal["kind"] == "float":
        return found | afloat(goal["water"], (outer - origin) @ axes.T, mass, local)
    if goal["kind"] == "balance":
        return found | unbalance(goal["rotor"], (outer - origin) @ axes[2], mass, local, tensor)
    _, directions = np.linalg.eigh(inertia)
    leaning = [math.atan2(np.linalg.norm(np.cross(d, axes[2])), abs(d @ axes[2])) for d in directions.T]
    found["axis_tilt_deg"] = math.degrees(min(leaning))
    found["axis_offset_mm"] = np.linalg.norm(local if goal["kind"] == "yoyo" else local[:2])
    found["dominance_ratio"] = transverse / axial
    found["spin_it_ratio"] = (tensor[:2, :2] ** 2).sum() / axial**2
    found["center_height_mm"] = local[2]
    if goal["kind"] == "top":
        omega2 = GRAVITY_MM_S2 * mass * max(local[2], 0.0) / (axial - transverse)
        found["critical_speed_rpm"] = math.sqrt(omega2) * 30 / math.pi if axial > transverse else None
    return found


def afloat(water, outer, mass, center):
    """How a body floats upright: its level by bisection, its metacentre by the waterplane's second moment."""
    from scipy.optimize import brentq
    triangles = outer.reshape(-1, 3, 3)
    mesh = trimesh.Trimesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3), process=False)
    low, high = outer[:, 2].min(), outer[:, 2].max()
    displaced = mass / (water["liquid_g_cm3"] / 1000)

    def wet(level):
        # With the origin in the level, the plane that closes the wet part adds nothing to volume and first moments.
        sliced = trimesh.intersections.slice_mesh_plane(mesh, [0, 0, -1], [0, 0, level])
        return sliced.triangles - [0, 0, level]

    def volume(corners):
        return math.fsum(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6

    margin = 1e-6 * (high - low)
    if volume(triangles) <= displaced:
        return {"waterline_mm": None, "metacentric_height_mm": None}
    level = brentq(lambda z: volume(wet(z)) - displaced, low + margin, high - margin, xtol=1e-10)
    a, b, c = (wet(level)[:, i] for i in range(3))
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))
    buoyancy = (sixfold[:, None] * (a + b + c)).sum(axis=0) / 24 / (sixfold.sum() / 6) + [0, 0, level]
    # ∬ f n_z over the wet surface is −∬ f over the waterplane, f any function of x and y.
    upward = np.cross(b - a, c - a)[:, 2] / 2
    middles = [(a + b)[:, :2] / 2, (b + c)[:, :2] / 2, (c + a)[:, :2] / 2]
    area = -upward.sum()
    first = -sum(upward @ m for m in middles) / 3
    second = -sum(np.einsum("n,ni,nj->ij", upward, m, m) for m in middles) / 3
    least = np.linalg.eigvalsh(second - np.outer(first, first) / area)[0]
    return {
        "waterline_mm": level - low,
        "trim_mm": np.linalg.norm((buoyancy - center)[:2]),
        "metacentric_height_mm": buoyancy[2] + least / displaced - center[2],
    }


def unbalance(rotor, along, mass, center, tensor):
    """The unbalance in the two planes at the ends, and the ISO 21940-11 grade that it is at the rotor's speed."""
    first = mass * center[:2]
    product = -tensor[:2, 2] + first * center[2]
    low, high = along.min(), along.max()
    planes = (first * high - product) / (high - low), (product - first * low) / (high - low)
    worst = max(np.linalg.norm(plane) for plane in planes)
    omega = rotor["speed_rpm"] * math.pi / 30
    return {"balance_grade_mm_s": 2 * worst / mass * omega, "reach_mm_s": (high - low) * omega}


def inside_distance(points, p):
    """How far p lies inside the convex hull of points; negative outside."""
    from scipy.spatial import ConvexHull

    hull = ConvexHull(points)
    return float(-(hull.equations[:, :2] @ p + hull.equations[:, 2]).max())


def split(mesh):
    """The outward and the inward shells of a welded mesh."""
    corners = mesh.triangles
    volumes = [(moments(corners[group])[0], group) for group in groups_of(mesh)]
    pick = lambda test: [corners[group] for volume, group in volumes if test(volume)]
    return pick(lambda v: v > 0), pick(lambda v: v <= 0)


def cells_of(low, high, size):
    """Every (cell, box) that a box touches in a grid of cubes."""
    low, high = (np.floor(corner / size).astype(np.int64) for corner in (low, high))
    counts = (high - low + 1).prod(axis=1)
    owner = np.repeat(np.arange(len(low)), counts)
    rank = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    x, y, _ = (high - low + 1)[owner].T
    cell = low[owner] + np.stack([rank % x, rank // x % y, rank // (x * y)], 1) - low.min(axis=0)
    span = cell.max(axis=0) + 1
    return (cell[:, 0] * span[1] + cell[:, 1]) * span[2] + cell[:, 2], owner


def cut_up(corners, size):
    """The triangles halved across their longest side until none is longer than size; and whose piece each is."""
    owner, pieces, owners = np.arange(len(corners)), [], []
    while len(corners):
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        is_long = lengths.max(axis=1) > size
        pieces.append(corners[~is_long])
        owners.append(owner[~is_long])
        start = lengths[is_long].argmax(axis=1)
        a, b, c = (corners[is_long, (start + k) % 3] for k in range(3))
        middle = (a + b) / 2
        corners = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        owner = np.tile(owner[is_long], 2)
    return np.concatenate(pieces), np.concatenate(owners)


def grid_pairs(corners, size):
    """Pairs of triangles that share a cell of the grid and overlap in their boxes, some at a time."""
    # Middles of sides are rounded, so boxes are a little wider than their pieces.
    low, high = corners.min(axis=1) - 1e-9, corners.max(axis=1) + 1e-9
    key, owner = cells_of(low, high, size)
    order = np.argsort(key, kind="stable")
    key, owner, held, found = key[order], owner[order], 0, []
    alike = np.arange(len(key) - 1)
    for step in range(1, len(key)):
        alike = alike[alike + step < len(key)]
        alike = alike[key[alike + step] == key[alike]]
        i, j = owner[alike], owner[alike + step]
        boxes = ((low[i] <= high[j]) & (low[j] <= high[i])).all(axis=1)
        found.append(np.stack([i[boxes], j[boxes]], 1))
        held += len(found[-1])
        if len(alike) == 0 or held > PAIRS_AT_ONCE:
            yield np.concatenate(found)
            held, found = 0, []
        if len(alike) == 0:
            return


def near_pairs(corners):
    """Pairs of triangles that come near each other, long triangles looked at piece by piece; None if too many."""
    typical = np.median(np.ptp(corners, axis=1).max(axis=1))
    pieces, owner = cut_up(corners, LONG * typical)
    keys, looked_at = np.empty(0, np.int64), 0
    for pairs in grid_pairs(pieces, 2 * typical):
        looked_at += len(pairs)
        if looked_at > PAIRS_LIMIT:
            return None
        pairs = np.sort(owner[pairs], axis=1)
        keys = np.unique(np.concatenate([keys, pairs[:, 0] * len(corners) + pairs[:, 1]]))
    pairs = np.stack([keys // len(corners), keys % len(corners)], 1)
    return pairs[pairs[:, 0] != pairs[:, 1]]


def sign_of(normal, offset):
    """The sign of normal · offset; zero where rounding decides."""
    value = np.einsum("ij,ij->i", normal, offset)
    noise = 1e-14 * np.linalg.norm(normal, axis=1) * np.linalg.norm(offset, axis=1)
    return np.where(np.abs(value) > noise, np.sign(value), 0)


def side(a, b, c, d):
    """The sign of the tetrahedron a, b, c, d; zero where rounding decides."""
    return sign_of(np.cross(b - a, c - a), a - d)


def piercing(corners, normals, first, second):
    """Where an edge of the first triangle passes strictly through the second."""
    plane, foot = normals[second], corners[second, 0]
    sides = [sign_of(plane, foot - corners[first, k]) for k in range(3)]
    found = np.zeros(len(first), bool)
    for k, m in ((0, 1), (1, 2), (2, 0)):
        at = np.flatnonzero(sides[k] * sides[m] < 0)
        p, q, target = corners[first[at], k], corners[first[at], m], corners[second[at]]
        turns = sum(side(p, q, target[:, i], target[:, (i + 1) % 3]) for i in range(3))
        found[at] |= np.abs(turns) == 3
    return found


def self_intersections(corners):
    """How many pairs of triangles have an edge of one strictly through the inside of the other; None if slivers make
    too many pairs to look at."""
    pairs = near_pairs(corners)
    if pairs is None:
        return None
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    count = 0
    for chunk in np.array_split(pairs, 1 + 4 * len(pairs) // PAIRS_AT_ONCE):
        first, second = chunk.T
        count += int((piercing(corners, normals, first, second) | piercing(corners, normals, second, first)).sum())
    return count


def smallest_wall(outer, voids):
    """The least distance from vertices, edge middles and face middles of the voids to the outer surface."""
    corners = np.concatenate(voids)
    points = np.concatenate([corners.reshape(-1, 3), corners.mean(axis=1), (corners + np.roll(corners, 1, 1)).reshape(-1, 3) / 2])
    points = np.unique(points, axis=0)
    if len(points) > WALL_SAMPLES:
        points = points[np.random.default_rng(1).choice(len(points), WALL_SAMPLES, replace=False)]
    surface = welded(np.concatenate(outer))
    distances = [trimesh.proximity.closest_point(surface, chunk)[1].min() for chunk in np.array_split(points, max(1, len(points) // 5000))]
    return float(min(distances))


def across_both(a, b):
    """The cross products of vectors, as numpy.cross gives them, which takes long for few rows."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]).T


def distances(corners, origin, direction):
    """How far a ray goes until it meets each triangle; infinite where it meets none. A plane and three sides each."""
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = across_both(direction, ac)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 1 / np.einsum("ij,ij->i", ab, across)
        u = np.einsum("ij,ij->i", origin - a, across) * scale
        turned = across_both(origin - a, ab)
        v, t = turned @ direction * scale, np.einsum("ij,ij->i", ac, turned) * scale
        return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)


def first_hits(corners, origins, directions):
    """How far each ray goes until it meets a triangle; infinite where it meets none."""
    return np.array([distances(corners, origin, direction).min(initial=np.inf) for origin, direction in zip(origins, directions)])


def felt(corners, peg, pin_length):
    """Distances of a pin's or socket's sides from its axis, and how far from the cut it ends, by rays in a part's file."""
    axis, center = np.array(peg["axis"]), np.array(peg["center_mm"])
    reach = 2 * (peg["diameter_mm"] + peg["length_mm"])
    near = (corners.min(axis=1) <= center + reach).all(axis=1) & (corners.max(axis=1) >= center - reach).all(axis=1)
    corners = corners[near]
    u = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    sides = [u * math.cos(a) + v * math.sin(a) for a in np.arange(60) * math.tau / 60 + 0.01]
    places = [center + axis * share * pin_length for share in (0.4, 0.6)]
    radii = first_hits(corners, [p for p in places for _ in sides], sides * len(places))
    middle = center + axis * pin_length / 2
    ends = pin_length / 2 + first_hits(corners, [middle + s * peg["diameter_mm"] / 7 for s in sides[::20]], [axis] * 3)
    return radii, ends


def judge_pins(table, sheet, parts):
    """Every pin stands in its part's file, and its socket in its mate's, with the gap of the joint between them."""
    sockets = {peg["id"]: (peg, corners) for part, corners in zip(sheet["parts"], parts) for peg in part["sockets"]}
    gaps = {joint["id"]: joint["clearance_mm"] for joint in sheet["joints"]}
    for part, corners in zip(sheet["parts"], parts):
        for pin in part["pins"]:
            socket, mate = sockets[pin["id"]]
            (radii, ends), (bores, depths) = felt(corners, pin, pin["length_mm"]), felt(mate, socket, pin["length_mm"])
            off = [radii.max() - pin["diameter_mm"] / 2, bores.min() - socket["diameter_mm"] / 2]
            off += list(ends - pin["length_mm"]) + list(depths - socket["length_mm"])
            table.at_most(f"{pin['id']} pin and socket off by, mm", PIN_TOLERANCE_MM, np.abs(off).max())
            table.at_least(f"{pin['id']} gap, mm", gaps[pin["joint"]] - GAP_TOLERANCE_MM, (bores - radii).min())


def seats_of(sheet, joint):
    """For each pin or dowel of a joint: its middle, its axis, and how far the parts move to each side of it, mm."""
    rows = lambda key: [peg for part in sheet["parts"] for peg in part[key] if peg["joint"] == joint]
    sockets = {peg["id"]: peg for peg in rows("sockets")}
    sizes = [(pin["id"], pin["diameter_mm"], 1) for pin in rows("pins")]
    sizes += [(rod["id"], rod["diameter_mm"], 2) for rod in sheet.get("dowels", [])]
    found = [(sockets[name], diameter, gaps) for name, diameter, gaps in sizes if name in sockets]
    return [(np.array(s["center_mm"]), np.array(s["axis"]), gaps * (s["diameter_mm"] - d) / 2) for s, d, gaps in found]


def worst_motion(pins, rooms, rim):
    """The largest turn of a plate held by round pins, radians, and the farthest that a corner of its rim moves, mm: turn by
    turn the shifts are the common part of discs, whose corners and whose farthest points from each corner are tried."""
    if not len(rim):
        return 0.0, math.inf
    middle, quarter = pins.mean(axis=0), np.array([[0.0, -1.0], [1.0, 0.0]])
    pins, rim = pins - middle, rim - middle
    pairs = [(i, j) for i in range(len(pins)) for j in range(i)]
    most = min((rooms[i] + rooms[j]) / np.linalg.norm(pins[i] - pins[j]) for i, j in pairs)
    largest, step = 0.0, 0.0
    for turn in np.linspace(-most, most, 801):
        centers, moved = -turn * pins @ quarter.T, turn * rim @ quarter.T
        shifts = []
        for i, j in pairs:
            along = centers[j] - centers[i]
            apart = np.linalg.norm(along)
            if 0 < apart <= (rooms[i] + rooms[j]) * (1 + 1e-12):
                share = (apart**2 + rooms[i] ** 2 - rooms[j] ** 2) / (2 * apart)
                aside = math.sqrt(max(rooms[i] ** 2 - share**2, 0.0)) * quarter @ along / apart
                shifts += [centers[i] + along * share / apart + side * aside for side in (-1, 1)]
        for center, room in zip(centers, rooms):
            away = center + moved
            length = np.linalg.norm(away, axis=1)
            shifts += list((center + room * away / np.where(length > 0, length, 1)[:, None])[length > 0])
        if not shifts:
            continue
        shifts = np.array(shifts)
        inside = (np.linalg.norm(shifts[:, None] - centers[None], axis=2) <= rooms[None] + 1e-9).all(axis=1)
        if inside.any():
            largest = max(largest, abs(turn))
            step = max(step, np.linalg.norm(shifts[inside][:, None] + moved[None], axis=2).max())
    return largest, step


def shared_rim(parts, point, axes):
    """The corners of the faces in which two parts touch, in the coordinates of their plane."""
    from shapely import Polygon, unary_union

    regions = []
    for corners in parts:
        local = (corners - point) @ axes.T
        flat = local[(np.abs(local[:, :, 2]) <= 1e-3).all(axis=1)][:, :, :2]
        regions.append(unary_union([Polygon(t).buffer(1e-6) for t in flat]))
    shared = regions[0].intersection(regions[1]).buffer(-1e-4)
    return np.array(shared.convex_hull.exterior.coords) if not shared.is_empty else np.zeros((0, 2))


def stops_in(jig, surface, outer, side, count):
    """The stops of the outside on one side of a joint: points of so many sections through the rib, and the jig nearest to each."""
    normal, out = np.array(jig["normal"], float), np.array(jig["out"], float)
    axes, near, far = np.stack([np.cross(normal, out), out]), *jig["ribs_mm"]
    stops = []
    # Just within the ribs: an edge of a rib would count with the face of its end.
    for height in np.linspace(near + 1e-3, far - 1e-3, count):
        section = outer.section(plane_origin=np.array(jig["point_mm"]) + side * height * normal, plane_normal=normal)
        for line in [] if section is None else section.discrete:
            pieces = np.maximum(np.ceil(np.linalg.norm(np.diff(line, axis=0), axis=1) / 0.15), 1).astype(int)
            points = np.concatenate([a + (b - a) * np.arange(n)[:, None] / n for a, b, n in zip(line, line[1:], pieces)])
            nearest, distance, face = trimesh.proximity.closest_point(surface, points)
            flat = (nearest - points) @ axes.T
            room = np.linalg.norm(flat, axis=1)
            # Beside a corner of the jig there is room to pass it.
            ahead = np.abs(((nearest - points) * surface.face_normals[face]).sum(axis=1))
            held = (distance < 1) & (room > 0.9 * distance) & (room > 0) & (ahead >= 0.99 * distance)
            stops += list(np.column_stack([points @ axes.T, flat / np.where(room > 0, room, 1)[:, None], room])[held])
    return np.array(stops)


def pressed(stops, press, depth):
    """The motions (two shifts and a turn) of what is pressed down at a point until it is within a depth of the end, as rows of
    inequalities: found by a linear program."""
    from scipy.optimize import linprog

    at, normal, room = stops[:, :2] - press, stops[:, 2:4], stops[:, 4]
    rows = np.column_stack([normal, normal[:, 1] * at[:, 0] - normal[:, 0] * at[:, 1]])
    down = linprog([0, 1, 0], A_ub=rows, b_ub=room, bounds=[(-20, 20), (-20, 20), (-0.2, 0.2)])
    return np.vstack([rows, [0, 1, 0]]), np.append(room, down.x[1] + depth)


def step_in_jig(jig, surface, outer, rim, count):
    """The farthest that the rims of two parts move apart, pressed into a jig: linear programs in 24 directions at every corner."""
    from scipy.optimize import linprog
    from scipy.spatial import ConvexHull

    axes = np.stack([np.cross(jig["normal"], jig["out"]), np.array(jig["out"], float)])
    flat = rim @ axes.T
    flat = flat[ConvexHull(flat).vertices]
    press = np.array([(flat[:, 0].min() + flat[:, 0].max()) / 2, flat[:, 1].max()])
    stops = [stops_in(jig, surface, outer, side, count) for side in (-1, 1)]
    if min(map(len, stops)) < 3:
        return math.inf
    motions, step = [pressed(stop, press, jig["pressed_mm"]) for stop in stops], 0.0
    for x, y in (flat - press)[:: max(1, len(flat) // 24)]:
        for turn in np.arange(24) * math.tau / 24:
            way = np.array([math.cos(turn), math.sin(turn), math.sin(turn) * x - math.cos(turn) * y])
            ends = [linprog(-sign * way, A_ub=a, b_ub=b, bounds=[(-20, 20), (-20, 20), (-0.2, 0.2)]).fun for sign, (a, b) in zip((1, -1), motions)]
            step = max(step, -sum(ends))
    return step


def judge_jigs(table, sheet, kit, parts, outer):
    """Whether every jig is sound, lies and fits on the plate, comes off, keeps its gap, leaves the seam free and holds the parts."""
    printer, limit = sheet["printer"], sheet["printer"].get("seam_step_mm")
    by_id = {part["id"]: corners for part, corners in zip(sheet["parts"], parts)}
    for jig in sheet.get("jigs", []):
        printed = read_part(kit / jig["file"]) / (printer.get("print_scale_ratio") or [1, 1, 1])
        mesh, pose = welded(printed), np.array(jig["print_from_model"], float)
        sound = bool(mesh.is_watertight and mesh.is_winding_consistent and moments(printed)[0] > 0)
        table.line(f"{jig['id']} watertight, outward", True, sound, sound)
        table.at_most(f"{jig['id']} height of lowest point, mm", RESTING_LIMIT_MM, abs(mesh.bounds[0][2]))
        if printer.get("build_volume_mm"):
            table.at_least(f"{jig['id']} room left, mm", 0.0, (np.array(printer["build_volume_mm"]) - np.ptp(mesh.bounds, axis=0)).min())
        corners = (printed - pose[:3, 3]) @ pose[:3, :3]
        surface, out = welded(corners), np.array(jig["out"], float)
        joint = next(joint for joint in sheet["joints"] if joint["id"] == jig["joint"])
        _, axes = frame({"axis": jig["normal"], "origin_mm": [0, 0, 0]})
        origin = np.array(jig["point_mm"])
        rim = origin + shared_rim([by_id[part] for part in joint["parts"]], origin, axes) @ axes[:2]
        # The other half of a yo-yo is not there while the glue sets.
        bodies = [welded(body) for body in outer]
        outside = min(bodies, key=lambda body: trimesh.proximity.closest_point(body, rim)[1].min())
        points = np.concatenate([surface.vertices, surface.triangles_center])
        table.at_least(f"{jig['id']} gap, mm", jig["gap_mm"] - GAP_TOLERANCE_MM, trimesh.proximity.closest_point(outside, points)[1].min())
        few = points[:: max(1, len(points) // 400)]
        caught = sum(int((heights < 0).any()) for heights in lines_through(outside.triangles, few, out))
        table.none(f"{jig['id']} points caught on its way off", caught)
        table.at_least(f"{jig['id']} room along the seam, mm", 3.0, trimesh.proximity.closest_point(surface, rim)[1].min())
        # A few sections see most stops. A narrow ridge takes more: on one trunk 9 give 0.28 mm, 33 give 0.27 and 81 give 0.21;
        # on another 9 give 0.52 mm, 81 give 0.31 and 121 give 0.28. What they miss makes the step too large, never too small.
        for count in (9, 81, 121):
            step = step_in_jig(jig, surface, outside, rim, count)
            agrees = abs(step - joint["play"]["step_mm"]) <= 0.05
            if agrees and (limit is None or step <= limit):
                break
        table.line(f"{jig['joint']} step in its jig, mm", joint["play"]["step_mm"], step, agrees)
        if limit is not None:
            table.at_most(f"{jig['joint']} step in its jig, mm", limit, step)


def judge_play(table, sheet, parts):
    """Whether the pins of every joint that they hold are thick enough, and leave the play and the step at the rim as stated."""
    limit, least = sheet["printer"].get("seam_step_mm"), sheet["printer"].get("least_pin_mm", 0.0)
    by_id = {part["id"]: corners for part, corners in zip(sheet["parts"], parts)}
    for pin in (pin for part in sheet["parts"] for pin in part["pins"]):
        table.at_least(f"{pin['id']} diameter, mm", least - 1e-9, pin["diameter_mm"])
    for joint in sheet["joints"]:
        seats = seats_of(sheet, joint["id"])
        if joint.get("held_by") != "pins" or len(seats) < 2:
            table.line(f"{joint['id']} aligned", "by something", joint.get("held_by"), joint.get("held_by") in (None, "eye", "jig"))
            continue
        _, axes = frame({"axis": seats[0][1], "origin_mm": [0, 0, 0]})
        rim = shared_rim([by_id[part] for part in joint["parts"]], seats[0][0], axes)
        pins = np.array([(middle - seats[0][0]) @ axes[:2].T for middle, _, _ in seats])
        turn, step = worst_motion(pins, np.array([room for _, _, room in seats]), rim)
        # The program stands a polygon of 48 sides around each circle, 0.2 % outside.
        table.same(f"{joint['id']} turn, °", joint["play"]["turn_deg"], math.degrees(turn), 5e-3)
        table.same(f"{joint['id']} step at the rim, mm", joint["play"]["step_mm"], step, 5e-3)
        widest = lambda points: max((np.linalg.norm(a - b) for a in points for b in points), default=0.0)
        table.at_least(f"{joint['id']} pins apart, of its width", 0.333, widest(pins) / widest(rim))
        if limit is not None:
            table.at_most(f"{joint['id']} step at the rim, mm", limit, step)


def connected(sheet, start, left_out):
    """The parts that joints connect with a part, without the joints between two parts that are left out."""
    reached, fresh = {start}, [start]
    pairs = [set(joint["parts"]) for joint in sheet["joints"]]
    while fresh:
        part = fresh.pop()
        fresh_here = {other for pair in pairs if part in pair and pair != left_out for other in pair} - reached
        reached |= fresh_here
        fresh += fresh_here
    return reached


def judge_slack(table, sheet, parts, outer, density):
    """Whether the play of a rotor's joints can leave the unbalance that is stated: the lighter side shifts, all around in the joint."""
    stated = [joint for joint in sheet["joints"] if joint.get("unbalance_g_mm") is not None]
    if not stated:
        return
    origin, axes = frame(sheet["goal"])
    by_id = {part["id"]: corners for part, corners in zip(sheet["parts"], parts)}
    along = (outer - origin) @ axes[2]
    low, high = along.min(), along.max()
    for joint in stated:
        sides = [connected(sheet, part, set(joint["parts"])) for part in joint["parts"]]
        weights = [moments(np.concatenate([by_id[part] for part in sorted(side)])) for side in sides]
        volume, first, _ = min(weights, key=lambda weight: weight[0])
        mass, center = volume * density, axes @ (first / volume - origin)
        seats, jig = seats_of(sheet, joint["id"]), next((jig for jig in sheet.get("jigs", []) if jig["joint"] == joint["id"]), None)
        _, (u, v, _) = frame({"axis": seats[0][1] if seats else jig["normal"], "origin_mm": [0, 0, 0]})
        worst = 0.0
        for angle in np.arange(0.0, 2 * math.pi, math.pi / 90):
            shift = axes @ (u * math.cos(angle) + v * math.sin(angle)) * joint["play"]["shift_mm"]
            # What the shift adds to Σ m (x, y) and to Σ m z (x, y); without it the rotor is balanced.
            added = mass * shift[:2]
            product = mass * (shift[:2] * center[2] + shift[2] * center[:2] + shift[2] * shift[:2])
            planes = (added * high - product) / (high - low), (product - added * low) / (high - low)
            worst = max(worst, *(np.linalg.norm(plane) for plane in planes))
        # What is left without a shift adds to it or takes from it. The program tries 32 directions, this 180.
        left = sheet["assembly"]["unbalance"]["end_plane_g_mm"]
        table.at_most(f"{joint['id']} unbalance by a shift, off by g·mm", left + 5e-3 * worst, abs(joint["unbalance_g_mm"] - worst))


def rings_of(mesh, heights, flat):
    """The closed lines in which a plane meets a welded mesh, a corner on the plane counting as above it."""
    edge_after, above = {}, heights >= 0
    for triangle in mesh.faces[above[mesh.faces].any(axis=1) & ~above[mesh.faces].all(axis=1)]:
        edges = [(triangle[i], triangle[(i + 1) % 3]) for i in range(3)]
        down = next(e for e in edges if above[e[0]] and not above[e[1]])
        up = next(e for e in edges if not above[e[0]] and above[e[1]])
        edge_after[tuple(sorted(down))] = tuple(sorted(up))
    rings = []
    while edge_after:
        start, edge = edge_after.popitem()
        ring = [start]
        while edge != start and edge in edge_after:
            ring.append(edge)
            edge = edge_after.pop(edge)
        at = lambda p, q: flat[p] + (flat[q] - flat[p]) * (heights[p] / (heights[p] - heights[q]))
        rings.append([at(p, q) for p, q in ring])
    return [ring for ring in rings if len(ring) > 2]


def mouths_of(cavity, plane, tool):
    """For each mouth that a cut leaves in a void: its widest disc, and the places where a disc of the tool's diameter finds
    room, the widest first."""
    from shapely import MultiPolygon, Point, Polygon
    from shapely.ops import polylabel

    origin, axes = frame({"axis": plane["normal"], "origin_mm": plane["point_mm"]})
    local = (cavity.vertices - origin) @ axes.T
    region = MultiPolygon()
    for ring in rings_of(cavity, local[:, 2], local[:, :2]):
        region = region.symmetric_difference(Polygon(ring).buffer(0))
    mouths = []
    for mouth in getattr(region, "geoms", [region]):
        if mouth.geom_type != "Polygon" or mouth.area < 1e-4:
            continue
        middle = polylabel(mouth, 0.01)
        room = mouth.boundary.distance(middle)
        low_x, low_y, high_x, high_y = mouth.bounds
        roomy = mouth.buffer(-tool / 2)
        steps = (np.arange(SIGHT_ACROSS) + 0.5) / SIGHT_ACROSS
        grid = [Point(low_x + (high_x - low_x) * i, low_y + (high_y - low_y) * j) for i in steps for j in steps]
        at = [middle] + [p for p in grid if room >= tool / 2 and roomy.contains(p)]
        # In a narrow arm of a mouth few places of the grid have room: what is seen from there is seen along the rim of the room.
        for rim in [line for piece in getattr(roomy, "geoms", [roomy]) for line in [piece.exterior, *piece.interiors]]:
            if room >= tool / 2 and rim.length > 0:
                at += [rim.interpolate(i / SIGHT_ALONG, normalized=True) for i in range(SIGHT_ALONG)]
        mouths.append((2 * room, origin + np.array([[p.x, p.y] for p in at]) @ axes[:2]))
    return mouths


def in_the_way(surface, start, end):
    """Whether any triangle of a surface (its corners, its triangles' boxes by axes, and those met last) stands between two
    points."""
    corners, low, high, met = surface
    length = np.linalg.norm(end - start)
    direction = (end - start) / length
    # What was in the way of one place is in the way of its neighbours.
    if met and (distances(corners[met], start, direction) < length).any():
        return True
    is_near = np.ones(len(corners), bool)
    for axis in range(3):
        is_near &= (low[axis] <= max(start[axis], end[axis])) & (high[axis] >= min(start[axis], end[axis]))
    near = np.flatnonzero(is_near)
    found = near[distances(corners[near], start, direction) < length]
    met[:] = [*found[:4].tolist(), *met][:LAST_MET]
    return len(found) > 0


def sight(cavity, cuts, parts, printer, rotations):
    """The shares of a void's wall that are in sight of the mouths in the cuts about them and within reach: of those that let
    the tool in, of all; and of all or printed without support. Of a random sample, with the parts' own triangles in the way.
    A mouth too narrow for the tool counts where a piece of the void has no wider one, which lies between the first two."""
    rule, tool = printer["cleaning"], printer["minimum_opening_mm"]
    planes = [(np.array(c["point_mm"], float), np.array(c["normal"], float) / np.linalg.norm(c["normal"])) for c in cuts]
    mouths = [mouths_of(cavity, cut, tool) for cut in cuts]
    points, faces = trimesh.sample.sample_surface(cavity, SIGHT_SAMPLES, seed=7)
    box = cavity.bounds + np.array([[-1.0], [1.0]])
    near = [c[(c.min(axis=1) <= box[1]).all(axis=1) & (c.max(axis=1) >= box[0]).all(axis=1)] for c in parts]
    all_near, owners = np.concatenate(near), np.concatenate([np.full(len(c), i) for i, c in enumerate(near)])
    surfaces = [(c, c.min(axis=1).T.copy(), c.max(axis=1).T.copy(), []) for c in near]
    owner_of = owners[trimesh.proximity.closest_point(welded_soup(all_near), points)[2]]
    heights = np.array([[(p - o) @ n for o, n in planes] for p in points]).reshape(len(points), len(planes))
    index_of = {c["id"]: k for k, c in enumerate(cuts)}
    # The sides of earlier cuts to which each cut is limited.
    limits = [[(index_of[w["cut"]], 1 if w["side"] == "above" else -1) for w in c.get("within", [])] for c in cuts]
    made_at = lambda place, k: all(((place - planes[j][0]) @ planes[j][1]) * sign >= -1e-6 for j, sign in limits[k])
    mouths = [[(width, np.array([e for e in at if made_at(e, k)]).reshape(-1, 3)) for width, at in of] for k, of in enumerate(mouths)]
    seen = narrowly = needless = 0
    for index, point in enumerate(points):
        eyes = []
        for k, cut_mouths in enumerate(mouths):
            for width, at in cut_mouths:
                # On the point's side of every other cut: else it would look through a piece that is not its own.
                other = [j for j in range(len(planes)) if j != k and made_at(point, j)]
                beside = np.array([[(e - planes[j][0]) @ planes[j][1] for j in other] for e in at]).reshape(len(at), len(other))
                own = (beside * heights[index, other] >= -1e-6).all(axis=1) if other else np.ones(len(at), bool)
                eyes += [(width < tool, np.linalg.norm(e - point), e) for e in at[own]]
        eyes.sort(key=lambda eye: eye[:2])
        surface = surfaces[owner_of[index]]
        reach = rule.get("reach_mm", math.inf)
        sees = lambda e, far: far <= reach and not in_the_way(surface, e, e + (point - e) * 0.998)
        narrow = next((is_narrow for is_narrow, far, e in eyes if sees(e, far)), None)
        visible = narrow is not None
        # The cavity's own normals look into it, as the material's do.
        upright = rotations[owner_of[index]] @ cavity.face_normals[faces[index]]
        lean = rule.get("overhang_deg")
        free = lean is not None and -upright[2] <= math.cos(math.radians(lean))
        seen, narrowly, needless = seen + visible, narrowly + bool(narrow), needless + (free and not visible)
    return (seen - narrowly) / len(points), seen / len(points), (seen + needless) / len(points)


def welded_soup(corners):
    return trimesh.Trimesh(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), process=False)


def judge_voids(table, sheet, voids, parts):
    """Every void is open as the sheet says, and as much of it in sight as the sheet says and the rule asks."""
    printer, rule = sheet["printer"], sheet["printer"].get("cleaning")
    if rule is None:
        return
    rotations = [np.array(part["print_from_model"], float)[:3, :3] for part in sheet["parts"]]
    table.line("voids on the sheet", len(sheet["voids"]), len(voids), len(sheet["voids"]) == len(voids))
    for row, corners in zip(sheet["voids"], voids):
        if row.get("drained_by"):
            continue
        cavity = welded(corners)
        widest = max([width for cut in sheet["cuts"] for width, _ in mouths_of(cavity, cut, 0.0)], default=0.0)
        # The stated opening is that of the piece where it is least: no mouth need be wider than the widest.
        table.at_most(f"{row['id']} stated opening, widest found", widest * 1.01, row["opening_mm"])
        table.at_least(f"{row['id']} widest opening, mm", min(row["least_opening_mm"], rule.get("pair_opening_mm", math.inf)) * 0.995, widest)
        if rule["sight_ratio"] == 0:
            continue
        wide_only, in_sight, clean = sight(cavity, sheet["cuts"], parts, printer, rotations)
        # Four standard deviations of this sample and that of the program, and a hundredth for eyes at other places.
        spread = lambda p: 0.01 + 4 * math.sqrt(max(p * (1 - p), 0.002) * (1 / SIGHT_SAMPLES + 1 / 2000))
        off = max(wide_only - row["sight_ratio"], row["sight_ratio"] - in_sight)
        table.line(f"{row['id']} in sight, as stated", row["sight_ratio"], in_sight, off <= spread(in_sight))
        asked = rule["sight_ratio"]
        counted = clean if rule["rule"] == "in-sight-or-self-supporting" else in_sight
        table.at_least(f"{row['id']} clean", asked - spread(asked), counted)
def judge_dowels(table, sheet, parts):
    """Every dowel has a socket in two parts' files, as deep as it is half long and more, with the gap of the joint around it."""
    gaps = {joint["id"]: joint["clearance_mm"] for joint in sheet["joints"]}
    for dowel in sheet.get("dowels", []):
        ends = [(peg, corners) for part, corners in zip(sheet["parts"], parts) for peg in part["sockets"] if peg["id"] == dowel["id"]]
        table.line(f"{dowel['id']} sockets of the dowel", 2, len(ends), len(ends) == 2)
        table.same(f"{dowel['id']} {dowel['what']}, g", dowel["mass_g"], rod_moments(dowel)[0] * dowel["density_g_cm3"] / 1000)
        for socket, corners in ends:
            bores, depths = felt(corners, socket, dowel["depth_mm"])
            off = [bores.min() - socket["diameter_mm"] / 2] + list(depths - socket["length_mm"])
            table.at_most(f"{dowel['id']} socket off by, mm", PIN_TOLERANCE_MM, np.abs(off).max())
            table.at_least(f"{dowel['id']} gap, mm", gaps[socket["joint"]] - GAP_TOLERANCE_MM, bores.min() - dowel["diameter_mm"] / 2)
            table.at_least(f"{dowel['id']} room at its end, mm", 0.0, depths.min() - dowel["depth_mm"])


def judge_films(table, sheet, parts):
    """Every film of glue covers the faces that lie in its plane in the files: as much of them, with the same middle."""
    glued = [joint for joint in sheet["joints"] if "glue" in joint]
    for joint in glued:
        film, cut = joint["glue"], next(cut for cut in sheet["cuts"] if cut["id"] == joint["cut"])
        normal, foot = np.array(cut["normal"]), np.array(cut["point_mm"])
        faces = np.concatenate([corners[(np.abs((corners - foot) @ normal) < 1e-3).all(axis=1)] for corners in parts])
        areas = np.linalg.norm(np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]), axis=1) / 2
        alike = [other["glue"] for other in glued if other["cut"] == joint["cut"]]
        promised = sum(other["area_mm2"] for other in alike)
        middle = sum(other["area_mm2"] * np.array(other["center_mm"]) for other in alike) / promised
        found = (faces.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()
        table.same(f"{joint['id']} film of glue, mm²", promised, areas.sum() / 2, FILM_RATIO)
        table.at_most(f"{joint['id']} middle of the film, off by mm", FILM_RATIO * math.sqrt(promised), np.linalg.norm(middle - found))
        table.at_most(f"{joint['id']} film off its cut, mm", 1e-6, abs((np.array(film["center_mm"]) - foot) @ normal))
        table.same(f"{joint['id']} glue, g", film["mass_g"], film["area_mm2"] * film["thickness_mm"] * film["density_g_cm3"] / 1000)


def judge_marks(table, sheet, parts):
    """Every stroke of an engraved id is a groove in its part's file, as deep as promised: felt from outside, along it."""
    for part, corners in zip(sheet["parts"], parts):
        for mark in part.get("marks", []):
            axis, strokes = np.array(mark["axis"]), np.array(mark["strokes_mm"])
            depths = first_hits(corners, strokes - axis * 1e-3, [axis] * len(strokes)) - 1e-3
            table.at_most(f"{part['id']} '{mark['text']}' in {mark['cut']}, depth off by, mm", 1e-3, np.abs(depths - mark["depth_mm"]).max())


def judge_support(table, sheet, parts, whole):
    """What hangs in the air outside and in hollows is as the sheet says: triangles that look down too steeply and lie on the uncut body."""
    printer = sheet["printer"]
    lean = (printer.get("cleaning") or {}).get("overhang_deg")
    least = (SUPPORT_LINES * printer["pixel_mm"][0]) ** 2
    for row, corners in zip(sheet["parts"], parts):
        if "support" not in row or lean is None:
            continue
        pose, stated = np.array(row["print_from_model"], float), row["support"]
        printed = corners @ pose[:3, :3].T + pose[:3, 3]
        normal = np.cross(printed[:, 1] - printed[:, 0], printed[:, 2] - printed[:, 0])
        height = printed[:, :, 2] - printed[:, :, 2].min()
        steep = -normal[:, 2] > math.cos(math.radians(lean)) * np.linalg.norm(normal, axis=1)
        hung = np.flatnonzero(steep & ~(height < printer["layer_mm"]).all(axis=1))
        if len(hung):
            _, distance, _ = trimesh.proximity.closest_point(whole, corners[hung].mean(axis=1))
            hung = hung[distance <= 0.01]
        area = -normal[hung, 2] / 2
        mesh = welded(corners)
        faces = mesh.faces[hung]
        edges = faces[:, [[0, 1], [1, 2]]].reshape(-1, 2)
        place = trimesh.graph.connected_component_labels(edges, node_count=len(mesh.vertices))[faces[:, 0]] if len(hung) else hung
        of_place = np.bincount(place, weights=area)[place] if len(hung) else area
        # Small places are left out; one that is outside and in a hollow counts as two, so twice the least is sure to count.
        sure = of_place >= 2 * least
        told = stated["outside_mm2"] + stated["hollow_mm2"]
        table.at_most(f"{row['id']} hangs, told too much by, mm²", 1e-3 + 1e-6 * area.sum(), told - area.sum())
        table.at_most(f"{row['id']} hangs, told too little by, mm²", 1e-3 + area[~sure].sum() + least * len(set(place[sure])), area.sum() - told)
        if sure.any():
            table.at_least(f"{row['id']} hangs from, mm", stated["from_mm"] - 1e-6, height[hung][sure].min())
            table.at_most(f"{row['id']} hangs to, mm", stated["to_mm"] + 1e-6, height[hung][sure].max())


def cup_volume(corners, cell):
    """The resin that a part in print pose encloses against the film, mm³: the empty cells that have no way to the rim of the grid
    through their own layer and the layers before, when their layer is printed."""
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    columns, rows, layers = (int(n) for n in np.ceil((high - low) / cell)[:3] + [3, 3, 0])
    top, bottom = corners[:, :, 2].max(axis=1), corners[:, :, 2].min(axis=1)
    parent = [0]

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    before, enclosed = np.zeros((rows, columns), dtype=int), 0
    for layer in range(layers):
        z = low[2] + (layer + 0.5) * cell + 1e-5
        cut = corners[(bottom < z) & (top >= z)]
        walls = np.zeros((rows, columns + 1), dtype=int)
        ends = []
        for i, j in ((0, 1), (1, 2), (2, 0)):
            p, q = cut[:, i], cut[:, j]
            crosses = (p[:, 2] < z) != (q[:, 2] < z)
            # The same end first for both triangles of an edge.
            swap = p[:, 2] > q[:, 2]
            p, q = np.where(swap[:, None], q, p), np.where(swap[:, None], p, q)
            with np.errstate(divide="ignore", invalid="ignore"):
                at = p[:, :2] + (q[:, :2] - p[:, :2]) * ((z - p[:, 2]) / (q[:, 2] - p[:, 2]))[:, None]
            ends.append(np.where(crosses[:, None], at, np.nan))
        for three in np.stack(ends, axis=1) if len(cut) else []:
            pair = three[~np.isnan(three[:, 0])]
            if len(pair) != 2:
                continue
            (ax, ay), (bx, by) = sorted((pair - low[:2]) / cell + 1.37, key=lambda end: (end[1], end[0]))
            for row in range(math.ceil(ay), min(rows, math.ceil(by))):
                x = ax + (bx - ax) * (row - ay) / (by - ay)
                walls[row, min(columns, max(0, math.ceil(x)))] += 1
        empty = np.cumsum(walls, axis=1)[:, :columns] % 2 == 0
        labels, count = scipy.ndimage.label(empty)
        labels = np.where(empty, labels + len(parent) - 1, 0)
        parent.extend(range(len(parent), len(parent) + count))
        rim = np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]])
        joined = [(0, int(i)) for i in np.unique(rim[rim > 0])]
        both = (labels > 0) & (before > 0)
        joined += [tuple(map(int, pair)) for pair in np.unique(np.stack([labels[both], before[both]], axis=1), axis=0)]
        for a, b in joined:
            a, b = root(a), root(b)
            parent[max(a, b)] = min(a, b)
        numbers, cells = np.unique(labels[labels > 0], return_counts=True)
        enclosed += sum(int(n) for i, n in zip(numbers, cells) if root(int(i)) != 0)
        before = labels
    return enclosed * cell**3


def judge_cups(table, sheet, parts):
    """No part of a vat encloses more resin at any layer than drains from a socket."""
    if sheet["printer"]["process"] != "sla":
        return
    cell = 0.45 * sheet["printer"]["minimum_wall_mm"]
    for row, corners in zip(sheet["parts"], parts):
        pose = np.array(row["print_from_model"], float)
        table.at_most(f"{row['id']} encloses resin, mm³", CUP_LIMIT_MM3, cup_volume(corners @ pose[:3, :3].T + pose[:3, 3], cell))


def judge_foot(table, sheet, outer, center):
    """Whether a top stands when it does not spin: the height of its centre of mass over the floor grows however it is tilted."""
    goal = sheet["goal"]
    if goal["kind"] != "top" or "finished_size_mm" not in sheet:
        return
    origin, axes = frame(goal)
    has_tip = any(rod["what"] == "tip" for rod in sheet.get("hardware", []))
    points = np.concatenate([np.concatenate(outer).reshape(-1, 3)] + ([origin[None]] if has_tip else []))
    points, center = (points - origin) @ axes.T, axes @ (center - origin)
    turns = np.radians(np.arange(0, 360, 10))

    def least_rise(degrees):
        """The least by which a tilt lifts the centre of mass over the floor, of all directions."""
        tilt = math.radians(degrees)
        ups = np.stack([-np.cos(turns) * math.sin(tilt), -np.sin(turns) * math.sin(tilt), np.full(len(turns), math.cos(tilt))], axis=1)
        return (ups @ center - (points @ ups.T).min(axis=0)).min()

    rest = center[2] - points[:, 2].min()
    stands = least_rise(1) > rest
    table.line("stands without spinning", "foot" in sheet, bool(stands), ("foot" in sheet) == bool(stands))
    if "foot" in sheet:
        degrees = int(round(sheet["foot"]["rights_to_deg"]))
        heights = [least_rise(d) for d in range(1, degrees + 1)]
        table.line("rights itself up to, °", float(degrees), float(degrees), all(b > a for a, b in zip(heights, heights[1:])))
        table.same("centre over the floor, mm", sheet["foot"]["center_height_mm"], rest, 1e-4)


def lean_on_tip(points, radius):
    """The lean, degrees, at which a point first reaches the floor beside a ball about (0, 0, radius): by bisection."""
    out, up = np.hypot(points[:, 0], points[:, 1]), points[:, 2] - radius
    reaches = lambda degrees: (out * math.sin(math.radians(degrees)) - up * math.cos(math.radians(degrees))).max() > radius
    low, high = 0.0, 90.0
    if reaches(low) or not reaches(high):
        return low if reaches(low) else high
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (low, middle) if reaches(middle) else (middle, high)
    return low


def lean_on_foot(points, size):
    """The lean, degrees, at which the contact of a body on its own foot no longer rolls: the least over all directions."""
    return min(walk_of_contact(points, size, math.tau * k / LEAN_DIRECTIONS) for k in range(LEAN_DIRECTIONS))


def walk_of_contact(points, size, turn):
    """Follows the lowest point of a body that is leaned in one direction from place to place."""
    out, height = points @ [math.cos(turn), math.sin(turn), 0.0], points[:, 2]
    lowest = np.flatnonzero(height <= height.min())
    here, at, lean = np.zeros(3), lowest[out[lowest].argmax()], 0.0
    while True:
        patch = (STEP_RATIO + math.sin(lean)) * size
        if np.linalg.norm(points[at] - here) > STEP_RATIO * size or np.hypot(*points[at, :2]) > patch:
            return math.degrees(lean)
        beyond = np.flatnonzero(out > out[at])
        if not len(beyond):
            return 90.0
        slopes = np.arctan2(height[beyond] - height[at], out[beyond] - out[at])
        steepness = slopes.min()
        # Of points on one line the last touches.
        level = beyond[slopes <= steepness + 1e-12]
        here, at, lean = points[at], level[out[level].argmax()], max(steepness, 0.0)


def judge_contact(table, sheet, outer):
    """Whether a top's contact is its lowest point, and how far it leans until more than its tip or its foot touches the floor."""
    from scipy.spatial import ConvexHull

    goal, stated = sheet["goal"], sheet["goal"].get("spins_on")
    if goal["kind"] != "top" or stated is None:
        return
    origin, axes = frame(goal)
    corners = np.concatenate(outer).reshape(-1, 3)
    points = (corners[ConvexHull(corners).vertices] - origin) @ axes.T
    size = np.ptp(corners, axis=0).max()
    tip = next((rod for rod in sheet.get("hardware", []) if rod["what"] == "tip"), None)
    lowest = points[:, 2].min()
    if tip:
        end = axes @ (np.array(tip["to_mm"], float) - origin)
        table.at_most("tip's end off the contact, mm", CONTACT_LIMIT_MM, np.linalg.norm(end))
        lowest, lean = min(lowest, end[2]), lean_on_tip(points - [0, 0, end[2]], tip["diameter_mm"] / 2)
    else:
        lean = lean_on_foot(points, size)
        if goal.get("least_lean_deg"):
            gap = trimesh.proximity.closest_point(welded(np.concatenate(outer)), origin[None])[1][0]
            table.at_most("contact off the surface, mm", CONTACT_LIMIT_MM, gap)
    table.at_most("lowest point below the contact, mm", CONTACT_LIMIT_MM, -lowest)
    table.line("lean, °", stated["lean_deg"], lean, abs(stated["lean_deg"] - lean) <= 1e-3)
    if goal.get("least_lean_deg"):
        table.at_least("lean promised, °", goal["least_lean_deg"], lean)


def judge_part(table, kit, part, printer):
    """Checks one file and returns its corners in the model frame."""
    path, room = kit / part["file"], printer.get("build_volume_mm")
    table.line(f"{part['id']} SHA-256", part["sha256"][:12], digest(path)[:12], part["sha256"] == digest(path))
    corners = read_part(path) / (printer.get("print_scale_ratio") or [1, 1, 1])
    mesh = welded(corners)
    sound = bool(mesh.is_watertight and mesh.is_winding_consistent and moments(corners)[0] > 0)
    table.line(f"{part['id']} watertight, outward", True, sound, sound)
    cavities = len(split(mesh)[1])
    table.line(f"{part['id']} closed cavities", 0, cavities, cavities == 0)
    table.none(f"{part['id']} self-intersections", self_intersections(corners))
    table.same(f"{part['id']} volume, mm³", part["volume_mm3"], moments(corners)[0])
    low, high = mesh.bounds
    table.at_most(f"{part['id']} height of lowest point, mm", RESTING_LIMIT_MM, abs(low[2]))
    if room is not None:
        table.at_least(f"{part['id']} room left, mm", 0.0, (np.array(room) - (high - low)).min())
    pose = np.array(part["print_from_model"], float)
    rotation, shift = pose[:3, :3], pose[:3, 3]
    rigid = max(np.abs(rotation @ rotation.T - np.eye(3)).max(), abs(np.linalg.det(rotation) - 1))
    table.at_most(f"{part['id']} pose from rigid", 1e-9, rigid)
    return (corners - shift) @ rotation


def turned_body(peg, profile):
    """The sides and the end of a body of revolution (radius, height) about a peg's axis, facing outward, and its mouth."""
    center, axes = frame({"axis": peg["axis"], "origin_mm": peg["center_mm"]})
    angles = np.arange(PEG_SIDES) * math.tau / PEG_SIDES
    round_about = np.cos(angles)[:, None] * axes[0] + np.sin(angles)[:, None] * axes[1]
    rings = [center + radius * round_about + height * axes[2] for radius, height in profile]
    after = lambda ring: np.roll(ring, -1, axis=0)
    fan = lambda ring, height: np.stack([np.broadcast_to(center + height * axes[2], ring.shape), ring, after(ring)], 1)
    sides = [np.stack(t, 1) for low, high in zip(rings, rings[1:]) for t in ((low, after(low), after(high)), (low, after(high), high))]
    return np.concatenate([*sides, fan(rings[-1], profile[-1][1])]), fan(rings[0], profile[0][1])


def peg_body(peg, is_socket):
    """The surface of a pin or socket as its part has it, and a socket's mouth facing out of the part on the other side. Its
    chamfer follows from its volume: a prism of 48 sides, less or more a ring."""
    area = PEG_SIDES / 2 * math.sin(math.tau / PEG_SIDES)
    radius, length = peg["diameter_mm"] / 2 / (math.cos(math.pi / PEG_SIDES) if is_socket else 1), peg["length_mm"]
    change, sign = abs(peg["volume_mm3"] / area - radius**2 * length), 1 if is_socket else -1
    roots = np.roots([sign / 3, radius, 0, -change])
    real = roots[np.abs(roots.imag) < 1e-6].real
    chamfer = max(min(real[real > 0], default=0.0), 0.0)
    if is_socket:
        surface, mouth = turned_body(peg, [(radius + chamfer, 0.0), (radius, chamfer), (radius, length)])
        return surface[:, ::-1], mouth
    return turned_body(peg, [(radius, 0.0), (radius, length - chamfer), (radius - chamfer, length)])[0], np.empty((0, 3, 3))


def mark_body(mark):
    """The grooves of an engraved id, and their mouths facing out of the part on the other side."""
    boxes = np.array([np.add(SEGMENTS[int(k)], (5.5 * i, 5.5 * i, 0, 0)) for i, c in enumerate(mark["text"]) for k in CHARACTERS.get(c, "")], float)
    middles, into = np.array(mark["strokes_mm"], float), np.array(mark["axis"], float)
    if len(boxes) != len(middles) or not len(boxes):
        return np.empty((0, 3, 3)), np.empty((0, 3, 3))
    flat = np.stack([boxes[:, :2].mean(axis=1), boxes[:, 2:].mean(axis=1)], 1) * mark["stroke_mm"]
    # The turn that fits all middles best: the phase of the sum of products of complex numbers.
    _, axes = frame({"axis": into, "origin_mm": [0, 0, 0]})
    there = (middles - middles.mean(axis=0)) @ axes[:2].T @ [1, 1j]
    drawn = (flat - flat.mean(axis=0)) @ [1, -1j]
    phase = np.angle((there * np.conj(drawn)).sum())
    right = math.cos(phase) * axes[0] + math.sin(phase) * axes[1]
    up = np.cross(right, into)
    surface, mouth = [], []
    for (left, end, bottom, top), middle in zip(boxes * mark["stroke_mm"], middles):
        around = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        rim = [middle + x * (end - left) / 2 * right + y * (top - bottom) / 2 * up for x, y in around]
        floor = [p + mark["depth_mm"] * into for p in rim]
        quads = [floor] + [[rim[i - 1], rim[i], floor[i], floor[i - 1]] for i in range(4)]
        surface += [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        a, b, c, d = rim
        mouth += [(a, c, b), (a, d, c)]
    return np.array(surface), np.array(mouth)


def hole_sides(hole):
    """The axis of a drain hole, two directions across it, its length, and the inward unit normals of its 48 flats."""
    start, end = np.array(hole["from_mm"], float), np.array(hole["to_mm"], float)
    length = np.linalg.norm(end - start)
    _, axes = frame({"axis": end - start, "origin_mm": start})
    middles = (np.arange(PEG_SIDES) + 0.5) * math.tau / PEG_SIDES
    return start, axes, length, np.stack([-np.cos(middles), -np.sin(middles)], 1)


def hole_radii(hole):
    """The distances of a hole's flats from its axis at its outer and inner end, mm: a hole for a plug is wider outside."""
    return hole.get("mouth_mm", hole["diameter_mm"]) / 2, hole["diameter_mm"] / 2


def within_hole(points, hole, by=0.0):
    """Whether points lie in the prism of a drain hole, deeper than this under its flats, mm."""
    start, axes, length, inward = hole_sides(hole)
    outer, inner = hole_radii(hole)
    local = (points - start) @ axes.T
    depth = (local[:, :2] @ inward.T).min(axis=1) + outer + (inner - outer) * local[:, 2] / length
    return (depth > by) & (local[:, 2] > -by) & (local[:, 2] < length + by)


def near_hole(corners, hole):
    """The triangles that come near a drain hole."""
    start, axes, length, _ = hole_sides(hole)
    reach = length + 2 * hole["diameter_mm"]
    low, high = corners.min(axis=1) - start, corners.max(axis=1) - start
    return corners[((low < reach) & (high > -reach)).all(axis=1)]


def hole_walls(hole, body):
    """Points on the flats of a drain hole that bound material: on its way through the uncut body, off its rims."""
    start, axes, length, inward = hole_sides(hole)
    outer, inner = hole_radii(hole)
    near, points = near_hole(body, hole), []
    for out in -inward @ axes[:2]:
        foot, along = start + outer * out, length * axes[2] + (inner - outer) * out
        way = along / np.linalg.norm(along)
        met = next(lines_through(near, foot[None], way))
        met = met[(met > 0) & (met < np.linalg.norm(along))]
        for low, high in zip(met[0::2], met[1::2]):
            points.append(foot + np.linspace(low, high, 12)[1:-1, None] * way)
    return np.concatenate(points) if points else np.full((1, 3), np.inf)


def hole_rings(hole, gap=0.0):
    """The corners of a drain hole around its outer and inner end, or of what keeps a gap from its flats on each side."""
    start, axes, length, _ = hole_sides(hole)
    outer, inner = hole_radii(hole)
    angles = np.arange(PEG_SIDES) * math.tau / PEG_SIDES
    around = (np.cos(angles)[:, None] * axes[0] + np.sin(angles)[:, None] * axes[1]) / math.cos(math.pi / PEG_SIDES)
    # The flats lean, and the gap is normal to them.
    less = gap * math.hypot(1.0, (outer - inner) / length)
    return start + (outer - less) * around, start + length * axes[2] + (inner - less) * around


def plug_body(hole, outer):
    """The triangles of the plug that closes a drain hole: what lies in it of the body without voids, less its gap."""
    import manifold3d

    surface = welded(np.concatenate(outer))
    solid = manifold3d.Manifold(manifold3d.Mesh(surface.vertices.astype(np.float32), surface.faces.astype(np.uint32)))
    prism = manifold3d.Manifold.hull_points(np.concatenate(hole_rings(hole, hole["plug"]["gap_mm"])))
    plug = (solid ^ prism).to_mesh()
    return np.asarray(plug.vert_properties, float)[:, :3][np.asarray(plug.tri_verts)]


def plugs_of(sheet):
    """The hole of each part that is a plug, by the name of the part."""
    return {hole["plug"]["part"]: hole for hole in sheet.get("drains", []) if "plug" in hole}


def hole_surface(hole):
    """The whole mantle of a drain hole, facing its axis."""
    low, high = hole_rings(hole)
    after = lambda ring: np.roll(ring, -1, axis=0)
    return np.concatenate([np.stack(t, 1) for t in ((low, after(high), after(low)), (low, high, after(high)))])


def hole_volume(hole, body):
    """The material in a drain hole, mm³: lines along it through a grid of points across it."""
    start, axes, length, inward = hole_sides(hole)
    outer, inner = hole_radii(hole)
    radius = outer / math.cos(math.pi / PEG_SIDES)
    side = np.linspace(-radius, radius, 81)
    x, y = (grid.ravel() for grid in np.meshgrid((side[1:] + side[:-1]) / 2, (side[1:] + side[:-1]) / 2))
    flat = np.stack([x, y], 1)
    from_axis = -(flat @ inward.T).min(axis=1)
    flat, from_axis = flat[from_axis < outer], from_axis[from_axis < outer]
    # A line far from the axis of a hole that narrows leaves it through a flat.
    ends = np.where(from_axis <= inner, length, length * (outer - from_axis) / max(outer - inner, 1e-12))
    points, total = start + flat @ axes[:2], 0.0
    for met, end in zip(lines_through(near_hole(body, hole), points, axes[2]), ends):
        met = met[(met > 0) & (met < end)]
        met = np.append(met, end) if len(met) % 2 else met
        total += met[1::2].sum() - met[0::2].sum() if len(met) % 2 == 0 else math.nan
    return total * (side[1] - side[0]) ** 2


def judge_holes(table, sheet, parts, whole, voids):
    """Every drain hole begins in the open, ends in its void, is free by its diameter, and takes the stated volume. What closes it
    afterwards is no part of the body then."""
    plugs = plugs_of(sheet)
    closing = {row["id"]: corners for row, corners in zip(sheet["parts"], parts) if row["id"] in plugs}
    parts = [corners for row, corners in zip(sheet["parts"], parts) if row["id"] not in plugs]
    for name, hole in plugs.items():
        soup, plug = welded_soup(near_hole(np.concatenate(parts), hole)), spread_over(closing[name])[0]
        gap = trimesh.proximity.closest_point(soup, plug)[1].min()
        table.at_least(f"{name} gap in {hole['id']}, mm", hole["plug"]["gap_mm"] - GAP_TOLERANCE_MM, gap)
    for hole in sheet.get("drains", []):
        start, end = np.array(hole["from_mm"], float), np.array(hole["to_mm"], float)
        index = [void["id"] for void in sheet["voids"]].index(hole["void"])
        leads = bool(welded(voids[index][:, ::-1]).contains([end])[0]) and not whole.contains([start])[0]
        table.line(f"{hole['id']} leads from the open to {hole['void']}", True, leads, leads)
        # A ball is pushed along the axis: what is nearest to its middle anywhere decides.
        way = start + (end - start) * np.linspace(0, 1, 101)[:, None]
        near = near_hole(np.concatenate(parts), hole)
        soup = welded_soup(near)
        free = 2 * trimesh.proximity.closest_point(soup, way)[1].min()
        blocked = any(((met > 0) & (met < np.linalg.norm(end - start))).any() for met in lines_through(near, start[None], (end - start) / np.linalg.norm(end - start)))
        table.at_least(f"{hole['id']} free, mm", hole["diameter_mm"] - 0.01, 0.0 if blocked else free)
        table.same(f"{hole['id']} volume, mm³", hole["volume_mm3"], hole_volume(hole, whole.triangles), 0.01)
    if "cells" in sheet:
        judge_cells(table, sheet, voids)
    for void in sheet["voids"]:
        holes = [hole for hole in sheet.get("drains", []) if hole["void"] == void["id"]]
        if holes and "cleaning" in sheet["printer"]:
            rule, wide = sheet["printer"]["cleaning"], void["least_opening_mm"] - 0.01
            single = sum(hole["diameter_mm"] >= wide for hole in holes) >= (2 if sheet["printer"].get("process") == "sla" else 1)
            pair = sum(hole["diameter_mm"] >= rule.get("pair_opening_mm", math.inf) for hole in holes) >= 2
            table.line(f"{void['id']} has the holes it needs", True, single or pair, single or pair)


def judge_cells(table, sheet, voids):
    """The cells of a piece: their air is the voids, each place is in a void that a hole drains, and a ball of the stated width goes
    through each opening."""
    cells = sheet["cells"]
    meshes = [welded(void[:, ::-1]) for void in voids]
    table.same("air of the cells, mm³", cells["drained_mm3"], sum(mesh.volume for mesh in meshes), 1e-5)
    drained = {hole["void"] for hole in sheet.get("drains", [])}
    in_air = np.zeros(len(cells["places_mm"]), bool)
    for void, mesh in zip(sheet["voids"], meshes):
        if void["id"] in drained:
            in_air |= mesh.contains(np.array(cells["places_mm"], float))
    table.none("cells that no hole drains", int((~in_air).sum()))
    if cells["openings_mm"]:
        ways = np.array(cells["openings_mm"], float)
        ways = ways[:, :1] + (ways[:, 1:] - ways[:, :1]) * np.linspace(0, 1, OPENING_STEPS)[:, None]
        soup = welded_soup(np.concatenate(voids))
        near = trimesh.proximity.closest_point(soup, ways.reshape(-1, 3))[1]
        table.at_least("openings of the cells, mm", cells["opening_mm"] - 0.01, 2 * near.min())
    table.at_least("walls of the cells, mm", cells["wall_mm"] - WALL_TOLERANCE_MM, cell_wall(np.concatenate(voids), cells["wall_mm"]))


def cell_wall(corners, wall):
    """The thinnest wall behind places spread over voids, along their normals, up to two walls. An edge of the material is no wall: its
    sides meet, or do not face each other."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(areas, 1e-12)[:, None]
    rng = np.random.default_rng(0)
    thinnest = 2 * wall
    for i in rng.choice(len(corners), CELL_SAMPLES, p=areas / areas.sum()):
        u, v = rng.random(2)
        u, v = (u, v) if u + v < 1 else (1 - u, 1 - v)
        a, b, c = corners[i]
        # Surfaces look away from the material.
        met = distances(corners, a + u * (b - a) + v * (c - a) - 1e-4 * normals[i], -normals[i])
        behind = corners[met.argmin()]
        is_edge = (behind[:, None] == corners[i][None]).all(axis=2).any()
        if not is_edge and -normals[met.argmin()] @ normals[i] >= 0.5:
            thinnest = min(thinnest, met.min() + 1e-4)
    return thinnest


def same_triangles(corners, known):
    """For each triangle the known one with the same corners in the same order about it, or -1."""
    from scipy.spatial import cKDTree

    places, index = np.unique(known.reshape(-1, 3), axis=0, return_inverse=True)
    distance, at = cKDTree(places).query(corners.reshape(-1, 3), distance_upper_bound=SAME_PLACE_MM)
    at = np.where(np.isfinite(distance), at, -1).reshape(-1, 3)
    first = lambda rows: np.take_along_axis(rows, (rows.argmin(axis=1)[:, None] + [0, 1, 2]) % 3, axis=1)
    table = {tuple(row): i for i, row in enumerate(first(index.reshape(-1, 3)))}
    return np.array([table.get(tuple(row), -1) for row in first(at)], int)


def spread_over(corners):
    """Points over each triangle, its corners and middle among them, and whose point each is."""
    pieces, owner = cut_up(corners, SAMPLE_MM)
    points = np.concatenate([pieces.reshape(-1, 3), pieces.mean(axis=1)])
    return points, np.concatenate([np.repeat(owner, 3), owner])


class Boxes:
    """Triangles in a tree of boxes, each cut in halves along its longest side: which of them are near many points at once."""

    LEAF = 4

    def __init__(self, corners):
        self.corners = corners
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        # A triangle without area gets the normal 0, which refuses no point.
        self.normals = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]
        self.depth = max(0, math.ceil(math.log2(max(len(corners), 1) / self.LEAF)))
        size = self.LEAF << self.depth
        # What fills the last leaves up is nowhere.
        low, high = np.full((size, 3), np.inf), np.full((size, 3), -np.inf)
        low[: len(corners)], high[: len(corners)] = corners.min(axis=1), corners.max(axis=1)
        middle = np.full((size, 3), np.inf)
        middle[: len(corners)] = corners.mean(axis=1)
        self.order = np.arange(size)
        for level in range(self.depth):
            row = self.order.reshape(1 << level, -1)
            longest = (high[row].max(axis=1) - low[row].min(axis=1)).argmax(axis=1)
            along = np.take_along_axis(middle[row], longest[:, None, None], axis=2)[:, :, 0]
            self.order = np.take_along_axis(row, along.argsort(axis=1, kind="stable"), axis=1).ravel()
        self.levels = [(low[self.order].reshape(-1, self.LEAF, 3).min(axis=1), high[self.order].reshape(-1, self.LEAF, 3).max(axis=1))]
        for _ in range(self.depth):
            lower, upper = self.levels[-1]
            self.levels.append((lower.reshape(-1, 2, 3).min(axis=1), upper.reshape(-1, 2, 3).max(axis=1)))
        self.levels.reverse()
        # One axis after the other is much quicker than rows of three.
        self.levels = [(low.T.copy(), high.T.copy()) for low, high in self.levels]

    def near(self, points, reach):
        """Pairs of a point and a triangle no farther from it than the reach, and their distances."""
        found = [self._near(points, chunk, reach) for chunk in np.array_split(np.arange(len(points)), 1 + len(points) // 100000)]
        return tuple(np.concatenate(column) for column in zip(*found))

    def _near(self, points, who, reach):
        node, axes = np.zeros(len(who), int), points.T.copy()
        for level, (low, high) in enumerate(self.levels):
            for of, lower, upper in zip(axes, low - reach, high + reach):
                at = of[who]
                hit = (at >= lower[node]) & (at <= upper[node])
                who, node = who[hit], node[hit]
            if level < self.depth:
                who, node = np.repeat(who, 2), (2 * node[:, None] + [0, 1]).ravel()
        who, place = np.repeat(who, self.LEAF), self.order[(self.LEAF * node[:, None] + np.arange(self.LEAF)).ravel()]
        who, place = who[place < len(self.corners)], place[place < len(self.corners)]
        # Most of them lie beside the triangle's plane, which is quicker to see than the distance.
        beside = np.abs(np.einsum("ij,ij->i", points[who] - self.corners[place, 0], self.normals[place]))
        who, place = who[beside <= reach], place[beside <= reach]
        gaps = np.zeros(0)
        if len(who):
            gaps = np.linalg.norm(trimesh.triangles.closest_point(self.corners[place], points[who]) - points[who], axis=1)
        return who[gaps <= reach], place[gaps <= reach], gaps[gaps <= reach]


def farthest_off(corners, sheets):
    """For each triangle how far its points are from the sheets, at most (up to a limit), and the sheet nearest to its middle.
    A sheet that faces the other way does not count for triangles that are no slivers."""
    if not len(corners):
        return np.zeros(0), np.zeros(0, int)
    normals, facing = (np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) for c in (corners, sheets))
    longest = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    sliver = np.linalg.norm(normals, axis=1) < 2 * ON_SURFACE_MM * longest
    points, owner = spread_over(corners)
    boxes, off, nearest_of = Boxes(sheets), np.full(len(points), FAR_OFF_MM), np.full(len(points), -1)
    # Many triangles share a corner, which is looked for once.
    places, copy_of = np.unique(points, axis=0, return_inverse=True)
    copies, ends = np.argsort(copy_of.ravel(), kind="stable"), np.bincount(copy_of.ravel()).cumsum()
    starts, sought = np.concatenate([[0], ends[:-1]]), np.arange(len(places))
    # Few places are looked for twice: most of them are on a surface.
    for reach in (ON_SURFACE_MM, FAR_OFF_MM):
        at, place, gaps = boxes.near(places[sought], reach)
        at = sought[at]
        count = ends[at] - starts[at]
        pair = np.repeat(np.arange(len(at)), count)
        who = copies[starts[at][pair] + np.arange(len(pair)) - np.repeat(count.cumsum() - count, count)]
        place, gaps = place[pair], gaps[pair]
        fresh = nearest_of[who] < 0
        who, place, gaps = who[fresh], place[fresh], gaps[fresh]
        turned = np.einsum("ij,ij->i", normals[owner[who]], facing[place]) < 0
        counts = ~turned | sliver[owner[who]]
        # The nearest is written last.
        by_gap = np.flatnonzero(counts)[np.argsort(-gaps[counts], kind="stable")]
        off[who[by_gap]], nearest_of[who[by_gap]] = gaps[by_gap], place[by_gap]
        sought = np.unique(copy_of.ravel()[nearest_of < 0])
    worst, nearest = np.zeros(len(corners)), np.full(len(corners), -1)
    np.maximum.at(worst, owner, off)
    # The middles come last, one of them for each triangle at least.
    middles = np.arange(len(points) - len(points) // 4, len(points))
    nearest[owner[middles]] = nearest_of[middles]
    return worst, nearest


def judge_surfaces(table, sheet, parts, outer, voids):
    """Every triangle of every part lies on the uncut body, on a cut face of another part, or on its own pins, sockets and ids;
    and nothing of these is missing. Returns the outer triangles of the parts, and those of voids."""
    body, of_outer = np.concatenate([*outer, *voids]), sum(map(len, outer))
    own, mouths, plugs = [], [], plugs_of(sheet)
    for row in sheet["parts"]:
        bodies = [peg_body(pin, False) for pin in row["pins"]] + [peg_body(socket, True) for socket in row["sockets"]]
        bodies += [mark_body(mark) for mark in row.get("marks", [])]
        bodies += [(plug_body(plugs[row["id"]], outer), np.empty((0, 3, 3)))] if row["id"] in plugs else []
        own.append(np.concatenate([np.empty((0, 3, 3)), *(surface for surface, _ in bodies)]))
        mouths.append(np.concatenate([np.empty((0, 3, 3)), *(mouth for _, mouth in bodies)]))
    in_cut = lambda corners, cut: (np.abs((corners - cut["point_mm"]) @ cut["normal"]) <= ON_SURFACE_MM).all(axis=1)
    faces = [c[np.any([in_cut(c, cut) for cut in sheet["cuts"]], axis=0)] if sheet["cuts"] else c[:0] for c in parts]
    walls, left = ([], []), np.ones(len(body), bool)
    holes = sheet.get("drains", [])
    bores = np.concatenate([np.empty((0, 3, 3)), *map(hole_surface, holes)])
    for index, (row, corners) in enumerate(zip(sheet["parts"], parts)):
        same = same_triangles(corners, body)
        left[same[same >= 0]] = False
        others = [i for i in range(len(parts)) if i != index]
        sheets = np.concatenate([body, own[index], bores, *(mouths[i] for i in others), *(faces[i][:, ::-1] for i in others)])
        cut = np.flatnonzero(same < 0)
        off, nearest = farthest_off(corners[cut], sheets)
        same[cut] = nearest
        walls[0].append(corners[(same >= 0) & (same < of_outer)])
        walls[1].append(corners[(same >= of_outer) & (same < len(body))])
        table.at_most(f"{row['id']} off its surfaces, mm", ON_SURFACE_MM, off.max(initial=0.0))
        table.at_most(f"{row['id']} lacks of pins and ids, mm", ON_SURFACE_MM, farthest_off(own[index], corners)[0].max(initial=0.0))
        volumes = [moments(welded(corners).triangles[group])[0] for group in groups_of(welded(corners))]
        table.line(f"{row['id']} bodies", 1, sum(v > 0 for v in volumes), sum(v > 0 for v in volumes) == 1)
    rest = body[left]
    if holes:
        # What a hole takes off a triangle is no loss: around the holes it is looked at in small pieces.
        bored = np.concatenate([corners for row, corners in zip(sheet["parts"], parts) if row["id"] not in plugs])
        reach = lambda hole: hole_radii(hole)[0] + np.linalg.norm(np.subtract(hole["to_mm"], hole["from_mm"]))
        near = np.any([np.linalg.norm(trimesh.triangles.closest_point(rest, np.tile(hole["from_mm"], (len(rest), 1))) - hole["from_mm"], axis=1) < reach(hole) + 1 for hole in holes], axis=0)
        pieces, _ = cut_up(rest[near], HOLE_RIM_MM)
        kept = ~np.any([within_hole(pieces.reshape(-1, 3), hole, -ON_SURFACE_MM).reshape(-1, 3).any(axis=1) for hole in holes], axis=0)
        rest = np.concatenate([rest[~near], pieces[kept]])
        # Nothing of what a part has of the body lies in a hole.
        inside = [within_hole(bored.mean(axis=1), hole, ON_SURFACE_MM).sum() for hole in holes]
        table.none("triangles in the drain holes", int(sum(inside)))
        soup = lambda hole: welded_soup(near_hole(bored, hole))
        lack = [trimesh.proximity.closest_point(soup(hole), hole_walls(hole, body))[1].max(initial=0.0) for hole in holes]
        table.at_most("walls of the drain holes, off by mm", ON_SURFACE_MM, max(lack))
    off, _ = farthest_off(rest, np.concatenate(parts))
    table.at_most("missing of the uncut body, mm", ON_SURFACE_MM, off.max(initial=0.0))
    return walls


def judge_model(table, sheet, kit, outer):
    """The outside of the uncut body is the surface of the model in the kit, scaled, and nothing of the model is missing.

    Where the program was told to change the surface, or bores holes into it, nothing is compared. What of a model lies inside
    itself or is open is repaired: then the outside alone is held against the model, but for what closes its holes, and not the
    model against the outside."""
    row, files = sheet["model"], sorted((kit / "model").glob("*")) if (kit / "model").is_dir() else []
    changed = [word for word in ("redrawn", "thickened") if word in row] + [word for word in ("hardware", "string_gap_mm") if sheet.get(word)]
    if not files or changed:
        print(f"  outside not held against the model: {', '.join(changed) or 'no copy'}")
        return
    table.line("model's sha256", row["sha256"], digest(files[0]), digest(files[0]) == row["sha256"])
    loaded = trimesh.load(files[0], force="mesh", process=False)
    model = np.asarray(loaded.triangles, dtype=np.float64) * row["scale_ratio"]
    if moments(model)[0] < 0:
        model = model[:, ::-1]
    surface = np.concatenate(outer)
    pairs = [("outside off the model, mm", surface, model)]
    whole = welded(model.astype(np.float32).astype(np.float64))
    if whole.is_watertight and len(groups_of(whole)) == 1 and self_intersections(model) == 0:
        pairs.append(("missing of the model, mm", model, surface))
    else:
        print("  the model is open or crosses itself: not looked for in the outside")
    for name, corners, sheets in pairs:
        rest = corners[same_triangles(corners, sheets) < 0]
        off = farthest_off(rest, sheets)[0]
        if not whole.is_watertight and sheets is model and (off > ON_SURFACE_MM).any():
            closing = closes_holes(rest[off > ON_SURFACE_MM], whole)
            print(f"  {closing.sum()} triangles of the outside close holes of the model")
            off[np.flatnonzero(off > ON_SURFACE_MM)[closing]] = 0.0
        table.at_most(name, ON_SURFACE_MM, off.max(initial=0.0))


def closes_holes(corners, model):
    """Which triangles belong to patches whose edges are open edges of the model, corner by corner."""
    from scipy.spatial import cKDTree

    edges, count = np.unique(model.edges_sorted, axis=0, return_counts=True)
    rims = cKDTree(model.vertices[np.unique(edges[count == 1])])
    patches = welded(corners)
    closing = np.zeros(len(corners), bool)
    for group in trimesh.graph.connected_components(patches.face_adjacency, nodes=np.arange(len(corners)), min_len=1):
        own, count = np.unique(np.sort(patches.faces[group][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_counts=True)
        ends = patches.vertices[np.unique(own[count == 1])]
        closing[group] = len(ends) > 0 and rims.query(ends)[0].max() <= ON_SURFACE_MM
    return closing


def groups_of(mesh):
    """The triangles of each connected piece of a welded mesh."""
    return trimesh.graph.connected_components(mesh.face_adjacency, nodes=np.arange(len(mesh.faces)))


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def check_sums(table, kit):
    """The list of hashes, as sha256sum --check reads it, holds every file of the kit but itself, each once. What is not listed
    and could be printed, and any link, is no part of a kit; other files are only named."""
    sums = kit / "SHA256SUMS"
    lines = sums.read_bytes().decode(errors="replace").split("\n") if sums.exists() else [""]
    rows = [re.fullmatch(r"([0-9a-f]{64})  ([^\r]+)", line) for line in lines[:-1]]
    table.none("lines of SHA256SUMS of another form", sum(row is None for row in rows) + (lines[-1] != ""))
    listed = {row[2]: row[1] for row in rows if row}
    table.none("files listed twice", sum(row is not None for row in rows) - len(listed))
    links = [p for p in kit.rglob("*") if p.is_symlink()]
    table.none("links", len(links))
    there = {p.relative_to(kit).as_posix() for p in kit.rglob("*") if p.is_file()} - {"SHA256SUMS"}
    wrong = [name for name in listed if name not in there or digest(kit / name) != listed[name]]
    table.none("files unlike SHA256SUMS", len(wrong))
    strange = sorted(there - listed.keys())
    table.none("unlisted files that could be printed", sum(Path(name).suffix.lower() in PRINTABLE for name in strange))
    if strange:
        print(f"  not listed: {', '.join(strange[:10])}")


def judge(kit):
    sheet = json.loads((kit / "checklist.json").read_text())
    goal, promised, table = sheet["goal"], sheet["assembly"], Table()
    print(f"{kit}: {goal['kind']}, {len(sheet['parts'])} parts\n  {'':39} {'promised/limit':>18} {'measured':>18}")
    check_sums(table, kit)
    parts = [judge_part(table, kit, part, sheet["printer"]) for part in sheet["parts"]]
    hollowed = read_stl(kit / "hollowed.stl")
    whole = welded(hollowed)
    table.line("hollowed.stl watertight", True, bool(whole.is_watertight), bool(whole.is_watertight))
    table.none("hollowed.stl self-intersections", self_intersections(hollowed))
    outer, voids = split(whole)
    density = sheet["material"]["density_g_cm3"] / 1000
    ballast = sheet.get("ballast", [])
    films = [joint["glue"] for joint in sheet["joints"] if "glue" in joint]
    volume, mass, center, inertia = loaded(body(parts, density, sheet.get("hardware", []) + sheet.get("dowels", []), films), ballast)
    if "fill" in sheet:
        # A kit has ballast in pockets or a filling in its voids, never both.
        unfilled = volume, mass, center, inertia
        volume, mass, center, inertia = filled(unfilled, voids, sheet["fill"]["density_g_cm3"] / 1000)
    found = figures(goal, mass, center, inertia, np.concatenate(outer).reshape(-1, 3))
    judge_body(table, promised, (volume, mass, center, inertia), found)
    judge_goal(table, goal, sheet.get("promise"), found)
    judge_whole(table, sheet, volume, moments(hollowed)[0])
    judge_hardware(table, sheet, outer)
    judge_size(table, sheet, parts)
    judge_foot(table, sheet, outer, center)
    judge_contact(table, sheet, outer)
    judge_support(table, sheet, parts, whole)
    judge_cups(table, sheet, parts)
    for part in ballast:
        table.at_least(f"{part['id']} ({part['part']}) room, mm", 0.0, ballast_room(part, whole, voids))
    judge_pins(table, sheet, parts)
    judge_play(table, sheet, parts)
    judge_slack(table, sheet, parts, np.concatenate(outer).reshape(-1, 3), density)
    judge_jigs(table, sheet, kit, parts, outer)
    judge_voids(table, sheet, voids, parts)
    judge_holes(table, sheet, parts, whole, voids)
    judge_dowels(table, sheet, parts)
    judge_films(table, sheet, parts)
    judge_marks(table, sheet, parts)
    judge_model(table, sheet, kit, outer)
    outer_of_parts, voids_of_parts = judge_surfaces(table, sheet, parts, outer, voids)
    if voids:
        wall = smallest_wall(outer_of_parts, voids_of_parts)
        table.at_least("wall, mm", sheet["wall"]["required_mm"] - WALL_TOLERANCE_MM, wall)
        # Samples can only miss the thinnest place, never find a thinner one.
        table.at_least("sampled wall, not under stated", sheet["wall"]["measured_min_mm"] - SAME_PLACE_MM, wall)
    table.line("verdict of the checklist", sheet["verdict"], "fail" if table.failed else "pass", (sheet["verdict"] == "pass") == (not table.failed))
    return not table.failed


def judge_body(table, promised, body, found):
    volume, mass, center, inertia = body
    radius = math.sqrt(np.trace(inertia) / mass)
    table.same("volume, mm³", promised["volume_mm3"], volume)
    table.same("mass, g", promised["mass_g"], mass)
    for i, name in enumerate("xyz"):
        table.same(f"centre {name}, mm", promised["center_mm"][i], center[i], scale=radius)
    difference = np.abs(np.array(promised["inertia_g_mm2"]) - inertia).max()
    table.at_most("inertia, relative difference", AGREEMENT_RATIO, difference / np.abs(inertia).max())
    for name, value in zip("abc", found["principal_moments_g_mm2"]):
        index = "abc".index(name)
        table.same(f"I_{name}, g·mm²", promised["principal_moments_g_mm2"][index], value)
    for name in ("critical_speed_rpm", "topples_deg", "dominance_ratio", "spin_it_ratio", "center_height_mm"):
        if name in found:
            table.same(name, promised[name], found[name], SPEED_AGREEMENT_RATIO)
    if "metacentric_height_mm" in found:
        stated = promised["afloat"]
        table.same("waterline_mm", stated["waterline_mm"], found["waterline_mm"])
        height = "metacentric_height_mm"
        table.same(height, stated[height], found[height], METACENTRE_AGREEMENT_RATIO)
    if "balance_grade_mm_s" in found:
        # What is left is a difference of large moments: it is compared with the part's own length turning about.
        stated = promised["unbalance"]["grade_mm_s"]
        table.same("balance_grade_mm_s", stated, found["balance_grade_mm_s"], scale=found["reach_mm_s"])


def judge_goal(table, goal, promise, found):
    if goal["kind"] == "stand":
        table.at_least("stands, °", goal.get("least_angle_deg", 0.0), found["topples_deg"])
    elif goal["kind"] == "float":
        ordered = abs(found["waterline_mm"] - goal["water"]["waterline_mm"])
        table.at_most("waterline, off by mm", WATERLINE_TOLERANCE_MM, ordered)
        table.at_most("centre beside buoyancy, mm", AXIS_OFFSET_LIMIT_MM, found["trim_mm"])
        table.at_least("metacentric height, mm", 0.0, found["metacentric_height_mm"])
    elif goal["kind"] == "balance":
        table.at_most("balance grade, mm/s", goal["rotor"]["grade_mm_s"], found["balance_grade_mm_s"])
    else:
        table.at_most("axis offset, mm", AXIS_OFFSET_LIMIT_MM, found["axis_offset_mm"])
        table.at_most("axis tilt, °", AXIS_TILT_LIMIT_DEG, found["axis_tilt_deg"])
        table.at_most("dominance I_b/I_c", 1.0, found["dominance_ratio"])
    if promise:
        value = found[promise["figure"]]
        if promise["figure"] in ("topples_deg", "metacentric_height_mm"):
            table.at_least("promised figure, " + promise["figure"], promise["value"] * 0.999, value)
        else:
            table.at_most("promised figure, " + promise["figure"], promise["value"] * 1.001, value)


def judge_whole(table, sheet, volume, hollowed):
    pegs = lambda key: sum(peg["volume_mm3"] for part in sheet["parts"] for peg in part[key])
    marks = sum(mark["volume_mm3"] for part in sheet["parts"] for mark in part.get("marks", []))
    holes = sum(hole["volume_mm3"] for hole in sheet.get("drains", []))
    plugs = sum(part["volume_mm3"] for part in sheet["parts"] if part["id"] in plugs_of(sheet))
    error = abs(volume - hollowed - pegs("pins") + pegs("sockets") + marks + holes - plugs) / hollowed
    table.at_most("parts against hollowed, pins, sockets", VOLUME_SUM_LIMIT_RATIO, error)


def main(kits):
    if not kits:
        print(__doc__)
        return 2
    try:
        verdicts = [judge(Path(kit)) for kit in kits]
    except (OSError, ValueError, KeyError) as fault:
        print(f"no kit: {fault!r}", file=sys.stderr)
        return 2
    return 0 if all(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
