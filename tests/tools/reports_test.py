#!/usr/bin/env python3
"""The reports: every program that ./dev runs can be run, and the tables of pages are those of their rows."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
STUDIES = "docs/studies"
# Which write their tables again from the rows of the last run, and the pages that hold these.
REWRITING = {"falls/falls_report.py": "falls/README.md", "falls/tows_report.py": "falls/README.md",
             "falls/references_report.py": "falls/README.md", "falls/long_falls_report.py": "falls/README.md",
             "step/step_auto.py": "step/README.md", "noise/noise_report.py": "noise/README.md",
             "noise/ensembles_report.py": "noise/README.md", "surface-loads/surface_report.py": "../surface-loads.md",
             "test-falls/test_falls_report.py": "test-falls/README.md", "falls/bodies_report.py": "../shapes.md"}


class Reports(unittest.TestCase):
    def test_programs_that_dev_runs_can_be_run(self):
        with open(os.path.join(ROOT, "dev"), encoding="utf-8") as file:
            called = set(re.findall(r"(?:tests/tools|docs/studies)/[a-z_/-]+\.(?:py|sh)", file.read()))
        self.assertGreater(len(called), 10)
        for program in sorted(called):
            self.assertTrue(os.access(os.path.join(ROOT, program), os.X_OK), program)

    def test_tables_are_those_of_their_rows(self):
        with tempfile.TemporaryDirectory() as copy:
            for part in ("docs", "foam-cases/templates", "foam-cases/farm"):
                shutil.copytree(os.path.join(ROOT, part), os.path.join(copy, part),
                                ignore=shutil.ignore_patterns("*.h5", "*.png", "*.gif", "__pycache__"))
            for program, page in REWRITING.items():
                subprocess.run([os.path.join(STUDIES, program)], cwd=copy, check=True, stdout=subprocess.DEVNULL)
                texts = []
                for root in (ROOT, copy):
                    with open(os.path.join(root, STUDIES, page), encoding="utf-8") as file:
                        texts.append(file.read())
                self.assertEqual(*texts, program)


if __name__ == "__main__":
    unittest.main()
