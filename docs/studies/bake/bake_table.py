#!/usr/bin/env python3
"""Tables against CPU seconds, from what `samara bake --json` and `samara check-tables --json` printed.

    bake_table.py FOLDER ROWS.csv     FOLDER holds BODY-QUALITY.json and BODY-QUALITY.check.json

The seconds of free falls, of which no table is made, are not among them.
"""

import csv
import json
import os
import sys

BODIES = ("ellipsoid", "sheet")
QUALITIES = ("smoke", "preview", "standard", "high")
QUANTITIES = ("force", "moment", "turbulent_kinetic_energy", "dissipation_rate")


def read(path):
    with open(path) as file:
        return json.load(file)


def seconds_of_tables(bake):
    falls = sum(part["cpu_seconds"] for part in bake["cpu_account"] if part["part"].startswith("falls"))
    return bake["cpu_seconds"] - falls


def main(folder, target):
    rows = [["body", "quality", "cpu_seconds", "cases", "checked_cases", "within_two"]
            + [f"{quantity}_{what}" for quantity in QUANTITIES for what in ("error", "stated")]]
    for body in BODIES:
        for quality in QUALITIES:
            name = os.path.join(folder, f"{body}-{quality}")
            if not os.path.exists(name + ".check.json"):
                continue
            bake, check = read(name + ".json"), read(name + ".check.json")
            rows.append([body, quality, round(seconds_of_tables(bake), 1), len(bake["cases"]), len(check["cases"]),
                         round(check["within_two"], 3)]
                        + [f"{check[quantity][what]:.4g}" for quantity in QUANTITIES for what in ("error", "stated")])
    with open(target, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    for row in rows:
        print("  ".join(f"{value!s:>12.12}" for value in row))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
