#!/usr/bin/env python3
"""Judges what OpenFOAM left behind, from its own logs.

    check_case.py mesh FOLDER       writes FOLDER/mesh.json where the mesh is fit to be solved on
    check_case.py solution FOLDER   writes FOLDER/provenance.json where the solution holds

Exit 1 with one line that says what is wrong and names the log. The JSON files are written last and whole, so
that their existence means success. The folder above holds plan.json, whose input hashes they repeat.
"""

import json
import math
import os
import re
import sys

# A steady solution on these meshes ends with initial residuals near 1e-3, where the wake is steady, and with
# 1e-2 where it is not quite; the components across the flow, which hold little but noise, stay at 1e-2.
LARGEST_RESIDUAL = {"U": 0.05, "p": 0.05, "k": 0.05, "epsilon": 0.05}
# The largest force coefficient that is no sign of divergence, on the area of the sphere of equal surface: a
# plate broadside has 2.5.
LARGEST_COEFFICIENT = 20.0
# How much of the body's surface the mesh may miss, and how much it may add by steps.
SURFACE_AREA_RANGE = (0.8, 1.2)
# Faults of a mesh on which a solver's result means nothing, as checkMesh words them.
FATAL_MESH_FAULTS = ("zero or negative", "open cells", "Boundary openness", "incorrectly oriented",
                     "Number of regions")


class Fault(Exception):
    """What is wrong, in one line for the user."""


def read(path):
    try:
        with open(path, errors="replace") as file:
            return file.read()
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error


def write_json(path, content):
    """Writes the file whole, or not at all."""
    temporary = path + ".part"
    with open(temporary, "w") as file:
        json.dump(content, file, indent=2, allow_nan=False)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(temporary, path)


def numbers(text):
    """All the numbers in the text, `nan` and `inf` among them."""
    return [float(word) for word in re.findall(r"[-+]?(?:\d[\d.]*(?:[eE][-+]?\d+)?|nan|inf)", text)]


def check_ended(log, program):
    """Faults of a program that did not reach its end, with the iteration where it stopped."""
    text = read(log)
    if re.search(r"^End$", text, re.MULTILINE):
        return text
    times = re.findall(r"^Time = (\d+)", text, re.MULTILINE)
    where = f" at iteration {times[-1]}" if times else ""
    fatal = re.search(r"FOAM FATAL[^\n]*\n(?:\s*\n)*([^\n]*)", text)
    if fatal:
        raise Fault(f"{program} failed{where}: {fatal.group(1).strip().rstrip('.')}; see {log}")
    if "Floating point exception" in text:
        raise Fault(f"{program} diverged (floating point exception){where}; see {log}")
    raise Fault(f"{program} was stopped{where}, before its end; see {log}")


def cpu_seconds(log_text):
    times = re.findall(r"ExecutionTime = ([\d.]+) s", log_text)
    return float(times[-1]) if times else 0.0


def input_hash(folder, key=None):
    """The hash that plan.json, one folder up, gives the inputs; empty where the case stands alone."""
    path = os.path.join(folder, "..", "plan.json")
    if not os.path.exists(path):
        return ""
    plan = json.loads(read(path))
    if key:
        return plan.get(key, {}).get("inputs_hash", "")
    name = os.path.basename(os.path.abspath(folder))
    for case in plan["cases"]:
        if case["name"] == name:
            return case.get("inputs_hash", "")
    return ""


def foam_list(path):
    """The entries of an ASCII list file of OpenFOAM (points, faces), as lists of numbers."""
    body = re.split(r"^\d+\s*^\(", read(path), maxsplit=1, flags=re.MULTILINE)
    if len(body) != 2:
        raise Fault(f"{path}: is no ASCII list of OpenFOAM; set writeFormat ascii and make the mesh again")
    return [numbers(line) for line in body[1].splitlines() if "(" in line]


def patch_area(mesh_folder, patch):
    """The area of a patch, from the mesh's files; 0 where there is none."""
    entry = re.search(rf"^\s*{patch}\s*\{{(.*?)\}}", read(os.path.join(mesh_folder, "boundary")),
                      re.MULTILINE | re.DOTALL)
    if not entry:
        return 0.0
    count = int(re.search(r"nFaces\s+(\d+)", entry.group(1)).group(1))
    start = int(re.search(r"startFace\s+(\d+)", entry.group(1)).group(1))
    points = foam_list(os.path.join(mesh_folder, "points"))
    faces = foam_list(os.path.join(mesh_folder, "faces"))
    area = 0.0
    for face in faces[start:start + count]:
        corners = [points[int(index)] for index in face[1:]]
        vector = [0.0, 0.0, 0.0]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            vector[0] += (a[1] * b[2] - a[2] * b[1]) / 2
            vector[1] += (a[2] * b[0] - a[0] * b[2]) / 2
            vector[2] += (a[0] * b[1] - a[1] * b[0]) / 2
        area += math.hypot(*vector)
    return area


def check_mesh(folder):
    seconds = 0.0
    for program in ("surfaceFeatureExtract", "blockMesh", "snappyHexMesh", "topoSet"):
        text = check_ended(os.path.join(folder, "log." + program), program)
        finished = re.findall(r"Finished meshing in = ([\d.]+) s", text)
        seconds += float(finished[-1]) if finished else cpu_seconds(text)
    log = os.path.join(folder, "log.checkMesh")
    text = check_ended(log, "checkMesh")

    faults = [line.strip(" *") for line in text.splitlines() if line.startswith(" ***")]
    for fault in faults:
        if any(word in fault for word in FATAL_MESH_FAULTS):
            raise Fault(f"the mesh cannot be solved on: {fault}; see {log}")

    # The surface's area is pi L^2 by the definition of L, the unit of length.
    area = patch_area(os.path.join(folder, "constant", "polyMesh"), "body") / math.pi
    if not SURFACE_AREA_RANGE[0] <= area <= SURFACE_AREA_RANGE[1]:
        raise Fault(f"the mesh has {100 * area:.0f} % of the body's surface: the body is too thin or too fine "
                    f"for the cells of surfaceLevel in {folder}/parameters; see {os.path.join(folder, 'log.snappyHexMesh')}")
    shell = re.search(r"^\s*shell\s+(\d+)", text, re.MULTILINE)
    if not shell or int(shell.group(1)) == 0:
        raise Fault(f"the mesh has no cell from 0.05 L to 0.25 L of the body; see {folder}/log.topoSet")
    orthogonality = re.search(r"non-orthogonality Max: ([\d.]+) average: ([\d.]+)", text)
    write_json(os.path.join(folder, "mesh.json"), {
        "cells": int(re.search(r"^\s+cells:\s+(\d+)", text, re.MULTILINE).group(1)),
        "shell_cells": int(shell.group(1)),
        "verdict": "ok" if not faults else "; ".join(faults),
        "max_non_orthogonality": float(orthogonality.group(1)) if orthogonality else None,
        "mean_non_orthogonality": float(orthogonality.group(2)) if orthogonality else None,
        "body_area_over_true_area": area,
        "cpu_seconds": seconds,
        "inputs_hash": input_hash(folder, "mesh"),
    })


def table(path, first):
    """The rows of a function object's output from the given iteration on, without the iteration."""
    rows = [numbers(line) for line in read(path).splitlines() if line and not line.startswith("#")]
    rows = [row[1:] for row in rows if row and row[0] >= first]
    if not rows:
        raise Fault(f"{path}: holds no iteration from {first:g} on")
    return rows


def mean_and_deviation(rows, columns):
    means, deviations = [], []
    for column in columns:
        values = [row[column] for row in rows]
        mean = math.fsum(values) / len(values)
        means.append(mean)
        deviations.append(math.sqrt(math.fsum((value - mean) ** 2 for value in values) / len(values)))
    return means, deviations


def parameter(text, name):
    match = re.search(rf"^{name}\s+([^;]+);", text, re.MULTILINE)
    if not match:
        raise Fault(f"parameters: has no entry {name}")
    values = numbers(match.group(1))
    return values if match.group(1).startswith("(") else values[0]


def final_residuals(log_text, log):
    """The initial residuals of the last iteration."""
    last = log_text.rfind("\nTime = ")
    found = {}
    for field, value in re.findall(r"Solving for (\w+), Initial residual = (\S+?),", log_text[last:]):
        found.setdefault(field, float(value))
    if not found:
        raise Fault(f"no residual in {log}")
    return found


def check_residuals(residuals, log):
    for field, bound in LARGEST_RESIDUAL.items():
        values = [value for name, value in residuals.items() if re.fullmatch(field + "[xyz]?", name)]
        if not values:
            raise Fault(f"no residual of {field} in {log}")
        # Of the velocity's components the best counts: those across the flow may be noise alone.
        best = min(values)
        if not all(map(math.isfinite, values)) or best > bound:
            raise Fault(f"did not converge: the residual of {field} ended at {best:.2g}, above {bound:g}; "
                        f"see {log}")


def check_solution(folder):
    log = os.path.join(folder, "log.simpleFoam")
    text = check_ended(log, "simpleFoam")
    parameters = read(os.path.join(folder, "parameters"))
    residuals = final_residuals(text, log)
    check_residuals(residuals, log)

    start = parameter(parameters, "averagingStart")
    flow = parameter(parameters, "flowVelocity")
    output = os.path.join(folder, "postProcessing")
    forces = table(os.path.join(output, "forces", "0", "force.dat"), start)
    moments = table(os.path.join(output, "forces", "0", "moment.dat"), start)
    shell = table(os.path.join(output, "shell", "0", "volFieldValue.dat"), start)
    force, force_deviation = mean_and_deviation(forces, range(3))
    moment, moment_deviation = mean_and_deviation(moments, range(3))
    turbulence, turbulence_deviation = mean_and_deviation(shell, range(2))
    if not all(map(math.isfinite, force + moment + turbulence)):
        raise Fault(f"diverged: a force or turbulence is not finite; see {log}")
    # F/(rho U^2 A/2) with rho = U = L = 1 and A = pi L^2/4
    largest = max(math.hypot(*row[:3]) for row in forces) / (math.pi / 8)
    if largest > LARGEST_COEFFICIENT:
        raise Fault(f"diverged: a force coefficient reached {largest:.3g}; see {log}")
    drag = math.fsum(f * u for f, u in zip(force, flow)) / (math.pi / 8)
    if drag <= 0.0:
        raise Fault(f"diverged: the drag coefficient is {drag:.3g}, not positive; see {log}")
    if min(turbulence) <= 0.0:
        raise Fault(f"diverged: k or epsilon is not positive in the shell; see {log}")

    mesh_path = os.path.join(folder, "..", "mesh", "mesh.json")
    schemes = read(os.path.join(folder, "system", "fvSchemes"))
    closure = re.search(r"RASModel\s+(\w+);", read(os.path.join(folder, "constant", "turbulenceProperties")))
    build = re.search(r"^Build\s*:\s*(.*)$", text, re.MULTILINE)
    write_json(os.path.join(folder, "provenance.json"), {
        "case": os.path.basename(os.path.abspath(folder)),
        "openfoam": build.group(1).strip() if build else "",
        "closure": closure.group(1) if closure else "laminar",
        "schemes": dict(re.findall(r"^\s*div\(phi,(\w+)\)\s+([^;]+);", schemes, re.MULTILINE)),
        "direction": parameter(parameters, "direction"),
        "reynolds_number": parameter(parameters, "reynoldsNumber"),
        "inflow": {"k": parameter(parameters, "inflowK"), "epsilon": parameter(parameters, "inflowEpsilon"),
                   "eddy_viscosity": parameter(parameters, "inflowNut")},
        "iterations": int(parameter(parameters, "iterations")),
        "averaged_iterations": len(forces),
        "final_residuals": residuals,
        "drag_coefficient": drag,
        "force": force,
        "force_deviation": force_deviation,
        "moment": moment,
        "moment_deviation": moment_deviation,
        "shell": {"k": turbulence[0], "epsilon": turbulence[1],
                  "k_deviation": turbulence_deviation[0], "epsilon_deviation": turbulence_deviation[1]},
        "mesh": json.loads(read(mesh_path)) if os.path.exists(mesh_path) else None,
        "cpu_seconds": cpu_seconds(text),
        "inputs_hash": input_hash(folder),
    })


def main(words):
    if len(words) != 3 or words[1] not in ("mesh", "solution"):
        sys.stderr.write(__doc__)
        return 2
    try:
        if words[1] == "mesh":
            check_mesh(words[2])
        else:
            check_solution(words[2])
    except Fault as fault:
        print(f"{words[2]}: {fault}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
