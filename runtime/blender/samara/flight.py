"""Flights: the poses of objects at every frame, and many of them at once on all cores. Knows nothing of Blender."""

import concurrent.futures
import dataclasses
import os
import threading
from typing import Optional

import numpy

from . import samara_library
from .conventions import noise_name
from .samara_library import SamaraError


@dataclasses.dataclass(frozen=True)
class Request:
    """All that an object's motion depends on, in SI units. Equal requests have equal motions."""

    name: str
    body_file: str
    body_file_time: int  # when the file was written: a file that is baked anew is another request
    density: float
    loads: str  # AUTO: from tables where the file has them, TABLE, COEFFICIENTS
    drag_coefficient: float
    lift_coefficient: float
    noise: bool
    position: tuple  # of the shape's origin
    orientation: tuple  # w, x, y, z
    velocity: tuple  # of the centre of mass, world axes
    angular_velocity: tuple  # world axes
    fluid_density: float
    fluid_viscosity: float
    current: tuple
    gravity: tuple
    ground: Optional[float]
    step: float
    seed: int
    frames: int
    frame_seconds: float
    metres_per_unit: float


def _settings(request):
    settings = samara_library.default_settings()
    settings.fluid_density = request.fluid_density
    settings.fluid_viscosity = request.fluid_viscosity
    settings.current[:] = request.current
    settings.gravity[:] = request.gravity
    settings.step = request.step
    settings.seed = request.seed
    if request.ground is not None:
        settings.has_ground, settings.ground = 1, request.ground
    return settings


def _kind(request, body):
    kind = samara_library.default_kind()
    kind.name = noise_name(request.name).encode()
    kind.density = request.density
    kind.position[:] = request.position
    kind.orientation[:] = request.orientation
    kind.velocity[:] = request.velocity
    kind.angular_velocity[:] = request.angular_velocity
    has_tables = request.loads == "TABLE" or (request.loads == "AUTO" and body.has_tables)
    kind.loads = samara_library.LOADS_TABLE if has_tables else samara_library.LOADS_COEFFICIENTS
    kind.drag_coefficient = request.drag_coefficient
    kind.lift_coefficient = request.lift_coefficient
    kind.turbulence = (
        samara_library.TURBULENCE_AS_LOADS if request.noise else samara_library.TURBULENCE_NONE
    )
    return kind


class Flight:
    """The motion of one object, flown as far as it was asked for."""

    def __init__(self, request):
        self.request = request
        self.poses = numpy.empty((request.frames, samara_library.POSE_SIZE))
        self.flown = 0  # frames
        try:
            body = samara_library.body_of_file(request.body_file)
            self._simulation = samara_library.Simulation(_settings(request), body, _kind(request, body))
        except SamaraError as fault:
            raise SamaraError(f"{request.name}: {fault}") from None

    def fly_to(self, frame, cancelled=None):
        """Up to a frame of the range, counted from 0; ends early once the event `cancelled` is set."""
        try:
            while self.flown <= frame and not (cancelled and cancelled.is_set()):
                self._simulation.advance_to(self.flown * self.request.frame_seconds)
                self._simulation.read_pose(self.poses[self.flown])
                self.flown += 1
        except SamaraError as fault:
            raise SamaraError(f"{self.request.name}: {fault}") from None

    def locations(self):
        """Of the shape's origin at the frames that were flown (n, 3), in Blender units."""
        return self.poses[: self.flown, 0:3] / self.request.metres_per_unit

    def rotations(self):
        """Quaternions at the frames that were flown (n, 4), their signs continuous."""
        return self.poses[: self.flown, 3:7]

    def pose_at(self, frame):
        """Location (3, Blender units) and quaternion at a frame of the range, counted from 0, or between two: there
        as linear keys have it. Held before the first and behind the last."""
        frame = min(max(frame, 0.0), self.request.frames - 1.0)
        before = int(frame)
        share = frame - before
        self.fly_to(before + (share > 0.0))
        pose = self.poses[before]
        if share > 0.0:
            pose = (1.0 - share) * pose + share * self.poses[before + 1]
        rotation = pose[3:7] / numpy.linalg.norm(pose[3:7])
        return pose[0:3] / self.request.metres_per_unit, rotation


class FlightJob:
    """Many flights over all frames, on all cores, beside the thread that started them."""

    def __init__(self, requests):
        self.flights = [Flight(request) for request in requests]
        self._cancelled = threading.Event()
        self._threads = concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count() or 1)
        self._futures = [
            self._threads.submit(flight.fly_to, flight.request.frames - 1, self._cancelled)
            for flight in self.flights
        ]

    def progress(self):
        """From 0 to 1."""
        total = sum(flight.request.frames for flight in self.flights)
        return sum(flight.flown for flight in self.flights) / total if total else 1.0

    def is_done(self):
        """Whether all are flown. Raises what went wrong in one of them."""
        done = all(future.done() for future in self._futures)
        for future in self._futures:
            if future.done() and future.exception() is not None:
                fault = future.exception()
                self.cancel()
                raise fault
        return done

    def wait(self):
        concurrent.futures.wait(self._futures)
        self._threads.shutdown()
        self.is_done()

    def cancel(self):
        """Ends all flights within a frame."""
        self._cancelled.set()
        self._threads.shutdown(wait=True)
