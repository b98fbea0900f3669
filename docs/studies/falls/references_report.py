#!/usr/bin/env python3
"""The reference falls of docs/studies/falls, solved by full CFD on two meshes and by two closures.

    references_report.py BIN WORK [--mesh-alone] [--others-alone] [NAME...]
        solves what is missing in WORK, some three CPU hours where nothing is, and writes docs/studies/falls/NAME.h5 with its
        uncertainties, references.csv, and the tables of README.md, where those by kEpsilon stand beside them; of the falls
        that are named, or all; with --mesh-alone not by the other closure; with --others-alone NAME.h5 is taken as
        it stands, and what it is held beside is solved
    references_report.py
        writes the tables again from references.csv

What is solved is not solved again. Run from the project's folder.
"""

import csv
import glob
import os
import shutil
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
import falls_report  # noqa: E402
from falls_report import FALLS, FIGURES, SCENES, percent, rows_of_falls, run, table_of_falls, written  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

# Cells of the reference and of the coarser mesh; a third of the usual ones is too coarse to tell anything of these.
CELLS, CELLS_OF = (20000, 6000), {name: (60000, 20000) for name in ("spheroid", "disc-light", "plate")}
CLOSURE, OTHER_CLOSURE = "kOmegaSSTLM", "kOmegaSST"
NAMES = list(SCENES) + ["cube", "airplane", "samara"]
ROWS, OLD_CLOSURE_ROWS = f"{FALLS}/references.csv", f"{FALLS}/k-epsilon/falls.csv"


def solved(programs, work, name, cells, closure, others=(), falls=FALLS):
    """The motion file of a fall of the folder `falls`, and what `samara validate` says of it."""
    folder = os.path.join(work, f"{name}-{cells}-{closure}")
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, f"{name}.h5")
    words = [f"{programs}/samara", "validate", f"{falls}/{name}.toml", "-o", file, "--cells", str(cells), "--closure", closure]
    return file, run(words + ["--json", *others])


def differences(programs, motion, reference):
    """By how much the figures of a motion differ from a reference's, over these; and its regime."""
    comparison = run([f"{programs}/samara", "compare", motion, reference, "--json"])
    measures = comparison["measures"]
    return [(measures.get(figure) or {}).get("relative_difference") for figure in FIGURES], comparison["motion"]["regime"]


def row_of(programs, work, name, mesh_alone, old):
    """The row of a fall, whose reference is solved where there is no `old` row of it, and held beside the others in any case."""
    cells, coarse_cells = CELLS_OF.get(name, CELLS)
    coarse, _ = solved(programs, work, name, coarse_cells, CLOSURE)
    others = ["--other-mesh", coarse]
    by_closure, regime_by_closure = [None] * len(FIGURES), None
    if not mesh_alone:
        other, _ = solved(programs, work, name, coarse_cells, OTHER_CLOSURE)
        others += ["--other-closure", f"{other},{coarse}"]
        by_closure, regime_by_closure = differences(programs, other, coarse)
    target = f"{FALLS}/{name}.h5"
    if old:
        run([f"{programs}/samara", "validate", target, "-o", target, "--json", *others])
        figures = old[:heading().index("regime_coarse")]
        measured = old[heading().index(FIGURES[0]):heading().index(f"{FIGURES[0]}_by_mesh")]
    else:
        file, result = solved(programs, work, name, cells, CLOSURE, others)
        shutil.copyfile(file, target)
        figures = [name, result["cells"], result["cpu_seconds"], result["balance"]["force"], result["balance"]["moment"],
                   result["largest_courant_number"], result["body"]["regime"]]
        measured = [result["body"].get(figure) for figure in FIGURES]
    by_mesh, regime_by_mesh = differences(programs, coarse, target)
    return figures + [regime_by_mesh, regime_by_closure] + measured + by_mesh + by_closure


def hold_k_epsilon(programs):
    """Writes the falls by kEpsilon beside the references."""
    rows = [falls_report.heading()]
    for name in SCENES:
        words = [f"{programs}/samara", "compare", f"{FALLS}/k-epsilon/{name}.h5", f"{FALLS}/{name}.h5", "--json"]
        rows.append(falls_report.row_of(name, "off", run(words)))
    written(OLD_CLOSURE_ROWS, rows)


def heading():
    return (["fall", "cells", "cpu_seconds", "balance_force", "balance_moment", "largest_courant_number", "regime",
             "regime_coarse", "regime_other_closure"] + list(FIGURES)
            + [f"{figure}_by_{cause}" for cause in ("mesh", "closure") for figure in FIGURES])


def title_of(name):
    """What a scene's first line says of it."""
    with open(f"{FALLS}/{name}.toml", encoding="utf-8") as scene:
        return scene.readline().lstrip("# ").rstrip(".\n")


def number(text, scale, digits, unit):
    return f"{scale * float(text):.{digits}g}{unit}" if text else "-"


def tables():
    with open(ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    falls = ["| fall | what | cells | CPU s | momenta balance (force / moment) | descent | frequency | amplitude | regime |",
             "|---" * 9 + "|"]
    errors = ["| fall | coarser mesh: descent | frequency | amplitude | rms angular speed | regime | other closure: descent "
              "| frequency | amplitude | rms angular speed | regime |", "|---" * 11 + "|"]
    for row in rows:
        name, turns = row["fall"], bool(row["frequency"])
        falls.append(f"| [{name}]({name}.toml) | {title_of(name)} | {int(row['cells']):,} | {float(row['cpu_seconds']):.0f} "
                     f"| {100 * float(row['balance_force']):.1f} / {100 * float(row['balance_moment']):.1f} % "
                     f"| {number(row['descent_speed'], 1, 3, ' m/s')} | {number(row['frequency'], 1, 3, ' Hz')} "
                     f"| {number(row['inclination_amplitude'], 57.29578, 2, ' degrees') if turns else '-'} | {row['regime']} |")
        cells = [name]
        for cause, regime in (("mesh", "regime_coarse"), ("closure", "regime_other_closure")):
            cells += [percent(float(row[f"{figure}_by_{cause}"]) if row[f"{figure}_by_{cause}"] else None) for figure in FIGURES]
            cells.append(row[regime] or "-")
        errors.append("| " + " | ".join(cells) + " |")
    beside = table_of_falls(rows_of_falls("off", OLD_CLOSURE_ROWS), "kEpsilon")
    return ["\n".join(lines) + "\n" for lines in (falls, errors)] + [beside]


def main(words):
    if len(words) == 2:
        sys.stderr.write(__doc__)
        return 2
    if len(words) > 2:
        mesh_alone, others_alone = "--mesh-alone" in words, "--others-alone" in words
        names = [word for word in words[3:] if not word.startswith("--")] or NAMES
        old = {}
        if os.path.exists(ROWS):
            with open(ROWS, newline="", encoding="utf-8") as file:
                old = {row[0]: row for row in list(csv.reader(file))[1:]}
        if others_alone and not set(names) <= set(old):
            sys.exit(f"{ROWS} has no row of {', '.join(sorted(set(names) - set(old)))}, which --others-alone needs")
        for name in names:
            old[name] = row_of(words[1], words[2], name, mesh_alone, old.get(name) if others_alone else None)
            print(*old[name])
        written(ROWS, [heading()] + [old[name] for name in NAMES if name in old])
        hold_k_epsilon(words[1])
    write_tables(f"{FALLS}/README.md", tables(), mark("references"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
