#!/usr/bin/env python3
"""Falls by the loads of the surface, without CFD, beside full CFD; what it takes of bodies that come with samara.

    surface_report.py BIN    flies the falls, and writes surface-loads.csv and the tables of docs/studies/surface-loads/README.md
    surface_report.py        writes the tables again from the rows of the last run

BIN: the folder of the programs. Run from the project's folder.
"""

import csv
import glob
import os
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
import falls_report  # noqa: E402
from falls_report import BODIES, FALLS, SCENES, compared, row_of, run, table_of_falls, worst_figure, written  # noqa: E402
from long_falls_report import FOLDER as LONG  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from test_falls_report import FOLDER as TEST_FALLS  # noqa: E402
from test_falls_report import SEEN  # noqa: E402

ROWS = "docs/studies/surface-loads/surface-loads.csv"
# The constants were chosen on the first; nobody had looked at the others then.
CHOSEN = list(SCENES) + ["cube"]
SHAPES = {name: shape for name, (shape, _) in BODIES.items()} | {
    "cube": "meshes/shapes/cube.geo", "samara": "meshes/shapes/samara.geo"}


def shape_of(body):
    return f"meshes/shapes/{body.removeprefix('samara:')}.geo" if body.startswith("samara:") else SHAPES[body]


def plain(programs, shape, folder):
    """A body file of the shape without tables."""
    file = os.path.join(folder, os.path.basename(shape).replace(".geo", ".body.h5"))
    if not os.path.exists(file):
        run([f"{programs}/samara", "kirchhoff", shape, "-o", file, "--json"])
    return file


def flown(programs, name, shape, folder, falls):
    comparison = compared(programs, plain(programs, shape, folder), name, folder, falls=falls)
    row = row_of(name, "off", comparison)
    print(name, row[2], row[3], f"{100 * worst_figure(comparison):.0f} %")
    return row


def fly(programs):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in CHOSEN:
            rows.append(["chosen"] + flown(programs, name, SHAPES[SCENES.get(name, name)], folder, FALLS))
        rows += [["long"] + flown(programs, name, SHAPES[body], folder, LONG) for name, body in SCENES.items()]
        rows.append(["test"] + flown(programs, "samara", SHAPES["samara"], folder, FALLS))
        for name, body in SEEN.items():
            rows.append(["test"] + flown(programs, name, shape_of(body), folder, TEST_FALLS))
    written(ROWS, [["set"] + falls_report.heading()] + rows)


def main(words):
    if len(words) > 2:
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 2:
        fly(words[1])
    with open(ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    tables = [table_of_falls([row for row in rows if row["set"] == kind]) for kind in ("chosen", "test", "long")]
    write_tables("docs/studies/surface-loads/README.md", tables, mark("surface"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
