#!/usr/bin/env python3
"""The samara of docs/scenes/samara.toml let go in many attitudes, its surface in more and more patches.

    spin_report.py BIN

Writes the table of docs/spin.md. BIN: the folder of the programs. Run from the project's folder.
"""

import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
from falls_report import run  # noqa: E402
from gnuplot_picture import flights  # noqa: E402
from nature_measure import coning, mean, spin, swinging_descent  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

SCENE = "docs/scenes/samara.toml"
PATCHES = (1, 2, 4, 8, 16)
ATTITUDES = 48  # drawn at random from the scene's seed
SPINNING = 5.0  # turns in a second about the vertical


def row_of(programs, patches, noise, folder):
    with open(SCENE, encoding="utf-8") as file:
        text = re.sub(r"(?m)^(patches|orientation) = .*\n", "", file.read())
    scene, motion = (os.path.join(folder, name) for name in ("spin.toml", "spin.h5"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f'{text}patches = {patches}\nturbulence = "{noise}"\ncount = {ATTITUDES}\nspread = {{ angle = 3.14 }}\n')
    seconds = run([f"{programs}/samara", "simulate", scene, "-o", motion, "--threads", "1", "--json"])["nanoseconds_per_step"]
    found = [(spin(poses)[0], swinging_descent(poses)[0], coning(poses)[0]) for poses in flights(programs, motion).values()]
    spinning = [figures for figures in found if figures[0] > SPINNING]
    others = [figures for figures in found if figures[0] <= SPINNING]
    means = [mean([figures[i] for figures in spinning]) if spinning else None for i in range(3)]
    cells = [str(patches), "with" if noise == "table" else "without", f"{len(spinning)} of {len(found)}"]
    cells += ["-" if value is None else f"{value:.3g}" for value in means]
    cells += [f"{mean([figures[1] for figures in others]):.2g}" if others else "-", f"{1e-3 * seconds:.2g}"]
    return "| " + " | ".join(cells) + " |"


def main(programs):
    lines = ["| patches | noise | spin of those let go | spin, Hz | descent, m/s | coning, degrees | the others sink at, m/s "
             "| us a step and body |", "|---" * 8 + "|"]
    with tempfile.TemporaryDirectory() as folder:
        for noise in ("table", "none"):
            lines += [row_of(programs, patches, noise, folder) for patches in PATCHES]
    write_tables("docs/spin.md", ["\n".join(lines) + "\n"], mark("spin"))
    print(*lines, sep="\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
