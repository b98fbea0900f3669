"""Rigid bodies that fall, flutter and tumble through water and air.

    import samara
    scene = samara.Scene({"scene": {"duration": 3, "ground": 0}, "fluid": {"preset": "air"},
                          "body": [{"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 20}]})
    motion = samara.simulate(scene, runs=5)
    motion["leaf"].position          # (runs, frames, copies, 3) in m, without a copy
    motion["leaf"].ensemble()        # descent speed, frequency, regimes, landing, ... with their errors
    samara.plot.motion(motion)       # a matplotlib figure

Lengths are in metres, times in seconds, angles in radians, all else in SI units; world axes have z up. Errors are samara.Error,
whose text is one line with the place and the remedy: InputError (also a ValueError) for input, FileError (also an OSError) for files
that cannot be read or written.
"""

import os as _os
from typing import Any, Callable, Optional, Union

from ._samara import Body, BodyMotion, Error, FileError, Simulation, InputError, Motion, Poses, Scene, __version__, compare, fly as _fly, ready_bodies
from .programs import bake, plan

__all__ = ["Body", "BodyMotion", "Error", "FileError", "Simulation", "InputError", "Motion", "Poses", "Scene", "bake", "compare",
           "plan", "ready_bodies", "simulate", "__version__"]


def simulate(scene: Union[Scene, dict[str, Any], str, "_os.PathLike[str]"], *, runs: int = 1, seed: Optional[int] = None,
             step: Optional[float] = None, threads: int = 0, bodies: Union[str, "_os.PathLike[str]"] = "",
             progress: Optional[Callable[[float, float], object]] = None) -> Motion:
    """Simulates a scene (a Scene, a dict, or the name of a scene file) and returns its Motion.

    runs: repetitions that differ only in their noise. seed, step: by default those of the scene. threads: 0 for all cores; the motion does
    not depend on it. bodies: a folder of baked bodies, NAME.body.h5 for each body of the scene. progress: called with (done, total) at
    most ten times a second; an exception from it stops the simulation. Other Python threads continue to run.
    """
    if isinstance(scene, dict):
        scene = Scene(scene)
    elif not isinstance(scene, Scene):
        scene = Scene.read(scene)
    return _fly(scene, runs=runs, seed=seed, step=step, threads=threads, bodies=bodies, progress=progress)


def __getattr__(name: str) -> Any:
    if name in ("plot", "report"):  # which need matplotlib
        import importlib
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _show_in_notebook(motion: Motion) -> str:
    from html import escape
    return (f'<iframe srcdoc="{escape(motion.page(), quote=True)}" style="width: 100%; height: 560px; border: 0" '
            f'title="{escape(repr(motion), quote=True)}"></iframe>')


Motion._repr_html_ = _show_in_notebook  # type: ignore[attr-defined]
for _public in (Body, BodyMotion, Error, FileError, Simulation, InputError, Motion, Poses, Scene):
    _public.__module__ = __name__
del _public
