#!/usr/bin/env python3
"""Counts the instructions of samara's work by valgrind and compares them with those of instructions.json: a speed that no other load on
the machine changes.

    instructions.py BUILD             # exit 1 where a count has grown by more than 3 %
    instructions.py BUILD --record    # write the file anew

BUILD is a build folder with the programs, of the release preset. valgrind has no AVX-512: the steps are those for AVX2.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
COUNTS = HERE / "instructions.json"
MOST = 1.03

AIR = '[fluid]\npreset = "air"\n'


def scene(duration: float, body: str, settings: str = "") -> str:
    return f"[scene]\nduration = {duration}\nframe_rate = 10\n{settings}\n{AIR}{body}"


def leaves(count: int, position: str) -> str:
    several = f"count = {count}\nspread = {{ angle = 3.1 }}\n" if count > 1 else ""
    return f'[[body]]\nname = "leaf"\nshape = "samara:leaf"\nposition = {position}\n{several}'


def stack(count: int) -> str:
    """Sheets on each other, each turned by 7 degrees: a heap of leaves is chaotic, and so is what its steps cost."""
    return "".join(f'[[body]]\nname = "sheet-{i}"\nshape = "samara:sheet"\nturbulence = "none"\n'
                   f"position = [0, 0, {0.001 * (i + 0.5)}]\nrotation = [0, 0, {7 * i}]\n" for i in range(count))


def by_difference(make, short: float, long: float, steps: int):
    """Scenes of two durations, and the steps of bodies that the longer one takes more."""
    return make(short), make(long), steps


# What a step takes, without the start of the program.
STEPS = {
    "a step of one leaf": by_difference(lambda t: scene(t, leaves(1, "[0, 0, 50]")), 0.5, 2.5, 1000),
    "a step in a crowd of 512 leaves": by_difference(lambda t: scene(t, leaves(512, "[0, 0, 50]")), 0.1, 0.2, 50 * 512),
    "the same in single precision": by_difference(
        lambda t: scene(t, leaves(512, "[0, 0, 50]"), 'precision = "single"'), 0.1, 0.2, 50 * 512),
    "a step of leaves that land": by_difference(lambda t: scene(t, leaves(8, "[0, 0, 0.08]"), "ground = 0"), 0.1, 0.3, 100 * 8),
    "a step of sheets in a stack that slides": by_difference(
        lambda t: scene(t, stack(10), "ground = 0\nbodies_collide = true\ngravity = [6, 0, -7]"), 0.2, 0.4, 100 * 10),
}


def executed(words: list[str], work: pathlib.Path) -> int:
    """The instructions of a program, without those of the confined process that reads its files."""
    log = work / "counts"
    log.unlink(missing_ok=True)
    run = subprocess.run(["valgrind", "--tool=callgrind", "--vgdb=no", f"--callgrind-out-file={log}", *words], cwd=work,
                         capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise SystemExit(f"instructions: {' '.join(words)} failed under valgrind: {run.stderr[-500:]}")
    found = re.search(r"^(?:totals|summary): (\d+)", log.read_text(encoding="utf-8"), re.MULTILINE)
    if not found:
        raise SystemExit("instructions: valgrind counted nothing")
    return int(found[1])


def counted(program: str, work: pathlib.Path) -> dict[str, int]:
    counts: dict[str, int] = {}

    def simulate(text: str) -> int:
        (work / "scene.toml").write_text(text, encoding="utf-8")
        return executed([program, "simulate", "scene.toml", "-o", "motion.h5", "--threads", "1"], work)

    for name, (short, long, steps) in STEPS.items():
        counts[name] = round((simulate(long) - simulate(short)) / steps)
        print(f"instructions: {name}: {counts[name]:,}", file=sys.stderr)
    counts["samara simulate, start to end"] = simulate(scene(0.01, leaves(1, "[0, 0, 50]")))
    subprocess.run([program, "mesh", str(SOURCE / "meshes/shapes/ellipsoid.geo"), "-o", "ellipsoid.body.h5", "--triangles", "100"], cwd=work, check=True,
                   capture_output=True)
    counts["samara kirchhoff, a ladder of flat triangles up to 1,568"] = executed([program, "kirchhoff", "ellipsoid.body.h5", "--threads", "1"], work)
    return counts


def main() -> int:
    words = sys.argv[1:]
    if not words or words[1:] not in ([], ["--record"]):
        print(__doc__, file=sys.stderr)
        return 2
    program = str((pathlib.Path(words[0]) / "bin/samara").resolve())
    with tempfile.TemporaryDirectory() as work:
        counts = counted(program, pathlib.Path(work))
    if words[1:]:
        COUNTS.write_text(json.dumps(counts, indent=2) + "\n", encoding="utf-8")
        return 0
    before = json.loads(COUNTS.read_text(encoding="utf-8"))
    more = 0
    print(f"{'instructions':<58} {'recorded':>14} {'now':>14}  ratio")
    for name, count in counts.items():
        ratio = count / before[name]
        more += ratio > MOST
        print(f"{name:<58} {before[name]:>14,} {count:>14,}  {ratio:.3f}{'  MORE' if ratio > MOST else ''}")
    if more:
        print(f"{more} counts have grown by more than {100 * (MOST - 1):.0f} %; if that is meant, record them: ./dev bench --instructions --record")
    return 1 if more else 0


if __name__ == "__main__":
    sys.exit(main())
