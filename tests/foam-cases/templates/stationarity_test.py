#!/usr/bin/env python3
"""Tests which histories body-flow/stationarity.py takes for stationary. Run by ctest."""

import math
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "foam-cases", "templates")
sys.path[:0] = [TEMPLATES, os.path.join(TEMPLATES, "body-flow")]
from case_files import CaseError, history  # noqa: E402
from stationarity import AREA_UNIT, Diverged, worst_quantity  # noqa: E402


class Case:
    """A folder with the histories of rounds of 100 iterations."""

    def __init__(self, iterations, force=lambda i: 1.0, k=lambda i: 0.01):
        self.folder = tempfile.TemporaryDirectory()
        self.iterations = iterations
        for start in range(0, iterations, 100):
            rows = range(start + 1, start + 101)
            self.write("forces", start, "force.dat", [(i, AREA_UNIT * force(i), 0.0, 0.0) for i in rows])
            self.write("forces", start, "moment.dat", [(i, 0.0, 0.0, 0.0) for i in rows])
            self.write("nearWake", start, "volFieldValue.dat", [(i, k(i), 0.02) for i in rows])

    def write(self, name, start, file, rows):
        folder = os.path.join(self.folder.name, "postProcessing", name, str(start))
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, file), "w") as out:
            out.write("# Time values\n" + "".join("\t".join(map(repr, row)) + "\n" for row in rows))

    def judge(self, first=0, viscosity=1e-4):
        return worst_quantity(self.folder.name, first, self.iterations, 0.01, True, viscosity=viscosity)


class Stationarity(unittest.TestCase):
    def test_a_steady_history_is_stationary(self):
        worst, _, start = Case(200).judge()
        self.assertLess(worst, 1e-9)
        self.assertEqual(start, 101)

    def test_a_k_that_still_grows_is_not_though_the_force_is_steady(self):
        worst, name, _ = Case(200, k=lambda i: 0.001 * i).judge()
        self.assertGreater(worst, 1.0)
        self.assertEqual(name, "k")

    def test_growth_by_a_tenth_for_each_doubling_is_found_at_any_number_of_iterations(self):
        for iterations in (200, 400, 800):
            worst, name, _ = Case(iterations, force=lambda i: 1.0 + 0.15 * math.log(i)).judge()
            self.assertGreater(worst, 1.0, iterations)
            self.assertEqual(name, "force")

    def test_a_fast_swing_about_a_steady_mean_is_stationary(self):
        worst, _, _ = Case(400, force=lambda i: 1.0 + 0.1 * math.sin(2 * math.pi * i / 11)).judge()
        self.assertLess(worst, 1.0)

    def test_a_swing_as_slow_as_the_window_is_not(self):
        worst, _, _ = Case(400, force=lambda i: 1.0 + 0.1 * math.sin(2 * math.pi * i / 150)).judge()
        self.assertGreater(worst, 1.0)

    def test_the_window_begins_after_the_settings_changed(self):
        worst, _, start = Case(400, force=lambda i: 2.0 if i <= 200 else 1.0).judge(first=200)
        self.assertEqual(start, 301)
        self.assertLess(worst, 1e-9)

    def test_values_that_are_not_finite_are_a_divergence(self):
        with self.assertRaises(Diverged):
            Case(200, force=lambda i: math.nan if i == 150 else 1.0).judge()

    def test_an_absurd_force_is_a_divergence(self):
        with self.assertRaises(Diverged):
            Case(200, force=lambda i: 100.0).judge()

    def test_the_drag_of_creeping_flow_is_none(self):
        Case(200, force=lambda i: 240.0).judge(viscosity=10.0)
        with self.assertRaises(Diverged):
            Case(200, force=lambda i: 2400.0).judge(viscosity=10.0)

    def test_a_k_that_is_not_positive_is_a_divergence(self):
        with self.assertRaises(Diverged):
            Case(200, k=lambda i: -0.01).judge()

    def test_a_history_without_its_last_iterations_is_refused(self):
        for file in ("forces/100/force.dat", "forces/100/moment.dat", "nearWake/100/volFieldValue.dat"):
            for rows in ([], [(101, 1.0, 0.0, 0.0), (103, 1.0, 0.0, 0.0)]):
                case = Case(200)
                case.write(*file.split("/"), rows)
                missing = 102 if rows else 101
                with self.assertRaisesRegex(CaseError, f"{file.split('/')[2]} has no iteration {missing} of 200"):
                    case.judge()

    def test_a_last_line_that_was_cut_short_is_none(self):
        case = Case(200)
        path = os.path.join(case.folder.name, "postProcessing/forces/100/force.dat")
        os.truncate(path, os.path.getsize(path) - 3)
        with self.assertRaisesRegex(CaseError, "has no iteration 200 of 200"):
            case.judge()

    def test_folders_that_are_no_times_are_passed_over(self):
        case = Case(200)
        case.write("forces", "notes", "force.dat", [(1, 7.0, 0.0, 0.0)])
        case.write("forces", "1.2.3", "force.dat", [(1, 7.0, 0.0, 0.0)])
        self.assertLess(case.judge()[0], 1e-9)

    def test_a_round_that_was_done_again_replaces_its_rows(self):
        case = Case(200)
        case.write("forces", 150, "force.dat", [(i, 7.0, 0.0, 0.0) for i in range(151, 201)])
        rows = history(case.folder.name, "forces", "force.dat")
        self.assertEqual([row[0] for row in rows], [float(i) for i in range(1, 201)])
        self.assertEqual(rows[-1][1], 7.0)


if __name__ == "__main__":
    unittest.main()
