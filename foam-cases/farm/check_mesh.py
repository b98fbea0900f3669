"""Judges a mesh by the files that OpenFOAM wrote: checkMesh's verdict, and the share of the body's surface in it."""

import math
import os
import re

from case_files import Failure, breakdown, cpu_seconds, read
from patch_area import patch_area

PROGRAMS = ("surfaceFeatureExtract", "blockMesh", "snappyHexMesh", "topoSet", "checkMesh")
# The mesh's share of the body's surface. A thin sheet whose rim is lost has 0.87 to 0.90, a good mesh of a curved
# thin shell 0.97; flat faces on a slender rod of eight cells around 0.95.
GOOD_AREA = (0.92, 1.05)
# Where no remedy gives a good mesh, the best one within these limits is used.
USABLE_AREA = (0.85, 1.2)
# Errors of a mesh with which a solution is useless, as checkMesh words them.
FATAL_ERRORS = ("zero or negative", "open cells", "Boundary openness", "incorrectly oriented", "Number of regions")


def is_within(value, bounds):
    return bounds[0] <= value <= bounds[1]


class Judgement:
    """The quality of a mesh. `errors` is empty for a good one, `fatal` for one that can be used."""

    def __init__(self):
        self.errors = []
        self.fatal = []
        self.area = 0.0
        self.seconds = 0.0
        self.facts = {}

    @property
    def is_good(self):
        return not self.errors and not self.fatal

    @property
    def misses_surface(self):
        """Whether a mesh exists that misses a part of the body's surface."""
        return bool(self.facts) and not is_within(self.area, GOOD_AREA)

    @property
    def verdict(self):
        return "; ".join(self.fatal + [error for error in self.errors if error not in self.fatal]) or "ok"


def judge_cells(judgement, folder, text):
    near_wake = re.search(r"^\s*nearWake\s+(\d+)", text, re.MULTILINE)
    cells = re.search(r"^\s+cells:\s+(\d+)", text, re.MULTILINE)
    orthogonality = re.search(r"non-orthogonality Max: ([\d.]+) average: ([\d.]+)", text)
    judgement.facts = {
        "cells": int(cells.group(1)) if cells else 0,
        "cells_in_near_wake": int(near_wake.group(1)) if near_wake else 0,
        "max_non_orthogonality": float(orthogonality.group(1)) if orthogonality else None,
        "mean_non_orthogonality": float(orthogonality.group(2)) if orthogonality else None,
        "body_area_over_true_area": judgement.area,
    }
    judgement.errors += [line.strip(" *").rstrip(".") for line in text.splitlines() if line.startswith(" ***")]
    judgement.fatal += [error for error in judgement.errors if any(word in error for word in FATAL_ERRORS)]
    if judgement.facts["cells_in_near_wake"] == 0:
        judgement.fatal.append("no cell lies from 0.2 L to 1.5 L of the body")


def judge_surface(judgement):
    share = f"{100 * judgement.area:.0f} % of the body's surface is in the mesh"
    if not is_within(judgement.area, USABLE_AREA):
        judgement.fatal.append(share)
    elif judgement.misses_surface:
        judgement.errors.append(share)


def judge(folder):
    """Judges the mesh in constant/polyMesh. Raises CaseError where a program was stopped before its end."""
    judgement = Judgement()
    text = ""
    try:
        for program in PROGRAMS:
            log = os.path.join(folder, "log." + program)
            text = read(log)
            if not re.search(r"^End$", text, re.MULTILINE):
                raise breakdown(log, program)
            finished = re.findall(r"Finished meshing in = ([\d.]+) s", text)
            judgement.seconds += float(finished[-1]) if finished else cpu_seconds(text)
    except Failure as failure:
        judgement.fatal.append(str(failure))
        return judgement
    # The surface's area is pi L^2 by the definition of L, the unit of length.
    judgement.area = patch_area(os.path.join(folder, "constant", "polyMesh"), "body") / math.pi
    judge_cells(judgement, folder, text)
    judge_surface(judgement)
    return judgement
