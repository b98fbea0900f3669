"""Operators that simulate to keyframes, toggle live simulation, and copy the settings."""

import math

import bpy
import numpy
from mathutils import Quaternion

from . import keyframes, live
from .conventions import continuous
from .flight import FlightJob, together
from .job_operator import JobOperator
from .objects import flown_objects, has_keys, request_of, surroundings_of
from .samara_library import SamaraError


MOST_KEYED_SPEED = 100.0  # m/s: a faster motion is a jump, such as of emitters
_BEFORE = 0.25  # frames before the release, or after the return, between which the keys' velocities are measured


def led_frames(o):
    """Returns for how many frames the object follows its keys: a whole number, so that repeated simulations give the same."""
    return max(1, round(o.samara.release)) if has_keys(o) and o.samara.release > 0.0 else 0


def _set_frame(scene, frame):
    scene.frame_set(math.floor(frame), subframe=frame % 1.0)


def _let_go(scene, o, surroundings):
    """Returns the request for an object that is released from its keys, with their pose and velocities there."""
    frames = led_frames(o)
    _set_frame(scene, scene.frame_start + frames - _BEFORE)
    before_location, before_rotation, _ = o.matrix_basis.decompose()
    _set_frame(scene, scene.frame_start + frames)
    location, rotation, _ = o.matrix_basis.decompose()
    seconds = _BEFORE * surroundings.frame_seconds
    velocity = (location - before_location) / seconds
    if surroundings.metres_per_unit * velocity.length > MOST_KEYED_SPEED:
        raise SamaraError(
            f"{o.name}: its keys move at {surroundings.metres_per_unit * velocity.length:.3g} m/s just before its release, "
            f"above the limit of {MOST_KEYED_SPEED:g}; smooth them there, or change Release"
        )
    w, *axis = rotation @ before_rotation.conjugated()
    length = math.hypot(*axis)
    angle = 2.0 * math.atan2(math.copysign(length, w), abs(w))
    angular = [x / length * angle / seconds if length > 0.0 else 0.0 for x in axis]
    return request_of(o, surroundings, (frames, list(velocity), angular))


class _KeyedPath:
    """The poses by keys of an object: until its release, and again from its return on."""

    def __init__(self):
        self.before = []  # poses (location, quaternion) at the frames before the release
        self.returns = None  # frame, counted from 0, from which it follows its keys again
        self.after = []  # poses from the return on
        self.blend = 0  # frames over which it is blended into them
        self.moving = None  # velocities at the return: Blender units and a rotation vector per frame

    def taken_up(self, frames_before):
        """Returns the pose that reaches that of the return at constant velocity."""
        location, rotation = self.after[0]
        moving, angular = self.moving
        turn = Quaternion(angular.normalized(), -frames_before * angular.length)
        return location - frames_before * moving, turn @ rotation

    def leaves_simulated(self, frame):
        """Whether the pose between two frames, counted from 0, is the simulated one."""
        return len(self.before) <= frame and (self.returns is None or frame < self.returns - self.blend)

    def put_into(self, locations, rotations):
        """Inserts the poses by keys into the simulated poses (n, 3) and (n, 4)."""
        for i, (location, rotation) in enumerate(self.before):
            locations[i], rotations[i] = location, rotation
        if self.returns is None:
            return
        for i in range(max(0, self.returns - self.blend + 1), min(self.returns, len(locations))):
            share = 1.0 - (self.returns - i) / self.blend
            share *= share * (3.0 - 2.0 * share)  # keeps the velocities at both ends
            location, rotation = self.taken_up(self.returns - i)
            locations[i] += share * (numpy.array(location) - locations[i])
            rotations[i] = Quaternion(rotations[i]).slerp(rotation, share)
        for i, (location, rotation) in enumerate(self.after, self.returns):
            locations[i], rotations[i] = location, rotation


def _return_frame(o, surroundings):
    """Returns the frame, counted from 0, from which the object follows its keys again; None: never."""
    body = o.samara
    if body.returns == 0:
        return None
    if not has_keys(o):
        raise SamaraError(f"{o.name}: has Return set, but no keys; add keys, or set Return to 0")
    if body.returns <= body.release:
        raise SamaraError(f"{o.name}: returns to its keys before its release; set Return later, or Release earlier")
    return body.returns if body.returns < surroundings.frames else None


def _keyed_paths(scene, objects, surroundings):
    """Returns the poses by keys of the objects that follow them at times, by name. Leaves the scene at another frame."""
    paths = {}
    for o in objects:
        returns = _return_frame(o, surroundings)
        if led_frames(o) == 0 and returns is None:
            continue
        path = paths[o.name] = _KeyedPath()
        if returns is not None:
            path.returns = returns
            path.blend = min(o.samara.return_blend, returns - led_frames(o))
    keyed = [o for o in objects if o.name in paths]
    for i in range(surroundings.frames if keyed else 0):
        here = [
            o
            for o in keyed
            if i < led_frames(o) or (paths[o.name].returns is not None and i >= paths[o.name].returns)
        ]
        if not here:
            continue
        scene.frame_set(scene.frame_start + i)
        for o in here:
            location, rotation, _ = o.matrix_basis.decompose()
            path = paths[o.name]
            (path.before if i < led_frames(o) else path.after).append((location.copy(), rotation.copy()))
    for o in keyed:
        path = paths[o.name]
        if path.returns is None:
            continue
        _set_frame(scene, scene.frame_start + path.returns + _BEFORE)
        location, rotation, _ = o.matrix_basis.decompose()
        turn = rotation @ path.after[0][1].conjugated()
        if turn.w < 0.0:
            turn.negate()
        axis, angle = turn.to_axis_angle()
        path.moving = (location - path.after[0][0]) / _BEFORE, axis * (angle / _BEFORE)
    return paths


def requests_of(context, objects):
    """Returns the objects' requests, which start at their poses at the scene's first frame where keys move them, at their release,
    or else at the current ones; and the poses by keys of those that follow them at times, by name."""
    scene = context.scene
    now = scene.frame_current_final
    obstacles = live.look_at_obstacles(context)
    if any(has_keys(o) for o in objects):
        scene.frame_set(scene.frame_start)
    context.view_layer.update()
    led = [o for o in objects if led_frames(o)]
    try:
        surroundings = surroundings_of(scene, obstacles)
        requests = {o.name: request_of(o, surroundings) for o in objects if o not in led}
        for o in led:
            requests[o.name] = _let_go(scene, o, surroundings)
        paths = _keyed_paths(scene, objects, surroundings)
        return together([requests[o.name] for o in objects]), paths
    finally:
        if scene.frame_current_final != now:
            _set_frame(scene, now)


def insert_flights(context, objects, flights, paths):
    """Writes keys at every frame of the scene's range; where an object follows its keys, they are kept, one per frame. Where a body
    turns far between two frames, adds keys in between. Returns the number of these keys for each object."""
    scene, counts = context.scene, []
    for o, flight in zip(objects, flights):
        if o.samara.live:
            live.go_off(o)
        locations, rotations = flight.locations().copy(), flight.rotations().copy()
        path = paths.get(o.name)
        if path is not None:
            path.put_into(locations, rotations)
        between = [(frame, pose) for frame, pose in flight.between if path is None or path.leaves_simulated(frame)]
        frames = numpy.concatenate((numpy.arange(len(locations)), [frame for frame, _ in between]))
        if between:
            poses = numpy.array([pose for _, pose in between])
            order = frames.argsort()
            frames = frames[order]
            locations = numpy.concatenate((locations, poses[:, 0:3] / flight.request.surroundings.metres_per_unit))[order]
            rotations = numpy.concatenate((rotations, poses[:, 3:7]))[order]
        keyframes.insert_poses(o, scene.frame_start + frames, locations, continuous(rotations))
        counts.append(len(between))
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)
    return counts


def summary(frames, counts):
    """Returns what was simulated, in one line. counts: of each object's keys between frames."""
    text = f"{len(counts)} objects simulated over {frames} frames"
    spinning = sum(count > 0 for count in counts)
    if spinning == 0:
        return text
    return f"{text}; {sum(counts)} more keys between frames, for the rotations of {spinning} by more than 90 degrees"


class SAMARA_OT_simulate(JobOperator, bpy.types.Operator):
    bl_idname = "samara.simulate"
    bl_label = "Simulate to Keyframes"
    bl_description = "Simulates the selected objects over the scene's frame range and inserts keys of location and rotation"
    bl_options = {"UNDO"}  # not REGISTER, by which changed settings of a past call would run it again
    CANCELLED = "simulation cancelled; nothing has changed"

    def start(self, context):
        self._objects = flown_objects(context)
        requests, self._ways = requests_of(context, self._objects)
        return FlightJob(requests)

    def status(self):
        return f"samara is simulating: {100.0 * self.job.progress():.0f} %"

    def finish(self, context):
        counts = insert_flights(context, self._objects, self.job.flights, self._ways)
        self.report({"INFO"}, summary(self.job.flights[0].request.surroundings.frames, counts))
        return {"FINISHED"}


class SAMARA_OT_live(bpy.types.Operator):
    bl_idname = "samara.live"
    bl_label = "Live"
    bl_description = (
        "Makes the selected objects follow their simulations at every frame change, without keys. "
        "Click again to move them back to their start"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            objects = flown_objects(context)
            if all(o.samara.live for o in objects):
                for o in objects:
                    live.go_off(o)
            else:
                context.view_layer.update()
                live.go_live([o for o in objects if not o.samara.live], context)
        except SamaraError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class SAMARA_OT_copy_settings(bpy.types.Operator):
    bl_idname = "samara.copy_settings"
    bl_label = "Copy to Selected"
    bl_description = "Copies the active object's body and settings to the other selected objects"
    bl_options = {"REGISTER", "UNDO"}

    COPIED = (
        "body_file",
        "body_scale",
        "density",
        "mass_source",
        "area_density",
        "mass",
        "use_center_of_mass",
        "center_of_mass",
        "use_inertia",
        "inertia",
        "products_of_inertia",
        "loads",
        "drag_coefficient",
        "lift_coefficient",
        "patches",
        "noise",
        "velocity",
        "angular_velocity",
        "release",
        "returns",
        "return_blend",
    )

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def execute(self, context):
        source = context.object
        for o in context.selected_objects:
            if o == source:
                continue
            for name in self.COPIED:
                setattr(o.samara, name, getattr(source.samara, name))
        return {"FINISHED"}


CLASSES = (SAMARA_OT_simulate, SAMARA_OT_live, SAMARA_OT_copy_settings)
