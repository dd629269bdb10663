#!/usr/bin/env python3
"""An independent judge of the kit of an object on a laser-cut base: Python, numpy, scipy, trimesh, manifold3d, shapely and ezdxf, nothing of
the program.

    python3 tests/judge/judge_core.py KIT [KIT ...]

Reads the parts and the model (STL), the sheets (DXF and SVG), panels.json and certificate.json, and from checklist.json what was promised.
Checks the certificate triangle by triangle, builds the base from its planes and the panels from their outlines, takes the object apart unit by
unit with solid intersections, cuts the sheets, and weighs everything. Prints promise against measurement. Exit code 0: all agree; 1: something
does not; 2: no kit.
"""

import hashlib
import json
import math
import sys
import tomllib
from pathlib import Path

import manifold3d
import networkx
import numpy as np
import scipy.optimize
import scipy.spatial
import shapely
import trimesh
from shapely.geometry import Point, Polygon, box

from cut_drawings import read_both

PARTED_MM = 1e-6
SAMPLED_MM = 1e-3
OUTSIDE_MM3 = 1e-2
PANELS_MM3 = 1e-3
IN_BASE_MM3 = 1e-2
HEADS_MM3 = 0.05
# Steps of a unit on its way out, mm, and the volume that it may share with what stands, mm³.
STEPS_MM = (0.2, 2.0, 8.0, 30.0, 100.0, 350.0)
WAY_MM3 = 1e-2
VOLUME_RATIO = 1e-6
MASS_RATIO = 1e-6
CENTRE_MM = 1e-3
TOPPLING_DEG = 0.01
NEAR_MM = 1e-3
# By how much less is looked for about pins, mm, and the volume that may be missing there, mm³.
NEAR_PIN_MM = 0.05
PIN_MM3 = 0.02
TOUCH_MM = 5e-3
BAND_RATIO = 0.002
SAMPLES = 4000
# The catalogue of ballast: what a part of a name is and weighs.
STOCK = {
    part["id"]: part
    for file in (Path(__file__).parents[2] / "profiles/ballast").glob("*.toml")
    for part in tomllib.loads(file.read_text())["part"]
}
# The catalogue of fasteners: the rods.
RODS = {
    part["id"]: part
    for part in tomllib.loads((Path(__file__).parents[2] / "profiles/fasteners/dowels.toml").read_text())["part"]
}
# The least and the greatest play of a rod in its hole, mm.
ROD_PLAY_MM = (0.1, 1.0)
STRAY_SIDES = "sides that lie between no polyhedra"


def solid_of(mesh):
    """Returns a mesh as a solid, in double precision."""
    return manifold3d.Manifold(manifold3d.Mesh64(np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.uint64)))


def moments(mesh):
    """Volume and first moments of a closed mesh, about its own middle."""
    middle = mesh.bounds.mean(axis=0)
    a, b, c = (mesh.triangles[:, k] - middle for k in range(3))
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    volume = math.fsum(six) / 6
    first = np.array([math.fsum(six * (a + b + c)[:, k]) / 24 for k in range(3)])
    return volume, first + volume * middle


class Base:
    """A polyhedron of the base: its planes, and the planes between it and others."""

    def __init__(self, certificate):
        self.planes = np.array(certificate["planes"])
        self.sides = np.array(certificate.get("sides", [])).reshape(-1, 4)
        self.named = np.array(certificate["faces"])

    def solid(self, by, is_bounded=False, inset=0.0):
        """The polyhedron with each plane moved out by a distance; if asked, bounded by the planes to others, or by these moved in."""
        planes = self.planes + [0, 0, 0, by]
        if is_bounded:
            planes = np.concatenate([planes, self.sides - [0, 0, 0, inset]])
        half = np.column_stack([planes[:, :3], -planes[:, 3]])
        corners = scipy.spatial.HalfspaceIntersection(half, self.middle()).intersections
        return manifold3d.Manifold.hull_points(corners), corners

    def middle(self):
        """A point inside: the middle of the largest ball."""
        rows = np.column_stack([self.planes[:, :3], np.ones(len(self.planes))])
        best = scipy.optimize.linprog([0, 0, 0, -1], A_ub=rows, b_ub=self.planes[:, 3], bounds=[(None, None)] * 3 + [(0, None)])
        return best.x[:3]


class Kit:
    def __init__(self, folder):
        self.folder = Path(folder)
        load = lambda name: json.loads((self.folder / name).read_text())
        self.sheet, self.panels, self.certificate = load("checklist.json"), load("panels.json")["panels"], load("certificate.json")
        self.bases = [Base(one) for one in [self.certificate, *self.certificate.get("others", [])]]
        self.model = trimesh.load(self.folder / self.certificate["model"], process=False)
        scale = np.array(self.sheet["printer"].get("print_scale_ratio") or [1.0] * 3)
        self.parts = {}
        for part in self.sheet["parts"]:
            mesh = trimesh.load(self.folder / part["file"], process=False)
            # Corners of a file that are the same number are one; the turn below would round them apart.
            mesh.merge_vertices(digits_vertex=12)
            back = np.linalg.inv(np.array(part["print_from_model"]))
            mesh.vertices = (np.asarray(mesh.vertices) / scale) @ back[:3, :3].T + back[:3, 3]
            self.parts[part["id"]] = mesh
        self.solids = {name: solid_of(mesh) for name, mesh in self.parts.items()}
        self.thick = self.sheet["sheet"]["thickness_mm"]
        self.faults = []

    def check(self, name, found, holds, limit):
        print(f"  {'ok  ' if holds else 'FAIL'} {name}: {found:.6g} ({limit})")
        if not holds:
            self.faults.append(name)

    def panel_solid(self, panel):
        ring = np.array(panel["outline_mm"])
        section = manifold3d.CrossSection([ring])
        body = manifold3d.Manifold.extrude(section, self.thick)
        axes = np.array(panel["axes"]).T
        place = np.column_stack([axes, np.array(panel["origin_mm"]) - axes[:, 2] * self.thick])
        return body.transform(place)

    def base_of(self, panel):
        return self.bases[panel.get("polyhedron", 1) - 1]

    def polyhedron(self, number):
        """The polyhedron of a panel."""
        return self.panels[number - 1].get("polyhedron", 1)

    def group(self, unit):
        """The polyhedron of a unit by its panel and its parts of the shell, whatever it is told to be; 0 if there are several."""
        if len(self.bases) == 1:
            return 1
        shell = [part for part in self.sheet["parts"] if part["id"] in unit["parts"] and part["kind"] == "shell"]
        found = {self.polyhedron(number) for number in [unit["panel"], *(part["panel"] for part in shell)] if number}
        return found.pop() if len(found) == 1 else 0


def judge_files(kit):
    listed = kit.sheet["files"]
    wrong = [file for file, sha in listed.items() if hashlib.sha256((kit.folder / file).read_bytes()).hexdigest() != sha]
    kit.check("files that changed", len(wrong), not wrong, "0")


def pieces(triangles, longest):
    """Halves triangles at the middle of their longest edge until all edges are short; keeps their order."""
    order = np.arange(len(triangles), dtype=np.float64)
    width = np.ones(len(triangles))
    done, keys = [], []
    while len(triangles):
        squared = np.stack([((triangles[:, (k + 1) % 3] - triangles[:, k]) ** 2).sum(axis=1) for k in range(3)], axis=1)
        edge = np.argmax(squared, axis=1)
        short = squared.max(axis=1) <= longest * longest
        done.append(triangles[short])
        keys.append(order[short])
        triangles, edge, order, width = triangles[~short], edge[~short], order[~short], width[~short] / 2
        rows = np.arange(len(triangles))
        a, b, c = (triangles[rows, (edge + k) % 3] for k in range(3))
        middle = 0.5 * a + 0.5 * b
        triangles = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
        order, width = np.concatenate([order, order + width]), np.concatenate([width, width])
    done, keys = np.concatenate(done), np.concatenate(keys)
    return done[np.argsort(keys, kind="stable")]


def judge_base(kit):
    certificate, distance = kit.certificate, kit.certificate["distance_mm"]
    cut = pieces(np.asarray(kit.model.triangles), certificate["longest_edge_mm"])
    model = trimesh.Trimesh(kit.model.vertices, kit.model.faces, process=True)
    all_corners = []
    for base in kit.bases:
        same = len(cut) == len(base.named) and base.named.max() < len(base.planes)
        kit.check("pieces of the surface", len(cut), same, f"{len(base.named)} in the certificate")
        if same:
            planes = base.planes[base.named]
            heights = np.einsum("ijk,ik->ij", cut, planes[:, :3]) - planes[:, 3:]
            kit.check("parted by, mm", heights.min(), heights.min() >= distance - PARTED_MM, f"at least {distance}")
        body, corners = base.solid(0.0)
        all_corners.append(corners)
        outside = (body - solid_of(model)).volume()
        kit.check("volume of the base outside, mm³", outside, outside <= OUTSIDE_MM3, OUTSIDE_MM3)
        hull = trimesh.convex.convex_hull(corners)
        points = np.concatenate([trimesh.sample.sample_surface(hull, SAMPLES, seed=7)[0], corners])
        near = np.abs(trimesh.proximity.closest_point(model, points)[1]).min()
        kit.check("sampled distance of the base, mm", near, near >= distance - SAMPLED_MM, f"at least {distance}")
    for one in range(len(kit.bases)):
        for other in range(one):
            # Any plane between both will do: the judge looks for one among their sides.
            gaps = [-math.inf]
            for side in kit.bases[one].sides:
                below = side[3] - (all_corners[one] @ side[:3]).max()
                above = (all_corners[other] @ side[:3]).min() - side[3]
                gaps.append(min(below, above))
            kit.check(f"polyhedra {other + 1} and {one + 1} apart, mm", max(gaps), max(gaps) >= 0, 0)
    # Parts keep no distance beyond sides, so each must be a plane between two polyhedra.
    stray = 0
    for one, base in enumerate(kit.bases):
        for side in base.sides:
            flipped = any((other.sides == -side).all(axis=1).any() for other in kit.bases if other is not base)
            stray += not (flipped and (all_corners[one] @ side[:3]).max() <= side[3])
    kit.check(STRAY_SIDES, stray, stray == 0, 0)
    return solid_of(model)


def judge_panels(kit):
    bodies = [kit.panel_solid(panel) for panel in kit.panels]
    shared = [(a ^ b).volume() for at, a in enumerate(bodies) for b in bodies[:at]]
    kit.check("volume that two panels share, mm³", max(shared, default=0), max(shared, default=0) <= PANELS_MM3, PANELS_MM3)
    out = -math.inf
    for panel, body in zip(kit.panels, bodies):
        planes = kit.base_of(panel).planes
        corners = body.to_mesh64().vert_properties[:, :3]
        out = max(out, (corners @ planes[:, :3].T - planes[:, 3]).max())
    kit.check("panels out of the base, mm", out, out <= 1e-6, 1e-6)
    screws = [one for one in kit.sheet["fasteners"] if one["kind"] not in ("insert", "nut")]
    loose = 0
    for screw in screws:
        own = passed(kit, screw, screw["panel"])
        other = passed(kit, screw, screw["through"]) if screw.get("through") else own
        bears = own and (screw["kind"] == "bolt" or abs(own[0]) < NEAR_MM and own[2] < screw["head_mm"][0])
        loose += not (bears and other)
    kit.check("screws without a hole", loose, loose == 0, f"0 of {len(screws)}")
    judge_bolts(kit)
    return bodies


def on_axis(one, points):
    """How far along the axis of a fastener points lie from its seat, and their greatest distance from the axis, mm."""
    away = np.atleast_2d(points) - one["seat_mm"]
    along = away @ np.array(one["axis"])
    return along, np.linalg.norm(away - np.outer(along, one["axis"]), axis=1).max()


def passed(kit, one, number):
    """Where the axis of a fastener enters a hole of a panel and leaves it, mm from its seat, and the hole's diameter. None: no hole."""
    panel = kit.panels[number - 1]
    if abs(np.linalg.norm(one["axis"]) - 1) > 1e-9 or on_axis(one, one["center_mm"])[1] > NEAR_MM:
        return None
    for hole in panel["holes"]:
        local = np.array([[*hole["at_mm"], 0.0], [*hole["at_mm"], -kit.thick]])
        along, off = on_axis(one, local @ np.array(panel["axes"]) + panel["origin_mm"])
        if off < NEAR_MM and along.min() > -NEAR_MM:
            return along.min(), along.max(), hole["diameter_mm"]
    return None


def judge_bolts(kit):
    """Each bolt holds panels of two polyhedra between two washers and a nut, and fits the holes."""
    all_of = lambda kind: [one for one in kit.sheet["fasteners"] if one["kind"] == kind]
    loose = 0
    for bolt in all_of("bolt"):
        first, second = passed(kit, bolt, bolt["panel"]), passed(kit, bolt, bolt["through"]) if bolt.get("through") else None
        of = lambda kind, number, turn: [
            one for one in all_of(kind) if one["panel"] == number and abs(np.dot(one["axis"], bolt["axis"]) - turn) < 1e-9
            and on_axis(bolt, [one["seat_mm"], one["center_mm"]])[1] < NEAR_MM
        ]
        near, far = of("washer", bolt["panel"], 1), of("washer", bolt.get("through"), -1)
        nuts = of("nut", bolt.get("through"), -1)
        if not (first and second and bolt.get("shaft_mm") and [len(nuts), len(near), len(far)] == [1, 1, 1]):
            loose += 1
            continue
        thread, length = bolt["shaft_mm"]
        seat = on_axis(bolt, nuts[0]["seat_mm"])[0][0]
        holds = (
            kit.polyhedron(bolt["panel"]) != kit.polyhedron(bolt["through"])
            and 0 < thread <= min(first[2], second[2])
            and abs(first[0] - near[0]["head_mm"][1]) < NEAR_MM
            and abs(seat - second[1] - far[0]["head_mm"][1]) < NEAR_MM
            and first[1] <= second[0] + NEAR_MM
            and seat + nuts[0]["head_mm"][1] <= length + NEAR_MM
        )
        loose += not holds
    bolts, nuts, washers = (len(all_of(kind)) for kind in ("bolt", "nut", "washer"))
    kit.check("bolts that hold no panels", loose, loose == 0, f"0 of {bolts}")
    kit.check("nuts and washers", nuts + washers, [nuts, washers] == [bolts, 2 * bolts], 3 * bolts)


def judge_sheet(kit, index, promised):
    faults = []
    lines, size = read_both(kit.folder / promised["dxf"], kit.folder / promised["svg"], faults)
    cut = kit.sheet["sheet"]
    kerf, spacing, margin = cut["offset_kerf_mm"], cut["spacing_mm"], cut["margin_mm"]
    paths = [Polygon(points) for layer, _, points in lines if layer == "CUT_OUTER"]
    holes = [points for layer, kind, points in lines if layer == "CUT_INNER" and kind == "circle"]
    rings, count = [], 0
    for place in promised["panels"]:
        panel = kit.panels[place["panel"] - 1]
        turn = np.array([[math.cos(place["turn_rad"]), -math.sin(place["turn_rad"])], [math.sin(place["turn_rad"]), math.cos(place["turn_rad"])]])
        # The inner face is up: a panel lies as it is seen from inside.
        put = lambda points: np.asarray(points, float).reshape(-1, 2) * [-1, 1] @ turn.T + place["at_mm"]
        ring = Polygon(put(panel["outline_mm"]))
        rings.append(ring)
        own = [path for path in paths if path.intersection(ring).area > 0.9 * ring.area]
        if len(own) != 1:
            faults.append(f"panel {place['panel']} has {len(own)} paths")
            continue
        left = own[0].buffer(-kerf / 2, join_style=2, mitre_limit=20)
        relief = kerf**2 * len(panel["outline_mm"]) + 2 * NEAR_MM * ring.length
        if left.symmetric_difference(ring).area > relief:
            faults.append(f"panel {place['panel']} comes out {left.symmetric_difference(ring).area:.3f} mm² off")
        # The beam takes no more of a panel than reliefs in its inner corners.
        beam = shapely.LineString([*own[0].exterior.coords]).buffer(kerf / 2)
        if beam.intersection(ring.buffer(-NEAR_MM)).area > relief:
            faults.append(f"the beam cuts into panel {place['panel']}")
        for hole in panel["holes"]:
            count += 1
            at = put(hole["at_mm"])[0]
            fits = [abs(2 * radius + kerf - hole["diameter_mm"]) < NEAR_MM for middle, (radius, _) in holes if math.dist(middle, at) < NEAR_MM]
            if fits != [True] or not ring.contains(Point(at).buffer(hole["diameter_mm"] / 2)):
                faults.append(f"a hole of panel {place['panel']} is wrong")
    if count != len(holes) or len(paths) != len(rings):
        faults.append(f"{len(holes)} holes of {count}, {len(paths)} paths of {len(rings)}")
    apart = [a.distance(b) for at, a in enumerate(rings) for b in rings[:at]]
    if min(apart, default=math.inf) < spacing - NEAR_MM:
        faults.append(f"two panels are {min(apart):.3f} mm apart")
    room = box(0, 0, *size).buffer(-margin + NEAR_MM, join_style=2)
    if list(size) != list(promised["size_mm"]) or not all(room.contains(ring) for ring in rings):
        faults.append("a panel lies in the margin, or the sheet has another size")
    print(f"  {promised['dxf']}: {len(rings)} panels, {len(holes)} holes, least distance {min(apart, default=math.nan):.3f} mm")
    for fault in faults:
        print(f"    {fault}")
    kit.check(f"faults of sheet {index + 1}", len(faults), not faults, "0")
    return [place["panel"] for place in promised["panels"]]


def judge_parts(kit, model):
    shell = [part for part in kit.sheet["parts"] if part["kind"] == "shell"]
    broken = [name for name, mesh in kit.parts.items() if not mesh.is_watertight or mesh.body_count != 1]
    kit.check("parts that are no closed body", len(broken), not broken, "0")
    room = kit.sheet["printer"]["build_volume_mm"]
    for part in kit.sheet["parts"]:
        pose = np.array(part["print_from_model"])
        points = kit.parts[part["id"]].vertices @ pose[:3, :3].T + pose[:3, 3]
        low, size = points.min(axis=0), np.ptp(points, axis=0)
        lies = lambda x, y: size[0] <= x + NEAR_MM and size[1] <= y + NEAR_MM
        fits = room is None or size[2] <= room[2] + NEAR_MM and (lies(room[0], room[1]) or lies(room[1], room[0]))
        if abs(low[2]) > NEAR_MM or not fits:
            kit.faults.append(f"part {part['id']} does not lie in the printer's room")
    grown = [base.solid(kit.sheet["gap_mm"], True)[0] for base in kit.bases]
    clear = [base.solid(kit.sheet["gap_mm"] - 0.01, True, 0.01)[0] for base in kit.bases]
    inside = sum((kit.solids[part["id"]] ^ one).volume() for part in shell for one in clear)
    kit.check("parts within the gap, mm³", inside, inside <= IN_BASE_MM3, IN_BASE_MM3)
    pins = lambda part: part.get("pins_mm3", [0.0, 0.0])
    parts = math.fsum(moments(kit.parts[part["id"]])[0] + part["void_mm3"] + part["bores_mm3"] + pins(part)[1] - pins(part)[0] for part in shell)
    whole = moments(kit.model)[0]
    off = (parts + sum((one ^ model).volume() for one in grown)) / whole - 1
    kit.check("sum of volumes, relative", off, abs(off) <= VOLUME_RATIO, VOLUME_RATIO)


def bar(peg, radius, low, high):
    """A round bar about the axis of a pin, between two heights."""
    place = trimesh.geometry.align_vectors([0, 0, 1], peg["direction"])
    place[:3, 3] = np.array(peg["center_mm"]) + low * np.array(peg["direction"])
    return manifold3d.Manifold.cylinder(high - low, radius, circular_segments=96).transform(place[:3])


def cone(a, b, height):
    return math.pi * height / 3 * (a * a + a * b + b * b)


def judge_pins(kit):
    """Every pin is there, has room in its socket, a wall about it, and stands along the way of its unit."""
    pegs, units = kit.sheet.get("pins", []), kit.sheet["units"]
    wall = kit.sheet["printer"]["minimum_wall_mm"]
    wrong = []
    unit_of = lambda name: next(at for at, unit in enumerate(units) if name in unit["parts"])
    volumes = {name: [0.0, 0.0] for name in kit.parts}
    for peg in pegs:
        on, into = kit.solids[peg["on"]], kit.solids[peg["into"]]
        thick, wide, long, deep = peg["diameter_mm"] / 2, peg["socket_diameter_mm"] / 2, peg["length_mm"], peg["socket_depth_mm"]
        tip, mouth = peg["chamfers_mm"]
        name = f"the pin of {peg['on']} into {peg['into']}"
        if peg["on"] == peg["into"] or not (0 < tip < thick < wide and 0 < long < deep and mouth >= 0) or abs(np.linalg.norm(peg["direction"]) - 1) > 1e-9:
            wrong.append(f"{name} is none")
            continue
        volumes[peg["on"]][0] += math.pi * thick**2 * (long - tip) + cone(thick, thick - tip, tip)
        volumes[peg["into"]][1] += math.pi * wide**2 * (deep - mouth) + cone(wide, wide + mouth, mouth)
        if (bar(peg, thick - NEAR_PIN_MM, NEAR_PIN_MM, long - tip) - on).volume() > PIN_MM3:
            wrong.append(f"{name} is not there")
        room = bar(peg, wide - NEAR_PIN_MM, NEAR_PIN_MM, deep - NEAR_PIN_MM)
        if (room ^ into).volume() > PIN_MM3:
            wrong.append(f"{name} has no room")
        if ((room - bar(peg, thick + NEAR_PIN_MM, 0, deep)) ^ on).volume() > PIN_MM3:
            wrong.append(f"{name} is thicker than listed")
        about = bar(peg, wide + wall - NEAR_PIN_MM, mouth + NEAR_PIN_MM, deep) - bar(peg, wide + NEAR_PIN_MM, 0, deep + 1)
        below = bar(peg, 0.9 * wide, deep + NEAR_PIN_MM, deep + wall - NEAR_PIN_MM)
        if (about - into).volume() > PIN_MM3 or (below - into).volume() > PIN_MM3:
            wrong.append(f"the socket of {name} lacks its wall")
        first, second = unit_of(peg["on"]), unit_of(peg["into"])
        if first != second:
            way = np.dot(units[max(first, second)]["way"], peg["direction"])
            if abs(way - (1 if second > first else -1)) > 1e-9:
                wrong.append(f"{name} stands across the way of its unit")
    benched, group = [peg for peg in pegs if unit_of(peg["on"]) == unit_of(peg["into"])], {name: {name} for name in kit.parts}
    for peg in benched:
        one, other = group[peg["on"]], group[peg["into"]]
        if one is other:
            continue
        across = [pin["direction"] for pin in benched if pin["on"] in one and pin["into"] in other or pin["on"] in other and pin["into"] in one]
        if min(abs(np.dot(peg["direction"], way)) for way in across) < 1 - 1e-9:
            wrong.append(f"{peg['into']} cannot be joined to {peg['on']} in turn")
        one |= other
        group.update({name: one for name in other})
    for part in kit.sheet["parts"]:
        told = part.get("pins_mm3", [0.0, 0.0])
        if any(abs(a - b) > 0.02 * b for a, b in zip(told, volumes[part["id"]])):
            wrong.append(f"the volumes of the pins of {part['id']} are others")
    for fault in wrong:
        print(f"    {fault}")
    kit.check("faults of pins", len(wrong), not wrong, f"0 of {len(pegs)} pins")


def ballast_solid(piece):
    place = trimesh.geometry.align_vectors([0, 0, 1], piece["axis"])
    height, radius = piece["shape"]["thickness_mm"], piece["shape"]["diameter_mm"] / 2
    place[:3, 3] = np.array(piece["center_mm"]) - height / 2 * np.array(piece["axis"])
    return manifold3d.Manifold.cylinder(height, radius, circular_segments=96).transform(place[:3])


def judge_ballast(kit, panels):
    """Every piece lies flat on its panel, in the place that is shown, within the base, and in nothing else."""
    pieces, wrong = kit.sheet.get("ballast", []), 0
    bodies = [ballast_solid(piece) for piece in pieces]
    for at, (piece, body) in enumerate(zip(pieces, bodies)):
        panel = kit.panels[piece["panel"] - 1]
        axes, half = np.array(panel["axes"]), piece["shape"]["thickness_mm"] / 2
        x, y, z = axes @ (np.array(piece["center_mm"]) - panel["origin_mm"])
        lies = abs(z + half + kit.thick) <= NEAR_MM and math.dist((x, y), piece["at_mm"]) <= NEAR_MM and np.linalg.norm(axes[2] - piece["axis"]) <= 1e-9
        within = Polygon(panel["outline_mm"]).contains(Point(x, y).buffer(piece["shape"]["diameter_mm"] / 2))
        base = kit.base_of(panel).solid(0.0)[0]
        others = [*kit.solids.values(), *panels, *bodies[:at]]
        shared = sum((body ^ other).volume() for other in others if meets(body, other))
        named = STOCK.get(piece["id"], {})
        stocked = all(named.get(key) == piece[key] for key in ("shape", "mass_g"))
        wrong += not (lies and within and (body - base).volume() <= IN_BASE_MM3 and shared <= HEADS_MM3 and stocked)
    kit.check("faults of ballast", wrong, wrong == 0, f"0 of {len(pieces)} pieces")
    return bodies


def rod_solid(rod, radius=None, along=None):
    """The body of a rod, or another bar about its axis between two places along it."""
    start = np.array(rod["ends_mm"][0])
    way = np.array(rod["ends_mm"][1]) - start
    way /= np.linalg.norm(way)
    low, high = along or (0.0, rod["length_mm"])
    place = trimesh.geometry.align_vectors([0, 0, 1], way)
    place[:3, 3] = start + low * way
    return manifold3d.Manifold.cylinder(high - low, radius or rod["diameter_mm"] / 2, circular_segments=96).transform(place[:3])


def rod_hole(kit, rod, number):
    """Where the axis of a rod enters the hole of a panel and leaves it, mm from its first end, and the hole's diameter. None: no hole."""
    panel, start = kit.panels[number - 1], np.array(rod["ends_mm"][0])
    way = np.array(rod["ends_mm"][1]) - start
    way /= np.linalg.norm(way)
    for hole in panel["holes"]:
        ends = np.array([[*hole["at_mm"], 0.0], [*hole["at_mm"], -kit.thick]]) @ np.array(panel["axes"]) + panel["origin_mm"] - start
        along = ends @ way
        if np.linalg.norm(ends - np.outer(along, way), axis=1).max() < NEAR_MM:
            return along.min(), along.max(), hole["diameter_mm"]
    return None


def bored_panels(kit, panels):
    """The panels with the holes that rods pass."""
    bored = list(panels)
    for rod in kit.sheet.get("rods", []):
        for number in rod["panels"]:
            hole = rod_hole(kit, rod, number)
            if hole:
                bored[number - 1] -= rod_solid(rod, hole[2] / 2 * 1.0006, (hole[0] - 1, hole[1] + 1))
    return bored


def rod_fault(kit, rod, others, model):
    """What is wrong with a rod; None if nothing is."""
    start, end = (np.array(point) for point in rod["ends_mm"])
    if not (rod["diameter_mm"] > 0 and abs(np.linalg.norm(end - start) - rod["length_mm"]) < NEAR_MM):
        return "has another length"
    if len({kit.polyhedron(number) for number in rod["panels"]}) != 2:
        return "joins no two polyhedra"
    first, second = (rod_hole(kit, rod, number) for number in rod["panels"])
    if not (first and second):
        return "passes no hole"
    if not all(ROD_PLAY_MM[0] <= hole[2] - rod["diameter_mm"] <= ROD_PLAY_MM[1] for hole in (first, second)):
        return "has another play"
    stands = (first[0], rod["length_mm"] - second[1])
    if not (first[1] < second[0] and min(stands) >= 0 and all(abs(found - rod["stands_mm"]) < NEAR_MM for found in stands)):
        return "stands out by another length"
    loose = rod_solid(rod, (rod["diameter_mm"] + ROD_PLAY_MM[0]) / 2)
    if sum((loose ^ part).volume() for part in kit.solids.values() if meets(loose, part)) > HEADS_MM3:
        return "cannot slide in its bore"
    body = rod_solid(rod)
    if sum((body ^ other).volume() for other in others if meets(body, other)) > HEADS_MM3:
        return "lies in something else"
    # A collar of most of the wall about the widest bore on its axis is material, but for the gaps over the panels.
    way = (end - start) / rod["length_mm"]
    off = lambda boss: np.linalg.norm(np.cross(np.array(boss["foot_mm"]) - start, way))
    bores = [boss["bore_mm"] for part in kit.sheet["parts"] for boss in part["bosses"] if off(boss) < NEAR_MM and boss["bore_mm"] > rod["diameter_mm"]]
    if not bores:
        return "has no bore"
    gap, wall, radius = kit.sheet["gap_mm"] + NEAR_PIN_MM, kit.sheet["wall_mm"], max(bores) / 2
    span = (first[1] + gap, second[0] - gap)
    collar = rod_solid(rod, radius + 0.9 * wall, span) - rod_solid(rod, radius + NEAR_PIN_MM, (span[0] - 1, span[1] + 1))
    for part in kit.solids.values():
        if meets(collar, part):
            collar -= part
    if collar.volume() > 0.5:
        return f"lacks {collar.volume():.2f} mm³ of its collar"
    if (rod_solid(rod, rod["diameter_mm"] / 2 + 0.99 * wall, span) - model).volume() > PIN_MM3:
        return "is too near to the surface"
    mass = math.pi / 4 * rod["diameter_mm"] ** 2 * rod["length_mm"] * rod["density_g_cm3"] / 1e3
    stocked = RODS.get(rod["id"], {})
    shape = stocked.get("shape", {})
    density = stocked.get("mass_g", 0.0) / (math.pi / 4 * shape.get("diameter_mm", 1.0) ** 2 * shape.get("length_mm", 1.0)) * 1e3
    if abs(mass / rod["mass_g"] - 1) > 1e-9 or abs(density / rod["density_g_cm3"] - 1) > 1e-9 or np.linalg.norm((start + end) / 2 - rod["center_mm"]) > NEAR_MM:
        return "has another mass"
    if [shape.get("diameter_mm"), shape.get("length_mm")] != [rod["diameter_mm"], rod["stock_mm"]]:
        return "is not the rod of its name"
    return None


def rods_needed(lengths, stock):
    """The rods as sold from which lengths are sawn, longest first, with a saw cut of 2 mm."""
    left = []
    for length in sorted(lengths, reverse=True):
        at = next((at for at, rest in enumerate(left) if rest >= length), None)
        if at is None:
            left.append(stock - length - 2.0 if length <= stock else -math.inf)
        else:
            left[at] -= length + 2.0
    return math.inf if -math.inf in left else len(left)


def judge_rods(kit, panels, ballast, model):
    """Every rod passes holes of both panels, is in solid material and in nothing else, weighs what it should, and is bought."""
    rods, wrong = kit.sheet.get("rods", []), []
    bodies = [*kit.solids.values(), *panels, *ballast]
    for at, rod in enumerate(rods):
        fault = rod_fault(kit, rod, bodies + [rod_solid(other) for other in rods[:at]], model)
        if fault:
            wrong.append(f"{rod['name']} {fault}")
    for name in {rod["id"] for rod in rods}:
        cut = [rod["length_mm"] for rod in rods if rod["id"] == name]
        bought = sum(row["count"] for row in kit.sheet["buy"] if row["id"] == name)
        if rods_needed(cut, RODS.get(name, {}).get("shape", {}).get("length_mm", 0.0)) > bought:
            wrong.append(f"{bought} of {name} are bought")
    for fault in wrong:
        print(f"    {fault}")
    kit.check("faults of rods", len(wrong), not wrong, f"0 of {len(rods)} rods")


def judge_stock(kit):
    """Every sheet is one of those at hand and lies on the bed; panels follow the grain if they must."""
    lying = lambda thing: (thing["size_mm"], thing["is_turned"])
    left = [[lying(stock), math.inf if stock["count"] is None else stock["count"]] for stock in kit.sheet["stock"]]
    bed, missing = kit.sheet["cutter"]["bed_mm"], 0
    for sheet in kit.sheet["cut_sheets"]:
        own = [one for one in left if one[0] == lying(sheet) and one[1] > 0]
        missing += not own
        if own:
            own[0][1] -= 1
        missing += any(side > room + 1e-6 for side, room in zip(sheet["size_mm"], bed))
    kit.check("sheets that are not at hand", missing, missing == 0, 0)
    if kit.sheet["sheet"]["keeps_grain"]:
        grain = lambda sheet: math.pi / 2 if sheet["is_turned"] else 0.0
        turns = [abs(math.sin(place["turn_rad"] - grain(sheet))) for sheet in kit.sheet["cut_sheets"] for place in sheet["panels"]]
        kit.check("sine of a panel's turn against the grain", max(turns), max(turns) <= 1e-9, 1e-9)


def judge_held(kit):
    """Every part lies on its panel and is held there, or is joined to a part that is held."""
    shell = [part for part in kit.sheet["parts"] if part["kind"] == "shell"]
    screwed = {one["part"] for one in kit.sheet["fasteners"] if one["kind"] == "screw"}
    films = [film.get("parts", []) for film in kit.sheet["glue"]]
    screwed |= {film[0] for film in films if len(film) == 1}
    graph = networkx.Graph()
    graph.add_node("base")
    for part in shell:
        graph.add_node(part["id"])
        panel = kit.panels[part["panel"] - 1]
        heights = (kit.parts[part["id"]].vertices - panel["origin_mm"]) @ np.array(panel["axes"][2])
        if part["id"] in screwed and (np.abs(heights - kit.sheet["gap_mm"]) < TOUCH_MM).sum() >= 3:
            graph.add_edge("base", part["id"])
    pairs = [(peg["on"], peg["into"]) for peg in kit.sheet.get("pins", [])] + [tuple(film) for film in films if len(film) == 2]
    for a, b in set(pairs):
        if kit.solids[a].min_gap(kit.solids[b], 1.0) < TOUCH_MM:
            graph.add_edge(a, b)
    loose = set(graph) - networkx.node_connected_component(graph, "base")
    kit.check("parts without a path to the base", len(loose), not loose, 0)


def judge_ways(kit, panels, ballast):
    """Takes the object apart: every unit, the last joined first, in steps along its way."""
    units = kit.sheet["units"]
    named = sorted(name for unit in units for name in unit["parts"])
    kit.check("things in units", len(named), named == sorted(kit.parts), len(kit.parts))
    bodies = []
    for unit in units:
        own = [kit.solids[name] for name in unit["parts"]]
        laid = [body for piece, body in zip(kit.sheet.get("ballast", []), ballast) if piece["panel"] == unit["panel"]]
        rods = [rod_solid(rod) for rod in kit.sheet.get("rods", []) if rod["panels"][0] == unit["panel"]]
        bodies.append(own + ([panels[unit["panel"] - 1]] if unit["panel"] else []) + laid + rods)
    worst, where = 0.0, "none"
    for name, way, moving, standing in steps(kit, bodies):
        for step in STEPS_MM:
            moved = [body.translate(np.array(way) * step) for body in moving]
            shared = sum((a ^ b).volume() for a in moved for b in standing if meets(a, b))
            if shared > worst:
                worst, where = shared, f"{name} at {step} mm"
    kit.check(f"shared on the way, mm³, worst {where}", worst, worst <= WAY_MM3, WAY_MM3)
    ways = [thing["way"] for thing in [*units, *kit.sheet.get("joins", [])]]
    off = max(abs(np.linalg.norm(way) - 1) for way in ways)
    kit.check("length of a way, off 1", off, off <= 1e-9, 1e-9)
    judge_joins(kit)


def steps(kit, bodies):
    """The steps of putting the object together: units of each polyhedron, the polyhedra, then what comes last."""
    units = kit.sheet["units"]
    last = lambda at: units[at].get("is_last", False)
    group = lambda at: kit.group(units[at])
    for at, unit in enumerate(units):
        there = [other for other in range(at) if last(at) or (not last(other) and group(other) == group(at))]
        yield unit["id"], unit["way"], bodies[at], [body for other in there for body in bodies[other]]
    for join in kit.sheet.get("joins", []):
        of = lambda numbers: [body for at in range(len(units)) if group(at) in numbers and not last(at) for body in bodies[at]]
        yield f"polyhedra {join['moving']}", join["way"], of(join["moving"]), of(join["standing"])


def judge_joins(kit):
    """All polyhedra come together group by group, and bolts hold each."""
    units, joins, count = kit.sheet["units"], kit.sheet.get("joins", []), len(kit.bases)
    wrong = sum(kit.group(unit) not in ([unit.get("polyhedron", 1)] if count == 1 else [unit.get("polyhedron")]) for unit in units)
    wrong += sum(not kit.group(unit) for unit in units)
    kit.check("units of another polyhedron", wrong, wrong == 0, 0)
    late = [unit.get("is_last", False) for unit in units]
    kit.check("units out of turn", sum(late), late == sorted(late) and (count > 1 or not any(late)), "those that come last are last")
    groups, misfits = [frozenset([number]) for number in range(1, count + 1)], 0
    bolts = [one for one in kit.sheet["fasteners"] if one["kind"] == "bolt" and one.get("through")]
    held = [(kit.polyhedron(bolt["panel"]), kit.polyhedron(bolt["through"])) for bolt in bolts]
    for join in joins:
        sides = [frozenset(join["moving"]), frozenset(join["standing"])]
        doubled = len(join["moving"]) + len(join["standing"]) != len(sides[0] | sides[1])
        if doubled or not all(side in groups for side in sides):
            misfits += 1
            continue
        groups = [group for group in groups if group not in sides] + [sides[0] | sides[1]]
        across = sum(a in sides[0] and b in sides[1] or b in sides[0] and a in sides[1] for a, b in held)
        misfits += across != join["bolts"]
    kit.check("polyhedra that come together", count + 1 - len(groups), misfits == 0 and len(groups) == 1, count)
    rods = kit.sheet.get("rods", [])
    spanned = [tuple(kit.polyhedron(number) for number in rod["panels"]) for rod in rods]
    still = 0
    for rod, (first, second) in zip(rods, spanned):
        way = np.array(rod["ends_mm"][1]) - np.array(rod["ends_mm"][0])
        own = [join for join in joins if first in join["standing"] and second in join["moving"]]
        still += not (own and np.dot(way, own[0]["way"]) >= (1 - 1e-9) * np.linalg.norm(way))
    for join in joins:
        across = sum(a in join["moving"] and b in join["standing"] or b in join["moving"] and a in join["standing"] for a, b in spanned)
        still += across != join.get("rods", 0) or across == 1
    kit.check("rods on which nothing comes", still, still == 0, f"0 of {len(rods)}")
    graph = networkx.Graph(held + spanned)
    graph.add_nodes_from(range(1, count + 1))
    kit.check("polyhedra that are bolted", count, networkx.is_connected(graph), count)
    last = {unit["panel"] for unit in units if unit.get("is_last") and unit["panel"]}
    early = sum(bool(last & {bolt["panel"], bolt["through"]}) for bolt in bolts) + sum(bool(last & {*rod["panels"]}) for rod in rods)
    kit.check("bolts through panels that come last", early, early == 0, 0)


def meets(a, b):
    a, b = np.reshape(a.bounding_box(), (2, 3)), np.reshape(b.bounding_box(), (2, 3))
    return bool((a[0] < b[1]).all() and (b[0] < a[1]).all())


def judge_heads(kit, panels):
    """Screws' heads must lie in nothing else."""
    inside = 0.0
    for screw in kit.sheet["fasteners"]:
        diameter, height = screw["head_mm"]
        if not height:
            continue
        back = -np.array(screw["axis"])
        place = trimesh.geometry.align_vectors([0, 0, 1], back)
        place[:3, 3] = screw["seat_mm"]
        head = manifold3d.Manifold.cylinder(height, diameter / 2, circular_segments=24).transform(place[:3])
        inside += sum((head ^ other).volume() for other in [*kit.solids.values(), *panels] if meets(head, other))
    kit.check("screws' heads in other things, mm³", inside, inside <= HEADS_MM3, HEADS_MM3)


def judge_mass(kit):
    sheet = kit.sheet
    mass, first = 0.0, np.zeros(3)
    for mesh in kit.parts.values():
        volume, own = moments(mesh)
        mass, first = mass + volume * sheet["material"]["density_g_cm3"] / 1e3, first + own * sheet["material"]["density_g_cm3"] / 1e3
    density = sheet["sheet"]["density_g_cm3"] / 1e3
    for panel in kit.panels:
        ring = Polygon(panel["outline_mm"])
        axes, origin = np.array(panel["axes"]), np.array(panel["origin_mm"])
        put = lambda x, y: origin + axes[0] * x + axes[1] * y - axes[2] * kit.thick / 2
        terms = [(ring.area, put(ring.centroid.x, ring.centroid.y))]
        terms += [(-math.pi / 4 * hole["diameter_mm"] ** 2, put(*hole["at_mm"])) for hole in panel["holes"]]
        for area, middle in terms:
            mass, first = mass + area * kit.thick * density, first + middle * area * kit.thick * density
    for thing in [*sheet["fasteners"], *sheet.get("rods", []), *sheet["glue"], *sheet.get("ballast", [])]:
        mass, first = mass + thing["mass_g"], first + np.array(thing["center_mm"]) * thing["mass_g"]
    centre = first / mass
    kit.check("mass, relative", mass / sheet["mass_g"] - 1, abs(mass / sheet["mass_g"] - 1) <= MASS_RATIO, f"{MASS_RATIO} of {sheet['mass_g']:.1f} g")
    far = np.linalg.norm(centre - sheet["centre_mm"])
    kit.check("centre, mm", far, far <= CENTRE_MM, CENTRE_MM)
    if sheet["least_angle_deg"] is None:
        return
    up = np.array(sheet["up"])
    u = np.cross(up, np.eye(3)[np.argmin(np.abs(up))])
    u /= np.linalg.norm(u)
    axes = np.stack([u, np.cross(up, u), up])
    shell = [kit.parts[part["id"]].vertices for part in sheet["parts"] if part["kind"] == "shell"]
    points = np.concatenate(shell) @ axes.T
    low, high = points[:, 2].min(), points[:, 2].max()
    feet = points[points[:, 2] <= low + BAND_RATIO * (high - low), :2]
    hull = scipy.spatial.ConvexHull(feet)
    at = axes @ centre
    inward = -(hull.equations[:, :2] @ at[:2] + hull.equations[:, 2])
    lean = math.degrees(math.atan2(inward.min(), at[2] - low))
    kit.check("topples at, °", lean, lean >= sheet["least_angle_deg"] and abs(lean - sheet["toppling_deg"]) <= TOPPLING_DEG, f"{sheet['toppling_deg']:.4f} told, {sheet['least_angle_deg']} asked")


def judge_things(kit, model):
    panels = judge_panels(kit)
    cut = [panel for index, promised in enumerate(kit.sheet["cut_sheets"]) for panel in judge_sheet(kit, index, promised)]
    kit.check("panels that are cut", len(cut), sorted(cut) == list(range(1, len(kit.panels) + 1)), len(kit.panels))
    judge_stock(kit)
    judge_parts(kit, model)
    judge_pins(kit)
    judge_held(kit)
    ballast = judge_ballast(kit, panels)
    bored = bored_panels(kit, panels)
    judge_rods(kit, bored, ballast, model)
    if "faults of rods" not in kit.faults:
        judge_ways(kit, bored, ballast)
        judge_heads(kit, [*panels, *ballast, *map(rod_solid, kit.sheet.get("rods", []))])
    judge_mass(kit)


def lacking(sheet):
    """The keys of stock and grain that a list must have and has not."""
    at = [(sheet, "stock"), (sheet, "cutter"), (sheet.get("cutter", {}), "bed_mm"), (sheet.get("sheet", {}), "keeps_grain")]
    at += [(thing, "is_turned") for thing in [*sheet.get("stock", []), *sheet.get("cut_sheets", [])]]
    return sorted({key for thing, key in at if thing.get(key) in (None, [])})


def judge(folder):
    print(folder)
    lacks = lacking(json.loads((Path(folder) / "checklist.json").read_text()))
    if lacks:
        print(f"  broken: checklist.json lacks {', '.join(lacks)}")
        return False
    kit = Kit(folder)
    judge_files(kit)
    model = judge_base(kit)
    # With a wrong side there is no room that parts must keep clear of, so that nothing else can be held.
    if STRAY_SIDES not in kit.faults:
        judge_things(kit, model)
    for fault in kit.faults:
        print(f"  broken: {fault}")
    return not kit.faults


if __name__ == "__main__":
    folders = sys.argv[1:]
    if not folders or not all((Path(folder) / "checklist.json").is_file() for folder in folders):
        print(__doc__)
        sys.exit(2)
    sys.exit(0 if all([judge(folder) for folder in folders]) else 1)
