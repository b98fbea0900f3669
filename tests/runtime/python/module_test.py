#!/usr/bin/env python3
"""The Python module, with real bodies, files and threads. PYTHONPATH names its folder, PATH that of the programs."""

import gc
import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import unittest

import numpy

import samara

ROOT = pathlib.Path(__file__).resolve().parents[3]


def leaves(**more):
    body = {"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 3, "spread": {"angle": 0.5}}
    return {"scene": {"duration": 0.5, "step": 0.002, "frame_rate": 50}, "fluid": {"preset": "air"}, "body": [body | more]}


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
        for fault, scene in {
            "scene: unknown key 'densty' in [[body]]; did you mean 'density'": leaves(densty=600),
            "scene['body'][0]['position'] is of the type set": leaves(position={1, 2}),
            "a list of 3 numbers": leaves(position=[0, 0]),
            "finite": leaves(position=[0, 0, math.nan]),
            "has the key 3; keys are texts": {"scene": {3: 1}},
            "there is no ready-baked body": leaves(shape="samara:lead"),
        }.items():
            with self.subTest(fault), self.assertRaises(samara.Error) as caught:
                samara.Scene(scene)
            self.assertIn(fault, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaisesRegex(samara.Error, "nowhere.toml"):
            samara.simulate("nowhere.toml")


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

    def test_figures_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.h5")
            self.motion.write(file)
            told = json.loads(subprocess.run(["samara", "info", file, "--json"], check=True, capture_output=True).stdout)
        ensemble = self.leaf.ensemble()
        for figure in ("descent_speed", "descent_speed_error", "rms_angular_speed", "regime", "samples"):
            self.assertEqual(ensemble[figure], told["bodies"][0][figure])
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
        with self.assertRaisesRegex(KeyError, "the bodies are leaf"):
            self.motion["seed"]
        with self.assertRaisesRegex(IndexError, "run 2: there are 2"):
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


class LongFlights(unittest.TestCase):
    long = leaves(count=200) | {"scene": {"duration": 60.0}}

    def test_progress_is_told_and_what_it_raises_ends_the_flight(self):
        told = []

        def stop_soon(done, total):
            told.append(done / total)
            if len(told) == 2:
                raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            samara.simulate(self.long, progress=stop_soon)
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
            samara.simulate(self.long)

    def test_an_interpreter_may_exit_in_the_middle_of_a_flight(self):
        program = textwrap.dedent(f"""
            import threading, samara
            begun = threading.Event()
            thread = threading.Thread(target=samara.simulate, args=({self.long!r},), daemon=True,
                                      kwargs=dict(progress=lambda done, total: begun.set()))
            thread.start()
            begun.wait()
        """)
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=100, check=False)
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


class LiveFlights(unittest.TestCase):
    def setUp(self):
        self.scene = samara.Scene(leaves())
        self.flight = samara.Flight(self.scene, runs=2)

    def test_the_step_may_be_left_to_the_advice(self):
        scene = leaves()
        scene["scene"]["step"] = "auto"
        motion = samara.simulate(samara.Scene(scene))
        flight = samara.Flight(samara.Scene(scene))
        flight.advance(motion.times[-1])
        numpy.testing.assert_array_equal(flight.poses("leaf").position, motion["leaf"].position[:, -1])

    def test_its_poses_are_the_frames_of_a_motion(self):
        motion = samara.simulate(self.scene, runs=2)
        for frame in (0, 10, 25):
            self.flight.advance(motion.times[frame])
            poses = self.flight.poses("leaf")
            numpy.testing.assert_array_equal(poses.position, motion["leaf"].position[:, frame])
            numpy.testing.assert_array_equal(poses.velocity, motion["leaf"].velocity[:, frame])

    def test_a_state_brings_it_back(self):
        self.flight.advance(0.2)
        state = self.flight.state()
        self.flight.advance(0.4)
        expected = self.flight.poses("leaf").position
        other = samara.Flight(self.scene, runs=2)
        other.set_state(state)
        self.assertEqual(other.time, 0.2)
        other.advance(0.4)
        numpy.testing.assert_array_equal(other.poses("leaf").position, expected)
        for foreign in (b"", b"nonsense", state[:-1], state[:-1] + b"?"):
            with self.assertRaises(samara.Error):
                other.set_state(foreign)
        with self.assertRaises(samara.Error):
            samara.Flight(self.scene, runs=1).set_state(state)

    def test_a_body_can_be_put_elsewhere(self):
        self.flight.advance(0.1)
        before = self.flight.poses("leaf")
        self.flight.set_pose("leaf", run=1, copy=2, position=(1, 2, 3), velocity=[0, 0, 0])
        after = self.flight.poses("leaf")
        numpy.testing.assert_allclose(after.position[1, 2], [1, 2, 3], rtol=1e-12)
        numpy.testing.assert_allclose(after.orientation[1, 2], before.orientation[1, 2], atol=1e-12)
        numpy.testing.assert_array_equal(after.position[0], before.position[0])

    def test_a_force_acts_over_the_whole_advance_however_long(self):
        at_once, in_parts, plain = (samara.Flight(self.scene) for _ in range(3))
        at_once.add_force("leaf", (0.01, 0.0, 0.0), copy=1)
        at_once.advance(2.0)
        for i in range(1, 9):
            in_parts.add_force("leaf", (0.01, 0.0, 0.0), copy=1)
            in_parts.advance(0.25 * i)
        plain.advance(2.0)
        pushed, unpushed = at_once.poses("leaf").position[0], plain.poses("leaf").position[0]
        numpy.testing.assert_array_equal(pushed, in_parts.poses("leaf").position[0])
        self.assertGreater(pushed[1, 0], unpushed[1, 0] + 0.1)
        numpy.testing.assert_array_equal(pushed[0], unpushed[0])

    def test_an_impulse_changes_the_velocity_and_a_point_makes_it_spin(self):
        self.flight.advance(0.1)
        before = self.flight.poses("leaf")
        self.flight.add_impulse("leaf", (0.0, 1e-4, 0.0), point=before.position[0, 1] + [0.01, 0.0, 0.0], copy=1)
        after = self.flight.poses("leaf")
        self.assertGreater(after.velocity[0, 1, 1], before.velocity[0, 1, 1] + 0.01)
        self.assertGreater(numpy.linalg.norm(after.angular_velocity[0, 1] - before.angular_velocity[0, 1]), 0.1)
        numpy.testing.assert_array_equal(after.velocity[0, 0], before.velocity[0, 0])

    def test_a_removed_body_stays_until_it_is_put_back(self):
        self.flight.advance(0.1)
        self.flight.remove("leaf", copy=2)
        there = self.flight.poses("leaf").position[0, 2]
        self.flight.advance(0.3)
        numpy.testing.assert_array_equal(self.flight.poses("leaf").position[0, 2], there)
        with self.assertRaisesRegex(samara.Error, "removed"):
            self.flight.add_force("leaf", (1, 0, 0), copy=2)
        self.flight.set_pose("leaf", copy=2, position=(0, 0, 0))
        self.flight.advance(0.5)
        self.assertLess(self.flight.poses("leaf").position[0, 2, 2], 0.0)

    def test_a_host_finds_the_acceleration_of_the_flight_itself(self):
        scene = leaves(spread={"angle": 0.5, "size": [0.5, 2]})
        scene["scene"]["step"] = 2.0**-16
        flight = samara.Flight(samara.Scene(scene))
        flight.advance(2.0**-3)
        for copy in range(3):
            now = flight.poses("leaf")
            wrench, added, damping = flight.fluid_load("leaf", copy=copy)
            mass, center, inertia = flight.mass_properties("leaf", copy=copy)
            self.assertEqual((wrench.shape, added.shape, damping.shape, center.shape), ((6,), (6, 6), (6, 6), (3,)))
            x, y, z, w = now.orientation[0, copy]
            turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
            inertia = turn @ inertia @ turn.T
            omega = now.angular_velocity[0, copy]
            own = numpy.concatenate([-numpy.cross(omega, inertia @ omega), [0, 0, -9.81 * mass]])
            body = numpy.block([[inertia, numpy.zeros((3, 3))], [numpy.zeros((3, 3)), mass * numpy.eye(3)]])
            found = numpy.linalg.solve(body + added, own + wrench)
            later = samara.Flight(samara.Scene(scene))
            later.set_state(flight.state())
            later.advance(2.0**-3 + 2.0**-16)
            then = later.poses("leaf")
            flown = numpy.concatenate([then.angular_velocity[0, copy] - omega, then.velocity[0, copy] - now.velocity[0, copy]]) * 2**16
            numpy.testing.assert_allclose(found[3:], flown[3:], atol=5e-3 * numpy.linalg.norm(flown[3:]))
            numpy.testing.assert_allclose(found[:3], flown[:3], atol=5e-3 * numpy.linalg.norm(flown[:3]))
        self.flight.remove("leaf", copy=2)
        with self.assertRaisesRegex(samara.Error, "removed"):
            self.flight.fluid_load("leaf", copy=2)
        flight.advance(2.0**-3 + 2.0**-17)
        with self.assertRaisesRegex(samara.Error, "lies within one"):
            flight.fluid_load("leaf")

    def test_wind_and_ground_change_in_flight(self):
        plain = samara.Flight(self.scene, runs=2)
        self.flight.set_wind({"velocity": [3, 0, 0], "vortex": [{"position": [0, 0, 1], "circulation": 1.0, "core": 0.1}]})
        for flight in (self.flight, plain):
            flight.advance(0.3)
        drift = self.flight.poses("leaf").position - plain.poses("leaf").position
        self.assertTrue((drift[..., 0] > 0.1).all())
        self.flight.set_wind({})
        self.flight.set_ground(1.9)
        self.flight.advance(3.0)
        self.assertGreater(self.flight.poses("leaf").position[..., 2].min(), 1.9)
        self.flight.set_ground(None)
        for wrong in ({"velocty": [3, 0, 0]}, {"velocity": [3, 0]}, {"velocity": {1, 2}}, {"file": "nowhere.h5"}):
            with self.subTest(wrong), self.assertRaises(samara.Error):
                self.flight.set_wind(wrong)
        with self.assertRaisesRegex(samara.Error, "^wind: unknown key 'velocty'"):
            self.flight.set_wind({"velocty": [3, 0, 0]})
        with self.assertRaisesRegex(samara.Error, "finite"):
            self.flight.set_ground(math.inf)

    def test_bodies_meet_where_the_scene_says_so(self):
        scene = leaves()
        scene["scene"]["bodies_meet"] = True
        scene["scene"]["ground"] = -0.05
        flight = samara.Flight(samara.Scene(scene), runs=1)
        flight.watch_contacts(True)
        flight.advance(2.0)
        met = flight.take_contacts("leaf")
        self.assertTrue(((met["body"] >= -1) & (met["body"] < met["body"].size)).all())
        self.assertTrue((met["obstacle"] == -1).all())

    def test_contacts_are_arrays_of_runs_and_copies(self):
        scene = leaves()
        scene["scene"]["ground"] = -0.2
        flight = samara.Flight(samara.Scene(scene), runs=2)
        flight.watch_contacts(True)
        flight.advance(3.0)
        met = flight.take_contacts("leaf")
        copies = flight.poses("leaf").position.shape[1]
        self.assertEqual(met["impulse"].shape, (2, copies, 3))
        self.assertEqual(met["at_rest"].shape, (2, copies))
        self.assertTrue((met["strongest"] > 0).all())
        self.assertTrue((met["impulse"][..., 2] > 0).all())
        self.assertTrue((met["obstacle"] == -1).all())
        # Where the point was when the step began that brought it to the ground, at some 2 m/s in 2 ms.
        height = met["point"][..., 2] + 0.2
        self.assertGreaterEqual(height.min(), -1e-6)
        self.assertLess(height.max(), 4e-3)
        self.assertTrue((met["time"] > 0).all())

    def test_wrong_forces_are_refused(self):
        for name, wrong in (("force", {"force": (1, 2)}), ("point", {"force": (1, 0, 0), "point": numpy.zeros((3, 1))}),
                            ("moment", {"force": (1, 0, 0), "moment": "up"}), ("force", {"force": None})):
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, name + ": give 3 real numbers"):
                self.flight.add_force("leaf", **wrong)
        with self.assertRaisesRegex(samara.Error, "force: give finite"):
            self.flight.add_force("leaf", (math.nan, 0, 0))
        with self.assertRaisesRegex(samara.Error, "impulse: give finite"):
            self.flight.add_impulse("leaf", (1e31, 0, 0))
        with self.assertRaises(IndexError):
            self.flight.add_force("leaf", (1, 0, 0), copy=99)
        with self.assertRaises(KeyError):
            self.flight.remove("stone")

    def test_wrong_arrays_are_refused(self):
        for wrong in ({"position": (1, 2)}, {"position": "here"}, {"orientation": numpy.zeros((2, 2))}):
            with self.subTest(wrong), self.assertRaises(TypeError):
                self.flight.set_pose("leaf", **wrong)
        for wrong in ({"position": (1, 2, math.inf)}, {"orientation": (0, 0, 0, 2)}, {"velocity": (math.nan, 0, 0)}):
            with self.subTest(wrong), self.assertRaises(samara.Error):
                self.flight.set_pose("leaf", **wrong)
        with self.assertRaisesRegex(samara.Error, "finite"):
            self.flight.advance(math.nan)
        self.flight.advance(0.2)
        with self.assertRaises(samara.Error):
            self.flight.advance(0.1)

    def test_poses_outlive_the_flight(self):
        position = self.flight.poses("leaf").position
        del self.flight
        gc.collect()
        self.assertTrue(numpy.isfinite(position).all())

    def test_a_progress_function_may_look_but_not_change(self):
        seen = []

        def look(done, total):
            seen.append((self.flight.time, self.flight.poses("leaf").position.shape, self.flight.state()))
            for change in (lambda: self.flight.advance(9), lambda: self.flight.set_pose("leaf", position=(0, 0, 0)),
                           lambda: self.flight.add_force("leaf", (1, 0, 0)), lambda: self.flight.remove("leaf"),
                           lambda: self.flight.set_state(seen[0][2])):
                with self.assertRaisesRegex(samara.Error, "look at it, but not change it"):
                    change()

        self.flight.advance(0.5, progress=look)
        self.assertEqual(seen[-1][:2], (0.5, (2, 3, 3)), "it is told of the end")
        plain = samara.Flight(self.scene, runs=2)
        plain.advance(0.5)
        numpy.testing.assert_array_equal(self.flight.poses("leaf").position, plain.poses("leaf").position)

    def test_a_progress_function_that_throws_leaves_a_flight_that_goes_on(self):
        def stop(done, total):
            raise ZeroDivisionError("enough")

        scene = samara.Scene(LongFlights.long)
        flight, plain = samara.Flight(scene), samara.Flight(scene)
        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            flight.advance(60.0, progress=stop)
        self.assertLess(flight.time, 60.0)
        flight.advance(flight.time + 0.1)
        plain.advance(flight.time)
        numpy.testing.assert_array_equal(flight.poses("leaf").position, plain.poses("leaf").position)

    def test_an_interpreter_may_exit_in_the_middle_of_an_advance(self):
        program = textwrap.dedent(f"""
            import threading, samara
            flight = samara.Flight(samara.Scene({LongFlights.long!r}))
            begun = threading.Event()
            thread = threading.Thread(target=flight.advance, args=(60.0,), daemon=True,
                                      kwargs=dict(progress=lambda done, total: begun.set()))
            thread.start()
            begun.wait()
        """)
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=100, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_arrays_of_any_memory_order_are_read_as_what_they_show(self):
        place = numpy.array([1.0, 2.0, 3.0])
        table = numpy.asfortranarray(numpy.tile(place, (4, 1)))
        spread = numpy.repeat(place, 2)[::2]
        for given in (table[2], spread, place[::-1][::-1], place.astype(numpy.float32), place.astype(">f8"), [1, 2, 3]):
            self.flight.set_pose("leaf", position=given)
            numpy.testing.assert_allclose(self.flight.poses("leaf").position[0, 0], place, rtol=1e-12)
        for wrong in (place + 1j, numpy.array(["1", "2", "3"]), numpy.array([None, 2, 3]), table, place[:2], numpy.float64(1)):
            with self.subTest(wrong), self.assertRaises(TypeError):
                self.flight.set_pose("leaf", position=wrong)

    def test_objects_outlive_what_they_came_from(self):
        body = samara.simulate(leaves())["leaf"]
        poses = samara.Flight(self.scene).poses("leaf")
        table = samara.Body.read(ROOT / "runtime/bodies/leaf.body.h5").force_table
        gc.collect()
        self.assertGreater(body.ensemble()["descent_speed"], 0.0)
        self.assertTrue(numpy.isfinite(poses.velocity).all())
        self.assertTrue(numpy.isfinite(table).all())

    def test_calls_of_several_threads_wait_for_one_another(self):
        times = numpy.linspace(0.0, 0.5, 51)
        seen = []
        reader = threading.Thread(target=lambda: seen.extend(self.flight.poses("leaf").position for _ in range(200)))
        reader.start()
        for time in times:
            self.flight.advance(time)
        reader.join()
        self.assertTrue(numpy.isfinite(seen).all())
        numpy.testing.assert_array_equal(self.flight.poses("leaf").position,
                                         samara.simulate(self.scene, runs=2)["leaf"].position[:, -1])


class Bodies(unittest.TestCase):
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
        for direction, reynolds_number in (([0, 0, 0], 1000), ([0, 0, math.nan], 1000), ([0, 0, 1], math.nan), ([0, 0, 1], -1)):
            with self.subTest(direction), self.assertRaises(samara.Error):
                body.loads(direction, reynolds_number)
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
