"""Draws motions, bodies and bakes as matplotlib figures::

    figure = samara.plot.motion(motion)                    # or phase, landing; body="leaf", run=0, copy=3
    figure = samara.plot.polars(samara.Body.read("leaf.body.h5"))  # or sphere, convergence
    figure = samara.plot.comparison(motion, "reference.h5")
    samara.plot.save(figure, "motion.svg")                 # or .png

Each function also takes the dict that the programs hand over as JSON, whose key "picture" names what it shows; draw()
takes any of these. The functions of the modules motions, bodies, comparisons and bakes describe the dicts. These modules
need only numpy and matplotlib.
"""

import os
from collections.abc import Mapping
from typing import Any, Callable, Optional, Union

from . import bakes as _bakes
from . import bodies as _bodies
from . import comparisons as _comparisons
from . import motions as _motions
from . import style as _style
from .style import write as write

_DRAWERS: dict[str, Callable[[dict[str, Any]], Any]] = {
    "strip": _motions.strip, "phase": _motions.phase, "landing": _motions.landing,
    "forces": _motions.forces, "polars": _bodies.polars,
    "sphere": _bodies.sphere, "convergence": _bodies.convergence, "comparison": _comparisons.comparison,
    "plan": _bakes.plan,
    "meshes": _bakes.meshes, "histories": _bakes.histories,
}


def draw(data: Mapping[str, Any]) -> Any:
    """Draws the picture that a program handed over: a dict whose "picture" is one of strip, phase, landing, forces, polars, sphere,
    convergence, comparison, plan, meshes, histories. Returns a matplotlib Figure of 2000 x 1300 pixels."""
    with _style.page():
        figure = _DRAWERS[data["picture"]](dict(data))
    return figure


def save(figure: Any, file: Union[str, "os.PathLike[str]"]) -> None:
    """Writes a figure as .png or .svg, by the name's ending. Raises ValueError for another ending."""
    ending = os.path.splitext(os.fspath(file))[1]
    if ending not in (".png", ".svg"):
        raise ValueError(f"{os.fspath(file)}: the format '{ending}' is unknown; end the name in .png or .svg")
    write(figure, os.fspath(file), ending[1:])


def _of_motion(picture: str, given: Any, body: Optional[str], run: int, copy: int) -> Any:
    return draw(given if isinstance(given, Mapping) else given._picture(picture, body, run, copy))


def motion(motion: Any, body: Optional[str] = None, *, run: int = 0, copy: int = 0) -> Any:
    """Draws a body of a samara.Motion along its path: silhouettes from the front and the side at even times, beside its
    descent speed, inclination and angular velocity over time. `body`: its name; by default the first. Returns a
    matplotlib Figure."""
    return _of_motion("strip", motion, body, run, copy)


def phase(motion: Any, body: Optional[str] = None, *, run: int = 0, copy: int = 0) -> Any:
    """Draws the phase portrait of a body of a samara.Motion: its tilt in the plane in which it swings most (degrees)
    against the tilt's rate (rad/s), and both over time. Returns a matplotlib Figure."""
    return _of_motion("phase", motion, body, run, copy)


def forces(motion: Any, body: Optional[str] = None, *, run: int = 0, copy: int = 0) -> Any:
    """Draws the fluid's forces on a body of a samara.Motion that was simulated with forces=True: as arrows at its
    silhouettes, and over time. Returns a matplotlib Figure."""
    return _of_motion("forces", motion, body, run, copy)


def landing(motion: Any, body: Optional[str] = None) -> Any:
    """Draws where all copies and runs of a body of a samara.Motion land, from above, with the distributions of the
    distance from their mean (m) and of the time (s). Returns a matplotlib Figure."""
    return _of_motion("landing", motion, body, 0, 0)


def _of_body(picture: str, given: Any) -> Any:
    return draw(given if isinstance(given, Mapping) else given._picture(picture))


def polars(body: Any) -> Any:
    """Draws drag, lift and moment coefficients and k/U² of a samara.Body with tables against the direction of motion
    (degrees) in the planes of its principal axes. Returns a matplotlib Figure."""
    return _of_body("polars", body)


def sphere(body: Any) -> Any:
    """Draws drag, moment, k and the force's relative standard error of a samara.Body with tables over all directions of
    motion, in Hammer's equal-area projection. Returns a matplotlib Figure."""
    return _of_body("sphere", body)


def convergence(body: Any) -> Any:
    """Draws how accurate the tables of a samara.Body are: drag and k over the cells of the meshes, standard errors by
    source, drag over Reynolds numbers. Returns a matplotlib Figure."""
    return _of_body("convergence", body)


def comparison(motion: Any, reference: Any = None, body: Optional[str] = None,
               window: Optional[tuple[float, float]] = None) -> Any:
    """Draws a samara.Motion (or motion file) beside a reference: paths, inclination over time, spectra of the swings,
    distributions of the inclination. `body`, `window`: as in samara.compare. Returns a matplotlib Figure."""
    if isinstance(motion, Mapping):
        return draw(motion)
    from samara._samara import _comparison_picture
    return draw(_comparison_picture(motion, reference, body=body, window=window))
