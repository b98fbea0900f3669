#!/usr/bin/env python3
"""Drops a body in water and prints where it is, 24 times a second: the C interface without a compiler.

    fall.py LIBRARY NAME.body.h5      LIBRARY: libsamara.so, of the package /usr/lib/libsamara.so

Any Python 3 will do. Places are those of the shape's origin.
"""

import ctypes
import sys
from ctypes import c_double, c_int32, c_size_t, c_uint32, c_uint64


class Settings(ctypes.Structure):  # samara_settings of samara.h
    _fields_ = [("size", c_size_t), ("fluid_density", c_double), ("fluid_viscosity", c_double),
                ("current", c_double * 3), ("gust_amplitude", c_double * 3), ("gust_period", c_double),
                ("gravity", c_double * 3), ("step", c_double), ("seed", c_uint64), ("run", c_uint32),
                ("threads", c_int32), ("has_ground", c_int32), ("ground", c_double),
                ("wind", ctypes.c_void_p), ("wind_context", ctypes.c_void_p),
                ("bodies_collide", ctypes.c_int32), ("precision", c_uint64)]


class BodyGroup(ctypes.Structure):  # samara_body_group
    _fields_ = [("size", c_size_t), ("name", ctypes.c_char_p), ("count", c_uint32), ("density", c_double),
                ("mass", c_double), ("has_center_of_mass", c_int32), ("center_of_mass", c_double * 3),
                ("inertia", c_double * 9), ("position", c_double * 3), ("orientation", c_double * 4),
                ("velocity", c_double * 3), ("angular_velocity", c_double * 3), ("start", c_double),
                ("spread_position", c_double * 3), ("spread_angle", c_double), ("loads", c_int32),
                ("drag_coefficient", c_double), ("lift_coefficient", c_double), ("reference_area", c_double),
                ("normal", c_double * 3), ("center_of_pressure", c_double * 3), ("turbulence", c_int32),
                ("turbulent_kinetic_energy", c_double), ("dissipation_rate", c_double), ("langevin", c_int32),
                ("table_reynolds_number", c_double), ("added_mass", c_int32), ("dynamic_coefficients", c_int32), ("patches", c_int32),
                ("spread_start", c_double), ("smallest_size", c_double), ("largest_size", c_double), ("area_density", c_double)]


class Pose(ctypes.Structure):  # samara_pose
    _fields_ = [("position", c_double * 3), ("orientation", c_double * 4), ("velocity", c_double * 3),
                ("angular_velocity", c_double * 3)]


def main(library, body_file):
    try:
        samara = ctypes.CDLL(library)
    except OSError as error:
        sys.exit(f"fall.py: {error}")
    error = ctypes.create_string_buffer(256)

    def call(function, *words):
        if getattr(samara, function)(*words, error, c_size_t(len(error))) != 0:
            sys.exit(f"fall.py: {error.value.decode()}")

    body, simulation = ctypes.c_void_p(), ctypes.c_void_p()
    call("samara_body_load", body_file.encode(), ctypes.byref(body))

    settings = Settings()
    call("samara_default_settings", ctypes.byref(settings), c_size_t(ctypes.sizeof(settings)))
    call("samara_simulation_create", ctypes.byref(settings), ctypes.byref(simulation))

    group = BodyGroup()
    call("samara_default_body_group", ctypes.byref(group), c_size_t(ctypes.sizeof(group)))
    group.density = 1200.0
    call("samara_simulation_add", simulation, body, ctypes.byref(group), None)
    samara.samara_body_free(body)

    pose = Pose()
    for frame in range(25):
        call("samara_advance_to", simulation, c_double(frame / 24.0))
        call("samara_get_poses", simulation, c_size_t(0), c_size_t(1), ctypes.byref(pose), c_size_t(0))
        print("{:.4f} s  at {:8.4f} {:8.4f} {:8.4f} m".format(frame / 24.0, *pose.position))
    samara.samara_simulation_free(simulation)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("Usage: fall.py LIBRARY NAME.body.h5")
    main(*sys.argv[1:])
