#!/usr/bin/env python3
"""The cases of docs/studies/nature: what is measured of a fall, the scenes, the fruits' mass and the tables. Run by ctest."""

import csv
import glob
import math
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
PROJECT = os.path.join(HERE, "..", "..", "..")
sys.path[:0] = glob.glob(os.path.join(PROJECT, "docs", "studies", "*", ""))
import nature_fruit  # noqa: E402
import nature_scenes  # noqa: E402
from study_pictures import Pose, rotation_of  # noqa: E402
from nature_families import FRUITS, REGIMES, slope, transition  # noqa: E402
from nature_measure import coning, drift, first_acceleration, horizontal_speed, measured, peak_speed, spin, turning_rate  # noqa: E402
from nature_report import mean_of_flights, with_copies  # noqa: E402
from nature_study import ACCELERATIONS, CASES, REGIME, added_mass, fruit_name, terminal_speed  # noqa: E402
from nature_study import first_acceleration as exact_acceleration  # noqa: E402
from nature_tables import DERIVED, MODELS, bracket, derived, merged, misses, told  # noqa: E402

UPRIGHT = rotation_of(1, 0, 0, 0)


def fall(velocity, turning=lambda t: (0, 0, 0), rotation=UPRIGHT, seconds=2.0, frames=201):
    times = [seconds * i / (frames - 1) for i in range(frames)]
    return [Pose(t, (0, 0, 0), rotation, velocity(t), turning(t)) for t in times]


def published():
    with open(os.path.join(PROJECT, "docs", "studies", "nature", "published.csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Measures(unittest.TestCase):
    def test_the_first_acceleration_is_read_past_a_jolt_and_before_drag(self):
        jolted = fall(lambda t: (0, 0, -(2 * t - 0.5 * t ** 3 + (0.03 if t > 0.01 else 0))), seconds=0.5)
        self.assertAlmostEqual(first_acceleration(jolted)[0], 2.0, 3)

    def test_a_straight_fall_drifts_nowhere_and_an_aslant_one_by_its_angle(self):
        self.assertEqual(drift(fall(lambda t: (0, 0, -1)))[0], 0.0)
        self.assertAlmostEqual(drift(fall(lambda t: (1, 0, -1)))[0], 45.0)

    def test_swings_to_and_fro_are_neither_a_speed_nor_a_turning_rate(self):
        swings = fall(lambda t: (math.cos(20 * math.pi * t), 0, -1), lambda t: (math.cos(20 * math.pi * t), 0, 0), seconds=3.0, frames=3001)
        self.assertLess(horizontal_speed(swings)[0], 0.01)
        self.assertLess(turning_rate(swings)[0], 0.01)

    def test_a_seed_spins_and_cones(self):
        raised = rotation_of(math.cos(-0.15), 0, math.sin(-0.15), 0)  # by 0.3 rad
        seed = fall(lambda t: (0, 0, -1), lambda t: (0, 0, -4 * math.pi), raised)
        self.assertAlmostEqual(spin(seed)[0], 2.0)
        self.assertAlmostEqual(coning(seed)[0], math.degrees(0.3))

    def test_the_peak_is_downwards(self):
        self.assertEqual(peak_speed(fall(lambda t: (9, 0, 3 - 4 * t)))[0], 5.0)

    def test_every_quantity_of_every_case_can_be_measured(self):
        poses = fall(lambda t: (0.1, 0, -1 - t), lambda t: (0, 0, 1))
        for case in CASES:
            for quantity in case.measures:
                if quantity != REGIME:
                    self.assertTrue(math.isfinite(measured(case, quantity, poses)[0]), case.name)


class Study(unittest.TestCase):
    def test_added_mass_of_spheres_and_ellipsoids_is_lambs(self):
        self.assertAlmostEqual(added_mass((1, 1, 1), 0), 0.5, 5)
        for axis, coefficient in enumerate((1.518, 0.398, 0.127)):
            self.assertAlmostEqual(added_mass((1, 2, 4), axis), coefficient, 3)

    def test_the_exact_accelerations_are_those_that_are_published(self):
        figures = {row["case"]: float(row["value"]) for row in published() if row["verified"] == "exact"}
        for name, body in ACCELERATIONS.items():
            self.assertAlmostEqual(figures[name], exact_acceleration(*body), 5)

    def test_a_slow_sphere_sinks_as_stokes_says(self):
        self.assertAlmostEqual(terminal_speed(1e-4, 1.5, 1e-4) / (0.5 * 9.81 * 1e-8 / 18 / 1e-4), 1.0, 2)

    def test_the_scenes_are_those_that_are_written(self):
        with tempfile.TemporaryDirectory() as folder:
            nature_scenes.main(folder)
            for name in os.listdir(folder):
                with open(os.path.join(folder, name), encoding="utf-8") as new, \
                        open(os.path.join(PROJECT, "docs", "studies", "nature", name), encoding="utf-8") as kept:
                    self.assertEqual(new.read(), kept.read(), name)
        for case in CASES:
            self.assertTrue(os.path.exists(os.path.join(PROJECT, case.scene)), case.scene)
            if case.reference:
                self.assertTrue(os.path.exists(os.path.join(PROJECT, case.reference)), case.reference)


class Fruits(unittest.TestCase):
    def test_have_the_volume_of_the_authors_cad_model(self):
        # Wings upright, radius of curvature 30 mm: 5986.4 mm^3 outside, 2918.6 mm^3 of plastic, less two holes in the pod's wall.
        self.assertAlmostEqual(nature_fruit.outer_volume(0.1, 30) / 5986.4, 1.0, 3)
        holes = 2 * math.pi * 1.5 ** 2 * nature_fruit.POD_WALL
        self.assertAlmostEqual((nature_fruit.plastic_volume(0.1, 30) - holes) / 2918.6, 1.0, 3)

    def test_a_heavier_payload_hangs_lower(self):
        masses = [nature_fruit.mass_properties(0, 26, payload) for payload in (0.54, 2.16, 4.0)]
        self.assertEqual(sorted(masses), masses)
        self.assertEqual([mass[1] for mass in masses], sorted((mass[1] for mass in masses), reverse=True))
        for _, _, inertia in masses:
            self.assertGreater(min(inertia[i][i] for i in range(3)), 0)


    def test_all_84_are_there_and_those_of_the_table_are_among_them(self):
        with open(os.path.join(PROJECT, FRUITS), newline="", encoding="utf-8") as file:
            fruits = {fruit_name(int(row["angle"]), int(row["radius"]), float(row["payload"])): row for row in csv.DictReader(file)}
        self.assertEqual(len(fruits), 84)
        for row in published():
            if row["case"].startswith("fruit-"):
                one = fruits[row["case"]]
                column = "spin" if row["quantity"] == "spin" else "descent"
                self.assertEqual((float(row["value"]), float(row["uncertainty"])),
                                 (float(one[column]), float(one[f"{column}_deviation"])), row["case"])


class Families(unittest.TestCase):
    @staticmethod
    def strip(froude, fluttering, tumbling):
        return {"froude": str(froude)} | dict.fromkeys(REGIMES, "0") | {"fluttering": str(fluttering), "tumbling": str(tumbling)}

    def test_strips_go_over_where_most_of_them_no_longer_flutter(self):
        falls = [self.strip(0.4, 20, 0), self.strip(0.6, 11, 9), self.strip(0.8, 9, 11), self.strip(1.0, 0, 20)]
        self.assertEqual(transition(falls), "between 0.6 and 0.8")
        self.assertEqual(transition(falls[:2]), "above 0.6")
        self.assertEqual(transition(falls[2:]), "below 0.8")
        self.assertEqual(transition([falls[0], falls[2], self.strip(0.9, 20, 0)]), "not sharp, 0.8 to 0.9")

    def test_an_exponent_is_that_of_a_power(self):
        self.assertAlmostEqual(slope([(x, 7 * x ** -0.5) for x in (0.3, 1, 4)]), -0.5)

    def test_the_error_of_a_mean_is_the_falls_drift_and_the_means_own(self):
        self.assertEqual(mean_of_flights([(2.0, 0.1)]), (2.0, 0.1))
        value, error = mean_of_flights([(1.0, 0.3), (3.0, 0.3)])
        self.assertEqual(value, 2.0)
        self.assertAlmostEqual(error, math.hypot(0.3, math.sqrt(2.0) / math.sqrt(2)))

    def test_copies_have_the_noise_that_a_scene_has_of_itself(self):
        text = with_copies('[[body]]\nname = "a"\nshape = "a.geo"\nturbulence = "none"\n', "/tmp/b.body.h5", "surface")
        self.assertNotIn("turbulence", text)
        self.assertIn('shape = "/tmp/b.body.h5"', text)
        self.assertIn('loads = "surface"', text)


class Tables(unittest.TestCase):
    def test_every_published_figure_is_of_a_case_that_measures_it(self):
        measures = {case.name: case.measures for case in CASES}
        for row in published():
            self.assertIn(row["verified"], ("yes", "in part", "no", "exact"))
            if row["case"] not in DERIVED:
                self.assertIn(row["quantity"], measures[row["case"]], row["case"])

    def test_what_is_not_measured_is_not_solved_yet(self):
        rows = merged(published(), [], [])
        self.assertEqual(len(rows), len(published()))
        self.assertEqual({told(row, column) for row in rows for column in MODELS.values()}, {"not solved yet", "no case yet"})

    def test_what_a_folder_has_not_stays_as_it_was_measured(self):
        before = [dict(row, tables="1.3", tables_error="0.1") if row["case"] == "sphere-ga-144" else row
                  for row in merged(published(), [], [])]
        after = merged(published(), [], before)
        self.assertEqual({row["tables"] for row in after if row["case"] == "sphere-ga-144"}, {"1.3"})
        self.assertEqual({row["tables"] for row in after if row["case"] != "sphere-ga-144"}, {""})

    def test_a_miss_is_bold_and_a_figure_within_the_uncertainty_is_not(self):
        def row(speed):
            found = merged(published(), [{"case": "sphere-ga-144", "quantity": "descent speed", "model": "surface", "value": speed,
                                          "error": "0", "by": ""}], [])
            return next(each for each in found if each["case"] == "sphere-ga-144" and each["quantity"] == "descent speed")

        speed = 1.285 * 0.442944691807
        self.assertEqual(told(row(str(speed)), "surface"), "1.285 (+0.0 %)")
        self.assertFalse(misses(row(str(1.004 * speed)), "surface"))
        self.assertTrue(told(row(str(0.95 * speed)), "surface").startswith("**"))

    def test_a_transition_lies_between_the_last_and_the_first(self):
        falls = [(0.4, "fluttering"), (0.6, "fluttering"), (0.8, "tumbling")]
        self.assertEqual(bracket(falls, "fluttering", "tumbling"), "between 0.6 and 0.8")
        self.assertEqual(bracket([(0.4, "fluttering")], "fluttering", "tumbling"), "above 0.4")
        self.assertIsNone(bracket([], "fluttering", "tumbling"))

    def test_a_transition_holds_where_its_bracket_meets_the_published_one(self):
        def row(text):
            return {"quantity": "Froude number of the transition", "published": "0.67", "uncertainty": "0.05", "verified": "yes",
                    "surface": text, "surface_error": ""}

        self.assertTrue(misses(row("between 0.8 and 0.85"), "surface"))
        self.assertFalse(misses(row("between 0.7 and 0.75"), "surface"))
        self.assertIsNone(misses(row("above 1"), "surface"))

    def test_the_cards_exponents_are_those_of_their_rates(self):
        rates = {"card-20-0_3": 10.0, "card-20-0_6": 10.0 * math.sqrt(2), "card-30-0_3": 10.0 * 2 / 3}
        found = derived({(name, "turning rate"): rate for name, rate in rates.items()})
        self.assertEqual(found["cards", "exponent of the thickness"], "0.5")
        self.assertEqual(found["cards", "exponent of the width"], "-1")


if __name__ == "__main__":
    unittest.main()
