#!/usr/bin/python3
"""docs/pictures/samara.gif: the samara of docs/scenes/samara.toml spins up, seen by an eye that falls with it.

    spin_picture.py BIN PICTURE.gif

BIN: the folder of the programs. Run from the project's folder.
"""

import glob
import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import run  # noqa: E402
from study_pictures import flights, new_figure, turned  # noqa: E402

SCENE = "docs/scenes/samara.toml"
BEGIN, END = 0.1, 1.25  # s
FRAMES, SLOWED = 25, 4  # in a second; how much slower than it falls
HALF_WIDTH, HALF_HEIGHT = 0.06, 0.042  # m, of what is seen
STEEPNESS = math.radians(25)  # by which the eye looks down
LIGHT = (0.35, -0.6, 0.72)
SHADES = 10
DARK, BRIGHT = (74, 44, 22), (226, 178, 118)


def surface_of(usda):
    """Corners and triangles of the one mesh of a .usda file."""
    with open(usda, encoding="utf-8") as file:
        text = file.read()
    points = re.search(r"point3f\[\] points = \[(.*?)\]", text, re.S).group(1)
    corners = re.search(r"int\[\] faceVertexIndices = \[(.*?)\]", text, re.S).group(1)
    places = [tuple(map(float, place.split(","))) for place in re.findall(r"\(([^)]*)\)", points)]
    indices = [int(index) for index in corners.split(",")]
    return places, list(zip(indices[::3], indices[1::3], indices[2::3]))


def shaded(places, triangles, pose):
    """{shade: outlines} of the triangles that face the eye, in m beside and above the body."""
    corners = [turned(pose.rotation, place) for place in places]
    cosine, sine = math.cos(STEEPNESS), math.sin(STEEPNESS)
    found = {}
    for triangle in triangles:
        a, b, c = (corners[i] for i in triangle)
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.sqrt(sum(n * n for n in normal))
        if length == 0.0 or cosine * normal[1] - sine * normal[2] >= 0.0:
            continue
        lit = max(0.0, sum(n * s for n, s in zip(normal, LIGHT)) / length)
        found.setdefault(round((SHADES - 1) * lit), []).append([(p[0], cosine * p[2] + sine * p[1]) for p in (a, b, c, a)])
    return found


def colour(shade):
    part = shade / (SHADES - 1)
    return "#" + "".join(f"{round(dark + part * (bright - dark)):02x}" for dark, bright in zip(DARK, BRIGHT))


def frame(places, triangles, pose, start):
    """One picture of the moving one."""
    from matplotlib.collections import PolyCollection
    from PIL import Image
    figure = new_figure(680, 480, 9)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(-HALF_WIDTH, HALF_WIDTH)
    axes.set_ylim(-HALF_HEIGHT, HALF_HEIGHT)
    fallen = start[2] - pose.position[2]
    for mark in range(-1, 200):
        height = (fallen - 0.05 * mark) * math.cos(STEEPNESS)
        if abs(height) < HALF_HEIGHT:
            axes.axhline(height, color="#d5dde3", lw=1)
            axes.text(-HALF_WIDTH + 0.002, height + 0.001, f"{5 * mark} cm", color="#8295a3")
    for shade, outlines in sorted(shaded(places, triangles, pose).items()):
        axes.add_collection(PolyCollection(outlines, facecolors=colour(shade), edgecolors=colour(shade), linewidths=0.6, zorder=3), autolim=False)
    spin = abs(pose.angular_velocity[2]) / (2 * math.pi)
    axes.text(HALF_WIDTH - 0.002, HALF_HEIGHT - 0.004, f"{pose.time:.2f} s    sinks at {-pose.velocity[2]:.1f} m/s    {spin:.0f} turns a second",
              ha="right", va="center", color="#26323b", fontsize=11, zorder=4)
    figure.canvas.draw()
    return Image.frombytes("RGBA", (680, 480), bytes(figure.canvas.buffer_rgba())).convert("RGB")


def main(programs, picture):
    with tempfile.TemporaryDirectory() as folder:
        motion, usda = os.path.join(folder, "samara.h5"), os.path.join(folder, "samara.usda")
        scene = os.path.join(folder, "samara.toml")
        with open(SCENE, encoding="utf-8") as given, open(scene, "w", encoding="utf-8") as changed:
            changed.write(re.sub(r"frame_rate = \d+", f"frame_rate = {FRAMES * SLOWED}", given.read()))
        run([f"{programs}/samara", "simulate", scene, "-o", motion, "--json"])
        run([f"{programs}/samara", "export", motion, "-o", usda, "--json"])
        poses = next(iter(flights(programs, motion).values()))
        places, triangles = surface_of(usda)
    middle = [sum(place[i] for place in places) / len(places) for i in range(3)]
    places = [tuple(p - m for p, m in zip(place, middle)) for place in places]
    frames = [frame(places, triangles, pose, poses[0].position).quantize(64) for pose in poses if BEGIN <= pose.time <= END]
    frames[0].save(picture, save_all=True, append_images=frames[1:], duration=1000 // FRAMES, loop=0, optimize=True)
    print(f"Written: {picture}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
