#!/usr/bin/env python3
"""Ensembles of falls that start a little differently: full CFD beside the runtime, with its noise and without.

    ensembles_report.py BIN BODIES WORK    solves in WORK what is missing of ENSEMBLES, an hour and a half of CPU where nothing
                                           is, flies them, and writes docs/studies/noise/ensembles/NAME.h5 and ensembles.csv
    ensembles_report.py BIN BODIES         flies them against the motions that docs/studies/noise/ensembles has
    ensembles_report.py                    writes the tables again

Run from the project's folder.
"""

import csv
import glob
import os
import shutil
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import FIGURES, RUNS, baked, compared, percent, run, written  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

FOLDER = "docs/studies/noise/ensembles"
# The body that each is flown with.
ENSEMBLES = {"disc-light": "disc-range", "disc-heavy": "disc-range"}
CLOSURE = "kOmegaSSTDDES"
ROWS = f"{FOLDER}/ensembles.csv"
LANDING = ("depth", "time_runtime", "time_cfd", "time_cfd_error", "scatter_runtime", "scatter_runtime_error", "scatter_cfd",
           "scatter_cfd_error", "distance", "distance_by_chance", "probability")
FALL = [f"{figure}_{what}" for figure in FIGURES for what in ("cfd", "cfd_deviation", "runtime", "runtime_deviation")]


def solve(programs, work):
    os.makedirs(work, exist_ok=True)
    for name in ENSEMBLES:
        file = os.path.join(work, f"{name}.h5")
        run([f"{programs}/samara", "validate", f"{FOLDER}/{name}.toml", "-o", file, "--closure", CLOSURE, "--json"])
        shutil.copyfile(file, f"{FOLDER}/{name}.h5")


def rows_of(name, noise, comparison):
    """One for each level of the landings: the ensemble's figures stand in all of them."""
    measures = comparison["measures"]
    figures = []
    for figure in FIGURES:
        for side in ("reference", "motion"):
            estimate = measures[figure][side] or {}
            figures += [estimate.get("value"), estimate.get("deviation")]
    rows = []
    for landing in comparison["landings"]:
        motion, reference = landing["motion"], landing["reference"]
        rows.append([name, noise, comparison["motion"]["regime"], comparison["reference"]["regime"],
                     landing["depth"], motion["time"]["value"], reference["time"]["value"], reference["time"]["error"],
                     motion["scatter"]["value"], motion["scatter"]["error"], reference["scatter"]["value"],
                     reference["scatter"]["error"], landing["distance"], landing["distance_by_chance"], landing["probability"],
                     *figures])
    return rows


def fly(programs, bodies):
    rows = [["ensemble", "noise", "regime_runtime", "regime_cfd", *LANDING, *FALL]]
    with tempfile.TemporaryDirectory() as work:
        for name, body in ENSEMBLES.items():
            for noise in RUNS:
                comparison = compared(programs, baked(programs, bodies, body)[0], name, work, noise, FOLDER)
                rows += rows_of(name, noise, comparison)
    written(ROWS, rows)


def with_deviation(row, figure, side, scale=1.0):
    value, deviation = (row[f"{figure}_{side}{what}"] for what in ("", "_deviation"))
    return f"{scale * float(value):.3g} ({scale * float(deviation or 0):.1g})" if value else "-"


def table_of_figures(rows):
    lines = ["| ensemble | | descent, m/s | frequency, Hz | amplitude, degrees | rms angular speed, rad/s | regime |", "|---" * 7 + "|"]
    scales = (1.0, 1.0, 57.29578, 1.0)
    for name in ENSEMBLES:
        of_name = {row["noise"]: row for row in rows if row["ensemble"] == name}
        for title, row, side in (("full CFD", of_name["on"], "cfd"), ("runtime, noise on", of_name["on"], "runtime"),
                                 ("runtime, noise off", of_name["off"], "runtime")):
            cells = [with_deviation(row, figure, side, scale) for figure, scale in zip(FIGURES, scales)]
            lines.append(f"| {name} | {title} | " + " | ".join(cells) + f" | {row[f'regime_{side}']} |")
    return "\n".join(lines) + "\n"


def table_of_landings(rows):
    lines = ["| ensemble | level, m below | reached after, full CFD | noise on | off | places scattered by, full CFD | noise on | off "
             "| places apart, noise on | by chance | p |", "|---" * 11 + "|"]
    for on, off in zip([row for row in rows if row["noise"] == "on"], [row for row in rows if row["noise"] == "off"]):
        later = [percent(float(row["time_runtime"]) / float(row["time_cfd"]) - 1) for row in (on, off)]
        scatter = [f"{1e3 * float(row['scatter_runtime']):.3g} mm ({float(row['scatter_runtime']) / float(row['scatter_cfd']):.2g} times)"
                   for row in (on, off)]
        lines.append(f"| {on['ensemble']} | {float(on['depth']):.3g} | {float(on['time_cfd']):.3g} s | {later[0]} | {later[1]} "
                     f"| {1e3 * float(on['scatter_cfd']):.3g} +- {1e3 * float(on['scatter_cfd_error']):.2g} mm | {scatter[0]} | {scatter[1]} "
                     f"| {1e3 * float(on['distance']):.2g} mm | {1e3 * float(on['distance_by_chance']):.2g} mm | {float(on['probability']):.2g} |")
    return "\n".join(lines) + "\n"


def tables():
    with open(ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [table_of_figures(rows), table_of_landings(rows)]


def main(words):
    if len(words) == 2:
        sys.stderr.write(__doc__)
        return 2
    if len(words) > 3:
        solve(words[1], words[3])
    if len(words) > 2:
        fly(words[1], words[2])
    write_tables("docs/studies/noise/README.md", tables(), mark("ensembles"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
