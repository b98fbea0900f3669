"""The ready-baked bodies that come with the add-on. An object names one as a scene file does: samara:leaf. Does not import
Blender's modules."""

import dataclasses
import functools
import os
import re

from .samara_library import SamaraError

PREFIX = "samara:"
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bodies")


@dataclasses.dataclass(frozen=True)
class ReadyBody:
    """A line of bodies.toml: the fluid and the density that the body was baked for."""

    name: str
    fluid: str  # WATER or AIR
    density: float  # kg/m^3
    purpose: str


@functools.lru_cache(maxsize=1)
def ready_bodies():
    """Returns the ready-baked bodies by name."""
    try:
        with open(os.path.join(FOLDER, "bodies.toml"), encoding="utf-8") as file:
            lines = [dict(re.findall(r'(\w+) = "?((?<=")[^"]*|[^",} ]+)', line)) for line in file if line.lstrip().startswith("{")]
    except OSError as error:
        raise SamaraError(f"{error.filename}: {error.strerror}; install the add-on's zip again") from None
    return {b["name"]: ReadyBody(b["name"], b["fluid"].upper(), float(b.get("density", 1200.0)), b["purpose"]) for b in lines}


def ready_body(file):
    """Returns the ready-baked body that a body file's name means, samara:NAME; None for a path. Raises SamaraError for a NAME that
    is none."""
    if not file.startswith(PREFIX):
        return None
    name = file[len(PREFIX) :]
    if name not in ready_bodies():
        raise SamaraError(f"there is no ready-baked body '{name}'; choose one of {', '.join(ready_bodies())}")
    return ready_bodies()[name]


def path_of(file):
    """Returns the path of the body file that is meant, or None for another than a ready-baked body."""
    body = ready_body(file)
    return os.path.join(FOLDER, f"{body.name}.body.h5") if body else None
