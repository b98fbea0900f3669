#!/usr/bin/env python3
"""The structs of samara.h as Python writes them down for ctypes, in the add-on and in docs/examples/fall.py: field by field as
the header has them, and of its version."""

import ctypes
import importlib.util
import os
import re
import sys
import types
import unittest

try:
    import numpy  # noqa: F401
except ImportError:  # which the structs do without
    sys.modules["numpy"] = types.ModuleType("numpy")

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
TYPES = {"size_t": ctypes.c_size_t, "double": ctypes.c_double, "uint64_t": ctypes.c_uint64, "uint32_t": ctypes.c_uint32,
         "int32_t": ctypes.c_int32, "int": ctypes.c_int, "const char*": ctypes.c_char_p,
         "void*": ctypes.c_void_p, "samara_wind_function": ctypes.c_void_p, "const double*": ctypes.c_void_p,
         "const int32_t*": ctypes.c_void_p, "const samara_obstacle_key*": ctypes.c_void_p}


def header():
    with open(os.path.join(ROOT, "runtime", "samara.h"), encoding="utf-8") as file:
        return re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)


def fields_of(struct):
    """[(name, ctypes type)] of a struct of the header."""
    body = re.search(rf"typedef struct {struct} \{{(.*?)\}} {struct};", header(), re.DOTALL).group(1)
    fields = []
    for kind, name, count in re.findall(r"([\w ]+\*?)\s+(\w+)(?:\[(\d+)\])?;", body):
        type_of = TYPES[kind.strip()]
        fields.append((name, type_of * int(count) if count else type_of))
    return fields


def module(*path):
    spec = importlib.util.spec_from_file_location("of_" + path[-1][:-3], os.path.join(ROOT, *path))
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


class CStructsTest(unittest.TestCase):
    def check(self, written, struct):
        wanted = fields_of(struct)
        self.assertGreater(len(wanted), 3)
        self.assertEqual(written._fields_, wanted, struct)

    def test_the_add_on_has_the_fields_of_the_header(self):
        library = module("runtime", "blender", "samara", "samara_library.py")
        self.check(library.Settings, "samara_settings")
        self.check(library.Kind, "samara_kind")
        self.check(library.Obstacle, "samara_obstacle")
        self.assertEqual(library.ObstacleKey._fields_, fields_of("samara_obstacle_key"))
        self.assertEqual(library.POSE_SIZE, ctypes.sizeof(type("Pose", (ctypes.Structure,), {"_fields_": fields_of("samara_pose")})) // 8)

    def test_the_add_on_is_of_the_version_of_the_header(self):
        library = module("runtime", "blender", "samara", "samara_library.py")
        self.assertEqual(library.API_VERSION, int(re.search(r"#define SAMARA_API_VERSION (\d+)", header()).group(1)))

    def test_the_example_has_the_fields_of_the_header(self):
        example = module("docs", "examples", "fall.py")
        self.check(example.Settings, "samara_settings")
        self.check(example.Kind, "samara_kind")
        self.check(example.Pose, "samara_pose")


if __name__ == "__main__":
    unittest.main()
