#!/usr/bin/env python3
"""The tables of README.md and closures.csv, from the rows that closures_report.py wrote.

    closures_tables.py ROWS.csv DOCS
"""

import csv
import glob
import os
import shutil
import sys

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from closures_study import REYNOLDS_NUMBERS, STUDY, brown_lawler  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

NEAR = 0.1  # the goal: within that of the literature


def number(row, name):
    return float(row[name]) if row[name] else None


def key(row):
    return row["body"], number(row, "reynolds_number"), row["model"], row["mesh"]


def drag(row):
    """C_D with its error; in brackets where the case did not settle."""
    if not row or not row["drag"]:
        return "-"
    text = f"{number(row, 'drag'):.3f}"
    error = number(row, "error")
    if error is not None:
        percent = f"{100 * error:+.0f} %"
        text += f" ({f'**{percent}**' if abs(error) > NEAR else percent})"
    return f"[{text}]" if row["verdict"] == "failed" else text


def table(head, lines):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
                     + ["| " + " | ".join(line) + " |" for line in lines]) + "\n"


def sphere_table(rows):
    def lines():
        yield ["Brown and Lawler", ""] + [f"{brown_lawler(reynolds):.3f}" for reynolds in REYNOLDS_NUMBERS]
        models = list(dict.fromkeys((row["model"], row["mesh"]) for row in rows if row["body"] == "sphere"))
        for model, mesh in models:
            cells = [rows_by_key.get(("sphere", float(reynolds), model, mesh)) for reynolds in REYNOLDS_NUMBERS]
            yield [model, mesh] + [drag(row) for row in cells]

    rows_by_key = {key(row): row for row in rows}
    return table(["model", "mesh"] + [f"Re {reynolds:,.0f}" for reynolds in REYNOLDS_NUMBERS], lines())


def body_table(rows):
    def lines():
        for row in rows:
            if row["body"] != "sphere":
                yield [row["body"], row["literature"], row["model"], row["mesh"], row["layers"], row["y_plus"], drag(row),
                       row["side_force"], row["cpu_seconds"]]

    return table(["body", "literature", "model", "mesh", "layers made", "y+", "C_D", "side force", "CPU s"], lines())


def cost_table(rows):
    def lines():
        for row in rows:
            if row["body"] == "sphere" and number(row, "reynolds_number") in (1e4, 1e5):
                yield [f"{number(row, 'reynolds_number'):,.0f}", row["model"], row["mesh"], row["cells"], row["layers"],
                       f"{row['y_plus']} ({row['largest_y_plus']})", row["iterations"], row["cpu_seconds"], drag(row),
                       row["drag_error"], row["drag_deviation"], row["side_force"], row["verdict"]]

    return table(["Re", "model", "mesh", "cells", "layers made", "y+ mean (largest)", "iterations", "CPU s", "C_D",
                  "its error", "its swing (rms)", "side force", "verdict"], lines())


def main(source, folder):
    with open(source, newline="") as file:
        rows = list(csv.DictReader(file))
    order = {(body, float(reynolds), model, mesh): i for i, (body, reynolds, model, mesh, *_) in
             reversed(list(enumerate(STUDY)))}
    rows = sorted((row for row in rows if key(row) in order), key=lambda row: order[key(row)])
    target = os.path.join(folder, "closures.csv")
    with open(target + ".part", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    shutil.move(target + ".part", target)
    write_tables(os.path.join(folder, "README.md"), [sphere_table(rows), body_table(rows), cost_table(rows)], mark("closures"))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
