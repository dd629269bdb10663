#!/usr/bin/env python3
"""The consortium's own library reads every 3MF file of a kit in strict mode: Python and lib3mf, nothing of the program.

    python3 tests/judge/judge_3mf.py KIT [KIT ...]

Every file must be read without a warning, in millimetres, with a title, the program and the job in its metadata; every mesh must be
closed and oriented, named after a part of checklist.json and coloured; its volume must be the checklist's. In assembly.3mf the
objects must lie where print_from_model says, on plates in print pose apart from each other; every part and every jig on exactly one
plate, in the box that the checklist's plate map says.
Exit code 0: all is so; 1: something is not; 2: no kit, or no 3MF file in it.
"""

import json
import sys
from pathlib import Path

import lib3mf
import numpy as np

# lib3mf keeps single precision; a volume of f32 tetrahedra about the origin is summed here in f64.
VOLUME_RATIO = 1e-6
# Single-precision coordinates of up to 500 mm, through a transform kept in single precision.
PLACE_MM = 2e-4
# Two parts on a plate may not be nearer, mm, than the program says it leaves, less rounding.
GAP_MM = 5.0 - 1e-3
OURS = "urn:equipoise:kit"

WRAPPER = lib3mf.get_wrapper()


class Faults(list):
    def must(self, holds, text):
        if not holds:
            self.append(text)


def matrix(transform):
    """A 3MF transform as a 4×4 matrix for column vectors."""
    fields = np.array([[transform.Fields[column][row] for row in range(3)] for column in range(4)], dtype=float)
    whole = np.eye(4)
    whole[:3, :3] = fields[:3].T
    whole[:3, 3] = fields[3]
    return whole


def corners(mesh):
    """The corners of a mesh object as an (n, 3, 3) array."""
    vertices = np.array([list(v.Coordinates) for v in mesh.GetVertices()], dtype=float)
    triangles = np.array([list(t.Indices) for t in mesh.GetTriangleIndices()], dtype=int)
    return vertices[triangles]


def volume(triangles):
    a, b, c = (triangles[:, i] - triangles[:, 0].mean(axis=0) for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def below(resource, at):
    """The mesh objects of an object that lies at a 4×4 matrix, each with its own."""
    if resource.IsMeshObject():
        return [(resource, at)]
    found = []
    for index in range(resource.GetComponentCount()):
        component = resource.GetComponent(index)
        found += below(component.GetObjectResource(), at @ matrix(component.GetTransform()))
    return found


def read(path, faults):
    model = WRAPPER.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    faults.must(reader.GetWarningCount() == 0, f"{reader.GetWarningCount()} warnings: " + "; ".join(
        str(reader.GetWarning(i)) for i in range(reader.GetWarningCount())))
    return model


def metadata(model):
    group = model.GetMetaDataGroup()
    items = [group.GetMetaData(i) for i in range(group.GetMetaDataCount())]
    return {(item.GetNameSpace(), item.GetName()): item.GetValue() for item in items}


def judge_file(path, sheet):
    """The faults of one file, and what it places: part id, triangles, matrix."""
    faults = Faults()
    try:
        model = read(path, faults)
    except Exception as error:  # lib3mf raises its own class for every fault
        return Faults([f"lib3mf cannot read it: {error}"]), []
    faults.must(model.GetUnit() == lib3mf.ModelUnit.MilliMeter, f"its unit is {model.GetUnit()}")
    told = metadata(model)
    for key in [("", "Title"), ("", "Application"), (OURS, "Job")]:
        faults.must(told.get(key), f"it has no metadata {key[1]}")
    faults.must(told.get((OURS, "Job")) == sheet["job"], "its job is another")
    items, found = model.GetBuildItems(), []
    while items.MoveNext():
        item = items.GetCurrent()
        placed = below(item.GetObjectResource(), matrix(item.GetObjectTransform()))
        found += [(mesh.GetName(), mesh, at) for mesh, at in placed]
    parts = {part["id"]: part for part in sheet["parts"] + sheet.get("jigs", [])}
    scale = np.prod((sheet["printer"].get("print_scale_ratio") or [1, 1, 1]))
    placings = []
    for name, mesh, at in found:
        faults.must(name in parts, f"the object {name!r} is no part and no jig of the checklist")
        faults.must(mesh.IsManifoldAndOriented(), f"{name} is not closed and oriented")
        _, _, is_coloured = mesh.GetObjectLevelProperty()
        faults.must(is_coloured, f"{name} has no colour")
        triangles = corners(mesh)
        if name in parts:
            promised = parts[name]["volume_mm3"] * scale
            faults.must(abs(volume(triangles) / promised - 1) < VOLUME_RATIO, f"{name} has {volume(triangles)} mm³, not {promised}")
            # The checklist does not count the triangles of jigs.
            faults.must(len(triangles) == parts[name].get("triangles", len(triangles)), f"{name} has {len(triangles)} triangles")
        placings.append((name, triangles, at))
    faults.must(placings, "it builds nothing")
    return faults, placings


def judge_assembly(placings, sheet):
    faults, scale = Faults(), np.diag(list(sheet["printer"].get("print_scale_ratio") or [1, 1, 1]) + [1])
    faults.must(sorted(name for name, _, _ in placings) == sorted(p["id"] for p in sheet["parts"]), "it does not hold every part once")
    for part in sheet["parts"]:
        for name, triangles, at in placings:
            if name == part["id"]:
                wanted = np.linalg.inv(scale @ np.array(part["print_from_model"]))
                flat = np.c_[triangles.reshape(-1, 3), np.ones(3 * len(triangles))]
                off = np.abs(flat @ (at - wanted).T).max()
                faults.must(off < PLACE_MM, f"{name} is {off} mm from its place")
    return faults


def judge_plate(placings, told):
    """The faults of one plate; told is what the plate map of the checklist says about it."""
    faults, boxes = Faults(), []
    for name, triangles, at in placings:
        laid = triangles.reshape(-1, 3) @ at[:3, :3].T + at[:3, 3]
        faults.must(abs(laid[:, 2].min()) < PLACE_MM, f"{name} does not rest on the plate")
        faults.must(abs(at[2, :3] - [0, 0, 1]).max() < 1e-12, f"{name} is not in print pose")
        boxes.append((name, laid[:, :2].min(axis=0), laid[:, :2].max(axis=0)))
    for i, (name, low, high) in enumerate(boxes):
        for other, from_, to in boxes[i + 1:]:
            gap = max((low - to).max(), (from_ - high).max())
            faults.must(gap > GAP_MM, f"{name} and {other} are {gap} mm apart")
    if told is None:
        return Faults(faults + ["the plate map does not name it"])
    spots = {spot["id"]: spot for spot in told["holds"]}
    faults.must(sorted(spots) == sorted(name for name, _, _ in boxes), f"its plate map holds {sorted(spots)}")
    for name, low, high in boxes:
        if name in spots:
            mapped = np.array(spots[name]["low_mm"])
            off = max(abs(mapped - low).max(), abs(mapped + spots[name]["size_mm"] - high).max())
            faults.must(off < PLACE_MM, f"{name} lies {off} mm from where the plate map says")
        beyond = max((-low).max(), (high - told["size_mm"]).max())
        faults.must(beyond < PLACE_MM, f"{name} reaches {beyond} mm beyond the plate")
    return faults


def judge_kit(kit):
    sheet = json.loads((kit / "checklist.json").read_text())
    files = sorted(kit.rglob("*.3mf"))
    if not files:
        print(f"{kit}: no 3MF files")
        return 2
    failed, on_plates = False, []
    told = {plate["file"]: plate for plate in sheet.get("plates", [])}
    for path in files:
        name = path.relative_to(kit).as_posix()
        faults, placings = judge_file(path, sheet)
        if name == "assembly.3mf":
            faults += judge_assembly(placings, sheet)
        elif name.startswith("plate"):
            faults += judge_plate(placings, told.get(name))
            on_plates += [part for part, _, _ in placings]
        failed |= bool(faults)
        print(f"  {'FAIL' if faults else 'ok  '} {name:<44} {len(placings)} objects" + "".join(f"\n         {fault}" for fault in faults))
    if sorted(on_plates) != sorted(part["id"] for part in sheet["parts"] + sheet.get("jigs", [])):
        failed = True
        print(f"  FAIL the plates hold {sorted(on_plates)}")
    return int(failed)


def main(kits):
    codes = []
    for kit in map(Path, kits):
        print(kit)
        if not (kit / "checklist.json").is_file():
            print("  no checklist.json: this is no kit")
            codes.append(2)
            continue
        codes.append(judge_kit(kit))
    return max(codes, default=2)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
