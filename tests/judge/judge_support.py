#!/usr/bin/env python3
"""A slicer weighs the support of a kit's parts: each as it is written, against the same part in 26 other poses.

    python3 tests/judge/judge_support.py --profile tests/printers/mk4-like.ini KIT [KIT ...]

Slices every part with PrusaSlicer and adds up the filament of `;TYPE:Support material` in the G-code. Then turns the part so that
each of the 26 directions to the faces, edges and corners of a cube, in the model's frame, points up, and slices it again. A pose
counts if it keeps the rules of filament printing: no pin reaches as low as the rest of the part, and the first layer of part and
support is large enough for the height. A part fails if it needs more than 1.1 times the support of the best of these, or stands on
less than 5 mm² itself.

The largest cut face without pins down is sliced too, or the largest one up if all have pins: what a shop does without thinking.
Parts are sliced without infill and solid layers, which changes nothing about support and saves most of the time. `--part ID` takes
one part only, `--no-cube` leaves the 26 poses out, `--jobs N` slices so many at once, `--slicer CMD` names the program.
Exit code 0: no part fails; 1: some do; 2: no kit, or a pose as written that cannot be sliced.
"""

import argparse
import itertools
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import trimesh

WORST_RATIO = 1.1
# Less support than this is a stray line or two, and 1.1 times nothing is nothing, g.
NEXT_TO_NOTHING_G = 0.1
# The first layer of part and support is at least a square as wide as the height over this, and never smaller than that, mm².
SLENDERNESS = 5.0
LEAST_BED_MM2 = 20.0
# A part whose own first layer is smaller in its middle stands on a point, mm²: nobody prints it so.
LEAST_FOOT_MM2 = 5.0
# Vertices so near a pin's cylinder belong to it, mm.
ON_PIN_MM = 1e-3
# A plane of the cut and a face of the part are one if they are no further apart, mm.
ON_CUT_MM = 1e-3
SLICING_SECONDS = 900
WITHOUT_FILLING = ["--fill-density", "0%", "--top-solid-layers", "0", "--bottom-solid-layers", "0"]


def turned(mesh, up):
    """The part with the direction `up` pointing up, its lowest point on the plate."""
    side = np.eye(3)[np.argmin(np.abs(up))]
    side = side - up * side.dot(up)
    side /= np.linalg.norm(side)
    new = mesh.copy()
    new.vertices = mesh.vertices @ np.array([side, np.cross(up, side), up]).T
    new.vertices -= [0, 0, new.vertices[:, 2].min()]
    return new


def sliced(mesh, options):
    """The G-code of a part, its support switched on; None if the slicer refuses it."""
    with tempfile.TemporaryDirectory() as folder:
        model, code = Path(folder, "part.stl"), Path(folder, "part.gcode")
        mesh.export(model)
        command = [options.slicer, "--export-gcode", "--load", options.profile, "--support-material", *WITHOUT_FILLING]
        try:
            subprocess.run([*command, "-o", code, model], capture_output=True, timeout=SLICING_SECONDS)
        except subprocess.TimeoutExpired:
            return None
        return code.read_text() if code.exists() else None


def weigh(code):
    """Grams of support, and the area of its first layer, mm²."""

    def setting(name):
        return float(re.search(rf"^; {name} = ([\d.]+)", code, re.M).group(1))

    area_mm2 = math.pi * setting("filament_diameter") ** 2 / 4
    is_support, is_relative, last, fed, fed_first = False, False, 0.0, 0.0, 0.0
    layers = 0
    for line in code.splitlines():
        if line.startswith(";TYPE:"):
            is_support = line[6:].startswith("Support")
        elif line.startswith(";LAYER_CHANGE"):
            layers += 1
        words = line.split(";")[0].split()
        if not words:
            continue
        if words[0] in ("M82", "M83"):
            is_relative = words[0] == "M83"
        feeds = [float(word[1:]) for word in words if word[0] == "E"]
        if words[0] == "G92" and feeds:
            last = feeds[0]
        elif words[0] in ("G1", "G2", "G3") and feeds:
            step = feeds[0] if is_relative else feeds[0] - last
            last = feeds[0]
            if is_support:
                fed += step
                fed_first += step if layers <= 1 else 0.0
    grams = fed * area_mm2 * setting("filament_density") / 1000
    return grams, fed_first * area_mm2 / setting("first_layer_height")


def foot_mm2(mesh, height_mm):
    """Area of the part's own section in the middle of its first layer."""
    section = mesh.section([0, 0, 1], [0, 0, height_mm / 2])
    return 0.0 if section is None else section.to_2D()[0].area


def on_plate(mesh):
    """The same mesh with its lowest point at z = 0."""
    mesh = mesh.copy()
    mesh.apply_translation([0, 0, -mesh.bounds[0][2]])
    return mesh


def rests_on_pin(part, pins, up, room_mm):
    """Whether a pin reaches as low as the rest of the part, or less than this above."""
    if not pins:
        return False
    bare, lowest = np.ones(len(part.vertices), bool), math.inf
    for pin in pins:
        center, axis = np.array(pin["center_mm"]), np.array(pin["axis"])
        length, radius = pin["length_mm"], pin["diameter_mm"] / 2
        from_base = part.vertices - center
        along = from_base @ axis
        aside = np.linalg.norm(from_base - np.outer(along, axis), axis=1)
        bare &= ~((along > ON_PIN_MM) & (along < length + ON_PIN_MM) & (aside < radius + ON_PIN_MM))
        rise = axis.dot(up)
        lowest = min(lowest, center.dot(up) + min(length * rise, 0) - radius * math.sqrt(max(0.0, 1 - rise * rise)))
    return lowest < (part.vertices[bare] @ up).min() + room_mm


def on_cut_face(part, sheet, pins):
    """The direction up with the largest cut face down, or up if all have pins; None without a cut face."""
    faces = []
    for cut in sheet["cuts"]:
        normal = np.array(cut["normal"])
        offset = normal.dot(cut["point_mm"])
        on_plane = (np.abs(part.triangles @ normal - offset) < ON_CUT_MM).all(axis=1)
        for side in (normal, -normal):
            has_pin = any(np.dot(pin["axis"], side) > 0.99 and abs(normal.dot(pin["center_mm"]) - offset) < ON_CUT_MM for pin in pins)
            area = part.area_faces[on_plane & (part.face_normals @ side > 0.99)].sum()
            if area > 0:
                faces.append((not has_pin, area, side if has_pin else -side))
    return max(faces, key=lambda face: face[:2])[2] if faces else None


def cube_directions():
    """The directions from a cube's middle to its faces, edges and corners."""
    corners = [np.array(way, float) for way in itertools.product((-1, 0, 1), repeat=3) if any(way)]
    return [way / np.linalg.norm(way) for way in corners]


def judge_part(kit, sheet, row, options):
    """A line of the table: the part, its mass and its support in each pose."""
    place = np.array(row["print_from_model"])
    written = trimesh.load(Path(kit, row["file"]), process=True)
    part = written.copy()
    part.vertices = (written.vertices - place[:3, 3]) @ place[:3, :3]
    layer_mm = float(re.search(r"^first_layer_height = ([\d.]+)", Path(options.profile).read_text(), re.M).group(1))
    pins = row.get("pins", [])

    def in_pose(up):
        mesh = turned(part, up)
        if rests_on_pin(part, pins, up, layer_mm) or foot_mm2(mesh, layer_mm) < LEAST_FOOT_MM2:
            return None
        code = sliced(mesh, options)
        if code is None:
            return None
        grams, bed_mm2 = weigh(code)
        height_mm = mesh.extents[2]
        is_firm = bed_mm2 + foot_mm2(mesh, layer_mm) >= max(LEAST_BED_MM2, (height_mm / SLENDERNESS) ** 2)
        return grams if is_firm else None

    def by_face():
        up = on_cut_face(part, sheet, pins)
        code = None if up is None else sliced(turned(part, up), options)
        return None if code is None else weigh(code)[0]

    ways = [] if options.no_cube else cube_directions()
    with ThreadPoolExecutor(options.jobs) as pool:
        as_written = pool.submit(sliced, written, options)
        on_face = pool.submit(by_face)
        of_cube = list(pool.map(in_pose, ways))
    code = as_written.result()
    if code is None:
        sys.exit(f"{kit}: {row['id']} as written cannot be sliced")
    kept = [(grams, way) for grams, way in zip(of_cube, ways) if grams is not None]
    best, way = min(kept, key=lambda pose: pose[0]) if kept else (None, None)
    return {
        "kit": Path(kit).name, "id": row["id"], "mass": row["mass_g"], "written": weigh(code)[0], "foot": foot_mm2(on_plate(written), layer_mm),
        "estimate": (row.get("support") or {}).get("material_mm3", 0.0), "face": on_face.result(),
        "best": best, "way": None if way is None else np.sign(np.round(way, 2)).astype(int).tolist(), "kept": len(kept),
    }  # fmt: skip


def fails(line):
    if line["foot"] < LEAST_FOOT_MM2:
        return True
    return line["best"] is not None and line["written"] > max(WORST_RATIO * line["best"], NEXT_TO_NOTHING_G)


def text(grams):
    return "-" if grams is None else f"{grams:.2f}"


def main():
    parser = argparse.ArgumentParser(description="A slicer weighs the support of a kit's parts.")
    parser.add_argument("kits", nargs="+", metavar="KIT")
    parser.add_argument("--profile", required=True)
    parser.add_argument("--slicer", default="prusa-slicer")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--part")
    parser.add_argument("--no-cube", action="store_true")
    options = parser.parse_args()
    if shutil.which(options.slicer) is None or not Path(options.profile).exists():
        sys.stderr.write(f"{options.slicer} or {options.profile} is not there\n")
        return 2
    print("kit part: mass g; support g as written, by the sheet, on a cut face, best of 26 (how many keep the rules, up)")
    failed = 0
    for kit in options.kits:
        if not Path(kit, "checklist.json").exists():
            sys.stderr.write(f"{kit} is no kit: it has no checklist.json\n")
            return 2
        sheet = json.loads(Path(kit, "checklist.json").read_text())
        density = sheet["material"].get("density_g_cm3", 1.24)
        for row in sheet["parts"]:
            if options.part not in (None, row["id"]):
                continue
            line = judge_part(kit, sheet, row, options)
            failed += fails(line)
            estimate = line["estimate"] * density / 1000
            print(
                f"{'WRONG' if fails(line) else 'ok   '} {line['kit']} {line['id']}: {line['mass']:.2f}; {text(line['written'])}, "
                f"{estimate:.2f}, {text(line['face'])}, {text(line['best'])} ({line['kept']}, {line['way']})",
                flush=True,
            )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
