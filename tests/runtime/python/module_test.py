#!/usr/bin/env python3
"""The Python module, with real bodies, files and threads. PYTHONPATH names its folder, PATH that of the programs."""

import copy
import gc
import json
import math
import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy

import samara
from leaves import ended_in_the_middle, endless, leaves, long_flight

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Copies(unittest.TestCase):
    def test_motions_iterate_over_their_bodies_and_know_their_names(self):
        motion = samara.simulate(leaves(count=2))
        self.assertEqual([body.name for body in motion], ["leaf"])
        self.assertIn("leaf", motion)
        self.assertNotIn("twig", motion)

    def test_pickled_motions_and_bodies_are_the_same(self):
        motion = samara.simulate(leaves(count=2), forces=True)
        for copied in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion), copy.copy(motion)):
            numpy.testing.assert_array_equal(copied["leaf"].position, motion["leaf"].position)
            numpy.testing.assert_array_equal(copied["leaf"].forces["drag"], motion["leaf"].forces["drag"])
        leaf = pickle.loads(pickle.dumps(motion["leaf"]))
        numpy.testing.assert_array_equal(leaf.orientation, motion["leaf"].orientation)
        body = samara.Body.read(ROOT / "runtime/bodies/leaf.body.h5")
        for copied in (pickle.loads(pickle.dumps(body)), copy.deepcopy(body)):
            numpy.testing.assert_array_equal(copied.force_table, body.force_table)
            self.assertEqual(copied.mass, body.mass)

    def test_forces_have_a_row_for_each_frame_and_balance_a_steady_fall(self):
        self.assertIsNone(samara.simulate(leaves())["leaf"].forces)
        motion = samara.simulate(leaves(count=2), runs=2, forces=True)
        forces = motion["leaf"].forces
        self.assertEqual(list(forces), ["buoyancy", "inertia", "drag", "lift", "noise"])
        for part in forces.values():
            self.assertEqual(part.shape, motion["leaf"].position.shape[:3] + (6,))
        self.assertTrue((forces["drag"][:, 5:, :, 5] > 0.0).all())  # upwards, while it falls


class Scenes(unittest.TestCase):
    def test_a_dict_a_text_and_a_file_give_the_same_motion(self):
        scene = samara.Scene(leaves())
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "leaves.toml"
            file.write_text(scene.text)
            motions = [samara.simulate(s) for s in (leaves(), scene, samara.Scene.from_text(scene.text), file, str(file))]
        for motion in motions[1:]:
            numpy.testing.assert_array_equal(motion["leaf"].position, motions[0]["leaf"].position)

    def test_numbers_may_be_numpys_and_paths_pathlibs(self):
        shape = ROOT / "runtime/bodies/leaf.body.h5"
        scene = samara.Scene(leaves(shape=shape, position=numpy.array([0.0, 0.0, 2.0]), count=numpy.int32(3), density=numpy.float32(600),
                                    start=numpy.array(0.25)))
        self.assertIn("density = 600.0", scene.text)
        self.assertIn("count = 3\n", scene.text)
        self.assertIn("start = 0.25", scene.text)

    def test_a_scene_tells_what_it_holds(self):
        scene = samara.Scene(leaves())
        self.assertEqual((scene.duration, scene.step, scene.frame_rate, scene.ground), (0.5, 0.002, 50.0, None))
        self.assertEqual(scene.names, ["leaf"])
        numpy.testing.assert_array_equal(scene.gravity, [0, 0, -9.81])

    def test_faults_name_the_place_and_the_remedy(self):
        for error, scene in {
            "scene: unknown key 'densty' in [[body]]; did you mean 'density'": leaves(densty=600),
            "scene['body'][0]['position'] has the type set": leaves(position={1, 2}),
            "a list of 3 numbers": leaves(position=[0, 0]),
            "finite": leaves(position=[0, 0, math.nan]),
            "has the key 3; keys must be strings": {"scene": {3: 1}},
            "there is no ready-baked body": leaves(shape="samara:lead"),
        }.items():
            with self.subTest(error), self.assertRaises(samara.Error) as caught:
                samara.Scene(scene)
            self.assertIn(error, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaisesRegex(samara.Error, "nowhere.toml"):
            samara.simulate("nowhere.toml")

    def test_what_holds_itself_or_lies_too_deep_is_refused(self):
        ring = [0, 0]
        ring[1] = ring
        deep, deep_list = {}, []
        for _ in range(100000):
            deep, deep_list = {"a": deep}, [deep_list]
        array = numpy.empty(1, dtype=object)
        array[0] = array
        for values in (endless(), deep, {"scene": endless()}, {"scene": ring}, {"scene": deep_list}, leaves(position=ring),
                       leaves(position=array), leaves(position=(ring, ring))):
            with self.assertRaisesRegex(samara.InputError, "check that none contains itself") as caught:
                samara.Scene(values)
            self.assertLess(len(str(caught.exception)), 200)

    def test_numbers_beyond_all_range_and_texts_that_are_none_are_refused(self):
        for error, scene in {"beyond 64 bits": leaves(count=10**400), "finite": leaves(position=[0, 0, 1e999]),
                             "not valid Unicode": leaves(name="\ud800"), "holds a string": {"\ud800": 1}}.items():
            with self.subTest(error), self.assertRaisesRegex(samara.InputError, error):
                samara.Scene(scene)

        class Huge:
            def __float__(self):
                return float(10**400)

        class Broken:
            def __index__(self):
                raise ZeroDivisionError("broken")

        with self.assertRaisesRegex(samara.InputError, "beyond the range"):
            samara.Scene(leaves(density=Huge()))
        with self.assertRaisesRegex(ZeroDivisionError, "broken"):
            samara.Scene(leaves(count=Broken()))

    def test_numbers_of_numpy_are_taken_wherever_numbers_are(self):
        scene = leaves(added_mass=numpy.bool_(False), density=numpy.longdouble(600), count=numpy.uint8(2), start=numpy.float16(0.5),
                       velocity=(numpy.float32(1), numpy.int64(2), numpy.bool_(True) + 2), spread={"angle": numpy.array(0.5)})
        text = samara.Scene(scene).text
        for line in ("added_mass = false", "density = 600.0", "count = 2", "start = 0.5"):
            self.assertIn(line, text)
        motion = samara.simulate(leaves(), runs=numpy.int16(2), seed=numpy.uint64(5), step=numpy.float32(0.004), threads=numpy.int8(1))
        self.assertEqual(motion.runs, 2)
        self.assertGreater(motion["leaf"].measure(run=numpy.int64(1), copy=numpy.uint8(2))["descent_speed"], 0.0)


class Errors(unittest.TestCase):
    def test_are_of_pythons_kinds_too(self):
        for kind, call in (
            (samara.FileError, lambda: samara.Scene.read("nowhere.toml")),
            (samara.FileError, lambda: samara.Body.read("nowhere.body.h5")),
            (samara.FileError, lambda: samara.Motion.read("nowhere.h5")),
            (samara.FileError, lambda: samara.simulate(leaves(), bodies="nowhere")),
            (samara.FileError, lambda: samara.simulate(leaves()).write("nowhere/motion.h5")),
            (samara.FileError, lambda: samara.simulate(leaves()).export("nowhere/motion.csv")),
            (samara.InputError, lambda: samara.simulate(leaves()).export("motion.fbx")),
            (samara.InputError, lambda: samara.Scene(leaves(densty=600))),
            (samara.InputError, lambda: samara.Scene.from_text("nonsense")),
            (samara.InputError, lambda: samara.Scene.read(ROOT / "README.md")),
            (samara.InputError, lambda: samara.Motion.read(ROOT / "README.md")),
            (samara.InputError, lambda: samara.simulate(leaves(), runs=0)),
            (samara.InputError, lambda: samara.simulate(leaves(position=[0, 0, -1]) | {"scene": {"duration": 1, "ground": 0}})),
            (samara.InputError, lambda: samara.Simulation(samara.Scene(leaves())).advance(-1.0)),
            (samara.InputError, lambda: samara.Simulation(samara.Scene(leaves())).set_state(b"nonsense")),
        ):
            with self.assertRaises(kind) as caught:
                call()
            self.assertIsInstance(caught.exception, samara.Error)
            self.assertIsInstance(caught.exception, OSError if kind is samara.FileError else ValueError)

    def test_objects_made_without_init_are_empty_and_no_crash(self):
        classes = (samara.Scene, samara.Body, samara.Motion, samara.BodyMotion, samara.Simulation, samara.Poses)
        for kind in classes:
            empty = kind.__new__(kind)
            for name in dir(kind):
                if name.startswith("__") and name not in ("__len__", "__getitem__"):
                    continue
                with self.subTest(kind=kind, name=name), self.assertRaises((TypeError, AttributeError)):
                    getattr(empty, name)()
            try:
                repr(empty)
            except TypeError:
                pass
        with self.assertRaises(TypeError):
            samara.simulate(samara.Scene.__new__(samara.Scene))
        with self.assertRaises(TypeError):
            samara.Simulation(samara.Scene.__new__(samara.Scene))
        with self.assertRaises(TypeError):
            samara.compare(samara.Motion.__new__(samara.Motion), "reference.h5")

        class Careless(samara.Scene):
            def __init__(self):
                pass

        with self.assertRaises(TypeError):
            Careless()


class ReadyBodies(unittest.TestCase):
    def test_a_wheel_brings_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(shutil.copytree(pathlib.Path(samara.__file__).parent, pathlib.Path(folder) / "samara"))
            (package / "bodies").mkdir()
            shutil.copy(ROOT / "runtime/bodies/sphere.body.h5", package / "bodies")
            told = subprocess.run([sys.executable, "-c", "import samara; print(*samara.ready_bodies())"], check=True, text=True,
                                  capture_output=True, env=os.environ | {"PYTHONPATH": folder})
        self.assertEqual(told.stdout.split(), ["sphere"])
        self.assertGreater(len(samara.ready_bodies()), 1)


class Motions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = samara.simulate(leaves(), runs=2)
        cls.leaf = cls.motion["leaf"]

    def test_poses_are_runs_by_frames_by_copies_in_one_memory(self):
        self.assertEqual(self.leaf.position.shape, (2, 26, 3, 3))
        self.assertEqual(self.leaf.orientation.shape, (2, 26, 3, 4))
        self.assertEqual(self.leaf.velocity.shape, self.leaf.angular_velocity.shape)
        self.assertFalse(self.leaf.position.flags.owndata)
        self.assertTrue(numpy.shares_memory(self.leaf.position, self.motion["leaf"].position))
        with self.assertRaises(ValueError):
            self.leaf.position[0, 0, 0] = 0

    def test_poses_are_those_of_the_file_formats(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "motion.csv"
            self.motion.export(table, run=1)
            rows = numpy.genfromtxt(table, delimiter=",", names=True, usecols=range(2, 17))
        chosen = rows[rows["copy"] == 2]
        quaternions = numpy.stack([chosen["orientation_" + axis] for axis in "xyzw"], axis=-1)
        numpy.testing.assert_allclose(quaternions, self.leaf.orientation[1, :, 2], rtol=0, atol=1e-15)
        spins = numpy.stack([chosen["angular_velocity_" + axis] for axis in "xyz"], axis=-1)
        numpy.testing.assert_array_equal(spins, self.leaf.angular_velocity[1, :, 2])
        numpy.testing.assert_array_equal(chosen["time"], self.motion.times)

    def test_sizes_of_a_crowd_are_an_array(self):
        self.assertIsNone(self.leaf.sizes)
        crowd = samara.simulate(leaves(spread={"size": [0.5, 2]}), runs=2)["leaf"]
        self.assertEqual(crowd.sizes.shape, (2, 3))
        self.assertTrue(((crowd.sizes >= 0.5) & (crowd.sizes <= 2)).all())
        self.assertGreater(crowd.sizes.std(), 0.0)

    def test_velocities_are_the_derivatives_of_places(self):
        moved = self.leaf.position[:, 2:] - self.leaf.position[:, :-2]
        speed = moved * self.motion.frame_rate / 2
        self.assertLess(numpy.abs(speed - self.leaf.velocity[:, 1:-1]).max(), 0.02 * numpy.abs(speed).max())

    def test_arrays_outlive_the_motion(self):
        position = samara.simulate(leaves())["leaf"].position
        first = position.copy()
        gc.collect()
        other = [samara.simulate(leaves(), seed=seed) for seed in (5, 6, 7)]
        numpy.testing.assert_array_equal(position, first)
        self.assertFalse((other[0]["leaf"].position == first).all())

    def test_a_file_gives_back_what_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.h5")
            self.motion.write(file)
            again = samara.Motion.read(file)
            numpy.testing.assert_array_equal(again["leaf"].velocity, self.leaf.velocity)
            self.assertEqual(again.scene_text, self.motion.scene_text)
            self.assertIsNone(again.report)
            with open(file, "r+b") as damaged:
                damaged.truncate(2000)
            with self.assertRaisesRegex(samara.Error, "motion.h5"):
                samara.Motion.read(file)

    def test_metrics_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.h5")
            self.motion.write(file)
            told = json.loads(subprocess.run(["samara", "info", file, "--json"], check=True, capture_output=True).stdout)
        ensemble = self.leaf.ensemble()
        for metric in ("descent_speed", "descent_speed_error", "rms_angular_speed", "regime", "samples"):
            self.assertEqual(ensemble[metric], told["bodies"][0][metric])
        measures = self.leaf.measure(run=1, copy=2, window=(0.1, 0.5))
        self.assertEqual(measures["window"], [0.1, 0.5])
        fallen = self.leaf.position[1, 5, 2, 2] - self.leaf.position[1, 25, 2, 2]
        self.assertAlmostEqual(measures["descent_speed"], fallen / 0.4, places=12)

    def test_a_motion_agrees_with_itself_and_not_with_a_sphere(self):
        verdict = samara.compare(self.motion, self.motion)
        self.assertTrue(verdict["agrees"])
        sphere = samara.simulate(leaves(shape="samara:sphere", density=3000))
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "sphere.h5"
            sphere.write(file)
            self.assertFalse(samara.compare(self.motion, file)["agrees"])
        with self.assertRaisesRegex(samara.Error, "holds the bodies leaf"):
            samara.compare(self.motion, sphere, body="seed")
        for window in ((0.4, 0.1), (math.nan, 0.5), (5, 6)):
            with self.subTest(window), self.assertRaises(samara.Error):
                samara.compare(self.motion, self.motion, window=window)
            with self.subTest(window), self.assertRaises(samara.Error):
                self.leaf.measure(window=window)

    def test_a_progress_function_may_read_files_and_fly(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.h5")
            self.motion.write(file)
            read = []

            def look(done, total):
                read.append(samara.Motion.read(file).runs + samara.simulate(leaves())["leaf"].copies)

            samara.compare(self.motion, file, progress=look)
            samara.simulate(leaves(), progress=look)
        self.assertEqual(set(read), {5})

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(KeyError, "is not a body; choose one of leaf"):
            self.motion["seed"]
        with self.assertRaisesRegex(IndexError, "run 2: there are only 2"):
            self.leaf.measure(run=2)
        with self.assertRaisesRegex(IndexError, "copy -1"):
            self.leaf.measure(copy=-1)
        with self.assertRaisesRegex(samara.Error, "'.fbx' is unknown"):
            self.motion.export("motion.fbx")
        for wrong in ({"runs": 0}, {"threads": -1}, {"step": 0.0}, {"step": math.nan}):
            with self.subTest(wrong), self.assertRaises(samara.Error):
                samara.simulate(leaves(), **wrong)

    def test_the_page_shows_in_a_notebook(self):
        shown = self.motion._repr_html_()
        self.assertTrue(shown.startswith("<iframe srcdoc="))
        self.assertIn("&lt;html", shown.lower())


class Repeats(unittest.TestCase):
    def test_a_body_is_prepared_once(self):
        scene = samara.Scene(leaves(turbulence="none") | {"scene": {"duration": 0.01}})
        samara.simulate(scene, threads=1)
        begin = time.perf_counter()
        for _ in range(10):
            samara.simulate(scene, threads=1)
        self.assertLess((time.perf_counter() - begin) / 10, 0.01)

    def test_a_file_that_changes_is_read_again(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "some.body.h5"
            shapes = []
            for name in ("leaf", "sphere", "leaf"):
                shutil.copy(ROOT / f"runtime/bodies/{name}.body.h5", file)
                shapes.append(len(samara.simulate(leaves(shape=file))["leaf"].vertices))
        self.assertEqual(shapes[0], shapes[2])
        self.assertNotEqual(shapes[0], shapes[1])


class LongFlights(unittest.TestCase):
    def test_progress_is_told_and_what_it_raises_ends_the_flight(self):
        told = []

        def stop_soon(done, total):
            told.append(done / total)
            if len(told) == 2:
                raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            samara.simulate(long_flight, progress=stop_soon)
        self.assertEqual(len(told), 2)
        self.assertLess(told[1], 1.0)

    def test_other_threads_of_python_go_on(self):
        counts = []
        ready = threading.Event()

        def count():
            ready.set()
            while not done.is_set():
                counts.append(len(counts))

        done = threading.Event()
        thread = threading.Thread(target=count)
        thread.start()
        ready.wait()
        before = len(counts)
        samara.simulate(leaves(count=100), runs=4)
        after = len(counts)
        done.set()
        thread.join()
        self.assertGreater(after - before, 100)

    def test_ctrl_c_ends_a_flight(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            samara.simulate(long_flight)

    def test_an_interpreter_may_exit_in_the_middle_of_a_flight(self):
        ended = ended_in_the_middle("samara.simulate", "long")
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_flights_on_several_threads_give_what_one_gives(self):
        motions = {}

        def fly(seed):
            motions[seed] = samara.simulate(leaves(), seed=seed)

        threads = [threading.Thread(target=fly, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed, motion in motions.items():
            numpy.testing.assert_array_equal(motion["leaf"].position, samara.simulate(leaves(), seed=seed)["leaf"].position)


class Bodies(unittest.TestCase):
    def test_a_body_is_simulated_as_its_file_recommends_where_the_scene_does_not_say(self):
        body = samara.Body.read(ROOT / "runtime/bodies/samara.body.h5")
        self.assertEqual(body.recommended, {"loads": "surface", "patches": 2, "turbulence": "table"})
        self.assertIsNone(samara.Body.read(ROOT / "runtime/bodies/cube.body.h5").recommended)
        scene = {"scene": {"duration": 0.1}, "fluid": {"preset": "air"}, "body": [{"name": "seed", "shape": "samara:samara"}]}
        self.assertTrue(samara.simulate(scene)["seed"].models.startswith("loads surface; turbulence table (wake); in 2 patches"))
        scene["body"][0]["loads"] = "table"
        self.assertTrue(samara.simulate(scene)["seed"].models.startswith("loads table; turbulence table (wake); dynamic"))

    def test_a_body_file_as_arrays(self):
        body = samara.Body.read(ROOT / "runtime/bodies/ellipsoid.body.h5")
        corners = body.vertices[body.triangles]
        volume = numpy.linalg.det(corners).sum() / 6
        self.assertAlmostEqual(volume / body.volume, 1.0, delta=0.02)  # its triangles are curved
        numpy.testing.assert_allclose(body.kirchhoff_tensor, body.kirchhoff_tensor.T, atol=1e-12 * numpy.abs(body.kirchhoff_tensor).max())
        rows = len(body.reynolds_numbers)
        self.assertEqual(body.force_table.shape[0], rows)
        self.assertEqual(body.force_table.shape[:3], body.dissipation_rate_table.shape)
        # A node of the map lies in the direction z: what is looked up there stands in the table.
        force, _ = body.loads([0, 0, 1], body.reynolds_numbers[-1])
        self.assertLess(numpy.abs(body.force_table[-1].reshape(-1, 3) - force).max(axis=1).min(), 1e-9)
        for direction, reynolds_number in (([0, 0, 0], 1000), ([0, 0, math.nan], 1000), ([0, 0, 1], math.nan), ([0, 0, 1], -1), ([0, 0, 1], math.inf),
                                           ([math.inf, 0, 0], 1000)):
            with self.subTest(direction), self.assertRaises(samara.Error):
                body.loads(direction, reynolds_number)
        usual, _ = body.loads([1, 0, 0], 1000)
        for scale in (1e300, 1e-300):
            numpy.testing.assert_allclose(body.loads([scale, 0, 0], 1000)[0], usual, rtol=1e-12)
        ring = [0, 0, 0]
        ring[2] = ring
        with self.assertRaises(TypeError):
            body.loads(ring, 1000)
        for direction in ([0, 1], [[0, 1], [2, 3]], "up", numpy.zeros(4)):
            with self.subTest(direction), self.assertRaises(TypeError):
                body.loads(direction, 1000)
        with self.assertRaises(samara.Error):
            samara.Body.read(ROOT / "README.md")


class Programs(unittest.TestCase):
    def test_a_plan_is_a_dict(self):
        told = []
        plan = samara.plan(ROOT / "docs/scenes/leaves.toml", progress=lambda done, total: told.append(done / total), tolerance=0.5)
        self.assertIn("bodies", plan)
        self.assertTrue(all(0 <= share <= 1 for share in told))

    def test_faults_of_a_program_are_errors(self):
        with self.assertRaisesRegex(samara.Error, "nowhere.geo"):
            samara.bake("nowhere.geo", "nowhere.body.h5")


if __name__ == "__main__":
    unittest.main()
