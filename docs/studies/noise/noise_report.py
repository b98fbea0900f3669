#!/usr/bin/python3
"""The loads' fluctuations of bodies that are held in a stream: full CFD in time beside the runtime's noise.

    noise_report.py BIN FOLDER            solves in FOLDER what is missing of CASES, some two CPU hours where nothing is,
                                          measures both, and writes fluctuations.csv and the tables of README.md
    noise_report.py BIN FOLDER CASE...    only solves these
    noise_report.py BIN FOLDER --flown    solves nothing: measures what is solved in FOLDER, takes what fluctuations.csv has of
                                          the other cases, and flies the runtime anew
    noise_report.py                       writes the tables again

What is solved is not solved again, and what was stopped goes on. Run from the project's folder.

In the runtime a body is held by a mass that nothing moves; its loads are what little its velocity changes by.
Loads are coefficients as the tables' (over A = pi L^2/4, moments about the centroid over A L), times over L/U. Of both,
means over 8 steps of 0.03 L/U are measured: what is shorter moves no body, and a stream that jumps at each step pushes
without bounds.
"""

import cmath
import csv
import glob
import json
import math
import os
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from closures_report import cells_of, make_case, run, set_parameters  # noqa: E402
from case_files import history, read_record  # noqa: E402
from closures_study import RESOLVED, Body, box, disc, mesh, norm, sphere, unsteady  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from stationarity import AREA_UNIT  # noqa: E402
from study_pictures import key, logarithmic, new_figure, save  # noqa: E402


def axis_along_z(triangles):
    return [[(y, z, x) for x, y, z in triangle] for triangle in triangles]


# As meshes/shapes and the studies of falls have them, with axes, fluid and a Reynolds number (over L) of their tables.
BODIES = {
    "sphere": (sphere(), 15900, "water"),
    "disc": (axis_along_z(disc(40, 2)), 7640, "water"),
    "ellipsoid": (sphere(1, 2, 4), 10300, "water"),
    "sheet": (box(83, 83, 0.1), 4990, "air"),
    "cube": (box(20, 20, 20), 6070, "water"),
    "box": (box(12, 24, 36), 11200, "water"),
    "spheroid": (sphere(4, 4, 1), 5960, "water"),
}
HALF = math.sqrt(0.5)
EDGE = (math.cos(math.radians(20)), 0.0, math.sin(math.radians(20)))
CASES = {
    "sphere": ("sphere", (1, 0, 0)),
    "disc-0": ("disc", (0, 0, 1)),
    "disc-45": ("disc", (HALF, 0, HALF)),
    "disc-70": ("disc", EDGE),
    "ellipsoid-0": ("ellipsoid", (1, 0, 0)),
    "ellipsoid-45": ("ellipsoid", (HALF, 0, HALF)),
    "ellipsoid-90": ("ellipsoid", (0, 0, 1)),
    "sheet-0": ("sheet", (0, 0, 1)),
    "sheet-45": ("sheet", (HALF, 0, HALF)),
    "sheet-70": ("sheet", EDGE),
    "cube-0": ("cube", (1, 0, 0)),
    "cube-45": ("cube", (HALF, HALF, 0)),
    "disc-20": ("disc", (EDGE[2], 0, EDGE[0])),
    "ellipsoid-middle": ("ellipsoid", (0, 1, 0)),
    "box-0": ("box", (1, 0, 0)),
    "box-45": ("box", (HALF, 0, HALF)),
    "spheroid-0": ("spheroid", (0, 0, 1)),
    "spheroid-45": ("spheroid", (HALF, 0, HALF)),
}
# The cases by which the fluctuating wake (runtime/core/kernel/step_constants.hpp) was fitted; the others were held out.
FITTED = tuple(name for name in CASES if CASES[name][0] in ("sphere", "disc", "ellipsoid", "sheet")
               and name not in ("disc-20", "ellipsoid-middle"))
# Solved with the wake's cells twice as wide, too.
COARSER = ("sphere", "disc-45", "ellipsoid-45")
STEP, STEPS, WAKE_LENGTH, WAKE_MARGIN = 0.03, 2400, 2.5, 0.3
MODEL = {**unsteady(f"{STEP}", STEPS), **RESOLVED, "simulationType": "LES", "closure": "kOmegaSSTDDES",
         "convection": "LUST grad(U)"}
COMPONENTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
BLOCK, PIECES, RUNS = 8, 6, 8
# Of the case's mean force: what is smaller is not held against anything.
LEAST = {"force": 0.01, "moment": 0.002}
KINDS = ("wake", "seen-fluid")
ROWS, SPECTRA_ROWS, PAGE, PICTURE = ("docs/studies/noise/fluctuations.csv", "docs/studies/noise/spectra.csv", "docs/studies/noise/README.md",
                                     "docs/studies/noise/spectra.png")
SEGMENT = 600
SPECTRA = (("sphere", "force_y"), ("disc-0", "force_z"), ("ellipsoid-45", "force_x"), ("sheet-45", "moment_y"))
VISCOSITY, DENSITY = {"water": 1.004e-6, "air": 1.516e-5}, {"water": 998.2, "air": 1.204}


def file_of(shape):
    return f"runtime/bodies/{shape}.body.h5"


def baked(programs, work, shape):
    """The file of the ready-baked body; else that of the study of falls with k and epsilon solved anew, in some 400 CPU s."""
    if os.path.exists(file_of(shape)):
        return file_of(shape)
    body = os.path.join(work, f"{shape}.body.h5")
    if not os.path.exists(body):
        subprocess.run([f"{programs}/samara", "bake", f"docs/studies/falls/bodies/{shape}.body.h5", "-o", body, "--turbulence-only",
                        "--quality", "standard"], check=True)
    return body


def vector(a):
    return "(" + " ".join(f"{x + 0.0:.8g}" for x in a) + ")"


def wake_radius(body, direction):
    """Of a cylinder along the flow that holds the body's shadow, and somewhat more."""
    def from_axis(point):
        along = sum(x * d for x, d in zip(point, direction))
        return norm([x - along * d for x, d in zip(point, direction)])
    return max(from_axis(point) for triangle in body.triangles for point in triangle) + WAKE_MARGIN


def is_solved(folder):
    """All its steps; no verdict is asked, since the loads of most do not settle."""
    attempts = read_record(os.path.join(folder, "rounds.json")).get("attempts", [])
    return bool(attempts) and attempts[-1]["iterations"] >= STEPS


def cpu_seconds_of(folder):
    return read_record(os.path.join(folder, "rounds.json")).get("cpu_seconds", 0.0)


def folder_of(work, name, coarse=False):
    return os.path.join(work, f"{name}-coarse" if coarse else name)


def solve(work, name, coarse=False):
    folder = folder_of(work, name, coarse)
    if is_solved(folder):
        return
    shape, direction = CASES[name]
    triangles, reynolds, _ = BODIES[shape]
    body = Body(triangles, None, math.pi / 4, None, direction)
    if not os.path.exists(os.path.join(folder, "parameters")):
        make_case(folder)
        os.makedirs(os.path.join(folder, "constant/triSurface"), exist_ok=True)
        body.write(os.path.join(folder, "constant/triSurface/body.stl"))
    set_parameters(folder, {
        **mesh(20, 4, "medium", 9, "1.4"), "wakeLevel": 3 if coarse else 4, "wakeRadius": f"{wake_radius(body, direction):.4g}",
        "wakeEnd": vector([-WAKE_LENGTH * x for x in direction]), "direction": vector(direction),
        "flowVelocity": vector([-x for x in direction]), "reynoldsNumber": f"{reynolds:g}", "viscosity": f"{1 / reynolds:.8g}",
        "inflowEpsilon": f"{0.09 * 1.5e-4 ** 2 * reynolds:.6g}", "inflowNut": f"{1 / reynolds:.8g}",
        "inflowOmega": f"{1.5e-4 * reynolds:.6g}", **MODEL})
    run(["./Allrun"], folder)
    print(os.path.basename(folder), cells_of(folder), "cells", f"{cpu_seconds_of(folder):.0f} CPU s", flush=True)


def loads_by_cfd(folder):
    """One row of six coefficients a step, over the last two thirds of the times."""
    forces, moments = history(folder, "forces", "force.dat"), history(folder, "forces", "moment.dat")
    rows = [[x / AREA_UNIT for x in force[1:4] + moment[1:4]] for force, moment in zip(forces, moments)]
    return rows[len(rows) // 3:]


def loads_by_runtime(programs, work, name, kind):
    """Likewise of RUNS runs, one after the other."""
    shape, direction = CASES[name]
    _, reynolds, fluid = BODIES[shape]
    body = baked(programs, work, shape)
    info = json.loads(subprocess.run([f"{programs}/samara", "info", body, "--json"], check=True, capture_output=True,
                                     text=True).stdout)
    length = info["tables"]["reference_length"]
    speed = reynolds * VISCOSITY[fluid] / length
    time_step = STEP * length / speed
    mass = 1e7 * DENSITY[fluid] * length ** 3
    scene, motion = os.path.join(work, f"{name}.toml"), os.path.join(work, f"{name}.h5")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f"""[scene]
duration = {STEPS * time_step!r}
frame_rate = {1 / time_step!r}
step = {time_step!r}
gravity = [0, 0, 0]
[fluid]
density = {DENSITY[fluid]}
viscosity = {DENSITY[fluid] * VISCOSITY[fluid]!r}
[[body]]
name = "{name}"
shape = "{os.path.abspath(body)}"
mass = {mass!r}
inertia = {[mass * length ** 2] * 3}
velocity = {[speed * x for x in direction]}
langevin = "{kind}"
""")
    quiet = {"check": True, "capture_output": True}
    subprocess.run([f"{programs}/samara", "simulate", scene, "-o", motion, "--runs", str(RUNS)], **quiet)
    subprocess.run([f"{programs}/samara", "export", motion, "-o", motion + ".csv"], **quiet)
    unit = 0.5 * DENSITY[fluid] * speed ** 2 * math.pi * length ** 2 / 4 * time_step / mass
    runs = {}
    with open(motion + ".csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            runs.setdefault(row["run"], []).append(
                [float(row[f"{what}velocity_{axis}"]) * scale / unit
                 for what, scale in (("", 1.0), ("angular_", length)) for axis in "xyz"])
    return [[[b - a for a, b in zip(before, after)] for before, after in zip(rows[:-1], rows[1:])] for rows in runs.values()]


def moments_of(series):
    """Mean, rms about it and correlation time (the integral of the autocorrelation to its first zero) of block means."""
    middle = math.fsum(series) / len(series)
    rest = [x - middle for x in series]
    variance = math.fsum(x * x for x in rest) / len(rest)
    total = 0.5
    for lag in range(1, len(rest) // 2):
        correlation = math.fsum(a * b for a, b in zip(rest, rest[lag:])) / (len(rest) * max(variance, 1e-300))
        if correlation <= 0.0:
            break
        total += correlation
    return middle, math.sqrt(variance), total * BLOCK * STEP


def blocks(rows, component):
    values = [row[component] for row in rows]
    return [math.fsum(values[i:i + BLOCK]) / BLOCK for i in range(0, len(values) - BLOCK + 1, BLOCK)]


def measured(runs, component):
    """Of each run, or of one run's whole; the error is the scatter of six pieces' rms, or that between the runs."""
    each = [moments_of(blocks(rows, component)) for rows in runs]
    middle, rms, time = (sum(one[i] for one in each) / len(each) for i in range(3))
    pieces = [one[1] for one in each]
    if len(runs) == 1:
        length = len(runs[0]) // PIECES
        pieces = [moments_of(blocks(runs[0][i * length:(i + 1) * length], component))[1] for i in range(PIECES)]
    center = sum(pieces) / len(pieces)
    error = math.sqrt(sum((x - center) ** 2 for x in pieces) / (len(pieces) * (len(pieces) - 1)))
    return middle, rms, error, time


def spectrum_of(runs, component):
    """[(frequency, power)] in coefficient^2 L/U, one-sided: Welch's, of segments of SEGMENT steps under Hann's window."""
    window = [math.sin(math.pi * i / SEGMENT) ** 2 for i in range(SEGMENT)]
    segments = []
    for rows in runs:
        values = [row[component] for row in rows]
        middle = math.fsum(values) / len(values)
        for start in range(0, len(values) - SEGMENT + 1, SEGMENT // 2):
            segments.append([(x - middle) * w for x, w in zip(values[start:start + SEGMENT], window)])
    scale = 2.0 * STEP / (sum(w * w for w in window) * len(segments))
    found, line = [], 1
    while line < SEGMENT // 8:
        turn = cmath.exp(-2j * math.pi * line / SEGMENT)
        power = 0.0
        for segment in segments:
            total = 0.0
            for x in reversed(segment):
                total = total * turn + x
            power += abs(total) ** 2
        found.append((line / (SEGMENT * STEP), power * scale))
        line = max(line + 1, round(line * 1.15))
    return found


def rows_kept(path):
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def spectra_rows(programs, work, kept):
    rows = []
    for name, component in SPECTRA:
        runs = {kind: loads_by_runtime(programs, work, name, kind) for kind in KINDS}
        if is_solved(folder_of(work, name)):
            runs["cfd"] = [loads_by_cfd(folder_of(work, name))]
        else:
            rows += [list(row.values()) for row in kept
                     if (row["case"], row["component"], row["model"]) == (name, component, "cfd")]
        for which, series in runs.items():
            rows += [[name, component, which, f"{frequency:.5g}", f"{power:.5g}"]
                     for frequency, power in spectrum_of(series, COMPONENTS.index(component))]
    return rows


def draw_spectra():
    with open(SPECTRA_ROWS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    figure, panels = new_figure(1600, 900, rows=2, columns=2, margins=(0.07, 0.98, 0.16, 0.94), gaps=(0.08, 0.16))
    titles = {"cfd": ("full CFD", "#d98c1f"), "seen-fluid": ("the stream", "#7a7a7a"), "wake": ("the wake", "#2a7f8e")}
    for axes, (name, component) in zip(panels, SPECTRA):
        for which, (title, color) in titles.items():
            points = [(float(row["frequency"]), float(row["power"])) for row in rows
                      if (row["case"], row["component"], row["model"]) == (name, component, which)]
            if points:
                axes.plot(*zip(*points), color=color, lw=2, label=title)
        what, axis = component.split("_")
        axes.set(title=f"{name}: {what} along {axis}", xlabel="frequency, U/L", ylabel="power, L/U")
        axes.set_yscale("log")
        logarithmic(axes, (0.04, 6))
    key(figure, panels, 3)
    save(figure, PICTURE)


MEASURES = ("mean", "rms", "rms_error", "time")


def rows_of(programs, work, name, kept):
    """Of a case, one for each component: of full CFD what `kept` has where the folder has not."""
    runs = {kind: loads_by_runtime(programs, work, name, kind) for kind in KINDS}
    folders = {"cfd": folder_of(work, name)} | ({"coarser": folder_of(work, name, True)} if name in COARSER else {})
    for which, folder in folders.items():
        if is_solved(folder):
            runs[which] = [loads_by_cfd(folder)]
    rows = []
    for i, component in enumerate(COMPONENTS):
        old = next((row for row in kept if (row["case"], row["component"]) == (name, component)), {})
        row = dict.fromkeys(heading(), "") | {"case": name, "component": component}
        row |= {key: value for key, value in old.items() if key.startswith(("cells", "cpu", "cfd", "coarser"))}
        if "cfd" in runs:
            row |= {"cells": cells_of(folders["cfd"]), "cpu_seconds": f"{cpu_seconds_of(folders['cfd']):.0f}"}
        for which, series in runs.items():
            row |= {f"{which}_{what}": f"{x:.5g}" for what, x in zip(MEASURES, measured(series, i))}
        rows.append(list(row.values()))
    return rows


def heading():
    return ["case", "component", "cells", "cpu_seconds"] + [
        f"{which}_{what}" for which in ("cfd", *KINDS, "coarser") for what in MEASURES]


class Row:
    """Of a case's component; what a file holds as text, as numbers."""

    def __init__(self, values):
        self.case, self.component = values["case"], values["component"]
        self.cells, self.cpu_seconds = int(values["cells"]), float(values["cpu_seconds"])
        self.numbers = {name: float(value) for name, value in values.items() if value and name not in ("case", "component")}

    def __getattr__(self, name):
        return self.numbers.get(name)

    @property
    def title(self):
        what, axis = self.component.split("_")
        return f"{what} {axis}"


def read_rows():
    return [Row(values) for values in rows_kept(ROWS)]


def judged(rows):
    """Those whose rms is above LEAST of the case's mean force, for moments over L."""
    force = {}
    for row in rows:
        if row.component.startswith("force"):
            force[row.case] = math.hypot(force.get(row.case, 0.0), row.cfd_mean)
    return [row for row in rows if row.cfd_rms > LEAST[row.component.split("_")[0]] * force[row.case]]


def drag(rows, which):
    direction = CASES[rows[0].case][1]
    return -sum(d * getattr(row, f"{which}_mean") for d, row in zip(direction, rows))


def table_of_cases(rows):
    lines = ["| case | cells | CPU s | mean drag coefficient | in the runtime | for |", "|---" * 6 + "|"]
    for name in CASES:
        of_case = [row for row in rows if row.case == name]
        if not of_case:
            continue
        lines.append(f"| {name} | {of_case[0].cells:,} | {of_case[0].cpu_seconds:.0f} | {drag(of_case, 'cfd'):.3g} | "
                     f"{drag(of_case, 'wake'):.3g} | {'the choice' if name in FITTED else 'the test'} |")
    return "\n".join(lines) + "\n"


def times(value, truth):
    return f"{value / truth:.2g}"


def table_of_loads(rows, fitted):
    lines = ["| case | load | rms, full CFD | lasts, L/U | the stream: rms over CFD's | lasts, over CFD's | the wake: rms over CFD's | lasts, over CFD's |", "|---" * 8 + "|"]
    for row in judged(rows):
        if (row.case in FITTED) != fitted:
            continue
        lines.append(f"| {row.case} | {row.title} | {row.cfd_rms:.2g} +- {row.cfd_rms_error:.1g} | {row.cfd_time:.2g} | "
                     + " | ".join(f"{times(row.numbers[kind + '_rms'], row.cfd_rms)} | "
                                  f"{times(row.numbers[kind + '_time'], row.cfd_time)}" for kind in ("seen-fluid", "wake")) + " |")
    return "\n".join(lines) + "\n"


def factor(ratios):
    """The geometric mean of by how much they are off, up or down."""
    return math.exp(math.sqrt(sum(math.log(ratio) ** 2 for ratio in ratios) / len(ratios)))


def table_of_sums(rows):
    lines = ["| loads of | model | rms over CFD's, median | off by a factor of | within 30 % | lasting over CFD's, median | off by | within a factor of 1.5 |",
             "|---" * 8 + "|"]
    groups = {"the choice": FITTED, "the test": [case for case in CASES if case not in FITTED]}
    groups |= {f"of it the {body}": [case for case in groups["the test"] if CASES[case][0] == body]
               for body in ("cube", "box", "spheroid", "disc", "ellipsoid")}
    for group, cases in groups.items():
        some = [row for row in judged(rows) if row.case in cases]
        if not some:
            continue
        for kind, title in (("seen-fluid", "the stream"), ("wake", "the wake")):
            rms = [row.numbers[kind + "_rms"] / row.cfd_rms for row in some]
            lasting = [row.numbers[kind + "_time"] / row.cfd_time for row in some]
            lines.append(f"| {group} | {title} | {statistics.median(rms):.2g} | {factor(rms):.2g} | "
                         f"{sum(abs(x - 1) <= 0.3 for x in rms)} of {len(some)} | {statistics.median(lasting):.2g} | {factor(lasting):.2g} | "
                         f"{sum(1 / 1.5 <= x <= 1.5 for x in lasting)} of {len(some)} |")
    some = [row for row in judged(rows) if row.case in COARSER]
    rms, lasting = ([getattr(row, f"coarser_{what}") / getattr(row, f"cfd_{what}") for row in some] for what in ("rms", "time"))
    lines.append(f"| {', '.join(COARSER)} | full CFD, cells twice as wide | {statistics.median(rms):.2g} | {factor(rms):.2g} | "
                 f"{sum(abs(x - 1) <= 0.3 for x in rms)} of {len(some)} | {statistics.median(lasting):.2g} | {factor(lasting):.2g} | "
                 f"{sum(1 / 1.5 <= x <= 1.5 for x in lasting)} of {len(some)} |")
    return "\n".join(lines) + "\n"


def table_of_meshes(rows):
    lines = ["| case | load | rms | with cells twice as wide | lasts, L/U | with cells twice as wide |", "|---" * 6 + "|"]
    for row in judged(rows):
        if row.case in COARSER:
            lines.append(f"| {row.case} | {row.title} | {row.cfd_rms:.2g} +- {row.cfd_rms_error:.1g} | {row.coarser_rms:.2g} +- {row.coarser_rms_error:.1g} | "
                         f"{row.cfd_time:.2g} | {row.coarser_time:.2g} |")
    return "\n".join(lines) + "\n"


def main(programs, work, names):
    os.makedirs(work, exist_ok=True)
    only_flown = "--flown" in names
    for name in [] if only_flown else names or CASES:
        solve(work, name)
        if name in COARSER:
            solve(work, name, True)
    if names and not only_flown:
        return
    kept, kept_spectra = rows_kept(ROWS), rows_kept(SPECTRA_ROWS)
    known = {row["case"] for row in kept}
    os.makedirs(os.path.dirname(ROWS), exist_ok=True)
    with open(ROWS, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading())
        for name in CASES:
            if name in known or is_solved(folder_of(work, name)):
                writer.writerows(rows_of(programs, work, name, kept))
    with open(SPECTRA_ROWS, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "component", "model", "frequency", "power"])
        writer.writerows(spectra_rows(programs, work, kept_spectra))


if __name__ == "__main__":
    if len(sys.argv) == 2:
        sys.exit(__doc__)
    if len(sys.argv) > 2:
        main(sys.argv[1], sys.argv[2], sys.argv[3:])
    if len(sys.argv) < 4 or "--flown" in sys.argv:
        draw_spectra()
        found = read_rows()
        write_tables(PAGE, [table_of_cases(found), table_of_meshes(found), table_of_loads(found, True),
                            table_of_loads(found, False), table_of_sums(found)], mark("noise"))
