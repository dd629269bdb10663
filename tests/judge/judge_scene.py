#!/usr/bin/env python3
"""An independent reader of motion.glb: trimesh for its parts, and numpy for its animations.

    python3 tests/judge/judge_scene.py KIT [KIT ...]

Holds that the scene is sound glTF 2.0 as far as trimesh and the checks below see, that it holds the parts of the kit in metres, and
that the animation `open` takes every part to where motion.json says, at the keys and between them, by matrix exponentials. Exit code 0:
all agree; 1: something does not.
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
    found.update({own["id"]: place for own, place in zip(sheet["junctures"], junctures)})
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

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = COMPONENTS[accessor["componentType"]], WIDTHS[accessor["type"]]
        assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(self.bin)
        values = np.frombuffer(self.bin, kind, accessor["count"] * width, view["byteOffset"]).reshape(-1, width)
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
            first, second = values[after - 1], values[after]
            node = channel["target"]["node"]
            if channel["target"]["path"] == "translation":
                to[node] = first + (second - first) * share
            else:
                turns[node] = slerp(first, second, share)
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


def slerp(first, second, share):
    cosine = np.clip(first @ second, -1, 1)
    if cosine < 0:
        second, cosine = -second, -cosine
    angle = np.arccos(cosine)
    if angle < 1e-9:
        return second
    return (np.sin((1 - share) * angle) * first + np.sin(share * angle) * second) / np.sin(angle)


def matrix(to, turn):
    x, y, z, w = turn / np.linalg.norm(turn)
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
    parts.update({own["id"]: (own["file"], own["print_from_model"]) for own in sheet.get("junctures", [])})
    return parts


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
    upright = matrix([0, 0, 0], np.array(root["rotation"]))[:3, :3]
    for name in sorted(names & set(parts)):
        file, pose = parts[name]
        mesh = trimesh.load(kit / file, process=True)
        pose = np.array(pose)
        mesh.vertices = (mesh.vertices / scale - pose[:3, 3]) @ pose[:3, :3]
        mesh.apply_transform(start[name])
        wanted = mesh.vertices @ upright.T
        placed, geometry = scene.graph.get(name)
        own = scene.geometry[geometry].copy()
        own.apply_transform(placed)
        seen = own.vertices * 1000
        far = max(np.abs(wanted.min(0) - seen.min(0)).max(), np.abs(wanted.max(0) - seen.max(0)).max())
        if far > SIZE_LIMIT_MM or abs(np.cbrt(abs(own.volume)) * 1000 - np.cbrt(mesh.volume)) > SIZE_LIMIT_MM:
            found.append(f"{name} is another body, or {far:.4f} mm off when all is in")
    opening = next((one for one in glb.json.get("animations", []) if one["name"] == "open"), None)
    joints = [joint["id"] for limb in motion.get("limbs", [motion]) for joint in limb["joints"]]
    alone = [one["name"] for one in glb.json.get("animations", []) if one is not opening]
    if alone != joints:
        found.append(f"the animations of single joints are {alone}, not {joints}")
    worst = 0.0
    reach = np.array([[0, 50, 0, 0], [0, 0, 50, 0], [0, 0, 0, 50], [1, 1, 1, 1]], float)
    for moment in (first + share for first in range(len(keys) - 1) for share in (0.0, *SHARES, 1.0)):
        first = min(int(moment), len(keys) - 2)
        states = mixed(keys[first]["states"], keys[first + 1]["states"], moment - first)
        own = glb.placed(opening, moment)
        for name, wanted in places(motion, sheet, states).items():
            worst = max(worst, np.linalg.norm(((own[name] - wanted) @ reach)[:3], axis=0).max())
    if worst > PLACE_LIMIT_MM:
        found.append(f"the animation is {worst:.4f} mm off")
    print(f"motion.glb: {len(names)} parts, {len(joints) + 1} animations, {worst:.1e} mm off the screws at most")
    return found


def judge(kit):
    """Prints the faults of a kit's motion.glb, and returns their number."""
    found = faults(kit)
    for fault in found:
        print(f"broken: motion.glb: {fault}")
    return len(found)


if __name__ == "__main__":
    sys.exit(1 if sum(judge(kit) for kit in sys.argv[1:]) else 0)
