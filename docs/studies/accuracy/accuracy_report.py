#!/usr/bin/env python3
"""The figures of accuracy that pages show: accuracy.csv, and the tables of docs/explanation/accuracy.md and of README.md.

    accuracy_report.py    takes the rows that the studies' last runs left, writes accuracy.csv of them, and the tables of that

Nothing is simulated here. Run from the project's folder.
"""

import csv
import glob
import os
import statistics
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import FIGURES, agrees, differences_of, has_the_regime, rows_of_falls, worst_of, written  # noqa: E402
from motion_report import cfd  # noqa: E402
from nature_study import CASES  # noqa: E402
from nature_tables import MODELS as NATURE_MODELS  # noqa: E402
from nature_tables import as_number, misses, ratio_of  # noqa: E402
from peers_report import DEFAULT, OTHERS, SURFACE  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from surface_report import nature_tables  # noqa: E402
from test_falls_report import SCENES as TEST_SCENES  # noqa: E402

STUDIES = "docs/studies"
FOLDER, PAGE = f"{STUDIES}/accuracy", "docs/explanation/accuracy.md"
# The models, as all tables name them.
NO_BAKE, STANDARD, NOISE, MUJOCO, FITTED, CFD = ("no bake", "standard bake", "standard bake, noise", "MuJoCo, defaults",
                                                 "MuJoCo, fitted to other falls", "full CFD, 20,000 cells")
COARSE_CFD = "full CFD, 6,000 cells"
HELD_OUT, HARD, LONG, CHOSEN = "held-out falls", "hard starts", "long falls", "falls that the form was chosen on"
SEEN = "other test falls, seen"
READY, READY_BODY, READY_NOISE = "ready-baked bodies, one fall each", "ready-baked", "ready-baked, noise"
OF_MOTION = {"no bake": NO_BAKE, "preview bake": "preview bake", "standard bake": STANDARD, "standard bake with noise (20 runs)": NOISE,
             DEFAULT: MUJOCO, OTHERS: FITTED, cfd(6000): COARSE_CFD, cfd(20000): CFD}
OF_NOISE = {"off": STANDARD, "on": NOISE}
OF_PEERS = {SURFACE: NO_BAKE, DEFAULT: MUJOCO, OTHERS: FITTED}
# From on end, on edge or on a corner: held out until they were first simulated.
HARD_STARTS = ("box-5000", "thick-disc-6000", "plate-edge", "sheet-700", "ellipsoid-2000", "spheroid-1500", "disc-10400", "cube-1150",
               "cube-3200")
HEADS = ["falls", "model", "count", "regimes_right", "within_10_20_30", "mean_descent_error", "mean_worst_error"]


def rows_from(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def summed(what, model, falls):
    """A row of accuracy.csv from (regime right, within the limits, descent error, worst error) of each fall."""
    regimes, within, descents, worst = zip(*falls)
    return dict(zip(HEADS, (what, model, len(falls), sum(regimes), sum(within), statistics.mean(abs(value) for value in descents),
                            statistics.mean(worst))))


def of_runtime(row):
    return has_the_regime(row), agrees(row), differences_of(row)[0], worst_of(row)


def of_motion(row):
    return (row["regime"] == row["regime_reference"], row["agrees"] == "yes", as_number(row["descent_speed_difference"]) or 1.0,
            float(row["worst_error"]))


def of_peer(row):
    right = row["regime"] == row["regime_cfd"]
    return right, right and row["agrees"] == "yes", as_number(row["descent"]) or 1.0, float(row["worst"])


def summaries():
    motion = rows_from(f"{STUDIES}/motion/motion.csv")
    for name, model in OF_MOTION.items():
        falls = [of_motion(row) for row in motion if row["model"] == name and row["worst_error"]]
        if falls:
            yield summed(HELD_OUT, model, falls)
    for noise, model in OF_NOISE.items():
        rows = [row for row in rows_of_falls(noise, f"{STUDIES}/test-falls/falls.csv") if row["fall"] in HARD_STARTS]
        yield summed(HARD, model, [of_runtime(row) for row in rows])
        yield summed(SEEN, model, [of_runtime(row) for row in rows_of_falls(noise, f"{STUDIES}/test-falls/falls.csv")
                                   if row["fall"] not in (*HARD_STARTS, *TEST_SCENES)])
        yield summed(LONG, model, [of_runtime(row) for row in rows_of_falls(noise, f"{STUDIES}/falls/long/falls.csv")])
        yield summed(CHOSEN, model, [of_runtime(row) for row in rows_of_falls(noise, f"{STUDIES}/falls/falls.csv")])
    for noise, model in (("off", READY_BODY), ("on", READY_NOISE)):
        yield summed(READY, model, [of_runtime(row) for row in rows_of_falls(noise, f"{STUDIES}/falls/bodies.csv")])
    surface = rows_from(f"{STUDIES}/surface-loads/surface-loads.csv")
    seen = {row["fall"]: of_runtime(row) for row in surface if row["set"] == "test" and row["fall"] != "samara"}
    yield summed(HARD, NO_BAKE, [seen[fall] for fall in HARD_STARTS])
    yield summed(SEEN, NO_BAKE, [row for fall, row in seen.items() if fall not in HARD_STARTS])
    for what, file in ((LONG, "peers-long.csv"), (CHOSEN, "peers.csv")):
        rows = rows_from(f"{STUDIES}/peers/{file}")
        for name, model in OF_PEERS.items():
            yield summed(what, model, [of_peer(row) for row in rows if row["model"] == name])


def percent(value):
    return f"{100 * value:.0f} %"


def counts_table(rows):
    order = (HELD_OUT, HARD, SEEN, LONG, READY, CHOSEN)
    models = [*OF_MOTION.values(), READY_BODY, READY_NOISE]
    rows = sorted(rows, key=lambda row: (order.index(row["falls"]), models.index(row["model"])))
    return table(["falls", "model", "regime right", "within 10, 20, 30 %", "descent, mean error", "worst metric, mean error"],
                 ([row["falls"], row["model"], f"{row['regimes_right']} of {row['count']}", f"{row['within_10_20_30']} of {row['count']}",
                   percent(float(row["mean_descent_error"])), percent(float(row["mean_worst_error"]))] for row in rows))


def classes_table():
    """The falls of full CFD in two classes: regular ones, judged by their metrics, and irregular ones, by distributions; of the standard
    bake with noise."""
    test_falls, long_falls = f"{STUDIES}/test-falls/falls.csv", f"{STUDIES}/falls/long/falls.csv"
    sets = ((HELD_OUT, test_falls, lambda fall: fall in TEST_SCENES), (HARD, test_falls, lambda fall: fall in HARD_STARTS),
            (SEEN, test_falls, lambda fall: fall not in (*HARD_STARTS, *TEST_SCENES)), (LONG, long_falls, lambda fall: True))

    def line(what, file, belongs):
        rows = [row for row in rows_of_falls("on", file) if belongs(row["fall"])]
        regular = [row for row in rows if row["judged_by"] == "metrics"]
        irregular = [row for row in rows if row["judged_by"] == "distributions"]
        agreeing = [row for row in irregular if row["agrees_as_judged"] == "yes"]
        return [what, f"{sum(map(has_the_regime, regular))} of {len(regular)}", f"{sum(map(agrees, regular))} of {len(regular)}",
                f"{len(agreeing)} of {len(irregular)}", f"{sum(row['certain'] == 'yes' for row in irregular)} of {len(irregular)}"]

    return table(["falls", "regular: regime right", "within 10, 20, 30 %", "irregular: agree", "certain"], (line(*one) for one in sets))


def held_out_table():
    """Fall by fall: the standard bake's differences from full CFD, with what the reference is uncertain by."""
    def cell(row, figure):
        difference, uncertainty = as_number(row[f"{figure}_difference"]), as_number(row[f"{figure}_uncertainty"])
        if difference is None:
            return "-"
        return f"{100 * difference:+.0f}" + (" %" if uncertainty is None else f" +- {100 * uncertainty:.0f} %")

    rows = [row for row in rows_from(f"{STUDIES}/motion/motion.csv") if row["model"] == "standard bake"]
    cells = {row["fall"]: row["model"].removeprefix("full CFD, ").removesuffix(" cells") for row in rows_from(f"{STUDIES}/motion/motion.csv")
             if row["model"].startswith("full CFD") and not row["worst_error"]}
    return table(["fall", "cells of the reference", "regime: samara / full CFD", "descent", "frequency", "amplitude", "rms angular speed"],
                 ([f"[{row['fall']}](../studies/test-falls/{row['fall']}.toml)", cells[row["fall"]], f"{row['regime']} / {row['regime_reference']}",
                   *(cell(row, figure) for figure in FIGURES)] for row in rows))


def measured_table(rows):
    """The published speeds and rotation rates with an uncertainty, and what each model gives; fruits are counted elsewhere."""
    names = {case.name: f"{case.group}: {case.text}" for case in CASES}

    def cell(row, column):
        ratio, error = ratio_of(row, column), as_number(row[f"{column}_error"])
        if ratio is None:
            return "-"
        share = 100 * (error or 0) / float(row["published"])
        text = f"{100 * (ratio - 1):+.0f}" + (f" +- {share:.0f}" if share >= 1 else "") + " %"
        return f"**{text}**" if misses(row, column) else text

    chosen = [row for row in rows if row["uncertainty"] and as_number(row["published"]) and row["verified"] != "exact"
              and row["quantity"] in ("descent speed", "spin", "speed without walls", "turning rate")
              and any(row[column] for column in ("tables", "cfd")) and not row["case"].startswith("fruit")]
    return table(["case", "quantity", "published", "uncertainty", "no bake", "baked", "full CFD"],
                 ([names[row["case"]], row["quantity"], f"{row['published']} {row['unit']}",
                   f"{100 * float(row['uncertainty']) / float(row['published']):.1f} %",
                   *(cell(row, column) for column in NATURE_MODELS.values())] for row in chosen))


def front_table(rows, nature):
    """The table of the README."""
    found = {(row["falls"], row["model"]): row for row in rows}
    judged = {column: [verdict for verdict in (misses(row, column) for row in nature) if verdict is not None]
              for column in NATURE_MODELS.values()}

    def cell(what, model, text):
        row = found.get((what, model))
        return text(row) if row else "-"

    def held_out(row):
        return (f"{row['regimes_right']} of {row['count']}; {row['within_10_20_30']} of {row['count']}; "
                f"{percent(float(row['mean_descent_error']))}")

    def within(row):
        return f"{row['within_10_20_30']} of {row['count']}"

    def both(model):
        cells = [cell(what, model, within) for what in (HARD, LONG)]
        return "; ".join(cells) if any(text != "-" for text in cells) else "-"

    def measured(column):
        return f"{judged[column].count(False)} of {len(judged[column])}"

    costs = rows_from(f"{FOLDER}/costs.csv")
    heads = ("no bake", "standard bake", "MuJoCo's fluid model", "full CFD")
    lines = [[f"[{row['what']}]({row['link']})", *(row[head] for head in heads)] for row in costs]
    lines += [
        [f"[{HELD_OUT}]({PAGE}#held-out-falls): regime right; within 10/20/30 %; mean descent error", cell(HELD_OUT, NO_BAKE, held_out),
         cell(HELD_OUT, STANDARD, held_out), cell(HELD_OUT, FITTED, held_out),
         cell(HELD_OUT, COARSE_CFD, lambda row: f"6,000 cells: {held_out(row)}")],
        [f"[{HARD}, {LONG}]({PAGE}#all-sets): within 10/20/30 %", both(NO_BAKE), both(STANDARD), both(FITTED), "the reference"],
        [f"[measured falls]({PAGE}#measured-falls): values within their uncertainty", measured("surface"), measured("tables"), "-",
         measured("cfd")],
    ]
    return table(["", *heads], lines)


def main(words):
    if len(words) != 1:
        sys.stderr.write(__doc__)
        return 2
    rows = list(summaries())
    written(f"{FOLDER}/accuracy.csv", [HEADS] + [[row[head] for head in HEADS] for row in rows])
    rows, nature = rows_from(f"{FOLDER}/accuracy.csv"), rows_from(f"{STUDIES}/nature/nature.csv")
    write_tables(PAGE, [held_out_table(), counts_table(rows), classes_table(), measured_table(nature), *nature_tables(only_baked=True)],
                 mark("accuracy"))
    write_tables("README.md", [front_table(rows, nature)], mark("accuracy"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
