#!/usr/bin/env python3
"""Tests body-flow/iterate.py with a case whose solver is stopped, whose disk was full, or whose files were damaged
since, with a solver made here that is done at once. Run by ctest."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from faked_solver import TEMPLATES, FakedSolverTest  # noqa: E402

# Settles at once. FAKE: what happens in the round that ends there: "nothing", "kill" (at its end), "disk" (its files are
# cut short, and all seems well), "refuse" (it does not know what the case asks for). "AT swing": a force of 0.4 that is more
# by AT in every other sixty iterations.
SOLVER = '''#!/usr/bin/env python3
import os, re, sys
at, what = os.environ["FAKE"].split()
print("Build  : 1\\nExec   : simpleFoam", flush=True)
start = max(int(name) for name in os.listdir(".") if re.fullmatch(r"[0-9]+", name))
if os.path.getsize(f"{start}/U") == 0:
    sys.exit("--> FOAM FATAL IO ERROR: \\nthe file is cut short\\n\\nFOAM exiting")
end = int(re.search(r"endTime (\\d+);", open("round").read()).group(1))
if what == "refuse":
    sys.exit("--> FOAM FATAL ERROR: \\nUnknown function type nearWake\\n\\nFOAM exiting")
full = what == "disk" and int(at) == end
for name, values in (("forces/{}/force.dat", "(0.4 0 0)"), ("forces/{}/moment.dat", "(0 0 0)"),
                     ("nearWake/{}/volFieldValue.dat", "0.01 0.02")):
    if what == "swing" and name.startswith("forces/{}/force"):
        values = "({} 0 0)"
    path = "postProcessing/" + name.format(start)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write("# Time values\\n" + "".join(f"{i} {values.format(0.4 + float(at) * (i // 60 % 2))}\\n"
                                              for i in range(start + 1, end + 1 - 5 * full)))
os.makedirs(f"{end}")
with open(f"{end}/U", "w") as file:
    file.write("" if full else "values")
print("".join(f"Time = {i}\\nExecutionTime = 1 s\\n" for i in range(start + 1, end + 1)), flush=True)
if what == "kill" and int(at) == end:
    os.kill(os.getpid(), 9)
print("End")
'''


class IteratedCase(FakedSolverTest):
    def setUp(self):
        self.make_case("a 'case'")
        shutil.copytree(os.path.join(TEMPLATES, "body-flow"), self.case)
        shutil.copy(os.path.join(TEMPLATES, "case_files.py"), self.case)
        os.makedirs(os.path.join(self.case, "constant/polyMesh"))

    def run_case(self, fake="0 nothing"):
        """The exit status and the last line of what was said."""
        status, said = self.run_faked("Allrun", fake)
        return status, said.splitlines()[-1]

    def rounds(self):
        with open(os.path.join(self.case, "rounds.json")) as file:
            return json.load(file)

    def text(self, name):
        with open(os.path.join(self.case, name)) as file:
            return file.read()

    def histories(self):
        found = {}
        for folder, _, names in os.walk(os.path.join(self.case, "postProcessing")):
            for name in names:
                with open(os.path.join(folder, name)) as file:
                    found[os.path.relpath(os.path.join(folder, name), self.case)] = file.read()
        return found

    def set_parameter(self, name, value):
        path = os.path.join(self.case, "parameters")
        with open(path) as file:
            text, count = re.subn(rf"(?m)^{name} [^;]*;", f"{name} {value};", file.read())
        self.assertEqual(count, 1, name)
        self.write(path, text)


class IterateTest(IteratedCase):
    SOLVER_NAME = "simpleFoam"
    SOLVER = SOLVER

    def expect_solved_as_if_never_stopped(self):
        self.assertEqual(self.run_case()[0], 0)
        self.assertEqual(self.rounds()["verdict"], "stationary")
        after = self.histories()
        subprocess.run([os.path.join(self.case, "Allclean")], check=True)
        self.assertEqual(self.run_case()[0], 0)
        self.assertEqual(self.histories(), after)
        self.assertEqual(len(after), 6)

    def test_a_case_that_settles_takes_two_rounds(self):
        self.expect_solved_as_if_never_stopped()
        self.assertEqual(self.rounds()["attempts"][0]["iterations"], 200)

    def test_a_file_with_the_name_of_a_module_of_pythons_is_not_run(self):
        self.write("json.py", "raise SystemExit('ran a stranger')\n")
        self.assertEqual(self.run_case()[0], 0)

    def test_what_a_round_left_counts_for_no_start(self):
        self.write("round", "#calc \"1\";\n")
        self.write("Allrun", self.text("Allrun").replace("exec ./iterate.py", "cp round kept; exec ./iterate.py"))
        self.assertEqual(self.run_case()[0], 0)
        self.assertNotIn("#calc", self.text("round"))

    def test_a_record_that_makes_no_sense_is_none(self):
        self.run_case("200 kill")
        record = self.rounds()
        for name, damage in (("what", "its own way"), ("iterations", "#calc"), ("first", None)):
            whole = dict(record["attempts"][0])
            record["attempts"][0][name] = damage
            self.write("rounds.json", json.dumps(record))
            record["attempts"][0] = whole
            self.assertEqual(self.run_case()[0], 0)

    def test_a_killed_solver_is_said_and_the_case_goes_on(self):
        status, said = self.run_case("200 kill")
        self.assertEqual(status, 1)
        self.assertIn("simpleFoam was stopped at iteration 200, before its end", said)
        self.assertIsNone(self.rounds()["verdict"])
        self.expect_solved_as_if_never_stopped()

    def test_a_version_that_the_cases_are_not_tested_with_is_named_beside_its_fault(self):
        status, said = self.run_case("100 refuse")
        self.assertEqual(status, 1)
        self.assertIn("simpleFoam failed: Unknown function type nearWake (this OpenFOAM is '1'; the cases are tested with v1912)",
                      said)

    def test_a_history_that_ends_early_is_a_full_disk_and_not_the_cases_fault(self):
        status, said = self.run_case("100 disk")
        self.assertEqual(status, 1)
        self.assertIn("force.dat has no iteration 96 of 100; was the disk full?", said)
        self.assertIsNone(self.rounds()["verdict"])
        self.expect_solved_as_if_never_stopped()

    def test_a_last_round_that_cannot_be_read_is_solved_anew_from_the_start(self):
        self.run_case("200 kill")
        self.write("100/U", "")
        self.expect_solved_as_if_never_stopped()

    def test_a_solved_case_whose_history_is_gone_or_cut_short_is_solved_anew(self):
        self.run_case()
        whole = self.histories()
        for name, damage in (("forces/100/force.dat", os.remove), ("forces/0/moment.dat", lambda path: os.truncate(path, 0)),
                             ("nearWake/100/volFieldValue.dat", lambda path: os.truncate(path, 500)),
                             ("nearWake/0/volFieldValue.dat", lambda path: self.write(path, "# Time\n1.2.3 4\n"))):
            damage(os.path.join(self.case, "postProcessing", name))
            self.assertEqual(self.run_case()[0], 0)
            self.assertEqual(self.histories(), whole)

    def test_a_damaged_record_of_the_rounds_is_none(self):
        self.run_case("200 kill")
        self.write("rounds.json", '{"inputs": ')
        self.expect_solved_as_if_never_stopped()

    def test_folders_of_the_users_are_no_times(self):
        for name in ("1.2.3", "7th try", "postProcessing/forces/notes"):
            os.makedirs(os.path.join(self.case, name))
        self.assertEqual(self.run_case()[0], 0)
        self.assertTrue(os.path.isdir(os.path.join(self.case, "1.2.3")))
        self.assertTrue(os.path.isdir(os.path.join(self.case, "7th try")))

    def verdict_of_a_swing(self, size, tolerance):
        self.set_parameter("stationarity", tolerance)
        status, _ = self.run_case(f"{size} swing")
        rounds = self.rounds()
        return status, rounds["verdict"], [one["what"] for one in rounds["attempts"]]

    def test_a_swing_within_the_accepted_error_is_taken_at_every_tolerance(self):
        for tolerance in ("0.01", "0.005"):
            self.assertEqual(self.verdict_of_a_swing(0.07, tolerance), (0, "restless", ["as planned"]))

    def test_the_accepted_error_is_the_cases_own(self):
        self.assertEqual(self.verdict_of_a_swing(0.2, "0.005"), (0, "restless", ["as planned"]))

    def test_a_swing_beyond_that_is_damped_and_then_fails(self):
        self.set_parameter("acceptedError", "0.03")
        self.assertEqual(self.verdict_of_a_swing(0.2, "0.005"), (1, "failed", ["as planned", "damped", "cautious"]))

    def test_a_mesh_that_is_not_made_yet_is_said(self):
        os.rmdir(os.path.join(self.case, "constant/polyMesh"))
        os.symlink("../../mesh/constant/polyMesh", os.path.join(self.case, "constant/polyMesh"))
        status, said = self.run_case()
        self.assertEqual(status, 1)
        self.assertTrue(re.search("is a link to a mesh that is not made yet", said))

    def test_a_case_without_means_of_k_and_epsilon_is_judged_by_its_loads_alone(self):
        self.set_parameter("turbulenceMeans", "no")
        solver = os.path.join(os.path.dirname(self.case), "bin", self.SOLVER_NAME)
        self.write(solver, SOLVER.replace("nearWake/{}/volFieldValue.dat", "nearWake/{}/other.dat"))
        self.assertEqual(self.run_case()[0], 0)
        self.assertEqual(self.rounds()["verdict"], "stationary")


# Steps of the size that the round says; FAKE "0 blow": those of the planned size blow up at once.
UNSTEADY_SOLVER = '''#!/usr/bin/env python3
import os, re, sys
print("Build  : 1\\nExec   : pimpleFoam", flush=True)
start = max(float(name) for name in os.listdir(".") if re.fullmatch(r"[0-9]+([.][0-9]+)?", name))
entry = {name: float(value) for name, value in re.findall(r"^(endTime|timeStep) ([0-9.]+);", open("round").read(), re.M)}
step = entry["timeStep"]
first, last = round(start / step) + 1, round(entry["endTime"] / step)
if os.environ["FAKE"] == "0 blow" and step == 0.02:
    print(f"Time = {step}\\nsigFpe::sigHandler")
    sys.exit(1)
for name in ("force.dat", "moment.dat"):
    path = f"postProcessing/forces/{start:g}/{name}"
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write("# Time values\\n" + "".join(f"{i * step:.10g} (0.4 0 {i % 7})\\n" for i in range(first, last + 1)))
os.makedirs(f"{entry['endTime']:.10g}")
print("".join(f"Time = {i * step:.10g}\\nExecutionTime = 1 s\\n" for i in range(first, last + 1)) + "End")
'''


class UnsteadyTest(IteratedCase):
    """A case in time: an iteration is a step."""

    SOLVER_NAME = "pimpleFoam"
    SOLVER = UNSTEADY_SOLVER

    def setUp(self):
        super().setUp()
        for name, value in (("solver", "pimpleFoam"), ("rateOfChange", "backward"), ("timeStep", "0.02"),
                            ("simulationType", "laminar"), ("turbulenceMeans", "no"), ("roundIterations", "70"), ("leastIterations", "210"),
                            ("stationarity", "0.2")):
            self.set_parameter(name, value)

    def test_a_case_in_time_counts_its_steps(self):
        self.assertEqual(self.run_case()[0], 0)
        rounds = self.rounds()
        self.assertEqual((rounds["verdict"], rounds["attempts"][0]["iterations"], rounds["averaging_start"]),
                         ("stationary", 210, 106))
        self.assertEqual([name for name in os.listdir(self.case) if re.match("[1-9]", name)], ["4.2"])
        self.assertEqual(len(self.histories()), 6)

    def test_what_blows_up_is_tried_with_half_the_step_for_as_long_a_time(self):
        self.assertEqual(self.run_case("0 blow")[0], 0)
        rounds = self.rounds()
        self.assertEqual([one["what"] for one in rounds["attempts"]], ["as planned", "half the step"])
        self.assertIn("diverged (floating point exception) at iteration 0.02", rounds["attempts"][0]["end"])
        self.assertEqual(rounds["attempts"][1]["iterations"], 420)
        self.assertIn("4.2", os.listdir(self.case))


if __name__ == "__main__":
    unittest.main()
