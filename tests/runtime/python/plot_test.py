#!/usr/bin/env python3
"""samara.plot and samara.report: pictures that can be read off, of motions and bodies that are hard to draw."""

import glob
import itertools
import math
import os
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.text import Text  # noqa: E402

import samara  # noqa: E402
from samara import plot, report  # noqa: E402
from samara.plot import silhouettes, style  # noqa: E402

SOURCES = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))


def cube(size=1.0):
    """Vertices and triangles, anticlockwise from outside."""
    vertices = size * (np.array(list(itertools.product((0.0, 1.0), repeat=3))) - 0.5)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])


def flaws(figure):
    """What keeps a picture from being read off: texts that overlap or leave it, numbers that are none, bare panels."""
    figure.canvas.draw()
    renderer, found = figure.canvas.get_renderer(), []
    width, height = figure.get_size_inches() * figure.dpi
    texts = [(text.get_text(), text.get_window_extent(renderer)) for text in figure.findobj(Text)
             if text.get_visible() and text.get_text().strip()]
    texts = [(words, box) for words, box in texts if box.width > 0]
    for i, (words, box) in enumerate(texts):
        if re.search(r"\b(nan|inf|None)\b", words):
            found.append(f"no number: {words}")
        if box.x0 < -1 or box.y0 < -1 or box.x1 > width + 1 or box.y1 > height + 1:
            found.append(f"leaves the picture: {words}")
        for other, place in texts[:i]:
            across = min(box.x1, place.x1) - max(box.x0, place.x0)
            up = min(box.y1 - 0.2 * box.height, place.y1 - 0.2 * place.height) - max(box.y0 + 0.2 * box.height,
                                                                                     place.y0 + 0.2 * place.height)
            if across > 1 and up > 1:
                found.append(f"overlap: {words} and {other}")
    for axes in figure.axes:
        if axes.name != "rectilinear" or not axes.axison or axes.get_label() == "<colorbar>":
            continue
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            numbers = [tick for tick in axis.get_majorticklocs() if low - 1e-9 * abs(high - low) <= tick <= high
                       + 1e-9 * abs(high - low)]
            labels = {text.get_text() for text in axis.get_majorticklabels() if text.get_visible()}
            if len(numbers) == 1 or len(labels) == 1:
                found.append(f"one number along an axis: {numbers}")
        if not (axes.lines or axes.collections or axes.patches):
            found.append("a panel shows nothing")
    return found


class Pose:
    """A synthetic motion as samara's programs hand it over: frames of (position, tilt about y, rates)."""

    def __init__(self, place, tilt, duration=4.0, rate=60.0, size=0.08, name="leaf", **more):
        times = np.arange(int(round(duration * rate)) + 1) / rate
        position = np.array([place(time) for time in times])
        angle = np.array([tilt(time) for time in times])
        spin = np.gradient(angle, times) if len(times) > 1 else np.zeros(1)
        velocity = np.gradient(position, times, axis=0) if len(times) > 1 else np.zeros((1, 3))
        vertices, triangles = cube()
        vertices = vertices * size * np.array([1.0, 0.5, 0.15])
        folded = np.abs(np.arcsin(np.abs(np.sin(angle))))
        begin, end = times[0], times[-1]
        measures = {"window": [begin + (end - begin) / 3, end], "mean_velocity": list(velocity.mean(axis=0)),
                    "descent_speed": float(-velocity[:, 2].mean()), "mean_inclination": float(folded.mean()),
                    "inclination_amplitude": float(np.percentile(folded, 95)), "frequency": None,
                    "regime": "fluttering",
                    "rms_angular_speed": float(np.sqrt((spin**2).mean())), **more.pop("measures", {})}
        common = {"name": name, "run": 0, "runs": 1, "copy": 0, "copies": 1, "measures": measures, "fall": [begin, end],
                  **more}
        zero = np.zeros(len(times))
        self.strip = {"picture": "strip", **common, "times": times, "position": position,
                      "orientation": np.column_stack([zero, np.sin(angle / 2), zero, np.cos(angle / 2)]),
                      "descent_speed": -velocity[:, 2], "inclination": folded,
                      "angular_velocity": np.column_stack([zero, spin, zero]),
                      "vertices": vertices, "triangles": triangles}
        turned = np.floor(angle / math.pi + 0.5)
        self.phase = {"picture": "phase", **common, "times": times, "angle": angle - math.pi * turned, "rate": spin,
                      "continues": np.concatenate([[False], np.diff(turned) == 0]), "frames_in_swing": None}


def flutter(time):
    return 0.7 * math.cos(7.0 * time)


def sink(speed, sway=0.02, at=(0.0, 0.0, 0.0)):
    return lambda time: np.array([at[0] + sway * math.sin(7.0 * time), at[1] + 0.3 * sway * time, at[2] - speed * time])


LONG = ("Aeronautically_{improbable} 'leaf' of \\Acer & \"friends\" $x_1^2$, größer als je zuvor gesehen, "
        "the third of its kind, and so on")
HARD = {
    "flutter": Pose(sink(0.2), flutter), "tumbling": Pose(sink(0.4), lambda t: 8.0 * t),
    "rest": Pose(sink(0.0, 0.0), lambda t: 0.0),
    "one frame": Pose(sink(0.4), lambda t: 0.3, duration=0.0), "two frames": Pose(sink(0.2), flutter, duration=1 / 60),
    "straight down": Pose(sink(0.5, 0.0), lambda t: 0.0, duration=6.0), "slow": Pose(sink(1e-7, 0.0), lambda t: 0.0,
                                                                                     duration=2.0),
    "coarse": Pose(sink(0.2), flutter, rate=18.0, ), "long": Pose(sink(0.2), flutter, duration=400.0, rate=20.0),
    "far away": Pose(sink(0.2, at=(-54321.0, 12345.6, -98765.4)), flutter),
    "high": Pose(sink(0.2, at=(0.0, 0.0, 7531.2)), flutter),
    "huge": Pose(sink(2e6, 2e5), flutter, size=8e5), "tiny": Pose(sink(2e-7, 2e-8), flutter, size=8e-8),
    "long name": Pose(sink(0.2), flutter, name=LONG), "one of many": Pose(sink(0.2), flutter, runs=3, copies=50),
    "wide": Pose(lambda t: np.array([t, 0.3 * math.sin(t), 0.0]), lambda t: 20.0 * t, duration=2.0),
}


def landing(count, spread, landed=True, at=(0.0, 0.0), size=0.08, name="leaf"):
    angle = 2.4 * np.arange(count)
    places = np.asarray(at) + spread * np.column_stack([np.cos(angle), np.sin(3.0 * angle)])
    mean = places.mean(axis=0)
    distances = np.linalg.norm(places - mean, axis=1)
    paths = [[list(at), list(place)] for place in places[:200]]
    return {"picture": "landing", "name": name, "runs": 1, "copies": count, "samples": count + 2, "landed": count
            if landed else 0,
            "mean": [*mean, -1.0], "spread": float(np.sqrt((distances**2).mean())),
            "median": float(np.median(distances)), "end": 4.0,
            "radius": size, "places": places, "values": 1.0 + 0.1 * np.sin(angle), "paths": paths}


class Pictures(unittest.TestCase):
    def test_of_hard_motions_can_be_read_off(self):
        for name, pose in HARD.items():
            for draw, data in ((plot.motion, pose.strip), (plot.phase, pose.phase)):
                with self.subTest(name, picture=data["picture"]):
                    self.assertEqual(flaws(draw(data)), [])

    def test_of_hard_landings_can_be_read_off(self):
        for name, data in {"two": landing(2, 0.2, False), "one place": landing(3, 0.0), "crowd": landing(1000, 0.3),
                           "far away": landing(40, 0.3, at=(-54321.0, 98765.4)), "huge": landing(40, 3e6, size=8e5),
                           "tiny": landing(40, 3e-7, size=8e-8), "long name": landing(40, 0.3, name="W" * 120)}.items():
            with self.subTest(name):
                self.assertEqual(flaws(plot.landing(data)), [])

    def test_of_all_shipped_bodies_can_be_read_off(self):
        for file in sorted(glob.glob(f"{SOURCES}/runtime/bodies/*.body.h5")):
            body = samara.Body.read(file)
            if body.force_table is None:
                continue
            for draw in (plot.polars, plot.sphere, plot.convergence):
                with self.subTest(body.name, picture=draw.__name__):
                    self.assertEqual(flaws(draw(body)), [])

    def test_of_plans_meshes_and_histories_can_be_read_off(self):
        directions = np.random.default_rng(1).normal(size=(500, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        mesh = {"title": "mesh_fine: 12345 cells", "cells": np.random.default_rng(2).uniform(-1, 1, (300, 4)),
                "body": [[-0.5, 0.0, 0.5, 0.0]], "half_width": 1.0, "half_height": 0.6}
        iterations = list(range(1, 300))
        case = {"iterations": iterations, "drag": [1.0 + math.exp(-i / 30) for i in iterations], "k": [],
                "residuals": [0.1 / i for i in iterations],
                "moment": [0.1] * 299, "residual_iterations": iterations}
        pictures = [{"picture": "plan", "name": "leaf", "visited": directions, "cases": directions[:20]},
                    {"picture": "plan", "name": LONG, "visited": [], "cases": []},
                    *({"picture": "meshes", "name": "leaf", "meshes": [mesh] * count} for count in (1, 2, 3, 4)),
                    {"picture": "histories", "name": "leaf", "cases": [case, {key: [] for key in case}]}]
        for data in pictures:
            with self.subTest(data["picture"]):
                self.assertEqual(flaws(plot.draw(data)), [])

    def test_that_are_drawn_wrong_are_caught(self):
        figure = plot.motion(HARD["flutter"].strip)
        figure.text(0.3, 0.96, "much too long a text for this place " * 9)
        self.assertTrue(any("leaves the picture" in flaw for flaw in flaws(figure)))
        self.assertTrue(any("overlap" in flaw for flaw in flaws(figure)))

    def test_leave_matplotlib_as_it_was(self):
        before = dict(matplotlib.rcParams)
        with tempfile.TemporaryDirectory() as folder:
            plot.save(plot.phase(HARD["flutter"].phase), os.path.join(folder, "phase.png"))
            with self.assertRaisesRegex(ValueError, "end the name in .png or .svg"):
                plot.save(plot.phase(HARD["flutter"].phase), os.path.join(folder, "phase.pdf"))
        self.assertEqual(before, dict(matplotlib.rcParams))


class Silhouettes(unittest.TestCase):
    def test_follow_at_even_times_without_smearing(self):
        shown = plot.motion(HARD["flutter"].strip).shown
        self.assertTrue(8 <= shown["silhouettes"] <= 40)
        self.assertEqual(shown["strip"], [0.0, 4.0])
        self.assertEqual(plot.motion(HARD["rest"].strip).shown["silhouettes"], 1)

    def test_of_a_long_fall_are_of_its_last_stretch(self):
        vertices, _ = cube(1.0)  # its largest extent is the root of three
        position = np.column_stack([np.zeros(1201), np.zeros(1201), -np.arange(1201) / 10.0])
        rotation = np.tile(np.eye(3), (1201, 1, 1))
        first, frames = silhouettes.chosen_frames(position, rotation, vertices, 0, 1200)
        self.assertAlmostEqual((1200 - first) / 10.0, 24.0 * math.sqrt(3.0), delta=0.2)
        self.assertEqual(len(set(np.diff(frames))), 1)

    def test_nearly_touch_where_a_body_sinks(self):
        vertices, _ = cube(0.02)  # sinks 4.67 mm a frame: apart after 4.3 frames
        position = np.column_stack([np.zeros(121), np.zeros(121), -0.28 / 60 * np.arange(121)])
        _, frames = silhouettes.chosen_frames(position, np.tile(np.eye(3), (121, 1, 1)), vertices, 0, 120)
        self.assertEqual(frames[1] - frames[0], 5)

    def test_show_the_side_to_the_viewer_brighter_above(self):
        body = silhouettes.Silhouettes(*cube(2.0), 1)
        turn = np.array([[1, 0, 0], [0, math.cos(0.5), -math.sin(0.5)], [0, math.sin(0.5), math.cos(0.5)]])
        polygons, colors = body.painted(np.array([5.0, 6.0, 7.0]), turn, silhouettes.FRONT, (0.2, 0.4, 0.6), 1e-9)
        x, y = polygons[..., 0], polygons[..., 1]
        areas = 0.5 * np.abs((x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1))
        self.assertAlmostEqual(areas.sum(), 2.0 * 2.0 * (math.cos(0.5) + math.sin(0.5)), places=5)
        self.assertAlmostEqual(x.min(), 4.0, places=6)
        heights = y.mean(axis=1)[areas > 0.5]
        self.assertGreater(colors[areas > 0.5][heights.argmax()].sum(), colors[areas > 0.5][heights.argmin()].sum()
                           + 0.1)

    def test_of_large_surfaces_are_simplified_to_the_same_form(self):
        vertices, triangles = cube()
        for _ in range(5):  # to 12288 triangles
            a, b, c = (vertices[triangles[:, i]] for i in range(3))
            corners = np.stack([a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2], axis=1).reshape(-1, 3)
            vertices, places = np.unique(corners.round(9), axis=0, return_inverse=True)
            places = places.reshape(-1, 6)
            triangles = np.concatenate([places[:, order] for order in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5])])
        merged, fewer = silhouettes.simplified(vertices, triangles, 3000)
        self.assertTrue(300 < len(fewer) <= 3000)
        edges = merged[fewer]
        area = 0.5 * np.linalg.norm(np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0]), axis=1).sum()
        self.assertAlmostEqual(area, 6.0, delta=0.5)


class Lengths(unittest.TestCase):
    def test_are_numbered_less_an_origin_or_in_powers_of_ten(self):
        for ends, title in (((-1.0, 0.1), "z (m)"), ((0.0, 0.03), "z (m)"), ((-940.0, 10.0), "z (m)"),
                            ((98765.1, 98765.9), "z − 98766 (m)"),
                            ((-98765.9, -98765.1), "z + 98766 (m)"), ((-4e6, 0.0), "z (10⁶ m)"),
                            ((-4e-7, 0.0), "z (10⁻⁹ m)")):
            self.assertEqual(style.Lengths(*ends, 985.0).title("z"), title)
        self.assertEqual(style.Lengths(-4e6, 0.0, 985.0).of(-3e6), -3.0)

    def test_have_two_numbers_at_least(self):
        for low, size, most in itertools.product((-3.7, 0.0, 12.34, 1e6), (1e-9, 0.3, 7.0, 9.99, 5e5), (1.0, 2.3, 9.0)):
            places = style.RoundLocator(most).tick_values(low, low + size)
            self.assertGreaterEqual(len(places), 2)
            self.assertTrue(low - 1e-6 * size <= places[0] and places[-1] <= low + size * (1 + 1e-6) + 1e-9)


class OfObjects(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = samara.simulate(samara.Scene({
            "scene": {"duration": 1.0, "ground": 0, "frame_rate": 60}, "fluid": {"preset": "air"},
            "body": [{"name": "leaf-one", "shape": "samara:leaf", "position": [70000.0, 0, 0.5], "count": 5,
                      "spread": {"position": [0.2, 0.2, 0.1], "angle": 0.5}}]}), runs=2)

    def test_motions_are_drawn_wherever_they_are(self):
        with tempfile.TemporaryDirectory() as folder:
            figure = plot.motion(self.motion, "leaf-one", run=1, copy=3)
            self.assertEqual(flaws(figure), [])
            file = os.path.join(folder, "leaf.svg")
            plot.save(figure, file)
            with open(file, encoding="utf-8") as opened:
                text = opened.read()
        self.assertTrue("leaf-one: " in text and "x − 70000 (m)" in text)
        painted = re.search(r'<g id="silhouettes_x">(.*?)</g>\s*<g id', text, re.S)[1]
        self.assertGreater(painted.count("<path"), 100)
        places = [float(x) for x in re.findall(r"M (-?[\d.]+) ", painted)]
        self.assertTrue(0.0 < min(places) and max(places) < 720.0)
        for draw in (plot.phase, plot.landing):
            self.assertEqual(flaws(draw(self.motion)), [])
        self.assertEqual(figure._repr_png_()[:4], b"\x89PNG")

    def test_comparisons_are_drawn_of_motions_and_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.h5")
            self.motion.write(file)
            self.assertEqual(flaws(plot.comparison(self.motion, file, window=(0.1, 0.2))), [])

    def test_what_is_not_there_is_told(self):
        with self.assertRaises(KeyError):
            plot.motion(self.motion, "no such body")
        with self.assertRaises(IndexError):
            plot.motion(self.motion, copy=5)
        with self.assertRaisesRegex(samara.InputError, "landing map needs more than one"):
            plot.landing(samara.simulate({"scene": {"duration": 0.1}, "fluid": {"preset": "air"},
                                          "body": [{"name": "leaf", "shape": "samara:leaf"}]}))


class Report(unittest.TestCase):
    def test_is_one_page_that_shows_all_texts_as_they_are(self):
        evil = "<script>alert(1)</script>&{{ 1 + 1 }}"
        verdict = {"grade": "good", "headline": evil, "good_for": [evil], "not_for": [],
                   "findings": [{"grade": "bad", "what": evil, "text": evil}]}
        blocks = [{"text": evil}, {"list": [evil]}, {"table": {"headings": [evil], "rows": [[evil, "1"]]}, "summary": evil},
                  {"picture": landing(5, 0.1, name=evil), "words": evil + '"'}]
        page = report.page({"name": evil, "below": evil, "version": "1", "verdict": verdict,
                            "parts": [{"title": evil, "blocks": blocks}]})
        self.assertNotIn("<script", page)
        self.assertIn("&lt;script&gt;alert(1)&lt;/script&gt;&amp;{{ 1 + 1 }}", page)
        self.assertEqual(page.count("data:image/svg+xml;base64,"), 1)
        self.assertTrue(page.startswith("<!DOCTYPE html>") and page.endswith("</html>\n"))
        self.assertIsNone(re.search(r'src="[^d]|href="[^#]|@import|url\(', page))


if __name__ == "__main__":
    unittest.main()
