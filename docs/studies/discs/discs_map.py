#!/usr/bin/python3
"""How a disc falls over its dimensionless inertia I* and the Reynolds number, beside Field et al. 1997.

    discs_map.py BIN BODIES FOLDER

BIN: the folder of the programs; BODIES: that of the baked disc-light.body.h5 and disc-heavy.body.h5 (a model whose body is
not there keeps its rows of the last run); FOLDER: of discs.csv, discs.png and README.md, which it writes. Run from
the project's folder.
"""

import csv
import glob
import math
import os
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import run  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from study_pictures import flights, key, logarithmic, new_figure, plain, save  # noqa: E402

DISC = "docs/studies/falls/disc.geo"
DIAMETER, THICKNESS, FLUID_DENSITY, GRAVITY = 0.04, 0.004, 998.2, 9.81
INERTIAS = [0.0055, 0.007, 0.01, 0.014, 0.02, 0.03, 0.045, 0.07, 0.1, 0.15]
REYNOLDS_NUMBERS = [30, 100, 300, 1000, 3000, 10000]  # aimed at; those of the fall are measured
STARTS = 12
COLUMNS = ("inertia", "reynolds", "regime", "share", "field", "frequency", "steady", "fluttering", "chaotic", "tumbling",
           "autorotating")
REGIMES = ("steady", "fluttering", "chaotic", "tumbling", "autorotating")


def expected(inertia, reynolds):
    """Field's regime, by the round limits of README.md."""
    if reynolds < 100:
        return "steady"
    return "fluttering" if inertia < 0.01 else "chaotic" if inertia < 0.05 else "tumbling"


def scene_of(inertia, reynolds, shape, loads):
    """A scene: `STARTS` discs from rest, turned from level by up to 0.6 rad about random axes."""
    ratio = inertia / (math.pi / 64 * THICKNESS / DIAMETER)
    speed = math.sqrt(2 * (ratio - 1) * GRAVITY * THICKNESS / 1.1)  # terminal, broadside
    viscosity = FLUID_DENSITY * speed * DIAMETER / reynolds
    time = DIAMETER / speed
    return f'''[scene]
duration = {150 * time}
step = {0.01 * time}
frame_rate = {15 / time}
[fluid]
density = {FLUID_DENSITY}
viscosity = {viscosity}
[[body]]
name = "disc"
shape = "{os.path.abspath(shape)}"
density = {ratio * FLUID_DENSITY}
count = {STARTS}
spread = {{ position = [0, 0, 0], angle = 0.6 }}
turbulence = "none"
{loads}
''', viscosity / FLUID_DENSITY


def flown(programs, work, inertia, reynolds, shape, loads):
    """The row of one point of the map."""
    scene = os.path.join(work, "disc.toml")
    text, viscosity = scene_of(inertia, reynolds, shape, loads)
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    body = run([f"{programs}/samara", "simulate", scene, "-o", os.path.join(work, "disc.h5"), "--threads", "1",
                "--json"])["bodies"][0]
    measured = body["descent_speed"] * DIAMETER / viscosity
    row = {"inertia": inertia, "reynolds": measured, "regime": body["regime"], "share": body["regime_share"],
           "field": expected(inertia, measured), "frequency": body["frequency"]}
    return row | {name: body["regimes"][name] for name in REGIMES}


def earlier(file):
    """{model: rows of its map} of the last run."""
    maps = {}
    if os.path.exists(file):
        with open(file, newline="", encoding="utf-8") as opened:
            for row in csv.DictReader(opened):
                numbers = {key: float(row[key]) for key in ("inertia", "reynolds", "share")}
                counts = {name: int(row.get(name) or 0) for name in REGIMES}
                known = {key: row[key] for key in ("regime", "field", "frequency")}
                maps.setdefault(row["model"], []).append({key: (numbers | known | counts)[key] for key in COLUMNS})
    return maps


def mapped(programs, bodies, maps):
    """{model: rows of its map}; of models that cannot be flown those given."""
    with tempfile.TemporaryDirectory() as work:
        plain = os.path.join(work, "plain.body.h5")
        run([f"{programs}/samara", "kirchhoff", DISC, "-o", plain, "--json"])
        models = {"coefficients": (plain, 'loads = "coefficients"\ndrag_coefficient = 1.1\nlift_coefficient = 1.0'),
                  "surface": (plain, 'loads = "surface"')}
        for name in ("disc-light", "disc-heavy"):
            file = os.path.join(bodies, f"{name}.body.h5")
            if os.path.exists(file):
                models[f"tables, {name}"] = (file, 'loads = "table"')
            else:
                print(f"no {file}: its rows stay as they are")
        for model, (shape, loads) in models.items():
            maps[model] = [flown(programs, work, inertia, reynolds, shape, loads)
                           for inertia in INERTIAS for reynolds in REYNOLDS_NUMBERS]
            print(model, "agrees with Field's map at", sum(row["regime"] == row["field"] for row in maps[model]), "of",
                  len(maps[model]), "points")
    order = list(models) + [model for model in maps if model not in models]
    return {model: maps[model] for model in order}


def table(maps):
    """How many points of each of Field's regimes a model puts where."""
    lines = ["| model | Field's regime | points | " + " | ".join(REGIMES) + " |",
             "|---" * (3 + len(REGIMES)) + "|"]
    for model, rows in maps.items():
        for regime in REGIMES[:4]:  # Field has no discs that spin up
            there = [row for row in rows if row["field"] == regime]
            counts = [sum(row["regime"] == other for row in there) for other in REGIMES]
            cells = [f"**{count}**" if other == regime and count else str(count) for other, count in zip(REGIMES, counts)]
            lines.append(f"| {model} | {regime} | {len(there)} | " + " | ".join(cells) + " |")
        agree = sum(row["regime"] == row["field"] for row in rows)
        lines.append(f"| {model} | all | {len(rows)} | alike at {agree} |" + " |" * (len(REGIMES) - 1))
    return "\n".join(lines) + "\n"


# Diameter (m) and Reynolds number of the discs of Tinklenberg et al. 2023 that their abstract names.
THIN_DISCS = ((0.001, 96), (0.003, 360))
ASPECT, THIN_STARTS = 40, 200
AIR_DENSITY, AIR_VISCOSITY = 1.204, 1.825e-5


def thin_disc(programs, work, diameter, reynolds):
    """200 starts of a thin disc in air, turned about random axes by any angle; a line of the table."""
    thickness, speed = diameter / ASPECT, reynolds * AIR_VISCOSITY / (AIR_DENSITY * diameter)
    density = AIR_DENSITY * (1.1 * speed ** 2 / (2 * GRAVITY * thickness) + 1)  # falls broadside at that speed
    time = diameter / speed
    shape, scene, motion = (os.path.join(work, f"thin.{end}") for end in ("geo", "toml", "h5"))
    with open(shape, "w", encoding="utf-8") as file:
        file.write(f'SetFactory("OpenCASCADE");\nCylinder(1) = {{0, 0, {-thickness / 2}, 0, 0, {thickness}, {diameter / 2}}};\n'
                   f"Mesh.MeshSizeMax = {diameter / 16};\n")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f'[scene]\nduration = {600 * time}\nstep = {0.02 * time}\nframe_rate = {10 / time}\n[fluid]\npreset = "air"\n'
                   f'[[body]]\nname = "thin"\nshape = "{shape}"\ndensity = {density}\ncount = {THIN_STARTS}\n'
                   f'spread = {{ position = [0, 0, 0], angle = {math.pi} }}\nturbulence = "none"\nloads = "surface"\n')
    body = run([f"{programs}/samara", "simulate", scene, "-o", motion, "--threads", "1", "--json"])["bodies"][0]
    drifts = []
    for poses in flights(programs, motion).values():
        way = [b - a for a, b in zip(poses[len(poses) // 3].position, poses[-1].position)]
        drifts.append(math.degrees(math.atan2(math.hypot(*way[:2]), -way[2])))
    shares = " | ".join(f"{100 * body['regimes'][name] / THIN_STARTS:.0f} %" for name in REGIMES)
    inertia = math.pi / 64 * density * thickness / (AIR_DENSITY * diameter)
    return (f"| {1000 * diameter:.0f} mm | {reynolds} | {inertia:.1f} | {speed:.2f} m/s | {body['descent_speed']:.2f} m/s | {shares} | "
            f"{sum(drifts) / len(drifts):.0f}, {max(drifts):.0f} degrees |")


def thin_table(programs):
    lines = ["| diameter | Reynolds number | I* | their fall speed | samara's | " + " | ".join(REGIMES) + " | drift: mean, largest |",
             "|---" * (6 + len(REGIMES)) + "|"]
    with tempfile.TemporaryDirectory() as work:
        lines += [thin_disc(programs, work, *disc) for disc in THIN_DISCS]
    return "\n".join(lines) + "\n"


def picture(maps, file):
    width = 170 + 760 * len(maps)
    figure, panels = new_figure(width, 900, 16, columns=len(maps), margins=(150 / width, 1 - 20 / width, 0.2, 0.93), gaps=(100 / width, 0))
    styles = (("#8a8a8a", "o"), ("#2a6f97", "o"), ("#d98c1f", "^"), ("#c0392b", "s"), ("#4a7c59", "D"))
    areas = ((10, 100, 0.004, 0.2, "#f1f1f1"), (100, 3e4, 0.004, 0.01, "#e3eef5"), (100, 3e4, 0.01, 0.05, "#f7ead6"), (100, 3e4, 0.05, 0.2, "#f5dedb"))
    words = (("Field: steady", 11, 0.187, "#6b6b6b"), ("Field: periodic", 110, 0.0044, "#2a6f97"), ("Field: chaotic", 110, 0.0365, "#b5761a"),
             ("Field: tumbling", 110, 0.187, "#a5281b"))
    for axes, (model, rows) in zip(panels, maps.items()):
        for left, right, bottom, top, colour in areas:
            axes.fill_between((left, right), bottom, top, color=colour, lw=0)
        for text, x, y, colour in words:
            axes.text(x, y, text, color=colour, va="center")
        for regime, (colour, marker) in zip(REGIMES, styles):
            there = [row for row in rows if row["regime"] == regime]
            axes.scatter([row["reynolds"] for row in there], [row["inertia"] for row in there], marker=marker, edgecolors=colour, zorder=3,
                         s=[20.0 * (1.0 + 1.8 * row["share"]) ** 2 for row in there], linewidths=1.6,
                         facecolors="white" if regime == "steady" else colour)
            axes.plot([], [], marker, mec=colour, mfc="white" if regime == "steady" else colour, ms=11, mew=1.6,
                      label="fluttering (periodic)" if regime == "fluttering" else regime)
        axes.grid(False)
        axes.set(title=model, xlabel="Reynolds number of the fall")
        logarithmic(axes, (10, 3e4), (0.004, 0.2))
        plain(axes.yaxis, (0.005, 0.01, 0.02, 0.05, 0.1, 0.2))
    panels[0].set_ylabel("I* = (π/64) $ρ_{disc}$ t / ($ρ_{fluid}$ d)")
    key(figure, panels, 5)
    save(figure, file)


def main(words):
    if len(words) != 4:
        sys.stderr.write(__doc__)
        return 2
    programs, bodies, folder = words[1:4]
    maps = mapped(programs, bodies, earlier(os.path.join(folder, "discs.csv")))
    with open(os.path.join(folder, "discs.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["model", *COLUMNS])
        for model, rows in maps.items():
            writer.writerows([model] + [f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row.values()]
                             for row in rows)
    picture(maps, os.path.join(folder, "discs.png"))
    write_tables(os.path.join(folder, "README.md"), [table(maps), thin_table(programs)], mark("scenes"))
    print(f"Written: discs.csv, discs.png and README.md in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
