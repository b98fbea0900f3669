#!/usr/bin/env python3
"""Judges a mesh from the files that OpenFOAM left behind.

    check_mesh.py FOLDER   writes FOLDER/mesh.json where the mesh is fit to be solved on

Else exit 1 with one line that says what is wrong and names the log; where the mesh is at fault (not where a
program was only stopped) also FOLDER/failed.json with that reason. mesh.json is written last and whole, so that its existence means success.
"""

import math
import os
import re
import sys

from case_files import Failure, Fault, check_ended, cpu_seconds, input_hash, numbers, read, run_on_folder, write_json

# How much of the body's surface the mesh may miss, and how much it may add by steps.
SURFACE_AREA_RANGE = (0.8, 1.2)
# Faults of a mesh on which a solver's result means nothing, as checkMesh words them.
FATAL_MESH_FAULTS = ("zero or negative", "open cells", "Boundary openness", "incorrectly oriented",
                     "Number of regions")


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
            raise Failure(f"the mesh cannot be solved on: {fault}; see {log}")

    # The surface's area is pi L^2 by the definition of L, the unit of length.
    area = patch_area(os.path.join(folder, "constant", "polyMesh"), "body") / math.pi
    if not SURFACE_AREA_RANGE[0] <= area <= SURFACE_AREA_RANGE[1]:
        raise Failure(f"the mesh has {100 * area:.0f} % of the body's surface: the body is too thin or too fine "
                      f"for the cells of surfaceLevel in {folder}/parameters; see {folder}/log.snappyHexMesh")
    shell = re.search(r"^\s*shell\s+(\d+)", text, re.MULTILINE)
    if not shell or int(shell.group(1)) == 0:
        raise Failure(f"the mesh has no cell from 0.05 L to 0.25 L of the body; see {folder}/log.topoSet")
    orthogonality = re.search(r"non-orthogonality Max: ([\d.]+) average: ([\d.]+)", text)
    write_json(os.path.join(folder, "mesh.json"), {
        "cells": int(re.search(r"^\s+cells:\s+(\d+)", text, re.MULTILINE).group(1)),
        "shell_cells": int(shell.group(1)),
        "verdict": "ok" if not faults else "; ".join(faults),
        "max_non_orthogonality": float(orthogonality.group(1)) if orthogonality else None,
        "mean_non_orthogonality": float(orthogonality.group(2)) if orthogonality else None,
        "body_area_over_true_area": area,
        "cpu_seconds": seconds,
        "inputs_hash": input_hash(folder),
    })


if __name__ == "__main__":
    sys.exit(run_on_folder(sys.argv, __doc__, check_mesh))
