#!/usr/bin/env python3
"""Judges the drawings of a cutter's coupons: Python with ezdxf, shapely, trimesh and manifold3d, nothing of the program.

    python3 tests/judge/judge_cut.py FOLDER

FOLDER is what `equipoise coupon --cutter ID --sheet ID` wrote. The DXF must pass ezdxf's audit, be in millimetres, and hold closed
polylines without bulges for cuts and open ones for engraving, none twice. The SVG must hold the same points, in mm, without a scale.
The squares must be as drawn in coupon.json; each slot, after the beam has taken half a kerf on both sides, as wide as it says. Both
panels of each joint are put together at its angle: loose and exact ones must not overlap, and pressed ones must.
Exit code 0: all of it holds; 1: else, with a line for each fault.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
import trimesh
from shapely.geometry import Polygon

from cut_drawings import NEAR_MM, read_both

# Drawings are rounded to a ten-thousandth, over some hundred mm² of faces that touch.
TOUCH_MM3, PRESSED_MM3 = 0.02, 0.1


def size(points):
    return [max(p[axis] for p in points) - min(p[axis] for p in points) for axis in (0, 1)]


def check_slots(plate, sizes, faults):
    """Holds the widths of the open slots of the plate against those that the sizes name."""
    half = sizes["offset_kerf_mm"] / 2
    top = max(y for _, y in plate)
    low = min(y for _, y in plate)
    level = (top + low) / 2 + (top - low) * 0.3
    crossings = []
    for a, b in zip(plate, plate[1:] + plate[:1]):
        if (a[1] > level) != (b[1] > level):
            crossings.append(a[0] + (b[0] - a[0]) * (level - a[1]) / (b[1] - a[1]))
    # The outside of the plate comes first and last; between two teeth lies a slot.
    crossings = sorted(crossings)[1:-1]
    widths = [b - a + 2 * half for a, b in zip(crossings[::2], crossings[1::2])]
    if len(widths) != len(sizes["slots"]):
        faults.append(f"{len(widths)} slots, not {len(sizes['slots'])}")
    for width, slot in zip(widths, sizes["slots"]):
        if abs(width - slot["width_mm"]) > NEAR_MM:
            faults.append(f"slot {slot['number']} is {width:.4f} mm wide, not {slot['width_mm']:.4f}")


def panel(points, sizes, angle, side):
    """A panel as the beam leaves it, its outer face in a plane through the x axis that leans by half the angle."""
    sheet = sizes["thickness_mm"]
    left = Polygon(points).buffer(-sizes["offset_kerf_mm"] / 2, join_style=2, mitre_limit=5)
    x, y, *_ = left.bounds
    # The tips of the fingers are known from the angle alone.
    tip = max(0.0, sheet / math.tan(angle))
    placed = Polygon([(a - x, b - y + tip) for a, b in left.exterior.coords])
    body = trimesh.creation.extrude_polygon(placed, sheet)
    along, across, deep = body.vertices.T
    sine, cosine = math.sin(angle / 2), math.cos(angle / 2)
    corners = np.stack([along, side * (across * sine - deep * cosine), across * cosine + deep * sine], axis=1)
    body = trimesh.Trimesh(corners, body.faces)
    if body.volume < 0:
        body.invert()
    return body


def check_joints(panels, sizes, faults):
    for joint, pair in zip(sizes["joints"], zip(panels[::2], panels[1::2])):
        angle = math.radians(joint["angle_deg"])
        bodies = [panel(points, sizes, angle, side) for points, side in zip(pair, (1, -1))]
        shared = trimesh.boolean.intersection(bodies, engine="manifold")
        overlap = shared.volume if len(shared.faces) else 0.0
        if (overlap > PRESSED_MM3) != (joint["press_mm"] > 0) or joint["press_mm"] <= 0 and overlap > TOUCH_MM3:
            faults.append(f"the panels of {joint['name']} overlap by {overlap:.3f} mm³")


def judge(folder):
    faults = []
    sizes = json.loads((folder / "coupon.json").read_text())
    lines, _ = read_both(folder / "coupon.dxf", folder / "coupon.svg", faults)
    cuts = [points for layer, _, points in lines if layer == "CUT_OUTER"]
    squares = [points for points in cuts if all(abs(side - sizes["side_mm"]) < NEAR_MM for side in size(points))]
    if len(squares) != sizes["squares"]:
        faults.append(f"{len(squares)} squares, not {sizes['squares']}")
    if len(cuts) != sizes["squares"] + 1 + 2 * len(sizes["joints"]):
        faults.append(f"{len(cuts)} pieces to be cut")
    check_slots(cuts[sizes["squares"]], sizes, faults)
    check_joints(cuts[sizes["squares"] + 1 :], sizes, faults)
    return faults


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = judge(Path(sys.argv[1]))
    print("\n".join(found) or "the drawings are as coupon.json says")
    sys.exit(1 if found else 0)
