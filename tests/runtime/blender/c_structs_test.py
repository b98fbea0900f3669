#!/usr/bin/env python3
"""What Python writes down of samara.h for ctypes, in the add-on and in docs/examples/fall.py: structs field by field, functions
argument by argument, and constants as the header has them, and of its version."""

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
    with open(os.path.join(ROOT, "runtime", "core", "c_interface", "samara.h"), encoding="utf-8") as file:
        return re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)


def fields_of(struct):
    """[(name, ctypes type)] of a struct of the header."""
    body = re.search(rf"typedef struct {struct} \{{(.*?)\}} {struct};", header(), re.DOTALL).group(1)
    fields = []
    for kind, name, count in re.findall(r"([\w ]+\*?)\s+(\w+)(?:\[(\d+)\])?;", body):
        type_of = TYPES[kind.strip()]
        fields.append((name, type_of * int(count) if count else type_of))
    return fields


def functions():
    """{name: (result, [argument])} of the header, each as a word of C without the argument's name."""
    found = {}
    for result, name, arguments in re.findall(r"SAMARA_API ([^;(]*?)\s*(samara_\w+)\(([^;]*?)\);", header()):
        words = [re.sub(r"\s+", " ", argument).strip() for argument in arguments.split(",")]
        kinds = [re.sub(r"\b\w+(\[\d+\])?$", lambda name: "*" if name[1] else "", word).strip() for word in words if word != "void"]
        found[name] = (result.strip(), kinds)
    return found


def fits(written, kind):
    """Whether a type of ctypes is one of C, given in words: numbers exactly, any pointer for a pointer."""
    if "*" not in kind:
        return written is (ctypes.c_int if kind == "samara_status" else None if kind == "void" else TYPES[kind])
    if kind.replace(" ", "") in ("constchar*", "char*"):
        return written is ctypes.c_char_p
    return written is ctypes.c_void_p or issubclass(written, ctypes._Pointer)


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
        library = module("runtime", "blender", "samara_addon", "samara_library.py")
        self.check(library.Settings, "samara_settings")
        self.check(library.BodyGroup, "samara_body_group")
        self.check(library.Obstacle, "samara_obstacle")
        self.assertEqual(library.ObstacleKey._fields_, fields_of("samara_obstacle_key"))
        self.assertEqual(library.POSE_SIZE, ctypes.sizeof(type("Pose", (ctypes.Structure,), {"_fields_": fields_of("samara_pose")})) // 8)

    def test_the_add_on_has_the_functions_of_the_header(self):
        library = module("runtime", "blender", "samara_addon", "samara_library.py")
        declared = functions()
        self.assertGreater(len(declared), 40)
        written = {name: (result, list(arguments)) for name, (result, arguments) in library._PLAIN.items()}
        for name, arguments in library._FALLIBLE.items():
            written[name] = (ctypes.c_int, arguments + [ctypes.c_char_p, ctypes.c_size_t])
        for name, (result, arguments) in written.items():
            with self.subTest(name):
                wanted_result, wanted = declared[name]
                self.assertTrue(fits(result, wanted_result), wanted_result)
                self.assertEqual(len(arguments), len(wanted))
                for argument, kind in zip(arguments, wanted):
                    self.assertTrue(fits(argument, kind), f"{argument} for {kind}")

    def test_the_add_on_has_the_constants_of_the_header(self):
        library = module("runtime", "blender", "samara_addon", "samara_library.py")
        declared = dict(re.findall(r"SAMARA_((?:LOADS|TURBULENCE)_\w+) =\s+(\d+)", header()))
        written = {name: value for name, value in vars(library).items() if re.match("LOADS_|TURBULENCE_", name)}
        self.assertGreaterEqual(len(written), 5)
        for name, value in written.items():
            self.assertEqual(value, int(declared[name]), name)

    def test_the_add_on_has_what_a_body_weighs_as_numbers_without_gaps(self):
        kinds = [kind for _, kind in fields_of("samara_mass_properties")]
        self.assertEqual(sum(getattr(kind, "_length_", 1) for kind in kinds), 13)
        self.assertEqual([name for name, _ in fields_of("samara_mass_properties")], ["mass", "center_of_mass", "inertia"])

    def test_the_add_on_is_of_the_version_of_the_header(self):
        library = module("runtime", "blender", "samara_addon", "samara_library.py")
        self.assertEqual(library.API_VERSION, int(re.search(r"#define SAMARA_API_VERSION (\d+)", header()).group(1)))

    def test_the_example_has_the_fields_of_the_header(self):
        example = module("docs", "examples", "fall.py")
        self.check(example.Settings, "samara_settings")
        self.check(example.BodyGroup, "samara_body_group")
        self.check(example.Pose, "samara_pose")


if __name__ == "__main__":
    unittest.main()
