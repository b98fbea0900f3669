#!/usr/bin/env python3
"""Drag by several models of the flow, on several meshes, against measurements (README.md).

    closures_report.py FOLDER ROWS.csv [CASES]   solves the next CASES cases (all) of STUDY that have no row yet

The cases are made in FOLDER from the template body-flow; a row is written as soon as its case is solved, so that what
was stopped goes on.

Columns: Reynolds number and drag are over the literature's own length and area, side force too. `pressure_drag`: the
part of the pressure. `drag_deviation`: rms of the drag about its mean over the last half of the iterations, or steps;
`drag_error`: how well that mean is known (stationarity.py). `y_plus`: of the cells at the body, mean and largest.
`iterations`, `cpu_seconds`: over all attempts of iterate.py, whose `verdict` stands. `layers`: the mean number that
snappyHexMesh could make. `error`: over the literature's.
"""

import csv
import math
import os
import re
import resource
import shutil
import subprocess
import sys

os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
HERE = os.path.dirname(os.path.abspath(__file__))
FOAM_CASES = os.path.join(HERE, "..", "..", "..", "foam-cases")
TEMPLATES = os.path.join(FOAM_CASES, "templates")
sys.dont_write_bytecode = True
sys.path[:0] = [TEMPLATES, os.path.join(TEMPLATES, "body-flow"), os.path.join(FOAM_CASES, "farm")]
from case_files import history, numbers, read, read_record  # noqa: E402
from closures_study import BODIES, MESH_BEFORE, MESHES, MODELS, STUDY  # noqa: E402
from stationarity import AREA_UNIT, mean, unsteadiness  # noqa: E402

COLUMNS = ("body", "reynolds_number", "model", "mesh", "cells", "layers", "y_plus", "largest_y_plus", "iterations", "cpu_seconds",
           "mesh_seconds", "verdict", "drag", "pressure_drag", "drag_deviation", "drag_error", "side_force", "literature",
           "error")


def set_parameters(folder, entries):
    path = os.path.join(folder, "parameters")
    text = read(path)
    for name, value in entries.items():
        text, count = re.subn(rf"^({name}\s+)[^;]+;", rf"\g<1>{value};", text, flags=re.MULTILINE)
        if count != 1:
            sys.exit(f"parameters: has no entry {name}")
    with open(path, "w") as file:
        file.write(text)


def make_case(folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(os.path.join(TEMPLATES, "body-flow"), folder)
    shutil.copy(os.path.join(TEMPLATES, "case_files.py"), folder)


def folder_name(*words):
    return re.sub("[^a-zA-Z0-9.]+", "-", " ".join(words))


def run(words, folder):
    """The exit status and the CPU seconds of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(os.path.join(folder, "log.run"), "w") as log:
        status = subprocess.run(words, cwd=folder, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return status, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def mesh_folder(work, body, mesh):
    """The folder of the mesh, made where it is not there, with `seconds` beside it."""
    folder = os.path.join(work, folder_name("mesh", body, mesh))
    done = os.path.join(folder, "seconds")
    if not os.path.exists(done):
        make_case(folder)
        set_parameters(folder, MESHES[mesh])
        os.makedirs(os.path.join(folder, "constant/triSurface"), exist_ok=True)
        BODIES[body].write(os.path.join(folder, "constant/triSurface/body.stl"))
        status, seconds = run(["./Allrun", "mesh"], folder)
        if status != 0:
            sys.exit(f"{folder}: no mesh")
        with open(done, "w") as file:
            file.write(f"{seconds:.1f}\n")
    return folder


def cells_of(mesh):
    return int(re.search(r"^\s+cells:\s+(\d+)", read(os.path.join(mesh, "log.checkMesh")), re.MULTILINE).group(1))


def layers_of(mesh):
    """The mean number of layers along the surface that snappyHexMesh could make."""
    found = re.findall(r"^body +\d+ +([\d.]+) ", read(os.path.join(mesh, "log.snappyHexMesh")), re.MULTILINE)
    return found[-1] if found else "0"


def y_plus(case, solver):
    """Mean and largest over the surface, of the last written time."""
    run([solver, "-postProcess", "-func", "yPlus", "-latestTime"], case)
    found = re.findall(r"^[^#\n]*body\s+(.*)$", "".join(
        read(os.path.join(folder, name)) for folder, _, names in os.walk(os.path.join(case, "postProcessing/yPlus"))
        for name in names), re.MULTILINE)
    smallest, largest, average = numbers(found[-1]) if found else (math.nan,) * 3
    return average, largest


def start_of(work, body, reynolds, model, mesh):
    """The solved case on the mesh before this one, whose solution the case starts from as in a bake, or none."""
    before = folder_name(body, f"{reynolds:g}", model, MESH_BEFORE.get(mesh, "none"))
    if read_record(os.path.join(work, before, "rounds.json")).get("verdict") not in ("stationary", "restless"):
        return "none"
    # What iterate.py takes for a solved case.
    with open(os.path.join(work, before, "provenance.json"), "w") as file:
        file.write("{}\n")
    return before


def solve(work, body, reynolds, model, mesh, more):
    shape = BODIES[body]
    meshed = mesh_folder(work, body, mesh)
    case = os.path.join(work, folder_name(body, f"{reynolds:g}", model, mesh))
    # From here on Re and C_D are those of the literature: over the body's own length and area.
    viscosity = shape.length / reynolds
    settings = {**MODELS[model], **more}
    # By the template's own: 1 % and the fluid's own viscosity.
    intensity, viscosity_ratio = settings.pop("inflow", (0.01, 1.0))
    k = 1.5 * intensity ** 2
    make_case(case)
    set_parameters(case, {**MESHES[mesh], "reynoldsNumber": f"{1 / viscosity:.6g}", "viscosity": f"{viscosity:.8g}",
                          "inflowK": f"{k:.6g}", "inflowEpsilon": f"{0.09 * k * k / (viscosity_ratio * viscosity):.6g}",
                          "inflowNut": f"{viscosity_ratio * viscosity:.8g}",
                          "inflowOmega": f"{k / (viscosity_ratio * viscosity):.6g}",
                          "startFrom": start_of(work, body, reynolds, model, mesh),
                          "direction": shape.direction_text(1), "flowVelocity": shape.direction_text(-1),
                          **settings})
    os.symlink(os.path.join("..", "..", os.path.basename(meshed), "constant", "polyMesh"),
               os.path.join(case, "constant", "polyMesh"))
    os.makedirs(os.path.join(case, "constant/triSurface"), exist_ok=True)
    status, seconds = run(["./Allrun"], case)
    rounds = read_record(os.path.join(case, "rounds.json"))
    row = dict.fromkeys(COLUMNS, "")
    row.update(body=body, reynolds_number=f"{reynolds:g}", model=model, mesh=mesh, cells=cells_of(meshed), layers=layers_of(meshed),
               cpu_seconds=f"{seconds:.1f}", mesh_seconds=read(os.path.join(meshed, "seconds")).strip(),
               verdict=rounds.get("verdict") or "stopped")
    literature = shape.literature(reynolds)
    if literature:
        row["literature"] = f"{literature:.3f}"
    forces = history(case, "forces", "force.dat")
    if forces and "averaging_start" in rounds:
        row["iterations"] = sum(one["iterations"] - one["first"] for one in rounds["attempts"])
        window = forces[int(rounds["averaging_start"]) - 1:]
        flow = [-x for x in shape.direction]
        unit = AREA_UNIT * shape.area / (math.pi / 4)

        def along(values):
            return sum(a * b for a, b in zip(values, flow)) / unit

        drags = [along(one[1:4]) for one in window]
        drag = mean(drags)
        force = [mean([one[i] for one in window]) / unit for i in (1, 2, 3)]
        side = math.sqrt(max(0.0, sum(f * f for f in force) - drag * drag))
        average, largest = y_plus(case, re.sub(r"\s", "", MODELS[model].get("solver", "simpleFoam")))
        row.update(drag=f"{drag:.4f}", pressure_drag=f"{mean([along(one[4:7]) for one in window]):.4f}",
                   drag_deviation=f"{math.sqrt(mean([(d - drag) ** 2 for d in drags])):.4f}",
                   drag_error=f"{unsteadiness(drags):.4f}", side_force=f"{side:.4f}", y_plus=f"{average:.2f}",
                   largest_y_plus=f"{largest:.2f}")
        if literature:
            row["error"] = f"{drag / literature - 1:.3f}"
    return row


def main(work, target, most=None):
    os.makedirs(work, exist_ok=True)
    rows = []
    if os.path.exists(target):
        with open(target, newline="") as file:
            rows = list(csv.DictReader(file))
    solved = {(row["body"], float(row["reynolds_number"]), row["model"], row["mesh"]) for row in rows}
    for body, reynolds, model, mesh, *more in STUDY:
        if (body, float(reynolds), model, mesh) in solved:
            continue
        if most == 0:
            return 0
        most = most - 1 if most else None
        row = solve(work, body, float(reynolds), model, mesh, more[0] if more else {})
        with open(target, "a", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            if file.tell() == 0:
                writer.writeheader()
            writer.writerow(row)
        print("  ".join(f"{row[name]!s:>9.14}" for name in COLUMNS), flush=True)
    return 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) == 4 else None))
