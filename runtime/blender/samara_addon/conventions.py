"""Converts between Blender's conventions and samara's: lengths, time, names.

Both have z up, right-handed axes and quaternions (w, x, y, z), so that only scales differ. samara counts metres and
seconds. A Blender unit is `metres_per_unit` metres, a frame is fps_base/fps seconds, and the scene's first frame is
time 0. The scene's gravity is read as m/s^2 whatever a unit is.
"""

import hashlib
import math
import re

from .samara_library import SamaraError


def metres_per_unit(scene):
    """Returns the length of a Blender unit (m): the scene's unit scale, where it has units."""
    units = scene.unit_settings
    return units.scale_length if units.system != "NONE" else 1.0


def seconds_per_frame(scene):
    return scene.render.fps_base / scene.render.fps


def frame_count(scene):
    """Returns the number of frames from the scene's first to its last, inclusive."""
    if scene.frame_end <= scene.frame_start:
        raise SamaraError(
            f"the scene's frame range, {scene.frame_start} to {scene.frame_end}, is empty; "
            "set its end after its start"
        )
    return scene.frame_end - scene.frame_start + 1


def frame_times(scene):
    """Returns the time (s) of every frame of the range."""
    step = seconds_per_frame(scene)
    return [i * step for i in range(frame_count(scene))]


def noise_name(name):
    """Returns the name that seeds an object's noise: unique for each name, with letters, digits, - and _ only."""
    plain = re.sub(r"[^A-Za-z0-9-]", lambda c: "__" if c[0] == "_" else f"_{ord(c[0]):x}_", name)
    if len(plain) <= 64:
        return plain
    return plain[:40] + "_" + hashlib.sha256(name.encode()).hexdigest()[:20]


def continuous(rotations):
    """Chooses the signs of consecutive quaternions (n, 4) so that each is near the one before."""
    for i in range(1, len(rotations)):
        if rotations[i] @ rotations[i - 1] < 0.0:
            rotations[i] = -rotations[i]
    return rotations


def size_of(name, scale, body_scale):
    """Returns the size of an object relative to its body file. Raises SamaraError for an object of another shape."""
    ratios = [a / b if b else 0.0 for a, b in zip(scale, body_scale)]
    if ratios[0] > 0.0 and all(math.isclose(ratio, ratios[0], rel_tol=1e-4) for ratio in ratios):
        return 1.0 if math.isclose(ratios[0], 1.0, rel_tol=1e-4) else sum(ratios) / 3.0
    text = ", ".join(f"{s:.4g}" for s in scale)
    wanted = ", ".join(f"{s:.4g}" for s in body_scale)
    raise SamaraError(
        f"{name}: its scale is ({text}), but the body file is for ({wanted}) or a multiple; apply the scale (Ctrl A) "
        "and bake the body again, or restore the scale"
    )
