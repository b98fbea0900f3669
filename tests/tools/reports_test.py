#!/usr/bin/env python3
"""The reports: every program that ./dev runs can be run, and the tables of pages are those of their rows."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
# Which write their tables again from the rows of the last run.
REWRITING = {"falls_report.py": "docs/falls.md", "tows_report.py": "docs/falls.md", "references_report.py": "docs/falls.md",
             "step_auto.py": "docs/speed-against-error/step.md", "noise_report.py": "docs/noise.md", "surface_report.py": "docs/surface-loads.md",
             "test_falls_report.py": "docs/test-falls.md", "long_falls_report.py": "docs/falls.md",
             "ensembles_report.py": "docs/noise.md"}


class Reports(unittest.TestCase):
    def test_programs_that_dev_runs_can_be_run(self):
        with open(os.path.join(ROOT, "dev"), encoding="utf-8") as file:
            called = set(re.findall(r"tests/tools/[a-z_]+\.(?:py|sh)", file.read()))
        self.assertGreater(len(called), 10)
        for program in sorted(called):
            self.assertTrue(os.access(os.path.join(ROOT, program), os.X_OK), program)

    def test_tables_are_those_of_their_rows(self):
        with tempfile.TemporaryDirectory() as copy:
            for part in ("docs", "tests/tools", "foam-cases/templates", "foam-cases/farm"):
                shutil.copytree(os.path.join(ROOT, part), os.path.join(copy, part),
                                ignore=shutil.ignore_patterns("*.h5", "*.png", "*.gif", "node_modules", "__pycache__"))
            for program, page in REWRITING.items():
                subprocess.run([os.path.join("tests/tools", program)], cwd=copy, check=True, stdout=subprocess.DEVNULL)
                texts = []
                for root in (ROOT, copy):
                    with open(os.path.join(root, page), encoding="utf-8") as file:
                        texts.append(file.read())
                self.assertEqual(*texts, program)


if __name__ == "__main__":
    unittest.main()
