#!/usr/bin/python3
"""What the reports' pictures share: poses from a motion file, silhouettes, and matplotlib; and the pictures of one
table each.

    study_pictures.py NAME ROWS.csv PICTURE.png

NAME: one of bake, closures, kirchhoff, motion, mujoco, peers, plan, step. Drawing needs numpy and matplotlib. """

import collections
import csv
import math
import os
import subprocess
import sys
import tempfile

Pose = collections.namedtuple("Pose", "time position rotation velocity angular_velocity")


def rotation_of(w, x, y, z):
    """The matrix (rows) of a unit quaternion, body to world."""
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def turned(rotation, vector):
    return tuple(sum(a * b for a, b in zip(row, vector)) for row in rotation)


def flights(programs, motion):
    """The poses of each flight of a motion file with one body: {(run, copy): [Pose]}. The position is that of the
    shape's origin (m, world)."""
    found = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as work:
        table = os.path.join(work, "motion.csv")
        subprocess.run([f"{programs}/samara", "export", motion, "-o", table], check=True, stdout=subprocess.DEVNULL)
        with open(table, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                found[int(row["run"]), int(row["copy"])].append(Pose(
                    float(row["time"]), tuple(float(row[f"position_{axis}"]) for axis in "xyz"),
                    rotation_of(*(float(row[f"orientation_{part}"]) for part in "wxyz")),
                    tuple(float(row[f"velocity_{axis}"]) for axis in "xyz"),
                    tuple(float(row[f"angular_velocity_{axis}"]) for axis in "xyz")))
    return dict(found)


def ellipsoid_outline(semi_axes, pose, horizontal, points=48):
    """The outline of an ellipsoid seen level, as points (along the world's axis `horizontal`, 0 or 1; height)."""
    rows = (pose.rotation[horizontal], pose.rotation[2])
    a, b, c = (sum(p * q * s * s for p, q, s in zip(first, second, semi_axes))
               for first, second in ((rows[0], rows[0]), (rows[0], rows[1]), (rows[1], rows[1])))
    first = math.sqrt(a)  # the root of the matrix [[a, b], [b, c]], by Cholesky
    second, third = b / first, math.sqrt(max(0.0, c - b * b / a))
    outline = []
    for i in range(points):
        cosine, sine = math.cos(2 * math.pi * i / points), math.sin(2 * math.pi * i / points)
        outline.append((pose.position[horizontal] + first * cosine, pose.position[2] + second * cosine + third * sine))
    return outline


# Drawing. matplotlib is imported where it is used: what reads poses alone does without it.

GRAY = "#6b6b6b"


def new_figure(width, height, font=14.0, **subplots):
    """A figure of so many pixels with type of so many points (of a 96th of an inch); where `rows` or `columns` are
    given also its axes in a flat list, laid out within `margins` (left, right, bottom, top: shares) and `gaps` (across,
    up: shares)."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    matplotlib.rcdefaults()
    matplotlib.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": font, "axes.titlesize": font, "axes.labelsize": font,
        "legend.fontsize": font,
        "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": GRAY, "xtick.color": GRAY,
        "ytick.color": GRAY,
        "xtick.labelcolor": "#1a1a1a", "ytick.labelcolor": "#1a1a1a", "axes.grid": True, "axes.axisbelow": True,
        "grid.color": "#e4e4e4",
        "grid.linewidth": 0.8, "lines.linewidth": 1.6, "legend.frameon": False, "legend.handlelength": 1.6,
        "xtick.minor.size": 0,
        "ytick.minor.size": 0})
    figure = Figure(figsize=(width / 96, height / 96), dpi=96, facecolor="white")
    FigureCanvasAgg(figure)
    if not subplots:
        return figure
    rows, columns = subplots.get("rows", 1), subplots.get("columns", 1)
    left, right, bottom, top = subplots["margins"]
    across, up = subplots.get("gaps", (0.05, 0.1))
    wide, tall = (right - left - (columns - 1) * across) / columns, (top - bottom - (rows - 1) * up) / rows
    return figure, [figure.add_axes((left + column * (wide + across), bottom + (rows - 1 - row) * (tall + up), wide,
                                     tall))
                    for row in range(rows) for column in range(columns)]


def save(figure, file):
    figure.savefig(file, dpi=96, metadata={"Software": "samara"})


def key(figure, axes, columns, place=(0.5, 0.01)):
    """One key of what the axes name, below all of them."""
    handles = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="lower center", bbox_to_anchor=place, ncol=columns)


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def points(rows, x, y, **where):
    """The columns x and y of the rows whose other columns are as given."""
    chosen = [row for row in rows if all(row[name] == value for name, value in where.items())]
    return [number(row[x]) for row in chosen], [number(row[y]) for row in chosen]


def logarithmic(axes, x=None, y=None):
    """Logarithmic axes between two ends, where these are given."""
    for limits, scale, bound in ((x, axes.set_xscale, axes.set_xlim), (y, axes.set_yscale, axes.set_ylim)):
        if limits:
            scale("log")
            bound(*limits)


def plain(axis, places):
    """Numbers an axis at these places, as they are."""
    axis.set_ticks(places, [f"{place:g}" for place in places])
    axis.set_ticks([], minor=True)


def draw_bake(rows, source):
    """Error of the tables against CPU seconds; pale what it was before."""
    before = rows_of(source.replace(".csv", "-before.csv"))
    figure, panels = new_figure(1900, 720, columns=3, margins=(0.06, 0.99, 0.25, 0.92), gaps=(0.045, 0))
    bodies = (("ellipsoid", "#c0392b", "#e9b9b3"), ("sheet", "#2a7f8e", "#aacdd3"))
    titles = (("force", "force"), ("moment", "moment"), ("turbulent_kinetic_energy", "k (natural logarithm)"))
    for axes, (quantity, title) in zip(panels, titles):
        for body, color, pale in bodies:
            axes.plot(*points(before, "cpu_seconds", quantity + "_error", body=body), "o-", color=pale,
                      label=f"{body} before")
            axes.plot(*points(rows, "cpu_seconds", quantity + "_error", body=body), "o-", color=color, label=body)
            axes.plot(*points(rows, "cpu_seconds", quantity + "_stated", body=body), "o--", mfc="white", color=color,
                      label=f"{body} as stated")
        for row in rows:
            if row["body"] == "ellipsoid":
                axes.text(number(row["cpu_seconds"]), 0.026, row["quality"], ha="center", va="center", color=GRAY,
                          fontsize=12)
        axes.set_title(title)
        axes.set_xlabel("CPU seconds of the bake")
        logarithmic(axes, (4, 900), (0.02, 4))
        plain(axes.yaxis, (0.03, 0.1, 0.3, 1, 3))
        plain(axes.xaxis, (10, 100))
    panels[0].set_ylabel("error of the table, rms over rms")
    key(figure, panels, 3)
    return figure


CLOSURES = (("kEpsilon", "k-epsilon, wall functions", "#c0392b", "o"), ("kOmegaSST linearUpwind", "k-omega SST",
                                                                        "#d98c1f", "^"),
            ("kOmegaSSTLM linearUpwind", "k-omega SST with transition (LM)", "#2a7f8e", "s"),
            ("laminar linearUpwind", "no closure", "#7a7a7a", "D"))


def brown_lawler(reynolds):
    return 24.0 / reynolds * (1 + 0.150 * reynolds ** 0.681) + 0.407 / (1 + 8710.0 / reynolds)


def draw_closures(rows, _):
    """Models of the flow against measurements of drag."""
    import numpy as np
    figure, (sphere, bodies, cost) = new_figure(2000, 760, columns=3, margins=(0.05, 0.99, 0.23, 0.92), gaps=(0.05, 0))
    line = np.geomspace(30, 2e5, 200)
    sphere.fill_between(line, 0.9 * brown_lawler(line), 1.1 * brown_lawler(line), color="#e3e3e3", lw=0,
                        label="Brown and Lawler 2003, 10 % to either side")
    sphere.plot(line, brown_lawler(line), color="#1a1a1a")
    names = ("sphere", "cube", "disc", "plate", "ellipsoid broadside", "ellipsoid at 45", "ellipsoid end on")
    for place, (model, title, color, marker) in enumerate(CLOSURES):
        style = {"ls": "none", "marker": marker, "color": color, "ms": 9}
        of_model = [row for row in rows if row["model"] == model]
        medium = [row for row in of_model if row["body"] == "sphere" and (
            row["mesh"] == "medium" or row["mesh"] == "medium layered" and number(row["reynolds_number"]) < 5e4
            or row["mesh"] == "medium thinly layered" and number(row["reynolds_number"]) > 5e4)]
        sphere.plot(*points(medium, "reynolds_number", "drag"), label=title, **style)
        near = [row for row in of_model if 9e3 < number(row["reynolds_number"]) < 1.2e4 and row["body"] in names
                and row["mesh"] in ("medium", "medium layered") and number(row["literature"]) > 0]
        bodies.plot([names.index(row["body"]) + 1 + 0.12 * (place - 1.5) for row in near],
                    [number(row["drag"]) / number(row["literature"]) for row in near], **style)
        cost.plot(*points(of_model, "cpu_seconds", "error", body="sphere", reynolds_number="10000"), **style)
    unsteady = [row for row in rows if row["body"] == "sphere" and number(row["reynolds_number"]) == 1e4
                and (row["model"].startswith("unsteady") or row["model"] == "kOmegaSSTDDES")]
    cost.plot(*points(unsteady, "cpu_seconds", "error"), "o", mfc="none", mec="#5b3a8e", mew=1.6, ms=10,
              label="in time: DDES, LM, no closure")
    sphere.set(title="sphere: drag against the Reynolds number", xlabel="Re", ylabel="$C_D$")
    logarithmic(sphere, (30, 2e5), (0.2, 1.8))
    plain(sphere.yaxis, (0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5))
    bodies.set(title="all bodies at Re 1e4: drag over the literature's", ylabel="$C_D$ over the literature's",
               xlim=(0.5, 7.5), ylim=(0.4, 1.6))
    bodies.set_xticks(range(1, 8), ["sphere", "cube", "disc", "plate", "ellipsoid\nbroadside", "at 45", "end on"],
                      fontsize=12)
    bodies.axhline(1.0, color="#1a1a1a", lw=1)
    cost.set(title="sphere at Re 1e4: error against cost", xlabel="CPU seconds of a case",
             ylabel="$C_D$ over the literature's, less 1", ylim=(-0.4, 0.4))
    logarithmic(cost, (1, 300))
    plain(cost.xaxis, (1, 10, 100))
    cost.axhline(0.0, color="#1a1a1a", lw=1)
    key(figure, (sphere, cost), 3)
    return figure


def draw_kirchhoff(rows, _):
    """Error of the added mass against milliseconds."""
    figure, panels = new_figure(2000, 740, 15, columns=4, margins=(0.06, 0.985, 0.27, 0.92), gaps=(0.04, 0))
    methods = dict(zip(("offset sources (0.1)", "offset sources (0.6)", "samara hypersingular", "samara from flat mesh",
                        "samara from curved mesh", "samara to a tolerance"),
                        ("#b0b0b0", "#7a7a7a", "#2a7f8e", "#d98c1f", "#c0392b", "#5b3a8e")))
    for axes, body in zip(panels, ("ellipsoid 1:2:4", "oblate 1:1:0.01", "cube", "plate 1:1:0.0001")):
        for method, color in methods.items():
            axes.plot(*points(rows, "milliseconds", "error", body=body, method=method), "o-", color=color, label=method)
        axes.set(title=body, xlabel="time, ms")
        logarithmic(axes, (0.03, 1e5), (1e-7, 100))
    panels[0].set_ylabel("relative tensor error")
    key(figure, panels, 3)
    return figure


# The models of the picture of the motion: their rows, names, colors and markers, and where the name stands beside the mark.
OWN, FULL_CFD, OTHERS = "#1f5f8b", "#1a1a1a", "#a0522d"
MOTION_MODELS = (
    ("inertia alone", "inertia alone", OWN, "o", "right"), ("drag coefficient 1", "drag\ncoefficient 1", OWN, "o", "left"),
    ("the paper as printed (20 runs)", "the paper\nas printed", OTHERS, "D", "left"), ("no bake", "no bake", OWN, "o", "right"),
    ("preview bake", "preview bake", OWN, "o", "right"), ("standard bake", "standard bake", OWN, "o", "above right"),
    ("standard bake, five times the step", "standard bake,\nfive times\nthe step", OWN, "o", "left"),
    ("standard bake with noise (20 runs)", "standard bake\nwith noise", OWN, "s", "below"),
    ("MuJoCo default", "MuJoCo,\ndefaults", OTHERS, "^", "right"),
    ("MuJoCo best for each shape on other falls", "MuJoCo,\nfitted to\nother falls", OTHERS, "^", "right"),
    ("full CFD, 6,000 cells", "6,000 cells", FULL_CFD, "o", "above"), ("full CFD, 20,000 cells", "20,000 cells", FULL_CFD, "o", "above"))


def draw_motion(rows, _):
    """Error of a fall against seconds for a simulated second: a median with its quartiles for each model, and a line through those
    that nothing cheaper beats. The axis leaves out the decades between the models and full CFD."""
    import statistics
    figure = new_figure(1500, 860, 15)
    models, cfd = figure.add_axes((0.075, 0.1, 0.62, 0.84)), figure.add_axes((0.73, 0.1, 0.255, 0.84))
    offsets = {"right": ((13, 0), "left", "center"), "left": ((-13, 0), "right", "center"), "above": ((0, 13), "center", "bottom"),
               "below": ((0, -13), "center", "top"), "above right": ((11, 8), "left", "bottom")}
    marks = []
    for model, name, color, marker, side in MOTION_MODELS:
        seconds, errors = points(rows, "seconds_per_simulated_second", "worst_error", model=model)
        errors = [error for error in errors if not math.isnan(error)]
        if len(errors) < 2:
            continue
        low, middle, high = statistics.quantiles([100 * error for error in errors], n=4, method="inclusive")
        place = statistics.median(seconds)
        marks.append((place, middle))
        axes = cfd if color == FULL_CFD else models
        axes.errorbar(place, middle, [[middle - low], [high - middle]], fmt=marker, color=color, ms=11, capsize=4, lw=1.3,
                      mfc="white" if color == OTHERS else color, mew=1.6)
        shift, across, up = offsets[side]
        axes.annotate(name, (place, high if side == "above" else low if side == "below" else middle), xytext=shift,
                      textcoords="offset points", ha=across, va=up, color=color)
    best, line = math.inf, []
    for place, error in sorted(marks):
        if error < best:
            best = error
            line.append((place, error))
    for axes in (models, cfd):
        axes.plot(*zip(*line), color="#c0392b", lw=1.4, ls="--", zorder=0)
        axes.set_yscale("log")
        axes.set_ylim(4, 4000)
        axes.set_xscale("log")
    reference, _ = points(rows, "seconds_per_simulated_second", "worst_error", model="full CFD, 60,000 cells")
    cfd.axvline(statistics.median(reference), color=GRAY, lw=1)
    cfd.text(0.92 * statistics.median(reference), 3000, "60,000 cells:\nthe reference", color=GRAY, va="top", ha="right")
    models.set(xlim=(8e-5, 1.2e-2), title="models: hundreds to thousands of times faster than real time", ylabel="worst metric of a fall off by, %")
    cfd.set(xlim=(5, 600), title="full CFD: slower than real time", xlabel="")
    models.set_xlabel("seconds of one core for a simulated second (the decades between the two halves are left out)")
    plain(models.yaxis, (10, 30, 100, 300, 1000, 3000))
    cfd.set_yticks([10, 30, 100, 300, 1000, 3000], [""] * 6)
    cfd.set_yticks([], minor=True)
    plain(cfd.xaxis, (10, 30, 100, 300))
    plain(models.xaxis, (0.0001, 0.0003, 0.001, 0.003, 0.01))
    return figure


def draw_mujoco(rows, _):
    """Error of a step against its cost, beside MuJoCo's."""
    figure, panels = new_figure(1500, 700, 15, columns=2, margins=(0.07, 0.99, 0.23, 0.92), gaps=(0.07, 0))
    methods = dict(zip(("MuJoCo Euler", "MuJoCo implicit", "MuJoCo RK4", "samara tables", "samara coefficients"),
                       ("#b0b0b0", "#7a7a7a", "#2a7f8e", "#c0392b", "#d98c1f")))
    for axes, column, title in zip(panels, ("relative_position_error", "angle_error_rad"),
                                   ("place after 1 s, error relative to the path",
                                    "orientation after 1 s, error in rad")):
        for method, color in methods.items():
            axes.plot(*points(rows, "cpu_milliseconds_per_second", column, method=method), "o-", color=color,
                      label=method)
        axes.set(title=title, xlabel="CPU ms for one simulated second")
        logarithmic(axes, (0.03, 40), (1e-10, 3))
        plain(axes.xaxis, (0.1, 1, 10))
    key(figure, panels, 5)
    return figure


def draw_peers(rows, _):
    """MuJoCo's fluid model and samara's beside the reference falls."""
    figure, panels = new_figure(1900, 1150, 15, rows=3, margins=(0.075, 0.99, 0.15, 0.965), gaps=(0, 0.05))
    falls = ("sphere", "ellipsoid-tilted", "ellipsoid-compound", "ellipsoid-edgewise", "ellipsoid-heavy", "spheroid",
             "disc-light",
             "disc-heavy", "plate", "sheet")
    models = (("MuJoCo default", "MuJoCo, default", "#9a9a9a", "s"), ("MuJoCo best", "MuJoCo, best for all falls",
                                                                      "#c0392b", "o"),
              ("MuJoCo best for each shape", "MuJoCo, best for the shape", "#d98c1f", "^"),
              ("MuJoCo best for each shape on other falls", "MuJoCo, the shape on other falls", "#7d3c98", "v"),
              ("MuJoCo best for each fall", "MuJoCo, best for the fall", "#dcb878", "o"),
              ("samara by the surface", "samara, surface", "#3a9d5d", "D"),
              ("samara by tables with noise", "samara, tables", "#2a6f97", "s"))
    edge = 105.0  # where what is beyond the picture stands
    for axes, column, title, limit in zip(panels, ("descent", "frequency", "amplitude"),
                                          ("descent speed", "frequency", "amplitude"), (10, 20, 30)):
        axes.axhspan(-limit, limit, color="#e9f2e6", lw=0)
        for place, (model, name, color, marker) in enumerate(models):
            found = [(falls.index(row["fall"]) + 1, number(row[column])) for row in rows if row["model"] == model
                     and row["fall"] in falls
                     and row[column] and (column == "descent" or row["fall"] != "sphere")]
            axes.plot([fall + 0.115 * (place - 3) for fall, _ in found], [max(-edge, min(edge, 100 * value)) for _,
                                                                          value in found], marker,
                      color=color, ms=9, mfc="none" if model in ("MuJoCo default", "MuJoCo best for each fall")
                      else color, mew=1.6, label=name)
        for fall in range(1, 10):
            axes.axvline(fall + 0.5, color="#dddddd", lw=0.8)
        axes.grid(False, axis="x")
        axes.set(xlim=(0.5, 10.5), ylim=(-112, 112), title=f"{title} less that of full CFD (shaded: within {limit} %)")
        axes.set_yticks([-100, -50, 0, 50, edge], ["−100 %", "−50 %", "0", "+50 %", "≥ +100 %"])
        axes.set_xticks(range(1, 11), [fall.replace("-", "\n") for fall in falls] if column == "amplitude"
                        else [""] * 10)
    key(figure, panels, 4, (0.5, 0.01))
    return figure


def draw_plan(rows, _):
    """Error against CPU seconds of baking only what a scene needs."""
    figure, panels = new_figure(1900, 1050, rows=2, columns=3, margins=(0.06, 0.985, 0.13, 0.94), gaps=(0.05, 0.12))

    def floored(error):
        return 100 * error if error > 0.0007 else 0.07

    for place, (axes, body) in enumerate(zip(panels, ("sphere", "ellipsoid", "sheet", "airplane", "samara", "leaf"))):
        grids = [row for row in rows if row["body"] == body and row["set"] != "plan"]
        planned = [row for row in rows if row["body"] == body and row["set"] == "plan"]
        cost = [number(row["cpu_seconds"]) for row in grids]
        whole = [number(row["cpu_seconds"]) * number(row["without_symmetry"]) / number(row["directions"])
                 for row in grids]
        worst = [floored(number(row["worst"])) for row in grids]
        axes.plot(cost, worst, "o-", color="#2a7f8e", label="uniform grid, after symmetry")
        axes.plot(whole, worst, "o--", mfc="white", color="#9a9a9a", label="uniform grid without symmetry")
        for row in planned:
            error, chance = number(row["worst"]), 2 * number(row["worst_chance"])
            middle = floored(error)
            axes.errorbar(number(row["cpu_seconds"]), middle, [[max(0.0, middle - floored(error - chance))],
                                                               [max(0.0, floored(error + chance) - middle)]],
                          fmt="s", color="#c0392b", ms=9, capsize=4,
                          label="what the scene needs, with twice its chance")
        axes.set(title=body, xlabel="CPU seconds of the bake" if place > 2 else "", ylabel="worst measure off by, %"
                 if place % 3 == 0 else "")
        logarithmic(axes, (4, 4000), (0.05, 200))
        plain(axes.xaxis, (10, 100, 1000))
        plain(axes.yaxis, (0.1, 1, 10, 100))
    key(figure, panels, 3)
    return figure


def draw_step(rows, _):
    """Error of a step against its length and against milliseconds."""
    figure, panels = new_figure(2500, 1120, 15, rows=2, columns=5, margins=(0.05, 0.992, 0.125, 0.945),
                                gaps=(0.034, 0.12))
    methods = (("explicit Euler", "#b0b0b0", "s"), ("Runge-Kutta 4", "#7a7a7a", "^"),
               ("samara reference", "#2a7f8e", "D"),
               ("samara implicit", "#c0392b", "o"))
    for place, axes in enumerate(panels):
        body = ("rubber ellipsoid", "paper sheet", "air bubble", "neutral ellipsoid", "copper coin")[place % 5]
        upper = place < 5
        for method, color, marker in methods:
            of_method = [row for row in rows if row["body"] == body and row["method"] == method]
            finite = [row for row in of_method if row["position_error"] != "inf"]
            axes.plot(*points(finite, "step" if upper else "milliseconds_per_second", "position_error"), marker=marker,
                      color=color, label=method)
            lost = [number(row["step"]) for row in of_method if row["position_error"] == "inf"]
            if upper:
                axes.plot(lost, [4.0 if method == "explicit Euler" else 0.8] * len(lost), "x", color=color, ms=8, mew=2)
        if upper:
            axes.axvline(1.0 / 24, color="#d8b26a", lw=1, dashes=(4, 3))
        axes.set(title=body if upper else "", xlabel="step, s" if upper else "CPU ms for a simulated second",
                 ylabel="position error / path" if place % 5 == 0 else "")
        logarithmic(axes, (7e-6, 0.06) if upper else (5e-3, 1500), (5e-13, 10))
    key(figure, panels, 4)
    return figure


DRAWERS = {"bake": draw_bake, "closures": draw_closures, "kirchhoff": draw_kirchhoff, "motion": draw_motion,
           "mujoco": draw_mujoco,
           "peers": draw_peers, "plan": draw_plan, "step": draw_step}


def picture_of(name, rows, picture):
    """Draws the table `rows`, a .csv, into a .png."""
    save(DRAWERS[name](rows_of(rows), rows), picture)


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in DRAWERS:
        sys.exit(__doc__)
    picture_of(*sys.argv[1:])
