#!/usr/bin/env python3
"""A thousand odd scenes, made from sound ones by edits, through every command that takes a scene. Run by ctest.

    odd_scenes_test.py PROGRAMS [FIRST [COUNT]]   PROGRAMS: the folder of samara and its tools

Each command ends by itself, in bounded time and memory: with exit status 0 and one JSON object, or with exit status 1
and one line that says what is wrong; never by a signal, and never with both hands empty. What is said of a scene that
ends otherwise is printed with the scene's number and its text: give that number as FIRST, and 1 as COUNT, to see it again.
"""

import concurrent.futures
import copy
import json
import math
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

SCENES = 1000
MOST_MEMORY = 3 << 30  # bytes of address space
MOST_CPU_SECONDS = 20
MOST_SECONDS = 300  # the machine may be busy

# Each with the words that follow its scene; {} is a folder for its output.
COMMANDS = {
    "simulate": ("samara", "simulate", "-o", "{}/m.h5", "--threads", "1", "--json"),
    "search": ("samara", "search", "--target", "0,0,-1,100", "--tries", "2", "--threads", "1", "--json"),
    "plan": ("samara-plan", "--quality", "smoke", "--json"),
    "bake": ("samara-bake", "-o", "{}/baked", "--quality", "smoke", "--dry-run", "--json"),
    "validate": ("samara-validate", "-o", "{}/v.h5", "--dry-run", "--json"),
}
# Numbers that a sound scene has, wherever the command works them out.
FINITE = {"estimated_cpu_seconds", "estimated_cells", "estimated_bytes", "reynolds_number", "reynolds_numbers", "steps",
          "terminal_speed", "reference_length", "time_step"}

# What programs say of their progress where they take longer.
PROGRESS = re.compile(r"[a-z ]+: \d+ of \d+ [a-z]+(, about .* left)?$")

BODY = {"name": "body", "shape": "samara:disc", "density": 1500.0}


def base_scenes():
    """Sound scenes, as lists of tables [(header, entries), ...]."""
    scene = {"duration": 0.02, "step": 0.002, "frame_rate": 100}
    water = {"preset": "water"}
    yield [("[scene]", scene), ("[fluid]", water), ("[[body]]", dict(BODY))]
    yield [("[scene]", {**scene, "ground": 0.0}), ("[fluid]", {"preset": "air", "current": [0.2, 0.0, 0.0]}),
           ("[[body]]", {**BODY, "shape": "samara:leaf", "density": 400.0, "position": [0.0, 0.0, 1.0], "count": 3,
                         "spread": {"position": [0.1, 0.1, 0.0], "angle": 1.0}})]
    yield [("[scene]", scene), ("[fluid]", {"density": 1000.0, "viscosity": 1e-3,
                                            "gust": {"amplitude": [0.1, 0.0, 0.0], "period": 0.5}}),
           ("[[body]]", {**BODY, "shape": "samara:sphere", "loads": "coefficients", "turbulence": "constant",
                         "turbulent_kinetic_energy": 0.01, "dissipation_rate": 0.02, "velocity": [0.1, 0.0, 0.0]})]
    yield [("[scene]", {**scene, "bodies_collide": True}), ("[fluid]", water),
           ("[[body]]", {**BODY, "mass": 0.01, "density": None, "start": 0.01}),
           ("[[body]]", {**BODY, "name": "other", "shape": "samara:cube", "position": [0.0, 0.0, 0.2], "loads": "surface",
                         "turbulence": "none", "angular_velocity": [3.0, 0.0, 1.0]})]
    yield [("[scene]", scene), ("[fluid]", {"preset": "air"}),
           ("[wind]", {"velocity": [1.0, 0.0, 0.0], "profile": {"law": "log", "roughness": 0.03, "height": 2.0},
                       "gusts": {"rms": 0.3, "length": 1.5, "bands": 8}}),
           ("[[wind.vortex]]", {"position": [1.0, 0.0, 0.0], "circulation": 2.0, "core": 0.2}),
           ("[[wind.fan]]", {"position": [-2.0, 0.0, 0.5], "direction": [1.0, 0.0, 0.2], "speed": 3.0, "diameter": 0.4}),
           ("[[body]]", {**BODY, "shape": "samara:sheet", "density": 700.0, "position": [0.0, 0.0, 2.0]})]
    yield [("[scene]", {**scene, "duration": 0.08}), ("[fluid]", water),
           ("[[obstacle]]", {"name": "floor", "shape": "floor.obj", "position": [0.0, 0.0, -0.1], "friction": 0.4,
                             "keys": [{"time": 0.0}, {"time": 0.1, "position": [0.0, 0.0, -0.09]}]}),
           ("[[body]]", {**BODY, "shape": "samara:ellipsoid", "count": 4, "orientation": [0.8, 0.0, -0.6, 0.0],
                         "spread": {"size": [0.8, 1.25], "start": 0.02, "angle": 0.5},
                         "emitter": {"shape": "floor.obj", "position": [0.0, 0.0, 1.0], "offset": 0.05, "speed": 0.1}})]


NUMBERS = [0.0, -0.0, -1.0, 1.0, 5e-324, 1e-300, 1e-60, 1e-31, 1e-12, 1e-6, 1e-3, 0.01, 0.5, 2.0, 1e3, 1e6, 1e12, 1e18, 1e30,
           1e31, 1e300, 1.7e308, -1e30, math.inf, -math.inf, math.nan, 2 ** 31, 2 ** 63 - 1, -2 ** 63, 998.2, 1.204, 300, 3]
OTHERS = ["", "x", "samara:", "samara:none", "../none.obj", "auto", "none", "table", "\u202e", "a" * 300, True, False, [], {},
          [0.0, 0.0, 0.0], [1e30, -1e30, 1e-60], [math.nan, 0.0, 0.0], [1.0], [1.0, 2.0, 3.0, 4.0], [[1.0]], {"position": 1.0}]
MORE_KEYS = {
    "[scene]": ["ground", "gravity", "seed", "step", "duration", "frame_rate", "bodies_collide", "step_tolerance"],
    "[fluid]": ["density", "viscosity", "current", "gust", "preset"],
    "[[body]]": ["mass", "density", "center_of_mass", "inertia", "scale", "count", "spread", "start", "loads", "turbulence",
                 "added_mass", "dynamic_coefficients", "table_reynolds_number", "patches", "langevin", "drag_coefficient",
                 "position", "velocity", "angular_velocity", "orientation", "turbulent_kinetic_energy", "dissipation_rate"],
}
VECTORS = {"gravity", "current", "velocity", "angular_velocity", "position", "center_of_mass", "inertia", "axis", "direction",
           "amplitude"}


def some_number(draw):
    choice = draw.random()
    if choice < 0.6:
        return draw.choice(NUMBERS)
    if choice < 0.8:
        return 10.0 ** draw.uniform(-12, 12)
    return draw.choice([1, -1]) * 10.0 ** draw.uniform(-4, 4)


def some_value(draw, key, old):
    choice = draw.random()
    if choice < 0.15:
        return draw.choice(OTHERS)
    if key in VECTORS or isinstance(old, list):
        count = len(old) if isinstance(old, list) and old else 3
        vector = copy.deepcopy(old) if isinstance(old, list) and len(old) == count else [0.0] * count
        vector[draw.randrange(count)] = some_number(draw)
        return vector if choice < 0.7 else [some_number(draw) for _ in range(count)]
    if isinstance(old, int) and not isinstance(old, bool):
        return draw.choice([0, 1, 2, 7, -1, 100, 10 ** 9, 2 ** 31, 2 ** 63 - 1, old])
    if isinstance(old, float) and choice < 0.5:
        return old * 10.0 ** draw.uniform(-6, 6)
    return some_number(draw)


def tables_within(entries):
    """The table and those within it."""
    yield entries
    for value in entries.values():
        if isinstance(value, dict):
            yield from tables_within(value)
        elif isinstance(value, list):
            for one in value:
                if isinstance(one, dict):
                    yield from tables_within(one)


def edit(scene, draw):
    """One edit of the scene, in place."""
    header, entries = draw.choice(scene)
    table = draw.choice(list(tables_within(entries)))
    choice = draw.random()
    if choice < 0.45 and table:
        key = draw.choice(list(table))
        table[key] = some_value(draw, key, table[key])
    elif choice < 0.6:
        key = draw.choice(MORE_KEYS.get(header, ["position"]))
        entries[key] = some_value(draw, key, entries.get(key))
    elif choice < 0.68 and table:
        del table[draw.choice(list(table))]
    elif choice < 0.72 and table:
        key = draw.choice(list(table))
        table[key[:-1] + "q"] = table[key]
    elif choice < 0.77:
        scene.append(copy.deepcopy(draw.choice(scene)))
    elif choice < 0.8 and len(scene) > 1:
        scene.remove(draw.choice(scene))
    else:
        edit_times(scene, draw)


def edit_times(scene, draw):
    """How start, duration, step and frames stand to one another."""
    times = next((entries for header, entries in scene if header == "[scene]"), {})
    bodies = [entries for header, entries in scene if header == "[[body]]"] or [{}]
    duration = times.get("duration", 0.02)
    duration = duration if isinstance(duration, float) else 0.02
    body = draw.choice(bodies)
    body_edits = [
        lambda: body.update(start=duration), lambda: body.update(start=2 * duration), lambda: body.update(start=1e30),
        lambda: body.update(start=0.99 * duration), lambda: body.update(count=5, spread={"start": 10.0 * abs(duration)}),
        lambda: body.update(count=2, spread={"start": 1e30}), lambda: body.update(count=3, spread={"size": [1e-3, 1e3]}),
        lambda: body.update(count=3, spread={"position": [1e30, 0.0, 0.0]}), lambda: body.update(scale=1e-9),
        lambda: body.update(scale=1e9), lambda: body.update(density=998.2), lambda: body.update(density=1e6),
        lambda: body.update(density=1e-3), lambda: body.update(models="auto"), lambda: body.update(velocity=[1e12, 0.0, 0.0]),
    ]
    scene_edits = [
        lambda: times.update(step=2 * duration), lambda: times.update(step=1e30), lambda: times.update(step=duration),
        lambda: times.update(duration=1e-60), lambda: times.update(duration=1e-9), lambda: times.update(frame_rate=1e-30),
        lambda: times.update(frame_rate=1e9), lambda: times.update(frame_rate=1e30), lambda: times.update(duration=1e30),
        lambda: times.update(step="auto"), lambda: times.update(gravity=[0.0, 0.0, 0.0]), lambda: times.update(step=1e-30),
        lambda: times.update(gravity=[1e30, 0.0, 0.0]), lambda: times.update(duration=1e-4, step=1.0),
    ]
    draw.choice(body_edits if draw.random() < 0.5 else scene_edits)()


def toml(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + " }"
    return repr(value)


def text_of(scene, draw):
    lines = []
    for header, entries in scene:
        lines.append(header)
        lines += [f"{key} = {toml(value)}" for key, value in entries.items() if value is not None]
    if draw.random() < 0.03:  # a key twice
        lines.insert(draw.randrange(1, len(lines)), draw.choice(lines))
    text = "\n".join(lines) + "\n"
    if draw.random() < 0.03:
        place = draw.randrange(len(text))
        text = text[:place] + draw.choice(["\0", "\"", "[", "=", "\n", "'''", "\ufeff", "e400"]) + text[place + draw.randrange(4):]
    return text


def is_long(scene):
    """Whether a sound scene would only take its time: more than some ten thousand steps or frames, and fewer than what is
    refused."""
    times = next((entries for header, entries in scene if header == "[scene]"), {})
    numbers = [times.get(name, default) for name, default in (("duration", 0.02), ("step", 0.002), ("frame_rate", 60.0))]
    if not all(isinstance(number, (int, float)) and math.isfinite(number) and number > 0 for number in numbers):
        return False
    duration, step, rate = numbers
    copies = 1
    for header, entries in scene:
        count = entries.get("count", 1)
        if header == "[[body]]" and isinstance(count, int) and count > 0:
            copies = max(copies, count)
    starts = [entries["start"] for header, entries in scene if isinstance(entries.get("start"), float)]
    rest = duration if not starts or not 0 <= min(starts) < duration else duration - min(starts)
    return 2e4 < max(rest / step, duration * rate) * copies < 1e13


def odd_scene(number):
    draw = random.Random(f"odd scene {number}")
    while True:
        scene = copy.deepcopy(draw.choice(list(base_scenes())))
        for _ in range(draw.choice([1, 1, 1, 2, 2, 3])):
            edit(scene, draw)
        if not is_long(scene):
            return text_of(scene, draw)


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_SECONDS, MOST_CPU_SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def unknown_numbers(result, name=""):
    """The names of numbers that a result should have and has not."""
    if isinstance(result, dict):
        return [one for key, value in result.items() for one in unknown_numbers(value, key)]
    if isinstance(result, list):
        return [one for value in result for one in unknown_numbers(value, name)]
    return [name] if name in FINITE and (result is None or result < 0) else []


def error_of(command, status, output, said):
    """Returns the error in how a command ended; None where it ended properly."""
    notes = [line for line in said.splitlines() if ": warning: " not in line and not PROGRESS.match(line)]
    if status == 0:
        try:
            missing = unknown_numbers(json.loads(output))
        except ValueError:
            return "no JSON object"
        return f"no number for {missing[0]}" if missing else ("said: " + notes[0] if notes else None)
    if status != 1:
        return f"exit status {status}"
    if len(notes) != 1 or not notes[0].startswith(f"samara {command}: ") or len(notes[0]) > 2000:
        return f"{len(notes)} lines, {notes[:2]}"
    for word in ("std::", "what()", "vector::", "basic_string", "bad_alloc", "json.exception", "Assertion", " nan"):
        if word in notes[0]:
            return f"unclear words: {notes[0]}"
    return None


class OddScenes:
    def __init__(self, programs, folder):
        self.programs = programs
        self.folder = folder
        self.seconds = dict.fromkeys(COMMANDS, 0.0)

    def errors(self, number):
        """The errors of all commands of one scene, as texts."""
        text = odd_scene(number)
        folder = os.path.join(self.folder, str(number))
        os.makedirs(folder)
        file = os.path.join(folder, "scene.toml")
        with open(file, "w", encoding="utf-8", errors="surrogatepass", newline="") as stream:
            stream.write(text)
        with open(os.path.join(folder, "floor.obj"), "w") as stream:
            stream.write("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        found = []
        for command, words in COMMANDS.items():
            program, *rest = (word.format(folder) for word in words)
            first = [rest.pop(0)] if program == "samara" else []
            try:
                done = subprocess.run([os.path.join(self.programs, program), *first, file, *rest], capture_output=True,
                                      preexec_fn=limits, timeout=MOST_SECONDS, check=False)
                error = error_of(command, done.returncode, done.stdout.decode(errors="replace"),
                                 done.stderr.decode(errors="replace"))
            except subprocess.TimeoutExpired:
                error = f"no end within {MOST_SECONDS} s"
            if error:
                found.append(f"scene {number}, samara {command}: {error}")
        return found + ([text] if found else [])


def main(programs, first=0, count=SCENES):
    with tempfile.TemporaryDirectory() as folder:
        odd = OddScenes(programs, folder)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            errors = [line for found in pool.map(odd.errors, range(first, first + count)) for line in found]
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print("\n".join(errors))
    print(f"{count} scenes, {len(COMMANDS)} commands: {used.ru_utime + used.ru_stime:.0f} CPU s, "
          f"{sum(line.startswith('scene ') for line in errors)} errors")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])) if len(sys.argv) > 1 else __doc__)
