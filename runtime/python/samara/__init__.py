"""Rigid bodies that fall, flutter and tumble through water and air.

    import samara
    scene = samara.Scene({"scene": {"duration": 3, "ground": 0}, "fluid": {"preset": "air"},
                          "body": [{"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 20}]})
    motion = samara.simulate(scene, runs=5)
    motion["leaf"].position          # (runs, frames, copies, 3) in m, without a copy
    motion["leaf"].ensemble()        # descent speed, frequency, regimes, landing, ... with their errors

Lengths are in metres, times in seconds, angles in radians, all else in SI units; world axes have z up. Faults are samara.Error,
whose text is one line that names the place and the remedy.
"""

import os as _os

from ._samara import Body, BodyMotion, Error, Flight, Motion, Poses, Scene, __version__, compare, fly as _fly, ready_bodies
from .programs import bake, plan

__all__ = ["Body", "BodyMotion", "Error", "Flight", "Motion", "Poses", "Scene", "bake", "compare", "plan", "ready_bodies",
           "simulate", "__version__"]


def _as_scene(scene):
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, dict):
        return Scene(scene)
    return Scene.read(_os.fspath(scene))


def simulate(scene, *, runs=1, seed=None, step=None, threads=0, bodies="", progress=None):
    """Flies a scene (a Scene, a dict, or the name of a scene file) into a Motion.

    runs: that differ by their noise alone. seed, step: instead of the scene's. threads: 0 for all cores; the motion is the same
    for any number. bodies: a folder of baked bodies, NAME.body.h5 for each body of the scene. progress: called with (done, total)
    ten times a second at most; what it raises ends the flight. Other threads of Python go on meanwhile.
    """
    return _fly(_as_scene(scene), runs=runs, seed=seed, step=step, threads=threads, bodies=bodies, progress=progress)


def _show_in_notebook(motion):
    from html import escape
    return (f'<iframe srcdoc="{escape(motion.page(), quote=True)}" style="width: 100%; height: 560px; border: 0" '
            f'title="{escape(repr(motion), quote=True)}"></iframe>')


Motion._repr_html_ = _show_in_notebook
