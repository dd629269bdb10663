#!/usr/bin/env python3
"""The table of default seams: where they run on figures with marked faces, and what they cost. Python and numpy, nothing of the program.

    python3 tests/judge/judge_seams.py --program EQUIPOISE --models FOLDER --out FOLDER [--rows PATTERN] [--more "--pitch 0.5mm"]

FOLDER of the models holds faces.toml, whose head explains it: balls about faces, and which way is up. For each figure, goal and
printer it makes a kit as it comes and one with `--seam short`, unless --out holds them already. If a seam runs through a face, it
makes a third one that keeps the face clear. It reads the written parts, hollowed.stl and checklist.json. A seam is where the rim of
a part's cut face lies on the outside; what an endless plane meets beside it does not count.

It prints a table in Markdown: the length of the seams, whether one comes within a face's ball, those that are neither level nor
upright in the figure's own frame with what they follow, and the share of the goal's figure that is lost against the better of all
kits of the row. Exit code 0: no face is cut, or keeping it whole costs more than 10 % and the kit says so; 1: else.
"""

import argparse
import json
import math
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import trimesh

from judge_kit import read_part, read_stl, split, welded

GOALS, PRINTERS = ("stand", "top"), ("objet-connex350", "prusa-mk4")
SIZE_MM = 100.0
# What a whole face may cost of the goal's figure.
MOST_LOSS_RATIO = 0.1
# Written vertices of a cut face lie in its plane to single precision; chamfers of pins stand off by tenths.
IN_PLANE_MM = 2e-3
# The outside's section is sampled so densely; a rim is this near to it where it is a seam.
STEP_MM = 0.25
# Nobody sees less.
UNSEEN_SLANT_DEG = 2.0
# Figures of which more is better.
MORE_IS_BETTER = ("toppl", "metacentr", "volume", "gm")
# A neck is short, and the outline grows on both sides of it: lengths in circles about the model, distances in its diagonals.
NECK_CIRCLES, NECK_GROWTH, NECK_REACH = 0.25, 1.4, 0.05
# Hollows are measured over this radius, in diagonals: a full one rises by so much of it; so much of a seam in a crease is in them.
HOLLOW_RADIUS, FULL_HOLLOW, CREASE_SHARE, OTHER_SIDE = 0.06, 0.12, 0.4, -0.5
# What lies no higher is the base, in heights of the body.
BASE_RATIO = 0.2
SURFACE_SAMPLES = 8000


def sections(mesh, point, normal):
    """The outline of a mesh in a plane, as segments (n, 2, 3)."""
    return trimesh.intersections.mesh_plane(mesh, normal, point)


def length(segments):
    return float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum()) if len(segments) else 0.0


def sampled(segments):
    """Points along segments, and the length for which each stands."""
    sizes = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    counts = np.maximum(1, np.ceil(sizes / STEP_MM).astype(int))
    which = np.repeat(np.arange(len(segments)), counts)
    step = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = ((step + 0.5) / counts[which])[:, None]
    return segments[which, 0] * (1 - share) + segments[which, 1] * share, (sizes / counts)[which]


def rims(parts, point, normal):
    """The edges about the faces that written parts have in a plane, as segments (n, 2, 3)."""
    found = []
    for corners in parts:
        face = corners[(np.abs((corners - point) @ normal) < IN_PLANE_MM).all(axis=1)]
        if len(face):
            mesh = welded(face)
            edges = np.sort(mesh.edges, axis=1)
            once, counts = np.unique(edges, axis=0, return_counts=True)
            found.append(mesh.vertices[once[counts == 1]])
    return np.concatenate(found) if found else np.zeros((0, 2, 3))


def distance(points, segments):
    """The distance from each point to the nearest segment."""
    if not len(segments) or not len(points):
        return np.full(len(points), np.inf)
    least = np.full(len(points), np.inf)
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    square = np.maximum((along**2).sum(axis=1), 1e-30)
    for rows in np.array_split(np.arange(len(points)), 1 + len(points) * len(segments) // 4_000_000):
        off = points[rows, None] - start
        share = np.clip((off * along).sum(axis=2) / square, 0, 1)
        least[rows] = np.linalg.norm(off - share[:, :, None] * along, axis=2).min(axis=1)
    return least


class Kit:
    """A written kit in the frame of its model."""

    def __init__(self, folder):
        self.sheet = json.loads((folder / "checklist.json").read_text())
        scale = self.sheet["printer"].get("print_scale_ratio") or [1, 1, 1]
        self.parts = [self.placed(folder, row, scale) for row in self.sheet["parts"]]
        outer = np.concatenate(split(welded(read_stl(folder / "hollowed.stl")))[0])
        self.outer = welded(outer)
        self.diagonal = float(np.linalg.norm(self.outer.extents))
        proof = self.sheet["certificate"]
        self.figure, self.value = proof["figure"], proof["value"]
        texts = [*self.sheet.get("offers", []), *self.sheet.get("notes", []), *self.sheet.get("warnings", [])]
        self.said = [text for text in texts if text.startswith(("seams:", "pins: cuts where their seams are seen"))]

    @staticmethod
    def placed(folder, row, scale):
        pose = np.array(row["print_from_model"], float)
        return (read_part(folder / row["file"]) / scale - pose[:3, 3]) @ pose[:3, :3]

    def cost(self):
        return -self.value if any(word in self.figure for word in MORE_IS_BETTER) else self.value

    def seams(self, up):
        return [Seam(self, cut, up) for cut in self.sheet["cuts"]]


class Seam:
    """The seam of one cut on the outside."""

    def __init__(self, kit, cut, up):
        self.id, self.kit, self.up = cut["id"], kit, up
        self.point, self.normal = np.array(cut["point_mm"], float), np.array(cut["normal"], float)
        points, sizes = sampled(sections(kit.outer, self.point, self.normal))
        is_made = distance(points, rims(kit.parts, self.point, self.normal)) < STEP_MM
        self.points, self.length = points[is_made], float(sizes[is_made].sum())

    def depth(self, center, radius):
        """How far it enters a ball, mm; not above 0 if it does not."""
        return radius - float(np.linalg.norm(self.points - center, axis=1).min()) if len(self.points) else 0.0

    def slant_deg(self):
        rise = math.degrees(math.asin(min(1.0, abs(float(self.normal @ self.up)))))
        return min(rise, 90 - rise)

    def lie(self):
        rise = math.degrees(math.asin(min(1.0, abs(float(self.normal @ self.up)))))
        if self.slant_deg() <= UNSEEN_SLANT_DEG:
            return "level" if rise > 45 else "upright"
        follows = [name for name, holds in (("neck", self.is_neck), ("crease", self.is_crease), ("base", self.is_base)) if holds()]
        return f"{self.slant_deg():.0f}° along a {follows[0]}" if follows else f"**{self.slant_deg():.0f}°**"

    def heights(self):
        along = self.kit.outer.vertices @ self.up
        return (self.points @ self.up - along.min()) / (along.max() - along.min())

    def is_neck(self):
        reach = NECK_REACH * self.kit.diagonal
        beside = [length(sections(self.kit.outer, self.point + side * reach * self.normal, self.normal)) for side in (-1, 1)]
        here = length(sections(self.kit.outer, self.point, self.normal))
        return here < NECK_CIRCLES * math.pi * self.kit.diagonal and min(beside) > NECK_GROWTH * here

    def is_crease(self):
        places, faces = trimesh.sample.sample_surface_even(self.kit.outer, SURFACE_SAMPLES, seed=1)
        normals = self.kit.outer.face_normals[faces]
        radius = HOLLOW_RADIUS * self.kit.diagonal
        ratios = []
        for at in self.points[:: max(1, len(self.points) // 400)]:
            off = places - at
            far = np.linalg.norm(off, axis=1)
            normal = normals[far.argmin()]
            near = (far < radius) & (normals @ normal > OTHER_SIDE)
            rise = (off[near] @ normal).mean() if near.any() else 0.0
            ratios.append(np.clip(rise / (radius * FULL_HOLLOW), 0, 1))
        return bool(ratios) and float(np.mean(ratios)) > CREASE_SHARE

    def is_base(self):
        return bool(len(self.points)) and self.heights().max() < BASE_RATIO


class Row:
    """A figure with its goal and printer, and the kits that are made of it."""

    def __init__(self, name, figure, goal, printer, run):
        self.name, self.figure, self.goal, self.printer, self.run = name, figure, goal, printer, run
        self.scale = SIZE_MM / figure["longest"]
        axis = figure.get("up_vector") or [float(figure["up"][0] + "1") * (figure["up"][1] == axis) for axis in "xyz"]
        self.up = np.array(axis) / np.linalg.norm(axis)

    def faces(self):
        for mark in self.figure.get("keep_clear", []):
            if mark["what"] == "face":
                center = np.array(self.figure["min"]) * self.scale + np.array(mark["center"]) * SIZE_MM
                yield center, mark["radius"] * SIZE_MM

    def kit(self, suffix, *more):
        """The kit with more options, made unless it is there; None if there is none, or one that breaks a promise. The text beside it explains."""
        out = self.run.out / "-".join([self.name, self.goal, self.printer, *([suffix] if suffix else [])])
        told = out.with_name(out.name + ".txt")
        if not told.exists():
            command = [self.run.program, "-q", "prepare", f"{self.run.models}/{self.figure['file']}", "--goal", self.goal, "--printer", self.printer]
            command += ["--size", f"{SIZE_MM:g}mm", "--out", str(out), "--force", *more, *shlex.split(self.run.more)]
            done = subprocess.run(command, capture_output=True, text=True)
            told.write_text(f"{shlex.join(command)}\nexit {done.returncode}\n{done.stdout}{done.stderr}")
        is_kit = (out / "checklist.json").exists() and "\nexit 0\n" in told.read_text()
        return Kit(out) if is_kit else None

    def refusal(self):
        told = (self.run.out / f"{self.name}-{self.goal}-{self.printer}.txt").read_text()
        lines = [line for line in told.splitlines()[2:] if line.strip()]
        return lines[0].strip() if lines else "no kit"

    def judge(self):
        """Prints the row. Returns whether its faces are whole, or cost too much and the kit says so."""
        label = f"| {self.name} | {self.goal} | {self.printer} |"
        kit, short = self.kit(""), self.kit("short", "--seam", "short")
        if kit is None:
            print(f"{label} {self.refusal()} | | | | | | |", flush=True)
            return not (self.run.out / f"{self.name}-{self.goal}-{self.printer}" / "checklist.json").exists()
        seams = kit.seams(self.up)
        depth = max((seam.depth(*face) for seam in seams for face in self.faces()), default=0.0)
        is_cut = depth > 0
        clear = self.kit("clear", *(word for (x, y, z), r in self.faces() for word in ("--keep-clear", f"{x},{y},{z},{r}"))) if is_cut else None
        best = min(other.cost() for other in (kit, short, clear) if other is not None)
        loss = lambda of: (of.cost() - best) / abs(best)
        price = loss(clear) if clear else None
        is_paid = not is_cut or ((price is None or price > MOST_LOSS_RATIO) and bool(kit.said))
        face = "no" if not is_cut else f"YES, by {depth:.1f} mm; whole: {'no kit' if price is None else f'{100 * price:.1f} %'}{', said' if kit.said else ', NOT SAID'}"
        lies = ", ".join(f"{seam.lie()} at {self.place(seam)}" for seam in seams)
        mm = " + ".join(f"{seam.length:.0f}" for seam in seams)
        print(f"{label} {len(kit.parts)} | {mm} | {face} | {lies} | {kit.value:.4g} | {100 * loss(kit):.1f} % |", flush=True)
        return is_paid

    @staticmethod
    def place(seam):
        if not len(seam.points):
            return "no seam"
        low, high = 100 * seam.heights().min(), 100 * seam.heights().max()
        return f"{low:.0f} %" if high - low < 1 else f"{low:.0f} to {high:.0f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--models", required=True, type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--rows", default=".", help="a pattern for NAME-GOAL-PRINTER")
    parser.add_argument("--more", default="", help="options added to every kit")
    run = parser.parse_args()
    run.out.mkdir(parents=True, exist_ok=True)
    figures = tomllib.loads((run.models / "faces.toml").read_text())
    print("| model | goal | printer | parts | seams, mm | through a face | lie, of the height | figure | lost |\n|" + "---|" * 9)
    rows = [Row(name, figure, goal, printer, run) for name, figure in figures.items() for goal in GOALS for printer in PRINTERS]
    wanted = [row for row in rows if re.search(run.rows, f"{row.name}-{row.goal}-{row.printer}")]
    return 0 if all([row.judge() for row in wanted]) else 1


if __name__ == "__main__":
    sys.exit(main())
