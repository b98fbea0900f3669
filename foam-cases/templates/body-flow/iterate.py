#!/usr/bin/env -S python3 -IB
"""Runs the case's solver in rounds until the case is statistically stationary (stationarity.py).

    iterate.py      in the folder of the case, whose mesh is there

A case that does not settle, or diverges, is repeated with the settings of ATTEMPTS, and fails after the last. For an unsteady case
an iteration is a step. rounds.json records the rounds. An interrupted round is repeated from the last whole one, so that a killed
case ends with the same bytes as others; where an input has changed, the case starts again.

Exit 0: rounds.json has the verdict "stationary", or "restless" where an attempt ended within ACCEPTED_TOLERANCES or
`acceptedError` (a wake that oscillates about a constant mean, whose standard error tells its accuracy). Exit 1 with one line:
the verdict is "failed" where all attempts failed; otherwise the solver was stopped.
"""

import glob
import os
import resource
import shutil
import subprocess
import sys

# After Python's own folders, so that no file of this one replaces a module there.
sys.path.append(os.path.dirname(os.path.realpath(__file__)))
from case_files import (Failure, CaseError, are_attempts, breakdown, could_not_read_state,  # noqa: E402
                        hash_of_inputs, read, read_record, say, time_folders, word, write_entries, write_json)
from stationarity import has_turbulence_means, whole_histories, worst_quantity  # noqa: E402

# For each attempt: changes of parameters, further changes in its first round, and its start: by `startFrom`, from the current
# state, or from the undisturbed flow.
ATTEMPTS = {
    "as planned": ({}, {}, "startFrom"),
    "damped": ({"momentumRelaxation": "0.7", "turbulenceRelaxation": "0.5"}, {}, "what stands"),
    "cautious": ({"momentumRelaxation": "0.5", "turbulenceRelaxation": "0.4"},
                 {"convection": "upwind", "turbulenceConvection": "upwind", "gradient": "cellLimited Gauss linear 1"},
                 "undisturbed"),
    "half the step": ({}, {}, "startFrom"),
}
AFTER_RESTLESSNESS = {"as planned": "damped", "damped": "cautious"}
AFTER_DIVERGENCE = {"as planned": "cautious", "damped": "cautious"}
# For unsteady cases: oscillations are of the flow itself, and relaxation does not help against divergence.
AFTER_DIVERGENCE_IN_TIME = {"as planned": "half the step"}
STEPS_OVER_PLANNED = {"half the step": 2}
ACCEPTED_TOLERANCES = 3.0


def own(name):
    """Returns the text of an entry of the case's file `parameters`."""
    return word(read("parameters"), name)


def start_folder():
    """Returns the folder of the solved case to start from; None where there is none, or where it failed."""
    folder = os.path.join("..", own("startFrom"))
    return folder if os.path.exists(os.path.join(folder, "provenance.json")) else None


def run_program(words, log):
    """Runs a program; returns its exit status and CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(log, "w") as file:
        status = subprocess.run(words, stdout=file, stderr=subprocess.STDOUT, check=False).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return status, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Rounds:
    """The rounds of the case so far. `goes_on`: whether it continues an earlier run, and no round was done since."""

    def __init__(self):
        self.round_iterations = int(own("roundIterations"))
        self.most_iterations = int(own("mostIterations"))
        self.least_iterations = int(own("leastIterations"))
        self.tolerance = float(own("stationarity"))
        self.accepted = max(ACCEPTED_TOLERANCES, float(own("acceptedError")) / self.tolerance)
        self.turbulent = has_turbulence_means(read("parameters"))
        self.solver = own("solver")
        self.log = f"log.{self.solver}"
        self.planned_step = float(own("timeStep"))
        self.unsteady = own("rateOfChange") != "steadyState"
        self.inputs = hash_of_inputs([os.path.join(start_folder(), "rounds.json")] if start_folder() else [])
        self.state = read_record("rounds.json")
        self.goes_on = (self.state.get("inputs") == self.inputs and self.state.get("verdict") != "failed"
                        and are_attempts(self.state, ATTEMPTS, ("first", "iterations"), ("unsteadiness_over_tolerance",))
                        and self.histories_are_whole())
        if self.goes_on:
            self.keep_whole_rounds()
        else:
            self.start_afresh()

    @property
    def attempt(self):
        return self.state["attempts"][-1]

    @property
    def steps_over_planned(self):
        return STEPS_OVER_PLANNED.get(self.attempt["what"], 1)

    @property
    def time_step(self):
        return self.planned_step / self.steps_over_planned

    def time_at(self, iterations):
        return float(f"{iterations * self.time_step:.10g}")

    def histories_are_whole(self):
        try:
            whole_histories(".", self.attempt["iterations"], self.turbulent, self.time_step)
        except CaseError:
            return False
        return True

    def start_afresh(self):
        self.state = {"inputs": self.inputs, "verdict": None, "cpu_seconds": 0.0, "attempts": []}
        self.begin("as planned")

    def begin(self, what):
        first = self.attempt["iterations"] if ATTEMPTS[what][2] == "what stands" else 0
        self.state["attempts"].append({"what": what, "first": first, "iterations": first})
        if self.unsteady:
            self.attempt["time_step"] = self.time_step
        write_json("rounds.json", self.state)
        self.keep_whole_rounds()

    def keep_whole_rounds(self):
        """Removes the fields of all but the last whole round, and the histories of later ones."""
        whole = self.time_at(self.attempt["iterations"])
        for time, path in time_folders(".").items():
            if time not in (0, whole) or whole == 0:
                shutil.rmtree(path)
        for name in glob.glob("postProcessing/*"):
            for start, path in time_folders(name).items():
                if start >= whole:
                    shutil.rmtree(path)
        for path in glob.glob("processor*"):
            shutil.rmtree(path)
        if whole == 0:
            self.make_start()

    def make_start(self):
        """Makes the folder 0: the undisturbed flow, or the solution of another case mapped to this mesh."""
        if os.path.lexists("round"):  # of another run
            os.remove("round")
        shutil.copytree("0.orig", "0")
        source = start_folder() if ATTEMPTS[self.attempt["what"]][2] == "startFrom" else None
        self.attempt["started_from"] = own("startFrom") if source else "undisturbed flow"
        if source:
            status, seconds = run_program(["./Allrun", "map", source], "log.mapFields")
            self.state["cpu_seconds"] += seconds
            if status != 0:
                raise CaseError(f"mapFields failed; see {os.path.abspath('log.mapFields')}")

    def run_round(self):
        """Runs one more round, and records a verdict, the end of the attempt, or neither."""
        attempt = self.attempt
        changes, first_changes, _ = ATTEMPTS[attempt["what"]]
        if attempt["iterations"] == attempt["first"]:
            changes = changes | first_changes
        end = attempt["iterations"] + self.round_iterations
        if self.unsteady:
            changes = {**changes, "timeStep": f"{self.time_step:.10g}"}
        entries = {"endTime": f"{self.time_at(end):.10g}", "writeFormat": "binary", **changes}
        write_entries("round", "What this round has of its own; written by iterate.py", entries)
        status, seconds = run_program(["./Allrun", "round"], self.log)
        self.state["cpu_seconds"] += seconds
        if status != 0:
            raise breakdown(os.path.abspath(self.log), self.solver, "iteration")
        attempt["iterations"] = end
        unsteady, quantity, start = worst_quantity(".", attempt["first"], end, self.tolerance, self.turbulent,
                                                   self.time_step, float(own("viscosity")))
        attempt["unsteadiness_over_tolerance"] = unsteady
        attempt["worst_quantity"] = quantity
        self.state["averaging_start"] = start
        self.goes_on = False
        done = end - attempt["first"]
        if unsteady <= 1.0 and done >= self.least_iterations * self.steps_over_planned:
            self.state["verdict"] = "stationary"
        elif done >= self.most_iterations * self.steps_over_planned:
            attempt["end"] = f"the {quantity} did not settle: {unsteady:.2g} times its tolerance of {self.tolerance:g}"
        write_json("rounds.json", self.state)
        self.keep_whole_rounds()

    def after(self, cause, following):
        """Begins the next attempt, or sets the verdict."""
        self.attempt["end"] = cause
        following = following.get(self.attempt["what"])
        if following:
            self.begin(following)
        elif self.attempt.get("unsteadiness_over_tolerance", self.accepted + 1) <= self.accepted:
            self.state["verdict"] = "restless"
        else:
            self.state["verdict"] = "failed"
        write_json("rounds.json", self.state)

    def run(self):
        while self.state["verdict"] is None:
            # An attempt that had ended before the script was killed is not continued.
            if "end" in self.attempt:
                accepted = self.attempt["unsteadiness_over_tolerance"] <= self.accepted
                self.after(self.attempt["end"], {} if accepted or self.unsteady else AFTER_RESTLESSNESS)
                continue
            try:
                self.run_round()
            except Failure as cause:
                self.attempt.pop("unsteadiness_over_tolerance", None)
                self.after(str(cause), AFTER_DIVERGENCE_IN_TIME if self.unsteady else AFTER_DIVERGENCE)
            except CaseError:
                # For example the disk was full when an earlier run wrote its last round.
                if not self.goes_on or not could_not_read_state(self.log):
                    raise
                self.goes_on = False
                self.start_afresh()


def main():
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    try:
        rounds = Rounds()
        rounds.run()
    except (CaseError, OSError) as error:
        say(error, sys.stderr)
        return 1
    if rounds.state["verdict"] == "failed":
        attempts = ", ".join(one["what"] for one in rounds.state["attempts"])
        say(f"{rounds.attempt['end']} (attempts: {attempts})", sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
