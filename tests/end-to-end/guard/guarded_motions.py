#!/usr/bin/env python3
"""Flies the guarded motions and compares the digests of their positions and orientations with guarded_motions.json.

    guarded_motions.py BUILD            # exit 1 where a motion's bytes differ from those of the file
    guarded_motions.py BUILD --record   # write the file anew

BUILD is a build folder with its programs, the Python module and the program guarded_motions. No body is meshed: every shape is a
ready-baked body, so that a digest depends on the steps alone.
"""

import argparse
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[2]
DIGESTS = HERE / "guarded_motions.json"

AIR = '[fluid]\npreset = "air"\n'
WATER = '[fluid]\npreset = "water"\n'


def scene(fluid: str, rest: str, duration: float = 2.0, settings: str = "") -> str:
    return f"[scene]\nduration = {duration}\n{settings}\n{fluid}\n{rest}"


def body(name: str, rest: str = "") -> str:
    return f'[[body]]\nname = "{name}"\nshape = "samara:{name}"\n{rest}\n'


# Scenes of docs/scenes, for so many seconds. Their shapes, where they would be meshed, are ready-baked here.
DOCUMENTED = {
    "compound-tilt": 3.0, "heap": 1.0, "leaves": 1.0, "paper-airplane": 2.0, "paper-airplane-equation-8": 2.0, "paper-airplane-still": 2.0,
    "pebble": 3.0, "roof": 2.0, "roof-crowd": 1.5, "roof-wind": 1.5, "rubber-ellipsoid": 3.0, "rubber-ellipsoid-inertia": 3.0, "samara": 1.0,
}
SHAPE_OF = {"ellipsoid.geo": "ellipsoid", "leaf.geo": "leaf", "samara.geo": "samara", "airplane.geo": "airplane"}

# Through the command: hard cases, noise, winds, sizes.
COMMANDED = {
    "bubble": scene(WATER, body("sphere", "density = 1.2"), 1.0),
    "spin": scene(WATER, body("ellipsoid", 'density = 1100\nangular_velocity = [10, 1000, 3]\nloads = "none"'), 1.0, "step = 0.0416666667"),
    "long-step": scene(AIR, body("sheet", "density = 800\ncount = 4\nspread = { angle = 3.1 }"), 8.0, "step = 0.2"),
    "coin": scene(WATER, body("disc", "density = 8900\norientation = [0.98, 0.2, 0, 0]\ncount = 6\nspread = { angle = 0.05 }"), 2.0, "ground = -0.5"),
    "noise-of-paper": scene(AIR, body("airplane", 'density = 800\nturbulence = "table"\nlangevin = "body-velocity"\nvelocity = [-1, 0, 0]'), 2.0, "seed = 11"),
    "gust": scene(WATER + "gust = { amplitude = [0.2, 0, 0], period = 0.9 }\ncurrent = [0.1, 0.05, 0]\n",
                  body("cube", "count = 5\nspread = { angle = 3.1, position = [0.2, 0, 0], size = [0.6, 1.7], start = 0.5 }")),
    "vortex-and-fan": scene(AIR + '[wind]\nvelocity = [0.5, 0, 0]\nprofile = { law = "power" }\n[[wind.vortex]]\ncirculation = 1.0\n'
                            "core = 0.2\n[[wind.fan]]\nposition = [-1, 0, 1]\ndirection = [1, 0, 0]\nspeed = 2\n",
                            body("leaf", "position = [0, 0, 2]\ncount = 8\nspread = { position = [0.3, 0.3, 0.1], angle = 3.1 }")),
    "no-added-mass": scene(AIR, body("leaf", 'added_mass = false\nloads = "coefficients"\ndrag_coefficient = 1.1\nturbulence = "none"')),
    "cubes-in-a-heap": scene(WATER, body("cube", "count = 9\nposition = [0, 0, 0.2]\nspread = { angle = 3.1 }"), 2.0,
                                   "ground = 0.0\nbodies_meet = true\nstep = 0.01"),
}


def text_of_documented(name: str, duration: float) -> str:
    lines = (SOURCE / "docs" / "scenes" / f"{name}.toml").read_text().splitlines()
    for i, line in enumerate(lines):
        if line.startswith("duration"):
            lines[i] = f"duration = {duration}"
        if "meshes/shapes/" in line:
            shape = line.split("meshes/shapes/")[1].split('"')[0]
            lines[i] = f'shape = "samara:{SHAPE_OF[shape]}"'
        lines[i] = lines[i].replace('"roof.obj"', json.dumps(str(SOURCE / "docs" / "scenes" / "roof.obj")))
    return "\n".join(lines) + "\n"


def digest(arrays) -> str:
    """Of arrays of doubles, one after the other, whatever their shapes."""
    import numpy

    sha = hashlib.sha256()
    for array in arrays:
        sha.update(numpy.ascontiguousarray(array, dtype="<f8").tobytes())
    return sha.hexdigest()[:32]


def digest_of_motion(motion) -> str:
    return digest(array for flown in motion.bodies for array in (flown.position, flown.orientation))


def by_command(build: pathlib.Path, folder: pathlib.Path):
    import samara

    scenes = {name: text_of_documented(name, duration) for name, duration in DOCUMENTED.items()} | COMMANDED
    for name, text in scenes.items():
        file, output = folder / f"{name}.toml", folder / f"{name}.h5"
        file.write_text(text)
        flown = subprocess.run([build / "bin" / "samara", "simulate", file, "-o", output, "--runs", "2"], capture_output=True, text=True)
        if flown.returncode != 0:
            sys.exit(f"{name}: {flown.stderr}")
        yield f"command: {name}", digest_of_motion(samara.Motion.read(output))


def by_c(build: pathlib.Path, folder: pathlib.Path):
    import numpy

    subprocess.run([build / "tests" / "end-to-end" / "guarded_motions", SOURCE / "runtime" / "bodies", folder], check=True)
    for file in sorted(folder.glob("*.poses")):
        poses = numpy.fromfile(file, "<f8").reshape(-1, 13)
        yield f"C: {file.stem.removeprefix('c-')}", digest([poses[:, :7]])


def by_python():
    import numpy
    import samara

    def text(fluid: str, rest: str, settings: str = ""):
        return samara.Scene.from_text(scene(fluid, rest, settings=settings))

    def fly(simulation, names, until, frames=24):
        seen = []
        start = simulation.time
        for i in range(1, frames + 1):
            simulation.advance(start + (until - start) * i / frames)
            for name in names:
                poses = simulation.poses(name)
                seen += [numpy.array(poses.position), numpy.array(poses.orientation)]
        return seen

    ellipsoids = body("ellipsoid", "count = 4\nspread = { position = [0.3, 0, 0], angle = 3 }")
    simulation = samara.Simulation(text(WATER, ellipsoids), runs=2, seed=3)
    simulation.add_force("ellipsoid", [0.01, 0, 0.02], run=1, copy=2)
    simulation.add_impulse("ellipsoid", [0, 0.01, 0], point=[0, 0, 0.1], copy=1)
    simulation.set_pose("ellipsoid", copy=0, angular_velocity=[30, 0, 1])
    seen = fly(simulation, ["ellipsoid"], 0.5)
    simulation.remove("ellipsoid", copy=3)
    simulation.set_ground(-0.5)
    simulation.set_wind({"velocity": [0.1, 0, 0]})
    yield "Python: pushed", digest(seen + fly(simulation, ["ellipsoid"], 1.5))

    simulation = samara.Simulation(text(AIR, body("leaf", "count = 10\nspread = { angle = 3 }"), "seed = 8"), threads=2)
    simulation.advance(0.4)
    state = simulation.state()
    seen = fly(simulation, ["leaf"], 1.0)
    simulation.set_state(state)
    yield "Python: played again", digest(seen + fly(simulation, ["leaf"], 1.0))

    crowd = body("samara", 'loads = "surface"\npatches = 2\ncount = 12\nspread = { position = [1, 1, 0], angle = 3, size = [0.8, 1.2] }')
    yield "Python: sizes and runs", digest_of_motion(samara.simulate(text(AIR, crowd), runs=3, seed=21, step=0.002, threads=2))

    met = body("disc", "count = 15\nposition = [0, 0, 0.3]\nspread = { position = [0.02, 0.02, 0.1], angle = 3 }")
    simulation = samara.Simulation(text(WATER, met, "ground = 0.0\nbodies_meet = true"))
    simulation.watch_contacts(True)
    yield "Python: discs in a heap", digest(fly(simulation, ["disc"], 2.0))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--record", action="store_true", help="write the digests again")
    chosen = parser.parse_args()
    build = chosen.build.resolve()
    sys.path.insert(0, str(build / "python"))
    os.environ["SAMARA_CACHE"] = "off"
    folder = pathlib.Path(tempfile.mkdtemp(prefix="guarded-motions-"))
    try:
        found = {}
        for motions in (by_command(build, folder), by_c(build, folder), by_python()):
            for name, value in motions:
                found[name] = value
                print(f"\r{len(found)} motions flown", end="", flush=True)
        print()
    finally:
        shutil.rmtree(folder)
    if chosen.record:
        DIGESTS.write_text(json.dumps(found, indent=2) + "\n")
        print(f"{DIGESTS.name} holds {len(found)} motions")
        return 0
    expected = json.loads(DIGESTS.read_text())
    others = [name for name in sorted(expected.keys() | found.keys()) if expected.get(name) != found.get(name)]
    for name in others:
        print(f"{name}: its bytes differ from those of guarded_motions.json")
    print(f"{len(expected) - len(others)} of {len(expected)} motions are the same to the byte")
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
