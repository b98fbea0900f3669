#!/usr/bin/env python3
"""The test set of docs/studies/test-falls: falls that nothing was fitted on nor chosen by, held against the runtime.

    test_falls_report.py BIN BODIES WORK    solves in WORK, by full CFD on two meshes, the falls that references.csv has no row
                                            of, bakes what is missing in BODIES, flies every scene and compares
    test_falls_report.py                    writes the tables again from the rows of the last run

Writes docs/studies/test-falls/NAME.h5, references.csv and falls.csv, and the tables of README.md. Run from the project's
folder.
"""

import csv
import glob
import os
import shutil
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
import falls_report  # noqa: E402
from falls_report import FIGURES, RUNS, baked, compared, rows_of_falls, table_of_falls, written  # noqa: E402
from references_report import CELLS, CLOSURE, differences, number, percent, solved  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

FOLDER = "docs/studies/test-falls"
# With which body each fall is flown: one of falls_report.py, or a ready-baked one.
SCENES = {
    "box-3500": "box", "thick-disc-3500": "thick-disc", "plate-2200": "plate", "sheet-600": "sheet",
    "ellipsoid-1800": "ellipsoid", "spheroid-1700": "spheroid", "disc-8500": "disc-heavy", "disc-1300": "disc-light",
    "cube-1300": "samara:cube",
}
# Test sets of before, which have been looked at.
SEEN = {
    "disc-2000": "disc-range", "disc-3000": "disc-range", "disc-6000": "disc-range", "ellipsoid-3000": "ellipsoid-range",
    "sheet-steep": "sheet", "sphere-light": "samara:sphere", "plate-steep": "plate", "spheroid-steep": "spheroid",
    "box-1500": "box", "box-6000": "box", "thick-disc-1400": "thick-disc", "thick-disc-5000": "thick-disc",
    "cube-1050": "samara:cube", "cube-2400": "samara:cube", "ellipsoid-1600": "ellipsoid-range", "sheet-1000": "sheet",
    "disc-4500": "samara:disc",
    "box-2500": "box", "box-4000": "box", "thick-disc-2500": "thick-disc", "thick-disc-7000": "thick-disc",
    "cube-1400": "samara:cube", "ellipsoid-2200": "ellipsoid-range", "sheet-800-edge": "sheet",
    "disc-7800": "samara:disc",
    "box-2000": "box", "box-7000": "box", "thick-disc-1800": "thick-disc", "thick-disc-4000": "thick-disc",
    "plate-end": "plate", "spheroid-spin": "spheroid", "disc-1500-edge": "disc-light", "ellipsoid-1300": "ellipsoid",
    "box-3000": "box", "thick-disc-3000": "thick-disc", "cube-1800": "samara:cube", "plate-turned": "plate",
    "sheet-900": "sheet", "ellipsoid-1400": "ellipsoid", "spheroid-1400": "spheroid", "disc-9500": "disc-heavy",
    "cube-2000": "samara:cube",
    "box-5000": "box", "thick-disc-6000": "thick-disc", "plate-edge": "plate",
    "sheet-700": "sheet", "ellipsoid-2000": "ellipsoid", "spheroid-1500": "spheroid", "disc-10400": "disc-heavy",
    "cube-1150": "samara:cube", "cube-3200": "samara:cube",
}
ROWS = f"{FOLDER}/falls.csv"


def file_of(programs, bodies, body):
    if body.startswith("samara:"):
        return f"runtime/bodies/{body.removeprefix('samara:')}.body.h5"
    return baked(programs, bodies, body)[0]


def rows_of_references(folder=FOLDER):
    """Those of references.csv of a folder of falls; none where there is no such file."""
    if not os.path.exists(f"{folder}/references.csv"):
        return []
    with open(f"{folder}/references.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def solve_references(programs, work, folder, names, seen=(), cells_of=None):
    """Solves the named falls of a folder that references.csv there has no row of and writes them with their uncertainty, and its
    rows; those of falls that were `seen` stay. `cells_of`: cells of the mesh and of the coarser one, where not the usual ones."""
    heads = (["fall", "cells", "cpu_seconds", "balance_force", "balance_moment", "regime", "regime_coarse"] + list(FIGURES)
             + [f"{figure}_by_mesh" for figure in FIGURES])
    rows = {row["fall"]: [row[head] for head in heads] for row in rows_of_references(folder)}
    os.makedirs(work, exist_ok=True)
    for name in names:
        if name in rows:
            continue
        cells, coarse_cells = (cells_of or {}).get(name, CELLS)
        coarse, _ = solved(programs, work, name, coarse_cells, CLOSURE, falls=folder)
        file, result = solved(programs, work, name, cells, CLOSURE, ["--other-mesh", coarse], falls=folder)
        shutil.copyfile(file, f"{folder}/{name}.h5")
        by_mesh, regime_by_mesh = differences(programs, coarse, file)
        body, balance = result["body"], result["balance"]
        rows[name] = [name, result["cells"], result["cpu_seconds"], balance["force"], balance["moment"], body["regime"],
                      regime_by_mesh] + [body.get(figure) for figure in FIGURES] + by_mesh
        written(f"{folder}/references.csv", [heads] + [rows[known] for known in (*names, *seen) if known in rows])


def fly(programs, bodies, folder, scenes):
    """Flies the scenes of a folder whose fall is solved with their bodies, and writes the rows of falls.csv there."""
    rows = []
    os.makedirs(bodies, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        solved_falls = {row["fall"] for row in rows_of_references(folder)}
        for noise in RUNS:
            for scene, body in scenes.items():
                if scene not in solved_falls:
                    continue
                comparison = compared(programs, file_of(programs, bodies, body), scene, work, noise, folder)
                rows.append(falls_report.row_of(scene, noise, comparison))
                print(*rows[-1])
    written(f"{folder}/falls.csv", [falls_report.heading()] + rows)


def table_of_references(folder=FOLDER, folder_of_page=FOLDER):
    lines = ["| fall | cells | CPU s | momenta balance (force / moment) | descent | frequency | amplitude | rms angular speed "
             "| regime | coarser mesh: descent | frequency | amplitude | rms angular speed | regime |", "|---" * 14 + "|"]
    for row in rows_of_references(folder):
        changes = [percent(float(row[f"{figure}_by_mesh"])) if row[f"{figure}_by_mesh"] else "-" for figure in FIGURES]
        lines.append("| " + " | ".join(
            [f"[{row['fall']}]({os.path.relpath(f'{folder}/' + row['fall'], folder_of_page)}.toml)", f"{int(row['cells']):,}",
             f"{float(row['cpu_seconds']):.0f}",
             f"{100 * float(row['balance_force']):.1f} / {100 * float(row['balance_moment']):.1f} %",
             number(row["descent_speed"], 1, 3, " m/s"), number(row["frequency"], 1, 3, " Hz"),
             number(row["inclination_amplitude"], 57.29578, 2, " degrees"), number(row["rms_angular_speed"], 1, 3, " rad/s"),
             row["regime"]] + changes + [row["regime_coarse"]]) + " |")
    return "\n".join(lines) + "\n"


def tables():
    """Of the references; of the test set and of those of before, without noise and with."""
    return [table_of_references()] + [table_of_falls([row for row in rows_of_falls(noise, ROWS) if row["fall"] in falls])
                                      for falls in (SCENES, SEEN) for noise in ("off", "on")]


def main(words):
    if len(words) not in (1, 4):
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 4:
        programs, bodies, work = words[1:]
        solve_references(programs, work, FOLDER, SCENES, SEEN)
        fly(programs, bodies, FOLDER, SCENES | SEEN)
    write_tables(f"{FOLDER}/README.md", tables(), mark("test-falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
