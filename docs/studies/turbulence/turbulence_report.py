#!/usr/bin/python3
"""k and epsilon of the near wake by mesh, scheme and closure, beside scale-resolved CFD (README.md).

    turbulence_report.py FOLDER             solves in FOLDER what is missing, some five CPU hours where nothing is solved, writes
                                            turbulence.csv and the tables of README.md
    turbulence_report.py FOLDER CASE,MESH,MODEL[,BEFORE]...   only solves these, the last from the solution on the mesh BEFORE
    turbulence_report.py FOLDER --measured  solves nothing, and keeps the rows of cases that FOLDER has not
    turbulence_report.py                    writes the tables again

Run from the project's folder; needs python3-scipy. What is solved is not solved again.
"""

import csv
import math
import os
import sys

sys.dont_write_bytecode = True
from turbulence_cases import BLUNT, DIRECTIONS, folder_of, is_done, read_record, solve  # noqa: E402
from closures_report import cells_of  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402

ROWS, PAGE = "docs/studies/turbulence/turbulence.csv", "docs/studies/turbulence/README.md"
HEADING = ["case", "mesh", "model", "cells", "cpu_seconds", "k", "epsilon", "resolved_share", "shell_k", "first_half", "second_half",
           "time", "length"]
SCHEMES = ("sphere", "capsule-67", "ellipsoid-45", "cube-0", "disc-45")
CLOSURES = ("sphere", "disc-0", "ellipsoid-45", "cube-0", "capsule-67")
FINEST = (*SCHEMES, "disc-0")


def ladder(name, model, meshes):
    return [(name, mesh, model, before) for before, mesh in zip((None, *meshes), meshes)]


def all_cases():
    """(case, mesh, model, mesh before) in the order of solving."""
    cases = [(name, "wake", "DDES", None) for name in DIRECTIONS if name not in ("disc-20", "disc-70", "sheet-70", "ellipsoid-middle")]
    for name in DIRECTIONS:
        if name != "disc-20":
            cases += ladder(name, "kEpsilon", ("F10", "F14", "F20", "F28") if name in FINEST else ("F10", "F14", "F20"))
    for name in SCHEMES:
        cases += ladder(name, "LUST", ("F10", "F14", "F20")) + ladder(name, "upwind", ("F10", "F14", "F20"))
    cases += [(name, "medium", model, None) for model in ("kEpsilon", "wall") for name in SCHEMES]
    cases += [(name, "fine", "kEpsilon", "medium") for name in ("capsule-67", "ellipsoid-45")]
    for name in CLOSURES:
        for closure in ("realizableKE", "kOmegaSST"):
            cases += ladder(name, closure, ("F10", "F14", "F20"))
    return cases


def mesh_log(work, name, mesh):
    own = folder_of(work, name, mesh, "DDES")
    return own if mesh == "wake" else os.path.join(work, f"mesh_{DIRECTIONS[name][0]}_{mesh}")


def row_of(work, name, mesh, model):
    from turbulence_fields import eddies, near_wake
    folder = folder_of(work, name, mesh, model)
    k, epsilon, resolved, shell = near_wake(folder, name, model)
    row = [name, mesh, model, cells_of(mesh_log(work, name, mesh)), f"{read_record(os.path.join(folder, 'rounds.json'))['cpu_seconds']:.0f}",
           f"{k:.4g}", "" if epsilon is None else f"{epsilon:.4g}", f"{resolved:.3g}", f"{shell:.4g}"]
    return row + ([f"{value:.4g}" for value in eddies(folder, name)] if model == "DDES" else [""] * 4)


def write_rows(work):
    kept = {(row["case"], row["mesh"], row["model"]): list(row.values()) for row in read_rows()}
    with open(ROWS, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADING)
        for name, mesh, model, _ in all_cases():
            if is_done(folder_of(work, name, mesh, model)):
                writer.writerow(row_of(work, name, mesh, model))
            elif (name, mesh, model) in kept:
                writer.writerow(kept[name, mesh, model])


def read_rows():
    if not os.path.exists(ROWS):
        return []
    with open(ROWS, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Results:
    def __init__(self, rows):
        self.rows = {(row["case"], row["mesh"], row["model"]): row for row in rows}

    def has(self, *key):
        return key in self.rows

    def k(self, *key):
        return float(self.rows[key]["k"])

    def chi(self, *key):
        return float(self.rows[key]["epsilon"]) / self.k(*key)

    def length(self, *key):
        return math.sqrt(self.k(*key)) / self.chi(*key)

    def change(self, quantity, of, to):
        return f"{100 * abs(math.expm1(math.log(getattr(self, quantity)(*to) / getattr(self, quantity)(*of)))):.0f} %"


def kind(name):
    return "blunt" if name in BLUNT else "smooth"


def table_of_meshes(found):
    lines = []
    for name in DIRECTIONS:
        keys = [(name, mesh, "kEpsilon") for mesh in ("F10", "F14", "F20", "F28") if found.has(name, mesh, "kEpsilon")]
        if len(keys) < 3:
            continue
        third, last = keys[1], keys[2]
        lines.append([name, kind(name)] + [" / ".join(f"{found.k(*key):.3g}" for key in keys), found.change("k", last, third),
                                            " / ".join(f"{found.chi(*key):.2f}" for key in keys), found.change("chi", last, third),
                                            *((found.change("k", last, keys[3]), found.change("chi", last, keys[3])) if len(keys) > 3
                                              else ("-", "-"))])
    return table(["case", "", "k / U^2 on 15,000 / 42,000 / 120,000 / 330,000 cells", "42,000 beside 120,000", "chi L / U", "likewise",
                  "k, 330,000 beside 120,000", "chi"], lines)


def table_of_schemes(found):
    lines = []
    for name in SCHEMES:
        here, lust, upwind = ((name, "F20", model) for model in ("kEpsilon", "LUST", "upwind"))
        if not found.has(*lust):
            continue
        first = (f"{found.k(*upwind):.3g}", f"{found.chi(*upwind):.2f}") if found.has(*upwind) else ("-", "-")
        lines.append([name, f"{found.k(*here):.3g}", f"{found.k(*lust):.3g}", found.change("k", here, lust), first[0],
                      f"{found.chi(*here):.2f}", f"{found.chi(*lust):.2f}", first[1]])
    return table(["case", "k by linearUpwind", "by LUST", "apart", "k by upwind of k and epsilon", "chi by linearUpwind", "by LUST",
                  "by upwind"], lines)


def table_of_walls(found):
    lines = []
    for name in SCHEMES:
        here, wall, fine = (name, "medium", "kEpsilon"), (name, "medium", "wall"), (name, "fine", "kEpsilon")
        if found.has(*here) and found.has(*wall):
            lines.append([name, f"{found.k(*wall):.3g}", f"{found.k(*here):.3g}", f"{found.chi(*wall):.2f}", f"{found.chi(*here):.2f}",
                          f"{found.k(*fine):.3g}" if found.has(*fine) else "-", f"{found.k(name, 'F20', 'kEpsilon'):.3g}"])
    return table(["case", "k, production at the wall", "without", "chi, production at the wall", "without",
                  "k on 58,000 cells, coarse behind the body", "k on 120,000"], lines)


def table_of_closures(found):
    lines = []
    for name in CLOSURES:
        keys = [(name, "F20", model) for model in ("kEpsilon", "realizableKE", "kOmegaSST")]
        if all(found.has(*key) for key in keys):
            lines.append([name] + [f"{found.k(*key):.3g}" for key in keys] + [f"{found.chi(*key):.2f}" for key in keys])
    return table(["case", "k, kEpsilon", "realizableKE", "kOmegaSST", "chi, kEpsilon", "realizableKE", "kOmegaSST"], lines)


def table_beside_ddes(found):
    lines = []
    for name in DIRECTIONS:
        steady, resolved = (name, "F20", "kEpsilon"), (name, "wake", "DDES")
        if not (found.has(*steady) and found.has(*resolved)):
            continue
        row = found.rows[resolved]
        k, truth = found.k(*steady), found.k(*resolved)
        lines.append([name, kind(name), f"{truth:.3g}", f"{float(row['first_half']):.3g}, {float(row['second_half']):.3g}", f"{k:.3g}",
                      f"{math.sqrt(k / truth):.2f}", f"{float(row['time']):.2f}", f"{1 / found.chi(*steady):.2f}",
                      f"{0.635 / found.chi(*steady):.2f}", f"{float(row['length']):.2f}", f"{found.length(*steady):.2f}"])
    return table(["case", "", "k, DDES", "of its halves (resolved)", "k, kEpsilon", "rms over DDES's", "time, DDES", "k/epsilon",
                  "0.635 k/epsilon", "length, DDES", "k^(3/2)/epsilon"], lines)


def main(words):
    if words and "," in "".join(words[1:]):
        os.makedirs(words[0], exist_ok=True)
        for case in words[1:]:
            solve(words[0], *case.split(","))
        return
    if words:
        for case in [] if "--measured" in words else all_cases():
            os.makedirs(words[0], exist_ok=True)
            solve(words[0], *case)
        write_rows(words[0])
    found = Results(read_rows())
    write_tables(PAGE, [table_of_meshes(found), table_of_schemes(found), table_of_walls(found), table_of_closures(found), table_beside_ddes(found)],
                 mark("turbulence"))


if __name__ == "__main__":
    main(sys.argv[1:])
