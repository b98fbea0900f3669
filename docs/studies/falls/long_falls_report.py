#!/usr/bin/env python3
"""The reference falls three times as long, by full CFD, held against the runtime: the folder long and its tables in README.md.

    long_falls_report.py BIN BODIES WORK    solves in WORK, on two meshes, the falls that references.csv has no row of, some
                                            CPU hours where it has none, flies every scene with its body and compares
    long_falls_report.py                    writes the tables again from the rows of the last run

BODIES as falls_report.py leaves it. Run from the project's folder.
"""

import glob
import os
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import FALLS, SCENES, rows_of_falls, table_of_falls  # noqa: E402
from references_report import CELLS  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from test_falls_report import fly, solve_references, table_of_references  # noqa: E402

FOLDER = f"{FALLS}/long"
# Of those whose references of the usual length are finer, a third of the usual cells tells nothing.
CELLS_OF = {name: (CELLS[0], CELLS[0] // 2) for name in ("spheroid", "disc-light", "plate")}


def main(words):
    if len(words) not in (1, 4):
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 4:
        programs, bodies, work = words[1:]
        solve_references(programs, work, FOLDER, SCENES, cells_of=CELLS_OF)
        fly(programs, bodies, FOLDER, SCENES)
    tables = [table_of_references(FOLDER, FALLS)] + [table_of_falls(rows_of_falls(noise, f"{FOLDER}/falls.csv")) for noise in ("off", "on")]
    write_tables(f"{FALLS}/README.md", tables, mark("long-falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
