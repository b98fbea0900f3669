"""The C interface of samara (samara.h) in Python: bodies, settings, simulations. Does not import Blender's modules.

SI units, world z up, quaternions (w, x, y, z). Every failure is a SamaraError with one line of text.
"""

import ctypes
import functools
import os
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_int32, c_size_t, c_uint32, c_uint64, c_void_p

import numpy

LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libsamara.so")
API_VERSION = 11

LOADS_NONE, LOADS_COEFFICIENTS, LOADS_TABLE, LOADS_SURFACE, LOADS_OF_BODY = 0, 1, 2, 3, 4
TURBULENCE_NONE, TURBULENCE_AS_LOADS = 0, 3

# Numbers of a pose: position 3, orientation 4 (w, x, y, z), velocity 3, angular velocity 3.
POSE_SIZE = 13


class SamaraError(Exception):
    """An error of the library, or of a check of the add-on, in one line."""


class Settings(ctypes.Structure):
    """samara_settings."""

    _fields_ = [
        ("size", c_size_t),
        ("fluid_density", c_double),
        ("fluid_viscosity", c_double),
        ("current", c_double * 3),
        ("gust_amplitude", c_double * 3),
        ("gust_period", c_double),
        ("gravity", c_double * 3),
        ("step", c_double),
        ("seed", c_uint64),
        ("run", c_uint32),
        ("threads", c_int32),
        ("has_ground", c_int32),
        ("ground", c_double),
        ("wind", c_void_p),
        ("wind_context", c_void_p),
        ("bodies_collide", c_int32),
        ("precision", c_uint64),
    ]


class BodyGroup(ctypes.Structure):
    """samara_body_group."""

    _fields_ = [
        ("size", c_size_t),
        ("name", c_char_p),
        ("count", c_uint32),
        ("density", c_double),
        ("mass", c_double),
        ("has_center_of_mass", c_int32),
        ("center_of_mass", c_double * 3),
        ("inertia", c_double * 9),
        ("position", c_double * 3),
        ("orientation", c_double * 4),
        ("velocity", c_double * 3),
        ("angular_velocity", c_double * 3),
        ("start", c_double),
        ("spread_position", c_double * 3),
        ("spread_angle", c_double),
        ("loads", c_int32),
        ("drag_coefficient", c_double),
        ("lift_coefficient", c_double),
        ("reference_area", c_double),
        ("normal", c_double * 3),
        ("center_of_pressure", c_double * 3),
        ("turbulence", c_int32),
        ("turbulent_kinetic_energy", c_double),
        ("dissipation_rate", c_double),
        ("langevin", c_int32),
        ("table_reynolds_number", c_double),
        ("added_mass", c_int32),
        ("dynamic_coefficients", c_int32),
        ("patches", c_int32),
        ("spread_start", c_double),
        ("smallest_size", c_double),
        ("largest_size", c_double),
        ("area_density", c_double),
    ]


class ObstacleKey(ctypes.Structure):
    """samara_obstacle_key."""

    _fields_ = [("time", c_double), ("position", c_double * 3), ("orientation", c_double * 4)]


class Obstacle(ctypes.Structure):
    """samara_obstacle."""

    _fields_ = [
        ("size", c_size_t),
        ("name", c_char_p),
        ("vertices", c_void_p),
        ("vertex_count", c_size_t),
        ("triangles", c_void_p),
        ("triangle_count", c_size_t),
        ("friction", c_double),
        ("position", c_double * 3),
        ("orientation", c_double * 4),
        ("keys", c_void_p),
        ("key_count", c_size_t),
    ]


# Result and arguments of each function, without the buffer for errors and its size at the end of those that can fail.
_PLAIN = {
    "samara_api_version": (c_int, []),
    "samara_version": (c_char_p, []),
    "samara_body_free": (None, [c_void_p]),
    "samara_body_name": (c_char_p, [c_void_p]),
    "samara_body_mass": (c_double, [c_void_p]),
    "samara_body_has_added_mass": (c_int, [c_void_p]),
    "samara_body_has_tables": (c_int, [c_void_p]),
    "samara_body_has_surface_loads": (c_int, [c_void_p]),
    "samara_body_recommended_loads": (c_int, [c_void_p]),
    "samara_body_vertex_count": (c_size_t, [c_void_p]),
    "samara_body_triangle_count": (c_size_t, [c_void_p]),
    "samara_simulation_free": (None, [c_void_p]),
}
_FALLIBLE = {
    "samara_body_load": [c_char_p, POINTER(c_void_p)],
    "samara_body_get_vertices": [c_void_p, c_void_p, c_size_t],
    "samara_body_get_triangles": [c_void_p, c_void_p, c_size_t],
    "samara_default_settings": [POINTER(Settings), c_size_t],
    "samara_default_body_group": [POINTER(BodyGroup), c_size_t],
    "samara_simulation_create": [POINTER(Settings), POINTER(c_void_p)],
    "samara_simulation_add": [c_void_p, c_void_p, POINTER(BodyGroup), c_void_p],
    "samara_default_obstacle": [POINTER(Obstacle), c_size_t],
    "samara_simulation_add_obstacle": [c_void_p, POINTER(Obstacle), c_void_p],
    "samara_set_wind": [c_void_p, c_char_p],
    "samara_advance_to": [c_void_p, c_double],
    "samara_get_poses": [c_void_p, c_size_t, c_size_t, c_void_p, c_size_t],
    "samara_set_poses": [c_void_p, c_size_t, c_size_t, c_void_p, c_size_t],
    "samara_get_mass_properties": [c_void_p, c_size_t, c_void_p],
}


@functools.lru_cache(maxsize=1)
def library():
    """Returns the loaded library. Where it is missing or incompatible, the next call tries again."""
    try:
        loaded = ctypes.CDLL(LIBRARY)
        for name, (result, arguments) in _PLAIN.items():
            function = getattr(loaded, name)
            function.restype, function.argtypes = result, arguments
        for name, arguments in _FALLIBLE.items():
            function = getattr(loaded, name)
            function.restype, function.argtypes = c_int, arguments + [c_char_p, c_size_t]
    except (OSError, AttributeError) as error:
        raise SamaraError(
            f"samara's library cannot be loaded: {error}; install the add-on's zip for this system again"
        ) from None
    if loaded.samara_api_version() < API_VERSION:
        raise SamaraError(f"{LIBRARY} is older than the add-on; install the add-on's zip again")
    return loaded


def _call(name, *arguments):
    error = ctypes.create_string_buffer(512)
    if getattr(library(), name)(*arguments, error, len(error)) != 0:
        raise SamaraError(error.value.decode("utf-8", "replace"))


def version():
    """Returns the library's version, such as "0.1.0"."""
    return library().samara_version().decode()


class Body:
    """The content of a body file. May be used from several threads."""

    def __init__(self, path):
        self.handle = c_void_p()
        self._free = library().samara_body_free  # of the library that made it
        self.path = path
        _call("samara_body_load", os.fsencode(path), byref(self.handle))

    def __del__(self):
        if self.handle:
            self._free(self.handle)

    @property
    def name(self):
        return library().samara_body_name(self.handle).decode("utf-8", "replace")

    @property
    def mass(self):
        """Returns the mass in the file (kg); 0 where it has none."""
        return library().samara_body_mass(self.handle)

    @property
    def has_added_mass(self):
        return bool(library().samara_body_has_added_mass(self.handle))

    @property
    def has_tables(self):
        return bool(library().samara_body_has_tables(self.handle))

    @property
    def has_surface_loads(self):
        return bool(library().samara_body_has_surface_loads(self.handle))

    def loads_in_use(self, choice):
        """Returns TABLE, SURFACE or COEFFICIENTS: the choice, or for AUTO what the file recommends or holds."""
        if choice != "AUTO":
            return choice
        loads = library().samara_body_recommended_loads(self.handle)
        return {LOADS_TABLE: "TABLE", LOADS_SURFACE: "SURFACE"}.get(loads, "COEFFICIENTS")

    def surface(self):
        """Returns vertices (n, 3), in metres and the shape's axes, and triangles (m, 3), counter-clockwise from outside."""
        vertices = numpy.empty((library().samara_body_vertex_count(self.handle), 3))
        triangles = numpy.empty((library().samara_body_triangle_count(self.handle), 3), numpy.int32)
        _call("samara_body_get_vertices", self.handle, vertices.ctypes.data, vertices.size)
        _call("samara_body_get_triangles", self.handle, triangles.ctypes.data, triangles.size)
        return vertices, triangles


_bodies = {}


def body_of_file(path):
    """Returns the body of a file, which is read again only where the file has changed."""
    if not path:
        raise SamaraError("no body file is chosen; pick one or bake one")
    try:
        status = os.stat(path)
    except OSError as error:
        raise SamaraError(f"{path}: {error.strerror}") from None
    key = (status.st_mtime_ns, status.st_size, status.st_ino)
    if path not in _bodies or _bodies[path][0] != key:
        _bodies[path] = (key, Body(path))
    return _bodies[path][1]


def default_settings():
    settings = Settings()
    _call("samara_default_settings", byref(settings), ctypes.sizeof(settings))
    return settings


def default_body_group():
    group = BodyGroup()
    _call("samara_default_body_group", byref(group), ctypes.sizeof(group))
    return group


class Simulation:
    """A simulation of bodies of several groups among obstacles. Other threads run during a call; only one thread may call at a time."""

    def __init__(self, settings):
        self.handle = c_void_p()
        self._free = library().samara_simulation_free  # of the library that made it
        _call("samara_simulation_create", byref(settings), byref(self.handle))

    def __del__(self):
        if self.handle:
            self._free(self.handle)

    def add_obstacle(self, name, vertices, triangles, friction, keys):
        """Adds an obstacle; to be called before bodies are added. vertices: (n, 3) doubles; triangles: (m, 3) int32; keys: (k, 8)
        doubles with time, place and quaternion, k at least 1."""
        obstacle = Obstacle()
        _call("samara_default_obstacle", byref(obstacle), ctypes.sizeof(obstacle))
        obstacle.name = name.encode()
        obstacle.vertices, obstacle.vertex_count = vertices.ctypes.data, len(vertices)
        obstacle.triangles, obstacle.triangle_count = triangles.ctypes.data, len(triangles)
        obstacle.friction = friction
        obstacle.keys, obstacle.key_count = keys.ctypes.data, len(keys)
        _call("samara_simulation_add_obstacle", self.handle, byref(obstacle), None)

    def set_wind(self, text):
        """Sets the wind by the keys of [wind] of a scene, as TOML."""
        _call("samara_set_wind", self.handle, text.encode())

    def add(self, body, group):
        """Adds a group and returns the number of its first body."""
        first = c_size_t()
        _call("samara_simulation_add", self.handle, body.handle, byref(group), byref(first))
        return first.value

    def lead(self, index, pose):
        """Starts a body at a pose of POSE_SIZE doubles whose velocity is that of the shape's origin."""
        own = numpy.empty(13)  # samara_mass_properties: mass, centre of mass, inertia
        _call("samara_get_mass_properties", self.handle, index, own.ctypes.data)
        pose = numpy.array(pose, numpy.float64)
        (w, axis), center = (pose[3], pose[4:7]), own[1:4]
        turned = center + 2.0 * numpy.cross(axis, numpy.cross(axis, center) + w * center)
        pose[7:10] += numpy.cross(pose[10:13], turned)
        _call("samara_set_poses", self.handle, index, 1, pose.ctypes.data, 0)

    def advance_to(self, time):
        """Advances to a time (s), not before that of the last call."""
        _call("samara_advance_to", self.handle, time)

    def read_poses(self, rows):
        """Copies the poses of all bodies into an array (bodies, POSE_SIZE) of doubles without gaps."""
        _call("samara_get_poses", self.handle, 0, len(rows), rows.ctypes.data, 0)
