#!/usr/bin/env python3
"""The runtime against the reference falls, with its noise and without, and what each term of the loads does.

    falls_report.py BIN BODIES    bakes what is missing in BODIES, flies every scene and compares; then identifies
                                  anew without each term, and holds the falls again
    falls_report.py BIN BODIES FALL...
                                  bakes, flies and compares these falls alone; the rows of others stay as they are
    falls_report.py               writes the tables again from the rows of the last run

Writes docs/falls/falls.csv and terms.csv, and the tables of docs/falls.md. BIN: the folder of the programs; BODIES: a
folder for baked bodies. Run from the project's folder.
"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile

from report_tables import mark, write_tables

FALLS = "docs/falls"
# The body of each scene: its shape, and what it is baked for. No body is baked from a reference fall.
BODIES = {
    "sphere": ("meshes/shapes/sphere.geo", ["--density", "1300"]),
    "ellipsoid": ("meshes/shapes/ellipsoid.geo", ["--density", "1200"]),
    "spheroid": (f"{FALLS}/spheroid.geo", ["--density", "1297.7"]),
    "disc-light": (f"{FALLS}/disc.geo", ["--density", "1497.3"]),
    "disc-heavy": (f"{FALLS}/disc.geo", ["--density", "11340"]),
    "plate": (f"{FALLS}/plate.geo", ["--density", "2700"]),
    "sheet": ("meshes/shapes/sheet.geo", ["--fluid", "air", "--density", "800"]),
}
SCENES = {
    "sphere": "sphere", "ellipsoid-tilted": "ellipsoid", "ellipsoid-compound": "ellipsoid",
    "ellipsoid-edgewise": "ellipsoid", "ellipsoid-heavy": "ellipsoid", "spheroid": "spheroid",
    "disc-light": "disc-light", "disc-heavy": "disc-heavy", "plate": "plate", "sheet": "sheet",
}
TERMS = ("transport", "turning transport", "drag in motion", "drag in spin", "rotational drag",
         "rotational drag in spin", "wake by velocity", "wake by turning", "entrained inertia", "unsteady factor")
# As users fly them, with noise; and without.
RUNS = {"on": 20, "off": 1}
# Narrower limits than those of `samara compare`: of descent, frequency, amplitude and rms angular speed.
NARROW = (0.05, 0.15, 0.25, 0.25)
FIGURES = ("descent_speed", "frequency", "inclination_amplitude", "rms_angular_speed")


def run(words):
    """What a program prints as JSON; its one line of fault goes on."""
    return json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout)


def baked_file(folder, body):
    return os.path.join(folder, f"{body}.body.h5")


def baked(programs, folder, body):
    """The baked body's file and its falls, separated by commas."""
    shape, options = BODIES[body]
    file = baked_file(folder, body)
    if not os.path.exists(file):
        run([f"{programs}/samara", "bake", shape, "-o", file, "--quality", "standard", "--json"] + options)
    cases = os.path.join(folder, f"{body}.cases")
    falls = sorted(name for name in os.listdir(cases) if name.startswith("fall_")) if os.path.isdir(cases) else []
    return file, ",".join(os.path.join(cases, name) for name in falls)


def scene_with(scene, keys, folder, steps=1):
    """Writes a reference's scene with other keys of its body, and with so many steps made one, into the folder; its path."""
    with open(f"{FALLS}/{scene}.toml") as opened:
        text = opened.read()
    for key, value in keys.items():
        text = re.sub(rf"(?m)^{key} = .*\n?", "", text).rstrip() + f'\n{key} = "{value}"\n'
    text = re.sub(r"step = ([0-9.]+)", lambda step: f"step = {steps * float(step.group(1)):.6g}", text)
    path = os.path.join(folder, f"{scene}.toml")
    with open(path, "w") as changed:
        changed.write(text)
    return path


def compared(programs, body_file, scene, folder, noise="off"):
    """The comparison of a scene flown with a body with its reference fall."""
    keys = {"shape": os.path.abspath(body_file)} | ({"turbulence": "table"} if noise == "on" else {})
    motion = os.path.join(folder, f"{scene}.h5")
    run([f"{programs}/samara", "simulate", scene_with(scene, keys, folder), "-o", motion, "--runs", str(RUNS[noise]), "--json"])
    return run([f"{programs}/samara", "compare", motion, f"{FALLS}/{scene}.h5", "--json"])


def row_of(scene, noise, comparison):
    """The figures of a comparison: of the motion, of the reference, what they differ by, and what the reference itself is
    uncertain by."""
    measures = comparison["measures"]
    row = [scene, noise, comparison["motion"]["regime"], comparison["reference"]["regime"]]
    for figure in FIGURES:
        measure = measures.get(figure) or {}
        of_motion, of_reference = measure.get("motion") or {}, measure.get("reference") or {}
        magnitude = abs(of_reference.get("value") or 0.0)
        row += [of_motion.get("value"), of_reference.get("value"), of_reference.get("error"),
                measure.get("relative_difference"),
                measure["reference_uncertainty"] / magnitude if magnitude and measure.get("reference_uncertainty") else None]
    apart = comparison["first_swing"]["path_distance"]
    return row + [apart["value"] if apart else None,
                  "yes" if comparison["agrees"] else "no"]


def worst_figure(comparison):
    """What a fall misses of its reference: the largest difference of its figures, none of them divided. A figure that one of
    the two has alone counts as all of itself, another regime as no less; a sphere has its descent alone."""
    figures = FIGURES if comparison["judges_inclination"] else FIGURES[:1]
    misses = [0.0 if comparison["regimes_agree"] or not comparison["judges_inclination"] else 1.0]
    for figure in figures:
        measure = comparison["measures"].get(figure) or {}
        if measure.get("motion") or measure.get("reference"):
            difference = measure.get("relative_difference")
            misses.append(1.0 if difference is None else abs(difference))
    return max(misses)


def percent(difference):
    return "-" if difference is None else f"{100 * difference:+.1f} %"


def differences_of(row):
    """Of the figures of a row of falls.csv, over the reference's; None where there is nothing to compare. A sphere, which
    has no frequency, has no axis either whose inclination could be measured."""
    differences = [float(row[f"{figure}_difference"]) if row[f"{figure}_difference"] else None for figure in FIGURES]
    if differences[FIGURES.index("frequency")] is None and row["fall"] == "sphere":
        differences[FIGURES.index("inclination_amplitude")] = None
    return differences


def worst_of(row):
    """The largest of a row's differences, none of them divided."""
    return max(abs(difference) for difference in differences_of(row) if difference is not None)


def has_the_regime(row):
    return row["regime_runtime"] == row["regime_cfd"]


def agrees(row):
    """Whether `samara compare` says so, and the regime is right: of a sphere it does not judge that."""
    return row["agrees"] == "yes" and has_the_regime(row)


def uncertainties_of(row):
    """What the reference is uncertain by in each figure, by its mesh and its closure together."""
    return [float(row[f"{figure}_uncertainty"] or 0.0) for figure in FIGURES]


def agrees_narrowly(row):
    return has_the_regime(row) and all(
        difference is None or abs(difference) - uncertainty <= limit
        for difference, uncertainty, limit in zip(differences_of(row), uncertainties_of(row), NARROW))


def heading():
    columns = [f"{figure}_{what}" for figure in FIGURES
               for what in ("runtime", "cfd", "cfd_error", "difference", "uncertainty")]
    return ["fall", "noise", "regime_runtime", "regime_cfd"] + columns + ["first_swing_apart", "agrees"]


def written(target, rows):
    with open(target, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(
            [[f"{cell:.5g}" if isinstance(cell, float) else "" if cell is None else cell for cell in row]
             for row in rows])
    print(f"Written: {target}")


def falls_table(programs, folder, scenes):
    """Flies the scenes and writes their rows into falls.csv; the tables of docs/falls.md, with noise and without."""
    with open(f"{FALLS}/falls.csv", newline="") as file:
        rows = {(row[0], row[1]): row for row in csv.reader(file)}
    with tempfile.TemporaryDirectory() as work:
        for noise in RUNS:
            for scene in scenes:
                file, _ = baked(programs, folder, SCENES[scene])
                rows[scene, noise] = row_of(scene, noise, compared(programs, file, scene, work, noise))
                print(*rows[scene, noise])
    written(f"{FALLS}/falls.csv", [heading()] + [rows[scene, noise] for noise in RUNS for scene in SCENES
                                                 if (scene, noise) in rows])
    return tables_of_falls()


def rows_of_falls(noise, table=f"{FALLS}/falls.csv"):
    with open(table, newline="") as file:
        return [row for row in csv.DictReader(file) if row["noise"] == noise]


def tables_of_falls():
    return [table_of_falls(rows_of_falls(noise)) for noise in RUNS]


def table_of_falls(rows, who="runtime"):
    """A table of docs/falls.md, of rows of falls.csv; `who` was held against the references."""
    if not rows:
        return "Not flown yet.\n"
    lines = [f"| fall | descent | frequency | amplitude | rms angular speed | regime ({who} / reference) | worst figure "
             "| within 10, 20, 30 % | within 5, 15, 25, 25 % |", "|---" * 9 + "|"]
    for row in rows:
        cells = [row["fall"]]
        for difference, uncertainty in zip(differences_of(row), uncertainties_of(row)):
            known = difference is not None and uncertainty > 0.0
            cells.append(percent(difference) + (f" ({100 * uncertainty:.0f})" if known else ""))
        cells += [f"{row['regime_runtime']} / {row['regime_cfd']}", f"{100 * worst_of(row):.0f} %",
                  "yes" if agrees(row) else "no", "yes" if agrees_narrowly(row) else "no"]
        lines.append("| " + " | ".join(cells) + " |")
    mean = sum(worst_of(row) for row in rows) / len(rows)
    lines.append(f"| mean, or within the limits | | | | | {sum(map(has_the_regime, rows))} of {len(rows)} "
                 f"| {100 * mean:.0f} % | {sum(map(agrees, rows))} of {len(rows)} "
                 f"| {sum(map(agrees_narrowly, rows))} of {len(rows)} |")
    return "\n".join(lines) + "\n"


def terms_table(programs, folder):
    """Writes terms.csv; the table of docs/falls.md. Every body but the sphere identified anew without each term: how well
    it predicts its own fall, and which references agree."""
    scenes = {scene: body for scene, body in SCENES.items() if body != "sphere"}
    rows = [["without", "prediction_error"] + list(scenes) + ["agree"]]
    with tempfile.TemporaryDirectory() as work:
        for term in ("",) + TERMS:
            errors, verdicts = [], []
            files = {}
            for body in sorted(set(scenes.values())):
                file, fall = baked(programs, folder, body)
                files[body] = os.path.join(work, f"{body}.body.h5")
                words = [f"{programs}/samara", "identify", file, fall, "-o", files[body], "--json"]
                identified = run(words + (["--without", term] if term else []))
                errors.append(identified["prediction_error"])
            for scene, body in scenes.items():
                comparison = compared(programs, files[body], scene, work)
                descent = comparison["measures"]["descent_speed"]["relative_difference"]
                verdicts.append(f"{'yes' if comparison['agrees'] else 'no'} {100 * descent:+.0f} %")
            agree = sum(verdict.startswith("yes") for verdict in verdicts)
            rows.append([term or "nothing", sum(errors) / len(errors)] + verdicts + [agree])
            print(rows[-1][0], f"{rows[-1][1]:.3f}", agree)
    written(f"{FALLS}/terms.csv", rows)
    return table_of_terms()


def table_of_terms():
    """The table of docs/falls.md, of terms.csv."""
    with open(f"{FALLS}/terms.csv", newline="") as file:
        heads, *rows = csv.reader(file)
    scenes = heads[2:-1]
    lines = ["| without | misses | " + " | ".join(scenes) + " | within 10, 20, 30 % |",
             "|---" * (len(scenes) + 3) + "|"]
    lines += ["| " + " | ".join([row[0], f"{100 * float(row[1]):.1f} %"] + row[2:]) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main(words):
    if len(words) == 2 or not set(words[3:]) <= set(SCENES):
        sys.stderr.write(__doc__)
        return 2
    if len(words) >= 3:
        os.makedirs(words[2], exist_ok=True)
        tables = [*falls_table(words[1], words[2], words[3:] or SCENES),
                  table_of_terms() if words[3:] else terms_table(words[1], words[2])]
    else:
        tables = [*tables_of_falls(), table_of_terms()]
    write_tables("docs/falls.md", tables, mark("falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
