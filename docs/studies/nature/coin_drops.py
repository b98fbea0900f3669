#!/usr/bin/python3
"""Twenty coins in water at once: their paths, their depth over time and where they land, beside what was measured.

    coin_drops.py BIN PICTURE.png    simulates coin-5-czk.toml, without a bake, and draws it beside coins.csv and coin-landings.csv

The measurements (18 drops) are of the repository ondrej-cloud/autumn-coin (International Young Physicists' Tournament; MIT licence): depth
is good to some 10 %, the coin's thickness is the mint's. Walls at 16 and 19 cm stopped the widest drops; the scene has none. Run from the
project's folder; needs numpy and matplotlib.
"""

import csv
import glob
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from study_pictures import flights, new_figure, save  # noqa: E402

FOLDER, COIN = "docs/studies/nature", "5-czk"
RADIUS, HALF_THICKNESS, BOTTOM = 0.0115, 0.000925, -0.38  # m


def measured(name):
    with open(f"{FOLDER}/{name}.csv", newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["coin"] == COIN]


def main(words):
    if len(words) != 3:
        sys.exit(__doc__)
    programs, picture = words[1:]
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([f"{programs}/samara", "simulate", f"{FOLDER}/coin-5-czk.toml", "-o", f"{work}/coin.h5", "--json"], check=True,
                       stdout=subprocess.DEVNULL)
        falls = [falls for _, falls in sorted(flights(programs, f"{work}/coin.h5").items())]
    times = np.array([pose.time for pose in falls[0]])
    places = np.array([[pose.position for pose in fall] for fall in falls])  # (coins, frames, 3)
    figure, panels = new_figure(1500, 600, 14, columns=3, margins=(0.055, 0.985, 0.12, 0.92), gaps=(0.06, 0))
    paths(panels[0], falls, places)
    depths(panels[1], times, places)
    landings(panels[2], times, places)
    save(figure, picture)


def paths(axes, falls, places):
    """Every coin's path from the side, and the coin at every tenth of a second, seen edge on where it stands on edge."""
    colors = [f"C{number % 10}" for number in range(len(falls))]
    for fall, path, color in zip(falls, places, colors):
        axes.plot(100 * path[:, 0], 100 * path[:, 2], color=color, lw=0.7, alpha=0.5)
        for pose in fall[5::8]:
            normal = np.array([row[2] for row in pose.rotation])
            side = np.array((normal[0], normal[2]))
            across = np.array((normal[2], -normal[0]))
            across = across / max(1e-9, np.linalg.norm(across))
            thin = max(HALF_THICKNESS, RADIUS * abs(normal[1]))
            side = side / max(1e-9, np.linalg.norm(side))
            turn = np.linspace(0, 2 * np.pi, 40)[:, None]
            outline = np.array((pose.position[0], pose.position[2])) + RADIUS * np.cos(turn) * across + thin * np.sin(turn) * side
            axes.fill(*(100 * outline.T), color=color, alpha=0.55, lw=0)
    axes.axhline(100 * BOTTOM, color="#6b6b6b")
    axes.set(title="twenty coins, every 0.08 s", xlabel="cm", ylabel="height, cm", xlim=(-32, 32), ylim=(-40, 2))
    axes.set_aspect("equal")


def depths(axes, times, places):
    rows = measured("coins")
    depth = -100 * places[:, :, 2]
    mean, spread = depth.mean(axis=0), depth.std(axis=0)
    shown = times <= 0.8
    axes.fill_between(times[shown], (mean - spread)[shown], (mean + spread)[shown], color="#2a6f97", alpha=0.25, lw=0)
    axes.plot(times[shown], mean[shown], color="#2a6f97", label="samara without a bake, 20 coins")
    axes.errorbar([float(row["time_s"]) for row in rows], [float(row["depth_cm"]) for row in rows],
                  [float(row["depth_sd_cm"]) for row in rows], fmt="o", color="#c0392b", capsize=3, label="measured, 18 drops")
    axes.set(title="depth, with its standard deviation", xlabel="s", ylabel="cm", xlim=(0, 0.8), ylim=(36, 0))
    axes.legend(loc="lower left")


def landings(axes, times, places):
    """Where each coin reaches the bottom, beside the ellipse of one and two standard deviations that was measured."""
    first = [int(np.argmax(path[:, 2] < BOTTOM + 2 * RADIUS)) or len(times) - 1 for path in places]
    landed = 100 * np.array([path[index, :2] for path, index in zip(places, first)])
    row, = measured("coin-landings")
    turn = np.linspace(0, 2 * np.pi, 100)
    for many, label in ((1, "measured: one and two standard deviations"), (2, None)):
        axes.plot(many * float(row["sigma_x_cm"]) * np.cos(turn), many * float(row["sigma_z_cm"]) * np.sin(turn), color="#c0392b",
                  label=label)
    axes.plot(*landed.T, "o", color="#2a6f97", ms=8, label="samara without a bake")
    median = np.median(np.linalg.norm(landed, axis=1))
    axes.set(title=f"landing: median distance {median:.0f} cm, measured {float(row['median_distance_cm']):.0f}", xlabel="cm",
             xlim=(-32, 32), ylim=(-32, 32))
    axes.set_aspect("equal")
    axes.legend(loc="lower left", fontsize=11)


if __name__ == "__main__":
    main(sys.argv)
