#!/usr/bin/env python3
"""What body-flow/iterate.py does with a case whose solver is stopped, whose disk was full, or whose files were damaged
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
# cut short, and all seems well).
SOLVER = '''#!/usr/bin/env python3
import os, re, sys
at, what = os.environ["FAKE"].split()
print("Build  : 1\\nExec   : simpleFoam", flush=True)
start = max(int(name) for name in os.listdir(".") if re.fullmatch(r"[0-9]+", name))
if os.path.getsize(f"{start}/U") == 0:
    sys.exit("--> FOAM FATAL IO ERROR: \\nthe file is cut short\\n\\nFOAM exiting")
end = int(re.search(r"endTime (\\d+);", open("round").read()).group(1))
full = what == "disk" and int(at) == end
for name, values in (("forces/{}/force.dat", "(0.4 0 0)"), ("forces/{}/moment.dat", "(0 0 0)"),
                     ("shell/{}/volFieldValue.dat", "0.01 0.02")):
    path = "postProcessing/" + name.format(start)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write("# Time values\\n" + "".join(f"{i} {values}\\n" for i in range(start + 1, end + 1 - 5 * full)))
os.makedirs(f"{end}")
with open(f"{end}/U", "w") as file:
    file.write("" if full else "values")
print("".join(f"Time = {i}\\nExecutionTime = 1 s\\n" for i in range(start + 1, end + 1)), flush=True)
if what == "kill" and int(at) == end:
    os.kill(os.getpid(), 9)
print("End")
'''


class IterateTest(FakedSolverTest):
    SOLVER_NAME = "simpleFoam"
    SOLVER = SOLVER

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

    def histories(self):
        found = {}
        for folder, _, names in os.walk(os.path.join(self.case, "postProcessing")):
            for name in names:
                with open(os.path.join(folder, name)) as file:
                    found[os.path.relpath(os.path.join(folder, name), self.case)] = file.read()
        return found

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

    def test_a_killed_solver_is_said_and_the_case_goes_on(self):
        status, said = self.run_case("200 kill")
        self.assertEqual(status, 1)
        self.assertIn("simpleFoam was stopped at iteration 200, before its end", said)
        self.assertIsNone(self.rounds()["verdict"])
        self.expect_solved_as_if_never_stopped()

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
                             ("shell/100/volFieldValue.dat", lambda path: os.truncate(path, 500)),
                             ("shell/0/volFieldValue.dat", lambda path: self.write(path, "# Time\n1.2.3 4\n"))):
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

    def test_a_mesh_that_is_not_made_yet_is_said(self):
        os.rmdir(os.path.join(self.case, "constant/polyMesh"))
        os.symlink("../../mesh/constant/polyMesh", os.path.join(self.case, "constant/polyMesh"))
        status, said = self.run_case()
        self.assertEqual(status, 1)
        self.assertTrue(re.search("is a link to a mesh that is not made yet", said))


if __name__ == "__main__":
    unittest.main()
