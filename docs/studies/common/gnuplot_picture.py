"""What the reports' pictures share: poses from a motion file, silhouettes, and gnuplot."""

import collections
import csv
import math
import os
import subprocess
import tempfile

Pose = collections.namedtuple("Pose", "time position rotation velocity angular_velocity")


def rotation_of(w, x, y, z):
    """The matrix (rows) of a unit quaternion, body to world."""
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def turned(rotation, vector):
    return tuple(sum(a * b for a, b in zip(row, vector)) for row in rotation)


def flights(programs, motion):
    """The poses of each flight of a motion file with one body: {(run, copy): [Pose]}. The position is that of the shape's
    origin (m, world)."""
    found = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as work:
        table = os.path.join(work, "motion.csv")
        subprocess.run([f"{programs}/samara", "export", motion, "-o", table], check=True, stdout=subprocess.DEVNULL)
        with open(table, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                found[int(row["run"]), int(row["copy"])].append(Pose(
                    float(row["time"]), tuple(float(row[f"position_{axis}"]) for axis in "xyz"),
                    rotation_of(*(float(row[f"orientation_{part}"]) for part in "wxyz")),
                    tuple(float(row[f"velocity_{axis}"]) for axis in "xyz"),
                    tuple(float(row[f"angular_velocity_{axis}"]) for axis in "xyz")))
    return dict(found)


def ellipsoid_outline(semi_axes, pose, horizontal, points=48):
    """The outline of an ellipsoid seen level, as points (along the world's axis `horizontal`, 0 or 1; height)."""
    rows = (pose.rotation[horizontal], pose.rotation[2])
    a, b, c = (sum(p * q * s * s for p, q, s in zip(first, second, semi_axes))
               for first, second in ((rows[0], rows[0]), (rows[0], rows[1]), (rows[1], rows[1])))
    first = math.sqrt(a)  # the root of the matrix [[a, b], [b, c]], by Cholesky
    second, third = b / first, math.sqrt(max(0.0, c - b * b / a))
    outline = []
    for i in range(points):
        cosine, sine = math.cos(2 * math.pi * i / points), math.sin(2 * math.pi * i / points)
        outline.append((pose.position[horizontal] + first * cosine, pose.position[2] + second * cosine + third * sine))
    return outline


def block(name, curves):
    """A gnuplot data block of curves, each closed off by a blank line."""
    lines = [f"${name} << EOD"]
    for curve in curves:
        lines += [" ".join(f"{value:.6g}" if isinstance(value, float) else str(value) for value in point) for point in curve]
        lines.append("")
    return "\n".join(lines + ["EOD", ""])


def draw(commands):
    subprocess.run(["gnuplot"], input=commands, text=True, check=True)
