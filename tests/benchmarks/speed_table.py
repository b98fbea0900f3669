#!/usr/bin/env python3
"""Prints what samara's work costs on this machine, each row beside what a user would take instead, or beside the floor, measured in
the same run.

    speed_table.py BUILD    # a build folder with the programs and samara-benchmarks

Times are CPU times, the least of some repetitions. A row whose peer is not installed says so.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BENCHMARKS = "^(step_with_tables_and_noise|(single_)?batch_on_one_core/4096/real_time|slide_on_ground|slide_on_sheet/20|mujoco_step|bullet_.*)$"


def ready(settings: str, fluid: str, body: str, rest: str) -> str:
    """A scene of a ready-baked body."""
    return f'[scene]\n{settings}\n[fluid]\npreset = "{fluid}"\n[[body]]\nname = "{body}"\nshape = "samara:{body}"\n{rest}\n'


FALL = ready("duration = 4.0", "water", "ellipsoid", "density = 1200\norientation = [0.9, 0.3, 0.2, 0.1]")
CROWD = ready("duration = 0.5\nstep = 0.01666666666666\nframe_rate = 60", "air", "leaf",
              "position = [0, 0, 50]\ncount = 100000\nspread = { position = [50, 50, 10], angle = 3.1 }")
CROWD_FRAMES = 30
# Of the shapes that come with samara, those with the most edges and the thinnest.
SHAPES = ("sheet", "samara", "maple-leaf", "airplane")


class Bench:
    def __init__(self, build: pathlib.Path, work: pathlib.Path):
        self.bin = (build / "bin").resolve()
        self.work = work
        self.rows: list[tuple[str, ...]] = []

    def cpu(self, *words: str, repeats: int = 3) -> tuple[float, dict]:
        """The least CPU seconds of a command, its children's included, and the JSON that it prints."""
        least, printed = float("inf"), {}
        for _ in range(repeats):
            with tempfile.TemporaryFile() as output:
                process = subprocess.Popen([str(self.bin / words[0]), *words[1:]], stdout=output, stderr=subprocess.DEVNULL, cwd=self.work)
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                if process.returncode != 0:
                    raise SystemExit(f"speed_table: {' '.join(words)} failed; run it alone to see why")
                output.seek(0)
                text = output.read()
            least = min(least, usage.ru_utime + usage.ru_stime)
            printed = json.loads(text) if text.startswith(b"{") else {}
        return least, printed

    def scene(self, name: str, text: str) -> str:
        (self.work / name).write_text(text, encoding="utf-8")
        return name

    def row(self, work: str, value: str, beside: str, ratio: float | None, reach: str) -> None:
        self.rows.append((work, value, beside, "-" if ratio is None else f"{ratio:.3g}", reach))
        print(f"speed_table: {work}: {value}", file=sys.stderr)


def of_steps(bench: Bench) -> dict[str, float]:
    """The nanoseconds of an iteration of each benchmark."""
    run = subprocess.run([str(bench.bin / "samara-benchmarks"), f"--benchmark_filter={BENCHMARKS}", "--benchmark_repetitions=3",
                          "--benchmark_min_time=0.2", "--benchmark_format=json"], capture_output=True, text=True, check=True)
    times: dict[str, float] = {}
    for one in json.loads(run.stdout)["benchmarks"]:
        if one["run_type"] != "iteration":
            continue
        unit = {"ns": 1.0, "us": 1e3, "ms": 1e6}[one["time_unit"]]
        times[one["run_name"]] = min(times.get(one["run_name"], float("inf")), one["cpu_time"] * unit)
    return times


def step_rows(bench: Bench, times: dict[str, float]) -> None:
    def beside(peer: str, name: str, value: float, unit: float, word: str) -> tuple[str, float | None]:
        if name not in times:
            return f"{peer} is not installed", None
        return f"{peer}: {times[name] / unit:.3g} {word}", value / times[name]

    step = times["step_with_tables_and_noise"]
    bench.row("a step with tables and noise", f"{step / 1e3:.3g} us", *beside("MuJoCo, implicit", "mujoco_step", step, 1e3, "us"), "0.25 us")
    for title, kind in (("", ""), (", single precision", "single_")):
        crowd = times[kind + "batch_on_one_core/4096/real_time"] / (8 * 4096)
        bench.row(f"a step in a crowd{title}, a core", f"{1e3 / crowd:.3g} million/s", f"alone: {1e3 / step:.3g} million/s", crowd / step,
                  "50 million/s")
    for name, title, peer in (("slide_on_ground", "a body sliding on the ground", "bullet_slide_on_sheet/1"),
                              ("slide_on_sheet/20", "the same on 800 triangles", "bullet_slide_on_sheet/20")):
        bench.row(title + ", a step", f"{times[name] / 1e3:.3g} us", *beside("Bullet", peer, times[name], 1e3, "us"), "3 us")
    heap, _ = bench.cpu("samara", "simulate", str(SOURCE / "docs/scenes/heap.toml"), "-o", "heap.h5", "--threads", "1", repeats=1)
    bench.row("the heap of 60 leaves, 4 s", f"{heap:.3g} s", *beside("Bullet, hulls of 42 points, no fluid", "bullet_heap", 1e9 * heap, 1e9, "s"),
              "2 s")


def process_rows(bench: Bench) -> None:
    start, _ = bench.cpu("samara", "--version", repeats=10)
    for duration, reach in (("1.0", "15 ms"), ("4.0", "")):
        scene = bench.scene("one.toml", ready(f"duration = {duration}", "air", "leaf", "position = [0, 0, 50]"))
        run, _ = bench.cpu("samara", "simulate", scene, "-o", "one.h5", "--threads", "1", repeats=10)
        bench.row(f"samara simulate, {float(duration):.0f} s of a ready-baked leaf, from start to end", f"{1e3 * run:.3g} ms",
                  f"samara --version: {1e3 * start:.3g} ms", run / start, reach)


def crowd_row(bench: Bench) -> None:
    scene = bench.scene("crowd.toml", CROWD)
    seconds = []
    for _ in range(2):
        begin = time.perf_counter()
        bench.cpu("samara", "simulate", scene, "-o", "crowd.h5", repeats=1)
        seconds.append(time.perf_counter() - begin)
    size = (bench.work / "crowd.h5").stat().st_size
    block = b"\1" * (1 << 20)
    begin = time.perf_counter()
    with open(bench.work / "floor", "wb") as file:
        for _ in range(size >> 20):
            file.write(block)
        file.flush()
        os.fsync(file.fileno())
    floor = time.perf_counter() - begin
    million = CROWD_FRAMES / min(seconds) / 10
    bench.row("a million leaves, file to file, all cores", f"{million:.3g} frames/s", f"writing as many bytes: {CROWD_FRAMES / floor / 10:.3g} frames/s",
              min(seconds) / floor, "60 frames/s")
    for name in ("crowd.h5", "floor"):
        (bench.work / name).unlink()


def tensor_row(bench: Bench) -> None:
    times = {}
    for shape in SHAPES:
        bench.cpu("samara", "mesh", str(SOURCE / f"meshes/shapes/{shape}.geo"), "-o", f"{shape}.body.h5", repeats=1)
        times[shape], _ = bench.cpu("samara", "kirchhoff", f"{shape}.body.h5", "--json", repeats=1)
    worst = max(times, key=lambda shape: times[shape])
    _, ellipsoid = bench.cpu("samara", "kirchhoff", str(SOURCE / "meshes/shapes/ellipsoid.geo"), "--json", repeats=1)
    bench.row(f"samara kirchhoff, the slowest of {len(SHAPES)} shapes ({worst})", f"{times[worst]:.3g} CPU s",
              f"the ellipsoid of curved triangles: {ellipsoid['seconds']:.2g} s", times[worst] / ellipsoid["seconds"], "2 s")


def bake_rows(bench: Bench) -> None:
    shape = str(SOURCE / "meshes/shapes/ellipsoid.geo")
    _, plan = bench.cpu("samara-bake", shape, "-o", "e.body.h5", "--quality", "standard", "--dry-run", "--json", repeats=1)
    bench.row("standard bake of the ellipsoid, estimated", f"{plan['estimated_cpu_seconds']:.0f} CPU s",
              f"its longest chain of cases: {plan['longest_chain_seconds']:.0f} s",
              plan["estimated_cpu_seconds"] / plan["longest_chain_seconds"], "half, at equal error")
    scene = bench.scene("fall.toml", FALL)
    _, cfd = bench.cpu("samara-validate", scene, "-o", "v.h5", "--cells", "6000", "--dry-run", "--json", repeats=1)
    run, simulated = bench.cpu("samara", "simulate", scene, "-o", "s.h5", "--threads", "1", "--json")
    steps = simulated["steps"] * simulated["nanoseconds_per_step"] * 1e-9
    # Of the meshes of docs/studies/motion the coarsest whose error is the simulation's (docs/start/choose-a-model.md).
    bench.row("full CFD of 4 s of the rubber ellipsoid, 6,000 cells, estimated", f"{cfd['estimated_cpu_seconds']:.0f} CPU s",
              f"its simulation: {1e3 * steps:.3g} ms of steps, {1e3 * run:.3g} ms in all", cfd["estimated_cpu_seconds"] / steps, "stays")


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as work:
        bench = Bench(pathlib.Path(sys.argv[1]), pathlib.Path(work))
        step_rows(bench, of_steps(bench))
        process_rows(bench)
        crowd_row(bench)
        tensor_row(bench)
        bake_rows(bench)
    print("| work | measured | beside it | ratio | to reach |\n|---|---|---|---|---|")
    for row in bench.rows:
        print("| " + " | ".join(row) + " |")
    print("\nFrom a bare machine to the first picture: time ./dev demo there.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
