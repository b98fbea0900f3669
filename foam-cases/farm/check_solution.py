#!/usr/bin/env -S python3 -IB
"""Judges a solution by the files that OpenFOAM wrote.

    check_solution.py FOLDER   writes FOLDER/provenance.json where the solution holds

Otherwise exits with 1 and one line with the error and the log's name; where the flow diverged or did not converge (not where the
solver was only stopped) FOLDER/failed.json with that reason is written too. provenance.json is written last and whole, so that
its existence means success; it repeats the hash of the case's inputs in plan.json in the folder above.
"""

import math
import os
import re
import sys

sys.path.append(os.path.dirname(os.path.realpath(__file__)))  # which python3 -I leaves out
from farm_script import input_hash, mesh_record, run_on_folder, stopping_error  # noqa: E402
from case_files import Failure, CaseError, parameter, read, read_record, word, write_json  # noqa: E402
from stationarity import AREA_UNIT, has_turbulence_means, whole_histories  # noqa: E402


def mean_and_deviation(rows, columns):
    means, deviations = [], []
    for column in columns:
        values = [row[column] for row in rows]
        mean = math.fsum(values) / len(values)
        means.append(mean)
        deviations.append(math.sqrt(math.fsum((value - mean) ** 2 for value in values) / len(values)))
    return means, deviations


def final_residuals(log_text, log):
    """Returns the initial residuals of the last iteration by field."""
    last = log_text.rfind("\nTime = ")
    found = {}
    for field, value in re.findall(r"Solving for (\w+), Initial residual = (\S+?),", log_text[last:]):
        found.setdefault(field, float(value))
    if not found:
        raise CaseError(f"no residual in {log}")
    return found


def check_solution(folder):
    rounds = read_record(os.path.join(folder, "rounds.json"))
    if not rounds:
        raise CaseError("was stopped before its first round; run again to continue")
    parameters = read(os.path.join(folder, "parameters"))
    log = os.path.join(folder, "log." + word(parameters, "solver"))
    last = rounds["attempts"][-1]
    if rounds["verdict"] == "failed":
        raise Failure(f"{last['end']} (attempts: {', '.join(one['what'] for one in rounds['attempts'])})")
    if rounds["verdict"] is None:
        raise CaseError(stopping_error(folder, log))
    text = read(log)
    start = rounds["averaging_start"]
    turbulent = has_turbulence_means(parameters)
    time_step = last.get("time_step", 1)

    forces, moments, near_wake = (
        [row[1:] for row in rows if row[0] >= start]
        for rows in whole_histories(folder, last["iterations"], turbulent, time_step))
    force, force_deviation = mean_and_deviation(forces, range(3))
    moment, moment_deviation = mean_and_deviation(moments, range(3))
    flow = parameter(parameters, "flowVelocity")
    drag = math.fsum(f * u for f, u in zip(force, flow)) / AREA_UNIT
    if drag <= 0.0:
        raise Failure(f"diverged: the drag coefficient is {drag:.3g}, not positive; see {log}")

    build = re.search(r"^Build\s*:\s*(.*)$", text, re.MULTILINE)
    record = {
        "case": os.path.basename(os.path.abspath(folder)),
        "openfoam": build.group(1).strip() if build else "",
        "closure": "laminar" if word(parameters, "simulationType") == "laminar" else word(parameters, "closure"),
        "convection": word(parameters, "convection"),
        "gradient": word(parameters, "gradient"),
        "direction": parameter(parameters, "direction"),
        "reynolds_number": parameter(parameters, "reynoldsNumber"),
        "inflow": {"k": parameter(parameters, "inflowK"), "epsilon": parameter(parameters, "inflowEpsilon"),
                   "eddy_viscosity": parameter(parameters, "inflowNut")},
        "verdict": rounds["verdict"],
        "attempts": rounds["attempts"],
        "iterations": last["iterations"],
        # Half a step before the first, so that rounding does not matter.
        "averaging_start": (start - 0.5) * time_step if "time_step" in last else start,
        "averaged_iterations": len(forces),
        "final_residuals": final_residuals(text, log),
        "drag_coefficient": drag,
        "force": force,
        "force_deviation": force_deviation,
        "moment": moment,
        "moment_deviation": moment_deviation,
        "mesh": mesh_record(folder),
        "cpu_seconds": rounds["cpu_seconds"],
        "inputs_hash": input_hash(folder),
    }
    if turbulent:
        means, deviation = mean_and_deviation(near_wake, range(2))
        record["near_wake"] = {"k": means[0], "epsilon": means[1],
                               "k_deviation": deviation[0], "epsilon_deviation": deviation[1]}
    write_json(os.path.join(folder, "provenance.json"), record)


if __name__ == "__main__":
    sys.exit(run_on_folder(sys.argv, __doc__, check_solution))
