#!/usr/bin/env python3
"""How a wake forms: bodies that are towed from rest, each in the plane of its longest and its shortest extent.

    tows_report.py BIN BODIES FOLDER   solves in FOLDER the tows that tows.csv has no row of, from the cases in BODIES
                                       (NAME.cases of a standard bake, see falls_report.py), and writes the rows and the table
    tows_report.py                     writes the table again from the rows

A tow is the bake's case, but in time (pimpleFoam, second order), from the undisturbed flow, on the mesh of the bake's falls.
Its moment goes from that of the potential flow to that of the steady tow; the way of the wake is that after which 1/e of the
difference is left. Run from the project's folder.
"""

import csv
import glob
import json
import math
import os
import shutil
import statistics
import subprocess
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from closures_report import run, set_parameters  # noqa: E402 finds the templates too
from case_files import history, read, word  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from stationarity import AREA_UNIT, mean  # noqa: E402

ROWS, PAGE = "docs/studies/falls/tows.csv", "docs/studies/falls/README.md"
COLUMNS = ("body", "angle", "extent", "reynolds_number", "cpu_seconds", "moment_at_start", "moment_at_end", "way")
# The axes of the shape along the longest and the shortest extent.
BODIES = {"thick-disc": "xz", "box": "zx", "disc-heavy": "xz", "plate": "xz", "spheroid": "xz", "ellipsoid": "zx"}
ANGLES = (15, 45, 75)  # degrees between the way and the longest extent
DURATION = 20.0        # L/U
# When the moment is the potential flow's still, and when the steady tow's (L/U).
START, END = (0.1, 0.2), (15.0, DURATION)
LEAST_CHANGE = 0.1     # of the moment, for a way to be told
OF_THE_MESH = ("backgroundCells", "surfaceLevel", "layers", "layerThickness", "layerRatio", "refinementShells")


def make_tow(cases, case, direction):
    """Makes the case from the first of a bake's and from the mesh of its falls."""
    source, mesh = os.path.join(cases, "direction_00_coarse"), os.path.abspath(os.path.join(cases, "mesh_falls"))
    shutil.rmtree(case, ignore_errors=True)
    for part in ("0.orig", "system"):
        shutil.copytree(os.path.join(source, part), os.path.join(case, part), symlinks=True)
    for part in ("Allrun", "Allclean", "parameters", "case_files.py", "iterate.py", "stationarity.py"):
        shutil.copy(os.path.join(source, part), case)
    os.makedirs(os.path.join(case, "constant"))
    for part in ("transportProperties", "turbulenceProperties"):
        shutil.copy(os.path.join(source, "constant", part), os.path.join(case, "constant"))
    for part in ("polyMesh", "triSurface"):
        os.symlink(os.path.join(mesh, "constant", part), os.path.join(case, "constant", part))
    meshed = read(os.path.join(mesh, "parameters"))
    steps = math.ceil(DURATION / float(word(read(os.path.join(cases, "fall_00/parameters")), "timeStep")))

    def vector(sign):
        return "(" + " ".join(f"{sign * x:.10g}" for x in direction) + ")"

    set_parameters(case, {
        **{name: word(meshed, name) for name in OF_THE_MESH},
        "direction": vector(1), "flowVelocity": vector(-1), "startFrom": "none", "solver": "pimpleFoam",
        "rateOfChange": "backward", "timeStep": f"{DURATION / steps:.12g}", "momentumRelaxation": 1, "turbulenceRelaxation": 1,
        "roundIterations": steps, "leastIterations": steps, "mostIterations": steps})


def solve(programs, bodies, work, body, angle):
    """The row of a tow."""
    cases = os.path.join(bodies, f"{body}.cases")
    length = json.loads(read(os.path.join(cases, "fall_00/fall.json")))["length"]
    extents = json.loads(subprocess.run([f"{programs}/samara", "info", os.path.join(bodies, f"{body}.body.h5"), "--json"],
                                        check=True, stdout=subprocess.PIPE).stdout)["principal_extents"]
    along = {axis: 0.0 for axis in "xyz"}
    long, short = BODIES[body]
    along[long], along[short] = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    case = os.path.join(work, f"{body}-{angle}")
    make_tow(cases, case, list(along.values()))
    _, seconds = run(["./Allrun"], case)
    # The moment about the axis across both extents.
    across = next(i for i, axis in enumerate("xyz") if axis not in BODIES[body])
    moments = [(row[0], row[1 + across] / AREA_UNIT) for row in history(case, "forces", "moment.dat")]
    if not moments or moments[-1][0] < 0.999 * DURATION:
        sys.exit(f"{case}: was not solved to its end; see the logs there")

    def mean_of(times):
        return mean([value for time, value in moments if times[0] <= time <= times[1]])

    start, end = mean_of(START), mean_of(END)
    way = next(time for time, value in moments if time > START[1] and (value - end) / (start - end) < math.exp(-1.0))
    return dict(zip(COLUMNS, (
        body, angle, f"{math.hypot(extents[2] * along[long], extents[0] * along[short]) / length:.4g}",
        word(read(os.path.join(case, "parameters")), "reynoldsNumber"), f"{seconds:.0f}", f"{start:.4g}", f"{end:.4g}",
        f"{way:.3g}")))


def rows():
    if not os.path.exists(ROWS):
        return []
    with open(ROWS, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def way_of(row):
    """The way over the extent along it; none of a tow whose moment hardly changes."""
    if abs(float(row["moment_at_end"]) / float(row["moment_at_start"]) - 1.0) < LEAST_CHANGE:
        return None
    return float(row["way"]) / float(row["extent"])


def table_of_tows():
    head = ["body", "degrees from its longest extent", "extent along the way", "moment at the start", "in the end",
            "way of the wake", "over the extent"]
    lines = [[row["body"], row["angle"], f"{float(row['extent']):.2f} L", f"{float(row['moment_at_start']):.3f}",
              f"{float(row['moment_at_end']):.3f}"]
             + (["-", "-"] if way_of(row) is None else [f"{float(row['way']):.2g} L", f"{way_of(row):.1f}"]) for row in rows()]
    median = statistics.median(way for way in map(way_of, rows()) if way is not None)
    return table(head, lines + [["median"] + [""] * 5 + [f"{median:.1f}"]])


def main(words):
    if len(words) not in (1, 4):
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 4:
        solved = {(row["body"], row["angle"]) for row in rows()}
        for body in BODIES:
            for angle in ANGLES:
                if (body, str(angle)) in solved:
                    continue
                row = solve(*words[1:], body, angle)
                with open(ROWS, "a", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
                    if file.tell() == 0:
                        writer.writeheader()
                    writer.writerow(row)
                print(row, flush=True)
    write_tables(PAGE, [table_of_tows()], mark("tows"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
