#!/usr/bin/env python3
"""Other models of falling bodies and the runtime against the reference falls.

    peers_report.py BIN WORK FOLDER [SAMPLES]
    peers_report.py FOLDER    takes the other models' rows as they stand, and the runtime's from falls.csv

BIN: the folder of the programs; FOLDER: of peers.csv, peers.gp and peers.md, whose tables it writes. SAMPLES: how many sets of
coefficients are drawn in the search for each model's best, 2000 by default; what was found is kept in WORK and used again. The
runtime's rows by tables are those of docs/falls/falls.csv, which falls_report.py flies; by the loads of the surface it is flown
here. Run from the project's folder.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

from falls_report import BODIES, FALLS, SCENES, compared, differences_of, has_the_regime, rows_of_falls, run, worst_figure, worst_of
from falls_report import FIGURES as MEASURES
from report_tables import mark, table, write_tables
from surface_report import plain

FIGURES = dict(zip(("descent", "frequency", "amplitude", "angular_speed"), MEASURES))
DEFAULT, BEST, SHAPE, ALONE = "MuJoCo default", "MuJoCo best", "MuJoCo best for each shape", "MuJoCo best for each fall"
# The runtime, by the noise of its rows in falls.csv; and without a bake.
OURS = {"samara by tables with noise": "on", "samara by tables": "off"}
SURFACE = "samara by the surface"
PLATES = ("disc-light", "disc-heavy", "plate", "sheet")
# Models by their equations alone: their names, those of the program, the falls that they know, and whether their numbers
# are published ones.
EQUATIONS = (("the paper's eq. 5", "paper", tuple(SCENES), False),
             ("linear drag", "linear-drag", tuple(SCENES), False),
             ("plate equations", "falling-plate", PLATES, True))


def scenes_of(names):
    return ",".join(f"{FALLS}/{name}.toml" for name in names)


def searched(programs, folder, samples, model="mujoco", scenes=tuple(SCENES)):
    """What the search for the best coefficients found, kept in the folder."""
    kept = os.path.join(folder, f"{model}-search-{samples}.json")
    if not os.path.exists(kept):
        search = run([f"{programs}/samara-peer-falls", scenes_of(scenes), "--model", model, "--search", samples,
                      "--json"])
        with open(kept, "w", encoding="utf-8") as file:
            json.dump(search, file, indent=1)
    with open(kept, encoding="utf-8") as file:
        return json.load(file)


def agreement(fall, within, same_regime):
    """Whether a fall is within the limits and of the same regime, of which a sphere is not judged."""
    return "yes" if within and (same_regime or fall == "sphere") else "no"


def row_of(fall, who, comparison):
    """A row of peers.csv. Without a comparison the numbers ran away."""
    row = {"fall": fall, "model": who}
    if comparison is None:
        return row | {"regime": "breaks", "worst": 1.0, "agrees": "no"}
    row |= {name: (comparison["measures"].get(figure) or {}).get("relative_difference")
            for name, figure in FIGURES.items()}
    return row | {"regime": comparison["motion"]["regime"], "regime_cfd": comparison["reference"]["regime"],
                  "worst": worst_figure(comparison), "agrees": agreement(fall, comparison["agrees"], comparison["regimes_agree"])}


def peer(programs, scenes, who, coefficients, model="mujoco"):
    """A model's rows: its motions, judged as every motion is. Its own coefficients where none are given."""
    rows = []
    with tempfile.TemporaryDirectory() as work:
        words = [f"{programs}/samara-peer-falls", scenes_of(scenes), "--model", model, "-o", work, "--json"]
        if coefficients is not None:
            words += ["--coefficients", ",".join(map(str, coefficients))]
        for flown in run(words)["falls"]:
            comparison = None if flown["broke"] else run(
                [f"{programs}/samara", "compare", f"{work}/{flown['fall']}.h5", f"{FALLS}/{flown['fall']}.h5",
                 "--json"])
            rows.append(row_of(flown["fall"], who, comparison))
    return rows


def by_equations(programs, folder, samples):
    """The rows of the models by their equations, each with the best set for a shape, and as published."""
    rows = []
    for name, model, scenes, published in EQUATIONS:
        if published:
            rows += peer(programs, scenes, f"{name}, as published", None, model=model)
        for found in searched(programs, folder, samples, model, scenes)["best_by_shape"].values():
            rows += peer(programs, found["falls"], f"{name}, best for each shape", found["coefficients"], model=model)
    return rows


def reported(who, noise):
    """The runtime's rows as docs/falls/falls.csv has them."""
    return [{"fall": row["fall"], "model": who, "regime_cfd": row["regime_cfd"], "regime": row["regime_runtime"],
             **dict(zip(FIGURES, differences_of(row))), "worst": worst_of(row),
             "agrees": agreement(row["fall"], row["agrees"] == "yes", has_the_regime(row))} for row in rows_of_falls(noise)]


def kept_rows(folder):
    """The rows of the last run but for the runtime's by tables."""
    with open(os.path.join(folder, "peers.csv"), newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["model"] not in OURS]
    return [row | {name: float(row[name]) if row[name] else None for name in (*FIGURES, "worst")} for row in rows]


def by_surface(programs):
    """The runtime's rows by the loads of the surface."""
    with tempfile.TemporaryDirectory() as work:
        return [row_of(scene, SURFACE, compared(programs, plain(programs, BODIES[body][0], work), scene, work))
                for scene, body in SCENES.items()]


def percent(value):
    return "-" if value is None else f"{100 * value:+.0f} %"


def cell(row):
    if row is None:
        return "-"
    if row["regime"] == "breaks":
        return "breaks"
    if row["fall"] == "sphere":  # its inclination has no meaning
        return percent(row["descent"]) + (" **yes**" if row["agrees"] == "yes" else "")
    figures = " / ".join(percent(row[name]) for name in FIGURES)
    return f"{figures}, {row['regime']}" + (" **yes**" if row["agrees"] == "yes" else "")


def errors_table(rows, models):
    """A line a fall, a column a model."""
    found = {(row["fall"], row["model"]): row for row in rows}

    def title(scene):
        regime = next(row["regime_cfd"] for row in rows if row["fall"] == scene and row.get("regime_cfd"))
        return scene if scene == "sphere" else f"{scene} ({regime})"

    return table(["fall (full CFD)", *models],
                 ([title(scene)] + [cell(found.get((scene, model))) for model in models] for scene in SCENES))


def summary_table(rows):
    """A line a model: what it misses in the mean over the falls, undivided."""
    def mean_of(values):
        return f"{100 * sum(values) / len(values):.0f} %" if values else "-"

    def lines():
        for model in dict.fromkeys(row["model"] for row in rows):
            of = [row for row in rows if row["model"] == model]
            figures = [mean_of([abs(row[name]) for row in of
                                if row.get(name) is not None and (name == "descent" or row["fall"] != "sphere")])
                       for name in FIGURES]
            worst = [row["worst"] for row in of]
            regimes = sum(row["regime"] == row.get("regime_cfd") for row in of)
            yield [model, *figures, mean_of(worst), f"{100 * max(worst):.0f} %", f"{regimes} of {len(of)}",
                   f"{sum(row['agrees'] == 'yes' for row in of)} of {len(of)}"]

    return table(["model", "descent", "frequency", "amplitude", "rms angular speed", "worst figure: mean", "largest", "regimes right",
                  "within 10, 20, 30 %"], lines())


def coefficients_table(search, default):
    lines = ["| coefficients | blunt drag | slender drag | angular drag | Kutta lift | Magnus lift | misfit |", "|---" * 7 + "|"]
    sets = [("MuJoCo's defaults", default, search["default_misfit"]),
            ("best for all falls", search["best"]["coefficients"], search["best"]["misfit"])]
    sets += [(f"best for {', '.join(found['falls'])}", found["coefficients"], found["misfit"])
             for found in search["best_by_shape"].values() if len(found["falls"]) > 1]
    alone = search["best_alone"]
    sets += [(f"best for {scene} alone", alone[scene]["coefficients"], alone[scene]["misfit"]) for scene in SCENES]
    for name, numbers, misfit in sets:
        lines.append(f"| {name} | " + " | ".join(f"{number:.3g}" for number in numbers) + f" | {misfit:.2f} |")
    return "\n".join(lines) + "\n"


def write_report(folder, rows, coefficients):
    """peers.csv, the tables of peers.md (that of coefficients: None leaves it as it stands) and the picture."""
    rows = rows + [row for who, noise in OURS.items() for row in reported(who, noise)]
    equations = [row["model"] for row in rows if row["model"].startswith(tuple(name for name, *_ in EQUATIONS))]
    columns = ["fall", "model", "regime_cfd", "regime"] + list(FIGURES) + ["worst", "agrees"]
    with open(os.path.join(folder, "peers.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()})
    write_tables(os.path.join(folder, "peers.md"), [
        summary_table(rows), coefficients, errors_table(rows, (DEFAULT, BEST, SHAPE, ALONE)),
        errors_table(rows, tuple(dict.fromkeys(equations))), errors_table(rows, [SURFACE, *OURS])], mark("falls"))
    subprocess.run(["gnuplot", "-e", f"rows='{folder}/peers.csv'; picture='{folder}/peers.png'", f"{folder}/peers.gp"],
                   check=True)
    print(f"Written: peers.csv, peers.md and peers.png in {folder}")


def main(words):
    if len(words) not in (2, 4, 5):
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 2:
        write_report(words[1], kept_rows(words[1]), None)
        return 0
    programs, work, folder = words[1:4]
    default = (0.5, 0.25, 1.5, 1.0, 1.0)
    scenes = list(SCENES)
    samples = words[4] if len(words) == 5 else "2000"
    search = searched(programs, work, samples)
    best = search["best"]["coefficients"]
    rows = peer(programs, scenes, DEFAULT, default) + peer(programs, scenes, BEST, best)
    for found in search["best_by_shape"].values():
        rows += peer(programs, found["falls"], SHAPE, found["coefficients"])
    for scene in scenes:
        rows += peer(programs, [scene], ALONE, search["best_alone"][scene]["coefficients"])
    rows += by_equations(programs, work, samples) + by_surface(programs)
    write_report(folder, rows, coefficients_table(search, default))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
