#!/usr/bin/env python3
"""The reference falls three times as long, by full CFD, held against the runtime: docs/falls/long and the tables of docs/falls.md.

    long_falls_report.py BIN BODIES WORK    solves in WORK, on two meshes, the falls that references.csv has no row of, some
                                            CPU hours where it has none, flies every scene with its body and compares
    long_falls_report.py                    writes the tables again from the rows of the last run

BODIES as falls_report.py leaves it. Run from the project's folder.
"""

import sys

from falls_report import FALLS, SCENES, rows_of_falls, table_of_falls
from references_report import CELLS
from report_tables import mark, write_tables
from test_falls_report import fly, solve_references, table_of_references

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
    tables = [table_of_references(FOLDER)] + [table_of_falls(rows_of_falls(noise, f"{FOLDER}/falls.csv")) for noise in ("off", "on")]
    write_tables("docs/falls.md", tables, mark("long-falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
