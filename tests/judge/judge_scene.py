#!/usr/bin/env python3
"""An independent reader of motion.glb: trimesh for its parts, and numpy for its animations.

    python3 tests/judge/judge_scene.py KIT [KIT ...]

Holds that the scene is sound glTF 2.0 as far as trimesh and the checks below see, that it holds the parts of the kit in metres and
upright, and that the animation `open`, and that of each joint, takes every part to where motion.json says, at the keys and between
them, by matrix exponentials. Exit code 0: all agree; 1: something does not.
"""

import json
import struct
import sys
from pathlib import Path

import numpy as np
import scipy.linalg
import trimesh

PLACE_LIMIT_MM = 0.05
SIZE_LIMIT_MM = 2e-3
SHARES = (0.25, 0.5, 0.75)
COMPONENTS = {5126: np.float32, 5123: np.uint16, 5125: np.uint32}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
NORM_LIMIT = 1e-3
UP_LIMIT = 1e-6
# The keys that a kit's file has. A viewer would obey others, such as a stride or an offset, and this reader would not.
KEYS = {
    "": "asset scene scenes nodes meshes materials animations accessors bufferViews buffers",
    "scenes": "name nodes",
    "nodes": "name children translation rotation scale mesh",
    "meshes": "name primitives",
    "materials": "name pbrMetallicRoughness",
    "animations": "name channels samplers",
    "accessors": "bufferView componentType count type min max",
    "bufferViews": "buffer byteOffset byteLength target",
}


def screw(shell, arc):
    curvature, torsion = shell["curvature"], shell["torsion"]
    return scipy.linalg.expm(arc * np.array([[0, -curvature, 0, 1], [curvature, 0, -torsion, 0], [0, torsion, 0, 0], [0, 0, 0, 0]], float))


def rolled(angle):
    matrix = np.eye(4)
    matrix[1:3, 1:3] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return matrix


def chain(motion, states):
    frames = [np.array(motion["root"])]
    for (slide, turn), outer, inner in zip(states, motion["shells"], motion["shells"][1:]):
        frames.append(frames[-1] @ screw(outer, outer["length_mm"]) @ rolled(turn) @ screw(inner, slide - inner["length_mm"]))
    return frames


def places(motion, sheet, states):
    """Returns the place of every part in a state, by its id."""
    if "limbs" not in motion:
        frames = chain(motion, states)
        return {part["id"]: frames[part["shell"] - 1] for part in sheet["parts"]}
    junctures = [np.eye(4) for _ in sheet["junctures"]]
    found = {}
    for limb, own, state in zip(sheet["limbs"], motion["limbs"], states):
        frames = chain(own, state)
        out = chain(own, [[joint["open_mm"], joint["turn_rad"]] for joint in own["joints"]])
        base = junctures[limb["from"] - 1]
        junctures[limb["to"] - 1] = base @ frames[-1] @ np.linalg.inv(out[-1])
        found.update({part["id"]: base @ frames[part["shell"] - 1] for part in limb["sheet"]["parts"]})
    found.update({part["id"]: place for own, place in zip(sheet["junctures"], junctures) for part in own["parts"]})
    return found


def mixed(start, end, share):
    if isinstance(start, list):
        return [mixed(a, b, share) for a, b in zip(start, end)]
    return start + (end - start) * share


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data)), "the frame is wrong"
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(data[20 : 20 + size])
        more, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0" and 28 + size + more == length
        self.bin = data[28 + size :]
        assert self.json["asset"]["version"] == "2.0"
        assert self.json["buffers"] == [{"byteLength": more}]
        for name, known in KEYS.items():
            for row in self.json.get(name, []) if name else [self.json]:
                assert set(row) <= set(known.split()), f"{name}: {sorted(set(row) - set(known.split()))}"
        for mesh in self.json.get("meshes", []):
            (own,) = mesh["primitives"]
            assert set(own) <= {"attributes", "indices", "material"} and set(own["attributes"]) == {"POSITION"}
        nodes = self.json["nodes"]
        children = [child for node in nodes for child in node.get("children", [])]
        meshes = [node["mesh"] for node in nodes if "mesh" in node]
        assert len(set(children)) == len(children) and len(set(meshes)) == len(meshes), "a node or a mesh is used twice"
        assert self.json["scene"] == 0 and len(self.json["scenes"]) == 1 and len(self.json["scenes"][0]["nodes"]) == 1
        assert sum("scale" in node for node in nodes) == 1, "only the root has a scale"
        for node in nodes:
            assert np.isfinite(node.get("translation", [0])).all()
            unit(node.get("rotation", [0, 0, 0, 1]))
        for animation in self.json.get("animations", []):
            targets = [(channel["target"]["node"], channel["target"]["path"]) for channel in animation["channels"]]
            samplers = [channel["sampler"] for channel in animation["channels"]]
            assert len(set(targets)) == len(targets) and len(set(samplers)) == len(samplers), "a channel is there twice"
            assert {path for _, path in targets} <= {"translation", "rotation"}
            assert all(set(row) <= {"input", "output", "interpolation"} for row in animation["samplers"])
            assert all(set(row) == {"sampler", "target"} and set(row["target"]) == {"node", "path"} for row in animation["channels"])

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = COMPONENTS[accessor["componentType"]], WIDTHS[accessor["type"]]
        assert view["buffer"] == 0
        assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(self.bin)
        values = np.frombuffer(self.bin, kind, accessor["count"] * width, view["byteOffset"]).reshape(-1, width)
        assert np.isfinite(values).all(), f"accessor {index} has what is no number"
        for bound, name in ((values.min(0), "min"), (values.max(0), "max")):
            assert name not in accessor or np.array_equal(bound.astype(float), accessor[name]), f"{name} of accessor {index}"
        return values.astype(float)

    def placed(self, animation, time):
        """Returns the place of every node by its name at a time, in the root's frame: linear, and along great arcs."""
        nodes = self.json["nodes"]
        to = [np.array(node.get("translation", [0, 0, 0]), float) for node in nodes]
        turns = [np.array(node.get("rotation", [0, 0, 0, 1]), float) for node in nodes]
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            assert sampler.get("interpolation", "LINEAR") == "LINEAR"
            times, values = self.values(sampler["input"])[:, 0], self.values(sampler["output"])
            after = int(np.clip(np.searchsorted(times, time, "right"), 1, len(times) - 1))
            share = np.clip((time - times[after - 1]) / (times[after] - times[after - 1]), 0, 1)
            assert (np.diff(times) > 0).all() and len(times) == len(values)
            first, second = values[after - 1], values[after]
            node = channel["target"]["node"]
            if channel["target"]["path"] == "translation":
                to[node] = first + (second - first) * share
            else:
                turns[node] = slerp(unit(first), unit(second), share)
        found = {}

        def walk(index, base):
            own = base @ matrix(to[index], turns[index])
            assert nodes[index]["name"] not in found
            found[nodes[index]["name"]] = own
            for child in nodes[index].get("children", []):
                walk(child, own)

        for child in nodes[self.json["scenes"][self.json["scene"]]["nodes"][0]].get("children", []):
            walk(child, np.eye(4))
        return found


def unit(turn):
    """Returns a turn with a norm of 1, which it must have nearly."""
    norm = np.linalg.norm(turn)
    assert abs(norm - 1) <= NORM_LIMIT, f"a turn has the norm {norm}"
    return np.array(turn, float) / norm


def slerp(first, second, share):
    cosine = np.clip(first @ second, -1, 1)
    if cosine < 0:
        second, cosine = -second, -cosine
    angle = np.arccos(cosine)
    if angle < 1e-9:
        return second
    return (np.sin((1 - share) * angle) * first + np.sin(share * angle) * second) / np.sin(angle)


def matrix(to, turn):
    x, y, z, w = unit(turn)
    own = np.eye(4)
    own[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    own[:3, 3] = to
    return own


def parts_of(sheet):
    """Returns the file and the pose of every part by its id."""
    limbs = [limb["sheet"] for limb in sheet["limbs"]] if "limbs" in sheet else [sheet]
    parts = {part["id"]: (part["file"], part["print_from_shell"]) for limb in limbs for part in limb["parts"]}
    pieces = [part for own in sheet.get("junctures", []) for part in own["parts"]]
    parts.update({part["id"]: (part["file"], part["print_from_model"]) for part in pieces})
    return parts


def up_of(motion):
    """Returns the direction up: that of several telescopes is told, a single one stands on its root's tail."""
    if "up" in motion:
        return np.array(motion["up"])
    root = motion["shells"][0]
    return (np.array(motion["root"]) @ screw(root, root["ends_mm"][0]))[:3, 0]


def plays(motion):
    """Returns the states from second to second of every animation by its name: all joints, and each joint by its own moves."""
    keys = [key["states"] for key in motion["keys"]]
    found = {"open": list(zip(keys, keys[1:]))}
    limbs = motion.get("limbs")
    for limb, own in enumerate(limbs or [motion]):
        for joint, row in enumerate(own["joints"]):

            def alone(state):
                first = json.loads(json.dumps(keys[0]))
                moved, seen = (first[limb], state[limb]) if limbs else (first, state)
                moved[joint] = seen[joint]
                return first

            moves = [(alone(start), alone(end)) for start, end in zip(keys, keys[1:])]
            assert row["id"] not in found
            found[row["id"]] = [(start, end) for start, end in moves if start != end]
    return {name: moves for name, moves in found.items() if moves}


def moments(mesh, middle):
    """Returns the volume, the centre and the mean products of the coordinates of a body about a point."""
    corners = mesh.triangles - middle
    volumes = np.linalg.det(corners) / 6
    volume, sums = volumes.sum(), corners.sum(1)
    products = np.einsum("t,tki,tkj->ij", volumes, corners, corners) + np.einsum("t,ti,tj->ij", volumes, sums, sums)
    return volume, volumes @ sums / 4 / volume, products / 20 / volume


def is_same(own, wanted):
    """Holds a body against another by its box and its ten moments, up to single precision, in mm."""
    far = max(np.abs(own.vertices.min(0) - wanted.vertices.min(0)).max(), np.abs(own.vertices.max(0) - wanted.vertices.max(0)).max())
    middle, reach = wanted.bounds.mean(0), np.linalg.norm(np.ptp(wanted.bounds, 0))
    (volume, centre, products), (other, at, second) = moments(own, middle), moments(wanted, middle)
    off = [far, abs(np.cbrt(volume) - np.cbrt(other)), np.abs(centre - at).max(), np.abs(products - second).max() / reach]
    return max(off) if np.isfinite(off).all() else np.inf


def faults(kit):
    kit = Path(kit)
    sheet, motion = (json.loads((kit / name).read_text()) for name in ("checklist.json", "motion.json"))
    glb = Glb(kit / "motion.glb")
    scene = trimesh.load(kit / "motion.glb")
    parts = parts_of(sheet)
    keys = motion["keys"]
    found = []
    names = set(scene.graph.nodes_geometry)
    if names != set(parts):
        found.append(f"the parts are {sorted(names)}, not {sorted(parts)}")
    scale = np.array(sheet["printer"].get("print_scale_ratio") or [1.0, 1.0, 1.0])
    start = places(motion, sheet, keys[0]["states"])
    root = next(node for node in glb.json["nodes"] if "scale" in node)
    assert root["scale"] == [0.001] * 3 and root is glb.json["nodes"][glb.json["scenes"][0]["nodes"][0]]
    assert not {"translation", "matrix", "mesh"} & set(root)
    upright = matrix([0, 0, 0], np.array(root["rotation"]))[:3, :3]
    for name in sorted(names & set(parts)):
        file, pose = parts[name]
        mesh = trimesh.load(kit / file, process=True)
        pose = np.array(pose)
        mesh.vertices = (mesh.vertices / scale - pose[:3, 3]) @ pose[:3, :3]
        mesh.apply_transform(start[name])
        mesh.vertices = mesh.vertices @ upright.T
        placed, geometry = scene.graph.get(name)
        own = scene.geometry[geometry].copy()
        own.apply_transform(placed)
        own.vertices = own.vertices * 1000
        off = is_same(own, mesh)
        if not off <= SIZE_LIMIT_MM:
            found.append(f"{name} is another body, or {off:.4f} mm off when all is in")
    if not np.linalg.norm(upright @ up_of(motion) - [0, 1, 0]) <= UP_LIMIT:
        found.append("it does not stand upright")
    wanted = plays(motion)
    animations = {one["name"]: one for one in glb.json.get("animations", [])}
    if [one["name"] for one in glb.json.get("animations", [])] != list(wanted):
        found.append(f"the animations are {list(animations)}, not {list(wanted)}")
    worst = 0.0
    for name in (name for name in wanted if name in animations):
        off = worst_of(glb, animations[name], wanted[name], lambda states: places(motion, sheet, states))
        worst = max(worst, off)
        if not off <= PLACE_LIMIT_MM:
            found.append(f"the animation {name} is {off:.4f} mm off")
    print(f"motion.glb: {len(names)} parts, {len(animations)} animations, {worst:.1e} mm off the screws at most")
    return found


def worst_of(glb, animation, moves, wanted):
    """Returns by how much a part is off in an animation at most, mm; infinite if something is no number."""
    reach = np.array([[0, 50, 0, 0], [0, 0, 50, 0], [0, 0, 0, 50], [1, 1, 1, 1]], float)
    worst = 0.0
    for first, (start, end) in enumerate(moves):
        for share in (0.0, *SHARES, 1.0):
            own = glb.placed(animation, first + share)
            for name, place in wanted(mixed(start, end, share)).items():
                off = np.linalg.norm(((own[name] - place) @ reach)[:3], axis=0).max() if name in own else np.inf
                # `max` would drop what is no number.
                worst = max(worst, off) if np.isfinite(off) else np.inf
    return worst


def judge(kit):
    """Prints the faults of a kit's motion.glb, and returns their number."""
    found = faults(kit)
    for fault in found:
        print(f"broken: motion.glb: {fault}")
    return len(found)


if __name__ == "__main__":
    sys.exit(1 if sum(judge(kit) for kit in sys.argv[1:]) else 0)
