"""Computes the area of a patch from the files of an OpenFOAM mesh, ASCII or binary."""

import array
import math
import os
import re
import sys

from case_files import CaseError, numbers, read

LABELS = {"32": "i", "64": "q"}
SCALARS = {"32": "f", "64": "d"}


def read_file(path):
    """Returns the header of a mesh file, as text, and the bytes after it."""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from error
    header = re.search(rb"FoamFile\s*\{.*?\}", content, re.DOTALL)
    if not header:
        raise CaseError(f"{path}: is not an OpenFOAM file; make the mesh again")
    return header.group(0).decode(errors="replace"), content[header.end():]


def is_binary(header):
    return re.search(r"format\s+binary", header) is not None


def type_code(header, name, codes):
    """Returns the type code of array for labels or scalars by the header's entry arch; without one those of 32-bit labels
    and 64-bit scalars."""
    width = re.search(rf"{name}=(\d+)", header)
    return codes[width.group(1) if width else {"label": "32", "scalar": "64"}[name]]


def binary_list(path, content, start, code, components=1):
    """Returns the next list of a binary file from `start` on, with `components` values per entry, and where it ends."""
    opening = re.compile(rb"(\d+)\s*\(").search(content, start)
    if not opening:
        raise CaseError(f"{path}: is truncated; make the mesh again")
    values = array.array(code)
    end = opening.end() + int(opening.group(1)) * components * values.itemsize
    if end > len(content):
        raise CaseError(f"{path}: is truncated; make the mesh again")
    values.frombytes(content[opening.end():end])
    if sys.byteorder == "big":
        values.byteswap()
    return values, end


def ascii_entries(path, content):
    """Returns the entries of a list in brackets, one per line, as lists of numbers."""
    parts = re.split(r"^\d+\s*^\(", content.decode(errors="replace"), maxsplit=1, flags=re.MULTILINE)
    if len(parts) != 2:
        raise CaseError(f"{path}: holds no list; make the mesh again")
    return [numbers(line) for line in parts[1].splitlines() if "(" in line]


def read_points(path):
    header, content = read_file(path)
    if not is_binary(header):
        return ascii_entries(path, content)
    flat, _ = binary_list(path, content, 0, type_code(header, "scalar", SCALARS), 3)
    return [flat[i:i + 3] for i in range(0, len(flat), 3)]


def read_faces(path, first, count):
    """Returns the corners of `count` faces from `first` on, as indices of points."""
    header, content = read_file(path)
    if not is_binary(header):
        return [[int(corner) for corner in face[1:]] for face in ascii_entries(path, content)[first:first + count]]
    code = type_code(header, "label", LABELS)
    starts, end = binary_list(path, content, 0, code)
    corners, _ = binary_list(path, content, end, code)
    return [corners[starts[face]:starts[face + 1]] for face in range(first, first + count)]


def polygon_area(corners):
    vector = [0.0, 0.0, 0.0]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        vector[0] += (a[1] * b[2] - a[2] * b[1]) / 2
        vector[1] += (a[2] * b[0] - a[0] * b[2]) / 2
        vector[2] += (a[0] * b[1] - a[1] * b[0]) / 2
    return math.hypot(*vector)


def patch_area(mesh_folder, patch):
    """Returns the area of a patch of constant/polyMesh; 0 where there is none of that name."""
    entry = re.search(rf"^\s*{patch}\s*\{{(.*?)\}}", read(os.path.join(mesh_folder, "boundary")),
                      re.MULTILINE | re.DOTALL)
    if not entry:
        return 0.0
    count = int(re.search(r"nFaces\s+(\d+)", entry.group(1)).group(1))
    first = int(re.search(r"startFace\s+(\d+)", entry.group(1)).group(1))
    points = read_points(os.path.join(mesh_folder, "points"))
    faces = read_faces(os.path.join(mesh_folder, "faces"), first, count)
    return math.fsum(polygon_area([points[corner] for corner in face]) for face in faces)
