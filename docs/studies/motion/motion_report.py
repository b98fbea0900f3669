#!/usr/bin/python3
"""Error of the motion against time, from inertia alone to full CFD, on the reference falls and on those three times as long.

    motion_report.py BIN BODIES FOLDER    flies the falls whose bodies are in BODIES, writes FOLDER/motion.{csv,png}, motion-long.csv
                                          and the tables of README.md

BODIES: as falls_report.py leaves it, NAME.body.h5 at quality standard, and NAME-preview.body.h5, which is baked here
if it is missing. Bodies that are not there are left out. Run from the project's folder.
"""

import csv
import glob
import os
import re
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import BODIES as SHAPES  # noqa: E402
from falls_report import FALLS, SCENES, baked_file, run, scene_with, worst_figure  # noqa: E402
from long_falls_report import FOLDER as LONG  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from study_pictures import picture_of  # noqa: E402

# The models, cheapest first: the keys that the body of a scene is given, the body file that it needs, how many steps of
# the scene are made one, and how many runs are flown: more than one with noise, as a scene is by default.
MODELS = (
    ("inertia alone", {"loads": "none"}, "standard", 1, 1),
    ("drag coefficient 1", {"loads": "coefficients"}, "standard", 1, 1),
    ("preview tables", {}, "preview", 1, 1),
    ("standard tables with default coefficients", {"dynamic_coefficients": "default"}, "standard", 1, 1),
    ("standard tables with identified coefficients", {}, "standard", 1, 1),
    ("the same with five times the step", {}, "standard", 5, 1),
    ("the same with noise (20 runs)", {"turbulence": "table"}, "standard", 1, 20),
)
CFD = "full CFD"


def preview_of(programs, folder, body):
    file = os.path.join(folder, f"{body}-preview.body.h5")
    if not os.path.exists(file):
        shape, options = SHAPES[body]
        run([f"{programs}/samara", "bake", shape, "-o", file, "--quality", "preview", "--json"] + options)
    return file


def flown(programs, scene, keys, file, steps, runs, folder, falls):
    """The comparison of a scene with other keys with its reference, and the seconds for a simulated second."""
    changed = scene_with(scene, {"shape": os.path.abspath(file)} | keys, folder, steps, falls)
    motion = os.path.join(folder, "motion.h5")
    words = [f"{programs}/samara", "simulate", changed, "-o", motion, "--threads", "1", "--runs", str(runs), "--json"]
    seconds = min(run(words)["seconds"] for _ in range(5))
    with open(changed) as opened:
        duration = float(re.search(r"duration = ([0-9.]+)", opened.read()).group(1))
    return run([f"{programs}/samara", "compare", motion, f"{falls}/{scene}.h5", "--json"]), seconds / duration / runs


def cpu_seconds(falls):
    """CPU seconds that a simulated second of each fall of a folder took by full CFD."""
    costs = {}
    with open(f"{falls}/references.csv", newline="") as file:
        for row in csv.DictReader(file):
            with open(f"{falls}/{row['fall']}.toml") as scene:
                duration = float(re.search(r"duration = ([0-9.]+)", scene.read()).group(1))
            costs[row["fall"]] = float(row["cpu_seconds"]) / duration
    return costs


def fly(programs, bodies, falls, target):
    """Flies every fall of a folder by every model, and writes the rows."""
    rows = []
    costs = cpu_seconds(falls)
    with tempfile.TemporaryDirectory() as work:
        for scene, body in SCENES.items():
            if not os.path.exists(baked_file(bodies, body)):
                print(f"{scene}: no {baked_file(bodies, body)}, left out")
                continue
            for model, keys, quality, steps, runs in MODELS:
                file = baked_file(bodies, body) if quality == "standard" else preview_of(programs, bodies, body)
                comparison, seconds = flown(programs, scene, keys, file, steps, runs, work, falls)
                agrees = comparison["motion"]["regime"] == comparison["reference"]["regime"]
                rows.append([scene, model, seconds, worst_figure(comparison), comparison["motion"]["regime"],
                             "yes" if agrees else "no"])
                print(*rows[-1])
            rows.append([scene, CFD, costs[scene], 0.0, comparison["reference"]["regime"], "yes"])
    with open(target, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["fall", "model", "seconds_per_simulated_second", "error", "regime", "regime_agrees"])
        writer.writerows([[f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row] for row in rows])


def table_of(rows_file):
    """A table of README.md."""
    with open(rows_file, newline="") as file:
        rows = list(csv.DictReader(file))
    falls = list(dict.fromkeys(row["fall"] for row in rows))
    lines = ["| model | s for a simulated second | faster than full CFD | " + " | ".join(falls) + " | mean | regimes right |",
             "|---" * (len(falls) + 5) + "|"]
    of_cfd = [float(row["seconds_per_simulated_second"]) for row in rows if row["model"] == CFD]
    for model in dict.fromkeys(row["model"] for row in rows):
        of_model = [row for row in rows if row["model"] == model]
        seconds = [float(row["seconds_per_simulated_second"]) for row in of_model]
        errors = [float(row["error"]) for row in of_model]
        mean = sum(seconds) / len(seconds)
        lines.append(f"| {model} | {mean:.2g} | {sum(of_cfd) / len(of_cfd) / mean:,.0f} | " +
                     " | ".join(f"{100 * error:.0f} %" for error in errors) +
                     f" | {100 * sum(errors) / len(errors):.0f} % | "
                     f"{sum(row['regime_agrees'] == 'yes' for row in of_model)} of {len(of_model)} |")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.strip())
    programs, bodies, folder = sys.argv[1:]
    tables = []
    for falls, name in ((FALLS, "motion.csv"), (LONG, "motion-long.csv")):
        fly(programs, bodies, falls, f"{folder}/{name}")
        tables.append(table_of(f"{folder}/{name}"))
    write_tables(f"{folder}/README.md", tables, mark("falls"))
    picture = f"{folder}/motion"
    picture_of("motion", f"{picture}.csv", f"{picture}.png")
    print(f"Written: motion.csv, motion-long.csv, README.md and motion.png in {folder}")


if __name__ == "__main__":
    main()
