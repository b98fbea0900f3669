"""What a Blender object asks to be flown."""

import os

import bpy

from .conventions import checked_scale, frame_count, metres_per_unit, seconds_per_frame
from .flight import Request
from .samara_library import SamaraError

FLUIDS = {"WATER": (998.2, 1.002e-3), "AIR": (1.204, 1.825e-5)}  # kg/m^3, Pa s; at 20 degrees Celsius


def body_file_of(o):
    """The absolute path of the object's body file, or an empty text."""
    file = o.samara.body_file
    return os.path.normpath(bpy.path.abspath(file, library=o.library)) if file else ""


def fluid_of(scene):
    """Density (kg/m^3) and dynamic viscosity (Pa s)."""
    settings = scene.samara
    return FLUIDS.get(settings.fluid) or (settings.fluid_density, settings.fluid_viscosity)


def flown_objects(context):
    """The selected objects that have a body file."""
    objects = [o for o in context.selected_objects if o.samara.body_file]
    if not objects:
        raise SamaraError("no selected object has a body file; select objects, and pick or bake their bodies")
    return objects


def has_keys(o):
    """Whether keys or drivers move or turn the object."""
    data = o.animation_data
    if data is None:
        return False
    curves = list(data.drivers) + (list(data.action.fcurves) if data.action else [])
    return any(curve.data_path == "location" or curve.data_path.startswith("rotation") for curve in curves)


def start_pose(o):
    """Location (Blender units) and quaternion from which the object starts: that of now, or of when it went live."""
    if o.samara.live:
        return tuple(o.samara.start_location), tuple(o.samara.start_rotation)
    if o.parent is not None:
        raise SamaraError(f"{o.name}: has a parent; clear it (Alt P, Keep Transformation)")
    location, rotation, scale = o.matrix_world.decompose()
    own_location, own_rotation, _ = o.matrix_basis.decompose()
    if (location - own_location).length > 1e-5 * max(1.0, location.length) or (
        rotation.rotation_difference(own_rotation).angle % 6.28318 > 1e-3
    ):
        raise SamaraError(f"{o.name}: is moved by constraints or delta transforms; apply them first")
    rotation.normalize()
    return tuple(location), tuple(rotation)


def request_of(o, scene):
    """The object's flight over the scene's frame range."""
    body, surroundings = o.samara, scene.samara
    checked_scale(o.name, o.scale, body.body_scale)
    location, rotation = start_pose(o)
    file = body_file_of(o)
    unit = metres_per_unit(scene)
    fluid_density, fluid_viscosity = fluid_of(scene)
    return Request(
        name=o.name,
        body_file=file,
        body_file_time=os.stat(file).st_mtime_ns if os.path.exists(file) else 0,
        density=body.density,
        loads=body.loads,
        drag_coefficient=body.drag_coefficient,
        lift_coefficient=body.lift_coefficient,
        noise=body.noise,
        position=tuple(unit * x for x in location),
        orientation=rotation,
        velocity=tuple(unit * x for x in body.velocity),
        angular_velocity=tuple(body.angular_velocity),
        fluid_density=fluid_density,
        fluid_viscosity=fluid_viscosity,
        current=tuple(unit * x for x in surroundings.current),
        gravity=tuple(scene.gravity) if scene.use_gravity else (0.0, 0.0, 0.0),
        ground=unit * surroundings.ground if surroundings.use_ground else None,
        step=surroundings.step,
        seed=surroundings.seed,
        frames=frame_count(scene),
        frame_seconds=seconds_per_frame(scene),
        metres_per_unit=unit,
    )
