#!/usr/bin/env python3
"""The runtime against the reference falls, with its noise and without, and what each term of the loads does.

    falls_report.py BIN BODIES    bakes what is missing in BODIES, flies every scene and compares; then identifies
                                  anew without each term, and holds the falls again
    falls_report.py BIN BODIES keep
                                  identifies every body that was baked in BODIES anew from its falls, and keeps both in
                                  docs/studies/falls/bodies: with these the form of the loads can be changed without CFD
    falls_report.py BIN BODIES ready
                                  likewise the ready-baked bodies that `./dev bodies` has baked in BODIES, into runtime/bodies
                                  and docs/studies/falls/bodies/ready, from where it takes the falls where BODIES has none; ellipsoid
                                  and sheet from the falls of the references' bodies
    falls_report.py BIN BODIES FALL...
                                  bakes, flies and compares these falls alone; the rows of others stay as they are. As FALL,
                                  `range` is all those with bodies that are baked for a range of densities, `terms`,
                                  `fewer` and `repeats` all with bodies identified anew without each term, from fewer
                                  falls, and without each stretch of them
    falls_report.py               writes the tables again from the rows of the last run

Writes docs/studies/falls/falls.csv, range.csv, terms.csv, fewer.csv and repeats.csv, and the tables of README.md. BIN: the folder
of the programs; BODIES: a folder for baked bodies. Run from the project's folder.
"""

import csv
import glob
import io
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tarfile
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from report_tables import mark, write_tables  # noqa: E402

FALLS = "docs/studies/falls"
KEPT = f"{FALLS}/bodies"  # baked bodies and their falls
READY, READY_FALLS = "runtime/bodies", f"{KEPT}/ready"
READY_FROM_KEPT = ("ellipsoid", "sheet")  # their falls are those of BODIES
# The body of each scene: its shape, and what it is baked for. No body is baked from a reference fall.
BODIES = {
    "sphere": ("meshes/shapes/sphere.geo", ["--density", "1300"]),
    "ellipsoid": ("meshes/shapes/ellipsoid.geo", ["--density", "1200"]),
    "spheroid": (f"{FALLS}/spheroid.geo", ["--density", "1297.7"]),
    "disc-light": (f"{FALLS}/disc.geo", ["--density", "1497.3"]),
    "disc-heavy": (f"{FALLS}/disc.geo", ["--density", "11340"]),
    "plate": (f"{FALLS}/plate.geo", ["--density", "2700"]),
    "sheet": ("meshes/shapes/sheet.geo", ["--fluid", "air", "--density", "800"]),
    "disc-range": (f"{FALLS}/disc.geo", ["--density", "1497.3", "--density-to", "11340"]),
    "ellipsoid-range": ("meshes/shapes/ellipsoid.geo", ["--density", "1200", "--density-to", "2700"]),
    # Of the test falls.
    "box": ("docs/studies/test-falls/box.geo", ["--density", "1200", "--density-to", "7850"]),
    "thick-disc": ("docs/studies/test-falls/thick-disc.geo", ["--density", "1200", "--density-to", "7850"]),
}
SCENES = {
    "sphere": "sphere", "ellipsoid-tilted": "ellipsoid", "ellipsoid-compound": "ellipsoid",
    "ellipsoid-edgewise": "ellipsoid", "ellipsoid-heavy": "ellipsoid", "spheroid": "spheroid",
    "disc-light": "disc-light", "disc-heavy": "disc-heavy", "plate": "plate", "sheet": "sheet",
}
# Falls within the densities of one body file.
OF_A_RANGE = {"disc-light": "disc-range", "disc-heavy": "disc-range", "ellipsoid-tilted": "ellipsoid-range",
              "ellipsoid-compound": "ellipsoid-range", "ellipsoid-edgewise": "ellipsoid-range",
              "ellipsoid-heavy": "ellipsoid-range"}
TERMS = ("transport", "rotational transport", "drag in motion", "drag in spin", "rotational drag",
         "rotational drag in spin", "unsteady factor")
# As users fly them, with noise; and without.
RUNS = {"on": 20, "off": 1}
RANGE_ROWS, REPEATS = f"{FALLS}/range.csv", f"{FALLS}/repeats.csv"
# What bodies are identified from.
FEWER = {"the gentle fall": ["fall_00"], "the oblique fall": ["fall_01"], "both": None}
STRETCHES = 6  # of a fall; identified is from all of them, and without each
# Narrower limits than those of `samara compare`: of descent, frequency, amplitude and rms angular speed.
NARROW = (0.05, 0.15, 0.25, 0.25)
FIGURES = ("descent_speed", "frequency", "inclination_amplitude", "rms_angular_speed")


def run(words):
    """What a program prints as JSON; its one line of error goes on."""
    return json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout)


def baked_file(folder, body):
    return os.path.join(folder, f"{body}.body.h5")


def kept_falls(body, folder=KEPT):
    """The archive of what was solved of a body's falls, which is kept so that a form of the loads costs no CFD to try."""
    return f"{folder}/{body}.falls.tar.xz"


def falls_of(body, cases, archives=KEPT):
    """The folders of the body's falls in its cases, separated by commas; they are unpacked where there are no cases."""
    if not os.path.isdir(cases) and os.path.exists(kept_falls(body, archives)):
        with tarfile.open(kept_falls(body, archives)) as archive:
            archive.extractall(cases)
    names = sorted(name for name in os.listdir(cases) if name.startswith("fall_")) if os.path.isdir(cases) else []
    return ",".join(os.path.join(cases, name) for name in names)


def baked(programs, folder, body):
    """The baked body's file in the folder and its falls, separated by commas: where it has none those of KEPT, or
    the ready-baked one."""
    shape, options = BODIES[body]
    file = baked_file(folder, body)
    kept = [baked_file(place, body) for place in (KEPT, READY) if os.path.exists(baked_file(place, body))]
    cases = os.path.join(folder, f"{body}.cases")
    if not os.path.exists(file) and kept:
        shutil.copyfile(kept[0], file)  # where other reports look for it
    elif not os.path.exists(file):
        run([f"{programs}/samara", "bake", shape, "-o", file, "--quality", "standard", "--json"] + options)
    return file, falls_of(body, cases)


def rounded(text):
    """A history of OpenFOAM's with its numbers to eight digits."""
    return re.sub(r"-?\d+\.\d+(e[-+]\d+)?", lambda number: f"{float(number.group()):.8g}", text)


def pack(falls, target):
    """Writes what was solved of the falls into the archive."""
    with tarfile.open(target, "w:xz", preset=9) as archive:
        for fall in falls.split(","):
            histories = glob.glob("postProcessing/*/*/*.dat", root_dir=fall)
            for name in ["fall.json", "attempts.json", *sorted(histories)]:
                with open(os.path.join(fall, name), encoding="utf-8") as opened:
                    content = rounded(opened.read()) if name in histories else opened.read()
                entry = tarfile.TarInfo(f"{os.path.basename(fall)}/{name}")
                entry.size = len(content.encode())
                archive.addfile(entry, io.BytesIO(content.encode()))


def identify_from_kept(programs, file, body, folder, target, archives=KEPT):
    """Writes the body identified from the falls of its archive."""
    with tempfile.TemporaryDirectory(dir=folder) as work:
        falls = falls_of(body, os.path.join(work, f"{body}.cases"), archives)
        identified = os.path.join(work, f"{body}.body.h5")
        run([f"{programs}/samara", "identify", file, falls, "-o", identified, "--json"])
        shutil.copyfile(identified, target)


def keep(programs, folder):
    """Identifies each body of the folder anew, and writes it and what was solved of its falls into KEPT."""
    for body in BODIES:
        if not os.path.exists(baked_file(folder, body)):
            continue
        file, falls = baked(programs, folder, body)
        if not falls:
            continue
        target = baked_file(KEPT, body)
        pack(falls, kept_falls(body))
        # From the archive, to the last bit as it is from there later: the solution may turn on its rounding.
        identify_from_kept(programs, file, body, folder, target)
        shutil.copyfile(target, file)
        print(f"Written: {target}, {kept_falls(body)}")


def keep_ready(programs, folder):
    """Likewise each ready-baked body; those without falls of their own are only copied."""
    os.makedirs(READY_FALLS, exist_ok=True)
    for target in sorted(glob.glob(f"{READY}/*.body.h5")):
        body = os.path.basename(target).removesuffix(".body.h5")
        file = baked_file(folder, body) if os.path.exists(baked_file(folder, body)) else target
        falls = falls_of(body, os.path.join(folder, f"{body}.cases"), READY_FALLS)
        if body in READY_FROM_KEPT:
            identify_from_kept(programs, file, body, folder, target)
        elif falls:
            pack(falls, kept_falls(body, READY_FALLS))
            identify_from_kept(programs, file, body, folder, target, READY_FALLS)
        elif file != target:
            shutil.copyfile(file, target)
        else:
            continue
        print(f"Written: {target}")


def scene_with(scene, keys, folder, steps=1, falls=FALLS):
    """Writes the scene of a fall (of the folder `falls`) with other keys of its body, and with so many steps made one, into
    the folder; its path."""
    with open(f"{falls}/{scene}.toml") as opened:
        text = opened.read()
    for key, value in keys.items():
        text = re.sub(rf"(?m)^{key} = .*\n?", "", text).rstrip() + f'\n{key} = "{value}"\n'
    text = re.sub(r"step = ([0-9.]+)", lambda step: f"step = {steps * float(step.group(1)):.6g}", text)
    path = os.path.join(folder, f"{scene}.toml")
    with open(path, "w") as changed:
        changed.write(text)
    return path


def compared(programs, body_file, scene, folder, noise="off", falls=FALLS, more=None):
    """The comparison of a scene flown with a body, and with `more` keys of it, with its fall in full CFD, both of the folder
    `falls`."""
    keys = {"shape": os.path.abspath(body_file)} | ({"turbulence": "table"} if noise == "on" else {}) | (more or {})
    motion = os.path.join(folder, f"{scene}.h5")
    run([f"{programs}/samara", "simulate", scene_with(scene, keys, folder, falls=falls), "-o", motion, "--runs", str(RUNS[noise]),
         "--json"])
    return run([f"{programs}/samara", "compare", motion, f"{falls}/{scene}.h5", "--json"])


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
    return row + [apart["value"] if apart else None, "yes" if comparison["agrees_by_metrics"] else "no", comparison["judged_by"],
                  "yes" if comparison["agrees"] else "no", "yes" if comparison["certain"] else "no"]


def largest_miss(differences, wrong_regime):
    """Of figures that one of two falls has at least, their differences: one that the other has not, None, counts as all of
    itself, another regime as no less."""
    return max([1.0 if wrong_regime else 0.0] + [1.0 if difference is None else abs(difference) for difference in differences])


def worst_figure(comparison):
    """What a fall misses of its reference: the largest_miss() of its figures, none of them divided; of a sphere that of its
    descent alone."""
    is_judged = comparison["judges_inclination"]
    measures = [comparison["measures"].get(figure) or {} for figure in (FIGURES if is_judged else FIGURES[:1])]
    return largest_miss([measure.get("relative_difference") for measure in measures
                         if measure.get("motion") or measure.get("reference")],
                        is_judged and not comparison["regimes_agree"])


def percent(difference):
    return "-" if difference is None else f"{100 * difference:+.1f} %"


def differences_of(row):
    """Of the figures of a row of falls.csv, over the reference's; None where there is nothing to compare. A sphere, which
    has no frequency, has no axis either whose inclination could be measured."""
    differences = [float(row[f"{figure}_difference"]) if row[f"{figure}_difference"] else None for figure in FIGURES]
    if differences[FIGURES.index("frequency")] is None and row["fall"].startswith("sphere"):
        differences[FIGURES.index("inclination_amplitude")] = None
    return differences


def worst_of(row):
    """worst_figure() of a row of falls.csv."""
    is_judged = not row["fall"].startswith("sphere")
    figures = [figure for figure in (FIGURES if is_judged else FIGURES[:1]) if row[f"{figure}_runtime"] or row[f"{figure}_cfd"]]
    return largest_miss([float(row[f"{figure}_difference"]) if row[f"{figure}_difference"] else None for figure in figures],
                        is_judged and not has_the_regime(row))


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
    return ["fall", "noise", "regime_runtime", "regime_cfd"] + columns + ["first_swing_apart", "agrees", "judged_by", "agrees_as_judged", "certain"]


def written(target, rows):
    with open(target, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(
            [[f"{cell:.5g}" if isinstance(cell, float) else "" if cell is None else cell for cell in row]
             for row in rows])
    print(f"Written: {target}")


def fly(programs, folder, scenes):
    """Flies the scenes, with noise and without, and writes their rows into falls.csv."""
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


def fly_ranges(programs, folder):
    """Writes range.csv: falls with bodies that are baked for a range of densities."""
    with tempfile.TemporaryDirectory() as work:
        rows = [row_of(scene, noise, compared(programs, baked(programs, folder, body)[0], scene, work, noise))
                for noise in RUNS for scene, body in OF_A_RANGE.items()]
    written(RANGE_ROWS, [heading()] + rows)


def rows_of_falls(noise, table=f"{FALLS}/falls.csv"):
    with open(table, newline="") as file:
        return [row for row in csv.DictReader(file) if row["noise"] == noise]


def tables_of_falls():
    return [table_of_falls(rows_of_falls(noise, table)) for table in (f"{FALLS}/falls.csv", RANGE_ROWS) for noise in RUNS]


def table_of_falls(rows, who="runtime"):
    """A table of README.md, of rows of falls.csv; `who` was held against the references."""
    if not rows:
        return "Not flown yet.\n"
    lines = [f"| fall | descent | frequency | amplitude | rms angular speed | regime ({who} / reference) | worst metric "
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


def fly_anew(programs, folder, words=(), falls=None, noises=("off",)):
    """Every body but the sphere whose falls are there identified anew, with other options or from some of its falls alone:
    how well they predict those and what the bodies' falls cost in CPU seconds, both in the mean over the bodies, and for each
    noise the comparisons of their scenes."""
    scenes = {scene: body for scene, body in SCENES.items() if scene != "sphere"}
    files, errors, costs = {}, [], []
    with tempfile.TemporaryDirectory() as work:
        for body in sorted(set(scenes.values())):
            file, solved = baked(programs, folder, body)
            if not solved:
                scenes = {scene: of for scene, of in scenes.items() if of != body}
                continue
            chosen = [fall for fall in solved.split(",") if falls is None or os.path.basename(fall) in falls]
            files[body] = os.path.join(work, f"{body}.body.h5")
            command = [f"{programs}/samara", "identify", file, ",".join(chosen), "-o", files[body], "--json"]
            errors.append(run(command + list(words))["prediction_error"])
            costs.append(sum(cpu_seconds_of(fall) for fall in chosen))
        comparisons = [{scene: compared(programs, files[body], scene, work, noise) for scene, body in scenes.items()}
                       for noise in noises]
    return sum(errors) / len(errors), sum(costs) / len(costs), *comparisons


def cpu_seconds_of(fall):
    with open(os.path.join(fall, "attempts.json"), encoding="utf-8") as attempts:
        return json.load(attempts)["cpu_seconds"]


def fly_without_terms(programs, folder):
    """Writes terms.csv: how well bodies that are identified without a term predict their own falls, and which references
    agree."""
    rows = []
    for term in ("",) + TERMS:
        error, _, comparisons = fly_anew(programs, folder, ["--without", term] if term else [])
        verdicts = [f"{'yes' if comparison['agrees'] else 'no'} "
                    f"{100 * comparison['measures']['descent_speed']['relative_difference']:+.0f} %"
                    for comparison in comparisons.values()]
        rows.append([term or "nothing", error] + verdicts + [sum(verdict.startswith("yes") for verdict in verdicts)])
        print(rows[-1][0], f"{rows[-1][1]:.3f}", rows[-1][-1])
    written(f"{FALLS}/terms.csv", [["without", "prediction_error", *comparisons, "agree"]] + rows)


def summary_of(comparisons):
    """Of falls by the same identification: the worst metric in the mean, how many have the regime and agree, and by how much the
    descents are off in the mean."""
    falls = comparisons.values()
    descents = [abs(comparison["measures"]["descent_speed"]["relative_difference"]) for comparison in falls]
    return [sum(worst_figure(comparison) for comparison in falls) / len(falls),
            sum(comparison["regimes_agree"] for comparison in falls),
            sum(comparison["agrees_by_metrics"] for comparison in falls), sum(descents) / len(descents)]


def fly_fewer(programs, folder):
    """Writes fewer.csv: what bodies that are identified from fewer falls miss of the references."""
    rows = [["falls", "cpu_seconds", "prediction_error", "mean_worst_figure", "regimes", "agree", "references"]]
    for what, falls in FEWER.items():
        error, cost, comparisons = fly_anew(programs, folder, falls=falls)
        rows.append([what, cost, error, *summary_of(comparisons)[:3], len(comparisons)])
        print(*rows[-1])
    written(f"{FALLS}/fewer.csv", rows)


def fly_repeats(programs, folder):
    """Writes repeats.csv: what bodies identified from all of their falls, and without each stretch of them, miss of the
    references."""
    rows = [["without_stretch", "noise", "mean_worst_figure", "regimes", "agree", "descent", "references"]]
    for stretch in ("", *range(STRETCHES)):
        words = [] if stretch == "" else ["--without-stretch", str(stretch)]
        _, _, *by_noise = fly_anew(programs, folder, words, noises=RUNS)
        for noise, comparisons in zip(RUNS, by_noise):
            rows.append([stretch, noise, *summary_of(comparisons), len(comparisons)])
            print(*rows[-1])
    written(REPEATS, rows)


def table_of_repeats():
    """The table of README.md, of repeats.csv."""
    with open(REPEATS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| noise | worst metric | regimes | within 10, 20, 30 % | descent |", "|---" * 5 + "|"]
    for noise in ("off", "on"):
        of_noise = [row for row in rows if row["noise"] == noise]
        cells = []
        for column, scale, unit in (("mean_worst_figure", 100, " %"), ("regimes", 1, f" of {of_noise[0]['references']}"),
                                    ("agree", 1, f" of {of_noise[0]['references']}"), ("descent", 100, " %")):
            numbers = [scale * float(row[column]) for row in of_noise]
            error = statistics.stdev(numbers) / math.sqrt(len(numbers))
            cells.append(f"{statistics.mean(numbers):.1f} +- {error:.1f}{unit}")
        lines.append(f"| {noise} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def table_of_fewer():
    """The table of README.md, of fewer.csv."""
    with open(f"{FALLS}/fewer.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| identified from | CPU s a body | misses of its own | worst metric, mean | regime | within 10, 20, 30 % |",
             "|---" * 6 + "|"]
    lines += [f"| {row['falls']} | {float(row['cpu_seconds']):.0f} | {100 * float(row['prediction_error']):.1f} % "
              f"| {100 * float(row['mean_worst_figure']):.0f} % | {row['regimes']} of {row['references']} "
              f"| {row['agree']} of {row['references']} |" for row in rows]
    return "\n".join(lines) + "\n"


def table_of_terms():
    """The table of README.md, of terms.csv."""
    with open(f"{FALLS}/terms.csv", newline="") as file:
        heads, *rows = csv.reader(file)
    scenes = heads[2:-1]
    lines = ["| without | misses | " + " | ".join(scenes) + " | within 10, 20, 30 % |",
             "|---" * (len(scenes) + 3) + "|"]
    lines += ["| " + " | ".join([row[0], f"{100 * float(row[1]):.1f} %"] + row[2:]) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main(words):
    names = words[3:]
    if len(words) == 2 or not set(names) <= {*SCENES, "range", "terms", "fewer", "repeats", "keep", "ready"}:
        sys.stderr.write(__doc__)
        return 2
    if len(words) >= 3:
        programs, folder = words[1:3]
        os.makedirs(folder, exist_ok=True)
        if "keep" in names:
            keep(programs, folder)
        if "ready" in names:
            keep_ready(programs, folder)
        fly(programs, folder, [name for name in names if name in SCENES] if names else SCENES)
        if not names or "range" in names:
            fly_ranges(programs, folder)
        if not names or "terms" in names:
            fly_without_terms(programs, folder)
        if not names or "fewer" in names:
            fly_fewer(programs, folder)
        if not names or "repeats" in names:
            fly_repeats(programs, folder)
    write_tables(f"{FALLS}/README.md", [*tables_of_falls(), table_of_terms(), table_of_fewer(), table_of_repeats()], mark("falls"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
