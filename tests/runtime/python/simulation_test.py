#!/usr/bin/env python3
"""samara.Simulation, with real bodies and threads. PYTHONPATH names its folder."""

import gc
import math
import pathlib
import threading
import unittest

import numpy

import samara
from leaves import ended_in_the_middle, endless, leaves, long_flight

ROOT = pathlib.Path(__file__).resolve().parents[3]


class LiveFlights(unittest.TestCase):
    def setUp(self):
        self.scene = samara.Scene(leaves())
        self.simulation = samara.Simulation(self.scene, runs=2)

    def test_the_step_may_be_left_to_the_advice(self):
        scene = leaves()
        scene["scene"]["step"] = "auto"
        motion = samara.simulate(samara.Scene(scene))
        simulation = samara.Simulation(samara.Scene(scene))
        simulation.advance(motion.times[-1])
        numpy.testing.assert_array_equal(simulation.poses("leaf").position, motion["leaf"].position[:, -1])

    def test_its_poses_are_the_frames_of_a_motion(self):
        motion = samara.simulate(self.scene, runs=2)
        for frame in (0, 10, 25):
            self.simulation.advance(motion.times[frame])
            poses = self.simulation.poses("leaf")
            numpy.testing.assert_array_equal(poses.position, motion["leaf"].position[:, frame])
            numpy.testing.assert_array_equal(poses.velocity, motion["leaf"].velocity[:, frame])

    def test_a_budget_ends_a_call_after_a_step_and_the_next_takes_up_the_rest(self):
        other = samara.Simulation(self.scene, runs=2)
        other.advance(0.3)
        self.simulation.advance(0.3, budget=0.0)
        self.assertTrue(0 < self.simulation.time < 0.3)
        self.simulation.advance(0.3, budget=1e3)
        self.assertEqual(self.simulation.time, 0.3)
        numpy.testing.assert_array_equal(self.simulation.poses("leaf").position, other.poses("leaf").position)
        with self.assertRaisesRegex(samara.InputError, "budget"):
            self.simulation.advance(0.4, budget=-1.0)

    def test_a_state_brings_it_back(self):
        self.simulation.advance(0.2)
        state = self.simulation.state()
        self.simulation.advance(0.4)
        expected = self.simulation.poses("leaf").position
        other = samara.Simulation(self.scene, runs=2)
        other.set_state(state)
        self.assertEqual(other.time, 0.2)
        other.advance(0.4)
        numpy.testing.assert_array_equal(other.poses("leaf").position, expected)
        for foreign in (b"", b"nonsense", state[:-1], state[:-1] + b"?"):
            with self.assertRaises(samara.Error):
                other.set_state(foreign)
        with self.assertRaises(samara.Error):
            samara.Simulation(self.scene, runs=1).set_state(state)

    def test_a_body_can_be_put_elsewhere(self):
        self.simulation.advance(0.1)
        before = self.simulation.poses("leaf")
        self.simulation.set_pose("leaf", run=1, copy=2, position=(1, 2, 3), velocity=[0, 0, 0])
        after = self.simulation.poses("leaf")
        numpy.testing.assert_allclose(after.position[1, 2], [1, 2, 3], rtol=1e-12)
        numpy.testing.assert_allclose(after.orientation[1, 2], before.orientation[1, 2], atol=1e-12)
        numpy.testing.assert_array_equal(after.position[0], before.position[0])

    def test_a_force_acts_over_the_whole_advance_however_long(self):
        at_once, in_parts, plain = (samara.Simulation(self.scene) for _ in range(3))
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

    def test_a_force_counts_once_whatever_call_comes_before(self):
        once, held, refused = (samara.Simulation(self.scene) for _ in range(3))
        for simulation in (once, held, refused):
            simulation.advance(0.1)
            simulation.add_force("leaf", (0.01, 0.0, 0.0), copy=1)
        held.advance(0.1)
        for time in (0.05, 1e300):
            with self.assertRaises(samara.Error):
                refused.advance(time)
        for simulation in (once, held, refused):
            simulation.advance(0.5)
        expected = once.poses("leaf").position
        numpy.testing.assert_array_equal(held.poses("leaf").position, expected)
        numpy.testing.assert_array_equal(refused.poses("leaf").position, expected)

    def test_an_impulse_changes_the_velocity_and_a_point_makes_it_spin(self):
        self.simulation.advance(0.1)
        before = self.simulation.poses("leaf")
        self.simulation.add_impulse("leaf", (0.0, 1e-4, 0.0), point=before.position[0, 1] + [0.01, 0.0, 0.0], copy=1)
        after = self.simulation.poses("leaf")
        self.assertGreater(after.velocity[0, 1, 1], before.velocity[0, 1, 1] + 0.01)
        self.assertGreater(numpy.linalg.norm(after.angular_velocity[0, 1] - before.angular_velocity[0, 1]), 0.1)
        numpy.testing.assert_array_equal(after.velocity[0, 0], before.velocity[0, 0])

    def test_a_removed_body_stays_until_it_is_put_back(self):
        self.simulation.advance(0.1)
        self.simulation.remove("leaf", copy=2)
        there = self.simulation.poses("leaf").position[0, 2]
        self.simulation.advance(0.3)
        numpy.testing.assert_array_equal(self.simulation.poses("leaf").position[0, 2], there)
        with self.assertRaisesRegex(samara.Error, "removed"):
            self.simulation.add_force("leaf", (1, 0, 0), copy=2)
        self.simulation.set_pose("leaf", copy=2, position=(0, 0, 0))
        self.simulation.advance(0.5)
        self.assertLess(self.simulation.poses("leaf").position[0, 2, 2], 0.0)

    def test_a_host_finds_the_acceleration_of_the_flight_itself(self):
        scene = leaves(spread={"angle": 0.5, "size": [0.5, 2]})
        scene["scene"]["step"] = 2.0**-16
        simulation = samara.Simulation(samara.Scene(scene))
        simulation.advance(2.0**-3)
        for copy in range(3):
            now = simulation.poses("leaf")
            wrench, added, damping = simulation.fluid_load("leaf", copy=copy)
            mass, center, inertia = simulation.mass_properties("leaf", copy=copy)
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
            later = samara.Simulation(samara.Scene(scene))
            later.set_state(simulation.state())
            later.advance(2.0**-3 + 2.0**-16)
            then = later.poses("leaf")
            flown = numpy.concatenate([then.angular_velocity[0, copy] - omega, then.velocity[0, copy] - now.velocity[0, copy]]) * 2**16
            numpy.testing.assert_allclose(found[3:], flown[3:], atol=5e-3 * numpy.linalg.norm(flown[3:]))
            numpy.testing.assert_allclose(found[:3], flown[:3], atol=5e-3 * numpy.linalg.norm(flown[:3]))
        self.simulation.remove("leaf", copy=2)
        with self.assertRaisesRegex(samara.Error, "removed"):
            self.simulation.fluid_load("leaf", copy=2)
        simulation.advance(2.0**-3 + 2.0**-17)
        with self.assertRaisesRegex(samara.Error, "is within a step"):
            simulation.fluid_load("leaf")

    def test_wind_and_ground_change_in_flight(self):
        plain = samara.Simulation(self.scene, runs=2)
        self.simulation.set_wind({"velocity": [3, 0, 0], "vortex": [{"position": [0, 0, 1], "circulation": 1.0, "core": 0.1}]})
        for simulation in (self.simulation, plain):
            simulation.advance(0.3)
        drift = self.simulation.poses("leaf").position - plain.poses("leaf").position
        self.assertTrue((drift[..., 0] > 0.1).all())
        self.simulation.set_wind({})
        self.simulation.set_ground(1.9)
        self.simulation.advance(3.0)
        self.assertGreater(self.simulation.poses("leaf").position[..., 2].min(), 1.9)
        self.simulation.set_ground(None)
        for wrong in ({"velocty": [3, 0, 0]}, {"velocity": [3, 0]}, {"velocity": {1, 2}}, {"file": "nowhere.h5"}):
            with self.subTest(wrong), self.assertRaises(samara.Error):
                self.simulation.set_wind(wrong)
        with self.assertRaisesRegex(samara.Error, "^wind: unknown key 'velocty'"):
            self.simulation.set_wind({"velocty": [3, 0, 0]})
        with self.assertRaisesRegex(samara.Error, "finite"):
            self.simulation.set_ground(math.inf)

    def test_a_body_with_an_emitter_is_added_in_flight(self):
        self.simulation.advance(0.1)
        roof = {"shape": str(ROOT / "docs/scenes/roof.obj"), "position": [0, 0, 3], "offset": 0.1}
        self.simulation.add({"name": "oak", "shape": "samara:oak-leaf", "count": 3, "emitter": roof})
        self.assertEqual(self.simulation.names, ["leaf", "oak"])
        before = self.simulation.poses("oak").position
        self.assertTrue((before[..., 2] > 3.0).all())
        self.simulation.advance(0.5)
        self.assertTrue((self.simulation.poses("oak").position[..., 2] < before[..., 2] - 0.1).all())
        with self.assertRaisesRegex(samara.Error, "already has the name 'oak'"):
            self.simulation.add({"name": "oak", "shape": "samara:oak-leaf"})
        with self.assertRaisesRegex(samara.Error, "did you mean 'count'"):
            self.simulation.add({"name": "elm", "shape": "samara:oak-leaf", "cuont": 3})

    def test_an_obstacle_added_in_flight_bears_bodies_until_it_is_removed(self):
        self.simulation.advance(0.1)
        below = self.simulation.poses("leaf").position[..., 2].min() - 0.3
        slab = {"name": "roof", "shape": str(ROOT / "docs/scenes/roof.obj"), "position": [0, 0, below]}
        self.simulation.add_obstacle(slab)
        with self.assertRaisesRegex(samara.Error, "already has the name 'roof'"):
            self.simulation.add_obstacle(slab)
        self.simulation.remove_obstacle("roof")
        with self.assertRaisesRegex(samara.InputError, "no obstacle 'roof'"):
            self.simulation.remove_obstacle("roof")
        with self.assertRaisesRegex(samara.Error, "frictoin"):
            self.simulation.add_obstacle(slab | {"frictoin": 1})

    def test_bodies_meet_where_the_scene_says_so(self):
        scene = leaves()
        scene["scene"]["bodies_collide"] = True
        scene["scene"]["ground"] = -0.05
        simulation = samara.Simulation(samara.Scene(scene), runs=1)
        simulation.watch_contacts(True)
        simulation.advance(2.0)
        met = simulation.take_contacts("leaf")
        self.assertTrue(((met["body"] >= -1) & (met["body"] < met["body"].size)).all())
        self.assertTrue((met["obstacle"] == -1).all())

    def test_steps_are_of_single_precision_where_the_scene_says_so(self):
        scene = leaves()
        places = []
        for precision in ("double", "single"):
            scene["scene"]["precision"] = precision
            checked = samara.Scene(scene)
            self.assertEqual(checked.precision, precision)
            simulation = samara.Simulation(checked, runs=1)
            simulation.advance(0.2)
            places.append(simulation.poses("leaf").position)
        self.assertFalse((places[0] == places[1]).all())
        self.assertLess(abs(places[0] - places[1]).max(), 1e-4)
        scene["scene"]["bodies_collide"] = True
        with self.assertRaisesRegex(samara.InputError, "precision in .scene. must be"):
            samara.Scene(scene)

    def test_contacts_are_arrays_of_runs_and_copies(self):
        scene = leaves()
        scene["scene"]["ground"] = -0.2
        simulation = samara.Simulation(samara.Scene(scene), runs=2)
        simulation.watch_contacts(True)
        simulation.advance(3.0)
        met = simulation.take_contacts("leaf")
        copies = simulation.poses("leaf").position.shape[1]
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

    def test_contacts_that_are_not_watched_are_no_zeros(self):
        with self.assertRaisesRegex(samara.InputError, "call watch_contacts"):
            self.simulation.take_contacts("leaf")
        self.simulation.watch_contacts(numpy.bool_(True))
        self.assertEqual(self.simulation.take_contacts("leaf")["strongest"].max(), 0.0)

    def test_wrong_forces_are_refused(self):
        for name, wrong in (("force", {"force": (1, 2)}), ("point", {"force": (1, 0, 0), "point": numpy.zeros((3, 1))}),
                            ("moment", {"force": (1, 0, 0), "moment": "up"}), ("force", {"force": None})):
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, name + ": give 3 real numbers"):
                self.simulation.add_force("leaf", **wrong)
        with self.assertRaisesRegex(samara.Error, "force: give finite"):
            self.simulation.add_force("leaf", (math.nan, 0, 0))
        with self.assertRaisesRegex(samara.Error, "impulse: give finite"):
            self.simulation.add_impulse("leaf", (1e31, 0, 0))
        with self.assertRaises(IndexError):
            self.simulation.add_force("leaf", (1, 0, 0), copy=99)
        with self.assertRaises(KeyError):
            self.simulation.remove("stone")

    def test_wrong_arrays_are_refused(self):
        for wrong in ({"position": (1, 2)}, {"position": "here"}, {"orientation": numpy.zeros((2, 2))}):
            with self.subTest(wrong), self.assertRaises(TypeError):
                self.simulation.set_pose("leaf", **wrong)
        for wrong in ({"position": (1, 2, math.inf)}, {"orientation": (0, 0, 0, 2)}, {"velocity": (math.nan, 0, 0)},
                      {"position": (1e300, 0, 0)}, {"orientation": (1e300, 0, 0, 0)}):
            with self.subTest(wrong), self.assertRaises(samara.Error):
                self.simulation.set_pose("leaf", **wrong)
        with self.assertRaisesRegex(samara.Error, "finite"):
            self.simulation.advance(math.nan)
        with self.assertRaisesRegex(samara.Error, "steps away"):
            self.simulation.advance(1e300)
        with self.assertRaises(samara.Error):
            self.simulation.set_ground(1e300)
        with self.assertRaisesRegex(samara.Error, "check that none contains itself"):
            self.simulation.set_wind(endless())
        self.simulation.advance(0.2)
        with self.assertRaises(samara.Error):
            self.simulation.advance(0.1)

    def test_poses_outlive_the_flight(self):
        position = self.simulation.poses("leaf").position
        del self.simulation
        gc.collect()
        self.assertTrue(numpy.isfinite(position).all())

    def test_a_progress_function_may_look_but_not_change(self):
        seen = []

        def look(done, total):
            seen.append((self.simulation.time, self.simulation.poses("leaf").position.shape, self.simulation.state()))
            for change in (lambda: self.simulation.advance(9), lambda: self.simulation.set_pose("leaf", position=(0, 0, 0)),
                           lambda: self.simulation.add_force("leaf", (1, 0, 0)), lambda: self.simulation.remove("leaf"),
                           lambda: self.simulation.set_state(seen[0][2])):
                with self.assertRaisesRegex(samara.Error, "read it, but not change it"):
                    change()

        self.simulation.advance(0.5, progress=look)
        self.assertEqual(seen[-1][:2], (0.5, (2, 3, 3)), "it is told of the end")
        plain = samara.Simulation(self.scene, runs=2)
        plain.advance(0.5)
        numpy.testing.assert_array_equal(self.simulation.poses("leaf").position, plain.poses("leaf").position)

    def test_a_progress_function_that_throws_leaves_a_flight_that_goes_on(self):
        def stop(done, total):
            raise ZeroDivisionError("enough")

        scene = samara.Scene(long_flight)
        simulation, plain = samara.Simulation(scene), samara.Simulation(scene)
        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            simulation.advance(60.0, progress=stop)
        self.assertLess(simulation.time, 60.0)
        simulation.advance(simulation.time + 0.1)
        plain.advance(simulation.time)
        numpy.testing.assert_array_equal(simulation.poses("leaf").position, plain.poses("leaf").position)

    def test_an_interpreter_may_exit_in_the_middle_of_an_advance(self):
        ended = ended_in_the_middle("samara.Simulation(long).advance", "60.0")
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_arrays_of_any_memory_order_are_read_as_what_they_show(self):
        place = numpy.array([1.0, 2.0, 3.0])
        table = numpy.asfortranarray(numpy.tile(place, (4, 1)))
        spread = numpy.repeat(place, 2)[::2]
        for given in (table[2], spread, place[::-1][::-1], place.astype(numpy.float32), place.astype(">f8"), [1, 2, 3]):
            self.simulation.set_pose("leaf", position=given)
            numpy.testing.assert_allclose(self.simulation.poses("leaf").position[0, 0], place, rtol=1e-12)
        for wrong in (place + 1j, numpy.array(["1", "2", "3"]), numpy.array([None, 2, 3]), table, place[:2], numpy.float64(1)):
            with self.subTest(wrong), self.assertRaises(TypeError):
                self.simulation.set_pose("leaf", position=wrong)

    def test_objects_outlive_what_they_came_from(self):
        body = samara.simulate(leaves())["leaf"]
        poses = samara.Simulation(self.scene).poses("leaf")
        table = samara.Body.read(ROOT / "runtime/bodies/leaf.body.h5").force_table
        gc.collect()
        self.assertGreater(body.ensemble()["descent_speed"], 0.0)
        self.assertTrue(numpy.isfinite(poses.velocity).all())
        self.assertTrue(numpy.isfinite(table).all())

    def test_calls_of_several_threads_wait_for_one_another(self):
        times = numpy.linspace(0.0, 0.5, 51)
        seen = []
        reader = threading.Thread(target=lambda: seen.extend(self.simulation.poses("leaf").position for _ in range(200)))
        reader.start()
        for time in times:
            self.simulation.advance(time)
        reader.join()
        self.assertTrue(numpy.isfinite(seen).all())
        numpy.testing.assert_array_equal(self.simulation.poses("leaf").position,
                                         samara.simulate(self.scene, runs=2)["leaf"].position[:, -1])


if __name__ == "__main__":
    unittest.main()
