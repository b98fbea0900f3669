#!/usr/bin/env -S python3 -B
"""Runs pimpleFoam over a free fall, watches it, and tries again with shorter steps where it blows up.

    fall.py      in the folder of the case, whose mesh is there

The attempts are those of ATTEMPTS, each from the start; attempts.json holds what was done. A fall that was cut short
goes on from the last state that was written whole; where an input has changed, it starts afresh. A fall that went on
is not the same to the last bit as one that was never stopped: the solver takes its first step anew.

Exit 0: attempts.json has the verdict "done". Exit 1: one line says why; the verdict is "failed" where all attempts
blew up, else something stopped the solver.
"""

import glob
import hashlib
import json
import math
import os
import re
import resource
import shutil
import subprocess
import sys
import time

# Each: the factors on the step and on the relaxation of the acceleration, and the outer correctors.
ATTEMPTS = {
    "as planned": (1.0, 1.0, None),
    "half the step": (0.5, 0.7, None),
    "a quarter of the step": (0.25, 0.5, 2),
}
# A body in free fall is about as fast as the case's unit: ten times that, or of the start, is no fall any more.
LARGEST_SPEED = 10.0
LARGEST_TURNING = 100.0
SECONDS_BETWEEN_LOOKS = 0.5
NUMBER = re.compile(r"[-+]?(?:\d[\d.]*(?:[eE][-+]?\d+)?|nan|inf)")


class Fault(Exception):
    """What is wrong, in one line for the user."""


class BlownUp(Exception):
    """The fall went to nonsense."""


def read(path):
    with open(path, errors="replace") as file:
        return file.read()


def write_json(path, content):
    """Writes the file whole, or not at all."""
    with open(path + ".part", "w") as file:
        json.dump(content, file, indent=2)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(path + ".part", path)


def parameter(name):
    match = re.search(rf"^{name}\s+([^;]+);", read("parameters"), re.MULTILINE)
    if not match:
        raise Fault(f"parameters: has no entry {name}; restore it")
    return match.group(1).strip()


def hash_of_inputs():
    paths = ["parameters"] + [path for pattern in ("0.orig/*", "system/*", "constant/*") for path in glob.glob(pattern)]
    paths += glob.glob("constant/polyMesh/[!s]*")
    total = hashlib.sha256()
    for path in sorted(paths):
        if os.path.isfile(path):
            with open(path, "rb") as file:
                total.update(path.encode() + b"\0" + file.read() + b"\0")
    return total.hexdigest()


def time_folders():
    """The written states by their times, without the start."""
    names = [name for name in os.listdir(".") if re.fullmatch(r"\d[\d.]*(e[-+]?\d+)?", name)]
    return {float(name): name for name in names if float(name) > 0}


def last_state():
    """The time and the numbers of the last whole row of the body's state; nothing before the first."""
    starts = sorted(glob.glob("postProcessing/state/*"), key=lambda path: float(os.path.basename(path)))
    for path in reversed(starts):
        for file in glob.glob(os.path.join(path, "sixDoFRigidBodyState*.dat")):
            rows = [row for row in read(file).split("\n")[:-1] if row and not row.startswith("#")]
            if rows:
                row = [float(word) for word in NUMBER.findall(rows[-1])]
                return row[0], row[1:]
    return None


def is_blown_up(state, start_speed):
    velocity, turning = state[-6:-3], state[-3:]
    speed = math.hypot(*velocity)
    if not all(math.isfinite(number) for number in state):
        return "its state is not finite"
    if speed > LARGEST_SPEED * max(1.0, start_speed):
        return f"its speed is {speed:.3g} times that of the case's unit"
    if math.hypot(*turning) > LARGEST_TURNING:
        return "its angular velocity is beyond all bounds"
    return None


def breakdown(log):
    """The exception for a solver that did not reach its end: BlownUp where its steps broke down."""
    text = read(log)
    times = re.findall(r"^Time = (\S+)", text, re.MULTILINE)
    where = f" at time {times[-1]}" if times else ""
    see = f"; see {os.path.abspath(log)}"
    fatal = re.search(r"FOAM FATAL ([A-Z ]*ERROR)[^\n]*\n(?:\s*\n)*([^\n]*)", text)
    if fatal:
        kind = BlownUp if times and "IO" not in fatal.group(1) else Fault
        return kind(f"pimpleFoam failed{where}: {fatal.group(2).strip().rstrip('.')}{see}")
    # The signal's handler, in the stack that OpenFOAM prints; its banner speaks of floating point exceptions too.
    if "sigFpe::sigHandler" in text:
        return BlownUp(f"pimpleFoam diverged (floating point exception){where}{see}")
    return Fault(f"pimpleFoam was stopped{where}, before its end{see}")


class Fall:
    """What was done, and so from where to go on."""

    def __init__(self):
        inputs = hash_of_inputs()
        try:
            self.state = json.loads(read("attempts.json"))
        except (OSError, ValueError):
            self.state = {}
        if self.state.get("inputs") == inputs and self.state.get("verdict") in ("done", None):
            self.go_on()
        else:
            self.state = {"inputs": inputs, "verdict": None, "cpu_seconds": 0.0, "attempts": []}
            self.begin("as planned")

    @property
    def attempt(self):
        return self.state["attempts"][-1]

    def begin(self, what):
        step, relaxation, correctors = ATTEMPTS[what]
        for path in time_folders().values():
            shutil.rmtree(path)
        for path in ("0", "postProcessing"):
            shutil.rmtree(path, ignore_errors=True)
        shutil.copytree("0.orig", "0")
        entries = {}
        if what != "as planned":
            entries["timeStep"] = f"{step * float(parameter('timeStep')):g}"
            entries["accelerationRelaxation"] = f"{relaxation * float(parameter('accelerationRelaxation')):g}"
        if correctors:
            entries["outerCorrectors"] = correctors
        with open("remedy", "w") as file:
            file.write("// What this attempt has in place of the plan; written by fall.py\n")
            file.write("".join(f"{name} {value};\n" for name, value in entries.items()))
        self.state["attempts"].append({"what": what, **entries})
        write_json("attempts.json", self.state)

    def go_on(self):
        """Keeps the last state that is whole: the solver had gone on after it."""
        reached = last_state()
        times = sorted(time_folders())
        whole = [time for time in times if reached and time < reached[0]]
        for time in times:
            if time not in whole[-1:]:
                shutil.rmtree(time_folders()[time])
        for path in glob.glob("postProcessing/*/*"):
            if float(os.path.basename(path)) >= (whole[-1] if whole else 0.0):
                shutil.rmtree(path)
        if whole:
            self.attempt["went_on_from"] = self.attempt.get("went_on_from", []) + [whole[-1]]
            write_json("attempts.json", self.state)

    def watch(self, solver):
        start = [float(word) for word in NUMBER.findall(parameter("startVelocity"))]
        while solver.poll() is None:
            time.sleep(SECONDS_BETWEEN_LOOKS)
            reached = last_state()
            fault = reached and is_blown_up(reached[1], math.hypot(*start))
            if fault:
                solver.terminate()
                solver.wait()
                raise BlownUp(f"the fall blew up at time {reached[0]:g}: {fault}; see "
                              f"{os.path.abspath('log.pimpleFoam')}")

    def run_attempt(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open("log.pimpleFoam", "w") as log:
            solver = subprocess.Popen(["pimpleFoam"], stdout=log, stderr=subprocess.STDOUT)
            try:
                self.watch(solver)
            finally:
                if solver.poll() is None:
                    solver.terminate()
                    solver.wait()
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                self.state["cpu_seconds"] += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
                write_json("attempts.json", self.state)
        if solver.returncode != 0:
            raise breakdown("log.pimpleFoam")

    def run(self):
        while self.state["verdict"] is None:
            try:
                self.run_attempt()
                self.state["verdict"] = "done"
            except BlownUp as cause:
                self.attempt["end"] = str(cause)
                names = list(ATTEMPTS)
                following = names.index(self.attempt["what"]) + 1
                if following < len(names):
                    self.begin(names[following])
                else:
                    self.state["verdict"] = "failed"
            write_json("attempts.json", self.state)


def main():
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    try:
        fall = Fall()
        fall.run()
    except (Fault, OSError) as fault:
        print(fault, file=sys.stderr)
        return 1
    if fall.state["verdict"] == "failed":
        print(fall.attempt["end"], file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
