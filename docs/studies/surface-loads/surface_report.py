#!/usr/bin/env python3
"""Falls by the loads of the surface, without a bake, beside measured falls and full CFD.

    surface_report.py BIN           flies the falls, and writes surface-loads.csv, nature-falls.csv and the tables of
                                    docs/studies/surface-loads/README.md
    surface_report.py BIN FOLDER    writes the bodies and scenes that samara-surface-choice reads
    surface_report.py               writes the tables again from the rows of the last run

BIN: the folder of the programs. Run from the project's folder.
"""

import csv
import glob
import os
import shutil
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
import falls_report  # noqa: E402
from falls_report import BODIES, FALLS, SCENES, compared, row_of, run, table_of_falls, worst_figure, written  # noqa: E402
from long_falls_report import FOLDER as LONG  # noqa: E402
from nature_scenes import fruit_scene  # noqa: E402
from nature_study import fruit_name, fruit_shape  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from test_falls_report import FOLDER as TEST_FALLS  # noqa: E402
from test_falls_report import SEEN  # noqa: E402

ROWS = "docs/studies/surface-loads/surface-loads.csv"
NATURE_ROWS = "docs/studies/surface-loads/nature-falls.csv"
NATURE = "docs/studies/nature"
BAKED, BAKED_BODIES = "build/report-nature", ("thin-disc", "coin-5-czk")
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


def nature_bodies(programs, folder):
    """Writes what samara-surface-choice reads: bodies with added mass, and the scenes of the fruits."""
    shapes = set(SHAPES[body] for body in SCENES.values()) | {SHAPES["cube"], SHAPES["samara"]}
    shapes |= {f"{NATURE}/{name}.geo" for name in ("thin-disc", "thin-square", "coin-5-czk", "coin-50-czk")}
    with open(f"{NATURE}/fruits.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            fruit = int(row["angle"]), int(row["radius"]), float(row["payload"])
            shapes.add(f"{NATURE}/{fruit_shape(*fruit[:2])}.geo")
            with open(f"{folder}/{fruit_name(*fruit)}.toml", "w", encoding="utf-8") as scene:
                scene.write(fruit_scene(*fruit).replace(".geo\"", ".body.h5\""))
    for shape in shapes:
        plain(programs, shape, folder)


def fly_nature(programs):
    """Measured falls by the numbers in use: the half of the bodies that they were fitted to, and the other half; and by
    the baked bodies of build/report-nature, whose rows are kept where they are missing."""
    with open(NATURE_ROWS, newline="", encoding="utf-8") as file:
        baked = [row for row in csv.reader(file) if row[0] == "baked"]
    rows = [["half", "source", "name", "simulated", "measured", "miss", "holds"]]
    with tempfile.TemporaryDirectory() as folder:
        nature_bodies(programs, folder)
        for half in ("fit", "choose"):
            rows += nature_rows(programs, folder, half, half)
        if all(os.path.exists(f"{BAKED}/{name}.body.h5") for name in BAKED_BODIES):
            for name in BAKED_BODIES:
                shutil.copy(f"{BAKED}/{name}.body.h5", folder)
            baked = [row for row in nature_rows(programs, folder, "baked", "all")
                     if row[1] in ("paper", "coins") and ("thin-disc" in row[2] or "5-czk" in row[2])]
    written(NATURE_ROWS, rows + baked)


def nature_rows(programs, folder, label, half):
    judged = run([f"{programs}/samara-surface-choice", folder, "--half", half, "--json"])
    return [[label, source, fall["name"], fall["simulated"], fall["measured"], f"{fall['miss']:.2f}",
             "yes" if fall["holds"] else "no"] for source, falls in judged.items() for fall in falls]


def nature_tables(only_baked=False):
    """Paper and coins one by one, perhaps only those that are baked; discs and fruits by how many hold."""
    with open(NATURE_ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    baked = {row["name"]: row["simulated"] for row in rows if row["half"] == "baked"}
    single = [[row["name"], row["half"], row["measured"], row["simulated"], baked.get(row["name"], "-")] for row in rows
              if row["source"] in ("paper", "coins") and row["half"] != "baked" and (row["name"] in baked or not only_baked)]
    counts = []
    for source in ("discs", "fruits", "seeds", "full CFD"):
        for kind in sorted({kind_of(row) for row in rows if row["source"] == source}):
            some = {half: [row["holds"] == "yes" for row in rows
                           if (row["source"], row["half"], kind_of(row)) == (source, half, kind)]
                    for half in ("fit", "choose")}
            seen = [f"{sum(one)} of {len(one)}" for one in some.values()]
            if source in ("seeds", "full CFD"):  # the same falls in both halves
                seen[1] = "-"
            counts.append([f"{source}{', ' + kind if kind else ''}"] + seen)
    return [table(["body", "half", "measured", "without a bake", "baked"], single), table(["falls", "fit", "choose"], counts)]


def kind_of(row):
    """The regime of a disc, the attack of a fruit's wing."""
    if row["source"] == "discs":
        return row["measured"]
    return f"wings at {row['name'].split('-')[1]} degrees" if row["source"] == "fruits" else ""


def main(words):
    if len(words) > 3:
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 3:
        os.makedirs(words[2], exist_ok=True)
        nature_bodies(*words[1:])
        return 0
    if len(words) == 2:
        fly(words[1])
        fly_nature(words[1])
    with open(ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    write_tables(f"{NATURE}/README.md", nature_tables(), mark("surface"))
    tables = [table_of_falls([row for row in rows if row["set"] == kind]) for kind in ("chosen", "test", "long")]
    write_tables("docs/studies/surface-loads/README.md", tables, mark("surface"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
