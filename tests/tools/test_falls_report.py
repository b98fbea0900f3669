#!/usr/bin/env python3
"""The test set of docs/test-falls: falls that nothing was fitted on nor chosen by, held against the runtime.

    test_falls_report.py BIN BODIES WORK    solves what is missing in WORK by full CFD on two meshes, bakes what is missing in
                                            BODIES, flies every scene and compares
    test_falls_report.py                    writes the tables again from the rows of the last run

Writes docs/test-falls/NAME.h5, references.csv and falls.csv, and the tables of docs/test-falls.md. Run from the project's
folder.
"""

import csv
import os
import shutil
import sys
import tempfile

import falls_report
from falls_report import FIGURES, RUNS, baked, compared, rows_of_falls, table_of_falls, written
from references_report import CELLS, CLOSURE, differences, number, percent, solved
from report_tables import mark, write_tables

FOLDER = "docs/test-falls"
# With which bodies each fall is flown, of those of docs/falls or ready-baked ones: first the one that is baked for its
# density.
SCENES = {
    "disc-2000": ("disc-range",),
    "disc-3000": ("disc-range",),
    "disc-6000": ("disc-range",),
    "ellipsoid-3000": ("ellipsoid-range", "samara:ellipsoid"),
    "sheet-steep": ("samara:sheet",),
    "sphere-light": ("samara:sphere",),
    "plate-steep": ("plate-resolved",),
    "spheroid-steep": ("spheroid-resolved",),
}
REFERENCES, ROWS = f"{FOLDER}/references.csv", f"{FOLDER}/falls.csv"


def file_of(programs, bodies, body):
    if body.startswith("samara:"):
        return f"runtime/bodies/{body.removeprefix('samara:')}.body.h5"
    return baked(programs, bodies, body)[0]


def solved_references(programs, work):
    """Solves the falls and writes them with their uncertainty, and the rows of references.csv."""
    rows = [["fall", "cells", "cpu_seconds", "balance_force", "balance_moment", "regime", "regime_coarse"] + list(FIGURES)
            + [f"{figure}_by_mesh" for figure in FIGURES]]
    for name in SCENES:
        cells, coarse_cells = CELLS
        coarse, _ = solved(programs, work, name, coarse_cells, CLOSURE, falls=FOLDER)
        file, result = solved(programs, work, name, cells, CLOSURE, ["--other-mesh", coarse], falls=FOLDER)
        shutil.copyfile(file, f"{FOLDER}/{name}.h5")
        by_mesh, regime_by_mesh = differences(programs, coarse, file)
        body, balance = result["body"], result["balance"]
        rows.append([name, result["cells"], result["cpu_seconds"], balance["force"], balance["moment"], body["regime"],
                     regime_by_mesh] + [body.get(figure) for figure in FIGURES] + by_mesh)
    written(REFERENCES, rows)


def flown(programs, bodies):
    """Flies every scene with its bodies, and writes the rows of falls.csv."""
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for noise in RUNS:
            for scene, names in SCENES.items():
                for body in names:
                    comparison = compared(programs, file_of(programs, bodies, body), scene, work, noise, FOLDER)
                    rows.append([body] + falls_report.row_of(scene, noise, comparison))
                    print(*rows[-1])
    written(ROWS, [["body"] + falls_report.heading()] + rows)


def table_of_references():
    with open(REFERENCES, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| fall | cells | CPU s | momenta balance (force / moment) | descent | frequency | amplitude | rms angular speed "
             "| regime | coarser mesh: descent | frequency | amplitude | rms angular speed | regime |", "|---" * 14 + "|"]
    for row in rows:
        changes = [percent(float(row[f"{figure}_by_mesh"])) if row[f"{figure}_by_mesh"] else "-" for figure in FIGURES]
        lines.append("| " + " | ".join(
            [f"[{row['fall']}](test-falls/{row['fall']}.toml)", f"{int(row['cells']):,}", f"{float(row['cpu_seconds']):.0f}",
             f"{100 * float(row['balance_force']):.1f} / {100 * float(row['balance_moment']):.1f} %",
             number(row["descent_speed"], 1, 3, " m/s"), number(row["frequency"], 1, 3, " Hz"),
             number(row["inclination_amplitude"], 57.29578, 2, " degrees"), number(row["rms_angular_speed"], 1, 3, " rad/s"),
             row["regime"]] + changes + [row["regime_coarse"]]) + " |")
    return "\n".join(lines) + "\n"


def tables():
    """Of the references; of each fall with the body that is baked for it, without noise and with; and with the others."""
    made = [table_of_references()]
    for noise in ("off", "on"):
        made.append(table_of_falls([row for row in rows_of_falls(noise, ROWS) if row["body"] == SCENES[row["fall"]][0]]))
    others = [row | {"fall": f"{row['fall']}, the body {row['body']}"} for row in rows_of_falls("off", ROWS)
              if len(SCENES[row["fall"]]) > 1 and row["body"] != SCENES[row["fall"]][0]]
    return made + [table_of_falls(others)]


def main(words):
    if len(words) not in (1, 4):
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 4:
        programs, bodies, work = words[1:]
        os.makedirs(bodies, exist_ok=True)
        os.makedirs(work, exist_ok=True)
        solved_references(programs, work)
        flown(programs, bodies)
    write_tables("docs/test-falls.md", tables(), mark("test-falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
