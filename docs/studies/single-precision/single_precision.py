#!/usr/bin/env python3
"""Falls in single precision beside falls in double, of the ready-baked bodies from the same starts with the same noise.

    single_precision.py BIN WORK    simulates 200 falls of each in both, with noise, and one in both without, and writes the
                                    table of README.md

Run from the project's folder.
"""

import glob
import json
import os
import subprocess
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from report_tables import mark, table, write_tables  # noqa: E402

BODIES = ("airplane", "cube", "disc", "ellipsoid", "leaf", "maple-leaf", "oak-leaf", "samara", "sheet", "sphere")
WATER = ("cube", "disc", "ellipsoid", "sphere")
FALLS = 200
PAGE = "docs/studies/single-precision/README.md"


def simulated(programs, work, body, precision, rest):
    scene, motion = os.path.join(work, "scene.toml"), os.path.join(work, f"{body}-{precision}.h5")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f'[scene]\nduration = 6\nframe_rate = {720 if body == "samara" else 60}\nprecision = "{precision}"\n[fluid]\npreset = "{"water" if body in WATER else "air"}"\n'
                   f'[[body]]\nname = "{body}"\nshape = "samara:{body}"\n{rest}\n')
    subprocess.run([f"{programs}/samara", "simulate", scene, "-o", motion], capture_output=True, check=True)
    return motion


def compared(programs, work, body, rest):
    """What `samara compare` says of the falls in single precision, beside those in double."""
    motions = [simulated(programs, work, body, precision, rest) for precision in ("single", "double")]
    done = subprocess.run([f"{programs}/samara", "compare", *motions, "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def row_of(programs, work, body):
    noisy = compared(programs, work, body, f"count = {FALLS}\nspread = {{ angle = 3.14 }}")
    still = compared(programs, work, body, 'orientation = [0.8, 0.3, 0.5, 0.1]\nturbulence = "none"')["first_swing"]

    def change(key):
        measure = noisy["measures"][key]
        chance = measure["difference_error"] / measure["reference"]["value"]
        return f"{100 * measure['relative_difference']:+.3f} % ({100 * chance:.2f} %)"

    counts = [noisy[which]["regimes"] for which in ("motion", "reference")]
    moved = sum(abs(counts[0][regime] - counts[1][regime]) for regime in counts[0]) // 2
    speeds = noisy["distributions"]["angular_speed"]
    path = still and still["path_distance"]
    apart = f"{1e3 * path['value'] / still['way_fallen']:.2g} mm" if path else "-"
    return [body, f"{noisy['reference']['regime']}", f"{moved} of {FALLS}", change("descent_speed"), change("rms_angular_speed"),
            f"{speeds['distance']:.4f} ({speeds['distance_by_chance']:.4f})" if speeds else "-", apart]


def main(words):
    if len(words) != 3:
        sys.stderr.write(__doc__)
        return 2
    os.makedirs(words[2], exist_ok=True)
    head = ["body", "regime", "other regime", "descent (chance)", "rms angular speed (chance)", "angular speeds apart (chance)",
            "no noise: apart in the first swing, a metre fallen"]
    rows = []
    for body in BODIES:
        rows.append(row_of(words[1], words[2], body))
        print(*rows[-1], sep="; ", flush=True)
    write_tables(PAGE, [table(head, rows)], mark("step"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
