"""How well hits of two tumbling ellipsoids, askew and without fluid, keep momentum and angular momentum, by the step.

    python3 docs/studies/stability/askew_hits.py build/release/python

Misses are over an impulse times an arm: the first body's mass, 1 m/s and 20 mm. They are those of the steps in which the
two touch; beside them stands what the steps in which each flies alone miss.
"""

import sys

import numpy

sys.path.insert(0, sys.argv[1])
import samara

NAMES = ("a", "b")
ARM = 0.02


def starts(count):
    """Pairs of bodies that fly at each other: (position, velocity, orientation, angular velocity) of each."""
    draw = numpy.random.default_rng(1)
    for _ in range(count):
        offset = draw.normal(size=2) * 0.6 * ARM
        yield [
            [place, velocity, draw.normal(size=4), draw.normal(size=3) * 4]
            for place, velocity in (([-0.08, 0, 0], [1, 0, 0]), ([0.08, *offset], [-0.5, draw.normal() / 2, 0]))
        ]


def body(name, density, start):
    keys = ("position", "velocity", "orientation", "angular_velocity")
    physics = {"loads": "none", "turbulence": "none", "added_mass": False, "density": density}
    return {"name": name, "shape": "samara:ellipsoid", **physics, **{key: [*map(float, x)] for key, x in zip(keys, start)}}


def turn(x, y, z, w):
    """The rotation of a quaternion."""
    across = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + 2 * w * across + 2 * across @ across


def totals(flight):
    """Momentum, angular momentum about the origin, and energy."""
    momentum, angular, energy = numpy.zeros(3), numpy.zeros(3), 0.0
    for name in NAMES:
        (mass, centre_of_mass, own_inertia), poses = flight.mass_properties(name), flight.poses(name)
        axes = turn(*poses.orientation.reshape(4))
        velocity, spin = poses.velocity.reshape(3), poses.angular_velocity.reshape(3)
        inertia = axes @ numpy.reshape(own_inertia, (3, 3)) @ axes.T
        momentum += mass * velocity
        centre = poses.position.reshape(3) + axes @ centre_of_mass
        angular += mass * numpy.cross(centre, velocity) + inertia @ spin
        energy += 0.5 * mass * velocity @ velocity + 0.5 * spin @ inertia @ spin
    return momentum, angular, energy


print("step s   hits  momentum missed  angular momentum missed: mean, most; alone: mean  energy left")
for step in (0.0005, 0.002, 0.01, 1 / 24):
    misses = []
    for pair in starts(30):
        scene = {
            "scene": {"duration": 1, "step": step, "gravity": [0, 0, 0], "bodies_collide": True},
            "fluid": {"density": 1e-6, "viscosity": 1e-9},
            "body": [body(name, density, start) for name, density, start in zip(NAMES, (700, 900), pair)],
        }
        flight = samara.Simulation(samara.Scene(scene))
        flight.watch_contacts(True)
        scale = flight.mass_properties("a")[0]
        begin = before = totals(flight)
        missed = {True: numpy.zeros(2), False: numpy.zeros(2)}
        for number in range(1, round(1 / step) + 1):
            flight.advance(number * step)
            after = totals(flight)
            touch = bool(flight.take_contacts("a")["strongest"].item() > 0)
            missed[touch] += [numpy.linalg.norm(after[i] - before[i]) / scale for i in (0, 1)]
            before = after
        if missed[True].any():
            misses.append((*missed[True], missed[False][1], after[2] / begin[2]))
    moved, turned, alone, energy = numpy.array(misses).T
    line = f"{moved.max():15.1e}  {turned.mean() / ARM:22.4f}  {turned.max() / ARM:6.4f}  {alone.mean() / ARM:12.4f}"
    print(f"{step:6.4f}  {len(misses):4d}  {line}  {energy.mean():11.2f}")
