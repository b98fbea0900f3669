#!/usr/bin/env python3
"""The samara of docs/scenes/samara.toml let go in many attitudes, its surface in more and more patches; and that of
docs/studies/falls/samara.toml beside its fall by full CFD.

    spin_report.py BIN

Writes the tables of README.md. BIN: the folder of the programs. Run from the project's folder.
"""

import glob
import itertools
import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import percent, run, scene_with  # noqa: E402
from study_pictures import flights  # noqa: E402
from nature_measure import coning, mean, spin, stretch, swinging_descent  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

SCENE, REFERENCE = "docs/scenes/samara.toml", "docs/studies/falls/samara.h5"
PATCHES = (1, 2, 4, 8, 16)
ATTITUDES = 48  # drawn at random from the scene's seed
SPINNING = 5.0  # turns in a second about the vertical


# What the rows are flown by: the keys of the body, in words.
MODELS = {"tables, noise": 'loads = "table"\nturbulence = "table"', "tables": 'loads = "table"\nturbulence = "none"',
          "surface": 'loads = "surface"'}


def row_of(programs, patches, model, folder):
    with open(SCENE, encoding="utf-8") as file:
        text = re.sub(r"(?m)^(loads|patches|orientation) = .*\n", "", file.read())
    scene, motion = (os.path.join(folder, name) for name in ("spin.toml", "spin.h5"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f'{text}patches = {patches}\n{MODELS[model]}\ncount = {ATTITUDES}\nspread = {{ angle = 3.14 }}\n')
    seconds = run([f"{programs}/samara", "simulate", scene, "-o", motion, "--threads", "1", "--json"])["nanoseconds_per_step"]
    found = [(spin(poses)[0], swinging_descent(poses)[0], coning(poses)[0]) for poses in flights(programs, motion).values()]
    spinning = [figures for figures in found if figures[0] > SPINNING]
    others = [figures for figures in found if figures[0] <= SPINNING]
    means = [mean([figures[i] for figures in spinning]) if spinning else None for i in range(3)]
    cells = [model, str(patches), f"{len(spinning)} of {len(found)}"]
    cells += ["-" if value is None else f"{value:.3g}" for value in means]
    cells += [f"{mean([figures[1] for figures in others]):.2g}" if others else "-", f"{1e-3 * seconds:.2g}"]
    return "| " + " | ".join(cells) + " |"


def late_figures(programs, motion):
    """Spin (Hz) and descent (m/s) over the last quarter of the fall, and the coning (degrees) over its last two thirds."""
    poses = next(iter(flights(programs, motion).values()))
    late = stretch(poses, 0.75)
    return (abs(mean([pose.angular_velocity[2] for pose in late])) / (2 * math.pi), mean([-pose.velocity[2] for pose in late]),
            coning(poses)[0])


def beside_full_cfd(programs, folder):
    """The table of the runtime beside docs/studies/falls/samara.h5."""
    truth = late_figures(programs, REFERENCE)
    lines = ["| last quarter of the 1.2 s | spin, Hz | descent, m/s | coning over the last two thirds, degrees |", "|---" * 4 + "|",
             "| full CFD | " + " | ".join(f"{value:.3g}" for value in truth) + " |"]
    motion = os.path.join(folder, "samara.h5")
    for loads, patches in itertools.product(("table", "surface"), PATCHES[:-1]):
        scene = scene_with("samara", {"shape": "samara:samara", "loads": loads}, folder)
        with open(scene, encoding="utf-8") as file:
            text = re.sub(r"(?m)^patches = .*\n", "", file.read())
        with open(scene, "w", encoding="utf-8") as file:
            file.write(f"{text}patches = {patches}\n")
        run([f"{programs}/samara", "simulate", scene, "-o", motion, "--json"])
        found = late_figures(programs, motion)
        cells = [f"{value:.3g} ({percent(value / true - 1)})" for value, true in zip(found, truth)]
        lines.append(f"| runtime, loads: {loads}, patches: {patches} | " + " | ".join(cells if found[0] > SPINNING else ["dives", "", ""]) + " |")
    return "\n".join(lines) + "\n"


def main(programs):
    lines = ["| loads | patches | spin of those let go | spin, Hz | descent, m/s | coning, degrees | the others sink at, m/s "
             "| us a step and body |", "|---" * 8 + "|"]
    with tempfile.TemporaryDirectory() as folder:
        for model in MODELS:
            lines += [row_of(programs, patches, model, folder) for patches in PATCHES]
        tables = ["\n".join(lines) + "\n", beside_full_cfd(programs, folder)]
    write_tables("docs/studies/spin/README.md", tables, mark("spin"))
    print(*tables, sep="\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
