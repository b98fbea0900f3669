#!/usr/bin/env python3
"""Judges a solution from the files that OpenFOAM left behind.

    check_solution.py FOLDER   writes FOLDER/provenance.json where the solution holds

Else exit 1 with one line that says what is wrong and names the log; where the flow diverged or did not converge
(not where the solver was only stopped) also FOLDER/failed.json with that reason. provenance.json is written last
and whole, so that its existence means success. The folder above holds plan.json, whose hash of the case's inputs
it repeats.
"""

import json
import math
import os
import re
import sys

from case_files import (Failure, Fault, check_ended, cpu_seconds, input_hash, numbers, parameter, read, run_on_folder,
                        write_json)

# A steady solution on these meshes ends with initial residuals near 1e-3, where the wake is steady, and with
# 1e-2 where it is not quite; the components across the flow, which hold little but noise, stay at 1e-2.
LARGEST_RESIDUAL = {"U": 0.05, "p": 0.05, "k": 0.05, "epsilon": 0.05}
# The largest force coefficient that is no sign of divergence, on the area of the sphere of equal surface: a
# plate broadside has 2.5.
LARGEST_COEFFICIENT = 20.0


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
            raise Failure(f"did not converge: the residual of {field} ended at {best:.2g}, above {bound:g}; "
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
        raise Failure(f"diverged: a force or turbulence is not finite; see {log}")
    # F/(rho U^2 A/2) with rho = U = L = 1 and A = pi L^2/4
    largest = max(math.hypot(*row[:3]) for row in forces) / (math.pi / 8)
    if largest > LARGEST_COEFFICIENT:
        raise Failure(f"diverged: a force coefficient reached {largest:.3g}; see {log}")
    drag = math.fsum(f * u for f, u in zip(force, flow)) / (math.pi / 8)
    if drag <= 0.0:
        raise Failure(f"diverged: the drag coefficient is {drag:.3g}, not positive; see {log}")
    if min(turbulence) <= 0.0:
        raise Failure(f"diverged: k or epsilon is not positive in the shell; see {log}")

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


if __name__ == "__main__":
    sys.exit(run_on_folder(sys.argv, __doc__, check_solution))
