#!/usr/bin/env -S python3 -IB
"""Runs pimpleFoam over a free fall, monitors it, and repeats it with shorter steps where it diverges.

    fall.py      in the folder of the case, whose mesh is there

The attempts are those of ATTEMPTS, each from the start; attempts.json records them. An interrupted fall continues from the last
state that was written completely; where an input has changed, it starts again. A continued fall is not equal to the last bit to
one that was never stopped, since the solver repeats its first step.

Exit 0: attempts.json has the verdict "done". Exit 1 with one line: the verdict is "failed" where all attempts diverged; otherwise
the solver was stopped.
"""

import glob
import math
import os
import re
import shutil
import signal
import subprocess
import sys

# After Python's own folders, so that no file of this one replaces a module there.
sys.path.append(os.path.dirname(os.path.realpath(__file__)))
from case_files import (Failure, CaseError, are_attempts, breakdown, could_not_read_state, cpu_seconds,  # noqa: E402
                        hash_of_inputs, numbers, parameter, read, read_record, say, time_folders, write_entries,
                        write_json)

SOLVER = "pimpleFoam"
CONTAINER = os.environ.get("SAMARA_OPENFOAM", "").split()  # the words that run it in a container
LOG = "log." + SOLVER

# For each attempt: factors of the step and of the relaxation of the acceleration, and the outer correctors. The relaxation is
# lowered too, since the coupling of body and fluid may be unstable, which no step helps.
ATTEMPTS = {
    "as planned": (1.0, 1.0, None),
    "half the step": (0.5, 0.7, None),
    "a quarter of the step": (0.25, 0.5, 2),
}
# The entries that an attempt may replace.
REMEDIES = ("timeStep", "accelerationRelaxation", "outerCorrectors")
# The speed of a fall is about the case's unit: ten times that, or ten times the start's, means divergence.
LARGEST_SPEED = 10.0
# In units of U/L: some twenty times the angular velocity of a tumbling coin, whose rim is about as fast as its centre.
LARGEST_ANGULAR_VELOCITY = 100.0
SECONDS_BETWEEN_CHECKS = 0.5
MORE_THAN_A_ROW = 1024  # characters of a history


def own(name):
    return parameter(read("parameters"), name)


def states():
    """Returns the paths of the written states by their times, without the start."""
    return {time: path for time, path in time_folders(".").items() if time > 0}


def last_row(path):
    """Returns the last whole row of a history; None where there is none."""
    with open(path, "rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - MORE_THAN_A_ROW))
        lines = file.read().decode(errors="replace").split("\n")
    rows = [line for line in lines[1:-1] if line and not line.startswith("#")]
    return numbers(rows[-1]) if rows else None


def last_state():
    """Returns the time and the numbers of the last whole row of the body's state; None before the first."""
    for start in reversed(time_folders("postProcessing/state").values()):
        for path in glob.glob(os.path.join(start, "sixDoFRigidBodyState*.dat")):
            row = last_row(path)
            if row:
                return row[0], row[1:]
    return None


def divergence_of(state, start_speed):
    """Returns the sign of divergence in a state; None where there is none."""
    velocity, angular_velocity = state[-6:-3], state[-3:]
    speed = math.hypot(*velocity)
    if not all(map(math.isfinite, state)):
        return "its state is not finite"
    if speed > LARGEST_SPEED * max(1.0, start_speed):
        return f"its speed is {speed:.3g} U"
    if math.hypot(*angular_velocity) > LARGEST_ANGULAR_VELOCITY:
        return f"its angular velocity is {math.hypot(*angular_velocity):.3g} U/L"
    return None


class Fall:
    """The attempts at the fall so far."""

    def __init__(self):
        inputs = hash_of_inputs()
        self.state = read_record("attempts.json")
        if self.state.get("inputs") != inputs or self.state.get("verdict") == "failed" or not self.is_whole():
            self.state = {"inputs": inputs, "verdict": None, "cpu_seconds": 0.0, "attempts": []}
            self.begin("as planned")
        elif self.state["verdict"] is None:
            self.take_up()

    def is_whole(self):
        """Whether the fall is unfinished, or its history reaches its end."""
        return are_attempts(self.state, ATTEMPTS, ("started",), REMEDIES) and (
            self.state["verdict"] is None or self.is_at_end())

    @property
    def attempt(self):
        return self.state["attempts"][-1]

    def is_at_end(self):
        reached = last_state()
        return reached is not None and reached[0] > own("duration") - 1.5 * self.time_step()

    def time_step(self):
        return float(self.attempt.get("timeStep", own("timeStep")))

    def begin(self, what):
        step, relaxation, correctors = ATTEMPTS[what]
        entries = {}
        if what != "as planned":
            entries["timeStep"] = f"{step * own('timeStep'):.12g}"
            entries["accelerationRelaxation"] = f"{relaxation * own('accelerationRelaxation'):g}"
        if correctors:
            entries["outerCorrectors"] = correctors
        self.state["attempts"].append({"what": what, "started": False, **entries})
        write_json("attempts.json", self.state)
        self.make_start()

    def write_remedy(self):
        """Writes the entries that the attempt replaces: only numbers, whatever its record holds."""
        write_entries("remedy", "What this attempt has in place of the plan; written by fall.py",
                      {name: f"{float(self.attempt[name]):.12g}" for name in REMEDIES if name in self.attempt})

    def make_start(self):
        for path in [*states().values(), "0", "postProcessing"]:
            shutil.rmtree(path, ignore_errors=True)
        if os.path.exists(LOG):
            os.remove(LOG)
        shutil.copytree("0.orig", "0")
        self.write_remedy()
        self.attempt["started"] = True
        write_json("attempts.json", self.state)

    def take_up(self):
        """Continues an interrupted attempt, or begins the next one."""
        if "end" in self.attempt:
            self.after_divergence()
        elif not self.attempt["started"]:
            self.make_start()
        else:
            self.write_remedy()
            self.go_on()

    def go_on(self, before=math.inf):
        """Removes the states from a time on, and those that may be incomplete, since the solver did not continue after them; and the
        histories after the last remaining state."""
        reached = last_state()
        bound = min(before, reached[0] if reached else 0.0)
        last = max([time for time in states() if time < bound], default=0.0)
        for time, path in states().items():
            if time > last:
                shutil.rmtree(path)
        for name in glob.glob("postProcessing/*"):
            for start, path in time_folders(name).items():
                if start >= last:
                    shutil.rmtree(path)
        if last > 0.0:
            self.attempt["went_on_from"] = self.attempt.get("went_on_from", []) + [last]
            write_json("attempts.json", self.state)

    def watch(self, solver):
        start_speed = math.hypot(*own("startVelocity"))
        ended = False
        while not ended:
            try:
                solver.wait(SECONDS_BETWEEN_CHECKS)
                ended = True
            except subprocess.TimeoutExpired:
                pass
            reached = last_state()
            error = reached and divergence_of(reached[1], start_speed)
            if error:
                raise Failure(f"the fall diverged at time {reached[0]:g}: {error}; see {os.path.abspath(LOG)}")

    def run_solver(self):
        """Runs the solver to the end of the fall; its log is appended to that of an earlier run."""
        with open(LOG, "a") as log:
            solver = subprocess.Popen([*CONTAINER, SOLVER], stdout=log, stderr=subprocess.STDOUT)
            try:
                self.watch(solver)
            finally:
                if solver.poll() is None:
                    solver.terminate()
                    solver.wait()
        if solver.returncode != 0:
            raise breakdown(os.path.abspath(LOG), SOLVER, "time")
        if not self.is_at_end():
            raise CaseError(f"postProcessing/state ends before the fall does; is the disk full? See {os.path.abspath(LOG)}")

    def note_cost(self):
        """Records the CPU seconds of all runs of this attempt, by its log."""
        runs = re.split(r"^Build\s*:", read(LOG), flags=re.MULTILINE)
        self.attempt["cpu_seconds"] = round(sum(map(cpu_seconds, runs)), 2)
        self.state["cpu_seconds"] = round(sum(one["cpu_seconds"] for one in self.state["attempts"]), 2)

    def after_divergence(self):
        names = list(ATTEMPTS)
        following = names[names.index(self.attempt["what"]) + 1:]
        if following:
            self.begin(following[0])
        else:
            self.state["verdict"] = "failed"

    def run_attempt(self):
        try:
            self.run_solver()
            self.note_cost()
            self.state["verdict"] = "done"
        except Failure as cause:
            self.note_cost()
            kept = f"{LOG}.{len(self.state['attempts'])}"  # the next attempt writes another log
            shutil.copyfile(LOG, kept)
            self.attempt["end"] = str(cause).replace(LOG, kept)
            write_json("attempts.json", self.state)
            self.after_divergence()
        except CaseError:
            if not states() or not could_not_read_state(LOG):
                raise
            self.go_on(before=max(states()))

    def run(self):
        while self.state["verdict"] is None:
            self.run_attempt()
            write_json("attempts.json", self.state)


def main():
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    # So that the solver is terminated too.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit("stopped; ./Allrun goes on from the last state"))
    try:
        fall = Fall()
        fall.run()
    except KeyboardInterrupt:
        print("stopped; ./Allrun goes on from the last state", file=sys.stderr)
        return 1
    except (CaseError, OSError) as error:
        say(error, sys.stderr)
        return 1
    if fall.state["verdict"] == "failed":
        say(fall.attempt["end"], sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
