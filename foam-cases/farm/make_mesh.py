#!/usr/bin/env -S python3 -IB
"""Makes the mesh of a case, and tries remedies in a fixed order until it is good.

    make_mesh.py FOLDER   runs FOLDER/Allrun mesh and writes FOLDER/mesh.json where the mesh can be used

A mesh is good where checkMesh finds no error and contains the body's whole surface (check_mesh.py). Otherwise the remedies
below are tried, each in place of the one before, by a file `remedy` that `parameters` includes at its end; mesh.json lists
them and their results. Where none gives a good mesh, the usable one with the fewest errors is taken; its verdict names them.

Otherwise exits with 1 and one line with the error; where the body is the cause (not where a program was only stopped)
FOLDER/failed.json with that reason is written too. mesh.json is written last and whole, so that its existence means success.
"""

import os
import re
import shutil
import subprocess
import sys

sys.path.append(os.path.dirname(os.path.realpath(__file__)))  # which python3 -I leaves out
from farm_script import input_hash, run_on_folder  # noqa: E402
from case_files import Failure, CaseError, parameter, read, write_entries, write_json  # noqa: E402
from check_mesh import PROGRAMS, judge  # noqa: E402

# The products of `Allrun mesh`.
PRODUCTS = ("constant/polyMesh", "constant/extendedFeatureEdgeMesh", "constant/triSurface/body.eMesh")


def thinner_layers(plan):
    return {"layerThickness": 0.3}


def one_layer(plan):
    return {"layers": 1, "layerThickness": 0.3}


def no_layers(plan):
    return {"layers": 0}


def finer_background(plan):
    """Cells smaller by a tenth, which intersect the body at other places."""
    return {"backgroundCells": round(1.1 * plan["backgroundCells"])}


def more_levels(plan, count):
    """Smaller cells along the surface, two deep at each level, so that snappyHexMesh resolves what it missed."""
    cell = 2 * plan["boxHalfWidth"] / plan["backgroundCells"]
    finest = plan["surfaceLevel"] + count
    shells = [f"({2 * cell / 2 ** level:.6g} {level})" for level in range(finest, plan["surfaceLevel"], -1)]
    return {"surfaceLevel": finest, "refinementShells": f"({' '.join(shells)} {plan['refinementShells'][1:]}"}


def one_more_level(plan):
    return more_levels(plan, 1)


def two_more_levels(plan):
    return more_levels(plan, 2)


# In the order in which they are tried: those that cost the fewest cells and the least accuracy first. For meshes that
# miss a part of the surface, and for those with other errors.
REMEDIES_OF_SURFACE = {
    "finer background": finer_background,
    "one more surface level": one_more_level,
    "two more surface levels": two_more_levels,
}
REMEDIES_OF_CELLS = {
    "thinner layers": thinner_layers,
    "one layer": one_layer,
    "finer background": finer_background,
    "one more surface level": one_more_level,
    "no layers": no_layers,
}


def planned(folder):
    """Returns the entries of `parameters` that remedies change."""
    text = read(os.path.join(folder, "parameters"))
    plan = {name: int(parameter(text, name)) for name in ("backgroundCells", "surfaceLevel", "layers")}
    plan["boxHalfWidth"] = parameter(text, "boxHalfWidth")
    shells = re.search(r"^refinementShells\s+(\(.*\));", text, re.MULTILINE)
    if not shells:
        raise CaseError("parameters: has no entry refinementShells")
    plan["refinementShells"] = shells.group(1)
    return plan


def clear(folder):
    for name in PRODUCTS:
        path = os.path.join(folder, name)
        if os.path.isdir(path) and not os.path.islink(path):
            shutil.rmtree(path)
        elif os.path.lexists(path):
            os.remove(path)
    for name in ["remedy", "mesh.json", "failed.json"] + ["log." + program for program in PROGRAMS]:
        if os.path.lexists(os.path.join(folder, name)):
            os.remove(os.path.join(folder, name))


def attempt(folder, remedy, entries):
    """Makes the mesh with the remedy's entries and judges it."""
    clear(folder)
    if entries:
        write_entries(os.path.join(folder, "remedy"), f"In place of entries of parameters: {remedy} (make_mesh.py)",
                      entries)
    # Its logs hold the errors; its output is needed only where there are no logs.
    result = subprocess.run([os.path.join(folder, "Allrun"), "mesh"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, check=False)
    if not os.path.exists(os.path.join(folder, "log." + PROGRAMS[0])):
        raise CaseError((result.stdout.strip().splitlines() or ["Allrun mesh did nothing"])[-1])
    return judge(folder)


def attempts_until_good(folder):
    """Returns (remedy, entries, judgement) of each attempt; the last one is good, where there is a good mesh."""
    plan = planned(folder)
    attempts = [("as planned", {}, attempt(folder, "as planned", {}))]
    remedies = REMEDIES_OF_SURFACE if attempts[0][2].misses_surface else REMEDIES_OF_CELLS
    for remedy, change in remedies.items():
        if attempts[-1][2].is_good:
            break
        entries = change(plan)
        attempts.append((remedy, entries, attempt(folder, remedy, entries)))
    return attempts


def badness(tried):
    """The key by which meshes are ordered from the best to the worst; the first of equals is used."""
    judgement = tried[2]
    return (len(judgement.fatal), len(judgement.errors), round(abs(judgement.area - 1.0), 2))


def make_mesh(folder):
    attempts = attempts_until_good(folder)
    best = min(attempts, key=badness)
    remedy, entries, judgement = best
    if judgement.fatal:
        raise Failure(f"the body cannot be meshed: {judgement.fatal[0]}, and {len(attempts) - 1} remedies did not help: "
                      f"parts may be too thin for the cells; thicken them, or use a finer --quality; "
                      f"see {folder}/log.snappyHexMesh")
    seconds = sum(tried[2].seconds for tried in attempts)
    if best is not attempts[-1]:
        judgement = attempt(folder, remedy, entries)
        seconds += judgement.seconds
    write_json(os.path.join(folder, "mesh.json"), {
        **judgement.facts,
        "verdict": judgement.verdict,
        "remedy": remedy,
        "attempts": [{"remedy": tried[0], "verdict": tried[2].verdict} for tried in attempts],
        "cpu_seconds": round(seconds, 2),
        "inputs_hash": input_hash(folder),
    })


if __name__ == "__main__":
    sys.exit(run_on_folder(sys.argv, __doc__, make_mesh))
