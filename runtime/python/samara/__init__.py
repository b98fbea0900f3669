"""Simulates rigid bodies that fall, flutter and tumble through water and air::

    import samara
    scene = samara.Scene({"scene": {"duration": 3, "ground": 0}, "fluid": {"preset": "air"},
                          "body": [{"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 20}]})
    motion = samara.simulate(scene, runs=5)
    motion["leaf"].position          # (runs, frames, copies, 3) in m, without a copy
    motion["leaf"].ensemble()        # descent speed, frequency, regimes, landing, ... with their errors
    samara.plot.motion(motion)       # a matplotlib figure

Lengths are in metres, times in seconds, angles in radians, all else in SI units; world axes have z up. Quaternions are x, y, z, w.

Errors are samara.Error, whose text is one line that names the place and the remedy. An error in an input is an InputError, which is
a ValueError too; that of a file that cannot be read or written is a FileError, an OSError too.
"""

import os as _os
from typing import Any, Callable, Optional, Union

from ._samara import (Body, BodyMotion, Error, FileError, Simulation, InputError, Motion, Poses, Scene, __version__,
                      _body_of_bytes, _motion_of_bytes, compare, fly as _fly, ready_bodies)
from .programs import bake, plan

__all__ = ["Body", "BodyMotion", "Error", "FileError", "Simulation", "InputError", "Motion", "Poses", "Scene", "bake", "compare",
           "plan", "ready_bodies", "simulate", "__version__"]


def simulate(scene: Union[Scene, dict[str, Any], str, "_os.PathLike[str]"], *, runs: int = 1, seed: Optional[int] = None,
             step: Optional[float] = None, threads: int = 0, bodies: Union[str, "_os.PathLike[str]"] = "",
             forces: bool = False, progress: Optional[Callable[[float, float], object]] = None) -> Motion:
    """Simulates a scene (a Scene, a dict, or the name of a scene file) and returns its Motion.

    runs: repetitions that differ by their noise alone. seed, step (s): instead of the scene's. threads: 0 for all cores; the motion is
    the same for any number. bodies: a folder of baked bodies, NAME.body.h5 for each body of the scene. forces: keep the
    fluid's forces of each frame (BodyMotion.forces). progress: called with (done, total), ten times a second at most; an exception in it ends the simulation. Other threads of Python run meanwhile.

    Raises InputError where the scene or a body is wrong, FileError where a file cannot be read, Error where a body's motion leaves
    the range of numbers.
    """
    if isinstance(scene, dict):
        scene = Scene(scene)
    elif not isinstance(scene, Scene):
        scene = Scene.read(scene)
    return _fly(scene, runs=runs, seed=seed, step=step, threads=threads, bodies=bodies, forces=forces,
                progress=progress)


# Pickles name functions of Python: those of the compiled module cannot be pickled.
def _unpickled_motion(data: bytes) -> Motion:
    return _motion_of_bytes(data)


def _unpickled_body(data: bytes) -> Body:
    return _body_of_bytes(data)


def __getattr__(name: str) -> Any:
    if name in ("plot", "report", "datasets"):  # which need matplotlib, or xarray
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
