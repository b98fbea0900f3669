#!/usr/bin/env python3
"""Writes the scenes of docs/studies/nature that come in families, from nature_study.py.

    nature_scenes.py FOLDER
"""

import math
import os
import sys

sys.dont_write_bytecode = True
from nature_fruit import mass_properties  # noqa: E402
from nature_study import (  # noqa: E402
    ACCELERATION_DENSITY, ACCELERATIONS, CARDS, DISCS, DISC_DIAMETER, DISC_FLUID, DISC_THICKNESS, FRUITS, GRAVITY, SPHERES,
    SPHERE_DIAMETER, SPHERE_FLUID, SPHERE_RATIO, SPHERE_SPEED, STRIP_FROUDE_NUMBERS, STRIP_THICKNESS_RATIO, TANK_LIQUIDS,
    TANK_SPHERE, card_name, disc_name, fruit_name,
    fruit_shape, strip_name, tank_name)

WATER, AIR = 'preset = "water"', 'preset = "air"'
WATER_DENSITY = 998.2
# Of winged seeds, which are made to spin; all else, which may swing or turn over, has the default of one. Eight say the same as
# sixteen; the samara flies as it ships (docs/studies/spin).
FRUIT_PATCHES, SAMARA_PATCHES = 8, 2
WIDTH = 120


def number(value):
    return f"{value:.9g}"


def liquid(density, viscosity):
    return f"density = {density:.6g}\nviscosity = {viscosity:.6g}"


def commented(text):
    lines, line = [], "#"
    for word in text.split():
        if len(line) + 1 + len(word) > WIDTH:
            lines.append(line)
            line = "#"
        line += " " + word
    return "\n".join(lines + [line]) + "\n"


def turned_about(axis, degrees):
    """The quaternion of a turn about one of the world's axes, as the scene has it."""
    half = math.radians(degrees) / 2
    return [math.cos(half)] + [math.sin(half) if axis == i else 0.0 for i in range(3)]


def scene(text, duration, fluid, name, shape, body, orientation=None, step=0.002, frame_rate=100):
    """A scene of one body; `body`: its keys beside name, shape and orientation."""
    lines = [commented(text) + "[scene]", f"duration = {number(duration)}", f"step = {number(step)}",
             f"frame_rate = {number(frame_rate)}", "", "[fluid]", fluid, "", "[[body]]", f'name = "{name}"', f'shape = "{shape}"']
    lines += [f"{key} = {value}" for key, value in body.items()]
    if orientation:
        lines.append("orientation = [" + ", ".join(number(part) for part in orientation) + "]")
    return "\n".join(lines + [""])


# From the axis that points down to the orientation: the shapes' axes are x, y, z.
DOWN = {0: turned_about(1, 90), 1: turned_about(0, 90), 2: None}
ACCELERATION_SHAPES = {"ellipsoid": "../../../meshes/shapes/ellipsoid.geo", "spheroid": "../falls/spheroid.geo",
                       "sphere": "../../../meshes/shapes/sphere.geo"}


def accelerations():
    for name, (semi_axes, axis) in ACCELERATIONS.items():
        body = name.split("-")[1]
        # The spheroid's short axis is z in its shape.
        along = (2, 0)[axis] if body == "spheroid" else axis
        yield name, scene(
            f"{body.capitalize()} with semi-axes of {', '.join(f'{1000 * a:g}' for a in semi_axes)} mm, let go at rest with axis "
            f"{'xyz'[along]} of its shape down, {ACCELERATION_DENSITY:g} times as dense as water: its first acceleration. Left out: the "
            "runtime flies without loads, by its added mass alone; full CFD has viscosity.",
            0.08, WATER, name, ACCELERATION_SHAPES[body],
            {"density": number(ACCELERATION_DENSITY * WATER_DENSITY), "loads": '"none"'}, DOWN[along], 0.0005, 1000)


def spheres():
    for galileo, duration in SPHERES.items():
        viscosity = SPHERE_FLUID * SPHERE_SPEED * SPHERE_DIAMETER / galileo
        name = f"sphere-ga-{galileo}"
        yield name, scene(
            f"A sphere {SPHERE_RATIO:g} times as dense as its fluid at a Galileo number of {galileo}, let go at rest (Uhlmann and "
            f"Dusek 2014). Their figures are over u_g = sqrt(0.5 g d) = {SPHERE_SPEED:.6f} m/s: diameter and viscosity here are one "
            "choice of units. Left out: nothing; the fluid is unbounded.",
            duration, liquid(SPHERE_FLUID, viscosity), name, ACCELERATION_SHAPES["sphere"],
            {"density": number(SPHERE_RATIO * SPHERE_FLUID)})


def tank_spheres():
    diameter, density = TANK_SPHERE
    for reynolds, (fluid_density, viscosity, duration) in TANK_LIQUIDS.items():
        name = tank_name(reynolds)
        yield name, scene(
            f"A sphere of {1000 * diameter:g} mm in silicone oil, Re {reynolds} (ten Cate and others 2002). Left out: the walls and the "
            "floor of their tank of 100 x 100 x 160 mm, which slow the sphere; here the fluid is unbounded, and the fall ends about "
            "where theirs meets the floor.",
            duration, liquid(fluid_density, viscosity), name, ACCELERATION_SHAPES["sphere"],
            {"scale": number(diameter / 0.04), "density": density}, step=0.001)


def plate():
    yield "plate", scene(
        "An aluminium plate in water that tumbles (Andersen, Pesavento and Wang 2005): 0.81 mm thick, 6.48 mm wide, 2.7 times as "
        "dense as water, let go at 11.5 degrees. Left out: theirs reaches from wall to wall of a narrow tank, so that its flow is "
        "nearly two-dimensional; this one is 5 widths long with free ends.",
        2, liquid(997.05, 0.89e-6 * 997.05), "plate", "plate.geo", {"density": number(2.7 * 997.05)}, turned_about(0, 11.5),
        0.0005, 400)


def strip_scene(froude):
    ratio = froude ** 2 / STRIP_THICKNESS_RATIO
    return scene(
        f"A strip of 100 x 20 x 1 mm at a Froude number of {froude:g} (Belmonte, Eisenberg and Moses 1998): the root of "
        f"(thickness over width) x (density over the fluid's, {ratio:.4g}). Left out: their cell, thin across the strip, in which "
        "the flow is nearly two-dimensional, and the rings that keep the strip upright in it. Fr is varied by the density alone.",
        4, WATER, strip_name(froude), "strip.geo", {"density": number(ratio * WATER_DENSITY)}, turned_about(0, 20), 0.0005, 400)


def strips():
    for froude in STRIP_FROUDE_NUMBERS:
        yield strip_name(froude), strip_scene(froude)


def cards():
    for width, thickness in CARDS:
        name = card_name(width, thickness)
        yield name, scene(
            f"A card of 120 x {width} x {thickness:g} mm of 800 kg/m^3 in air, let go at 30 degrees about its long axis (Mahadevan, Ryu "
            "and Samuel 1999). Their cards' sizes were not at hand: only the exponents of thickness and width are compared.",
            3, AIR, name, f"{name}.geo", {"density": 800}, turned_about(0, 30), 0.0005, 400)


def discs():
    for inertia, reynolds in DISCS:
        ratio = inertia / (math.pi / 64 * DISC_THICKNESS / DISC_DIAMETER)
        speed = math.sqrt(2 * (ratio - 1) * GRAVITY * DISC_THICKNESS / 1.1)  # terminal, broadside
        time = DISC_DIAMETER / speed
        name = disc_name(inertia, reynolds)
        yield name, scene(
            f"A disc a tenth as thick as wide with I* = {inertia:g}, at a Reynolds number of about {reynolds} (Field, Klaus, Moore "
            "and Nori 1997), turned by 20 degrees from level. Left out: their discs were thinner, so that this one is lighter for its I*.",
            100 * time, liquid(DISC_FLUID, DISC_FLUID * speed * DISC_DIAMETER / reynolds), name, "../falls/disc.geo",
            {"density": number(ratio * DISC_FLUID)}, turned_about(1, 20), 0.01 * time, 15 / time)


def fruit_scene(angle, radius, payload):
    mass, centre, inertia = mass_properties(angle, radius, payload)
    rows = "[" + ", ".join("[" + ", ".join(f"{x:.4g}" for x in row) + "]" for row in inertia) + "]"
    curve = f"curved with a radius of {radius} mm" if radius < 10000 else "straight"
    return scene(
        f"A printed fruit with two wings in water (Fauli, Rabault and Carlson 2019): wings at {angle} degrees from the axis, "
        f"{curve}, {payload:g} g of lead in the pod. Mass, centre and inertia by nature_fruit.py, with the water that "
        "fills the pod. Left out: the holes by which it is filled. Assumed: the print weighs 1240 kg/m^3, and the lead lies in the "
        "pod's lower end.",
        6, WATER, fruit_name(angle, radius, payload), f"{fruit_shape(angle, radius)}.geo",
        {"mass": f"{mass:.6g}", "center_of_mass": "[" + ", ".join(f"{x:.5g}" for x in centre) + "]", "inertia": rows,
         "patches": FRUIT_PATCHES})


def fruits():
    for fruit in FRUITS:
        yield fruit_name(*fruit), fruit_scene(*fruit)


def maple():
    yield "maple", scene(
        "The maple samara of meshes/shapes in air, mass and inertia as in docs/scenes/samara.toml. The published figures (Lee, Lee "
        "and Sohn 2014) are of Acer palmatum, whose mass and size were not at hand: this seed is another, larger one.",
        3, AIR, "maple", "../../../meshes/shapes/samara.geo",
        {"mass": "1.42e-4", "center_of_mass": "[0.0035, -0.0003, 0]", "inertia": "[6.8e-10, 1.07e-8, 1.12e-8]",
         "patches": SAMARA_PATCHES},
        turned_about(1, 30), 0.0005, 500)


FAMILIES = (accelerations, spheres, tank_spheres, plate, strips, cards, discs, fruits, maple)


def main(folder):
    for family in FAMILIES:
        for name, text in family():
            with open(os.path.join(folder, f"{name}.toml"), "w", encoding="utf-8") as file:
                file.write(text)
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
