"""The simulated poses of objects at every frame, many objects in one simulation. Does not import Blender's modules."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import math
import os
import threading
from typing import Optional

import numpy

from . import samara_library
from .conventions import noise_name
from .samara_library import SamaraError

FAR_TURN = math.radians(90.0)  # between two frames: a body that turns further has poses in between
KEPT_TURN = math.radians(60.0)  # the most from one kept pose to the next
PARTS = 24  # of a frame, of which those are kept that are needed


@dataclasses.dataclass(frozen=True)
class Obstacle:
    """An obstacle, in SI units. Arrays are stored as bytes, so that equal obstacles compare equal."""

    name: str
    vertices: bytes  # doubles (n, 3), in the object's axes
    triangles: bytes  # int32 (m, 3)
    friction: float
    keys: bytes  # doubles (k, 8): time, place, quaternion

    @functools.cached_property
    def digest(self):
        """Returns the hash of all members in hexadecimal digits."""
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
    """The settings that all bodies of a scene share, and the frames."""

    fluid_density: float
    fluid_viscosity: float
    current: tuple
    winds: tuple  # TOML: one, or one for each frame after the first
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
        """Returns the hash of all members in hexadecimal digits."""
        plain = dataclasses.replace(self, obstacles=tuple(obstacle.digest for obstacle in self.obstacles))
        return hashlib.sha256(repr(plain).encode()).hexdigest()

    def simulation(self):
        """Returns a simulation without bodies."""
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
        if self.winds[0]:
            simulation.set_wind(self.winds[0])
        for obstacle in self.obstacles:
            obstacle.add_to(simulation)
        return simulation


@dataclasses.dataclass(frozen=True)
class Request:
    """All inputs of an object's motion, in SI units. Equal requests have equal motions."""

    name: str
    body_file: str
    body_file_time: int  # modification time: a file that is baked again is another request
    density: float
    area_density: float  # g/m^2
    mass: str  # FILE: the file's mass, or by the density where it has none; DENSITY; AREA; MASS
    mass_given: tuple  # with MASS: kg, centre of mass or None, inertia (9 numbers) or None; at the object's size
    size: float  # relative to the body file
    start: float  # s, until which it is held or follows its keys
    led: bool  # whether the velocities are those of its keys, at the shape's origin
    loads: str  # AUTO (what the file recommends or holds), TABLE, SURFACE, COEFFICIENTS
    patches: int  # 0: as the file recommends, or 1
    drag_coefficient: float
    lift_coefficient: float
    noise: bool
    position: tuple  # of the shape's origin
    orientation: tuple  # w, x, y, z
    velocity: tuple  # of the centre of mass, world axes
    angular_velocity: tuple  # world axes
    surroundings: Surroundings
    group_digest: str = ""  # where bodies collide: the digest of all bodies of the simulation

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
        loads = body.loads_in_use(self.loads)
        # Also with a recommendation a body without tables and loads of its surface has none.
        group.loads = getattr(samara_library, f"LOADS_{'OF_BODY' if self.loads == 'AUTO' and loads != 'COEFFICIENTS' else loads}")
        group.patches = self.patches
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
        elif self.mass == "AREA":
            group.area_density = self.area_density
        elif self.mass == "DENSITY" or body.mass == 0.0:
            group.density = self.density

    def digest(self):
        """Returns the hash of all inputs of the motion, including the library's version, in hexadecimal digits."""
        plain = dataclasses.replace(self, surroundings=None)
        return hashlib.sha256(f"{samara_library.version()} {self.surroundings.digest} {plain!r}".encode()).hexdigest()


def together(requests):
    """Returns the requests; where bodies collide, each with the digest of all, since its motion depends on them."""
    if not requests or not requests[0].surroundings.bodies_collide:
        return requests
    alone = sorted(dataclasses.replace(request, group_digest="").digest() for request in requests)
    group_digest = hashlib.sha256(" ".join(alone).encode()).hexdigest()
    return [dataclasses.replace(request, group_digest=group_digest) for request in requests]


class Flight:
    """The motion of one object, simulated as far as requested."""

    def __init__(self, request, poses, fleet=None):
        self.request = request
        self.poses = poses  # (frames, POSE_SIZE)
        self.fleet = fleet  # the fleet that simulates it; None: it is complete
        self.between = []  # (frame from 0, pose): where it turns far between two frames, if its fleet keeps these

    @property
    def flown(self):
        """Returns the number of simulated frames."""
        return self.fleet.flown if self.fleet else len(self.poses)

    def is_flying(self):
        """Whether a thread may still add missing frames; not after it was cancelled or has failed."""
        return self.fleet is not None and self.fleet.is_flying()

    def fly_to(self, frame):
        """Simulates up to a frame of the range, counted from 0."""
        if frame >= self.flown:
            self.fleet.fly_to(frame)

    def locations(self):
        """Returns the locations of the shape's origin at the simulated frames (n, 3), in Blender units."""
        return self.poses[: self.flown, 0:3] / self.request.surroundings.metres_per_unit

    def rotations(self):
        """Returns the quaternions at the simulated frames (n, 4), with continuous signs."""
        return self.poses[: self.flown, 3:7]

    def pose_at(self, frame):
        """Returns location (3, Blender units) and quaternion at a frame of the range, counted from 0, interpolated between two frames
        like linear keys. Constant before the first and after the last."""
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
    """Bodies in the same surroundings, in one simulation. May be used from several threads."""

    def __init__(self, surroundings, requests, refused, in_parts=False):
        """`refused`: called with (request, SamaraError) for those that cannot be simulated, which are left out. `in_parts`: whether
        poses between frames are kept where bodies turn far."""
        self.surroundings = surroundings
        self.in_parts = in_parts
        self.flown = 0
        self.cancelled = threading.Event()  # ends the simulation within a frame
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
        # By frame, then by body, as the library writes them.
        self._poses = numpy.empty((surroundings.frames, len(accepted), samara_library.POSE_SIZE))
        self.flights = [Flight(request, self._poses[:, i], self) for i, request in enumerate(accepted)]

    def is_flying(self):
        return self.flown < self.surroundings.frames and not self.failed and not self.cancelled.is_set()

    def _advance(self):
        """Simulates the next frame."""
        frame, seconds, winds = self.flown, self.surroundings.frame_seconds, self.surroundings.winds
        if frame > 1 and len(winds) > 1 and winds[frame - 1] != winds[frame - 2]:
            self._simulation.set_wind(winds[frame - 1])
        if frame > 0 and self.in_parts:
            self._advance_in_parts(frame)
        else:
            self._simulation.advance_to(frame * seconds)
            self._simulation.read_poses(self._poses[frame])

    def _advance_in_parts(self, frame):
        parts = numpy.empty((PARTS + 1, *self._poses.shape[1:]))
        parts[0] = self._poses[frame - 1]
        for part in range(1, PARTS + 1):
            self._simulation.advance_to((frame - 1 + part / PARTS) * self.surroundings.frame_seconds)
            self._simulation.read_poses(parts[part])
        self._poses[frame] = parts[PARTS]
        cosines = numpy.abs(numpy.einsum("pij,pij->pi", parts[:-1, :, 3:7], parts[1:, :, 3:7]))
        turns = 2.0 * numpy.arccos(numpy.minimum(cosines, 1.0))
        for i in numpy.flatnonzero(turns.sum(axis=0) > FAR_TURN):
            turned = 0.0
            for part in range(1, PARTS):
                turned += turns[part - 1, i]
                if turned + turns[part, i] > KEPT_TURN:
                    self.flights[i].between.append((frame - 1 + part / PARTS, parts[part, i].copy()))
                    turned = 0.0

    def fly_to(self, frame):
        """Simulates up to a frame of the range, counted from 0. A call for an early frame need not wait for another's late one."""
        while not self.cancelled.is_set():
            with self._turn:
                while self._flying and self.flown <= frame:
                    self._turn.wait()
                if self.flown > frame:
                    return
                self._flying = True
            try:
                self._advance()
                self.flown += 1
            except SamaraError:
                self.failed = True
                raise
            finally:
                with self._turn:
                    self._flying = False
                    self._turn.notify_all()


def fleets_of(requests, refused, count=1, in_parts=False):
    """Returns fleets for requests, at most `count` for each surroundings, but one where bodies collide. `refused`: called with
    (request, SamaraError). `in_parts`: as of Fleet."""
    by_surroundings = {}
    for request in requests:
        by_surroundings.setdefault(request.surroundings, []).append(request)
    fleets = []
    for surroundings, group in by_surroundings.items():
        shares = 1 if surroundings.bodies_collide else min(count, len(group))
        for i in range(shares):
            share = group[i::shares]
            try:
                fleets.append(Fleet(surroundings, share, refused, in_parts))
            except SamaraError as error:  # by an obstacle or the wind
                for request in share:
                    refused(request, error)
    return fleets


class FlightJob:
    """Simulates many objects over all frames, on all cores, beside the calling thread, with poses between frames of bodies that turn
    far."""

    def __init__(self, requests):
        def refuse(_, error):
            raise error

        cores = os.cpu_count() or 1
        fleets = fleets_of(requests, refuse, cores, in_parts=True)
        flights = {flight.request.name: flight for fleet in fleets for flight in fleet.flights}
        self.flights = [flights[request.name] for request in requests]
        self._fleets = fleets
        self._threads = concurrent.futures.ThreadPoolExecutor(max_workers=cores)
        self._futures = [
            self._threads.submit(fleet.fly_to, fleet.surroundings.frames - 1) for fleet in fleets
        ]

    def progress(self):
        """Returns the progress from 0 to 1."""
        total = sum(fleet.surroundings.frames for fleet in self._fleets)
        return sum(fleet.flown for fleet in self._fleets) / total if total else 1.0

    def is_done(self):
        """Whether all are simulated. Raises the error of one that failed."""
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
        """Ends all simulations within a frame."""
        for fleet in self._fleets:
            fleet.cancelled.set()
        self._threads.shutdown(wait=True)
