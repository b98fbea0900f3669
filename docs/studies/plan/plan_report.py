#!/usr/bin/python3
"""What baking only what a scene needs saves: its rounds beside uniform grids of directions.

    plan_report.py BIN WORK ROWS.csv    bakes the scenes of docs/studies/plan in the folder WORK, or goes on there
    plan_report.py ROWS.csv             only writes the tables of README.md and the picture beside the rows again

BIN: the folder of the programs. Run from the project's folder. For each scene: the bake in rounds; then every
direction that it might have solved, on the same meshes, as the truth; then uniform grids of these directions.
Each set of tables flies the scene 32 times and is held against the truth by `samara compare`.
"""

import csv
import glob
import itertools
import json
import os
import shutil
import subprocess
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from report_tables import mark, write_tables  # noqa: E402
from study_pictures import picture_of  # noqa: E402

SCENES = "docs/studies/plan"
BODIES = ("sphere", "ellipsoid", "sheet", "airplane", "samara", "leaf")
FIGURES = ("descent_speed", "frequency", "inclination_amplitude", "rms_angular_speed")
SHARES = dict(zip(FIGURES, (1, 2, 3, 3)))
RUNS = "32"


def run(words):
    """What a program prints as JSON; its one line of error goes on."""
    return json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout)


def kept(file, make):
    """The JSON in a file, made if it is not there yet."""
    if not os.path.exists(file):
        made = make()
        with open(file + ".part", "w") as part:
            json.dump(made, part)
        os.replace(file + ".part", file)
    with open(file) as opened:
        return json.load(opened)


def baked(programs, work, body, kind, options):
    folder = os.path.join(work, kind)
    os.makedirs(folder, exist_ok=True)
    words = [f"{programs}/samara", "bake", f"{SCENES}/{body}.toml", "-o", folder, "--json"] + options
    return kept(os.path.join(folder, f"{body}.json"), lambda: run(words)["bodies"][0])


def read(*path):
    with open(os.path.join(*path)) as file:
        return json.load(file)


def subdivisions_of(directions):
    """The least of 1, 2, 4, 8 whose octahedral map has the direction as a node."""
    for n in (1, 2, 4, 8):
        scaled = [n * x / sum(abs(y) for y in directions) for x in directions]
        if all(abs(x - round(x)) < 1e-6 for x in scaled):
            return n
    return 16


def subset(cases, target, chosen):
    """A folder like `cases` with the chosen directions alone: links to what is solved there."""
    shutil.rmtree(target, ignore_errors=True)
    os.makedirs(target)
    plan = read(cases, "plan.json")
    main = plan["cases"][0]["reynolds_number"]
    plan["cases"] = [case for case in plan["cases"]
                     if case["reynolds_number"] == main and chosen(case["direction"])]
    plan["covers"] = "scene"
    for name in os.listdir(cases):
        if name != "plan.json":
            source, copy = os.path.join(cases, name), os.path.join(target, name)  # links to elsewhere are not followed
            if os.path.isdir(source):
                shutil.copytree(source, copy, symlinks=True, copy_function=os.link)
            else:
                os.link(source, copy)
    with open(os.path.join(target, "plan.json"), "w") as file:
        json.dump(plan, file)
    return plan


def seconds_of(cases, plan):
    """CPU seconds of a plan's meshes and cases by their records, and of the cases alone."""
    meshes = sum(read(cases, mesh["name"], "mesh.json")["cpu_seconds"] for mesh in plan["meshes"])
    solved = sum(read(cases, case["name"], "provenance.json")["cpu_seconds"] for case in plan["cases"])
    return meshes + solved, solved


def flown(programs, work, body, body_file, name):
    """The motion of the scene with a body file."""
    bodies = os.path.join(work, "flights", name)
    os.makedirs(bodies, exist_ok=True)
    link = os.path.join(bodies, f"{body}.body.h5")
    if os.path.lexists(link):
        os.remove(link)
    os.symlink(os.path.abspath(body_file), link)
    motion = os.path.join(bodies, f"{body}.h5")
    subprocess.run([f"{programs}/samara", "simulate", f"{SCENES}/{body}.toml", "-o", motion, "--bodies", bodies,
                    "--runs", RUNS, "--json"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return motion


def compared(programs, motion, truth):
    result = run([f"{programs}/samara", "compare", motion, truth, "--json"])
    differences = {}
    for figure in FIGURES:
        measure = result["measures"].get(figure) or {}
        value = (measure.get("reference") or {}).get("value")
        if measure.get("relative_difference") is None or not value:
            continue
        differences[figure] = (measure["relative_difference"], (measure.get("difference_error") or 0.0) / abs(value))
    if not result.get("judges_inclination", True):
        differences = {name: value for name, value in differences.items() if name == "descent_speed"}
    return differences, result["motion"]["regime"], result["reference"]["regime"]


def report(programs, work, target):
    rows = [["body", "set", "directions", "without_symmetry", "cases", "cpu_seconds"] +
            [f"{figure}_{what}" for figure in FIGURES for what in ("difference", "chance", "stated")] +
            ["worst", "worst_chance", "regime", "regime_of_all", "stopped_because"]]
    for body in BODIES:
        plan = baked(programs, work, body, "plan", ["--quality", "preview"])
        everything = os.path.join(work, "all")
        if not os.path.exists(os.path.join(everything, f"{body}.json")):
            os.makedirs(everything, exist_ok=True)
            cases = os.path.join(everything, f"{body}.cases")
            if not os.path.exists(cases):
                shutil.copytree(os.path.join(work, "plan", f"{body}.cases"), cases, symlinks=True)
        whole = baked(programs, work, body, "all",
                      ["--quality", "preview", "--whole-grid"])
        cases = os.path.join(everything, f"{body}.cases")
        truth = flown(programs, work, body, os.path.join(everything, f"{body}.body.h5"), "all")

        def row_of(name, file, counts, number_of_cases, seconds, stated):
            differences, regime, of_all = compared(programs, flown(programs, work, body, file, name), truth)
            row = [body, name, *counts, number_of_cases, f"{seconds:.0f}"]
            for figure in FIGURES:
                difference = differences.get(figure)
                row += [f"{difference[0]:.4f}", f"{difference[1]:.4f}"] if difference else ["", ""]
                row.append(f"{stated[figure]['error_of_table']:.4f}" if figure in stated else "")
            # In what the descent speed's tolerance is to the others': 1, 2, 3 and 3 times.
            worst = max(abs(differences[figure][0]) / share for figure, share in SHARES.items() if figure in differences)
            chance = max(differences[figure][1] / share for figure, share in SHARES.items() if figure in differences)
            return row + [f"{worst:.4f}", f"{chance:.4f}", regime, of_all]

        last = plan["plan"]["rounds"][-1]
        rows.append(row_of("plan", os.path.join(work, "plan", f"{body}.body.h5"), (last["directions"], ""),
                           last["cases"], plan["cpu_seconds"], last["measures"]) + [plan["plan"]["stopped_because"]])
        print(*rows[-1])
        directions = [case["direction"] for case in read(cases, "plan.json")["cases"]]
        finest = max(subdivisions_of(direction) for direction in directions)
        for n in itertools.takewhile(lambda n: n <= finest, (1, 2, 4, 8)):
            folder = os.path.join(work, "grids", f"{body}-{n}.cases")
            chosen = subset(cases, folder, lambda direction: subdivisions_of(direction) <= n)
            file = os.path.join(work, "grids", f"{body}-{n}.body.h5")
            subprocess.run([f"{programs}/samara", "convert", folder, "-o", file, "--json"], check=True,
                           stdout=subprocess.DEVNULL)
            count = len({tuple(case["direction"]) for case in chosen["cases"]})
            rows.append(row_of(f"grid_{n}", file, (count, 4 * n * n + 2), len(chosen["cases"]), seconds_of(cases, chosen)[0], {}) +
                        [""])
            print(*rows[-1])
    with open(target, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    write(target)
    print(f"Written: {target}")


def percent(row, figure):
    """A set's difference from the truth, with what chance makes of it and what was stated."""
    if not row[f"{figure}_difference"]:
        return "-"
    text = f"{100 * float(row[f'{figure}_difference']):+.1f} +- {100 * float(row[f'{figure}_chance']):.1f} %"
    stated = row[f"{figure}_stated"]
    return text + (f" ({100 * float(stated):.1f})" if stated else "")


def holds(row):
    """How many of the measures keep within two of their stated errors, chance included; and of how many."""
    kept = 0
    measures = [figure for figure in FIGURES if row[f"{figure}_difference"]]
    for figure in measures:
        stated, chance = float(row[f"{figure}_stated"] or 0.0), float(row[f"{figure}_chance"])
        kept += abs(float(row[f"{figure}_difference"])) <= 2.0 * (stated ** 2 + chance ** 2) ** 0.5
    return kept, len(measures)


def write(target):
    """The tables of README.md beside the rows, and its picture."""
    with open(target, newline="") as file:
        rows = list(csv.DictReader(file))
    lines = ["| body | set | directions | CPU s | descent | frequency | amplitude | rms angular speed | regime |",
             "|---" * 9 + "|"]
    summary = ["| body | what the scene needs: directions, CPU s | all directions, after symmetry | without symmetry | "
               "share of their CPU s | worst measure off, with its chance | stated errors hold | "
               "the cheapest uniform grid as good |", "|---" * 8 + "|"]
    kept, measured = 0, 0
    for body in BODIES:
        of_body = [row for row in rows if row["body"] == body]
        for row in of_body:
            lines.append(f"| {body} | {row['set'].replace('_', ' ')} | {row['directions']} | {row['cpu_seconds']} | " +
                         " | ".join(percent(row, figure) for figure in FIGURES) + f" | {row['regime']} |")
        if not of_body:
            continue
        plan, grids = of_body[0], of_body[1:]
        allowed = float(plan["worst"]) + 2.0 * float(plan["worst_chance"])
        good = next(row for row in grids if float(row["worst"]) <= allowed or row is grids[-1])
        whole = grids[-1]
        alone = float(whole["cpu_seconds"]) * int(whole["without_symmetry"]) / int(whole["directions"])
        now = holds(plan)
        kept, measured = kept + now[0], measured + now[1]
        needed = float(plan["cpu_seconds"])
        summary.append(f"| {body} | {plan['directions']}, {plan['cpu_seconds']} | {whole['directions']}, "
                       f"{whole['cpu_seconds']} | {whole['without_symmetry']}, {alone:.0f} | "
                       f"{100 * needed / float(whole['cpu_seconds']):.0f} %; {100 * needed / alone:.0f} % | "
                       f"{100 * float(plan['worst']):.1f} +- {100 * float(plan['worst_chance']):.1f} % | "
                       f"{now[0]} of {now[1]} | {good['directions']}, {good['cpu_seconds']} |")
    summary.append(f"| together | | | | | | {kept} of {measured} | |")
    write_tables(os.path.join(os.path.dirname(target), "README.md"), ["\n".join(summary) + "\n", "\n".join(lines) + "\n"],
                 mark("plan"))
    picture = target.replace(".csv", "")
    picture_of("plan", target, f"{picture}.png")


def main():
    if len(sys.argv) == 2:
        write(sys.argv[1])
    elif len(sys.argv) == 4:
        report(*sys.argv[1:])
    else:
        sys.exit(__doc__.strip())


if __name__ == "__main__":
    main()
