#!/usr/bin/env python3
"""An independent reader of G-code weighs a print: Python and numpy, nothing of the program.

    python3 tests/judge/judge_gcode.py FILE.gcode CLAIM.json
    python3 tests/judge/judge_gcode.py FILE.gcode

CLAIM.json holds what the program found: "diameter_mm", "moments" (∫ of 1, x, y, z, xy, yz, xz, x², y², z² over all
parts, mm³ to mm⁵), and "objects", each with "label" and "moments". Mass must agree within 1e-6, centres within 1e-4 mm,
second moments about the centre within 1e-6 of their trace. Without a claim the findings are printed.

Each move that lays material is a box of the move's length, the layer's height and the width that gives its volume. Arcs
are cut into chords of 0.02 mm; each piece is wider outside than inside, as a piece of a ring is. Exit code 0: all agrees; 1: something does not; 2: nothing to judge.
"""

import json
import math
import re
import sys
from pathlib import Path

import numpy as np

MASS_RATIO = 1e-6
CENTRE_MM = 1e-4
SECOND_RATIO = 1e-6
CHORD_MM = 0.02
# What does not stay in the finished object, under the names of every slicer, in lower case.
AUXILIARY = {
    "custom", "flush", "skirt/brim", "skirt", "brim", "raft", "support", "support material", "support interface",
    "support material interface", "support transition", "support-interface", "wipe tower", "prime tower", "prime-tower",
}
WORD = re.compile(r"([A-Za-z])\s*([-+]?(?:\d+\.?\d*|\.\d+))")
COMMAND = re.compile(r"\s*(?:[Nn]\d+\s*)?([A-Za-z])(\d+)(\.\d+)?")


class Machine:
    """Where the nozzle is, and under which modes the numbers of a program are read."""

    def __init__(self):
        self.at = [0.0, 0.0, 0.0]
        self.origin = [0.0, 0.0, 0.0]
        self.e = 0.0
        self.unit = 1.0
        self.relative = self.e_relative = self.absolute_centres = self.volumetric = False

    def e_unit(self):
        return self.unit**3 if self.volumetric else self.unit

    def move(self, words):
        """Goes where the words say; returns the places before and after, and what E did."""
        before = list(self.at)
        for axis, letter in enumerate("XYZ"):
            if letter in words:
                base = self.at[axis] if self.relative else self.origin[axis]
                self.at[axis] = base + words[letter] * self.unit
        fed = 0.0
        if "E" in words:
            value = words["E"] * self.e_unit()
            fed = value if self.relative or self.e_relative else value - self.e
            self.e = self.e + value if self.relative or self.e_relative else value
        return before, list(self.at), fed

    def arc(self, words, before, after, clockwise):
        """The chords of an arc, as places, and for each the unit vector outwards over the radius."""
        if "R" in words and "I" not in words and "J" not in words:
            radius = words["R"] * self.unit
            dx, dy = after[0] - before[0], after[1] - before[1]
            chord = math.hypot(dx, dy)
            height = math.sqrt(max(0.0, radius * radius - chord * chord / 4)) * math.copysign(1, radius)
            if clockwise:
                height = -height
            centre = [(before[0] + after[0]) / 2 - height * dy / chord, (before[1] + after[1]) / 2 + height * dx / chord]
        elif self.absolute_centres:
            centre = [words[k] * self.unit + self.origin[n] if k in words else before[n] for n, k in enumerate("IJ")]
        else:
            centre = [before[0] + words.get("I", 0.0) * self.unit, before[1] + words.get("J", 0.0) * self.unit]
        start = math.atan2(before[1] - centre[1], before[0] - centre[0])
        end = math.atan2(after[1] - centre[1], after[0] - centre[0])
        if math.hypot(after[0] - before[0], after[1] - before[1]) < 1e-9:
            sweep = 2 * math.pi
        else:
            sweep = (start - end if clockwise else end - start) % (2 * math.pi)
        radius = math.hypot(before[0] - centre[0], before[1] - centre[1])
        count = max(8, math.ceil(sweep * radius / CHORD_MM))
        turn = np.linspace(0, -sweep if clockwise else sweep, count + 1) + start
        z = np.linspace(before[2], after[2], count + 1)
        places = np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn), z])
        halfway = (turn[:-1] + turn[1:]) / 2
        return places, np.column_stack([np.cos(halfway), np.sin(halfway)]) / radius


class Layers:
    """The height of a bead: as the file states it, else its rise over the layer before."""

    def __init__(self):
        self.stated = self.usual = None
        self.top = self.below = 0.0
        self.marked = False

    def begin(self):
        self.marked, self.below = True, self.top

    def height(self, z):
        if not self.marked and abs(z - self.top) > 1e-4:
            self.below = self.top
        self.top = z
        if z <= self.below:
            self.below = 0.0
        rise = z - self.below
        if self.usual:
            believed = 0.49 * self.usual <= rise <= 4.01 * self.usual
        else:
            believed = 1e-3 <= rise <= 100
        return self.stated or (rise if believed else self.usual or 0.2)


class Labels:
    """The object being printed, under the first of several ways to name it."""

    WAYS = ("printing", "bambu", "mesh", "exclude", "m486")

    def __init__(self):
        self.now = dict.fromkeys(self.WAYS)
        self.names = {}
        self.number = None

    def current(self):
        found = next((self.now[way] for way in self.WAYS if self.now[way] is not None), None)
        if isinstance(found, int):
            return f"{self.names[found]} ({found})" if found in self.names else f"object {found}"
        return found

    def comment(self, text):
        if text.startswith("printing object "):
            name = text[16:]
            found = re.fullmatch(r"(.*?)(?: id:(-?\d+))?(?: copy (-?\d+))?", name)
            name, number, copy = found.groups()
            label = f"{name} ({number})" if number is not None else name
            self.now["printing"] = label + (f", copy {copy}" if copy and int(copy) > 0 else "")
        elif text.startswith("stop printing object,"):
            self.now["bambu"] = None
        elif text.startswith("stop printing object "):
            self.now["printing"] = None
        elif text.startswith("start printing object,"):
            self.now["bambu"] = f"object {int(text.rsplit(':', 1)[1])}"
        elif text.startswith("MESH:"):
            self.now["mesh"] = None if text[5:].strip() == "NONMESH" else text[5:].strip()

    def macro(self, line):
        if line.startswith("EXCLUDE_OBJECT_END"):
            self.now["exclude"] = None
        elif line.startswith("EXCLUDE_OBJECT_START"):
            self.now["exclude"] = re.search(r"NAME=(\S+)", line).group(1).strip("\"'")

    def m486(self, words):
        if words.startswith("A"):
            if self.number is not None:
                self.names[self.number] = words[1:].strip()
        elif found := re.search(r"S(-?\d+)", words):
            number = int(found.group(1))
            self.number = self.now["m486"] = number if number >= 0 else None


def read(path):
    """Beads as rows (x0, y0, z0, x1, y1, z1, height, E, tool, volumetric, bend x, bend y), their labels and kinds."""
    machine, layers, labels = Machine(), Layers(), Labels()
    kind, kinds, tool = "", False, 0
    rows, tags, facts = [], [], {}
    for raw in open(path, errors="replace", newline="\n"):
        line = raw.strip()
        if line.startswith(";"):
            text = line[1:].strip()
            if text.startswith(("TYPE:", "FEATURE:")):
                kind, kinds = text.split(":", 1)[1].strip().lower(), True
            elif text.startswith(("HEIGHT:", "LAYER_HEIGHT:")):
                layers.stated = float(text.split(":")[1])
            elif text in ("LAYER_CHANGE", "CHANGE_LAYER") or re.fullmatch(r"LAYER:-?\d+", text):
                layers.begin()
            elif "bject" in text or text.startswith("MESH:"):
                labels.comment(text)
            if found := re.fullmatch(r"(layer_height|Layer height|filament_diameter|use_volumetric_e)\s*[=:]\s*(\S+)", text):
                facts.setdefault(found.group(1).lower().replace(" ", "_"), found.group(2))
                if found.group(1) in ("layer_height", "Layer height") and layers.usual is None:
                    layers.usual = float(found.group(2))
            continue
        found = COMMAND.match(line)
        if not found:
            labels.macro(line)
            continue
        command = found.group(1).upper() + str(int(found.group(2))) + (found.group(3) or "")
        rest = line[found.end():]
        if command == "M486":
            labels.m486(rest.split(";")[0].strip())
            continue
        rest = re.sub(r"\(.*?\)", "", rest.split(";")[0].split("*")[0])
        words = {letter.upper(): float(number) for letter, number in WORD.findall(rest)}
        if command in ("G0", "G1", "G2", "G3"):
            before, after, fed = machine.move(words)
            if fed <= 0:
                continue
            if command in ("G2", "G3"):
                places, bend = machine.arc(words, before, after, command == "G2")
            else:
                places, bend = np.array([before, after]), np.zeros((1, 2))
            if np.hypot(*np.diff(places[:, :2], axis=0).T).sum() <= 1e-9:
                continue
            height, count = layers.height(max(before[2], after[2])), len(places) - 1
            tail = np.tile([height, fed / count, tool, machine.volumetric], (count, 1))
            rows.append(np.hstack([places[:-1], places[1:], tail, bend]))
            tags.extend([(labels.current(), kind)] * count)
        elif command in ("G20", "G21"):
            machine.unit = 25.4 if command == "G20" else 1.0
        elif command in ("G90", "G91"):
            machine.relative = command == "G91"
        elif command in ("G90.1", "G91.1"):
            machine.absolute_centres = command == "G90.1"
        elif command in ("M82", "M83"):
            machine.e_relative = command == "M83"
        elif command == "M200" and words.keys() & {"D", "S"}:
            machine.volumetric = words.get("S", words.get("D")) > 0
        elif command == "G92":
            for axis, letter in enumerate("XYZ"):
                if letter in words:
                    machine.origin[axis] = machine.at[axis] - words[letter] * machine.unit
            if "E" in words:
                machine.e = words["E"] * machine.e_unit()
        elif command == "G28":
            named = [n for n, letter in enumerate("XYZ") if letter in rest.upper()] or [0, 1, 2]
            for axis in named:
                machine.at[axis] = machine.origin[axis] = 0.0
        elif re.fullmatch(r"T\d{1,2}", command):
            tool = int(command[1:])
    if not rows:
        return None
    # What precedes the first kind is no part, unless the file knows no kinds at all.
    part = np.array([bool(kind) and kind not in AUXILIARY if kinds else True for _, kind in tags])
    return np.vstack(rows), np.array([label for label, _ in tags], dtype=object), part, facts


def moments(rows, diameter_mm, volumes):
    """The ten moments of boxes: V, x, y, z, xy, yz, xz, xx, yy, zz."""
    start, end, height = rows[:, 0:3], rows[:, 3:6], rows[:, 6]
    along = end - start
    length = np.hypot(along[:, 0], along[:, 1])
    keep = length > 0
    start, end, height, along, length, rows = start[keep], end[keep], height[keep], along[keep], length[keep], rows[keep]
    area = np.where(volumes | (rows[:, 9] > 0), 1.0, math.pi / 4 * diameter_mm**2)
    volume = rows[:, 7] * area
    width = volume / (length * height)
    across = np.column_stack([-along[:, 1] / length, along[:, 0] / length, np.zeros(len(rows))])
    middle = (start + end) / 2
    middle[:, 2] -= height / 2
    # Over the radius R the offset from the middle line has the mean width²/12R outwards.
    lean = np.column_stack([rows[:, 10:12] * (width**2 / 12)[:, None], np.zeros(len(rows))])
    second = (
        np.einsum("i,ij,ik->jk", volume / 12, along, along)
        + np.einsum("i,ij,ik->jk", volume * width**2 / 12, across, across)
        + np.einsum("i,ij,ik->jk", volume, middle, middle)
        + np.einsum("i,ij,ik->jk", volume, middle, lean)
        + np.einsum("i,ij,ik->jk", volume, lean, middle)
    )
    second[2, 2] += (volume * height**2 / 12).sum()
    first = (volume[:, None] * (middle + lean)).sum(0)
    pairs = [second[0, 1], second[1, 2], second[0, 2], second[0, 0], second[1, 1], second[2, 2]]
    return np.array([volume.sum(), *first, *pairs])


def central(ten):
    volume, first = ten[0], ten[1:4]
    xy, yz, xz, xx, yy, zz = ten[4:]
    centre = first / volume
    return volume, centre, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) - volume * np.outer(centre, centre)


def differences(name, claimed, found):
    """What differs too much between two sets of moments, and the measured errors."""
    (v0, c0, s0), (v1, c1, s1) = central(np.array(claimed)), central(found)
    errors = abs(v0 / v1 - 1), np.linalg.norm(c0 - c1), np.abs(s0 - s1).max() / np.trace(s1)
    print(f"{name}: {v1:.3f} mm³, mass {errors[0]:.1e}, centre {errors[1]:.1e} mm, second {errors[2]:.1e}")
    bounds = zip(("mass", "centre", "second moments"), errors, (MASS_RATIO, CENTRE_MM, SECOND_RATIO))
    return [f"{name}: {what} differ by {error:.2e}" for what, error, most in bounds if not error <= most]


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__)
        return 2
    found = read(Path(sys.argv[1]))
    if found is None:
        print("no move lays material")
        return 2
    rows, labels, part, facts = found
    claim = json.loads(Path(sys.argv[2]).read_text()) if len(sys.argv) == 3 else {}
    diameter_mm = claim.get("diameter_mm") or float(facts.get("filament_diameter", "1.75").split(",")[0])
    volumes = facts.get("use_volumetric_e") == "1"
    if not claim:
        volume, centre, second = central(moments(rows[part], diameter_mm, volumes))
        print(json.dumps({"volume_mm3": volume, "centre_mm": centre.tolist(), "second_mm5": second.tolist()}, indent=1))
        return 0
    faults = differences("all parts", claim["moments"], moments(rows[part], diameter_mm, volumes))
    for claimed in claim["objects"]:
        own = part & np.array([label == claimed["label"] for label in labels])
        if claimed["moments"][0] == 0 and not own.any():
            continue
        if not own.any():
            faults.append(f"{claimed['label']}: the file holds no such object")
            continue
        faults += differences(claimed["label"], claimed["moments"], moments(rows[own], diameter_mm, volumes))
    print("\n".join(f"FAIL {fault}" for fault in faults) or "ok")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
