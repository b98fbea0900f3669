#!/usr/bin/env python3
"""The bodies and the literature of docs/studies/closures (closures_study.py), and the case that is made of each model. Run by ctest."""

import collections
import math
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "docs", "studies", "closures"))
from closures_report import make_case, read, set_parameters  # noqa: E402
from closures_study import BODIES, MESHES, MODELS, STUDY, brown_lawler, cross, minus, norm  # noqa: E402


def written_triangles(body):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "body.stl")
        body.write(path)
        with open(path) as file:
            points = [tuple(map(float, line.split()[1:])) for line in file if line.startswith("vertex")]
    return [points[i:i + 3] for i in range(0, len(points), 3)]


class Bodies(unittest.TestCase):
    def test_are_closed_look_outwards_and_have_the_area_pi(self):
        for name, body in BODIES.items():
            triangles = written_triangles(body)
            edges = collections.Counter((a, b) for p, q, r in triangles for a, b in ((p, q), (q, r), (r, p)))
            self.assertEqual(max(edges.values()), 1, name)
            self.assertTrue(all((b, a) in edges for a, b in edges), name)
            normals = [cross(minus(q, p), minus(r, p)) for p, q, r in triangles]
            self.assertAlmostEqual(sum(map(norm, normals)) / 2, math.pi, 5, name)
            volume = sum(sum(n * x for n, x in zip(normal, p)) for normal, (p, q, r) in zip(normals, triangles)) / 6
            self.assertGreater(volume, 0.0, name)

    def test_have_the_lengths_and_areas_of_the_literature(self):
        sphere, cube = BODIES["sphere"], BODIES["cube"]
        self.assertAlmostEqual(sphere.length, 1.0, 2)
        self.assertAlmostEqual(sphere.area, math.pi / 4, 2)
        self.assertAlmostEqual(6 * cube.length ** 2, math.pi)
        self.assertAlmostEqual(cube.area, cube.length ** 2)

    def test_show_their_literature_area_to_the_flow(self):
        for name, body in BODIES.items():
            normals = [cross(minus(q, p), minus(r, p)) for p, q, r in written_triangles(body)]
            shadow = sum(abs(sum(n * d for n, d in zip(normal, body.direction))) for normal in normals) / 4
            self.assertAlmostEqual(shadow / body.area, 1.0, 2, name)

    def test_the_spheres_drag_is_stokes_at_the_slow_end_and_0_4_at_the_fast_one(self):
        self.assertAlmostEqual(brown_lawler(1e-3) * 1e-3 / 24, 1.0, 2)
        self.assertAlmostEqual(brown_lawler(1e5), 0.466, 3)


class Study(unittest.TestCase):
    def test_names_what_there_is(self):
        for body, _, model, mesh in STUDY:
            self.assertIn(body, BODIES)
            self.assertIn(model, MODELS)
            self.assertIn(mesh, MESHES)

    def test_sets_entries_that_the_template_has(self):
        with tempfile.TemporaryDirectory() as folder:
            for settings in (*MODELS.values(), *MESHES.values()):
                case = os.path.join(folder, "case")
                make_case(case)
                entries = {name: value for name, value in settings.items() if name != "inflow"}
                set_parameters(case, entries)
                for name, value in entries.items():
                    self.assertIn(f" {value};", read(os.path.join(case, "parameters")), name)


if __name__ == "__main__":
    unittest.main()
