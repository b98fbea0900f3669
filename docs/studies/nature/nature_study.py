"""The cases of README.md: published falls as scenes, and what is measured of them."""

import collections
import math

GRAVITY = 9.81
REGIME = "regime"

# `scene`: of docs/studies/nature, or a path from the project's folder. `quality`: of the bake; None where there is none to make.
# `without_loads`: the body flies by its added mass alone. `measures`: the quantities, as published.csv names them. `scales`: what a
# dimensionless unit is in SI units. `reference`: a motion by full CFD that the project has. `cells`, `step`: of `samara validate`.
# `ready`: a body file of the project that the case flies with, unbaked. `group`: the table on the page.
Case = collections.namedtuple("Case", "name group text scene quality measures scales reference cells step ready "
                              "without_loads")


def case(name, group, text, quality, measures, scales=None, scene=None, reference=None, cells=20000, step=1,
         ready=None, without_loads=False):
    return Case(name, group, text, scene or f"docs/studies/nature/{name}.toml", quality, measures, scales or {}, reference, cells, step, ready,
                without_loads)


# First accelerations: the short, middle and long axis of the body point down one after the other.
ACCELERATION_DENSITY = 1.5  # over the fluid's
ACCELERATIONS = {
    "acceleration-ellipsoid-short": ((0.01, 0.02, 0.04), 0), "acceleration-ellipsoid-middle": ((0.01, 0.02, 0.04), 1),
    "acceleration-ellipsoid-long": ((0.01, 0.02, 0.04), 2), "acceleration-spheroid-axis": ((0.005, 0.02, 0.02), 0),
    "acceleration-spheroid-edge": ((0.005, 0.02, 0.02), 1), "acceleration-sphere": ((0.02, 0.02, 0.02), 0),
}
# Where the jolt of the first steps rings beyond what is measured.
ACCELERATION_STEPS = {"acceleration-spheroid-axis": 0.25}

# Spheres of 4 cm, 1.5 times as dense as the fluid, by their Galileo number: seconds of fall.
SPHERES = {144: 3, 178: 9, 190: 14, 250: 14}
SPHERE_DIAMETER, SPHERE_RATIO, SPHERE_FLUID = 0.04, 1.5, 1000.0
SPHERE_SPEED = math.sqrt((SPHERE_RATIO - 1) * GRAVITY * SPHERE_DIAMETER)

# ten Cate's liquids by the Reynolds number in their figures' captions: density, viscosity (Pa s), seconds until the floor.
TANK_LIQUIDS = {"1.5": (970, 0.373, 4.0), "4.1": (965, 0.212, 2.4), "11.6": (962, 0.113, 1.6), "31.9": (960, 0.058, 1.2)}
TANK_SPHERE = (0.015, 1120)

# Strips of one shape by their Froude number, the root of (thickness over width) x (density over the fluid's).
STRIP_FROUDE_NUMBERS = (0.4, 0.55, 0.67, 0.8, 1.0)
STRIP_THICKNESS_RATIO = 0.05

# Cards by width and thickness (mm).
CARDS = ((20, 0.3), (20, 0.6), (30, 0.3))

# Discs a tenth as thick as wide by dimensionless inertia and the Reynolds number aimed at.
DISCS = ((0.0055, 1000), (0.0074, 1000), (0.015, 1000), (0.03, 1000), (0.056, 1000), (0.1, 1000), (0.0074, 60), (0.056, 60))
DISC_DIAMETER, DISC_THICKNESS, DISC_FLUID = 0.04, 0.004, 998.2

# Winged fruits: base angle (degrees), radius of curvature (mm; 10000 is straight), payload of lead (g).
FRUITS = ((0, 20, 2.16), (0, 26, 0.54), (0, 26, 2.16), (0, 26, 4.0), (0, 35, 2.16), (0, 65, 2.16), (35, 45, 2.16),
          (35, 10000, 2.16), (35, 45, 0.54), (35, 45, 3.78), (35, 35, 2.16), (35, 65, 2.16))


def added_mass(semi_axes, axis):
    """Of an ellipsoid moving along one of its axes, over the displaced mass (Lamb, Hydrodynamics, art. 114)."""
    steps = 4000
    total = 0.0
    for i in range(steps):  # lambda = tan^2 u of the largest semi-axis, which ends the integral at u = pi/2
        u = (i + 0.5) * math.pi / 2 / steps
        scale = max(semi_axes) ** 2
        lam = scale * math.tan(u) ** 2
        root = math.sqrt(math.prod(a * a + lam for a in semi_axes))
        total += 2 * scale * math.tan(u) / math.cos(u) ** 2 / ((semi_axes[axis] ** 2 + lam) * root)
    alpha = total * math.pi / 2 / steps * math.prod(semi_axes)
    return alpha / (2 - alpha)


def first_acceleration(semi_axes, axis):
    """Of the ellipsoids above, let go at rest in a fluid at rest (m/s^2)."""
    return (ACCELERATION_DENSITY - 1) * GRAVITY / (ACCELERATION_DENSITY + added_mass(semi_axes, axis))


def brown_lawler(reynolds):
    return 24 / reynolds * (1 + 0.150 * reynolds ** 0.681) + 0.407 / (1 + 8710 / reynolds)


def terminal_speed(diameter, ratio, kinematic_viscosity):
    """Of a sphere by Brown and Lawler's drag, unbounded."""
    speed = 0.1
    for _ in range(200):
        drag = brown_lawler(speed * diameter / kinematic_viscosity)
        speed = 0.5 * (speed + math.sqrt(4 / 3 * (ratio - 1) * GRAVITY * diameter / drag))
    return speed


def named(text):
    """A name that bodies and files may have: without dots."""
    return text.replace(".", "_")


def tank_name(reynolds):
    return named(f"tank-sphere-{reynolds}")


def strip_name(froude):
    return named(f"strip-{froude:g}")


def card_name(width, thickness):
    return named(f"card-{width}-{thickness:g}")


def disc_name(inertia, reynolds):
    return named(f"disc-{inertia:g}-{reynolds}")


def fruit_shape(angle, radius):
    return f"fruit-{angle}-{radius if radius < 10000 else 'straight'}"


def fruit_name(angle, radius, payload):
    return named(f"{fruit_shape(angle, radius)}-{payload:g}")


CASES = [
    *(case(name, "acceleration", name.removeprefix("acceleration-").replace("-", ", "), None, ("first acceleration",),
           step=ACCELERATION_STEPS.get(name, 1), without_loads=True)
      for name in ACCELERATIONS),
    *(case(f"sphere-ga-{galileo}", "spheres", f"sphere at Ga {galileo}", "standard",
           ("descent speed",) + (("horizontal speed", "drift") if galileo == 178 else ("drift",)), {"u_g": SPHERE_SPEED})
      for galileo in SPHERES),
    *(case(tank_name(reynolds), "spheres", f"sphere in a tank, Re {reynolds}", "standard",
           ("peak speed", "speed without walls")) for reynolds in TANK_LIQUIDS),
    case("sphere", "spheres", "sphere of density 1.3, Re 2.3e4", None, ("descent speed", "drift"), scene="docs/studies/falls/sphere.toml",
         reference="docs/studies/falls/sphere.h5", ready="runtime/bodies/sphere.body.h5"),
    case("plate", "plates", "tumbling plate", "standard", ("horizontal speed", "descent speed", "turning rate", REGIME),
         cells=200000),
    *(case(strip_name(froude), "plates", f"strip at Fr {froude:g}", "standard", (REGIME,), cells=60000)
      for froude in STRIP_FROUDE_NUMBERS),
    *(case(card_name(*card), "plates", f"card of {card[0]} mm, {card[1]:g} mm thick", "standard", ("turning rate", REGIME), cells=60000)
      for card in CARDS),
    case("disc-light", "discs", "disc, I* 0.0074, Re 5,800", None, (REGIME,), scene="docs/studies/falls/disc-light.toml",
         reference="docs/studies/falls/disc-light.h5", ready="docs/studies/falls/bodies/disc-light.body.h5"),
    case("disc-heavy", "discs", "disc, I* 0.056, Re 23,500", None, (REGIME,), scene="docs/studies/falls/disc-heavy.toml",
         reference="docs/studies/falls/disc-heavy.h5", ready="docs/studies/falls/bodies/disc-heavy.body.h5"),
    *(case(disc_name(*disc), "discs", f"disc, I* {disc[0]:g}, Re {disc[1]:,} aimed at", "standard", (REGIME,)) for disc in DISCS),
    *(case(fruit_name(*fruit), "fruits", f"fruit, {fruit[0]} degrees, "
           + (f"R {fruit[1]} mm" if fruit[1] < 10000 else "straight") + f", {fruit[2]:g} g", "preview",
           ("descent speed", "spin")) for fruit in FRUITS),
    case("maple", "fruits", "maple seed", None, ("descent speed", "spin", "coning"), cells=60000,
         ready="runtime/bodies/samara.body.h5"),
]
