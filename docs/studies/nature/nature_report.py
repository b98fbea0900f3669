#!/usr/bin/env python3
"""The cases of nature_study.py flown by the runtime and solved by full CFD, and what is measured of them.

    nature_report.py BIN WORK ROWS.csv [SECONDS [CASE...]]

BIN: the folder of the programs. All cases are flown by the loads of the surface first, which needs nothing else and takes minutes.
WORK: WORK/bodies holds what is baked and WORK/full-cfd the falls that are solved; what is there and made from the scene as it is
now is used again, and a bake or fall that was stopped goes on. SECONDS (1200): how many CPU seconds of bakes and falls are begun
in this run, by the programs' own estimates; the cheapest come first, one after the other. CASE: only these. With 0 seconds
everything is measured anew from what is there. Writes ROWS.csv, a row for each case, quantity and model that is measured, and
beside it costs.csv, what each bake and fall is estimated to cost. Run from the project's folder.

The runtime flies copies that are turned a little from the scene's start, by the noise that a scene has of itself; a figure is
their mean, its error what a fall still drifts by together with the mean's standard error. A regime is the commonest, its error the
share of the flights that have another.
"""

import collections
import csv
import glob
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from study_pictures import flights  # noqa: E402
from nature_measure import measured  # noqa: E402
from nature_study import CASES, REGIME  # noqa: E402

COLUMNS = ("case", "quantity", "model", "value", "error", "by")
SURFACE, TABLES, FULL_CFD = "surface", "tables", "full CFD"
COPIES, TURNED = 20, 0.05  # let go turned by up to so much (rad) about any axis
COSTS = ("case", "bake", "fall")
CLOSURE = "kOmegaSSTLM"  # of the falls by full CFD


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def run(words):
    """What a program prints as JSON; a line of what it says on its way goes on. None where it fails."""
    result = subprocess.run(words, check=False, stdout=subprocess.PIPE, text=True)
    return json.loads(result.stdout) if result.returncode == 0 else None


class Made:
    """A file that a program makes from a scene, with what it is made of beside it: what was made otherwise is made anew."""

    def __init__(self, folder, case, ending, options):
        self.file = os.path.join(folder, case.name + ending)
        self.record = os.path.join(folder, case.name + ".made")
        self.made_of = f"# {options}\n{read(case.scene)}"

    def is_there(self):
        return os.path.exists(self.file) and os.path.exists(self.record) and read(self.record) == self.made_of

    def note(self):
        with open(self.record, "w", encoding="utf-8") as file:
            file.write(self.made_of)


def baked(work, case):
    return Made(os.path.join(work, "bodies"), case, ".body.h5", case.quality)


def solved(work, case):
    return Made(os.path.join(work, "full-cfd"), case, ".h5", f"{case.cells} cells, step {case.step}, {CLOSURE}")


def bake_words(programs, work, case):
    return [f"{programs}/samara", "bake", case.scene, "-o", os.path.join(work, "bodies"), "--quality", case.quality,
            "--jobs", "1", "--json"]


def fall_words(programs, work, case):
    return [f"{programs}/samara", "validate", case.scene, "-o", solved(work, case).file, "--cells", str(case.cells),
            "--step", str(case.step), "--closure", CLOSURE, "--json"]


def estimated_costs(programs, work, case):
    """CPU seconds of the bake and of the fall; None for what a case does not need, or where the program cannot tell."""
    bake = run(bake_words(programs, work, case) + ["--dry-run"]) if case.quality else None
    fall = None if case.reference else run(fall_words(programs, work, case) + ["--dry-run"])
    return (sum(body["estimated_cpu_seconds"] for body in bake["bodies"]) if bake else None,
            fall["estimated_cpu_seconds"] if fall else None)


def costs_of(programs, work, cases):
    """{case: (bake, fall)}, kept in WORK/costs.json as long as the scene stays as it is."""
    kept_file = os.path.join(work, "costs.json")
    kept = json.loads(read(kept_file)) if os.path.exists(kept_file) else {}
    for case in cases:
        scene = [read(case.scene), case.quality, case.cells, case.step, CLOSURE]
        if kept.get(case.name, {}).get("of") != scene:
            found = estimated_costs(programs, work, case)
            kept[case.name] = {"of": scene if any(found) else None, "costs": found}
            with open(kept_file, "w", encoding="utf-8") as file:
                json.dump(kept, file)
    return {case.name: kept[case.name]["costs"] for case in cases}


def make(programs, work, cases, costs, budget):
    """Bakes and solves what is missing, the cheapest first, until the budget is spent."""
    missing = []
    for case in cases:
        bake, fall = costs[case.name]
        if bake is not None and not baked(work, case).is_there():
            missing.append((bake, case, "bake", bake_words, baked))
        if fall is not None and not solved(work, case).is_there():
            missing.append((fall, case, "full CFD", fall_words, solved))
    for seconds, case, what, words, made in sorted(missing, key=lambda entry: entry[0]):
        if seconds > budget:
            print(f"{case.name}: {what} left, about {seconds:.0f} CPU s", flush=True)
            continue
        budget -= seconds
        print(f"{case.name}: {what}, about {seconds:.0f} CPU s", flush=True)
        if run(words(programs, work, case)) is None:
            print(f"{case.name}: {what} failed", flush=True)
        else:
            made(work, case).note()


def mean_of_flights(figures):
    """(value, error) of those of several flights."""
    values, drifts = zip(*figures)
    standard_error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0
    return statistics.fmean(values), math.hypot(statistics.fmean(drifts), standard_error)


def rows_of(programs, case, model, motion):
    told = run([f"{programs}/samara", "info", motion, "--json"])["bodies"][0]
    falls = list(flights(programs, motion).values())
    for quantity in case.measures:
        if quantity == REGIME:
            value, error = told["regime"], 1.0 - told["regimes"][told["regime"]] / sum(told["regimes"].values())
        else:
            value, error = mean_of_flights([measured(case, quantity, poses) for poses in falls])
        yield {"case": case.name, "quantity": quantity, "model": model, "value": value if quantity == REGIME else f"{value:.6g}",
               "error": f"{error:.2g}", "by": told["models"]}


def with_copies(text, shape, loads):
    """A scene's text with copies of its body, which has this shape or body file, flown by these loads, and with its noise."""
    text = re.sub(r'(?m)^turbulence = .*\n', "", text)
    text = re.sub(r'shape = ".*"', f'shape = "{os.path.abspath(shape)}"', text)
    return text + f"count = {COPIES}\nspread = {{ angle = {TURNED} }}\n" + f'loads = "{loads}"\n'


def shape_of(scene):
    return os.path.join(os.path.dirname(scene), re.search(r'shape = "(.*)"', read(scene)).group(1))


def flown(programs, case, folder, bodies=None):
    """The motion of a case by the runtime, with the bodies of a folder or by the loads of the surface; None where that fails."""
    scene, motion = os.path.join(folder, f"{case.name}.toml"), os.path.join(folder, f"{case.name}.h5")
    if case.without_loads:
        scene = case.scene
    else:
        with open(scene, "w", encoding="utf-8") as file:
            file.write(with_copies(read(case.scene), shape_of(case.scene), "table" if bodies else SURFACE))
    words = [f"{programs}/samara", "simulate", scene, "-o", motion, "--json"] + (["--bodies", bodies] if bodies else [])
    return motion if run(words) is not None else None


def motions_of(programs, work, case, folder):
    """(model, motion file) of what can be flown with a bake, and of what is solved."""
    bodies = None
    if case.ready:
        bodies = os.path.join(folder, "ready")
        os.makedirs(bodies, exist_ok=True)
        shutil.copy(case.ready, os.path.join(bodies, f"{case.name}.body.h5"))
    elif case.quality and baked(work, case).is_there():
        bodies = os.path.join(work, "bodies")
    motion = flown(programs, case, folder, bodies) if bodies or case.without_loads else None
    if motion:
        yield TABLES, motion
    fall = solved(work, case)
    if case.reference or fall.is_there():
        yield FULL_CFD, case.reference or fall.file


def write(path, columns, rows):
    with open(path + ".part", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    shutil.move(path + ".part", path)


def main(programs, work, target, budget=1200.0, names=()):
    for name in ("bodies", "full-cfd"):
        os.makedirs(os.path.join(work, name), exist_ok=True)
    unknown = set(names) - {case.name for case in CASES}
    if unknown:
        sys.exit(f"no such case: {', '.join(sorted(unknown))}")
    chosen = [case for case in CASES if not names or case.name in names]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in chosen:
            motion = flown(programs, case, folder)
            rows += rows_of(programs, case, SURFACE, motion) if motion else []
        write(target, COLUMNS, rows)
        costs = costs_of(programs, work, CASES)
        make(programs, work, chosen, costs, float(budget))
        for case in CASES:
            for model, motion in motions_of(programs, work, case, folder):
                rows += rows_of(programs, case, model, motion)
    write(target, COLUMNS, rows)
    write(os.path.join(os.path.dirname(target), "costs.csv"), COSTS,
          [{"case": name, "bake": bake, "fall": fall} for name, (bake, fall) in costs.items()])
    found = collections.Counter(row["model"] for row in rows)
    wanted = sum(len(case.measures) for case in CASES)
    print("Measured: " + ", ".join(f"{found[model]} by {model}" for model in (SURFACE, TABLES, FULL_CFD)) + f", of {wanted} figures")
    return 0


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:5], names=sys.argv[5:]))
