"""Flights: the poses of objects at every frame, many of them in one simulation. Knows nothing of Blender."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import os
import threading
from typing import Optional

import numpy

from . import samara_library
from .conventions import noise_name
from .samara_library import SamaraError


@dataclasses.dataclass(frozen=True)
class Obstacle:
    """What bodies touch, in SI units; arrays as bytes, so that equal obstacles are the same to all that depends on them."""

    name: str
    vertices: bytes  # doubles (n, 3), in the object's axes
    triangles: bytes  # int32 (m, 3)
    friction: float
    keys: bytes  # doubles (k, 8): time, place, quaternion

    @functools.cached_property
    def digest(self):
        """In hexadecimal digits: of all of it."""
        parts = (self.name.encode(), self.vertices, self.triangles, repr(self.friction).encode(), self.keys)
        return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()

    def add_to(self, simulation):
        simulation.add_obstacle(
            noise_name(self.name),
            numpy.frombuffer(self.vertices).reshape(-1, 3),
            numpy.frombuffer(self.triangles, numpy.int32).reshape(-1, 3),
            self.friction,
            numpy.frombuffer(self.keys).reshape(-1, 8),
        )


@dataclasses.dataclass(frozen=True)
class Surroundings:
    """What all bodies of a scene share, and the frames at which they are shown."""

    fluid_density: float
    fluid_viscosity: float
    current: tuple
    wind: str  # TOML
    gravity: tuple
    ground: Optional[float]
    obstacles: tuple
    bodies_collide: bool
    step: float
    seed: int
    frames: int
    frame_seconds: float
    metres_per_unit: float

    @functools.cached_property
    def digest(self):
        """In hexadecimal digits: of all of it."""
        plain = dataclasses.replace(self, obstacles=tuple(obstacle.digest for obstacle in self.obstacles))
        return hashlib.sha256(repr(plain).encode()).hexdigest()

    def simulation(self):
        """One without bodies."""
        settings = samara_library.default_settings()
        settings.fluid_density = self.fluid_density
        settings.fluid_viscosity = self.fluid_viscosity
        settings.current[:] = self.current
        settings.gravity[:] = self.gravity
        settings.step = self.step
        settings.seed = self.seed
        settings.bodies_collide = int(self.bodies_collide)
        if self.ground is not None:
            settings.has_ground, settings.ground = 1, self.ground
        simulation = samara_library.Simulation(settings)
        if self.wind:
            simulation.set_wind(self.wind)
        for obstacle in self.obstacles:
            obstacle.add_to(simulation)
        return simulation


@dataclasses.dataclass(frozen=True)
class Request:
    """All that an object's motion depends on, in SI units. Equal requests have equal motions."""

    name: str
    body_file: str
    body_file_time: int  # when the file was written: a file that is baked anew is another request
    density: float
    mass: str  # FILE: as the file says, by the density where it says nothing; DENSITY, MASS
    mass_given: tuple  # kg, centre of mass or None, inertia (9 numbers) or None; with MASS; at the object's size
    size: float  # over the body file's
    start: float  # s: held until then, or led by keys
    led: bool  # whether the velocities are the keys', of the shape's origin
    loads: str  # AUTO: what the file holds, TABLE, SURFACE, COEFFICIENTS
    drag_coefficient: float
    lift_coefficient: float
    noise: bool
    position: tuple  # of the shape's origin
    orientation: tuple  # w, x, y, z
    velocity: tuple  # of the centre of mass, world axes
    angular_velocity: tuple  # world axes
    surroundings: Surroundings
    company: str = ""  # where bodies meet: the digest of all that fly together

    def group(self, body):
        group = samara_library.default_body_group()
        group.name = noise_name(self.name).encode()
        self._weigh(group, body)
        group.smallest_size = group.largest_size = self.size
        group.start = self.start
        group.position[:] = self.position
        group.orientation[:] = self.orientation
        group.velocity[:] = self.velocity
        group.angular_velocity[:] = self.angular_velocity
        group.loads = getattr(samara_library, f"LOADS_{body.loads_in_use(self.loads)}")
        group.drag_coefficient = self.drag_coefficient
        group.lift_coefficient = self.lift_coefficient
        group.turbulence = samara_library.TURBULENCE_AS_LOADS if self.noise else samara_library.TURBULENCE_NONE
        return group

    def _weigh(self, group, body):
        if self.mass == "MASS":
            mass, center, inertia = self.mass_given
            size = self.size
            group.mass = mass / size**3
            if center is not None:
                group.has_center_of_mass = 1
                group.center_of_mass[:] = [x / size for x in center]
            if inertia is not None:
                group.inertia[:] = [x / size**5 for x in inertia]
        elif self.mass == "DENSITY" or body.mass == 0.0:
            group.density = self.density

    def digest(self):
        """In hexadecimal digits: of all that the motion depends on, the library's version included."""
        plain = dataclasses.replace(self, surroundings=None)
        return hashlib.sha256(f"{samara_library.version()} {self.surroundings.digest} {plain!r}".encode()).hexdigest()


def together(requests):
    """The same requests; where bodies meet, each knows all of them, since each one's motion depends on them all."""
    if not requests or not requests[0].surroundings.bodies_collide:
        return requests
    alone = sorted(dataclasses.replace(request, company="").digest() for request in requests)
    company = hashlib.sha256(" ".join(alone).encode()).hexdigest()
    return [dataclasses.replace(request, company=company) for request in requests]


class Flight:
    """The motion of one object, flown as far as it was asked for."""

    def __init__(self, request, poses, fleet=None):
        self.request = request
        self.poses = poses  # (frames, POSE_SIZE)
        self.fleet = fleet  # that flies it; None: it is all there

    @property
    def flown(self):
        """How many frames."""
        return self.fleet.flown if self.fleet else len(self.poses)

    def is_flying(self):
        """Whether frames are missing that a thread may add; not once it was ended or has failed."""
        return self.fleet is not None and self.fleet.is_flying()

    def fly_to(self, frame):
        """Up to a frame of the range, counted from 0."""
        if frame >= self.flown:
            self.fleet.fly_to(frame)

    def locations(self):
        """Of the shape's origin at the frames that were flown (n, 3), in Blender units."""
        return self.poses[: self.flown, 0:3] / self.request.surroundings.metres_per_unit

    def rotations(self):
        """Quaternions at the frames that were flown (n, 4), their signs continuous."""
        return self.poses[: self.flown, 3:7]

    def pose_at(self, frame):
        """Location (3, Blender units) and quaternion at a frame of the range, counted from 0, or between two: there
        as linear keys have it. Held before the first and behind the last."""
        frame = min(max(frame, 0.0), self.request.surroundings.frames - 1.0)
        before = int(frame)
        share = frame - before
        self.fly_to(before + (share > 0.0))
        pose = self.poses[before]
        if share > 0.0:
            pose = (1.0 - share) * pose + share * self.poses[before + 1]
        rotation = pose[3:7] / numpy.linalg.norm(pose[3:7])
        return pose[0:3] / self.request.surroundings.metres_per_unit, rotation


class Fleet:
    """Flights in the same surroundings, flown by one simulation. May be asked by several threads."""

    def __init__(self, surroundings, requests, refused):
        """`refused`: takes (request, SamaraError) of those that cannot be flown, which are left out."""
        self.surroundings = surroundings
        self.flown = 0
        self.cancelled = threading.Event()  # ends its flights within a frame
        self.failed = False
        self._turn = threading.Condition()
        self._flying = False
        accepted = []
        self._simulation = surroundings.simulation()
        for request in requests:
            try:
                body = samara_library.body_of_file(request.body_file)
                index = self._simulation.add(body, request.group(body))
                if request.led:
                    pose = request.position + request.orientation + request.velocity + request.angular_velocity
                    self._simulation.lead(index, pose)
                accepted.append(request)
            except SamaraError as error:
                refused(request, SamaraError(f"{request.name}: {error}"))
        # Frame by frame, all bodies of one on end, as the library writes them.
        self._poses = numpy.empty((surroundings.frames, len(accepted), samara_library.POSE_SIZE))
        self.flights = [Flight(request, self._poses[:, i], self) for i, request in enumerate(accepted)]

    def is_flying(self):
        return self.flown < self.surroundings.frames and not self.failed and not self.cancelled.is_set()

    def fly_to(self, frame):
        """Up to a frame of the range, counted from 0. Who asks for an early one need not wait for another's late one."""
        while not self.cancelled.is_set():
            with self._turn:
                while self._flying and self.flown <= frame:
                    self._turn.wait()
                if self.flown > frame:
                    return
                self._flying = True
            try:
                self._simulation.advance_to(self.flown * self.surroundings.frame_seconds)
                self._simulation.read_poses(self._poses[self.flown])
                self.flown += 1
            except SamaraError:
                self.failed = True
                raise
            finally:
                with self._turn:
                    self._flying = False
                    self._turn.notify_all()


def fleets_of(requests, refused, count=1):
    """Fleets for requests, `count` for each surroundings at most, but one where bodies meet. `refused`: takes (request,
    SamaraError)."""
    by_surroundings = {}
    for request in requests:
        by_surroundings.setdefault(request.surroundings, []).append(request)
    fleets = []
    for surroundings, group in by_surroundings.items():
        shares = 1 if surroundings.bodies_collide else min(count, len(group))
        for i in range(shares):
            share = group[i::shares]
            try:
                fleets.append(Fleet(surroundings, share, refused))
            except SamaraError as error:  # of an obstacle or the wind
                for request in share:
                    refused(request, error)
    return fleets


class FlightJob:
    """Many flights over all frames, on all cores, beside the thread that started them."""

    def __init__(self, requests):
        def refuse(_, error):
            raise error

        cores = os.cpu_count() or 1
        fleets = fleets_of(requests, refuse, cores)
        flights = {flight.request.name: flight for fleet in fleets for flight in fleet.flights}
        self.flights = [flights[request.name] for request in requests]
        self._fleets = fleets
        self._threads = concurrent.futures.ThreadPoolExecutor(max_workers=cores)
        self._futures = [
            self._threads.submit(fleet.fly_to, fleet.surroundings.frames - 1) for fleet in fleets
        ]

    def progress(self):
        """From 0 to 1."""
        total = sum(fleet.surroundings.frames for fleet in self._fleets)
        return sum(fleet.flown for fleet in self._fleets) / total if total else 1.0

    def is_done(self):
        """Whether all are flown. Raises what went wrong in one of them."""
        done = all(future.done() for future in self._futures)
        for future in self._futures:
            if future.done() and future.exception() is not None:
                error = future.exception()
                self.cancel()
                raise error
        return done

    def wait(self):
        concurrent.futures.wait(self._futures)
        self._threads.shutdown()
        self.is_done()

    def cancel(self):
        """Ends all flights within a frame."""
        for fleet in self._fleets:
            fleet.cancelled.set()
        self._threads.shutdown(wait=True)
