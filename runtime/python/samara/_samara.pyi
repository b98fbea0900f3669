import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy
import numpy.typing

_Array = numpy.typing.NDArray[numpy.float64]
_Path = Union[str, os.PathLike[str]]
_Progress = Optional[Callable[[float, float], object]]
_Window = Optional[tuple[float, float]]
_Numbers = Union[Sequence[float], _Array]

__version__: str

class Error(RuntimeError):
    """The base of all errors of this module: one line that names the place and the remedy."""

class InputError(Error, ValueError):
    """An error in an input: a scene, the content of a file, an argument. A ValueError too."""

class FileError(Error, OSError):
    """An error of a file that cannot be read or written. An OSError too."""

class Scene:
    """A checked scene: its bodies, their starts and their surroundings. It does not change; make another for other values."""

    def __init__(self, values: dict[str, Any], folder: _Path = ...) -> None:
        """Makes a scene from a dict with the keys of a scene file: {'scene': {'duration': 2}, 'fluid': {...}, 'body': [{...}]}.

        Keys whose value is None are left out. Paths are relative to `folder`. Raises InputError where the scene is wrong.
        """
    @staticmethod
    def read(file: _Path) -> Scene:
        """Reads a scene file (.toml); paths in it are relative to its folder. Raises FileError or InputError."""
    @staticmethod
    def from_text(text: str, folder: _Path = ...) -> Scene:
        """Makes a scene from the text of a scene file; paths in it are relative to `folder`. Raises InputError."""
    @property
    def duration(self) -> float:
        """Duration in s."""
    @property
    def step(self) -> float:
        """Time step in s."""
    @property
    def frame_rate(self) -> float:
        """Frames per second."""
    @property
    def seed(self) -> int:
        """Seed of the noise and of the spread of starts."""
    @property
    def ground(self) -> Optional[float]:
        """Height of level ground in m, or None."""
    @property
    def gravity(self) -> _Array:
        """Gravity in m/s^2, world axes, shape (3,)."""
    @property
    def names(self) -> list[str]:
        """Names of the bodies, in the scene's order."""
    @property
    def text(self) -> str:
        """The scene as the text of a scene file."""

class Body:
    """The content of a body file. Arrays are read-only views."""

    @staticmethod
    def read(file: _Path) -> Body:
        """Reads a body file (.body.h5). Raises FileError where it cannot be read, InputError where its content is wrong."""
    @property
    def name(self) -> str:
        """Name of the body: that of its file or of its scene."""
    @property
    def source(self) -> str:
        """One line: how the surface was made."""
    @property
    def vertices(self) -> _Array:
        """Vertices of the surface in m, shape axes, shape (n, 3)."""
    @property
    def triangles(self) -> numpy.typing.NDArray[numpy.int32]:
        """Three vertex numbers for each triangle, anticlockwise from outside, shape (m, 3)."""
    @property
    def volume(self) -> float:
        """Volume in m^3."""
    @property
    def surface_area(self) -> float:
        """Surface area in m^2."""
    @property
    def centroid(self) -> _Array:
        """Centroid of the volume in m, shape axes, shape (3,)."""
    @property
    def mass(self) -> Optional[float]:
        """Mass in kg that the file gives, or None."""
    @property
    def kirchhoff_tensor(self) -> Optional[_Array]:
        """Added mass for a fluid of 1 kg/m^3, shape (6, 6): angular before linear velocity, about the centroid, shape axes; or None."""
    @property
    def kirchhoff_error(self) -> Optional[float]:
        """Estimated relative error of the tensor, or None."""
    @property
    def quality(self) -> str:
        """Quality of the bake: smoke, preview, standard or high; empty without tables."""
    @property
    def reynolds_numbers(self) -> Optional[_Array]:
        """Reynolds numbers of the tables, ascending, shape (r,); None without tables."""
    @property
    def force_table(self) -> Optional[_Array]:
        """Force coefficients F / (rho U^2 A / 2) over the octahedral map of directions, body axes, shape (r, n, n, 3); or None."""
    @property
    def moment_table(self) -> Optional[_Array]:
        """Moment coefficients M / (rho U^2 A L / 2), as force_table."""
    @property
    def force_error_table(self) -> Optional[_Array]:
        """Standard errors of force_table, or None."""
    @property
    def turbulent_kinetic_energy_table(self) -> Optional[_Array]:
        """k / U^2 over the octahedral map of directions, shape (r, n, n); or None."""
    @property
    def dissipation_rate_table(self) -> Optional[_Array]:
        """epsilon L / U^3, as turbulent_kinetic_energy_table."""
    def loads(self, direction: _Numbers, reynolds_number: float) -> tuple[_Array, _Array]:
        """Returns the tables' force and moment coefficients, each of shape (3,), for a body that moves in `direction` relative to the fluid.

        direction: three numbers, shape axes, of any length. Raises InputError without tables.
        """
    def _picture(self, picture: str) -> dict[str, Any]: ...

class BodyMotion:
    """A body of a motion with all its runs, frames and copies. Arrays are read-only views, which keep the motion alive."""

    @property
    def name(self) -> str:
        """Name of the body in the scene."""
    @property
    def copies(self) -> int:
        """Number of copies."""
    @property
    def models(self) -> str:
        """In words: the loads, the turbulence and the defaults that were used."""
    @property
    def center_of_mass(self) -> _Array:
        """Centre of mass in m, shape axes, shape (3,)."""
    @property
    def position(self) -> _Array:
        """Positions of the centre of mass in m, world axes (z up), shape (runs, frames, copies, 3)."""
    @property
    def orientation(self) -> _Array:
        """Unit quaternions x, y, z, w from shape to world axes, as scipy's Rotation has them, shape (runs, frames, copies, 4)."""
    @property
    def velocity(self) -> _Array:
        """Velocities of the centre of mass in m/s, world axes, shape (runs, frames, copies, 3)."""
    @property
    def angular_velocity(self) -> _Array:
        """Angular velocities in rad/s, world axes, shape (runs, frames, copies, 3)."""
    @property
    def sizes(self) -> Optional[_Array]:
        """Sizes of the copies relative to the vertices, shape (runs, copies); None where all are 1."""
    @property
    def vertices(self) -> _Array:
        """Vertices of the surface in m, shape axes, shape (n, 3)."""
    @property
    def triangles(self) -> numpy.typing.NDArray[numpy.int32]:
        """Three vertex numbers for each triangle, anticlockwise from outside, shape (m, 3)."""
    def measure(self, run: int = ..., copy: int = ..., window: _Window = ...) -> dict[str, Any]:
        """Returns the metrics of one fall as a dict, in SI units and radians: descent_speed, frequency, inclination_amplitude,
        rms_angular_speed, regime and others.

        window: (begin, end) in s; by default the last two thirds of the fall. Raises IndexError for a run or copy that does not exist.
        """
    def ensemble(self) -> dict[str, Any]:
        """Returns the metrics of all runs and copies together as a dict: means, deviations, standard errors, regimes, path_spread, landing."""

class Motion:
    """Poses of bodies at evenly spaced times, in runs that differ by their noise alone."""

    @staticmethod
    def read(file: _Path) -> Motion:
        """Reads a motion file (.h5). Raises FileError or InputError."""
    def write(self, file: _Path) -> None:
        """Writes a motion file (.h5), whole or not at all. Raises FileError."""
    def export(self, file: _Path, run: int = ...) -> None:
        """Writes one run for other programs. The ending of the name chooses the format: .glb, .usda, .chan, .csv or .html."""
    def page(self, run: int = ...) -> str:
        """Returns the page (.html) that plays a run, as text."""
    def _picture(self, picture: str, body: Optional[str], run: int, copy: int) -> dict[str, Any]: ...
    @property
    def times(self) -> _Array:
        """Times of the frames in s, shape (frames,)."""
    @property
    def runs(self) -> int:
        """Number of runs."""
    @property
    def frame_rate(self) -> float:
        """Frames per second."""
    @property
    def seed(self) -> int:
        """Seed of the noise and of the spread of starts."""
    @property
    def scene_text(self) -> str:
        """The scene that was simulated, as text."""
    @property
    def report(self) -> Optional[dict[str, Any]]:
        """Of a motion that was simulated in this process: a dict with steps, implicit_steps, most_substeps, steps_at_limit, seconds, and
        for each body its highest Reynolds number. Otherwise None.
        """
    @property
    def bodies(self) -> list[BodyMotion]:
        """The bodies, in the scene's order."""
    def __getitem__(self, name: str) -> BodyMotion:
        """Returns the body of that name. Raises KeyError."""
    def __len__(self) -> int:
        """Returns the number of bodies."""

class Poses:
    """Poses of a body at one time, for all runs and copies. Arrays are read-only."""

    @property
    def position(self) -> _Array:
        """Positions of the centre of mass in m, world axes (z up), shape (runs, copies, 3)."""
    @property
    def orientation(self) -> _Array:
        """Unit quaternions x, y, z, w from shape to world axes, shape (runs, copies, 4)."""
    @property
    def velocity(self) -> _Array:
        """Velocities of the centre of mass in m/s, world axes, shape (runs, copies, 3)."""
    @property
    def angular_velocity(self) -> _Array:
        """Angular velocities in rad/s, world axes, shape (runs, copies, 3)."""

class Simulation:
    """A simulation that you advance call by call: read and set poses, push bodies, save and restore everything.

    The motion does not depend on how the times are divided into calls. Threads may share a simulation: calls wait for each other.
    """

    def __init__(
        self, scene: Scene, *, runs: int = ..., seed: Optional[int] = ..., threads: int = ..., bodies: _Path =
        """Places the bodies of a scene at their starts, at time 0.

        runs: repetitions that differ by their noise alone. seed: instead of the scene's. threads: 0 for all cores; the motion is the same for any
        number. bodies: a folder of baked bodies, NAME.body.h5 for each body of the scene. Raises InputError or FileError.
        """
    ) -> None: ...
    @property
    def time(self) -> float:
        """Time in s."""
    @property
    def steps(self) -> int:
        """Number of steps so far, over all bodies."""
    @property
    def names(self) -> list[str]:
        """Names of the bodies, in the scene's order."""
    def advance(self, time: float, *, progress: _Progress = ...) -> None:
        """Steps all bodies to a time (s).

        progress: called with (done, total) in s; it may read the simulation but not change it, and an exception in it ends the call. Raises
        InputError for a time that has passed.
        """
    def poses(self, name: str) -> Poses:
        """Returns the poses of all copies of a body in all runs, now. Raises KeyError for an unknown name."""
    def set_pose(
        self,
        name: str,
        *,
        run: int = ...,
        copy: int = ...,
        position: Optional[_Numbers] = ...,
        orientation: Optional[_Numbers] = ...,
        velocity: Optional[_Numbers] = ...,
        angular_velocity: Optional[_Numbers] = ...,
    ) -> None:
        """Moves one body; values that are None stay. Lengths in m, orientation as a unit quaternion x, y, z, w, world axes.

        A body that was removed returns.
        """
    def add_force(
        self,
        name: str,
        force: _Numbers,
        *,
        point: Optional[_Numbers] = ...,
        moment: Optional[_Numbers] = ...,
        run: int = ...,
        copy: int = ...,
    ) -> None:
        """Pushes a body during the next advance(): force in N, moment in N m, world axes. Several add up.

        point: where the force acts, in m, world axes; None: at the centre of mass.
        """
    def add_impulse(
        self,
        name: str,
        impulse: _Numbers,
        *,
        point: Optional[_Numbers] = ...,
        angular_impulse: Optional[_Numbers] = ...,
        run: int = ...,
        copy: int = ...,
    ) -> None:
        """Gives a body an impulse now (N s, world axes) and an angular impulse (N m s); body and fluid take it together.

        point: where it acts, in m, world axes; None: at the centre of mass.
        """
    def remove(self, name: str, *, run: int = ..., copy: int = ...) -> None:
        """Removes a body: it takes no steps and touches nothing. set_pose() puts it back."""
    def fluid_load(self, name: str, *, run: int = ..., copy: int = ...) -> tuple[_Array, _Array, _Array]:
        """Returns the load of the fluid on a body in its next step, for an engine that integrates the body itself: wrench W, shape (6,),
        added inertia A and damping D, shape (6, 6).

        SI units, world axes, at the centre of mass, angular before linear. With the body's own inertia M, own wrench g and step h:
        (M + A + h D) a = g + W. Then call set_pose(), and advance() by one step.
        """
    def mass_properties(self, name: str, *, run: int = ..., copy: int = ...) -> tuple[float, _Array, _Array]:
        """Returns mass (kg), centre of mass (m, from the shape's origin, shape axes, shape (3,)) and inertia about it (kg m^2, shape axes,
        shape (3, 3)) of the body without fluid.
        """
    def set_ground(self, height: Optional[float]) -> None:
        """Sets level ground at a height (m), or removes it (None). Bodies below it are lifted onto it."""
    def set_wind(self, wind: dict[str, Any]) -> None:
        """Replaces the wind from now on: a dict with the keys of [wind] of a scene; {} for none. Raises InputError."""
    def watch_contacts(self, watch: bool) -> None:
        """Records the contacts of bodies with ground, obstacles and each other from now on, or stops (False)."""
    def take_contacts(self, name: str) -> dict[str, Any]:
        """Returns the contacts of a body since the last call, as a dict of arrays of shape (runs, copies) or (runs, copies, 3):

        impulse (N s, world axes, the sum), strongest (N s, of one point in one step; 0: no contact) with its point (m), normal and time (s),
        obstacle (its number; -1: ground or body), body (its number over all bodies of the scene, run by run and copy by copy; -1: none), at_rest.
        Raises InputError while contacts are not watched.
        """
    def state(self) -> bytes:
        """Returns everything that the rest of the motion depends on, as bytes."""
    def set_state(self, state: bytes) -> None:
        """Continues from a state() of a simulation of the same scene and runs. Raises InputError for other bytes."""

def compare(
    motion: Union[Motion, _Path],
    reference: Union[Motion, _Path],
    *,
    body: Optional[str] = ...,
    window: _Window = ...,
    progress: _Progress = ...,
) -> dict[str, Any]:
    """Compares a motion with a reference, such as a fall by full CFD; each is a Motion or a motion file.

    Returns a dict, as 'samara compare --json' prints it: agrees, certain, and each metric of both with its standard error, their difference
    and the verdict. body: its name, where a motion has several. window: (begin, end) in s after the release. progress: called with
    (done, total).
    """
def _comparison_picture(
    motion: Union[Motion, _Path],
    reference: Union[Motion, _Path],
    *,
    body: Optional[str] = ...,
    window: _Window = ...,
) -> dict[str, Any]: ...
def fly(
    scene: Scene,
    *,
    runs: int,
    seed: Optional[int],
    step: Optional[float],
    threads: int,
    bodies: _Path,
    progress: _Progress,
) -> Motion: ...
def ready_bodies() -> dict[str, str]:
    """Returns the ready-baked bodies, which a scene names 'samara:NAME': a dict of each name and what it is for."""
