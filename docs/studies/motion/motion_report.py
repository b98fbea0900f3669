#!/usr/bin/python3
"""Error of the motion against time, from inertia alone to full CFD, on the nine held-out falls.

    motion_report.py BIN BODIES WORK [solve]    simulates the falls by every model, and writes motion.csv, motion.png and the table of
                                                README.md; with `solve` it solves what is missing in WORK by full CFD first: three CPU hours;
                                                without, the rows of full CFD stay
    motion_report.py                            writes the table again from the rows of the last run

BODIES: as falls_report.py leaves it, NAME.body.h5 at quality standard, and NAME-preview.body.h5, which is baked here if it is missing.
The references are docs/studies/motion/fine, the falls of docs/studies/test-falls on 60,000 cells; where that is not solved those on 20,000.
The rows of MuJoCo's model are made where BIN has samara-peer-falls (./dev bench builds it). Run from the project's folder.
"""

import csv
import glob
import os
import re
import shutil
import statistics
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import BODIES as SHAPES  # noqa: E402
from falls_report import FIGURES, run, scene_with, worst_figure, written  # noqa: E402
from peers_report import DEFAULT, DEFAULT_COEFFICIENTS, OTHERS, searched, stem_of  # noqa: E402
from references_report import CLOSURE, solved  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from study_pictures import picture_of  # noqa: E402
from surface_report import plain, shape_of  # noqa: E402
from test_falls_report import FOLDER as FALLS  # noqa: E402
from test_falls_report import SCENES, file_of, rows_of_references  # noqa: E402

FOLDER = "docs/studies/motion"
FINE, REFERENCE_CELLS, OTHER_CELLS = f"{FOLDER}/fine", 60000, 20000
FILM, FLOWS_A_SECOND = "disc-1300", 20  # the fall of wake_film.py, which needs the flow
# The models, cheapest first: the keys that the body of a scene is given, the body file that it needs, how many steps of the scene are
# made one, and how many runs are simulated: more than one with noise.
MODELS = (
    ("inertia alone", {"loads": "none"}, "surface", 1, 1),
    ("drag coefficient 1", {"loads": "coefficients"}, "surface", 1, 1),
    ("the paper as printed (20 runs)", {"loads": "coefficients", "turbulence": "table", "langevin": "body-velocity"}, "standard", 1, 20),
    ("no bake", {"loads": "surface"}, "surface", 1, 1),
    ("no bake, with noise (20 runs)", {"loads": "surface", "turbulence": "table"}, "surface", 1, 20),
    ("preview bake", {}, "preview", 1, 1),
    ("standard bake", {}, "standard", 1, 1),
    ("standard bake, five times the step", {}, "standard", 5, 1),
    ("standard bake with noise (20 runs)", {"turbulence": "table"}, "standard", 1, 20),
)
HEADS = ["fall", "model", "seconds_per_simulated_second", "worst_error", "regime", "regime_reference", "agrees",
         *(f"{figure}{what}" for figure in FIGURES for what in ("_difference", "_uncertainty"))]


def cfd(cells):
    return f"full CFD, {cells:,} cells"


def preview_of(programs, folder, body):
    name = body.removeprefix("samara:")
    file = os.path.join(folder, f"{name}-preview.body.h5")
    if not os.path.exists(file):
        shape, options = SHAPES.get(body, (shape_of(body), ["--density", "1300"]))
        run([f"{programs}/samara", "bake", shape, "-o", file, "--quality", "preview", "--json", *options])
    return file


def duration_of(scene):
    with open(f"{FALLS}/{scene}.toml", encoding="utf-8") as file:
        return float(re.search(r"duration = ([0-9.]+)", file.read()).group(1))


def reference_of(scene):
    """The fall on the finest mesh that it is solved on."""
    return f"{FINE}/{scene}.h5" if os.path.exists(f"{FINE}/{scene}.h5") else f"{FALLS}/{scene}.h5"


def row_of(programs, scene, model, seconds, motion):
    """The row of a motion beside its reference."""
    comparison = run([f"{programs}/samara", "compare", motion, reference_of(scene), "--json"])
    regimes = comparison["motion"]["regime"], comparison["reference"]["regime"]
    is_right = regimes[0] == regimes[1]
    row = [scene, model, seconds, max(worst_figure(comparison), 0.0 if is_right else 1.0), *regimes,
           "yes" if comparison["agrees_by_metrics"] and is_right else "no"]
    for figure in FIGURES:
        measure = comparison["measures"].get(figure) or {}
        magnitude = abs((measure.get("reference") or {}).get("value") or 0.0)
        row += [measure.get("relative_difference"), measure["reference_uncertainty"] / magnitude
                if magnitude and measure.get("reference_uncertainty") else None]
    return row


def flow_of(scene, cells):
    """The words with which a fall is solved that the film shows."""
    return ["--fields", str(FLOWS_A_SECOND)] if (scene, cells) == (FILM, REFERENCE_CELLS) else []


def rows_of_cfd():
    """The rows of full CFD of the last run."""
    with open(f"{FOLDER}/motion.csv", newline="", encoding="utf-8") as file:
        return [row for row in csv.reader(file) if row[1].startswith("full CFD")]


def by_cfd(programs, work):
    """The rows of the falls on each mesh; references on the finest mesh, with what they differ by from the next coarser one, go to
    FINE."""
    rows = []
    os.makedirs(FINE, exist_ok=True)
    for scene in SCENES:
        motions = {cells: solved(programs, work, scene, cells, CLOSURE, flow_of(scene, cells), FALLS)
                   for cells in (6000, REFERENCE_CELLS)}
        if not os.path.exists(f"{FINE}/{scene}.h5"):
            run([f"{programs}/samara", "validate", motions[REFERENCE_CELLS][0], "-o", f"{work}/{scene}-fine.h5", "--other-mesh",
                 f"{FALLS}/{scene}.h5", "--json"])
            shutil.copyfile(f"{work}/{scene}-fine.h5", f"{FINE}/{scene}.h5")
        costs = {cells: result["cpu_seconds"] / duration_of(scene) for cells, (_, result) in motions.items()}
        costs[OTHER_CELLS] = next(float(row["cpu_seconds"]) for row in rows_of_references() if row["fall"] == scene) / duration_of(scene)
        own = REFERENCE_CELLS if os.path.exists(f"{FINE}/{scene}.h5") else OTHER_CELLS
        for cells in sorted(costs):
            if cells == own:  # the reference itself, which has no error
                rows.append([scene, cfd(cells), costs[cells]] + [None] * (len(HEADS) - 3))
            else:
                rows.append(row_of(programs, scene, cfd(cells), costs[cells],
                                   f"{FALLS}/{scene}.h5" if cells == OTHER_CELLS else motions[cells][0]))
    return rows


def by_runtime(programs, bodies):
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for scene, body in SCENES.items():
            files = {"surface": plain(programs, shape_of(body), work), "preview": preview_of(programs, bodies, body),
                     "standard": file_of(programs, bodies, body)}
            for model, keys, file, steps, runs in MODELS:
                changed = scene_with(scene, {"shape": os.path.abspath(files[file])} | keys, work, steps, FALLS)
                words = [f"{programs}/samara", "simulate", changed, "-o", f"{work}/motion.h5", "--threads", "1", "--runs", str(runs),
                         "--json"]
                seconds = min(run(words)["seconds"] for _ in range(5)) / duration_of(scene) / runs
                rows.append(row_of(programs, scene, model, seconds, f"{work}/motion.h5"))
                print(*rows[-1])
    return rows


def by_mujoco(programs):
    """MuJoCo's model with its default coefficients, and with those fitted for each shape on falls seen before."""
    if not os.path.exists(f"{programs}/samara-peer-falls"):
        return []
    rows, found = [], searched(programs, "docs/studies/peers", of_others=True)["best_by_shape"]
    with tempfile.TemporaryDirectory() as work:
        for scene, body in SCENES.items():
            for model, coefficients in ((DEFAULT, DEFAULT_COEFFICIENTS), (OTHERS, found[stem_of(body)]["coefficients"])):
                flown = run([f"{programs}/samara-peer-falls", f"{FALLS}/{scene}.toml", "--model", "mujoco", "-o", work, "--json",
                             "--coefficients", ",".join(map(str, coefficients))])["falls"][0]
                seconds = flown["seconds_per_simulated_second"]
                if flown["broke"]:
                    rows.append([scene, model, seconds, 1.0, "breaks", "", "no"] + [None] * 2 * len(FIGURES))
                else:
                    rows.append(row_of(programs, scene, model, seconds, f"{work}/{scene}.h5"))
    return rows


def summary(rows):
    """A line for each model: medians with their quartiles, and how many falls are right."""
    lines = []
    for model in dict.fromkeys(row["model"] for row in rows):
        of_model = [row for row in rows if row["model"] == model]
        seconds = statistics.median(float(row["seconds_per_simulated_second"]) for row in of_model)
        judged = [row for row in of_model if row["worst_error"]]
        descent = [abs(float(row["descent_speed_difference"])) for row in judged if row["descent_speed_difference"]]
        if judged:
            worst = [float(row["worst_error"]) for row in judged]
            low, middle, high = statistics.quantiles(worst if len(worst) > 1 else 2 * worst, n=4, method="inclusive")
        lines.append([model, f"{seconds:.2g}" if seconds < 100 else f"{seconds:.0f}"] + ([
            f"{100 * middle:.0f} %", f"{100 * low:.0f} to {100 * high:.0f} %", f"{100 * statistics.mean(descent):.0f} %",
            f"{sum(row['regime'] == row['regime_reference'] for row in judged)} of {len(judged)}",
            f"{sum(row['agrees'] == 'yes' for row in judged)} of {len(judged)}"] if judged else ["the reference"] + ["-"] * 4))
    return table(["model", "s for a simulated second", "worst metric: median", "quartiles", "descent: mean", "regimes right",
                  "within 10, 20, 30 %"], lines)


def main(words):
    if len(words) not in (1, 4) and words[4:] != ["solve"]:
        sys.stderr.write(__doc__)
        return 2
    if len(words) > 1:
        programs, bodies, work = words[1:4]
        os.makedirs(work, exist_ok=True)
        rows = by_cfd(programs, work) if "solve" in words else rows_of_cfd()
        written(f"{FOLDER}/motion.csv", [HEADS] + by_runtime(programs, bodies) + by_mujoco(programs) + rows)
    with open(f"{FOLDER}/motion.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    write_tables(f"{FOLDER}/README.md", [summary(rows)], mark("motion"))
    if len(words) > 1:
        picture_of("motion", f"{FOLDER}/motion.csv", f"{FOLDER}/motion.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
