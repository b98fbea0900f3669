#!/usr/bin/env python3
"""The ready-baked bodies beside falls of theirs by full CFD, with noise and without: bodies.csv and the tables of
docs/studies/falls/ready-baked.md.

    bodies_report.py BIN     flies them: seconds. BIN: the folder of the programs
    bodies_report.py         writes the tables again

Run from the project's folder.
"""

import glob
import os
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import FALLS, RUNS, compared, heading, row_of, rows_of_falls, table_of_falls, written  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

ROWS, PAGE = f"{FALLS}/bodies.csv", "docs/studies/falls/ready-baked.md"
# The falls of each body, and the folder that holds them.
FALLS_OF = {"airplane": ("airplane", FALLS), "cube": ("cube", FALLS), "disc": ("disc-4500", "docs/studies/test-falls"),
            "ellipsoid": ("ellipsoid-tilted", FALLS), "leaf": ("leaf", FALLS), "samara": ("samara", FALLS),
            "sheet": ("sheet", FALLS), "sphere": ("sphere", FALLS)}


def flown(programs):
    with tempfile.TemporaryDirectory() as work:
        return [row_of(body, noise, compared(programs, f"runtime/bodies/{body}.body.h5", scene, work, noise, folder,
                                             {"loads": "table"}))
                for noise in RUNS for body, (scene, folder) in FALLS_OF.items()]


def main(words):
    if len(words) > 2:
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 2:
        written(ROWS, [heading()] + flown(words[1]))
    write_tables(PAGE, [table_of_falls(rows_of_falls(noise, ROWS), "body") for noise in RUNS], mark("bodies"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
