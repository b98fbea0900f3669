#!/usr/bin/env python3
"""What step = "auto" does to falls, of the ready-baked bodies, as users fly them: with noise.

    step_auto.py BIN WORK    flies 48 runs of each at "auto", at the default 2 ms and at 0.25 ms, and writes
                             step-auto.csv and the table of README.md
    step_auto.py             writes the table again

The three have other random numbers, so that what they differ by is chance too: its standard error stands beside. Run from the
project's folder.
"""

import csv
import glob
import json
import math
import os
import subprocess
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from report_tables import mark, write_tables  # noqa: E402

BODIES = ("airplane", "cube", "disc", "ellipsoid", "leaf", "samara", "sheet", "sphere")
AIR = ("airplane", "leaf", "samara", "sheet")
RUNS, DURATION = 48, 6.0
FIGURES = ("descent_speed", "rms_angular_speed")
ROWS, PAGE = "docs/studies/step/step-auto.csv", "docs/studies/step/README.md"


def scene_of(body, step):
    return f"""[scene]
duration = {DURATION}
step = {step}
[fluid]
preset = "{'air' if body in AIR else 'water'}"
[[body]]
name = "{body}"
shape = "samara:{body}"
orientation = [0.8, 0.3, 0.5, 0.1]
"""


def flown(programs, work, body, step, seed):
    """What `samara simulate` says of a scene, and the figures of its runs."""
    scene, motion = os.path.join(work, f"{body}.toml"), os.path.join(work, f"{body}.h5")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(scene_of(body, step))
    words = [f"{programs}/samara", "simulate", scene, "-o", motion, "--runs", str(RUNS), "--seed", str(seed), "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def estimate(body, figure):
    """Mean and standard error over the runs."""
    return body[figure], body.get(f"{figure}_error")


def row_of(programs, work, body):
    automatic = flown(programs, work, body, '"auto"', 1)
    usual = flown(programs, work, body, 0.002, 2)
    fine = flown(programs, work, body, 0.00025, 3)
    row = [body, automatic["step"]["seconds"], automatic["step"]["auto"]["error"], automatic["step"]["auto"]["limit"],
           automatic["implicit_steps"], usual["implicit_steps"], fine["implicit_steps"], automatic["most_substeps"]]
    for figure in FIGURES:
        truth, truth_error = estimate(fine["bodies"][0], figure)
        for other in (automatic, usual):
            value, error = estimate(other["bodies"][0], figure)
            row += [value / truth - 1.0, math.hypot(error or 0.0, truth_error or 0.0) / truth]
    return row


def heading():
    return ["body", "step", "error", "limit", "implicit_steps", "implicit_steps_usual", "implicit_steps_fine", "most_parts"] + [
        f"{figure}_{which}" for figure in FIGURES for which in ("auto", "auto_chance", "usual", "usual_chance")]


def table():
    with open(ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| body | step | off by, a window | no longer by | parts of a step: mean (most) | implicit steps a second and body (at 2 ms) | descent (at 2 ms) | rms angular speed (at 2 ms) |",
             "|---" * 8 + "|"]

    def changed(row, figure):
        auto, chance = 100 * float(row[f"{figure}_auto"]), 100 * float(row[f"{figure}_auto_chance"])
        usual = 100 * float(row[f"{figure}_usual"])
        return f"{auto:+.1f}{f' +- {chance:.1f}' if chance else ''} % ({usual:+.1f} %)"

    for row in rows:
        seconds = RUNS * DURATION
        parts = int(row["implicit_steps"]) / seconds * float(row["step"])
        limit = row["limit"].split(" of ")[0] or "the longest there is"
        lines.append(f"| {row['body']} | {1e3 * float(row['step']):.3g} ms | {100 * float(row['error']):.2g} % | {limit} "
                     f"| {parts:.2g} ({row['most_parts']}) | {int(row['implicit_steps']) / seconds:.0f} ({int(row['implicit_steps_usual']) / seconds:.0f}) "
                     f"| {changed(row, FIGURES[0])} | {changed(row, FIGURES[1])} |")
    return "\n".join(lines) + "\n"


def main(words):
    if len(words) == 2:
        sys.stderr.write(__doc__)
        return 2
    if len(words) == 3:
        os.makedirs(words[2], exist_ok=True)
        rows = [heading()] + [row_of(words[1], words[2], body) for body in BODIES]
        with open(ROWS + ".part", "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
        os.replace(ROWS + ".part", ROWS)
        print(f"Written: {ROWS}")
    write_tables(PAGE, [table()], mark("step"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
