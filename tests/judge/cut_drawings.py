"""Reads drawings for cutters, DXF by ezdxf and SVG as text, and holds one against the other. Nothing of the program."""

import re
import xml.etree.ElementTree as tree

import ezdxf

CUTS, ENGRAVING, EDGE = ("CUT_INNER", "CUT_OUTER"), "ENGRAVE", "SHEET"
NEAR_MM = 2e-4
SVG = "{http://www.w3.org/2000/svg}"


def lines_of_dxf(path, faults):
    """The lines of a DXF as (layer, kind, points); a circle's points are its middle and (radius, 0)."""
    drawing = ezdxf.readfile(path)
    audit = drawing.audit()
    faults += [f"audit: {entry.message}" for entry in [*audit.errors, *audit.fixes]]
    if drawing.units != 4:
        faults.append(f"units are {drawing.units}, not mm")
    lines = []
    for entity in drawing.modelspace():
        if entity.dxftype() == "CIRCLE":
            lines.append((entity.dxf.layer, "circle", [(entity.dxf.center.x, entity.dxf.center.y), (entity.dxf.radius, 0.0)]))
        elif entity.dxftype() == "LWPOLYLINE":
            points = [(x, y) for x, y, *_, bulge in entity.get_points() if not bulge or faults.append("a bulge")]
            lines.append((entity.dxf.layer, "closed" if entity.closed else "open", points))
        else:
            faults.append(f"an entity is a {entity.dxftype()}")
    return lines


def lines_of_svg(path, faults):
    """The lines of an SVG in the frame of the DXF, and the size of the drawing in mm."""
    root = tree.parse(path).getroot()
    width, height = (float(re.fullmatch(r"([\d.]+)mm", root.get(side)).group(1)) for side in ("width", "height"))
    if [float(number) for number in root.get("viewBox").split()] != [0, 0, width, height]:
        faults.append("the view box scales the drawing")
    lines = []
    for group in root:
        for shape in group:
            if group.get("transform") or shape.get("transform"):
                faults.append("a transform")
            if shape.tag == f"{SVG}circle":
                x, y, radius = (float(shape.get(name)) for name in ("cx", "cy", "r"))
                lines.append((group.get("id"), "circle", [(x, height - y), (radius, 0.0)]))
                continue
            pairs = [pair.split(",") for pair in shape.get("points").split()]
            points = [(float(x), height - float(y)) for x, y in pairs]
            lines.append((group.get("id"), "closed" if shape.tag == f"{SVG}polygon" else "open", points))
    return lines, (width, height)


def area(points):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))


def read_both(dxf_path, svg_path, faults):
    """The lines of a drawing that was written both ways, and its size; what is wrong with either goes to the faults."""
    dxf = lines_of_dxf(dxf_path, faults)
    svg, size = lines_of_svg(svg_path, faults)
    for layer, kind, points in dxf:
        if (kind != "open") != (layer in (*CUTS, EDGE)) or layer not in (*CUTS, ENGRAVING, EDGE):
            faults.append(f"a line on {layer} is {kind}")
        if kind == "closed" and len(points) < 3 or len(points) < 2:
            faults.append("a line has no length")
        if layer == "CUT_OUTER" and area(points) <= 0:
            faults.append("an outline goes clockwise")
    rounded = [(layer, tuple((round(x, 3), round(y, 3)) for x, y in points)) for layer, _, points in dxf]
    if len(set(rounded)) != len(rounded):
        faults.append("a line is drawn twice")
    if len(dxf) != len(svg):
        faults.append(f"the DXF has {len(dxf)} lines and the SVG {len(svg)}")
    for (layer, kind, a), (other, same, b) in zip(dxf, svg):
        apart = max((abs(p - q) for one, two in zip(a, b) for p, q in zip(one, two)), default=0)
        if (layer, kind, len(a)) != (other, same, len(b)) or apart > NEAR_MM:
            faults.append(f"a line on {layer} differs between both files")
    return dxf, size
