#!/usr/bin/env python3
"""Tests free-fall/fall.py with falls that diverge, are stopped or are damaged, with a solver made here that is done
at once. Run by ctest."""

import json
import os
import shutil
import sys
import unittest

sys.dont_write_bytecode = True
from faked_solver import TEMPLATES, FakedSolverTest  # noqa: E402

# Falls for 4 time units, with a state at each whole one, of which it keeps the last two. FAKE: "LARGEST STEP" at which
# it does not blow up, and what stops it at time 2.5: nothing, "kill", "disk" (it ends there, as if all were well).
SOLVER = '''#!/usr/bin/env python3
import os, re, shutil, sys
largest, stop = os.environ["FAKE"].split()
text = open("parameters").read() + open("remedy").read()
step = float(re.findall(r"^timeStep +(\\S+);", text, re.M)[-1])
print("Build  : 1\\nExec   : pimpleFoam", flush=True)
start = max(float(name) for name in os.listdir(".") if re.fullmatch(r"[0-9.]+", name))
if os.path.exists(f"{start:g}/damaged"):
    sys.exit("--> FOAM FATAL IO ERROR: \\nthe file is cut short\\n\\nFOAM exiting")
os.makedirs(f"postProcessing/state/{start:g}")
with open(f"postProcessing/state/{start:g}/sixDoFRigidBodyState.dat", "w") as file:
    file.write("# Time centreOfRotation centreOfMass rotation velocity omega\\n")
    time = start
    while time < 4 - step / 2:
        time += step
        speed = 1 if step <= float(largest) else 1000
        file.write(f"{time:.10g} (0 0 0) (0 0 0) (0 0 0) ({speed} 0 0) (0 0 0)\\n")
        print(f"Courant Number mean: 0.1 max: 0.5\\nTime = {time:.10g}\\nExecutionTime = {time - start:g} s", flush=True)
        if abs(time - round(time)) < step / 4:
            os.makedirs(f"{round(time)}", exist_ok=True)
            if round(time) > 2:
                shutil.rmtree(f"{round(time) - 2}", ignore_errors=True)
        if time > 2.45 and stop != "nothing":
            file.flush()
            os.kill(os.getpid(), 9) if stop == "kill" else sys.exit(0)
print("End")
'''

PARAMETERS = """startVelocity       (0 0 0);
timeStep            0.1;
duration            4;
accelerationRelaxation 0.7;
"""


class FallTest(FakedSolverTest):
    SOLVER_NAME = "pimpleFoam"
    SOLVER = SOLVER

    def setUp(self):
        self.make_case("fall_00")
        os.makedirs(os.path.join(self.case, "0.orig"))
        for path in ("free-fall/fall.py", "case_files.py"):
            shutil.copy(os.path.join(TEMPLATES, path), self.case)
        self.write("parameters", PARAMETERS)
        self.write("0.orig/U", "at rest")

    def fall(self, largest_step=1.0, stop="nothing"):
        """The exit status and what was said of a run."""
        return self.run_faked("fall.py", f"{largest_step} {stop}")

    def state(self):
        with open(os.path.join(self.case, "attempts.json")) as file:
            return json.load(file)

    def set_state(self, change):
        state = self.state()
        change(state)
        self.write("attempts.json", json.dumps(state))

    def attempts(self):
        return [attempt["what"] for attempt in self.state()["attempts"]]

    def exists(self, name):
        return os.path.exists(os.path.join(self.case, name))

    def starts(self):
        return sorted(os.listdir(os.path.join(self.case, "postProcessing/state")))

    def test_a_fall_that_holds_takes_one_attempt(self):
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.state()["verdict"], "done")
        self.assertEqual(self.attempts(), ["as planned"])
        self.assertEqual(self.state()["cpu_seconds"], 4.0)

    def test_a_solved_fall_is_left_alone(self):
        self.fall()
        before = os.stat(os.path.join(self.case, "log.pimpleFoam")).st_mtime_ns
        self.assertEqual(self.fall(largest_step=0.0), (0, ""))
        self.assertEqual(os.stat(os.path.join(self.case, "log.pimpleFoam")).st_mtime_ns, before)

    def test_a_solved_fall_whose_history_is_gone_is_solved_again(self):
        self.fall()
        shutil.rmtree(os.path.join(self.case, "postProcessing"))
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.starts(), ["0"])

    def test_one_whose_history_is_gone_has_all_its_attempts_again(self):
        self.fall()
        shutil.rmtree(os.path.join(self.case, "postProcessing"))
        self.assertEqual(self.fall(largest_step=0.06), (0, ""))
        self.assertEqual(self.attempts(), ["as planned", "half the step"])

    def test_a_record_adds_nothing_but_numbers_to_the_case(self):
        self.fall(largest_step=0.06, stop="kill")
        whole = self.state()
        for damage in ('0.05; libs ("/tmp/strange.so")', "#calc \"1\"", None, [1]):
            self.set_state(lambda state: state["attempts"][-1].update(timeStep=damage))
            self.assertEqual(self.fall(largest_step=0.06, stop="kill")[0], 1)
            self.assertEqual(self.state(), whole)
        self.write("remedy", "#calc \"1\";\n")
        self.assertEqual(self.fall(largest_step=0.06), (0, ""))
        with open(os.path.join(self.case, "remedy")) as file:
            self.assertEqual(file.read().splitlines()[1:], ["timeStep 0.05;", "accelerationRelaxation 0.49;"])

    def test_a_file_with_the_name_of_a_module_of_pythons_is_not_run(self):
        self.write("json.py", "raise SystemExit('ran a stranger')\n")
        self.assertEqual(self.fall(), (0, ""))

    def test_a_divergence_is_followed_by_shorter_steps(self):
        self.assertEqual(self.fall(largest_step=0.03), (0, ""))
        self.assertEqual(self.attempts(), ["as planned", "half the step", "a quarter of the step"])
        first, second, third = self.state()["attempts"]
        self.assertIn("its speed is 1e+03 U", first["end"])
        self.assertIn("log.pimpleFoam.2", second["end"])
        self.assertTrue(self.exists("log.pimpleFoam.1"))
        self.assertEqual(third["timeStep"], "0.025")
        self.assertEqual(third["accelerationRelaxation"], "0.35")
        self.assertEqual(third["outerCorrectors"], 2)
        self.assertNotIn("end", third)

    def test_one_that_blows_up_every_time_fails_and_is_tried_anew_when_run_again(self):
        status, said = self.fall(largest_step=0.0)
        self.assertEqual(status, 1)
        self.assertIn("diverged", said)
        self.assertEqual(said.count("\n"), 1)
        self.assertEqual(self.state()["verdict"], "failed")
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.attempts(), ["as planned"])

    def test_a_killed_solver_is_no_divergence_and_the_fall_goes_on(self):
        status, said = self.fall(stop="kill")
        self.assertEqual(status, 1)
        self.assertIn("pimpleFoam was stopped at time 2.5", said)
        self.assertIsNone(self.state()["verdict"])
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.state()["attempts"][0]["went_on_from"], [2.0])
        self.assertEqual(self.starts(), ["0", "2"])
        # 2.5 of the killed run and 2 of the other.
        self.assertEqual(self.state()["cpu_seconds"], 4.5)

    def test_one_killed_before_its_first_state_starts_afresh(self):
        self.fall(stop="kill")
        for name in ("1", "2"):
            shutil.rmtree(os.path.join(self.case, name))
        self.assertEqual(self.fall(), (0, ""))
        self.assertNotIn("went_on_from", self.state()["attempts"][0])
        self.assertEqual(self.starts(), ["0"])

    def test_a_damaged_state_is_dropped_for_the_one_before(self):
        self.fall(stop="kill")
        self.write("2/damaged", "")
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.state()["attempts"][0]["went_on_from"], [2.0, 1.0])
        self.assertEqual(self.starts(), ["0", "1"])

    def test_a_history_that_ends_early_is_a_full_disk(self):
        status, said = self.fall(stop="disk")
        self.assertEqual(status, 1)
        self.assertIn("is the disk full?", said)
        self.assertIsNone(self.state()["verdict"])

    def test_a_kill_between_two_attempts_leaves_nothing_of_the_first(self):
        self.fall(stop="kill")

        def begun(state):
            state["attempts"][0].update(end="it diverged", cpu_seconds=1.0)
            state["attempts"].append({"what": "half the step", "started": False, "timeStep": "0.05",
                                      "accelerationRelaxation": "0.49"})

        self.set_state(begun)
        self.assertEqual(self.fall(largest_step=0.06), (0, ""))
        self.assertEqual(self.attempts(), ["as planned", "half the step"])
        self.assertEqual(self.starts(), ["0"])

    def test_a_kill_right_after_a_divergence_is_followed_by_the_next_attempt(self):
        self.fall(stop="kill")
        self.set_state(lambda state: state["attempts"][0].update(end="it diverged", cpu_seconds=1.0))
        self.assertEqual(self.fall(largest_step=0.06), (0, ""))
        self.assertEqual(self.attempts(), ["as planned", "half the step"])
        self.assertEqual(self.starts(), ["0"])

    def test_another_input_starts_afresh(self):
        self.fall(stop="kill")
        self.write("parameters", PARAMETERS.replace("0.1;", "0.2;"))
        self.assertEqual(self.fall(), (0, ""))
        self.assertEqual(self.starts(), ["0"])
        self.assertNotIn("went_on_from", self.state()["attempts"][0])


if __name__ == "__main__":
    unittest.main()
