#!/usr/bin/env python3
"""Families of published falls by the loads of the surface: strips over Froude numbers, and all 84 of the printed fruits.

    nature_families.py BIN

Flies them and writes strips.csv and, beside the published figures, fruits.csv; nature_tables.py makes
tables of them. BIN: the folder of the programs. Run from the project's folder; minutes.
"""

import csv
import glob
import itertools
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import run  # noqa: E402
from study_pictures import flights  # noqa: E402
from nature_measure import spin, swinging_descent  # noqa: E402
from nature_report import mean_of_flights, with_copies, write  # noqa: E402
from nature_scenes import fruit_scene, strip_scene  # noqa: E402
from nature_study import fruit_name, fruit_shape  # noqa: E402
from report_tables import table  # noqa: E402
from surface_report import plain  # noqa: E402

NATURE = "docs/studies/nature"
STRIPS, FRUITS = f"{NATURE}/strips.csv", f"{NATURE}/fruits.csv"
FROUDE_NUMBERS = [round(0.2 + 0.05 * i, 2) for i in range(37)]  # to 2
REGIMES = ("steady", "fluttering", "chaotic", "tumbling", "autorotating")
STRAIGHT = 10000  # mm: the radius that stands for a straight wing
NEAR = 0.15


def flown(programs, text, body, folder):
    """The motion file of a scene's copies, flown with a body file without tables."""
    scene, motion = (os.path.join(folder, f"family.{ending}") for ending in ("toml", "h5"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(with_copies(text, body, "surface"))
    run([f"{programs}/samara", "simulate", scene, "-o", motion, "--json"])
    return motion


def fly_strips(programs, folder):
    body = plain(programs, f"{NATURE}/strip.geo", folder)
    rows = []
    for froude in FROUDE_NUMBERS:
        motion = flown(programs, strip_scene(froude), body, folder)
        counts = run([f"{programs}/samara", "info", motion, "--json"])["bodies"][0]["regimes"]
        rows.append({"froude": froude} | {regime: counts[regime] for regime in REGIMES})
    write(STRIPS, ("froude", *REGIMES), rows)


def fly_fruits(programs, folder):
    rows = read(FRUITS)
    for row in rows:
        angle, radius, payload = int(row["angle"]), int(row["radius"]), float(row["payload"])
        body = plain(programs, f"{NATURE}/{fruit_shape(angle, radius)}.geo", folder)
        falls = list(flights(programs, flown(programs, fruit_scene(angle, radius, payload), body, folder)).values())
        for quantity, measure in (("descent", swinging_descent), ("spin", spin)):
            value, error = mean_of_flights([measure(poses) for poses in falls])
            row |= {f"surface_{quantity}": f"{value:.4g}", f"surface_{quantity}_error": f"{error:.2g}"}
        print(fruit_name(angle, radius, payload), row["surface_descent"], row["surface_spin"], flush=True)
    write(FRUITS, tuple(rows[0]), rows)


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def transition(rows):
    """'between a and b': the Froude numbers of the strips between which it is no longer the most of them that flutter."""
    swinging = [(float(row["froude"]), int(row["fluttering"]) + int(row["steady"]), sum(int(row[regime]) for regime in REGIMES))
                for row in rows]
    flutter = [froude for froude, count, of in swinging if 2 * count > of]
    others = [froude for froude, count, of in swinging if 2 * count <= of]
    if not others:
        return f"above {max(flutter):g}"
    if not flutter:
        return f"below {min(others):g}"
    if max(flutter) < min(others):
        return f"between {max(flutter):g} and {min(others):g}"
    return f"not sharp, {min(others):g} to {max(flutter):g}"


def strips_table():
    """The commonest regime of each stretch of Froude numbers."""
    def lines():
        stretches = itertools.groupby(read(STRIPS), lambda row: max(REGIMES, key=lambda regime: int(row[regime])))
        for regime, of in stretches:
            of = list(of)
            shares = [int(row[regime]) / sum(int(row[each]) for each in REGIMES) for row in of]
            spread = "" if min(shares) == max(shares) else f"{100 * min(shares):.0f} to "
            yield [f"{of[0]['froude']} to {of[-1]['froude']}", regime, f"{spread}{100 * max(shares):.0f} %"]

    return table(["Fr", "most of the 20", "share"], lines())


def slope(points):
    """Of the line that is nearest to (ln x, ln y): the exponent of y's growth with x."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean = [sum(each) / len(logs) for each in zip(*logs)]
    return sum((x - mean[0]) * (y - mean[1]) for x, y in logs) / sum((x - mean[0]) ** 2 for x, _ in logs)


def ratios(rows, quantity):
    return [float(row[f"surface_{quantity}"]) / float(row[quantity]) for row in rows]


def span(values):
    return f"{sum(values) / len(values):.2f} ({min(values):.2f} to {max(values):.2f})"


def fruits_table():
    """Shape by shape: measured over published, and how both grow with the payload."""
    rows = read(FRUITS)
    shapes = {}
    for row in rows:
        shapes.setdefault((row["angle"], int(row["radius"])), []).append(row)

    def lines():
        for (angle, radius), of in [*shapes.items(), (("all", 0), rows)]:
            name = "all" if angle == "all" else f"{angle} degrees, " + (f"R {radius} mm" if radius < STRAIGHT else "straight")
            cells = [name, str(len(of))]
            for quantity in ("descent", "spin"):
                found = ratios(of, quantity)
                cells += [span(found), str(sum(abs(ratio - 1) <= NEAR for ratio in found))]
                cells.append("" if angle == "all" else " / ".join(
                    f"{slope([(float(row['payload']), float(row[column])) for row in of]):.2f}"
                    for column in (quantity, f"surface_{quantity}")))
            yield cells

    within = f"within {100 * NEAR:.0f} %"
    return table(["fruits", "payloads", "descent, over published", within, "exponent of the payload, published / runtime",
                  "spin, over published", within, "exponent, published / runtime"], lines())


def main(programs):
    with tempfile.TemporaryDirectory() as folder:
        fly_strips(programs, folder)
        fly_fruits(programs, folder)
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
