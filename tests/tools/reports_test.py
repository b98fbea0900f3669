#!/usr/bin/env python3
"""The pages: programs that ./dev runs can be run, tables are those of their rows, and links lead somewhere."""

import csv
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
             "noise/ensembles_report.py": "noise/README.md", "surface-loads/surface_report.py": "surface-loads/README.md",
             "test-falls/test_falls_report.py": "test-falls/README.md", "falls/bodies_report.py": "falls/ready-baked.md",
             "motion/motion_report.py": "motion/README.md", "accuracy/accuracy_report.py": "../explanation/accuracy.md"}


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
            shutil.copy(os.path.join(ROOT, "README.md"), copy)
            for program, page in REWRITING.items():
                subprocess.run([os.path.join(STUDIES, program)], cwd=copy, check=True, stdout=subprocess.DEVNULL)
                texts = []
                for root in (ROOT, copy):
                    with open(os.path.join(root, STUDIES, page), encoding="utf-8") as file:
                        texts.append(file.read())
                self.assertEqual(*texts, program)
            with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as kept, open(f"{copy}/README.md", encoding="utf-8") as written:
                self.assertEqual(kept.read(), written.read())

    def test_counts_of_accuracy_stand_on_one_page(self):
        """How many falls are right is told by accuracy.md, the README and the studies alone: a second copy would grow old."""
        numbers = dict(enumerate("no one two three four five six seven eight nine ten".split()))
        with open(os.path.join(ROOT, STUDIES, "accuracy/accuracy.csv"), newline="", encoding="utf-8") as file:
            counts = {(int(row[column]), int(row["count"])) for row in csv.DictReader(file)
                      for column in ("regimes_right", "within_10_20_30")}
        told = "|".join(rf"\b(?:{part}|{numbers.get(part, part)}) of (?:the )?(?:{whole}|{numbers.get(whole, whole)})\b"
                        for part, whole in counts)
        pages = [page for page in pages_of(ROOT) if "/studies/" not in page
                 and not page.endswith(("explanation/accuracy.md", "README.md", "CHANGELOG.md"))]
        self.assertGreater(len(pages), 30)
        for page in pages:
            with open(page, encoding="utf-8") as file, self.subTest(page=os.path.relpath(page, ROOT)):
                self.assertIsNone(re.search(told, file.read()), "link to docs/explanation/accuracy.md instead")


def pages_of(root):
    folders = [*os.walk(os.path.join(root, "docs")), (root, [], os.listdir(root))]
    return [os.path.join(folder, name) for folder, _, names in folders for name in names if name.endswith(".md")]


def headings(path):
    """The anchors that the headings of a page have."""
    with open(path, encoding="utf-8") as file:
        titles = re.findall(r"^#+ +(.*?) *$", re.sub(r"^```.*?^```", "", file.read(), flags=re.S | re.M), re.M)
    titles = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title) for title in titles]
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


class Sizes(unittest.TestCase):
    def test_of_pages_are_a_readers(self):
        """Outside of the studies a page has fewer than 250 lines, and all together fewer than 60,000 words; the README 90 lines."""
        pages = {}
        for page in pages_of(ROOT):
            if "/studies/" not in page:
                with open(page, encoding="utf-8") as file:
                    pages[page] = file.read()
        for page, text in pages.items():
            if not page.endswith("CHANGELOG.md"):
                self.assertLess(text.count("\n"), 90 if page == os.path.join(ROOT, "README.md") else 250, os.path.relpath(page, ROOT))
        self.assertLess(sum(len(re.findall(r"\S*\w\S*", text)) for page, text in pages.items()
                            if not page.endswith("CHANGELOG.md")), 60000)


class Links(unittest.TestCase):
    def test_of_pages_lead_to_files_and_headings(self):
        pages = pages_of(ROOT)
        self.assertGreater(len(pages), 40)
        for page in pages:
            with open(page, encoding="utf-8") as file:
                text = re.sub(r"^```.*?^```|`[^`\n]*`", "", file.read(), flags=re.S | re.M)
            for target, anchor in re.findall(r"\]\((?![a-z]+:)([^)\s#]*)#?([^)\s]*)\)", text):
                with self.subTest(page=os.path.relpath(page, ROOT), target=target, anchor=anchor):
                    path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
                    self.assertTrue(os.path.exists(path))
                    if anchor:
                        self.assertIn(anchor, headings(path))


if __name__ == "__main__":
    unittest.main()
