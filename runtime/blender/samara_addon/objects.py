"""Makes simulation requests from Blender objects."""

import os

import bpy
import numpy
from mathutils import Quaternion

from .conventions import frame_count, metres_per_unit, seconds_per_frame, size_of
from .flight import Request, Surroundings
from .ready_bodies import path_of
from .samara_library import SamaraError
from .wind import winds_of

FLUIDS = {"WATER": (998.2, 1.002e-3), "AIR": (1.204, 1.825e-5)}  # kg/m^3, Pa s; at 20 degrees Celsius


def path_of_body_file(file, library=None):
    """Returns the absolute path of a body file, given by a path or as a ready-baked body; an empty text for an empty one."""
    return path_of(file) or (os.path.normpath(bpy.path.abspath(file, library=library)) if file else "")


def body_file_of(o):
    """Returns the absolute path of the object's body file, or an empty text."""
    return path_of_body_file(o.samara.body_file, o.library)


def fluid_of(scene):
    """Returns density (kg/m^3) and dynamic viscosity (Pa s) of the scene's fluid."""
    settings = scene.samara
    return FLUIDS.get(settings.fluid) or (settings.fluid_density, settings.fluid_viscosity)


def flown_objects(context):
    """Returns the selected objects that have a body file."""
    objects = [o for o in context.selected_objects if o.samara.body_file]
    if not objects:
        raise SamaraError("no selected object has a body file; select objects, and pick or bake their body files")
    return objects


def has_keys(o):
    """Whether keys or drivers move or rotate the object."""
    data = o.animation_data
    if data is None:
        return False
    curves = list(data.drivers) + (list(data.action.fcurves) if data.action else [])
    return any(curve.data_path == "location" or curve.data_path.startswith("rotation") for curve in curves)


def delta_turn(o):
    """Returns the rotation of the object's delta transform as a quaternion; Python has no access to that of the axis-angle mode."""
    if o.rotation_mode == "QUATERNION":
        return o.delta_rotation_quaternion.normalized()
    return Quaternion() if o.rotation_mode == "AXIS_ANGLE" else o.delta_rotation_euler.to_quaternion()


def turn_by_quaternions(o):
    """Changes the rotation mode and keeps the delta transform."""
    turn = delta_turn(o)
    o.rotation_mode = "QUATERNION"
    o.delta_rotation_quaternion = turn


def own_channels(o, locations, rotations):
    """Returns the locations and quaternions that give poses (n, 3) and (n, 4) together with the object's delta transform."""
    turn = delta_turn(o)
    locations = numpy.asarray(locations) - numpy.array(o.delta_location)
    if turn != Quaternion():
        back = turn.conjugated()
        rotations = numpy.array([back @ Quaternion(rotation) for rotation in rotations])
    return locations, rotations


def scale_of(o):
    """Returns the object's scale, including that of the delta transform."""
    return tuple(a * b for a, b in zip(o.scale, o.delta_scale))


def _require_steady_deltas(o):
    """Raises SamaraError where keys or drivers animate the delta transform, which would move the object too."""
    data = o.animation_data
    curves = [] if data is None else list(data.drivers) + (list(data.action.fcurves) if data.action else [])
    if any(curve.data_path.startswith("delta_") for curve in curves):
        raise SamaraError(f"{o.name}: its delta transform has keys or drivers; clear them, or use keys of location and rotation")


def start_pose(o):
    """Returns location (Blender units) and quaternion of the object's start: the current ones, or those when it became live."""
    if o.samara.live:
        return tuple(o.samara.start_location), tuple(o.samara.start_rotation)
    _require_steady_deltas(o)
    if o.parent is not None:
        raise SamaraError(f"{o.name}: has a parent; clear it (Alt P, Keep Transformation)")
    location, rotation, scale = o.matrix_world.decompose()
    own_location, own_rotation, _ = o.matrix_basis.decompose()
    if (location - own_location).length > 1e-5 * max(1.0, location.length) or (
        rotation.rotation_difference(own_rotation).angle % 6.28318 > 1e-3
    ):
        raise SamaraError(f"{o.name}: is moved by constraints; apply them first")
    rotation.normalize()
    return tuple(location), tuple(rotation)


def surroundings_of(scene, obstacles):
    """Returns the settings that the scene's bodies share. obstacles: those of obstacles.py."""
    settings, unit = scene.samara, metres_per_unit(scene)
    fluid_density, fluid_viscosity = fluid_of(scene)
    return Surroundings(
        fluid_density=fluid_density,
        fluid_viscosity=fluid_viscosity,
        current=tuple(unit * x for x in settings.current),
        winds=winds_of(scene),
        gravity=tuple(scene.gravity) if scene.use_gravity else (0.0, 0.0, 0.0),
        ground=unit * settings.ground if settings.use_ground else None,
        obstacles=obstacles,
        bodies_collide=settings.bodies_meet,
        step=settings.step,
        seed=settings.seed,
        frames=frame_count(scene),
        frame_seconds=seconds_per_frame(scene),
        metres_per_unit=unit,
    )


def _mass_of(body, unit):
    """Returns the mass, centre and inertia that are given with the object; () where they are not used."""
    if body.mass_source != "MASS":
        return ()
    center = tuple(unit * x for x in body.center_of_mass) if body.use_center_of_mass else None
    if not body.use_inertia:
        return body.mass, center, None
    (xx, yy, zz), (xy, xz, yz) = body.inertia, body.products_of_inertia
    return body.mass, center, (xx, xy, xz, xy, yy, yz, xz, yz, zz)


def request_of(o, surroundings, let_go=None):
    """Returns the request of the object's simulation over the scene's frame range. let_go: for an object that follows its keys at
    first, the number of frames until its release at the current pose, and the linear velocity of its origin (Blender units per
    second) and its angular velocity (rad/s) there."""
    body, unit = o.samara, surroundings.metres_per_unit
    if body.is_obstacle:
        raise SamaraError(f"{o.name}: is an obstacle and cannot be simulated; untick Obstacle, or deselect it")
    size = size_of(o.name, scale_of(o), body.body_scale)
    location, rotation = start_pose(o)
    file = body_file_of(o)
    return Request(
        name=o.name,
        body_file=file,
        body_file_time=os.stat(file).st_mtime_ns if os.path.exists(file) else 0,
        density=body.density,
        area_density=body.area_density,
        mass=body.mass_source,
        mass_given=_mass_of(body, unit),
        size=size,
        start=(let_go[0] if let_go else body.release) * surroundings.frame_seconds,
        loads=body.loads,
        drag_coefficient=body.drag_coefficient,
        lift_coefficient=body.lift_coefficient,
        patches=body.patches,
        noise=body.noise,
        position=tuple(unit * x for x in location),
        orientation=rotation,
        led=let_go is not None,
        velocity=tuple(unit * x for x in (let_go[1] if let_go else body.velocity)),
        angular_velocity=tuple(let_go[2] if let_go else body.angular_velocity),
        surroundings=surroundings,
    )
