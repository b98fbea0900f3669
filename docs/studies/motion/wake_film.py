#!/usr/bin/python3
"""The film of the README: full CFD's wake beside the runtime, in step, on a held-out fall.

    wake_film.py BIN CASE FILM.webp    BIN: the folder of the programs; CASE: fall_00 of docs/studies/test-falls/disc-1300.toml, solved by
                                       samara validate with --cells 60000 --fields 20 (25 CPU minutes)

The fall is planar. Left, the vorticity across the plane and the body, from the flow that the case keeps; right, the body as
samara simulate moves it with the tables and coefficients of its standard bake, the path of its centre, and, as an outline, the body by
CFD. Run from the project's folder; needs numpy, scipy, matplotlib and Pillow.
"""

import base64
import glob
import json
import os
import sys
import tempfile
from xml.etree import ElementTree

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import ConvexHull

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import baked, run, scene_with  # noqa: E402
from motion_report import FILM as NAME  # noqa: E402
from motion_report import FLOWS_A_SECOND as RATE  # noqa: E402
from study_pictures import flights, new_figure  # noqa: E402
from test_falls_report import FOLDER, SCENES  # noqa: E402

SECONDS = 7.0
WIDTH, HEIGHT = 0.23, 0.23  # of a panel, m
RADIUS, HALF_THICKNESS = 0.02, 0.002  # of docs/studies/falls/disc.geo, m


def arrays(file, *names):
    """The named arrays of a VTK file with inline base64 data."""
    kinds = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
    found = {}
    for element in ElementTree.parse(file).iter("DataArray"):
        if element.get("Name") in names and element.get("Name") not in found:
            data = np.frombuffer(base64.b64decode(element.text.strip()), dtype=np.uint8)[8:].view(kinds[element.get("type")])
            found[element.get("Name")] = data.reshape(-1, int(element.get("NumberOfComponents") or 1))
    return [found[name] for name in names]


def centers(points, connectivity, offsets):
    """The means of the corners of each cell."""
    ends = offsets.ravel()
    sums = np.add.reduceat(points[connectivity.ravel()], np.concatenate(([0], ends[:-1])), axis=0)
    return sums / np.diff(ends, prepend=0)[:, None]


def vorticity(file, center, up, across, length, speed, grid):
    """(rows, columns) of the vorticity (1/s) across the plane of the fall, on a grid (m) about the centre (in units of the case)."""
    points, connectivity, offsets, velocity = arrays(file, "Points", "connectivity", "offsets", "U")
    places = centers(points, connectivity, offsets)
    side = np.cross(up, across)
    relative = places - center
    near = (abs(relative @ side) < 0.35) & (np.linalg.norm(relative, axis=1) < 9)
    flat = np.stack((relative[near] @ across, relative[near] @ up, relative[near] @ side), axis=1)
    x, z = (axis / length for axis in np.meshgrid(*grid))
    field = LinearNDInterpolator(flat, np.stack((velocity[near] @ across, velocity[near] @ up), axis=1))(x, z, 0.0 * x)
    step = (grid[0][1] - grid[0][0]) / length
    return (np.gradient(field[..., 0], step, axis=0) - np.gradient(field[..., 1], step, axis=1)) * speed / length


def disc(center, axis):
    """The corners of the disc seen along its plane of motion: its centre and its axis in that plane."""
    axis = np.asarray(axis) / np.linalg.norm(axis)
    along = np.array((axis[1], -axis[0]))
    return [center + a * RADIUS * along + b * HALF_THICKNESS * axis for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def main(words):
    if len(words) != 4:
        sys.exit(__doc__)
    programs, case, film = words[1:]
    with open(f"{case}/fall.json", encoding="utf-8") as file:
        fall = json.load(file)
    length, speed = fall["length"], fall["speed"]
    up = -np.array(fall["gravity"]) / np.linalg.norm(fall["gravity"])
    across = np.cross((1.0, 0.0, 0.0), up) * -1.0
    with tempfile.TemporaryDirectory() as work:
        body, _ = baked(programs, work, SCENES[NAME])
        motion = f"{work}/motion.h5"
        result = run([f"{programs}/samara", "simulate", scene_with(NAME, {"shape": os.path.abspath(body)}, work, falls=FOLDER), "-o",
                      motion, "--threads", "1", "--json"])
        runtime = flights(programs, motion)[0, 0]
    print(f"runtime: {result['seconds']:.4f} s for {runtime[-1].time:.1f} s")
    # The fall is in the world's y-z plane: the start turns about x.
    plane = [(np.array((pose.position[1], pose.position[2])), np.array((pose.rotation[1][2], pose.rotation[2][2]))) for pose in runtime]
    rate = round(1 / (runtime[1].time - runtime[0].time))
    grid = (np.arange(-0.55 * WIDTH, 0.55 * WIDTH, 0.0011), np.arange(-0.55 * HEIGHT, 0.55 * HEIGHT, 0.0011))
    files = sorted(glob.glob(f"{case}/postProcessing/fields/fall_00_*/internal.vtu"))[: int(SECONDS * RATE)]
    frames, path = [], []
    for number, file in enumerate(files, 1):
        points, = arrays(file.replace("internal.vtu", "boundary/body.vtp"), "Points")
        outline = length * np.stack((points @ across, points @ up), axis=1)
        outline = outline[ConvexHull(outline).vertices]
        path.append((outline.max(axis=0) + outline.min(axis=0)) / 2)
        # Sideways the panels stay, downwards they follow CFD's body.
        corner = np.array((0.0, path[-1][1] + 0.03))
        field = vorticity(file, (corner[0] * across + corner[1] * up) / length, up, across, length, speed, grid)
        index = round(number / RATE * rate)
        frames.append(picture(field, grid, corner, number / RATE, outline, disc(*plane[index]), path,
                              [place for place, _ in plane[:index + 1:rate // RATE]]))
    frames[0].save(film, save_all=True, append_images=frames[1:], duration=round(1000 / RATE), loop=0, quality=80, method=6)
    print(f"Written: {film}, {os.path.getsize(film) / 1e6:.2f} MB, {len(frames)} frames")


def picture(field, grid, corner, time, outline, own, path, own_path):
    """One frame, as an image of Pillow."""
    from PIL import Image
    figure, panels = new_figure(780, 430, 12, columns=2, margins=(0.01, 0.99, 0.02, 0.9), gaps=(0.02, 0))
    for axes, title, trail in zip(panels, ("full CFD: 55,756 cells", "samara: tables, coefficients"), (path, own_path)):
        axes.set(xlim=(corner[0] - WIDTH / 2, corner[0] + WIDTH / 2), ylim=(corner[1] - HEIGHT / 2, corner[1] + HEIGHT / 2), xticks=[],
                 yticks=[], title=title)
        axes.set_aspect("equal")
        axes.grid(False)
        for spine in axes.spines.values():
            spine.set_visible(True)
        axes.plot(*np.array(trail).T, color="#555555", lw=1.0)
    panels[0].imshow(field, origin="lower", extent=(corner[0] + grid[0][0], corner[0] + grid[0][-1], corner[1] + grid[1][0],
                                                    corner[1] + grid[1][-1]), cmap="RdBu_r", vmin=-16, vmax=16, interpolation="bilinear")
    panels[0].fill(*np.array(outline).T, color="#1a1a1a")
    panels[1].fill(*np.array(outline).T, fc="none", ec="#c0392b", lw=1.2)
    panels[1].fill(*np.array(own).T, color="#1f5f8b")
    panels[1].text(0.97, 0.02, f"{time:.1f} s", transform=panels[1].transAxes, ha="right", color="#1a1a1a")
    figure.canvas.draw()
    return Image.frombuffer("RGBA", figure.canvas.get_width_height(), figure.canvas.buffer_rgba(), "raw", "RGBA", 0, 1).convert("RGB")


if __name__ == "__main__":
    main(sys.argv)
