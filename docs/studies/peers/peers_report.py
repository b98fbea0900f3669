#!/usr/bin/python3
"""Other models of falling bodies and the runtime against the reference falls, those three times as long, and the test falls.

    peers_report.py BIN FOLDER    flies the other models, and the runtime by the loads of the surface
    peers_report.py FOLDER        takes those rows as they stand

FOLDER: of peers.csv, peers-long.csv, peers-test.csv, peers.gp and README.md, whose tables it writes. The best coefficients of
each model are searched on the falls of the usual length, and MuJoCo's on test falls of before too, some minutes to an hour each;
what was found is kept in FOLDER, peers-MODEL.json, and used again. The runtime's rows by tables are those of falls_report.py,
long_falls_report.py and test_falls_report.py. Run from the project's folder.
"""

import csv
import glob
import json
import os
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import FALLS, SCENES, compared, differences_of, has_the_regime, rows_of_falls, run, worst_figure, worst_of  # noqa: E402
from falls_report import FIGURES as MEASURES  # noqa: E402
from long_falls_report import FOLDER as LONG  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from surface_report import plain, shape_of  # noqa: E402
from test_falls_report import FOLDER as TEST  # noqa: E402
from test_falls_report import SCENES as TEST_SCENES  # noqa: E402
from test_falls_report import SEEN  # noqa: E402
from study_pictures import picture_of  # noqa: E402

FIGURES = dict(zip(("descent", "frequency", "amplitude", "angular_speed"), MEASURES))
DEFAULT, BEST, SHAPE, ALONE = "MuJoCo default", "MuJoCo best", "MuJoCo best for each shape", "MuJoCo best for each fall"
OTHERS = "MuJoCo best for each shape on other falls"
# The rows of each set of falls, the folder that holds these, and their bodies.
SETS = {"peers.csv": (FALLS, SCENES), "peers-long.csv": (LONG, SCENES), "peers-test.csv": (TEST, TEST_SCENES)}
DEFAULT_COEFFICIENTS = (0.5, 0.25, 1.5, 1.0, 1.0)
# How many sets a search draws; that on other falls, of which there are four times as many, fewer.
SAMPLES, SAMPLES_OF_OTHERS = "2000", "500"
# The runtime, by the noise of its rows in falls.csv; and without a bake.
OURS = {"samara by tables with noise": "on", "samara by tables": "off"}
SURFACE = "samara by the surface"
PLATES = ("disc-light", "disc-heavy", "plate", "sheet")
# Models by their equations alone: their names, those of the program, the falls that they know, and whether their numbers
# are published ones.
EQUATIONS = (("the paper's eq. 5", "paper", tuple(SCENES), False),
             ("linear drag", "linear-drag", tuple(SCENES), False),
             ("plate equations", "falling-plate", PLATES, True))


def scenes_of(names, falls=FALLS):
    return ",".join(f"{falls}/{name}.toml" for name in names)


def searched(programs, folder, model="mujoco", scenes=tuple(SCENES), of_others=False):
    """What the search for the best coefficients found on the references, or on other falls; kept in the folder."""
    kept = os.path.join(folder, f"peers-{model}{'-other-falls' if of_others else ''}.json")
    if not os.path.exists(kept):
        files, samples = (scenes_of(SEEN, TEST), SAMPLES_OF_OTHERS) if of_others else (scenes_of(scenes), SAMPLES)
        search = run([f"{programs}/samara-peer-falls", files, "--model", model, "--search", samples, "--json"])
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
                  "worst": worst_figure(comparison), "agrees": agreement(fall, comparison["agrees_by_metrics"], comparison["regimes_agree"])}


def peer(programs, scenes, who, coefficients, model="mujoco", falls=FALLS):
    """A model's rows: its motions, judged as every motion is. Its own coefficients where none are given."""
    rows = []
    with tempfile.TemporaryDirectory() as work:
        words = [f"{programs}/samara-peer-falls", scenes_of(scenes, falls), "--model", model, "-o", work, "--json"]
        if coefficients is not None:
            words += ["--coefficients", ",".join(map(str, coefficients))]
        for flown in run(words)["falls"]:
            comparison = None if flown["broke"] else run(
                [f"{programs}/samara", "compare", f"{work}/{flown['fall']}.h5", f"{falls}/{flown['fall']}.h5",
                 "--json"])
            rows.append(row_of(flown["fall"], who, comparison))
    return rows


def by_mujoco(programs, folder, falls, scenes):
    """MuJoCo's rows, with its defaults and with the best sets for all falls, for a shape and for a fall; the last two where
    the falls are of the references' bodies."""
    search = searched(programs, folder)
    rows = peer(programs, scenes, DEFAULT, DEFAULT_COEFFICIENTS, falls=falls)
    rows += peer(programs, scenes, BEST, search["best"]["coefficients"], falls=falls)
    if scenes is not SCENES:
        return rows
    for found in search["best_by_shape"].values():
        rows += peer(programs, found["falls"], SHAPE, found["coefficients"], falls=falls)
    for scene in SCENES:
        rows += peer(programs, [scene], ALONE, search["best_alone"][scene]["coefficients"], falls=falls)
    return rows


def by_other_falls(programs, folder, falls, scenes):
    """MuJoCo's rows with the best set for each shape on test falls of before."""
    found = searched(programs, folder, of_others=True)["best_by_shape"]
    of_shape = {}
    for scene, body in scenes.items():
        of_shape.setdefault(stem_of(body), []).append(scene)
    return [row for shape, names in of_shape.items()
            for row in peer(programs, names, OTHERS, found[shape]["coefficients"], falls=falls)]


def stem_of(body):
    """The name of a body's shape."""
    return os.path.basename(shape_of(body)).removesuffix(".geo")


def by_equations(programs, folder, falls):
    """The rows of the models by their equations, each with the best set for a shape, and as published."""
    rows = []
    for name, model, scenes, published in EQUATIONS:
        if published:
            rows += peer(programs, scenes, f"{name}, as published", None, model, falls)
        for found in searched(programs, folder, model, scenes)["best_by_shape"].values():
            rows += peer(programs, found["falls"], f"{name}, best for each shape", found["coefficients"], model, falls)
    return rows


def reported(who, noise, falls, scenes):
    """The runtime's rows as falls.csv of the folder `falls` has them."""
    return [{"fall": row["fall"], "model": who, "regime_cfd": row["regime_cfd"], "regime": row["regime_runtime"],
             **dict(zip(FIGURES, differences_of(row))), "worst": worst_of(row),
             "agrees": agreement(row["fall"], row["agrees"] == "yes", has_the_regime(row))}
            for row in rows_of_falls(noise, f"{falls}/falls.csv") if row["fall"] in scenes]


def kept_rows(folder, name):
    """The rows of the last run but for the runtime's by tables."""
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["model"] not in OURS]
    return [row | {name: float(row[name]) if row[name] else None for name in (*FIGURES, "worst")} for row in rows]


def by_surface(programs, falls, scenes):
    """The runtime's rows by the loads of the surface."""
    with tempfile.TemporaryDirectory() as work:
        return [row_of(scene, SURFACE, compared(programs, plain(programs, shape_of(body), work), scene, work, falls=falls))
                for scene, body in scenes.items()]


def fly(programs, folder, falls, scenes):
    """The rows of all that is flown here on a set of falls; the equations' sets know the references' bodies alone."""
    equations = by_equations(programs, folder, falls) if scenes is SCENES else []
    return (by_mujoco(programs, folder, falls, scenes) + by_other_falls(programs, folder, falls, scenes) + equations
            + by_surface(programs, falls, scenes))


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


def errors_table(rows, models, scenes=tuple(SCENES)):
    """A line a fall, a column a model."""
    found = {(row["fall"], row["model"]): row for row in rows}

    def title(scene):
        regime = next(row["regime_cfd"] for row in rows if row["fall"] == scene and row.get("regime_cfd"))
        return scene if scene == "sphere" else f"{scene} ({regime})"

    return table(["fall (full CFD)", *models],
                 ([title(scene)] + [cell(found.get((scene, model))) for model in models] for scene in scenes))


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

    return table(["model", "descent", "frequency", "amplitude", "rms angular speed", "worst metric: mean", "largest", "regimes right",
                  "within 10, 20, 30 %"], lines())


def coefficients_table(search, of_others):
    lines = ["| coefficients | blunt drag | slender drag | angular drag | Kutta lift | Magnus lift | misfit |", "|---" * 7 + "|"]
    sets = [("MuJoCo's defaults", DEFAULT_COEFFICIENTS, search["default_misfit"]),
            ("best for all falls", search["best"]["coefficients"], search["best"]["misfit"])]
    sets += [(f"best for {', '.join(found['falls'])}", found["coefficients"], found["misfit"])
             for found in search["best_by_shape"].values() if len(found["falls"]) > 1]
    sets += [(f"best for {shape} on {len(found['falls'])} other falls", found["coefficients"], found["misfit"])
             for shape, found in of_others["best_by_shape"].items()]
    alone = search["best_alone"]
    sets += [(f"best for {scene} alone", alone[scene]["coefficients"], alone[scene]["misfit"]) for scene in SCENES]
    for name, numbers, misfit in sets:
        lines.append(f"| {name} | " + " | ".join(f"{number:.3g}" for number in numbers) + f" | {misfit:.2f} |")
    return "\n".join(lines) + "\n"


def write_rows(target, rows):
    columns = ["fall", "model", "regime_cfd", "regime"] + list(FIGURES) + ["worst", "agrees"]
    with open(target, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()})


def write_report(folder, rows_of):
    """The rows of each set, the tables of README.md and the picture."""
    for name, rows in rows_of.items():
        write_rows(os.path.join(folder, name), rows)
    rows, long_rows, test_rows = rows_of.values()
    equations = [row["model"] for row in rows if row["model"].startswith(tuple(name for name, *_ in EQUATIONS))]
    write_tables(os.path.join(folder, "README.md"), [
        summary_table(rows), summary_table(long_rows), summary_table(test_rows),
        coefficients_table(searched(None, folder), searched(None, folder, of_others=True)),
        errors_table(rows, (DEFAULT, BEST, SHAPE, OTHERS, ALONE)), errors_table(rows, tuple(dict.fromkeys(equations))),
        errors_table(rows, [SURFACE, *OURS]), errors_table(long_rows, [SHAPE, OTHERS, SURFACE, *OURS]),
        errors_table(test_rows, [OTHERS, SURFACE, *OURS], TEST_SCENES)], mark("falls"))
    picture_of("peers", f"{folder}/peers.csv", f"{folder}/peers.png")
    print(f"Written: {', '.join(rows_of)}, README.md and peers.png in {folder}")


def main(words):
    if len(words) not in (2, 3):
        sys.stderr.write(__doc__)
        return 2
    folder, rows_of = words[-1], {}
    for name, (falls, scenes) in SETS.items():
        rows_of[name] = fly(words[1], folder, falls, scenes) if len(words) == 3 else kept_rows(folder, name)
        rows_of[name] += [row for who, noise in OURS.items() for row in reported(who, noise, falls, scenes)]
    write_report(folder, rows_of)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
