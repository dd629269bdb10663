#!/usr/bin/env python3
"""Judges the drawings of sheets with panels: Python with ezdxf and shapely, nothing of the program.

    python3 tests/judge/judge_sheets.py FOLDER

FOLDER holds sheet-1.dxf and sheet-1.svg, and so on, and sheets.json: `kerf_mm` by which lines are offset, `spacing_mm` and `margin_mm`
that are promised, and for each panel its sheet, the area of its outline and the diameters of its holes as they should come out.
Both files of a sheet must hold the same lines, closed where they cut and none twice. The beam takes half a kerf on either side of its
path. What it leaves must have the areas and diameters that are promised, lie inside the sheet's edge less the margin, and keep the
spacing to its neighbours. Holes and engraving lie on a panel, clear of its edge, and no engraving runs into a hole.
Exit code 0: all of it holds, and a line of figures for each sheet; 1: else, with a line for each fault.
"""

import json
import math
import sys
from pathlib import Path

from shapely.geometry import LineString, Point, Polygon, box

from cut_drawings import read_both

NEAR_MM = 1e-3


def left_by_beam(points, kerf):
    return Polygon(points).buffer(-kerf / 2, join_style=2, mitre_limit=20)


def check_panel(number, body, path, promised, on_sheet, faults):
    """Holds one panel against what was promised; the areas may differ by the reliefs in its inner corners."""
    holes, kerf = on_sheet
    bores = [(Point(middle), 2 * radius + kerf) for middle, (radius, _) in holes if path.contains(Point(middle))]
    found, wanted = sorted(size for _, size in bores), sorted(promised["holes_mm"])
    if len(found) != len(wanted) or any(abs(a - b) > NEAR_MM for a, b in zip(found, wanted)):
        faults.append(f"panel {number} has holes of {found} mm, not {wanted}")
    for middle, size in bores:
        if body.exterior.distance(middle) < size / 2 + kerf:
            faults.append(f"a hole of panel {number} is open to its edge")
    relief = promised["inner_corners"] * kerf**2
    short = promised["area_mm2"] - body.area
    if not -NEAR_MM * path.length < short < relief + NEAR_MM * path.length:
        faults.append(f"panel {number} has {body.area:.3f} mm², not {promised['area_mm2']:.3f}")


def judge_sheet(folder, index, promised, faults):
    found = []
    lines, size = read_both(folder / f"sheet-{index}.dxf", folder / f"sheet-{index}.svg", found)
    kerf = promised["kerf_mm"]
    paths = [Polygon(points) for layer, _, points in lines if layer == "CUT_OUTER"]
    holes = [points for layer, kind, points in lines if layer == "CUT_INNER" and kind == "circle"]
    strokes = [LineString(points) for layer, _, points in lines if layer == "ENGRAVE"]
    edges = [Polygon(points) for layer, _, points in lines if layer == "SHEET"]
    panels = [panel for panel in promised["panels"] if panel["sheet"] == index]
    if len(edges) != 1 or abs(edges[0].area - size[0] * size[1]) > NEAR_MM or len(paths) != len(panels):
        found.append(f"{len(edges)} edges of the sheet, {len(paths)} panels of {len(panels)}")
    bodies = [left_by_beam(path.exterior.coords, kerf) for path in paths]
    room = box(0, 0, *size).buffer(-promised["margin_mm"] + NEAR_MM, join_style=2)
    for number, (body, path, panel) in enumerate(zip(bodies, paths, panels), 1):
        if body.geom_type != "Polygon" or not path.is_valid:
            found.append(f"panel {number} falls apart")
            continue
        if not room.contains(body):
            found.append(f"panel {number} lies in the margin")
        check_panel(number, body, path, panel, (holes, kerf), found)
    apart = [a.distance(b) for at, a in enumerate(bodies) for b in bodies[:at]]
    if min(apart, default=math.inf) < promised["spacing_mm"] - NEAR_MM:
        found.append(f"two panels are {min(apart):.3f} mm apart")
    for stroke in strokes:
        on = [body for body in bodies if body.buffer(-0.5).contains(stroke)]
        near = [middle for middle, (radius, _) in holes if stroke.distance(Point(middle)) < radius + 0.5]
        if len(on) != 1 or near:
            found.append("engraving runs over an edge or a hole")
    faults += [f"sheet {index}: {fault}" for fault in found]
    cut = sum(path.length for path in paths) + sum(2 * math.pi * radius for _, (radius, _) in holes)
    area = sum(panel["area_mm2"] - sum(math.pi * d * d / 4 for d in panel["holes_mm"]) for panel in panels)
    return {"cut_mm": cut, "engraved_mm": sum(stroke.length for stroke in strokes), "area_mm2": area, "size_mm": size}


def judge(folder):
    faults = []
    promised = json.loads((folder / "sheets.json").read_text())
    count = len(list(folder.glob("sheet-*.dxf")))
    figures = [judge_sheet(folder, index, promised, faults) for index in range(1, count + 1)]
    return faults, figures


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    wrong, told = judge(Path(sys.argv[1]))
    print("\n".join(wrong) or json.dumps(told))
    sys.exit(1 if wrong else 0)
