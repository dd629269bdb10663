#!/usr/bin/env python3
"""An independent judge of a telescope's kit: Python, numpy, trimesh and manifold3d, nothing of the program.

    python3 tests/judge/judge_telescope.py KIT [KIT ...]

Reads the parts (STL), motion.json (helices, joints, keys), curve.csv (the points asked for), and from checklist.json what was promised. A kit
of several telescopes on junctures is judged limb by limb, and then as a whole: pairs of all bodies, mass, centres, boxes. Junctures that are
pieces of a model are held against model.stl: none lies beyond it, nothing of it is lost, every bore has its wall. One that is cut for a small
printer is put together from its parts: they fit the room, meet without reaching into each other, and pins stand in their sockets. Poses are
gone to from all in, and their tips measured. Moves
the shells by matrix exponentials, tries the stops with solid intersections, and prints promise against measurement. Exit code 0: all agree; 1:
something does not; 2: no kit.
"""

import csv
import hashlib
import json
import sys
import tomllib
from pathlib import Path

import manifold3d
import numpy as np
import scipy.linalg
import scipy.spatial
import trimesh

sys.dont_write_bytecode = True
import judge_scene  # noqa: E402, beside this file

# A stop is free so much before it and holds so much after it, mm.
FREE_MM = 0.02
HELD_MM = 0.05
# A twist stop holds so much beyond its play, rad.
BEYOND_RAD = np.radians(2.0)
# Two solids that share less than this do not touch, mm³: rounding of single precision along a seat.
SHARED_MM3 = 1e-3
# A stop that holds shares at least this, mm³.
HOLDS_MM3 = 5e-3
GAP_LIMIT_MM = 0.02
# Gaps are looked for up to so many clearances: farther ones cost minutes.
SEARCH_RATIO = 1.2
DEVIATION_LIMIT_MM = 0.05
MASS_LIMIT_RATIO = 1e-4
CENTRE_LIMIT_MM = 0.01
GROUND_LIMIT_MM = 0.01
TOPPLING_LIMIT_DEG = 0.05
BOX_LIMIT_MM = 0.02
# Slides at which a joint's gap is sampled, as shares of its free stroke, and states of a move.
STROKE = (0.0, 0.5, 1.0)
BETWEEN = (0.0, 0.5)
STEPS = 20
# Pieces of a model lie on it within this, mm; a shell of this thickness about a body is rounding.
ON_MODEL_MM = 0.002
# A bore takes so much below its root's tail, and its rim widens over so much before the mouth, mm.
BELOW_TAIL_MM = 1.0
RIM_MM = 0.5
# A point beside a bore by less than this is in it, mm: facets.
BESIDE_MM = 0.02
ANGLES = 48
# A tip is in its place within this, mm. Slides (mm) and turns (rad) of keys are rounded to this.
REACH_MM = 1.0
STATE_LIMIT = 1e-6
# Pins and sockets are as promised within this, mm; sockets are cut with this many sides.
PIN_MM = 0.02
SIDES = 48
# A socket and an id may widen at their mouths by so much, mm; material is looked for so far behind a socket's walls.
WIDER_MM = 1.0
BEHIND_MM = 0.3
# Faces in one plane reach into each other by less than this, mm: rounding of single precision.
ROUNDING_MM = 1e-4
# The parts of a juncture fill it within this share.
FILLED_RATIO = 1e-4
SUM_RATIO = 1e-5
# What lies around a model is a box so much larger, mm.
AROUND_MM = 20.0


class OlderKit(Exception):
    """A kit whose lists have another shape."""


def screw(curvature, torsion, arc):
    """Returns the 4×4 motion along a helix: the exponential of its twist."""
    twist = np.array([[0, -curvature, 0, 1], [curvature, 0, -torsion, 0], [0, torsion, 0, 0], [0, 0, 0, 0]], float)
    return scipy.linalg.expm(twist * arc)


def roll(angle):
    matrix = np.eye(4)
    sine, cosine = np.sin(angle), np.cos(angle)
    matrix[1:3, 1:3] = [[cosine, -sine], [sine, cosine]]
    return matrix


class Kit:
    def __init__(self, folder, limb=None):
        self.folder = Path(folder)
        self.sheet = json.loads((self.folder / "checklist.json").read_text())
        self.motion = json.loads((self.folder / "motion.json").read_text())
        self.curve = "curve.csv"
        self.faults = 0
        if limb is not None:
            own = self.sheet["limbs"][limb]
            self.curve = f"curves/{own['id']}.csv"
            self.sheet, self.motion = own["sheet"], self.motion["limbs"][limb]
        self.shells = [[] for _ in self.motion["shells"]]
        self.tubes = []
        scale = np.array(self.sheet["printer"].get("print_scale_ratio") or [1.0, 1.0, 1.0])
        for part in self.sheet["parts"]:
            mesh = self.read(part, scale, part["print_from_shell"])
            self.shells[part["shell"] - 1].append(mesh)
        self.solids = [self.solid(meshes) for meshes in self.shells]

    def read(self, part, scale, pose):
        mesh = trimesh.load(self.folder / part["file"], process=True)
        # Single precision makes some slivers to lines, which have no area.
        faces = mesh.faces
        mesh.update_faces((faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0]))
        mesh.apply_scale(1.0 / scale)
        self.say(f"{part['id']} closed", mesh.is_watertight and mesh.is_winding_consistent and mesh.body_count == 1)
        self.say(f"{part['id']} rests", abs(mesh.bounds[0][2]) < 1e-3)
        mesh.apply_transform(np.linalg.inv(np.array(pose)))
        return mesh

    def say(self, promise, kept, detail=""):
        if not kept:
            self.faults += 1
            print(f"FAIL {promise} {detail}")
        elif detail:
            print(f"ok   {promise} {detail}")

    def solid(self, meshes):
        whole = manifold3d.Manifold()
        for mesh in meshes:
            data = manifold3d.Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32))
            body = manifold3d.Manifold(data)
            self.say("a part is a manifold", body.status() == manifold3d.Error.NoError)
            whole += body
        return whole

    def along(self, shell, arc):
        own = self.motion["shells"][shell]
        return screw(own["curvature"], own["torsion"], arc)

    def step(self, joint, slide, turn):
        length = self.motion["shells"][joint]["length_mm"]
        inner = self.motion["shells"][joint + 1]["length_mm"]
        return self.along(joint, length) @ roll(turn) @ self.along(joint + 1, slide - inner)

    def frames(self, states):
        frames = [np.array(self.motion["root"])]
        for joint, (slide, turn) in enumerate(states):
            frames.append(frames[-1] @ self.step(joint, slide, turn))
        return frames

    def shared(self, a, b, placed):
        moved = self.solids[b].transform(placed[:3, :])
        return (self.solids[a] ^ moved).volume()

    def is_joined(self, a, b):
        """Neighbours slide in each other; their joints are tried."""
        return abs(a - b) <= 1

    def gap(self, joint, slide):
        placed = self.step(joint, slide, 0.0)
        moved = self.solids[joint + 1].transform(placed[:3, :])
        return self.solids[joint].min_gap(moved, SEARCH_RATIO * self.sheet["clearance_mm"])


def judge_files(kit):
    listed = {}
    for line in (kit.folder / "SHA256SUMS").read_text().splitlines():
        sha, file = line.split("  ", 1)
        listed[file] = sha
    wrong = [file for file, sha in listed.items() if hashlib.sha256((kit.folder / file).read_bytes()).hexdigest() != sha]
    kit.say("files as they were made", not wrong, f"{len(listed)} files {wrong or ''}")
    wrong = [file for file, sha in kit.sheet["files"].items() if listed.get(file) != sha]
    kit.say("checklist and list agree", not wrong, str(wrong or ""))


def judge_joints(kit):
    clearance = kit.sheet["clearance_mm"]
    for joint, promise in enumerate(kit.sheet["joints"]):
        own = kit.motion["joints"][joint]
        name, stop, play = promise["id"], promise["stop_mm"], promise["play_rad"]
        slides = [own["closed_mm"] + share * (promise["free_to_mm"] - own["closed_mm"]) for share in STROKE]
        gap = min(kit.gap(joint, slide) for slide in slides)
        kit.say(f"{name} slides", gap >= clearance - GAP_LIMIT_MM, f"gap {gap:.4f} of {clearance} mm")
        free = kit.shared(joint, joint + 1, kit.step(joint, stop - FREE_MM, 0.0))
        held = kit.shared(joint, joint + 1, kit.step(joint, stop + HELD_MM, 0.0))
        kit.say(f"{name} stops at {stop:.3f} mm", free < SHARED_MM3 and held > HOLDS_MM3, f"shared {free:.5f}, {held:.4f} mm³")
        turn, sign = own["turn_rad"], -1.0 if own["turn_rad"] < 0 else 1.0
        out = own["open_mm"] - FREE_MM
        free = max(kit.shared(joint, joint + 1, kit.step(joint, out, share * turn)) for share in (0.0, 0.5, 1.0))
        held = [kit.shared(joint, joint + 1, kit.step(joint, out, at)) for at in (turn + sign * (play + BEYOND_RAD), -sign * (play + BEYOND_RAD))]
        kit.say(f"{name} turns by {np.degrees(turn):.1f}°", free < SHARED_MM3 and min(held) > HOLDS_MM3, f"shared {free:.5f}, {min(held):.4f} mm³")
        back = kit.shared(joint, joint + 1, kit.step(joint, promise["back_mm"], 0.0))
        kit.say(f"{name} is closed behind", back > HOLDS_MM3, f"shared {back:.4f} mm³")


def opens(motion, first, last):
    """Whether states go from all joints in to all out."""
    closed = [(joint["closed_mm"], 0.0) for joint in motion["joints"]]
    out = [(joint["open_mm"], joint["turn_rad"]) for joint in motion["joints"]]
    return all(np.allclose(state, wanted, atol=1e-6) for state, wanted in ((first, closed), (last, out)))


def judge_motion(kit):
    keys = kit.motion["keys"]
    kit.say("keys go from all in to all out", len(keys) > 1 and opens(kit.motion, keys[0]["states"], keys[-1]["states"]), f"{len(keys)} keys")
    error = 0.0
    for key in keys:
        for own, written in zip(kit.frames(key["states"]), key["placements"], strict=True):
            error = max(error, np.abs(own - np.array(written)).max())
    kit.say("keys place the shells", error < 1e-6, f"{error:.1e} mm")
    worst, looked = 0.0, 0
    known = {}
    for before, after in zip(keys, keys[1:]):
        for share in BETWEEN:
            a, b = np.array(before["states"]), np.array(after["states"])
            frames = kit.frames(a + (b - a) * share)
            for i in range(len(frames)):
                for j in range(i + 2, len(frames)):
                    placed = np.linalg.inv(frames[i]) @ frames[j]
                    if (i, j) in known and np.abs(known[i, j] - placed).max() < 1e-9:
                        continue
                    known[i, j] = placed
                    looked += 1
                    worst = max(worst, kit.shared(i, j, placed))
    kit.say("no two shells touch on the way", worst < SHARED_MM3, f"shared {worst:.6f} mm³ in {looked} pairs")


def judge_curve(kit):
    rows = list(csv.DictReader((kit.folder / kit.curve).open()))
    asked = np.array([[float(row[f"asked_{axis}"]) for axis in "xyz"] for row in rows])
    states = kit.motion["keys"][-1]["states"]
    frames = kit.frames(states)
    made = [frames[0][:3, 3]]
    for shell, frame in enumerate(frames):
        length = kit.motion["shells"][shell]["length_mm"]
        made += [(frame @ kit.along(shell, length * (i + 1) / STEPS))[:3, 3] for i in range(STEPS)]
    made = np.array(made)
    arcs = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(asked, axis=0), axis=1))])
    at = np.linspace(0, arcs[-1], len(made))
    wanted = np.stack([np.interp(at, arcs, asked[:, axis]) for axis in range(3)], axis=1)
    off = np.linalg.norm(made - wanted, axis=1)
    promised = kit.sheet["deviation"]
    kit.say("deviation", off.max() <= promised["max_mm"] + DEVIATION_LIMIT_MM, f"{off.max():.3f} of {promised['max_mm']:.3f} mm, rms {np.sqrt((off**2).mean()):.3f}")


def judge_balance(kit):
    volumes = np.array([sum(mesh.volume for mesh in meshes) for meshes in kit.shells])
    centres = [sum(mesh.center_mass * mesh.volume for mesh in meshes) / volume for meshes, volume in zip(kit.shells, volumes)]
    density = kit.sheet["material"]["density_g_cm3"] / 1000.0
    for piece in kit.sheet.get("ballast", []):
        # A piece counts as a volume of the shells' material, in the root.
        more = piece["mass_g"] / density
        centres[0] = (centres[0] * volumes[0] + np.array(piece["center_mm"]) * more) / (volumes[0] + more)
        volumes[0] += more
    judge_ballast(kit)
    mass = volumes.sum() * density
    kit.say("mass", abs(mass / kit.sheet["mass_g"] - 1) < MASS_LIMIT_RATIO, f"{mass:.4f} of {kit.sheet['mass_g']:.4f} g")
    root = np.array(kit.motion["root"]) @ kit.along(0, kit.motion["shells"][0]["ends_mm"][0])
    to_ground = np.linalg.inv(root)
    vertices = np.concatenate([mesh.vertices for mesh in kit.shells[0]])
    local = (to_ground @ np.array(kit.motion["root"]) @ np.c_[vertices, np.ones(len(vertices))].T).T[:, :3]
    ground = local[:, 0].min()
    feet = local[local[:, 0] < ground + 1e-2][:, 1:3]
    hull = feet[scipy.spatial.ConvexHull(feet).vertices]
    must_stand = kit.sheet["least_angle_deg"] is not None
    worst_centre, worst_lean, least = 0.0, 0.0, np.inf

    def balance(states):
        placed = [(frame @ np.append(centre, 1))[:3] for frame, centre in zip(kit.frames(states), centres)]
        centre = np.average(placed, axis=0, weights=volumes)
        x, *foot = (to_ground @ np.append(centre, 1))[:3]
        edges = np.roll(hull, -1, axis=0) - hull
        normals = np.stack([-edges[:, 1], edges[:, 0]], axis=1) / np.linalg.norm(edges, axis=1)[:, None]
        margin = ((np.array(foot) - hull) * normals).sum(axis=1).min()
        return centre, np.degrees(np.arctan2(margin, x - ground))

    for key, promise in zip(kit.motion["keys"], kit.sheet["balance"], strict=True):
        centre, lean = balance(key["states"])
        worst_centre = max(worst_centre, np.linalg.norm(centre - promise["centre_mm"]))
        if must_stand or promise["toppling_deg"] is not None:
            stated = promise["toppling_deg"] if promise["toppling_deg"] is not None else -np.inf
            worst_lean = max(worst_lean, abs(lean - stated))
        least = min(least, lean)
    kit.say("centres", worst_centre < CENTRE_LIMIT_MM, f"{worst_centre:.5f} mm off at worst")
    kit.say("toppling", worst_lean < TOPPLING_LIMIT_DEG, f"{worst_lean:.4f}° off at worst, least {least:.2f}°")
    if must_stand:
        kit.say("stands", least >= kit.sheet["least_angle_deg"], f"{least:.2f} of {kit.sheet['least_angle_deg']}°")
        judge_ground(kit, to_ground, ground)
        for pose in kit.motion.get("poses", []):
            least = min(balance(key[0])[1] for key in pose["keys"])
            kit.say(f"stands in pose {pose['name']}", least >= kit.sheet["least_angle_deg"], f"{least:.2f} of {kit.sheet['least_angle_deg']}°")


def judge_ballast(kit):
    """Every piece has room in the root: no corner of its rims is in a solid."""
    for number, piece in enumerate(kit.sheet.get("ballast", []), 1):
        axis = np.array(piece["axis"]) / np.linalg.norm(piece["axis"])
        side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        side /= np.linalg.norm(side)
        radius, half = piece["shape"]["diameter_mm"] / 2, piece["shape"]["thickness_mm"] / 2
        turns = np.linspace(0, 2 * np.pi, 48, endpoint=False)[:, None]
        rim = (np.cos(turns) * side + np.sin(turns) * np.cross(axis, side)) * radius
        points = np.concatenate([rim + np.array(piece["center_mm"]) + axis * end for end in (-half, half)])
        is_in = np.any([mesh.contains(points).any() for mesh in kit.shells[0]])
        kit.say(f"ballast {number} has room", not is_in, piece["id"])


def judge_ground(kit, to_ground, ground):
    """Nothing of it may reach below the foot, at any of ten states of each move."""
    depth = 0.0
    for first, last in zip(kit.motion["keys"], kit.motion["keys"][1:]):
        for share in np.linspace(0, 1, 10):
            states = (1 - share) * np.array(first["states"]) + share * np.array(last["states"])
            for frame, meshes in zip(kit.frames(states), kit.shells):
                vertices = np.concatenate([mesh.vertices for mesh in meshes])
                heights = (to_ground @ frame @ np.c_[vertices, np.ones(len(vertices))].T)[0]
                depth = max(depth, ground - heights.min())
    kit.say("ground", depth < GROUND_LIMIT_MM, f"{depth:.4f} mm below the foot at worst")


def end_of(kit, frames):
    """Returns the centre of the last shell's visible end."""
    last = len(kit.motion["shells"]) - 1
    return (frames[last] @ kit.along(last, kit.motion["shells"][last]["length_mm"]))[:3, 3]


def is_possible(motion, states):
    """Every joint within its range, and turned only where it is all out."""
    for joint, (slide, turn) in zip(motion["joints"], states, strict=True):
        low, high = sorted((0.0, joint["turn_rad"]))
        is_out = abs(slide - joint["open_mm"]) < STATE_LIMIT
        in_range = joint["closed_mm"] - STATE_LIMIT <= slide <= joint["open_mm"] + STATE_LIMIT and low - STATE_LIMIT <= turn <= high + STATE_LIMIT
        if not in_range or not (is_out or abs(turn) < STATE_LIMIT):
            return False
    return True


def judge_poses(kit, limbs, places):
    """Poses: what moves them, where their tips are, and that nothing touches on the way. `places` gives the motion of all bodies."""
    promised, written = kit.sheet.get("poses", []), kit.motion.get("poses", [])
    kit.say("the poses of the list and the motion", [own["name"] for own in promised] == [own["name"] for own in written])
    for promise, pose in zip(promised, written):
        name, keys = f"pose {promise['name']}", pose["keys"]
        closed = [[[joint["closed_mm"], 0.0] for joint in limb.motion["joints"]] for limb in limbs]
        begins = all(np.allclose(a, b, atol=STATE_LIMIT) for a, b in zip(keys[0], closed, strict=True))
        kit.say(f"{name} begins with all shells in", begins)
        possible = all(is_possible(limb.motion, own) for key in keys for limb, own in zip(limbs, key, strict=True))
        kit.say(f"{name} keeps every joint in its range", possible)
        judge_pose_file(kit, limbs, promise, keys[-1])
        frames = places(keys[-1])
        shells, first = [], 0
        for limb in limbs:
            shells.append(frames[first : first + len(limb.shells)])
            first += len(limb.shells)
        error = max(np.abs(np.array(a) - b).max() for own, stated in zip(shells, pose["shells"], strict=True) for a, b in zip(stated, own, strict=True))
        kit.say(f"{name} places the shells", error < 1e-6, f"{error:.1e} mm")
        for tip in promise["tips"]:
            limb = tip["limb"] - 1
            at = end_of(limbs[limb], shells[limb])
            error = np.linalg.norm(at - tip["reached_mm"])
            kit.say(f"{name}, tip {tip['id']} is where it is stated", error < 0.01, f"{error:.5f} mm off")
            if tip["wanted_mm"] is not None:
                off = np.linalg.norm(at - tip["wanted_mm"])
                kit.say(f"{name}, tip {tip['id']} reaches its place", off <= REACH_MM, f"{off:.4f} mm off")
        judge_way(kit, limbs, keys, name, places)


def judge_pose_file(kit, limbs, promise, states):
    """The file that is given back says what the motion does."""
    told = tomllib.loads((kit.folder / promise["file"]).read_text())
    kit.say(f"{promise['file']} is of this pose", told["kind"] == "pose" and told["name"] == promise["name"])
    joints = {joint["id"]: joint for joint in told["joint"]}
    worst = 0.0
    for limb, own in zip(limbs, states, strict=True):
        for joint, (slide, turn) in zip(limb.motion["joints"], own, strict=True):
            row = joints.pop(joint["id"], None)
            kit.say(f"{joint['id']} stands in {promise['file']}", row is not None)
            if row:
                worst = max(worst, abs(row["stroke_mm"] - slide + joint["closed_mm"]), abs(row.get("turn_deg", 0.0) - np.degrees(turn)))
    kit.say(f"{promise['file']} names these joints, with their strokes", worst < 1e-3 and not joints, f"{worst:.1e}")


def judge_way(kit, limbs, keys, name, places):
    """No two bodies touch on the way to a pose; shells of one joint keep their clearance in it."""
    known, worst, looked = {}, 0.0, 0
    for before, after in zip(keys, keys[1:]):
        for share in (*BETWEEN, 1.0):
            states = [np.array(a) + (np.array(b) - np.array(a)) * share for a, b in zip(before, after, strict=True)]
            frames = places(states)
            for a in range(len(frames)):
                for b in range(a + 1, len(frames)):
                    placed = np.linalg.inv(frames[a]) @ frames[b]
                    if kit.is_joined(a, b) or (a, b) in known and np.abs(known[a, b] - placed).max() < 1e-9:
                        continue
                    known[a, b] = placed
                    looked += 1
                    worst = max(worst, kit.shared(a, b, placed))
    kit.say(f"nothing touches on the way to {name}", worst < SHARED_MM3, f"shared {worst:.6f} mm³ in {looked} pairs")
    for limb, states in zip(limbs, keys[-1], strict=True):
        clearance = limb.sheet["clearance_mm"]
        for joint, (promise, (slide, _)) in enumerate(zip(limb.sheet["joints"], states, strict=True)):
            if slide <= promise["free_to_mm"]:
                gap = limb.gap(joint, slide)
                kit.say(f"{promise['id']} in {name}", gap >= clearance - GAP_LIMIT_MM, f"gap {gap:.4f} of {clearance} mm")


def judge_boxes(kit):
    for key, name in ((kit.motion["keys"][0], "collapsed_mm"), (kit.motion["keys"][-1], "extended_mm")):
        frames = kit.frames(key["states"])
        back = np.linalg.inv(frames[0])
        points = np.concatenate([trimesh.transform_points(mesh.vertices, back @ frame) for meshes, frame in zip(kit.shells, frames) for mesh in meshes])
        error = np.abs(np.ptp(points, axis=0) - kit.sheet[name]).max()
        kit.say(name, error < BOX_LIMIT_MM, f"{error:.5f} mm off")


class Network(Kit):
    """Several telescopes on junctures. Bodies are those of all limbs, then the junctures."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.sheet = json.loads((self.folder / "checklist.json").read_text())
        self.motion = json.loads((self.folder / "motion.json").read_text())
        self.faults = 0
        self.limbs = [Kit(folder, limb) for limb in range(len(self.sheet["limbs"]))]
        scale = np.array(self.sheet["printer"].get("print_scale_ratio") or [1.0, 1.0, 1.0])
        self.pieces = [[self.read(part, scale, part["print_from_model"]) for part in own["parts"]] for own in self.sheet["junctures"]]
        self.junctures = [trimesh.util.concatenate(pieces) if len(pieces) > 1 else pieces[0] for pieces in self.pieces]
        self.bodies = [(limb, shell) for limb, kit in enumerate(self.limbs) for shell in range(len(kit.shells))]
        self.bodies += [(None, juncture) for juncture in range(len(self.junctures))]
        self.meshes = [self.junctures[i] if limb is None else trimesh.util.concatenate(self.limbs[limb].shells[i]) for limb, i in self.bodies]
        self.solids = [self.solid(self.pieces[i]) if limb is None else self.limbs[limb].solids[i] for limb, i in self.bodies]

    def places(self, states):
        """Returns the motion of every body, those of junctures from where they are when all is out."""
        junctures = [np.eye(4) for _ in self.junctures]
        frames = []
        for own, kit, state in zip(self.sheet["limbs"], self.limbs, states, strict=True):
            out = [(joint["open_mm"], joint["turn_rad"]) for joint in kit.motion["joints"]]
            base, now, end = junctures[own["from"] - 1], kit.frames(state), kit.frames(out)
            junctures[own["to"] - 1] = base @ now[-1] @ np.linalg.inv(end[-1])
            frames += [base @ frame for frame in now]
        return frames + junctures

    def is_joined(self, a, b):
        """Neighbours in a limb, and what is glued together."""
        (p, i), (q, j) = self.bodies[a], self.bodies[b]
        return (p == q and p is not None and abs(i - j) <= 1) or (p != q and self.is_one(a, b))

    def is_one(self, a, b):
        """Shells of one limb, which were judged, and what is glued together."""
        (p, i), (q, j) = sorted((self.bodies[a], self.bodies[b]), key=lambda body: body[0] is None)
        if q is None and p is not None:
            own, last = self.sheet["limbs"][p], len(self.limbs[p].shells) - 1
            return (own["from"] == j + 1 and i == 0) or (own["to"] == j + 1 and i == last)
        return p is not None and p == q


def boxes_meet(a, b):
    return bool(np.all(a[0] <= b[1]) and np.all(b[0] <= a[1]))


def judge_network(kit):
    keys = kit.motion["keys"]
    ends = zip(kit.motion["limbs"], keys[0]["states"], keys[-1]["states"], strict=True)
    kit.say("keys go from all in to all out", len(keys) > 1 and all(opens(*end) for end in ends), f"{len(keys)} keys")
    order = []
    for before, after in zip(keys, keys[1:]):
        moved = [own["id"] for own, a, b in zip(kit.sheet["limbs"], before["states"], after["states"]) if a != b]
        order += [name for name in moved if order[-1:] != [name]]
    kit.say("limbs open in the order of the sheet", order == kit.sheet["order"] == kit.motion["order"], ", ".join(order))
    error = 0.0
    for key in keys:
        own = kit.places(key["states"])[-len(kit.junctures) :]
        error = max(error, max(np.abs(a - np.array(b)).max() for a, b in zip(own, key["junctures"], strict=True)))
    kit.say("keys place the junctures", error < 1e-6, f"{error:.1e} mm")
    count = len(kit.bodies)
    pairs = [(a, b) for a in range(count) for b in range(a + 1, count) if not kit.is_one(a, b)]
    corners = [trimesh.bounds.corners(mesh.bounds) for mesh in kit.meshes]
    worst, looked, known = 0.0, 0, {}
    for before, after in zip(keys, keys[1:]):
        for share in BETWEEN:
            states = [np.array(a) + (np.array(b) - np.array(a)) * share for a, b in zip(before["states"], after["states"])]
            places = kit.places(states)
            bounds = [np.stack([p.min(axis=0), p.max(axis=0)]) for p in (trimesh.transform_points(c, m) for c, m in zip(corners, places))]
            for a, b in pairs:
                placed = np.linalg.inv(places[a]) @ places[b]
                if (a, b) in known and np.abs(known[a, b] - placed).max() < 1e-9:
                    continue
                known[a, b] = placed
                if boxes_meet(bounds[a], bounds[b]):
                    looked += 1
                    worst = max(worst, kit.shared(a, b, placed))
    kit.say("no two bodies touch on the way", worst < SHARED_MM3, f"shared {worst:.6f} mm³ in {looked} pairs")
    open_places = kit.places(keys[-1]["states"])
    for a in range(count):
        for b in range(a + 1, count):
            if kit.is_one(a, b) and None in (kit.bodies[a][0], kit.bodies[b][0]):
                shared = kit.shared(a, b, np.linalg.inv(open_places[a]) @ open_places[b])
                kit.say(f"glued bodies {a} and {b} have room", shared < SHARED_MM3, f"shared {shared:.6f} mm³")
    volumes = np.array([mesh.volume for mesh in kit.meshes])
    mass = volumes.sum() * kit.sheet["material"]["density_g_cm3"] / 1000.0
    kit.say("mass", abs(mass / kit.sheet["mass_g"] - 1) < MASS_LIMIT_RATIO, f"{mass:.4f} of {kit.sheet['mass_g']:.4f} g")
    worst = 0.0
    for key, promised in zip(keys, kit.sheet["centres_mm"], strict=True):
        centres = [(place @ np.append(mesh.center_mass, 1))[:3] for place, mesh in zip(kit.places(key["states"]), kit.meshes)]
        worst = max(worst, np.linalg.norm(np.average(centres, axis=0, weights=volumes) - promised))
    kit.say("centres", worst < CENTRE_LIMIT_MM, f"{worst:.5f} mm off at worst")
    if kit.sheet.get("least_angle_deg") is not None:
        judge_figure_stands(kit, volumes)
    for key, name in ((keys[0], "collapsed_mm"), (keys[-1], "extended_mm")):
        points = np.concatenate([trimesh.transform_points(mesh.vertices, place) for place, mesh in zip(kit.places(key["states"]), kit.meshes)])
        error = np.abs(np.ptp(points, axis=0) - kit.sheet[name]).max()
        kit.say(name, error < BOX_LIMIT_MM, f"{error:.5f} mm off")


def judge_figure_stands(kit, volumes):
    """A figure on the foot of its first juncture, at the keys and ten states of each move."""
    up = np.array(kit.motion["up"]) / np.linalg.norm(kit.motion["up"])
    side = np.cross(up, np.eye(3)[np.argmin(np.abs(up))])
    side /= np.linalg.norm(side)
    axes = np.stack([side, np.cross(up, side), up])
    first = len(kit.bodies) - len(kit.junctures)
    base = kit.meshes[first].vertices @ axes.T
    ground = base[:, 2].min()
    feet = base[base[:, 2] < ground + 1e-2][:, :2]
    hull = feet[scipy.spatial.ConvexHull(feet).vertices]
    edges = np.roll(hull, -1, axis=0) - hull
    normals = np.stack([-edges[:, 1], edges[:, 0]], axis=1) / np.linalg.norm(edges, axis=1)[:, None]

    def lean(states):
        places = kit.places(states)
        centres = [(place @ np.append(mesh.center_mass, 1))[:3] for place, mesh in zip(places, kit.meshes)]
        *foot, height = axes @ np.average(centres, axis=0, weights=volumes)
        margin = ((np.array(foot) - hull) * normals).sum(axis=1).min()
        low = min((trimesh.transform_points(mesh.vertices, place) @ up).min() for place, mesh in zip(places, kit.meshes))
        return np.degrees(np.arctan2(margin, height - ground)), ground - low

    keys = kit.motion["keys"]
    found = [lean(key["states"])[0] for key in keys]
    off = max(abs(a - b) for a, b in zip(found, kit.sheet["toppling_deg"], strict=True))
    least, depth = np.inf, 0.0
    for before, after in zip(keys, keys[1:]):
        for share in np.linspace(0, 1, 10):
            states = [(1 - share) * np.array(a) + share * np.array(b) for a, b in zip(before["states"], after["states"])]
            angle, below = lean(states)
            least, depth = min(least, angle), max(depth, below)
    kit.say("toppling", off < TOPPLING_LIMIT_DEG, f"{off:.4f}° off at worst, least {least:.2f}°")
    kit.say("stands", least >= kit.sheet["least_angle_deg"], f"{least:.2f} of {kit.sheet['least_angle_deg']}°")
    kit.say("ground", depth < GROUND_LIMIT_MM, f"{depth:.4f} mm below the foot at worst")


def rod(peg, radius, low, high):
    """Returns a rod about the axis of a pin or socket, between two heights over the cut."""
    axis = np.array(peg["axis"]) / np.linalg.norm(peg["axis"])
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    place = np.column_stack([side, np.cross(axis, side), axis, np.array(peg["center_mm"]) + axis * low])
    return manifold3d.Manifold.cylinder(high - low, radius, radius, SIDES).transform(place)


def judge_pin(kit, pin, carrier, socket, receiver, clearance):
    """A pin as thick and long as promised, in a socket with its room and its walls."""
    radius, length = pin["diameter_mm"] / 2, pin["length_mm"]
    hole, depth = socket["diameter_mm"] / 2, socket["length_mm"]
    # Flats lie within a circle by this share; a chamfer takes the tip of a pin and the mouth of a socket.
    flat = np.cos(np.pi / SIDES)
    low, high = 0.3 * length, 0.6 * length
    lacks = [
        rod(pin, radius * flat - PIN_MM, low, high) - carrier,
        rod(pin, radius / 2, low, length - PIN_MM) - carrier,
        (rod(pin, radius + clearance - PIN_MM, low, length + PIN_MM) - rod(pin, radius + PIN_MM, 0, length)) ^ carrier,
        rod(pin, radius / 2, length + PIN_MM, length + 2 * PIN_MM) ^ carrier,
        rod(socket, hole - PIN_MM, PIN_MM, depth - PIN_MM) ^ receiver,
        (rod(socket, hole / flat + BEHIND_MM, 0.5 * depth, 0.9 * depth) - rod(socket, hole / flat + PIN_MM, 0, depth)) - receiver,
        rod(socket, hole - PIN_MM, depth + PIN_MM, depth + BEHIND_MM) - receiver,
    ]
    lack = max(body.volume() for body in lacks)
    apart = np.linalg.norm(np.array(pin["center_mm"]) - socket["center_mm"]) + np.linalg.norm(np.array(pin["axis"]) - socket["axis"])
    gap = hole - radius
    kit.say(f"pin {pin['id']} in its socket", lack < SHARED_MM3 and apart < 1e-6 and gap > clearance - 1e-3, f"gap {gap:.3f} of {clearance} mm, {lack:.5f} mm³ off")


def judge_joints_of_parts(kit, own):
    """As many pins and sockets as the joints of a juncture state, two where one way is promised, and no part without a joint."""
    parts = {part["id"]: part for part in own["parts"]}
    joints = [joint for joint in kit.sheet.get("juncture_joints", []) if joint["juncture"] == own["id"]]
    ids = {name: [{peg["id"] for peg in part.get(kind, [])} for kind in ("pins", "sockets")] for name, part in parts.items()}
    reached = {own["parts"][0]["id"]}
    for joint in joints:
        (one_pins, one_sockets), (other_pins, other_sockets) = (ids.get(name, (set(), set())) for name in joint["parts"])
        found = len(one_pins & other_sockets) + len(other_pins & one_sockets)
        kept = found == joint["pins"] and (found >= 2 or not joint["is_aligned"])
        kit.say(f"{' and '.join(joint['parts'])} have their pins", kept, f"{found} of {joint['pins']}")
    for _ in joints:
        for joint in joints:
            if reached & set(joint["parts"]):
                reached |= set(joint["parts"])
    kit.say(f"joints join all parts of {own['id']}", reached >= set(parts))
    stated = sum(joint["pins"] for joint in joints)
    found = [sum(len(part.get(kind, [])) for part in own["parts"]) for kind in ("pins", "sockets")]
    kit.say(f"{own['id']} has all pins of its joints", found == [stated, stated], f"{found} of {stated}")


def judge_divided(kit):
    """Junctures in several parts: they fit the room, meet in their cuts, hold by pins, and are the whole together."""
    room = kit.sheet["printer"].get("build_volume_mm")
    first = len(kit.bodies) - len(kit.junctures)
    kit.filled = list(kit.solids[first:])
    for index, (own, meshes) in enumerate(zip(kit.sheet["junctures"], kit.pieces, strict=True)):
        for part, mesh in zip(own["parts"], meshes, strict=True):
            size = np.ptp(trimesh.transform_points(mesh.vertices, np.array(part["print_from_model"])), axis=0)
            fits = room is None or (size[2] <= room[2] and (bool(np.all(size[:2] <= room[:2])) or bool(np.all(size[1::-1] <= room[:2]))))
            kit.say(f"{part['id']} fits the room", fits, f"{size.round(1)} in {room}")
        kit.say(f"{own['id']} states its cuts if it has parts", (len(meshes) > 1) == bool(own.get("divided")))
        if len(meshes) == 1 or not own.get("divided"):
            continue
        judge_joints_of_parts(kit, own)
        solids = [kit.solid([mesh]) for mesh in meshes]
        both = [body for i in range(len(solids)) for j in range(i) for body in (solids[i] ^ solids[j]).decompose()]
        deep = max((body.volume() / body.surface_area() for body in both), default=0.0)
        kit.say(f"the parts of {own['id']} keep apart", deep < ROUNDING_MM, f"{deep:.6f} mm into each other")
        sockets = {socket["id"]: (socket, solid) for part, solid in zip(own["parts"], solids) for socket in part.get("sockets", [])}
        pins = [(pin, solid) for part, solid in zip(own["parts"], solids) for pin in part.get("pins", [])]
        kit.say(f"{own['id']} has a socket for every pin", sorted(pin["id"] for pin, _ in pins) == sorted(sockets), f"{len(pins)} pins")
        for pin, solid in pins:
            if pin["id"] in sockets:
                judge_pin(kit, pin, solid, *sockets[pin["id"]], own["divided"]["clearance_mm"])
        marks = [mark for part in own["parts"] for mark in part.get("marks", [])]
        volume, added = own["divided"]["volume_mm3"], sum(pin["volume_mm3"] for pin, _ in pins)
        taken = sum(socket["volume_mm3"] for socket, _ in sockets.values()) + sum(mark["volume_mm3"] for mark in marks)
        error = abs(sum(mesh.volume for mesh in meshes) - added + taken - volume) / volume
        kit.say(f"the parts of {own['id']} add up", error < SUM_RATIO, f"{error:.1e}")
        fill = [kit.filled[index]]
        for socket, _ in sockets.values():
            radius = socket["diameter_mm"] / 2
            fill += [rod(socket, radius + WIDER_MM, 0, WIDER_MM), rod(socket, radius + PIN_MM, 0, socket["length_mm"] + PIN_MM)]
        for mark in marks:
            fill += [rod({**mark, "center_mm": at}, 2.1 * mark["stroke_mm"], 0, mark["depth_mm"] + PIN_MM) for at in mark["strokes_mm"]]
        kit.filled[index] = manifold3d.Manifold.batch_boolean(fill, manifold3d.OpType.Add)
        error = kit.filled[index].volume() / volume - 1
        kit.say(f"{own['id']} is whole", abs(error) < FILLED_RATIO, f"{error:.1e}")
        kit.say(f"{own['id']} is one body", sum(body.volume() > SHARED_MM3 for body in kit.filled[index].decompose()) == 1)


def judge_model(kit):
    """Pieces of a model: none is off it, nothing of it is lost, and every bore has its wall."""
    mesh = trimesh.load(kit.folder / kit.sheet["model"], process=True)
    model = kit.solid([mesh])
    count = len(kit.bodies) - len(kit.junctures)
    whole = manifold3d.Manifold()
    for part, solid in zip(kit.sheet["junctures"], kit.solids[count:], strict=True):
        beyond = max((piece.volume() / piece.surface_area() for piece in (solid - model).decompose()), default=0.0)
        kit.say(f"{part['id']} lies in the model", beyond < ON_MODEL_MM, f"{beyond:.6f} mm beyond")
    for solid in kit.filled:
        whole += solid
    rest = [piece for piece in (model - whole).decompose() if piece.volume() >= ON_MODEL_MM * piece.surface_area()]
    points = [np.array(piece.to_mesh().vert_properties)[:, :3] for piece in rest]
    # A limb replaces one piece: of those from its root's mouth to its last one, that nearest to the mouth.
    replaced = set()
    for limb in kit.limbs:
        bands = [index for index in range(len(rest)) if index not in replaced and replaces(limb, points[index])]
        replaced |= set(sorted(bands, key=lambda index: from_mouth(limb, points[index]))[:1])
    lost = [f"{rest[i].volume():.1f} mm³ at {points[i].mean(axis=0).round(1)}" for i in range(len(rest)) if i not in replaced]
    kit.say("nothing of the model is lost", not lost, f"{len(rest)} pieces {lost or ''}")
    low, high = mesh.bounds
    box = manifold3d.Manifold.cube(tuple(high - low + 2 * AROUND_MM)).translate(tuple(low - AROUND_MM))
    outside = box - model
    wall = max(limb.sheet["wall_mm"] for limb in kit.limbs)
    gaps = {own["id"]: bore_gap(kit, limb, outside, 2 * wall) for own, limb in zip(kit.sheet["limbs"], kit.limbs)}
    kit.say("the model walls every root", min(gaps.values()) >= wall - BESIDE_MM, f"{min(gaps.values()):.3f} of {wall} mm {gaps}")


def replaces(limb, points):
    """Whether points reach from a limb's root's mouth to its last one: the band that it replaces."""
    out = [(joint["open_mm"], joint["turn_rad"]) for joint in limb.motion["joints"]]
    frames = limb.frames(out)
    last = len(frames) - 1
    mouths = [frames[shell] @ limb.along(shell, limb.motion["shells"][shell]["ends_mm"][1]) for shell in (0, last)]
    root, end = (trimesh.transform_points(points, np.linalg.inv(mouth))[:, 0] for mouth in mouths)
    return root.min() <= BESIDE_MM and end.max() >= -BESIDE_MM and np.ptp(root) > BESIDE_MM


def from_mouth(limb, points):
    """Returns the least distance of points from the middle of a root's mouth, mm."""
    out = [(joint["open_mm"], joint["turn_rad"]) for joint in limb.motion["joints"]]
    mouth = limb.frames(out)[0] @ limb.along(0, limb.motion["shells"][0]["ends_mm"][1])
    return np.linalg.norm(points - mouth[:3, 3], axis=1).min()


def bore_gap(kit, limb, outside, search):
    """Returns the gap between a root's bore and what is outside of the model, mm; at most `search`."""
    own = limb.motion["shells"][0]
    body = next(part["body_mm"] for part in limb.sheet["parts"] if part["is_tube"] and part["shell"] == 1)
    radius = body + kit.sheet["glue_mm"]
    angles = np.linspace(0, 2 * np.pi, ANGLES, endpoint=False)
    ring = np.stack([np.zeros(ANGLES), radius * np.cos(angles), radius * np.sin(angles)], axis=1)
    ring = np.vstack([ring, [0, radius + kit.sheet["groove_mm"], 0]])
    tail, mouth = own["ends_mm"]
    root = np.array(limb.motion["root"])
    rings = [trimesh.transform_points(ring, root @ limb.along(0, arc)) for arc in np.linspace(tail - BELOW_TAIL_MM, mouth - RIM_MM, STEPS)]
    pairs = [manifold3d.Manifold.hull_points(np.vstack(pair)) for pair in zip(rings, rings[1:])]
    return manifold3d.Manifold.batch_boolean(pairs, manifold3d.OpType.Add).min_gap(outside, search)


def judge_all(folder):
    kit = Network(folder)
    judge_files(kit)
    for limb in kit.limbs:
        for look in (judge_joints, judge_motion, judge_curve):
            look(limb)
        kit.faults += limb.faults
    judge_network(kit)
    judge_poses(kit, kit.limbs, kit.places)
    judge_divided(kit)
    if kit.sheet.get("model"):
        judge_model(kit)
    return kit


def judge(folder):
    sheet = json.loads((Path(folder) / "checklist.json").read_text())
    if any("parts" not in own for own in sheet.get("junctures", [])):
        raise OlderKit(f"{folder} was made by an older version, its junctures list no parts; make it again")
    if sheet["kind"] == "network":
        kit = judge_all(folder)
        kit.say("the kit's own verdict", kit.sheet["verdict"] == "pass")
        print(f"{folder}: {'agrees' if kit.faults == 0 else f'{kit.faults} faults'}")
        return kit.faults
    kit = Kit(folder)
    for look in (judge_files, judge_joints, judge_motion, judge_curve, judge_balance, judge_boxes):
        look(kit)
    judge_poses(kit, [kit], lambda states: kit.frames(states[0]))
    kit.say("the kit's own verdict", kit.sheet["verdict"] == "pass")
    print(f"{folder}: {'agrees' if kit.faults == 0 else f'{kit.faults} faults'}")
    return kit.faults


def main():
    if len(sys.argv) < 2:
        print(__doc__)
        return 2
    try:
        return 1 if sum(judge(folder) + judge_scene.judge(folder) for folder in sys.argv[1:]) else 0
    except OlderKit as error:
        print(error)
        return 2
    except FileNotFoundError as error:
        print(f"no kit: {error}")
        return 2


if __name__ == "__main__":
    sys.exit(main())
